//! One row of a table: its numbers and its words.

use std::borrow::Cow;

use csv::ByteRecord;

use crate::columns::{Header, LABEL};
use crate::frame::Frame;
use crate::header::Heading;
use crate::units::is_unit;
use crate::value::{Scalar, Value};

/// One row of a table.
pub struct Row<'a> {
    pub(crate) frame: &'a Frame,
    pub(crate) cells: &'a ByteRecord,
    pub(crate) number: usize,
    /// Numbers that take the place of those in cells.
    pub(crate) replaced: Vec<(&'static str, f64)>,
}

/// The text of a cell without surrounding space; empty if the row is too short.
pub(crate) fn text(cells: &ByteRecord, index: usize) -> Cow<'_, str> {
    match String::from_utf8_lossy(cells.get(index).unwrap_or_default().trim_ascii()) {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
    }
}

/// The same of a cell that is read as a number: with a minus sign of ASCII.
pub(crate) fn text_of_number(cells: &ByteRecord, index: usize) -> Cow<'_, str> {
    let text = text(cells, index);
    if text.is_ascii() { text } else { Cow::Owned(text.replace('\u{2212}', "-")) }
}

/// Why a cell is refused that is not a number, and what to do.
fn why_no_number(text: &str) -> &'static str {
    if text.starts_with('=') {
        "is a formula without a value; calculate the workbook and save it again, or enter the number"
    } else if is_date_or_time(text) {
        "is a date or time; enter the number, and format the cell as a number"
    } else if has_groups_of_digits(text) {
        "is not a number; write it without thousands separators and spaces"
    } else if has_unit(text) {
        "is not a number; enter the number alone, and give its unit in the header"
    } else {
        "is not a number"
    }
}

/// Whether a text is a number but for spaces and marks between its digits, as 1.234,5 or 2 600.
fn has_groups_of_digits(text: &str) -> bool {
    let is_separator = |character: char| character.is_whitespace() || matches!(character, '.' | ',' | '\'' | '’' | '_');
    let digits = text.trim_start_matches(['+', '-']);
    digits.starts_with(|first: char| first.is_ascii_digit())
        && digits.chars().all(|character| character.is_ascii_digit() || is_separator(character))
}

/// Whether a text is a number with a unit behind it.
fn has_unit(text: &str) -> bool {
    let end = text.rfind(|character: char| character.is_ascii_digit()).map_or(0, |last| last + 1);
    let unit_at = text.find(char::is_whitespace).unwrap_or(end);
    let (number, unit) = text.split_at(unit_at);
    number.replace(',', ".").parse::<f64>().is_ok() && is_unit(unit)
}

/// Whether a text is a date or a time, as 2026-09-02, 2/9/2026 or 2:09.
fn is_date_or_time(text: &str) -> bool {
    let parts = text.chars().all(|character| character.is_ascii_digit() || "-/:. T".contains(character));
    parts && (text.contains(':') || text.trim_start_matches('-').matches(['-', '/']).count() > 1)
}

