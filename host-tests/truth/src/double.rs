//! Double-double arithmetic: a number is the sum of two f64, which hold 31 digits.
//!
//! The crate `twofloat` 0.8 divides to 16 digits only. Products use Dekker's splitting, because a fused multiply-add is
//! a call of the C library on processors that are not known to have one.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::str::FromStr;

/// A number with 31 digits (Dekker 1971; Hida, Li and Bailey 2001).
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Double {
    high: f64,
    low: f64,
}

/// A factor that splits 53 bits into two times 26 (Veltkamp).
const SPLITTER: f64 = 134_217_729.0;

/// The sum and its rounding error.
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The same where `a` is the larger.
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Two numbers of 26 bits, whose sum is `a`.
#[inline(always)]
pub(crate) fn split(a: f64) -> (f64, f64) {
    let wide = SPLITTER * a;
    let head = wide - (wide - a);
    (head, a - head)
}

/// The product and its rounding error.
#[inline(always)]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_head, a_tail), (b_head, b_tail)) = (split(a), split(b));
    (product, ((a_head * b_head - product) + a_head * b_tail + a_tail * b_head) + a_tail * b_tail)
}

impl Double {
    /// 0
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    /// 1
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };
    /// pi
    pub const PI: Self = Self { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

    /// The sum of two numbers of which `high` is the larger.
    #[inline(always)]
    pub(crate) fn of_parts(high: f64, low: f64) -> Self {
        let (high, low) = quick_two_sum(high, low);
        Self { high, low }
    }

    /// The nearest f64, and the remainder.
    #[inline(always)]
    pub fn parts(self) -> (f64, f64) {
        (self.high, self.low)
    }

    /// The nearest f64.
    #[inline(always)]
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// Size.
    #[must_use]
    #[inline]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The larger.
    #[must_use]
    #[inline]
    pub fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// The smaller.
    #[must_use]
    #[inline]
    pub fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// Square root of a number that is not negative.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        let root = Self::from(self.high.sqrt());
        root + (self - root * root) / (root + root)
    }

    /// The power 2/5 of a positive number.
    #[must_use]
    pub fn two_fifths_power(self) -> Self {
        let mut root = Self::from(self.high.powf(0.2));
        // Newton's method doubles the 15 digits of the first value.
        for _ in 0..2 {
            let fourth = root * root * (root * root);
            root = root - (fourth * root - self) / (fourth * 5.0);
        }
        root * root
    }
}

impl From<f64> for Double {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

/// A decimal number with all its digits.
impl FromStr for Double {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let error = || format!("`{text}` is not a decimal number");
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let mut exponent: i32 = exponent.parse().map_err(|_| error())?;
        let (sign, digits) = mantissa.strip_prefix('-').map_or((1.0, mantissa), |digits| (-1.0, digits));
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let mut value = Self::ZERO;
        for digit in whole.chars().chain(fraction.chars()) {
            value = value * 10.0 + Self::from(f64::from(digit.to_digit(10).ok_or_else(error)?));
        }
        exponent -= fraction.len() as i32;
        for _ in 0..exponent.abs() {
            value = if exponent > 0 { value * 10.0 } else { value / 10.0 };
        }
        Ok(value * sign)
    }
}

impl Neg for Double {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Double {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (high, low) = two_sum(self.high, other.high);
        let (second, third) = two_sum(self.low, other.low);
        let (high, low) = quick_two_sum(high, low + second);
        Self::of_parts(high, low + third)
    }
}

impl Sub for Double {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (high, low) = two_product(self.high, other.high);
        Self::of_parts(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Mul<f64> for Double {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        let (high, low) = two_product(self.high, other);
        Self::of_parts(high, low + self.low * other)
    }
}

impl Div for Double {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        Self::of_parts(first, second) + Self::from(rest.high / other.high)
    }
}

impl Div<f64> for Double {
    type Output = Self;

    #[inline]
    fn div(self, other: f64) -> Self {
        let first = self.high / other;
        let rest = self - Self::from(other) * first;
        Self::of_parts(first, rest.high / other)
    }
}

#[cfg(test)]
mod tests {
    use super::Double;

    /// Some roundings of 106 bits.
    const ROUNDING: f64 = 1e-31;

    fn numbers() -> impl Iterator<Item = (Double, Double)> {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        let mut number = move || {
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            let unit = (bits >> 11) as f64 / 9_007_199_254_740_992.0;
            2.0_f64.powf(40.0 * unit - 20.0)
        };
        std::iter::repeat_with(move || {
            let mut double = || Double::from(number()) + Double::from(number() * 1e-18);
            (double(), double())
        })
    }

    #[test]
    fn quotients_and_roots_give_back_what_they_came_from() {
        for (a, b) in numbers().take(10_000) {
            let within = |value: Double| assert!(((value - a) / a).to_f64().abs() < ROUNDING, "{a:?} {b:?}");
            within(a / b * b);
            within(a * b / b);
            within(a.sqrt() * a.sqrt());
            let left = (a + b) - b - a;
            assert!(left.to_f64().abs() < ROUNDING * a.max(b).to_f64(), "{a:?} {b:?}");
            let fifth = a.two_fifths_power();
            let fifth = fifth * fifth * fifth.sqrt();
            assert!(((fifth - a) / a).to_f64().abs() < 10.0 * ROUNDING, "{a:?}");
            within(a / b.to_f64() * b.to_f64());
        }
    }
}
