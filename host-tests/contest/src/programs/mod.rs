//! Solvers in other languages, where they are installed.

mod pipe;

use std::path::Path;
use std::process::{Command, Stdio};

pub use pipe::Program;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/peers");
/// Where programs are built.
const BUILT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/peers");

/// Those that are installed, and of every other the reason and how to install it.
pub fn installed() -> (Vec<Program>, Vec<String>) {
    let (mut programs, mut absent) = (Vec::new(), Vec::new());
    for program in [odeint(), heyoka()] {
        match program {
            Ok(program) => programs.push(program),
            Err(reason) => absent.push(reason),
        }
    }
    (programs, absent)
}

/// Boost.odeint, built for this processor.
fn odeint() -> Result<Program, String> {
    let program = Path::new(BUILT).join("odeint");
    std::fs::create_dir_all(BUILT).map_err(|error| format!("odeint: {BUILT} cannot be made: {error}"))?;
    let mut compiler = Command::new("c++");
    compiler.args(["-std=c++17", "-O3", "-march=native", "odeint.cpp", "-o"]).arg(&program).current_dir(FOLDER);
    if !succeeds(&mut compiler) {
        let install = "apt-get install g++ libboost-dev";
        return Err(format!("odeint takes no part: no C++ compiler with Boost's headers; install them: {install}"));
    }
    Program::start("odeint", &mut Command::new(program))
}

/// The Python package heyoka.
fn heyoka() -> Result<Program, String> {
    if !succeeds(Command::new("python3").args(["-c", "import heyoka"])) {
        let install = "python3 -m pip install heyoka";
        return Err(format!("heyoka takes no part: python3 does not have the package; install it: {install}"));
    }
    Program::start("heyoka", Command::new("python3").arg("heyoka_peer.py").current_dir(FOLDER))
}

fn succeeds(command: &mut Command) -> bool {
    command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|status| status.success())
}
