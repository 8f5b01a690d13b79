//! Numbers that were refused: which, how, and in words.

use core::ffi::c_char;

use microimpact::{InputError, Parameter};

use crate::memory;

/// How a number misses its range. Its number is that of the protocol of instruments, plus one.
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
    /// A thickness above the radius of its sphere.
    ExceedsRadius,
    /// A tolerance below the precision of single precision, 1e-6.
    BelowPrecision,
    /// A tolerance below what the nodes of the method can keep.
    TooFewNodes,
    /// A term that does not go with the others of the scene.
    OtherLaw,
    /// A value that does not rise from point to point.
    OutOfOrder,
    /// A quantity that acts on one body, where two meet.
    TwoBodies,
    /// Bodies that do not approach each other along the normal.
    Receding,
    /// An index beyond the end of a table.
    NotInTable,
    /// A standard error above three tenths of the value.
    TooUncertain,
    /// Any other fault.
    Other,
}

impl From<microimpact::Fault> for Fault {
    fn from(fault: microimpact::Fault) -> Self {
        match fault {
            microimpact::Fault::NotFinite => Self::NotFinite,
            microimpact::Fault::TooSmall => Self::TooSmall,
            microimpact::Fault::TooLarge => Self::TooLarge,
            microimpact::Fault::ExceedsRadius => Self::ExceedsRadius,
            microimpact::Fault::BelowPrecision => Self::BelowPrecision,
            microimpact::Fault::TooFewNodes => Self::TooFewNodes,
            microimpact::Fault::OtherLaw => Self::OtherLaw,
            microimpact::Fault::OutOfOrder => Self::OutOfOrder,
            microimpact::Fault::TwoBodies => Self::TwoBodies,
            microimpact::Fault::Receding => Self::Receding,
            microimpact::Fault::NotInTable => Self::NotInTable,
            microimpact::Fault::TooUncertain => Self::TooUncertain,
            _ => Self::Other,
        }
    }
}

impl Fault {
    /// What is wrong, after "parameter: ".
    fn text(self) -> &'static str {
        match self {
            Self::None => "no fault",
            Self::NotFinite => "not a number, or infinite",
            Self::TooSmall => "below the smallest valid value",
            Self::TooLarge => "above the largest valid value",
            Self::ExceedsRadius => "above the radius of the sphere",
            Self::BelowPrecision => "below the precision of float; at least 1e-6",
            Self::TooFewNodes => "below what the nodes of the method can keep",
            Self::OtherLaw => {
                "does not go with the other terms of the scene; leave it or them out, or choose another law"
            }
            Self::OutOfOrder => "not above that of the point before; sort the points",
            Self::TwoBodies => "acts on one body where two meet; make it zero",
            Self::Receding => "the bodies do not approach; the normal points to the (first) sphere",
            Self::NotInTable => "beyond the end of the table; the first entry has the index 0",
            Self::TooUncertain => "known too badly; its standard error is at most three tenths of it",
            Self::Other => "not valid",
        }
    }
}

/// What was wrong with a number.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// Number of the parameter, as in the protocol of instruments, for microimpact_parameter_name.
    pub parameter: u32,
    /// What is wrong with it.
    pub fault: Fault,
    /// Smallest valid value of the parameter by itself; what other numbers of the scene demand of it, the fault says.
    pub smallest: f64,
    /// Largest valid value.
    pub largest: f64,
    /// The value that was refused.
    pub value: f64,
}

impl Error {
    /// No error.
    pub(crate) const NONE: Self = Self { parameter: 0, fault: Fault::None, smallest: 0.0, largest: 0.0, value: 0.0 };
}

/// The least tolerance in single precision.
const LEAST_TOLERANCE: f64 = 1e-6;

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        let (mut smallest, largest) = error.parameter.range();
        if error.fault == microimpact::Fault::BelowPrecision {
            smallest = LEAST_TOLERANCE;
        }
        let parameter = number(error.parameter);
        Self { parameter, fault: error.fault.into(), smallest, largest, value: error.value.into() }
    }
}

