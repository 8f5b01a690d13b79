//! Counts over many scenes.

use truth::{Double, Scene};

use crate::judge::{FAR, Finding, Judge, OutputError};
use crate::output::{COUNT, Output};
use crate::solver::{Answer, Solver};

/// Counts of the errors of an output.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutputErrors {
    /// Scenes that were compared.
    pub compared: u64,
    /// Errors beyond the tolerance and what the inputs account for.
    pub beyond: u64,
    /// Those beyond ten times the tolerance.
    pub far_beyond: u64,
    /// Those beyond ten times the tolerance that inputs which are wrong by the tolerance do not account for either.
    pub unexplained: u64,
    /// The largest, over the tolerance.
    pub largest: f64,
}

/// A scene that went wrong.
#[derive(Clone, Debug)]
pub struct Example {
    /// The scene.
    pub scene: Scene,
    /// What went wrong.
    pub fault: String,
    /// How badly: unexplained errors over the tolerance; a wrong class or outcome is worse than any.
    pub weight: f64,
}

/// What a solver did with many scenes.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Scenes that were put to the solver.
    pub scenes: u64,
    /// Scenes of which the truth does not know the outcome.
    pub unknown: u64,
    /// Answers that say how many evaluations they took.
    pub counted: u64,
    /// The sum of those.
    pub evaluations: u64,
    /// Refused inputs.
    pub refused: u64,
    /// Statuses other than *solved*.
    pub unsolved: u64,
    /// Undecided outcomes.
    pub undecided: u64,
    /// Those farther from the boundary than twice the stated error.
    pub needless: u64,
    /// Largest true distance from the boundary between capture and rebound among those, over the initial energy.
    pub largest_undecided: f64,
    /// Wrong outcomes with status *solved*.
    pub wrong_outcomes: u64,
    /// Largest true distance from the boundary among those.
    pub largest_wrong: f64,
    /// Wrong classes with the right outcome.
    pub wrong_classes: u64,
    /// In the order of [`Output::ALL`].
    pub outputs: [OutputErrors; COUNT],
    /// The worst scenes, worst first.
    pub worst: Vec<Example>,
}

/// Examples that are kept.
const EXAMPLES: usize = 10;

/// Weights above any error over its tolerance.
const WRONG_OUTCOME: f64 = 1e300;
const WRONG_CLASS: f64 = 1e299;
const NEEDLESS: f64 = 1e298;

impl Tally {
    /// Puts a scene to a solver, and counts what comes out.
    pub fn add(&mut self, judge: &Judge, solver: &Solver) {
        let Some(answer) = solver.solve(&judge.scene) else {
            return;
        };
        self.scenes += 1;
        if let Answer::Solved { evaluations: Some(evaluations), .. } = answer {
            self.counted += 1;
            self.evaluations += u64::from(evaluations);
        }
        let margin = judge.truth.margin.map_or(f64::INFINITY, Double::to_f64);
        match judge.judge(solver, &answer) {
            Finding::Unknown => self.unknown += 1,
            Finding::Refused => self.refused += 1,
            Finding::Unsolved => self.unsolved += 1,
            Finding::Undecided { needless } => {
                self.undecided += 1;
                self.needless += u64::from(needless);
                self.largest_undecided = self.largest_undecided.max(margin.abs());
                if needless {
                    self.keep(&judge.scene, NEEDLESS, || format!("undecided, margin {margin:.1e}"));
                }
            }
            Finding::WrongOutcome => {
                self.wrong_outcomes += 1;
                self.largest_wrong = self.largest_wrong.max(margin.abs());
                self.keep(&judge.scene, WRONG_OUTCOME, || format!("outcome, margin {margin:.1e}"));
            }
            Finding::Right { wrong_class, errors } => {
                if wrong_class {
                    let slip = judge.truth.slip_margin.map_or(f64::NAN, Double::to_f64);
                    self.wrong_classes += 1;
                    self.keep(&judge.scene, WRONG_CLASS, || format!("class, margin of the slip {slip:.1e}"));
                }
                for ((counts, error), output) in self.outputs.iter_mut().zip(*errors).zip(Output::ALL) {
                    if let Some(error) = error {
                        counts.add(error);
                        if error.size > 1.0 {
                            let fault = || format!("{}, {:.1e} tolerances", output.name(), error.size);
                            keep(&mut self.worst, &judge.scene, error.unexplained, fault);
                        }
                    }
                }
            }
        }
    }

    /// Adds the counts of other scenes.
    pub fn merge(&mut self, other: Self) {
        self.scenes += other.scenes;
        self.unknown += other.unknown;
        self.counted += other.counted;
        self.evaluations += other.evaluations;
        self.refused += other.refused;
        self.unsolved += other.unsolved;
        self.undecided += other.undecided;
        self.needless += other.needless;
        self.largest_undecided = self.largest_undecided.max(other.largest_undecided);
        self.wrong_outcomes += other.wrong_outcomes;
        self.largest_wrong = self.largest_wrong.max(other.largest_wrong);
        self.wrong_classes += other.wrong_classes;
        for (counts, more) in self.outputs.iter_mut().zip(other.outputs) {
            counts.compared += more.compared;
            counts.beyond += more.beyond;
            counts.far_beyond += more.far_beyond;
            counts.unexplained += more.unexplained;
            counts.largest = counts.largest.max(more.largest);
        }
        for Example { scene, fault, weight } in other.worst {
            self.keep(&scene, weight, || fault);
        }
    }

    fn keep(&mut self, scene: &Scene, weight: f64, fault: impl FnOnce() -> String) {
        keep(&mut self.worst, scene, weight, fault);
    }
}

impl OutputErrors {
    fn add(&mut self, error: OutputError) {
        self.compared += 1;
        self.beyond += u64::from(error.size > 1.0);
        self.far_beyond += u64::from(error.size > FAR);
        self.unexplained += u64::from(error.unexplained > FAR);
        self.largest = self.largest.max(error.size);
    }
}

/// Keeps an example if it is among the worst.
fn keep(worst: &mut Vec<Example>, scene: &Scene, weight: f64, fault: impl FnOnce() -> String) {
    let place = worst.partition_point(|example| example.weight >= weight);
    if place < EXAMPLES {
        worst.insert(place, Example { scene: *scene, fault: fault(), weight });
        worst.truncate(EXAMPLES);
    }
}
