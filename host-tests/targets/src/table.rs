//! The table of targets and features, in Markdown.

use crate::check::{FEATURES, Row, Support};

const NOTES: &str = "\
yes¹: together with the feature `portable-atomic`.
yes²: together with the feature `portable-atomic`, and with the feature `critical-section` or `unsafe-assume-single-core` of the
package [`portable-atomic`](https://docs.rs/portable-atomic), which your binary chooses:
`portable-atomic = { version = \"1\", features = [\"critical-section\"] }`.
-: the target has no standard library.";

impl Support {
    /// What a cell of the table says.
    fn text(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::PortableAtomic => "yes¹",
            Self::ChosenPortableAtomic => "yes²",
            Self::NoStandardLibrary => "-",
        }
    }
}

/// The table; a row that was not checked is that of the stored table.
pub(crate) fn table(rows: &[Row], stored: &str) -> String {
    let names =
        FEATURES.map(|feature| if feature.is_empty() { "no feature".to_owned() } else { format!("`{feature}`") });
    let mut lines =
        vec![format!("| target | {} |", names.join(" | ")), format!("| --- |{}", " --- |".repeat(names.len()))];
    for Row { triple, support } in rows {
        let start = format!("| `{triple}` |");
        let line = match support {
            Some(support) => Some(format!("{start} {} |", support.map(Support::text).join(" | "))),
            None => stored.lines().find(|line| line.starts_with(&start)).map(str::to_owned),
        };
        lines.extend(line);
    }
    format!("{}\n\n{NOTES}", lines.join("\n"))
}

/// The lines that only one of two texts has.
pub(crate) fn differing<'a>(one: &'a str, other: &'a str) -> Vec<&'a str> {
    let only =
        |one: &'a str, other: &'a str| one.lines().filter(move |line| !other.lines().any(|other| other == *line));
    only(one, other).chain(only(other, one)).collect()
}
