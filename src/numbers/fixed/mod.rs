//! Fixed-point numbers, for processors without floating point.

mod contact;
mod power;
mod rigid;

use core::num::NonZeroU32;
use core::ops::{Add, Div, Mul, Neg, Sub};

use fixed::types::I8F24;

use crate::Real;
pub use contact::FixedPointTerm;
pub use rigid::InFixedPoint;

/// A fixed-point number with 32 bits, 24 of them after the binary point: -128 to 128 in steps of 6e-8.
///
/// Both models compute with this type by the same code as with floating point. Their quantities are divided by units that
/// bring them near one. Sums, products, quotients and roots are rounded to the nearest number. A result outside the range
/// becomes the closest bound; it never wraps. The conversion from floating point can take place at start-up or on the host.
/// It returns an error, which names the quantity, for a value that does not fit.
///
/// What fixed point does not hold is refused: of a scene when it is converted, of an impact when it is solved. Gyration ratios may be
/// 0.2 to 1, friction coefficients up to 7, and velocities along the surface up to 8 units.
///
/// * [`InFixedPoint`] converts the rigid-body model. Approach speeds may be 0.004 to 8 units. The error of velocities is below 1e-5
///   units, and a rebound slower than 1e-6 units may be classified as a capture. The relative error of the speed margin is below 1e-4,
///   for critical speeds from 0.1 to 8 units and R above 0.1. For a slip above 0.1 units, the error of a friction margin m is below
///   1e-5 (1 + m).
/// * It also converts scenes of the simulation, for [`FixedCost`](crate::contact::FixedCost) with four to nine nodes: Hertz's contact,
///   alone or with a ring or DMT's adhesion, with no, hysteretic or viscoelastic damping, with or without Coulomb's friction. An impact
///   is in integers throughout. Its approach speed may be 0.1 to 8 units, and its velocities along the surface up to 50 times the
///   largest normal one. At the unit of speed, and again at the speed of each impact, the strength of adhesion may be up to 0.999 (above
///   that, hardly any energy remains to resolve), and the dampings up to 0.5 of the force at the peak. Adhesion falls with the speed and
///   damping grows, so take another unit where a scene is refused. The result contains a
///   [bound](crate::contact::RunReport::error_bound) of the error of e^2, rounding included. The error of e is at most that bound
///   divided by e. Rounding adds less than 3e-5 units to the error of velocities along the surface and of the spin, and less than
///   1e-4 (1 + m) to that of a friction margin m for a slip above 0.1 units; there is no margin where the slip rounds to zero. The
///   outputs [`Slip`](crate::contact::Slip) and [`Energy`](crate::contact::Energy) are [not
///   supported](crate::contact::Status::Unsupported).
/// * [`DimensionlessImpact::in_fixed_point`](crate::contact::DimensionlessImpact::in_fixed_point) converts one impact with its units, for
///   the class alone: what remains to be done takes fewer instructions. The same limits of adhesion and damping apply.
///
/// SI values, from 1e-10 m to 1e16 Pa, do not fit into a fixed-point number. So the constructors of [`Sphere`](crate::Sphere)
/// and [`NormalMotion`](crate::NormalMotion) refuse this type. If products were rounded down and not to the nearest number,
/// the rounding error of e would be more than 1.4 times as large.
///
/// ```
/// use microimpact::contact::{Contact, FixedCost};
/// use microimpact::{FixedPoint, NormalMotion, Real, Sphere, Stiffness};
///
/// // The set-up uses floating point. The motion uses integers only.
/// let scene = Contact::hertz(Sphere::solid(5.06e-6_f32, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let impact = scene.dimensionless(&NormalMotion::new(2.8)?)?.in_fixed_point()?;
/// let contact = impact.solve(&FixedCost::<4>::new(2)?);
/// let (e, error) = (contact.overall_restitution().to_f64(), contact.error_bound.to_f64());
/// assert!((e * e - 0.746193_f64.powi(2)).abs() <= error && error < 1.8e-3);
/// // A product that is too large does not wrap.
/// let large = FixedPoint::nearest(100.0);
/// assert!(large * large > large && -(large * large) < -large);
/// // A sphere in SI units does not fit.
/// assert!(Sphere::solid(FixedPoint::nearest(5.06e-6), FixedPoint::ONE).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FixedPoint(pub I8F24);

/// Bits after the binary point.
const FRACTION: u32 = I8F24::FRAC_NBITS;

