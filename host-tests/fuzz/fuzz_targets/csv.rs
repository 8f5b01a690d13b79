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
//!   `sep=`, a title and a row of units are no rows;
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
    // The result repeats the lines above its header, so that any line that ends with `error` may be the header.
    let mut lines = 0..=output.iter().filter(|byte| **byte == b'\n').count();
    assert!(
        lines.any(|above| is_answer(below(&output, above), below(file, above), column, status)),
        "{command} {options:?}, status {status}: {}",
        String::from_utf8_lossy(&output)
    );
});

/// Whether a result is what a command must write for a file: its last column is that of errors, each row of the file that has a
/// cell has a row with a result or an error, and the exit status says whether there is an error.
fn is_answer(result: &[u8], file: &[u8], column: &str, status: u8) -> bool {
    let header = result.split(|byte| *byte == b'\n').next().unwrap_or_default().trim_ascii_end();
    // The file may state any mark in `sep=`.
    let Some(&mark) = header.strip_suffix(b"error").and_then(<[u8]>::last) else {
        return false;
    };
    let computed = table(result, mark);
    if computed.header.last().is_none_or(|name| name != b"error") {
        return false;
    }
    let Some(place) = computed.header.iter().rposition(|name| name == column.as_bytes()) else {
        return false;
    };
    let given = table(file, mark).rows;
    let given = given.iter().filter(|row| row.iter().any(|cell| !cell.trim_ascii().is_empty())).count();
    // One may state the units.
    let are_all = !is_plain(file) || (computed.rows.len()..=computed.rows.len() + 1).contains(&given);
    let has_error = |row: &ByteRecord| !row[row.len() - 1].is_empty();
    // A row may have the result of one model and the error of the other.
    let is_whole = |row: &ByteRecord| row.len() == computed.header.len() && (!row[place].is_empty() || has_error(row));
    are_all && computed.rows.iter().all(is_whole) && (status == 1) == computed.rows.iter().any(has_error)
}

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

/// A table below some lines that are not blank, and the blank ones after them.
fn below(table: &[u8], mut lines: usize) -> &[u8] {
    let mut rest = table.strip_prefix("\u{feff}".as_bytes()).unwrap_or(table);
    loop {
        let end = rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |end| end + 1);
        let is_blank = rest[..end].iter().all(|byte| byte.is_ascii_whitespace() || b"\t;,\"-=".contains(byte));
        if end == 0 || (lines == 0 && !is_blank) {
            return rest;
        }
        lines -= usize::from(!is_blank);
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
