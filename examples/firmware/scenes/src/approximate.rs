//! A number whose roots, powers and exponentials are micromath's approximations, to compare them with the library's own.

use core::fmt::{self, LowerExp};
use core::ops::{Add, Div, Mul, Neg, Sub};

use microimpact::{Real, lift_tables};
use micromath::F32Ext;

/// Single precision with the functions of micromath.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Approximate(pub f32);

impl LowerExp for Approximate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operator {
    ($operator:ident, $name:ident) => {
        impl $operator for Approximate {
            type Output = Self;

            #[inline]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Approximate {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Approximate {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);
    const EPSILON: Self = Self(f32::EPSILON);
    const SMALLEST: Self = Self(f32::MIN_POSITIVE);

    #[inline]
    fn constant(value: f64) -> Self {
        Self(value as f32)
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self.0.into()
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    #[inline]
    fn sqrt(self) -> Self {
        Self(F32Ext::sqrt(self.0))
    }

    #[inline]
    fn two_fifths_power(self) -> Self {
        Self(F32Ext::powf(self.0, 0.4))
    }

    #[inline]
    fn exp(self) -> Self {
        Self(F32Ext::exp(self.0))
    }

    #[inline]
    fn saturating_div(self, divisor: Self) -> Self {
        Self(self.0.saturating_div(divisor.0))
    }
}

lift_tables!(Approximate, |wide: f32| Approximate(wide));
