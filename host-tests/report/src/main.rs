//! `cargo write-report`.

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match report::run(&report::Options::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
