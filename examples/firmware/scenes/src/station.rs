//! What the instrument measures and how it speaks of it. Firmware and host share this file, so that they agree.

use microimpact::contact::FixedCost;
use microimpact::instrument::link::{Refusal, Reply, Request};
use microimpact::instrument::{PlanarReading, Simulated, SpeedBins};
use microimpact::rigid::WorkOfAdhesion;
use microimpact::{
    AnyModel, Class, Coulomb, InputError, ModelConfig, Real, ReboundAdhesionConfig, RestitutionConfig, RigidBody,
    SceneConfig, SpeedRestitution, Sphere,
};

use crate::table_1::{DENSITY_KG_M3, FRICTION, RADIUS_M, RESTITUTION_SPEED_M_S, WORK_OF_ADHESION_J};

/// Particle and surface that the station starts with.
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
pub const MESSAGE_BYTES: usize = 64;
/// Bytes of the longest frame to the host, a report.
pub const REPLY_BYTES: usize = 184;
/// One more than the requests that can wait for the main loop.
pub const QUEUE: usize = 64;
/// Turns of a loop of two instructions that stand for other work of a busy main loop, before each request.
pub const OTHER_WORK: u32 = 300_000;

/// What the station classifies by: a scene that the host may change, and the method for scenes that are simulated.
pub type Scenes = Simulated<AnyModel<f32>, FixedCost<5, 7>>;

/// Iterations of that method.
const ITERATIONS: u32 = 3;

/// The scene that the station starts with, as it would be configured: that of [`scene`].
pub const SCENE: SceneConfig<f32> = SceneConfig {
    radius: RADIUS_M as f32,
    density: DENSITY_KG_M3 as f32,
    gyration_ratio: 0.4,
    friction: FRICTION as f32,
    model: ModelConfig::RigidBody {
        restitution: RestitutionConfig::Speed { speed: RESTITUTION_SPEED_M_S as f32 },
        adhesion: ReboundAdhesionConfig::Work { work: WORK_OF_ADHESION_J as f32 },
    },
};

/// The classifier of a configuration.
///
/// # Errors
/// A number outside its range.
pub fn classifier(config: &SceneConfig<f32>) -> Result<Scenes, Refusal> {
    Ok(Simulated { scene: config.scene()?, method: FixedCost::<5>::new(ITERATIONS)?.with_outputs() })
}

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
