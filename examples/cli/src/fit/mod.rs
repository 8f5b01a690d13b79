//! Fits restitution laws and laws of contact to measured impacts.
//!
//! `cargo microimpact fit FILE.csv` prints what the impacts say; `--format json` for programs, `--figure FILE.svg` for the eye.

mod answer;
mod figure;
mod rows;

use std::error::Error;
use std::io::BufRead;
use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use impact_fit::{Law, ScatterModel, compete};

use crate::Streams;
use crate::command::{Reading, exit_status, open};
use crate::progress::Waiting;
use answer::Answer;
pub use rows::INPUTS;

/// Fit restitution laws and laws of contact to measured impacts
///
/// The result is the law, its parameters and the critical speed with intervals of 95 %, or that no law fits, or that the data are
/// not enough.
///
/// Input columns, in SI units. Only the first and one of the second are required.
///   speed_normal_m_s (approach speed, a positive number),
///   rebound_speed_m_s, or overall_restitution (e = rebound speed over approach speed),
///   outcome (rebound or capture) [a rebound speed or restitution of exactly 0 is a capture, all others are rebounds],
///   velocity_error_m_s (standard error of both speeds) [0.01 with rebound speeds; none with restitutions alone],
///   speed_normal_error_m_s, rebound_speed_error_m_s, overall_restitution_error [velocity_error_m_s],
///   diameter_m or radius_m, diameter_error_m [0], density_kg_m3, or mass_kg instead [not known: works are in J/kg].
///
/// The laws: constant (R), speed-restitution (R = k/(k + v)), elastic-plastic (Thornton 1997) and viscoelastic, each with a work
/// of adhesion W_A that is one constant for all sizes, e^2 = R^2 - 2 W_A/(m v^2); and the contact simulation with hysteretic
/// damping and the adhesion of ring, dmt or jkr. The fitted curve is the median of e. Natural scatter of the impacts and a
/// fraction of outliers are fitted too, and captures count as observations. A law does not fit if the residuals have a trend over
/// speed, or impacts rebound far below its critical speed (p < 0.001). Where several laws fit and Akaike's criterion differs by
/// less than 6, the data do not tell them apart; the paper's speed-restitution is stated if it is one of them.
#[derive(Args)]
#[command(verbatim_doc_comment, after_help = format!("{SHORT}\n{EXAMPLE}\n{STATUS}"), after_long_help = format!("{EXAMPLE}\n{HELP}\n\n{STATUS}"))]
pub struct Options {
    /// CSV or xlsx file of impacts; `-` for standard input.
    file: PathBuf,
    /// Format of the result.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// The law to fit, instead of all.
    #[arg(long, value_parser = PossibleValuesParser::new(Law::ALL.map(Law::name)).try_map(|name| law_of(&name)))]
    law: Option<Law>,
    /// Take the stated errors for all of the scatter; a law that they do not explain does not fit (chi-squared).
    #[arg(long)]
    no_natural_scatter: bool,
    /// SVG file to draw the impacts, the curve and the residuals in.
    #[arg(long)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLE: &str = "\
Example:
  printf 'speed_normal_m_s,overall_restitution\\n1.9,0.30\\n2,0.44\\n2.2,0.56\\n2.5,0.68\\n3,0.79\\n3.5,0.83\\n4,0.87\\n5,0.89\\n\
6,0.91\\n7,0.91\\n8,0.91\\n9,0.92\\n10,0.91\\n12,0.90\\n' |
  cargo microimpact fit - --format json
";

const HELP: &str = "\
JSON: law (none if no law fits), fits (true, false, or null with a reason), p_value, parameters (each with value, low and high;
high is null where the data set no bound), candidates (all laws, with the difference of Akaike's criterion and p), told_apart and
indistinguishable_laws, assumptions. With different diameters, work and critical speed are those of the median diameter.";

const SHORT: &str = "\
The laws: constant, speed-restitution, elastic-plastic and viscoelastic restitution, each with a work of adhesion, and the contact \
simulation with the adhesion of ring, dmt or jkr. All compete unless --law names one.
`cargo microimpact columns fit` lists the columns that it reads; `cargo microimpact man fit` says more of the laws.
";

const STATUS: &str = "\
Exit status: 0 if there is an answer, which may be that no law fits or that the data are not enough; 2 if the command fails, for \
example because a row is bad.";

/// Format of the result.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// Tables to read.
    Table,
    /// JSON, for programs.
    Json,
    /// A row for each parameter.
    Csv,
}

fn law_of(name: &str) -> Result<Law, String> {
    Law::ALL.into_iter().find(|law| law.name() == name).ok_or_else(|| format!("no law is called {name}"))
}

const NAME: &str = "fit";

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status(NAME, run(self, streams).map(|()| 0), streams.errors)
    }
}

fn run(options: &Options, streams: &mut Streams<'_>) -> Result<(), Box<dyn Error>> {
    let source: Box<dyn BufRead> =
        if options.file.as_os_str() == "-" { Box::new(&mut *streams.input) } else { Box::new(open(&options.file)?) };
    let table = rows::read(NAME, &options.reading, source, streams.errors)?;
    let laws = options.law.map_or(Law::ALL.to_vec(), |law| vec![law]);
    let scatter = if options.no_natural_scatter { ScatterModel::Errors } else { ScatterModel::Free };
    let waiting = Waiting::new(format!("fitting {} laws to {} impacts", laws.len(), table.observations.len()));
    let verdict = compete(&table.observations, &laws, scatter);
    drop(waiting);
    let answer = Answer { table: &table, verdict: &verdict };
    match options.format {
        Format::Table => answer.write_table(streams.output)?,
        Format::Json => answer.write_json(streams.output)?,
        Format::Csv => answer.write_csv(&mut *streams.output)?,
    }
    if let Some(path) = &options.figure {
        figure::draw(path, &table.observations, &verdict)?;
    }
    Ok(())
}