impl Error {
    /// An index of a material that is not one of `count`.
    pub(crate) fn beyond(index: u32, count: usize) -> Self {
        let (parameter, largest) = (number(Parameter::MaterialIndex), count.saturating_sub(1) as f64);
        Self { parameter, fault: Fault::NotInTable, smallest: 0.0, largest, value: index.into() }
    }
}

/// Number of a parameter, as in the protocol of instruments.
fn number(parameter: Parameter) -> u32 {
    Parameter::ALL.iter().position(|other| *other == parameter).unwrap_or(Parameter::ALL.len()) as u32
}

/// Writes parts of a text and a zero byte to a buffer, cut off where it is too small, and returns the length of the whole text.
///
/// # Safety
/// The buffer is null or has room for `capacity` bytes.
unsafe fn write_text<'a>(parts: impl Iterator<Item = &'a str>, buffer: *mut c_char, capacity: usize) -> usize {
    let room = capacity.checked_sub(1);
    let mut length = 0_usize;
    for byte in parts.flat_map(str::bytes) {
        if room.is_some_and(|room| length < room) {
            // SAFETY: below the capacity, so there is room by the contract of this function; null is not written to.
            let _ = unsafe { memory::write(memory::element_mut(buffer, length), byte as c_char) };
        }
        length = length.saturating_add(1);
    }
    if let Some(room) = room {
        // SAFETY: at most the capacity less one.
        let _ = unsafe { memory::write(memory::element_mut(buffer, length.min(room)), 0) };
    }
    length
}

fn numbered(parameter: u32) -> Option<Parameter> {
    Parameter::ALL.get(parameter as usize).copied()
}

/// Writes the name of a parameter and a zero byte to a buffer, cut off where it is too small, and returns the length of the
/// whole name, zero for a parameter that there is not. Re-entrant.
///
/// # Safety
/// The buffer is null or has room for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_parameter_name(parameter: u32, buffer: *mut c_char, capacity: usize) -> usize {
    // SAFETY: the contract of this function.
    unsafe { write_text(numbered(parameter).map(Parameter::name).into_iter(), buffer, capacity) }
}

/// The same for the unit of a parameter, "1" for a ratio. Re-entrant.
///
/// # Safety
/// The buffer is null or has room for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_parameter_unit(parameter: u32, buffer: *mut c_char, capacity: usize) -> usize {
    // SAFETY: the contract of this function.
    unsafe { write_text(numbered(parameter).map(Parameter::unit).into_iter(), buffer, capacity) }
}

/// Writes an error in words, from its parameter and its fault, and a zero byte to a buffer, as "approach speed (m/s): below the smallest
/// valid value", cut off where it is too small, and returns the length of the whole text, zero if there is no error. MICROIMPACT_LARGEST_TEXT bytes are always enough.
/// The numbers are in the error: printf("%s: %g, not %g to %g", text, error.value, error.smallest, error.largest). Re-entrant.
///
/// # Safety
/// The buffer is null or has room for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_describe(
    parameter: u32,
    fault: u32,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    let fault = FAULTS.iter().find(|named| **named as u32 == fault).copied().unwrap_or(Fault::Other);
    let parts = match (fault, numbered(parameter)) {
        (Fault::None, _) => [""; 5],
        (_, Some(parameter)) => [parameter.name(), " (", parameter.unit(), "): ", fault.text()],
        (_, None) => ["a parameter", "", "", ": ", fault.text()],
    };
    // SAFETY: the contract of this function.
    unsafe { write_text(parts.into_iter(), buffer, capacity) }
}

const FAULTS: [Fault; 13] = [
    Fault::None,
    Fault::NotFinite,
    Fault::TooSmall,
    Fault::TooLarge,
    Fault::ExceedsRadius,
    Fault::BelowPrecision,
    Fault::TooFewNodes,
    Fault::OtherLaw,
    Fault::OutOfOrder,
    Fault::TwoBodies,
    Fault::Receding,
    Fault::NotInTable,
    Fault::TooUncertain,
];

/// Room that is enough for every text of microimpact_describe.
pub const LARGEST_TEXT: usize = 160;
