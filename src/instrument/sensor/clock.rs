//! The clock that times the edges of a signal.

use super::{calibration, relative_error, with_relative_errors};
use crate::measure::Estimate;
use crate::{InputError, Parameter, Real};

/// A clock of known frequency whose counter an interrupt, or a capture unit, stores at the edges of a signal.
///
/// ```
/// use microimpact::instrument::sensor::Clock;
/// use microimpact::measure::Estimate;
///
/// let clock = Clock::new(&Estimate { value: 72e6, standard_error: 720.0 }, 0.0)?;
/// let time = clock.time(7200)?;
/// assert!((time.value - 1e-4_f64).abs() < 1e-18);
/// // 1e-5 from the frequency, and sqrt(1/6)/7200 = 5.7e-5 from whole ticks.
/// assert!((time.standard_error / 1e-4 - 5.76e-5).abs() < 1e-7);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Clock<T> {
    frequency: Estimate<T>,
    edge_variance: T,
}

/// Variance of the number of ticks that a clock counts in a time, averaged over the fraction of a tick and the phase of the
/// clock. The number is one of the two nearest integers, with variance p (1 - p), and p is uniform from 0 to 1.
const WHOLE_TICKS: f64 = 1.0 / 6.0;

impl<T: Real> Clock<T> {
    /// Creates a clock from its `frequency` (Hz) and the standard error of the time of one edge, in ticks.
    ///
    /// The error of an edge is that of the signal: noise over slope, and the jitter of an interrupt that reads the counter. That
    /// of whole ticks is added here. Errors of both edges are independent.
    ///
    /// # Errors
    /// A value is outside its range, or the relative error of the frequency exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::Clock;
    /// use microimpact::measure::Estimate;
    ///
    /// assert!(Clock::new(&Estimate { value: 72e6, standard_error: 0.0 }, 2.0).is_ok());
    /// assert!(Clock::new(&Estimate { value: 0.0, standard_error: 0.0 }, 2.0).is_err());
    /// ```
    pub fn new(frequency: &Estimate<T>, edge_error: T) -> Result<Self, InputError> {
        let edge_error = Parameter::EdgeError.check(edge_error)?;
        let frequency = calibration(Parameter::ClockFrequency, frequency)?;
        Ok(Self { frequency, edge_variance: T::constant(2.0) * edge_error * edge_error + T::constant(WHOLE_TICKS) })
    }

    /// Time between two edges that are `ticks` apart, s. From two values of a counter of 32 bits, the ticks are
    /// `second.wrapping_sub(first)`.
    ///
    /// # Errors
    /// There are no ticks, or so few that the relative error exceeds a fifth.
    ///
    /// ```
    /// use microimpact::Parameter;
    /// use microimpact::instrument::sensor::Clock;
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 1e6_f32, standard_error: 0.0 }, 0.0)?;
    /// assert_eq!(clock.time(0).unwrap_err().parameter, Parameter::Ticks);
    /// assert_eq!(clock.time(2).unwrap_err().parameter, Parameter::RelativeError);
    /// assert!(clock.time(3).is_ok());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn time(&self, ticks: u32) -> Result<Estimate<T>, InputError> {
        let ticks = Parameter::Ticks.check(T::constant(ticks.into()))?;
        let edges = self.edge_variance.sqrt() / ticks;
        with_relative_errors(ticks / self.frequency.value, &[edges, relative_error(&self.frequency)?])
    }

    /// Speed over a length that takes this number of ticks, m/s.
    pub(super) fn speed_over(&self, length: &Estimate<T>, ticks: u32) -> Result<Estimate<T>, InputError> {
        let time = self.time(ticks)?;
        with_relative_errors(length.value / time.value, &[relative_error(length)?, relative_error(&time)?])
    }
}
