//! Fixed-point numbers, for the dimensionless motion of the simulation.

use core::ops::{Add, Div, Mul, Neg, Sub};

use fixed::types::I8F24;

use crate::simulation::{DimensionlessImpact, PhaseNodes, Share};
use crate::{InputError, Parameter, Real};

/// A number of 32 bits with 24 behind the binary point: -128 to 128 in steps of 6e-8.
///
/// It is a [`Real`] for the dimensionless motion, solved by [`FixedCost`](crate::simulation::FixedCost): sums, products,
/// quotients and roots are rounded to the nearest number, and what lies beyond the bounds is held at them, never wrapped.
/// [`DimensionlessImpact::in_fixed_point`] refuses what does not fit: strengths of adhesion above 0.999, where hardly any
/// energy is left to resolve, and damping above 0.5. Values in SI units, from 1e-10 m to 1e16 Pa, fit no fixed point, so that
/// [`Sphere`](crate::Sphere), [`NormalMotion`](crate::NormalMotion) and with them the rigid-body model refuse the type by
/// an error that names the quantity.
///
/// Four nodes and two sweeps err by less than 1e-4 in e, and by less than 1e-5 more than in f64, where e exceeds 0.2 and the
/// strength of adhesion is below 0.95; rounding weighs with the inverse of e and of the energy.
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
    pub fn to_f64(self) -> f64 {
        f64::from(self.0)
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
        let half = 1 << (FRACTION - 1);
        let product = self.0.wide_mul(other.0).to_bits() + half;
        let high = (product >> 32) as i32;
        // One word decides on saturation, without a branch: the compiler can move products out of loops.
        let fits = high >> (FRACTION - 1) == high >> 31;
        let units = if fits { (product >> FRACTION) as i32 } else { i32::MAX ^ (high >> 31) };
        Self(I8F24::from_bits(units))
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
    let (upper, lower) = (divisor >> 16, divisor & 0xffff);
    // One digit of the quotient, and what it leaves.
    let digit = |high: u32, next: u32| {
        let (mut digit, mut rest) = (high / upper, high % upper);
        // The upper half of the divisor alone gives at most two too many.
        for _ in 0..2 {
            if rest <= 0xffff && (digit > 0xffff || digit * lower > (rest << 16 | next)) {
                digit -= 1;
                rest += upper;
            }
        }
        (digit, (high << 16 | next).wrapping_sub(digit.wrapping_mul(divisor)))
    };
    let low = dividend as u32;
    let (first, rest) = digit((dividend >> 32) as u32, low >> 16);
    let (second, _) = digit(rest, low & 0xffff);
    first << 16 | second
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

    #[inline(never)]
    fn sqrt(self) -> Self {
        let square = u64::from(self.0.to_bits().max(0).unsigned_abs()) << FRACTION;
        let root = square.isqrt();
        let up = square - root * root > root;
        Self(I8F24::from_bits((root + u64::from(up)) as i32))
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

impl<T: Real + Into<f64>> DimensionlessImpact<T> {
    /// The same impact in fixed point.
    ///
    /// # Errors
    /// Adhesion or damping outside its range for [`FixedPoint`].
    ///
    /// ```
    /// use microimpact::simulation::{DimensionlessImpact, FixedCost};
    ///
    /// let impact = DimensionlessImpact::new(0.5, 0.1, 0.1)?;
    /// let (narrow, wide) = (impact.in_fixed_point()?, impact);
    /// let method = FixedCost::<4>::new(2)?;
    /// let difference = narrow.solve(&method).overall_restitution().to_f64() - wide.solve(&method).overall_restitution();
    /// assert!(difference.abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn in_fixed_point(&self) -> Result<DimensionlessImpact<FixedPoint>, InputError> {
        let adhesion = Parameter::DimensionlessAdhesion.check(self.adhesion)?;
        let material_damping = Parameter::DimensionlessDamping.check(self.material_damping)?;
        let adhesion_damping = Parameter::DimensionlessDamping.check(self.adhesion_damping)?;
        Ok(DimensionlessImpact {
            adhesion: FixedPoint::nearest(adhesion.into()),
            energy: FixedPoint::nearest(self.energy.into()),
            material_damping: FixedPoint::nearest(material_damping.into()),
            adhesion_damping: FixedPoint::nearest(adhesion_damping.into()),
        })
    }
}

/// Numbers of a table, each the nearest.
#[allow(clippy::indexing_slicing)] // by indices below the length, and evaluated by the compiler
const fn nearest_all<const M: usize>(table: [f64; M]) -> [FixedPoint; M] {
    let mut nearest = [FixedPoint::ZERO; M];
    let mut i = 0;
    while i < M {
        nearest[i] = FixedPoint::nearest(table[i]);
        i += 1;
    }
    nearest
}

impl<const M: usize> PhaseNodes<M> for FixedPoint {
    const Z: [Self; M] = nearest_all(<f64 as PhaseNodes<M>>::Z);
    const SHARES: [Share<Self>; M] = nearest_shares(<f64 as PhaseNodes<M>>::SHARES);
    const RUNNING: [[Self; M]; M] = nearest_rows(<f64 as PhaseNodes<M>>::RUNNING);
    const RUNNING_POWERS: [(Self, Self); M] = nearest_pairs(<f64 as PhaseNodes<M>>::RUNNING_POWERS);
    const WHOLE: [Self; M] = nearest_all(<f64 as PhaseNodes<M>>::WHOLE);
    const TAIL: [Self; M] = nearest_all(<f64 as PhaseNodes<M>>::TAIL);
}

/// The same for a table of rows.
#[allow(clippy::indexing_slicing)]
const fn nearest_rows<const M: usize>(table: [[f64; M]; M]) -> [[FixedPoint; M]; M] {
    let mut nearest = [[FixedPoint::ZERO; M]; M];
    let mut i = 0;
    while i < M {
        nearest[i] = nearest_all(table[i]);
        i += 1;
    }
    nearest
}

/// The same for contact radii.
#[allow(clippy::indexing_slicing)]
const fn nearest_shares<const M: usize>(shares: [Share<f64>; M]) -> [Share<FixedPoint>; M] {
    let zero = FixedPoint::ZERO;
    let mut nearest = [Share { radius: zero, square: zero, cubic: zero, quintic: zero }; M];
    let mut i = 0;
    while i < M {
        let Share { radius, square, cubic, quintic } = shares[i];
        nearest[i] = Share {
            radius: FixedPoint::nearest(radius),
            square: FixedPoint::nearest(square),
            cubic: FixedPoint::nearest(cubic),
            quintic: FixedPoint::nearest(quintic),
        };
        i += 1;
    }
    nearest
}

/// The same for pairs.
#[allow(clippy::indexing_slicing)]
const fn nearest_pairs<const M: usize>(pairs: [(f64, f64); M]) -> [(FixedPoint, FixedPoint); M] {
    let mut nearest = [(FixedPoint::ZERO, FixedPoint::ZERO); M];
    let mut i = 0;
    while i < M {
        nearest[i] = (FixedPoint::nearest(pairs[i].0), FixedPoint::nearest(pairs[i].1));
        i += 1;
    }
    nearest
}
