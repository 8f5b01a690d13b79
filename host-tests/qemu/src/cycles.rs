//! `cargo qemu cycles`: the cycles of some scenes by a model, the published timings of each core applied to every instruction that
//! QEMU executes.

use std::fs;
use std::path::{Path, PathBuf};

use boards::figures::LARGEST_EXCESS;
use boards::packages::Permission;
use boards::toolchain::{Choice, Toolchain};
use boards::{BOARDS, Board, REFERENCE_CORE, emulator, firmware, symbols};

use timings::{Cycles, Timings};

use crate::report;

mod timings;
mod trace;

const BINARY: &str = "cycles";

/// Names of the build of all cores, and of others on the reference core.
const DEFAULT_BUILD: &str = "opt-level 3, fat LTO";
const FOR_CPU: (&str, &str) = ("target-cpu=cortex-m4", "cortex-m4");
const SETTINGS: [(&str, (&str, &str)); 2] =
    [("opt-level s", ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "s")), ("no LTO", ("CARGO_PROFILE_RELEASE_LTO", "off"))];

/// Clocks in MHz at which cycles are told as microseconds: those of a widespread chip with each core (STM32F0, STM32F1, STM32F4,
/// STM32H7, LPC5500, GD32VF103).
const CLOCKS: [(&str, f64); 6] = [
    ("Cortex-M0", 48.0),
    ("Cortex-M3", 72.0),
    (REFERENCE_CORE, 168.0),
    ("Cortex-M7", 480.0),
    ("Cortex-M33", 150.0),
    ("RV32IMAC", 108.0),
];

/// Cores of which so little is known that the middle between the fewest and the most cycles says nothing.
const WITHOUT_MIDDLE: [&str; 2] = ["Cortex-M7", "RV32IMAC"];

/// What a classification takes.
struct Cost {
    core: &'static str,
    build: &'static str,
    scene: String,
    scalar: String,
    impact: String,
    instructions: u64,
    cycles: Cycles,
}

/// Models the cycles on all cores, and stores them or names each figure that exceeds the stored one of the same compiler.
pub(crate) fn compare(choice: Choice, permission: Permission, overwrite: bool) -> Result<Vec<String>, String> {
    let toolchain = crate::tools(choice, &BOARDS, permission)?;
    let mut costs = Vec::new();
    for board in BOARDS {
        eprintln!("building and following {BINARY} on {} ({}) ...", board.core, board.machine);
        let folder = firmware::build(&toolchain, &board, &[BINARY])?;
        costs.extend(followed(&toolchain, &board, DEFAULT_BUILD, &folder)?);
    }
    for board in BOARDS.into_iter().filter(|board| board.core == REFERENCE_CORE) {
        for (build, setting) in SETTINGS {
            eprintln!("building and following {BINARY} on {}: {build} ...", board.core);
            let folder = firmware::build_with_setting(&toolchain, &board, setting, &[BINARY])?;
            costs.extend(followed(&toolchain, &board, build, &folder)?);
        }
        let (build, cpu) = FOR_CPU;
        eprintln!("building and following {BINARY} on {}: {build} ...", board.core);
        let board = Board { cpu: Some(cpu), ..board };
        let folder = firmware::build(&toolchain, &board, &[BINARY])?;
        costs.extend(followed(&toolchain, &board, build, &folder)?);
    }
    println!("{}", table(&costs));
    if overwrite {
        store(&toolchain.compiler, &costs)?;
        return Ok(Vec::new());
    }
    worse(&toolchain.compiler, &costs)
}

/// Runs a firmware and follows each of its calls.
fn followed(toolchain: &Toolchain, board: &Board, build: &'static str, folder: &Path) -> Result<Vec<Cost>, String> {
    let binary = folder.join(BINARY);
    let lacks = |function: &str| format!("{} has no function {function}", binary.display());
    let function = |name| symbols::function(&binary, &["counter", name]);
    let reading = function("now")?.ok_or_else(|| lacks("now"))?;
    // The loop that the counter is tried with, and what counts the rounds of the timer.
    let mut left_out = vec![function("looping")?.ok_or_else(|| lacks("looping"))?];
    left_out.extend(symbols::function(&binary, &["SysTick"])?);
    left_out.sort_by_key(|function| function.start);

    let log = firmware::target_folder(toolchain, board).join("trace");
    let printed = emulator::trace(board, &binary, &left_out, &log)?;
    let trace = trace::read(&log, &reading)?;
    fs::remove_file(&log).map_err(|error| format!("cannot remove {}: {error}", log.display()))?;

    let timings = Timings::of(board.core)?;
    let lines: Vec<&str> = printed.lines().filter(|line| *line != "done").collect();
    // The calls of the scenes are the last. Those before are the trials of the counter, of whose loop nothing is followed, and a call
    // that does nothing.
    let first = trace.calls.len().checked_sub(lines.len());
    let (trials, calls) = trace.calls.split_at(first.ok_or_else(|| format!("{}: calls are missing", board.core))?);
    let empty = trials.iter().max_by_key(|call| call.len()).map_or(&[][..], Vec::as_slice);
    let nothing = timings.cycles(&trace, empty)?;
    let mut costs = Vec::new();
    for (line, call) in lines.iter().zip(calls) {
        let wrong = || format!("{}: the firmware printed {line:?}", board.core);
        let [scene, scalar, impact, counted] = *Vec::from_iter(line.split(';')) else { return Err(wrong()) };
        let counted: u64 = counted.parse().map_err(|_| wrong())?;
        let instructions = (call.len() - empty.len()) as u64;
        if instructions != counted {
            return Err(format!(
                "{}, {scene}: {instructions} instructions were followed, but {counted} counted",
                board.core
            ));
        }
        let cycles = timings.cycles(&trace, call)? - nothing;
        let [scene, scalar, impact] = [scene, scalar, impact].map(str::to_owned);
        costs.push(Cost { core: board.core, build, scene, scalar, impact, instructions, cycles });
    }
    Ok(costs)
}

