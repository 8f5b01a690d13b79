//! The truth of a scene, and what an answer is worth beside it.

use std::cell::{OnceCell, RefCell};
use std::f64::consts::PI;

use microimpact::{Outcome, SurfaceMotion};
use reference::scenes::mass;
use truth::{Double, Scene, Truth, solve};

use crate::allowance::Allowance;
use crate::output::{COUNT, Output};
use crate::solver::{Answer, Number, Solver};

/// Steps after which the truth gives up. Stiff scenes take more.
const STEPS: u32 = 300;

/// A scene with its truth. What the inputs account for is computed where an error needs it.
pub struct Judge {
    /// The scene.
    pub scene: Scene,
    /// Its solution.
    pub truth: Truth,
    of_rounding: [OnceCell<Allowance>; 3],
    of_tolerances: RefCell<Vec<(f64, Allowance)>>,
}

/// The error of an output over the tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputError {
    /// Less what the rounding of the inputs accounts for.
    pub size: f64,
    /// Where it is far beyond the tolerance, less also what inputs account for that are wrong by the tolerance.
    pub unexplained: f64,
}

/// What an answer is worth.
#[derive(Clone, Debug)]
pub enum Finding {
    /// The truth does not know the outcome.
    Unknown,
    /// The inputs were refused.
    Refused,
    /// The status is not *solved*.
    Unsolved,
    /// The outcome is undecided.
    Undecided {
        /// Although the energy left differs from none by more than twice the error that the method states.
        needless: bool,
    },
    /// Rebound for capture or capture for rebound.
    WrongOutcome,
    /// The right outcome.
    Right {
        /// Sliding for rolling or the reverse, farther from the boundary than the tolerance.
        wrong_class: bool,
        /// Of each output; `None` where it is not compared.
        errors: Box<[Option<OutputError>; COUNT]>,
    },
}

impl Judge {
    /// Solves the scene.
    pub fn new(scene: Scene) -> Self {
        Self { truth: solve(&scene, STEPS), scene, of_rounding: Default::default(), of_tolerances: RefCell::default() }
    }

    /// Judges an answer of a solver.
    pub fn judge(&self, solver: &Solver, answer: &Answer) -> Finding {
        let Some(outcome) = self.truth.outcome else {
            return Finding::Unknown;
        };
        let (found, motion, outputs) = match answer {
            Answer::Refused => return Finding::Refused,
            Answer::Unsolved => return Finding::Unsolved,
            Answer::Solved { outcome: Outcome::Undecided, stated_error, .. } => {
                let needless = self.is_clear(solver, *stated_error);
                return Finding::Undecided { needless };
            }
            Answer::Solved { outcome, motion, outputs, .. } => (*outcome, motion, outputs),
        };
        let rebounds = outcome == truth::Outcome::Rebound;
        if rebounds != (found == Outcome::Rebound) {
            return Finding::WrongOutcome;
        }
        let other_motion = motion.is_some_and(|motion| self.is_other_motion(rebounds, motion));
        let near = || {
            let allowance = self.rounding(solver.number).slip + FARTHEST * solver.tolerance;
            self.truth.slip_margin.is_some_and(|margin| margin.to_f64().abs() <= allowance)
        };
        let compared = match (self.truth.complete, rebounds) {
            (true, true) => COUNT,
            (true, false) => Output::OF_CAPTURES,
            (false, _) => 0,
        };
        let mut errors = Box::new([None; COUNT]);
        for (index, output) in Output::ALL.into_iter().enumerate().take(compared) {
            let given = match output {
                Output::RestitutionSquared => true,
                Output::Turning => solver.follows_captures,
                Output::RollTime => solver.all_outputs && !other_motion,
                _ => solver.all_outputs,
            };
            if given {
                errors[index] = self.error(solver, index, output, outputs[index]);
            }
        }
        Finding::Right { wrong_class: other_motion && !near(), errors }
    }

    /// Whether the energy left differs from none by more than twice a stated error, and by more than the rounding of
    /// the inputs accounts for.
    fn is_clear(&self, solver: &Solver, stated_error: f64) -> bool {
        const ALLOWED: f64 = 2.0;
        let margin = self.truth.margin.map_or(f64::INFINITY, |margin| margin.to_f64().abs());
        let stated = ALLOWED * stated_error;
        // Of a sphere that creeps to rest the truth has a bound, far from what rounding can change.
        let creeps = self.truth.outcome == Some(truth::Outcome::Capture) && self.truth.turning.is_none();
        margin > stated && (creeps || margin > stated + self.rounding(solver.number).margin)
    }

