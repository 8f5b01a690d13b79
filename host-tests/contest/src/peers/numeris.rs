//! The crate numeris, which has no events but dense output.

use std::hint::black_box;

use numeris::Vector;
use numeris::ode::{AdaptiveSettings, RKAdaptive, RKF45, RKTS54, RKV65, RKV87, RKV98, RKV98Efficient, RKV98NoInterp};

use super::sign_change;
use crate::contestant::{Contestant, tolerances};
use crate::problem::Problem;

type State = Vector<f64, 4>;

/// Settings: tolerances, and first steps of its own choice or of half a leg.
fn settings() -> impl Iterator<Item = (String, AdaptiveSettings<f64>, Option<f64>)> {
    tolerances().flat_map(|tolerance| {
        let settings = AdaptiveSettings {
            abs_tol: tolerance,
            rel_tol: tolerance,
            min_step: 1e-12,
            max_steps: 10_000,
            ..AdaptiveSettings::default()
        };
        [(None, ""), (Some(0.5), ", long first step")]
            .map(|(fraction, named)| (format!("{tolerance:.0e}{named}"), settings, fraction))
    })
}

/// Settings with which the last step to an event is against the event's own variable.
pub fn with_last_step(equations: Problem, places: [f64; 2]) -> Vec<Contestant> {
    let mut all = Vec::new();
    macro_rules! compete {
        ($($method:ident),*) => {
            $(for (setting, settings, fraction) in settings() {
                let method = concat!(stringify!($method), ", last step");
                all.push(Contestant::new("numeris", method, setting, move || {
                    let mut evaluations = 0;
                    let end = black_box(equations).without_events(places, |system, from, state, to| {
                        let rates = |_, state: &State| Vector::from_array(system.rates(vector(state)));
                        let initial_step = fraction.map(|fraction| fraction * (to - from).abs());
                        let settings = AdaptiveSettings { initial_step, ..settings };
                        let solution = $method::integrate(from, to, &Vector::from_array(state), rates, &settings).ok()?;
                        evaluations += solution.evals;
                        Some(vector(&solution.y))
                    })?;
                    Some(equations.answer(end, Some(evaluations)))
                }));
            })*
        };
    }
    compete!(RKF45, RKTS54, RKV65, RKV87, RKV98NoInterp);
    all
}

/// Settings with which an event is looked for on dense output, which ends at `places` behind the events.
pub fn with_dense_output(equations: Problem, places: [f64; 2]) -> Vec<Contestant> {
    let mut all = Vec::new();
    macro_rules! compete {
        ($($method:ident),*) => {
            $(for (setting, settings, fraction) in settings() {
                let method = concat!(stringify!($method), ", dense output");
                all.push(Contestant::new("numeris", method, setting, move || {
                    let mut evaluations = 0;
                    let mut state = Vector::from_array(equations.start());
                    let system = *black_box(equations);
                    for (system, to) in [system, system.on_rebound()].into_iter().zip(places) {
                        let rates = |_, state: &State| Vector::from_array(system.rates(vector(state)));
                        let initial_step = fraction.map(|fraction| fraction * to);
                        let settings = AdaptiveSettings { initial_step, dense_output: true, ..settings };
                        let solution = $method::integrate(0.0, to, &state, rates, &settings).ok()?;
                        evaluations += solution.evals;
                        // The step in which speed or contact radius changes its sign.
                        let index = usize::from(!system.rebound);
                        let dense = solution.dense.as_ref()?;
                        let step = dense.y.iter().skip(1).position(|state| state[index] <= 0.0);
                        let step = step.unwrap_or(dense.y.len() - 1);
                        let places = dense.t.iter().copied().chain([to]);
                        let values = dense.y.iter().chain([&solution.y]).map(|state| state[index]);
                        let mut ends = places.zip(values).skip(step);
                        sign_change(ends.next()?, ends.next()?, |place| {
                            state = $method::interpolate(place, &solution).unwrap_or(state);
                            state[index]
                        });
                        state[index] = 0.0;
                    }
                    Some(equations.answer(vector(&state), Some(evaluations)))
                }));
            })*
        };
    }
    compete!(RKTS54, RKV65, RKV87, RKV98, RKV98Efficient);
    all
}

fn vector(state: &State) -> [f64; 4] {
    [state[0], state[1], state[2], state[3]]
}
