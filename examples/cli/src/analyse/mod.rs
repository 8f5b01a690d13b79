//! Analyses measured impacts with the rigid-body model: coefficients, energy, class and how sure it is.
//!
//! `cargo microimpact analyse` shows a bundled table of synthetic impacts and two of the paper;
//! `cargo microimpact analyse FILE.csv --format csv --plots FOLDER` adds the result to each row of a table and
//! draws figures of the paper's kinds.

mod measured;
mod plots;
mod summary;

use std::cell::RefCell;
use std::error::Error;
use std::marker::PhantomData;
use std::path::PathBuf;

use clap::Args;
use comfy_table::Cell;
use indicatif::{ProgressBar, ProgressStyle};
use microimpact::Real;
use sheet::Row;

use crate::Streams;
use crate::command::{BadRows, TableOptions, Work};
use crate::words::{motion_name, outcome_name};
use measured::{Inputs, Measured, Number};
use summary::Summary;

/// Analyse measured impacts of microspheres: coefficients, energy, class and how sure it is.
///
/// Columns read, in SI units; an empty cell means what stands in brackets:
///   diameter_m or radius_m, density_kg_m3, gyration_ratio (k^2/r^2; 0.4, solid),
///   restitution (R) or restitution_speed_m_s (k of R = k/(k + v)),
///   speed_normal_m_s (approach speed), speed_tangential_m_s (0), spin_rad_s (not measured: the sphere is taken to roll at
///   separation, and the spin that this implies is computed),
///   rebound_speed_m_s, speed_tangential_out_m_s, spin_out_rad_s (not measured: follows from friction alone),
///   velocity_error_m_s (standard error of every measured velocity; 0.01).
/// All other columns pass through; one that is named like a computed column is kept as input_NAME.
///
/// Computed: a slip within three of its standard errors counts as rolling. The confidence is the probability that the true
/// velocities, normal about the measured ones, have the same class. A row with velocities that no impact can have is bad, and
/// says why.
///
/// With --format csv rows are read and written one by one, so that a file may be larger than memory. Figures and the summary
/// on standard error are made from at most 10000 rows drawn at random.
///
/// Exit status: 0, or 1 if a row was bad (its reason stands in the column `error`), or 2 if nothing could be read.
#[derive(Args)]
#[command(verbatim_doc_comment)]
pub struct Options {
    /// Folder for figures: velocity_ratio.svg and impulse_ratio.svg.
    #[arg(long)]
    plots: Option<PathBuf>,
    #[command(flatten)]
    table: TableOptions,
}

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        self.table.run("analyse", streams, |streams| run::<f32>(self, streams), |streams| run::<f64>(self, streams))
    }
}

fn run<T: Number>(options: &Options, streams: &mut Streams<'_>) -> BadRows {
    let analysis = Analysis::<T> { summary: RefCell::default(), progress: progress()?, scalar: PhantomData };
    let bad_rows = options.table.work(include_str!("impacts.csv"), &analysis, streams)?;
    analysis.progress.finish_and_clear();
    let summary = analysis.summary.into_inner();
    write!(streams.errors, "{summary}")?;
    if let Some(folder) = &options.plots {
        std::fs::create_dir_all(folder)?;
        plots::velocity_ratio(&folder.join("velocity_ratio.svg"), &summary)?;
        plots::impulse_ratio(&folder.join("impulse_ratio.svg"), &summary)?;
    }
    Ok(bad_rows)
}

/// A line on standard error that counts the rows, where that is a terminal.
fn progress() -> Result<ProgressBar, Box<dyn Error>> {
    let style = ProgressStyle::with_template("{human_pos} rows, {per_sec}, {elapsed}")?;
    Ok(ProgressBar::new_spinner().with_style(style))
}

/// The analysis in numbers of type `T`, and what is gathered while rows pass by.
struct Analysis<T> {
    summary: RefCell<Summary>,
    progress: ProgressBar,
    scalar: PhantomData<T>,
}

impl<T: Number> Analysis<T> {
    fn compute(&self, row: &Row<'_>) -> Result<Measured<T>, String> {
        self.progress.inc(1);
        let measured = Measured::of(row)?;
        self.summary.borrow_mut().add(&measured);
        Ok(measured)
    }
}

impl<T: Number> Work for Analysis<T> {
    fn columns(&self) -> Vec<String> {
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

    fn cells(&self, row: &Row<'_>) -> (Vec<String>, Result<(), String>) {
        let measured = match self.compute(row) {
            Ok(measured) => measured,
            Err(reason) => return (Vec::new(), Err(reason)),
        };
        let ledger = measured.energy();
        let cells = vec![
            outcome_name(measured.classification.outcome).into(),
            motion_name(measured.classification.contact.motion).into(),
            row.cell(measured.confidence),
            row.cell(T::constant(measured.incidence())),
            row.cell(measured.restitution().value),
            row.cell(measured.restitution_error()),
            row.cell(measured.impact.normal.adhesion_coefficient().value),
            row.cell(measured.impulse_ratio().value),
            row.cell(measured.impulse_ratio_error()),
            row.cell(measured.impact.tangential.rolling_ratio().value),
            measured.implied_spin().map(|spin| row.cell(spin)).unwrap_or_default(),
            row.cell(ledger.before.value),
            row.cell(ledger.material.value),
            row.cell(ledger.adhesion.value),
            row.cell(ledger.friction.value),
            row.cell(ledger.rolling.value),
        ];
        (cells, Ok(()))
    }

    fn heads(&self) -> Vec<&'static str> {
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

    fn words(&self) -> usize {
        2
    }

    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<Cell>, String> {
        let measured = self.compute(row)?;
        let ledger = measured.energy();
        let share =
            |loss: Inputs<T>| format!("{:.1}", (Inputs::constant(100.0) * loss / ledger.before).value + T::ZERO);
        let with_error = |value: Inputs<T>, error: T| format!("{:.4} ± {error:.4}", value.value + T::ZERO);
        let cells = [
            name,
            measured.classification.class().to_string(),
            format!("{:.0}", T::constant(100.0) * measured.confidence),
            format!("{:.1}", measured.incidence()),
            with_error(measured.restitution(), measured.restitution_error()),
            format!("{:.3}", measured.impact.normal.adhesion_coefficient().value),
            with_error(measured.impulse_ratio(), measured.impulse_ratio_error()),
            format!("{:.4}", measured.impact.tangential.rolling_ratio().value + T::ZERO),
            measured.implied_spin().map_or("-".into(), |spin| format!("{spin:.2e}")),
            share(ledger.material),
            share(ledger.adhesion),
            share(ledger.friction),
            share(ledger.rolling),
        ];
        Ok(cells.into_iter().map(Cell::new).collect())
    }
}
