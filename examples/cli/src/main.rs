//! `cargo microimpact`.

use std::io;
use std::process::ExitCode;

use clap::Parser;
use microimpact_cli::{Arguments, Streams};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let (input, output, errors) = (&mut io::stdin().lock(), &mut io::stdout().lock(), &mut io::stderr());
    ExitCode::from(arguments.run(&mut Streams { input, output, errors }))
}
