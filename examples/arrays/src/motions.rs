//! How spheres arrive.

use microimpact::space::{SpatialMotion, Wall, WallIncidence};
use microimpact::{Approach, InputError, NormalMotion, Oblique, PlanarMotion, Sphere, SurfaceMotion};

use crate::Column;

/// The motions of all rows before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motions<'a> {
    /// In a plane.
    Planar {
        /// Approach speed, m/s, positive.
        speed_normal: Column<'a>,
        /// Tangential velocity, m/s.
        speed_tangential: Column<'a>,
        /// Spin, rad/s.
        spin: Column<'a>,
    },
    /// In space, towards a wall of any direction that may move.
    Wall {
        /// Velocity of the centre, m/s.
        velocity: [Column<'a>; 3],
        /// Spin, rad/s.
        spin: [Column<'a>; 3],
        /// Direction from the wall to the sphere, of length one.
        normal: [Column<'a>; 3],
        /// Velocity of the wall, m/s.
        wall_velocity: [Column<'a>; 3],
    },
}

/// The planar motion of a row, and the plane that it lies in.
pub(crate) struct Arrival {
    pub(crate) motion: PlanarMotion<f64>,
    pub(crate) incidence: Option<WallIncidence<f64>>,
}

impl Motions<'_> {
    /// Whether the motions are in space, where neither a peeling moment nor rolling dissipation is known.
    pub(crate) fn are_in_space(&self) -> bool {
        matches!(self, Self::Wall { .. })
    }

    /// The motion of a sphere in a row.
    pub(crate) fn arrival(&self, sphere: &Sphere<f64>, row: usize) -> Result<Arrival, InputError> {
        match self {
            Self::Planar { speed_normal, speed_tangential, spin } => {
                let motion = NormalMotion::new(speed_normal.at(row))?
                    .with_tangential(speed_tangential.at(row))?
                    .with_spin(sphere, spin.at(row))?;
                Ok(Arrival { motion, incidence: None })
            }
            Self::Wall { velocity, spin, normal, wall_velocity } => {
                let [velocity, spin, normal, wall] =
                    [velocity, spin, normal, wall_velocity].map(|columns| Column::vector(columns, row));
                let before = SpatialMotion::new(velocity, spin)?;
                let incidence = Wall::moving(normal, wall)?.incidence(sphere, &before)?;
                let motion = incidence
                    .normal()
                    .with_tangential(incidence.tangential())?
                    .with_peripheral_velocity(incidence.peripheral())?;
                Ok(Arrival { motion, incidence: Some(incidence) })
            }
        }
    }
}

impl Arrival {
    /// How the contact point moves after the impact: a sphere that the plane of the impact shows at rest may roll sideways.
    pub(crate) fn motion_after(&self, in_plane: SurfaceMotion) -> SurfaceMotion {
        match &self.incidence {
            Some(incidence) if in_plane == SurfaceMotion::Resting && incidence.sideways() != 0.0 => {
                SurfaceMotion::Rolling
            }
            _ => in_plane,
        }
    }
}
