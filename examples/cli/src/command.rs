//! What the commands that work on tables have in common: where a table comes from, what is made of it, and how it ends.

use std::error::Error;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use comfy_table::{Cell, CellAlignment, ContentArrangement, Table, presets};

use sheet::{Row, Sheet};

use crate::Streams;

/// The options that all of these commands have.
#[derive(Args)]
pub struct TableOptions {
    /// Table to work on; `-` for standard input. Without it, the bundled one.
    file: Option<PathBuf>,
    /// A table to read, or the whole result for a spreadsheet.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Number type to compute in.
    #[arg(long, value_enum, default_value_t = ScalarType::F64)]
    scalar: ScalarType,
}

/// How a result is written.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// To read.
    Table,
    /// The whole result, for a spreadsheet.
    Csv,
}

/// The number type to compute in.
#[derive(Clone, Copy, ValueEnum)]
enum ScalarType {
    F32,
    F64,
}

/// What is made of each row of a table.
pub trait Work {
    /// Columns that are computed, in the order they are written; the column `error` follows them.
    fn columns(&self) -> Vec<String>;

    /// The computed cells of a row. Where there is an error, cells that could be computed all the same may be filled.
    fn cells(&self, row: &Row<'_>) -> (Vec<String>, Result<(), String>);

    /// Column heads of the readable table.
    fn heads(&self) -> Vec<&'static str>;

    /// How many of its columns, from the left, hold words.
    fn words(&self) -> usize;

    /// A line of the readable table.
    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<Cell>, String>;
}

/// The number of bad rows, or why nothing could be done.
pub type BadRows = Result<usize, Box<dyn Error>>;

impl TableOptions {
    /// Works on all rows of a file, of standard input where it is `-`, or of a bundled table.
    pub fn work(&self, bundled: &str, work: &impl Work, streams: &mut Streams<'_>) -> BadRows {
        let source: Box<dyn BufRead> = match &self.file {
            None => Box::new(bundled.as_bytes()),
            Some(path) if path.as_os_str() == "-" => Box::new(&mut *streams.input),
            Some(path) => {
                Box::new(BufReader::new(File::open(path).map_err(|error| format!("{}: {error}", path.display()))?))
            }
        };
        let sheet = Sheet::open(source)?;
        match self.format {
            Format::Csv => write_csv(sheet, &mut *streams.output, work),
            Format::Table => write_table(sheet, &mut *streams.output, work),
        }
    }

    /// Runs a command in the number type asked for; its exit status.
    pub fn run(
        &self,
        command: &str,
        streams: &mut Streams<'_>,
        single: impl FnOnce(&mut Streams<'_>) -> BadRows,
        double: impl FnOnce(&mut Streams<'_>) -> BadRows,
    ) -> u8 {
        let outcome = match self.scalar {
            ScalarType::F32 => single(streams),
            ScalarType::F64 => double(streams),
        };
        exit_status(command, outcome, streams.errors)
    }
}

/// The exit status of a command: 0, or 1 if a row was bad, or 2 if nothing could be done.
pub fn exit_status(command: &str, outcome: BadRows, errors: &mut dyn Write) -> u8 {
    let (status, message) = match outcome {
        Ok(0) => return 0,
        Ok(1) => (1, "1 bad row, with its reason".to_owned()),
        Ok(bad_rows) => (1, format!("{bad_rows} bad rows, each with its reason")),
        Err(error) if is_broken_pipe(error.as_ref()) => return 0,
        Err(error) => (2, error.to_string()),
    };
    // Nothing can be done where standard error is closed too.
    let _ = writeln!(errors, "{command}: {message}");
    status
}

/// Whether the reader of our output has gone away, as `head` does.
fn is_broken_pipe(error: &(dyn Error + 'static)) -> bool {
    let io_error = match error.downcast_ref::<csv::Error>().map(csv::Error::kind) {
        Some(csv::ErrorKind::Io(error)) => Some(error),
        _ => error.downcast_ref::<io::Error>(),
    };
    io_error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn write_csv(mut sheet: Sheet<Box<dyn BufRead + '_>>, sink: impl Write, work: &impl Work) -> BadRows {
    let mut columns = work.columns();
    let computed = columns.len();
    columns.push("error".into());
    let mut writer = sheet.writer(io::BufWriter::new(sink), &columns)?;
    let mut bad_rows = 0;
    while let Some(row) = sheet.next_row()? {
        let (mut cells, result) = match row.check() {
            Ok(()) => work.cells(&row),
            Err(reason) => (Vec::new(), Err(reason)),
        };
        cells.resize(computed, String::new());
        bad_rows += usize::from(result.is_err());
        cells.push(result.err().unwrap_or_default());
        writer.write(&row, &cells)?;
    }
    writer.finish()?;
    Ok(bad_rows)
}

fn write_table(mut sheet: Sheet<Box<dyn BufRead + '_>>, mut sink: impl Write, work: &impl Work) -> BadRows {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_header(work.heads());
    for column in table.column_iter_mut().skip(work.words()) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let (mut number, mut bad_rows) = (0, 0);
    while let Some(row) = sheet.next_row()? {
        number += 1;
        let name = row.text("name").unwrap_or_else(|| format!("row {number}"));
        match row.check().and_then(|()| work.line(&row, name.clone())) {
            Ok(line) => table.add_row(line),
            Err(reason) => {
                bad_rows += 1;
                table.add_row(vec![name, format!("bad row: {reason}")])
            }
        };
    }
    writeln!(sink, "{table}")?;
    Ok(bad_rows)
}
