//! Other names for the columns of a table.

use std::io::{BufRead, Write, copy};

use crate::{BYTE_ORDER_MARK, Dialect, column_name};

/// Copies a table, in which some columns get other names: each pair is a name of the header, and the one to write instead.
/// Another column that has a name to be written becomes `unused_NAME`.
///
/// # Errors
/// What is wrong with the table, in words.
pub fn rename(mut source: impl BufRead, names: &[(String, String)], mut sink: impl Write) -> Result<(), String> {
    let mut line = Vec::new();
    source.read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
    let dialect = Dialect::of(&line);
    let mut rows = csv::ReaderBuilder::new().delimiter(dialect.delimiter).has_headers(false).from_reader(&line[..]);
    let mut header = csv::ByteRecord::new();
    rows.read_byte_record(&mut header).map_err(|error| error.to_string())?;
    let renamed = header.iter().map(|cell| {
        let name = column_name(cell);
        if let Some((_, to)) = names.iter().find(|(from, _)| column_name(from.as_bytes()) == name) {
            return to.as_bytes().to_owned();
        }
        match names.iter().any(|(_, to)| *to == name) {
            true => format!("unused_{name}").into_bytes(),
            false => cell.strip_prefix(BYTE_ORDER_MARK).unwrap_or(cell).to_owned(),
        }
    });
    if dialect.byte_order_mark {
        sink.write_all(BYTE_ORDER_MARK).map_err(|error| error.to_string())?;
    }
    let terminator = if dialect.carriage_return { csv::Terminator::CRLF } else { csv::Terminator::Any(b'\n') };
    let mut writer =
        csv::WriterBuilder::new().delimiter(dialect.delimiter).terminator(terminator).from_writer(&mut sink);
    writer.write_record(renamed).and_then(|()| Ok(writer.flush()?)).map_err(|error| error.to_string())?;
    drop(writer);
    copy(&mut source, &mut sink).map_err(|error| error.to_string())?;
    Ok(())
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
        let table = "\u{feff}Size;\"speed; out\";radius_m\r\n1;\"2;\"\"3\";4\r\n5;6;7";
        let expected = "\u{feff}radius_m;speed_normal_m_s;unused_radius_m\r\n1;\"2;\"\"3\";4\r\n5;6;7";
        assert_eq!(renamed(table, &[("size", "radius_m"), ("Speed; out", "speed_normal_m_s")]), expected);
        assert_eq!(renamed(table, &[]), table);
        assert_eq!(renamed("", &[("a", "b")]), "\"\"\n");
    }
}
