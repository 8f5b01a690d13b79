//! Impacts in space: on a wall of any direction, and between two spheres.

use microimpact::rigid::Departure;
use microimpact::space::{self, Departing, PairIncidence, WallIncidence};
use microimpact::{InputError, Oblique, Parameter, Sphere};

use crate::error::Error;
use crate::memory;
use crate::status::{Failure, Motion, Status, finish, followed};

/// The motion of a solid sphere in space.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialMotion {
    /// Velocity of the centre, m/s.
    pub velocity: [f32; 3],
    /// Spin, rad/s.
    pub spin: [f32; 3],
}

impl SpatialMotion {
    fn check(self) -> Result<space::SpatialMotion<f32>, InputError> {
        space::SpatialMotion::new(self.velocity, self.spin)
    }
}

impl From<space::SpatialMotion<f32>> for SpatialMotion {
    fn from(motion: space::SpatialMotion<f32>) -> Self {
        Self { velocity: motion.velocity(), spin: motion.spin() }
    }
}

/// The wall that a sphere hits, at rest or moving.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Direction from the wall to the sphere, a vector of length one; within 1e-3 of it, the length is set to one.
    pub normal: [f32; 3],
    /// Velocity of the surface of the wall at the contact, m/s; zeros for a wall at rest.
    pub velocity: [f32; 3],
}

impl Wall {
    /// The incidence of a sphere on a wall that C gives.
    ///
    /// # Safety
    /// As for [`memory::read`].
    unsafe fn read(
        wall: *const Self,
        radius: f32,
        motion: *const SpatialMotion,
    ) -> Result<WallIncidence<f32>, Failure> {
        // SAFETY: the contract of this function.
        let (wall, motion) = unsafe { (followed(memory::read(wall))?, followed(memory::read(motion))?) };
        Ok(wall.incidence(radius, motion)?)
    }

    fn incidence(self, radius: f32, motion: SpatialMotion) -> Result<WallIncidence<f32>, InputError> {
        let wall = space::Wall::moving(self.normal, self.velocity)?;
        // The density has no part in the motion.
        wall.incidence(&Sphere::solid(radius, 1.0)?, &motion.check()?)
    }
}

/// Two solid spheres that collide.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Radius of each sphere, m.
    pub radius: [f32; 2],
    /// Density of each sphere, kg/m^3.
    pub density: [f32; 2],
    /// Direction from the centre of the second sphere to that of the first, a vector of length one; within 1e-3 of it, the
    /// length is set to one.
    pub normal: [f32; 3],
    /// Motion of each sphere before the impact.
    pub motion: [SpatialMotion; 2],
}

impl Pair {
    /// The reduced sphere, and its motion.
    fn incidence(self) -> Result<(Sphere<f32>, PairIncidence<f32>), InputError> {
        let ([first, second], [dense, other]) = (self.radius, self.density);
        let pair = space::Pair::new(Sphere::solid(first, dense)?, Sphere::solid(second, other)?);
        let [first, second] = self.motion;
        Ok((pair.reduced(), pair.incidence(self.normal, [&first.check()?, &second.check()?])?))
    }
}

impl Motion {
    fn of(incidence: &impl Oblique<f32>) -> Self {
        Self {
            approach: incidence.normal().speed(),
            tangential: incidence.tangential(),
            peripheral: incidence.peripheral(),
        }
    }
}

/// The planar result of an impact, as C gives it back.
struct Planar {
    rebound: f32,
    tangential: f32,
}

impl Planar {
    fn new(incidence: &impl Oblique<f32>, restitution: f32, tangential: f32) -> Result<Self, InputError> {
        let restitution = Parameter::Restitution.check(restitution)?;
        let tangential = Parameter::TangentialVelocity.check(tangential)?;
        Ok(Self { rebound: incidence.normal().speed() * restitution, tangential })
    }
}

impl Departing<f32> for Planar {
    fn departure(&self, _before: f32) -> Option<Departure<f32>> {
        Some(Departure { normal: self.rebound, tangential: self.tangential })
    }
}

/// Writes what an incidence makes of the planar result of its impact.
///
/// # Safety
/// As for [`memory::write`].
unsafe fn write_after<I: Oblique<f32>, M: Copy>(
    incidence: impl FnOnce() -> Result<I, Failure>,
    (restitution, tangential): (f32, f32),
    after: *mut M,
    error: *mut Error,
    motions: impl FnOnce(&I, &Planar) -> Option<M>,
) -> Status {
    let computed = || -> Result<(), Failure> {
        let incidence = incidence()?;
        let impact = Planar::new(&incidence, restitution, tangential)?;
        let motions = motions(&incidence, &impact).ok_or(Failure::Status(Status::Unsolved))?;
        // SAFETY: the contract of this function.
        followed(unsafe { memory::write(after, motions) })
    };
    // SAFETY: the contract of this function.
    unsafe { finish(computed(), error) }
}

