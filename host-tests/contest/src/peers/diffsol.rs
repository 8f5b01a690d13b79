//! The crate diffsol, with its own events or with a last step; problem and solver are built once and used again.

use std::cell::Cell;
use std::hint::black_box;
use std::rc::Rc;

use diffsol::{NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason, Op};

use crate::contestant::{Contestant, tolerances};
use crate::problem::{Equations, Problem, Vector};
use microimpact_scenes::methods::regularised::Variable;

/// Settings with the events of the solver.
pub fn with_events(equations: Problem) -> Vec<Contestant> {
    tolerances().map(|tolerance| contestant(equations, tolerance, None)).collect()
}

/// Settings with which the last step to an event is against the event's own variable.
pub fn with_last_step(equations: Problem, places: [f64; 2]) -> Vec<Contestant> {
    tolerances().map(|tolerance| contestant(equations, tolerance, Some(places))).collect()
}

fn contestant(equations: Problem, tolerance: f64, places: Option<[f64; 2]>) -> Contestant {
    let method = if places.is_some() { "tsit45, last step" } else { "tsit45, events" };
    // The equations change at the events.
    let current = Rc::new(Cell::new(*equations));
    let (rates, event, start) = (Rc::clone(&current), Rc::clone(&current), equations.start());
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance])
        .rhs(move |state, _, _, out| out.copy_from_slice(&rates.get().rates(vector(state))))
        .root(move |state, _, _, out| out[0] = event_value(&event.get(), state), 1)
        .init(move |_, _, state| state.copy_from_slice(&start), 4)
        .build()
        .expect("the problem is complete");
    // A solver borrows its problem, and both last as long as the benchmark.
    let problem = &*Box::leak(Box::new(problem));
    let mut solver = problem.tsit45().expect("the problem is complete");
    let first_step = solver.state().h;
    Contestant::new("diffsol", method, format!("{tolerance:.0e}"), move || {
        let before = problem.eqn.rhs().statistics().number_of_calls;
        let begin = |solver: &mut _, equations: Equations, from: f64, state: Vector, step: f64| {
            current.set(equations);
            restart(solver, &equations, from, state, step);
        };
        let end = match places {
            Some(places) => equations.without_events(places, |system, from, state, to| {
                begin(&mut solver, system, from, state, to - from);
                solver.set_stop_time(to).ok()?;
                while solver.step().ok()? != OdeSolverStopReason::TstopReached {}
                Some(vector(solver.state().y.batch_as_slice(0)))
            })?,
            None => {
                begin(&mut solver, *black_box(equations), 0.0, start, first_step);
                let peak = next_event(&mut solver)?;
                let step = solver.state().h;
                begin(&mut solver, equations.on_rebound(), 0.0, [peak[0], 0.0, peak[2], peak[3]], step);
                next_event(&mut solver)?
            }
        };
        let calls = problem.eqn.rhs().statistics().number_of_calls - before;
        Some(equations.answer(end, Some(calls)))
    })
}

/// Speed on approach, contact radius on rebound; no event where the variable itself is the event's.
fn event_value(equations: &Equations, state: &[f64]) -> f64 {
    match equations.against {
        Variable::Stretched => state[usize::from(!equations.rebound)],
        Variable::Speed | Variable::Radius => 1.0,
    }
}

/// Puts a solver back to a state.
fn restart<'a, E>(solver: &mut impl OdeSolverMethod<'a, E>, equations: &Equations, from: f64, state: Vector, step: f64)
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
{
    let to = solver.state_mut();
    to.y.batch_as_mut_slice(0).copy_from_slice(&state);
    to.dy.batch_as_mut_slice(0).copy_from_slice(&equations.rates(state));
    (*to.t, *to.h) = (from, step);
}

/// Steps to the next event.
fn next_event<'a, E>(solver: &mut impl OdeSolverMethod<'a, E>) -> Option<Vector>
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
{
    for _ in 0..10_000 {
        if let OdeSolverStopReason::RootFound(place, _) = solver.step().ok()? {
            return Some(vector(solver.interpolate(place).ok()?.batch_as_slice(0)));
        }
    }
    None
}

fn vector(state: &[f64]) -> Vector {
    [state[0], state[1], state[2], state[3]]
}
