//! Laws of restitution and of adhesion of the rigid body.

use microimpact::contact::{Adaptive, Contact};
use microimpact::rigid::{
    AdhesionCoefficient, AnyRestitution, ElasticPlasticRestitution, PowerRestitution, ReboundAdhesion, SpeedAdhesion,
    TabulatedRestitution, ViscoelasticRestitution, WorkOfAdhesion,
};
use microimpact::{
    ConstantRestitution, CriticalSpeed, Dual, NoAdhesion, NormalMotion, Outcome, Real, RestitutionLaw, RigidBody,
    SpeedRestitution, Sphere, Stiffness,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Largest difference of the algebraic law of a viscoelastic sphere from the simulation, as its documentation states it.
const VISCOELASTIC_ERROR: f64 = 3e-7;

/// A law with the sphere for which it holds.
fn sphere() -> Sphere<f64> {
    Sphere::solid(2e-6, 1050.0).unwrap()
}

fn stiffness() -> Stiffness<f64> {
    Stiffness::new(5e9).unwrap()
}

#[test]
fn elastic_plastic_restitution_is_thorntons() {
    let law = ElasticPlasticRestitution::new(0.3).unwrap();
    for (ratio, e) in [
        (1.0, 1.0),
        (1.5, 0.971239411072),
        (2.0, 0.930625877274),
        (3.0, 0.862739963121),
        (5.0, 0.773336898970),
        (10.0, 0.658558336665),
        (20.0, 0.557108666504),
        (50.0, 0.444606441002),
        (100.0, 0.374298961876),
    ] {
        assert!((law.restitution(0.3 * ratio) - e).abs() < 1e-12, "{ratio}");
    }
}

/// At any speed and damping, up to spheres that hardly rebound, and in single precision.
#[test]
fn viscoelastic_restitution_is_that_of_the_simulation() {
    let method = Adaptive::new(1e-11).unwrap();
    let largest = |time: f64, speed: f64| {
        let law = ViscoelasticRestitution::new(&sphere(), stiffness(), time).unwrap();
        let scene = Contact::hertz(sphere(), stiffness()).with_viscoelastic_damping(time).unwrap().without_tension();
        let e = scene.solve(&NormalMotion::new(speed).unwrap(), &method).unwrap().normal.overall_restitution();
        let single = Sphere::solid(2e-6_f32, 1050.0).unwrap();
        let single = ViscoelasticRestitution::new(&single, Stiffness::new(5e9).unwrap(), time as f32).unwrap();
        let of_single = f64::from(single.restitution(speed as f32)) - e;
        ((law.restitution(speed) - e).abs(), of_single.abs())
    };
    let mut found: f64 = 0.0;
    for i in 0..60 {
        for speed in [1e-3, 1.0, 1e3] {
            let (double, single) = largest(1e-13 * 10f64.powf(0.15 * f64::from(i)), speed);
            assert!(
                double < VISCOELASTIC_ERROR && single < VISCOELASTIC_ERROR + 2e-6,
                "{i} {speed}: {double:e} {single:e}"
            );
            found = found.max(double);
        }
    }
    // The bound is not far above what it bounds.
    assert!(found > 0.2 * VISCOELASTIC_ERROR, "{found:e}");
}

#[test]
fn power_one_is_the_law_of_the_paper() {
    let (power, speed) = (PowerRestitution::new(7.0, 1.0).unwrap(), SpeedRestitution::new(7.0).unwrap());
    for v in [1e-6, 0.3, 7.0, 1e3] {
        assert!((power.restitution(v) / speed.restitution(v) - 1.0).abs() < 1e-14);
    }
    assert!((power.approach_speed(6.9).unwrap() / speed.approach_speed(6.9).unwrap() - 1.0).abs() < 1e-12);
    assert_eq!(power.approach_speed(7.1), None);
}

/// Spheres that were captured, or a rebound speed that is the same at two speeds: the critical speed is the largest that captures.
#[test]
fn plateaus_of_a_table() {
    let held = TabulatedRestitution::new([(1.0, 0.0), (2.0, 0.0), (3.0, 0.5)]).unwrap();
    assert_eq!((held.restitution(0.0), held.restitution(f64::MAX)), (0.0, 0.5));
    let scene = RigidBody::new(sphere(), held);
    assert_eq!(scene.critical_speed(), CriticalSpeed::At(2.0));
    for (speed, outcome) in [(1.5, Outcome::Capture), (2.0, Outcome::Capture), (2.1, Outcome::Rebound)] {
        assert_eq!(scene.classify(&NormalMotion::new(speed).unwrap()).outcome, outcome, "{speed}");
    }
    let flat = TabulatedRestitution::new([(1.0, 0.8), (2.0, 0.4), (3.0, 0.9)]).unwrap();
    assert_eq!((flat.restitution(0.0), flat.approach_speed(0.8)), (0.8, Some(2.0)));
    let scene = RigidBody::new(sphere(), flat).with_work_of_adhesion(0.5 * sphere().mass() * 0.64).unwrap();
    let CriticalSpeed::At(critical) = scene.critical_speed() else { panic!() };
    assert!((critical - 2.0).abs() < 1e-12);
}

/// Does the same with every law.
macro_rules! for_laws {
    ($time:expr, |$law:ident| $check:expr) => {{
        let c = Real::constant;
        let sphere = Sphere::solid(c(2e-6), c(1050.0)).unwrap();
        let stiffness = Stiffness::new(c(5e9)).unwrap();
        {
            let $law = ConstantRestitution::new(c(0.7)).unwrap();
            $check
        }
        {
            let $law = SpeedRestitution::new(c(30.0)).unwrap();
            $check
        }
        {
            let $law = PowerRestitution::new(c(30.0), c(0.6)).unwrap();
            $check
        }
        {
            let $law = ElasticPlasticRestitution::new(c(0.2)).unwrap();
            $check
        }
        {
            let $law = ViscoelasticRestitution::new(&sphere, stiffness, c($time)).unwrap();
            $check
        }
        {
            let points = [(0.1, 0.95), (1.0, 0.9), (10.0, 0.5)].map(|(speed, r)| (c(speed), c(r)));
            let $law = TabulatedRestitution::new(points).unwrap();
            $check
        }
    }};
}

/// R is between zero and one, R v never falls, and the inverse finds the speed again.
fn check_inverse(law: impl RestitutionLaw<f64>, speed: f64) {
    let rebound = law.restitution(speed) * speed;
    assert!((0.0..=speed).contains(&rebound));
    assert!(law.restitution(1.001 * speed) * 1.001 * speed >= rebound * (1.0 - 1e-14));
    assert!(
        (law.approach_speed(rebound).unwrap() / speed - 1.0).abs() < 1e-11,
        "{speed}: {:?}",
        law.approach_speed(rebound)
    );
}

/// The derivative of the inverse is one over that of R v.
fn check_derivative(law: impl RestitutionLaw<Dual<f64, 1>>, speed: f64) {
    let [v] = Dual::variables([speed]);
    let rebound = law.restitution(v) * v;
    let found = law.approach_speed(rebound).unwrap();
    assert!((found.partials[0] - 1.0).abs() < 1e-6, "{speed}: {found:?}");
}

/// Just below the critical speed the sphere is held, just above it rebounds.
fn check_critical<L: RestitutionLaw<f64> + Copy>(law: L, adhesion: impl ReboundAdhesion<f64> + Copy, pull: f64) {
    let sphere = sphere();
    let speed = adhesion.holding_speed(&law, pull).unwrap();
    let departs = |v: f64| adhesion.departure(v, law.restitution(v) * v) - pull;
    assert!(speed == 0.0 || departs(speed * (1.0 - 1e-9)) <= 0.0, "{speed}");
    assert!(departs((speed * (1.0 + 1e-9)).max(1e-6)) > 0.0, "{speed}");
    let scene = RigidBody::new(sphere, law).with_adhesion_at_speed(0.5, 2.0).unwrap();
    let held = scene.with_external_impulses(0.0, -0.01 * sphere.mass()).unwrap();
    let CriticalSpeed::At(critical) = held.critical_speed() else { panic!("{:?}", held.critical_speed()) };
    let outcome = |v| held.classify(&NormalMotion::new(v).unwrap()).outcome;
    assert_eq!(outcome(critical * (1.0 - 1e-9)), Outcome::Capture);
    assert_eq!(outcome(critical * (1.0 + 1e-9)), Outcome::Rebound);
    assert_eq!(scene.critical_speed(), CriticalSpeed::AlwaysRebounds);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, rng_seed: RngSeed::Fixed(14), ..ProptestConfig::default() })]

    #[test]
    fn laws_are_monotonic_and_have_an_inverse(decade in -5.0..3.0_f64, damping in -12.0..-7.0_f64) {
        let (speed, time) = (10f64.powf(decade), 10f64.powf(damping));
        for_laws!(time, |law| check_inverse(law, speed));
        for_laws!(time, |law| check_derivative(law, speed));
    }

    #[test]
    fn critical_speeds_separate_capture_from_rebound(decade in -6.0..0.0_f64, l in -3.0..1.0_f64, q in 0.1..8.0_f64) {
        let pull = 10f64.powf(decade);
        let by_speed = SpeedAdhesion::new(10f64.powf(l), q).unwrap();
        let work = WorkOfAdhesion::new(0.5 * sphere().mass() * 0.04, &sphere()).unwrap();
        for_laws!(1e-9, |law| {
            check_critical(law, NoAdhesion, pull);
            check_critical(law, AdhesionCoefficient::new(0.3).unwrap(), pull);
            check_critical(law, work, pull);
            check_critical(law, by_speed, pull);
        });
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(5), ..ProptestConfig::default() })]

    /// A law that is chosen at run time is the typed one to the last bit.
    #[test]
    fn chosen_law_is_the_typed_one(speed in 1e-3_f64..1e2, time in 1e-11_f64..1e-7) {
        fn check<L: RestitutionLaw<f64> + Into<AnyRestitution<f64>>>(law: L, speed: f64) {
            let (r, v) = (law.restitution(speed), law.approach_speed(speed));
            let chosen = law.into();
            assert_eq!(chosen.restitution(speed).to_bits(), r.to_bits());
            assert_eq!(chosen.approach_speed(speed).map(f64::to_bits), v.map(f64::to_bits));
        }
        check(ConstantRestitution::new(0.7).unwrap(), speed);
        check(SpeedRestitution::new(30.0).unwrap(), speed);
        check(PowerRestitution::new(30.0, 0.6).unwrap(), speed);
        check(ElasticPlasticRestitution::new(0.2).unwrap(), speed);
        check(ViscoelasticRestitution::new(&sphere(), stiffness(), time).unwrap(), speed);
    }
}
