//! Fits of data that nobody measures: they end, and state numbers or nothing.

use fastrand::Rng;
use impact_fit::{Interval, Law, MeasuredSphere, Observation, Response, ScatterModel, Statement, Verdict, compete};

/// Rows of a set: more than a fit needs.
const ROWS: usize = 30;

/// Sets of each kind.
const SETS: u64 = 6;

/// The laws whose curve needs no simulation, which would take minutes without optimisation.
const QUICK: [Law; 4] = [Law::SpeedRestitution, Law::Constant, Law::ElasticPlastic, Law::Viscoelastic];

/// One of some numbers, or one between two powers of ten.
fn number(random: &mut Rng, some: &[f64], powers: (f64, f64)) -> f64 {
    let place = random.usize(0..=some.len());
    some.get(place).copied().unwrap_or_else(|| 10.0_f64.powf(powers.0 + (powers.1 - powers.0) * random.f64()))
}

/// A set of rows, each of whose numbers may be anything in wide ranges, or of those that a fit refuses.
fn any_set(random: &mut Rng, refused: bool) -> Vec<Observation> {
    let powers = (-12.0 * random.f64(), 6.0 * random.f64());
    let rebounds: &[f64] = if refused { &[f64::NAN, f64::INFINITY, -1e300, 0.0] } else { &[0.0, -1e6, 1e6, 1e-300] };
    let errors: &[f64] = if refused { &[f64::NAN, -1.0, f64::INFINITY] } else { &[0.0, 0.0, 1e-300, 1e6] };
    let with_mass = random.bool();
    let row = |_| {
        let speed = number(random, if refused { &[f64::NAN, 0.0, -1.0] } else { &[1.0] }, powers);
        let rebound =
            Response::Rebound { speed: number(random, rebounds, powers), error: number(random, errors, (-9.0, 6.0)) };
        Observation {
            speed,
            speed_error: number(random, errors, (-9.0, 6.0)),
            response: if random.u8(0..5) == 0 { Response::Capture } else { rebound },
            sphere: with_mass.then(|| MeasuredSphere {
                mass: number(random, &[1e-40, 1e10], (-20.0, 0.0)),
                relative_error: number(random, errors, (-3.0, 3.0)).min(1e3),
            }),
        }
    };
    (0..ROWS).map(row).collect()
}

/// Restitutions of the paper's law, times a factor: of 100 if they are in percent, of -1 if the speeds have the other sign.
fn times(factor: f64, random: &mut Rng) -> Vec<Observation> {
    let row = |step| {
        let speed = 1.5 * 1.09_f64.powi(step);
        let restitution = 130.0 / (130.0 + speed) + 0.02 * (random.f64() - 0.5);
        let response = Response::Rebound { speed: factor * restitution * speed, error: 0.0 };
        Observation { speed, speed_error: 0.0, response, sphere: None }
    };
    (0..ROWS as i32).map(row).collect()
}

fn check(observations: &[Observation], laws: &[Law]) {
    for scatter in [ScatterModel::Free, ScatterModel::Errors] {
        if let Verdict::Fits(statement) = compete(observations, laws, scatter) {
            check_statement(&statement, observations);
        }
    }
}

fn check_statement(Statement { fit, quantities, .. }: &Statement, observations: &[Observation]) {
    for quantity in quantities {
        let Interval { value, low, high } = quantity.interval;
        assert!(low <= value && value <= high, "{} {value}, {low} to {high}: {observations:?}", quantity.name);
    }
    assert!(!fit.judgement.p_value().is_nan() && fit.scatter().is_finite() && fit.outliers().is_finite());
    for (low, high) in fit.band(&[0.5 * fit.reference(), fit.reference()]) {
        assert!(low <= high, "{observations:?}");
    }
}

#[test]
fn percentages_and_negative_speeds() {
    let mut random = Rng::with_seed(1);
    for factor in [100.0, 10.0, 1e4, -1.0, 1e-6] {
        check(&times(factor, &mut random), &QUICK);
    }
}

#[test]
fn any_numbers() {
    for seed in 0..SETS {
        check(&any_set(&mut Rng::with_seed(seed), false), &QUICK);
    }
}

#[test]
fn numbers_that_are_refused() {
    for seed in 0..SETS {
        let set = any_set(&mut Rng::with_seed(seed), true);
        assert!(matches!(compete(&set, &Law::ALL, ScatterModel::Free), Verdict::NotEnough(_)), "{set:?}");
    }
}

#[test]
fn contact_laws() {
    let mut random = Rng::with_seed(2);
    check(&times(100.0, &mut random), &[Law::Jkr]);
    check(&any_set(&mut random, false), &[Law::Ring]);
}
