//! The figures of a run, and those of an earlier one to compare with.

use std::fmt::{self, Display};
use std::io;
use std::path::{Path, PathBuf};

use super::firmware::repository;

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

const COLUMNS: [&str; 8] = ["compiler", "core", "scene", "scalar", "impact", "quantity", "value", "unit"];

/// Writes figures as CSV, with their column names.
pub fn write(rows: &[(&str, &Figure)], destination: impl io::Write) -> Result<(), csv::Error> {
    let mut writer = csv::Writer::from_writer(destination);
    writer.write_record(COLUMNS)?;
    for (compiler, Figure { subject, value }) in rows {
        writer.write_record([
            compiler,
            &*subject.core,
            &*subject.scene,
            &*subject.scalar,
            &*subject.impact,
            subject.quantity.name(),
            &value.to_string(),
            subject.quantity.unit(),
        ])?;
    }
    writer.flush()?;
    Ok(())
}

/// The figures that are kept in the repository, each with the compiler that led to it.
pub struct Stored {
    rows: Vec<(String, Figure)>,
}

impl Stored {
    /// The file in the repository.
    pub fn path() -> PathBuf {
        repository().join("host-tests/data/footprint.csv")
    }

    /// The figures in a file; none where there is no file.
    pub fn read(path: &Path) -> Result<Self, String> {
        if !path.exists() {
            return Ok(Self { rows: Vec::new() });
        }
        let wrong = |error: &dyn Display| {
            format!("{}: {error}; correct it, or delete it and run `cargo qemu --overwrite`", path.display())
        };
        let mut reader = csv::Reader::from_path(path).map_err(|error| wrong(&error))?;
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| wrong(&error))?;
            let row = parse(&record).ok_or_else(|| wrong(&format!("wrong row {record:?}")))?;
            rows.push(row);
        }
        Ok(Self { rows })
    }

    /// What is worse than stored, for the same compiler.
    pub fn compare(&self, compiler: &str, figures: &[Figure]) -> Comparison {
        let own: Vec<&Figure> = self.rows_of(compiler).collect();
        let mut comparison = Comparison { stored: own.len(), unknown: 0, worse: Vec::new() };
        for figure in figures {
            let Some(before) = own.iter().find(|old| old.subject == figure.subject) else {
                comparison.unknown += 1;
                continue;
            };
            if is_worse(figure.subject.quantity, before.value, figure.value) {
                comparison.worse.push(format!(
                    "{}: {} {}, {} when stored; make it better, or accept it with `cargo qemu \
                     --overwrite`",
                    figure.subject,
                    figure.value,
                    figure.subject.quantity.unit(),
                    before.value
                ));
            }
        }
        comparison
    }

    /// Replaces the figures of one compiler and keeps those of all others.
    pub fn overwrite(&self, compiler: &str, figures: &[Figure], path: &Path) -> Result<(), String> {
        let others = self.rows.iter().filter(|(by, _)| by != compiler);
        let mut rows: Vec<(&str, &Figure)> = others.map(|(by, figure)| (&**by, figure)).collect();
        rows.extend(figures.iter().map(|figure| (compiler, figure)));
        rows.sort_by_key(|(by, _)| *by);

        let wrong = |error: &dyn Display| format!("cannot write {}: {error}", path.display());
        let file = std::fs::File::create(path).map_err(|error| wrong(&error))?;
        write(&rows, file).map_err(|error| wrong(&error))
    }

    /// The compilers that have figures, the earliest in the file first.
    pub fn compilers(&self) -> Vec<&str> {
        let mut compilers: Vec<&str> = self.rows.iter().map(|(by, _)| &**by).collect();
        compilers.dedup();
        compilers
    }

    /// The figures of one compiler.
    pub fn rows_of(&self, compiler: &str) -> impl Iterator<Item = &Figure> {
        let own = self.rows.iter().filter(move |(by, _)| by == compiler);
        own.map(|(_, figure)| figure)
    }
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

/// More than 5 %, and more than is tolerated in any case.
fn is_worse(quantity: Quantity, before: f64, now: f64) -> bool {
    let more = now - before;
    more > quantity.tolerated() && more > 0.05 * before
}

fn parse(record: &csv::StringRecord) -> Option<(String, Figure)> {
    let text = |column: usize| record.get(column).map(str::to_owned);
    let quantity = text(5)?;
    let subject = Subject {
        core: text(1)?,
        scene: text(2)?,
        scalar: text(3)?,
        impact: text(4)?,
        quantity: Quantity::ALL.into_iter().find(|known| known.name() == quantity)?,
    };
    let value = record.get(6)?.parse().ok()?;
    Some((text(0)?, Figure { subject, value }))
}
