//! Statistics of populations of spheres, by either model.
//!
//! `cargo microimpact population` shows populations of the paper's spheres;
//! `cargo microimpact population FILE.csv --format csv` writes the statistics of each row of a table.

mod distributions;
mod figure;
mod output;
mod results;
mod scenes;

use std::error::Error;
use std::io::BufRead;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use sheet::{Decimal, Input, Row, Sheet};

use crate::Streams;
use crate::command::{Reading, SimulationOptions, exit_status, open};
use crate::contact_law::LAW_HELP;
use distributions::SampleFiles;
use results::{Questions, Results};

const NAME: &str = "population";

/// Glass spheres of the paper on steel with a spread of diameters and speeds. Its program halves the printed damping of
/// adhesion.
const BUNDLED: &str = include_str!("populations.csv");

/// Compute what a population of spheres does: the probability of each class, the capture efficiency by size, the bounce
/// fraction by speed, and the moments of the restitution e. Without a table, compute populations of the paper's spheres.
///
/// Each row of the table is a population. Its quantities are independent of each other. Columns, in SI units; brackets give
/// the value that an empty or absent cell has; the other columns are required.
///   Diameter, in one of these ways:
///     diameter_m, one value; diameter_median_m with diameter_geometric_deviation, a log-normal distribution;
///     diameter_mean_m with diameter_deviation_m, a normal one.
///   Speed along the path in the same ways:
///     speed_m_s; speed_median_m_s with speed_geometric_deviation; speed_mean_m_s with speed_deviation_m_s.
///   Angle between the path and the normal of the surface, degrees: angle_deg, or angle_mean_deg with angle_deviation_deg [0].
///   Adhesion: adhesion_n_m, work_of_adhesion_j_m2 or work_of_adhesion_j (below), each with _median and _geometric_deviation,
///     or with _mean and _deviation before its unit, as in adhesion_median_n_m.
///   density_kg_m3; gyration_ratio (k^2/r^2) [0.4, a solid sphere]; friction (Coulomb's coefficient f) [0].
/// The simulation also reads
///   stiffness_pa (K), adhesion_n_m (f0) [0], zeta_h [0], zeta_a [0], external_force_n (positive out of the surface) [0],
///   law, work_of_adhesion_j_m2, damping, damping_value, end_rule (below).
/// The rigid-body model also reads
///   restitution (R), or restitution_speed_m_s and restitution_power (k and p of R = k^p/(k^p + v^p)) [p = 1],
///   or yield_speed_m_s (elastic-plastic, Thornton 1997),
///   work_of_adhesion_j, the same for all diameters, or adhesion_coefficient (rho), or adhesion_speed_m_s and adhesion_power
///   (l and q of rho = l^q/(l^q + v^q)) [no adhesion; q = 1].
///
/// Normal distributions of diameter, speed and adhesion begin at a thousandth of their mean, those of angles at 0; angles end
/// at 89.9 degrees; what lies beyond is left out. Distributions are cut off at six standard deviations. Spheres do not spin
/// before the impact.
///
/// Result: probabilities of the classes by number and by mass; a capture that rests counts as rolling. The capture efficiency
/// is the part of the spheres, or of their mass, in a range of diameters that is captured. The bounce fraction is the
/// probability of a rebound at one speed, with the interval of Wilson for as many particles as --particles. Moments of e
/// are those of the rebounds, and those of all impacts, where a capture has e = 0. Each number has the error of the
/// quadrature, from two orders; of a simulation also that of interpolation between its impacts. The distributions count as
/// exact. A simulated population takes seconds, and minutes where all four quantities vary.
/// With --format csv the result has a row for each number: population, model, quantity, from and to (range of diameters in m,
/// or speed in m/s), value, error, low and high (interval), and reason (of a bad row).
#[derive(Args)]
#[command(verbatim_doc_comment, after_long_help = format!("{EXAMPLE}\n\n{LAW_HELP}\n\n{STATUS}"))]
pub struct Options {
    /// CSV file of populations; `-` for standard input.
    #[arg(conflicts_with = "given")]
    file: Option<PathBuf>,
    /// One population by its columns, each as NAME=VALUE, instead of a file.
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE")]
    given: Vec<String>,
    /// Measured values of a quantity, NAME=FILE: a CSV file with the column NAME, which is diameter_m, speed_m_s, angle_deg or
    /// the column of adhesion. All populations have them.
    #[arg(long, value_name = "NAME=FILE")]
    samples: Vec<String>,
    /// Model that computes the impacts.
    #[arg(long, value_enum, default_value_t = Model::Simulation)]
    model: Model,
    /// Number of ranges of diameters, from quantile 0.001 to 0.999 of the diameters. With samples, from the smallest to the
    /// largest.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=200))]
    bins: u32,
    /// Edges of the ranges of diameters instead, m, in increasing order.
    #[arg(long, value_delimiter = ',', conflicts_with = "bins")]
    edges: Vec<f64>,
    /// Speeds of the bounce fraction, m/s [default: ten, from quantile 0.01 to 0.99 of the speeds].
    #[arg(long, value_delimiter = ',')]
    speeds: Vec<f64>,
    /// Number of particles that are observed at each speed, for the intervals of the bounce fraction.
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    particles: u32,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// SVG file to draw the capture efficiency and the bounce fraction of a population in.
    #[arg(long)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    simulation: SimulationOptions,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLE: &str = "\
Example: glass spheres of 8.6 um with a geometric standard deviation of 1.2 on steel, at 1.9 m/s
  cargo microimpact population --given diameter_median_m=8.6e-6 diameter_geometric_deviation=1.2 \\
    speed_median_m_s=1.9 speed_geometric_deviation=1.3 density_kg_m3=2600 stiffness_pa=7.5e10 \\
    adhesion_n_m=250 zeta_h=10.5 zeta_a=6.25 friction=0.1 --figure population.svg";

const STATUS: &str = "\
Exit status: 0 on success; 1 if a row is bad (its reason is in the result); 2 if the command fails, for
example because it cannot read the table.";

/// Model that computes the impacts.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Model {
    RigidBody,
    Simulation,
}

