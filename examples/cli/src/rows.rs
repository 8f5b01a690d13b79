//! Computes the rows of a table on all cores, in order, with memory that does not depend on the number of rows.
//!
//! One thread reads a chunk of rows and writes the results of another, while all cores compute the chunk between them.

use std::error::Error;
use std::io::Write;

use rayon::prelude::*;
use sheet::{ByteRecord, EmptyCells, Frame, Header, Input, Row, RowReader, RowWriter, Rows, Value};

use crate::progress::Progress;

/// What a command computes from each row of a table.
pub trait Work: Sync {
    /// What it keeps of a part of the rows for later.
    type Notes: Default + Send;

    /// The numbers that it reads.
    fn inputs(&self) -> Vec<Input>;

    /// Columns that are computed for a table, in the order in which they are written; the column `error` follows them.
    fn columns(&self, header: &Header<'_>) -> Vec<String>;

    /// The computed cells of a row.
    fn cells(&self, row: &Row<'_>, notes: &mut Self::Notes) -> Result<Vec<Value>, BadRow>;

    /// Column heads of the summary.
    fn heads(&self, header: &Header<'_>) -> Vec<&'static str>;

    /// How many columns of the summary, from the left, hold words: two unless given.
    fn words(&self) -> usize {
        2
    }

    /// A line of the summary.
    fn line(&self, row: &Row<'_>, name: String, notes: &mut Self::Notes) -> Result<Vec<String>, String>;

    /// Keeps the notes of a part, in the order of the rows.
    fn keep(&self, _notes: Self::Notes) {}
}

/// A row that could not be computed, or only in part.
pub struct BadRow {
    /// Why.
    pub reason: String,
    /// The cells that could be computed; cells that are missing at the end are left empty.
    pub cells: Vec<Value>,
}

impl From<String> for BadRow {
    fn from(reason: String) -> Self {
        Self { reason, cells: Vec::new() }
    }
}

/// Rows of the first chunk, so that the first results come soon, and of the largest.
const FIRST_CHUNK: usize = 64;
const LARGEST_CHUNK: usize = 8192;

/// Bytes after which a chunk ends, however few rows it has.
const CHUNK_BYTES: usize = 1 << 23;

/// Parts of a chunk for each thread, so that none waits long for another, and the most rows of a part.
const PARTS: usize = 8;
const LARGEST_PART: usize = 256;

/// Rows that are held at a time.
struct Chunk {
    cells: Vec<ByteRecord>,
    length: usize,
    /// Number of the first row.
    first: usize,
}

impl Chunk {
    fn new() -> Self {
        Self { cells: Vec::new(), length: 0, first: 0 }
    }

    /// Reads at most so many rows. If reading fails, the rows before are there.
    fn fill(&mut self, reader: &mut RowReader<'_, '_>, rows: usize) -> Result<(), String> {
        self.length = 0;
        let mut bytes = 0;
        while self.length < rows && bytes < CHUNK_BYTES {
            if self.cells.len() == self.length {
                self.cells.push(ByteRecord::new());
            }
            let cells = &mut self.cells[self.length];
            let Some(number) = reader.read(cells)? else { break };
            if self.length == 0 {
                self.first = number;
            }
            bytes += cells.as_slice().len();
            self.length += 1;
        }
        Ok(())
    }
}

/// The result of a part of a chunk.
struct Part<N> {
    bytes: Vec<u8>,
    lines: Vec<Vec<String>>,
    bad_rows: Vec<(usize, String)>,
    empty: EmptyCells,
    notes: N,
}

/// What is known of a table when all of its rows are computed.
#[derive(Default)]
pub struct Computed {
    /// Number of rows.
    pub rows: usize,
    /// Number of bad rows.
    pub bad_rows: usize,
    /// The first of those that the summary does not show: number and reason.
    pub unshown: Option<(usize, String)>,
    /// Lines of the summary.
    pub lines: Vec<Vec<String>>,
    /// Empty cells in whose place a default is used.
    pub empty: EmptyCells,
}

/// How the rows are computed.
pub struct Task<'a, W> {
    /// What is computed.
    pub work: &'a W,
    /// What all rows share.
    pub frame: &'a Frame,
    /// Writer of all rows, if they are written.
    pub writer: Option<&'a RowWriter<'a>>,
    /// How many rows the summary shows.
    pub shown: usize,
    /// Number of computed columns, without the column `error`.
    pub columns: usize,
}

impl<W: Work> Task<'_, W> {
    fn part(&self, rows: &[ByteRecord], first: usize) -> Result<Part<W::Notes>, csv::Error> {
        let mut output = self.writer.map(RowWriter::rows);
        let mut part = Part {
            bytes: Vec::new(),
            lines: Vec::new(),
            bad_rows: Vec::new(),
            empty: EmptyCells::default(),
            notes: W::Notes::default(),
        };
        for (index, cells) in rows.iter().enumerate() {
            let row = self.frame.row(cells, first + index);
            part.empty.count(&row);
            let reason = match &mut output {
                Some(output) => self.write(&row, output, &mut part.notes)?,
                None if row.index() <= self.shown => {
                    let name = row.label();
                    let line = row.check().and_then(|()| self.work.line(&row, name.clone(), &mut part.notes));
                    let (line, reason) = match line {
                        Ok(line) => (line, None),
                        Err(reason) => (vec![name, format!("bad row: {reason}")], Some(reason)),
                    };
                    part.lines.push(line);
                    reason
                }
                None => self.cells(&row, &mut part.notes).err().map(|bad| bad.reason),
            };
            part.bad_rows.extend(reason.map(|reason| (row.index(), reason)));
        }
        part.bytes = output.map_or(Ok(Vec::new()), Rows::into_bytes)?;
        Ok(part)
    }

    fn cells(&self, row: &Row<'_>, notes: &mut W::Notes) -> Result<Vec<Value>, BadRow> {
        row.check()?;
        self.work.cells(row, notes)
    }

    /// Writes a row; why it is bad, if it is.
    fn write(&self, row: &Row<'_>, output: &mut Rows<'_>, notes: &mut W::Notes) -> Result<Option<String>, csv::Error> {
        let (mut cells, reason) = match self.cells(row, notes) {
            Ok(cells) => (cells, None),
            Err(bad) => (bad.cells, Some(bad.reason)),
        };
        cells.resize(self.columns, Value::Empty);
        cells.push(reason.clone().map_or(Value::Empty, Value::from));
        output.write(row, &cells)?;
        Ok(reason)
    }

    fn chunk(&self, chunk: &Chunk, progress: &indicatif::ProgressBar) -> Result<Vec<Part<W::Notes>>, csv::Error> {
        let length = (chunk.length / (PARTS * rayon::current_num_threads())).clamp(1, LARGEST_PART);
        let parts = chunk.cells[..chunk.length].par_chunks(length).enumerate().map(|(index, rows)| {
            let part = self.part(rows, chunk.first + index * length);
            progress.inc(rows.len() as u64);
            part
        });
        parts.collect()
    }

    /// Writes the results of a chunk, and adds what is known of it.
    fn finish(
        &self,
        parts: Vec<Part<W::Notes>>,
        computed: &mut Computed,
        to: &mut dyn Write,
    ) -> Result<(), Box<dyn Error>> {
        for part in parts {
            to.write_all(&part.bytes)?;
            computed.lines.extend(part.lines);
            computed.bad_rows += part.bad_rows.len();
            computed.empty.add(&part.empty);
            if computed.unshown.is_none() {
                computed.unshown = part.bad_rows.into_iter().find(|(number, _)| *number > self.shown);
            }
            self.work.keep(part.notes);
        }
        Ok(())
    }

    /// Computes all rows.
    ///
    /// # Errors
    /// A table that cannot be read to its end, after the rows before; or writing fails.
    pub fn run(
        &self,
        reader: &mut RowReader<'_, '_>,
        progress: &Progress,
        to: &mut dyn Write,
    ) -> Result<Computed, Box<dyn Error>> {
        let mut computed = Computed::default();
        let (mut current, mut next, mut size) = (Chunk::new(), Chunk::new(), FIRST_CHUNK);
        let mut readable = current.fill(reader, size);
        let mut done = Vec::new();
        while current.length > 0 {
            size = (2 * size).min(LARGEST_CHUNK);
            let mut parts = Ok(Vec::new());
            let bar = progress.bar();
            let written = rayon::in_place_scope(|scope| {
                scope.spawn(|_| parts = self.chunk(&current, bar));
                next.length = 0;
                if readable.is_ok() {
                    readable = next.fill(reader, size);
                }
                self.finish(std::mem::take(&mut done), &mut computed, to)
            });
            written?;
            done = parts?;
            computed.rows += current.length;
            progress.estimate(computed.rows + next.length);
            std::mem::swap(&mut current, &mut next);
        }
        self.finish(done, &mut computed, to)?;
        readable?;
        Ok(computed)
    }
}
