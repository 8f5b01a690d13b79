//! Which column of a header is which, and in which unit.

use crate::catalogue::Column;
use crate::units::{Unit, is_unit, plain, unit_by_suffix, unit_in, units_of};
use crate::{Input, LABEL};

/// A cell of a header.
#[derive(Clone, Debug)]
pub(crate) struct Heading {
    /// The text as it is written, and without space around it.
    pub(crate) raw: String,
    pub(crate) text: String,
    /// The same in lower case, with underscores for spaces.
    pub(crate) given: String,
    /// The column of the catalogue that it is, if the command reads that; otherwise the text in lower case.
    pub(crate) name: String,
    /// The unit of its numbers, if the command reads the column and the unit is not that in which it computes.
    pub(crate) unit: Option<Unit>,
}

impl Heading {
    /// The heading of a column that a command reads, or of another.
    ///
    /// # Errors
    /// The unit in brackets is none of the column's quantity.
    pub(crate) fn of(cell: &str, inputs: &[Input]) -> Result<Self, String> {
        let text = without_quotes(cell.trim().trim_start_matches('\u{feff}'));
        let (words, brackets) = split(text);
        let base = lower(words);
        let columns = || inputs.iter().flat_map(|input| input.columns()).copied();
        let mut heading = Self {
            name: text.to_lowercase(),
            given: lower(text),
            raw: cell.to_owned(),
            text: text.to_owned(),
            unit: None,
        };
        if let Some(unit) = brackets {
            if let Some((name, unit)) = in_brackets(columns(), &base, unit)? {
                heading.name = name.to_owned();
                heading.unit = unit;
            }
            return Ok(heading);
        }
        for base in [base, spelled(words)] {
            if let Some(name) = columns().find(|column| *column == base) {
                heading.name = name.to_owned();
                break;
            }
            if let Some((name, unit)) = columns().find_map(|name| Some((name, by_suffix(name, &base)?))) {
                heading.name = name.to_owned();
                heading.unit = (!unit.is_si()).then_some(unit);
                break;
            }
        }
        Ok(heading)
    }

    /// Gives a heading without a unit that of a row of units.
    ///
    /// # Errors
    /// The unit is unknown, none of the column's quantity, or contradicts that of the header.
    pub(crate) fn add_unit(&mut self, unit: &str, inputs: &[Input]) -> Result<(), String> {
        let (words, brackets) = split(&self.text);
        let unit = unit.trim_matches(['[', ']', '(', ')']);
        // A dash states no unit, and labels have none.
        if matches!(unit, "" | "-" | "–") || brackets.is_some() || self.name == LABEL {
            return Ok(());
        }
        let is_read = inputs.iter().any(|input| input.columns().contains(&self.name.as_str()));
        let is_that_of_name = || {
            let stated = unit_in(units_of(Column::named(&self.name)?.unit), unit)?;
            Some(self.unit.map_or(stated.is_si(), |named| named == stated))
        };
        if is_read && is_that_of_name() == Some(true) {
            return Ok(());
        }
        // A name of a number without a unit leaves open whether it is in per cent.
        let is_open = !is_read || Column::named(&self.name).is_some_and(|column| column.unit == "1");
        match Self::of(&format!("{words} [{unit}]"), inputs) {
            Ok(with_unit) if is_open => *self = with_unit,
            Err(reason) if is_open => return Err(reason),
            _ => {
                return Err(format!(
                    "{}: the row below the header says \"{unit}\", which is not the unit in the name; correct one of them",
                    self.text
                ));
            }
        }
        Ok(())
    }

    /// Whether the catalogue has numbers in this column.
    pub(crate) fn is_number(&self) -> bool {
        self.unit.is_some() || Column::named(&self.name).is_some_and(|column| !column.unit.is_empty())
    }

    /// Whether it is a column of these inputs, or its name without a unit.
    pub(crate) fn may_be_read(&self, inputs: &[Input]) -> bool {
        let mut columns = inputs.iter().flat_map(|input| input.columns()).copied();
        columns.any(|name| name == self.name || Column::named(name).is_some_and(|column| column.base() == self.given))
    }

    /// The name by which a message about a cell calls the column: that of the header, if its unit is another.
    pub(crate) fn name_in_messages(&self) -> &str {
        if self.unit.is_some() { &self.text } else { &self.name }
    }

    /// The heading as a message names it: the name as it was given, with the unit that its numbers have.
    pub(crate) fn in_words(&self) -> String {
        match &self.unit {
            Some(unit) => format!("{} ({} in {})", self.text, self.name, unit.symbol),
            None => self.name.clone(),
        }
    }
}

