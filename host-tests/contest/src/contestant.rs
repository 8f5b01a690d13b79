//! A method with one setting, and what it answers.

use std::hint::black_box;

use crate::race::{self, Sample};

/// What a method says of a contact, as far as it does.
#[derive(Clone, Copy)]
pub struct Answer {
    /// e.
    pub restitution: f64,
    /// s
    pub contact_time: Option<f64>,
    /// Of Hertz's force, N s.
    pub impulse: Option<f64>,
    /// What was counted, and how much of it.
    pub effort: Option<(usize, &'static str)>,
}

impl Answer {
    /// e alone.
    pub fn of_restitution(restitution: f64, effort: Option<(usize, &'static str)>) -> Self {
        Self { restitution, contact_time: None, impulse: None, effort }
    }

    /// Error of e, and relative errors of contact time and impulse.
    pub fn errors(&self, exact: &Self) -> [Option<f64>; 3] {
        let relative = |value: Option<f64>, exact: Option<f64>| Some((value? / exact? - 1.0).abs());
        [
            Some((self.restitution - exact.restitution).abs()),
            relative(self.contact_time, exact.contact_time),
            relative(self.impulse, exact.impulse),
        ]
    }
}

/// What a method is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// e alone.
    Restitution,
    /// e, contact time and Hertz impulse.
    Outputs,
}

/// Solves the impacts that it was made for, one after another.
pub trait Solver {
    /// Solves all of them, and tells each answer; `None` where it gives up.
    fn solve(&mut self, tell: &mut dyn FnMut(Option<Answer>));

    /// Time of doing so, repeated.
    fn time(&mut self, repeats: u32) -> Sample {
        race::time(&mut || self.solve(&mut |answer| _ = black_box(answer)), repeats)
    }
}

/// One impact.
impl<F: FnMut() -> Option<Answer>> Solver for F {
    fn solve(&mut self, tell: &mut dyn FnMut(Option<Answer>)) {
        tell(self());
    }
}

/// A method with one setting.
pub struct Contestant {
    /// Whose settings compete for one row: a method of this library, or a peer.
    pub entry: &'static str,
    /// Which of its algorithms.
    pub method: String,
    /// What sets the error.
    pub setting: String,
    /// What it does.
    pub solver: Box<dyn Solver>,
}

impl Contestant {
    /// A setting, run from the start each time.
    pub fn new(
        entry: &'static str,
        method: impl Into<String>,
        setting: impl Into<String>,
        run: impl FnMut() -> Option<Answer> + 'static,
    ) -> Self {
        Self::of(entry, method, setting, run)
    }

    /// The same for any number of impacts.
    pub fn of(
        entry: &'static str,
        method: impl Into<String>,
        setting: impl Into<String>,
        solver: impl Solver + 'static,
    ) -> Self {
        Self { entry, method: method.into(), setting: setting.into(), solver: Box::new(solver) }
    }

    /// The answer to the last of its impacts.
    pub fn answer(&mut self) -> Option<Answer> {
        let mut last = None;
        self.solver.solve(&mut |answer| last = answer);
        last
    }

    /// The answers to all of its impacts; `None` if it gives up one of them.
    pub fn answers(&mut self) -> Option<Vec<Answer>> {
        let mut answers = Some(Vec::new());
        self.solver.solve(&mut |answer| match (answer, &mut answers) {
            (Some(answer), Some(answers)) => answers.push(answer),
            _ => answers = None,
        });
        answers
    }
}

/// Tolerances from loose to tight.
pub fn tolerances() -> impl Iterator<Item = f64> {
    (4..=30).map(|half_decades| 10f64.powf(-0.5 * f64::from(half_decades)))
}