/// All costs as text.
fn table(costs: &[Cost]) -> String {
    let mut table = report::new_table();
    table.set_header([
        "scene",
        "core",
        "build",
        "instructions",
        "cycles, least",
        "most",
        "middle",
        "microseconds",
        "at MHz",
    ]);
    report::align_right(&mut table, 3..9);
    for cost in costs {
        let Cost { core, build, scene, instructions, cycles: Cycles { least, most }, .. } = cost;
        let middle = (least + most) / 2.0;
        let middle = if WITHOUT_MIDDLE.contains(core) { String::new() } else { format!("{middle:.0}") };
        let clock = CLOCKS.iter().find(|(known, _)| known == core).map_or(1.0, |(_, clock)| *clock);
        let range = if least == most {
            format!("{:.1}", least / clock)
        } else {
            format!("{:.1} to {:.1}", least / clock, most / clock)
        };
        let numbers = [instructions.to_string(), least.to_string(), most.to_string(), middle, range, clock.to_string()];
        table.add_row([scene, *core, *build].map(str::to_owned).into_iter().chain(numbers));
    }
    format!(
        "{table}\n\nThe cycles are a model, not a measurement: timings from the manuals (host-tests/data/timings.csv) for each executed\n\
         instruction, without wait states, interrupts and bus conflicts. The guide says how far they can be trusted."
    )
}

const HEADER: [&str; 9] =
    ["compiler", "core", "build", "scene", "scalar", "impact", "instructions", "cycles, least", "cycles, most"];

fn path() -> PathBuf {
    firmware::repository().join("host-tests/data/cycles.csv")
}

impl Cost {
    fn record(&self, compiler: &str) -> [String; 9] {
        let Self { core, build, scene, scalar, impact, instructions, cycles } = self;
        let numbers = [instructions.to_string(), cycles.least.to_string(), cycles.most.to_string()];
        let [instructions, least, most] = numbers;
        let [compiler, core, build, scene, scalar, impact] =
            [compiler, core, build, scene, scalar, impact].map(str::to_owned);
        [compiler, core, build, scene, scalar, impact, instructions, least, most]
    }
}

/// Stores the figures in place of those that were there.
fn store(compiler: &str, costs: &[Cost]) -> Result<(), String> {
    let write = || {
        let mut writer = csv::Writer::from_path(path())?;
        writer.write_record(HEADER)?;
        for cost in costs {
            writer.write_record(cost.record(compiler))?;
        }
        writer.flush()?;
        Ok(())
    };
    write().map_err(|error: csv::Error| format!("cannot write {}: {error}", path().display()))
}

/// Every figure that exceeds the stored one, and every scene without one.
fn worse(compiler: &str, costs: &[Cost]) -> Result<Vec<String>, String> {
    let unreadable = |error: csv::Error| format!("cannot read {}: {error}", path().display());
    let mut reader = csv::Reader::from_path(path()).map_err(unreadable)?;
    let records: Vec<_> = reader.records().collect::<Result<_, _>>().map_err(unreadable)?;
    if !records.iter().any(|record| record.get(0) == Some(compiler)) {
        eprintln!(
            "no cycles are stored for {compiler}, so none are compared; `cargo qemu --overwrite cycles` stores them"
        );
        return Ok(Vec::new());
    }
    let mut failures = Vec::new();
    for cost in costs {
        let found = cost.record(compiler);
        let name = found[1..6].join(", ");
        let Some(record) = records.iter().find(|record| record.iter().take(6).eq(&found[..6])) else {
            failures.push(format!("{name}: not stored; `cargo qemu --overwrite cycles` adds it"));
            continue;
        };
        let numbers = [cost.instructions as f64, cost.cycles.least, cost.cycles.most];
        for ((found, what), stored) in numbers.iter().zip(&HEADER[6..]).zip(record.iter().skip(6)) {
            let stored: f64 =
                stored.parse().map_err(|_| format!("{}: {stored:?} is not a number", path().display()))?;
            if *found > stored * (1.0 + LARGEST_EXCESS) {
                failures.push(format!("{name}: {found} {what}, but {stored} are stored"));
            }
        }
    }
    Ok(failures)
}