impl<'a> Row<'a> {
    /// The same row with another number in a column, which it need not have.
    #[must_use]
    pub fn with<T: Scalar>(&self, column: &'static str, value: T) -> Row<'a> {
        self.with_all([(column, value)])
    }

    /// The same row with other numbers in some columns, which it need not have.
    #[must_use]
    pub fn with_all<T: Scalar>(&self, numbers: impl IntoIterator<Item = (&'static str, T)>) -> Row<'a> {
        let mut row = Row { replaced: self.replaced.clone(), ..*self };
        for (column, value) in numbers {
            row.replaced.retain(|(other, _)| *other != column);
            row.replaced.push((column, value.to_f64()));
        }
        row
    }

    /// The number that takes the place of that in a column.
    fn replaced(&self, column: &str) -> Option<f64> {
        self.replaced.iter().find(|(other, _)| *other == column).map(|(_, number)| *number)
    }

    /// The text of a cell without surrounding space; `None` if there is no such column or the cell is empty.
    #[must_use]
    pub fn text(&self, column: &str) -> Option<Cow<'_, str>> {
        if let Some(number) = self.replaced(column) {
            return Some(Cow::Owned(format!("{number:e}")));
        }
        Some(text(self.cells, self.frame.place(column)?)).filter(|text| !text.is_empty())
    }

    /// The name of the row, or its number.
    #[must_use]
    pub fn label(&self) -> String {
        self.text(LABEL).map_or_else(|| format!("row {}", self.number), Cow::into_owned)
    }

    /// Whether a cell has a text.
    #[must_use]
    pub fn has(&self, column: &str) -> bool {
        self.text(column).is_some()
    }

    /// The names of the columns.
    #[must_use]
    pub fn header(&self) -> Header<'a> {
        self.frame.header()
    }

    /// The number of this row; that below the header is 1.
    #[must_use]
    pub fn index(&self) -> usize {
        self.number
    }

    /// The name by which a message calls a column: that of the header.
    pub fn name_in_header<'b>(&'b self, column: &'b str) -> &'b str {
        let heading = self.frame.place(column).and_then(|index| self.frame.headings.get(index));
        heading.map_or(column, Heading::name_in_messages)
    }

    /// The number in a cell, in the unit of the catalogue; `None` if there is no such column or the cell is empty. The column is
    /// one of the inputs with which the table was opened.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words. A number that the type rounds to zero is an error.
    pub fn number<T: Scalar>(&self, column: &str) -> Result<Option<T>, String> {
        debug_assert!(self.frame.inputs.iter().any(|input| input.columns().contains(&column)), "{column} is no input");
        if !self.replaced.is_empty()
            && let Some(number) = self.replaced(column)
        {
            return Ok(Some(T::constant(number)));
        }
        let Some(index) = self.frame.place(column) else {
            return Ok(None);
        };
        let text = text_of_number(self.cells, index);
        if text.is_empty() {
            return Ok(None);
        }
        let with_point = self.frame.convention.with_point(&self.frame.cell(index, self.number, &text))?;
        let number = match self.frame.headings.get(index).and_then(|heading| heading.unit) {
            Some(unit) => unit.in_si(&with_point).map_or(with_point, Cow::Owned),
            None => with_point,
        };
        let refused = |reason: &str| format!("{}: \"{text}\" {reason}", self.name_in_header(column));
        let value: T = number.parse().map_err(|_| refused(why_no_number(&text)))?;
        if value == T::ZERO {
            let mantissa = number.split(['e', 'E']).next().unwrap_or_default();
            if mantissa.contains(|c: char| matches!(c, '1'..='9')) {
                let scalar = std::any::type_name::<T>();
                return Err(refused(&format!("is refused: it is too small for {scalar}, which would make it 0")));
            }
        }
        Ok(Some(value))
    }

    /// The number in a cell that must not be empty.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn required<T: Scalar>(&self, column: &str) -> Result<T, String> {
        self.number(column)?.ok_or_else(|| format!("{}: missing; enter a number", self.name_in_header(column)))
    }

    /// The number in a cell, zero if it is empty.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn or_zero<T: Scalar>(&self, column: &str) -> Result<T, String> {
        Ok(self.number(column)?.unwrap_or(T::ZERO))
    }

    /// Checks that the row has no more cells than the header. Empty ones are no cells.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn check(&self) -> Result<(), String> {
        let width = self.frame.headings.len();
        if self.cells.len() <= width {
            return Ok(());
        }
        let surplus: Vec<_> =
            (width..self.cells.len()).map(|index| text(self.cells, index)).filter(|text| !text.is_empty()).collect();
        if surplus.is_empty() {
            return Ok(());
        }
        Err(format!("the row has more cells than the header; these are not copied: {}", surplus.join(" | ")))
    }

    /// The text of a number in the convention of the table.
    #[must_use]
    pub fn text_of<T: Scalar>(&self, value: T) -> String {
        value.value().text(self.frame.convention.decimal())
    }

    /// What a given cell holds: a number if the catalogue says so.
    pub(crate) fn given(&self, index: usize) -> Value {
        let text = text(self.cells, index);
        let Some(heading) = self.frame.headings.get(index) else {
            return Value::Empty;
        };
        let number = || {
            let with_point = self.frame.convention.with_point(&self.frame.cell(index, self.number, &text)).ok()?;
            with_point.parse::<f64>().ok().filter(|number| number.is_finite())
        };
        match number().filter(|_| heading.is_number()) {
            Some(number) => Value::Double(number),
            None => Value::from(text.into_owned()),
        }
    }
}
