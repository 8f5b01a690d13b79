//! Counts of the classes by size and speed, compared with what a model expects.

use super::statistics::Sum;
use super::{ClassSet, SizeBins, SpeedBins};
use crate::measure::Estimate;
use crate::{InputError, Parameter, Real};

/// Counts of `CLASSES` classes in `SIZES` bins of radius by `SPEEDS` bins of speed.
///
/// Each count can be compared with its expected value, the sum of the probabilities of that class over the readings. The
/// probabilities may come from a scene and the errors of a reading ([`ClassProbabilities`](crate::measure::ClassProbabilities)),
/// or from a known distribution of particles. The difference has the variance sum p (1 - p) of independent readings.
///
/// The comparison says something only if the observed class does not come from the same scene: a detector that sees the rebound
/// observes it.
///
/// ```
/// use microimpact::Outcome;
/// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
///
/// let mut tally = SizedTally::<f32, 3, 2, 1>::new(SizeBins::new([2e-6, 8e-6])?, SpeedBins::new([10.0])?);
/// for reading in 0..100 {
///     // The model expects as many rebounds as captures. Three in four rebound.
///     let class = if reading % 4 == 0 { Outcome::Capture } else { Outcome::Rebound };
///     tally.record(5e-6, 2.8, class, Some(&[0.5, 0.5, 0.0]))?;
/// }
/// let cell = tally.cell(1, 0).unwrap();
/// assert_eq!((cell.count(Outcome::Rebound), cell.count(Outcome::Capture)), (75, 25));
/// let excess = cell.excess(Outcome::Rebound);
/// assert_eq!((excess.value, excess.standard_error), (25.0, 5.0));
/// assert_eq!(cell.residual(Outcome::Rebound), Some(5.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SizedTally<T, const CLASSES: usize, const SIZES: usize, const SPEEDS: usize> {
    sizes: SizeBins<T, SIZES>,
    speeds: SpeedBins<T, SPEEDS>,
    cells: [[TallyCell<T, CLASSES>; SPEEDS]; SIZES],
    beyond: TallyCell<T, CLASSES>,
}

impl<T: Real, const CLASSES: usize, const SIZES: usize, const SPEEDS: usize> SizedTally<T, CLASSES, SIZES, SPEEDS> {
    /// Creates an empty tally.
    ///
    /// ```
    /// use microimpact::Class;
    /// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    ///
    /// let tally = SizedTally::<f32, 6, 2, 1>::new(SizeBins::new([2e-6, 8e-6])?, SpeedBins::new([10.0])?);
    /// assert_eq!(tally.total().count(Class::ReboundRolling), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn new(sizes: SizeBins<T, SIZES>, speeds: SpeedBins<T, SPEEDS>) -> Self {
        Self { sizes, speeds, cells: [[TallyCell::EMPTY; SPEEDS]; SIZES], beyond: TallyCell::EMPTY }
    }

    /// Counts the observed class of a particle with a `radius` (m) and an approach `speed` (m/s).
    ///
    /// `expected` holds the probability of each class, in the order of [`ClassSet::ALL`]. `None` counts the class without an
    /// expectation: give it for an undecided class, or where the probabilities are not known.
    ///
    /// # Errors
    /// A probability is outside its range. The reading is not counted.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    ///
    /// let mut tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// assert!(tally.record(5e-6, 2.8, Outcome::Undecided, None).is_ok());
    /// assert!(tally.record(5e-6, 2.8, Outcome::Rebound, Some(&[1.5, 0.0, 0.0])).is_err());
    /// assert_eq!(tally.total().readings(), 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn record<C: ClassSet>(
        &mut self,
        radius: T,
        speed: T,
        class: C,
        expected: Option<&[T; CLASSES]>,
    ) -> Result<(), InputError> {
        const { assert!(CLASSES == C::COUNT, "the tally must have as many classes as the classifier") };
        if let Some(expected) = expected {
            for &probability in expected {
                Parameter::Probability.check(probability)?;
            }
        }
        let speed = self.speeds.bin(speed);
        let row = self.sizes.bin(radius).and_then(|size| self.cells.get_mut(size));
        let cell = row.zip(speed).and_then(|(row, speed)| row.get_mut(speed));
        cell.unwrap_or(&mut self.beyond).record(class.index(), expected);
        Ok(())
    }

    /// The cell of a bin of radius and a bin of speed; `None` if there is no such bin.
    ///
    /// ```
    /// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    ///
    /// let tally = SizedTally::<f32, 3, 2, 1>::new(SizeBins::new([2e-6, 8e-6])?, SpeedBins::new([10.0])?);
    /// assert!(tally.cell(1, 0).is_some());
    /// assert!(tally.cell(2, 0).is_none());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn cell(&self, size: usize, speed: usize) -> Option<&TallyCell<T, CLASSES>> {
        self.cells.get(size)?.get(speed)
    }

    /// The particles that are too large or too fast for the bins.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    ///
    /// let mut tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// tally.record(9e-6, 2.8, Outcome::Rebound, None)?;
    /// assert_eq!(tally.beyond().readings(), 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn beyond(&self) -> &TallyCell<T, CLASSES> {
        &self.beyond
    }

    /// All particles together.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    ///
    /// let mut tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// tally.record(5e-6, 2.8, Outcome::Rebound, None)?;
    /// tally.record(9e-6, 2.8, Outcome::Capture, None)?;
    /// assert_eq!(tally.total().readings(), 2);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn total(&self) -> TallyCell<T, CLASSES> {
        let mut total = self.beyond;
        self.cells.iter().flatten().for_each(|cell| total.merge(cell));
        total
    }

    /// The bins of radius.
    ///
    /// ```
    /// # use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    /// let tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// assert_eq!(tally.sizes().edges(), &[8e-6]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn sizes(&self) -> &SizeBins<T, SIZES> {
        &self.sizes
    }

    /// The bins of speed.
    ///
    /// ```
    /// # use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    /// let tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// assert_eq!(tally.speeds().edges(), &[10.0]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn speeds(&self) -> &SpeedBins<T, SPEEDS> {
        &self.speeds
    }
}

