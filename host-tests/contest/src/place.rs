//! Impacts on which this library meets solvers in other languages, along the axes that make an impact easy or hard.

use std::rc::Rc;

use microimpact::contact::Adaptive;
use microimpact::{CriticalSpeed, Real};
use reference::{Case, case};

use crate::contestant::Answer;
use crate::scene::{hertz_scene, normal_scene, solve_exactly};

/// Damping d = c_H v of impacts without adhesion.
pub const DAMPING: &str = "damping";
/// Speed over the critical speed, less one.
pub const NEARNESS: &str = "nearness";
/// The impact of Table 1.
pub const PAPER: &str = "Table 1";
/// Many different impacts.
pub const ENSEMBLE: &str = "ensemble";

const DAMPINGS: [f64; 9] = [0.05, 0.5, 1.4, 2.5, 4.4, 14.0, 44.0, 440.0, 4400.0];
const NEARNESSES: [f64; 3] = [1e-1, 1e-2, 1e-4];

/// How many impacts an ensemble has.
const COUNT: usize = 240;
/// Speeds of an ensemble, m/s.
const SPEEDS: [f64; 2] = [1.5, 30.0];
/// Radii of an ensemble, m.
const RADII: [f64; 2] = [0.5e-6, 5e-6];
/// The least restitution in an ensemble: how near to the critical speed its impacts are is an axis of its own.
const LEAST_RESTITUTION: f64 = 0.1;

/// Impacts that are solved one after another.
pub struct Place {
    /// Its axis.
    pub axis: &'static str,
    /// Where on the axis; zero if it has one place.
    pub value: f64,
    /// The impacts.
    pub cases: Rc<[Case]>,
    /// Their solutions.
    pub exact: Vec<Answer>,
}

/// All places.
pub fn all() -> Vec<Place> {
    let table_1 = case("table1");
    let dampings = DAMPINGS.map(|damping| Place::of(DAMPING, damping, damped(&table_1, damping)));
    let nearnesses = NEARNESSES.map(|nearness| Place::of(NEARNESS, nearness, near(&table_1, nearness)));
    let mut places: Vec<Place> = dampings.into_iter().chain(nearnesses).collect();
    places.push(ensemble(&table_1));
    places.push(Place::of(PAPER, 0.0, table_1));
    places
}

impl Place {
    fn of(axis: &'static str, value: f64, case: Case) -> Self {
        let exact = vec![solve_exactly(&case).expect("the sphere rebounds")];
        Self { axis, value, cases: [case].into(), exact }
    }
}

/// The impact without adhesion and with another damping.
fn damped(case: &Case, damping: f64) -> Case {
    let free = case.scaled("adhesion_n_m", 0.0);
    let (scene, motion) = hertz_scene::<f64>(&free);
    let groups = scene.groups(&motion).expect("the scene can be represented");
    free.scaled("zeta_h", damping / groups.material_damping)
}

/// The impact at another speed over the critical one, less one.
fn near(case: &Case, nearness: f64) -> Case {
    let (scene, motion) = normal_scene::<f64>(case);
    let method = Adaptive::new(1e-12).expect("the tolerance is in its range");
    let Ok(CriticalSpeed::At(critical)) = scene.critical_speed(&method) else { panic!("there is a critical speed") };
    case.scaled("speed_normal_m_s", (1.0 + nearness) * critical / motion.speed().to_f64())
}

/// Impacts whose speeds and radii fill their ranges evenly, in logarithms, as far as they rebound.
fn ensemble(case: &Case) -> Place {
    // The powers of the inverse plastic number (Roberts 2018) spread over a square evenly.
    let plastic = 1.324_717_957_244_746_f64;
    let mut impacts = (1_u32..).filter_map(|index| {
        let at = |power: i32, [from, to]: [f64; 2]| {
            let fraction = (0.5 + f64::from(index) * plastic.powi(-power)).fract();
            from * (to / from).powf(fraction)
        };
        let scaled = case.scaled("speed_normal_m_s", at(1, SPEEDS) / case.number("speed_normal_m_s"));
        let scaled = scaled.scaled("radius_m", at(2, RADII) / case.number("radius_m"));
        let exact = solve_exactly(&scaled).filter(|exact| exact.restitution > LEAST_RESTITUTION)?;
        Some((scaled, exact))
    });
    let (cases, exact): (Vec<_>, Vec<_>) = impacts.by_ref().take(COUNT).unzip();
    Place { axis: ENSEMBLE, value: 0.0, cases: cases.into(), exact }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without adhesion 1 - e d = (1 + d) exp(-d (1 + e)), for any stiffness, mass and speed.
    #[test]
    fn damped_impacts_have_the_restitution_in_closed_form() {
        let table_1 = case("table1");
        for damping in DAMPINGS {
            let place = Place::of(DAMPING, damping, damped(&table_1, damping));
            let product = damping * place.exact[0].restitution;
            let error = 1.0 - product - (1.0 + damping) * (-damping - product).exp();
            assert!(error.abs() < 4.0 * f64::EPSILON, "d = {damping}: {error:e}");
        }
    }
}
