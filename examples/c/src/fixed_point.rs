//! The rigid-body model in integers, for processors without floating point.

use microimpact::rigid::WorkOfAdhesion;
use microimpact::{Coulomb, FixedPoint, InFixedPoint, InputError, PlanarMotion, RigidBody, SpeedRestitution};

use crate::error::Error;
use crate::memory;
use crate::rigid::RigidScene;
use crate::status::{Class, Failure, Status, finish, followed};

/// One unit in the numbers of MicroimpactFixedMotion and MicroimpactFixedResult: 2^24.
pub const FIXED_ONE: i32 = 1 << 24;

/// Room for a rigid body in integers, which microimpact_fixed_init makes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FixedBody {
    /// What is in it concerns the library alone.
    pub words: [u32; 8],
}

/// What is in the room.
#[derive(Clone, Copy)]
struct Made {
    mark: u32,
    scene: RigidBody<FixedPoint, SpeedRestitution<FixedPoint>, WorkOfAdhesion<FixedPoint>, Coulomb<FixedPoint>>,
}

/// Tells a body from memory in which none was made.
const MARK: u32 = 0x6d69_6678;

const _: () = assert!(size_of::<Made>() == size_of::<FixedBody>());
const _: () = assert!(align_of::<Made>() <= align_of::<FixedBody>());

/// A motion before the impact in 2^-24 of the unit of speed: the approach speed from 0.004 to 8 units, the others up to 8.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FixedMotion {
    /// Approach speed, positive.
    pub approach: i32,
    /// Tangential velocity.
    pub tangential: i32,
    /// Peripheral velocity, spin times radius.
    pub peripheral: i32,
}

/// A class, and what goes with it, in 2^-24. A margin that does not exist is negative.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedResult {
    /// What became of the sphere.
    pub impact_class: Class,
    /// Approach speed over the critical speed; 128 at most.
    pub speed_over_critical: i32,
    /// Friction over the least that ends sliding; 128 at most.
    pub friction_over_limit: i32,
    /// Overall restitution, zero for a capture.
    pub restitution: i32,
    /// Tangential velocity after the impact, in the unit of speed.
    pub tangential: i32,
    /// Peripheral velocity after the impact, in the unit of speed.
    pub peripheral: i32,
}

impl FixedMotion {
    pub(crate) fn check(self) -> Result<PlanarMotion<FixedPoint>, InputError> {
        PlanarMotion::in_units([self.approach, self.tangential, self.peripheral].map(FixedPoint::from_bits))
    }
}

/// Makes a rigid body in integers of a scene and a unit of speed, m/s, near the speeds that occur. This takes floating point; what it
/// makes can be copied, stored and made on another machine of the same byte order. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_fixed_init(
    scene: *const RigidScene,
    unit: f32,
    body: *mut FixedBody,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the body is room for a `Made`.
    unsafe {
        let made = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?.check()?.in_fixed_point(unit)?;
            followed(memory::write(body.cast(), Made { mark: MARK, scene }))
        };
        finish(made(), error)
    }
}

/// Classifies an impact of a rigid body in integers alone; a number that is refused is the exception, of which the error tells in
/// floating point. Velocities are exact to 1e-5 units, and to 1e-4 close to the critical speed. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_fixed_classify(
    body: *const FixedBody,
    motion: *const FixedMotion,
    result: *mut FixedResult,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; `Made` is plain numbers.
    unsafe {
        let classified = || -> Result<(), Failure> {
            let made: Made = followed(memory::read(body.cast()))?;
            if made.mark != MARK {
                return Err(Failure::Status(Status::Unmade));
            }
            let motion = followed(memory::read(motion))?.check()?;
            let impact = made.scene.impact(&motion);
            let classification = made.scene.classify_impact(&impact);
            let margin = |margin: Option<FixedPoint>| margin.map_or(-FIXED_ONE, FixedPoint::to_bits);
            followed(memory::write(
                result,
                FixedResult {
                    impact_class: classification.class().into(),
                    speed_over_critical: margin(classification.speed_over_critical),
                    friction_over_limit: margin(classification.contact.friction_over_limit),
                    restitution: impact.normal.overall_restitution().to_bits(),
                    tangential: impact.tangential.velocity().to_bits(),
                    peripheral: impact.tangential.peripheral().to_bits(),
                },
            ))
        };
        finish(classified(), error)
    }
}
