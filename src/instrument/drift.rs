//! An alarm for a drift of surface, particles or sensors: a class becomes more or less frequent than a model expects.

use crate::{InputError, Parameter, Real};

/// Direction of a drift.
///
/// ```
/// use microimpact::instrument::{Drift, DriftAlarm};
///
/// let mut alarm = DriftAlarm::new(2.0, 1000.0)?;
/// let found = (0..100).find_map(|_| alarm.observe(true, 0.5).ok().flatten());
/// assert_eq!(found, Some(Drift::MoreFrequent));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Drift {
    /// The class is more frequent than expected.
    MoreFrequent,
    /// The class is less frequent than expected.
    LessFrequent,
}

/// Two Shiryaev-Roberts statistics, one for each direction.
///
/// Each reading multiplies a statistic by its likelihood ratio: the likelihood if the odds p/(1 - p) of the class were multiplied,
/// or divided, by the odds ratio, over the likelihood with the expected probability p. Before that, a weight is added, w = 4 p (1 -
/// p): a reading whose class is certain beforehand has no weight. If both statistics together reach 2 N, they raise the alarm and
/// start again at zero.
///
/// While the expectation is right, the statistics less the sums of the weights are martingales. So the mean sum of the weights
/// between two alarms is at least N, whatever the probabilities of the readings are (Pollak, Ann. Statist. 13:206, 1985). It is
/// larger than N only because the last reading carries the statistics beyond the limit. No weight exceeds one, so that at least N
/// readings lie between two false alarms on average.
///
/// ```
/// use microimpact::instrument::{Drift, DriftAlarm};
///
/// // No more than one false alarm in 10 000 readings. The model expects three rebounds in four; one in two is observed.
/// let mut alarm = DriftAlarm::new(2.0_f32, 10e3)?;
/// let mut readings = 0..;
/// let found = readings.find_map(|reading| alarm.observe(reading % 2 == 0, 0.75).ok().flatten());
/// assert_eq!(found, Some(Drift::LessFrequent));
/// assert!(readings.start < 100);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DriftAlarm<T> {
    odds_ratio: T,
    limit: T,
    more: T,
    less: T,
}

impl<T: Real> DriftAlarm<T> {
    /// Creates an alarm that finds a change of the odds by `odds_ratio` (1.01 to 100) fastest. It raises no more than one false
    /// alarm in `false_alarm_interval` readings on average (10 to 1e12).
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// use microimpact::instrument::DriftAlarm;
    ///
    /// assert!(DriftAlarm::new(2.0, 1e5).is_ok());
    /// assert!(DriftAlarm::new(1.0, 1e5).is_err());
    /// ```
    pub fn new(odds_ratio: T, false_alarm_interval: T) -> Result<Self, InputError> {
        let odds_ratio = Parameter::OddsRatio.check(odds_ratio)?;
        let interval = Parameter::FalseAlarmInterval.check(false_alarm_interval)?;
        Ok(Self { odds_ratio, limit: interval + interval, more: T::ZERO, less: T::ZERO })
    }

    /// Adds a reading: whether the class was observed, and its expected `probability`. Returns the direction of the drift if the
    /// reading raises the alarm.
    ///
    /// # Errors
    /// The probability is outside its range. The statistics do not change.
    ///
    /// ```
    /// use microimpact::instrument::DriftAlarm;
    ///
    /// let mut alarm = DriftAlarm::new(2.0, 1e5)?;
    /// assert_eq!(alarm.observe(true, 0.9), Ok(None));
    /// assert!(alarm.observe(true, f64::NAN).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn observe(&mut self, observed: bool, probability: T) -> Result<Option<Drift>, InputError> {
        let probability = Parameter::Probability.check(probability)?;
        let weight = T::constant(4.0) * probability * (T::ONE - probability);
        let advance = |statistic: T, ratio: T| {
            let observed = if observed { ratio } else { T::ONE };
            (statistic + weight) * observed / (T::ONE + (ratio - T::ONE) * probability)
        };
        self.more = advance(self.more, self.odds_ratio);
        self.less = advance(self.less, T::ONE / self.odds_ratio);
        if self.more + self.less < self.limit {
            return Ok(None);
        }
        let drift = if self.more > self.less { Drift::MoreFrequent } else { Drift::LessFrequent };
        self.reset();
        Ok(Some(drift))
    }

    /// Starts both statistics again, as after a calibration.
    ///
    /// ```
    /// use microimpact::instrument::DriftAlarm;
    ///
    /// let mut alarm = DriftAlarm::new(2.0, 1e5)?;
    /// alarm.observe(true, 0.1)?;
    /// alarm.reset();
    /// assert_eq!(alarm, DriftAlarm::new(2.0, 1e5)?);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn reset(&mut self) {
        (self.more, self.less) = (T::ZERO, T::ZERO);
    }
}
