//! What every method and number type promises, over random scenes of all physics, judged by an independent truth.

use std::fmt::Write;
use std::sync::LazyLock;

use reference::repetitions;
use reference::scenes::Kind;
use trials::{Count, Number, OutputErrors, SCENES, SEED, Solver, Statistics, Tally, merged, run, solvers, stored};

/// Scenes of each kind in a short run: the first of those that the stored statistics are from.
const FEW: u64 = 40;

/// All solvers with what they did over the scenes of each kind.
struct Trials {
    solvers: Vec<Solver>,
    tallies: Vec<(Kind, Vec<Tally>)>,
}

static TRIALS: LazyLock<Trials> = LazyLock::new(|| {
    let solvers = solvers();
    let scenes = repetitions(SCENES, FEW);
    let tallies = Kind::ALL.map(|kind| (kind, run(kind, SEED, scenes, &solvers)));
    Trials { solvers, tallies: tallies.into() }
});

/// Fails with the worst scenes of each solver of which `count` is not zero.
fn assert_none(of: impl Fn(&Solver) -> bool, count: impl Fn(&Tally) -> u64) {
    let mut faults = String::new();
    for (kind, tallies) in &TRIALS.tallies {
        for (solver, tally) in TRIALS.solvers.iter().zip(tallies) {
            let found = if of(solver) { count(tally) } else { 0 };
            if found > 0 {
                let (kind, name, number) = (kind.name(), solver.name, solver.number.name());
                let _ = writeln!(faults, "{kind}, {name} {number}: {found} of {}", tally.scenes);
                for example in tally.worst.iter().take(2) {
                    let _ = writeln!(faults, "    {}: {}", example.fault, example.scene);
                }
            }
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

/// The scenes are not all alike, and the truth knows nearly all of them.
#[test]
fn the_truth_knows_the_scenes() {
    for (kind, tallies) in &TRIALS.tallies {
        let known = tallies[0].scenes - tallies[0].unknown;
        assert!(known * 10 >= tallies[0].scenes * 8, "{}: {known} of {}", kind.name(), tallies[0].scenes);
    }
}

#[test]
fn no_outcome_that_is_said_to_be_solved_is_wrong() {
    assert_none(|_| true, |tally| tally.wrong_outcomes);
}

#[test]
fn no_class_is_wrong() {
    assert_none(|_| true, |tally| tally.wrong_classes);
}

#[test]
fn only_scenes_closer_than_twice_the_stated_error_are_undecided() {
    assert_none(|_| true, |tally| tally.needless);
}

/// In double precision.
#[test]
fn methods_that_control_their_error_solve_all_scenes() {
    assert_none(|solver| solver.follows_captures && solver.number == Number::Double, |tally| tally.unsolved);
}

/// To ten times the tolerance, or as far as inputs that are wrong by the tolerance account for more.
#[test]
fn outputs_of_methods_that_control_their_error_are_within_it() {
    let unexplained = |errors: &OutputErrors| errors.unexplained;
    assert_none(|solver| solver.follows_captures, |tally| tally.outputs.iter().map(unexplained).sum());
}

/// Fewer than one of a hundred outputs is beyond the tolerance if the scene is not close to a boundary, where the inputs account for
/// more: over all other kinds of scenes, and over each kind of which enough are compared for such a fraction.
#[test]
fn outputs_are_rarely_beyond_the_tolerance() {
    const RARELY: u64 = 100;
    const ENOUGH: u64 = 10 * RARELY;
    let close = [Kind::Critical, Kind::Barrier, Kind::SlipToSeparation];
    for (index, solver) in TRIALS.solvers.iter().enumerate().filter(|(_, solver)| solver.follows_captures) {
        let (mut beyond, mut compared) = (0, 0);
        for (kind, tallies) in TRIALS.tallies.iter().filter(|(kind, _)| !close.contains(kind)) {
            let sum = |count: fn(&OutputErrors) -> u64| tallies[index].outputs.iter().map(count).sum::<u64>();
            let (of_kind, all) = (sum(|errors| errors.beyond), sum(|errors| errors.compared));
            let (kind, name) = (kind.name(), solver.name);
            assert!(all > 0 && (all < ENOUGH || of_kind * RARELY <= all), "{kind}, {name}: {of_kind} of {all}");
            beyond += of_kind;
            compared += all;
        }
        assert!(compared >= ENOUGH && beyond * RARELY <= compared, "{}: {beyond} of {compared}", solver.name);
    }
}

/// A run of all scenes gives the same counts but for few that the last bits decide; a run of few scenes gives no more.
#[test]
fn stored_statistics_are_current() {
    const FRACTION: u64 = 50;
    const FEWEST: u64 = 2;
    let all = TRIALS.tallies.iter().map(|(_, tallies)| tallies.clone()).reduce(merged).unwrap();
    let stored = stored().unwrap();
    assert_eq!(stored.len(), TRIALS.solvers.len());
    for ((solver, tally), stored) in TRIALS.solvers.iter().zip(&all).zip(stored) {
        let found = Statistics::new(solver, tally);
        assert_eq!(found.names, stored.names);
        for count in Count::ALL {
            let (now, before) = (found.get(count), stored.get(count));
            let apart = if repetitions(true, false) { now.abs_diff(before) } else { now.saturating_sub(before) };
            let near = apart <= FEWEST + before / FRACTION;
            assert!(near, "{:?}, {}: {now}, stored {before}; run `cargo trials --store`", found.names, count.name());
        }
    }
}
