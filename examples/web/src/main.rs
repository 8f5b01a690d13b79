//! `cargo web`: makes the web page that classifies impacts in the browser; `cargo web --check` tests it in Chromium.

mod browser;
mod check;
mod page;
mod screenshots;

use std::path::Path;
use std::process::ExitCode;

use boards::firmware::repository;
use boards::packages::Permission;
use clap::Parser;

/// Makes `target/web/microimpact.html`: one file that loads nothing else, and opens from disk or from any server.
///
/// The target wasm32-wasip1 is installed by rustup if it is missing.
#[derive(Parser)]
#[command(name = "cargo web", bin_name = "cargo web")]
struct Arguments {
    /// Test the page in Chromium, and write screenshots beside it
    #[arg(long)]
    check: bool,
    /// Install nothing; say what is missing
    #[arg(long)]
    no_install: bool,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let permission = if arguments.no_install { Permission::LookOnly } else { Permission::Install };
    let folder = repository().join("target/web");
    let file = folder.join("microimpact.html");
    let sizes = page::build(&folder, &file, permission)?;
    println!("{}: {sizes}", in_repository(&file));
    if arguments.check {
        sizes.check()?;
        check::page(&file, permission)?;
        println!("the page gives the answers of the program; its screenshots are in {}", in_repository(&folder));
    }
    Ok(())
}

/// A path as it is seen from the repository.
fn in_repository(path: &Path) -> String {
    path.strip_prefix(repository()).unwrap_or(path).display().to_string()
}
