//! Dual numbers: a value and its derivatives by the inputs, carried through every formula of the core.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Real;
use crate::contact::{Fraction, Nodes, PhaseNodes, PhaseSamples};

/// A value with its partial derivatives by `N` inputs (forward-mode differentiation).
///
/// It is a [`Real`], so a scene built of dual numbers computes the sensitivity of each of its results to each of its
/// inputs along with the result. Comparisons go by the value alone, so a dual number takes the same branches as the
/// number within it. Where a result has no finite derivative (a root at zero, an overflow) its partial derivatives are zero.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{Dual, NormalMotion, Real, Sphere, Stiffness};
///
/// // Restitution of Table 1 and its derivatives by radius and speed.
/// let [radius, speed] = Dual::variables([5.06e-6, 2.8]);
/// let scene = Simulation::new(Sphere::solid(radius, Dual::constant(2600.0))?, Stiffness::new(Dual::constant(7.5e10))?)
///     .with_damping(Dual::constant(10.5))?
///     .with_ring(Dual::constant(250.0), Dual::constant(6.25))?;
/// let method = Collocation::<12, Dual<f64, 2>>::new(Dual::constant(1e-12))?;
/// let e = scene.normal_impact(&method, &NormalMotion::new(speed)?)?.overall_restitution();
/// assert!((e.value - 0.746193259).abs() < 1e-9);
/// // A sphere larger by 1 % leaves with 0.752 of its speed.
/// assert!((e.value + 0.01 * 5.06e-6 * e.partials[0] - 0.752).abs() < 2e-4);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>"))
)]
pub struct Dual<T, const N: usize> {
    /// The value.
    pub value: T,
    /// Its partial derivatives by the inputs.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    pub partials: [T; N],
}

impl<T: Real, const N: usize> Dual<T, N> {
    /// A number that depends on no input.
    ///
    /// ```
    /// assert_eq!(microimpact::Dual::<f64, 2>::fixed(3.0).partials, [0.0, 0.0]);
    /// ```
    #[inline]
    pub const fn fixed(value: T) -> Self {
        Self { value, partials: [T::ZERO; N] }
    }

    /// The inputs themselves, in the order in which results list their partial derivatives.
    ///
    /// ```
    /// let [x, y] = microimpact::Dual::variables([3.0, 4.0]);
    /// assert_eq!((x * y).partials, [4.0, 3.0]);
    /// ```
    pub fn variables(values: [T; N]) -> [Self; N] {
        let mut count = 0;
        values.map(|value| {
            let mut variable = Self::fixed(value);
            if let Some(partial) = variable.partials.get_mut(count) {
                *partial = T::ONE;
            }
            count += 1;
            variable
        })
    }

    /// A function of this number with the given value and derivative.
    #[inline]
    fn chain(self, value: T, slope: T) -> Self {
        Self { value, partials: self.partials.map(|partial| slope * partial) }
    }

    /// A function of two numbers whose partial derivatives are those of both, each put together by `combine`.
    #[inline]
    fn both(self, other: Self, value: T, combine: impl Fn(T, T) -> T) -> Self {
        let mut partials = self.partials;
        for (partial, other) in partials.iter_mut().zip(other.partials) {
            *partial = combine(*partial, other);
        }
        Self { value, partials }
    }
}

impl<T: Real, const N: usize> PartialEq for Dual<T, N> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: Real, const N: usize> PartialOrd for Dual<T, N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<T: Real, const N: usize> Neg for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, partials: self.partials.map(|partial| -partial) }
    }
}

impl<T: Real, const N: usize> Add for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.both(other, self.value + other.value, |a, b| a + b)
    }
}

impl<T: Real, const N: usize> Sub for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.both(other, self.value - other.value, |a, b| a - b)
    }
}

impl<T: Real, const N: usize> Mul for Dual<T, N> {
    type Output = Self;

    #[inline]
    #[allow(clippy::suspicious_arithmetic_impl)] // the product rule
    fn mul(self, other: Self) -> Self {
        self.both(other, self.value * other.value, |a, b| a * other.value + b * self.value)
    }
}

impl<T: Real, const N: usize> Div for Dual<T, N> {
    type Output = Self;

    #[inline]
    #[allow(clippy::suspicious_arithmetic_impl)] // the quotient rule
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.both(other, value, |a, b| (a - value * b) / other.value)
    }
}

impl<T: Real, const N: usize> Real for Dual<T, N> {
    const ZERO: Self = Self::fixed(T::ZERO);
    const ONE: Self = Self::fixed(T::ONE);
    const EPSILON: Self = Self::fixed(T::EPSILON);
    const SMALLEST: Self = Self::fixed(T::SMALLEST);