/// Computes the planar motion of a solid sphere of the given radius (m) that hits a wall. microimpact_classify and
/// microimpact_simulate take it, with a scene of the same radius.
///
/// The plane contains the normal and the velocity with which the contact point slips on the wall. The sphere keeps its velocity
/// across that plane (microimpact_wall_sideways), so that a class such as rolling or resting describes the motion in the plane.
///
/// It is an error with the fault MICROIMPACT_FAULT_RECEDING if the sphere does not approach the wall. Where this fails, nothing
/// is written but the error, which may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_wall_incidence(
    wall: *const Wall,
    radius: f32,
    motion: *const SpatialMotion,
    planar: *mut Motion,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let computed = || -> Result<(), Failure> {
            followed(memory::write(planar, Motion::of(&Wall::read(wall, radius, motion)?)))
        };
        finish(computed(), error)
    }
}

/// Computes the velocity of a solid sphere across the plane of its impact on a wall (m/s), seen from the wall: from what
/// microimpact_wall_incidence takes. The sphere keeps it. So a sphere of MICROIMPACT_CLASS_CAPTURED_RESTING rests only if this
/// velocity is zero, and else rolls sideways with it. Where this fails, nothing is written but the error, which may be null.
/// Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_wall_sideways(
    wall: *const Wall,
    radius: f32,
    motion: *const SpatialMotion,
    sideways: *mut f32,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let computed = || followed(memory::write(sideways, Wall::read(wall, radius, motion)?.sideways()));
        finish(computed(), error)
    }
}

/// Computes the motion in space of a solid sphere after its impact on a wall: from the wall, the radius (m) and the motion that
/// microimpact_wall_incidence took, and from the overall restitution (0 to 1) and the tangential velocity (m/s) that
/// microimpact_classify, microimpact_simulate or microimpact_simulate_compliant returned for its planar motion.
///
/// With a restitution of zero, the sphere stays on the wall. An impact of MICROIMPACT_CLASS_UNDECIDED has that restitution, too,
/// but the motion after it is not known: do not call this function for it.
///
/// The motions before and after may be the same memory. Where this fails, nothing is written but the error, which may be null.
/// Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_wall_after(
    wall: *const Wall,
    radius: f32,
    motion: *const SpatialMotion,
    restitution: f32,
    tangential: f32,
    after: *mut SpatialMotion,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe {
        let incidence = || Wall::read(wall, radius, motion);
        write_after(incidence, (restitution, tangential), after, error, |incidence, impact| {
            incidence.after(impact).map(SpatialMotion::from)
        })
    }
}

/// Computes the reduced sphere of two solid spheres that collide, whose impact on a wall is equivalent to the collision: its
/// radius (m), its density (kg/m^3) and its planar motion. Initialise a scene with this radius and this density;
/// microimpact_classify, microimpact_simulate and microimpact_simulate_compliant then take the planar motion. All other parameters of the scene are those of the
/// contact of the two spheres, and a work of adhesion in joules is that of the relative motion.
///
/// The tangential velocity is that with which the spheres slip on each other, and the peripheral velocity is zero.
///
/// It is an error with the fault MICROIMPACT_FAULT_RECEDING if the spheres do not approach each other. Where this fails, nothing
/// is written but the error, which may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_pair_incidence(
    pair: *const Pair,
    radius: *mut f32,
    density: *mut f32,
    planar: *mut Motion,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let computed = || -> Result<(), Failure> {
            let pair = followed(memory::read(pair))?;
            followed(memory::room(radius))?;
            followed(memory::room(density))?;
            followed(memory::room(planar))?;
            let (reduced, incidence) = pair.incidence()?;
            followed(memory::write(radius, reduced.radius()))?;
            followed(memory::write(density, reduced.density()))?;
            followed(memory::write(planar, Motion::of(&incidence)))
        };
        finish(computed(), error)
    }
}

/// Computes the motions in space of two solid spheres after their collision: from the pair that microimpact_pair_incidence took,
/// and from the overall restitution (0 to 1) and the tangential velocity (m/s) that microimpact_classify, microimpact_simulate or
/// microimpact_simulate_compliant returned for its planar motion. There is room for two motions, those of the first and of the second sphere.
///
/// With a restitution of zero, the spheres stay in contact. An impact of MICROIMPACT_CLASS_UNDECIDED has that restitution, too, but
/// the motions after it are not known: do not call this function for it.
///
/// The motions after the impact may be in the memory of those of the pair. Where this fails, nothing is written but the error,
/// which may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the motions to room for two of them, and nobody else uses them during
/// the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_pair_after(
    pair: *const Pair,
    restitution: f32,
    tangential: f32,
    after: *mut SpatialMotion,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe {
        let incidence = || Ok(followed(memory::read(pair))?.incidence()?.1);
        write_after(incidence, (restitution, tangential), after.cast(), error, |incidence, impact| {
            incidence.after(impact).map(|motions| motions.map(SpatialMotion::from))
        })
    }
}
