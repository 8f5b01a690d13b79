//! Fractions of the peak, at which methods for whole phases evaluate a law.

use crate::Real;

/// A coordinate as a fraction m of its peak, with the sums that the potential drop of a polynomial law consists of.
///
/// A potential s^k drops by (1 - m^k) of its peak value. Tables hold (1 - m^k)/(1 - m) for the powers that laws have.
///
/// ```
/// use microimpact::contact::Fraction;
///
/// let fraction = Fraction::new(0.5);
/// assert_eq!((fraction.square, fraction.cubic, fraction.quintic), (0.25, 1.75, 1.9375));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Fraction<T> {
    /// m.
    pub value: T,
    /// m^2.
    pub square: T,
    /// (1 - m^3)/(1 - m).
    pub cubic: T,
    /// (1 - m^5)/(1 - m).
    pub quintic: T,
}

impl<T: Real> Fraction<T> {
    /// A fraction m of 0 to 1.
    ///
    /// ```
    /// assert_eq!(microimpact::contact::Fraction::new(1.0_f32).quintic, 5.0);
    /// ```
    #[inline]
    pub fn new(value: T) -> Self {
        let square = value * value;
        let cubic = T::ONE + value + square;
        Self { value, square, cubic, quintic: T::ONE + value + square * cubic }
    }
}

impl Fraction<f64> {
    /// As [`new`](Self::new), for tables.
    pub(crate) const fn at(value: f64) -> Self {
        let square = value * value;
        let cubic = 1.0 + value + square;
        Self { value, square, cubic, quintic: 1.0 + value + square * cubic }
    }
}