impl FixedPoint {
    /// Converts `value` to the nearest number, or to the closest bound. NaN becomes zero.
    ///
    /// The function can be evaluated at compile time.
    ///
    /// ```
    /// use microimpact::FixedPoint;
    ///
    /// const HALF: FixedPoint = FixedPoint::nearest(0.5);
    /// assert_eq!(HALF.to_f64(), 0.5);
    /// assert_eq!(FixedPoint::nearest(-1e9).to_f64(), -128.0);
    /// ```
    pub const fn nearest(value: f64) -> Self {
        let units = value * (1_u64 << FRACTION) as f64;
        let half = if units < 0.0 { -0.5 } else { 0.5 };
        // The conversion of a float saturates.
        Self(I8F24::from_bits((units + half) as i32))
    }

    /// Converts the number to f64, without error.
    ///
    /// ```
    /// assert_eq!(microimpact::FixedPoint::nearest(-3.25).to_f64(), -3.25);
    /// ```
    pub const fn to_f64(self) -> f64 {
        self.0.to_bits() as f64 / (1_u64 << FRACTION) as f64
    }

    /// The number of `units` of 2^-24.
    ///
    /// ```
    /// assert_eq!(microimpact::FixedPoint::from_bits(1 << 23).to_f64(), 0.5);
    /// ```
    pub const fn from_bits(units: i32) -> Self {
        Self(I8F24::from_bits(units))
    }

    /// The number in units of 2^-24.
    ///
    /// ```
    /// assert_eq!(microimpact::FixedPoint::nearest(0.5).to_bits(), 1 << 23);
    /// ```
    pub const fn to_bits(self) -> i32 {
        self.0.to_bits()
    }

    /// Rounds a product with 48 fractional bits to the nearest number, or to the closest bound.
    #[inline]
    fn rounded(product: i64) -> Self {
        let product = product + (1 << (FRACTION - 1));
        let high = (product >> 32) as i32;
        // The test for saturation uses one word and no branch, so that the compiler can move products out of loops.
        let fits = high >> (FRACTION - 1) == high >> 31;
        let units = if fits { (product >> FRACTION) as i32 } else { i32::MAX ^ (high >> 31) };
        Self(I8F24::from_bits(units))
    }

    /// The number with these bits, or the closest bound.
    #[inline]
    fn saturated(units: i64) -> Self {
        let (narrow, bound) = (units as i32, i32::MAX ^ (units >> 63) as i32);
        Self(I8F24::from_bits(if i64::from(narrow) == units { narrow } else { bound }))
    }
}

impl Neg for FixedPoint {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(self.0.saturating_neg())
    }
}

impl Add for FixedPoint {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl Sub for FixedPoint {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

impl Mul for FixedPoint {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        if MULTIPLIES_HALVES {
            return Self(I8F24::from_bits(product_by_halves(self.0.to_bits(), other.0.to_bits())));
        }
        Self::rounded(self.0.wide_mul(other.0).to_bits())
    }
}

impl Div for FixedPoint {
    type Output = Self;

