//! The simulation in fixed point: its error over the paper's and random scenes, its refusals, and its bounds.

use microimpact::contact::{DimensionlessImpact, FixedCost, Status};
use microimpact::{Fault, FixedPoint, InputError, NormalMotion, Outcome, Parameter, Real, Sphere};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::{Case, cases, repetitions};

fn in_fixed_point(case: &Case) -> Result<DimensionlessImpact<FixedPoint>, InputError> {
    case.scene::<f32>()?.dimensionless(&case.motion::<f32>()?)?.in_fixed_point()
}

#[test]
fn four_nodes_and_two_iterations() {
    let method = FixedCost::<4>::new(2).unwrap();
    let (mut largest, mut solved) = (0.0_f64, 0);
    for case in cases().iter().filter(|case| ["paper", "figure6", "random"].contains(&case.text("family"))) {
        let name = case.text("name");
        let impact = match in_fixed_point(case) {
            Ok(impact) => impact,
            // Damped too strongly for fixed point.
            Err(error) => {
                assert!(["r002", "r011", "r024"].contains(&name), "{name}: {error}");
                continue;
            }
        };
        let contact = impact.solve(&method);
        assert_eq!(contact.status, Status::Solved, "{name}");
        assert_eq!(contact.outcome == Some(Outcome::Rebound), case.text("outcome") == "rebound", "{name}");
        largest = largest.max((contact.overall_restitution().to_f64() - case.number("restitution")).abs());
        solved += 1;
    }
    assert_eq!(solved, 51);
    assert!(largest < 1e-4, "{largest:.1e}");
}

/// Random groups: what rounding adds to the error of the method, and no outcome that f64 contradicts.
#[test]
fn random_scenes_agree_with_double_precision() {
    let (mut random, method) = (StdRng::seed_from_u64(6), FixedCost::<4>::new(2).unwrap());
    let (mut largest, mut undecided) = (0.0_f64, 0);
    let scenes = repetitions(200_000, 20_000);
    for _ in 0..scenes {
        let p = random.random_range(0.0..0.999);
        let (h, g) = (random.random_range(0.0..0.5), random.random_range(0.0..0.5));
        let impact = DimensionlessImpact::new(p, h, g).unwrap();
        let (wide, narrow) = (impact.solve(&method), impact.in_fixed_point().unwrap().solve(&method));
        let e = wide.overall_restitution();
        match (wide.outcome, narrow.outcome) {
            (Some(wide), Some(narrow)) => assert!(wide == narrow || e < 0.02, "{p} {h} {g}"),
            (wide, narrow) => undecided += i32::from(wide != narrow),
        }
        if narrow.outcome.is_some() && e > 0.2 && p < 0.95 {
            largest = largest.max((narrow.overall_restitution().to_f64() - e).abs());
        }
    }
    assert!(largest < 1e-5, "{largest:.1e}");
    assert!(undecided < scenes / 10_000, "{undecided}");
}

#[test]
fn arithmetic_rounds_to_nearest_and_never_wraps() {
    let mut random = StdRng::seed_from_u64(7);
    let unit = FixedPoint::EPSILON.to_f64();
    let (smallest, largest) = (FixedPoint::nearest(-1e9).to_f64(), FixedPoint::nearest(1e9).to_f64());
    for _ in 0..repetitions(1_000_000, 100_000) {
        let mut draw = || {
            let size = 2f64.powi(random.random_range(-24..8));
            FixedPoint::nearest(size * random.random_range(-1.0..1.0))
        };
        let (a, b) = (draw(), draw());
        let (x, y) = (a.to_f64(), b.to_f64());
        let assert_nearest = |result: FixedPoint, exact: f64| {
            let error = (result.to_f64() - exact.clamp(smallest, largest)).abs();
            assert!(error <= 0.5001 * unit, "{x} {y}: {} for {exact}", result.to_f64());
        };
        assert_nearest(a + b, x + y);
        assert_nearest(a - b, x - y);
        assert_nearest(-a, -x);
        assert_nearest(a * b, x * y);
        if y != 0.0 {
            assert_nearest(a / b, x / y);
        }
        assert_nearest(a.abs().sqrt(), x.abs().sqrt());
        assert_nearest(a.abs().geometric_mean(b.abs()), (x.abs() * y.abs()).sqrt());
    }
    for bound in [smallest, largest] {
        let bound = FixedPoint::nearest(bound);
        assert_eq!((bound * bound).to_f64(), largest);
        assert!((bound / FixedPoint::ZERO).to_f64().abs() >= largest);
        assert_eq!((bound / FixedPoint::EPSILON).to_f64() > 0.0, bound > FixedPoint::ZERO);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let refused = |p, h, g| DimensionlessImpact::new(p, h, g).map(drop).unwrap_err();
    let error = refused(0.9999, 0.1, 0.1);
    assert_eq!((error.parameter, error.fault), (Parameter::DimensionlessAdhesion, Fault::TooLarge));
    assert_eq!(refused(0.5, 0.6, 0.1).parameter, Parameter::DimensionlessDamping);
    assert_eq!(refused(0.5, 0.1, 0.6).parameter, Parameter::DimensionlessDamping);
    for case in cases().iter().filter(|case| ["r002", "x001", "x002", "x008"].contains(&case.text("name"))) {
        assert_eq!(in_fixed_point(case).unwrap_err().fault, Fault::TooLarge, "{}", case.text("name"));
    }
    // SI units.
    let sphere = Sphere::solid(FixedPoint::nearest(5.06e-6), FixedPoint::nearest(100.0));
    assert_eq!(sphere.unwrap_err().parameter, Parameter::Radius);
    assert_eq!(NormalMotion::new(FixedPoint::ONE).unwrap_err().parameter, Parameter::ApproachSpeed);
}