    #[inline]
    fn constant(value: f64) -> Self {
        Self::fixed(T::constant(value))
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.partials.iter().all(|partial| partial.is_finite())
    }

    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, if root > T::ZERO { T::constant(0.5) / root } else { T::ZERO })
    }

    #[inline]
    fn two_fifths_power(self) -> Self {
        let power = self.value.two_fifths_power();
        self.chain(power, if self.value > T::ZERO { T::constant(0.4) * power / self.value } else { T::ZERO })
    }

    #[inline]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    #[inline]
    fn saturating_div(self, divisor: Self) -> Self {
        let value = self.value.saturating_div(divisor.value);
        self.both(divisor, value, |a, b| {
            let slope = (a - value * b) / divisor.value;
            if slope.is_finite() { slope } else { T::ZERO }
        })
    }
}

/// Numbers of a table as dual numbers that depend on no input.
#[allow(clippy::indexing_slicing)] // by indices below the length, and evaluated by the compiler
const fn fixed_all<T: Real, const N: usize, const M: usize>(table: [T; M]) -> [Dual<T, N>; M] {
    let mut fixed = [Dual::fixed(T::ZERO); M];
    let mut i = 0;
    while i < M {
        fixed[i].value = table[i];
        i += 1;
    }
    fixed
}

/// The same for a table of rows.
#[allow(clippy::indexing_slicing)]
const fn fixed_rows<T: Real, const N: usize, const M: usize, const L: usize>(
    table: [[T; M]; L],
) -> [[Dual<T, N>; M]; L] {
    let mut fixed = [[Dual::fixed(T::ZERO); M]; L];
    let mut i = 0;
    while i < L {
        fixed[i] = fixed_all(table[i]);
        i += 1;
    }
    fixed
}

/// The same for contact radii.
#[allow(clippy::indexing_slicing)]
const fn fixed_shares<T: Real, const N: usize, const M: usize>(shares: [Fraction<T>; M]) -> [Fraction<Dual<T, N>>; M] {
    let zero = Dual::fixed(T::ZERO);
    let mut fixed = [Fraction { value: zero, square: zero, cubic: zero, quintic: zero }; M];
    let mut i = 0;
    while i < M {
        let Fraction { value, square, cubic, quintic } = shares[i];
        fixed[i] = Fraction {
            value: Dual::fixed(value),
            square: Dual::fixed(square),
            cubic: Dual::fixed(cubic),
            quintic: Dual::fixed(quintic),
        };
        i += 1;
    }
    fixed
}

/// The same for pairs.
#[allow(clippy::indexing_slicing)]
const fn fixed_pairs<T: Real, const N: usize, const M: usize>(pairs: [(T, T); M]) -> [(Dual<T, N>, Dual<T, N>); M] {
    let zero = Dual::fixed(T::ZERO);
    let mut fixed = [(zero, zero); M];
    let mut i = 0;
    while i < M {
        fixed[i] = (Dual::fixed(pairs[i].0), Dual::fixed(pairs[i].1));
        i += 1;
    }
    fixed
}

impl<T: Nodes<M>, const N: usize, const M: usize> Nodes<M> for Dual<T, N> {
    const Z: [Self; M] = fixed_all(T::Z);
    const RUNNING: [[Self; M]; M] = fixed_rows(T::RUNNING);
    const TURNING: [[Self; M]; M] = fixed_rows(T::TURNING);
    const WHOLE: [Self; M] = fixed_all(T::WHOLE);
    const WHOLE_TURNING: [Self; M] = fixed_all(T::WHOLE_TURNING);
    const TAIL: [Self; M] = fixed_all(T::TAIL);
    const LEGENDRE: [[Self; M]; M] = fixed_rows(T::LEGENDRE);
}

impl<T: PhaseNodes<M>, const N: usize, const M: usize> PhaseNodes<M> for Dual<T, N> {
    const Z: [Self; M] = fixed_all(T::Z);
    const FRACTIONS: [Fraction<Self>; M] = fixed_shares(T::FRACTIONS);
    const RUNNING: [[Self; M]; M] = fixed_rows(T::RUNNING);
    const RUNNING_ENDS: [(Self, Self); M] = fixed_pairs(T::RUNNING_ENDS);
    const WHOLE: [Self; M] = fixed_all(T::WHOLE);
    const WHOLE_ENDS: (Self, Self) = fixed_pairs([T::WHOLE_ENDS])[0];
    const TAIL: [Self; M] = fixed_all(T::TAIL);
    const SLOWEST: Self = Dual::fixed(T::SLOWEST);
}

impl<T: PhaseSamples<L, M>, const N: usize, const L: usize, const M: usize> PhaseSamples<L, M> for Dual<T, N> {
    const FRACTIONS: [Fraction<Self>; M] = fixed_shares(<T as PhaseSamples<L, M>>::FRACTIONS);
    const RUNNING: [[Self; M]; L] = fixed_rows(<T as PhaseSamples<L, M>>::RUNNING);
}
