//! Columns with one value for all rows of a table.

use std::io::{Read, Write};

use csv::ByteRecord;

use crate::header::{Heading, is_unit_row};
use crate::rename::{Start, all_inputs};
use crate::row::text;
use crate::{COMMENT, is_decoration};

/// Copies a table and adds columns after its own: each pair is a heading, and the text that all rows have below it. A row of units, and
/// a row without data, stay as they are.
///
/// # Errors
/// What is wrong with the table, in words.
pub fn complete(source: impl Read, columns: &[(String, String)], mut sink: impl Write) -> Result<(), String> {
    let start = Start::of(source)?;
    let given: Vec<_> = (0..start.header.len()).map(|index| text(&start.header, index).into_owned()).collect();
    let inputs = all_inputs();
    // A heading whose unit is not known names no column.
    let known = |heading: &String| Heading::of(heading, &inputs).or_else(|_| Heading::of("", &inputs));
    let headings = given.iter().map(known).collect::<Result<Vec<_>, _>>()?;
    start.write(given.iter().cloned().chain(columns.iter().map(|(name, _)| name.clone())), &mut sink)?;
    let mut writer = start.writer(sink);
    let mut rows = csv::ReaderBuilder::new();
    rows.delimiter(start.dialect.delimiter).flexible(true).has_headers(false).comment(Some(COMMENT));
    let mut is_first = true;
    for row in rows.from_reader(start.rest).into_byte_records() {
        let mut row = row.map_err(|error| error.to_string())?;
        if !is_decoration(&row) {
            let cells: Vec<_> = (0..row.len()).map(|index| text(&row, index).into_owned()).collect();
            if !(is_first && is_unit_row(&headings, &cells, &inputs)) {
                row = completed(&row, given.len(), columns);
            }
            is_first = false;
        }
        writer.write_byte_record(&row).map_err(|error| error.to_string())?;
    }
    writer.flush().map_err(|error| error.to_string())
}

/// A row with the added cells below their headings; cells that it has beyond the headings come after them.
fn completed(row: &ByteRecord, width: usize, columns: &[(String, String)]) -> ByteRecord {
    let given = (0..width).map(|index| row.get(index).unwrap_or_default());
    given.chain(columns.iter().map(|(_, value)| value.as_bytes())).chain(row.iter().skip(width)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Decimal, Input, Sheet};

    #[test]
    fn every_row_has_the_added_cells() {
        let table = "# bench\r\nsize;\"v; out\"\r\num;m/s\r\n1,5;2\r\n\r\n3\r\n4;5;6\r\n";
        let named = "# bench\r\nradius [um];v\r\num;m/s\r\n1,5;2\r\n";
        let columns = [("density_kg_m3", "26e2"), ("law", "jkr")].map(|(name, value)| (name.into(), value.into()));
        let completed = |table: &str| {
            let mut to = Vec::new();
            complete(table.as_bytes(), &columns, &mut to).unwrap();
            String::from_utf8(to).unwrap()
        };
        let text = completed(table);
        let expected = "# bench\r\nsize;\"v; out\";density_kg_m3;law\r\num;m/s\r\n1,5;2;26e2;jkr\r\n3;;26e2;jkr\r\n4;5;26e2;jkr;6\r\n";
        assert_eq!(text, expected);

        let inputs = [Input::required(&["radius_m"]), Input::required(&["density_kg_m3"])];
        let completed = completed(named);
        let mut sheet = Sheet::open(completed.as_bytes(), &inputs, None::<Decimal>).unwrap();
        let row = sheet.next_row().unwrap().unwrap();
        assert_eq!((row.number("radius_m"), row.number("density_kg_m3")), (Ok(Some(1.5e-6)), Ok(Some(2600.0))));
        assert!(sheet.next_row().unwrap().is_none());
    }
}
