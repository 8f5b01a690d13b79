//! Empty cells of columns that a table has, and what is used in their place.

use csv::ByteRecord;

use crate::columns::Input;
use crate::frame::Frame;
use crate::row::{Row, text};

/// What a command uses in rows that leave some cells empty.
pub(crate) struct CellDefault {
    /// The columns, as the header names them.
    names: String,
    /// What is used, in words.
    used: &'static str,
    /// Places of the cells that are all empty.
    empty: Vec<usize>,
    /// Places of cells of which one is filled: those of `empty` are then components of the same vector.
    components: Vec<usize>,
    /// Places of cells of which one is filled, if the command reads the input only beside others, and whether it does.
    with: Option<Vec<usize>>,
    /// Places of cells that are all empty, because the command reads them instead.
    without: Vec<usize>,
}

impl CellDefault {
    /// What a table with these columns may leave to defaults: inputs of several columns only where a row fills none of them.
    pub(crate) fn all(frame: &Frame, inputs: &[Input]) -> Vec<Self> {
        let places = |columns: &[&str]| -> Vec<usize> { columns.iter().filter_map(|name| frame.place(name)).collect() };
        let name = |place: &usize| frame.headings.get(*place).map_or("", |heading| heading.name_in_messages());
        let mut defaults = Vec::new();
        for input in inputs {
            let empty = places(input.columns());
            let replacing = |other: &&Input| other.replaces.is_some_and(|(name, _)| input.columns().contains(&name));
            let replacing = inputs.iter().filter(replacing).flat_map(|other| places(other.columns()));
            let without: Vec<_> = places(input.without).into_iter().chain(replacing).collect();
            let with = (!input.with.is_empty()).then(|| places(input.with));
            let of = |empty: Vec<usize>, components: Vec<usize>, used| Self {
                names: empty.iter().map(name).collect::<Vec<_>>().join(", "),
                used,
                empty,
                components,
                with: with.clone(),
                without: without.clone(),
            };
            if let Some(component) = input.component {
                for place in &empty {
                    let others: Vec<_> = empty.iter().copied().filter(|other| other != place).collect();
                    defaults.extend((!others.is_empty()).then(|| of(vec![*place], others, component)));
                }
            }
            if let Some(used) = input.default().filter(|used| !used.is_empty() && !empty.is_empty()) {
                defaults.push(of(empty, Vec::new(), used));
            }
        }
        defaults
    }

    /// Whether a row leaves the cells empty, and the command uses the default.
    fn applies(&self, cells: &ByteRecord) -> bool {
        let some = |places: &[usize]| places.iter().any(|place| is_filled(cells, *place));
        !some(&self.empty)
            && (self.components.is_empty() || some(&self.components))
            && self.with.as_ref().is_none_or(|with| some(with))
            && !some(&self.without)
    }
}

/// Whether a cell has a text.
fn is_filled(cells: &ByteRecord, place: usize) -> bool {
    match cells.get(place).unwrap_or_default().trim_ascii() {
        [] => false,
        [first, ..] => first.is_ascii() || !text(cells, place).is_empty(),
    }
}

/// How many rows of a table, or of a part of it, leave cells empty in whose place a default is used.
#[derive(Clone, Debug, Default)]
pub struct EmptyCells {
    rows: usize,
    /// For each default of the table.
    counts: Vec<usize>,
}

impl EmptyCells {
    /// Counts the empty cells of a row.
    pub fn count(&mut self, row: &Row<'_>) {
        let defaults = &row.frame.defaults;
        self.rows += 1;
        self.counts.resize(defaults.len(), 0);
        for (count, default) in self.counts.iter_mut().zip(defaults) {
            *count += usize::from(default.applies(row.cells));
        }
    }

    /// Adds those of another part of the same table.
    pub fn add(&mut self, other: &Self) {
        self.rows += other.rows;
        self.counts.resize(self.counts.len().max(other.counts.len()), 0);
        for (count, others) in self.counts.iter_mut().zip(&other.counts) {
            *count += others;
        }
    }

    /// For each column with empty cells, in how many rows they are empty and what is used, in one line; `None` if there are none.
    #[must_use]
    pub fn in_words(&self, frame: &Frame) -> Option<String> {
        let counts = self.counts.iter().zip(&frame.defaults).filter(|(count, _)| **count > 0);
        let columns = counts
            .map(|(count, default)| format!("{} in {count} of {} rows ({})", default.names, self.rows, default.used));
        let columns: Vec<_> = columns.collect();
        (!columns.is_empty()).then(|| format!("empty cells, and what is used: {}", columns.join(", ")))
    }
}
