//! Which columns of a table a command reads.

use std::fmt::Write;
use std::slice::from_ref;

use csv::ByteRecord;
use rustc_hash::FxHashMap;

use crate::catalogue::Column;
use crate::header::Heading;

/// The column that names a row. It is a label, and never read as a number.
pub const LABEL: &str = "name";

/// A number or a word that a command reads from each row, and the columns that can give it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Input {
    columns: &'static [&'static str],
    /// What the command uses where no column gives it; `None` if it is required.
    default: Option<&'static str>,
    /// What the command uses for each component that is absent from a vector, if the columns are those of a vector.
    pub(crate) component: Option<&'static str>,
    /// Columns of which a table must have one, if any are named here, and columns of which it must have none: else nothing is
    /// said where this input is absent.
    pub(crate) with: &'static [&'static str],
    pub(crate) without: &'static [&'static str],
    /// A column that this input replaces in a row that gives both, and what to say then.
    pub(crate) replaces: Option<(&'static str, &'static str)>,
}

impl Input {
    /// What one of these columns must give.
    pub const fn required(columns: &'static [&'static str]) -> Self {
        Self { columns, default: None, component: None, with: &[], without: &[], replaces: None }
    }

    /// What has a default, which is given in words, and with its unit if it is a number.
    pub const fn optional(columns: &'static [&'static str], default: &'static str) -> Self {
        Self { default: Some(default), ..Self::required(columns) }
    }

    /// What only some tables have: nothing is said where it is absent.
    pub const fn further(columns: &'static [&'static str]) -> Self {
        Self::optional(columns, "")
    }

    /// A vector: what is used for all of it where it is absent, and for each component that is absent where others are not.
    pub const fn vector(columns: &'static [&'static str], default: &'static str, component: &'static str) -> Self {
        Self { component: Some(component), ..Self::optional(columns, default) }
    }

    /// The same input, whose default is said only of tables with one of these columns.
    pub const fn with(self, columns: &'static [&'static str]) -> Self {
        Self { with: columns, ..self }
    }

    /// The same input, whose default is said only of tables with none of these columns.
    pub const fn without(self, columns: &'static [&'static str]) -> Self {
        Self { without: columns, ..self }
    }

    /// The same input, which replaces that of another column; the words say so of a table with both.
    pub const fn replacing(self, column: &'static str, words: &'static str) -> Self {
        Self { replaces: Some((column, words)), ..self }
    }

    /// The columns that can give it.
    #[must_use]
    pub fn columns(&self) -> &'static [&'static str] {
        self.columns
    }

    /// What is used where no column gives it, in words; `None` if it is required, empty if nothing is.
    #[must_use]
    pub fn default(&self) -> Option<&'static str> {
        self.default
    }

    /// Whether a table needs it only beside certain other columns.
    #[must_use]
    pub fn is_conditional(&self) -> bool {
        !self.with.is_empty()
    }

    fn is_in(&self, header: &[&str]) -> bool {
        has_one(header, self.columns)
    }

    fn in_words(&self) -> String {
        self.columns.join(" or ")
    }

    /// The columns that are absent, with what is used in their place; `None` if there are none, or nothing is said of them.
    fn absent(&self, header: &[&str]) -> Option<String> {
        if self.is_in(header) {
            let component = self.component?;
            let absent = self.columns.iter().filter(|column| !has_one(header, &[column]));
            let absent: Vec<_> = absent.map(|column| format!("{column} ({component})")).collect();
            return (!absent.is_empty()).then(|| absent.join(", "));
        }
        let default = self.default.filter(|default| !default.is_empty())?;
        let said = (self.with.is_empty() || has_one(header, self.with)) && !has_one(header, self.without);
        let columns = if self.component.is_some() { self.columns.join(", ") } else { self.in_words() };
        said.then(|| format!("{columns} ({default})"))
    }
}

/// Whether a header has one of some columns.
fn has_one(header: &[&str], columns: &[&str]) -> bool {
    columns.iter().any(|column| header.contains(column))
}

/// The names of the columns of a table.
#[derive(Clone, Copy)]
pub struct Header<'a> {
    pub(crate) names: &'a [String],
    /// The place of each name, of a table that is read.
    pub(crate) places: Option<&'a FxHashMap<String, usize>>,
}

impl<'a> Header<'a> {
    /// A header of these columns.
    #[must_use]
    pub fn of(names: &'a [String]) -> Self {
        Self { names, places: None }
    }

    /// The names in their order.
    pub fn names(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        self.names.iter().map(String::as_str)
    }

