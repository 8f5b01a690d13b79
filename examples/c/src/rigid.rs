//! The rigid-body model.

use microimpact::rigid::WorkOfAdhesion;
use microimpact::{Coulomb, InputError, RigidBody, SpeedRestitution, Sphere};

use crate::error::Error;
use crate::memory;
use crate::status::{Class, Failure, Motion, Status, finish, followed, initialise};

/// A rigid body with R = k/(k + v), a work of adhesion and friction. Zero leaves a term out.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidScene {
    /// Radius of the sphere, m.
    pub radius: f32,
    /// Its density, kg/m^3.
    pub density: f32,
    /// Speed k of the restitution law, m/s.
    pub restitution_speed: f32,
    /// Work of adhesion, J; may be zero.
    pub work_of_adhesion: f32,
    /// Friction coefficient; may be zero.
    pub friction: f32,
}

type Scene = RigidBody<f32, SpeedRestitution<f32>, WorkOfAdhesion<f32>, Coulomb<f32>>;

impl RigidScene {
    pub(crate) fn check(self) -> Result<Scene, InputError> {
        RigidBody::new(Sphere::solid(self.radius, self.density)?, SpeedRestitution::new(self.restitution_speed)?)
            .with_work_of_adhesion(self.work_of_adhesion)?
            .with_friction(self.friction)
    }
}

/// Initialises a scene with parameters, of which what is left out is zero, and checks every one. The error names the first that
/// is outside its range, and may be null. Where this fails, the scene holds zeros, which every function reports. The parameters
/// and the scene may be the same memory. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_rigid_init(
    parameters: *const RigidScene,
    scene: *mut RigidScene,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { initialise(parameters, scene, error, |parameters| parameters.check().map(|_| parameters)) }
}

/// The class of an impact, and what goes with it. A margin that does not exist is negative.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Classification {
    /// What became of the sphere.
    pub impact_class: Class,
    /// Approach speed over the critical speed.
    pub speed_over_critical: f32,
    /// Friction over the least that ends sliding.
    pub friction_over_limit: f32,
    /// Overall restitution, zero for a capture.
    pub restitution: f32,
    /// Tangential velocity after the impact, m/s.
    pub tangential: f32,
    /// Peripheral velocity after the impact, m/s.
    pub peripheral: f32,
}

/// Classifies an impact of a rigid body. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_classify(
    scene: *const RigidScene,
    motion: *const Motion,
    result: *mut Classification,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let classified = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?.check()?;
            let motion = followed(memory::read(motion))?.check()?;
            let impact = scene.impact(&motion);
            let classification = scene.classify_impact(&impact);
            followed(memory::write(
                result,
                Classification {
                    impact_class: classification.class().into(),
                    speed_over_critical: classification.speed_over_critical.unwrap_or(-1.0),
                    friction_over_limit: classification.contact.friction_over_limit.unwrap_or(-1.0),
                    restitution: impact.normal.overall_restitution(),
                    tangential: impact.tangential.velocity(),
                    peripheral: impact.tangential.peripheral(),
                },
            ))
        };
        finish(classified(), error)
    }
}
