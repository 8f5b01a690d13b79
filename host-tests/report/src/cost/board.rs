//! The entrants on microcontrollers: the firmware `methods`, built and run in the emulator.

use std::path::Path;
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

/// The series of each core, and why others are missing.
pub(super) fn series(run: &Run) -> Result<(Vec<Series>, Vec<String>), String> {
    let cores = if run.quick { &[REFERENCE_CORE][..] } else { &CORES };
    let boards: Vec<Board> = BOARDS.into_iter().filter(|board| cores.contains(&board.core)).map(large).collect();
    let mut triples: Vec<&str> = boards.iter().map(|board| board.triple).collect();
    triples.dedup();
    let toolchain = match Toolchain::find(Choice::Auto, &triples, Permission::LookOnly) {
        Ok(toolchain) => toolchain,
        Err(missing) => return Ok((Vec::new(), vec![missing])),
    };
    if let Err(missing) = emulator::ARM.find(Permission::LookOnly) {
        return Ok((Vec::new(), vec![missing]));
    }
    let bar = run.progress(2 * boards.len(), "boards");
    let mut folders = Vec::new();
    for board in &boards {
        let folder = firmware::target_folder(&toolchain, board).join(board.triple).join("release");
        if run.quick && !folder.join(FIRMWARE).exists() {
            let note = "The quick run omits microcontrollers until a full run has built their firmware.";
            return Ok((Vec::new(), vec![note.to_owned()]));
        }
        folders.push(firmware::build_with(&toolchain, board, "methods", &[FIRMWARE])?);
        bar.inc(1);
    }
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
    let mut all = Vec::new();
    for (board, output) in boards.iter().zip(outputs) {
        let points = parse(&output?, &exact).map_err(|error| format!("{}: {error}", board.core))?;
        all.push(Series { processor: board.core.to_owned(), unit: Unit::Instructions, points });
    }
    Ok((all, Vec::new()))
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

/// Task, method, setting, number type, restitution, tangential velocity, spin, instructions.
type Line = (String, String, String, String, Option<f64>, Option<f64>, Option<f64>, u32);
