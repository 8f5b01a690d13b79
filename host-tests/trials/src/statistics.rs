//! What is counted of each solver, and its statistics over many scenes.

use crate::solver::Solver;
use crate::tally::{OutputErrors, Tally};

/// Something that is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Scenes that were put to the solver.
    Scenes,
    /// Scenes of which the truth does not know the outcome. They are counted nowhere else.
    Unknown,
    /// Refused inputs.
    Refused,
    /// Statuses other than *solved*.
    Unsolved,
    /// Undecided outcomes.
    Undecided,
    /// Those farther from the boundary than twice the stated error.
    Needless,
    /// Wrong outcomes with status *solved*.
    WrongOutcomes,
    /// Wrong classes with the right outcome.
    WrongClasses,
    /// Outputs that were compared with the truth.
    Outputs,
    /// Outputs beyond the tolerance and what the rounding of the inputs accounts for.
    Beyond,
    /// Those beyond ten times the tolerance.
    FarBeyond,
    /// Those beyond ten times the tolerance that inputs which are wrong by the tolerance do not account for either.
    Unexplained,
}

impl Count {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 12] = [
        Self::Scenes,
        Self::Unknown,
        Self::Refused,
        Self::Unsolved,
        Self::Undecided,
        Self::Needless,
        Self::WrongOutcomes,
        Self::WrongClasses,
        Self::Outputs,
        Self::Beyond,
        Self::FarBeyond,
        Self::Unexplained,
    ];

    /// In tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scenes => "scenes",
            Self::Unknown => "unknown",
            Self::Refused => "refused",
            Self::Unsolved => "not solved",
            Self::Undecided => "undecided",
            Self::Needless => "needless",
            Self::WrongOutcomes => "wrong outcomes",
            Self::WrongClasses => "wrong classes",
            Self::Outputs => "outputs",
            Self::Beyond => "beyond",
            Self::FarBeyond => "beyond ten",
            Self::Unexplained => "unexplained",
        }
    }

    /// The number in a tally.
    pub fn of(self, tally: &Tally) -> u64 {
        let sum = |of: fn(&OutputErrors) -> u64| tally.outputs.iter().map(of).sum();
        match self {
            Self::Scenes => tally.scenes,
            Self::Unknown => tally.unknown,
            Self::Refused => tally.refused,
            Self::Unsolved => tally.unsolved,
            Self::Undecided => tally.undecided,
            Self::Needless => tally.needless,
            Self::WrongOutcomes => tally.wrong_outcomes,
            Self::WrongClasses => tally.wrong_classes,
            Self::Outputs => sum(|errors| errors.compared),
            Self::Beyond => sum(|errors| errors.beyond),
            Self::FarBeyond => sum(|errors| errors.far_beyond),
            Self::Unexplained => sum(|errors| errors.unexplained),
        }
    }
}

/// The counts of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// Method, number type and tolerance, in the order of [`NAMES`](Self::NAMES).
    pub names: [String; 3],
    /// In the order of [`Count::ALL`].
    pub counts: [u64; Count::ALL.len()],
}

impl Statistics {
    /// The columns before the counts.
    pub const NAMES: [&str; 3] = ["method", "number type", "tolerance"];

    /// Those of a tally.
    pub fn new(solver: &Solver, tally: &Tally) -> Self {
        let names = [solver.name.to_owned(), solver.number.name().to_owned(), format!("{:.0e}", solver.tolerance)];
        Self { names, counts: Count::ALL.map(|count| count.of(tally)) }
    }

    /// All columns.
    pub fn columns() -> Vec<&'static str> {
        [&Self::NAMES[..], &Count::ALL.map(Count::name)].concat()
    }

    /// One of the counts.
    pub const fn get(&self, count: Count) -> u64 {
        self.counts[count as usize]
    }

    /// Scenes of which the truth knows the outcome.
    pub const fn known(&self) -> u64 {
        self.get(Count::Scenes) - self.get(Count::Unknown)
    }

    /// A count in percent: of the compared outputs where it counts outputs, else of the known scenes. `None` of none.
    pub fn percent(&self, count: Count) -> Option<f64> {
        let all = match count {
            Count::Outputs | Count::Beyond | Count::FarBeyond | Count::Unexplained => self.get(Count::Outputs),
            _ => self.known(),
        };
        (all > 0).then(|| 100.0 * self.get(count) as f64 / all as f64)
    }
}
