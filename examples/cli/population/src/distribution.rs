//! Distributions of the properties of a population.

use std::fmt;

use statrs::distribution::{Continuous, ContinuousCDF, Normal};

use crate::quadrature::Rule;

/// Standard deviations beyond which a distribution is cut off. The two tails together hold 2e-9 of it.
const REACH: f64 = 6.0;

/// A normal distribution of a positive quantity begins at this fraction of its mean.
const SMALLEST_FRACTION: f64 = 1e-3;

/// Least relative width of a distribution that is not a single value. Below it, rounding decides.
const NARROWEST: f64 = 1e-9;

/// Quantiles between which the ranges of a continuous distribution lie.
const TAILS: [f64; 2] = [0.001, 0.999];

/// The mass of a sphere is proportional to this power of its diameter.
pub(crate) const MASS: i32 = 3;

/// Larger lengths are not taken for micrometres.
const MOST_MICROMETRES: f64 = 1e4;

/// Relative room beside the smallest and the largest sample.
const ROOM: f64 = 1e-6;

/// A distribution of a quantity.
///
/// ```
/// use population::Distribution;
///
/// let diameter = Distribution::log_normal(5e-6, 1.4)?;
/// assert!((diameter.part(0.0, 5e-6) - 0.5).abs() < 1e-9);
/// // The median by mass is larger: Hatch and Choate 1929.
/// let by_mass = diameter.weighted(3);
/// assert!((by_mass.quantile(0.5) / (5e-6 * (3.0 * 1.4_f64.ln().powi(2)).exp()) - 1.0).abs() < 1e-9);
/// # Ok::<(), population::DistributionError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Distribution {
    shape: Shape,
    /// Values outside this range do not occur.
    range: [f64; 2],
    /// Each value is weighted with this power of itself.
    power: i32,
}

#[derive(Clone, Debug)]
enum Shape {
    Fixed(f64),
    Normal {
        mean: f64,
        deviation: f64,
    },
    /// Median and standard deviation of the logarithm.
    LogNormal {
        median: f64,
        deviation: f64,
    },
    /// In increasing order.
    Samples(Vec<f64>),
}

/// Largest angle of incidence, degrees. At 90 degrees a sphere never arrives.
const LARGEST_ANGLE: f64 = 89.9;

/// Why there is no such distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DistributionError {
    /// A value that is not a number, or infinite.
    NotFinite,
    /// A mean, a median or a sample is zero or negative.
    NotPositive(f64),
    /// A standard deviation is negative.
    NegativeDeviation(f64),
    /// A geometric standard deviation is below one.
    GeometricBelowOne(f64),
    /// There are no samples.
    NoSamples,
    /// One value, or a sample, is no angle of incidence.
    NoIncidence,
    /// No value lies in the range.
    OutsideRange(f64, f64),
    /// A length is outside its range.
    NoLength {
        /// The length, m.
        value: f64,
        /// Smallest and largest valid length, m.
        range: [f64; 2],
    },
    /// A distribution of lengths is wider than their range.
    TooWide {
        /// Between which lengths it lies, m.
        ends: [f64; 2],
        /// Smallest and largest valid length, m.
        range: [f64; 2],
    },
}

impl fmt::Display for DistributionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("must be finite numbers"),
            Self::NotPositive(value) => write!(f, "{value:?} is refused: it must be positive"),
            Self::NegativeDeviation(value) => {
                write!(f, "a standard deviation of {value} is refused: it must not be negative")
            }
            Self::GeometricBelowOne(value) => write!(
                f,
                "a geometric standard deviation of {value} is refused: it must be at least 1, where 1 is no spread"
            ),
            Self::NoSamples => f.write_str("there are no samples"),
            Self::NoIncidence => {
                write!(f, "an angle of incidence must be 0 to {LARGEST_ANGLE} degrees from the normal")
            }
            Self::OutsideRange(low, high) => write!(f, "no value lies in the range {low:e} to {high:e}"),
            Self::NoLength { value, range: [smallest, largest] } => {
                write!(f, "{value:?} m is refused: it must be {smallest:e} to {largest} m")?;
                if (*largest..MOST_MICROMETRES).contains(value) {
                    write!(f, "; enter {value:?} um as {value:?}e-6")?;
                }
                Ok(())
            }
            Self::TooWide { ends: [low, high], range: [smallest, largest] } => write!(
                f,
                "the distribution reaches from {low:.1e} to {high:.1e} m, but must lie within {smallest:e} to {largest} m; \
                 enter a smaller deviation"
            ),
        }
    }
}

