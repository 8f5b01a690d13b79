//! The fit of k and W_A to many impacts. How often its intervals hold the truth in many configurations is measured by `cargo coverage`.

use microimpact::contact::{Adaptive, Contact};
use microimpact::measure::{CalibrationError, Estimate, Interval, MeasuredImpact, NormalDistribution, RestitutionFit};
use microimpact::{
    CriticalSpeed, Fault, InputError, NormalMotion, Parameter, Real, RigidBody, SpeedRestitution, Sphere, Stiffness,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal};

/// k, m/s, and the work of adhesion of Table 1, J.
const K: f64 = 130.0;
const WORK: f64 = 2.22e-12;

fn glass(radius: f64) -> Sphere<f64> {
    Sphere::solid(radius, 2600.0).unwrap()
}

fn speed(value: f64, standard_error: f64) -> Estimate<f64> {
    Estimate { value, standard_error }
}

/// The exact rebound speed; zero for a capture.
fn exact(sphere: &Sphere<f64>, approach: f64) -> f64 {
    let scene = RigidBody::new(*sphere, SpeedRestitution::new(K).unwrap()).with_work_of_adhesion(WORK).unwrap();
    scene.impact(&NormalMotion::new(approach).unwrap()).normal.rebound_speed()
}

/// Impacts of spheres of different size, measured with an error, of which some are outliers.
struct Campaign {
    random: StdRng,
    error: f64,
    sizes: f64,
    outliers: f64,
}

impl Campaign {
    fn impacts(&mut self, count: usize, (slowest, fastest): (f64, f64)) -> Vec<MeasuredImpact<f64>> {
        let noise = Normal::new(0.0, self.error).unwrap();
        let one = |_| {
            let sphere = glass(5.06e-6 * (1.0 + self.sizes * self.random.random_range(-1.0..1.0)));
            let approach = self.random.random_range(slowest..fastest);
            let mut rebound = exact(&sphere, approach);
            if self.random.random_bool(self.outliers) {
                rebound = approach * self.random.random_range(0.0..0.8);
            }
            let mut measured = |value: f64| speed(value + noise.sample(&mut self.random), self.error);
            let approach = measured(approach);
            MeasuredImpact { sphere, approach, rebound: (rebound > 0.0).then(|| measured(rebound)) }
        };
        (0..count).map(one).collect()
    }
}

fn single(impact: &MeasuredImpact<f64>) -> MeasuredImpact<f32> {
    let estimate = |estimate: Estimate<f64>| Estimate {
        value: estimate.value as f32,
        standard_error: estimate.standard_error as f32,
    };
    let sphere = Sphere::solid(impact.sphere.radius() as f32, impact.sphere.density() as f32).unwrap();
    MeasuredImpact { sphere, approach: estimate(impact.approach), rebound: impact.rebound.map(estimate) }
}

#[test]
fn exact_impacts_give_exact_parameters() {
    let mut campaign = Campaign { random: StdRng::seed_from_u64(3), error: 0.0, sizes: 0.1, outliers: 0.0 };
    let impacts = campaign.impacts(30, (1.0, 40.0));
    let fit = RestitutionFit::of(&impacts).unwrap();
    assert!(fit.fits && (fit.restitution_speed.value / K - 1.0).abs() < 1e-6, "{fit:?}");
    assert!((fit.work_of_adhesion.value / WORK - 1.0).abs() < 1e-6, "{fit:?}");
    assert_eq!((fit.rebounds + fit.captures, fit.outliers), (30, 0));
    let fit = RestitutionFit::of(&impacts.iter().map(single).collect::<Vec<_>>()).unwrap();
    assert!((f64::from(fit.restitution_speed.value) / K - 1.0).abs() < 2e-3, "{fit:?}");
    assert!((f64::from(fit.work_of_adhesion.value) / WORK - 1.0).abs() < 2e-3, "{fit:?}");
}

