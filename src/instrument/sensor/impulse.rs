//! Impulse of an impact on a force sensor.

use super::{ROUNDING, calibration, relative_error, with_relative_errors};
use crate::measure::Estimate;
use crate::{InputError, Parameter, Real};

/// Sum of the samples of a pulse above the baseline, taken with integers in an interrupt.
///
/// ```
/// use microimpact::instrument::sensor::PulseSum;
///
/// let mut pulse = PulseSum::new(2048);
/// for sample in [2048, 2100, 2600, 2300, 2050] {
///     pulse.add(sample);
/// }
/// assert_eq!((pulse.sum(), pulse.samples()), (858, 5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PulseSum {
    baseline: i32,
    sum: i64,
    samples: u32,
}

impl PulseSum {
    /// Creates an empty sum above a `baseline`, in counts of the converter.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::sensor::PulseSum::new(2048).sum(), 0);
    /// ```
    pub const fn new(baseline: i32) -> Self {
        Self { baseline, sum: 0, samples: 0 }
    }

    /// Adds a sample.
    ///
    /// ```
    /// let mut pulse = microimpact::instrument::sensor::PulseSum::new(100);
    /// pulse.add(90);
    /// assert_eq!(pulse.sum(), -10);
    /// ```
    #[inline]
    pub fn add(&mut self, sample: i32) {
        self.sum = self.sum.saturating_add(i64::from(sample) - i64::from(self.baseline));
        self.samples = self.samples.saturating_add(1);
    }

    /// Sum above the baseline, in counts.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::sensor::PulseSum::new(0).sum(), 0);
    /// ```
    #[inline]
    pub fn sum(&self) -> i64 {
        self.sum
    }

    /// Number of samples.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::sensor::PulseSum::new(0).samples(), 0);
    /// ```
    #[inline]
    pub fn samples(&self) -> u32 {
        self.samples
    }
}

/// A force sensor, such as a piezoelectric one, under the surface that the particles hit.
///
/// The impulse is the sum of the samples times the sensitivity. The samples must cover the whole pulse.
///
/// ```
/// use microimpact::instrument::sensor::{ImpulseSensor, PulseSum};
/// use microimpact::measure::Estimate;
///
/// let sensitivity = Estimate { value: 1e-14, standard_error: 1e-16 };
/// let sensor = ImpulseSensor::new(&sensitivity, 2.0, 0.05)?;
/// let mut pulse = PulseSum::new(2048);
/// for sample in [2048, 2100, 2600, 2300, 2050] {
///     pulse.add(sample);
/// }
/// let impulse = sensor.impulse(&pulse)?;
/// assert!((impulse.value - 8.58e-12_f64).abs() < 1e-20);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImpulseSensor<T> {
    sensitivity: Estimate<T>,
    sample_variance: T,
    baseline_error: T,
}

impl<T: Real> ImpulseSensor<T> {
    /// Creates the front end from the impulse of one count in one sample (N s), the `noise` of a sample and the standard error of
    /// the baseline, both in counts. The noise of two samples is independent.
    ///
    /// # Errors
    /// A value is outside its range, or the relative error of the sensitivity exceeds a fifth.
    ///
    /// ```
    /// use microimpact::Parameter;
    /// use microimpact::instrument::sensor::ImpulseSensor;
    /// use microimpact::measure::Estimate;
    ///
    /// let sensitivity = Estimate { value: 1e-14, standard_error: 0.0 };
    /// assert_eq!(ImpulseSensor::new(&sensitivity, -2.0, 0.0).unwrap_err().parameter, Parameter::SignalNoise);
    /// ```
    pub fn new(sensitivity: &Estimate<T>, noise: T, baseline_error: T) -> Result<Self, InputError> {
        let noise = Parameter::SignalNoise.check(noise)?;
        Ok(Self {
            sensitivity: calibration(Parameter::Sensitivity, sensitivity)?,
            sample_variance: noise * noise + T::constant(ROUNDING),
            baseline_error: Parameter::SignalNoise.check(baseline_error)?,
        })
    }

    /// Impulse of a pulse, N s.
    ///
    /// # Errors
    /// The impulse is not positive, or its relative error exceeds a fifth.
    ///
    /// ```
    /// use microimpact::Parameter;
    /// use microimpact::instrument::sensor::{ImpulseSensor, PulseSum};
    /// use microimpact::measure::Estimate;
    ///
    /// let sensor = ImpulseSensor::new(&Estimate { value: 1e-14, standard_error: 0.0 }, 2.0, 0.0)?;
    /// assert_eq!(sensor.impulse(&PulseSum::new(0)).unwrap_err().parameter, Parameter::MeasuredImpulse);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impulse(&self, pulse: &PulseSum) -> Result<Estimate<T>, InputError> {
        let sum = T::constant(pulse.sum as f64);
        let value = Parameter::MeasuredImpulse.check(sum * self.sensitivity.value)?;
        let samples = T::constant(pulse.samples.into());
        let by_noise = (samples * self.sample_variance).sqrt() / sum;
        let by_baseline = samples * self.baseline_error / sum;
        with_relative_errors(value, &[by_noise, by_baseline, relative_error(&self.sensitivity)?])
    }
}
