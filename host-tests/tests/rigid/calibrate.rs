//! From measurements back to parameters: the paper's values, there and back again, reasons, outliers and coverage.

use microimpact::contact::{Collocation, Contact, FixedCost, HertzLaw, RingScene};
use microimpact::measure::{
    CalibrationError, Estimate, ImpulseRatios, Location, MeasuredRebound, adhesion_damping, estimate, friction,
    material_damping, parameter, ring_strength, rolling_motion,
};
use microimpact::rigid::{Departure, infer_assuming_rolling};
use microimpact::{
    Dual, Fault, InputError, NormalMotion, Oblique, Parameter, Real, RestitutionLaw, SpeedRestitution, Sphere,
    Stiffness,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal};

fn bare<T: Real>(radius: f64) -> Contact<T, HertzLaw<T>> {
    let sphere = Sphere::solid(T::constant(radius), T::constant(2600.0)).unwrap();
    Contact::hertz(sphere, Stiffness::new(T::constant(7.5e10)).unwrap())
}

fn scene(radius: f64, f0: f64, zeta_h: f64, zeta_a: f64) -> RingScene<f64> {
    bare(radius).with_damping(zeta_h).unwrap().with_ring(f0, zeta_a).unwrap()
}

fn method() -> Collocation<9, f64> {
    Collocation::new(1e-9).unwrap()
}

fn restitution(scene: &RingScene<f64>, speed: f64) -> f64 {
    scene.solve_normal(&NormalMotion::new(speed).unwrap(), &method()).unwrap().overall_restitution()
}

/// The parameters of the paper's scenes follow from its restitutions, of two digits at 4.3 um and three in Table 1.
#[test]
fn parameters_of_the_paper() {
    let law = SpeedRestitution::new(130.0).unwrap();
    // High speeds, where adhesion hardly counts, give R.
    let fast = MeasuredRebound { speed: 13.0, restitution: law.restitution(13.0) };
    assert!((material_damping(&bare(4.3e-6), &method(), &fast, 1e-9).unwrap() - 10.45).abs() < 0.05);
    for (radius, restitution) in [(4.3e-6, 0.62), (5.06e-6, 0.746)] {
        let rebound = MeasuredRebound { speed: 2.8, restitution };
        let ringed = bare(radius).with_ring(250.0, 6.25).unwrap();
        assert!((material_damping(&ringed, &method(), &rebound, 1e-9).unwrap() - 10.5).abs() < 0.05);
        let damped = bare(radius).with_damping(10.5).unwrap();
        assert!((adhesion_damping(&damped, 250.0, &method(), &rebound, 1e-9).unwrap() - 6.25).abs() < 0.05);
        let at = |radius| Ok(scene(radius, 250.0, 10.5, 6.25));
        let found = parameter((2e-6, 2e-5), at, &method(), &rebound, 1e-9).unwrap();
        assert!((found / radius - 1.0).abs() < 1e-3, "{found:e}");
        let at = |f0| Ok(scene(radius, f0, 10.5, 6.25));
        assert!((parameter((0.0, 1e3), at, &method(), &rebound, 1e-9).unwrap() - 250.0).abs() < 0.25);
    }
    // Contact radii of 5 % and 10 % of the radius.
    let (sphere, stiffness) = (*bare(4.3e-6).sphere(), Stiffness::new(7.5e10).unwrap());
    let strength = |share: f64| ring_strength(&sphere, stiffness, share * 4.3e-6).unwrap();
    assert!((strength(0.05) - 128.3).abs() < 0.05 && (strength(0.1) - 513.3).abs() < 0.05);
}

/// Table 1: the spin of a sphere that leaves with V_t = 0.21 m/s; figure 4: r w from mu_0 = 0.12.
#[test]
fn spins_of_the_paper() {
    let sphere = Sphere::solid(5.06e-6, 2600.0).unwrap();
    let before = NormalMotion::new(2.8).unwrap().with_tangential(0.0).unwrap();
    let motion = rolling_motion(&sphere, &before, 0.746, 0.043).unwrap();
    assert!((motion.peripheral() / sphere.radius() - 1.46e5).abs() < 0.01e5);
    let sphere = Sphere::solid(25e-6, 7800.0).unwrap();
    let before = NormalMotion::new(2.3).unwrap().with_tangential(0.0).unwrap();
    let motion = rolling_motion(&sphere, &before, 0.601, 0.12).unwrap();
    assert!((motion.peripheral() - 1.54).abs() < 0.01);
    // V_t of the same impacts, about 0.44 m/s.
    let after = Departure { normal: 0.601 * 2.3, tangential: 0.44 };
    let impact = infer_assuming_rolling(&sphere, &SpeedRestitution::new(130.0).unwrap(), &before, &after).unwrap();
    assert!((impact.tangential.impulse_ratio() - 0.12).abs() < 0.001);
}

