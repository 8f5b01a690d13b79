//! How spheres arrive.

use microimpact::space::{Departing, Pair, PairIncidence, SpatialMotion, Wall, WallIncidence};
use microimpact::{Fault, InputError, NormalMotion, Oblique, Parameter, PlanarMotion, Real, Sphere, SurfaceMotion};

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
    /// Of two spheres in space that collide.
    Pair {
        /// Velocities of the centres of the first sphere and of the second, m/s.
        velocities: [[Column<'a>; 3]; 2],
        /// Their spins, rad/s.
        spins: [[Column<'a>; 3]; 2],
        /// Direction from the second sphere to the first, of length one.
        normal: [Column<'a>; 3],
        /// Radius of the second sphere, m.
        radius: Column<'a>,
        /// Its density, kg/m^3.
        density: Column<'a>,
        /// Its squared radius of gyration over its squared radius.
        gyration_ratio: Column<'a>,
    },
}

/// The sphere of a row and its planar motion, and where they are in space. Of two spheres, those of the reduced sphere.
pub(crate) struct Arrival {
    pub(crate) sphere: Sphere<f64>,
    pub(crate) motion: PlanarMotion<f64>,
    pub(crate) place: Place,
}

/// Where an impact takes place.
pub(crate) enum Place {
    Plane,
    Wall(WallIncidence<f64>),
    Pair(PairIncidence<f64>),
}

/// A motion in a plane of the numbers that `at` takes from its columns: those of a row, or of several in lanes.
#[inline]
pub(crate) fn in_plane<T: Real>(
    [speed_normal, speed_tangential, spin]: [&Column<'_>; 3],
    sphere: &Sphere<T>,
    at: impl Fn(&Column<'_>) -> T,
) -> Result<PlanarMotion<T>, InputError> {
    NormalMotion::new(at(speed_normal))?.with_tangential(at(speed_tangential))?.with_spin(sphere, at(spin))
}

/// The same planar motion as a motion of that type.
fn planar(incidence: &impl Oblique<f64>) -> Result<PlanarMotion<f64>, InputError> {
    incidence.normal().with_tangential(incidence.tangential())?.with_peripheral_velocity(incidence.peripheral())
}

impl Motions<'_> {
    /// The arrival of a sphere in a row.
    #[inline]
    pub(crate) fn arrival(&self, sphere: Sphere<f64>, row: usize) -> Result<Arrival, InputError> {
        let vector = |columns| Column::vector(columns, row);
        match self {
            Self::Planar { speed_normal, speed_tangential, spin } => {
                let motion = in_plane([speed_normal, speed_tangential, spin], &sphere, |column| column.at(row))?;
                Ok(Arrival { sphere, motion, place: Place::Plane })
            }
            Self::Wall { velocity, spin, normal, wall_velocity } => {
                let before = SpatialMotion::new(vector(velocity), vector(spin))?;
                let incidence = Wall::moving(vector(normal), vector(wall_velocity))?.incidence(&sphere, &before)?;
                Ok(Arrival { sphere, motion: planar(&incidence)?, place: Place::Wall(incidence) })
            }
            Self::Pair { velocities, spins, normal, radius, density, gyration_ratio } => {
                let second = Sphere::new(radius.at(row), density.at(row), gyration_ratio.at(row))?;
                let motion = |body: usize| SpatialMotion::new(vector(&velocities[body]), vector(&spins[body]));
                let pair = Pair::new(sphere, second);
                let incidence = pair.incidence(vector(normal), [&motion(0)?, &motion(1)?])?;
                Ok(Arrival { sphere: pair.reduced(), motion: planar(&incidence)?, place: Place::Pair(incidence) })
            }
        }
    }
}

impl Place {
    /// How the contact point moves after the impact: a sphere that the plane of the impact shows at rest may roll sideways.
    #[inline]
    pub(crate) fn motion_after(&self, in_plane: SurfaceMotion) -> SurfaceMotion {
        match self {
            Self::Wall(incidence) if in_plane == SurfaceMotion::Resting && incidence.sideways() != 0.0 => {
                SurfaceMotion::Rolling
            }
            _ => in_plane,
        }
    }

    /// The motions in space after an impact of one sphere or two; none in a plane, or where they are not known.
    pub(crate) fn after(&self, impact: &impl Departing<f64>) -> [Option<SpatialMotion<f64>>; 2] {
        match self {
            Self::Plane => [None; 2],
            Self::Wall(incidence) => [incidence.after(impact), None],
            Self::Pair(incidence) => incidence.after(impact).map_or([None; 2], |bodies| bodies.map(Some)),
        }
    }

    /// Checks a number against which a spin about one axis acts: what it does in space is not known.
    pub(crate) fn check_about_one_axis(&self, parameter: Parameter, value: f64) -> Result<(), InputError> {
        match self {
            Self::Plane => Ok(()),
            _ if value == 0.0 => Ok(()),
            _ => Err(InputError { parameter, fault: Fault::OtherLaw, value: value as f32 }),
        }
    }

    /// Checks an external force, which acts on one body.
    pub(crate) fn check_on_one_body(&self, force: f64) -> Result<(), InputError> {
        match self {
            Self::Pair(_) if force != 0.0 => {
                Err(InputError { parameter: Parameter::ExternalForce, fault: Fault::TwoBodies, value: force as f32 })
            }
            _ => Ok(()),
        }
    }
}
