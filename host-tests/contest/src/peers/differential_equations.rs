//! The crate differential-equations. Its own search for events does not follow the tolerance, so they are located on
//! its interpolation, or by a last step.

use std::cell::Cell;
use std::hint::black_box;

use differential_equations::control::ControlFlag;
use differential_equations::interpolate::Interpolation;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod, solve_ode};
use differential_equations::prelude::ExplicitRungeKutta;
use differential_equations::solout::Solout;
use differential_equations::solution::Solution;

use super::sign_change;
use crate::contestant::{Contestant, tolerances};
use crate::problem::{Equations, Problem, Vector};

// A solver counts its steps over all runs, so each run has its own; it lives on the stack.

/// Settings with which an event is looked for on the interpolation of a step.
pub fn with_interpolation(equations: Problem) -> Vec<Contestant> {
    let mut all = Vec::new();
    macro_rules! compete {
        ($($method:ident),*) => {
            $(for tolerance in tolerances() {
                let setting = format!("{tolerance:.0e}");
                let method = concat!(stringify!($method), ", interpolation");
                all.push(Contestant::new("differential-equations", method, setting, move || {
                    let solver = ExplicitRungeKutta::$method().rtol(tolerance).atol(tolerance);
                    let (end, _, evaluations) = solve(solver, *black_box(equations))?;
                    Some(equations.answer(end, Some(evaluations)))
                }));
            })*
        };
    }
    compete!(dopri5, dop853, rkv656e, rkv767e, rkv878e, rkv988e);
    all
}

/// Settings with which the last step to an event is against the event's own variable.
pub fn with_last_step(equations: Problem, places: [f64; 2]) -> Vec<Contestant> {
    let mut all = Vec::new();
    macro_rules! compete {
        ($($method:ident),*) => {
            $(for tolerance in tolerances() {
                let setting = format!("{tolerance:.0e}");
                let method = concat!(stringify!($method), ", last step");
                all.push(Contestant::new("differential-equations", method, setting, move || {
                    let mut evaluations = 0;
                    let end = black_box(equations).without_events(places, |system, from, state, to| {
                        let mut solver = ExplicitRungeKutta::$method().rtol(tolerance).atol(tolerance);
                        let (system, mut last) = (Sided(Cell::new(system)), Last(state));
                        let solution = solve_ode(&mut solver, &system, from, to, &state, &mut last).ok()?;
                        evaluations += solution.evals.function;
                        Some(last.0)
                    })?;
                    Some(equations.answer(end, Some(evaluations)))
                }));
            })*
        };
    }
    compete!(dopri5, dop853, rkv656e, rkv767e, rkv878e, rkv988e);
    all
}

/// Places of the peak, and of the separation from there, to rounding; `None` if the sphere is still in contact at the end.
pub fn events(equations: Problem) -> Option<[f64; 2]> {
    let solver = ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13);
    let (_, places, _) = solve(solver, *equations)?;
    Some([places[0], places[1] - places[0]])
}

/// State at separation, places of the events, and evaluations.
fn solve(
    mut solver: impl OrdinaryNumericalMethod<f64, Vector> + Interpolation<f64, Vector>,
    equations: Equations,
) -> Option<(Vector, [f64; 2], usize)> {
    let system = Sided(Cell::new(equations));
    let start = equations.start();
    let mut events = Events { system: &system, places: [0.0; 2], end: None };
    let solution = solve_ode(&mut solver, &system, 0.0, 20.0, &start, &mut events).ok()?;
    Some((events.end?, events.places, solution.evals.function))
}

/// The equations of the side of the peak that the sphere is on.
struct Sided(Cell<Equations>);

impl ODE<f64, Vector> for Sided {
    #[inline]
    fn diff(&self, _z: f64, state: &Vector, rates: &mut Vector) {
        *rates = self.0.get().rates(*state);
    }
}

/// Locates the peak and the separation.
struct Events<'a> {
    system: &'a Sided,
    places: [f64; 2],
    end: Option<Vector>,
}

impl Solout<f64, Vector> for Events<'_> {
    fn solout<I: Interpolation<f64, Vector> + ?Sized>(
        &mut self,
        now: f64,
        before: f64,
        state: &Vector,
        state_before: &Vector,
        interpolation: &mut I,
        _solution: &mut Solution<f64, Vector>,
    ) -> ControlFlag<f64, Vector> {
        let equations = self.system.0.get();
        let rebound = equations.rebound;
        let index = usize::from(!rebound);
        if state[index] > 0.0 || now == before || (rebound && state_before[0] <= 0.0) || (!rebound && state[1] == 0.0) {
            return ControlFlag::Continue;
        }
        let mut root = *state;
        let place = sign_change((before, state_before[index]), (now, state[index]), |place| {
            root = interpolation.interpolate(place).unwrap_or(root);
            root[index]
        });
        self.places[usize::from(rebound)] = place;
        if rebound {
            self.end = Some(root);
            return ControlFlag::Terminate;
        }
        self.system.0.set(equations.on_rebound());
        root[1] = 0.0;
        ControlFlag::ModifyState(place, root)
    }
}

/// Keeps the last state.
struct Last(Vector);

impl Solout<f64, Vector> for Last {
    fn solout<I: Interpolation<f64, Vector> + ?Sized>(
        &mut self,
        _now: f64,
        _before: f64,
        state: &Vector,
        _state_before: &Vector,
        _interpolation: &mut I,
        _solution: &mut Solution<f64, Vector>,
    ) -> ControlFlag<f64, Vector> {
        self.0 = *state;
        ControlFlag::Continue
    }
}
