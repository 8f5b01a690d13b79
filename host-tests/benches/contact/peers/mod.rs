//! Solvers of other crates.

mod differential_equations;
#[cfg(feature = "diffsol")]
mod diffsol;
mod multicalc;
mod numeris;
mod ode_solvers;

use crate::common::contestant::Contestant;
use crate::common::regularised::{Regularised, Variable, Vector};

/// How far towards an event a solver goes that has none, before it changes the variable.
const SHARES: [f64; 3] = [0.97, 0.85, 0.7];

/// The settings of all peers.
pub fn all(equations: Regularised) -> Vec<Contestant> {
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

impl Regularised {
    /// The contact by a solver that finds no events: from a state at one value of the variable to another, four times.
    ///
    /// `places` are values of z shortly before the peak and the separation.
    #[inline]
    fn without_events(
        self,
        places: [f64; 2],
        mut leg: impl FnMut(Self, f64, Vector, f64) -> Option<Vector>,
    ) -> Option<Vector> {
        let short = leg(self, 0.0, self.start(), places[0])?;
        let peak = leg(self.against(Variable::Speed), short[1], short, 0.0)?;
        let back = self.on_rebound();
        let short = leg(back, 0.0, peak, places[1])?;
        leg(back.against(Variable::Radius), short[0], short, 0.0)
    }
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
