//! What the page shows of a table.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Write;

use microimpact_cli::Streams;
use serde_json::{Value, json};
use sheet::catalogue::COLUMNS;
use sheet::{Decimal, Row, Sheet};

/// Writes the headings of a table, each with the column that it names and its name as any column whose unit it states, and the
/// headings that a column may have, one for each unit.
pub fn columns(streams: &mut Streams<'_>) -> Result<(), String> {
    let headings: Vec<_> = sheet::headings(&mut *streams.input)?
        .into_iter()
        .map(|(heading, named)| {
            let stated = COLUMNS.iter().filter_map(|column| Some((column.name, column.name_in_unit_of(&heading)?)));
            let stated: BTreeMap<_, _> = stated.collect();
            json!({ "text": heading, "column": named, "stated": stated })
        })
        .collect();
    let units: BTreeMap<_, _> = COLUMNS.iter().map(|column| (column.name, column.names())).collect();
    write(&json!({ "headings": headings, "units": units }), streams.output)
}

/// Writes how many rows a classified table has, how many of them are bad, how often each class occurs, and its first rows.
pub fn summary(first: usize, streams: &mut Streams<'_>) -> Result<(), String> {
    let mut sheet = Sheet::open(&mut *streams.input, &[], Some(Decimal::Point))?;
    let names: Vec<String> = sheet.header().names().map(String::from).collect();
    let (mut rows, mut bad, mut shown) = (0_u64, 0_u64, Vec::new());
    let mut classes = BTreeMap::<_, u64>::new();
    while let Some(row) = sheet.next_row()? {
        rows += 1;
        if row.has("error") {
            bad += 1;
        } else {
            *classes.entry(class(&row)).or_default() += 1;
        }
        if shown.len() < first {
            let cell = |name: &String| row.text(name).map(Cow::into_owned).unwrap_or_default();
            shown.push(names.iter().map(cell).collect::<Vec<_>>());
        }
    }
    drop(sheet);
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
