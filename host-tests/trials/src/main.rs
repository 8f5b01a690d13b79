//! Trials: how often methods and number types are right over random scenes.

use std::error::Error;

use clap::Parser;
use comfy_table::{Table, presets};
use reference::scenes::Kind;
use trials::{Count, Output, SCENES, SEED, Solver, Statistics, Tally, merged, run, solvers, store};

/// How often methods and number types are right over random scenes, judged by an independent truth.
#[derive(Parser)]
struct Arguments {
    /// Scenes of each kind
    #[arg(long, default_value_t = SCENES)]
    scenes: u64,
    /// Seed of the random scenes
    #[arg(long, default_value_t = SEED)]
    seed: u64,
    /// Kind of scenes; all kinds without it
    #[arg(long, value_parser = kind)]
    kind: Vec<Kind>,
    /// Only methods whose name and number type contain this text, as `Adaptive` or `f32`
    #[arg(long, default_value = "")]
    method: String,
    /// Print the errors of each output
    #[arg(long)]
    outputs: bool,
    /// Print so many of the worst scenes of each method: radius, density, gyration ratio, stiffness, adhesion, zeta_H,
    /// zeta_A, friction, peeling, force, speed, tangential velocity and spin, all in SI units
    #[arg(long, default_value_t = 0)]
    worst: usize,
    /// Store the statistics over all kinds in host-tests/data/trials.csv, and the guide's table of them
    #[arg(long, conflicts_with_all = ["scenes", "seed", "kind", "method"])]
    store: bool,
}

fn kind(name: &str) -> Result<Kind, String> {
    let names = || Kind::ALL.map(Kind::name).join(", ");
    Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| format!("one of {}", names()))
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let kinds = if arguments.kind.is_empty() { Kind::ALL.to_vec() } else { arguments.kind.clone() };
    let mut solvers = solvers();
    solvers.retain(|solver| label(solver).contains(&arguments.method));
    let mut all = vec![Tally::default(); solvers.len()];
    for kind in &kinds {
        let tallies = run(*kind, arguments.seed, arguments.scenes, &solvers);
        print(kind.name(), &arguments, &solvers, &tallies);
        all = merged(all, tallies);
    }
    if kinds.len() > 1 {
        print("together", &arguments, &solvers, &all);
    }
    if arguments.store {
        let statistics: Vec<_> =
            solvers.iter().zip(&all).map(|(solver, tally)| Statistics::new(solver, tally)).collect();
        store(&statistics)?;
    }
    Ok(())
}

fn print(title: &str, arguments: &Arguments, solvers: &[Solver], tallies: &[Tally]) {
    println!("{title}\n{}\n", counts(solvers, tallies));
    if arguments.outputs {
        println!("{}\n", errors(solvers, tallies));
    }
    for (solver, tally) in solvers.iter().zip(tallies) {
        for example in tally.worst.iter().take(arguments.worst) {
            println!("{}: {}: {}", label(solver), example.fault, example.scene);
        }
    }
}

fn label(solver: &Solver) -> String {
    format!("{} {}", solver.name, solver.number.name())
}

/// A table with a row for each solver: the mean of its evaluations, all counts, the largest distances from the boundary of undecided and
/// wrong outcomes, the errors of e^2, and the worst output.
fn counts(solvers: &[Solver], tallies: &[Tally]) -> Table {
    const FIRST: [&str; 2] = ["method", "evaluations"];
    const MORE: [&str; 5] = ["undecided to", "wrong to", "e^2 beyond", "beyond ten", "worst output"];
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_header([&FIRST, &Count::ALL.map(Count::name)[..], &MORE].concat());
    for (solver, tally) in solvers.iter().zip(tallies) {
        let e = &tally.outputs[0];
        let worst = Output::ALL.iter().zip(&tally.outputs).max_by(|a, b| a.1.largest.total_cmp(&b.1.largest));
        let worst = worst.map(|(output, errors)| format!("{} {:.0e}", output.name(), errors.largest));
        let distance = |count: u64, distance: f64| if count > 0 { format!("{distance:.0e}") } else { String::new() };
        let more = [
            distance(tally.undecided, tally.largest_undecided),
            distance(tally.wrong_outcomes, tally.largest_wrong),
            e.beyond.to_string(),
            e.far_beyond.to_string(),
            worst.unwrap_or_default(),
        ];
        let counts = Count::ALL.map(|count| count.of(tally).to_string());
        let evaluations = match tally.counted {
            0 => String::new(),
            counted => format!("{:.1}", tally.evaluations as f64 / counted as f64),
        };
        table.add_row([label(solver), evaluations].into_iter().chain(counts).chain(more));
    }
    table
}

/// A table of errors beyond the tolerance, beyond ten times the tolerance, and the largest over the tolerance.
fn errors(solvers: &[Solver], tallies: &[Tally]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_header([vec!["method"], Output::ALL.map(Output::name).to_vec()].concat());
    for (solver, tally) in solvers.iter().zip(tallies) {
        let cells = tally.outputs.iter().map(|errors| match errors.beyond {
            0 => String::new(),
            beyond => format!("{beyond}/{}, {:.0e}", errors.far_beyond, errors.largest),
        });
        table.add_row([label(solver)].into_iter().chain(cells));
    }
    table
}