    /// Whether the table has a column.
    pub fn has(&self, column: &str) -> bool {
        match self.places {
            Some(places) => places.contains_key(column),
            None => self.names.iter().any(|name| name == column),
        }
    }
}

/// Similarity of Jaro and Winkler above which two names are near: it finds a missing unit (`density` for `density_kg_m3`) and
/// misspelt words, and keeps quantities apart that begin alike (`impulse_ratio` and `impulse_hertz_n_s`).
const NEAR: f64 = 0.875;

/// Symbols of the paper, in lower case, and other common names of a quantity, with the columns that may be meant by them.
const SYMBOLS: [(&str, &[&str]); 19] = [
    ("contact_law", &["law"]),
    ("d", &["diameter_m"]),
    ("f", &["friction"]),
    ("f0", &["adhesion_n_m"]),
    ("g", &["work_of_adhesion_j_m2"]),
    ("k", &["stiffness_pa", "restitution_speed_m_s"]),
    ("kappa", &["gyration_ratio"]),
    ("lambda", &["peeling_n_m"]),
    ("mu", &["impulse_ratio"]),
    ("omega", &["spin_rad_s"]),
    ("r", &["radius_m", "restitution"]),
    ("rho", &["adhesion_coefficient", "density_kg_m3"]),
    ("v_n", &["speed_normal_m_s"]),
    ("v_t", &["speed_tangential_m_s"]),
    ("velocity_normal", &["speed_normal_m_s"]),
    ("velocity_tangential", &["speed_tangential_m_s"]),
    ("w_a", &["work_of_adhesion_j"]),
    ("zetaa", &["zeta_a"]),
    ("zetah", &["zeta_h"]),
];

/// Whether a name is a symbol of a column, alone or with the unit of the column: `lambda` or `lambda_n_m`.
fn is_symbol(name: &str, column: &str) -> bool {
    SYMBOLS.iter().filter(|(_, columns)| columns.contains(&column)).any(|(symbol, _)| {
        name.strip_prefix(symbol)
            .is_some_and(|unit| unit.is_empty() || (unit.starts_with('_') && column.ends_with(unit)))
    })
}

/// Least length of a word that says which quantity is meant; shorter ones are units and indices.
const WORD: usize = 4;

/// Whether all words of a name are words of a column, as those of `force_n` are of `external_force_n`.
fn has_words_of(column: &str, name: &str) -> bool {
    name.split('_').any(|word| word.len() >= WORD)
        && name.split('_').all(|word| column.split('_').any(|other| other == word))
}

/// Whether a name is that of a column up to its unit, and none of another column.
fn has_another_unit(column: &str, name: &str) -> bool {
    let with_unit = Column::named(column).filter(|column| !matches!(column.unit, "" | "1"));
    let end = with_unit.and_then(|column| name.strip_prefix(column.base())?.strip_prefix('_'));
    end.is_some_and(|end| !end.is_empty()) && Column::named(name).is_none()
}

/// Columns of different quantities whose names are alike, so that neither is a misspelling of the other.
const ALIKE: [&str; 5] =
    ["work_of_adhesion_j", "work_of_adhesion_j_m2", "adhesion_n_m", "adhesion_speed_m_s", "adhesion_power"];

/// Whether a name is that of a standard error, which no other quantity is taken for.
fn is_error(name: &str) -> bool {
    name.split('_').any(|word| strsim::jaro_winkler(word, "error") > NEAR)
}

/// How likely it is that a column is meant by a name, larger for a better guess; `None` if it is unlikely.
fn likeness(name: &str, column: &str) -> Option<f64> {
    if ALIKE.contains(&name) && ALIKE.contains(&column) || is_error(name) != is_error(column) {
        return None;
    }
    let similarity = strsim::jaro_winkler(name, column);
    if is_symbol(name, column) {
        // The columns of a symbol are alike, so that the first of them is chosen.
        return Some(2.0);
    }
    // Words that agree are a better guess than a similar beginning.
    if has_words_of(column, name) || has_another_unit(column, name) {
        return Some(1.0 + similarity);
    }
    (similarity > NEAR).then_some(similarity)
}

/// The likeliest of some names or columns, each with the text by which it is compared.
fn likeliest<'a>(
    others: impl Iterator<Item = (&'a str, &'a str)>,
    likeness: impl Fn(&'a str) -> Option<f64>,
) -> Option<&'a str> {
    let likely = others.filter_map(|(other, compared)| Some((likeness(compared)?, other)));
    likely.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, other)| other)
}

