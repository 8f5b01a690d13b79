//! Words in cells and options.

use clap::ValueEnum;
use microimpact::{Class, Outcome, SurfaceMotion};
use sheet::Row;

/// The word for a value.
pub fn name_of(value: &impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// The value whose word is in a cell, in capitals or not; `None` if there is no such column or the cell is empty.
pub fn word<V: ValueEnum>(row: &Row<'_>, column: &str, allowed: &[V]) -> Result<Option<V>, String> {
    let Some(text) = row.text(column) else {
        return Ok(None);
    };
    let value = allowed.iter().find(|value| name_of(*value).eq_ignore_ascii_case(&text));
    value.cloned().map(Some).ok_or_else(|| {
        let words: Vec<_> = allowed.iter().map(name_of).collect();
        format!("{column}: \"{text}\" is refused: it must be {}", words.join(" or "))
    })
}

/// Least probability of a class that is named, where no other is given.
pub const LEVEL: f64 = 0.9;

/// A probability in an option.
pub fn probability(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number| (0.0..=1.0).contains(number));
    number.ok_or_else(|| "it is a probability; enter a number from 0 to 1".into())
}

/// The class of a sphere that moves on: one that is captured and rests counts as rolling.
pub fn moving(class: Class) -> Class {
    if class == Class::CapturedResting { Class::CapturedRolling } else { class }
}

/// The word for a class that the data do not decide.
pub const CANNOT_TELL: &str = "cannot tell";

/// How an impact ends.
pub fn outcome_name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Rebound => "rebound",
        Outcome::Capture => "capture",
        Outcome::Undecided => "undecided",
    }
}

/// How the contact point moves.
pub fn motion_name(motion: SurfaceMotion) -> &'static str {
    match motion {
        SurfaceMotion::Sliding => "sliding",
        SurfaceMotion::Rolling => "rolling",
        SurfaceMotion::Resting => "resting",
    }
}
