//! The numbers the models compute with.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number type that both models can run in.
///
/// The core uses the four operations, comparison and the few functions below. It never relies on NaN or
/// infinity as a signal, so a type without them (fixed point) or with more behind a value (a dual number)
/// can implement the trait.
///
/// ```
/// use microimpact::Real;
///
/// fn hypotenuse<T: Real>(a: T, b: T) -> T {
///     (a * a + b * b).sqrt()
/// }
/// assert_eq!(hypotenuse(3.0_f32, 4.0), 5.0);
/// assert_eq!(hypotenuse(3.0_f64, 4.0), 5.0);
/// ```
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + 'static
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Distance from one to the next larger number.
    const EPSILON: Self;
    /// Smallest positive number that has its full accuracy.
    const SMALLEST: Self;

    /// The number nearest to a constant; the closest bound where the constant lies outside the type's range.
    fn constant(value: f64) -> Self;

    /// Whether this is a number: neither infinite nor NaN, where the type has those.
    fn is_finite(self) -> bool;

    /// Square root of a number that is not negative.
    fn sqrt(self) -> Self;

    /// `self` to the power 2/5, the exponent of Hertz's contact, for a number that is not negative.
    fn two_fifths_power(self) -> Self;

    /// Exponential function.
    fn exp(self) -> Self;

    /// Quotient, held at the type's largest number where it would overflow; the divisor is positive.
    fn saturating_div(self, divisor: Self) -> Self;

    /// Size without sign.
    #[inline]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The smaller of two numbers.
    #[inline]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two numbers.
    #[inline]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

macro_rules! impl_real_for_float {
    ($float:ident, $sqrt:path, $power:path, $exp:path) => {
        impl Real for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const EPSILON: Self = $float::EPSILON;
            const SMALLEST: Self = $float::MIN_POSITIVE;

            #[inline]
            fn constant(value: f64) -> Self {
                value as $float
            }

            #[inline]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }

            #[inline]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            #[inline]
            fn two_fifths_power(self) -> Self {
                $power(self, 0.4)
            }

            #[inline]
            fn exp(self) -> Self {
                $exp(self)
            }

            #[inline]
            fn saturating_div(self, divisor: Self) -> Self {
                (self / divisor).clamp($float::MIN, $float::MAX)
            }

            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
        }
    };
}

#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
impl_real_for_float!(f32, libm::sqrtf, libm::powf, libm::expf);
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
impl_real_for_float!(f32, multiplied_root, libm::powf, libm::expf);
impl_real_for_float!(f64, libm::sqrt, libm::pow, libm::exp);

/// Square root by multiplications alone, to one unit in the last place, of zero or a normal number.
///
/// On ARM with a floating-point unit libm works in integers and with a table, which takes three times the
/// instructions and five times the flash; the unit's own root is out of reach of safe code.
#[cfg(any(test, all(target_arch = "arm", target_abi = "eabihf")))]
#[inline]
fn multiplied_root(x: f32) -> f32 {
    // Halving the exponent gives 1/sqrt(x) to 3.5 %, each of Newton's steps squares that error.
    let mut inverse = f32::from_bits(0x5f37_5a86 - (x.to_bits() >> 1));
    for _ in 0..2 {
        inverse = inverse * (1.5 - 0.5 * inverse * (x * inverse));
    }
    let root = x * inverse;
    root + 0.5 * inverse * (x - root * root)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::multiplied_root;

    #[test]
    fn root_is_exact_to_one_unit() {
        let mut x = f32::MIN_POSITIVE;
        while x < f32::MAX / 2.0 {
            let exact = f64::from(x).sqrt();
            let unit = f64::from(f32::EPSILON) * 2f64.powi(exact.log2().floor() as i32);
            let error = (f64::from(multiplied_root(x)) - exact).abs() / unit;
            assert!(error <= 1.0, "{x:e}: {error}");
            x *= 1.000_013;
        }
        assert_eq!(multiplied_root(0.0), 0.0);
        assert!((multiplied_root(f32::MAX) / f32::MAX.sqrt() - 1.0).abs() < 1e-6);
    }
}