impl std::error::Error for DistributionError {}

fn finite(value: f64) -> Result<f64, DistributionError> {
    if value.is_finite() { Ok(value) } else { Err(DistributionError::NotFinite) }
}

fn positive(value: f64) -> Result<f64, DistributionError> {
    if finite(value)? > 0.0 { Ok(value) } else { Err(DistributionError::NotPositive(value)) }
}

impl Distribution {
    /// One value, which may be zero.
    ///
    /// # Errors
    /// The value is not finite.
    pub fn fixed(value: f64) -> Result<Self, DistributionError> {
        Ok(Self::of(Shape::Fixed(finite(value)?)))
    }

    /// A normal distribution of a positive quantity. It begins at a thousandth of its mean; the rest is scaled to one.
    ///
    /// # Errors
    /// The mean is not positive, or the deviation is negative.
    pub fn normal(mean: f64, deviation: f64) -> Result<Self, DistributionError> {
        Self::normal_from(positive(mean)?, deviation, SMALLEST_FRACTION * mean)
    }

    /// A normal distribution of a quantity that is not below `smallest`. The rest is scaled to one.
    ///
    /// # Errors
    /// The deviation is negative, or the mean is below the smallest value.
    pub fn normal_from(mean: f64, deviation: f64, smallest: f64) -> Result<Self, DistributionError> {
        if finite(deviation)? < 0.0 {
            return Err(DistributionError::NegativeDeviation(deviation));
        }
        if deviation <= NARROWEST * finite(mean)?.abs() {
            return Self::fixed(mean)?.within(smallest, f64::INFINITY);
        }
        Self::of(Shape::Normal { mean, deviation }).within(smallest, f64::INFINITY)
    }

    /// A log-normal distribution by its median, which is the geometric mean, and its geometric standard deviation.
    ///
    /// # Errors
    /// The median is not positive, or the geometric standard deviation is below one.
    pub fn log_normal(median: f64, geometric_deviation: f64) -> Result<Self, DistributionError> {
        if finite(geometric_deviation)? < 1.0 {
            return Err(DistributionError::GeometricBelowOne(geometric_deviation));
        }
        let (median, deviation) = (positive(median)?, geometric_deviation.ln());
        Ok(Self::of(if deviation <= NARROWEST { Shape::Fixed(median) } else { Shape::LogNormal { median, deviation } }))
    }

    /// Measured values, each as probable as the others.
    ///
    /// # Errors
    /// There are none, or one of them is not positive.
    pub fn samples(values: Vec<f64>) -> Result<Self, DistributionError> {
        values.iter().try_for_each(|value| positive(*value).map(|_| ()))?;
        Self::samples_of_any_sign(values)
    }

    /// Measured values of a quantity that may be zero or negative, each as probable as the others.
    ///
    /// # Errors
    /// There are none, or one of them is not finite.
    pub fn samples_of_any_sign(mut values: Vec<f64>) -> Result<Self, DistributionError> {
        values.iter().try_for_each(|value| finite(*value).map(|_| ()))?;
        values.sort_by(f64::total_cmp);
        match values[..] {
            [] => Err(DistributionError::NoSamples),
            [value] => Self::fixed(value),
            _ => Ok(Self::of(Shape::Samples(values))),
        }
    }

