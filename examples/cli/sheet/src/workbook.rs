//! Tables in xlsx workbooks.

use std::fmt::Display;
use std::io::{Cursor, Read};

use calamine::{Data, ExcelDateTime, Reader, Sheet, SheetType, SheetVisible, Xlsx};

/// A sheet of a workbook.
pub(crate) struct Worksheet {
    /// Its cells as CSV with commas and decimal points.
    pub(crate) csv: Vec<u8>,
    /// Its name in quotes.
    pub(crate) name: String,
    /// The names of the others, which are not read.
    pub(crate) others: Vec<String>,
}

/// The first sheet of an xlsx workbook with cells that is not hidden.
///
/// # Errors
/// The workbook cannot be read, or all of its sheets are empty or hidden.
pub(crate) fn first_sheet(mut bytes: impl Read) -> Result<Worksheet, String> {
    let mut file = Vec::new();
    bytes.read_to_end(&mut file).map_err(|error| error.to_string())?;
    let mut workbook = Xlsx::new(Cursor::new(file)).map_err(unreadable)?;
    let sheets = workbook.sheets_metadata().to_vec();
    let is_shown = |sheet: &&Sheet| sheet.visible == SheetVisible::Visible && sheet.typ == SheetType::WorkSheet;
    for sheet in sheets.iter().filter(is_shown) {
        let cells = workbook.worksheet_range(&sheet.name).map_err(unreadable)?;
        if cells.is_empty() {
            continue;
        }
        let mut rows = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
        for row in cells.rows() {
            rows.write_record(row.iter().map(text)).map_err(unreadable)?;
        }
        let others = sheets.iter().filter(|other| other.name != sheet.name).map(|other| {
            let hidden = if other.visible == SheetVisible::Visible { "" } else { " (hidden)" };
            format!("\"{}\"{hidden}", other.name)
        });
        let (name, others) = (format!("\"{}\"", sheet.name), others.collect());
        return Ok(Worksheet { csv: rows.into_inner().map_err(unreadable)?, name, others });
    }
    Err("the workbook has no cells in a sheet that is not hidden".into())
}

fn unreadable(error: impl Display) -> String {
    format!("the workbook cannot be read: {error}; save it as CSV")
}

/// The text of a cell, a number with all of its digits.
fn text(cell: &Data) -> String {
    match cell {
        Data::Float(number) if number.abs() >= 1e16 || (*number != 0.0 && number.abs() < 1e-5) => format!("{number:e}"),
        Data::DateTime(moment) => date_or_time(moment),
        other => other.to_string(),
    }
}

/// Minutes of a day.
const DAY: f64 = 1440.0;

/// A date, a time or both in the form of ISO 8601, which is not read as a number.
fn date_or_time(moment: &ExcelDateTime) -> String {
    let days = moment.as_f64();
    let (year, month, day, hour, minute, second, _) = moment.to_ymd_hms_milli();
    let time = format!("{hour:02}:{minute:02}:{second:02}");
    if moment.is_duration() {
        let minutes = (days * DAY).abs();
        return format!(
            "{}{}:{:02}",
            if days < 0.0 { "-" } else { "" },
            (minutes / 60.0).trunc(),
            minutes.trunc() % 60.0
        );
    }
    // The day 0 of a spreadsheet is that of times without a date.
    if (0.0..1.0).contains(&days) {
        return time;
    }
    let date = format!("{year:04}-{month:02}-{day:02}");
    if days.fract() == 0.0 { date } else { format!("{date} {time}") }
}
