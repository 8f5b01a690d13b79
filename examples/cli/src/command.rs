//! What the commands share: options, the table that they read, the result that they write, and the exit status.

use std::error::Error;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use microimpact::contact::{Adaptive, AdaptiveNodes};
use microimpact::measure::NormalDistribution;
use microimpact::{InputError, Real};
use sheet::{Decimal, Header, Input, LABEL, Row, Scalar, Sheet};

use crate::Streams;
use crate::classify::OfferedNodes;
use crate::contact_law::LAW_HELP;

/// A number type that all commands can compute in.
pub trait Number: Scalar + AdaptiveNodes + OfferedNodes + NormalDistribution + Into<f64> + 'static {}

impl<T: Scalar + AdaptiveNodes + OfferedNodes + NormalDistribution + Into<f64> + 'static> Number for T {}

/// Options of a command that reads a table and adds columns to it.
#[derive(Args)]
pub struct TableOptions {
    /// CSV file to read; `-` for standard input. Without a file the command reads its bundled table.
    file: Option<PathBuf>,
    /// Format of the result: a summary to read, or CSV with all columns.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Number type of the computation.
    #[arg(long, value_enum, default_value_t = ScalarType::F64)]
    scalar: ScalarType,
    #[command(flatten)]
    reading: Reading,
}

/// How a command reads a table.
#[derive(Args)]
pub struct Reading {
    /// Decimal mark of the table. Without it the command judges the mark from the columns that it reads, in the first 1000
    /// rows, and writes no result before it has read them.
    #[arg(long, value_enum)]
    decimal: Option<Decimal>,
}

impl Reading {
    /// Opens a table, and says on standard error which of its columns a command reads. `computed` are the columns that it will
    /// add to it.
    ///
    /// # Errors
    /// What is wrong with the table, in words.
    pub fn open<'a>(
        &self,
        command: &str,
        source: impl BufRead + 'a,
        inputs: &[Input],
        computed: impl Fn(&Header<'_>) -> Vec<String>,
        errors: &mut dyn Write,
    ) -> Result<Sheet<Box<dyn BufRead + 'a>>, String> {
        let sheet = Sheet::open(source, inputs, self.decimal)?;
        // If standard error is closed, nobody wants to know.
        let _ = write!(errors, "{command}: {}", sheet.columns_in_words(&computed(&sheet.header())));
        Ok(sheet)
    }
}

/// What the help of each command that reads a table says at its end.
pub const TABLE_HELP: &str = "\
CSV files may use commas, semicolons or tabs, and decimal points or decimal commas: one mark in the
whole file. A number such as 2.600 is refused unless other cells, commas that separate cells, or
--decimal settle whether its mark is decimal; thousands separators are not read. The result has the
decimal mark of the file. The command copies all other columns. If an input column has the name of
a computed column, its copy is named input_NAME. Standard error lists the columns that the command
uses, the defaults of those that are absent, and the columns that it does not read.

Exit status: 0 on success; 1 if a row is bad (the column `error` gives the reason); 2 if the command
fails, for example because it cannot read the table.";

/// What the help of each command that reads a table and simulates contacts says at its end.
pub fn simulation_help() -> String {
    format!("{LAW_HELP}\n\n{TABLE_HELP}")
}

/// Options of a command that simulates contacts.
#[derive(Args)]
pub struct SimulationOptions {
    /// Tolerance of the simulation [default: 1e-9 in f64, 1e-6 in f32].
    ///
    /// It bounds the error of the squared restitution, and the relative error of a critical speed. Rounding limits it: it must
    /// be at least 1e-13 in f64, and 1e-6 in f32.
    #[arg(long)]
    tolerance: Option<f64>,
}

/// Default tolerances of f64 and f32.
const TOLERANCE: f64 = 1e-9;
const SINGLE_TOLERANCE: f64 = 1e-6;

impl SimulationOptions {
    /// Whether a tolerance was given.
    pub fn is_given(&self) -> bool {
        self.tolerance.is_some()
    }

    /// The tolerance: without the option, one that the number type can keep.
    pub fn tolerance<T: Real>(&self) -> T {
        let default = if T::EPSILON < T::constant(TOLERANCE) { TOLERANCE } else { SINGLE_TOLERANCE };
        T::constant(self.tolerance.unwrap_or(default))
    }

    /// The method that keeps this tolerance.
    pub fn method<T: Real>(&self) -> Result<Adaptive<T>, InputError> {
        Adaptive::new(self.tolerance())
    }
}

/// Format of a result.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A summary to read.
    Table,
    /// All columns, for a spreadsheet.
    Csv,
}

/// Number type of the computation.
#[derive(Clone, Copy, ValueEnum)]
enum ScalarType {
    F32,
    F64,
}

/// A command that reads a table and adds columns to it.
pub trait TableCommand {
    /// The name under which it reports errors.
    const NAME: &'static str;

    /// The options that all of these commands have.
    fn options(&self) -> &TableOptions;

