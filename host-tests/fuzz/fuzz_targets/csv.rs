//! Tables of the command line. From this package's folder:
//!
//! ```text
//! cargo fuzz run --sanitizer none csv
//! ```
//!
//! The first byte chooses a command and its options; the others are the file. Checked:
//!
//! * nothing panics, and the exit status is 0, 1 or 2;
//! * a text that is read gives one row of CSV for each of its rows that has a cell, each with a result or an error; a comment, a
//!   `sep=` and a row of units are no rows;
//! * the exit status says whether a row has an error, and a file that is refused is refused in words.
#![no_main]

use clap::Parser;
use csv::{ByteRecord, ReaderBuilder};
use libfuzzer_sys::fuzz_target;
use microimpact_cli::{Arguments, Streams};

/// Commands with the column that each row without an error has.
const COMMANDS: [(&str, &[&str], &str); 8] = [
    ("classify", &[], "outcome"),
    ("classify", &["--model", "simulation"], "outcome"),
    ("classify", &["--model", "both", "--scalar", "f32", "--tolerance", "1e-6"], "outcome"),
    ("classify", &["--model", "simulation", "--method", "fixed-cost"], "outcome"),
    ("classify", &["--decimal", "comma"], "outcome"),
    ("analyse", &[], "outcome"),
    ("analyse", &["--scalar", "f32"], "outcome"),
    ("critical", &[], "critical"),
];

fuzz_target!(|data: &[u8]| {
    let Some((&choice, file)) = data.split_first() else {
        return;
    };
    let (command, options, column) = COMMANDS[usize::from(choice & 7)];
    if choice & 8 != 0 {
        // The summary is for people: its lines are not counted here.
        let summary = run(command, options, "table", file);
        assert!(summary.status == 2 || !summary.output.is_empty());
        return;
    }
    let Output { status, output, errors } = run(command, options, "csv", file);
    if status == 2 {
        assert!(!errors.is_empty(), "{command} fails without a word");
        return;
    }
    let body = body(&output);
    // The file may state any mark in `sep=`.
    let mut marks = [b'\t', b';', b','].into_iter().chain(0..128);
    let delimiter = marks.find(|&delimiter| delimiter != b'\n' && table(body, delimiter).is_computed());
    let delimiter = delimiter.unwrap_or_else(|| panic!("no column `error`: {}", String::from_utf8_lossy(&output)));
    let computed = table(body, delimiter);
    let what = || format!("{command} {options:?}: {}", String::from_utf8_lossy(&output));
    if is_plain(file) {
        let filled = |row: &&ByteRecord| row.iter().any(|cell| !cell.trim_ascii().is_empty());
        let given = table(self::body(file), delimiter).rows.iter().filter(filled).count();
        let units = given.saturating_sub(computed.rows.len());
        assert!(units <= 1 && given >= computed.rows.len(), "{given} rows: {}", what());
    }
    let place = computed.header.iter().rposition(|name| name == column.as_bytes()).expect("the column is written");
    let mut bad = 0;
    for row in &computed.rows {
        let (result, error) = (&row[place], &row[row.len() - 1]);
        assert_eq!(row.len(), computed.header.len(), "{}", what());
        // A row may have the result of one model and the error of the other.
        assert!(!result.is_empty() || !error.is_empty(), "{}", what());
        bad += usize::from(!error.is_empty());
    }
    assert_eq!(status, u8::from(bad > 0), "{}", what());
});

/// What a command wrote, and its exit status.
struct Output {
    status: u8,
    output: Vec<u8>,
    errors: Vec<u8>,
}

fn run(command: &str, options: &[&str], format: &str, mut file: &[u8]) -> Output {
    let words = ["microimpact", command, "-", "--format", format].into_iter().chain(options.iter().copied());
    let arguments = Arguments::try_parse_from(words).unwrap_or_else(|error| panic!("{error}"));
    let (mut output, mut errors) = (Vec::new(), Vec::new());
    let status = arguments.run(&mut Streams { input: &mut file, output: &mut output, errors: &mut errors });
    assert!(status <= 2, "{status}");
    Output { status, output, errors }
}

/// Whether a file is a text whose bytes are those of its cells: no workbook, and neither UTF-16 nor an old code page.
fn is_plain(file: &[u8]) -> bool {
    std::str::from_utf8(file).is_ok() && !file.contains(&0) && !file.starts_with(b"PK")
}

/// A table from its header on: without comments, `sep=` and empty lines before it.
fn body(table: &[u8]) -> &[u8] {
    let mut rest = table.strip_prefix("\u{feff}".as_bytes()).unwrap_or(table);
    loop {
        let end = rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |end| end + 1);
        let line = rest[..end].trim_ascii_start();
        let line = line.strip_prefix(b"\"").unwrap_or(line);
        let is_blank = line.iter().all(|byte| byte.is_ascii_whitespace() || b"\t;,\"".contains(byte));
        let is_separator = line.len() > 4 && line[..4].eq_ignore_ascii_case(b"sep=");
        if end == 0 || !(is_blank || is_separator || line.starts_with(b"#")) {
            return rest;
        }
        rest = &rest[end..];
    }
}

/// A table as the crate `csv` reads it.
struct Table {
    header: Vec<Vec<u8>>,
    rows: Vec<ByteRecord>,
}

fn table(file: &[u8], delimiter: u8) -> Table {
    let mut reader = ReaderBuilder::new().delimiter(delimiter).flexible(true).from_reader(file);
    let header = reader.byte_headers().map(|header| header.iter().map(<[u8]>::to_vec).collect());
    let rows = reader.byte_records().collect::<Result<_, _>>();
    Table { header: header.unwrap_or_default(), rows: rows.unwrap_or_default() }
}

impl Table {
    /// Whether its last column is that of errors.
    fn is_computed(&self) -> bool {
        self.header.len() > 1 && self.header.last().is_some_and(|name| name == b"error")
    }
}
