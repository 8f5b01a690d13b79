//! What all functions share: how they end, motions and classes.

use microimpact::{InputError, NormalMotion, PlanarMotion};

use crate::error::Error;
use crate::memory;

/// How a function has ended.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All is well, and the results are there.
    Ok,
    /// A pointer that is null or misaligned; there is no result.
    Pointer,
    /// A number outside its range: the error says which.
    Input,
    /// The simulation did not come to an end within its budget; nothing was written for this motion.
    Unsolved,
    /// Fewer results fit than there are motions, and those that fit were written; or no trajectory fits.
    Capacity,
    /// A table, a tally or a scene in integers that was never made.
    Unmade,
    /// A choice, of a model or a term, that there is not; or a method that this function does not take: a scene of `iterations` where a
    /// tolerance is needed.
    Choice,
    /// Fewer measurements than a fit needs.
    TooFew,
    /// Measurements that do not determine a parameter.
    Undetermined,
    /// A measurement that no value of a parameter gives.
    Contradiction,
}

/// How a function ends, with its error written where C wants it.
///
/// # Safety
/// As for [`memory::write`].
pub(crate) unsafe fn finish(result: Result<(), Failure>, error: *mut Error) -> Status {
    let (status, detail) = match result {
        Ok(()) => (Status::Ok, Error::NONE),
        Err(Failure::Input(input)) => (Status::Input, input.into()),
        Err(Failure::Index { index, count }) => (Status::Input, Error::beyond(index, count)),
        Err(Failure::Status(status)) => (status, Error::NONE),
    };
    // The error is optional: who does not want it passes null.
    // SAFETY: the contract of this function.
    let _ = unsafe { memory::write(error, detail) };
    status
}

/// Initialises a scene: writes what `filled` makes of the parameters or, if it refuses them, zeros.
///
/// # Safety
/// As for [`memory::read`] of the parameters and [`memory::write`] of the others, but that the parameters and the scene may be the
/// same memory.
pub(crate) unsafe fn initialise<S: Copy + Default, E>(
    parameters: *const S,
    scene: *mut S,
    error: *mut Error,
    filled: impl FnOnce(S) -> Result<S, E>,
) -> Status
where
    Failure: From<E>,
{
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let initialised = || -> Result<(), Failure> {
            let parameters = memory::read(parameters);
            followed(memory::write(scene, S::default()))?;
            followed(memory::write(scene, filled(followed(parameters)?)?))
        };
        finish(initialised(), error)
    }
}

/// Why a function has no results.
pub(crate) enum Failure {
    Input(InputError),
    /// An index of a material that is not one of `count`.
    Index {
        index: u32,
        count: usize,
    },
    Status(Status),
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

/// A pointer that could not be followed.
pub(crate) fn followed<T>(result: Option<T>) -> Result<T, Failure> {
    result.ok_or(Failure::Status(Status::Pointer))
}

/// A motion before the impact.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Approach speed, positive, m/s.
    pub approach: f32,
    /// Tangential velocity, m/s.
    pub tangential: f32,
    /// Peripheral velocity, spin times radius, m/s.
    pub peripheral: f32,
}

impl Motion {
    pub(crate) fn check(self) -> Result<PlanarMotion<f32>, InputError> {
        NormalMotion::new(self.approach)?.with_tangential(self.tangential)?.with_peripheral_velocity(self.peripheral)
    }
}

/// What became of the sphere.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Leaves the surface while its contact point slips.
    ReboundSliding,
    /// Leaves the surface rolling.
    ReboundRolling,
    /// Captured, and slides on.
    CapturedSliding,
    /// Captured, and rolls on.
    CapturedRolling,
    /// Captured and at rest.
    CapturedResting,
    /// Too close to the critical speed to decide.
    Undecided,
}

impl From<microimpact::Class> for Class {
    fn from(class: microimpact::Class) -> Self {
        match class {
            microimpact::Class::ReboundSliding => Self::ReboundSliding,
            microimpact::Class::ReboundRolling => Self::ReboundRolling,
            microimpact::Class::CapturedSliding => Self::CapturedSliding,
            microimpact::Class::CapturedRolling => Self::CapturedRolling,
            microimpact::Class::CapturedResting => Self::CapturedResting,
            microimpact::Class::Undecided => Self::Undecided,
        }
    }
}
