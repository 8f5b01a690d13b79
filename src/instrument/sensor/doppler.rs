//! Velocity from the frequency of a laser Doppler burst.

use super::{Clock, calibration, relative_error};
use crate::measure::Estimate;
use crate::numbers::norm;
use crate::{InputError, Parameter, Real};

/// What a counter measures of a Doppler burst.
///
/// ```
/// use microimpact::instrument::sensor::DopplerBurst;
///
/// assert!(DopplerBurst { periods: 16, ticks: 4000 }.ticks > 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DopplerBurst {
    /// Number of whole periods between two zero crossings.
    pub periods: u32,
    /// Ticks of the clock between these zero crossings.
    pub ticks: u32,
}

/// A laser Doppler velocimeter: two beams that cross at an angle theta make fringes with the spacing lambda/(2 sin(theta/2)).
///
/// A particle that crosses the fringes scatters light with the frequency of velocity over spacing (Albrecht, Borys, Damaschke and
/// Tropea, Laser Doppler and Phase Doppler Measurement Techniques, 2003). If one beam is shifted by a frequency, the fringes
/// move, and the sign of the velocity is known too.
///
/// ```
/// use microimpact::instrument::sensor::{Clock, Doppler, DopplerBurst};
/// use microimpact::measure::Estimate;
///
/// let clock = Clock::new(&Estimate { value: 100e6, standard_error: 0.0 }, 1.0)?;
/// let doppler = Doppler::new(&Estimate { value: 3e-6, standard_error: 0.0 }, 40e6, clock)?;
/// // 39.5 MHz: the particle moves with the fringes, at 1.5 m/s.
/// let velocity = doppler.velocity(&DopplerBurst { periods: 395, ticks: 1000 })?;
/// assert!((velocity.value + 1.5_f64).abs() < 1e-9);
/// assert!((velocity.standard_error - 0.175).abs() < 0.001);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Doppler<T> {
    spacing: Estimate<T>,
    shift: T,
    clock: Clock<T>,
}

impl<T: Real> Doppler<T> {
    /// Creates the front end from the `spacing` of the fringes (m), the frequency `shift` (Hz; zero without) and the clock. The
    /// shift is measured by the same clock, as whose multiple it is best made.
    ///
    /// # Errors
    /// A value is outside its range, or the relative error of the spacing exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::{Clock, Doppler};
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 100e6, standard_error: 0.0 }, 1.0)?;
    /// assert!(Doppler::new(&Estimate { value: -3e-6, standard_error: 0.0 }, 0.0, clock).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(spacing: &Estimate<T>, shift: T, clock: Clock<T>) -> Result<Self, InputError> {
        let spacing = calibration(Parameter::SensorLength, spacing)?;
        Ok(Self { spacing, shift: Parameter::FrequencyShift.check(shift)?, clock })
    }

    /// Velocity of a particle across the fringes, m/s. It is positive against the motion of shifted fringes. Near zero, its
    /// relative error may be large.
    ///
    /// # Errors
    /// There are no periods or ticks, or the relative error of the frequency exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::{Clock, Doppler, DopplerBurst};
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 100e6, standard_error: 0.0 }, 1.0)?;
    /// let doppler = Doppler::new(&Estimate { value: 3e-6, standard_error: 0.0 }, 0.0, clock)?;
    /// let velocity = doppler.velocity(&DopplerBurst { periods: 16, ticks: 1000 })?;
    /// assert!((velocity.value - 4.8_f64).abs() < 1e-9);
    /// assert!(doppler.velocity(&DopplerBurst { periods: 0, ticks: 1000 }).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn velocity(&self, burst: &DopplerBurst) -> Result<Estimate<T>, InputError> {
        let periods = Parameter::SignalCycles.check(T::constant(burst.periods.into()))?;
        let time = self.clock.time(burst.ticks)?;
        let frequency = periods / time.value;
        let value = self.spacing.value * (frequency - self.shift);
        let by_time = self.spacing.value * frequency * relative_error(&time)?;
        let by_spacing = value * relative_error(&self.spacing)?;
        Ok(Estimate { value, standard_error: norm([by_time, by_spacing]) })
    }
}