    #[inline(never)]
    fn div(self, other: Self) -> Self {
        let (dividend, divisor) = (self.0.to_bits(), other.0.to_bits());
        let magnitude = divisor.unsigned_abs();
        let scaled = (u64::from(dividend.unsigned_abs()) << FRACTION) + u64::from(magnitude >> 1);
        let size = i64::from(quotient(scaled, magnitude));
        Self::saturated(if (dividend ^ divisor) < 0 { -size } else { size })
    }
}

/// Whether the processor has no product of 64 bits: Cortex-M0. It also lacks what atomics need, which can be asked for.
const MULTIPLIES_HALVES: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// The product as by [`FixedPoint::rounded`], from products of halves: one with 64 bits would be a call, and rounding it more code.
#[inline(never)]
fn product_by_halves(a: i32, b: i32) -> i32 {
    let ((a_high, a_low), (b_high, b_low)) = ((a >> 16, a & 0xffff), (b >> 16, b & 0xffff));
    let (high, first, second) = (a_high * b_high, a_high * b_low, a_low * b_high);
    // In units of 2^16: what is below does not change the rounding.
    let low = ((a_low as u32 * b_low as u32) >> 16) as i32;
    let rest = (first & 0xff) + (second & 0xff) + low + (1 << (FRACTION - 17));
    let middle = (first >> 8) + (second >> 8) + (rest >> 8);
    // The middle is below a quarter of the range.
    if (high + (1 << 22)) as u32 <= 1 << 23 {
        return (high << 8) + middle;
    }
    FixedPoint::saturated((i64::from(high) << 8) + i64::from(middle)).0.to_bits()
}

/// Quotient of 64 by 32 bits, computed as two digits of 16 bits. It is the largest number of 32 bits if it would be larger,
/// or if the divisor is zero.
///
/// Processors divide 32 by 32 bits. A general division of 64 bits takes four times as many instructions.
#[inline]
fn quotient(dividend: u64, divisor: u32) -> u32 {
    if (dividend >> 32) as u32 >= divisor {
        return u32::MAX;
    }
    let shift = divisor.leading_zeros();
    let (dividend, divisor) = (dividend << shift, divisor << shift);
    let (Some(upper), lower) = (NonZeroU32::new(divisor >> 16), divisor & 0xffff) else {
        return u32::MAX;
    };
    // One digit of the quotient, and the remainder.
    let digit = |high: u32, next: u32| {
        let (mut digit, mut rest) = (high / upper, high % upper);
        // The upper half of the divisor gives a digit that is at most two too large.
        for _ in 0..2 {
            if rest <= 0xffff && (digit > 0xffff || digit * lower > (rest << 16 | next)) {
                digit -= 1;
                rest += upper.get();
            }
        }
        (digit, (high << 16 | next).wrapping_sub(digit.wrapping_mul(divisor)))
    };
    let low = dividend as u32;
    let (first, rest) = digit((dividend >> 32) as u32, low >> 16);
    let (second, _) = digit(rest, low & 0xffff);
    first << 16 | second
}

/// The number nearest to the root of a square with 48 fractional bits; zero if the square is negative.
#[inline(never)]
fn nearest_root(square: i64) -> FixedPoint {
    let square = square.max(0).unsigned_abs();
    // After normalization, the root of the upper word gives the upper half of the root. A division gives the lower half.
    let shift = square.leading_zeros() & 62;
    let normal = square << shift;
    let Some(high) = NonZeroU32::new((normal >> 32) as u32) else {
        return FixedPoint::ZERO;
    };
    let upper = high.isqrt();
    let rest = high.get() - upper.get() * upper.get();
    let lower = ((rest << 15) + ((normal as u32) >> 17)) / upper;
    let root = ((upper.get() << 16) + lower.min(0xffff)) >> (shift / 2);
    // The error is at most one.
    let (rest, root) = (square.wrapping_sub(u64::from(root) * u64::from(root)) as i64, i64::from(root));
    FixedPoint::saturated(root + i64::from(rest > root) - i64::from(rest <= -root))
}

impl Real for FixedPoint {
    const ZERO: Self = Self(I8F24::ZERO);
    const ONE: Self = Self(I8F24::ONE);
    const EPSILON: Self = Self(I8F24::DELTA);
    const SMALLEST: Self = Self(I8F24::DELTA);
    const IS_FIXED_POINT: bool = true;

    #[inline]
    fn constant(value: f64) -> Self {
        Self::nearest(value)
    }

    #[inline]
    fn to_f64(self) -> f64 {
        Self::to_f64(self)
    }

    #[inline]
    fn is_finite(self) -> bool {
        true
    }

    #[inline]
    fn sqrt(self) -> Self {
        nearest_root(i64::from(self.0.to_bits()) << FRACTION)
    }

    #[inline]
    fn geometric_mean(self, other: Self) -> Self {
        nearest_root(self.0.wide_mul(other.0).to_bits())
    }

    fn two_fifths_power(self) -> Self {
        power::two_fifths(self)
    }

    fn exp(self) -> Self {
        Self::nearest(Real::exp(self.to_f64()))
    }

    #[inline]
    fn ln(self) -> Self {
        Self::nearest(Real::ln(self.to_f64()))
    }

    #[inline]
    fn saturating_div(self, divisor: Self) -> Self {
        self / divisor
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for FixedPoint {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=f64}", self.to_f64());
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for FixedPoint {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.to_f64())
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for FixedPoint {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = f64::deserialize(deserializer)?;
        // A number outside the range would become a bound, which is not the number that was written.
        let fits = (-128.0..128.0).contains(&value);
        if fits {
            Ok(Self::nearest(value))
        } else {
            Err(serde::de::Error::custom("fixed-point number must be -128 to 128"))
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::{FixedPoint, I8F24, product_by_halves};

    #[test]
    fn products_by_halves_are_those_of_64_bits() {
        let mut numbers =
            Vec::from([0_i32, 1, -1, i32::MAX, i32::MIN, 0xffff, -0x1_0000, 1 << 24, -1 << 24, 0x00ff_ffff, 1 << 23]);
        // Those of a linear congruential generator, of all sizes.
        let mut state = 1_u32;
        for index in 0..if cfg!(miri) { 20 } else { 1000 } {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            numbers.push(state as i32 >> (index % 25));
        }
        for a in &numbers {
            for b in &numbers {
                let wide = FixedPoint::rounded(I8F24::from_bits(*a).wide_mul(I8F24::from_bits(*b)).to_bits());
                assert_eq!(product_by_halves(*a, *b), wide.0.to_bits(), "{a} {b}");
            }
        }
    }
}