/// Counts of the classes in one cell of a [`SizedTally`], with their differences from the expected counts.
///
/// ```
/// use microimpact::Outcome;
/// use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
///
/// let tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
/// assert_eq!(tally.total().count(Outcome::Capture), 0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct TallyCell<T, const CLASSES: usize> {
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    counts: [u64; CLASSES],
    /// Observed less expected counts of the readings that have an expectation.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    excess: [Sum<T>; CLASSES],
    /// Variances of these differences.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    variance: [Sum<T>; CLASSES],
}

/// Least variance of a count for which its residual is nearly normally distributed: the usual limit for the normal
/// approximation of a binomial distribution, n p (1 - p) >= 9.
const LEAST_VARIANCE: f64 = 9.0;

impl<T: Real, const CLASSES: usize> TallyCell<T, CLASSES> {
    const EMPTY: Self = Self { counts: [0; CLASSES], excess: [Sum::ZERO; CLASSES], variance: [Sum::ZERO; CLASSES] };

    fn record(&mut self, class: usize, expected: Option<&[T; CLASSES]>) {
        if let Some(count) = self.counts.get_mut(class) {
            *count = count.saturating_add(1);
        }
        let Some(expected) = expected else { return };
        let sums = self.excess.iter_mut().zip(&mut self.variance);
        for (index, ((excess, variance), &probability)) in sums.zip(expected).enumerate() {
            let observed = if index == class { T::ONE } else { T::ZERO };
            excess.add(observed - probability);
            variance.add(probability * (T::ONE - probability));
        }
    }

    fn merge(&mut self, other: &Self) {
        for (count, others) in self.counts.iter_mut().zip(other.counts) {
            *count = count.saturating_add(others);
        }
        let add = |sums: &mut [Sum<T>; CLASSES], others: &[Sum<T>; CLASSES]| {
            sums.iter_mut().zip(others).for_each(|(sum, other)| sum.merge(other));
        };
        add(&mut self.excess, &other.excess);
        add(&mut self.variance, &other.variance);
    }

    /// Number of particles of a class.
    ///
    /// ```
    /// # use microimpact::{Outcome, instrument::{SizeBins, SizedTally, SpeedBins}};
    /// let mut tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// tally.record(5e-6, 2.8, Outcome::Rebound, None)?;
    /// assert_eq!(tally.total().count(Outcome::Rebound), 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn count<C: ClassSet>(&self, class: C) -> u64 {
        const { assert!(CLASSES == C::COUNT, "the tally must have as many classes as the classifier") };
        self.counts.get(class.index()).copied().unwrap_or(0)
    }

    /// Number of particles of all classes.
    ///
    /// ```
    /// # use microimpact::instrument::{SizeBins, SizedTally, SpeedBins};
    /// let tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// assert_eq!(tally.total().readings(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn readings(&self) -> u64 {
        self.counts.iter().fold(0, |total, &count| total.saturating_add(count))
    }

    /// Number of particles of a class less the expected number. The standard error is that of the number, if the expectation is
    /// right.
    ///
    /// Readings without an expectation do not take part.
    ///
    /// ```
    /// # use microimpact::{Outcome, instrument::{SizeBins, SizedTally, SpeedBins}};
    /// let mut tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// tally.record(5e-6, 2.8, Outcome::Rebound, Some(&[0.5, 0.5, 0.0]))?;
    /// let excess = tally.total().excess(Outcome::Capture);
    /// assert_eq!((excess.value, excess.standard_error), (-0.5, 0.5));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn excess<C: ClassSet>(&self, class: C) -> Estimate<T> {
        const { assert!(CLASSES == C::COUNT, "the tally must have as many classes as the classifier") };
        let of = |sums: &[Sum<T>; CLASSES]| sums.get(class.index()).map_or(T::ZERO, Sum::value);
        Estimate { value: of(&self.excess), standard_error: of(&self.variance).max(T::ZERO).sqrt() }
    }

    /// The [excess](Self::excess) of a class divided by its standard error. If the expectation is right, it is nearly a standard
    /// normal variable. `None` below a variance of 9, where there are too few readings to say so.
    ///
    /// ```
    /// # use microimpact::{Outcome, instrument::{SizeBins, SizedTally, SpeedBins}};
    /// let mut tally = SizedTally::<f32, 3, 1, 1>::new(SizeBins::new([8e-6])?, SpeedBins::new([10.0])?);
    /// for _ in 0..35 {
    ///     tally.record(5e-6, 2.8, Outcome::Rebound, Some(&[0.5, 0.5, 0.0]))?;
    /// }
    /// assert_eq!(tally.total().residual(Outcome::Rebound), None);
    /// tally.record(5e-6, 2.8, Outcome::Rebound, Some(&[0.5, 0.5, 0.0]))?;
    /// assert_eq!(tally.total().residual(Outcome::Rebound), Some(6.0));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn residual<C: ClassSet>(&self, class: C) -> Option<T> {
        let excess = self.excess(class);
        let enough = excess.standard_error * excess.standard_error >= T::constant(LEAST_VARIANCE);
        enough.then(|| excess.value / excess.standard_error)
    }
}