/// Format of the result.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Tables to read.
    Table,
    /// A row for each number.
    Csv,
    /// An object for each population.
    Json,
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
        if !positive(&self.speeds) {
            return Err("--speeds: give positive speeds in m/s".into());
        }
        Ok(Questions {
            bins: self.bins,
            edges: self.edges.clone(),
            speeds: self.speeds.clone(),
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
    let given = one_population(&options.given)?;
    let mut sheet = match (&options.file, &given) {
        (_, Some(text)) => Sheet::open(text.as_bytes(), &inputs, Some(Decimal::Point))?,
        (file, None) => {
            let source: Box<dyn BufRead> = match file {
                None => Box::new(BUNDLED.as_bytes()),
                Some(path) if path.as_os_str() == "-" => Box::new(&mut *streams.input),
                Some(path) => Box::new(open(path)?),
            };
            options.reading.open(NAME, source, &inputs, |_| Vec::new(), streams.errors)?
        }
    };
    if given.is_some() {
        // If standard error is closed, nobody wants to know.
        let _ = write!(streams.errors, "{NAME}: {}", sheet.columns_in_words(&[]));
    }
    let mut answers: Vec<Answer> = Vec::new();
    while let Some(row) = sheet.next_row()? {
        answers.push((row.label(), options.answer(&row, &samples, &questions)));
    }
    match options.format {
        Format::Table => output::tables(&answers, streams.output)?,
        Format::Csv => output::csv(&answers, streams.output)?,
        Format::Json => output::json(&answers, streams.output)?,
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

/// The table of one population, from its columns as `NAME=VALUE`.
fn one_population(given: &[String]) -> Result<Option<String>, Box<dyn Error>> {
    if given.is_empty() {
        return Ok(None);
    }
    let mut cells = Vec::new();
    for pair in given {
        let Some((name, value)) = pair.split_once('=') else {
            return Err(format!("--given: \"{pair}\" is refused: enter NAME=VALUE, as density_kg_m3=2600").into());
        };
        cells.push((name.trim(), value.trim()));
    }
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(cells.iter().map(|(name, _)| name))?;
    table.write_record(cells.iter().map(|(_, value)| value))?;
    Ok(Some(String::from_utf8(table.into_inner()?)?))
}
