//! How often the intervals of a fit hold the truth, and how wide they are.
//!
//! `cargo coverage` fits 1000 synthetic sets of each configuration; `cargo coverage --sets 100` a tenth of them. It fails if an
//! interval of 95 % holds the truth in less or more sets than 95 +- 2 % by more than chance explains, or if it is too wide. Both the
//! likelihood of the command line and the estimate of the core are measured.

mod configuration;

use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use configuration::{ALL, Configuration, DENSITY, Natural};
use impact_fit::{
    Coordinate, LEAST_P_VALUE, Law, LawFit, Observation, Response, ScatterModel, information, median_mass,
};
use microimpact::Sphere;
use microimpact::measure::{Estimate, Interval, MeasuredImpact, RestitutionFit};
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
    /// Only one of both fits.
    #[arg(long)]
    by: Option<Fit>,
}

/// Nominal coverage, and how far it may be missed.
const NOMINAL: f64 = 0.95;
const MARGIN: f64 = 0.02;

/// Coverage of the device's estimate, which has no model of outliers and of skewed scatter, where there are such.
const LEAST_OF_HARD: f64 = 0.88;

/// Standard errors by which chance moves a coverage: one of a hundred such numbers lies beyond three by chance in one of eight runs.
const CHANCE: f64 = 3.0;

/// Largest share of sets in which a true law may be refuted: p < 0.001 in one of a thousand, and the approximations of the tests.
const REFUTED: f64 = 0.002;

/// Probability of as many refuted sets or more that chance does not explain.
const UNLIKELY: f64 = 0.001;

const QUANTITIES: [&str; 3] = ["k", "W_A", "v_c"];

fn main() -> ExitCode {
    let options = Options::parse();
    println!("{:35} {:>6} {:>24} {:>24} {:>24} {:>9} {:>6}", "", "sets", "k", "W_A", "v_c", "refuted", "ms");
    println!("{:42} {:>24} {:>24} {:>24}", "", "held, width, / bound", "held, width, / bound", "held, width, / bound");
    let mut faults = Vec::new();
    for fit in Fit::ALL.into_iter().filter(|fit| options.by.is_none_or(|by| by == *fit)) {
        for configuration in ALL.iter().filter(|configuration| configuration.name.contains(&options.only)) {
            measure(fit, configuration, &options, &mut faults);
        }
    }
    faults.iter().for_each(|fault| eprintln!("{fault}"));
    if faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Measures one fit on the sets of one configuration, and prints a line.
fn measure(fit: Fit, configuration: &Configuration, options: &Options, faults: &mut Vec<String>) {
    let (name, by) = (configuration.name, fit.name());
    let begin = std::time::Instant::now();
    let seeds = options.first..options.first + options.sets;
    let results: Vec<Held> = seeds.into_par_iter().filter_map(|seed| Held::of(fit, configuration, seed)).collect();
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
        let least = if fit == Fit::Device && configuration.is_hard() { LEAST_OF_HARD } else { NOMINAL - MARGIN };
        if held < least - chance(least) || held > NOMINAL + MARGIN + chance(NOMINAL) {
            faults.push(format!("{by}, {name}: {quantity} is held in {held:.3} of the sets"));
        }
        if known && ratio > fit.widest() {
            faults.push(format!("{by}, {name}: {quantity} is {ratio:.2} times as wide as it could be"));
        }
    }
    let wrong = results.iter().filter(|held| held.refuted).count();
    let refuted = wrong as f64 / count;
    if at_least(wrong, results.len(), REFUTED) < UNLIKELY || results.len() < options.sets as usize {
        faults.push(format!("{by}, {name}: {refuted:.3} of {count} sets refute the true law"));
    }
    println!(
        "{by:10} {name:24} {count:>6} {:>24} {:>24} {:>24} {refuted:>9.3} {time:>6.1}",
        columns[0], columns[1], columns[2]
    );
}

