//! An independent solver of Hertz's oblique impact with tangential compliance: Taylor series in double precision.
//!
//! With delta = L s^2, delta' = U y and d tau = 2 s d sigma, where L is the undamped peak and U the approach speed, A = 5/4 and
//! b = 1 + 1/kappa, all equations are polynomials:
//!
//! ```text
//! s' = y,   y' = -2 A s^4 (1 + h y)
//! sticking, loading:    F' = -3 chi A s^2 u,   u' = 2 b s F
//! sticking, unloading:  Q' = -2 s u,           u' = 3 chi A b s^2 Q,   F = (3/2) chi A s Q
//! slip in direction q:  F = -q f A s^3,        u' = -2 q b f A s^4
//! ```
//!
//! Each step ends at the first event inside it. Events are sign changes between the zeros of the derivative, found the same way, so
//! that none is missed.

/// Number of coefficients of a series.
const TERMS: usize = 25;

/// Part of the radius of convergence that a step takes: what the series leaves out is then 1e-16.
const STEP: f64 = 0.2;

/// Steps after which a run is given up.
const MOST_STEPS: u32 = 100_000;

const ELASTICITY: f64 = 1.25;

/// An impact in reduced numbers; speeds are over the approach speed.
#[derive(Clone, Copy, Debug)]
pub struct CompliantImpact {
    /// Slip before contact.
    pub slip: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Stiffness ratio chi.
    pub stiffness_ratio: f64,
    /// Hysteretic damping h = c_H v.
    pub damping: f64,
    /// Gyration ratio kappa.
    pub gyration_ratio: f64,
    /// Whether the force of the element does not follow its stiffness on unloading.
    pub incremental: bool,
}

/// Its end.
#[derive(Clone, Copy, Debug)]
pub struct CompliantRebound {
    /// Slip at separation.
    pub slip: f64,
    /// Restitution.
    pub restitution: f64,
    /// Number of phases of sticking or of slip in one direction.
    pub phases: u32,
    /// Largest growth of the energy in a step: of the normal motion, the slip and the element.
    pub growth: f64,
}

type Series = [f64; TERMS];

/// Coefficient k of a product.
fn product(a: &Series, b: &Series, k: usize) -> f64 {
    (0..=k).map(|i| a[i] * b[k - i]).sum()
}

