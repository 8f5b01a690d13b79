//! Writes a table to fill in: the header of a command and a row that it can compute.
//!
//! `cargo microimpact template classify --model simulation > impacts.csv`

use std::error::Error;

use clap::Args;
use sheet::catalogue::Column;
use sheet::{Decimal, Input, LABEL};

use crate::Streams;
use crate::classify::{MethodOptions, Model, model_columns};
use crate::columns::{Tabled, Used};
use crate::command::exit_status;
use crate::population;
use crate::words::name_of;

/// Write a CSV table to fill in: the header of a command, and a row that it can compute
#[derive(Args)]
#[command(after_help = "\
Example: an impact to simulate, in a file for a spreadsheet
  cargo microimpact template classify --model simulation")]
pub struct Options {
    /// Command that will read the table
    #[arg(value_enum, default_value_t = Tabled::Classify)]
    command: Tabled,
    /// Model of classify or population that will read it [default: as that of the command]
    #[arg(long, value_enum)]
    model: Option<Model>,
    /// Decimal mark; a comma makes semicolons separate the cells
    #[arg(long, value_enum, default_value_t = Decimal::Point)]
    decimal: Decimal,
}

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status("template", self.write(streams).map(|()| 0), streams.errors)
    }

    fn inputs(&self) -> Result<Vec<Input>, String> {
        match (self.command, self.model) {
            (Tabled::Classify, model) => {
                Ok(model_columns(model.unwrap_or(Model::RigidBody), &MethodOptions::default()).inputs)
            }
            (Tabled::Population, None | Some(Model::Simulation)) => {
                Ok(population::inputs(&[population::Model::Simulation]))
            }
            (Tabled::Population, Some(Model::RigidBody)) => Ok(population::inputs(&[population::Model::RigidBody])),
            (command, None) => Ok(Used::of(command).inputs),
            (command, Some(model)) => {
                Err(format!("--model {} does not apply to {}", name_of(&model), name_of(&command)))
            }
        }
    }

    fn write(&self, streams: &mut Streams<'_>) -> Result<(), Box<dyn Error>> {
        let inputs = self.inputs()?;
        if inputs.is_empty() {
            return Err("this command reads no table".into());
        }
        // Of several columns that give the same number, the first; not what only some tables have.
        let stated = inputs.iter().filter(|input| input.default() != Some("") && !input.is_conditional());
        let names = [LABEL].into_iter().chain(stated.filter_map(|input| input.columns().first().copied()));
        let columns: Vec<_> = names.filter_map(Column::named).collect();
        let delimiter = if self.decimal == Decimal::Comma { b';' } else { b',' };
        let mut rows = csv::WriterBuilder::new().delimiter(delimiter).from_writer(&mut *streams.output);
        rows.write_record(columns.iter().map(|column| column.name))?;
        rows.write_record(columns.iter().map(|column| {
            let is_number = self.decimal == Decimal::Comma && !column.unit.is_empty();
            if is_number { column.example.replace('.', ",") } else { column.example.to_owned() }
        }))?;
        rows.flush()?;
        Ok(())
    }
}
