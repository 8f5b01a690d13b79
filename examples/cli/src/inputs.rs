//! What a row of a table states: the law of contact of a scene, and the restitution of a rigid body.

use microimpact::contact::AnyLaw;
use microimpact::{ConstantRestitution, Real, RestitutionLaw, SpeedRestitution, Stiffness};
use sheet::{Input, Row, Scalar};

/// The numbers of a law of contact.
pub const LAW_INPUTS: [Input; 5] = [
    Input::required(&["stiffness_pa"]),
    Input::optional(&["adhesion_n_m"], "0 N/m"),
    Input::optional(&["zeta_h"], "0"),
    Input::optional(&["zeta_a"], "0"),
    Input::optional(&["external_force_n"], "0 N"),
];

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

/// The law of contact of a row: Hertz's, with a ring of adhesion if the row gives one of its columns.
pub fn contact_law<T: Scalar>(row: &Row<'_>) -> Result<AnyLaw<T>, String> {
    let stiffness = Stiffness::new(row.required("stiffness_pa")?).map_err(|error| row.reason(error))?;
    let mut law = AnyLaw::hertz(stiffness);
    // The peeling moment is proportional to the damping of the ring.
    if ["adhesion_n_m", "zeta_a", "peeling_n_m"].iter().any(|column| row.text(column).is_some()) {
        law = AnyLaw::ring(stiffness, row.or_zero("adhesion_n_m")?, row.or_zero("zeta_a")?)
            .map_err(|error| row.reason(error))?;
    }
    if let Some(zeta) = row.number("zeta_h")? {
        law = law.with_damping(zeta).map_err(|error| row.reason(error))?;
    }
    let force = row.or_zero("external_force_n")?;
    if force != T::ZERO {
        law = law.with_external_force(force).map_err(|error| row.reason(error))?;
    }
    Ok(law)
}

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
