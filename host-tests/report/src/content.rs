//! What a report consists of: sections of text, tables, figures and folded parts. Each table and figure has a CSV file beside
//! it.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};

/// A part of the report under a heading of its own.
#[derive(Default)]
pub(crate) struct Section {
    /// Heading.
    pub(crate) title: &'static str,
    /// Name in links and file names: lower case, joined by hyphens.
    pub(crate) name: &'static str,
    /// What the first screen shows of it; its caption is one sentence.
    pub(crate) lead: Option<Figure>,
    /// What this run leaves out, as the end of a sentence.
    pub(crate) left_out: Option<String>,
    pub(crate) parts: Vec<Part>,
}

/// One block of a section, from top to bottom.
pub(crate) enum Part {
    /// A paragraph, without markup but for code between backticks.
    Text(String),
    Table(Table),
    Figure(Figure),
    /// Parts that are shown on demand, under this line.
    Fold(String, Vec<Part>),
}

impl Section {
    /// All tables, those of figures and of folded parts included.
    pub(crate) fn tables(&self) -> Vec<&Table> {
        self.lead.iter().map(|figure| &figure.data).chain(tables(&self.parts)).collect()
    }
}

fn tables<'a>(parts: &'a [Part]) -> Vec<&'a Table> {
    let of = |part: &'a Part| match part {
        Part::Text(_) => Vec::new(),
        Part::Table(table) | Part::Figure(Figure { data: table, .. }) => vec![table],
        Part::Fold(_, parts) => tables(parts),
    };
    parts.iter().flat_map(of).collect()
}

/// Cells under columns; also the data of a figure.
pub(crate) struct Table {
    /// Of its CSV file, without the extension; unique in the report.
    pub(crate) name: String,
    pub(crate) caption: String,
    /// With units, as in `indentation, m`.
    pub(crate) columns: Vec<String>,
    pub(crate) rows: Vec<Vec<Cell>>,
}

/// A value with as many digits as it has; the page shows few, the CSV file all of them.
pub(crate) enum Cell {
    Text(String),
    /// A text, and the address that it leads to.
    Link(&'static str, &'static str),
    /// Empty where there is no number.
    Number(Option<f64>),
    Count(u64),
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(Some(number))
    }
}

impl From<Option<f64>> for Cell {
    fn from(number: Option<f64>) -> Self {
        Self::Number(number)
    }
}

/// A drawing and what it shows.
pub(crate) struct Figure {
    pub(crate) title: String,
    /// A whole `<svg>` element, as a backend of `plotters` writes it.
    pub(crate) drawing: String,
    pub(crate) data: Table,
}

/// How much a run does, and where it shows its progress.
pub(crate) struct Run {
    /// Whether it ends within a minute rather than a quarter of an hour.
    pub(crate) quick: bool,
}

impl Run {
    /// A bar on the terminal for so many steps, or the time that a single one takes; it ends when it is dropped. Where there
    /// is no terminal, nothing.
    pub(crate) fn progress(&self, steps: usize, message: &str) -> ProgressBar {
        let bar = ProgressBar::new(steps as u64).with_finish(ProgressFinish::AndClear).with_message(message.to_owned());
        // The template is right or wrong whatever the run; without it there is a plain bar.
        let template = match steps {
            1 => "  {msg} {spinner} {elapsed}",
            _ => "  {msg} [{wide_bar}] {pos}/{len}, {elapsed}, {eta} left",
        };
        let bar = match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        };
        // The time goes on where a step takes long.
        bar.enable_steady_tick(Duration::from_millis(500));
        bar
    }
}
