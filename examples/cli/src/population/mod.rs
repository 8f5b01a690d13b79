//! Statistics of populations of spheres, by either model.
//!
//! `cargo microimpact population` shows populations of the paper's spheres;
//! `cargo microimpact population FILE.csv --format csv` writes the statistics of each row of a table.

mod distributions;
mod figure;
mod output;
mod scenes;

use std::error::Error;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use sheet::{Input, Row};

use crate::Streams;
use crate::command::{Format, Origin, Reading, STATUS, SimulationOptions, TABLE_MANUAL, exit_status, one_row, say};
use crate::words::name_of;
use distributions::SampleFiles;
use population::{DIAMETERS, Questions, Results};

const NAME: &str = "population";

/// Glass spheres of the paper on steel with a spread of diameters and speeds. Its program halves the printed damping of
/// adhesion.
const BUNDLED: &str = include_str!("populations.csv");

/// Compute what populations of spheres do: classes, capture efficiency by size, bounce fraction by speed
#[derive(Args)]
#[command(after_help = format!("{EXAMPLE}\n{STATUS}"), after_long_help = format!("{EXAMPLE}\n\n{MANUAL}\n\n{TABLE_MANUAL}\n\n{STATUS}"))]
pub struct Options {
    /// CSV or xlsx file of populations; `-` for standard input [default: populations of the paper]
    #[arg(conflicts_with = "given")]
    file: Option<PathBuf>,
    /// One population by its columns, instead of a file
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE")]
    given: Vec<String>,
    /// File with measured values of a quantity, in the column NAME, for all populations
    #[arg(long, value_name = "NAME=FILE")]
    samples: Vec<String>,
    /// Model that computes the impacts
    #[arg(long, value_enum, default_value_t = Model::Simulation)]
    model: Model,
    /// Number of ranges of diameters
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=200))]
    bins: u32,
    /// Edges of the ranges of diameters instead, m
    #[arg(long, value_delimiter = ',', conflicts_with = "bins")]
    edges: Vec<f64>,
    /// Speeds of the bounce fraction, m/s [default: ten of the distribution]
    #[arg(long, value_delimiter = ',')]
    speeds: Vec<f64>,
    /// Particles observed at each speed, for the intervals of the bounce fraction
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    particles: u32,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// SVG file to draw the capture efficiency and the bounce fraction in
    #[arg(long)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    simulation: SimulationOptions,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLE: &str = "\
Example: glass spheres of 8.6 um with a geometric standard deviation of 1.2 on steel, at 1.9 m/s
  cargo microimpact population --given diameter_median_um=8.6 diameter_geometric_deviation=1.2 \\
    speed_m_s=1.9 density_kg_m3=2600 stiffness_gpa=75 adhesion_n_m=250 zeta_h=10.5 zeta_a=6.25
`cargo microimpact columns population` lists the columns that it reads and writes.";

const MANUAL: &str = "\
Each row of the table is a population, whose quantities are independent of each other. Diameter or radius, speed, angle and adhesion \
each have one value, a log-normal distribution by median and geometric deviation, or a normal one by mean and deviation. Normal \
distributions of diameter, speed and adhesion begin at a thousandth of their mean, those of angles at 0; angles end at 89.9 degrees; what lies \
beyond is left out. Distributions are cut off at six standard deviations. Spheres do not spin before the impact. The work of \
adhesion of a rigid body is the same for all diameters. --samples takes measured values: diameter_m=FILE or radius_m=FILE, \
speed_m_s=FILE, angle_deg=FILE, or the column of adhesion.

Result: probabilities of the classes by number and by mass; a capture that rests counts as rolling. The capture efficiency is the part \
of the spheres, or of their mass, in a range of diameters that is captured; the ranges go from quantile 0.001 to 0.999 of the \
diameters, or from the smallest to the largest sample. The bounce fraction is the probability of a rebound at one speed, with the \
interval of Wilson for as many particles as --particles. Moments of e are those of the rebounds, and those of all impacts, where a \
capture has e = 0. Each number has the error of the quadrature, from two orders; of a simulation also that of interpolation between \
its impacts. The distributions count as exact. A simulated population takes seconds, and minutes where all four quantities vary. The \
formats csv and json have a row or an object for each number.";

