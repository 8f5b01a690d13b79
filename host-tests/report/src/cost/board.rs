//! The entrants on microcontrollers: the firmware `methods`, built and run in the emulator, and its stored figures.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use boards::packages::Permission;
use boards::toolchain::{Choice, Toolchain};
use boards::{BOARDS, Board, REFERENCE_CORE, emulator, firmware};
use reference::case;

use super::host::Exact;
use super::point::{Entrant, Point, Series, Unit};
use crate::content::Run;

const FIRMWARE: &str = "methods";

/// For the slowest board on a busy machine.
const LIMIT: Duration = Duration::from_secs(240);

/// The board on which the code of every core runs that is too large for its own board: it knows all instructions of
/// Cortex-M0, and what is counted is instructions.
const LARGE: (&str, &str) = ("microbit", "mps2-an385");

/// Cores of the comparison.
const CORES: [&str; 4] = ["Cortex-M0", "Cortex-M3", REFERENCE_CORE, "Cortex-M7"];

/// A file for each core with the figures of an earlier run.
const STORED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/methods");

/// A row of such a file: task, method, setting, number type, error, instructions.
type Row = (String, String, String, String, Option<f64>, f64);

/// What the firmware prints: task, method, setting, number type, restitution, tangential velocity, spin, instructions.
type Line = (String, String, String, String, Option<f64>, Option<f64>, Option<f64>, u32);

/// The series of each core.
///
/// # Errors
/// What is missing, or what fails.
pub(super) fn measured(run: &Run) -> Result<Vec<Series>, String> {
    let boards: Vec<Board> = BOARDS.into_iter().filter(|board| CORES.contains(&board.core)).map(large).collect();
    let mut triples: Vec<&str> = boards.iter().map(|board| board.triple).collect();
    triples.dedup();
    let toolchain = Toolchain::find(Choice::Auto, &triples, Permission::LookOnly)?;
    emulator::ARM.find(Permission::LookOnly)?;
    let bar = run.progress(2 * boards.len(), "boards");
    let build = |board| {
        bar.inc(1);
        firmware::build_with(&toolchain, board, "methods", &[FIRMWARE])
    };
    let folders = boards.iter().map(build).collect::<Result<Vec<_>, _>>()?;
    let run_one = |board: &Board, folder: &Path| {
        let output = emulator::run_within(LIMIT, board, &folder.join(FIRMWARE));
        bar.inc(1);
        output
    };
    // Emulated instructions do not depend on what else runs.
    let outputs: Vec<Result<String, String>> = thread::scope(|scope| {
        let threads: Vec<_> =
            boards.iter().zip(&folders).map(|(board, folder)| scope.spawn(|| run_one(board, folder))).collect();
        let panicked = |_| Err("the thread of an emulator panicked".to_owned());
        threads.into_iter().map(|thread| thread.join().unwrap_or_else(panicked)).collect()
    });
    let exact = Exact::of(&case("table1"));
    let series = |(board, output): (&Board, Result<String, String>)| {
        let points = parse(&output?, &exact).map_err(|error| format!("{}: {error}", board.core))?;
        Ok(Series { processor: board.core.to_owned(), unit: Unit::Instructions, points })
    };
    boards.iter().zip(outputs).map(series).collect()
}

fn large(board: Board) -> Board {
    if board.machine == LARGE.0 { Board { machine: LARGE.1, ..board } } else { board }
}

/// Reads the lines that the firmware prints.
fn parse(output: &str, exact: &Exact) -> Result<Vec<Point>, String> {
    let lines = output.strip_suffix("done\n").ok_or("the firmware's output stops before its end")?;
    let mut reader = csv::ReaderBuilder::new().has_headers(false).delimiter(b';').from_reader(lines.as_bytes());
    let points = reader.deserialize().map(|line| {
        let (task, method, setting, scalar, restitution, velocity, spin, instructions): Line =
            line.map_err(|error| format!("a line of the firmware: {error}"))?;
        let surface = velocity.zip(spin).map(|(velocity, spin)| [velocity, spin]);
        Ok(Point {
            error: restitution.and_then(|restitution| exact.error(&scalar, restitution, surface)),
            entrant: Entrant { task, scalar, method, setting },
            cost: f64::from(instructions),
        })
    });
    points.collect()
}

fn file(core: &str) -> PathBuf {
    Path::new(STORED).join(format!("{}.csv", core.to_lowercase()))
}

/// Stores the series of each core.
pub(super) fn store(all: &[Series]) -> Result<(), String> {
    let write = |series: &Series| -> Result<(), csv::Error> {
        fs::create_dir_all(STORED)?;
        let mut writer = csv::Writer::from_path(file(&series.processor))?;
        writer.write_record(["task", "method", "setting", "number type", "error", "instructions"])?;
        for Point { entrant: Entrant { task, scalar, method, setting }, error, cost } in &series.points {
            writer.serialize((task, method, setting, scalar, error, cost))?;
        }
        Ok(writer.flush()?)
    };
    eprintln!("{STORED}");
    all.iter().try_for_each(|series| write(series).map_err(|error| format!("{}: {error}", series.processor)))
}

/// The stored series of each core.
pub(super) fn stored() -> Result<Vec<Series>, String> {
    let point = |row: Row| {
        let (task, method, setting, scalar, error, cost) = row;
        Point { entrant: Entrant { task, scalar, method, setting }, error, cost }
    };
    let read = |core: &str| -> Result<Series, csv::Error> {
        let mut reader = csv::Reader::from_path(file(core))?;
        let points = reader.deserialize().map(|row| row.map(point)).collect::<Result<_, _>>()?;
        Ok(Series { processor: core.to_owned(), unit: Unit::Instructions, points })
    };
    let wrong =
        |core, error| format!("{}: {error}; `cargo write-report --boards` writes it again", file(core).display());
    CORES.map(|core| read(core).map_err(|error| wrong(core, error))).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_core_has_stored_figures_of_us_and_of_peers() {
        for series in stored().unwrap() {
            for method in ["FixedCost", "Adaptive", "numeris"] {
                let of = series.points.iter().filter(|point| point.entrant.method == method);
                let solved = of.filter(|point| point.cost > 0.0 && point.error.is_some_and(|error| error < 1e-5));
                assert!(solved.count() > 2, "{}: {method}", series.processor);
            }
        }
    }
}
