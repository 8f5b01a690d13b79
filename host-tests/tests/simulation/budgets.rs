//! A simulation with a budget takes no more, and what it says is what one without a budget says.

use microimpact::contact::{
    Adaptive, Collocation, CriticalSpeedSearch, FixedCost, Impulses, Method, RungeKuttaGill, Status,
};
use microimpact::{CriticalSpeed, InputError, Outcome};
use reference::grids::{Impact, PLANES};
use reference::repetitions;

const NODES: usize = 9;

/// Evaluations that an interval may take at each node, as the documentation says.
const EVALUATIONS: u32 = 50;

/// Impacts of the shared grid: so many by so many of each plane.
fn impacts(count: usize) -> impl Iterator<Item = Impact> {
    PLANES.iter().flat_map(move |plane| {
        let places = plane.x.values(count).into_iter();
        places.flat_map(move |x| plane.y.values(count).into_iter().filter_map(move |y| (plane.impact)(x, y)))
    })
}

/// What runs with budgets came to.
#[derive(Default)]
struct Tally {
    solved: u32,
    spent: u32,
    /// Evaluations for each interval of a budget.
    largest: u32,
}

impl Tally {
    /// Solves an impact by a method with and without budgets, of which an interval takes at most so many evaluations.
    fn solve<M: Method<f64>, B: Method<f64>>(
        &mut self,
        impact: &Impact,
        method: &M,
        with_budget: impl Fn(u32) -> B,
        evaluations: u32,
    ) {
        let (Ok(scene), Ok(motion)) = (impact.scene::<f64>(), impact.motion::<f64>()) else { return };
        let Ok(whole) = scene.solve_for(&motion, method, Impulses) else { return };
        let mut decided = false;
        for budget in (0..24).chain([32, 48, 64, 96, 128, 192, 256, u32::MAX]) {
            let within = scene.solve_for(&motion, &with_budget(budget), Impulses).unwrap();
            let (answer, run) = (within.0.normal.outcome(), within.0.run);
            assert!(run.steps + run.refused <= budget.max(1), "{impact:?}: {run:?}");
            assert!(run.evaluations <= evaluations.saturating_mul(budget.max(1)), "{impact:?}: {run:?}");
            self.largest = self.largest.max(run.evaluations / budget.max(1));
            match answer {
                Some(Outcome::Rebound | Outcome::Capture) => {
                    assert_eq!(within, whole, "{impact:?} with {budget} intervals");
                    decided = true;
                    self.solved += 1;
                }
                // More is not known; nor by a larger budget, if the whole run does not know either.
                None | Some(Outcome::Undecided) => {
                    assert!(!decided, "{impact:?}: {budget} intervals are fewer than were enough before");
                    assert!(answer.is_some() || run.status == Status::BudgetSpent, "{impact:?}: {run:?}");
                    self.spent += 1;
                }
            }
        }
        let ample = scene.solve_for(&motion, &with_budget(u32::MAX), Impulses).unwrap();
        assert_eq!(ample.0.normal.outcome(), whole.0.normal.outcome(), "{impact:?}");
        assert_eq!(ample.0.run, whole.0.run, "{impact:?}");
    }

    fn check(&self, nodes: u32) {
        let Self { solved, spent, largest } = *self;
        assert!(solved > 500 && spent > 500, "{solved} {spent}");
        assert!(
            largest > 5 * nodes,
            "{largest} evaluations for each interval are far from the bound of {EVALUATIONS} at each of {nodes} nodes"
        );
    }
}

#[test]
fn a_budget_takes_nothing_but_the_answer() {
    let method = Collocation::<NODES, f64>::new(1e-9).unwrap();
    let mut tally = Tally::default();
    for impact in impacts(repetitions(20, 5) as usize) {
        tally.solve(&impact, &method, |budget| method.with_budget(budget), EVALUATIONS * NODES as u32);
    }
    tally.check(NODES as u32);
}

