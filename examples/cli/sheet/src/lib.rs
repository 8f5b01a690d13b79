//! Tables of impacts in the variants that spreadsheets write.
//!
//! Commas, semicolons or tabs separate cells. A byte-order mark, UTF-16, quotes, CRLF line ends, decimal commas, comments before
//! the header, a row of units below it, and xlsx workbooks are read, and CSV is written in the variant of the input. A table has
//! one decimal mark, which the columns that are read decide. The [catalogue](catalogue::COLUMNS) has all columns with their units.

pub mod catalogue;
mod columns;
mod complete;
mod decimal;
mod dialect;
mod empty;
mod frame;
mod header;
mod refusal;
mod rename;
mod row;
mod source;
mod units;
mod value;
mod workbook;
mod writer;

use std::collections::VecDeque;
use std::error::Error;
use std::io::{BufReader, Read};

pub use csv::ByteRecord;

pub use columns::{Header, Input, LABEL};
pub use complete::complete;
pub use decimal::Decimal;
use decimal::{Convention, JUDGED_ROWS, Judge};
pub use empty::EmptyCells;
pub use frame::Frame;
use header::{Heading, is_unit_row};
pub use rename::{headings, rename, restore};
pub use row::Row;
use row::{text, text_of_number};
use source::{Guard, Source};
pub use value::{Scalar, Value};
pub use writer::{RowWriter, Rows, Shape, write_records};

/// What begins a comment. A cell that begins with it has quotes, and is none.
const COMMENT: u8 = b'#';

/// A table that is read row by row.
pub struct Sheet<'a> {
    frame: Frame,
    rows: csv::Reader<Box<dyn Read + 'a>>,
    guard: Guard,
    /// Rows that were read when the table was opened.
    judged: VecDeque<ByteRecord>,
    /// The row that was given out last.
    current: ByteRecord,
    /// Rows that were given out.
    given: usize,
    empty: EmptyCells,
}

impl<'a> Sheet<'a> {
    /// Opens a table from which a command reads `inputs`: reads its header and its first row. Unless `decimal` gives the
    /// decimal mark, it reads the first 1000 rows and judges the mark from them.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words: required columns are absent, there are no rows, or the marks of all
    /// cells may separate thousands.
    pub fn open(source: impl Read + 'a, inputs: &[Input], decimal: Option<Decimal>) -> Result<Self, String> {
        let source = Source::of(source)?;
        let sheet = source.sheet.clone();
        Self::of(source, inputs, decimal).map_err(|reason| match sheet {
            Some(sheet) => format!("{reason}; {sheet}"),
            None => reason,
        })
    }

    fn of(source: Source<'a>, inputs: &[Input], decimal: Option<Decimal>) -> Result<Self, String> {
        let guard = Guard::default();
        let mut lines = BufReader::new(source.text);
        let (dialect, header_line) = dialect::read(&mut lines, |cells| columns::named(cells, inputs))?;
        let bytes: Box<dyn Read + 'a> = Box::new(guard.over(source::in_utf8(header_line, lines)));
        let mut rows = csv::ReaderBuilder::new();
        let mut rows = rows.delimiter(dialect.delimiter).flexible(true).comment(Some(COMMENT)).from_reader(bytes);
        let header = rows.byte_headers().map_err(|error| error.to_string())?.clone();
        let headings: Result<Vec<_>, _> =
            header.iter().map(|cell| Heading::of(&String::from_utf8_lossy(cell), inputs)).collect();
        let mut headings = headings?;
        let mut judged = VecDeque::new();
        let mut first = next_cells(&mut rows, &guard, 1)?;
        if let Some(cells) = &first {
            let units: Vec<_> = (0..cells.len()).map(|index| text(cells, index).into_owned()).collect();
            if is_unit_row(&headings, &units, inputs) {
                for (heading, unit) in headings.iter_mut().zip(&units) {
                    heading.add_unit(unit, inputs)?;
                }
                first = next_cells(&mut rows, &guard, 1)?;
            }
        }
        columns::check(&headings, inputs)?;
        judged.extend(first);
        if judged.is_empty() {
            return Err("the table has no rows below its header, so there is nothing to compute".into());
        }
        let convention = match decimal {
            Some(decimal) => Convention::chosen(decimal),
            None => {
                while judged.len() < JUDGED_ROWS
                    && let Some(cells) = next_cells(&mut rows, &guard, judged.len() + 1)?
                {
                    judged.push_back(cells);
                }
                judge(&headings, inputs, &judged, dialect.delimiter == b',')?
            }
        };
        let mut frame = Frame::new(headings, inputs, convention, dialect, source.byte_order_mark);
        frame.sheet = source.sheet;
        Ok(Self { frame, rows, guard, judged, current: ByteRecord::new(), given: 0, empty: EmptyCells::default() })
    }