/// A text without the quotes that stay in a cell behind a space: `"radius_m" , "density_kg_m3"`.
fn without_quotes(text: &str) -> &str {
    text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text).trim()
}

/// A text as names of columns are written: in lower case, with underscores for spaces.
fn lower(text: &str) -> String {
    text.trim().to_lowercase().replace(['µ', 'μ'], "u").replace([' ', '-'], "_")
}

/// The same of a name whose unit is written as in a text: `Radius / µm`, `density kg/m³`.
fn spelled(text: &str) -> String {
    plain(&lower(text)).split(['/', ' ', '_']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}

/// The unit that a heading states in brackets or at its end, whatever its words; `None` if it states none of this quantity.
pub(crate) fn stated_unit(heading: &str, units: &'static [Unit]) -> Option<Unit> {
    let (words, brackets) = split(heading.trim());
    if let Some(unit) = brackets {
        return unit_in(units, unit);
    }
    let name = lower(words).replace('/', "_").replace('^', "");
    let ends_with = |unit: &&Unit| name.strip_suffix(unit.suffix().as_str()).is_some_and(|rest| rest.ends_with('_'));
    // The longest, as cm/s rather than s; of those that differ in capitals only, the commoner, which is first.
    units.iter().rev().filter(ends_with).max_by_key(|unit| unit.symbol.len()).copied()
}

/// The words before brackets at the end of a header, and what stands in the brackets.
fn split(text: &str) -> (&str, Option<&str>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((words, unit)) = text.trim().strip_suffix(close).and_then(|text| text.rsplit_once(open)) {
            return (words.trim(), Some(unit.trim()));
        }
    }
    (text, None)
}

/// The unit that the end of a name states, if the rest of it is that of a column.
fn by_suffix(column: &str, name: &str) -> Option<Unit> {
    let column = Column::named(column)?;
    let suffix = name.strip_prefix(column.base())?.strip_prefix('_')?;
    unit_by_suffix(units_of(column.unit), suffix)
}

/// The column with a base name, or a full name, and a unit in brackets.
fn in_brackets(
    columns: impl Iterator<Item = &'static str>,
    base: &str,
    unit: &str,
) -> Result<Option<(&'static str, Option<Unit>)>, String> {
    let mut refused = None;
    for name in columns {
        let Some(column) = Column::named(name).filter(|column| column.base() == base || column.name == base) else {
            continue;
        };
        // A number without a unit may have an empty pair of brackets, or a dash.
        if column.unit == "1" && matches!(unit, "" | "-" | "–") {
            return Ok(Some((name, None)));
        }
        if let Some(unit) = unit_in(units_of(column.unit), unit) {
            if column.name == base && !unit.is_si() && column.unit != "1" {
                return Err(format!("{base}: the unit in brackets is not that in the name; correct one of them"));
            }
            return Ok(Some((name, (!unit.is_si()).then_some(unit))));
        }
        refused.get_or_insert_with(|| {
            let units: Vec<_> = units_of(column.unit).iter().map(|unit| unit.symbol).collect();
            let units = if units.is_empty() { "no unit".to_owned() } else { units.join(", ") };
            format!("{base}: the unit \"{unit}\" is refused; give one of {units}")
        });
    }
    refused.map_or(Ok(None), Err)
}

/// Whether cells are the units of the columns above them: no numbers, and a unit below a column that the command may read, or units
/// and empty cells alone. One of them may be a unit that the program does not know, which [`Heading::add_unit`] refuses.
pub(crate) fn is_unit_row(headings: &[Heading], cells: &[String], inputs: &[Input]) -> bool {
    let is_one_of_units = |cell: &String| is_unit(cell) && cell != "1";
    let is_number = |cell: &String| cell != "1" && cell.replace(',', ".").parse::<f64>().is_ok();
    let is_below_read = |index: usize| headings.get(index).is_some_and(|heading| heading.may_be_read(inputs));
    let mut units = cells.iter().enumerate().filter(|(_, cell)| is_one_of_units(cell)).peekable();
    let says_nothing = |cell: &String| matches!(cell.as_str(), "" | "-" | "–" | "1" | "[]" | "[-]");
    units.peek().is_some()
        && !cells.iter().any(is_number)
        && (units.any(|(index, _)| is_below_read(index))
            || cells
                .iter()
                .enumerate()
                .all(|(index, cell)| is_one_of_units(cell) || says_nothing(cell) || !is_below_read(index)))
}
