//! Speed from the transit between two light beams.

use super::{Clock, calibration};
use crate::measure::Estimate;
use crate::{InputError, Parameter, Real};

/// Two light beams across the path of the particles, at a known distance.
///
/// ```
/// use microimpact::instrument::sensor::{Clock, Transit};
/// use microimpact::measure::Estimate;
///
/// let clock = Clock::new(&Estimate { value: 72e6, standard_error: 720.0 }, 1.0)?;
/// let beams = Transit::new(&Estimate { value: 280e-6, standard_error: 1e-6 }, clock)?;
/// let speed = beams.speed(7200)?;
/// assert!((speed.value - 2.8_f64).abs() < 1e-12);
/// assert!((speed.standard_error - 0.01).abs() < 1e-4);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Transit<T> {
    distance: Estimate<T>,
    clock: Clock<T>,
}

impl<T: Real> Transit<T> {
    /// Creates the front end from the `distance` of the beams (m) and the clock.
    ///
    /// # Errors
    /// The distance is outside its range, or its relative error exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::{Clock, Transit};
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 72e6, standard_error: 0.0 }, 0.0)?;
    /// assert!(Transit::new(&Estimate { value: 0.0, standard_error: 0.0 }, clock).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(distance: &Estimate<T>, clock: Clock<T>) -> Result<Self, InputError> {
        Ok(Self { distance: calibration(Parameter::SensorLength, distance)?, clock })
    }

    /// Speed of a particle that takes this number of `ticks` from one beam to the other, m/s.
    ///
    /// # Errors
    /// There are no ticks, or the relative error exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::{Clock, Transit};
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 1e6, standard_error: 0.0 }, 0.0)?;
    /// let beams = Transit::new(&Estimate { value: 1e-3, standard_error: 0.0 }, clock)?;
    /// // The counter went around between the beams.
    /// assert_eq!(beams.speed(4_u32.wrapping_sub(u32::MAX - 495))?.value, 2.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn speed(&self, ticks: u32) -> Result<Estimate<T>, InputError> {
        self.clock.speed_over(&self.distance, ticks)
    }
}
