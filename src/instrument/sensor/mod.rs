//! Front ends of sensors: from integers that an interrupt stores to speed, size and charge with standard errors.
//!
//! | sensor | integers of the interrupt | results |
//! | --- | --- | --- |
//! | [two light beams](Transit) | ticks between two pulses | speed |
//! | [laser Doppler](Doppler) | periods, and ticks that they take | velocity, with its sign if the light is shifted |
//! | [image charge](ImageCharge) | height and width of a pulse | charge and speed; radius of an accelerated particle |
//! | [impulse on a piezo sensor](ImpulseSensor) | sum of samples, and their number | impulse; [radius](radius_from_impulse) |
//!
//! The interrupt needs no floating point. The main loop takes the integers from a [`Queue`](super::Queue) and calls the front end.
//!
//! Standard errors are propagated to first order. A result whose relative error would exceed a fifth is refused, since a
//! quotient of such a number is not normally distributed any more. With the feature `approximate-errors` each propagation in `f32` makes
//! them 0 to 6.1 % larger.

mod charge;
mod clock;
mod doppler;
mod impulse;
mod sizing;
mod transit;

pub use charge::{ChargePulse, ChargedParticle, ImageCharge};
pub use clock::Clock;
pub use doppler::{Doppler, DopplerBurst};
pub use impulse::{ImpulseSensor, PulseSum};
pub use sizing::{SizedImpact, radius_from_impulse};
pub use transit::Transit;

use core::f64::consts::PI;

use crate::measure::Estimate;
use crate::numbers::{cube_root, norm};
use crate::{InputError, Parameter, Real};

/// Variance of the rounding error of an integer.
const ROUNDING: f64 = 1.0 / 12.0;

/// Checks the value of a calibration and its standard error.
fn calibration<T: Real>(parameter: Parameter, estimate: &Estimate<T>) -> Result<Estimate<T>, InputError> {
    let value = parameter.check(estimate.value)?;
    relative_error(estimate)?;
    Ok(Estimate { value, standard_error: estimate.standard_error })
}

/// Relative standard error of a positive number, if it is small enough for first-order propagation.
fn relative_error<T: Real>(estimate: &Estimate<T>) -> Result<T, InputError> {
    let error = Parameter::StandardError.check(estimate.standard_error)?;
    Parameter::RelativeError.check(error.saturating_div(estimate.value.abs().max(T::SMALLEST)))
}

/// A result with the root of the sum of the squares of relative errors.
fn with_relative_errors<T: Real>(value: T, errors: &[T]) -> Result<Estimate<T>, InputError> {
    let standard_error = Parameter::RelativeError.check(norm(errors.iter().copied()))? * value.abs();
    Ok(Estimate { value, standard_error })
}

/// Radius of a sphere of a `mass` (kg) and a `density` (kg/m^3), m.
fn radius_of<T: Real>(mass: T, density: T) -> T {
    cube_root(T::constant(3.0 / (4.0 * PI)) * mass / density)
}
