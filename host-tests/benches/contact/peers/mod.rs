//! Solvers of other crates.

mod differential_equations;
#[cfg(feature = "diffsol")]
mod diffsol;
mod multicalc;
mod numeris;
mod ode_solvers;

use host_tests::Case;

use crate::contestant::Contestant;
use crate::regularised::Regularised;

/// How far towards an event a solver goes that has none, before it changes the variable.
const SHARES: [f64; 3] = [0.97, 0.85, 0.7];

/// The settings of all peers.
pub fn all(case: &Case) -> Vec<Contestant> {
    let equations = Regularised::of(case);
    let events = differential_equations::events(equations);
    let mut all = differential_equations::with_interpolation(equations);
    for share in SHARES {
        let places = events.map(|event| share * event);
        all.extend(differential_equations::with_last_step(equations, places));
        all.extend(ode_solvers::contestants(equations, places));
        all.extend(numeris::with_last_step(equations, places));
        all.extend(multicalc::contestants(equations, places));
        #[cfg(feature = "diffsol")]
        all.extend(diffsol::with_last_step(equations, places));
    }
    all.extend(numeris::with_dense_output(equations, events.map(|event| 1.02 * event)));
    #[cfg(feature = "diffsol")]
    all.extend(diffsol::with_events(equations));
    all
}