    /// What all rows share.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The same, and a reader of the rows alone.
    pub fn split(&mut self) -> (&Frame, RowReader<'_, 'a>) {
        let Self { frame, rows, guard, judged, given, .. } = self;
        (frame, RowReader { rows, guard, judged, given })
    }

    /// The next row, or `None` after the last.
    ///
    /// # Errors
    /// What is wrong with the table or the cell, in words.
    pub fn next_row(&mut self) -> Result<Option<Row<'_>>, String> {
        let mut cells = std::mem::take(&mut self.current);
        let number = self.split().1.read(&mut cells)?;
        self.current = cells;
        let row = number.map(|number| self.frame.row(&self.current, number));
        if let Some(row) = &row {
            self.empty.count(row);
        }
        Ok(row)
    }

    /// See [`EmptyCells::in_words`], of the rows that [`next_row`](Self::next_row) gave out.
    #[must_use]
    pub fn empty_in_words(&self) -> Option<String> {
        self.empty.in_words(&self.frame)
    }

    /// The names of the columns.
    #[must_use]
    pub fn header(&self) -> Header<'_> {
        self.frame.header()
    }

    /// See [`Frame::columns_in_words`].
    #[must_use]
    pub fn columns_in_words(&self, computed: &[String]) -> String {
        self.frame.columns_in_words(computed)
    }
}

/// Reads the cells of rows.
pub struct RowReader<'s, 'a> {
    rows: &'s mut csv::Reader<Box<dyn Read + 'a>>,
    guard: &'s Guard,
    judged: &'s mut VecDeque<ByteRecord>,
    given: &'s mut usize,
}

impl RowReader<'_, '_> {
    /// Reads the next row into `cells`; its number, or `None` after the last row.
    ///
    /// # Errors
    /// What is wrong with the table, in words.
    pub fn read(&mut self, cells: &mut ByteRecord) -> Result<Option<usize>, String> {
        let more = match self.judged.pop_front() {
            Some(judged) => {
                *cells = judged;
                true
            }
            None => read_cells(self.rows, self.guard, *self.given + 1, cells)?,
        };
        *self.given += usize::from(more);
        Ok(more.then_some(*self.given))
    }
}

/// The decimal mark of some rows.
fn judge(
    headings: &[Heading],
    inputs: &[Input],
    rows: &VecDeque<ByteRecord>,
    comma_separated: bool,
) -> Result<Convention, String> {
    let is_read = |heading: &Heading| inputs.iter().any(|input| input.columns().contains(&heading.name.as_str()));
    let read: Vec<_> = headings.iter().enumerate().filter(|(_, heading)| is_read(heading)).collect();
    let mut judge = Judge::default();
    for (row, cells) in rows.iter().enumerate() {
        for (index, heading) in &read {
            let column = if heading.unit.is_some() { &heading.text } else { &heading.name };
            judge.add(&decimal::Cell { row: row + 1, column, text: &text_of_number(cells, *index) });
        }
    }
    judge.convention(comma_separated)
}

/// The cells of the next row, or `None` after the last.
fn next_cells<R: Read>(rows: &mut csv::Reader<R>, guard: &Guard, number: usize) -> Result<Option<ByteRecord>, String> {
    let mut cells = ByteRecord::new();
    Ok(read_cells(rows, guard, number, &mut cells)?.then_some(cells))
}

/// Whether a row has no data: all of its cells are empty, only one is not, and begins with # as a comment, or they are a rule
/// of dashes or equals signs. A single dash is no rule, but says that a value is missing.
fn is_decoration(cells: &ByteRecord) -> bool {
    let filled = || cells.iter().map(<[u8]>::trim_ascii).filter(|cell| !cell.is_empty());
    let Some(first) = filled().next() else {
        return true;
    };
    match first[0] {
        COMMENT => filled().nth(1).is_none(),
        b'-' | b'=' => {
            filled().all(|cell| cell.iter().all(|byte| matches!(byte, b'-' | b'=')))
                && filled().any(|cell| cell.len() > 1)
        }
        _ => false,
    }
}

/// Reads the cells of the next row that has data; whether there is one.
fn read_cells<R: Read>(
    rows: &mut csv::Reader<R>,
    guard: &Guard,
    number: usize,
    cells: &mut ByteRecord,
) -> Result<bool, String> {
    loop {
        guard.begin();
        let line = rows.position().line();
        if !rows.read_byte_record(cells).map_err(|error| error.to_string())? {
            return Ok(false);
        }
        // A row of several lines whose last quote is not closed has swallowed the rows after it.
        if guard.is_open_at_end() && cells.as_slice().contains(&b'\n') {
            return Err(format!("row {number}, line {line}: a quote is not closed; close it or remove it"));
        }
        if !is_decoration(cells) {
            return Ok(true);
        }
    }
}

/// An error of the library as the text of a cell.
pub fn reason(error: impl Error) -> String {
    error.to_string()
}