/// The critical speed is that of the sphere of median mass.
#[test]
fn critical_speed_of_the_median_sphere() {
    let mut campaign = Campaign { random: StdRng::seed_from_u64(4), error: 0.0, sizes: 0.3, outliers: 0.0 };
    let impacts = campaign.impacts(41, (2.0, 20.0));
    let fit = RestitutionFit::of(&impacts).unwrap();
    let median = impacts.iter().find(|impact| impact.sphere.mass() == fit.mass).unwrap();
    let scene = RigidBody::new(median.sphere, SpeedRestitution::new(K).unwrap()).with_work_of_adhesion(WORK).unwrap();
    let CriticalSpeed::At(expected) = scene.critical_speed() else { panic!("adhesion captures the slowest") };
    assert!((fit.critical_speed.unwrap().value / expected - 1.0).abs() < 1e-5, "{fit:?}");
}

/// Intervals of 95 % hold the truth in about 95 % of all sets of data, with and without captures, and in nearly as many with a tenth of
/// outliers.
#[test]
fn intervals_hold_the_truth() {
    const SETS: usize = 400;
    for (range, outliers) in [((2.2, 30.0), 0.0), ((2.2, 30.0), 0.1), ((1.0, 6.0), 0.0)] {
        let mut campaign = Campaign { random: StdRng::seed_from_u64(7), error: 0.02, sizes: 0.05, outliers };
        let mut held = [0; 2];
        for _ in 0..SETS {
            let fit = RestitutionFit::of(&campaign.impacts(60, range)).unwrap();
            held[0] += usize::from(fit.restitution_speed.holds(K));
            held[1] += usize::from(fit.work_of_adhesion.holds(WORK));
        }
        for held in held {
            let share = held as f64 / SETS as f64;
            let least = if outliers > 0.0 { 0.88 } else { 0.92 };
            assert!((least..0.985).contains(&share), "{share} with {outliers} outliers in {range:?}");
        }
    }
}

/// A third of wild data does not move the fit far.
#[test]
fn many_outliers() {
    let mut campaign = Campaign { random: StdRng::seed_from_u64(5), error: 0.02, sizes: 0.0, outliers: 0.3 };
    for _ in 0..50 {
        let fit = RestitutionFit::of(&campaign.impacts(100, (2.0, 15.0))).unwrap();
        assert!((fit.restitution_speed.value / K - 1.0).abs() < 0.3, "{fit:?}");
        assert!((fit.work_of_adhesion.value / WORK - 1.0).abs() < 0.2, "{fit:?}");
        assert!(fit.outliers > 10);
    }
}

/// Captures bound the critical speed: with them the interval is narrower.
#[test]
fn captures_are_observations() {
    let mut campaign = Campaign { random: StdRng::seed_from_u64(6), error: 0.05, sizes: 0.0, outliers: 0.0 };
    let (mut with, mut without) = (0.0, 0.0);
    for _ in 0..20 {
        let mut impacts = campaign.impacts(60, (2.0, 12.0));
        let width = |interval: Interval<f64>| interval.high - interval.low;
        without += width(RestitutionFit::of(&impacts).unwrap().work_of_adhesion);
        impacts.extend(campaign.impacts(60, (1.5, 2.0)).into_iter().filter(|impact| impact.rebound.is_none()));
        with += width(RestitutionFit::of(&impacts).unwrap().work_of_adhesion);
    }
    assert!(with < 0.9 * without, "{with} {without}");
}

/// Impacts of other laws are said not to fit, and there is no critical speed.
#[test]
fn what_does_not_follow_the_law_is_said_not_to_fit() {
    let sphere = glass(5.06e-6);
    let simulated = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap());
    let simulated = simulated.with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
    let method = Adaptive::new(1e-6).unwrap();
    let laws: [&dyn Fn(f64) -> f64; 3] = [
        &|approach| 0.8 * approach,
        // A power law, as measured for ice.
        &|approach| approach * 0.8 * approach.powf(-0.234),
        &|approach| {
            let motion = NormalMotion::new(approach).unwrap();
            simulated.solve_normal(&motion, &method).unwrap().rebound_speed()
        },
    ];
    let (mut random, noise) = (StdRng::seed_from_u64(8), Normal::new(0.0, 0.02).unwrap());
    for (index, law) in laws.into_iter().enumerate() {
        let impacts: Vec<_> = (0..200)
            .map(|_| {
                let approach = random.random_range(1.0..30.0);
                let rebound = law(approach);
                let mut measured = |value: f64| speed(value + noise.sample(&mut random), 0.02);
                let approach = measured(approach);
                MeasuredImpact { sphere, approach, rebound: (rebound > 0.0).then(|| measured(rebound)) }
            })
            .collect();
        let fit = RestitutionFit::of(&impacts).unwrap();
        assert!(!fit.fits && fit.critical_speed.is_none(), "{index}: {fit:?}");
    }
}

