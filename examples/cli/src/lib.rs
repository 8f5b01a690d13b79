//! The command line of microimpact, as a library that tests can call.

use std::io::{BufRead, Write};

use clap::{Parser, Subcommand};
use command::TableCommand;

mod analyse;
mod classify;
mod command;
mod contact_law;
mod critical;
mod figure;
mod fit;
mod inputs;
pub mod joint_fit;
mod population;
mod progress;
mod rows;
mod table;
mod words;

/// Impacts of microspheres: classes, critical speeds, analyses of measurements, tables for firmware, fits, and
/// populations.
#[derive(Parser)]
#[command(name = "microimpact", version)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Classify(classify::Options),
    Critical(critical::Options),
    Analyse(analyse::Options),
    #[command(alias = "boundary")]
    Table(table::Options),
    Fit(fit::Options),
    JointFit(joint_fit::Options),
    Population(population::Options),
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
        }
    }
}
