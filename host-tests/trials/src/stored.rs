//! Statistics that are kept in the repository, and the guide's table of them.

use std::error::Error;
use std::fs;

use crate::solver::Number;
use crate::statistics::{Count, Statistics};

/// Scenes of each kind that stored statistics are from.
pub const SCENES: u64 = 1500;

/// Seed of these scenes.
pub const SEED: u64 = 1;

const STATISTICS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/trials.csv");
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/guide/pages/accuracy.md");

/// Writes statistics to `host-tests/data/trials.csv`, and the guide's table of them.
///
/// # Errors
/// A file that cannot be read or written, or a page without the table.
pub fn store(statistics: &[Statistics]) -> Result<(), Box<dyn Error>> {
    let page = with_table(&fs::read_to_string(PAGE)?, &guide_table(statistics)?)?;
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_path(STATISTICS)?;
    writer.write_record(Statistics::columns())?;
    for Statistics { names, counts } in statistics {
        writer.serialize((names, counts))?;
    }
    writer.flush()?;
    Ok(fs::write(PAGE, page)?)
}

/// Reads the statistics that are stored, in the order of the solvers.
///
/// # Errors
/// A file that cannot be read, or has other columns.
pub fn stored() -> Result<Vec<Statistics>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(STATISTICS)?;
    if !reader.headers()?.iter().eq(Statistics::columns()) {
        return Err(format!("the columns of {STATISTICS} are not the current ones; run `cargo trials --store`").into());
    }
    let rows = reader.deserialize().map(|row| {
        let (names, counts) = row?;
        Ok(Statistics { names, counts })
    });
    rows.collect()
}

/// The solvers in the guide: the recommended method, those that have a footprint there, and the paper's.
const IN_GUIDE: [(&str, Number); 11] = [
    ("Adaptive 1e-4", Number::Double),
    ("Adaptive 1e-6", Number::Double),
    ("Adaptive 1e-9", Number::Double),
    ("Adaptive 1e-12", Number::Double),
    ("Adaptive 1e-4", Number::Single),
    ("Adaptive 1e-6", Number::Single),
    ("Collocation 7, 1e-6", Number::Single),
    ("FixedCost 5 x 3", Number::Single),
    ("FixedCost 7 x 3", Number::Single),
    ("FixedCost 4 x 2", Number::Fixed),
    ("RungeKuttaGill 2000", Number::Double),
];

/// The counts in the guide, in percent.
const PERCENT: [Count; 7] = [
    Count::Refused,
    Count::Unsolved,
    Count::Undecided,
    Count::WrongOutcomes,
    Count::WrongClasses,
    Count::Beyond,
    Count::FarBeyond,
];

/// The first line of the guide's table.
fn header() -> String {
    row([&Statistics::NAMES[..], &["scenes"], &PERCENT.map(Count::name)].concat())
}

fn row(cells: Vec<&str>) -> String {
    format!("| {} |\n", cells.join(" | "))
}

/// The guide's table, with a line for each solver in it.
///
/// # Errors
/// A solver without statistics.
pub fn guide_table(statistics: &[Statistics]) -> Result<String, String> {
    let mut table = header() + &row(vec!["---"; 4 + PERCENT.len()]);
    for (method, number) in IN_GUIDE.map(|(method, number)| (method, number.name())) {
        let found = statistics.iter().find(|found| found.names[..2] == [method, number]);
        let found = found.ok_or_else(|| format!("no statistics of {method} in {number}"))?;
        let percent = PERCENT.map(|count| found.percent(count).map_or_else(String::new, two_digits));
        let cells = found.names.iter().cloned().chain([found.known().to_string()]).chain(percent).collect::<Vec<_>>();
        table += &row(cells.iter().map(String::as_str).collect());
    }
    Ok(table)
}

/// Two significant digits, or whole percents; zero only for none at all.
fn two_digits(percent: f64) -> String {
    // The exponent after rounding: 0.0998 is 0.10.
    let scientific = format!("{percent:.1e}");
    let exponent = scientific.split_once('e').map_or(Ok(0), |(_, exponent)| exponent.parse::<i32>());
    match exponent {
        Ok(exponent) if percent > 0.0 => format!("{percent:.*}", usize::try_from(1 - exponent).unwrap_or(0)),
        _ => percent.to_string(),
    }
}

/// A text with the table in place of the one that begins with the same line.
fn with_table(text: &str, table: &str) -> Result<String, String> {
    let split = text.split_once(&header());
    let (before, rest) = split.ok_or_else(|| format!("{PAGE} has no table that begins with\n{}", header()))?;
    // A table may end the page.
    let after = rest.split_once("\n\n").map_or_else(String::new, |(_, after)| format!("\n{after}"));
    Ok(format!("{before}{table}{after}"))
}

#[cfg(test)]
mod tests {
    use super::{header, two_digits, with_table};

    #[test]
    fn percents_have_two_digits() {
        for (percent, text) in
            [(0.0, "0"), (100.0, "100"), (61.27, "61"), (9.123, "9.1"), (0.0998, "0.10"), (0.000_567, "0.00057")]
        {
            assert_eq!(two_digits(percent), text);
        }
    }

    #[test]
    fn only_the_table_is_replaced() {
        let text = |rows: &str| format!("before\n\n{}{rows}\n\nafter\n\nend\n", header());
        let table = format!("{}| new |\n", header());
        assert_eq!(with_table(&text("| old |\n| older |"), &table), Ok(text("| new |")));
        let last = |rows: &str| format!("before\n\n{}{rows}\n", header());
        assert_eq!(with_table(&last("| old |\n| older |"), &table), Ok(last("| new |")));
        assert!(with_table("before\n\nafter\n", &table).is_err());
    }
}
