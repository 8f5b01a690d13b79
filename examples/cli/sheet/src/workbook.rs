//! Tables in xlsx workbooks.

use std::fmt::Display;
use std::io::{Cursor, Read};

use calamine::{Data, Dimensions, ExcelDateTime, Range, Reader, Sheet, SheetType, SheetVisible, Xlsx};

use crate::COMMENT;

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
/// The workbook cannot be read, all of its sheets are empty or hidden, or cells of the sheet are merged.
pub(crate) fn first_sheet(mut bytes: impl Read) -> Result<Worksheet, String> {
    let mut file = Vec::new();
    bytes.read_to_end(&mut file).map_err(|error| error.to_string())?;
    let mut workbook = Xlsx::new(Cursor::new(file)).map_err(unreadable)?;
    let sheets = workbook.sheets_metadata().to_vec();
    let is_shown = |sheet: &&Sheet| sheet.visible == SheetVisible::Visible && sheet.typ == SheetType::WorkSheet;
    for sheet in sheets.iter().filter(is_shown) {
        let cells = workbook.worksheet_range(&sheet.name).map_err(unreadable)?;
        let formulas = workbook.worksheet_formula(&sheet.name).map_err(unreadable)?;
        let Some(table) = bounds(&cells, &formulas) else { continue };
        let merged = workbook.merge_cells_by_sheet_name(&sheet.name).map_err(unreadable)?;
        if let Some(merged) = merged.iter().find(|merged| !is_in_comment(merged, &cells, table)) {
            let (first, last) = (address(merged.start), address(merged.end));
            return Err(format!(
                "the cells {first}:{last} of sheet \"{}\" are merged, so that all but {first} are empty; unmerge them, and fill \
                 each or leave it empty",
                sheet.name
            ));
        }
        let text = |row, column| match (cells.get_value((row, column)), formulas.get_value((row, column))) {
            (None | Some(Data::Empty), Some(formula)) if !formula.is_empty() => {
                format!("={}", formula.trim_start_matches('='))
            }
            (cell, _) => cell.map_or_else(String::new, text),
        };
        let mut rows = csv::WriterBuilder::new().flexible(true).comment(Some(COMMENT)).from_writer(Vec::new());
        for row in table.start.0..=table.end.0 {
            rows.write_record((table.start.1..=table.end.1).map(|column| text(row, column))).map_err(unreadable)?;
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

/// The smallest range with all values and all formulas, which may lack a value; `None` if there are none.
fn bounds(cells: &Range<Data>, formulas: &Range<String>) -> Option<Dimensions> {
    let range = |start: Option<_>, end: Option<_>| Some(Dimensions::new(start?, end?));
    match (range(cells.start(), cells.end()), range(formulas.start(), formulas.end())) {
        (Some(a), Some(b)) => Some(Dimensions::new(
            (a.start.0.min(b.start.0), a.start.1.min(b.start.1)),
            (a.end.0.max(b.end.0), a.end.1.max(b.end.1)),
        )),
        (cells, formulas) => cells.or(formulas),
    }
}

/// Whether merged cells are those of a comment or a title: of one row, which begins with # or has no other cell.
fn is_in_comment(merged: &Dimensions, cells: &Range<Data>, table: Dimensions) -> bool {
    let row = (table.start.1..=table.end.1).filter_map(|column| cells.get_value((merged.start.0, column)));
    let mut filled = row.map(text).filter(|text| !text.trim().is_empty());
    let first = filled.next();
    let is_alone = filled.next().is_none();
    merged.start.0 == merged.end.0 && first.is_none_or(|text| is_alone || text.trim_start().starts_with('#'))
}

/// The address of a cell as spreadsheets write it, B3 for the third row of the second column.
fn address((row, column): (u32, u32)) -> String {
    const LETTERS: u32 = 26;
    let (mut letters, mut left) = (String::new(), column + 1);
    while left > 0 {
        letters.extend(char::from_digit((left - 1) % LETTERS + 10, 10 + LETTERS));
        left = (left - 1) / LETTERS;
    }
    let letters: String = letters.to_uppercase().chars().rev().collect();
    format!("{letters}{}", row + 1)
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

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// A date, a time or both in the form of ISO 8601, which is not read as a number.
fn date_or_time(moment: &ExcelDateTime) -> String {
    let days = moment.as_f64();
    let (year, month, day, hour, minute, second, _) = moment.to_ymd_hms_milli();
    let time = format!("{hour:02}:{minute:02}:{second:02}");
    if moment.is_duration() {
        let seconds = (days.abs() * DAY).round();
        let sign = if days < 0.0 { "-" } else { "" };
        return format!(
            "{sign}{}:{:02}:{:02}",
            (seconds / 3600.0).trunc(),
            (seconds / 60.0).trunc() % 60.0,
            seconds % 60.0
        );
    }
    // The day 0 of a spreadsheet is that of times without a date.
    if (0.0..1.0).contains(&days) {
        return time;
    }
    let date = format!("{year:04}-{month:02}-{day:02}");
    if days.fract() == 0.0 { date } else { format!("{date} {time}") }
}
