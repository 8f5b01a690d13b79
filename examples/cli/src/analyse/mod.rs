//! Analyses measured impacts by the rigid-body model: coefficients, energy, class, and the probability of the class.
//!
//! `cargo microimpact analyse` shows a bundled table of synthetic impacts and two of the paper;
//! `cargo microimpact analyse FILE.csv --format csv --plots FOLDER` adds the result to each row of a table and
//! draws figures of the paper's kinds.

mod measured;
mod plots;
mod summary;
mod verdict;

use std::marker::PhantomData;
use std::path::PathBuf;
use std::sync::Mutex;

use clap::Args;
use microimpact::Real;
use sheet::{Header, Input, Row, Value};

use crate::Streams;
use crate::columns::Used;
use crate::command::{BadRows, Number, STATUS, TABLE_MANUAL, TableCommand, TableOptions};
use crate::rows::{BadRow, Work};
use crate::words::{LEVEL, probability};
use measured::{INPUTS, Inputs, Measured};
use summary::{Note, Summary};

/// Analyse measured impacts by the rigid-body model: coefficients, energy, class, and the probability of the class
#[derive(Args)]
#[command(after_help = format!("{EXAMPLE}\n{STATUS}"), after_long_help = format!("{EXAMPLE}\n\n{MANUAL}\n\n{TABLE_MANUAL}\n\n{STATUS}"))]
pub struct Options {
    /// Folder for the figures velocity_ratio.svg and impulse_ratio.svg
    #[arg(long)]
    plots: Option<PathBuf>,
    /// Least probability of an outcome or a motion that is stated
    #[arg(long, value_name = "P", default_value_t = LEVEL, value_parser = probability)]
    level: f64,
    #[command(flatten)]
    table: TableOptions,
}

const EXAMPLE: &str = "\
Example: synthetic impacts and two of the paper
  cargo microimpact analyse
`cargo microimpact columns analyse` lists the columns that it reads and writes.";

const MANUAL: &str = "\
Without a measured spin_rad_s the sphere is assumed to roll at separation, and the spin that this implies is computed; the motion is \
`assumed rolling`, and there is no confidence. Without spin_out_rad_s that spin follows from friction alone. The confidence is the \
probability of the most likely class. It takes rolling to be as likely before the measurement as sliding with any slip up to that \
before the impact. Below --level the outcome or the motion is `cannot tell`. A rebound speed of exactly 0 is a capture. A rebound above \
the bound of R, a negative one, and a gain of energy are possible within three standard errors; then the losses are those at the \
bound. Beyond, the row is bad. Without R the losses of body and adhesion are not told apart. Figures, and the statistics on standard \
error, use a random sample of at most 10000 rows.";

/// The columns of the command.
pub fn columns() -> Used {
    Used::by(&Analysis::<f64> { summary: Mutex::default(), level: LEVEL, scalar: PhantomData })
}

impl TableCommand for Options {
    const NAME: &'static str = "analyse";

    fn options(&self) -> &TableOptions {
        &self.table
    }

    fn run_in<T: Number>(&self, streams: &mut Streams<'_>) -> BadRows {
        let analysis = Analysis::<T> { summary: Mutex::default(), level: self.level, scalar: PhantomData };
        let bad_rows = self.table.work(Self::NAME, include_str!("impacts.csv"), &analysis, streams)?;
        let summary = analysis.summary.into_inner()?;
        write!(streams.errors, "{summary}")?;
        if let Some(folder) = &self.plots {
            std::fs::create_dir_all(folder)?;
            plots::velocity_ratio(&folder.join("velocity_ratio.svg"), &summary)?;
            plots::impulse_ratio(&folder.join("impulse_ratio.svg"), &summary)?;
        }
        Ok(bad_rows)
    }
}

/// The analysis in numbers of type `T`, and the statistics of the rows so far.
struct Analysis<T> {
    summary: Mutex<Summary>,
    level: f64,
    scalar: PhantomData<T>,
}

