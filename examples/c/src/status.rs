//! What all functions share: how they end, motions and classes.

use core::ffi::c_char;

use microimpact::{InputError, NormalMotion, Parameter, PlanarMotion};

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
    /// A table that was never made.
    Unmade,
}

/// How a number misses its range.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// No fault.
    None,
    /// NaN or infinite.
    NotFinite,
    /// Below the smallest valid value.
    TooSmall,
    /// Above the largest valid value.
    TooLarge,
    /// A term that does not go with the others of the scene.
    OtherLaw,
    /// Bodies that do not approach each other along the normal.
    Receding,
    /// Any other fault.
    Other,
}

/// What was wrong with a number.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// Which number, for microimpact_parameter_name.
    pub parameter: u32,
    /// What is wrong with it.
    pub fault: Fault,
    /// Smallest valid value.
    pub smallest: f64,
    /// Largest valid value.
    pub largest: f64,
}

impl Error {
    /// No error.
    pub(crate) const NONE: Self = Self { parameter: 0, fault: Fault::None, smallest: 0.0, largest: 0.0 };
}

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        let (smallest, largest) = error.parameter.range();
        let parameter = Parameter::ALL.iter().position(|parameter| *parameter == error.parameter);
        let fault = match error.fault {
            microimpact::Fault::NotFinite => Fault::NotFinite,
            microimpact::Fault::TooSmall => Fault::TooSmall,
            microimpact::Fault::TooLarge => Fault::TooLarge,
            microimpact::Fault::OtherLaw => Fault::OtherLaw,
            microimpact::Fault::Receding => Fault::Receding,
            _ => Fault::Other,
        };
        Self { parameter: parameter.unwrap_or(Parameter::ALL.len()) as u32, fault, smallest, largest }
    }
}

/// How a function ends, with its error written where C wants it.
///
/// # Safety
/// As for [`memory::write`].
pub(crate) unsafe fn finish(result: Result<(), Failure>, error: *mut Error) -> Status {
    let (status, detail) = match result {
        Ok(()) => (Status::Ok, Error::NONE),
        Err(Failure::Input(input)) => (Status::Input, input.into()),
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
pub(crate) unsafe fn initialise<S: Copy + Default>(
    parameters: *const S,
    scene: *mut S,
    error: *mut Error,
    filled: impl FnOnce(S) -> Result<S, InputError>,
) -> Status {
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
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// Writes the name of a parameter and a zero byte to a buffer, cut off where it is too small, and returns the length of the
/// whole name, zero for a parameter that there is not.
///
/// # Safety
/// The buffer is null or has room for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_parameter_name(parameter: u32, buffer: *mut c_char, capacity: usize) -> usize {
    let name = Parameter::ALL.get(parameter as usize).map_or("", |parameter| parameter.name());
    let Some(room) = capacity.checked_sub(1) else { return name.len() };
    let end = name.len().min(room);
    for (index, byte) in name.bytes().take(room).enumerate() {
        // SAFETY: below the capacity, so there is room by the contract of this function; null is not written to.
        let _ = unsafe { memory::write(memory::element_mut(buffer, index), byte as c_char) };
    }
    // SAFETY: `end` is at most the capacity less one.
    let _ = unsafe { memory::write(memory::element_mut(buffer, end), 0) };
    name.len()
}
