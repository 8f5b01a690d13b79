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

    /// Square root of a product that is not negative; a type of few digits rounds once.
    ///
    /// ```
    /// assert_eq!(microimpact::Real::geometric_mean(2.0_f32, 8.0), 4.0);
    /// ```
    #[inline]
    fn geometric_mean(self, other: Self) -> Self {
        (self * other).sqrt()
    }

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
    ($float:ident, $sqrt:path, $exp:path, $two_fifths_power:path) => {
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
                $two_fifths_power(self)
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

/// x^(2/5) of a normal number by multiplications alone, to one unit in the last place; zero for zero.
///
/// A general power takes ten times the instructions, and thousands where there is no floating-point unit.
macro_rules! two_fifths_power {
    ($name:ident, $float:ident, $start:literal, $steps:literal) => {
        #[inline]
        fn $name(x: $float) -> $float {
            // A fifth of the exponent gives x^(-1/5) to 3 %, each of Newton's steps squares that error.
            let mut root = $float::from_bits($start - x.to_bits() / 5);
            let fifth = 0.2 * x;
            for _ in 0..$steps {
                let square = root * root;
                root = root * (1.2 - fifth * square * square * root);
            }
            // The last step is one of the power itself, whose own rounding it takes back in part.
            let square = root * root;
            let power = x * root * square;
            power + 0.6 * power * (1.0 - power * square)
        }
    };
}

two_fifths_power!(two_fifths_power_f32, f32, 0x4c2b_ac71, 2);
two_fifths_power!(two_fifths_power_f64, f64, 0x4cb8_a8c1_54c9_8400, 3);

#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
impl_real_for_float!(f32, libm::sqrtf, libm::expf, two_fifths_power_f32);
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
impl_real_for_float!(f32, multiplied_root, libm::expf, two_fifths_power_f32);
impl_real_for_float!(f64, libm::sqrt, libm::exp, two_fifths_power_f64);

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

    use super::{Real, multiplied_root};

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

    #[test]
    fn two_fifths_power_is_exact_to_one_unit() {
        let mut x = 1e-30;
        while x < 1e30 {
            let exact = f64::powf(x, 0.4);
            assert!((Real::two_fifths_power(x) / exact - 1.0).abs() < 4e-15, "{x:e}");
            // A power by f64 is exact to so much only, as 0.4 is not.
            let single = f64::from(Real::two_fifths_power(x as f32));
            let error = (single / f64::powf(f64::from(x as f32), 0.4) - 1.0).abs();
            assert!(error < 1.1 * f64::from(f32::EPSILON), "{x:e}: {error:e}");
            x *= 1.000_7;
        }
        assert_eq!(Real::two_fifths_power(0.0_f32), 0.0);
        assert_eq!(Real::two_fifths_power(0.0_f64), 0.0);
    }
}
