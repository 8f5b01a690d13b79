//! Axes: what they show, how far they reach, and the numbers that stand at them.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;

/// A direction of a drawing.
#[derive(Clone)]
pub(crate) struct Axis {
    /// Name, symbol and unit.
    pub(super) label: String,
    pub(super) logarithmic: bool,
    pub(super) range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis that reaches as far as the data; the unit of a pure number is `1`.
    pub(crate) fn linear(name: &str, symbol: &str, unit: &str) -> Self {
        Self::labelled(format!("{name} {symbol} [{unit}]"))
    }

    /// A logarithmic axis that reaches as far as the positive data.
    pub(crate) fn logarithmic(name: &str, symbol: &str, unit: &str) -> Self {
        Self { logarithmic: true, ..Self::linear(name, symbol, unit) }
    }

    /// A linear axis with a whole label.
    pub(super) fn labelled(label: String) -> Self {
        Self { label, logarithmic: false, range: None }
    }

    /// The axis with ends of its own.
    pub(crate) fn between(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }

    pub(super) fn can_show(&self, value: f64) -> bool {
        let inside = |(low, high)| (low..=high).contains(&value);
        value.is_finite() && (value > 0.0 || !self.logarithmic) && self.range.is_none_or(inside)
    }

    /// The axis for values.
    pub(super) fn over(&self, values: impl Iterator<Item = f64>) -> Scale {
        let extent = values.filter(|value| self.can_show(*value)).map(|value| Scale::flatten(value, self.logarithmic));
        let (low, high) = match self.range {
            Some((low, high)) => (Scale::flatten(low, self.logarithmic), Scale::flatten(high, self.logarithmic)),
            None => {
                let (low, high) =
                    extent.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
                let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
                let room = if high > low { 0.04 * (high - low) } else { 0.5 };
                (low - room, high + room)
            }
        };
        Scale { flat: (low..high).into(), low, high, logarithmic: self.logarithmic }
    }
}

/// An axis with its ends; positions on a logarithmic one are common logarithms.
#[derive(Clone)]
pub(super) struct Scale {
    flat: RangedCoordf64,
    pub(super) low: f64,
    pub(super) high: f64,
    logarithmic: bool,
}

impl Scale {
    pub(super) fn flatten(value: f64, logarithmic: bool) -> f64 {
        if logarithmic { value.log10() } else { value }
    }

    pub(super) fn unflatten(&self, position: f64) -> f64 {
        if self.logarithmic { 10_f64.powf(position) } else { position }
    }

    /// Where a value lies between the ends, from 0 to 1.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        ((Self::flatten(value, self.logarithmic) - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.flat.map(&Self::flatten(*value, self.logarithmic), limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if !self.logarithmic {
            return self.flat.key_points(hint);
        }
        let room = hint.bold_points().max(1);
        let (first, last) = (self.low.ceil() as i32, self.high.floor() as i32);
        let decades = usize::try_from(last - first + 1).unwrap_or(0);
        let digits: &[f64] = match self.high - self.low {
            _ if decades >= 3 => &[1.0],
            length if length < 0.7 => &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
            _ => &[1.0, 2.0, 5.0],
        };
        let stride = decades.div_ceil(room).max(1);
        let points = (first - 1..=last).filter(|decade| (decade - first).rem_euclid(stride as i32) == 0);
        let points = points.flat_map(|decade| digits.iter().map(move |digit| digit * 10_f64.powi(decade)));
        points.filter(|value| (self.low..=self.high).contains(&value.log10())).collect()
    }

    fn range(&self) -> Range<f64> {
        self.unflatten(self.low)..self.unflatten(self.high)
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let plain = |value: f64| {
            let text = format!("{value:.6}");
            let text = text.trim_end_matches('0').trim_end_matches('.');
            if text == "-0" { "0".to_owned() } else { text.to_owned() }
        };
        if *value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
            return plain(*value);
        }
        if !self.logarithmic && value.abs() < 1e-9 * (self.high - self.low) {
            return "0".to_owned();
        }
        let scientific = format!("{value:e}");
        let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        let digits = digits.parse().map_or_else(|_| digits.to_owned(), plain);
        let power = format!("10{}", exponent.chars().map(superscript).collect::<String>());
        if digits == "1" { power } else { format!("{digits}·{power}") }
    }
}

fn superscript(digit: char) -> char {
    let place = digit.to_digit(10).and_then(|digit| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize));
    place.unwrap_or('⁻')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(axis: &Axis, low: f64, high: f64) -> Scale {
        axis.clone().between(low, high).over(std::iter::empty())
    }

    #[test]
    fn decades_are_marked_as_far_as_there_is_room() {
        let logarithmic = |low, high| scale(&Axis::logarithmic("", "", ""), low, high).key_points(8);
        assert_eq!(logarithmic(0.5, 2000.0), [1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(logarithmic(1.5, 60.0), [2.0, 5.0, 10.0, 20.0, 50.0]);
        let many = logarithmic(1e-14, 1.0);
        assert_eq!(logarithmic(2e4, 8e4), [2e4, 3e4, 5e4, 7e4]);
        assert!(many.len() <= 8 && many.len() > 4 && many.iter().all(|value| value.log10().fract().abs() < 1e-9));
    }

    #[test]
    fn marks_are_readable() {
        let logarithmic = scale(&Axis::logarithmic("", "", ""), 1e-9, 1e9);
        for (value, text) in [(1e-6, "10⁻⁶"), (2e7, "2·10⁷"), (0.01, "0.01"), (10.0, "10")] {
            assert_eq!(logarithmic.format_ext(&value), text);
        }
        let linear = scale(&Axis::linear("", "", ""), -1.0, 1.0);
        for (value, text) in [(0.1 + 0.2, "0.3"), (-1e-17, "0"), (-0.5, "-0.5")] {
            assert_eq!(linear.format_ext(&value), text);
        }
    }
}
