//! The figures of a run, and those of an earlier one to compare with.

use std::collections::HashMap;
use std::error::Error;
use std::fmt::{self, Display};
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::BOARDS;
use super::firmware::repository;

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// A classification.
    Classify,
    /// A classification and the validation of the measured motion before it.
    SetUpAndClassify,
    /// A calibration.
    Calibrate,
    /// The deepest stack of a classification or a calibration.
    Stack,
    /// Code and constants that a scene adds to a firmware which does nothing else.
    Flash,
    /// Code and constants that set-up, validation and classification refer to, in a firmware with other scenes.
    Code,
    /// Memory taken for as long as the firmware runs.
    StaticMemory,
    /// Bytes that differ from a build in which the terms that a scene does not use do not exist.
    AbsentTerms,
    /// The largest error of the restitution, or relative error of the margins where there is none.
    Error,
}

impl Quantity {
    const ALL: [Self; 9] = [
        Self::Classify,
        Self::SetUpAndClassify,
        Self::Calibrate,
        Self::Stack,
        Self::Flash,
        Self::Code,
        Self::StaticMemory,
        Self::AbsentTerms,
        Self::Error,
    ];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Classify => "classify",
            Self::SetUpAndClassify => "set up and classify",
            Self::Calibrate => "calibrate",
            Self::Stack => "stack",
            Self::Flash => "flash",
            Self::Code => "code and constants",
            Self::StaticMemory => "static memory",
            Self::AbsentTerms => "absent terms",
            Self::Error => "error",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Classify | Self::SetUpAndClassify | Self::Calibrate => "instructions",
            Self::Stack | Self::Flash | Self::Code | Self::StaticMemory | Self::AbsentTerms => "bytes",
            Self::Error => "1",
        }
    }

    /// A value with as many digits as it has, or few where it is no whole number.
    pub fn digits(self, value: f64) -> String {
        match self {
            Self::Error => format!("{value:.1e}"),
            _ => value.to_string(),
        }
    }

    /// What it may grow by in any case: below that the layout of unrelated code counts, or the last bits of a root.
    fn tolerated(self) -> f64 {
        match self {
            Self::Error => 1e-12,
            _ => 2.0,
        }
    }
}

/// What a figure belongs to; `impact` is empty where it belongs to a whole scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Subject {
    /// The processor core.
    pub core: String,
    /// What is classified.
    pub scene: String,
    /// The number type.
    pub scalar: String,
    /// The impact, where the figure belongs to one.
    pub impact: String,
    /// What is measured.
    pub quantity: Quantity,
}

impl Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { core, scene, scalar, impact, quantity } = self;
        write!(f, "{core}, {scene}, {scalar}")?;
        if !impact.is_empty() {
            write!(f, ", {impact}")?;
        }
        write!(f, ": {}", quantity.name())
    }
}

/// One measured number.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What the number belongs to.
    pub subject: Subject,
    /// In the unit of its quantity.
    pub value: f64,
}

/// The first columns of a table: what the figures of a row belong to.
const NAMES: [&str; 4] = ["compiler", "core", "scene", "scalar"];

/// The name of the column of a quantity, of one impact or of the whole scene: `classify: straight (instructions)`.
fn column_name(quantity: Quantity, impact: &str) -> String {
    let separator = if impact.is_empty() { "" } else { ": " };
    format!("{}{separator}{impact} ({})", quantity.name(), quantity.unit())
}

/// What a column of that name holds.
fn column(name: &str) -> Option<(Quantity, &str)> {
    Quantity::ALL.into_iter().find_map(|quantity| {
        let rest = name.strip_prefix(quantity.name())?.strip_suffix(&*format!(" ({})", quantity.unit()))?;
        if rest.is_empty() { Some((quantity, "")) } else { Some((quantity, rest.strip_prefix(": ")?)) }
    })
}

