//! The commands that the web page runs, as a program for WebAssembly.
//!
//! `classify`, `critical`, `trajectory` and `materials` are those of `cargo microimpact`, with the same options, so that the page gives the same answers.
//! The others tell the page about the table on standard input.

mod table;

use std::io;
use std::process::ExitCode;

use clap::Parser;
use microimpact_cli::{Classify, Critical, Materials, Streams, TableCommand, Trajectory};

#[derive(Parser)]
#[command(name = "microimpact")]
enum Command {
    Classify(Classify),
    Critical(Critical),
    Trajectory(Trajectory),
    Materials(Materials),
    /// Writes the headings of the table and the columns that they name as JSON.
    Columns,
    /// Copies the table with other headings for some columns.
    Rename {
        /// Headings of the table and those to write instead, by turns; a column with an empty one is not read.
        names: Vec<String>,
    },
    /// Copies the table with further columns, which hold the same in all rows.
    Complete {
        /// Headings of these columns and what they hold, by turns.
        columns: Vec<String>,
    },
    /// Copies the table with other headings for its first columns.
    Restore {
        /// The headings in their order.
        headings: Vec<String>,
    },
    /// Writes what a classified table holds as JSON: the numbers of rows and of bad rows, how often each class occurs, and the
    /// first rows.
    Summary {
        /// How many rows to show.
        #[arg(long, default_value_t = 20)]
        first: usize,
    },
}

fn main() -> ExitCode {
    let (input, output, errors) = (&mut io::stdin().lock(), &mut io::stdout().lock(), &mut io::stderr());
    let streams = &mut Streams { input, output, errors };
    let pairs =
        |texts: &[String]| texts.chunks_exact(2).map(|two| (two[0].clone(), two[1].clone())).collect::<Vec<_>>();
    let done = match Command::parse() {
        Command::Classify(options) => return ExitCode::from(options.run(streams)),
        Command::Critical(options) => return ExitCode::from(options.run(streams)),
        Command::Trajectory(options) => return ExitCode::from(options.run(streams)),
        Command::Materials(options) => return ExitCode::from(options.run(streams)),
        Command::Columns => table::columns(streams),
        Command::Rename { names } => sheet::rename(&mut *streams.input, &pairs(&names), &mut *streams.output),
        Command::Complete { columns } => sheet::complete(&mut *streams.input, &pairs(&columns), &mut *streams.output),
        Command::Restore { headings } => sheet::restore(&mut *streams.input, &headings, &mut *streams.output),
        Command::Summary { first } => table::summary(first, streams),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::from(2)
        }
    }
}
