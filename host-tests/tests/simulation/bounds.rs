//! Bounds of every value of the dimensionless motion, intermediate ones included, and what rounding each of them does.

use std::thread;

use crate::checking::{Checked, DOWN, EXACT, NEAREST, SINGLE, take_largest};
use microimpact::Outcome;
use microimpact::contact::{Collocation, DimensionlessImpact, FixedCost};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::{cases, repetitions};

/// Bound of fixed point.
const FIXED_POINT: f64 = 128.0;

/// Bound for collocation: the largest number of single precision is 3e38.
const SINGLE_PRECISION: f64 = 1e25;

/// Random groups, over all of their range.
fn groups(random: &mut StdRng) -> [f64; 3] {
    [random.random_range(0.0..0.999), random.random_range(0.0..0.5), random.random_range(0.0..0.5)]
}

fn impact<const ROUNDING: u8>([p, h, g]: [f64; 3]) -> DimensionlessImpact<Checked<ROUNDING>> {
    DimensionlessImpact::new(Checked(p), Checked(h), Checked(g)).unwrap()
}

/// A number of random scenes, each within its bound; how many are captured.
fn captures_of(scenes: u32, seed: u64) -> u32 {
    let (mut random, method) = (StdRng::seed_from_u64(seed), FixedCost::<4>::new(2).unwrap());
    let mut captures = 0;
    for _ in 0..scenes {
        let groups = groups(&mut random);
        let impact = impact::<EXACT>(groups);
        take_largest();
        let outcome = impact.solve(&method).outcome;
        let largest = take_largest();
        assert!(largest < FIXED_POINT, "{groups:?}: {largest}");
        captures += u32::from(outcome == Some(Outcome::Capture));
    }
    captures
}

#[test]
fn values_of_a_million_random_scenes() {
    let scenes = repetitions(250_000, 10_000);
    let captures: u32 = thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|seed| scope.spawn(move || captures_of(scenes, seed))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).sum()
    });
    assert!((scenes / 5..scenes * 19 / 5).contains(&captures), "{captures} captures");
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
            impact.solve(&FixedCost::<7>::new(4).unwrap());
            let largest = take_largest();
            assert!(largest < FIXED_POINT, "{}: {largest}", case.text("name"));
            checked += 1;
        }
    }
    assert!(checked > 70, "{checked}");
}

/// Collocation in single precision.
fn collocation() -> Collocation<7, Checked<SINGLE>> {
    Collocation::new(Checked(1e-6)).unwrap()
}

/// All of the reference, from no damping to overwhelming.
#[test]
fn values_of_the_reference_by_collocation() {
    for case in cases() {
        let scene = case.scene::<Checked<SINGLE>>().unwrap();
        let impact = scene.dimensionless(&case.motion::<Checked<SINGLE>>().unwrap()).unwrap();
        take_largest();
        impact.solve(&collocation());
        let largest = take_largest();
        assert!(largest < SINGLE_PRECISION, "{}: {largest:.1e}", case.text("name"));
    }
}

/// The largest value of a number of random scenes by collocation.
fn largest_by_collocation(scenes: u32, seed: u64) -> f64 {
    let mut random = StdRng::seed_from_u64(seed);
    take_largest();
    for _ in 0..scenes {
        impact::<SINGLE>(groups(&mut random)).solve(&collocation());
    }
    take_largest()
}

#[test]
fn values_of_random_scenes_by_collocation() {
    let scenes = repetitions(50_000, 5_000);
    let largest = thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|seed| scope.spawn(move || largest_by_collocation(scenes, seed))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).fold(0.0, f64::max)
    });
    assert!(largest < SINGLE_PRECISION, "{largest:.1e}");
}

/// With 24 bits, rounding down makes more than 1.4 times the error of rounding to the nearest number.
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
        let (rounded_down, rounded) = (impact::<DOWN>(groups).solve(&method), impact::<NEAREST>(groups).solve(&method));
        if [rounded_down.outcome, rounded.outcome] != [Some(Outcome::Rebound); 2] {
            continue;
        }
        count += 1;
        down += (rounded_down.overall_restitution().0 - e).powi(2);
        nearest += (rounded.overall_restitution().0 - e).powi(2);
    }
    let (down, nearest) = ((down / f64::from(count)).sqrt(), (nearest / f64::from(count)).sqrt());
    assert!(count > 1000 && nearest < 0.7 * down, "{nearest:.1e} against {down:.1e}");
}
