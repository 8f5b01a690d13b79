//! Bounds of every value of the dimensionless motion, intermediate ones included, and what rounding each of them does.

mod checking;

use checking::{Checked, DOWN, EXACT, NEAREST, take_largest};
use host_tests::cases;
use microimpact::Outcome;
use microimpact::simulation::{DimensionlessImpact, FixedCost};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// Bound of fixed point.
const FIXED_POINT: f64 = 128.0;
/// Bound for a sphere that has turned, whose speed is held from below: beyond that of fixed point, which holds it there.
const CAPTURED: f64 = 256.0;

/// Random groups, over all of their range.
fn groups(random: &mut StdRng) -> [f64; 3] {
    [random.random_range(0.0..0.999), random.random_range(0.0..0.5), random.random_range(0.0..0.5)]
}

fn impact<const ROUNDING: u8>([p, h, g]: [f64; 3]) -> DimensionlessImpact<Checked<ROUNDING>> {
    DimensionlessImpact::new(Checked(p), Checked(h), Checked(g)).unwrap()
}

fn bound(outcome: Option<Outcome>) -> f64 {
    if outcome == Some(Outcome::Capture) { CAPTURED } else { FIXED_POINT }
}

#[test]
fn values_of_a_million_random_scenes() {
    let (mut random, method) = (StdRng::seed_from_u64(4), FixedCost::<4>::new(2).unwrap());
    let mut captures = 0;
    for _ in 0..1_000_000 {
        let groups = groups(&mut random);
        let impact = impact::<EXACT>(groups);
        take_largest();
        let outcome = impact.solve(&method).outcome;
        let largest = take_largest();
        assert!(largest < bound(outcome), "{groups:?}: {largest}");
        captures += i32::from(outcome == Some(Outcome::Capture));
    }
    assert!((50_000..950_000).contains(&captures), "{captures} captures");
}

#[test]
fn values_of_the_reference() {
    let mut checked = 0;
    for case in cases() {
        let scene = case.scene::<Checked<EXACT>>().unwrap();
        let impact = scene.dimensionless(&case.motion::<Checked<EXACT>>().unwrap()).unwrap();
        let fits = case
            .scene::<f64>()
            .unwrap()
            .dimensionless(&case.motion::<f64>().unwrap())
            .is_ok_and(|impact| impact.in_fixed_point().is_ok());
        if fits {
            take_largest();
            let outcome = impact.solve(&FixedCost::<7>::new(4).unwrap()).outcome;
            let largest = take_largest();
            assert!(largest < bound(outcome), "{}: {largest}", case.text("name"));
            checked += 1;
        }
    }
    assert!(checked > 70, "{checked}");
}

/// With 24 bits, rounding down makes nearly twice the error of rounding to the nearest number.
#[test]
fn rounding_to_nearest_is_better() {
    let (mut random, method) = (StdRng::seed_from_u64(5), FixedCost::<4>::new(2).unwrap());
    let (mut down, mut nearest, mut count) = (0.0, 0.0, 0);
    for _ in 0..20_000 {
        let groups = groups(&mut random);
        let exact = impact::<EXACT>(groups).solve(&method);
        let e = exact.overall_restitution().0;
        if e < 0.2 || groups[0] > 0.95 {
            continue;
        }
        count += 1;
        down += (impact::<DOWN>(groups).solve(&method).overall_restitution().0 - e).powi(2);
        nearest += (impact::<NEAREST>(groups).solve(&method).overall_restitution().0 - e).powi(2);
    }
    let (down, nearest) = ((down / f64::from(count)).sqrt(), (nearest / f64::from(count)).sqrt());
    assert!(count > 1000 && nearest < 0.6 * down, "{nearest:.1e} against {down:.1e}");
}
