//! A solution that shares nothing with the library: the classical Runge-Kutta method on the equations in the contact radius.
//!
//! With the length and the speed of Hertz's impact for units, indentation s^2 and dt = 2 s dz:
//!
//! ds/dz = y,   dy/dz = 2 s^2 (B (1 - g y [y < 0]) - (5/4) s^2 (1 + h y))
//!
//! The steps are a fixed fraction of the time in which the motion changes. An event is met by a last step against its own
//! variable (Henon 1982).

use std::f64::consts::PI;

use reference::grids::Impact;

/// Steps after which a stiff motion is given up.
const MOST_STEPS: u32 = 200_000;

#[derive(Clone, Copy)]
struct Equations {
    adhesion: f64,
    material_damping: f64,
    adhesion_damping: f64,
}

type State = [f64; 2];

const ELASTICITY: f64 = 1.25;

impl Equations {
    fn of(impact: &Impact) -> Self {
        let (mass, root) = (impact.mass(), impact.radius.sqrt());
        let energy = mass * impact.speed * impact.speed;
        let length = (ELASTICITY * energy / (root * impact.stiffness)).powf(0.4);
        let damping = impact.damping_unit() * impact.speed;
        Self {
            adhesion: 2.0 * PI * impact.strength * root * length.powf(1.5) / energy,
            material_damping: impact.zeta_h * damping,
            adhesion_damping: impact.zeta_a * damping,
        }
    }

    /// The equations of the approach, where adhesion is not damped.
    fn on_approach(self) -> Self {
        Self { adhesion_damping: 0.0, ..self }
    }

    fn rates(&self, [s, y]: State) -> State {
        let pull = self.adhesion * (1.0 - self.adhesion_damping * y);
        [y, 2.0 * s * s * (pull - ELASTICITY * s * s * (1.0 + self.material_damping * y))]
    }

    /// How fast the motion changes, in its own units of z.
    fn haste(&self, [s, y]: State) -> f64 {
        let swing = (4.0 * s * (self.adhesion - 2.0 * ELASTICITY * s * s)).abs().sqrt();
        let damping =
            2.0 * s * s * (self.adhesion * self.adhesion_damping + ELASTICITY * s * s * self.material_damping);
        let smallest = (1.0 + self.adhesion).cbrt().recip();
        y.abs() / (s.abs() + smallest) + swing + damping
    }

    fn energy(&self, [s, y]: State) -> f64 {
        0.5 * y * y + 0.4 * ELASTICITY * s.powi(5) - 2.0 / 3.0 * self.adhesion * s.powi(3)
    }
}

/// A step of `length` in z, or in one of the variables.
fn step(at: State, length: f64, rates: impl Fn(State) -> State) -> State {
    let along = |slope: State, length: f64| std::array::from_fn(|i| at[i] + length * slope[i]);
    let first = rates(at);
    let second = rates(along(first, length / 2.0));
    let third = rates(along(second, length / 2.0));
    let fourth = rates(along(third, length));
    std::array::from_fn(|i| at[i] + length / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
}

/// e^2, with so many steps while the motion changes; `None` where it takes too many.
fn restitution_squared(impact: &Impact, fineness: f64) -> Option<f64> {
    let equations = Equations::of(impact);
    let mut state = [0.0, 1.0];
    let mut steps = 0;
    for (equations, event) in [(equations.on_approach(), 1), (equations, 0)] {
        loop {
            steps += 1;
            if steps > MOST_STEPS {
                return None;
            }
            if event == 0 && equations.energy(state) < 0.0 {
                return Some(0.0);
            }
            let length = (fineness * equations.haste(state)).recip();
            let next = step(state, length, |at| equations.rates(at));
            if !next[1].is_finite() {
                return None;
            }
            if next[event] <= 0.0 {
                let against = |at: State| {
                    let rates = equations.rates(at);
                    rates.map(|rate| rate / rates[event])
                };
                state = step(state, -state[event], against);
                state[event] = 0.0;
                break;
            }
            state = next;
        }
    }
    Some(state[1] * state[1])
}

/// Error up to which a solution counts as known.
const KNOWN: f64 = 1e-12;

/// e^2, where two numbers of steps agree on it.
pub(super) fn confirmed(impact: &Impact) -> Option<f64> {
    let coarse = restitution_squared(impact, 700.0)?;
    let fine = restitution_squared(impact, 1400.0)?;
    ((coarse - fine).abs() < KNOWN).then_some(fine)
}

/// e without adhesion, the root of d (1 + e) = ln((1 + d)/(1 - e d)).
pub(super) fn without_adhesion(damping: f64) -> f64 {
    let (mut low, mut high) = (0.0, damping.recip().min(1.0));
    for _ in 0..100 {
        let e = 0.5 * (low + high);
        if beyond_logarithm(damping) > beyond_logarithm(-e * damping) { low = e } else { high = e }
    }
    0.5 * (low + high)
}

/// x - ln(1 + x), without cancellation.
fn beyond_logarithm(x: f64) -> f64 {
    if x.abs() > 0.1 {
        return x - x.ln_1p();
    }
    // The series, from its small terms on.
    (2..=18).rev().fold(0.0, |sum, power| x * sum + if power % 2 == 0 { 1.0 } else { -1.0 } / f64::from(power)) * x * x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_logarithm_agree() {
        for x in [-0.1, 0.1_f64] {
            assert!((beyond_logarithm(x) / (x - x.ln_1p()) - 1.0).abs() < 1e-13);
        }
        // 1 - e is (2/3) d for small d.
        assert!((without_adhesion(1e-6) - (1.0 - 2e-6 / 3.0)).abs() < 1e-11);
    }

    /// The digits of the specification of d = 0.1, 1 and 10.
    #[test]
    fn closed_form_and_steps_agree() {
        for (damping, e) in [(0.1, 0.937_475_580), (1.0, 0.593_624_260), (10.0, 0.099_981_625)] {
            assert!((without_adhesion(damping) - e).abs() < 1e-9, "{damping}");
            let unit = Impact { strength: 0.0, zeta_a: 0.0, ..Impact::PAPER };
            let zeta_h = damping / (unit.damping_unit() * unit.speed);
            let square = restitution_squared(&Impact { zeta_h, ..unit }, 300.0).unwrap();
            assert!((square.sqrt() - e).abs() < 2e-9, "{damping}: {}", square.sqrt());
        }
    }
}
