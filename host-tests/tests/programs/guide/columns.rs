//! The guide's list of columns is that of `microimpact columns`.

use std::fmt::Write;

use serde_json::Value;

use super::{folder, keep_current};

/// A table of those columns that a command uses.
fn table(columns: &[Value], used: &str, heads: &[(&str, &str)]) -> String {
    let titles: Vec<_> = heads.iter().map(|(_, title)| *title).collect();
    let mut table = format!("| {} |\n|{}\n", titles.join(" | "), " --- |".repeat(heads.len()));
    for column in columns.iter().filter(|column| column[used].as_str().is_some_and(|commands| !commands.is_empty())) {
        let cells = heads.iter().map(|(key, _)| {
            let text = column[*key].as_str().unwrap_or_default().replace('|', "\\|");
            if *key == "column" { format!("`{text}`") } else { text.replace('*', "\\*").replace('_', "\\_") }
        });
        writeln!(table, "| {} |", cells.collect::<Vec<_>>().join(" | ")).unwrap();
    }
    table
}

/// The page, from the list of the program.
fn page() -> String {
    let output = crate::microimpact("columns", &["--format", "json"], b"");
    let columns: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert!(columns.len() > 100);
    let introduction = include_str!("../../../../examples/guide/source/columns.md");
    let read = [
        ("column", "column"),
        ("unit", "unit"),
        ("range", "range"),
        ("default", "default"),
        ("read_by", "read by"),
        ("meaning", "meaning"),
    ];
    let written = [
        ("column", "column"),
        ("unit", "unit"),
        ("range", "range"),
        ("written_by", "written by"),
        ("meaning", "meaning"),
    ];
    let (read, written) = (table(&columns, "read_by", &read), table(&columns, "written_by", &written));
    format!(
        "{introduction}\n## Columns that the commands read\n\n{read}\n## Columns that the commands write\n\n{written}"
    )
}

#[test]
fn list_of_columns_is_current() {
    keep_current(folder().join("pages/columns.md"), &page(), false);
}

#[test]
#[ignore = "writes the list of columns anew"]
fn write_columns() {
    keep_current(folder().join("pages/columns.md"), &page(), true);
}
