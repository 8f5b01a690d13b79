//! A simulation with a budget takes no more, and what it says is what one without a budget says.

use microimpact::Outcome;
use microimpact::contact::{Adaptive, Collocation, FixedCost, Impulses, RungeKuttaGill, Status};
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

#[test]
fn a_budget_takes_nothing_but_the_answer() {
    let method = Collocation::<NODES, f64>::new(1e-9).unwrap();
    let (mut solved, mut spent, mut largest) = (0, 0, 0);
    for impact in impacts(repetitions(20, 5) as usize) {
        let (Ok(scene), Ok(motion)) = (impact.scene::<f64>(), impact.motion::<f64>()) else { continue };
        let Ok(whole) = scene.solve_for(&motion, &method, Impulses) else { continue };
        let mut decided = false;
        for budget in (0..24).chain([32, 48, 64, 96, 128, 192, 256]) {
            let within = scene.solve_for(&motion, &method.with_budget(budget), Impulses).unwrap();
            let (answer, run) = (within.0.normal.outcome(), within.0.run);
            assert!(run.steps + run.refused <= budget.max(1), "{impact:?}: {run:?}");
            assert!(run.evaluations <= EVALUATIONS * NODES as u32 * budget.max(1), "{impact:?}: {run:?}");
            largest = largest.max(run.evaluations / (NODES as u32 * budget.max(1)));
            match answer {
                Some(Outcome::Rebound | Outcome::Capture) => {
                    assert_eq!(within, whole, "{impact:?} with {budget} intervals");
                    (decided, solved) = (true, solved + 1);
                }
                // More is not known; nor by a larger budget, if the whole run does not know either.
                None | Some(Outcome::Undecided) => {
                    assert!(!decided, "{impact:?}: {budget} intervals are fewer than were enough before");
                    assert!(answer.is_some() || run.status == Status::BudgetSpent, "{impact:?}: {run:?}");
                    spent += 1;
                }
            }
        }
    }
    assert!(solved > 500 && spent > 500, "{solved} {spent}");
    assert!(
        largest > 5,
        "{largest} evaluations at each node for each interval are far from the bound of {EVALUATIONS}"
    );
}

/// Nodes and iterations of the method of fixed cost.
const FIXED_NODES: usize = 7;
const ITERATIONS: u32 = 3;

/// No method runs on where a scene is as hard as the grid has it.
#[test]
fn every_method_keeps_its_own_bound() {
    let (adaptive, gill) = (Adaptive::new(1e-9).unwrap(), RungeKuttaGill::new(50));
    let fixed = FixedCost::<FIXED_NODES>::new(ITERATIONS).unwrap().with_outputs::<9>();
    let most = Collocation::<NODES, f64>::MOST_INTERVALS;
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
