//! How often each method and number type has an answer, and how often it is right, over random scenes.

use reference::scenes::Kind;
use trials::{Count, SEED, Solver, Statistics, Tally, merged, solvers};

use crate::content::{Cell, Part, Run, Table};

pub(super) fn parts(run: &Run) -> Vec<Part> {
    let scenes = if run.quick { 40 } else { 500 };
    let solvers = solvers();
    let bar = run.progress(Kind::ALL.len(), "random scenes");
    let tallies = Kind::ALL.map(|kind| {
        let tallies = trials::run(kind, SEED, scenes, &solvers);
        bar.inc(1);
        tallies
    });
    vec![
        Part::Table(all_counts(&solvers, &tallies, scenes)),
        Part::Table(by_kind(
            &solvers,
            &tallies,
            "stability-unanswered",
            "Scenes that are refused, not solved or undecided, in percent",
            &[Count::Refused, Count::Unsolved, Count::Undecided],
        )),
        Part::Table(by_kind(
            &solvers,
            &tallies,
            "stability-beyond",
            "Outputs beyond the tolerance, in percent",
            &[Count::Beyond],
        )),
        Part::Text(scenes_and_methods()),
        Part::Text(COLUMNS.to_owned()),
    ]
}

/// What is tried.
fn scenes_and_methods() -> String {
    format!(
        "Every method and number type solves random scenes of {} kinds. An independent solver computes the true outcomes and \
         outputs. `Adaptive` and `Collocation` control their error to the tolerance: that of e^2, relative for other outputs. \
         The other methods do not control their error; the column states the tolerance that they are judged by. \
         `FixedCost 5 x 3` has five nodes and three iterations, `RungeKuttaGill 2000` has 2000 steps. Scenes that single \
         precision cannot represent are solved in f64 alone. Fixed point refuses external forces and numbers outside its \
         range; its only output is e^2.",
        Kind::ALL.len()
    )
}

/// What the columns count.
const COLUMNS: &str = "A scene is unknown if the independent solver does not find its outcome; it is counted in no other \
    column. Of the known scenes, a method refuses the inputs, does not solve the scene, leaves the outcome undecided, or \
    states an outcome. An undecided outcome is needless if the scene is farther from the boundary than twice the stated error. A \
    class is wrong if the outcome is right, but sliding is taken for rolling or the reverse. Outputs are compared where the \
    outcome is right. An output is beyond if its error exceeds the tolerance by more than the rounding of the inputs \
    explains, and beyond ten if it exceeds ten tolerances. It is unexplained if an error of the inputs as large as the \
    tolerance does not explain it either.";

/// All counts, over the scenes of all kinds together.
fn all_counts(solvers: &[Solver], tallies: &[Vec<Tally>], scenes: u64) -> Table {
    let all = tallies.iter().cloned().reduce(merged).unwrap_or_default();
    let row = |(solver, tally): (&Solver, &Tally)| {
        let Statistics { names, counts } = Statistics::new(solver, tally);
        names.map(Cell::Text).into_iter().chain(counts.map(Cell::Count)).collect()
    };
    Table {
        name: "stability-trials".to_owned(),
        caption: format!("Counts over {scenes} random scenes of each of {} kinds, seed {SEED}", tallies.len()),
        columns: Statistics::columns().into_iter().map(str::to_owned).collect(),
        rows: solvers.iter().zip(&all).map(row).collect(),
    }
}

/// The sum of some counts in percent, with a column for each kind.
fn by_kind(solvers: &[Solver], tallies: &[Vec<Tally>], name: &str, caption: &str, counts: &[Count]) -> Table {
    let [method, number, _] = Statistics::NAMES;
    let columns = [method, number].into_iter().chain(Kind::ALL.map(Kind::name));
    let row = |(index, solver): (usize, &Solver)| {
        let percent = |tallies: &Vec<Tally>| {
            let statistics = Statistics::new(solver, &tallies[index]);
            Cell::from(counts.iter().map(|count| statistics.percent(*count)).sum::<Option<f64>>())
        };
        let names = [solver.name, solver.number.name()].map(Cell::from);
        names.into_iter().chain(tallies.iter().map(percent)).collect()
    };
    Table {
        name: name.to_owned(),
        caption: caption.to_owned(),
        columns: columns.map(str::to_owned).collect(),
        rows: solvers.iter().enumerate().map(row).collect(),
    }
}

#[cfg(test)]
mod tests {
    use trials::Number;

    use super::*;

    const EACH: u64 = 2;

    #[test]
    fn tables_leave_nothing_out() {
        let solvers = solvers();
        let tallies = Kind::ALL.map(|kind| trials::run(kind, SEED, EACH, &solvers));
        let table = all_counts(&solvers, &tallies, EACH);
        assert_eq!(table.rows.len(), solvers.len());
        for (row, solver) in table.rows.iter().zip(&solvers) {
            assert_eq!(row.len(), table.columns.len());
            let count = |count: Count| match row[Statistics::NAMES.len() + count as usize] {
                Cell::Count(count) => count,
                _ => panic!("{} is no count", count.name()),
            };
            // Single precision does not hold all scenes.
            let (scenes, all) = (count(Count::Scenes), EACH * Kind::ALL.len() as u64);
            assert!(scenes == all || solver.number != Number::Double && (1..all).contains(&scenes), "{}", solver.name);
            let ends = [Count::Unknown, Count::Refused, Count::Unsolved, Count::Undecided, Count::WrongOutcomes];
            assert!(ends.map(count).iter().sum::<u64>() <= scenes, "{}", solver.name);
        }
        let unanswered = by_kind(&solvers, &tallies, "", "", &[Count::Refused, Count::Unsolved, Count::Undecided]);
        let of_kinds = unanswered.rows[0].iter().filter(|cell| matches!(cell, Cell::Number(Some(0.0..=100.0)))).count();
        assert_eq!((unanswered.rows.len(), of_kinds), (solvers.len(), Kind::ALL.len()));
    }
}