/// Every parameter of random scenes comes back from the restitution it gives.
#[test]
fn there_and_back_again() {
    let mut random = StdRng::seed_from_u64(1);
    let mut tried = 0;
    for _ in 0..300 {
        let mut decade = |low: f64, high: f64| 10f64.powf(random.random_range(low..high));
        let (radius, f0, zeta_h, zeta_a) = (decade(-6.0, -4.0), decade(0.0, 3.0), decade(-1.0, 2.0), decade(-1.0, 1.5));
        let speed = decade(-1.0, 1.5);
        let whole = scene(radius, f0, zeta_h, zeta_a);
        let rebound = MeasuredRebound { speed, restitution: restitution(&whole, speed) };
        if rebound.restitution < 0.05 {
            continue;
        }
        tried += 1;
        let ringed = bare(radius).with_ring(f0, zeta_a).unwrap();
        let damped = bare(radius).with_damping(zeta_h).unwrap();
        let found = [
            material_damping(&ringed, &method(), &rebound, 1e-9).unwrap(),
            adhesion_damping(&damped, f0, &method(), &rebound, 1e-9).unwrap(),
        ];
        // Where a loss hardly counts, its strength is as uncertain as the error of the method makes it.
        for (index, found) in found.into_iter().enumerate() {
            let again = if index == 0 { scene(radius, f0, found, zeta_a) } else { scene(radius, f0, zeta_h, found) };
            assert!((restitution(&again, speed) - rebound.restitution).abs() < 1e-8, "{index}: {found}");
        }
    }
    assert!(tried > 100, "{tried}");
}

#[test]
fn single_precision_and_fixed_cost() {
    let method = FixedCost::<7>::new(4).unwrap();
    let rebound = MeasuredRebound { speed: 2.8_f32, restitution: 0.746 };
    let damped = bare::<f32>(5.06e-6).with_damping(10.5).unwrap();
    assert!((adhesion_damping(&damped, 250.0, &method, &rebound, 1e-6).unwrap() - 6.25).abs() < 0.05);
    let ringed = bare::<f32>(5.06e-6).with_ring(250.0, 6.25).unwrap();
    assert!((material_damping(&ringed, &method, &rebound, 1e-6).unwrap() - 10.5).abs() < 0.05);
}

#[test]
fn what_has_no_answer_says_why() {
    let sphere = bare::<f64>(4.3e-6);
    let damping =
        |speed, restitution| material_damping(&sphere, &method(), &MeasuredRebound { speed, restitution }, 1e-9);
    assert_eq!(damping(2.8, 0.0), Err(CalibrationError::Captured));
    assert_eq!(damping(2.8, 1.0), Ok(0.0));
    let input =
        |parameter, fault, value| Err::<f64, _>(CalibrationError::Input(InputError { parameter, fault, value }));
    assert_eq!(damping(2.8, 1.01), input(Parameter::Restitution, Fault::TooLarge, 1.01));
    assert_eq!(damping(2.8, f64::NAN), input(Parameter::Restitution, Fault::NotFinite, f32::NAN));
    assert_eq!(damping(-2.8, 0.5), input(Parameter::ApproachSpeed, Fault::TooSmall, -2.8));
    let ringed = sphere.with_ring(250.0, 6.25).unwrap();
    let too_fast = material_damping(&ringed, &method(), &MeasuredRebound { speed: 2.8, restitution: 0.99 }, 1e-9);
    assert_eq!(too_fast, Err(CalibrationError::ReboundTooFast));
    let at = |radius| Ok(scene(radius, 250.0, 10.5, 6.25));
    let radius =
        |restitution| parameter((4e-6, 6e-6), at, &method(), &MeasuredRebound { speed: 2.8, restitution }, 1e-9);
    assert_eq!(radius(0.1), Err(CalibrationError::ReboundTooSlow));
    assert_eq!(radius(0.95), Err(CalibrationError::ReboundTooFast));
    // Both ends of a bracket belong to it.
    for bracket in [(4e-6, 6e-6), (6e-6, 4e-6), (6e-6, 8e-6), (8e-6, 6e-6)] {
        let rebound = MeasuredRebound { speed: 2.8, restitution: restitution(&scene(6e-6, 250.0, 10.5, 6.25), 2.8) };
        assert!((parameter(bracket, at, &method(), &rebound, 1e-9).unwrap() / 6e-6 - 1.0).abs() < 1e-8);
    }
    assert_eq!(
        parameter((4e-6, 6e-6), at, &method(), &MeasuredRebound { speed: 2.8, restitution: 0.5 }, 0.0),
        input(Parameter::Tolerance, Fault::TooSmall, 0.0)
    );
    for error in [
        CalibrationError::ReboundTooFast,
        CalibrationError::ReboundTooSlow,
        CalibrationError::Captured,
        CalibrationError::NotConverged,
        CalibrationError::TooFew,
        CalibrationError::Undetermined,
        CalibrationError::NoMaterialLoss,
    ] {
        assert!(!error.to_string().is_empty());
    }
}