    /// Whether the motion along the surface is not the true one. A captured sphere is said to roll as soon as friction
    /// will end its slip.
    fn is_other_motion(&self, rebounds: bool, (motion, slides): (SurfaceMotion, bool)) -> bool {
        let sliding = motion == SurfaceMotion::Sliding;
        if rebounds {
            return sliding == self.truth.rolls || slides == self.truth.rolls;
        }
        sliding != (self.scene.friction == 0.0 && self.truth.slip_margin.is_some())
    }

    fn error(&self, solver: &Solver, index: usize, output: Output, found: Option<f64>) -> Option<OutputError> {
        let error = match (output.of(&self.truth), found) {
            (None, None) => return None,
            (Some(truth), Some(found)) => (Double::from(found) - truth).to_f64().abs(),
            // A swing smaller than the tolerance cannot be told from creeping to the equilibrium.
            (truth, found) if output == Output::Peak || output == Output::Turning => {
                let turn = truth.or(found.map(Double::from));
                let distance = turn.zip(self.truth.equilibrium).map(|(turn, rest)| (turn - rest).to_f64().abs());
                distance.unwrap_or(f64::INFINITY)
            }
            (truth, found) if output == Output::PeakTime && truth.is_some() == self.truth.peak.is_some() => {
                // Judged by the peak.
                debug_assert!(truth.is_none() || found.is_none());
                return None;
            }
            _ => f64::INFINITY,
        };
        let tolerance = solver.tolerance * output.scale(&self.scene, &self.truth);
        if error <= tolerance {
            let size = error / tolerance;
            return Some(OutputError { size, unexplained: size });
        }
        let beyond = |error: f64, allowed: f64| match allowed {
            f64::INFINITY => 0.0,
            _ if error.is_nan() => f64::INFINITY,
            _ => (error - allowed).max(0.0),
        };
        let rest = beyond(error, self.rounding(solver.number).outputs[index]);
        let size = rest / tolerance;
        let unexplained = match size > FAR {
            true => {
                let allowed = self.tolerated(solver.tolerance, index) + self.of_energy(solver.tolerance, output);
                beyond(rest, allowed) / tolerance
            }
            false => size,
        };
        Some(OutputError { size, unexplained })
    }

    /// What an energy accounts for that is exact to the tolerance: the sphere turns where the potential equals it. Close to the
    /// critical speed that is where forces nearly vanish.
    fn of_energy(&self, tolerance: f64, output: Output) -> f64 {
        let Some(turning) = self.truth.turning.filter(|_| output == Output::Turning).map(Double::to_f64) else {
            return 0.0;
        };
        let scene = &self.scene;
        let elastic = scene.radius.sqrt() * scene.stiffness * turning.powf(1.5);
        let adhesion = 2.0 * PI * scene.adhesion * (scene.radius * turning).sqrt();
        tolerance * 0.5 * mass(scene) * scene.speed * scene.speed / (elastic - adhesion + scene.force).abs()
    }

    fn rounding(&self, number: Number) -> &Allowance {
        self.of_rounding[number as usize]
            .get_or_init(|| Allowance::of_rounding(&self.scene, &self.truth, number.unit(), STEPS))
    }

    fn tolerated(&self, tolerance: f64, index: usize) -> f64 {
        let mut known = self.of_tolerances.borrow_mut();
        if !known.iter().any(|(of, _)| *of == tolerance) {
            known.push((tolerance, Allowance::of_tolerance(&self.scene, &self.truth, tolerance, STEPS)));
        }
        known.iter().find(|(of, _)| *of == tolerance).map_or(0.0, |(_, allowance)| allowance.outputs[index])
    }
}

/// Tolerances above which an error is far beyond.
pub(crate) const FAR: f64 = 10.0;

/// Tolerances from the boundary within which sliding may be taken for rolling.
const FARTHEST: f64 = 10.0;

#[cfg(test)]
mod tests {
    use microimpact::{Outcome, SurfaceMotion};
    use reference::scenes::Kind;
    use truth::Double;

    use super::{Finding, Judge};
    use crate::output::{COUNT, Output};
    use crate::solver::{Answer, Solver, solvers};

