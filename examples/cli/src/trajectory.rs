//! Writes how indentation and force change in time, by the contact simulation.
//!
//! `cargo microimpact trajectory FILE.csv` writes the samples of each row of a table.

use std::error::Error;
use std::io::{BufRead, Write};
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use microimpact::contact::{Contact, Recording, Sample, Status};
use microimpact::{NormalMotion, Sphere};
use sheet::{Input, LABEL, Row};

use crate::Streams;
use crate::command::{BadRows, Reading, SimulationOptions, exit_status, open, simulation_help};
use crate::contact_law::{LAW_INPUTS, RowLaw};
use crate::inputs::{DENSITY_INPUT, MOTION_INPUTS};

/// Write indentation and force in time, by the contact simulation: a row for each sample of each impact.
///
/// Input columns, in SI units. Brackets give the value that an empty or absent cell has; the other columns are required.
///   radius_m, density_kg_m3, speed_normal_m_s (approach speed, a positive number), stiffness_pa (K),
///   adhesion_n_m (f0) [0], zeta_h [0], zeta_a [0], external_force_n (positive out of the surface) [0],
///   law, work_of_adhesion_j_m2, damping, damping_value, end_rule (below).
///
/// Columns of the result: name of the impact, time_s from first contact, indentation_m, velocity_m_s (its rate, positive on the
/// way in), force_n of the surface on the sphere (positive where it repels), elastic_force_n (its elastic part), and error. Samples
/// are at most 200, and are dense where the motion is fast. A captured sphere is followed to its first turning point.
#[derive(Args)]
#[command(verbatim_doc_comment, after_long_help = simulation_help())]
pub struct Options {
    /// CSV file to read; `-` for standard input.
    file: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Csv)]
    format: Format,
    #[command(flatten)]
    simulation: SimulationOptions,
    #[command(flatten)]
    reading: Reading,
}

/// Format of the result.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A row for each sample.
    Csv,
}

const NAME: &str = "trajectory";

const COLUMNS: [&str; 7] = ["name", "time_s", "indentation_m", "velocity_m_s", "force_n", "elastic_force_n", "error"];

/// Samples of an impact.
const SAMPLES: usize = 200;

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status(NAME, run(self, streams), streams.errors)
    }

    fn samples(&self, row: &Row<'_>) -> Result<Vec<Sample<f64>>, String> {
        let sphere = Sphere::solid(row.required("radius_m")?, row.required("density_kg_m3")?);
        let sphere = sphere.map_err(|error| row.reason(error))?;
        let motion = NormalMotion::new(row.required("speed_normal_m_s")?).map_err(|error| row.reason(error))?;
        let law = RowLaw::read(row)?.law().map_err(|error| row.reason(error))?;
        let method = self.simulation.method::<f64>().map_err(|error| row.reason(error))?;
        let solved = Contact::new(sphere, law).solve_for(&motion, &method, Recording::<SAMPLES>);
        let (impact, trajectory) = solved.map_err(|error| row.reason(error))?;
        if impact.run.status != Status::Solved {
            return Err("the simulation did not converge; use a larger --tolerance".into());
        }
        Ok(trajectory.samples().collect())
    }
}

fn run(options: &Options, streams: &mut Streams<'_>) -> BadRows {
    let source: Box<dyn BufRead> =
        if options.file.as_os_str() == "-" { Box::new(&mut *streams.input) } else { Box::new(open(&options.file)?) };
    let own = [Input::required(&["radius_m"]), DENSITY_INPUT, MOTION_INPUTS[0]];
    let inputs = [&own[..], &LAW_INPUTS].concat();
    let computed = |_: &sheet::Header<'_>| COLUMNS.map(String::from).into();
    let mut sheet = options.reading.open(NAME, source, &inputs, computed, streams.errors)?;
    let Format::Csv = options.format;
    let mut rows = csv::Writer::from_writer(&mut *streams.output);
    rows.write_record(COLUMNS)?;
    let mut bad_rows = 0;
    while let Some(row) = sheet.next_row()? {
        let name = row.text(LABEL).unwrap_or_else(|| format!("row {}", row.index()));
        match row.check().and_then(|()| options.samples(&row)) {
            Ok(samples) => write(&mut rows, &row, &name, &samples)?,
            Err(reason) => {
                bad_rows += 1;
                rows.write_record([&name, "", "", "", "", "", &reason])?;
            }
        }
    }
    rows.flush()?;
    Ok(bad_rows)
}

fn write(
    rows: &mut csv::Writer<impl Write>,
    row: &Row<'_>,
    name: &str,
    samples: &[Sample<f64>],
) -> Result<(), Box<dyn Error>> {
    for sample in samples {
        let Sample { time, indentation, velocity, force, elastic } = *sample;
        let numbers = [time, indentation, velocity, force, elastic].map(|number| row.cell(number));
        rows.write_record([name].into_iter().chain(numbers.iter().map(String::as_str)).chain([""]))?;
    }
    Ok(())
}
