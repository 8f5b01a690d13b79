//! Events of an instrument that measures size and time, and knows the material.

use crate::error::Error;
use crate::memory;
use crate::scene::{SceneConfig, SceneImpact};
use crate::status::{Failure, Motion, Status, finish, followed};

/// A reading with the time at which it was taken, the size of the particle and its material.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Event {
    /// Value of a clock's counter.
    pub ticks: u32,
    /// Index of the particle's material among the scenes.
    pub material: u32,
    /// Radius of the particle, m; zero for that of the scene.
    pub radius: f32,
    /// Its motion.
    pub motion: Motion,
}

/// What becomes of the particle of an event: the scene at the index of its material, of `count`, with the radius of the event. The
/// other numbers of the scene, a work of adhesion too, stay as they are. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the materials to `count` of them, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_event_classify(
    materials: *const SceneConfig,
    count: usize,
    event: *const Event,
    impact: *mut SceneImpact,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let classified = || -> Result<(), Failure> {
            let event = followed(memory::read(event))?;
            let index = event.material as usize;
            if index >= count {
                return Err(Failure::Index { index: event.material, count });
            }
            let mut scene = followed(memory::read(memory::element(materials, index)))?;
            if event.radius != 0.0 {
                scene.radius = event.radius;
            }
            followed(memory::write(impact, scene.impact(&event.motion.check()?)?))
        };
        finish(classified(), error)
    }
}