    fn of(shape: Shape) -> Self {
        Self { shape, range: [f64::NEG_INFINITY, f64::INFINITY], power: 0 }
    }

    /// The distribution of the values above `low` and not above `high`.
    ///
    /// # Errors
    /// There are no such values.
    pub fn within(mut self, low: f64, high: f64) -> Result<Self, DistributionError> {
        self.range = [self.range[0].max(low), self.range[1].min(high)];
        let [start, end] = self.bounds();
        let empty = match &self.shape {
            Shape::Fixed(value) => !(low..=high).contains(value),
            Shape::Samples(_) => self.weighted_samples().is_empty(),
            _ => start >= end,
        };
        if empty { Err(DistributionError::OutsideRange(low, high)) } else { Ok(self) }
    }

    /// The same with each value weighted by a power of itself: the third of a diameter for a distribution by mass.
    pub fn weighted(mut self, power: i32) -> Self {
        self.power += power;
        self
    }

    /// The same in another unit: each value times a positive factor.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.range = self.range.map(|end| end * factor);
        self.shape = match self.shape {
            Shape::Fixed(value) => Shape::Fixed(factor * value),
            Shape::Normal { mean, deviation } => Shape::Normal { mean: factor * mean, deviation: factor * deviation },
            Shape::LogNormal { median, deviation } => Shape::LogNormal { median: factor * median, deviation },
            Shape::Samples(values) => Shape::Samples(values.into_iter().map(|value| factor * value).collect()),
        };
        self
    }

    /// Angles of incidence in radians, of a distribution in degrees: from 0 to 89.9 degrees, and what lies beyond is left out where the
    /// distribution is continuous.
    ///
    /// # Errors
    /// A value that is no such angle, or there are none.
    ///
    /// ```
    /// use population::Distribution;
    ///
    /// let angles = Distribution::fixed(60.0)?.incidence()?;
    /// assert!((angles.quantile(0.5) - 60_f64.to_radians()).abs() < 1e-15);
    /// assert!(Distribution::fixed(90.0)?.incidence().is_err());
    /// # Ok::<(), population::DistributionError>(())
    /// ```
    pub fn incidence(self) -> Result<Self, DistributionError> {
        if self.lone_values().iter().any(|angle| !(0.0..=LARGEST_ANGLE).contains(angle)) {
            return Err(DistributionError::NoIncidence);
        }
        let inside = if self.is_continuous() { self.within(0.0, LARGEST_ANGLE)? } else { self };
        Ok(inside.scaled(1.0_f64.to_radians()))
    }

    /// Lengths in metres, such as the [diameters](crate::DIAMETERS) of spheres: each value lies in a range, and so does the distribution by
    /// mass.
    ///
    /// # Errors
    /// The median, mean or a sample is outside the range, or the distribution is too wide for it.
    ///
    /// ```
    /// use population::{DIAMETERS, Distribution};
    ///
    /// let refused = Distribution::log_normal(8.6, 1.3)?.lengths_within(DIAMETERS).unwrap_err();
    /// assert_eq!(refused.to_string(), "8.6 m is refused: it must be 2e-10 to 2 m; enter 8.6 um as 8.6e-6");
    /// # Ok::<(), population::DistributionError>(())
    /// ```
    pub fn lengths_within(self, range: [f64; 2]) -> Result<Self, DistributionError> {
        let [smallest, largest] = range;
        let is_outside = |value: &f64| !(smallest..=largest).contains(value);
        let stated = match &self.shape {
            Shape::Fixed(value) | Shape::Normal { mean: value, .. } | Shape::LogNormal { median: value, .. } => {
                std::slice::from_ref(value)
            }
            Shape::Samples(values) => values,
        };
        if let Some(value) = stated.iter().copied().find(is_outside) {
            return Err(DistributionError::NoLength { value, range });
        }
        let ends = [self.bounds()[0], self.clone().weighted(MASS).bounds()[1]];
        if ends.iter().any(is_outside) { Err(DistributionError::TooWide { ends, range }) } else { Ok(self) }
    }

    /// The values of a distribution that is not continuous.
    pub fn lone_values(&self) -> Vec<f64> {
        self.weighted_samples().into_iter().map(|(value, _)| value).collect()
    }

    /// Whether there is one value only.
    pub fn is_fixed(&self) -> bool {
        matches!(self.shape, Shape::Fixed(_))
    }

    /// Whether the values have a density.
    pub fn is_continuous(&self) -> bool {
        matches!(self.shape, Shape::Normal { .. } | Shape::LogNormal { .. })
    }

    /// The samples in the range with their weights, whose sum is one; the one value of a fixed distribution.
    pub(crate) fn weighted_samples(&self) -> Vec<(f64, f64)> {
        let values = match &self.shape {
            Shape::Fixed(value) => return vec![(*value, 1.0)],
            Shape::Samples(values) => values,
            _ => return Vec::new(),
        };
        let inside: Vec<_> =
            values.iter().filter(|value| **value > self.range[0] && **value <= self.range[1]).collect();
        // Powers of diameters are small numbers.
        let largest = inside.last().map_or(1.0, |value| **value);
        let weight = |value: f64| (value / largest).powi(self.power);
        let sum: f64 = inside.iter().map(|value| weight(**value)).sum();
        inside.into_iter().map(|value| (*value, weight(*value) / sum)).collect()
    }

    /// The values between which the distribution lies, with tails of 1e-9 cut off.
    pub fn bounds(&self) -> [f64; 2] {
        let [low, high] = match &self.shape {
            Shape::Fixed(value) => return [*value, *value],
            Shape::Samples(_) => {
                let samples = self.weighted_samples();
                let ends = [samples.first(), samples.last()];
                return ends.map(|end| end.map_or(f64::NAN, |(value, _)| *value));
            }
            // The weight moves a normal distribution too, by less than this.
            Shape::Normal { mean, deviation } => {
                let shift = f64::from(self.power) * deviation / mean.abs().max(*deviation);
                [mean - REACH * deviation, mean + (REACH + shift) * deviation]
            }
            Shape::LogNormal { median, deviation } => {
                let shift = f64::from(self.power) * deviation;
                [-REACH, REACH + shift].map(|z| median * (z * deviation).exp())
            }
        };
        [low.max(self.range[0]), high.min(self.range[1])]
    }

    /// The coordinate in which the distribution is nearly symmetric: the logarithm of a log-normal one.
    pub(crate) fn coordinate(&self, value: f64) -> f64 {
        if matches!(self.shape, Shape::LogNormal { .. }) { value.ln() } else { value }
    }

    /// The value at a coordinate.
    pub(crate) fn value(&self, coordinate: f64) -> f64 {
        if matches!(self.shape, Shape::LogNormal { .. }) { coordinate.exp() } else { coordinate }
    }

    /// Integral of the weighted density between two values within the bounds, not scaled to one; by numbers of the size of one.
    fn raw(&self, low: f64, high: f64) -> f64 {
        match self.shape {
            Shape::LogNormal { median, deviation } => {
                let shift = f64::from(self.power) * deviation;
                let z = |value: f64| (value / median).ln() / deviation - shift;
                between(z(low), z(high))
            }
            Shape::Normal { mean, deviation } => {
                partial_moment(self.power, deviation / mean, (low - mean) / deviation, (high - mean) / deviation)
            }
            Shape::Fixed(_) | Shape::Samples(_) => {
                let inside = self.weighted_samples();
                inside.iter().filter(|(value, _)| *value > low && *value <= high).map(|(_, weight)| weight).sum()
            }
        }
    }

    /// The part of the distribution above `low` and not above `high`.
    pub fn part(&self, low: f64, high: f64) -> f64 {
        if !self.is_continuous() {
            return self.raw(low, high);
        }
        let [start, end] = self.bounds();
        let [low, high] = [low, high].map(|limit| limit.max(start).min(end));
        if low >= high { 0.0 } else { (self.raw(low, high) / self.raw(start, end)).min(1.0) }
    }

    /// Density in the coordinate, of a continuous distribution.
    pub(crate) fn density(&self, coordinate: f64) -> f64 {
        let [start, end] = self.bounds();
        let standard = Normal::standard();
        let raw = match self.shape {
            Shape::LogNormal { median, deviation } => {
                let shift = f64::from(self.power) * deviation;
                standard.pdf((coordinate - median.ln()) / deviation - shift) / deviation
            }
            Shape::Normal { mean, deviation } => {
                (coordinate / mean).powi(self.power) * standard.pdf((coordinate - mean) / deviation) / deviation
            }
            Shape::Fixed(_) | Shape::Samples(_) => return 0.0,
        };
        raw / self.raw(start, end)
    }

    /// The least value that is not below a part `p` of the distribution.
    pub fn quantile(&self, p: f64) -> f64 {
        let [mut low, mut high] = self.bounds();
        if !self.is_continuous() {
            let mut sum = 0.0;
            let value = self.weighted_samples().into_iter().find(|(_, weight)| {
                sum += weight;
                sum >= p
            });
            return value.map_or(high, |(value, _)| value);
        }
        let start = low;
        while high - low > 4.0 * f64::EPSILON * high.abs() {
            let middle = self.value(0.5 * (self.coordinate(low) + self.coordinate(high)));
            if middle <= low || middle >= high {
                break;
            }
            if self.part(start, middle) < p {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Edges of a number of ranges that hold all but the tails of positive values, equally spaced in their logarithm; none for one
    /// value.
    pub fn ranges(&self, count: usize) -> Vec<f64> {
        if self.is_fixed() || count == 0 {
            return Vec::new();
        }
        let [low, high] = if self.is_continuous() {
            TAILS.map(|p| self.quantile(p))
        } else {
            // A range does not contain its lower edge.
            let [smallest, largest] = self.bounds();
            [smallest * (1.0 - ROOM), largest * (1.0 + ROOM)]
        };
        let ratio = (high / low).ln() / count as f64;
        (0..=count).map(|index| low * (ratio * index as f64).exp()).collect()
    }

    /// Coordinates and weights of a rule between two coordinates of a continuous distribution, for integrands that rise as a
    /// root at either end.
    pub(crate) fn nodes_of_roots<'a>(
        &'a self,
        [low, high]: [f64; 2],
        rule: &'a Rule,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let half = 0.5 * (high - low);
        rule.on(0.0, std::f64::consts::PI).map(move |(angle, weight)| {
            let coordinate = low + half * (1.0 - angle.cos());
            (coordinate, weight * half * angle.sin() * self.density(coordinate))
        })
    }
}

/// Probability that a standard normal variable lies between two numbers.
fn between(low: f64, high: f64) -> f64 {
    let standard = Normal::standard();
    // Differences of small numbers keep their digits.
    if low > 0.0 { standard.cdf(-low) - standard.cdf(-high) } else { standard.cdf(high) - standard.cdf(low) }
}

/// Mean of (1 + spread z)^power for a standard normal z between two numbers, by the recurrence of its partial moments.
fn partial_moment(power: i32, spread: f64, low: f64, high: f64) -> f64 {
    let standard = Normal::standard();
    let (mut binomial, mut sum) = (1.0, 0.0);
    let mut moments = [between(low, high), standard.pdf(low) - standard.pdf(high)];
    for k in 0..=power {
        sum += binomial * spread.powi(k) * moments[0];
        binomial *= f64::from(power - k) / f64::from(k + 1);
        let next =
            f64::from(k + 1) * moments[0] + low.powi(k + 1) * standard.pdf(low) - high.powi(k + 1) * standard.pdf(high);
        moments = [moments[1], next];
    }
    sum
}
