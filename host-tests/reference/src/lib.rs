//! What tests and programs share: the reference solutions as scenes, the grids of scenes over which errors are stated, what
//! the C example must print, and how often tests repeat.

pub mod c_results;
pub mod grids;
pub mod laws;
pub mod published;
pub mod scenes;

use microimpact::contact::{Contact, PaperScene};
use microimpact::{InputError, NormalMotion, PlanarMotion, Real, Sphere, Stiffness};

const CASES: &str = include_str!("../../data/cases.csv");

/// An impact with its solution to 20 digits: a row of `data/cases.csv`.
#[derive(Clone)]
pub struct Case {
    names: csv::StringRecord,
    cells: csv::StringRecord,
}

/// All cases.
///
/// # Panics
/// If the file is not a table.
pub fn cases() -> Vec<Case> {
    table(CASES).map(|(names, cells)| Case { names, cells }).collect()
}

/// The rows of a text, each with the names of the columns.
fn table(text: &str) -> impl Iterator<Item = (csv::StringRecord, csv::StringRecord)> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = reader.headers().expect("the reference has a header").clone();
    reader.into_records().map(move |cells| (names.clone(), cells.expect("the reference is a table")))
}

/// The case of a name.
///
/// # Panics
/// If there is no such case.
pub fn case(name: &str) -> Case {
    cases().into_iter().find(|case| case.text("name") == name).expect("the reference has this row")
}

/// How often a test repeats what it draws at random: `all` times where MICROIMPACT_EXHAUSTIVE is set, else `few` times.
pub fn repetitions<T>(all: T, few: T) -> T {
    if std::env::var_os("MICROIMPACT_EXHAUSTIVE").is_some() { all } else { few }
}

impl Case {
    /// A cell.
    ///
    /// # Panics
    /// If there is no such column.
    pub fn text(&self, column: &str) -> &str {
        let index = self.names.iter().position(|name| name == column);
        &self.cells[index.unwrap_or_else(|| panic!("the reference has no column {column}"))]
    }

    /// A number.
    ///
    /// # Panics
    /// If there is no such column, or it does not hold numbers.
    pub fn number(&self, column: &str) -> f64 {
        let text = self.text(column);
        text.parse().unwrap_or_else(|_| panic!("{column} of the reference is no number: {text}"))
    }

    /// The case with the number in a column multiplied by a factor; its solution is no longer that of its inputs.
    ///
    /// # Panics
    /// As [`number`](Self::number).
    #[must_use]
    pub fn scaled(&self, column: &str, factor: f64) -> Self {
        let value = factor * self.number(column);
        let cells = self.names.iter().zip(&self.cells);
        let cells = cells.map(|(name, cell)| if name == column { format!("{value:e}") } else { cell.to_owned() });
        Self { names: self.names.clone(), cells: cells.collect() }
    }

    /// The motion before the impact.
    ///
    /// # Errors
    /// A value that the number type cannot hold.
    pub fn motion<T: Real>(&self) -> Result<PlanarMotion<T>, InputError> {
        NormalMotion::new(self.scalar("speed_normal_m_s"))?
            .with_tangential(self.scalar("speed_tangential_m_s"))?
            .with_spin(&self.sphere()?, self.scalar("spin_rad_s"))
    }

    /// The scene, still without a peeling moment.
    ///
    /// # Errors
    /// A value that the number type cannot hold.
    pub fn scene<T: Real>(&self) -> Result<PaperScene<T>, InputError> {
        Contact::hertz(self.sphere()?, Stiffness::new(self.scalar("stiffness_pa"))?)
            .with_damping(self.scalar("zeta_h"))?
            .with_ring(self.scalar("adhesion_n_m"), self.scalar("zeta_a"))?
            .with_friction(self.scalar("friction"))
    }

    /// The strength of the peeling moment, if there is one.
    pub fn peeling<T: Real>(&self) -> Option<T> {
        (self.number("peeling_n_m") > 0.0).then(|| self.scalar("peeling_n_m"))
    }

    fn sphere<T: Real>(&self) -> Result<Sphere<T>, InputError> {
        Sphere::solid(self.scalar("radius_m"), self.scalar("density_kg_m3"))
    }

    fn scalar<T: Real>(&self, column: &str) -> T {
        T::constant(self.number(column))
    }
}
