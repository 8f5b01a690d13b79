//! CSV tables of impacts in the variants that spreadsheets write.
//!
//! Commas, semicolons or tabs separate cells. A byte-order mark, quotes, CRLF line ends and decimal commas are read, and the
//! result is written in the same variant. A table has one decimal mark, which the columns that are read decide.

mod columns;
mod decimal;
mod refusal;
mod rename;

use std::collections::VecDeque;
use std::error::Error;
use std::fmt::{Display, LowerExp};
use std::io::{self, BufRead, Read, Write};
use std::str::FromStr;

use csv::ByteRecord;
use microimpact::Real;

pub use columns::{Header, Input, LABEL};
pub use decimal::Decimal;
use decimal::{Cell, Convention, JUDGED_ROWS, Judge};
pub use rename::rename;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// A number type that can be read from a cell and written to one.
pub trait Scalar: Real + FromStr + Display + LowerExp {}

impl<T: Real + FromStr + Display + LowerExp> Scalar for T {}

/// The variant of CSV of a table.
#[derive(Clone, Copy)]
pub struct Dialect {
    delimiter: u8,
    byte_order_mark: bool,
    carriage_return: bool,
}

impl Dialect {
    /// The dialect of a table, from its header line.
    fn of(header: &[u8]) -> Self {
        let outside_quotes = |delimiter: u8| {
            let mut quoted = false;
            header
                .iter()
                .filter(|&&byte| {
                    quoted ^= byte == b'"';
                    byte == delimiter && !quoted
                })
                .count()
        };
        // `max_by_key` keeps the last of equals, so the comma is chosen for a header of one cell.
        let delimiter = [b'\t', b';', b','].into_iter().max_by_key(|&delimiter| outside_quotes(delimiter));
        Self {
            delimiter: delimiter.unwrap_or(b','),
            byte_order_mark: header.starts_with(BYTE_ORDER_MARK),
            carriage_return: header.ends_with(b"\r\n"),
        }
    }
}

/// A table that is read row by row.
pub struct Sheet<R> {
    rows: csv::Reader<R>,
    header: ByteRecord,
    names: Vec<String>,
    dialect: Dialect,
    inputs: Vec<Input>,
    convention: Convention,
    /// Rows that were read when the table was opened.
    judged: VecDeque<ByteRecord>,
    /// Rows that were given out.
    given: usize,
}

impl<'a> Sheet<Box<dyn BufRead + 'a>> {
    /// Opens a table from which a command reads `inputs`: reads its header and its first row. Unless `decimal` gives the
    /// decimal mark, it reads the first 1000 rows and judges the mark from them.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words: required columns are absent, there are no rows, or the marks of all
    /// cells may separate thousands.
    pub fn open(mut source: impl BufRead + 'a, inputs: &[Input], decimal: Option<Decimal>) -> Result<Self, String> {
        let mut header_line = Vec::new();
        source.read_until(b'\n', &mut header_line).map_err(|error| error.to_string())?;
        let dialect = Dialect::of(&header_line);
        let bytes: Box<dyn BufRead> = Box::new(io::Cursor::new(header_line).chain(source));
        let mut rows = csv::ReaderBuilder::new().delimiter(dialect.delimiter).flexible(true).from_reader(bytes);
        let header = rows.byte_headers().map_err(|error| error.to_string())?.clone();
        let names: Vec<String> = header.iter().map(column_name).collect();
        if names.iter().all(String::is_empty) {
            return Err("the table is empty; its first row must name the columns".into());
        }
        if let Some(twice) = names.iter().enumerate().find(|(i, name)| !name.is_empty() && names[..*i].contains(name)) {
            return Err(format!("the header names the column {} twice; rename or remove one", twice.1));
        }
        columns::check(&names, inputs)?;
        let mut judged: VecDeque<_> = next_cells(&mut rows)?.into_iter().collect();
        if judged.is_empty() {
            return Err("the table has no rows below its header, so there is nothing to compute".into());
        }
        let convention = match decimal {
            Some(decimal) => Convention::chosen(decimal),
            None => {
                let is_read = |name: &String| inputs.iter().any(|input| input.columns().contains(&name.as_str()));
                let read: Vec<_> = names.iter().enumerate().filter(|(_, name)| is_read(name)).collect();
                let mut judge = Judge::default();
                while judged.len() < JUDGED_ROWS
                    && let Some(cells) = next_cells(&mut rows)?
                {
                    judged.push_back(cells);
                }
                for (row, cells) in judged.iter().enumerate() {
                    for (index, column) in &read {
                        let text = text(cells, *index);
                        judge.add(&Cell { row: row + 1, column, text: &text });
                    }
                }
                judge.convention(dialect.delimiter == b',')?
            }
        };
        Ok(Self { rows, header, names, dialect, inputs: inputs.to_vec(), convention, judged, given: 0 })
    }
}

