//! Tables in xlsx workbooks.

use std::io::{Cursor, Read};

use calamine::{Data, Reader, Xlsx};

/// The first sheet of an xlsx workbook with cells, as CSV with commas and decimal points.
///
/// # Errors
/// The workbook cannot be read, or all of its sheets are empty.
pub(crate) fn in_csv(mut bytes: impl Read) -> Result<Vec<u8>, String> {
    let mut file = Vec::new();
    bytes.read_to_end(&mut file).map_err(|error| error.to_string())?;
    let in_words = |error: &dyn std::fmt::Display| format!("the workbook cannot be read: {error}; save it as CSV");
    let mut workbook = Xlsx::new(Cursor::new(file)).map_err(|error| in_words(&error))?;
    for sheet in workbook.sheet_names() {
        let cells = workbook.worksheet_range(&sheet).map_err(|error| in_words(&error))?;
        if cells.is_empty() {
            continue;
        }
        let mut rows = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
        for row in cells.rows() {
            rows.write_record(row.iter().map(text)).map_err(|error| in_words(&error))?;
        }
        return rows.into_inner().map_err(|error| in_words(&error));
    }
    Err("the workbook has no cells".into())
}

/// The text of a cell, a number with all of its digits.
fn text(cell: &Data) -> String {
    match cell {
        Data::Float(number) if number.abs() >= 1e16 || (*number != 0.0 && number.abs() < 1e-5) => format!("{number:e}"),
        other => other.to_string(),
    }
}