/// Writes figures as a CSV table: a row for each compiler, core, scene and number type, a column for each quantity and impact.
/// A cell is empty where nothing is measured.
pub fn write(figures: &[(&str, &Figure)], destination: impl io::Write) -> Result<(), csv::Error> {
    let (mut rows, mut columns, mut cells) = (Vec::new(), Vec::new(), HashMap::new());
    for (compiler, Figure { subject, value }) in figures {
        let row = [compiler, &*subject.core, &*subject.scene, &*subject.scalar];
        let column = (subject.quantity, &*subject.impact);
        if !rows.contains(&row) {
            rows.push(row);
        }
        if !columns.contains(&column) {
            columns.push(column);
        }
        cells.insert((row, column), value.to_string());
    }
    columns.sort_by_key(|(quantity, _)| *quantity);
    let mut writer = csv::Writer::from_writer(destination);
    let names = columns.iter().map(|(quantity, impact)| column_name(*quantity, impact));
    writer.write_record(NAMES.into_iter().map(str::to_owned).chain(names))?;
    for row in rows {
        let values = columns.iter().map(|column| cells.get(&(row, *column)).map_or("", String::as_str));
        writer.write_record(row.into_iter().chain(values))?;
    }
    writer.flush()?;
    Ok(())
}

/// Reads such a table.
fn read(path: &Path) -> Result<Vec<(String, Figure)>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(path)?;
    let header = reader.headers()?.clone();
    if !header.iter().take(NAMES.len()).eq(NAMES) {
        return Err(format!("the first columns are not {}", NAMES.join(", ")).into());
    }
    let names = header.iter().skip(NAMES.len());
    let columns = names.map(|name| {
        column(name).ok_or_else(|| {
            format!(
                "the column `{name}` is unknown; names are like `stack (bytes)` or `classify: straight (instructions)`"
            )
        })
    });
    let columns = columns.collect::<Result<Vec<_>, _>>()?;
    let mut figures = Vec::new();
    for record in reader.records() {
        let record = record?;
        for ((quantity, impact), cell) in columns.iter().zip(record.iter().skip(NAMES.len())) {
            if cell.is_empty() {
                continue;
            }
            let [core, scene, scalar, impact] = [&record[1], &record[2], &record[3], impact].map(str::to_owned);
            let subject = Subject { core, scene, scalar, impact, quantity: *quantity };
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => figures.push((record[0].to_owned(), Figure { subject, value })),
                _ => return Err(format!("{subject} = `{cell}` is not a finite number").into()),
            }
        }
    }
    Ok(figures)
}

/// The largest figure of a scene, over all its impacts.
pub fn largest<'a>(
    figures: impl IntoIterator<Item = &'a Figure>,
    core: &str,
    scene: &str,
    scalar: &str,
    quantity: Quantity,
) -> Option<f64> {
    let is_of_scene = |subject: &Subject| {
        (&*subject.core, &*subject.scene, &*subject.scalar, subject.quantity) == (core, scene, scalar, quantity)
    };
    let own = figures.into_iter().filter(|figure| is_of_scene(&figure.subject));
    own.map(|figure| figure.value).reduce(f64::max)
}

/// The figures that are kept in the repository, each with the compiler that led to it.
pub struct Stored {
    /// In the order of the compilers' names.
    rows: Vec<(String, Figure)>,
}

impl Stored {
    /// The folder in the repository, with a file for each core.
    pub fn path() -> PathBuf {
        repository().join("host-tests/data/footprint")
    }