fn value(series: &[f64], x: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// All sign changes of a polynomial between 0 and an end.
fn sign_changes(polynomial: &[f64], end: f64) -> Vec<f64> {
    let mut places = vec![0.0];
    if polynomial.len() > 2 {
        let derivative: Vec<f64> = polynomial.iter().enumerate().skip(1).map(|(i, c)| i as f64 * c).collect();
        places.extend(sign_changes(&derivative, end));
    }
    places.push(end);
    let changes = places.windows(2).filter_map(|pair| bisect(polynomial, pair[0], pair[1]));
    changes.collect()
}

/// The sign change between two places, if there is one.
fn bisect(polynomial: &[f64], mut low: f64, mut high: f64) -> Option<f64> {
    let rises = value(polynomial, high) > 0.0;
    if (value(polynomial, low) > 0.0) == rises {
        return None;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if (value(polynomial, middle) > 0.0) == rises {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

/// The first place at which a polynomial that begins positive becomes negative.
fn falls_at(polynomial: &[f64], end: f64) -> Option<f64> {
    sign_changes(polynomial, end).into_iter().find(|&place| value(polynomial, place * (1.0 + 1e-12)) <= 0.0)
}

/// The state; `element` is the force or, where it elongates, the elongation.
#[derive(Clone, Copy)]
struct State {
    s: f64,
    y: f64,
    slip: f64,
    element: f64,
    /// Direction of slip, zero where the element sticks.
    direction: f64,
    elongates: bool,
}

impl CompliantImpact {
    fn mobility(&self) -> f64 {
        1.0 + 1.0 / self.gyration_ratio
    }

    fn series(&self, state: &State) -> [Series; 5] {
        let (a, b, chi, f) = (ELASTICITY, self.mobility(), self.stiffness_ratio, self.friction);
        let [mut s, mut y, mut u, mut x] = [state.s, state.y, state.slip, state.element].map(|start| {
            let mut series = [0.0; TERMS];
            series[0] = start;
            series
        });
        let [mut square, mut fourth, mut of_stick] = [[0.0; TERMS]; 3];
        for k in 0..TERMS - 1 {
            let n = (k + 1) as f64;
            square[k] = product(&s, &s, k);
            fourth[k] = product(&square, &square, k);
            s[k + 1] = y[k] / n;
            y[k + 1] = -2.0 * a * (fourth[k] + self.damping * product(&fourth, &y, k)) / n;
            if state.direction != 0.0 {
                u[k + 1] = -state.direction * 2.0 * b * f * a * fourth[k] / n;
            } else if state.elongates {
                of_stick[k] = product(&square, &x, k);
                u[k + 1] = 3.0 * chi * a * b * of_stick[k] / n;
                x[k + 1] = -2.0 * product(&s, &u, k) / n;
            } else {
                u[k + 1] = 2.0 * b * product(&s, &x, k) / n;
                x[k + 1] = -3.0 * chi * a * product(&square, &u, k) / n;
            }
        }
        square[TERMS - 1] = product(&s, &s, TERMS - 1);
        [s, y, u, x, square]
    }

    fn energy(&self, state: &State) -> f64 {
        let stiffness = 1.5 * self.stiffness_ratio * ELASTICITY * state.s;
        let force = match (state.direction != 0.0, state.elongates) {
            (true, _) => self.friction * ELASTICITY * state.s.powi(3),
            (false, true) => stiffness * state.element,
            (false, false) => state.element,
        };
        let element = if stiffness > 0.0 { 0.5 * force * force / stiffness } else { 0.0 };
        let normal = 0.5 * state.y * state.y + 0.4 * ELASTICITY * state.s.powi(5);
        normal + 0.5 * state.slip * state.slip / self.mobility() + element
    }

    /// From first contact to separation.
    ///
    /// # Panics
    /// If the motion does not end.
    #[must_use]
    pub fn solve(&self) -> CompliantRebound {
        let (f, chi) = (self.friction, self.stiffness_ratio);
        let slips = chi * self.slip.abs() > f;
        let direction = if slips { self.slip.signum() } else { 0.0 };
        let mut state = State { s: 0.0, y: 1.0, slip: self.slip, element: 0.0, direction, elongates: false };
        // Known zeros of the gaps at the beginning of a step, and the direction that has them; zero for both.
        let (mut zeros, mut of) = (3, 0.0);
        let (mut phases, mut growth, mut loading) = (1, 0.0_f64, true);
        for _ in 0..MOST_STEPS {
            let [s, y, u, x, square] = self.series(&state);
            let mut radius = f64::INFINITY;
            for series in [&s, &y, &u, &x] {
                for (power, coefficient) in series.iter().enumerate().skip(TERMS - 9) {
                    radius = radius.min(coefficient.abs().powf(-1.0 / power as f64));
                }
            }
            let mut step = (STEP * radius).min(0.5);
            let end = if loading { y } else { s };
            let ends = falls_at(&end, step);
            step = ends.unwrap_or(step);
            // Sticking turns into slip in a direction, or slip into sticking.
            let mut event: Option<(f64, f64)> = None;
            let limit = if state.elongates { 2.0 / 3.0 } else { 1.0 } * f / chi;
            if state.direction != 0.0 {
                let q = state.direction;
                let rate: Vec<f64> = u.iter().zip(&y).map(|(u, y)| q * u - limit * y).collect();
                event = falls_at(&rate, step).map(|place| (place, 0.0));
            } else if state.slip != 0.0 || state.element != 0.0 {
                let mut most = [0.0; TERMS];
                for (k, most) in most.iter_mut().enumerate() {
                    *most = if state.elongates { limit * square[k] } else { f * ELASTICITY * product(&square, &s, k) };
                }
                for q in [1.0, -1.0] {
                    let known = if of == 0.0 || of == q { zeros } else { 0 };
                    let gap: Vec<f64> = x.iter().zip(&most).map(|(x, most)| q * x + most).skip(known).collect();
                    if let Some(place) = falls_at(&gap, event.map_or(step, |(place, _)| place)) {
                        event = Some((place, q));
                    }
                }
            }
            zeros = 0;
            let before = self.energy(&state);
            step = event.map_or(step, |(place, _)| place);
            [state.s, state.y, state.slip, state.element] = [&s, &y, &u, &x].map(|series| value(series, step));
            growth = growth.max(self.energy(&state) - before);
            let stiffness = 1.5 * chi * ELASTICITY * state.s;
            match event {
                Some((_, q)) => {
                    if q == 0.0 {
                        let force = -state.direction * f * ELASTICITY * state.s.powi(3);
                        state.element = if state.elongates { force / stiffness } else { force };
                        (zeros, of) = (2, state.direction);
                    }
                    state.direction = q;
                    phases += 1;
                }
                None if ends.is_some() && loading => {
                    loading = false;
                    state.y = 0.0;
                    if !self.incremental {
                        state.elongates = true;
                        state.element /= stiffness;
                    }
                }
                None if ends.is_some() => {
                    return CompliantRebound { slip: state.slip, restitution: -state.y, phases, growth };
                }
                None => {}
            }
        }
        panic!("the contact does not end: {self:?}")
    }
}