/// The cells of the next row, or `None` after the last.
fn next_cells<R: Read>(rows: &mut csv::Reader<R>) -> Result<Option<ByteRecord>, String> {
    let mut cells = ByteRecord::new();
    let more = rows.read_byte_record(&mut cells).map_err(|error| error.to_string())?;
    Ok(more.then_some(cells))
}

/// The text of a cell without surrounding space; empty if the row is too short.
fn text(cells: &ByteRecord, index: usize) -> String {
    String::from_utf8_lossy(cells.get(index).unwrap_or_default()).trim().to_owned()
}

/// The name in a header cell: without a byte-order mark and surrounding space, in lower case.
fn column_name(cell: &[u8]) -> String {
    let cell = cell.strip_prefix(BYTE_ORDER_MARK).unwrap_or(cell);
    String::from_utf8_lossy(cell).trim().to_lowercase()
}

impl<R: Read> Sheet<R> {
    /// The next row, or `None` after the last.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn next_row(&mut self) -> Result<Option<Row<'_>>, String> {
        let cells = match self.judged.pop_front() {
            Some(cells) => Some(cells),
            None => next_cells(&mut self.rows)?,
        };
        self.given += 1;
        let Self { names, inputs, convention, given, .. } = &*self;
        Ok(cells.map(|cells| Row { names, inputs, convention, cells, number: *given, replaced: Vec::new() }))
    }

    /// The names of the columns.
    pub fn header(&self) -> Header<'_> {
        Header { names: &self.names }
    }

    /// Which columns are used, which are absent and what is used instead, and which are not read, in one to three lines.
    /// `computed` are the names of columns that will be added.
    pub fn columns_in_words(&self, computed: &[String]) -> String {
        columns::in_words(&self.names, &self.inputs, computed)
    }

    /// A writer for this table with computed columns after its own. If a column of the table has the name of a computed
    /// column, its copy is named `input_...`.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn writer<W: Write>(&self, mut sink: W, computed: &[String]) -> Result<SheetWriter<W>, String> {
        if self.dialect.byte_order_mark {
            sink.write_all(BYTE_ORDER_MARK).map_err(|error| error.to_string())?;
        }
        let terminator = if self.dialect.carriage_return { csv::Terminator::CRLF } else { csv::Terminator::Any(b'\n') };
        let mut rows = csv::WriterBuilder::new()
            .delimiter(self.dialect.delimiter)
            .terminator(terminator)
            .flexible(true)
            .from_writer(sink);
        let mut header = ByteRecord::new();
        for (cell, name) in self.header.iter().zip(&self.names) {
            if computed.contains(name) {
                let mut kept = format!("input_{name}");
                while self.names.contains(&kept) || computed.contains(&kept) {
                    kept.insert_str(0, "input_");
                }
                header.push_field(kept.as_bytes());
            } else {
                header.push_field(cell.strip_prefix(BYTE_ORDER_MARK).unwrap_or(cell));
            }
        }
        header.extend(computed.iter().map(|name| name.as_bytes()));
        rows.write_byte_record(&header).map_err(|error| error.to_string())?;
        Ok(SheetWriter { rows, width: self.names.len() })
    }
}

/// One row of a table.
pub struct Row<'a> {
    names: &'a [String],
    inputs: &'a [Input],
    convention: &'a Convention,
    cells: ByteRecord,
    number: usize,
    /// Numbers that take the place of those in cells, with a decimal point.
    replaced: Vec<(&'static str, String)>,
}

