//! Robust estimates: the median and Tukey's biweight.

use super::CalibrationError;
use crate::{Parameter, Real};

/// An estimated value with its standard error.
///
/// ```
/// use microimpact::measure::Estimate;
///
/// let friction = Estimate { value: 0.15, standard_error: 0.01 };
/// assert!(friction.value > 3.0 * friction.standard_error);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate<T> {
    /// The value.
    pub value: T,
    /// Standard error of the value.
    pub standard_error: T,
}

/// Centre and spread of repeated measurements.
///
/// ```
/// use microimpact::Parameter;
/// use microimpact::measure::Location;
///
/// let spins = [1.44e5, 1.46e5, 1.47e5, 1.45e5, 1.48e5, 9.0e5];
/// let spin = Location::of(Parameter::Spin, spins.into_iter())?;
/// assert!((spin.estimate.value - 1.46e5_f64).abs() < 0.01e5);
/// assert_eq!((spin.count, spin.outliers), (6, 1));
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Location<T> {
    /// The centre.
    pub estimate: Estimate<T>,
    /// Standard deviation of one measurement, computed from the median deviation.
    pub scale: T,
    /// Number of measurements.
    pub count: u32,
    /// Number of outliers: measurements so far from the centre that they have no weight.
    pub outliers: u32,
}

/// Largest number of passes over the data until an estimate converges.
pub(super) const MOST_PASSES: u32 = 50;

/// Standard deviation of a normal distribution divided by its median deviation.
pub(super) const DEVIATION: f64 = 1.482_602_218_505_602;

/// A deviation of more than this number of scales has no weight. With 4.685, the estimate has 95 % of the efficiency of the
/// mean for normal errors.
const CUT: f64 = 4.685;

/// Influence of a measurement on an estimate. Its deviation is in units of the scale.
pub(super) struct Influence<T> {
    /// Weight of the measurement.
    pub(super) weight: T,
    /// Weight times deviation.
    pub(super) psi: T,
    /// Derivative of psi with respect to the deviation.
    pub(super) slope: T,
}

impl<T: Real> Influence<T> {
    /// Tukey's biweight.
    pub(super) fn of(deviation: T) -> Self {
        let ratio = deviation * T::constant(1.0 / CUT);
        let rest = T::ONE - ratio * ratio;
        if rest <= T::ZERO {
            return Self { weight: T::ZERO, psi: T::ZERO, slope: T::ZERO };
        }
        let weight = rest * rest;
        let slope = rest * (T::ONE - T::constant(5.0) * ratio * ratio);
        Self { weight, psi: weight * deviation, slope }
    }
}

/// Converts a count to the number type.
pub(super) fn number<T: Real>(count: u32) -> T {
    T::constant(f64::from(count))
}

/// Median of values that are neither sorted nor stored. Some sixty passes count the values below a trial value.
pub(super) fn median<T: Real>(values: impl Iterator<Item = T> + Clone) -> Option<T> {
    let mut range: Option<(T, T)> = None;
    let mut count = 0_u32;
    for value in values.clone() {
        count += 1;
        range = Some(range.map_or((value, value), |(low, high)| (low.min(value), high.max(value))));
    }
    let range = range?;
    let half = T::constant(0.5);
    // An even number of values has two in the middle.
    let quantile = |enough: u32| {
        let (mut low, mut high) = range;
        if values.clone().filter(|value| *value <= low).count() >= enough as usize {
            return low;
        }
        for _ in 0..80 {
            let middle = low + half * (high - low);
            if middle <= low || middle >= high {
                break;
            }
            if values.clone().filter(|value| *value <= middle).count() >= enough as usize {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    };
    Some(half * (quantile(count.div_ceil(2)) + quantile(count / 2 + 1)))
}

impl<T: Real> Location<T> {
    /// Estimates the centre of the `values` of a `quantity` by Tukey's biweight, starting at the median. Up to half of the
    /// values may be outliers.
    ///
    /// # Errors
    /// A value is outside its range, or there are fewer than three values.
    ///
    /// ```
    /// use microimpact::Parameter;
    /// use microimpact::measure::{CalibrationError, Location};
    ///
    /// let location = |values: [f32; 2]| Location::of(Parameter::Restitution, values.into_iter());
    /// assert_eq!(location([0.5, 0.6]), Err(CalibrationError::TooFew));
    /// ```
    pub fn of(quantity: Parameter, values: impl Iterator<Item = T> + Clone) -> Result<Self, CalibrationError> {
        let (mut count, mut largest) = (0, T::ZERO);
        for value in values.clone() {
            largest = largest.max(quantity.check(value)?.abs());
            count += 1;
        }
        let Some(mut centre) = median(values.clone()).filter(|_| count >= 3) else {
            return Err(CalibrationError::TooFew);
        };
        let from_median = centre;
        let deviation = median(values.clone().map(|value| (value - from_median).abs())).unwrap_or(T::ZERO);
        // If more than half of the values are equal, the median deviation is zero.
        let scale = (T::constant(DEVIATION) * deviation).max(T::constant(16.0) * T::EPSILON * largest).max(T::SMALLEST);
        for _ in 0..MOST_PASSES {
            let (mut step, mut weights) = (T::ZERO, T::ZERO);
            for value in values.clone() {
                let Influence { weight, psi, .. } = Influence::of((value - centre) / scale);
                step = step + psi;
                weights = weights + weight;
            }
            if weights <= T::ZERO {
                return Err(CalibrationError::Undetermined);
            }
            let step = step / weights;
            centre = centre + step * scale;
            if step.abs() <= T::constant(4.0) * T::EPSILON {
                break;
            }
        }
        let (mut squares, mut slopes, mut outliers) = (T::ZERO, T::ZERO, 0);
        for value in values {
            let Influence { weight, psi, slope } = Influence::of((value - centre) / scale);
            squares = squares + psi * psi;
            slopes = slopes + slope;
            outliers += u32::from(weight == T::ZERO);
        }
        if slopes <= T::ZERO {
            return Err(CalibrationError::Undetermined);
        }
        let freedom = number::<T>(count) / number(count - 1);
        let standard_error = scale * (squares * freedom).sqrt() / slopes;
        Ok(Self { estimate: Estimate { value: centre, standard_error }, scale, count, outliers })
    }
}

#[cfg(test)]
mod tests {
    use super::median;

    #[test]
    fn median_of_odd_and_even_numbers() {
        let of = |values: &[f64]| median(values.iter().copied());
        assert_eq!(of(&[]), None);
        assert_eq!(of(&[3.0]), Some(3.0));
        assert_eq!(of(&[2.0, 2.0, 2.0, 9.0]), Some(2.0));
        for (values, expected) in
            [(&[5.0, -1.0, 2.0][..], 2.0), (&[5.0, -1.0, 2.0, 4.0], 3.0), (&[1e300, 1e-300, 0.0, -1e300, 7.0], 1e-300)]
        {
            let found = of(values).unwrap_or(f64::NAN);
            let size = values.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
            assert!((found - expected).abs() <= 1e-15 * size, "{found} {expected}");
        }
    }
}
