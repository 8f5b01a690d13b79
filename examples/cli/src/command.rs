//! What the commands share: options, the table that they read, the result that they write, and the exit status.

use std::error::Error;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use methods::{OfferedNodes, default};
use microimpact::contact::Adaptive;
use microimpact::measure::NormalDistribution;
use microimpact::{InputError, Real};
use sheet::{Decimal, Header, Input, LABEL, RowWriter, Scalar, Shape, Sheet, Value};

use crate::Streams;
use crate::progress::Progress;
use crate::rows::{Computed, Task, Work};

/// A number type that all commands can compute in.
pub trait Number: Scalar + OfferedNodes + NormalDistribution + Into<f64> {}

impl<T: Scalar + OfferedNodes + NormalDistribution + Into<f64>> Number for T {}

/// Options of a command that reads a table and adds columns to it.
#[derive(Args)]
pub struct TableOptions {
    /// CSV or xlsx file; `-` for standard input [default: bundled impacts of the paper]
    file: Option<PathBuf>,
    /// Format of the result: the first rows to read, or all rows and columns
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Number type of the computation
    #[arg(long, value_enum, default_value_t = ScalarType::F64)]
    scalar: ScalarType,
    #[command(flatten)]
    reading: Reading,
}

/// How a command reads a table.
#[derive(Args)]
pub struct Reading {
    /// Decimal mark of the table [default: judged from its first 1000 rows]
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
        source: impl Read + 'a,
        inputs: &[Input],
        computed: impl Fn(&Header<'_>) -> Vec<String>,
        errors: &mut dyn Write,
    ) -> Result<Sheet<'a>, String> {
        let sheet = Sheet::open(source, inputs, self.decimal)?;
        // If standard error is closed, nobody wants to know.
        let _ = write!(errors, "{command}: {}", sheet.columns_in_words(&computed(&sheet.header())));
        Ok(sheet)
    }

    /// Opens the table of one row that [`one_row`] made, or else a table. No column is added to it.
    ///
    /// # Errors
    /// What is wrong with the table, in words.
    pub fn open_either<'a>(
        &self,
        command: &str,
        given: Option<&'a str>,
        source: impl Read + 'a,
        inputs: &[Input],
        errors: &mut dyn Write,
    ) -> Result<Sheet<'a>, String> {
        match given {
            Some(text) => {
                let reading = Self { decimal: Some(Decimal::Point) };
                reading.open(command, text.as_bytes(), inputs, |_| Vec::new(), errors)
            }
            None => self.open(command, source, inputs, |_| Vec::new(), errors),
        }
    }
}

/// What the manual of each command that reads a table says of tables.
pub const TABLE_MANUAL: &str = "\
CSV files may use commas, semicolons or tabs, and decimal points or decimal commas: one mark in the whole file. A number such as \
2.600 is refused unless other cells, commas that separate cells, or --decimal settle whether its mark is decimal; thousands \
separators are not read. Lines that begin with # are comments; write a name that begins with # in quotes. A line sep=; before the header, empty rows and \
rows of dashes are skipped, and so are up to 50 lines of titles above the header. The first \
sheet of an xlsx workbook that is not hidden and not empty is read in the same way. UTF-16 is read.

A column has its unit at the end of its name (radius_um, Density g/cm3, Radius / um), in brackets (Radius [um]), or in a row of \
units below the header. `microimpact columns` lists all columns with their units, ranges and defaults.

The result has the decimal mark and the separator of the file. The command copies all columns. If an input column has the name of \
a computed column, its copy is named input_NAME. Standard error lists the columns that the command uses, the defaults of those that \
are absent, and the columns that it does not read; after the rows, in how many of them cells are empty, and what is used there.";

/// Exit status of each command that reads a table.
pub const STATUS: &str = "\
Exit status: 0 on success; 1 if a row is bad (the column `error` says why); 2 if nothing could be read.";

/// Options of a command that simulates contacts.
#[derive(Args, Default)]
pub struct SimulationOptions {
    /// Largest error of e^2 and of a critical speed [default: 1e-9 in f64, 1e-6 in f32]
    #[arg(long, value_name = "X")]
    tolerance: Option<f64>,
}

/// Default tolerance of f32.
const SINGLE_TOLERANCE: f64 = 1e-6;

impl SimulationOptions {
    /// Whether a tolerance was given.
    pub fn is_given(&self) -> bool {
        self.tolerance.is_some()
    }

    /// The tolerance: without the option, one that the number type can keep.
    pub fn tolerance<T: Real>(&self) -> T {
        let tolerance =
            if T::EPSILON < T::constant(default::TOLERANCE) { default::TOLERANCE } else { SINGLE_TOLERANCE };
        T::constant(self.tolerance.unwrap_or(tolerance))
    }

    /// The method that keeps this tolerance.
    pub fn method<T: Real>(&self) -> Result<Adaptive<T>, InputError> {
        Adaptive::new(self.tolerance())
    }
}

/// Format of a result.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    Table,
    Csv,
    Json,
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

/// The number of bad rows, or why the command failed.
pub type BadRows = Result<usize, Box<dyn Error>>;

/// A table to read, and the progress through it.
pub struct Origin<'a> {
    pub source: Box<dyn Read + 'a>,
    pub progress: Progress,
}

impl<'a> Origin<'a> {
    /// A file, standard input if the file is `-`, or a bundled table if there is no file.
    pub fn of(file: Option<&Path>, bundled: &'a str, input: &'a mut dyn io::BufRead) -> Result<Self, String> {
        let Some(path) = file else {
            return Ok(Self { source: Box::new(bundled.as_bytes()), progress: Progress::new(None) });
        };
        if path.as_os_str() == "-" {
            return Ok(Self { source: Box::new(input), progress: Progress::new(None) });
        }
        let file = open(path)?;
        let length = file.get_ref().metadata().ok().map(|known| known.len());
        let progress = Progress::new(length);
        Ok(Self { source: Box::new(progress.over(file)), progress })
    }
}

