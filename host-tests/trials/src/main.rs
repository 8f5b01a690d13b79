//! Trials: how often methods and number types are right over random scenes.

use clap::Parser;
use comfy_table::{Table, presets};
use reference::scenes::Kind;
use trials::{Output, Solver, Tally, run, solvers};

/// How often methods and number types are right over random scenes, judged by an independent truth.
#[derive(Parser)]
struct Arguments {
    /// Scenes of each kind
    #[arg(long, default_value_t = 1000)]
    scenes: u64,
    /// Seed of the random scenes
    #[arg(long, default_value_t = 1)]
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
}

fn kind(name: &str) -> Result<Kind, String> {
    let names = || Kind::ALL.map(Kind::name).join(", ");
    Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| format!("one of {}", names()))
}

fn main() {
    let arguments = Arguments::parse();
    let kinds = if arguments.kind.is_empty() { Kind::ALL.to_vec() } else { arguments.kind.clone() };
    let mut solvers = solvers();
    solvers.retain(|solver| label(solver).contains(&arguments.method));
    for kind in kinds {
        let tallies = run(kind, arguments.seed, arguments.scenes, &solvers);
        println!("{}", kind.name());
        println!("{}\n", counts(&solvers, &tallies));
        if arguments.outputs {
            println!("{}\n", errors(&solvers, &tallies));
        }
        for (solver, tally) in solvers.iter().zip(&tallies) {
            for example in tally.worst.iter().take(arguments.worst) {
                println!("{}: {}: {}", label(solver), example.fault, example.scene);
            }
        }
    }
}

fn label(solver: &Solver) -> String {
    format!("{} {}", solver.name, solver.number.name())
}

/// A table with a row for each solver.
fn counts(solvers: &[Solver], tallies: &[Tally]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_header([
        "method",
        "scenes",
        "unknown",
        "refused",
        "unsolved",
        "undecided",
        "needless",
        "up to",
        "wrong",
        "up to",
        "wrong class",
        "e^2 > 1",
        "e^2 > 10",
        "outputs > 1",
        "outputs > 10",
        "unexplained",
        "worst output",
    ]);
    for (solver, tally) in solvers.iter().zip(tallies) {
        let [e, others @ ..] = &tally.outputs;
        let sum = |of: fn(&trials::OutputErrors) -> u64| others.iter().map(of).sum::<u64>();
        let worst = Output::ALL.iter().zip(&tally.outputs).max_by(|a, b| a.1.largest.total_cmp(&b.1.largest));
        let worst = worst.map(|(output, errors)| format!("{} {:.0e}", output.name(), errors.largest));
        let distance = |count: u64, distance: f64| if count > 0 { format!("{distance:.0e}") } else { String::new() };
        table.add_row([
            label(solver),
            tally.scenes.to_string(),
            tally.unknown.to_string(),
            tally.refused.to_string(),
            tally.unsolved.to_string(),
            tally.undecided.to_string(),
            tally.needless.to_string(),
            distance(tally.undecided, tally.largest_undecided),
            tally.wrong_outcomes.to_string(),
            distance(tally.wrong_outcomes, tally.largest_wrong),
            tally.wrong_classes.to_string(),
            e.beyond.to_string(),
            e.far_beyond.to_string(),
            sum(|errors| errors.beyond).to_string(),
            sum(|errors| errors.far_beyond).to_string(),
            sum(|errors| errors.unexplained).to_string(),
            worst.unwrap_or_default(),
        ]);
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
