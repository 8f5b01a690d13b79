//! The variant of CSV of a table, and what stands before its header.

use std::io::{BufRead, Read};

/// Most lines before a header.
const MOST_LINES: usize = 1000;

/// Longest line before the first row, bytes.
const LONGEST_LINE: u64 = 1 << 20;

/// The marks that may separate cells.
const DELIMITERS: [u8; 3] = [b'\t', b';', b','];

/// The variant of CSV of a table.
#[derive(Clone)]
pub(crate) struct Dialect {
    pub(crate) delimiter: u8,
    pub(crate) carriage_return: bool,
    /// Lines before the header, `sep=;` and comments, which the result repeats.
    pub(crate) preamble: Vec<u8>,
}

/// Reads a text up to its header; returns the header line too.
///
/// # Errors
/// Reading fails, or no header follows.
pub(crate) fn read(text: &mut impl BufRead) -> Result<(Dialect, Vec<u8>), String> {
    let (mut preamble, mut separator) = (Vec::new(), None);
    for _ in 0..MOST_LINES {
        let mut line = Vec::new();
        text.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        if line.is_empty() {
            return Err("the table is empty; its first row must name the columns".into());
        }
        if let Some(delimiter) = stated_separator(&line) {
            separator = Some(delimiter);
            preamble.extend(line);
        } else if is_comment(&line) {
            preamble.extend(line);
        } else if !is_blank(&line) {
            if line.contains(&0) {
                return Err("this is no text: it holds bytes of zero; save the table as CSV or xlsx".into());
            }
            let carriage_return = line.ends_with(b"\r\n");
            return Ok((Dialect { delimiter: separator.unwrap_or(delimiter(&line)), carriage_return, preamble }, line));
        }
    }
    Err(format!("no header in the first {MOST_LINES} lines; a row must name the columns"))
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