impl TableOptions {
    /// Computes all rows of a file, of standard input if the file is `-`, or of a bundled table if there is no file.
    pub fn work(&self, command: &str, bundled: &str, work: &impl Work, streams: &mut Streams<'_>) -> BadRows {
        let Origin { source, progress } = Origin::of(self.file.as_deref(), bundled, streams.input)?;
        let computed = |header: &Header<'_>| {
            let mut names = work.columns(header);
            names.push("error".into());
            names
        };
        let mut sheet = self.reading.open(command, source, &work.inputs(), computed, streams.errors)?;
        let (frame, mut reader) = sheet.split();
        let names = computed(&frame.header());
        let columns = names.len() - 1;
        let mut output = BufWriter::new(&mut *streams.output);
        let Some(shape) = self.format.shape() else {
            let task = Task { work, frame, writer: None, shown: SHOWN, columns };
            let computed = task.run(&mut reader, &progress, &mut output)?;
            drop(progress);
            write_table(&mut output, work, &frame.header(), &computed)?;
            output.flush()?;
            say(command, computed.empty.in_words(frame), streams.errors);
            return Ok(computed.bad_rows);
        };
        if io::stdout().is_terminal() {
            progress.hide();
        }
        let writer = RowWriter::new(frame, shape, &names);
        writer.begin(&mut output)?;
        let task = Task { work, frame, writer: Some(&writer), shown: 0, columns };
        let computed = task.run(&mut reader, &progress, &mut output)?;
        writer.end(&mut output)?;
        output.flush()?;
        say(command, computed.empty.in_words(frame), streams.errors);
        Ok(computed.bad_rows)
    }
}

/// Says something on standard error.
pub fn say(command: &str, words: Option<String>, errors: &mut dyn Write) {
    if let Some(words) = words {
        // If standard error is closed, nobody wants to know.
        let _ = writeln!(errors, "{command}: {words}");
    }
}

/// Rows that a summary shows.
const SHOWN: usize = 100;

impl Format {
    /// How a table of this format is written for programs; `None` for a summary to read.
    fn shape(self) -> Option<Shape> {
        match self {
            Self::Table => None,
            Self::Csv => Some(Shape::Csv),
            Self::Json => Some(Shape::Json),
        }
    }
}

/// Writes records; a summary shows the first of them. The first columns, so many as `words`, hold words.
pub fn write_records(
    format: Format,
    names: &[&str],
    words: usize,
    records: impl IntoIterator<Item = Vec<Value>>,
    to: &mut dyn Write,
) -> io::Result<()> {
    let mut records = records.into_iter();
    let Some(shape) = format.shape() else {
        let line = |record: Vec<Value>| record.iter().map(in_summary).collect();
        let lines: Vec<Vec<String>> = records.by_ref().take(SHOWN).map(line).collect();
        let (shown, others) = (lines.len(), records.count());
        writeln!(to, "{}", table_of(names.to_vec(), words, lines))?;
        if others > 0 {
            writeln!(to, "The first {shown} of {} rows; --format csv writes all.", shown + others)?;
        }
        return Ok(());
    };
    sheet::write_records(shape, names, records, to)
}

/// A value with the digits that are read, not all of them.
fn in_summary(value: &Value) -> String {
    match value {
        Value::Double(number) if *number != 0.0 && !(1e-3..1e5).contains(&number.abs()) => format!("{number:.4e}"),
        Value::Double(number) => format!("{}", (number * 1e6).round() / 1e6),
        other => other.text(Decimal::Point),
    }
}

/// The table of one row, from its columns as `NAME=VALUE`; `None` if there are none.
pub fn one_row(given: &[String]) -> Result<Option<String>, Box<dyn Error>> {
    if given.is_empty() {
        return Ok(None);
    }
    let mut cells = Vec::new();
    for pair in given {
        let Some((name, value)) = pair.split_once('=') else {
            return Err(format!("--given: \"{pair}\" is refused: enter NAME=VALUE, as density_kg_m3=2600").into());
        };
        let (name, value) = (name.trim(), value.trim());
        if name != LABEL && value.contains(',') && value.replace(',', "").parse::<f64>().is_ok() {
            return Err(format!(
                "--given: \"{name}={value}\" is refused: --given takes a decimal point, and no separators of thousands"
            )
            .into());
        }
        cells.push((name, value));
    }
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(cells.iter().map(|(name, _)| name))?;
    table.write_record(cells.iter().map(|(_, value)| value))?;
    Ok(Some(String::from_utf8(table.into_inner()?)?))
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

/// A table to read, whose first columns, so many as `words`, hold words.
pub fn table_of(heads: Vec<&str>, words: usize, lines: impl IntoIterator<Item = Vec<String>>) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_header(heads).add_rows(lines);
    for column in table.column_iter_mut().skip(words) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Writes the summary, and says what it leaves out.
fn write_table(to: &mut impl Write, work: &impl Work, header: &Header<'_>, computed: &Computed) -> io::Result<()> {
    let Computed { rows, lines, unshown, .. } = computed;
    writeln!(to, "{}", table_of(work.heads(header), work.words(), lines.iter().cloned()))?;
    if *rows > lines.len() {
        writeln!(to, "The first {} of {rows} rows; --format csv writes all.", lines.len())?;
    }
    if let Some((number, reason)) = unshown {
        writeln!(to, "The first bad row below these is row {number}: {reason}")?;
    }
    Ok(())
}
