//! Finds the critical speeds of spheres, by the contact simulation.
//!
//! `cargo microimpact critical` shows spheres of the paper;
//! `cargo microimpact critical FILE.csv --format csv` adds the speed to each row of a table.

use clap::Args;
use microimpact::contact::{Adaptive, Contact};
use microimpact::{CriticalSpeed, Sphere};
use sheet::{Header, Input, Row, Value};

use crate::Streams;
use crate::columns::Used;
use crate::command::{BadRows, Number, STATUS, SimulationOptions, TABLE_MANUAL, TableCommand, TableOptions};
use crate::contact_law::{LAW_INPUTS, LawName, RowLaw};
use crate::inputs::{DENSITY_INPUT, SIZE_INPUT, radius};
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

/// Find the critical speed, at and below which spheres are captured, by the contact simulation
#[derive(Args)]
#[command(after_help = format!("{EXAMPLE}\n{STATUS}"), after_long_help = format!("{EXAMPLE}\n\n{MANUAL}\n\n{TABLE_MANUAL}\n\n{STATUS}"))]
pub struct Options {
    #[command(flatten)]
    simulation: SimulationOptions,
    #[command(flatten)]
    table: TableOptions,
}

const EXAMPLE: &str = "\
Example: the critical speeds of spheres of the paper
  cargo microimpact critical
`cargo microimpact columns critical` lists the columns that it reads and writes.";

const MANUAL: &str = "\
With a force out of the surface the critical speed is the largest speed at which spheres are captured: the force turns back the \
slowest spheres before adhesion can hold them. critical_speed_m_s is empty if there is no critical speed from 1e-12 to 1e6 m/s.";

/// The columns of the command.
pub fn columns() -> Used {
    let outputs = COLUMNS.iter().chain(&["error"]).map(|name| (*name).to_owned()).collect();
    Used { inputs: inputs(), outputs }
}

/// The computed columns.
const COLUMNS: [&str; 3] = ["critical_speed_m_s", "critical", "law"];

/// The columns that the command reads.
fn inputs() -> Vec<Input> {
    [&[SIZE_INPUT, DENSITY_INPUT], &LAW_INPUTS[..]].concat()
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
        let sphere = Sphere::solid(radius(row)?, row.required("density_kg_m3")?).map_err(|error| row.reason(error))?;
        let law = RowLaw::read(row)?;
        let critical = law.law().and_then(|law| Contact::new(sphere, law).critical_speed(&self.method));
        Ok((law.name, critical.map_err(|error| row.reason(error))?))
    }
}

impl<T: Number> Work for Critical<T> {
    type Notes = ();

    fn inputs(&self) -> Vec<Input> {
        inputs()
    }

    fn columns(&self, _header: &Header<'_>) -> Vec<String> {
        COLUMNS.map(String::from).into()
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
        Ok(vec![name, name_of(&law), row.text_of(radius::<T>(row)?), speed])
    }
}

fn in_words<T>(critical: &CriticalSpeed<T>) -> &'static str {
    match critical {
        CriticalSpeed::At(_) => "speed",
        CriticalSpeed::AlwaysRebounds => "always rebounds",
        CriticalSpeed::NeverRebounds => "never rebounds",
    }
}
