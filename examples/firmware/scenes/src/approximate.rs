//! A number whose roots, powers and exponentials are micromath's approximations, to compare them with the library's own.

use core::fmt::{self, LowerExp};
use core::ops::{Add, Div, Mul, Neg, Sub};

use microimpact::Real;
use microimpact::contact::{PhaseNodes, Share};
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

impl<const N: usize> PhaseNodes<N> for Approximate {
    const Z: [Self; N] = all(<f32 as PhaseNodes<N>>::Z);
    const SHARES: [Share<Self>; N] = {
        let (zero, from) = (Self(0.0), <f32 as PhaseNodes<N>>::SHARES);
        let mut shares = [Share { radius: zero, square: zero, cubic: zero, quintic: zero }; N];
        let mut i = 0;
        while i < N {
            let Share { radius, square, cubic, quintic } = from[i];
            shares[i] =
                Share { radius: Self(radius), square: Self(square), cubic: Self(cubic), quintic: Self(quintic) };
            i += 1;
        }
        shares
    };
    const RUNNING: [[Self; N]; N] = {
        let (mut rows, mut i) = ([[Self(0.0); N]; N], 0);
        while i < N {
            rows[i] = all(<f32 as PhaseNodes<N>>::RUNNING[i]);
            i += 1;
        }
        rows
    };
    const RUNNING_ENDS: [(Self, Self); N] = {
        let (mut pairs, mut i) = ([(Self(0.0), Self(0.0)); N], 0);
        while i < N {
            let (first, last) = <f32 as PhaseNodes<N>>::RUNNING_ENDS[i];
            pairs[i] = (Self(first), Self(last));
            i += 1;
        }
        pairs
    };
    const WHOLE: [Self; N] = all(<f32 as PhaseNodes<N>>::WHOLE);
    const WHOLE_ENDS: (Self, Self) = {
        let (first, last) = <f32 as PhaseNodes<N>>::WHOLE_ENDS;
        (Self(first), Self(last))
    };
    const TAIL: [Self; N] = all(<f32 as PhaseNodes<N>>::TAIL);
    const SLOWEST: Self = Self(<f32 as PhaseNodes<N>>::SLOWEST);
}

const fn all<const N: usize>(from: [f32; N]) -> [Approximate; N] {
    let (mut to, mut i) = ([Approximate(0.0); N], 0);
    while i < N {
        to[i] = Approximate(from[i]);
        i += 1;
    }
    to
}
