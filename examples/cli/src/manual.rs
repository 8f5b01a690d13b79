//! The manual page and the completions of shells.
//!
//! `cargo microimpact man classify | man -l -`; `cargo microimpact completions bash`

use std::io;

use clap::{Args, CommandFactory, ValueEnum};
use clap_complete::Shell;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};
use sheet::{Decimal, Value};

use crate::columns::{Tabled, records};
use crate::command::exit_status;
use crate::{Arguments, Streams};

/// Write the manual page of the program or of a command
#[derive(Args)]
#[command(after_help = "\
Example: the manual of classify on the screen
  cargo microimpact man classify | man -l -")]
pub struct ManOptions {
    /// Command [default: the program]
    command: Option<String>,
}

/// Write the completions of a shell
#[derive(Args)]
#[command(after_help = "\
Example: for bash, in ~/.bashrc
  source <(microimpact completions bash)")]
pub struct CompletionOptions {
    /// Shell
    #[arg(value_enum)]
    shell: Shell,
}

/// The program's name, by which it is installed.
const PROGRAM: &str = "microimpact";

impl ManOptions {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        let page = self.page().and_then(|page| Ok(streams.output.write_all(&page)?));
        exit_status("man", page.map(|()| 0), streams.errors)
    }

    fn page(&self) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
        let mut program = Arguments::command();
        program.build();
        let command = match &self.command {
            None => program,
            Some(name) => {
                let names: Vec<_> = program.get_subcommands().map(|command| command.get_name().to_owned()).collect();
                let found = program.find_subcommand(name).cloned();
                found.ok_or_else(|| format!("no command \"{name}\"; choose one of {}", names.join(", ")))?
            }
        };
        let mut page = Vec::new();
        let tabled = Tabled::from_str(command.get_name(), false).ok();
        Man::new(command).render(&mut page)?;
        if let Some(tabled) = tabled {
            columns(tabled, &mut page)?;
        }
        Ok(page)
    }
}

/// Appends the section of the columns of a command.
fn columns(command: Tabled, page: &mut Vec<u8>) -> io::Result<()> {
    let mut section = Roff::default();
    section.control("SH", ["COLUMNS"]);
    for record in records(Some(command)) {
        let [name, unit, range, default, read, _, meaning] =
            <[Value; 7]>::try_from(record).unwrap_or_default().map(|value| value.text(Decimal::Point));
        let unit = if matches!(unit.as_str(), "" | "1") { String::new() } else { format!(" {unit}") };
        let default = if read.is_empty() { "computed".to_owned() } else { format!("absent: {default}") };
        section.control("TP", []);
        section.text([bold(name)]);
        section.text([roman(format!("{meaning}; {range}{unit}; {default}"))]);
    }
    section.to_writer(page)
}

impl CompletionOptions {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), PROGRAM, &mut script);
        exit_status("completions", streams.output.write_all(&script).map(|()| 0).map_err(Into::into), streams.errors)
    }
}
