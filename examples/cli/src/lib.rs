//! The command line of microimpact, as a library that tests can call.

use std::io::{BufRead, Write};

use clap::{ArgAction, Parser, Subcommand};

mod analyse;
mod classify;
mod columns;
mod command;
mod contact_law;
mod critical;
mod figure;
mod fit;
mod inputs;
pub mod joint_fit;
mod law_options;
mod manual;
mod materials;
mod population;
mod progress;
mod restitution_constant;
mod restitution_table;
mod rows;
mod table;
mod template;
mod trajectory;
mod words;

pub use classify::Options as Classify;
pub use command::TableCommand;
pub use critical::Options as Critical;
pub use materials::Options as Materials;
pub use trajectory::Options as Trajectory;

/// Longest line of a help text, characters.
const HELP_WIDTH: usize = 100;

/// Impacts of microspheres on surfaces: classes, trajectories, critical speeds, and what measurements say
#[derive(Parser)]
#[command(
    name = "microimpact",
    version,
    disable_help_flag = true,
    disable_help_subcommand = true,
    max_term_width = HELP_WIDTH,
    after_help = "Example: classify impacts of the paper\n  cargo microimpact classify"
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Print help
    #[arg(short, long, action = ArgAction::HelpShort, global = true)]
    help: Option<bool>,
}

#[derive(Subcommand)]
enum Command {
    Classify(classify::Options),
    Trajectory(trajectory::Options),
    Critical(critical::Options),
    #[command(alias = "boundary")]
    Table(table::Options),
    Analyse(analyse::Options),
    Fit(fit::Options),
    JointFit(joint_fit::Options),
    Population(population::Options),
    Materials(materials::Options),
    Columns(columns::Options),
    Template(template::Options),
    Man(manual::ManOptions),
    Completions(manual::CompletionOptions),
}

/// The streams that a command reads and writes.
pub struct Streams<'a> {
    /// Standard input.
    pub input: &'a mut dyn BufRead,
    /// Standard output.
    pub output: &'a mut dyn Write,
    /// Standard error.
    pub errors: &'a mut dyn Write,
}

impl Arguments {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        match &self.command {
            Command::Classify(options) => options.run(streams),
            Command::Critical(options) => options.run(streams),
            Command::Analyse(options) => options.run(streams),
            Command::Table(options) => options.run(streams),
            Command::Fit(options) => options.run(streams),
            Command::JointFit(options) => options.run(streams),
            Command::Population(options) => options.run(streams),
            Command::Trajectory(options) => options.run(streams),
            Command::Materials(options) => options.run(streams),
            Command::Columns(options) => options.run(streams),
            Command::Template(options) => options.run(streams),
            Command::Man(options) => options.run(streams),
            Command::Completions(options) => options.run(streams),
        }
    }
}