impl<T: Number> Work for Analysis<T> {
    type Notes = Vec<Note>;

    fn inputs(&self) -> Vec<Input> {
        INPUTS.into()
    }

    fn columns(&self, _header: &Header<'_>) -> Vec<String> {
        [
            "outcome",
            "motion",
            "confidence",
            "incidence_deg",
            "overall_restitution",
            "overall_restitution_error",
            "adhesion_coefficient",
            "impulse_ratio_out",
            "impulse_ratio_error",
            "rolling_ratio",
            "spin_implied_rad_s",
            "energy_before_j",
            "work_material_j",
            "work_adhesion_j",
            "work_friction_j",
            "work_rolling_j",
        ]
        .map(String::from)
        .into()
    }

    fn cells(&self, row: &Row<'_>, notes: &mut Vec<Note>) -> Result<Vec<Value>, BadRow> {
        let measured = Measured::<T>::of(row)?;
        notes.push(Note::of(&measured, self.level));
        let ledger = measured.energy();
        let by_law = |value: T| Value::from(measured.has_law.then_some(value));
        Ok(vec![
            measured.verdict.outcome_word(self.level).into(),
            measured.verdict.motion_word(self.level).into(),
            measured.verdict.confidence().into(),
            T::constant(measured.incidence()).value(),
            measured.restitution().value.value(),
            measured.restitution_error().value(),
            by_law(measured.impact.normal.adhesion_coefficient().value),
            measured.impulse_ratio().value.value(),
            measured.impulse_ratio_error().value(),
            measured.impact.tangential.rolling_ratio().value.value(),
            measured.implied_spin().into(),
            ledger.before.value.value(),
            by_law(ledger.material.value),
            by_law(ledger.adhesion.value),
            ledger.friction.value.value(),
            ledger.rolling.value.value(),
        ])
    }

    fn heads(&self, _header: &Header<'_>) -> Vec<&'static str> {
        vec![
            "impact",
            "class",
            "confidence\n%",
            "angle\ndeg",
            "e",
            "rho",
            "mu",
            "mu_0",
            "implied spin\nrad/s",
            "material\n%",
            "adhesion\n%",
            "friction\n%",
            "rolling\n%",
        ]
    }

    fn keep(&self, notes: Vec<Note>) {
        // The lock is held by one thread, and adding a note does not fail.
        if let Ok(mut summary) = self.summary.lock() {
            notes.into_iter().for_each(|note| summary.add(note));
        }
    }

    fn line(&self, row: &Row<'_>, name: String, notes: &mut Vec<Note>) -> Result<Vec<String>, String> {
        let measured = Measured::<T>::of(row)?;
        notes.push(Note::of(&measured, self.level));
        let ledger = measured.energy();
        let percent = |loss: Inputs<T>| {
            let percent = (Inputs::constant(100.0) * loss / ledger.before).value;
            // Rounding makes a loss of zero negative.
            format!("{:.1}", if percent.abs() < T::constant(0.05) { T::ZERO } else { percent })
        };
        let with_error = |value: Inputs<T>, error: T| format!("{:.4} ± {error:.4}", value.value + T::ZERO);
        let by_law = |text: String| if measured.has_law { text } else { "-".into() };
        Ok(vec![
            name,
            measured.verdict.class(self.level),
            measured.verdict.confidence().map_or("-".into(), |confidence| format!("{:.0}", 100.0 * confidence)),
            format!("{:.1}", measured.incidence()),
            with_error(measured.restitution(), measured.restitution_error()),
            by_law(format!("{:.3}", measured.impact.normal.adhesion_coefficient().value)),
            with_error(measured.impulse_ratio(), measured.impulse_ratio_error()),
            format!("{:.4}", measured.impact.tangential.rolling_ratio().value + T::ZERO),
            measured.implied_spin().map_or("-".into(), |spin| format!("{spin:.2e}")),
            by_law(percent(ledger.material)),
            by_law(percent(ledger.adhesion)),
            percent(ledger.friction),
            percent(ledger.rolling),
        ])
    }
}
