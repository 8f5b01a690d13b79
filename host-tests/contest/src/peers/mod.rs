//! Solvers of other crates.

mod differential_equations;
#[cfg(feature = "diffsol")]
mod diffsol;
mod multicalc;
mod numeris;
mod ode_solvers;

use crate::contestant::Contestant;
use crate::problem::Problem;
use microimpact_scenes::methods::peers::FRACTIONS;

/// The settings of all peers; none where the contact lasts too long for explicit solvers.
pub fn all(problem: Problem) -> Vec<Contestant> {
    let Some(events) = differential_equations::events(problem) else { return Vec::new() };
    let mut all = differential_equations::with_interpolation(problem);
    for fraction in FRACTIONS {
        let places = events.map(|event| fraction * event);
        all.extend(differential_equations::with_last_step(problem, places));
        all.extend(ode_solvers::contestants(problem, places));
        all.extend(numeris::with_last_step(problem, places));
        all.extend(multicalc::contestants(problem, places));
        #[cfg(feature = "diffsol")]
        all.extend(diffsol::with_last_step(problem, places));
    }
    all.extend(numeris::with_dense_output(problem, events.map(|event| 1.02 * event)));
    #[cfg(feature = "diffsol")]
    all.extend(diffsol::with_events(problem));
    all
}

/// Place of a sign change of `value` between two places, by the Illinois method.
fn sign_change(mut low: (f64, f64), mut high: (f64, f64), mut value: impl FnMut(f64) -> f64) -> f64 {
    let mut place = high.0;
    for _ in 0..12 {
        place = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        let value = value(place);
        if value.abs() < 1e-15 {
            break;
        }
        if value > 0.0 {
            low = (place, value);
            high.1 *= 0.5;
        } else {
            high = (place, value);
            low.1 *= 0.5;
        }
    }
    place
}