    /// The figures in a folder; none of a core where it has no file.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let mut rows = Vec::new();
        for path in BOARDS.map(|board| file(folder, board.core)).iter().filter(|path| path.exists()) {
            rows.extend(read(path).map_err(|error| {
                let path = path.display();
                format!("{path}: {error}; correct the file, or delete it and run `cargo qemu --overwrite`")
            })?);
        }
        rows.sort_by(|(one, _), (other, _)| one.cmp(other));
        Ok(Self { rows })
    }

    /// What is worse than stored, for the same compiler.
    pub fn compare(&self, compiler: &str, figures: &[Figure]) -> Comparison {
        let own: Vec<&Figure> = self.rows_of(compiler).collect();
        let mut comparison = Comparison { stored: own.len(), unknown: 0, worse: Vec::new() };
        for Figure { subject, value } in figures {
            let Some(before) = own.iter().find(|old| old.subject == *subject).map(|old| old.value) else {
                comparison.unknown += 1;
                continue;
            };
            if is_worse(subject.quantity, before, *value) {
                let unit = subject.quantity.unit();
                comparison.worse.push(format!(
                    "{subject} = {value} {unit}, which is more than 5 % above the stored {before} {unit}; reduce it, or                      store the new figures with `cargo qemu --overwrite`"
                ));
            }
        }
        comparison
    }

    /// Replaces the figures of one compiler and keeps those of all others.
    pub fn overwrite(&self, compiler: &str, figures: &[Figure], folder: &Path) -> Result<(), String> {
        let others = self.rows.iter().filter(|(by, _)| by != compiler);
        let mut rows: Vec<(&str, &Figure)> = others.map(|(by, figure)| (&**by, figure)).collect();
        rows.extend(figures.iter().map(|figure| (compiler, figure)));
        rows.sort_by_key(|(by, _)| *by);
        for core in BOARDS.map(|board| board.core) {
            let path = file(folder, core);
            let rows: Vec<_> = rows.iter().copied().filter(|(_, figure)| figure.subject.core == core).collect();
            let created = fs::create_dir_all(folder).and_then(|()| fs::File::create(&path));
            let written = created.map_err(csv::Error::from).and_then(|file| write(&rows, file));
            written.map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        }
        Ok(())
    }

    /// The compilers that have figures.
    pub fn compilers(&self) -> Vec<&str> {
        let mut compilers: Vec<&str> = self.rows.iter().map(|(by, _)| &**by).collect();
        compilers.dedup();
        compilers
    }

    /// The figures of all compilers.
    pub fn all(&self) -> impl Iterator<Item = &Figure> {
        self.rows.iter().map(|(_, figure)| figure)
    }

    /// The figures of one compiler.
    pub fn rows_of(&self, compiler: &str) -> impl Iterator<Item = &Figure> {
        let own = self.rows.iter().filter(move |(by, _)| by == compiler);
        own.map(|(_, figure)| figure)
    }
}

/// The file with the figures of a core.
fn file(folder: &Path, core: &str) -> PathBuf {
    folder.join(format!("{}.csv", core.to_lowercase()))
}

/// How a run compares with the stored figures of the same compiler.
pub struct Comparison {
    /// Stored figures of this compiler.
    pub stored: usize,
    /// Figures of the run that are not stored.
    pub unknown: usize,
    /// What is worse than it was.
    pub worse: Vec<String>,
}

/// Part of a stored figure by which another may exceed it.
pub const LARGEST_EXCESS: f64 = 0.05;

/// More than that part, and more than is tolerated in any case.
fn is_worse(quantity: Quantity, before: f64, now: f64) -> bool {
    let more = now - before;
    more > quantity.tolerated() && more > LARGEST_EXCESS * before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_figures_are_written_as_they_were_read_and_compared() {
        let stored = Stored::read(&Stored::path()).unwrap();
        let compiler = stored.compilers()[0];
        let figures: Vec<Figure> = stored.rows_of(compiler).cloned().collect();
        let folder = std::env::temp_dir().join(format!("microimpact-footprint-{}", std::process::id()));
        stored.overwrite(compiler, &figures, &folder).unwrap();
        for core in BOARDS.map(|board| board.core) {
            let [before, after] = [&Stored::path(), &folder].map(|folder| fs::read(file(folder, core)).unwrap());
            assert!(before == after, "{core}");
        }
        fs::remove_dir_all(&folder).unwrap();

        let worse = |factor: f64, added: f64| {
            let grown = |old: &Figure| Figure { value: old.value * factor + added, ..old.clone() };
            stored.compare(compiler, &figures.iter().map(grown).collect::<Vec<_>>()).worse.len()
        };
        assert_eq!((worse(1.06, 3.0), worse(1.04, 0.0)), (figures.len(), 0));
        assert_eq!(stored.compare("another", &figures).unknown, figures.len());
    }
}
