//! What a row of a table states: the sphere and its motion, and the restitution of a rigid body.

use microimpact::{ConstantRestitution, Real, RestitutionLaw, SpeedRestitution};
use sheet::{Input, Row, Scalar};

/// The numbers of a peeling moment.
pub const PEELING_INPUT: Input = Input::optional(&["peeling_n_m"], "0 N m");

/// The numbers of a restitution law.
pub const RESTITUTION_INPUT: Input = Input::required(&["restitution", "restitution_speed_m_s"]);

/// The density of a sphere.
pub const DENSITY_INPUT: Input = Input::required(&["density_kg_m3"]);

/// The moment of inertia of a sphere.
pub const GYRATION_INPUT: Input = Input::optional(&["gyration_ratio"], "0.4, a solid sphere");

/// The motion before an impact.
pub const MOTION_INPUTS: [Input; 3] = [
    Input::required(&["speed_normal_m_s"]),
    Input::optional(&["speed_tangential_m_s"], "0 m/s"),
    Input::optional(&["spin_rad_s"], "0 rad/s"),
];

/// A restitution law, chosen at run time.
#[derive(Clone, Copy)]
pub enum AnyRestitution<T> {
    Constant(ConstantRestitution<T>),
    Speed(SpeedRestitution<T>),
}

impl<T: Real> RestitutionLaw<T> for AnyRestitution<T> {
    fn restitution(&self, speed: T) -> T {
        match self {
            Self::Constant(law) => law.restitution(speed),
            Self::Speed(law) => law.restitution(speed),
        }
    }

    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        match self {
            Self::Constant(law) => law.approach_speed(body_rebound),
            Self::Speed(law) => law.approach_speed(body_rebound),
        }
    }
}

/// The restitution law of a row, in numbers that `number` makes of those in its cells.
pub fn restitution_law<T: Scalar, N: Real>(row: &Row<'_>, number: fn(T) -> N) -> Result<AnyRestitution<N>, String> {
    match (row.number("restitution")?, row.number("restitution_speed_m_s")?) {
        (Some(r), None) => {
            ConstantRestitution::new(number(r)).map(AnyRestitution::Constant).map_err(|error| row.reason(error))
        }
        (None, Some(k)) => {
            SpeedRestitution::new(number(k)).map(AnyRestitution::Speed).map_err(|error| row.reason(error))
        }
        (None, None) => Err("restitution: missing; give restitution or restitution_speed_m_s".into()),
        (Some(_), Some(_)) => {
            Err("restitution: given twice, as restitution and restitution_speed_m_s; leave one of them empty".into())
        }
    }
}
