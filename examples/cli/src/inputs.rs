//! What a row of a table states: the sphere and its motion, and the restitution of a rigid body.

use microimpact::rigid::{AnyRestitution, ElasticPlasticRestitution, PowerRestitution};
use microimpact::{ConstantRestitution, Real, SpeedRestitution};
use sheet::{Input, Row, Scalar};

/// The numbers of a peeling moment.
pub const PEELING_INPUT: Input = Input::optional(&["peeling_n_m"], "0 N m");

/// The pressure from which a material yields.
pub const YIELD_INPUT: Input = Input::optional(&["yield_pressure_pa"], "not known");

/// The numbers of a restitution law.
pub const RESTITUTION_COLUMNS: [&str; 3] = ["restitution", "restitution_speed_m_s", "yield_speed_m_s"];
pub const RESTITUTION_INPUT: Input = Input::required(&RESTITUTION_COLUMNS);
pub const POWER_INPUT: Input = Input::optional(&["restitution_power"], "1");

/// Coulomb's friction, which both models have.
pub const FRICTION_INPUT: Input = Input::optional(&["friction"], "0");

/// The size of a sphere.
pub const SIZE_INPUT: Input = Input::required(&["radius_m", "diameter_m"]);

/// The radius of the sphere of a row.
pub fn radius<T: Scalar>(row: &Row<'_>) -> Result<T, String> {
    match (row.number("radius_m")?, row.number::<T>("diameter_m")?) {
        (Some(radius), None) => Ok(radius),
        (None, Some(diameter)) => Ok(T::constant(0.5) * diameter),
        (None, None) => Err("radius_m: missing; give radius_m or diameter_m".into()),
        (Some(_), Some(_)) => Err("size: given twice, as radius_m and diameter_m; leave one of them empty".into()),
    }
}

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

/// The restitution law of a row, in numbers that `number` makes of those in its cells.
pub fn restitution_law<T: Scalar, N: Real>(row: &Row<'_>, number: fn(T) -> N) -> Result<AnyRestitution<N>, String> {
    let power = row.number("restitution_power")?.map(number);
    let given = (row.number("restitution")?, row.number("restitution_speed_m_s")?, row.number("yield_speed_m_s")?);
    let law = match given {
        (Some(r), None, None) => ConstantRestitution::new(number(r)).map(Into::into),
        (None, Some(k), None) => match power {
            Some(power) => PowerRestitution::new(number(k), power).map(Into::into),
            None => SpeedRestitution::new(number(k)).map(Into::into),
        },
        (None, None, Some(speed)) => ElasticPlasticRestitution::new(number(speed)).map(Into::into),
        (None, None, None) => {
            return Err("restitution: missing; give restitution, restitution_speed_m_s or yield_speed_m_s".into());
        }
        _ => {
            let columns = "restitution, restitution_speed_m_s and yield_speed_m_s";
            return Err(format!("restitution: given twice; of {columns} leave all but one empty"));
        }
    };
    if power.is_some() && given.1.is_none() {
        return Err("restitution_power: restitution_speed_m_s is missing; give it too or leave the cell empty".into());
    }
    law.map_err(|error| row.reason(error))
}
