//! Formulations of the normal motion beside the one that the library uses, at equal error.
//!
//! The paper's equations with a fixed step; the [regularised equations] by a Runge-Kutta method, by splitting and by
//! Taylor series; the energy by collocation over a whole phase, with plain nodes and, as the library's `FixedCost`,
//! with nodes for the weight of the losses; and the energy by collocation in intervals, the library's `Collocation`,
//! which is the measure of time. `FixedCost` gives e alone. The library starts from SI units, all others from scaled
//! ones.
//!
//! A whole phase costs least where damping is mild, but it has no estimate of its error and does not converge where
//! damping is overwhelming. Intervals have such an estimate and converge under any damping.
//!
//! [regularised equations]: microimpact_scenes::methods::regularised

mod gauss;
mod library;
mod splitting;
mod taylor;
mod whole_phase;

use contest::contestant::Contestant;
use contest::runge_kutta;
use contest::table::compare;
use library::{COLLOCATION, Scene};

fn main() {
    for scene in Scene::all() {
        let equations = scene.equations();
        let mut all: Vec<Contestant> = scene.contestants();
        all.extend(runge_kutta::contestants(equations));
        all.extend(splitting::contestants(equations));
        all.extend(taylor::contestants(equations));
        all.extend(whole_phase::contestants(equations));
        println!("{}\n{}\n", scene.name, compare(all, &scene.exact, COLLOCATION));
    }
}
