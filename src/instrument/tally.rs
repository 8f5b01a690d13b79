//! Statistics of an instrument: counts of the classes, restitution by speed, and rejected readings.

use super::{ClassSet, Rejection, SpeedBins, Statistics, Verdict};
use crate::Real;

/// Counts of the readings without a class, by reason.
///
/// ```
/// use microimpact::instrument::Rejections;
///
/// assert_eq!(Rejections { input: 2, unsolved: 1 }.total(), 3);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rejections {
    /// Readings with a value, or with a ratio of forces, outside its range.
    pub input: u64,
    /// Motions for which the method did not converge.
    pub unsolved: u64,
}

impl Rejections {
    /// Number of all readings without a class.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::Rejections::default().total(), 0);
    /// ```
    pub fn total(&self) -> u64 {
        self.input.saturating_add(self.unsolved)
    }
}

/// Counts of `CLASSES` classes, and statistics of the restitution in `BINS` bins of speed.
///
/// A capture counts in its class. It does not count in the statistics of the restitution.
///
/// ```
/// use microimpact::Outcome;
/// use microimpact::instrument::{SpeedBins, Tally, Verdict};
///
/// let mut tally = Tally::<f32, 3, 2>::new(SpeedBins::new([1.0, 10.0])?);
/// tally.record(0.5, &Verdict { class: Outcome::Capture, restitution: Some(0.0) });
/// tally.record(2.0, &Verdict { class: Outcome::Rebound, restitution: Some(0.7) });
/// assert_eq!((tally.count(Outcome::Rebound), tally.count(Outcome::Capture)), (1, 1));
/// assert_eq!(tally.restitution().map(|bin| bin.count()), [0, 1]);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct Tally<T, const CLASSES: usize, const BINS: usize> {
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    classes: [u64; CLASSES],
    bins: SpeedBins<T, BINS>,
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    restitution: [Statistics<T>; BINS],
    beyond: Statistics<T>,
    rejections: Rejections,
    signal_failures: u64,
}

impl<T: Real, const CLASSES: usize, const BINS: usize> Tally<T, CLASSES, BINS> {
    /// Creates an empty tally.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// let tally = Tally::<f32, 6, 1>::new(SpeedBins::new([10.0])?);
    /// assert_eq!(tally.classified(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn new(bins: SpeedBins<T, BINS>) -> Self {
        Self {
            classes: [0; CLASSES],
            bins,
            restitution: [Statistics::new(); BINS],
            beyond: Statistics::new(),
            rejections: Rejections { input: 0, unsolved: 0 },
            signal_failures: 0,
        }
    }

    /// Counts the verdict on an impact with an approach `speed`, m/s.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{SpeedBins, Tally, Verdict};
    ///
    /// let mut tally = Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?);
    /// tally.record(2.0, &Verdict { class: Outcome::Rebound, restitution: None });
    /// assert_eq!((tally.count(Outcome::Rebound), tally.restitution()[0].count()), (1, 0));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn record<C: ClassSet>(&mut self, speed: T, verdict: &Verdict<T, C>) {
        const { assert!(CLASSES == C::COUNT, "the tally must have as many classes as the classifier") };
        if let Some(count) = self.classes.get_mut(verdict.class.index()) {
            *count = count.saturating_add(1);
        }
        if let Some(restitution) = verdict.restitution.filter(|&restitution| restitution > T::ZERO) {
            let bin = self.bins.bin(speed).and_then(|bin| self.restitution.get_mut(bin));
            bin.unwrap_or(&mut self.beyond).add(restitution);
        }
    }

    /// Counts a reading without a class.
    ///
    /// ```
    /// use microimpact::instrument::{Rejection, SpeedBins, Tally};
    ///
    /// let mut tally = Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?);
    /// tally.reject(&Rejection::Unsolved);
    /// assert_eq!(tally.rejections().unsolved, 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn reject(&mut self, rejection: &Rejection) {
        let count = match rejection {
            Rejection::Input(_) => &mut self.rejections.input,
            Rejection::Unsolved => &mut self.rejections.unsolved,
        };
        *count = count.saturating_add(1);
    }

    /// Counts a class line that did not switch.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// let mut tally = Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?);
    /// tally.fail_signal();
    /// assert_eq!(tally.signal_failures(), 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn fail_signal(&mut self) {
        self.signal_failures = self.signal_failures.saturating_add(1);
    }

    /// Number of impacts of a class.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// assert_eq!(Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?).count(Outcome::Capture), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn count<C: ClassSet>(&self, class: C) -> u64 {
        const { assert!(CLASSES == C::COUNT, "the tally must have as many classes as the classifier") };
        self.classes.get(class.index()).copied().unwrap_or(0)
    }

    /// Number of impacts of all classes.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// assert_eq!(Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?).classified(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn classified(&self) -> u64 {
        self.classes.iter().fold(0, |total, &count| total.saturating_add(count))
    }

    /// The bins of speed.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// assert_eq!(Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?).bins().edges(), &[10.0]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn bins(&self) -> &SpeedBins<T, BINS> {
        &self.bins
    }

    /// Statistics of the overall restitution of the rebounds in each bin.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// assert_eq!(Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?).restitution()[0].count(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn restitution(&self) -> &[Statistics<T>; BINS] {
        &self.restitution
    }

    /// Statistics of the overall restitution of the rebounds beyond the last bin.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{SpeedBins, Tally, Verdict};
    ///
    /// let mut tally = Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?);
    /// tally.record(20.0, &Verdict { class: Outcome::Rebound, restitution: Some(0.9) });
    /// assert_eq!(tally.restitution_beyond().count(), 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn restitution_beyond(&self) -> &Statistics<T> {
        &self.beyond
    }

    /// Counts of the readings without a class.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// assert_eq!(Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?).rejections().total(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn rejections(&self) -> Rejections {
        self.rejections
    }

    /// Number of times that the class lines did not switch.
    ///
    /// ```
    /// use microimpact::instrument::{SpeedBins, Tally};
    ///
    /// assert_eq!(Tally::<f32, 3, 1>::new(SpeedBins::new([10.0])?).signal_failures(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn signal_failures(&self) -> u64 {
        self.signal_failures
    }
}