impl<'a> Row<'a> {
    /// The same row with another number in a column, which it need not have.
    pub fn with<T: Scalar>(&self, column: &'static str, value: T) -> Row<'a> {
        self.with_all([(column, value)])
    }

    /// The same row with other numbers in some columns, which it need not have.
    pub fn with_all<T: Scalar>(&self, numbers: impl IntoIterator<Item = (&'static str, T)>) -> Row<'a> {
        let mut row = Row { cells: self.cells.clone(), replaced: self.replaced.clone(), ..*self };
        for (column, value) in numbers {
            row.replaced.retain(|(other, _)| *other != column);
            row.replaced.push((column, format!("{value:e}")));
        }
        row
    }

    /// The number that takes the place of that in a column.
    fn replaced(&self, column: &str) -> Option<&str> {
        self.replaced.iter().find(|(other, _)| *other == column).map(|(_, text)| text.as_str())
    }

    /// The text of a cell without surrounding space; `None` if there is no such column or the cell is empty.
    pub fn text(&self, column: &str) -> Option<String> {
        if let Some(text) = self.replaced(column) {
            return Some(text.to_owned());
        }
        let index = self.names.iter().position(|name| name == column)?;
        let text = text(&self.cells, index);
        (!text.is_empty()).then_some(text)
    }

    /// The names of the columns.
    pub fn header(&self) -> Header<'_> {
        Header { names: self.names }
    }

    /// The number of this row; that below the header is 1.
    pub fn index(&self) -> usize {
        self.number
    }

    /// The number in a cell; `None` if there is no such column or the cell is empty. The column is one of the inputs with
    /// which the table was opened.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words. A number that the type rounds to zero is an error.
    pub fn number<T: Scalar>(&self, column: &str) -> Result<Option<T>, String> {
        debug_assert!(self.inputs.iter().any(|input| input.columns().contains(&column)), "{column} is no input");
        let Some(text) = self.text(column) else {
            return Ok(None);
        };
        let number = match self.replaced(column) {
            Some(number) => number.to_owned(),
            None => self.convention.with_point(&Cell { row: self.number, column, text: &text })?,
        };
        let value: T = number.parse().map_err(|_| format!("{column}: \"{text}\" is not a number"))?;
        let mantissa = number.split(['e', 'E']).next().unwrap_or_default();
        if value == T::ZERO && mantissa.contains(|c: char| matches!(c, '1'..='9')) {
            let scalar = std::any::type_name::<T>();
            return Err(format!(
                "{column}: \"{text}\" is refused: it is too small for {scalar}, which would make it 0"
            ));
        }
        Ok(Some(value))
    }

    /// The number in a cell that must not be empty.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn required<T: Scalar>(&self, column: &str) -> Result<T, String> {
        self.number(column)?.ok_or_else(|| format!("{column}: missing; enter a number"))
    }

    /// The number in a cell, zero if it is empty.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn or_zero<T: Scalar>(&self, column: &str) -> Result<T, String> {
        Ok(self.number(column)?.unwrap_or(T::ZERO))
    }

    /// Checks that the row has no more cells than the header.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn check(&self) -> Result<(), String> {
        let surplus: Vec<_> = self.cells.iter().skip(self.names.len()).map(String::from_utf8_lossy).collect();
        if surplus.is_empty() {
            return Ok(());
        }
        Err(format!("the row has more cells than the header; these are not copied: {}", surplus.join(" | ")))
    }

    /// The cell for a number: the shortest text that reads back as the same number.
    pub fn cell<T: Scalar>(&self, value: T) -> String {
        let size = value.abs();
        let plain = size == T::ZERO || (size >= T::constant(1e-3) && size < T::constant(1e7));
        // Adding zero drops the sign of a zero.
        let value = value + T::ZERO;
        let text = if plain { value.to_string() } else { format!("{value:e}") };
        self.convention.decimal().mark(text)
    }
}

/// An error of the library as the text of a cell.
pub fn reason(error: impl Error) -> String {
    error.to_string()
}

/// A table that is written row by row.
pub struct SheetWriter<W: Write> {
    rows: csv::Writer<W>,
    width: usize,
}

impl<W: Write> SheetWriter<W> {
    /// Writes a row with its computed cells.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn write(&mut self, row: &Row<'_>, computed: &[String]) -> Result<(), csv::Error> {
        let empty: &[u8] = b"";
        let given = row.cells.iter().chain(std::iter::repeat(empty)).take(self.width);
        self.rows.write_record(given.chain(computed.iter().map(String::as_bytes)))
    }

    /// Writes the rows that are still buffered.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn finish(mut self) -> Result<(), csv::Error> {
        Ok(self.rows.flush()?)
    }
}