    /// Runs in numbers of type `T`.
    ///
    /// # Errors
    /// Why the command failed: the options, the table or a stream.
    fn run_in<T: Number>(&self, streams: &mut Streams<'_>) -> BadRows;

    /// Runs the command; its exit status.
    fn run(&self, streams: &mut Streams<'_>) -> u8 {
        let outcome = match self.options().scalar {
            ScalarType::F32 => self.run_in::<f32>(streams),
            ScalarType::F64 => self.run_in::<f64>(streams),
        };
        exit_status(Self::NAME, outcome, streams.errors)
    }
}

/// What a command computes from each row of a table.
pub trait Work {
    /// The numbers that it reads.
    fn inputs(&self) -> Vec<Input>;

    /// Columns that are computed for a table, in the order in which they are written; the column `error` follows them.
    fn columns(&self, header: &Header<'_>) -> Vec<String>;

    /// The computed cells of a row.
    fn cells(&self, row: &Row<'_>) -> Result<Vec<String>, BadRow>;

    /// Column heads of the summary.
    fn heads(&self, header: &Header<'_>) -> Vec<&'static str>;

    /// How many columns of the summary, from the left, hold words: two unless given.
    fn words(&self) -> usize {
        2
    }

    /// A line of the summary.
    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<String>, String>;
}

/// A row that could not be computed, or only in part.
pub struct BadRow {
    /// Why.
    pub reason: String,
    /// The cells that could be computed; cells that are missing at the end are left empty.
    pub cells: Vec<String>,
}

impl From<String> for BadRow {
    fn from(reason: String) -> Self {
        Self { reason, cells: Vec::new() }
    }
}

/// The number of bad rows, or why the command failed.
pub type BadRows = Result<usize, Box<dyn Error>>;

impl TableOptions {
    /// Computes all rows of a file, of standard input if the file is `-`, or of a bundled table if there is no file.
    pub fn work(&self, command: &str, bundled: &str, work: &impl Work, streams: &mut Streams<'_>) -> BadRows {
        let source: Box<dyn BufRead> = match &self.file {
            None => Box::new(bundled.as_bytes()),
            Some(path) if path.as_os_str() == "-" => Box::new(&mut *streams.input),
            Some(path) => Box::new(open(path)?),
        };
        let computed = |header: &Header<'_>| work.columns(header);
        let sheet = self.reading.open(command, source, &work.inputs(), computed, streams.errors)?;
        match self.format {
            Format::Csv => write_csv(sheet, &mut *streams.output, work),
            Format::Table => write_table(sheet, &mut *streams.output, work),
        }
    }
}

/// Opens a file to read.
pub fn open(path: &Path) -> Result<BufReader<File>, String> {
    File::open(path).map(BufReader::new).map_err(|error| format!("{}: {error}", path.display()))
}

/// The exit status of a command: 0 on success, 1 if a row was bad, 2 if the command failed.
pub fn exit_status(command: &str, outcome: BadRows, errors: &mut dyn Write) -> u8 {
    let (status, message) = match outcome {
        Ok(0) => return 0,
        Ok(1) => (1, "1 bad row; the row gives the reason".to_owned()),
        Ok(bad_rows) => (1, format!("{bad_rows} bad rows; each row gives its reason")),
        Err(error) if is_broken_pipe(error.as_ref()) => return 0,
        Err(error) => (2, error.to_string()),
    };
    // If standard error is closed too, there is nowhere left to report to.
    let _ = writeln!(errors, "{command}: {message}");
    status
}

/// Whether the reader of the output has closed it, as `head` does.
fn is_broken_pipe(error: &(dyn Error + 'static)) -> bool {
    let io_error = match error.downcast_ref::<csv::Error>().map(csv::Error::kind) {
        Some(csv::ErrorKind::Io(error)) => Some(error),
        _ => error.downcast_ref::<io::Error>(),
    };
    io_error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn write_csv(mut sheet: Sheet<Box<dyn BufRead + '_>>, sink: impl Write, work: &impl Work) -> BadRows {
    let mut columns = work.columns(&sheet.header());
    let computed = columns.len();
    columns.push("error".into());
    let mut writer = sheet.writer(io::BufWriter::new(sink), &columns)?;
    let mut bad_rows = 0;
    while let Some(row) = sheet.next_row()? {
        let (mut cells, reason) = match row.check().map_err(BadRow::from).and_then(|()| work.cells(&row)) {
            Ok(cells) => (cells, String::new()),
            Err(bad) => {
                bad_rows += 1;
                (bad.cells, bad.reason)
            }
        };
        cells.resize(computed, String::new());
        cells.push(reason);
        writer.write(&row, &cells)?;
    }
    writer.finish()?;
    Ok(bad_rows)
}

fn write_table(mut sheet: Sheet<Box<dyn BufRead + '_>>, mut sink: impl Write, work: &impl Work) -> BadRows {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_header(work.heads(&sheet.header()));
    for column in table.column_iter_mut().skip(work.words()) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut bad_rows = 0;
    while let Some(row) = sheet.next_row()? {
        let name = row.text(LABEL).unwrap_or_else(|| format!("row {}", row.index()));
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