fn covers(estimate: Estimate<f64>, truth: f64) -> bool {
    (estimate.value - truth).abs() <= 1.96 * estimate.standard_error
}

#[test]
fn intervals_of_friction_and_spin() {
    const SETS: usize = 400;
    let mut random = StdRng::seed_from_u64(11);
    let error = Normal::new(0.0, 0.01).unwrap();
    let (mut friction_held, mut spin_held, mut scales) = (0, 0, 0.0);
    for _ in 0..SETS {
        let impacts: Vec<_> = (0..80)
            .map(|_| {
                let rolling: f64 = random.random_range(0.0..1.5);
                let wild = random.random_bool(0.05);
                let size = if wild { random.random_range(0.0..rolling) } else { rolling.min(0.2) };
                ImpulseRatios { measured: -(size + error.sample(&mut random)), rolling: -rolling }
            })
            .collect();
        let plateau = friction(&impacts).unwrap();
        scales += plateau.scale / SETS as f64;
        friction_held += usize::from(covers(plateau.estimate, 0.2));
        let spins: Vec<_> = (0..40).map(|_| 1.46e5 * (1.0 + error.sample(&mut random))).collect();
        let spin = Location::of(Parameter::Spin, spins.iter().copied()).unwrap();
        spin_held += usize::from(covers(spin.estimate, 1.46e5));
    }
    assert!((scales - 0.01).abs() < 0.001, "{scales}");
    for held in [friction_held, spin_held] {
        let share = held as f64 / SETS as f64;
        assert!((0.90..0.99).contains(&share), "{share}");
    }
}

#[test]
fn friction_needs_impacts_that_slide() {
    let rolling = [0.05, 0.1, 0.15, 0.2].map(|ratio| ImpulseRatios { measured: ratio, rolling: ratio });
    assert_eq!(friction(&rolling), Err(CalibrationError::TooFew));
    let wild = [ImpulseRatios { measured: f64::INFINITY, rolling: 1.0 }];
    let error = InputError { parameter: Parameter::ImpulseRatio, fault: Fault::NotFinite, value: f32::INFINITY };
    assert_eq!(friction(&wild), Err(CalibrationError::Input(error)));
}

/// A number over many decades.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|decade| 10f64.powf(decade))
}

fn is_sound<T: Real>(estimate: Estimate<T>) -> bool {
    estimate.value.is_finite() && estimate.standard_error.is_finite() && estimate.standard_error >= T::ZERO
}

