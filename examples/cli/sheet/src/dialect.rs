//! The variant of CSV of a table, and what stands before its header.

use std::io::{BufRead, Read};

use csv::ByteRecord;

/// Most lines before a header.
const MOST_LINES: usize = 1000;

/// Lines without the columns that a command needs that may be titles above the header.
const MOST_TITLES: usize = 50;

/// Longest line before the first row, bytes.
const LONGEST_LINE: u64 = 1 << 20;

/// The marks that may separate cells.
const DELIMITERS: [u8; 3] = [b'\t', b';', b','];

/// The variant of CSV of a table.
#[derive(Clone)]
pub(crate) struct Dialect {
    pub(crate) delimiter: u8,
    pub(crate) carriage_return: bool,
    /// Lines before the header, `sep=;`, comments and titles, which the result repeats.
    pub(crate) preamble: Vec<u8>,
    /// How many of these are titles.
    pub(crate) titles: usize,
}

/// A line that may be the header.
struct Candidate {
    dialect: Dialect,
    /// The line, and those that were read after it.
    lines: Vec<u8>,
    /// How many columns it names.
    named: usize,
}

/// Reads a text up to its header; returns what was read from the header on too. `named` says how many columns some cells name, and
/// whether they are all that a table must have. The header is the first line that names all, or else the one that names most.
///
/// # Errors
/// Reading fails, or no header follows.
pub(crate) fn read(
    text: &mut impl BufRead,
    named: impl Fn(&ByteRecord) -> (usize, bool),
) -> Result<(Dialect, Vec<u8>), String> {
    let (mut preamble, mut separator, mut titles) = (Vec::new(), None, 0);
    let mut best: Option<Candidate> = None;
    for _ in 0..MOST_LINES {
        let mut line = Vec::new();
        text.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        if line.is_empty() || titles > MOST_TITLES {
            if let Some(Candidate { dialect, mut lines, .. }) = best {
                lines.extend(line);
                return Ok((dialect, lines));
            }
            return Err("the table is empty; its first row must name the columns".into());
        }
        if let Some(delimiter) = stated_separator(&line) {
            separator = Some(delimiter);
        } else if !is_comment(&line) && !is_blank(&line) {
            if line.contains(&0) {
                return Err("this is no text: it holds bytes of zero; save the table as CSV or xlsx".into());
            }
            let (delimiter, carriage_return) = (separator.unwrap_or(delimiter(&line)), line.ends_with(b"\r\n"));
            let dialect = |preamble| Dialect { delimiter, carriage_return, preamble, titles };
            let (named, are_all) = named(&cells(&line, delimiter));
            if are_all {
                return Ok((dialect(preamble), line));
            }
            if best.as_ref().is_none_or(|best| named > best.named) {
                best = Some(Candidate { dialect: dialect(preamble.clone()), lines: Vec::new(), named });
            }
            titles += 1;
        }
        if let Some(best) = &mut best {
            best.lines.extend(&line);
        }
        if !is_blank(&line) {
            preamble.extend(line);
        }
    }
    if let Some(Candidate { dialect, lines, .. }) = best {
        return Ok((dialect, lines));
    }
    Err(format!("no header in the first {MOST_LINES} lines; a row must name the columns"))
}

/// The cells of a line.
fn cells(line: &[u8], delimiter: u8) -> ByteRecord {
    let mut cells = ByteRecord::new();
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).has_headers(false).from_reader(line);
    // Bytes in memory are read without an error.
    let _ = reader.read_byte_record(&mut cells);
    cells
}

/// The separator that a line such as `sep=;` states.
fn stated_separator(line: &[u8]) -> Option<u8> {
    let text = line.trim_ascii();
    let text = text.strip_prefix(b"\"").and_then(|text| text.strip_suffix(b"\"")).unwrap_or(text);
    let (key, value) = text.split_at_checked(4)?;
    // The tab is white space.
    let value = if value.is_empty() { line.trim_ascii_start().get(4..5)? } else { value };
    (key.eq_ignore_ascii_case(b"sep=") && value.len() == 1).then(|| value[0]).filter(u8::is_ascii)
}

fn is_comment(line: &[u8]) -> bool {
    let text = line.trim_ascii_start();
    text.strip_prefix(b"\"").unwrap_or(text).starts_with(b"#")
}

/// Whether a line has no cell with a text, or is a rule.
fn is_blank(line: &[u8]) -> bool {
    line.iter().all(|byte| byte.is_ascii_whitespace() || DELIMITERS.contains(byte) || b"\"-=".contains(byte))
}

/// The mark that separates the cells of a header.
fn delimiter(header: &[u8]) -> u8 {
    let outside_quotes = |delimiter: u8| {
        let mut quoted = false;
        let separates = |byte: &&u8| {
            quoted ^= **byte == b'"';
            **byte == delimiter && !quoted
        };
        header.iter().filter(separates).count()
    };
    // `max_by_key` keeps the last of equals, so the comma is chosen for a header of one cell.
    DELIMITERS.into_iter().max_by_key(|&delimiter| outside_quotes(delimiter)).unwrap_or(b',')
}
