//! The text of a table, from the bytes of a file: UTF-8, UTF-16, or a sheet of an xlsx workbook.

use std::cell::Cell;
use std::io::{self, Cursor, Read};
use std::rc::Rc;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use encoding_rs_io::DecodeReaderBytesBuilder;

use crate::workbook::{self, Worksheet};

/// The first bytes of a zip archive, which an xlsx workbook is.
const ZIP: &[u8] = b"PK\x03\x04";

/// The first bytes of an older workbook.
const COMPOUND_FILE: &[u8] = &[0xd0, 0xcf, 0x11, 0xe0];

/// Bytes that tell the kind of a file.
const MARKS: usize = 4;

/// Longest row of a table, bytes: what is longer is no row, but a file with a quote that is not closed.
const LONGEST_ROW: u64 = 1 << 24;

/// A text to read a table from.
pub(crate) struct Source<'a> {
    pub(crate) text: Box<dyn Read + 'a>,
    /// Whether the result begins with a byte-order mark, as spreadsheets need it.
    pub(crate) byte_order_mark: bool,
    /// Which sheet it is, if it is from a workbook of several.
    pub(crate) sheet: Option<String>,
}

impl<'a> Source<'a> {
    /// The text in some bytes.
    ///
    /// # Errors
    /// The bytes are no text and no workbook that can be read, or reading fails.
    pub(crate) fn of(mut bytes: impl Read + 'a) -> Result<Self, String> {
        let mut start = Vec::new();
        bytes.by_ref().take(MARKS as u64).read_to_end(&mut start).map_err(|error| error.to_string())?;
        if start == COMPOUND_FILE {
            return Err("this is a workbook of an older format; save it as .xlsx or CSV".into());
        }
        let is_workbook = start == ZIP;
        let encoding = encoding(&start);
        let byte_order_mark = encoding.is_some();
        let all = Cursor::new(start).chain(bytes);
        if is_workbook {
            let Worksheet { csv, name, others } = workbook::first_sheet(all)?;
            let sheet = (!others.is_empty())
                .then(|| format!("sheet {name} of the workbook is read, and not {}", others.join(", ")));
            return Ok(Self { text: Box::new(Cursor::new(csv)), byte_order_mark: false, sheet });
        }
        let text: Box<dyn Read + 'a> = match encoding {
            // The decoder leaves out the mark.
            Some(encoding) => {
                Box::new(DecodeReaderBytesBuilder::new().encoding(Some(encoding)).bom_override(true).build(all))
            }
            None => Box::new(all),
        };
        Ok(Self { text, byte_order_mark, sheet: None })
    }
}

/// The encoding of a file with a byte-order mark, or of a UTF-16 file whose first character is one of ASCII.
fn encoding(start: &[u8]) -> Option<&'static Encoding> {
    match start {
        [0xef, 0xbb, 0xbf, ..] => Some(UTF_8),
        [0xff, 0xfe, ..] => Some(UTF_16LE),
        [0xfe, 0xff, ..] => Some(UTF_16BE),
        [first, 0, ..] if *first != 0 => Some(UTF_16LE),
        [0, second, ..] if *second != 0 => Some(UTF_16BE),
        _ => None,
    }
}

/// A text from its header on. Where the header is not UTF-8, the text has the code page of older spreadsheets, in which the sign of
/// a micrometre is one byte.
pub(crate) fn in_utf8<'a>(header: Vec<u8>, others: impl Read + 'a) -> Box<dyn Read + 'a> {
    let is_utf8 = std::str::from_utf8(&header).is_ok();
    let all = Cursor::new(header).chain(others);
    if is_utf8 {
        Box::new(all)
    } else {
        Box::new(DecodeReaderBytesBuilder::new().encoding(Some(WINDOWS_1252)).build(all))
    }
}

/// Counts of the text that a table was read from.
#[derive(Default)]
struct Counts {
    /// Bytes since the last row.
    bytes: Cell<u64>,
    quotes: Cell<u64>,
    has_ended: Cell<bool>,
}

/// A handle of what a [`Guarded`] reader has counted.
#[derive(Clone, Default)]
pub(crate) struct Guard(Rc<Counts>);

impl Guard {
    /// A reader that counts for this guard.
    pub(crate) fn over<R>(&self, text: R) -> Guarded<R> {
        Guarded { text, counts: Rc::clone(&self.0) }
    }

    /// Begins a row.
    pub(crate) fn begin(&self) {
        self.0.bytes.set(0);
    }

    /// Whether the text has ended, and its quotes are not in pairs.
    pub(crate) fn is_open_at_end(&self) -> bool {
        self.0.has_ended.get() && self.0.quotes.get() % 2 == 1
    }
}

/// A reader that counts quotes, and stops where a row does not end.
pub(crate) struct Guarded<R> {
    text: R,
    counts: Rc<Counts>,
}

impl<R: Read> Read for Guarded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.text.read(buffer)?;
        self.counts.has_ended.set(length == 0 && !buffer.is_empty());
        let quotes = memchr::memchr_iter(b'"', &buffer[..length]).count();
        self.counts.quotes.set(self.counts.quotes.get() + quotes as u64);
        self.counts.bytes.set(self.counts.bytes.get() + length as u64);
        if self.counts.bytes.get() > LONGEST_ROW {
            return Err(io::Error::other(format!(
                "a row is longer than {} MB: a quote is probably not closed; close it or remove it",
                LONGEST_ROW >> 20
            )));
        }
        Ok(length)
    }
}