    /// A solver with a tolerance of 1e-6, and scenes with a kind of outcome.
    fn judges(outcome: truth::Outcome) -> (Solver, impl Iterator<Item = Judge>) {
        let solver = solvers().into_iter().find(|solver| solver.name == "Adaptive 1e-6").unwrap();
        let scenes = (0..).map(|number| Judge::new(Kind::Mild.scene(9, number)));
        (solver, scenes.filter(move |judge| judge.truth.outcome == Some(outcome)).take(20))
    }

    /// The answer that is right, but for one output that is wrong by a fraction of its scale.
    fn answer(judge: &Judge, wrong: usize, error: f64) -> Answer {
        let mut outputs = Box::new([None; COUNT]);
        for (index, output) in Output::ALL.into_iter().enumerate() {
            let scale = if index == wrong { output.scale(&judge.scene, &judge.truth) } else { 0.0 };
            outputs[index] = output.of(&judge.truth).map(|value| value.to_f64() + error * scale);
        }
        let rebound = judge.truth.outcome == Some(truth::Outcome::Rebound);
        let (outcome, slides) = (if rebound { Outcome::Rebound } else { Outcome::Capture }, !judge.truth.rolls);
        let motion = if slides { SurfaceMotion::Sliding } else { SurfaceMotion::Rolling };
        Answer::Solved { outcome, stated_error: 0.0, evaluations: None, motion: Some((motion, slides)), outputs }
    }

    #[test]
    fn the_right_answer_is_right_and_each_wrong_output_is_found() {
        let (solver, judges) = judges(truth::Outcome::Rebound);
        for judge in judges {
            let found = |wrong, error| match judge.judge(&solver, &answer(&judge, wrong, error)) {
                Finding::Right { wrong_class: false, errors } => errors.map(|error| error.map_or(0.0, |e| e.size)),
                finding => panic!("{finding:?}"),
            };
            assert!(found(0, 0.0).iter().all(|error| *error < 1e-3), "{}", judge.scene);
            for (wrong, output) in Output::ALL.into_iter().enumerate() {
                // A million tolerances are more than any input accounts for.
                let far = output.of(&judge.truth).is_none() || found(wrong, 1.0)[wrong] > 1e5;
                assert!(far, "{}: {}", output.name(), judge.scene);
            }
        }
    }

    #[test]
    fn wrong_outcomes_and_classes_are_found() {
        for (outcome, other) in
            [(truth::Outcome::Rebound, Outcome::Capture), (truth::Outcome::Capture, Outcome::Rebound)]
        {
            let (solver, judges) = judges(outcome);
            for judge in judges {
                let right = answer(&judge, 0, 0.0);
                let Answer::Solved { motion, stated_error, evaluations, outcome: same, outputs } = right else {
                    unreachable!()
                };
                let wrong =
                    Answer::Solved { outcome: other, motion, stated_error, evaluations, outputs: outputs.clone() };
                assert!(matches!(judge.judge(&solver, &wrong), Finding::WrongOutcome), "{}", judge.scene);
                if outcome == truth::Outcome::Rebound
                    && judge.truth.slip_margin.is_some_and(|margin| margin.abs() > Double::from(0.01))
                {
                    let slides = judge.truth.rolls;
                    let motion = if slides { SurfaceMotion::Sliding } else { SurfaceMotion::Rolling };
                    let wrong = Answer::Solved {
                        outcome: same,
                        motion: Some((motion, slides)),
                        stated_error,
                        evaluations,
                        outputs,
                    };
                    let finding = judge.judge(&solver, &wrong);
                    assert!(matches!(finding, Finding::Right { wrong_class: true, .. }), "{}", judge.scene);
                }
            }
        }
    }

    #[test]
    fn undecided_is_needless_only_far_from_the_boundary() {
        let (solver, judges) = judges(truth::Outcome::Capture);
        for judge in judges {
            let margin = judge.truth.margin.unwrap().to_f64().abs();
            let needless = |stated_error| {
                let answer = Answer::Solved {
                    outcome: Outcome::Undecided,
                    evaluations: None,
                    motion: None,
                    stated_error,
                    outputs: Default::default(),
                };
                matches!(judge.judge(&solver, &answer), Finding::Undecided { needless: true })
            };
            assert!(needless(0.4 * margin) && !needless(0.6 * margin), "{}: {margin}", judge.scene);
        }
    }
}
