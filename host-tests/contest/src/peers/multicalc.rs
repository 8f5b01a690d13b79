//! The crate multicalc, which has no events and one adaptive method.

use std::hint::black_box;

use multicalc::linear_algebra::Vector;
use multicalc::ode::Rk45;

use crate::contestant::{Contestant, tolerances};
use crate::problem::Problem;

/// The settings: tolerances, and first steps of its own choice or of half a leg.
pub fn contestants(equations: Problem, places: [f64; 2]) -> Vec<Contestant> {
    let mut all = Vec::new();
    for tolerance in tolerances() {
        for (fraction, named) in [(0.0, ""), (0.5, ", long first step")] {
            let setting = format!("{tolerance:.0e}{named}");
            all.push(Contestant::new("multicalc", "Rk45, last step", setting, move || {
                let end = black_box(equations).without_events(places, |system, from, state, to| {
                    let rates = |_: f64, state: &Vector<4>| Vector::new(system.rates(state.into_array()));
                    let solver = Rk45::default().with_rtol(tolerance).with_atol(tolerance);
                    let solver = solver.with_first_step(fraction * (to - from).abs()).with_max_steps(10_000);
                    Some(solver.solve(&rates, from, &Vector::new(state), to).ok()?.into_array())
                })?;
                Some(equations.answer(end, None))
            }));
        }
    }
    all
}
