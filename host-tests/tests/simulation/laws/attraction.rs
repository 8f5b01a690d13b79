//! A constant attraction during contact, in units that miss the turning point: a law of one's own need not know it.

use super::assert_refused;
use microimpact::contact::{Adaptive, Collocation, Contact, ContactLaw, ErrorControl, RungeKuttaGill, Units};
use microimpact::{CriticalSpeed, InputError, NormalMotion, Outcome, Sphere};

const STIFFNESS: f64 = 7.5e10;
const ZETA: f64 = 0.075;
const ATTRACTION: f64 = 2e-5;

fn sphere() -> Sphere<f64> {
    Sphere::solid(5e-6, 2600.0).unwrap()
}

/// F = k x^1.5 (1 + zeta dx/dt) - a, with a length that is `shrunk` times too small for the turning point without attraction.
#[derive(Clone, Copy, Debug)]
struct Attracted {
    shrunk: f64,
    zeta: f64,
    attraction: f64,
}

impl Attracted {
    fn new(shrunk: f64) -> Self {
        Self { shrunk, zeta: ZETA, attraction: ATTRACTION }
    }
}

impl ContactLaw<f64> for Attracted {
    fn in_units(&self, sphere: &Sphere<f64>, approach: f64) -> Result<(Self, Units<f64>), InputError> {
        let (m, k) = (sphere.mass(), STIFFNESS * sphere.radius().sqrt());
        let length = (1.25 * m * approach * approach / k).powf(0.4) / self.shrunk;
        let speed = (0.8 * k * length.powf(2.5) / m).sqrt();
        let attraction = self.attraction * length / (m * speed * speed);
        let energy = 0.5 * (approach / speed).powi(2);
        Ok((Self { zeta: self.zeta * speed, attraction, ..*self }, Units { length, speed, energy }))
    }

    fn loss_power(&self) -> u32 {
        4
    }

    fn potential(&self, s: f64) -> f64 {
        0.5 * s.powi(5) - self.attraction * s * s
    }

    fn slope(&self, s: f64) -> f64 {
        2.5 * s.powi(4) - 2.0 * self.attraction * s
    }

    fn curvature(&self, s: f64) -> f64 {
        10.0 * s.powi(3) - 2.0 * self.attraction
    }

    fn mean_slope(&self, p: f64, s: f64) -> f64 {
        let quintic = p.powi(4) + p.powi(3) * s + p * p * s * s + p * s.powi(3) + s.powi(4);
        0.5 * quintic - self.attraction * (p + s)
    }

    fn elastic_force(&self, s: f64) -> f64 {
        1.25 * s.powi(3)
    }

    fn adhesion_force(&self, _s: f64) -> f64 {
        self.attraction
    }

    fn material_damping(&self, s: f64) -> f64 {
        self.zeta * self.elastic_force(s)
    }

    fn speed_of_adhesion(&self, _sphere: &Sphere<f64>) -> f64 {
        0.1
    }
}

fn critical(scene: &Contact<f64, impl ContactLaw<f64>>, method: &impl ErrorControl<f64>) -> f64 {
    match scene.critical_speed(method).unwrap() {
        CriticalSpeed::At(speed) => speed,
        other => panic!("{other:?}"),
    }
}

/// Whether a sphere is captured, by the classical Runge-Kutta method in time, in SI units.
fn captured(approach: f64) -> bool {
    let (m, k) = (sphere().mass(), STIFFNESS * sphere().radius().sqrt());
    let rates = |[x, y]: [f64; 2]| [y, (ATTRACTION - k * x.max(0.0).powf(1.5) * (1.0 + ZETA * y)) / m];
    // A thousandth of the duration of an impact this slow without attraction, and eight of those durations.
    let step = 2.9432 * (1.25 * m / k).powf(0.4) / approach.powf(0.2) / 1e3;
    let add = |state: [f64; 2], rate: [f64; 2], by: f64| [state[0] + by * rate[0], state[1] + by * rate[1]];
    let mut state = [0.0, approach];
    for _ in 0..8000 {
        let first = rates(state);
        let second = rates(add(state, first, step / 2.0));
        let third = rates(add(state, second, step / 2.0));
        let fourth = rates(add(state, third, step));
        for (rate, weight) in [(first, 1.0), (second, 2.0), (third, 2.0), (fourth, 1.0)] {
            state = add(state, rate, weight * step / 6.0);
        }
        if state[0] <= 0.0 {
            return false;
        }
    }
    true
}

/// Whatever the units, outcomes and critical speed are those of the motion in time.
#[test]
fn units_do_not_matter() {
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    let expected = critical(&Contact::new(sphere(), Attracted::new(1.0)), &method);
    assert!(captured(expected * (1.0 - 1e-4)) && !captured(expected * (1.0 + 1e-4)), "{expected}");
    for shrunk in [0.3, 1.0, 2.0, 3.0, 6.0, 20.0] {
        let scene = Contact::new(sphere(), Attracted::new(shrunk));
        for found in [critical(&scene, &method), critical(&scene, &Adaptive::new(1e-9).unwrap())] {
            assert!((found / expected - 1.0).abs() < 1e-8, "{found} in units shrunk {shrunk} times");
        }
        for (fraction, outcome) in [(0.5, Outcome::Capture), (0.99, Outcome::Capture), (1.01, Outcome::Rebound)] {
            let before = NormalMotion::new(fraction * expected).unwrap();
            let impact = scene.solve(&before, &method).unwrap();
            assert_eq!(impact.normal.outcome(), Some(outcome), "{fraction} in units shrunk {shrunk} times");
        }
    }
}

/// The same law at x = s^4, without the coordinate of an indentation.
#[derive(Clone, Copy, Debug)]
struct WithoutInverse(Attracted);

impl ContactLaw<f64> for WithoutInverse {
    fn in_units(&self, sphere: &Sphere<f64>, approach: f64) -> Result<(Self, Units<f64>), InputError> {
        let (law, units) = self.0.in_units(sphere, approach)?;
        Ok((Self(law), units))
    }

    fn loss_power(&self) -> u32 {
        9
    }

    fn potential(&self, s: f64) -> f64 {
        self.0.potential(s * s)
    }

    fn slope(&self, s: f64) -> f64 {
        2.0 * s * self.0.slope(s * s)
    }

    fn curvature(&self, s: f64) -> f64 {
        2.0 * self.0.slope(s * s) + 4.0 * s * s * self.0.curvature(s * s)
    }

    fn mean_slope(&self, p: f64, s: f64) -> f64 {
        (p + s) * self.0.mean_slope(p * p, s * s)
    }

    fn elastic_force(&self, s: f64) -> f64 {
        self.0.elastic_force(s * s)
    }

    fn indentation(&self, s: f64) -> f64 {
        s.powi(4)
    }

    fn indentation_slope(&self, s: f64) -> f64 {
        4.0 * s.powi(3)
    }
}

#[test]
fn runge_kutta_gill_refuses_a_coordinate_that_is_no_inverse() {
    let scene = Contact::new(sphere(), WithoutInverse(Attracted::new(1.0)));
    assert_refused(&scene, 0.1, &RungeKuttaGill::new(1000));
}
