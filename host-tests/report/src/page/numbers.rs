//! Numbers as text: all digits in files, four on the page.

use crate::content::Cell;

/// All digits.
pub(super) fn exact(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) => text.clone(),
        Cell::Link(text, _) => (*text).to_owned(),
        Cell::Number(None) => String::new(),
        Cell::Number(Some(number)) if *number == 0.0 || (1e-4..1e7).contains(&number.abs()) => number.to_string(),
        Cell::Number(Some(number)) => format!("{number:e}"),
        Cell::Count(count) => count.to_string(),
    }
}

/// Four significant digits.
pub(super) fn short(cell: &Cell) -> String {
    match cell {
        Cell::Number(Some(number)) => significant(*number),
        _ => exact(cell),
    }
}

fn significant(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return number.to_string();
    }
    // The exponent after rounding: 9.9996 is 10.00.
    let scientific = format!("{number:.3e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let zeros = |text: &str| match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => text.to_owned(),
    };
    match exponent.parse::<i32>() {
        Ok(exponent @ -3..=4) => zeros(&format!("{number:.*}", usize::try_from(3 - exponent).unwrap_or(0))),
        _ => format!("{}e{exponent}", zeros(digits)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        for (number, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-2.8, "-2.8"),
            (0.746_193_2, "0.7462"),
            (9.999_96, "10"),
            (41_714.3, "41714"),
            (0.001_234_56, "0.001235"),
            (4.251_18e-8, "4.251e-8"),
            (-7.5e10, "-7.5e10"),
        ] {
            assert_eq!(significant(number), text);
        }
    }

    #[test]
    fn files_have_all_digits() {
        for number in [0.1 + 0.2, 4.251_184_950_650_474_4e-8, -1e300, 5e-324, 0.0] {
            assert_eq!(exact(&Cell::Number(Some(number))).parse(), Ok(number));
        }
        assert_eq!(exact(&Cell::Number(None)), "");
    }
}