/// Checks that a header has all required columns, and none twice.
///
/// # Errors
/// Those that are absent, each with the likeliest name in the header, and the header.
pub(crate) fn check(headings: &[Heading], inputs: &[Input]) -> Result<(), String> {
    let header = names(headings);
    if header.iter().all(|name| name.is_empty()) {
        return Err("the table is empty; its first row must name the columns".into());
    }
    for (index, heading) in headings.iter().enumerate().filter(|(_, heading)| !heading.name.is_empty()) {
        if let Some(other) = headings[..index].iter().find(|other| other.name == heading.name) {
            let units =
                if other.text == heading.text { "" } else { &format!(", as {} and {}", other.text, heading.text) };
            return Err(format!("the header names the column {} twice{units}; rename or remove one", heading.name));
        }
    }
    let unread = || headings.iter().filter(|heading| heading.name != LABEL && !is_read(&heading.name, inputs));
    let absent = inputs.iter().filter(|input| input.default.is_none() && !input.is_in(&header)).map(|input| {
        let near = input.columns.iter().find_map(|column| {
            likeliest(unread().map(|heading| (heading.text.as_str(), heading.given.as_str())), |name| {
                likeness(name, column)
            })
        });
        let near = near.map_or_else(String::new, |near| format!(" (did you mean it by `{}`?)", near.to_lowercase()));
        format!("{}{near}", input.in_words())
    });
    let absent: Vec<_> = absent.collect();
    if absent.is_empty() {
        return Ok(());
    }
    let written: Vec<_> = headings.iter().map(|heading| heading.text.as_str()).collect();
    Err(format!("the table lacks required columns: {}; the header is: {}", absent.join(", "), written.join(", ")))
}

/// How many inputs some cells name, with or without a unit, which a row below them may give; and whether they name all that are
/// required.
pub(crate) fn named(cells: &ByteRecord, inputs: &[Input]) -> (usize, bool) {
    let headings = cells.iter().map(|cell| Heading::of(&String::from_utf8_lossy(cell), inputs));
    // A unit that is refused is an error of the header.
    let Ok(headings) = headings.collect::<Result<Vec<_>, _>>() else { return (inputs.len(), true) };
    let is_named = |input: &&Input| headings.iter().any(|heading| heading.may_be_read(from_ref(input)));
    let are_all = inputs.iter().filter(|input| input.default.is_none()).all(|input| is_named(&input));
    (inputs.iter().filter(is_named).count(), are_all)
}

/// The names of columns.
fn names(headings: &[Heading]) -> Vec<&str> {
    headings.iter().map(|heading| heading.name.as_str()).collect()
}

fn is_read(name: &str, inputs: &[Input]) -> bool {
    inputs.iter().any(|input| input.columns.contains(&name))
}

/// Which columns are used, which are absent and what is used instead, and which are not read. `computed` are names that a
/// command gives to its own columns, which nobody writes by mistake for another.
pub(crate) fn in_words(headings: &[Heading], inputs: &[Input], computed: &[String]) -> String {
    let header = names(headings);
    let used = headings.iter().filter(|heading| is_read(&heading.name, inputs)).map(|heading| {
        let input = inputs.iter().find(|input| has_one(&[&heading.name], input.columns));
        match input.and_then(|input| input.replaces).filter(|(replaced, _)| has_one(&header, &[replaced])) {
            Some((_, words)) => format!("{} ({words})", heading.in_words()),
            None => heading.in_words(),
        }
    });
    let defaulted = inputs.iter().filter_map(|input| input.absent(&header));
    let absent = || {
        let columns = inputs.iter().flat_map(|input| input.columns).copied();
        columns.filter(|column| !header.contains(column)).map(|column| (column, column))
    };
    let unread =
        |heading: &&Heading| !heading.name.is_empty() && heading.name != LABEL && !is_read(&heading.name, inputs);
    let unread = headings.iter().filter(unread).map(|heading| {
        match likeliest(absent(), |column| likeness(&heading.given, column)) {
            Some(near) if !computed.contains(&heading.name) => format!("{} (did you mean `{near}`?)", heading.name),
            _ => heading.name.clone(),
        }
    });
    let mut words = format!("columns used: {}\n", used.collect::<Vec<_>>().join(", "));
    for (title, names) in
        [("columns absent, and what is used", defaulted.collect::<Vec<_>>()), ("columns not read", unread.collect())]
    {
        if !names.is_empty() {
            // A string takes any text.
            let _ = writeln!(words, "  {title}: {}", names.join(", "));
        }
    }
    words
}
