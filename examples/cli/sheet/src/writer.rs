//! Tables that are written row by row, as CSV in the variant of the input, or as JSON.

use std::io::Write;

use csv::{ByteRecord, Terminator, WriterBuilder};

use crate::COMMENT;
use crate::decimal::Decimal;
use crate::frame::Frame;
use crate::row::Row;
use crate::value::{Value, write_json_text};

pub(crate) const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// CSV in the variant of the input.
    Csv,
    /// A JSON array with an object for each row.
    Json,
}

/// Writes rows of a table with computed columns after its own. Rows go to a buffer, so that several threads can write parts of a
/// table.
pub struct RowWriter<'a> {
    frame: &'a Frame,
    shape: Shape,
    /// Names of the given and the computed columns.
    names: Vec<String>,
    /// The same as text of JSON.
    keys: Vec<Vec<u8>>,
}

/// Rows that were written.
pub struct Rows<'a> {
    writer: &'a RowWriter<'a>,
    csv: csv::Writer<Vec<u8>>,
    json: Vec<u8>,
    cell: Vec<u8>,
}

/// Buffer of the rows that are formatted at once, bytes.
const BUFFER: usize = 1 << 15;

impl<'a> RowWriter<'a> {
    /// A writer for a table with these computed columns. If a column of the table has the name of a computed column, its copy is
    /// named `input_...`.
    #[must_use]
    pub fn new(frame: &'a Frame, shape: Shape, computed: &[String]) -> Self {
        let lower: Vec<_> = frame.headings.iter().map(|heading| heading.text.to_lowercase()).collect();
        let given = frame.headings.iter().zip(&lower).map(|(heading, name)| {
            if !computed.contains(name) {
                return heading.raw.clone();
            }
            let mut kept = format!("input_{name}");
            while lower.contains(&kept) || computed.contains(&kept) {
                kept.insert_str(0, "input_");
            }
            kept
        });
        let names: Vec<_> = given.chain(computed.iter().cloned()).collect();
        let key = |name: &String| {
            let mut key = Vec::new();
            write_json_text(name, &mut key);
            key.push(b':');
            key
        };
        let keys = names.iter().map(key).collect();
        Self { frame, shape, names, keys }
    }

    fn csv(&self) -> csv::Writer<Vec<u8>> {
        let dialect = &self.frame.dialect;
        let terminator = if dialect.carriage_return { Terminator::CRLF } else { Terminator::Any(b'\n') };
        WriterBuilder::new()
            .delimiter(dialect.delimiter)
            .terminator(terminator)
            .flexible(true)
            .comment(Some(COMMENT))
            .buffer_capacity(BUFFER)
            .from_writer(Vec::with_capacity(BUFFER))
    }

    /// What stands before the rows.
    ///
    /// # Errors
    /// Writing fails.
    pub fn begin(&self, to: &mut dyn Write) -> std::io::Result<()> {
        if self.shape == Shape::Json {
            return to.write_all(b"[");
        }
        if self.frame.byte_order_mark {
            to.write_all(BYTE_ORDER_MARK)?;
        }
        to.write_all(&self.frame.dialect.preamble)?;
        let mut header = self.csv();
        header.write_byte_record(&self.names.iter().map(String::as_bytes).collect::<ByteRecord>())?;
        to.write_all(&header.into_inner().map_err(|error| error.into_error())?)
    }

    /// What stands after the rows.
    ///
    /// # Errors
    /// Writing fails.
    pub fn end(&self, to: &mut dyn Write) -> std::io::Result<()> {
        if self.shape == Shape::Json { to.write_all(b"\n]\n") } else { Ok(()) }
    }

    /// Begins a part of the rows.
    #[must_use]
    pub fn rows(&'a self) -> Rows<'a> {
        Rows { writer: self, csv: self.csv(), json: Vec::new(), cell: Vec::new() }
    }
}

impl Rows<'_> {
    /// Writes a row with its computed cells.
    ///
    /// # Errors
    /// Never: a buffer takes all rows.
    pub fn write(&mut self, row: &Row<'_>, computed: &[Value]) -> Result<(), csv::Error> {
        match self.writer.shape {
            Shape::Csv => self.write_csv(row, computed),
            Shape::Json => {
                self.write_json(row, computed);
                Ok(())
            }
        }
    }

    fn write_csv(&mut self, row: &Row<'_>, computed: &[Value]) -> Result<(), csv::Error> {
        let decimal = self.writer.frame.convention.decimal();
        for index in 0..self.writer.frame.headings.len() {
            self.csv.write_field(row.cells.get(index).unwrap_or_default())?;
        }
        for value in computed {
            self.cell.clear();
            value.write(decimal, &mut self.cell);
            self.csv.write_field(&self.cell)?;
        }
        self.csv.write_record(None::<&[u8]>)
    }

    fn write_json(&mut self, row: &Row<'_>, computed: &[Value]) {
        let to = &mut self.json;
        to.extend(if row.number == 1 { "\n{".bytes() } else { ",\n{".bytes() });
        let given = (0..self.writer.frame.headings.len()).map(|index| row.given(index));
        let mut separator: &[u8] = b"";
        for (key, value) in self.writer.keys.iter().zip(given.chain(computed.iter().cloned())) {
            to.extend(separator);
            separator = b",";
            to.extend(key);
            value.write_json(to);
        }
        to.push(b'}');
    }

    /// The bytes of the rows.
    ///
    /// # Errors
    /// Never: a buffer takes all rows.
    pub fn into_bytes(self) -> std::io::Result<Vec<u8>> {
        match self.writer.shape {
            Shape::Csv => self.csv.into_inner().map_err(|error| error.into_error()),
            Shape::Json => Ok(self.json),
        }
    }
}

/// Writes records of words and numbers, as CSV with commas and decimal points, or as JSON.
///
/// # Errors
/// Writing fails.
pub fn write_records(
    shape: Shape,
    names: &[&str],
    records: impl IntoIterator<Item = Vec<Value>>,
    to: &mut dyn Write,
) -> std::io::Result<()> {
    if shape == Shape::Csv {
        let mut rows = WriterBuilder::new().comment(Some(COMMENT)).from_writer(to);
        rows.write_record(names)?;
        for record in records {
            rows.write_record(record.iter().map(|value| value.text(Decimal::Point)))?;
        }
        return rows.flush();
    }
    let mut text = vec![b'['];
    for (index, record) in records.into_iter().enumerate() {
        text.extend(if index == 0 { "\n{".bytes() } else { ",\n{".bytes() });
        for (index, (name, value)) in names.iter().zip(&record).enumerate() {
            text.extend(if index == 0 { "".bytes() } else { ",".bytes() });
            write_json_text(name, &mut text);
            text.push(b':');
            value.write_json(&mut text);
        }
        text.push(b'}');
    }
    text.extend(b"\n]\n");
    to.write_all(&text)
}
