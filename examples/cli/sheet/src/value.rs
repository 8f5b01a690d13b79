//! Numbers and words of computed cells, and how they are written.

use std::fmt::{Display, LowerExp};
use std::str::FromStr;

use microimpact::Real;

use crate::decimal::Decimal;

/// A number type that can be read from a cell and written to one.
pub trait Scalar: Real + FromStr + Display + LowerExp + Send + Sync {
    /// The number as that of a cell.
    fn value(self) -> Value;
}

impl Scalar for f64 {
    fn value(self) -> Value {
        Value::Double(self)
    }
}

impl Scalar for f32 {
    fn value(self) -> Value {
        Value::Single(self)
    }
}

/// What a computed cell holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Value {
    /// Nothing: the quantity does not exist, or is not known.
    #[default]
    Empty,
    /// A number in double precision.
    Double(f64),
    /// A number in single precision.
    Single(f32),
    /// A whole number.
    Integer(i64),
    /// A word of a fixed set.
    Word(&'static str),
    /// Any other text.
    Text(String),
}

impl<T: Scalar> From<Option<T>> for Value {
    fn from(number: Option<T>) -> Self {
        number.map_or(Self::Empty, Scalar::value)
    }
}

impl From<&'static str> for Value {
    fn from(word: &'static str) -> Self {
        Self::Word(word)
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        if text.is_empty() { Self::Empty } else { Self::Text(text) }
    }
}

impl Value {
    /// Its text with a decimal mark: of a number the shortest that reads back as the same number.
    #[must_use]
    pub fn text(&self, decimal: Decimal) -> String {
        let mut text = Vec::new();
        self.write(decimal, &mut text);
        String::from_utf8_lossy(&text).into_owned()
    }

    /// Appends its text.
    pub(crate) fn write(&self, decimal: Decimal, to: &mut Vec<u8>) {
        let start = to.len();
        match self {
            Self::Empty => {}
            Self::Double(number) => write_number(*number + 0.0, zmij::Buffer::new().format(*number + 0.0), to),
            Self::Single(number) => write_number(*number + 0.0, zmij::Buffer::new().format(*number + 0.0), to),
            Self::Integer(number) => to.extend(number.to_string().bytes()),
            Self::Word(word) => to.extend(word.bytes()),
            Self::Text(text) => to.extend(text.bytes()),
        }
        if decimal == Decimal::Comma && !matches!(self, Self::Word(_) | Self::Text(_)) {
            to[start..].iter_mut().filter(|byte| **byte == b'.').for_each(|byte| *byte = b',');
        }
    }

    /// Appends it as JSON.
    pub(crate) fn write_json(&self, to: &mut Vec<u8>) {
        match self {
            Self::Double(number) if number.is_finite() => self.write(Decimal::Point, to),
            Self::Single(number) if number.is_finite() => self.write(Decimal::Point, to),
            Self::Integer(_) => self.write(Decimal::Point, to),
            Self::Word(word) => write_json_text(word, to),
            Self::Text(text) => write_json_text(text, to),
            Self::Empty | Self::Double(_) | Self::Single(_) => to.extend(b"null"),
        }
    }
}

/// Appends a text in quotes.
pub(crate) fn write_json_text(text: &str, to: &mut Vec<u8>) {
    // A text always has a form in JSON.
    let _ = serde_json::to_writer(to, text);
}

/// Sizes between which a number is written without an exponent.
const PLAIN: [f64; 2] = [1e-3, 1e7];

/// Appends a number, whose shortest digits are those of `text`.
fn write_number<T: Scalar>(number: T, text: &str, to: &mut Vec<u8>) {
    let size = number.abs();
    let is_plain = size == T::ZERO || (size >= T::constant(PLAIN[0]) && size < T::constant(PLAIN[1]));
    if is_plain {
        to.extend(text.strip_suffix(".0").unwrap_or(text).bytes());
    } else if let Some((mantissa, exponent)) = text.split_once('e') {
        // `1.5e-06` and `1.5e+20` are written as 1.5e-6 and 1.5e20.
        let (sign, digits) = exponent.strip_prefix('-').map_or(("", exponent), |digits| ("-", digits));
        to.extend(mantissa.strip_suffix(".0").unwrap_or(mantissa).bytes());
        to.push(b'e');
        to.extend(sign.bytes().chain(digits.trim_start_matches(['+', '0']).bytes()));
    } else {
        to.extend(format!("{number:e}").bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn by_the_standard_library<T: Scalar>(number: T) -> String {
        let size = number.abs();
        let is_plain = size == T::ZERO || (size >= T::constant(1e-3) && size < T::constant(1e7));
        if is_plain { number.to_string() } else { format!("{number:e}") }
    }

    /// The digits of the standard library, over all sizes.
    #[test]
    fn digits_are_the_shortest() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..200_000 {
            // Knuth's linear congruential generator; its high bits are random.
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (double, single) = (f64::from_bits(bits), f32::from_bits((bits >> 32) as u32));
            if double.is_finite() {
                assert_eq!(double.value().text(Decimal::Point), by_the_standard_library(double));
            }
            if single.is_finite() {
                // Halfway between two shortest numbers the last digit may differ.
                let (text, other) = (single.value().text(Decimal::Point), by_the_standard_library(single));
                assert_eq!((text.parse(), text.len()), (Ok(single), other.len()), "{text} {other}");
            }
            let moderate = (bits >> 40) as f64 * 1e-4;
            assert_eq!(moderate.value().text(Decimal::Point), by_the_standard_library(moderate));
        }
        for number in [0.0, -0.0, 1.0, 1e-3, 1e7, 9.999_999e6, 1e-5, 1e15, 1e16, 1e22, 5e-324, f64::MAX, 0.1, 123_456.0]
        {
            assert_eq!(number.value().text(Decimal::Point), by_the_standard_library(number + 0.0));
        }
        assert_eq!(1.5_f64.value().text(Decimal::Comma), "1,5");
    }
}
