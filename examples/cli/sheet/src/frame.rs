//! What all rows of a table share: its columns, its decimal mark, and its variant of CSV.

use csv::ByteRecord;
use rustc_hash::FxHashMap;

use crate::columns::{self, Header, Input};
use crate::decimal::{Cell, Convention};
use crate::dialect::Dialect;
use crate::empty::CellDefault;
use crate::header::Heading;
use crate::row::Row;

/// What all rows of a table share.
pub struct Frame {
    pub(crate) headings: Vec<Heading>,
    /// Names of the columns, for [`Header`].
    pub(crate) names: Vec<String>,
    places: FxHashMap<String, usize>,
    pub(crate) inputs: Vec<Input>,
    pub(crate) defaults: Vec<CellDefault>,
    pub(crate) convention: Convention,
    pub(crate) dialect: Dialect,
    pub(crate) byte_order_mark: bool,
    /// Which sheet of a workbook of several it is, in words.
    pub(crate) sheet: Option<String>,
}

impl Frame {
    pub(crate) fn new(
        headings: Vec<Heading>,
        inputs: &[Input],
        convention: Convention,
        dialect: Dialect,
        byte_order_mark: bool,
    ) -> Self {
        let names: Vec<_> = headings.iter().map(|heading| heading.name.clone()).collect();
        let places = names.iter().cloned().enumerate().map(|(index, name)| (name, index)).collect();
        let inputs = inputs.to_vec();
        let mut frame = Self {
            headings,
            names,
            places,
            inputs,
            defaults: Vec::new(),
            convention,
            dialect,
            byte_order_mark,
            sheet: None,
        };
        frame.defaults = CellDefault::all(&frame, &frame.inputs);
        frame
    }

    /// The place of a column.
    pub(crate) fn place(&self, column: &str) -> Option<usize> {
        self.places.get(column).copied()
    }

    /// The names of the columns.
    #[must_use]
    pub fn header(&self) -> Header<'_> {
        Header { names: &self.names, places: Some(&self.places) }
    }

    /// A row of this table, whose number is that of the first row below the header counted as 1.
    #[must_use]
    pub fn row<'a>(&'a self, cells: &'a ByteRecord, number: usize) -> Row<'a> {
        Row { frame: self, cells, number, replaced: Vec::new() }
    }

    /// Which columns are used, which are absent and what is used instead, and which are not read, in one to three lines;
    /// before them which sheet of a workbook is read, if it has several, and how many titles stand above the header.
    /// `computed` are the names of columns that will be added.
    #[must_use]
    pub fn columns_in_words(&self, computed: &[String]) -> String {
        let sheet = self.sheet.as_ref().map_or_else(String::new, |sheet| format!("{sheet}\n  "));
        let titles = match self.dialect.titles {
            0 => String::new(),
            1 => "a line above the header is not read\n  ".to_owned(),
            titles => format!("{titles} lines above the header are not read\n  "),
        };
        sheet + &titles + &columns::in_words(&self.headings, &self.inputs, computed)
    }

    /// A cell, for a message about its decimal mark.
    pub(crate) fn cell<'a>(&'a self, index: usize, row: usize, text: &'a str) -> Cell<'a> {
        let column = self.headings.get(index).map_or("", |heading| heading.text.as_str());
        Cell { row, column, text }
    }
}
