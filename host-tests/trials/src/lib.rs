//! How often each method and number type is right, undecided, refused or beyond its tolerance, over random scenes,
//! judged by an independent truth.

mod allowance;
mod judge;
mod output;
mod solver;
mod statistics;
mod stored;
mod tally;

pub use judge::{Finding, Judge, OutputError};
pub use output::Output;
pub use solver::{Answer, Number, Solver, solvers};
pub use statistics::{Count, Statistics};
pub use stored::{SCENES, SEED, guide_table, store, stored};
pub use tally::{Example, OutputErrors, Tally};

use rayon::prelude::*;
use reference::scenes::Kind;

/// The tallies of all solvers over the scenes of a kind with numbers from 0 to `scenes`, in the order of the solvers.
pub fn run(kind: Kind, seed: u64, scenes: u64, solvers: &[Solver]) -> Vec<Tally> {
    let none = || vec![Tally::default(); solvers.len()];
    (0..scenes)
        .into_par_iter()
        .fold(none, |mut tallies, number| {
            let judge = Judge::new(kind.scene(seed, number));
            for (tally, solver) in tallies.iter_mut().zip(solvers) {
                tally.add(&judge, solver);
            }
            tallies
        })
        .reduce(none, merged)
}

/// The tallies of the same solvers over the scenes of both.
pub fn merged(mut all: Vec<Tally>, some: Vec<Tally>) -> Vec<Tally> {
    for (tally, more) in all.iter_mut().zip(some) {
        tally.merge(more);
    }
    all
}
