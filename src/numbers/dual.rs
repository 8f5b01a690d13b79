//! Dual numbers: a value with its derivatives with respect to the inputs.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Real, lift_tables};

/// A value with its partial derivatives with respect to `N` inputs (forward-mode automatic differentiation).
///
/// A dual number is a [`Real`]. So a scene of dual numbers computes each result together with its derivatives. Comparisons
/// use the value alone, so a dual number takes the same branches as its value. If a result has no finite derivative (a root
/// at zero, or an overflow), its partial derivatives are zero.
///
/// ```
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Dual, NormalMotion, Real, Sphere, Stiffness};
///
/// // Restitution of Table 1 and its derivatives with respect to radius and speed.
/// let [radius, speed] = Dual::variables([5.06e-6, 2.8]);
/// let scene = Contact::hertz(Sphere::solid(radius, Dual::constant(2600.0))?, Stiffness::new(Dual::constant(7.5e10))?)
///     .with_damping(Dual::constant(10.5))?
///     .with_ring(Dual::constant(250.0), Dual::constant(6.25))?;
/// let method = Collocation::<12, Dual<f64, 2>>::new(Dual::constant(1e-12))?;
/// let e = scene.solve_normal(&NormalMotion::new(speed)?, &method)?.overall_restitution();
/// assert!((e.value - 0.746193259).abs() < 1e-9);
/// // A sphere that is larger by 1 % leaves with 0.752 of its speed.
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
    /// Partial derivatives of the value with respect to the inputs.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    pub partials: [T; N],
}

impl<T: Real, const N: usize> Dual<T, N> {
    /// Creates a number that depends on no input: all partial derivatives are zero.
    ///
    /// ```
    /// assert_eq!(microimpact::Dual::<f64, 2>::fixed(3.0).partials, [0.0, 0.0]);
    /// ```
    #[inline]
    pub const fn fixed(value: T) -> Self {
        Self { value, partials: [T::ZERO; N] }
    }

    /// Creates the inputs. Results list their partial derivatives in the same order.
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

    /// A function of this number, given its value and its derivative (chain rule).
    #[inline]
    fn chain(self, value: T, slope: T) -> Self {
        Self { value, partials: self.partials.map(|partial| slope * partial) }
    }

    /// A function of two numbers; `combine` computes each partial derivative from those of both.
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
    fn to_f64(self) -> f64 {
        self.value.to_f64()
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
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::ONE / self.value)
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

lift_tables!([T: Real, const N: usize] Dual<T, N>, |wide: T| Dual::fixed(wide));
