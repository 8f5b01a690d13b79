//! Impacts in time: indentation, its rate and the force at each moment, by the contact simulation. A captured sphere is followed
//! until it first turns back or, if it creeps, to rest.
//!
//! `cargo microimpact trajectory` shows an impact of the paper;
//! `cargo microimpact trajectory FILE.csv --format csv` writes the samples of each row of a table.

use std::error::Error;
use std::path::PathBuf;

use clap::Args;
use methods::course as course_of;
use microimpact::contact::{Adaptive, Sample, Trajectory};
use sheet::{Input, Row, Sheet, Value};

use crate::Streams;
use crate::classify::{arrival, scene};
use crate::command::{BadRows, Format, Origin, Reading, SimulationOptions, exit_status, one_row, say, write_records};
use crate::contact_law::LAW_INPUTS;
use crate::figure;
use crate::inputs::{FRICTION_INPUT, PEELING_INPUT};

/// Compute impacts in time: indentation, its rate and the force at each moment, by the contact simulation
#[derive(Args)]
#[command(after_help = "\
Example: glass on steel at 2.8 m/s
  cargo microimpact trajectory --given radius_um=5.06 density_kg_m3=2600 stiffness_gpa=75 \\
    adhesion_n_m=250 zeta_h=10.5 zeta_a=6.25 speed_normal_m_s=2.8 --format csv
`cargo microimpact columns trajectory` lists the columns.
Exit status: 0 on success; 1 if a row is bad (the column `error` says why); 2 if nothing could be read.",
after_long_help = crate::command::TABLE_MANUAL)]
pub struct Options {
    /// CSV or xlsx file of impacts; `-` for standard input [default: an impact of the paper]
    #[arg(conflicts_with = "given")]
    file: Option<PathBuf>,
    /// One impact by its columns, instead of a file
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE")]
    given: Vec<String>,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// SVG file to draw force against indentation in
    #[arg(long)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    simulation: SimulationOptions,
    #[command(flatten)]
    reading: Reading,
}

const NAME: &str = "trajectory";

/// Table 1 of the paper. Its program halves the printed damping of adhesion.
const BUNDLED: &str = "\
name,radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,friction,speed_normal_m_s,spin_rad_s
Table 1: glass on steel,5.06e-6,2600,7.5e10,250,10.5,6.25,0.1,2.8,1.46e5
";

/// The columns that the command writes.
pub const COLUMNS: [&str; 8] =
    ["name", "time_s", "indentation_m", "indentation_rate_m_s", "force_n", "elastic_force_n", "event", "error"];

/// Most samples of an impact.
const SAMPLES: usize = 512;

/// The columns that the command reads.
pub fn inputs() -> Vec<Input> {
    [&arrival::INPUTS[..], &[FRICTION_INPUT, PEELING_INPUT], &LAW_INPUTS].concat()
}

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status(NAME, self.follow(streams), streams.errors)
    }

    fn follow(&self, streams: &mut Streams<'_>) -> BadRows {
        let method = self.simulation.method::<f64>()?;
        let given = one_row(&self.given)?;
        let inputs = inputs();
        let Origin { source, progress: _progress } = Origin::of(self.file.as_deref(), BUNDLED, streams.input)?;
        let mut sheet = self.reading.open_either(NAME, given.as_deref(), source, &inputs, streams.errors)?;
        let (records, curves, bad_rows) = samples(&mut sheet, &method)?;
        write_records(self.format, &COLUMNS, 1, records, streams.output)?;
        say(NAME, sheet.empty_in_words(), streams.errors);
        if let Some(path) = &self.figure {
            draw(&curves, path)?;
        }
        Ok(bad_rows)
    }
}

/// Indentation and force of the samples of an impact.
type Curve = Vec<(f64, f64)>;

/// The samples of all rows, their curves, and the number of bad rows.
fn samples(sheet: &mut Sheet<'_>, method: &Adaptive<f64>) -> Result<(Vec<Vec<Value>>, Vec<Curve>, usize), String> {
    let (mut records, mut curves, mut bad_rows) = (Vec::new(), Vec::new(), 0);
    while let Some(row) = sheet.next_row()? {
        let name = row.label();
        match row.check().and_then(|()| course(&row, method)) {
            Ok((trajectory, at_roll)) => {
                records.extend(
                    trajectory.samples().map(|sample| record(&name, &sample, event(&trajectory, &sample, at_roll))),
                );
                curves.push(trajectory.samples().map(|sample| (sample.indentation, sample.force)).collect());
            }
            Err(reason) => {
                bad_rows += 1;
                let mut record = vec![Value::Empty; COLUMNS.len()];
                record[0] = name.into();
                record[COLUMNS.len() - 1] = reason.into();
                records.push(record);
            }
        }
    }
    Ok((records, curves, bad_rows))
}

/// The impact of a row in time, and when the sphere begins to roll.
fn course(row: &Row<'_>, method: &Adaptive<f64>) -> Result<(Trajectory<f64, SAMPLES>, Option<f64>), String> {
    let (arrival, _, scene) = scene::<f64>(row)?;
    let scene = scene.with_peeling(row.or_zero("peeling_n_m")?).map_err(|error| row.reason(error))?;
    let solved = course_of::<_, SAMPLES>(&scene, &arrival.motion, method).map_err(|error| row.reason(error))?;
    let trajectory = solved.ok_or("the simulation did not converge; use a larger --tolerance")?;
    let at_roll = trajectory.roll().map(|sample| sample.time);
    Ok((trajectory, at_roll))
}

/// What happens at a sample.
fn event(trajectory: &Trajectory<f64, SAMPLES>, sample: &Sample<f64>, at_roll: Option<f64>) -> &'static str {
    let is_last = trajectory.samples().last().is_some_and(|last| last.time == sample.time);
    if is_last {
        "end"
    } else if trajectory.peak().is_some_and(|peak| peak.time == sample.time) {
        "peak"
    } else if at_roll == Some(sample.time) {
        "rolls"
    } else if sample.time == 0.0 {
        "contact"
    } else {
        ""
    }
}

fn record(name: &str, sample: &Sample<f64>, event: &'static str) -> Vec<Value> {
    let numbers = [sample.time, sample.indentation, sample.velocity, sample.force, sample.elastic];
    let event = if event.is_empty() { Value::Empty } else { event.into() };
    let name = [Value::from(name.to_owned())];
    name.into_iter().chain(numbers.map(Value::Double)).chain([event, Value::Empty]).collect()
}

/// Draws the forces against the indentations.
fn draw(curves: &[Curve], path: &std::path::Path) -> Result<(), Box<dyn Error>> {
    let all = || curves.iter().flatten().copied();
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        if low < high { low..high } else { low..low + 1.0 }
    };
    let ranges = [
        (range(&mut all().map(|(indentation, _)| indentation)), "indentation, m"),
        (range(&mut all().map(|(_, force)| force)), "force, N"),
    ];
    let area = figure::drawing(path, (640, 480))?;
    let lines = curves.iter().map(|curve| (figure::LINE, curve.clone()));
    figure::chart(&area, "Force of the surface", ranges, all(), lines)?;
    area.present()?;
    Ok(())
}
