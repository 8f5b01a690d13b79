//! Finds the speeds below which spheres are captured, by the contact simulation.
//!
//! `cargo microimpact critical` shows spheres of the paper;
//! `cargo microimpact critical FILE.csv --format csv` adds the speed to each row of a table.

use clap::Args;
use comfy_table::Cell;
use microimpact::contact::{Collocation, Nodes, Contact};
use microimpact::{CriticalSpeed, InputError, Sphere, Stiffness};
use sheet::{Row, Scalar, reason};

use crate::Streams;
use crate::command::{BadRows, TableOptions, Work};

/// Spheres of the paper's figure 6 and Table 1; its program halves the damping of adhesion.
const BUNDLED: &str = "\
name,radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a
Figure 6: 5 um,2.5e-6,2600,7.5e10,250,10.5,6.25
Mean of figure 6: 8.6 um,4.3e-6,2600,7.5e10,250,10.5,6.25
Table 1: 10.12 um,5.06e-6,2600,7.5e10,250,10.5,6.25
Figure 6: 13 um,6.5e-6,2600,7.5e10,250,10.5,6.25
20 um,1e-5,2600,7.5e10,250,10.5,6.25
50 um,2.5e-5,2600,7.5e10,250,10.5,6.25
\"50 um, damping doubled\",2.5e-5,2600,7.5e10,250,21,12.5
\"50 um, no adhesion\",2.5e-5,2600,7.5e10,0,10.5,0
";

/// Find the approach speeds that separate capture from rebound, by the contact simulation; without a table, those of
/// spheres of the paper.
///
/// Columns read, in SI units; an empty cell means what stands in brackets:
///   radius_m, density_kg_m3, stiffness_pa (K),
///   adhesion_n_m (f0; 0), zeta_h (0), zeta_a (0), external_force_n (positive out of the surface; 0).
/// All other columns pass through; one that is named like a computed column is kept as input_NAME.
///
/// Computed:
///   critical_speed_m_s: this and every lower speed is captured; but with a force out of the surface, which turns back
///     the slowest spheres before adhesion holds them, it is the largest speed that is captured;
///   critical: `speed` where there is such a speed; `always rebounds` or `never rebounds` where there is none between
///     1e-12 and 1e6 m/s, and critical_speed_m_s is empty.
///
/// Exit status: 0, or 1 if a row was bad (its reason stands in the column `error`), or 2 if nothing could be read.
#[derive(Args)]
#[command(verbatim_doc_comment)]
pub struct Options {
    /// Largest relative error of the speed; a number type's rounding limits it.
    #[arg(long, default_value_t = 1e-9)]
    tolerance: f64,
    #[command(flatten)]
    table: TableOptions,
}

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        self.table.run("critical", streams, |streams| run::<f32>(self, streams), |streams| run::<f64>(self, streams))
    }
}

fn run<T: Scalar + Nodes<8> + Nodes<12>>(options: &Options, streams: &mut Streams<'_>) -> BadRows {
    let work = Critical::<T>::new(options.tolerance)?;
    options.table.work(BUNDLED, &work, streams)
}

/// The search, coarse or fine.
struct Critical<T> {
    coarse: Option<Collocation<8, T>>,
    fine: Collocation<12, T>,
}

impl<T: Scalar + Nodes<8> + Nodes<12>> Critical<T> {
    fn new(tolerance: f64) -> Result<Self, InputError> {
        let coarse = (tolerance >= 1e-7).then(|| Collocation::new(T::constant(tolerance))).transpose()?;
        Ok(Self { coarse, fine: Collocation::new(T::constant(tolerance))? })
    }

    fn find(&self, row: &Row<'_>) -> Result<CriticalSpeed<T>, String> {
        let sphere = Sphere::solid(row.required("radius_m")?, row.required("density_kg_m3")?).map_err(reason)?;
        let stiffness = Stiffness::new(row.required("stiffness_pa")?).map_err(reason)?;
        let (adhesion, force) = (row.or_zero("adhesion_n_m")?, row.or_zero("external_force_n")?);
        let (zeta_h, zeta_a) = (row.or_zero("zeta_h")?, row.or_zero("zeta_a")?);
        let scene = Contact::hertz(sphere, stiffness)
            .with_damping(zeta_h)
            .and_then(|scene| scene.with_ring(adhesion, zeta_a))
            .and_then(|scene| scene.with_external_force(force))
            .map_err(reason)?;
        match &self.coarse {
            Some(method) => scene.critical_speed(method),
            None => scene.critical_speed(&self.fine),
        }
        .map_err(reason)
    }
}

impl<T: Scalar + Nodes<8> + Nodes<12>> Work for Critical<T> {
    fn columns(&self) -> Vec<String> {
        ["critical_speed_m_s", "critical"].map(String::from).into()
    }

    fn cells(&self, row: &Row<'_>) -> (Vec<String>, Result<(), String>) {
        match self.find(row) {
            Ok(critical) => {
                let speed = if let CriticalSpeed::At(speed) = critical { row.cell(speed) } else { String::new() };
                (vec![speed, in_words(&critical).into()], Ok(()))
            }
            Err(reason) => (Vec::new(), Err(reason)),
        }
    }

    fn heads(&self) -> Vec<&'static str> {
        vec!["sphere", "radius\nm", "critical speed\nm/s"]
    }

    fn words(&self) -> usize {
        1
    }

    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<Cell>, String> {
        let critical = self.find(row)?;
        let speed = match &critical {
            CriticalSpeed::At(speed) => row.cell(*speed),
            none => in_words(none).into(),
        };
        Ok([name, row.text("radius_m").unwrap_or_default(), speed].into_iter().map(Cell::new).collect())
    }
}

fn in_words<T>(critical: &CriticalSpeed<T>) -> &'static str {
    match critical {
        CriticalSpeed::At(_) => "speed",
        CriticalSpeed::AlwaysRebounds => "always rebounds",
        CriticalSpeed::NeverRebounds => "never rebounds",
    }
}
