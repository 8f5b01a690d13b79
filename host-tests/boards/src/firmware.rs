//! The firmware's binaries, built for a board by a cargo of their own.

use std::env;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::Board;
use super::process::{self, Finished};
use super::toolchain::{Toolchain, target_variable};

/// Generous: the first build on a slow machine compiles `core` too.
const LIMIT: Duration = Duration::from_secs(900);

/// Where the firmware is in the repository.
pub const FOLDER: &str = "examples/firmware";

/// Where the templates are in the repository.
const TEMPLATES: &str = "examples/firmware/templates";

/// The place of a law of contact among all of them, for a firmware with this law alone.
const LAW: &str = "MICROIMPACT_LAW";

/// The file with a grid of impacts, for a firmware that runs them.
const GRID: &str = "MICROIMPACT_GRID";

/// The feature of that firmware.
const WORST: &str = "worst";

/// The feature of the probes, which changes nothing in the other binaries.
pub const PROBE: &str = "probe";

/// The repository's top folder.
pub fn repository() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).unwrap_or(package)
}

/// The package of the firmware.
fn firmware() -> PathBuf {
    repository().join(FOLDER)
}

/// Builds binaries of the firmware and returns the folder they are in.
pub fn build(toolchain: &Toolchain, board: &Board, binaries: &[&str]) -> Result<PathBuf, String> {
    build_with(toolchain, board, PROBE, binaries)
}

/// The same, for flash rather than speed.
pub fn build_small(toolchain: &Toolchain, board: &Board, binaries: &[&str]) -> Result<PathBuf, String> {
    build_in(&firmware(), toolchain, board, "small", Some(PROBE), None, binaries)
}

/// The same with one law of contact.
pub fn build_law(toolchain: &Toolchain, board: &Board, place: usize, binaries: &[&str]) -> Result<PathBuf, String> {
    build_in(&firmware(), toolchain, board, "release", Some(PROBE), Some((LAW, place.to_string())), binaries)
}

/// The same with a grid of impacts, which is in a file.
pub fn build_with_grid(
    toolchain: &Toolchain,
    board: &Board,
    grid: &Path,
    binaries: &[&str],
) -> Result<PathBuf, String> {
    let variable = (GRID, grid.display().to_string());
    build_in(&firmware(), toolchain, board, "release", Some(WORST), Some(variable), binaries)
}

/// The same with a feature.
pub fn build_with(toolchain: &Toolchain, board: &Board, feature: &str, binaries: &[&str]) -> Result<PathBuf, String> {
    build_in(&firmware(), toolchain, board, "release", Some(feature), None, binaries)
}

/// Builds a binary of the templates by its feature and returns the folder it is in.
pub fn build_template(toolchain: &Toolchain, board: &Board, feature: &str, binary: &str) -> Result<PathBuf, String> {
    build_in(&repository().join(TEMPLATES), toolchain, board, "release", Some(feature), None, &[binary])
}

/// The same with a setting of the profile, as a variable for cargo.
pub fn build_with_setting(
    toolchain: &Toolchain,
    board: &Board,
    setting: (&str, &str),
    binaries: &[&str],
) -> Result<PathBuf, String> {
    let (name, value) = setting;
    build_in(&firmware(), toolchain, board, "release", Some(PROBE), Some((name, value.to_owned())), binaries)
}

/// Builds binaries that are allowed to fail.
pub fn try_build(toolchain: &Toolchain, board: &Board, binaries: &[&str]) -> Result<Finished, String> {
    run_cargo(&firmware(), toolchain, board, "release", Some(PROBE), None, binaries)
}

/// Builds binaries of a copy of the repository and returns the folder they are in.
pub fn build_copy(toolchain: &Toolchain, board: &Board, copy: &Path, binaries: &[&str]) -> Result<PathBuf, String> {
    build_in(&copy.join(FOLDER), toolchain, board, "release", None, None, binaries)
}

fn build_in(
    package: &Path,
    toolchain: &Toolchain,
    board: &Board,
    profile: &str,
    feature: Option<&str>,
    variable: Option<(&str, String)>,
    binaries: &[&str],
) -> Result<PathBuf, String> {
    let what = format!("{}: building {}", board.core, binaries.join(", "));
    run_cargo(package, toolchain, board, profile, feature, variable, binaries)?.succeeded(&what, 40)?;
    Ok(target_folder(toolchain, board).join(board.triple).join(profile))
}

fn run_cargo(
    package: &Path,
    toolchain: &Toolchain,
    board: &Board,
    profile: &str,
    feature: Option<&str>,
    variable: Option<(&str, String)>,
    binaries: &[&str],
) -> Result<Finished, String> {
    let mut cargo = toolchain.cargo(board.triple);
    cargo.current_dir(package).args(["--profile", profile]);
    cargo.arg("--target-dir").arg(target_folder(toolchain, board));
    if let Some(feature) = feature {
        cargo.args(["--features", feature]);
    }
    if let Some((name, value)) = variable {
        cargo.env(name, value);
    }
    for binary in binaries {
        cargo.args(["--bin", binary]);
    }
    if let Some(cpu) = board.cpu {
        let flags = format!("-C target-cpu={cpu}");
        cargo.env(target_variable(board.triple, "RUSTFLAGS"), flags);
    }
    process::run(&mut cargo, LIMIT).map_err(|error| format!("cannot run cargo: {error}"))
}

/// One for each compiler and processor: targets share a folder without harm, and what
/// is built for the host only once, but two processors of one target would not.
pub fn target_folder(toolchain: &Toolchain, board: &Board) -> PathBuf {
    builds().join("firmware").join(toolchain.folder()).join(board.cpu.unwrap_or("generic"))
}

/// The folder of all builds.
pub fn builds() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| repository().join("target"), PathBuf::from)
}
