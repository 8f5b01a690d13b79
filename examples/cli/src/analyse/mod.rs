//! Analyses measured impacts by the rigid-body model: coefficients, energy, class, and the probability of the class.
//!
//! `cargo microimpact analyse` shows a bundled table of synthetic impacts and two of the paper;
//! `cargo microimpact analyse FILE.csv --format csv --plots FOLDER` adds the result to each row of a table and
//! draws figures of the paper's kinds.

mod measured;
mod plots;
mod summary;
mod verdict;

use std::cell::RefCell;
use std::error::Error;
use std::marker::PhantomData;
use std::path::PathBuf;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use microimpact::Real;
use sheet::{Header, Input, Row};

use crate::Streams;
use crate::command::{BadRow, BadRows, Number, TABLE_HELP, TableCommand, TableOptions, Work};
use crate::words::probability;
use measured::{INPUTS, Inputs, Measured};
use summary::Summary;

/// Analyse measured impacts of microspheres: coefficients, energy, class, and the probability of the class. Without a table,
/// analyse synthetic impacts and two of the paper.
///
/// Input columns, in SI units. Brackets give the value that an empty or absent cell has; the other columns are required.
///   diameter_m or radius_m, density_kg_m3, gyration_ratio (k^2/r^2) [0.4, a solid sphere],
///   restitution (R), or restitution_speed_m_s and restitution_power (k and p of R = k^p/(k^p + v^p)) [p = 1],
///   or yield_speed_m_s (elastic-plastic, Thornton 1997) [not known: losses of body and adhesion are not told apart],
///   speed_normal_m_s (approach speed, a positive number), speed_tangential_m_s [0],
///   spin_rad_s [not measured: the sphere is assumed to roll at separation, and the spin that this implies is computed],
///   rebound_speed_m_s, speed_tangential_out_m_s,
///   spin_out_rad_s [not measured: the spin follows from friction alone],
///   velocity_error_m_s (standard error of each measured velocity) [0.01], or one column for each:
///   speed_normal_error_m_s, speed_tangential_error_m_s, spin_error_rad_s, rebound_speed_error_m_s,
///   speed_tangential_out_error_m_s, spin_out_error_rad_s.
///
/// Computed: confidence is the probability of the most likely class. It takes rolling to be as likely before the measurement
/// as sliding with any slip up to that before the impact. Below --level the outcome or the motion is `cannot tell`. Without a
/// measured spin the motion is `assumed rolling`, and there is no confidence. A rebound speed of exactly 0 is a capture. A
/// rebound above the bound of R, a negative one, and a gain of energy are possible within three standard errors; then the
/// losses are those at the bound. Beyond, the row is bad.
///
/// With --format csv the command reads and writes row by row, so that a file may be larger than memory. Figures, and the
/// statistics on standard error, use a random sample of at most 10000 rows.
#[derive(Args)]
#[command(verbatim_doc_comment, after_long_help = TABLE_HELP)]
pub struct Options {
    /// Folder for the figures velocity_ratio.svg and impulse_ratio.svg.
    #[arg(long)]
    plots: Option<PathBuf>,
    /// Least probability of an outcome or a motion that is stated; below it the answer is `cannot tell`.
    #[arg(long, default_value_t = 0.9, value_parser = probability)]
    level: f64,
    #[command(flatten)]
    table: TableOptions,
}

impl TableCommand for Options {
    const NAME: &'static str = "analyse";

    fn options(&self) -> &TableOptions {
        &self.table
    }

    fn run_in<T: Number>(&self, streams: &mut Streams<'_>) -> BadRows {
        let level = self.level;
        let analysis = Analysis::<T> { summary: RefCell::default(), progress: progress()?, level, scalar: PhantomData };
        let bad_rows = self.table.work(Self::NAME, include_str!("impacts.csv"), &analysis, streams)?;
        analysis.progress.finish_and_clear();
        let summary = analysis.summary.into_inner();
        write!(streams.errors, "{summary}")?;
        if let Some(folder) = &self.plots {
            std::fs::create_dir_all(folder)?;
            plots::velocity_ratio(&folder.join("velocity_ratio.svg"), &summary)?;
            plots::impulse_ratio(&folder.join("impulse_ratio.svg"), &summary)?;
        }
        Ok(bad_rows)
    }
}

/// A line on standard error that counts the rows, if that is a terminal.
fn progress() -> Result<ProgressBar, Box<dyn Error>> {
    let style = ProgressStyle::with_template("{human_pos} rows, {per_sec}, {elapsed}")?;
    Ok(ProgressBar::new_spinner().with_style(style))
}

/// The analysis in numbers of type `T`, and the statistics of the rows so far.
struct Analysis<T> {
    summary: RefCell<Summary>,
    progress: ProgressBar,
    level: f64,
    scalar: PhantomData<T>,
}

impl<T: Number> Analysis<T> {
    fn compute(&self, row: &Row<'_>) -> Result<Measured<T>, String> {
        self.progress.inc(1);
        let measured = Measured::of(row)?;
        self.summary.borrow_mut().add(&measured, self.level);
        Ok(measured)
    }
}

impl<T: Number> Work for Analysis<T> {
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

    fn cells(&self, row: &Row<'_>) -> Result<Vec<String>, BadRow> {
        let measured = self.compute(row)?;
        let ledger = measured.energy();
        let by_law = |value: T| if measured.has_law { row.cell(value) } else { String::new() };
        Ok(vec![
            measured.verdict.outcome_word(self.level).into(),
            measured.verdict.motion_word(self.level).into(),
            measured.verdict.confidence().map(|confidence| row.cell(confidence)).unwrap_or_default(),
            row.cell(T::constant(measured.incidence())),
            row.cell(measured.restitution().value),
            row.cell(measured.restitution_error()),
            by_law(measured.impact.normal.adhesion_coefficient().value),
            row.cell(measured.impulse_ratio().value),
            row.cell(measured.impulse_ratio_error()),
            row.cell(measured.impact.tangential.rolling_ratio().value),
            measured.implied_spin().map(|spin| row.cell(spin)).unwrap_or_default(),
            row.cell(ledger.before.value),
            by_law(ledger.material.value),
            by_law(ledger.adhesion.value),
            row.cell(ledger.friction.value),
            row.cell(ledger.rolling.value),
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

    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<String>, String> {
        let measured = self.compute(row)?;
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