/// Whatever was measured, there are numbers or a reason.
fn assert_sound<T: Real>(data: &[(f64, f64)]) -> Result<(), TestCaseError> {
    let c = T::constant;
    let impacts: Vec<_> =
        data.iter().map(|&(speed, e)| ImpulseRatios { measured: c(e), rolling: c(speed.min(1e3)) }).collect();
    if let Ok(plateau) = friction(&impacts) {
        prop_assert!(is_sound(plateau.estimate) && plateau.scale.is_finite(), "{plateau:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: reference::repetitions(2_000, 200), failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn any_cloud_gives_numbers_or_a_reason(
        wild in prop::collection::vec((decades(-12.0, 6.0), 0.0..=1.0), 0..30),
        tame in prop::collection::vec((decades(-1.0, 2.0), 0.0..=1.0), 0..30),
    ) {
        for data in [&wild, &tame] {
            assert_sound::<f32>(data)?;
            assert_sound::<f64>(data)?;
        }
    }

    #[test]
    fn any_rebound_gives_a_number_or_a_reason(
        radius in decades(-9.0, -2.0),
        f0 in decades(-6.0, 6.0),
        zeta in decades(-3.0, 6.0),
        speed in decades(-6.0, 3.0),
        restitution in 0.0..=1.0,
    ) {
        let rebound = MeasuredRebound { speed, restitution };
        let ringed = bare(radius).with_ring(f0, zeta).unwrap();
        let damped = bare(radius).with_damping(zeta).unwrap();
        let at = |f0| bare(radius).with_damping(zeta)?.with_ring(f0, 1.0);
        for found in [
            material_damping(&ringed, &method(), &rebound, 1e-9),
            adhesion_damping(&damped, f0, &method(), &rebound, 1e-9),
            parameter((0.0, f0), at, &method(), &rebound, 1e-9),
        ] {
            prop_assert_ne!(found, Err(CalibrationError::NotConverged));
            prop_assert!(found.is_err() || found.is_ok_and(|value| value.is_finite() && value >= 0.0), "{found:?}");
        }
    }
}

/// The restitution of the paper's scene with derivatives by one of its parameters, at first f0, zeta_H, zeta_A or the
/// radius, and by the speed.
fn sensitive(which: usize, value: f64, speed: f64) -> Dual<f64, 2> {
    let [parameter, speed] = Dual::variables([value, speed]);
    let fixed = Dual::<f64, 2>::fixed;
    let mut inputs = [250.0, 10.5, 6.25, 5.06e-6].map(fixed);
    inputs[which] = parameter;
    let [f0, zeta_h, zeta_a, radius] = inputs;
    let sphere = Sphere::solid(radius, fixed(2600.0)).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(fixed(7.5e10)).unwrap());
    let scene = scene.with_damping(zeta_h).unwrap().with_ring(f0, zeta_a).unwrap();
    let method = Collocation::<9, Dual<f64, 2>>::new(fixed(1e-9)).unwrap();
    scene.solve_normal(&NormalMotion::new(speed).unwrap(), &method).unwrap().overall_restitution()
}

/// Standard errors of what one impact tells are those of many repetitions of it.
#[test]
fn standard_errors_of_one_impact() {
    const DRAWS: u32 = 2000;
    let (damped, ringed) = (bare(5.06e-6).with_damping(10.5).unwrap(), bare(5.06e-6).with_ring(250.0, 6.25).unwrap());
    let found = |which: usize, rebound: &MeasuredRebound<f64>| match which {
        0 => parameter((0.0, 1e3), |f0| Ok(scene(5.06e-6, f0, 10.5, 6.25)), &method(), rebound, 1e-9),
        1 => material_damping(&ringed, &method(), rebound, 1e-9),
        2 => adhesion_damping(&damped, 250.0, &method(), rebound, 1e-9),
        _ => parameter((2e-6, 2e-5), |radius| Ok(scene(radius, 250.0, 10.5, 6.25)), &method(), rebound, 1e-9),
    };
    let mut random = StdRng::seed_from_u64(13);
    let errors = [0.004, 0.01];
    let [restitution_error, speed_error] = errors.map(|error| Normal::new(0.0, error).unwrap());
    for (which, truth) in [250.0, 10.5, 6.25, 5.06e-6].into_iter().enumerate() {
        let exact = restitution(&scene(5.06e-6, 250.0, 10.5, 6.25), 2.8);
        let stated = estimate(truth, sensitive(which, truth, 2.8), &errors).unwrap();
        let mut squares = 0.0;
        for _ in 0..DRAWS {
            let rebound = MeasuredRebound {
                speed: 2.8 + speed_error.sample(&mut random),
                restitution: exact + restitution_error.sample(&mut random),
            };
            squares += (found(which, &rebound).unwrap() - truth).powi(2) / f64::from(DRAWS);
        }
        let share = squares.sqrt() / stated.standard_error;
        assert!((share - 1.0).abs() < 0.08, "{which}: {share}");
    }
    let blind = estimate(1.0, Dual::fixed(0.7), &[0.01, 0.01]);
    assert_eq!(blind.map(|_: Estimate<f64>| ()), Err(CalibrationError::Undetermined));
    let wrong = estimate(6.25, sensitive(2, 6.25, 2.8), &[0.01, -0.01]);
    let error = InputError { parameter: Parameter::StandardError, fault: Fault::TooSmall, value: -0.01 };
    assert_eq!(wrong, Err(CalibrationError::Input(error)));
}
