//! What the instrument measures and how it speaks of it. Firmware and host share this file, so that they agree.

use microimpact::instrument::link::{Reply, Request};
use microimpact::instrument::{PlanarReading, SpeedBins};
use microimpact::rigid::WorkOfAdhesion;
use microimpact::{Class, Coulomb, InputError, Real, RigidBody, SpeedRestitution, Sphere};

use crate::table_1::{DENSITY_KG_M3, FRICTION, RADIUS_M, RESTITUTION_SPEED_M_S, WORK_OF_ADHESION_J};

/// Particle and surface.
pub type Scene<T> = RigidBody<T, SpeedRestitution<T>, WorkOfAdhesion<T>, Coulomb<T>>;
/// What the detector delivers.
pub type Event = PlanarReading<f32>;
/// What the host sends.
pub type ToInstrument = Request<Event>;
/// What the instrument answers.
pub type ToHost = Reply<f32, Class>;

/// Number of classes.
pub const CLASSES: usize = 6;
/// Number of bins of speed.
pub const BINS: usize = 6;
/// Bytes for the longest message to the instrument and its checksum.
pub const MESSAGE_BYTES: usize = 32;
/// Bytes of the longest frame to the host, a report.
pub const REPLY_BYTES: usize = 160;
/// One more than the requests that can wait for the main loop.
pub const QUEUE: usize = 64;
/// Turns of a loop of two instructions that stand for other work of a busy main loop, before each request.
pub const OTHER_WORK: u32 = 300_000;

/// Silver-coated glass on steel: Brach & Dunn (1995), Table 1, with R = k/(k + v).
///
/// # Errors
/// None for the values here.
pub fn scene<T: Real>() -> Result<Scene<T>, InputError> {
    let sphere = Sphere::solid(T::constant(RADIUS_M), T::constant(DENSITY_KG_M3))?;
    RigidBody::new(sphere, SpeedRestitution::new(T::constant(RESTITUTION_SPEED_M_S))?)
        .with_work_of_adhesion(T::constant(WORK_OF_ADHESION_J))?
        .with_friction(T::constant(FRICTION))
}

/// Bins of approach speed for the statistics of restitution.
///
/// # Errors
/// None for the values here.
pub fn bins() -> Result<SpeedBins<f32, BINS>, InputError> {
    SpeedBins::new([1.0, 2.0, 4.0, 8.0, 16.0, 32.0])
}
