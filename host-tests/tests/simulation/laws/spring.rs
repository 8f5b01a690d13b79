//! A linear spring with a dashpot, of which everything is known in closed form.

use std::f64::consts::PI;

use super::assert_refused;
use microimpact::contact::{
    Adaptive, Collocation, Contact, ContactLaw, Energy, FixedCost, Impulses, Method, Recording, RestCriterion,
    RungeKuttaGill, Slip, Status, Times, Units, Works,
};
use microimpact::{CriticalSpeed, InputError, NormalMotion, Outcome, Real, Sphere, SurfaceMotion};

/// A spring (N/m) with a dashpot (N s/m), at the root s of the indentation: x = s^2.
#[derive(Clone, Copy, Debug)]
struct Spring<T> {
    stiffness: T,
    dashpot: T,
}

impl<T: Real> ContactLaw<T> for Spring<T> {
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError> {
        let frequency = (self.stiffness / sphere.mass()).sqrt();
        let dashpot = self.dashpot / sphere.mass() / frequency;
        let units = Units { length: approach / frequency, speed: approach, energy: T::constant(0.5) };
        Ok((Self { stiffness: T::ONE, dashpot }, units))
    }

    fn loss_power(&self) -> u32 {
        if self.dashpot > T::ZERO { 1 } else { u32::MAX }
    }

    fn potential(&self, s: T) -> T {
        T::constant(0.5) * self.stiffness * s * s * s * s
    }

    fn slope(&self, s: T) -> T {
        T::constant(2.0) * self.stiffness * s * s * s
    }

    fn curvature(&self, s: T) -> T {
        T::constant(6.0) * self.stiffness * s * s
    }

    fn mean_slope(&self, p: T, s: T) -> T {
        T::constant(0.5) * self.stiffness * (p + s) * (p * p + s * s)
    }

    fn elastic_force(&self, s: T) -> T {
        self.stiffness * s * s
    }

    fn material_damping(&self, _s: T) -> T {
        self.dashpot
    }

    fn may_have_barrier(&self) -> bool {
        false
    }

    fn energy_power(&self) -> f64 {
        4.0
    }

    fn duration(&self, _energy: T) -> T {
        T::constant(PI)
    }
}

const SPEED: f64 = 0.3;
const STIFFNESS: f64 = 1e3;
const FRICTION: f64 = 0.05;

fn sphere<T: Real>() -> Sphere<T> {
    Sphere::solid(T::constant(1e-3), T::constant(2600.0)).unwrap()
}

fn scene<T: Real>(damping_ratio: f64) -> Contact<T, Spring<T>> {
    let critical = 2.0 * (STIFFNESS * sphere::<f64>().mass()).sqrt();
    let dashpot = T::constant(damping_ratio * critical);
    Contact::new(sphere(), Spring { stiffness: T::constant(STIFFNESS), dashpot })
}

/// What a damping ratio gives: restitution, peak indentation, and the times of the peak and of separation, s.
fn exact(zeta: f64) -> (f64, f64, f64, f64) {
    let frequency = (STIFFNESS / sphere::<f64>().mass()).sqrt();
    let root = (1.0 - zeta * zeta).sqrt();
    let peak = SPEED / frequency * (-zeta * zeta.acos() / root).exp();
    ((-PI * zeta / root).exp(), peak, zeta.acos() / (frequency * root), PI / (frequency * root))
}

/// The whole result of a method against what is known.
fn check<T: Real>(zeta: f64, method: &impl Method<T>, allowed: f64) {
    let scene = scene::<T>(zeta);
    let (e, peak, peak_time, contact_time) = exact(zeta);
    let momentum = scene.sphere().mass().to_f64() * SPEED;
    let energy = 0.5 * momentum * SPEED;
    let close = |found: T, expected: f64, what: &str| {
        let error = found.to_f64() / expected - 1.0;
        assert!(error.abs() < allowed, "{what} at {zeta}: {error:e} of {allowed:e}");
    };

    let motion = NormalMotion::new(T::constant(SPEED)).unwrap();
    let outputs = ((Times, Impulses, Works), Energy, Recording::<64>);
    let (impact, ((times, impulses, works), ledger, trajectory)) = scene.solve_for(&motion, method, outputs).unwrap();
    assert_eq!((impact.run.status, impact.normal.outcome()), (Status::Solved, Some(Outcome::Rebound)));
    close(impact.normal.overall_restitution(), e, "e");
    close(impact.normal.rebound_speed(), e * SPEED, "rebound speed");
    close(impact.normal.peak_indentation().unwrap(), peak, "peak");
    close(times.peak.unwrap(), peak_time, "time of the peak");
    close(times.contact.unwrap(), contact_time, "contact time");
    // The dashpot gives back on the way out the impulse that it takes on the way in.
    close(impulses.elastic, momentum * (1.0 + e), "impulse");
    let ledger = ledger.unwrap();
    close(ledger.before, energy, "energy before");
    close(ledger.after, energy * e * e, "energy after");
    if zeta > 0.0 {
        close(works.material, energy * (1.0 - e * e), "work");
        close(ledger.lost(), energy * (1.0 - e * e), "energy lost");
    } else {
        assert_eq!((works.material, ledger.lost()), (T::ZERO, T::ZERO));
    }
    assert_eq!((impulses.adhesion_rebound, works.adhesion), (T::ZERO, T::ZERO));

    // Only the dashpot pushes at first touch.
    let (first, last) = (trajectory.samples().next().unwrap(), trajectory.samples().last().unwrap());
    let dashpot = scene.law().dashpot * T::constant(SPEED);
    assert!((first.force - dashpot).abs() <= T::constant(8.0) * T::EPSILON * dashpot, "{first:?}");
    assert_eq!((first.indentation, first.elastic), (T::ZERO, T::ZERO));
    close(-last.velocity, e * SPEED, "last velocity");
    close(trajectory.peak().unwrap().elastic, STIFFNESS * peak, "peak force");

    // Friction goes by the spring alone.
    let oblique = motion.with_tangential(T::ONE).unwrap();
    let scene = scene.with_friction(T::constant(FRICTION)).unwrap();
    let impact = scene.solve(&oblique, method).unwrap();
    assert_eq!(impact.tangential.motion(), SurfaceMotion::Sliding);
    close(impact.tangential.velocity(), 1.0 - FRICTION * (1.0 + e) * SPEED, "tangential velocity");
    close(impact.tangential.spin(), 2.5 * FRICTION * (1.0 + e) * SPEED / 1e-3, "spin");
}

