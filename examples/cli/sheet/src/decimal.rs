//! The decimal mark of a table: one for the whole file, judged from the cells that are read as numbers.

use std::borrow::Cow;

use clap::ValueEnum;

/// Rows from which the decimal mark of a table is judged.
pub const JUDGED_ROWS: usize = 1000;

/// The decimal mark of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Decimal {
    /// 2.5
    Point,
    /// 2,5
    Comma,
}

impl Decimal {
    fn of(mark: &str) -> Self {
        if mark == "," { Self::Comma } else { Self::Point }
    }

    fn in_words(self) -> &'static str {
        match self {
            Self::Point => "decimal point",
            Self::Comma => "decimal comma",
        }
    }
}

/// The only mark in a number.
struct Mark {
    decimal: Decimal,
    /// Whether it may separate thousands instead.
    ambiguous: bool,
}

impl Mark {
    /// The mark of a cell; `None` if the cell has none or several, or is no number.
    fn of(text: &str) -> Option<Self> {
        let mut marks = text.match_indices(['.', ',']);
        let (Some((at, mark)), None) = (marks.next(), marks.next()) else {
            return None;
        };
        text.replace(',', ".").parse::<f64>().ok()?;
        let (whole, fraction) = (text[..at].trim_start_matches(['+', '-']), &text[at + 1..]);
        let three_digits = fraction.len() == 3 && fraction.bytes().all(|digit| digit.is_ascii_digit());
        // Nobody writes 0.250 or 2600.125 with a thousands separator.
        let ambiguous = three_digits && matches!(whole.len(), 1..=3) && !whole.starts_with('0');
        Some(Self { decimal: Decimal::of(mark), ambiguous })
    }
}

/// A cell of a table.
#[derive(Clone, Copy)]
pub struct Cell<'a> {
    /// Number of its row; the row below the header is row 1.
    pub row: usize,
    pub column: &'a str,
    pub text: &'a str,
}

impl Cell<'_> {
    fn example(&self) -> String {
        format!("{} \"{}\" in row {}", self.column, self.text, self.row)
    }

    fn ambiguous(&self, why: &str) -> String {
        let Self { row, column, text } = self;
        format!("{column}: \"{text}\" is ambiguous in row {row}: its mark may be decimal or separate thousands; {why}")
    }
}

/// How the decimal mark of a table is known.
enum Origin {
    /// The user chose it.
    Chosen,
    /// All marks of the judged rows agree, as in this cell.
    Agreed(String),
    /// Most marks of the judged rows agree, as in this cell.
    Mixed(String),
    /// The judged rows do not say, but commas separate the cells, so that the decimal mark is the point.
    Separated,
    /// The judged rows have no marks.
    Unmarked,
}

/// The decimal mark of a table, and how it is known.
pub struct Convention {
    decimal: Decimal,
    origin: Origin,
}

impl Convention {
    /// The mark that the user chose.
    pub fn chosen(decimal: Decimal) -> Self {
        Self { decimal, origin: Origin::Chosen }
    }

    pub fn decimal(&self) -> Decimal {
        self.decimal
    }

    /// The text of a cell with a decimal point.
    ///
    /// # Errors
    /// The mark of the cell is not that of the table, or may separate thousands.
    pub fn with_point<'a>(&self, cell: &Cell<'a>) -> Result<Cow<'a, str>, String> {
        let settled = !matches!(self.origin, Origin::Mixed(_) | Origin::Unmarked);
        let has_comma = cell.text.as_bytes().contains(&b',');
        if self.decimal == Decimal::Point && settled && !has_comma {
            return Ok(Cow::Borrowed(cell.text));
        }
        let mark = Mark::of(cell.text);
        match mark {
            Some(mark) if mark.decimal != self.decimal => Err(self.contradiction(cell, &mark)),
            Some(mark) if mark.ambiguous && !settled => Err(cell.ambiguous(UNSETTLED)),
            Some(_) if self.decimal == Decimal::Comma => Ok(Cow::Owned(cell.text.replace(',', "."))),
            _ => Ok(Cow::Borrowed(cell.text)),
        }
    }

    fn contradiction(&self, cell: &Cell<'_>, mark: &Mark) -> String {
        let own = self.decimal.in_words();
        let origin = match &self.origin {
            Origin::Chosen => format!("--decimal chooses the {own}"),
            Origin::Agreed(example) | Origin::Mixed(example) => format!("the table has the {own}, as {example}"),
            Origin::Separated => format!("the {own} was assumed, as commas separate cells; --decimal can change it"),
            Origin::Unmarked => {
                format!("the {own} was assumed, as the first {JUDGED_ROWS} rows have no mark; --decimal can change it")
            }
        };
        if mark.ambiguous {
            return cell.ambiguous(&format!("{origin}; write the cell so, without thousands separators"));
        }
        let Cell { row, column, text } = cell;
        format!("{column}: \"{text}\" in row {row} has a {}, but {origin}; correct the cell", mark.decimal.in_words())
    }
}

/// What an ambiguous cell needs.
const UNSETTLED: &str = "no other cell settles it; give --decimal point or --decimal comma";

/// The marks of the first rows.
#[derive(Default)]
pub struct Judge {
    points: Votes,
    commas: Votes,
    ambiguous: Option<String>,
}

/// Cells with one mark: how many, and the first.
#[derive(Default)]
struct Votes {
    count: usize,
    first: Option<String>,
}

impl Judge {
    /// Counts the mark of a cell.
    pub fn add(&mut self, cell: &Cell<'_>) {
        let Some(mark) = Mark::of(cell.text) else {
            return;
        };
        if mark.ambiguous {
            self.ambiguous.get_or_insert_with(|| cell.ambiguous(UNSETTLED));
            return;
        }
        let votes = match mark.decimal {
            Decimal::Point => &mut self.points,
            Decimal::Comma => &mut self.commas,
        };
        votes.count += 1;
        votes.first.get_or_insert_with(|| cell.example());
    }

    /// The mark of most cells; the point where no cell has a mark. Whoever writes decimal commas separates cells otherwise.
    ///
    /// # Errors
    /// All marks may separate thousands, and commas do not separate the cells.
    pub fn convention(self, comma_separated: bool) -> Result<Convention, String> {
        let decimal = if self.commas.count > self.points.count { Decimal::Comma } else { Decimal::Point };
        let origin = match (self.points.first, self.commas.first) {
            (None, None) if comma_separated => Origin::Separated,
            (None, None) => match self.ambiguous {
                Some(complaint) => return Err(complaint),
                None => Origin::Unmarked,
            },
            (Some(example), None) | (None, Some(example)) => Origin::Agreed(example),
            (Some(point), Some(comma)) => Origin::Mixed(if decimal == Decimal::Comma { comma } else { point }),
        };
        Ok(Convention { decimal, origin })
    }
}
