//! Fixed-point numbers, for both models on processors without floating point.

mod rigid;
mod simulation;

use core::num::NonZeroU32;
use core::ops::{Add, Div, Mul, Neg, Sub};

use fixed::types::I8F24;

use crate::Real;
pub use rigid::InFixedPoint;

/// A number of 32 bits with 24 behind the binary point: -128 to 128 in steps of 6e-8.
///
/// Both models run with it, by the same code as in floating point, in units that bring their values near one. Sums, products,
/// quotients and roots are rounded to the nearest number, and what lies beyond the bounds is held at them, never wrapped. What
/// does not fit is refused by an error that names the quantity; set-up may take floating point, or the host.
///
/// * The simulation of the normal motion, by [`FixedCost`](crate::contact::FixedCost), from
///   [`DimensionlessImpact::in_fixed_point`](crate::contact::DimensionlessImpact::in_fixed_point). It takes strengths of
///   adhesion up to 0.999, above which hardly any energy is left to resolve, and damping up to 0.5. Four nodes and two sweeps
///   err by less than 1e-4 in e, and by less than 1e-5 more than in f64, where e exceeds 0.2 and the strength of adhesion is
///   below 0.95; rounding weighs with the inverse of e and of the energy.
/// * The rigid body, in units of a speed, by [`InFixedPoint`]. It takes approach speeds from 0.004 to 8 units, other velocities
///   up to 8 and friction coefficients up to 7. Velocities err by less than 1e-5 units for gyration ratios from 0.2, and a
///   rebound slower than 1e-6 may count as a capture. Margins err by less than 1e-4 of themselves for speed, with critical
///   speeds from 0.1 to 8 units where R exceeds 0.1, and by 1e-5 of one more than themselves for friction, with a slip above
///   0.1 units.
///
/// Values in SI units, from 1e-10 m to 1e16 Pa, fit no fixed point, so that the constructors of [`Sphere`](crate::Sphere) and
/// [`NormalMotion`](crate::NormalMotion) refuse the type. Rounding down instead of to the nearest number would make the error
/// of e more than 1.6 times as large.
///
/// ```
/// use microimpact::simulation::{FixedCost, Simulation};
/// use microimpact::{FixedPoint, NormalMotion, Real, Sphere, Stiffness};
///
/// // Set-up in floating point, on the host or once; the motion in integers.
/// let scene = Simulation::new(Sphere::solid(5.06e-6_f32, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let impact = scene.dimensionless(&NormalMotion::new(2.8)?)?.in_fixed_point()?;
/// let contact = impact.solve(&FixedCost::<4>::new(2)?);
/// assert!((contact.overall_restitution().to_f64() - 0.746193).abs() < 1e-4);
/// // No wrapping.
/// let large = FixedPoint::nearest(100.0);
/// assert!(large * large > large && -(large * large) < -large);
/// // No sphere in SI units.
/// assert!(Sphere::solid(FixedPoint::nearest(5.06e-6), FixedPoint::ONE).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FixedPoint(pub I8F24);

/// Bits behind the binary point.
const FRACTION: u32 = I8F24::FRAC_NBITS;

impl FixedPoint {
    /// The number nearest to `value`, or the closest bound; zero for NaN. Constant, for scenes that are.
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

    /// As f64, exactly.
    ///
    /// ```
    /// assert_eq!(microimpact::FixedPoint::nearest(-3.25).to_f64(), -3.25);
    /// ```
    pub const fn to_f64(self) -> f64 {
        self.0.to_bits() as f64 / (1_u64 << FRACTION) as f64
    }

    /// The number nearest to a product in units of products, held at the bounds.
    #[inline]
    fn rounded(product: i64) -> Self {
        let product = product + (1 << (FRACTION - 1));
        let high = (product >> 32) as i32;
        // One word decides on saturation, without a branch: the compiler can move products out of loops.
        let fits = high >> (FRACTION - 1) == high >> 31;
        let units = if fits { (product >> FRACTION) as i32 } else { i32::MAX ^ (high >> 31) };
        Self(I8F24::from_bits(units))
    }

    /// Units, held at the bounds.
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

/// Quotient by two digits of 16 bits, held at the largest number of 32 bits where it is larger or the divisor is zero.
///
/// Processors divide 32 bits by 32; a general division of 64 takes four times the instructions.
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
    // One digit of the quotient, and what it leaves.
    let digit = |high: u32, next: u32| {
        let (mut digit, mut rest) = (high / upper, high % upper);
        // The upper half of the divisor alone gives at most two too many.
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

/// The number nearest to the root of a square in units of products; zero where that is negative.
#[inline(never)]
fn nearest_root(square: i64) -> FixedPoint {
    let square = square.max(0).unsigned_abs();
    // Normalized, the upper half of the root is that of the upper word, and a division gives the lower half.
    let shift = square.leading_zeros() & 62;
    let normal = square << shift;
    let Some(high) = NonZeroU32::new((normal >> 32) as u32) else {
        return FixedPoint::ZERO;
    };
    let upper = high.isqrt();
    let rest = high.get() - upper.get() * upper.get();
    let lower = ((rest << 15) + ((normal as u32) >> 17)) / upper;
    let root = ((upper.get() << 16) + lower.min(0xffff)) >> (shift / 2);
    // It is off by one at most.
    let (rest, root) = (square.wrapping_sub(u64::from(root) * u64::from(root)) as i64, i64::from(root));
    FixedPoint::saturated(root + i64::from(rest > root) - i64::from(rest <= -root))
}

impl Real for FixedPoint {
    const ZERO: Self = Self(I8F24::ZERO);
    const ONE: Self = Self(I8F24::ONE);
    const EPSILON: Self = Self(I8F24::DELTA);
    const SMALLEST: Self = Self(I8F24::DELTA);

    #[inline]
    fn constant(value: f64) -> Self {
        Self::nearest(value)
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
        Self::nearest(self.to_f64().two_fifths_power())
    }

    fn exp(self) -> Self {
        Self::nearest(Real::exp(self.to_f64()))
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
        // What the bounds would hold is not the number that was written.
        let fits = (-128.0..128.0).contains(&value);
        if fits { Ok(Self::nearest(value)) } else { Err(serde::de::Error::custom("fixed point holds -128 to 128")) }
    }
}
