//! Mean and variance of a stream of numbers by Welford's recurrence.

use crate::Real;

/// Count, mean and variance of numbers that arrive one by one.
///
/// The recurrence is delta = x - mean, mean += delta/n and M2 += delta (x - mean), where the last step uses the new mean
/// (B. P. Welford, Technometrics 4:419-420, 1962). Both sums are compensated: each has a second number for its rounding error.
/// Plain sums in f32 would stop changing after some ten million numbers.
///
/// ```
/// use microimpact::instrument::Statistics;
///
/// let mut restitution = Statistics::<f32>::new();
/// for e in [0.7, 0.8, 0.9] {
///     restitution.add(e);
/// }
/// assert_eq!(restitution.count(), 3);
/// assert!((restitution.mean() - 0.8).abs() < 1e-6);
/// assert!(restitution.variance().is_some_and(|variance| (variance - 0.01).abs() < 1e-6));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Statistics<T> {
    count: u64,
    mean: Sum<T>,
    squares: Sum<T>,
}

impl<T: Real> Statistics<T> {
    /// Creates empty statistics.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::Statistics::<f64>::new().count(), 0);
    /// ```
    pub const fn new() -> Self {
        Self { count: 0, mean: Sum::ZERO, squares: Sum::ZERO }
    }

    /// Adds a number. It must be finite.
    ///
    /// ```
    /// let mut statistics = microimpact::instrument::Statistics::new();
    /// statistics.add(2.0_f64);
    /// assert_eq!(statistics.mean(), 2.0);
    /// ```
    pub fn add(&mut self, x: T) {
        self.count = self.count.saturating_add(1);
        let delta = self.mean.difference(x);
        self.mean.add(delta / T::constant(self.count as f64));
        self.squares.add(delta * self.mean.difference(x));
    }

    /// Adds all numbers of `other` (Chan, Golub and LeVeque, COMPSTAT 1982, 30-41).
    ///
    /// ```
    /// use microimpact::instrument::Statistics;
    ///
    /// let (mut both, mut other) = (Statistics::<f64>::new(), Statistics::new());
    /// both.add(1.0);
    /// other.add(3.0);
    /// both.merge(&other);
    /// assert_eq!((both.count(), both.mean(), both.variance()), (2, 2.0, Some(2.0)));
    /// ```
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        let (own, others) = (self.count as f64, other.count as f64);
        let delta = self.mean.difference(other.mean.large) + other.mean.small;
        self.count = self.count.saturating_add(other.count);
        self.mean.add(delta * T::constant(others / (own + others)));
        self.squares.merge(&other.squares);
        self.squares.add(delta * delta * T::constant(own / (own + others) * others));
    }

    /// Number of numbers added.
    ///
    /// ```
    /// let mut statistics = microimpact::instrument::Statistics::new();
    /// statistics.add(0.5_f32);
    /// assert_eq!(statistics.count(), 1);
    /// ```
    #[inline]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean; zero without numbers.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::Statistics::<f32>::new().mean(), 0.0);
    /// ```
    #[inline]
    pub fn mean(&self) -> T {
        self.mean.large
    }

    /// Unbiased variance M2/(n - 1); `None` for fewer than two numbers.
    ///
    /// ```
    /// let mut statistics = microimpact::instrument::Statistics::<f64>::new();
    /// assert_eq!(statistics.variance(), None);
    /// statistics.add(1.0);
    /// statistics.add(2.0);
    /// assert_eq!(statistics.variance(), Some(0.5));
    /// ```
    pub fn variance(&self) -> Option<T> {
        let freedom = self.count.checked_sub(1).filter(|&freedom| freedom > 0)?;
        Some(self.squares.large.max(T::ZERO) / T::constant(freedom as f64))
    }
}

impl<T: Real> Default for Statistics<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// A compensated sum: the sum and its rounding error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Sum<T> {
    large: T,
    small: T,
}

impl<T: Real> Sum<T> {
    pub(super) const ZERO: Self = Self { large: T::ZERO, small: T::ZERO };

    /// The sum, rounded.
    #[inline]
    pub(super) fn value(&self) -> T {
        self.large
    }

    /// `x` minus this sum.
    #[inline]
    fn difference(&self, x: T) -> T {
        (x - self.large) - self.small
    }

    /// Adds `x`. Only the smaller part is rounded (D. E. Knuth, The Art of Computer Programming 2, 4.2.2).
    #[inline]
    pub(super) fn add(&mut self, x: T) {
        let x = x + self.small;
        let total = self.large + x;
        let part = total - self.large;
        self.small = (self.large - (total - part)) + (x - part);
        self.large = total;
    }

    /// Adds another sum with its rounding error.
    #[inline]
    pub(super) fn merge(&mut self, other: &Self) {
        self.add(other.large);
        self.add(other.small);
    }
}
