//! The trait that a number type implements, for f32 and f64.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number type that the models can compute with.
///
/// The models use the four arithmetic operations, comparison and the functions of this trait. They never use NaN or infinity
/// to signal anything. So fixed-point numbers, which have neither, and dual numbers, which carry derivatives, can implement
/// this trait.
///
/// A number type may also hold a number of each of several impacts, in *lanes*. Its comparisons are true only if they are true in every
/// lane, and its functions act in each. [`Contact::solve_lanes`](crate::contact::Contact::solve_lanes) takes scenes in such a type. So
/// does [`RigidBody::impact`](crate::RigidBody::impact); [`Impact::lane`](crate::Impact::lane) gives the impact of a lane. What decides
/// by comparisons of its own, as every other method does, is not for it.
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
    /// Smallest positive number with full accuracy.
    const SMALLEST: Self;

    /// Whether the numbers of this type lie at equal distances. What should be near one is then checked more narrowly.
    const IS_FIXED_POINT: bool = false;

    /// Whether it holds a number of each of several impacts, in lanes.
    const HAS_LANES: bool = false;

    /// Converts a constant to the nearest number. A constant outside the range of the type becomes the closest bound.
    fn constant(value: f64) -> Self;

    /// Converts this number to f64, for the value that an error reports.
    fn to_f64(self) -> f64;

    /// Whether this number is neither infinite nor NaN. Always true for a type without these.
    fn is_finite(self) -> bool;

    /// Square root of a non-negative number.
    fn sqrt(self) -> Self;

    /// Square root of a non-negative number, for a standard error. With the feature `approximate-errors` that of `f32` is micromath's,
    /// which is 0 to 6.1 % larger.
    ///
    /// ```
    /// assert_eq!(microimpact::Real::root_of_variance(4.0), 2.0);
    /// ```
    #[inline]
    fn root_of_variance(self) -> Self {
        self.sqrt()
    }

    /// Power 2/5 of a non-negative number. The peak of Hertz's contact depends on this power.
    fn two_fifths_power(self) -> Self;

    /// Exponential function.
    fn exp(self) -> Self;

    /// Natural logarithm of a positive number. By default it has the digits of this type, from a logarithm in double precision.
    ///
    /// ```
    /// assert_eq!(microimpact::Real::ln(1.0_f32), 0.0);
    /// ```
    #[inline]
    fn ln(self) -> Self {
        let start = Self::constant(libm::log(self.to_f64()));
        if start.is_finite() { start + (self * (-start).exp() - Self::ONE) } else { start }
    }

    /// Quotient by a positive divisor. A quotient that would overflow becomes the largest number of the type.
    fn saturating_div(self, divisor: Self) -> Self;

    /// Square root of a non-negative product. A type with few digits rounds only once.
    ///
    /// ```
    /// assert_eq!(microimpact::Real::geometric_mean(2.0_f32, 8.0), 4.0);
    /// ```
    #[inline]
    fn geometric_mean(self, other: Self) -> Self {
        (self * other).sqrt()
    }

    /// Whether this number is above another; of a type with lanes, in any of them.
    ///
    /// ```
    /// assert!(microimpact::Real::any_above(2.0, 1.0));
    /// ```
    #[inline]
    fn any_above(self, other: Self) -> bool {
        self > other
    }

    /// `then` where this number is above another, `otherwise` elsewhere; a type with lanes chooses in each.
    ///
    /// ```
    /// assert_eq!(microimpact::Real::where_above(2.0, 1.0, 5.0, 7.0), 5.0);
    /// ```
    #[inline]
    fn where_above(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self > other { then } else { otherwise }
    }

    /// Absolute value.
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
    ($float:ident, $sqrt:path, $root_of_variance:path, $exp:path, $ln:path, $two_fifths_power:path) => {
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
            fn to_f64(self) -> f64 {
                self as f64
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
            fn root_of_variance(self) -> Self {
                $root_of_variance(self)
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
            fn ln(self) -> Self {
                $ln(self)
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

/// x^(2/5) of zero or a normal number, with an error of one unit in the last place, by multiplications alone.
///
/// A general power function takes ten times as many instructions, and thousands without a floating-point unit.
macro_rules! two_fifths_power {
    ($name:ident, $float:ident, $start:literal, $steps:literal) => {
        #[inline]
        fn $name(x: $float) -> $float {
            // Dividing the exponent by five gives x^(-1/5) with an error of 3 %. Each Newton step squares the error.
            let mut root = $float::from_bits($start - x.to_bits() / 5);
            let fifth = 0.2 * x;
            for _ in 0..$steps {
                let square = root * root;
                root = root * (1.2 - fifth * square * square * root);
            }
            // The last Newton step is taken on the power itself. It also corrects part of the rounding of the power.
            let square = root * root;
            let power = x * root * square;
            power + 0.6 * power * (1.0 - power * square)
        }
    };
}

two_fifths_power!(two_fifths_power_f32, f32, 0x4c2b_ac71, 2);
two_fifths_power!(two_fifths_power_f64, f64, 0x4cb8_a8c1_54c9_8400, 3);

// Safe code without the standard library cannot use the processor's root. libm does on x86, by assembly that is slow between AVX code.
#[cfg(feature = "std")]
impl_real_for_float!(f32, f32::sqrt, root_of_variance_f32, libm::expf, libm::logf, two_fifths_power_f32);
#[cfg(feature = "std")]
impl_real_for_float!(f64, f64::sqrt, Real::sqrt, libm::exp, libm::log, two_fifths_power_f64);
#[cfg(all(not(feature = "std"), not(all(target_arch = "arm", target_abi = "eabihf"))))]
impl_real_for_float!(f32, libm::sqrtf, root_of_variance_f32, libm::expf, libm::logf, two_fifths_power_f32);
#[cfg(all(not(feature = "std"), target_arch = "arm", target_abi = "eabihf"))]
impl_real_for_float!(f32, multiplied_root, root_of_variance_f32, libm::expf, libm::logf, two_fifths_power_f32);
#[cfg(not(feature = "std"))]
impl_real_for_float!(f64, libm::sqrt, Real::sqrt, libm::exp, libm::log, two_fifths_power_f64);

#[inline]
fn root_of_variance_f32(x: f32) -> f32 {
    if cfg!(feature = "approximate-errors") { micromath::F32Ext::sqrt(x) } else { Real::sqrt(x) }
}

/// Square root of zero or a normal number, with an error of one unit in the last place, by multiplications alone.
///
/// On ARM with a floating-point unit, libm computes roots with integers and a table. That takes three times as many
/// instructions and five times as much flash. Safe code cannot use the square-root instruction of the unit.
#[cfg(any(test, all(not(feature = "std"), target_arch = "arm", target_abi = "eabihf")))]
#[inline]
fn multiplied_root(x: f32) -> f32 {
    // micromath halves the exponent, which gives 1/sqrt(x) with an error of 3.5 %. Each Newton step squares the error.
    let mut inverse = micromath::F32Ext::invsqrt(x);
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
            x *= if cfg!(miri) { 1.3 } else { 1.000_013 };
        }
        assert_eq!(multiplied_root(0.0), 0.0);
        assert!((multiplied_root(f32::MAX) / f32::MAX.sqrt() - 1.0).abs() < 1e-6);
    }

    /// Either root is never too small, beyond rounding.
    #[test]
    fn root_of_variance_is_at_most_a_sixteenth_too_large() {
        let largest = if cfg!(feature = "approximate-errors") { 0.0607 } else { 1e-6 };
        let (mut x, mut most) = (1e-30_f32, 0.0_f64);
        while x < 1e30 {
            let error = f64::from(x.root_of_variance()) / f64::from(x).sqrt() - 1.0;
            assert!((-1e-6..largest).contains(&error), "{x:e}: {error:e}");
            most = most.max(error);
            x *= if cfg!(miri) { 1.3 } else { 1.001 };
        }
        assert!(!cfg!(feature = "approximate-errors") || most > 0.05, "{most}");
    }

    #[test]
    fn two_fifths_power_is_exact_to_one_unit() {
        let mut x = 1e-30;
        while x < 1e30 {
            let exact = f64::powf(x, 0.4);
            assert!((Real::two_fifths_power(x) / exact - 1.0).abs() < 4e-15, "{x:e}");
            // f64 cannot represent 0.4, so the reference itself has an error.
            let single = f64::from(Real::two_fifths_power(x as f32));
            let error = (single / f64::powf(f64::from(x as f32), 0.4) - 1.0).abs();
            assert!(error < 1.1 * f64::from(f32::EPSILON), "{x:e}: {error:e}");
            x *= if cfg!(miri) { 1.7 } else { 1.000_7 };
        }
        assert_eq!(Real::two_fifths_power(0.0_f32), 0.0);
        assert_eq!(Real::two_fifths_power(0.0_f64), 0.0);
    }
}
