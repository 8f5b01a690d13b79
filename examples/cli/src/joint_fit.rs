//! Fits f0, both dampings and the distribution of diameters to a cloud of impacts.
//!
//! `cargo microimpact joint-fit FILE.csv --diameter 8.6e-6 --diameter-error 2e-7`

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use joint_fit::{Impact, JointFit, Known, NAMES};
use microimpact::Parameter;
use sheet::{Input, Value};

use crate::Streams;
use crate::command::{Format, Origin, Reading, exit_status, write_records};

pub mod figures;

/// Fit f0, zeta_H, zeta_A, and mean and spread of the diameters to approach speeds and restitutions
#[derive(Args)]
#[command(after_help = "\
Example: impacts of spheres of 8.6 um
  cargo microimpact joint-fit impacts.csv --diameter 8.6e-6 --diameter-error 2e-7
Each row needs speed_normal_m_s and overall_restitution, which is 0 for a capture.
Exit status: 0 on success; 2 if there is no fit (standard error says why).")]
pub struct Options {
    /// CSV or xlsx file of impacts; `-` for standard input
    file: PathBuf,
    /// Hertz stiffness, Pa
    #[arg(long, default_value_t = 7.5e10)]
    stiffness: f64,
    /// Density, kg/m^3
    #[arg(long, default_value_t = 2600.0)]
    density: f64,
    /// Standard error of a restitution
    #[arg(long, default_value_t = 0.01)]
    noise: f64,
    /// Mean diameter from another measurement, m; impacts alone give only f0 over the diameter
    #[arg(long)]
    diameter: f64,
    /// Standard error of the mean diameter, m
    #[arg(long)]
    diameter_error: f64,
    /// Values of f0, zeta_H, zeta_A and the relative spread at which the fit starts
    #[arg(long, num_args = 4, default_values_t = [250.0, 10.0, 6.0, 0.1])]
    first: Vec<f64>,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// SVG file to draw the fit in
    #[arg(long)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    reading: Reading,
}

/// The numbers of an impact.
pub const INPUTS: [Input; 2] = [Input::required(&["speed_normal_m_s"]), Input::required(&["overall_restitution"])];

const NAME: &str = "joint-fit";

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status(NAME, run(self, streams).map(|()| 0), streams.errors)
    }
}

fn run(options: &Options, streams: &mut Streams<'_>) -> Result<(), Box<dyn Error>> {
    let impacts = read(options, streams)?;
    let known = Known {
        stiffness: options.stiffness,
        density: options.density,
        noise: options.noise,
        diameter: (options.diameter, options.diameter_error),
    };
    let [f0, zeta_h, zeta_a, spread] = options.first[..] else {
        return Err("--first needs four numbers".into());
    };
    let fit = JointFit::of(&known, &impacts, [f0, zeta_h, zeta_a, options.diameter, spread])?;
    let records = NAMES.into_iter().enumerate().map(|(index, (name, unit))| {
        let (low, high) = fit.interval(index);
        let numbers = [fit.parameters[index], low, high].map(Value::Double);
        [Value::from(name)].into_iter().chain(numbers).chain([unit.into()]).collect()
    });
    write_records(options.format, &["parameter", "value", "low", "high", "unit"], 1, records, streams.output)?;
    let mean_square = fit.residuals().map(|(_, residual)| residual * residual).sum::<f64>() / impacts.len() as f64;
    let of_table = options.format == Format::Table;
    let remarks: &mut dyn Write = if of_table { &mut *streams.output } else { &mut *streams.errors };
    writeln!(remarks, "impacts: {}, mean square of the residuals in their variance: {mean_square:.3}", impacts.len())?;
    if let Some(figure) = &options.figure {
        figures::draw(&fit, figure)?;
    }
    Ok(())
}

/// The impacts of a table.
fn read(options: &Options, streams: &mut Streams<'_>) -> Result<Vec<Impact>, String> {
    let Origin { source, progress: _progress } = Origin::of(Some(&options.file), "", streams.input)?;
    let mut sheet = options.reading.open(NAME, source, &INPUTS, |_| Vec::new(), streams.errors)?;
    let mut impacts = Vec::new();
    while let Some(row) = sheet.next_row()? {
        let within = |parameter: Parameter, column: &str| {
            parameter.check(row.required::<f64>(column)?).map_err(|error| row.reason(error))
        };
        let impact = row.check().and_then(|()| {
            let speed = within(Parameter::ApproachSpeed, "speed_normal_m_s")?;
            Ok(Impact { speed, restitution: within(Parameter::Restitution, "overall_restitution")? })
        });
        impacts.push(impact.map_err(|reason| format!("row {}: {reason}", row.index()))?);
    }
    Ok(impacts)
}