#[test]
fn fits_that_have_no_answer_say_why() {
    let sphere = glass(5.06e-6);
    let fit = |impacts: &[(f64, f64)]| {
        let impact = |&(approach, rebound): &(f64, f64)| MeasuredImpact {
            sphere,
            approach: speed(approach, 0.01),
            rebound: (rebound != 0.0).then(|| speed(rebound, 0.01)),
        };
        RestitutionFit::of(&impacts.iter().map(impact).collect::<Vec<_>>()).map(|_| ())
    };
    assert_eq!(fit(&[]), Err(CalibrationError::TooFew));
    // Captures are no rebounds.
    assert_eq!(fit(&[(1.0, 0.0); 40]), Err(CalibrationError::TooFew));
    assert_eq!(fit(&[(2.0, 1.0); 20]), Err(CalibrationError::Undetermined));
    let mut wrong = [(2.0, 1.0); 20];
    for (value, parameter, fault) in [
        ((f64::NAN, 1.0), Parameter::ApproachSpeed, Fault::NotFinite),
        ((2.0, f64::INFINITY), Parameter::ReboundSpeed, Fault::NotFinite),
    ] {
        wrong[7] = value;
        let Err(CalibrationError::Input(error)) = fit(&wrong) else { panic!("{value:?} is refused") };
        assert_eq!((error.parameter, error.fault), (parameter, fault));
    }
    let negative = MeasuredImpact { sphere, approach: speed(2.0, -1.0), rebound: None };
    let error = InputError { parameter: Parameter::StandardError, fault: Fault::TooSmall, value: -1.0 };
    assert_eq!(RestitutionFit::of(&[negative]), Err(CalibrationError::Input(error)));
}

/// Whatever was measured, there are numbers or a reason.
fn assert_sound<T: Real + NormalDistribution>(data: &[(f64, f64, f64, f64)]) -> Result<(), TestCaseError> {
    let c = T::constant;
    let impact = |&(radius, approach, e, error): &(f64, f64, f64, f64)| MeasuredImpact {
        sphere: Sphere::solid(c(radius), c(2600.0)).unwrap(),
        approach: Estimate { value: c(approach), standard_error: c(error * approach) },
        rebound: (e > 0.1).then(|| Estimate { value: c((e - 0.2) * approach), standard_error: c(error * approach) }),
    };
    let impacts: Vec<_> = data.iter().map(impact).collect();
    if let Ok(fit) = RestitutionFit::of(&impacts) {
        let intervals = [Some(fit.restitution_speed), Some(fit.work_of_adhesion), fit.critical_speed];
        for interval in intervals.into_iter().flatten() {
            let ordered = interval.low <= interval.value && interval.value <= interval.high;
            prop_assert!(ordered && interval.low >= T::ZERO && interval.high.is_finite(), "{fit:?}");
        }
        prop_assert!(fit.scatter.is_finite() && fit.scatter >= T::ZERO, "{fit:?}");
    }
    Ok(())
}

fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|decade| 10f64.powf(decade))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: reference::repetitions(2_000, 100), failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn any_cloud_gives_numbers_or_a_reason(
        wild in prop::collection::vec((decades(-9.0, -2.0), decades(-12.0, 6.0), 0.0..=1.3, decades(-6.0, 2.0)), 0..30),
        tame in prop::collection::vec((decades(-5.3, -5.2), decades(-1.0, 2.0), 0.0..=1.3, decades(-6.0, 0.0)), 0..40),
    ) {
        for data in [&wild, &tame] {
            assert_sound::<f32>(data)?;
            assert_sound::<f64>(data)?;
        }
    }
}
