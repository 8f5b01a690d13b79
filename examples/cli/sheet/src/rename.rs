//! Which columns a table has, and other names for them.

use std::io::{BufRead, BufReader, Read, Write, copy};
use std::slice::from_ref;

use csv::ByteRecord;

use crate::Input;
use crate::catalogue::COLUMNS;
use crate::dialect::{self, Dialect};
use crate::header::Heading;
use crate::source::Source;
use crate::writer::BYTE_ORDER_MARK;

/// Most lines of a header, whose quoted cells may hold line ends.
const MOST_LINES: usize = 100;

/// A table up to its header, and what follows.
struct Start<'a> {
    byte_order_mark: bool,
    dialect: Dialect,
    header: ByteRecord,
    rest: BufReader<Box<dyn Read + 'a>>,
}

impl<'a> Start<'a> {
    fn of(source: impl Read + 'a) -> Result<Self, String> {
        let source = Source::of(source)?;
        let mut rest = BufReader::new(source.text);
        let (dialect, mut line) = dialect::read(&mut rest)?;
        for _ in 0..MOST_LINES {
            if line.iter().filter(|byte| **byte == b'"').count() % 2 == 0 {
                break;
            }
            rest.read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        }
        let reader = csv::ReaderBuilder::new().delimiter(dialect.delimiter).has_headers(false).from_reader(&line[..]);
        let header = reader.into_byte_records().next().unwrap_or_else(|| Ok(ByteRecord::new()));
        let header = header.map_err(|error| error.to_string())?;
        Ok(Self { byte_order_mark: source.byte_order_mark, dialect, header, rest })
    }
}

/// The text in a cell of a header.
fn text(cell: &[u8]) -> String {
    String::from_utf8_lossy(cell).trim().trim_start_matches('\u{feff}').to_owned()
}

/// The column of the catalogue that a heading names; `None` if it names none.
fn column(heading: &str) -> Option<String> {
    let inputs: Vec<_> = COLUMNS.iter().map(|column| Input::further(from_ref(&column.name))).collect();
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
/// instead. Another heading that names the same column becomes `unused_HEADING`.
///
/// # Errors
/// What is wrong with the table, in words.
pub fn rename(source: impl Read, names: &[(String, String)], mut sink: impl Write) -> Result<(), String> {
    let Start { byte_order_mark, dialect, header, mut rest } = Start::of(source)?;
    let taken: Vec<_> = names.iter().filter_map(|(_, to)| column(to)).collect();
    let renamed = header.iter().map(|cell| {
        let heading = text(cell);
        match names.iter().find(|(from, _)| *from == heading) {
            Some((_, to)) => to.clone(),
            None if column(&heading).is_some_and(|column| taken.contains(&column)) => format!("unused_{heading}"),
            None => heading,
        }
    });
    let terminator = if dialect.carriage_return { csv::Terminator::CRLF } else { csv::Terminator::Any(b'\n') };
    let mut variant = csv::WriterBuilder::new();
    variant.delimiter(dialect.delimiter).terminator(terminator);
    let mut writer = variant.from_writer(Vec::new());
    writer.write_record(renamed.map(String::into_bytes)).map_err(|error| error.to_string())?;
    let header = writer.into_inner().map_err(|error| error.to_string())?;
    let mark = if byte_order_mark { BYTE_ORDER_MARK } else { b"" };
    let start = [mark, &dialect.preamble, &header].concat();
    sink.write_all(&start).and_then(|()| copy(&mut rest, &mut sink)).map(drop).map_err(|error| error.to_string())
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
        assert_eq!(renamed("\"a\nb\",c\n1,2\n", &[("a\nb", "friction")]), "friction,c\n1,2\n");
        assert!(rename("".as_bytes(), &[], Vec::new()).unwrap_err().contains("the table is empty"));
    }

    #[test]
    fn headings_name_columns_of_the_catalogue() {
        let found = headings("Radius [um];density_g_cm3;name;remark\n".as_bytes()).unwrap();
        let columns: Vec<_> = found.iter().map(|(_, column)| column.as_deref()).collect();
        assert_eq!(columns, [Some("radius_m"), Some("density_kg_m3"), Some("name"), None]);
        assert_eq!(found[0].0, "Radius [um]");
    }
}
