//! What the page shows of a table.

use std::collections::BTreeMap;
use std::io::Write;

use microimpact_cli::Streams;
use serde_json::{Value, json};
use sheet::{Decimal, Row, Sheet};

/// Writes the names of the columns.
pub fn columns(streams: &mut Streams<'_>) -> Result<(), String> {
    // The mark does not matter where no number is read.
    let sheet = Sheet::open(&mut *streams.input, &[], Some(Decimal::Point))?;
    write(&json!(sheet.header().names().collect::<Vec<_>>()), streams.output)
}

/// Copies a table with other names for some of its columns: old and new ones by turns.
pub fn rename(names: &[String], streams: &mut Streams<'_>) -> Result<(), String> {
    let pairs: Vec<_> = names.chunks_exact(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect();
    sheet::rename(&mut *streams.input, &pairs, &mut *streams.output)
}

/// Writes how many rows a classified table has, how many of them are bad, how often each class occurs, and its first rows.
pub fn summary(first: usize, streams: &mut Streams<'_>) -> Result<(), String> {
    let mut sheet = Sheet::open(&mut *streams.input, &[], Some(Decimal::Point))?;
    let names: Vec<String> = sheet.header().names().map(String::from).collect();
    let (mut rows, mut bad, mut shown) = (0_u64, 0_u64, Vec::new());
    let mut classes = BTreeMap::<_, u64>::new();
    while let Some(row) = sheet.next_row()? {
        rows += 1;
        if row.text("error").is_some() {
            bad += 1;
        } else {
            *classes.entry(class(&row)).or_default() += 1;
        }
        if shown.len() < first {
            shown.push(names.iter().map(|name| row.text(name).unwrap_or_default()).collect::<Vec<_>>());
        }
    }
    write(&json!({ "rows": rows, "bad": bad, "classes": classes, "names": names, "first": shown }), streams.output)
}

/// The class of a row in words, from its outcome and the motion along the surface.
fn class(row: &Row<'_>) -> String {
    let outcome = row.text("outcome").map(|outcome| if outcome == "capture" { "captured".into() } else { outcome });
    [outcome, row.text("motion")].into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn write(value: &Value, output: &mut dyn Write) -> Result<(), String> {
    writeln!(output, "{value}").map_err(|error| error.to_string())
}