/// At a tolerance that whole phases serve in one attempt, at one that takes two, and at one at which all goes to intervals.
#[test]
fn adaptive_keeps_its_budget() {
    for (tolerance, nodes) in [(1e-3, 7), (1e-6, 7), (1e-9, 9), (1e-12, 12)] {
        let method = Adaptive::new(tolerance).unwrap();
        let mut tally = Tally::default();
        for impact in impacts(repetitions(20, 5) as usize) {
            tally.solve(&impact, &method, |budget| method.with_budget(budget), EVALUATIONS * nodes);
        }
        tally.check(nodes);
    }
}

/// Each step makes the trials that it may, and the critical speed is the one that is found at once.
#[test]
fn a_critical_speed_in_steps_is_the_same() {
    let (adaptive, collocation) = (Adaptive::new(1e-9).unwrap(), Collocation::<NODES, f64>::new(1e-9).unwrap());
    let (mut found, mut most) = (0, 0);
    for impact in impacts(repetitions(12, 5) as usize) {
        let Ok(scene) = impact.scene::<f64>() else { continue };
        for budget in [1, 2, 3, 7] {
            let (at_once, in_steps) = if budget % 2 == 1 {
                (
                    scene.critical_speed(&adaptive),
                    in_steps(budget, |search, budget| search.step(budget, &scene, &adaptive)),
                )
            } else {
                let step = |search: &mut CriticalSpeedSearch<f64>, budget| search.step(budget, &scene, &collocation);
                (scene.critical_speed(&collocation), in_steps(budget, step))
            };
            assert_eq!(in_steps.0, at_once, "{impact:?}");
            found += u32::from(matches!(at_once, Ok(CriticalSpeed::At(_))));
            most = most.max(in_steps.1);
        }
    }
    assert!(found > 100 && most > 7, "{found} found, in at most {most} trials");
}

/// The result of a search in steps of a number of trials, and all its trials.
fn in_steps(
    budget: u32,
    step: impl Fn(&mut CriticalSpeedSearch<f64>, u32) -> Result<Option<CriticalSpeed<f64>>, InputError>,
) -> (Result<CriticalSpeed<f64>, InputError>, u32) {
    let mut search = CriticalSpeedSearch::new();
    loop {
        let before = search.trials();
        let result = step(&mut search, budget).transpose();
        let trials = search.trials() - before;
        match result {
            None => assert_eq!(trials, budget),
            Some(result) => {
                assert!(trials <= budget && step(&mut search, budget).transpose() == Some(result));
                return (result, search.trials());
            }
        }
    }
}

/// Nodes and iterations of the method of fixed cost.
const FIXED_NODES: usize = 7;
const ITERATIONS: u32 = 3;

/// No method runs on where a scene is as hard as the grid has it.
#[test]
fn every_method_keeps_its_own_bound() {
    let (adaptive, gill) = (Adaptive::new(1e-9).unwrap(), RungeKuttaGill::new(50));
    let fixed = FixedCost::<FIXED_NODES>::new(ITERATIONS).unwrap().with_outputs::<9>();
    let most = Adaptive::<f64>::MOST_INTERVALS;
    for impact in impacts(repetitions(12, 5) as usize) {
        let (Ok(scene), Ok(motion)) = (impact.scene::<f64>(), impact.motion::<f64>()) else { continue };
        if let Ok(solved) = scene.solve(&motion, &adaptive) {
            assert!(solved.run.steps + solved.run.refused <= most, "{impact:?}: {:?}", solved.run);
        }
        if let Ok(solved) = scene.solve(&motion, &fixed) {
            // Iterations of both phases.
            let most = 2 * ITERATIONS * FIXED_NODES as u32;
            assert!(solved.run.evaluations <= most, "{impact:?}: {:?}", solved.run);
        }
        if let Ok(solved) = scene.solve(&motion, &gill) {
            // Runs with the step, with twice and with four times the step, of four evaluations a step.
            let longest = 50 * RungeKuttaGill::LONGEST_RUN;
            assert!(
                solved.run.evaluations <= 4 * (longest + longest / 2 + longest / 4 + 3),
                "{impact:?}: {:?}",
                solved.run
            );
        }
    }
}
