//! How often the intervals of a fit hold the truth, and how wide they are.
//!
//! `cargo coverage` fits 1000 synthetic sets of each configuration; `cargo coverage --sets 100` a tenth of them. It fails if an
//! interval of 95 % holds the truth in less or more sets than 95 +- 2 % by more than chance explains, or if it is too wide.

mod configuration;

use std::process::ExitCode;

use clap::Parser;
use configuration::{ALL, Configuration, Natural};
use impact_fit::{Coordinate, Interval, Law, LawFit, ScatterModel, information, median_mass};
use rayon::prelude::*;

/// Measure how often intervals of 95 % hold the truth.
#[derive(Parser)]
struct Options {
    /// Sets of each configuration.
    #[arg(long, default_value_t = 1000)]
    sets: u64,
    /// Seed of the first set.
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Only configurations whose name contains this.
    #[arg(long, default_value = "")]
    only: String,
}

/// Nominal coverage, and how far it may be missed.
const NOMINAL: f64 = 0.95;
const MARGIN: f64 = 0.02;

/// Standard errors by which chance moves a coverage: one of a hundred such numbers lies beyond three by chance in one of eight runs.
const CHANCE: f64 = 3.0;

/// Largest width over that of the bound of Cramer and Rao.
const WIDEST: f64 = 1.3;

/// Largest share of sets in which a true law may be refuted: p < 0.001 in one of a thousand, and chance.
const REFUTED: f64 = 0.002;

const QUANTITIES: [&str; 3] = ["k", "W_A", "v_c"];

fn main() -> ExitCode {
    let options = Options::parse();
    println!("{:24} {:>6} {:>24} {:>24} {:>24} {:>9} {:>6}", "", "sets", "k", "W_A", "v_c", "refuted", "ms");
    println!("{:31} {:>24} {:>24} {:>24}", "", "held, width, / bound", "held, width, / bound", "held, width, / bound");
    let mut faults = Vec::new();
    for configuration in ALL.iter().filter(|configuration| configuration.name.contains(&options.only)) {
        let begin = std::time::Instant::now();
        let seeds = options.first..options.first + options.sets;
        let results: Vec<Held> = seeds.into_par_iter().filter_map(|seed| Held::of(configuration, seed)).collect();
        let time = begin.elapsed().as_secs_f64() * 1e3 / options.sets as f64;
        let count = results.len() as f64;
        let chance = |p: f64| CHANCE * (p * (1.0 - p) / count).sqrt();
        let mut columns = Vec::new();
        for (index, quantity) in QUANTITIES.into_iter().enumerate() {
            let held = results.iter().filter(|held| held.held[index]).count() as f64 / count;
            let width = median(results.iter().map(|held| held.widths[index]));
            let ratio = median(results.iter().map(|held| held.widths[index] / held.bounds[index]));
            let known = configuration.bound_is_known();
            let bound = if known { format!("{ratio:.2}") } else { "-".into() };
            columns.push(format!("{held:.3} {width:.2e} {bound:>5}"));
            if (held - NOMINAL).abs() > MARGIN + chance(NOMINAL) {
                faults.push(format!("{}: {quantity} is held in {held:.3} of the sets", configuration.name));
            }
            if known && ratio > WIDEST {
                faults.push(format!("{}: {quantity} is {ratio:.2} times as wide as it could be", configuration.name));
            }
        }
        let refuted = results.iter().filter(|held| held.refuted).count() as f64 / count;
        if refuted > REFUTED + chance(REFUTED) || results.len() < options.sets as usize {
            faults.push(format!("{}: {refuted:.3} of {count} sets refute the true law", configuration.name));
        }
        println!(
            "{:24} {count:>6} {:>24} {:>24} {:>24} {refuted:>9.3} {time:>6.1}",
            configuration.name, columns[0], columns[1], columns[2]
        );
    }
    faults.iter().for_each(|fault| eprintln!("{fault}"));
    if faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Whether the intervals of a set hold the truth, and their widths over the truth.
struct Held {
    held: [bool; 3],
    widths: [f64; 3],
    /// Widths of the bound of Cramer and Rao.
    bounds: [f64; 3],
    refuted: bool,
}

impl Held {
    fn of(configuration: &Configuration, seed: u64) -> Option<Self> {
        let set = configuration.set(seed);
        let mass = median_mass(&set)?;
        let mut fit = LawFit::of(&set, Law::SpeedRestitution, ScatterModel::Free)?;
        let reference = fit.reference();
        let energy = 0.5 * mass * reference * reference;
        let intervals: [Interval; 3] =
            [fit.first().reciprocal(reference), fit.work()?.map(|work| work * energy), fit.critical_speed()?];
        let critical = configuration.critical_speed_of(mass);
        let truths = [configuration.restitution_speed, configuration.work, critical];
        let k = configuration.restitution_speed;
        let works = information(&set, Law::SpeedRestitution, Coordinate::Work, [k, 2.0 * configuration.work / mass]);
        let speeds = information(&set, Law::SpeedRestitution, Coordinate::CriticalSpeed, [k, critical]);
        Some(Self {
            held: std::array::from_fn(|index| intervals[index].holds(truths[index])),
            widths: std::array::from_fn(|index| (intervals[index].high - intervals[index].low) / truths[index]),
            bounds: [width(works, 0), width(works, 1), width(speeds, 1)],
            refuted: fit.judgement.p_value() < 0.001,
        })
    }
}

/// Relative width of the interval of 95 % that has the smallest variance, from the information on relative changes.
fn width(information: [[f64; 2]; 2], index: usize) -> f64 {
    let [[a, b], [_, d]] = information;
    let variance = information[1 - index][1 - index] / (a * d - b * b);
    2.0 * 1.96 * variance.sqrt()
}

impl Configuration {
    /// Whether errors are all of the scatter, and there are enough rows for the bound to be reached.
    fn bound_is_known(&self) -> bool {
        matches!(self.natural, Natural::None) && self.outliers == 0.0 && self.rows >= 50
    }
}
