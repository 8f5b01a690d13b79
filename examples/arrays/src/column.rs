//! Numbers of rows.

/// One number for all rows, or a number for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column<'a> {
    /// The same number in all rows.
    All(f64),
    /// A number for each row.
    Each(&'a [f64]),
}

impl Column<'_> {
    /// The number of a row. A row beyond the end of the column has NaN, which every model refuses.
    #[inline]
    #[must_use]
    pub fn at(&self, row: usize) -> f64 {
        match self {
            Self::All(value) => *value,
            Self::Each(values) => values.get(row).copied().unwrap_or(f64::NAN),
        }
    }

    /// The vector of a row.
    pub(crate) fn vector(columns: &[Self; 3], row: usize) -> [f64; 3] {
        columns.each_ref().map(|column| column.at(row))
    }
}

impl From<f64> for Column<'_> {
    fn from(value: f64) -> Self {
        Self::All(value)
    }
}
