//! Tests of tables and programs: the command line, the report, the C interface, and what the documentation states.

mod analyse;
mod boundary;
mod c_interface;
mod c_link;
mod classify;
mod commands;
mod contract;
mod critical;
mod documentation;
mod exporters;
mod fit;
mod formats;
mod guide;
mod joint_fit;
mod laws;
mod methods;
mod mistakes;
mod population;
mod report;
mod report_cost;
mod space;
mod steps;
mod tables;
mod templates;
mod uncertain;
mod without;

use clap::Parser;
use microimpact_cli::{Arguments, Streams};

/// What a run of the command line wrote, and its exit status.
struct Output {
    status: u8,
    stdout: Vec<u8>,
    stderr: Vec<u8>,
}

impl Output {
    fn complaint(&self) -> String {
        String::from_utf8_lossy(&self.stderr).into_owned()
    }
}

/// Runs a command of `microimpact` with arguments and standard input.
fn microimpact(command: &str, arguments: &[&str], mut input: &[u8]) -> Output {
    let words = ["microimpact", command].into_iter().chain(arguments.iter().copied());
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(error) => {
            return Output { status: error.exit_code() as u8, stdout: Vec::new(), stderr: error.to_string().into() };
        }
    };
    let (mut stdout, mut stderr) = (Vec::new(), Vec::new());
    let status = arguments.run(&mut Streams { input: &mut input, output: &mut stdout, errors: &mut stderr });
    Output { status, stdout, stderr }
}
