//! The crate ode_solvers, which has no events.

use std::hint::black_box;

use ode_solvers::{Dop853, Dopri5, OutputType, SVector, System};

use crate::contestant::{Contestant, tolerances};
use crate::problem::{Equations, Problem};

/// The equations as this crate takes them.
struct Rates(Equations);

impl System<f64, SVector<f64, 4>> for Rates {
    fn system(&self, _z: f64, state: &SVector<f64, 4>, rates: &mut SVector<f64, 4>) {
        *rates = self.0.rates((*state).into()).into();
    }
}

/// The settings.
pub fn contestants(equations: Problem, places: [f64; 2]) -> Vec<Contestant> {
    let mut all = Vec::new();
    macro_rules! compete {
        ($($method:ident),*) => {
            $(for tolerance in tolerances() {
                let method = concat!(stringify!($method), ", last step");
                all.push(Contestant::new("ode_solvers", method, format!("{tolerance:.0e}"), move || {
                    let mut evaluations = 0;
                    let end = black_box(equations).without_events(places, |system, from, state, to| {
                        let mut solver = $method::new(Rates(system), from, to, to - from, state.into(), tolerance, tolerance);
                        // The others interpolate to an end point that is not the last step's.
                        solver.set_output(OutputType::Sparse);
                        evaluations += solver.integrate().ok()?.num_eval as usize;
                        Some((*solver.y_out().last()?).into())
                    })?;
                    Some(equations.answer(end, Some(evaluations)))
                }));
            })*
        };
    }
    compete!(Dopri5, Dop853);
    all
}
