//! Which columns the commands read and write, with units, ranges, defaults and meanings.
//!
//! `cargo microimpact columns classify`

use std::error::Error;

use clap::{Args, ValueEnum};
use sheet::catalogue::{COLUMNS, Column};
use sheet::{Header, Input, LABEL, Value};

use crate::Streams;
use crate::classify::{MethodOptions, Model, model_columns};
use crate::command::{Format, exit_status, write_records};
use crate::rows::Work;
use crate::words::name_of;
use crate::{analyse, critical, fit, joint_fit, materials, population, trajectory};

/// List the columns that the commands read and write: unit, range, default and meaning
#[derive(Args)]
#[command(after_help = "\
Example: the columns that classify reads and writes
  cargo microimpact columns classify")]
pub struct Options {
    /// Command whose columns are listed [default: all]
    #[arg(value_enum)]
    command: Option<Tabled>,
    /// Format of the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// A command that reads or writes a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Tabled {
    Classify,
    Trajectory,
    Critical,
    Analyse,
    Fit,
    JointFit,
    Population,
    Materials,
}

/// The columns of a command.
pub struct Used {
    /// Those that it reads.
    pub inputs: Vec<Input>,
    /// Those that it writes besides the columns of its input.
    pub outputs: Vec<String>,
}

impl Used {
    /// The columns of a command that computes rows, from a table with all of its columns.
    pub fn by(work: &impl Work) -> Self {
        let inputs = work.inputs();
        let names: Vec<_> =
            inputs.iter().flat_map(|input| input.columns()).map(|column| (*column).to_owned()).collect();
        let mut outputs = work.columns(&Header::of(&names));
        outputs.push("error".into());
        Self { inputs, outputs }
    }

    /// The columns of a command.
    pub fn of(command: Tabled) -> Self {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        match command {
            Tabled::Classify => {
                let models = [Model::RigidBody, Model::Simulation];
                let mut both = Self { inputs: Vec::new(), outputs: Vec::new() };
                for model in models {
                    let used = model_columns(model, &MethodOptions::default());
                    both.inputs.extend(
                        used.inputs.into_iter().filter(|input| !both.inputs.contains(input)).collect::<Vec<_>>(),
                    );
                    both.outputs.extend(
                        used.outputs.into_iter().filter(|name| !both.outputs.contains(name)).collect::<Vec<_>>(),
                    );
                }
                both.outputs.extend(["models_agree", "models_differ_because"].map(String::from));
                both
            }
            Tabled::Trajectory => Self { inputs: trajectory::inputs(), outputs: owned(&trajectory::COLUMNS) },
            Tabled::Critical => critical::columns(),
            Tabled::Analyse => analyse::columns(),
            Tabled::Fit => Self { inputs: fit::INPUTS.into(), outputs: Vec::new() },
            Tabled::JointFit => Self { inputs: joint_fit::INPUTS.into(), outputs: Vec::new() },
            Tabled::Population => Self {
                inputs: population::inputs(population::Model::value_variants()),
                outputs: owned(&population::COLUMNS),
            },
            Tabled::Materials => Self { inputs: Vec::new(), outputs: owned(&materials::COLUMNS) },
        }
    }
}

/// A column with what the commands do with it.
struct Line {
    column: &'static Column,
    /// What each command that reads it uses where it is absent.
    defaults: Vec<(Tabled, String)>,
    writers: Vec<Tabled>,
}

impl Line {
    fn of(column: &'static Column, commands: &[(Tabled, Used)]) -> Self {
        let mut line = Self { column, defaults: Vec::new(), writers: Vec::new() };
        for (command, Used { inputs, outputs }) in commands {
            if let Some(input) = inputs.iter().find(|input| input.columns().contains(&column.name)) {
                line.defaults.push((*command, default_in_words(input, column.name)));
            } else if column.name == LABEL && !inputs.is_empty() {
                line.defaults.push((*command, "the number of the row".into()));
            }
            if outputs.iter().any(|name| name == column.name) {
                line.writers.push(*command);
            }
        }
        line
    }

    fn is_used(&self) -> bool {
        !self.defaults.is_empty() || !self.writers.is_empty()
    }

    /// The default, or that of each command where they differ.
    fn default(&self) -> String {
        let mut groups: Vec<(Vec<String>, &str)> = Vec::new();
        for (command, default) in &self.defaults {
            match groups.iter_mut().find(|(_, other)| other == default) {
                Some((commands, _)) => commands.push(name_of(command)),
                None => groups.push((vec![name_of(command)], default)),
            }
        }
        match &groups[..] {
            [] => String::new(),
            [(_, default)] => (*default).to_owned(),
            groups => {
                let each = groups.iter().map(|(commands, default)| format!("{}: {default}", commands.join(", ")));
                each.collect::<Vec<_>>().join("; ")
            }
        }
    }

    fn record(&self) -> Vec<Value> {
        let names = |commands: &mut dyn Iterator<Item = Tabled>| {
            commands.map(|command| name_of(&command)).collect::<Vec<_>>().join(", ")
        };
        vec![
            self.column.name.into(),
            self.column.unit.into(),
            self.column.range_in_words().into(),
            self.default().into(),
            names(&mut self.defaults.iter().map(|(command, _)| *command)).into(),
            names(&mut self.writers.iter().copied()).into(),
            self.column.meaning.into(),
        ]
    }
}

/// What is used where a column is absent.
fn default_in_words(input: &Input, column: &str) -> String {
    let others: Vec<_> = input.columns().iter().filter(|other| **other != column).copied().collect();
    match input.default() {
        Some("") => "none".into(),
        Some(default) => default.into(),
        None if others.is_empty() => "required".into(),
        None => format!("required, or {}", others.join(" or ")),
    }
}

const NAMES: [&str; 7] = ["column", "unit", "range", "default", "read_by", "written_by", "meaning"];

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status("columns", self.list(streams).map(|()| 0), streams.errors)
    }

    fn list(&self, streams: &mut Streams<'_>) -> Result<(), Box<dyn Error>> {
        Ok(write_records(self.format, &NAMES, NAMES.len(), records(self.command), streams.output)?)
    }
}

/// A record for each column of a command, or of all.
pub fn records(command: Option<Tabled>) -> impl Iterator<Item = Vec<Value>> {
    let chosen: Vec<_> = command.map_or(Tabled::value_variants().to_vec(), |command| vec![command]);
    let commands: Vec<_> = chosen.into_iter().map(|command| (command, Used::of(command))).collect();
    let lines = COLUMNS.iter().map(move |column| Line::of(column, &commands));
    lines.filter(Line::is_used).map(|line| line.record())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The catalogue has all columns that a command reads or writes, and no others.
    #[test]
    fn the_catalogue_is_complete() {
        let mut used = vec![LABEL.to_owned()];
        for command in Tabled::value_variants() {
            let Used { inputs, outputs } = Used::of(*command);
            used.extend(inputs.iter().flat_map(|input| input.columns()).map(|column| (*column).to_owned()));
            used.extend(outputs);
        }
        for name in &used {
            assert!(Column::named(name).is_some(), "{name} is not in the catalogue");
        }
        for column in COLUMNS {
            assert!(used.iter().any(|name| name == column.name), "{} is used by no command", column.name);
        }
    }
}
