//! What the approximate functions of micromath do to both models: the reason why classes do not depend on them.

use microimpact::contact::{DimensionlessContact, FixedCost, PhaseSamples};
use microimpact::{CriticalSpeed, Outcome, Real, RigidBody, SpeedRestitution, Sphere};
use microimpact_scenes::approximate::Approximate;
use reference::{Case, cases};

/// The scene set up and solved in one number type.
fn solve<T: PhaseSamples<4, 9>>(case: &Case) -> DimensionlessContact<T> {
    let impact = case.scene::<T>().unwrap().dimensionless(&case.motion::<T>().unwrap()).unwrap();
    impact.solve(&FixedCost::<4>::new(2).unwrap())
}

/// Largest error of e over the mildly damped scenes, and how many outcomes are wrong.
fn errors<T: PhaseSamples<4, 9>>(to_f64: impl Fn(T) -> f64) -> (f64, u32) {
    let (mut largest, mut wrong) = (0.0_f64, 0);
    for case in cases().iter().filter(|case| ["paper", "figure6"].contains(&case.text("family"))) {
        let contact = solve::<T>(case);
        let rebounds = match contact.outcome {
            Some(Outcome::Rebound) => true,
            Some(Outcome::Capture) => false,
            Some(Outcome::Undecided) | None => continue,
        };
        let e = to_f64(contact.overall_restitution());
        largest = largest.max((e - case.number("restitution")).abs());
        wrong += u32::from(rebounds != (case.text("outcome") == "rebound"));
    }
    (largest, wrong)
}

#[test]
fn simulation() {
    let (own, wrong) = errors(|e: f32| f64::from(e));
    assert!(own < 1e-4 && wrong == 0, "{own:.1e}, {wrong} outcomes");
    let (approximate, _) = errors(|e: Approximate| f64::from(e.0));
    assert!(approximate > 100.0 * own, "{approximate:.1e}");
}

/// Largest relative error of a function, in its own units of rounding.
fn largest_error(own: impl Fn(f32) -> f32, exact: impl Fn(f64) -> f64) -> f64 {
    let errors = (0..100_000).map(|step| {
        let x = 1.001_f32.powi(step % 20_000 - 10_000) * (1.0 + step as f32 * 1e-9);
        f64::from(own(x)) / exact(f64::from(x)) - 1.0
    });
    errors.fold(0.0, |largest, error| largest.max(error.abs()))
}

/// The functions themselves, where the library's own are exact to some units in the last place.
#[test]
fn functions() {
    assert!(largest_error(Real::sqrt, f64::sqrt) < 1e-7);
    assert!(largest_error(|x| x.two_fifths_power(), |x| x.powf(0.4)) < 1e-6);
    assert!(largest_error(|x| Real::sqrt(Approximate(x)).0, f64::sqrt) > 0.05);
    assert!(largest_error(|x| Approximate(x).two_fifths_power().0, |x| x.powf(0.4)) > 1e-3);
}

/// A critical speed is the root of the work of adhesion.
#[test]
fn critical_speed_of_a_rigid_body() {
    let (mut largest_own, mut largest) = (0.0_f64, 0.0_f64);
    for step in 0..1000 {
        let work = 1e-13 * 1.005_f64.powi(step);
        let exact = critical_speed::<f64>(work);
        largest_own = largest_own.max((f64::from(critical_speed::<f32>(work)) / exact - 1.0).abs());
        largest = largest.max((f64::from(critical_speed::<Approximate>(work).0) / exact - 1.0).abs());
    }
    assert!(largest_own < 1e-6 && largest > 0.05, "{largest_own:.1e}, {largest:.1e}");
}

fn critical_speed<T: Real>(work: f64) -> T {
    let sphere = Sphere::solid(T::constant(5.06e-6), T::constant(2600.0)).unwrap();
    let law = SpeedRestitution::new(T::constant(130.0)).unwrap();
    match RigidBody::new(sphere, law).with_work_of_adhesion(T::constant(work)).unwrap().critical_speed() {
        CriticalSpeed::At(speed) => speed,
        other => panic!("{other:?}"),
    }
}