const DAMPING_RATIOS: [f64; 6] = [0.0, 1e-3, 0.1, 0.3, 0.5, 0.9];

#[test]
fn closed_forms_are_met_by_methods_that_control_their_error() {
    for zeta in DAMPING_RATIOS {
        // What is left of a strong damping is small, and so is what the tolerance of e^2 is of it.
        let (e, ..) = exact(zeta);
        let scale = 3.0 / (e * e);
        check(zeta, &Adaptive::<f64>::new(1e-6).unwrap(), scale * 1e-6);
        check(zeta, &Adaptive::<f64>::new(1e-9).unwrap(), scale * 1e-9);
        check(zeta, &Adaptive::<f64>::new(1e-12).unwrap(), scale * 1e-12);
        check(zeta, &Collocation::<7, f64>::new(1e-6).unwrap(), scale * 1e-6);
        check(zeta, &Collocation::<9, f64>::new(1e-9).unwrap(), scale * 1e-9);
        check(zeta, &Collocation::<12, f64>::new(1e-12).unwrap(), scale * 1e-12);
        check(zeta, &Collocation::<8, f32>::new(1e-6).unwrap(), scale * 2e-6);
    }
}

#[test]
fn closed_forms_are_met_by_fixed_steps() {
    for zeta in DAMPING_RATIOS {
        let (e, ..) = exact(zeta);
        check::<f64>(zeta, &RungeKuttaGill::new(20_000), 1e-6 / (e * e));
    }
}

/// A dashpot takes energy with the first power of s, which whole phases cannot carry; without it they can.
#[test]
fn fixed_cost_carries_a_spring_but_no_dashpot() {
    assert_refused(&scene::<f64>(0.1), SPEED, &FixedCost::<7>::new(3).unwrap());
    assert_refused(&scene::<f32>(1e-3), SPEED as f32, &FixedCost::<5>::new(3).unwrap().with_outputs::<9>());
    check::<f64>(0.0, &FixedCost::<7>::new(3).unwrap().with_outputs::<16>(), 1e-12);
}

/// Nothing holds the sphere: it is neither captured nor followed to rest.
#[test]
fn a_spring_always_rebounds() {
    let (scene, motion) = (scene::<f64>(0.3), NormalMotion::new(SPEED).unwrap());
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    let criterion = RestCriterion::new(1e-6, 100).unwrap();
    assert_eq!(scene.critical_speed(&method).unwrap(), CriticalSpeed::AlwaysRebounds);
    assert_eq!(scene.classify(&motion, &method).unwrap().unwrap().outcome, Outcome::Rebound);
    let settled = scene.solve_to_rest(&motion, &method, &criterion, Times).unwrap();
    assert_eq!(settled.motion, None);
    assert!((settled.outputs.contact.unwrap() / exact(0.3).3 - 1.0).abs() < 1e-9);
}

/// Sliding ends where the spring has given enough impulse: the indentation so far is a closed form too.
#[test]
fn the_end_of_slip_is_found() {
    let scene = scene::<f64>(0.0).with_friction(FRICTION).unwrap();
    let tangential = 3.5 * FRICTION * SPEED;
    let motion = NormalMotion::new(SPEED).unwrap().with_tangential(tangential).unwrap();
    let frequency = (STIFFNESS / sphere::<f64>().mass()).sqrt();
    // The impulse is m v (1 - cos wt), and what is needed 2/7 of the slip over f: that at the peak.
    let (_, slip) = scene.solve_for(&motion, &Collocation::<9, f64>::new(1e-9).unwrap(), Slip).unwrap();
    assert!((slip.rolls_from.unwrap() * frequency / (0.5 * PI) - 1.0).abs() < 1e-7);
    assert!((slip.velocity / (5.0 / 7.0 * tangential) - 1.0).abs() < 1e-12);
}
