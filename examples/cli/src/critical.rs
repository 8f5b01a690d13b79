//! Finds the critical speeds of spheres, by the contact simulation.
//!
//! `cargo microimpact critical` shows spheres of the paper;
//! `cargo microimpact critical FILE.csv --format csv` adds the speed to each row of a table.

use clap::Args;
use microimpact::contact::{Adaptive, Contact};
use microimpact::{CriticalSpeed, Sphere};
use sheet::{Header, Input, Row, Value};

use crate::Streams;
use crate::command::{BadRows, Number, SimulationOptions, TableCommand, TableOptions};
use crate::contact_law::{LAW_INPUTS, LawName, RowLaw};
use crate::inputs::DENSITY_INPUT;
use crate::rows::{BadRow, Work};
use crate::words::name_of;

/// Spheres of the paper's figure 6 and Table 1. Its program halves the printed damping of adhesion.
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

/// Find the critical speed, which separates capture from rebound, by the contact simulation. Without a table, find it for
/// spheres of the paper.
///
/// Input columns, in SI units. Brackets give the value that an empty or absent cell has; the other columns are required.
///   radius_m, density_kg_m3, stiffness_pa (K),
///   adhesion_n_m (f0) [0], zeta_h [0], zeta_a [0], external_force_n (positive out of the surface) [0],
///   law, work_of_adhesion_j_m2, damping, damping_value, end_rule (below).
///
/// Computed columns:
///   critical_speed_m_s: spheres are captured at this speed and below. With a force out of the surface it is the largest
///     speed at which spheres are captured: the force turns back the slowest spheres before adhesion can hold them.
///   critical: `speed` if there is such a speed. `always rebounds` or `never rebounds` if there is none from 1e-12 to
///     1e6 m/s; critical_speed_m_s is then empty.
///   law: hertz, ring, dmt or jkr.
#[derive(Args)]
#[command(verbatim_doc_comment, after_long_help = crate::command::TABLE_MANUAL)]
pub struct Options {
    #[command(flatten)]
    simulation: SimulationOptions,
    #[command(flatten)]
    table: TableOptions,
}

impl TableCommand for Options {
    const NAME: &'static str = "critical";

    fn options(&self) -> &TableOptions {
        &self.table
    }

    fn run_in<T: Number>(&self, streams: &mut Streams<'_>) -> BadRows {
        self.table.work(Self::NAME, BUNDLED, &Critical { method: self.simulation.method::<T>()? }, streams)
    }
}

/// The search for a critical speed.
struct Critical<T> {
    method: Adaptive<T>,
}

impl<T: Number> Critical<T> {
    fn find(&self, row: &Row<'_>) -> Result<(LawName, CriticalSpeed<T>), String> {
        let sphere = Sphere::solid(row.required("radius_m")?, row.required("density_kg_m3")?)
            .map_err(|error| row.reason(error))?;
        let law = RowLaw::read(row)?;
        let critical = law.law().and_then(|law| Contact::new(sphere, law).critical_speed(&self.method));
        Ok((law.name, critical.map_err(|error| row.reason(error))?))
    }
}

impl<T: Number> Work for Critical<T> {
    type Notes = ();

    fn inputs(&self) -> Vec<Input> {
        [&[Input::required(&["radius_m"]), DENSITY_INPUT], &LAW_INPUTS[..]].concat()
    }

    fn columns(&self, _header: &Header<'_>) -> Vec<String> {
        ["critical_speed_m_s", "critical", "law"].map(String::from).into()
    }

    fn cells(&self, row: &Row<'_>, (): &mut ()) -> Result<Vec<Value>, BadRow> {
        let (law, critical) = self.find(row)?;
        let speed = if let CriticalSpeed::At(speed) = critical { speed.value() } else { Value::Empty };
        Ok(vec![speed, in_words(&critical).into(), name_of(&law).into()])
    }

    fn heads(&self, _header: &Header<'_>) -> Vec<&'static str> {
        vec!["sphere", "law", "radius\nm", "critical speed\nm/s"]
    }

    fn line(&self, row: &Row<'_>, name: String, (): &mut ()) -> Result<Vec<String>, String> {
        let (law, critical) = self.find(row)?;
        let speed = match &critical {
            CriticalSpeed::At(speed) => row.text_of(*speed),
            none => in_words(none).into(),
        };
        Ok(vec![name, name_of(&law), row.text_of(row.required::<T>("radius_m")?), speed])
    }
}

fn in_words<T>(critical: &CriticalSpeed<T>) -> &'static str {
    match critical {
        CriticalSpeed::At(_) => "speed",
        CriticalSpeed::AlwaysRebounds => "always rebounds",
        CriticalSpeed::NeverRebounds => "never rebounds",
    }
}
