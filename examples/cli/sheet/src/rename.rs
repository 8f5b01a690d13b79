//! Which columns a table has, and other names for them.

use std::io::{BufRead, BufReader, Cursor, Read, Write, copy};
use std::slice::from_ref;

use csv::{ByteRecord, Terminator};

use crate::catalogue::COLUMNS;
use crate::columns;
use crate::dialect::{self, Dialect};
use crate::header::Heading;
use crate::source::Source;
use crate::writer::BYTE_ORDER_MARK;
use crate::{COMMENT, Input};

/// Most lines of a header, whose quoted cells may hold line ends.
const MOST_LINES: usize = 100;

/// All columns of the catalogue, none of them required.
pub(crate) fn all_inputs() -> Vec<Input> {
    COLUMNS.iter().map(|column| Input::further(from_ref(&column.name))).collect()
}

/// A table up to its header, and what follows.
pub(crate) struct Start<'a> {
    byte_order_mark: bool,
    pub(crate) dialect: Dialect,
    pub(crate) header: ByteRecord,
    pub(crate) rest: BufReader<Box<dyn Read + 'a>>,
}

impl<'a> Start<'a> {
    pub(crate) fn of(source: impl Read + 'a) -> Result<Self, String> {
        let source = Source::of(source)?;
        let mut text = BufReader::new(source.text);
        let inputs = all_inputs();
        // Which of them the table needs is not known; a title does not name several.
        let (dialect, start) = dialect::read(&mut text, |cells| {
            let (named, _) = columns::named(cells, &inputs);
            (named, named > 1)
        })?;
        let (mut line, rest): (_, Box<dyn Read + 'a>) = (Vec::new(), Box::new(Cursor::new(start).chain(text)));
        let mut rest = BufReader::new(rest);
        for _ in 0..MOST_LINES {
            rest.read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
            if line.iter().filter(|byte| **byte == b'"').count() % 2 == 0 {
                break;
            }
        }
        let reader = csv::ReaderBuilder::new().delimiter(dialect.delimiter).has_headers(false).from_reader(&line[..]);
        let header = reader.into_byte_records().next().unwrap_or_else(|| Ok(ByteRecord::new()));
        let header = header.map_err(|error| error.to_string())?;
        Ok(Self { byte_order_mark: source.byte_order_mark, dialect, header, rest })
    }

    /// A writer of rows in the variant of the table.
    pub(crate) fn writer<W: Write>(&self, sink: W) -> csv::Writer<W> {
        let terminator = if self.dialect.carriage_return { Terminator::CRLF } else { Terminator::Any(b'\n') };
        csv::WriterBuilder::new()
            .delimiter(self.dialect.delimiter)
            .terminator(terminator)
            .flexible(true)
            .comment(Some(COMMENT))
            .from_writer(sink)
    }

    /// Writes what stands before the rows, with these headings.
    pub(crate) fn write(
        &self,
        headings: impl IntoIterator<Item = String>,
        sink: &mut impl Write,
    ) -> Result<(), String> {
        let mut writer = self.writer(Vec::new());
        writer.write_record(headings.into_iter().map(String::into_bytes)).map_err(|error| error.to_string())?;
        let header = writer.into_inner().map_err(|error| error.to_string())?;
        let mark = if self.byte_order_mark { BYTE_ORDER_MARK } else { b"" };
        sink.write_all(&[mark, &self.dialect.preamble, &header].concat()).map_err(|error| error.to_string())
    }

    /// Writes a table with these headings and the rows that follow, as they are.
    fn copy(mut self, headings: Vec<String>, mut sink: impl Write) -> Result<(), String> {
        self.write(headings, &mut sink)?;
        copy(&mut self.rest, &mut sink).map(drop).map_err(|error| error.to_string())
    }
}

/// The text in a cell of a header.
fn text(cell: &[u8]) -> String {
    String::from_utf8_lossy(cell).trim().trim_start_matches('\u{feff}').to_owned()
}

/// The column of the catalogue that a heading names; `None` if it names none.
fn column(heading: &str) -> Option<String> {
    let inputs = all_inputs();
    let name = Heading::of(heading, &inputs).ok()?.name;
    COLUMNS.iter().any(|column| column.name == name).then_some(name)
}

/// The headings of a table, each as it is written and with the column of the catalogue that it names, if it names one.
///
/// # Errors
/// What is wrong with the table, in words.
pub fn headings(source: impl Read) -> Result<Vec<(String, Option<String>)>, String> {
    let start = Start::of(source)?;
    let texts = start.header.iter().map(text);
    Ok(texts.map(|text| (text.clone(), column(&text))).collect())
}

/// Copies a table, in which some columns get other headings: each pair is a heading as it is written, and the one to write
/// instead. One that is empty, and another heading that names the same column, become `unused_HEADING`.
///
/// # Errors
/// What is wrong with the table, in words.
pub fn rename(source: impl Read, names: &[(String, String)], sink: impl Write) -> Result<(), String> {
    let start = Start::of(source)?;
    let taken: Vec<_> = names.iter().filter_map(|(_, to)| column(to)).collect();
    let renamed = start.header.iter().map(text).map(|heading| match names.iter().find(|(from, _)| *from == heading) {
        Some((_, to)) if !to.is_empty() => to.clone(),
        None if column(&heading).is_none_or(|column| !taken.contains(&column)) => heading,
        _ => format!("unused_{heading}"),
    });
    let headings = renamed.collect();
    start.copy(headings, sink)
}

/// Copies a table whose first columns get the headings of another again. One that a later column has becomes `input_HEADING`.
///
/// # Errors
/// What is wrong with the table, in words.
pub fn restore(source: impl Read, given: &[String], sink: impl Write) -> Result<(), String> {
    let start = Start::of(source)?;
    let others: Vec<_> = start.header.iter().skip(given.len()).map(|cell| text(cell).to_lowercase()).collect();
    let restored = start.header.iter().enumerate().map(|(index, cell)| {
        let Some(heading) = given.get(index) else { return text(cell) };
        let mut heading = heading.clone();
        while others.contains(&heading.to_lowercase()) {
            heading.insert_str(0, "input_");
        }
        heading
    });
    let headings = restored.collect();
    start.copy(headings, sink)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn renamed(table: &str, names: &[(&str, &str)]) -> String {
        let names: Vec<_> = names.iter().map(|(from, to)| ((*from).to_owned(), (*to).to_owned())).collect();
        let mut to = Vec::new();
        rename(table.as_bytes(), &names, &mut to).unwrap();
        String::from_utf8(to).unwrap()
    }

    #[test]
    fn only_the_header_changes() {
        let table = "\u{feff}# from the bench\r\nSize;\"speed; out\";Radius [mm]\r\n1;\"2;\"\"3\";4\r\n5;6;7";
        let expected =
            "\u{feff}# from the bench\r\nradius_um;speed_normal_m_s;unused_Radius [mm]\r\n1;\"2;\"\"3\";4\r\n5;6;7";
        assert_eq!(renamed(table, &[("Size", "radius_um"), ("speed; out", "speed_normal_m_s")]), expected);
        assert_eq!(renamed(table, &[]), table);
        assert_eq!(renamed("zeta_h,v\n1,2\n", &[("zeta_h", "")]), "unused_zeta_h,v\n1,2\n");
        assert_eq!(renamed("\"a\nb\",c\n1,2\n", &[("a\nb", "friction")]), "friction,c\n1,2\n");
        assert!(rename("".as_bytes(), &[], Vec::new()).unwrap_err().contains("the table is empty"));
    }

    #[test]
    fn a_result_gets_the_headings_of_its_table() {
        let result = "radius_um;unused_zeta_h;input_law;motion;law\n1;2;3;4;5\n";
        let given = ["Size (um)", "zeta_h", "Law"].map(String::from);
        let mut to = Vec::new();
        restore(result.as_bytes(), &given, &mut to).unwrap();
        assert_eq!(String::from_utf8(to).unwrap(), "Size (um);zeta_h;input_Law;motion;law\n1;2;3;4;5\n");
    }

    #[test]
    fn headings_name_columns_of_the_catalogue() {
        let found = headings("Rig; 3\nRadius [um];density_g_cm3;name;remark\n1;2;a;b\n".as_bytes()).unwrap();
        let columns: Vec<_> = found.iter().map(|(_, column)| column.as_deref()).collect();
        assert_eq!(columns, [Some("radius_m"), Some("density_kg_m3"), Some("name"), None]);
        assert_eq!(found[0].0, "Radius [um]");
        // Where no line has several, it is the first.
        let found = headings("size,speed\n1,2\n3,4\n".as_bytes()).unwrap();
        assert_eq!(found, [("size".to_owned(), None), ("speed".to_owned(), None)]);
    }
}
