//! `cargo qemu c`: the C example of `examples/c`, built by a C compiler against the static library, on an emulated board, and what each
//! function takes there.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use reference::c_results;
use reference::grids::Impact;

use crate::{costs, worst};

use boards::C_BOARD as BOARD;
use boards::emulator;
use boards::firmware;
use boards::packages::{self, Permission};
use boards::process::{self, Finished};
use boards::toolchain::Choice;

const COMPILER: &str = "arm-none-eabi-gcc";
const PACKAGES: [&str; 2] = ["gcc-arm-none-eabi", "libnewlib-arm-none-eabi"];
const LIBRARY: &str = "libmicroimpact_c.a";
/// Part of the name of Rust's panic handler.
const PANIC_HANDLER: &str = "rust_begin_unwind";
const LIMIT: Duration = Duration::from_secs(900);

/// Every line in which the board's results differ from the host's in any bit.
pub(crate) fn compare(choice: Choice, permission: Permission, overwrite: bool) -> Result<Vec<String>, String> {
    let toolchain = crate::tools(choice, &[BOARD], permission)?;
    eprintln!("C compiler: {}", packages::find(COMPILER, &PACKAGES, "", permission)?);
    let sources = firmware::repository().join("examples/c");
    let target = firmware::target_folder(&toolchain, &BOARD).join("c");
    let folder = target.join(BOARD.triple).join("release");

    eprintln!("building for {} ({}) ...", BOARD.core, BOARD.triple);
    for profile in ["dev", "release"] {
        let mut cargo = toolchain.cargo(BOARD.triple);
        cargo.current_dir(&sources).args(["--profile", profile, "--locked", "--target-dir"]).arg(&target);
        done("the static library", process::run(&mut cargo, LIMIT))?;
    }
    panics_are_left_out(&target.join(BOARD.triple))?;
    let [results, costs, grid] = ["results", "costs", "grid.h"].map(|file| folder.join(file));
    fs::write(&grid, rows()).map_err(|error| format!("cannot write {}: {error}", grid.display()))?;
    for (program, executable) in [("results.c", &results), ("costs.c", &costs)] {
        let mut compiler = link(&sources, program, &folder, executable);
        compiler.arg(format!("-DGRID_FILE=\"{}\"", grid.display()));
        done(program, process::run(&mut compiler, LIMIT))?;
    }

    eprintln!("running on {} ({}) ...", BOARD.core, BOARD.machine);
    let printed = emulator::run(&BOARD, &results)?;
    let expected = c_results::expected().map_err(|error| error.to_string())?;
    print!("{printed}");
    let (printed, expected): (Vec<_>, Vec<_>) = (printed.lines().collect(), expected.lines().collect());
    let mut failures = Vec::new();
    if printed.len() != expected.len() {
        failures.push(format!("C printed {} lines instead of {}", printed.len(), expected.len()));
    }
    let differing = printed.iter().zip(&expected).filter(|(printed, expected)| printed != expected);
    failures.extend(differing.map(|(printed, expected)| format!("C: {printed}\nRust: {expected}")));

    eprintln!("counting instructions and stack of every function ...");
    let printed = emulator::run_within(LIMIT, &BOARD, &costs)?;
    print!("{printed}");
    let (page, header) = (sources.join("README.md"), sources.join("include/microimpact.h"));
    failures.extend(costs::compare(&page, &header, &toolchain.compiler, &printed, overwrite)?);
    Ok(failures)
}

/// The shared grid as rows of an array in C.
fn rows() -> String {
    let row = |impact: &Impact| worst::numbers(impact).map(|number| format!("{number:e}f")).join(", ");
    worst::grid().iter().map(|impact| format!("{{{}}},\n", row(impact))).collect()
}

fn link(sources: &Path, program: &str, folder: &Path, executable: &Path) -> Command {
    let mut compiler = Command::new(COMPILER);
    compiler
        .args(["-mcpu=cortex-m3", "-mthumb", "-O2", "-std=c11", "-Wall", "-Wextra", "-Werror"])
        .args(["--specs=rdimon.specs", "-nostartfiles", "-Wl,--gc-sections", "-ffunction-sections"])
        .arg("-T")
        .arg(sources.join("board.ld"))
        .arg("-I")
        .arg(sources.join("include"))
        .args([sources.join("startup.c"), sources.join(program), folder.join(LIBRARY)])
        .arg("-o")
        .arg(executable);
    compiler
}

/// The optimised library has no panic handler, which proves that no function called from C panics; that the other one has it
/// proves the proof.
fn panics_are_left_out(builds: &Path) -> Result<(), String> {
    let has_handler = |build: &str| {
        let path = builds.join(build).join(LIBRARY);
        let library = fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        Ok::<_, String>(library.windows(PANIC_HANDLER.len()).any(|bytes| bytes == PANIC_HANDLER.as_bytes()))
    };
    match (has_handler("debug")?, has_handler("release")?) {
        (true, false) => Ok(()),
        (_, true) => Err("a function of the static library can panic".to_owned()),
        (false, _) => {
            Err(format!("{PANIC_HANDLER} is not the name of the panic handler, so its absence proves nothing"))
        }
    }
}

fn done(what: &str, run: std::io::Result<Finished>) -> Result<(), String> {
    let finished = run.map_err(|error| format!("building {what}: {error}"))?;
    finished.succeeded(&format!("building {what}"), 40).map(drop)
}
