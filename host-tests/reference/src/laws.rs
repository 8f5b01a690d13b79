//! Impacts by any law of contact, damping and end of contact.

use csv::StringRecord;
use microimpact::contact::{AnyLaw, Contact, ErrorControl, JkrEnd, Times};
use microimpact::{InputError, NormalMotion, Outcome, Real, Sphere, Stiffness};

const IMPACTS: &str = include_str!("../../data/laws.csv");
const CRITICAL: &str = include_str!("../../data/laws_critical.csv");

/// A row with its names.
pub struct Row {
    names: StringRecord,
    cells: StringRecord,
}

/// Impacts with their solutions to 20 digits: the rows of `data/laws.csv`.
///
/// # Panics
/// As [`rows`].
pub fn impacts() -> Vec<Row> {
    rows(IMPACTS)
}

/// Scenes with their critical speeds: the rows of `data/laws_critical.csv`.
///
/// # Panics
/// As [`rows`].
pub fn critical() -> Vec<Row> {
    rows(CRITICAL)
}

/// The rows of a table with the columns of `data/laws.csv`, or with some of them.
///
/// # Panics
/// If the text is not a table.
pub fn rows(text: &str) -> Vec<Row> {
    crate::table(text).map(|(names, cells)| Row { names, cells }).collect()
}

/// Columns that a result depends on.
const INPUTS: [&str; 8] = [
    "radius_m",
    "density_kg_m3",
    "stiffness_pa",
    "work_of_adhesion_j_m2",
    "adhesion_n_m",
    "zeta_a",
    "damping_value",
    "speed_normal_m_s",
];

/// What a row is solved for: the outcome, then e^2, the peak indentation, its time, and the contact time.
pub type Solution<T> = (Option<Outcome>, [Option<T>; 4]);

impl Row {
    /// A cell; empty where there is no such column.
    pub fn text(&self, column: &str) -> &str {
        self.names.iter().position(|name| name == column).map_or("", |place| &self.cells[place])
    }

    /// A number; `None` where the cell is empty.
    ///
    /// # Panics
    /// If the cell holds something else.
    pub fn number(&self, column: &str) -> Option<f64> {
        let text = Some(self.text(column)).filter(|text| !text.is_empty());
        text.map(|text| text.parse().unwrap_or_else(|_| panic!("{column} of the table is no number: {text}")))
    }

    /// What [`scene`](Self::scene) and [`solve`](Self::solve) take; zero where there is no number.
    ///
    /// # Panics
    /// As [`number`](Self::number).
    pub fn inputs(&self) -> [f64; 8] {
        INPUTS.map(|column| self.number(column).unwrap_or(0.0))
    }

    /// The outcome in the table.
    pub fn outcome(&self) -> Outcome {
        if self.text("outcome") == "rebound" { Outcome::Rebound } else { Outcome::Capture }
    }

    /// e^2, the peak indentation, its time, and the contact time in the table, as far as it gives them.
    ///
    /// # Panics
    /// As [`number`](Self::number).
    pub fn solution(&self) -> [Option<f64>; 4] {
        let [e, rest @ ..] =
            ["restitution", "max_indentation_m", "time_peak_s", "contact_time_s"].map(|column| self.number(column));
        let [indentation, peak, contact] = rest;
        [e.map(|e| e * e), indentation, peak, contact]
    }

    /// The scene of inputs.
    ///
    /// # Errors
    /// A value that the number type cannot hold.
    ///
    /// # Panics
    /// If the row names a law, an end of contact or a damping that does not exist.
    pub fn scene<T: Real>(&self, inputs: [T; 8]) -> Result<Contact<T, AnyLaw<T>>, InputError> {
        let [radius, density, stiffness, work, strength, zeta_a, damping, _] = inputs;
        let stiffness = Stiffness::new(stiffness)?;
        let law = match (self.text("law"), self.text("end_rule")) {
            ("hertz", "no-indentation") => AnyLaw::hertz(stiffness),
            ("hertz", "no-force") => AnyLaw::without_tension(stiffness),
            ("ring", "no-indentation") => AnyLaw::ring(stiffness, strength, zeta_a)?,
            ("dmt", "no-indentation") => AnyLaw::dmt(stiffness, work)?,
            ("jkr", "snap-off") => AnyLaw::jkr(stiffness, work, JkrEnd::SnapOff)?,
            ("jkr", "pull-off") => AnyLaw::jkr(stiffness, work, JkrEnd::PullOff)?,
            other => panic!("{other:?}"),
        };
        let law = match self.text("damping") {
            "none" => law,
            "hysteretic" => law.with_damping(damping)?,
            "viscoelastic" => law.with_viscoelastic_damping(damping)?,
            "constant" => law.with_constant_damping(damping)?,
            other => panic!("{other}"),
        };
        Ok(Contact::new(Sphere::solid(radius, density)?, law))
    }

    /// The solution by a method.
    ///
    /// # Errors
    /// A value that the number type cannot hold.
    ///
    /// # Panics
    /// As [`scene`](Self::scene).
    pub fn solve<T: Real>(&self, inputs: [T; 8], method: &impl ErrorControl<T>) -> Result<Solution<T>, InputError> {
        let (impact, times) = self.scene(inputs)?.solve_for(&NormalMotion::new(inputs[7])?, method, Times)?;
        let e = impact.normal.overall_restitution();
        let indentation = impact.normal.peak_indentation();
        Ok((impact.normal.outcome(), [Some(e * e), indentation, times.peak, times.contact]))
    }
}
