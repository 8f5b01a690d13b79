//! The bound of the error of e^2 holds for every method, over random scenes close to the critical speed and far from it.

use std::sync::LazyLock;

use microimpact::contact::{Collocation, FixedCost, Method, RungeKuttaGill};
use microimpact::{Outcome, Real};
use reference::grids::{Impact, impacts_of_random_groups};
use reference::repetitions;

/// An impact with its outcome and e^2.
type Solved = (Impact, Outcome, f64);

static SCENES: LazyLock<Vec<Solved>> = LazyLock::new(|| {
    let exact = Collocation::<14, f64>::new(1e-13).unwrap();
    let solution = |impact: Impact| {
        let solution = impact.scene().unwrap().solve_normal(&impact.motion().unwrap(), &exact).unwrap();
        let outcome = solution.outcome().filter(|outcome| *outcome != Outcome::Undecided)?;
        Some((impact, outcome, solution.overall_restitution().powi(2)))
    };
    impacts_of_random_groups(1).filter_map(solution).take(repetitions(20_000, 1_000)).collect()
});

/// Largest error of e^2 over its bound. All outcomes have to be right, and many of them known.
fn error_over_bound<T: Real>(name: &str, scenes: &[Solved], method: &impl Method<T>) -> f64 {
    const MANY: f64 = 0.25;
    let (mut largest, mut known) = (0.0_f64, 0);
    for (impact, outcome, exact) in scenes {
        let found = impact.scene::<T>().unwrap().solve(&impact.motion().unwrap(), method).unwrap();
        let (bound, e) = (found.run.error_bound.to_f64(), found.normal.overall_restitution().to_f64());
        match found.normal.outcome() {
            Some(Outcome::Undecided) => assert!(*exact <= 2.0 * bound, "{name}: {impact:?}"),
            Some(found) => {
                assert_eq!(found, *outcome, "{name}: {impact:?}");
                known += 1;
                largest = largest.max((e * e - exact).abs() / bound);
            }
            None => {}
        }
    }
    assert!(f64::from(known) > MANY * scenes.len() as f64, "{name}: {known} of {}", scenes.len());
    largest
}

#[test]
fn of_fixed_cost() {
    macro_rules! check {
        ($($number:ty: $($nodes:literal x $iterations:literal),+;)+) => { $($({
            let name = stringify!($nodes x $iterations $number);
            let method = FixedCost::<$nodes>::new($iterations).unwrap();
            let largest = error_over_bound::<$number>(name, &SCENES, &method);
            assert!(largest < 1.0, "{name}: {largest}");
        })+)+ };
    }
    check! {
        f64: 4 x 3, 5 x 3, 5 x 8, 6 x 2, 7 x 3, 7 x 12, 9 x 20, 12 x 12;
        f32: 5 x 3, 7 x 3, 7 x 12;
    }
}

#[test]
fn few_nodes_keep_the_tolerances_they_accept() {
    macro_rules! check {
        ($($nodes:literal: $tolerance:literal, $smaller:literal;)+) => { $({
            let method = Collocation::<$nodes, f64>::new($tolerance).unwrap();
            let largest = error_over_bound(stringify!($nodes), &SCENES, &method);
            assert!(largest < 1.0, "{} nodes: {largest}", $nodes);
            assert!(Collocation::<$nodes, f64>::new($smaller).is_err());
        })+ };
    }
    check! {
        4: 1e-3, 9e-4;
        5: 3e-4, 2.9e-4;
        6: 1e-5, 9e-6;
        7: 1e-7, 9e-8;
        8: 1e-9, 9e-10;
    }
}

#[test]
fn of_runge_kutta_gill() {
    const FEW: usize = 300;
    for steps in [16, 50, 400, 2000] {
        let name = format!("{steps} steps");
        let largest = error_over_bound::<f64>(&name, &SCENES[..FEW], &RungeKuttaGill::new(steps));
        assert!(largest < 1.0, "{name}: {largest}");
        let largest = error_over_bound::<f32>(&name, &SCENES[..FEW], &RungeKuttaGill::new(steps));
        assert!(largest < 1.0, "{name}, f32: {largest}");
    }
}