/// Probability that at least `seen` of `count` sets are refuted, each with a probability (binomial distribution).
fn at_least(seen: usize, count: usize, probability: f64) -> f64 {
    let mut term = (1.0 - probability).powf(count as f64);
    let mut below = 0.0;
    for number in 0..seen {
        below += term;
        term *= (count - number) as f64 / (number + 1) as f64 * probability / (1.0 - probability);
    }
    1.0 - below
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

/// What fits a set.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Fit {
    /// The likelihood of the command line.
    Likelihood,
    /// The estimate of the core, for devices.
    Device,
}

impl Fit {
    const ALL: [Self; 2] = [Self::Likelihood, Self::Device];

    /// Largest width over that of the bound of Cramer and Rao. The bounded influence of the device's estimate makes it wider.
    fn widest(self) -> f64 {
        match self {
            Self::Likelihood => 1.3,
            Self::Device => 1.6,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Likelihood => "likelihood",
            Self::Device => "device",
        }
    }

    /// Intervals of k, W_A and the critical speed, each as value, low and high, and whether the law is refuted.
    fn intervals(self, set: &[Observation]) -> Option<([[f64; 3]; 3], bool)> {
        match self {
            Self::Likelihood => {
                let mut fit = LawFit::of(set, Law::SpeedRestitution, ScatterModel::Free)?;
                let reference = fit.reference();
                let energy = 0.5 * median_mass(set)? * reference * reference;
                let intervals =
                    [fit.first().reciprocal(reference), fit.work()?.map(|work| work * energy), fit.critical_speed()?];
                let refuted = fit.judgement.p_value() < LEAST_P_VALUE;
                Some((intervals.map(|interval| [interval.value, interval.low, interval.high]), refuted))
            }
            Self::Device => {
                let impacts: Vec<_> = set.iter().filter_map(measured).collect();
                let fit = RestitutionFit::of(&impacts).ok()?;
                // A refuted law has no critical speed.
                let none = Interval { value: f64::NAN, low: f64::NAN, high: f64::NAN };
                let intervals = [fit.restitution_speed, fit.work_of_adhesion, fit.critical_speed.unwrap_or(none)];
                Some((intervals.map(|interval| [interval.value, interval.low, interval.high]), !fit.fits))
            }
        }
    }
}

fn measured(observation: &Observation) -> Option<MeasuredImpact<f64>> {
    let radius = (0.75 * observation.sphere?.mass / (std::f64::consts::PI * DENSITY)).cbrt();
    let rebound = match observation.response {
        Response::Rebound { speed, error } => Some(Estimate { value: speed, standard_error: error }),
        Response::Capture => None,
    };
    let approach = Estimate { value: observation.speed, standard_error: observation.speed_error };
    Some(MeasuredImpact { sphere: Sphere::solid(radius, DENSITY).ok()?, approach, rebound })
}

impl Held {
    fn of(fit: Fit, configuration: &Configuration, seed: u64) -> Option<Self> {
        let set = configuration.set(seed);
        let mass = median_mass(&set)?;
        let (intervals, refuted) = fit.intervals(&set)?;
        let critical = configuration.critical_speed_of(mass);
        let truths = [configuration.restitution_speed, configuration.work, critical];
        let k = configuration.restitution_speed;
        let works = information(&set, Law::SpeedRestitution, Coordinate::Work, [k, 2.0 * configuration.work / mass]);
        let speeds = information(&set, Law::SpeedRestitution, Coordinate::CriticalSpeed, [k, critical]);
        let holds = |index: usize| {
            let [_, low, high]: [f64; 3] = intervals[index];
            low <= truths[index] && truths[index] <= high
        };
        Some(Self {
            held: std::array::from_fn(holds),
            widths: std::array::from_fn(|index| (intervals[index][2] - intervals[index][1]) / truths[index]),
            bounds: [width(works, 0), width(works, 1), width(speeds, 1)],
            refuted,
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
    /// Whether there are outliers or skewed scatter.
    fn is_hard(&self) -> bool {
        matches!(self.natural, Natural::Glass) || self.outliers > 0.0
    }

    /// Whether errors are all of the scatter, and there are enough rows for the bound to be reached.
    fn bound_is_known(&self) -> bool {
        matches!(self.natural, Natural::None) && self.outliers == 0.0 && self.rows >= 50
    }
}