/// The columns that the command writes.
pub const COLUMNS: [&str; 10] =
    ["population", "model", "quantity", "from", "to", "value", "numerical_error", "low", "high", "error"];

/// The columns that some models read.
pub fn inputs(models: &[Model]) -> Vec<Input> {
    let none = SampleFiles::none();
    let mut inputs = Vec::new();
    for model in models.iter().copied() {
        let read = distributions::inputs(model, &none).into_iter().chain(scenes::inputs(model));
        inputs.extend(read.filter(|input| !inputs.contains(input)).collect::<Vec<_>>());
    }
    inputs
}

/// Model that computes the impacts.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Model {
    RigidBody,
    Simulation,
}

/// A population by name with its statistics, or why there are none.
type Answer = (String, Result<Results, String>);

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        let outcome = run(self, streams);
        exit_status(NAME, outcome, streams.errors)
    }

    fn questions(&self) -> Result<Questions, String> {
        let increasing = self.edges.windows(2).all(|pair| pair[0] < pair[1]);
        if !self.edges.is_empty() && (self.edges.len() < 2 || !increasing || !positive(&self.edges)) {
            return Err("--edges: give two or more positive diameters in m, in increasing order".into());
        }
        if let Some(edge) = self.edges.iter().find(|edge| **edge > DIAMETERS[1]) {
            let largest = DIAMETERS[1];
            return Err(format!(
                "--edges: {edge} m is refused: a diameter must be at most {largest} m; enter 5 um as 5e-6"
            ));
        }
        if !positive(&self.speeds) {
            return Err("--speeds: give positive speeds in m/s".into());
        }
        Ok(Questions {
            bins: self.bins,
            edges: self.edges.clone(),
            speeds: Some(self.speeds.clone()).filter(|speeds| !speeds.is_empty()),
            particles: self.particles,
        })
    }

    fn inputs(&self, samples: &SampleFiles) -> Vec<Input> {
        distributions::inputs(self.model, samples).into_iter().chain(scenes::inputs(self.model)).collect()
    }

    /// The statistics of a row.
    fn answer(&self, row: &Row<'_>, samples: &SampleFiles, questions: &Questions) -> Result<Results, String> {
        row.check()?;
        match self.model {
            Model::RigidBody => scenes::rigid_bodies(row, samples, questions),
            Model::Simulation => {
                let method = self.simulation.method().map_err(|error| error.to_string())?;
                scenes::simulations(row, samples, questions, method)
            }
        }
    }
}

fn positive(numbers: &[f64]) -> bool {
    numbers.iter().all(|number| number.is_finite() && *number > 0.0)
}

fn run(options: &Options, streams: &mut Streams<'_>) -> Result<usize, Box<dyn Error>> {
    if options.model == Model::RigidBody && options.simulation.is_given() {
        return Err("--tolerance does not apply to --model rigid-body, only to --model simulation".into());
    }
    let questions = options.questions()?;
    let samples = SampleFiles::read(&options.samples, options.model)?;
    let inputs = options.inputs(&samples);
    let given = one_row(&options.given)?;
    let Origin { source, progress } = Origin::of(options.file.as_deref(), BUNDLED, streams.input)?;
    let mut sheet = options.reading.open_either(NAME, given.as_deref(), source, &inputs, streams.errors)?;
    let mut answers: Vec<Answer> = Vec::new();
    while let Some(row) = sheet.next_row()? {
        answers.push((row.label(), options.answer(&row, &samples, &questions)));
        progress.bar().inc(1);
    }
    drop(progress);
    say(NAME, sheet.empty_in_words(), streams.errors);
    let model = name_of(&options.model);
    match options.format {
        Format::Table => output::tables(&answers, &model, streams.output)?,
        Format::Csv => output::csv(&answers, &model, streams.output)?,
        Format::Json => output::json(&answers, &model, streams.output)?,
    }
    if let Some(path) = &options.figure {
        match &answers[..] {
            [(name, Ok(results))] => figure::draw(name, results, path)?,
            [_] => return Err("--figure: there is nothing to draw".into()),
            _ => return Err("--figure draws one population; give a table with one row, or --given".into()),
        }
    }
    Ok(answers.iter().filter(|(_, answer)| answer.is_err()).count())
}
