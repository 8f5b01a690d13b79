//! `cargo targets`: the features with which the library compiles for each target, as a table that the documentation contains, and
//! the lowest versions of its dependencies.

use std::process::ExitCode;

use boards::firmware::{self, FOLDER};
use boards::packages::Permission;
use boards::section::Section;
use clap::{Parser, Subcommand};

mod check;
mod lowest;
mod table;

/// Checks the library for each target with each feature, prints a table, and fails where the README of examples/firmware has another.
///
/// What is missing is installed by rustup. Targets for which no compiler can be had are named and not compared.
#[derive(Parser)]
#[command(name = "cargo targets", bin_name = "cargo targets")]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Store the table in the README of examples/firmware
    #[arg(long)]
    overwrite: bool,
    /// Install nothing; say what is missing
    #[arg(long, global = true)]
    no_install: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Compiles the library with the lowest versions of its dependencies that Cargo.toml allows
    Lowest,
}

/// The command that writes the table.
const WRITER: &str = "cargo targets --overwrite";

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let permission = if arguments.no_install { Permission::LookOnly } else { Permission::Install };
    let result = match arguments.command {
        None => compare(permission, arguments.overwrite),
        Some(Command::Lowest) => lowest::check(permission),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the table, and stores it or compares it with the stored one.
fn compare(permission: Permission, overwrite: bool) -> Result<(), String> {
    let page = firmware::repository().join(FOLDER).join("README.md");
    let section = Section::read(&page, WRITER)?;
    let rows = check::rows(permission)?;
    let table = table::table(&rows, &section.text);
    println!("{table}");
    if overwrite {
        return section.overwrite(&table);
    }
    if table == section.text {
        return Ok(());
    }
    let differing = table::differing(&table, &section.text).join("\n");
    Err(format!("{} has another table; `{WRITER}` stores this one. Only one has\n{differing}", page.display()))
}
