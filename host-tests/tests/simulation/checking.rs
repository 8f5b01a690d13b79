//! A number that records the largest size among all results of its arithmetic, and rounds them as told.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use microimpact::contact::PhaseNodes;
use microimpact::{FixedPoint, Real, lift_tables};

/// Rounding to f64 alone.
pub const EXACT: u8 = 0;
/// Rounding down to 24 bits behind the binary point.
pub const DOWN: u8 = 1;
/// Rounding to the nearest of these numbers.
pub const NEAREST: u8 = 2;
/// Rounding to f32.
pub const SINGLE: u8 = 3;

thread_local! {
    static LARGEST: Cell<f64> = const { Cell::new(0.0) };
}

/// The largest size since the last call.
pub fn take_largest() -> f64 {
    LARGEST.take()
}

/// A number whose arithmetic is recorded.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Checked<const ROUNDING: u8>(pub f64);

impl<const ROUNDING: u8> Checked<ROUNDING> {
    fn recorded(value: f64) -> Self {
        LARGEST.with(|largest| {
            if value.abs() > largest.get() || value.is_nan() {
                largest.set(if value.is_nan() { f64::INFINITY } else { value.abs() });
            }
        });
        let units = value * f64::from(1 << 24);
        Self(match ROUNDING {
            DOWN => units.floor() / f64::from(1 << 24),
            NEAREST => units.round() / f64::from(1 << 24),
            SINGLE => f64::from(value as f32),
            _ => value,
        })
    }
}

macro_rules! recorded {
    ($operation:ident, $name:ident) => {
        impl<const ROUNDING: u8> $operation for Checked<ROUNDING> {
            type Output = Self;

            fn $name(self, other: Self) -> Self {
                Self::recorded(self.0.$name(other.0))
            }
        }
    };
}

recorded!(Add, add);
recorded!(Sub, sub);
recorded!(Mul, mul);
recorded!(Div, div);

impl<const ROUNDING: u8> Neg for Checked<ROUNDING> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const ROUNDING: u8> Real for Checked<ROUNDING> {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);
    const EPSILON: Self = Self(if ROUNDING == SINGLE { f32::EPSILON as f64 } else { 6e-8 });
    const SMALLEST: Self = Self(if ROUNDING == SINGLE { f32::MIN_POSITIVE as f64 } else { 6e-8 });

    fn constant(value: f64) -> Self {
        Self::recorded(value)
    }

    fn to_f64(self) -> f64 {
        self.0
    }

    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    fn sqrt(self) -> Self {
        Self::recorded(self.0.sqrt())
    }

    fn two_fifths_power(self) -> Self {
        Self::recorded(self.0.two_fifths_power())
    }

    fn exp(self) -> Self {
        Self::recorded(Real::exp(self.0))
    }

    fn saturating_div(self, divisor: Self) -> Self {
        self / divisor
    }
}

lift_tables!([const ROUNDING: u8] Checked<ROUNDING>, |wide: f64| Checked(wide), {
    const SLOWEST: Self = Checked(<FixedPoint as PhaseNodes<NODES>>::SLOWEST.to_f64());
});
