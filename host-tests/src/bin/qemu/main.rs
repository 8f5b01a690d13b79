//! `cargo qemu`: builds the firmware of `examples/firmware` for six processor
//! cores, runs it in QEMU, compares every class with the host's, and reports what
//! the library costs: instructions, flash, static memory and stack.

use std::io;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use answers::Protocol;
use host_tests::boards::emulator::Emulator;
use host_tests::boards::figures::{Figure, Quantity, Stored, Subject};
use host_tests::boards::footprint::Footprint;
use host_tests::boards::packages::Permission;
use host_tests::boards::toolchain::{Choice, Toolchain};
use host_tests::boards::{BOARDS, Board, REFERENCE_CORE, emulator, figures, firmware};

mod answers;
mod c;
mod instrument;
mod limits;
mod panics;
mod report;
mod session;

/// Runs the firmware on emulated Cortex-M0, M3, M4F, M7 and M33 and on RISC-V, and
/// reports class and instructions of every classification, flash, static memory, stack,
/// and whether a panicking path is left.
///
/// What is missing is installed where that is possible: targets by rustup, or else
/// Debian's compiler, and QEMU.
#[derive(Parser)]
#[command(name = "cargo qemu", bin_name = "cargo qemu")]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Form of the figures on standard output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Compiler for the boards
    #[arg(long, global = true, value_enum, default_value_t = Choice::Auto)]
    toolchain: Choice,
    /// Store the figures as those that later runs are compared with
    #[arg(long)]
    overwrite: bool,
    /// Install nothing; say what is missing
    #[arg(long, global = true)]
    no_install: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Runs the instrument, sends it events and prints their classes
    Instrument(instrument::Events),
    /// Runs the C example and compares its results with those of Rust
    C,
    /// Puts the instrument on trial: full speed, damaged frames, a full queue and a reset
    Load(instrument::Load),
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Table,
    Csv,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let permission = if arguments.no_install { Permission::LookOnly } else { Permission::Install };
    let result = match &arguments.command {
        None => run(&arguments, permission),
        Some(Command::Instrument(events)) => instrument::classify(events, arguments.toolchain, permission),
        Some(Command::C) => c::compare(arguments.toolchain, permission),
        Some(Command::Load(load)) => instrument::load(load, arguments.toolchain, permission),
    };
    let failures = match result {
        Ok(failures) => failures,
        Err(error) => vec![error],
    };
    if failures.is_empty() {
        eprintln!("all is well");
        return ExitCode::SUCCESS;
    }
    eprintln!("\n{} failed:", failures.len());
    for failure in &failures {
        eprintln!("* {}", failure.replace('\n', "\n  "));
    }
    ExitCode::FAILURE
}

/// Everything that went wrong although the run could go on; `Err` if it could not.
fn run(arguments: &Arguments, permission: Permission) -> Result<Vec<String>, String> {
    let stored = Stored::read(&Stored::path())?;
    let expected = answers::expected()?;
    let (toolchain, emulator) = match tools(arguments.toolchain, &BOARDS, permission) {
        Ok(tools) => tools,
        Err(missing) => return Ok(missing),
    };
    eprintln!("compiler: {}\nemulator: {emulator}", toolchain.compiler);

    let mut failures = Vec::new();
    let mut protocols = Vec::new();
    let mut proved = Vec::new();
    for board in &BOARDS {
        match run_board(&toolchain, board) {
            Ok(protocol) => {
                let differences = protocol.differences(&expected);
                failures.extend(differences.iter().map(|text| format!("{}: {text}", board.core)));
                protocols.push((board, protocol));
            }
            Err(error) => failures.push(error),
        }
        eprintln!("looking for panicking paths on {} ...", board.core);
        let doubts = panics::doubts(&toolchain, board);
        proved.push((board, doubts.is_empty()));
        failures.extend(doubts);
    }
    let mut figures = measured(&protocols);
    match flash(&toolchain) {
        Ok(sizes) => figures.extend(sizes),
        Err(error) => failures.push(error),
    }
    let checked = limits::check(&figures);
    failures.extend(limits::broken(&checked));
    failures.extend(limits::broken_elsewhere(&figures));

    match arguments.format {
        Format::Table => {
            println!("{}", report::classes(&protocols));
            println!("{}", report::footprint(&checked));
            println!("{}", report::panics(&proved));
        }
        Format::Csv => {
            let rows: Vec<(&str, &Figure)> = figures.iter().map(|figure| (&*toolchain.compiler, figure)).collect();
            figures::write(&rows, io::stdout()).map_err(|error| error.to_string())?;
        }
    }

    if !arguments.overwrite {
        failures.extend(compare(&stored, &toolchain, &figures));
    } else if failures.is_empty() {
        stored.overwrite(&toolchain.compiler, &figures, &Stored::path())?;
        eprintln!("stored the figures in {}", Stored::path().display());
    } else {
        eprintln!("the figures are not stored, because of what failed");
    }
    Ok(failures)
}

/// Compiler and emulators, or everything that is missing.
fn tools(choice: Choice, boards: &[Board], permission: Permission) -> Result<(Toolchain, String), Vec<String>> {
    let mut triples: Vec<&str> = boards.iter().map(|board| board.triple).collect();
    triples.dedup();
    let mut emulators: Vec<&Emulator> = boards.iter().map(|board| &board.emulator).collect();
    emulators.dedup_by_key(|emulator| emulator.program);
    let toolchain = Toolchain::find(choice, &triples, permission);
    let (mut versions, mut missing) = (Vec::new(), Vec::new());
    for emulator in emulators {
        match emulator.find(permission) {
            Ok(version) => versions.push(version),
            Err(why) => missing.push(why),
        }
    }
    match toolchain {
        Ok(toolchain) if missing.is_empty() => return Ok((toolchain, versions.join("; "))),
        Ok(_) => {}
        Err(why) => missing.insert(0, why),
    }
    Err(missing)
}

fn run_board(toolchain: &Toolchain, board: &Board) -> Result<Protocol, String> {
    eprintln!("building for {} ({}) ...", board.core, board.triple);
    let folder = firmware::build(toolchain, board, &["classify"])?;
    eprintln!("running on {} ({}) ...", board.core, board.machine);
    let output = emulator::run(board, &folder.join("classify"))?;
    Protocol::parse(&output).map_err(|error| format!("{}: {error}", board.core))
}

/// The figures that the boards printed.
fn measured(protocols: &[(&Board, Protocol)]) -> Vec<Figure> {
    let mut figures = Vec::new();
    for (board, protocol) in protocols {
        for measurement in &protocol.measurements {
            let figure = |quantity, value| Figure {
                subject: Subject {
                    core: board.core.to_owned(),
                    scene: measurement.case.scene.clone(),
                    scalar: measurement.case.scalar.clone(),
                    impact: measurement.case.impact.clone(),
                    quantity,
                },
                value,
            };
            figures.push(figure(Quantity::Classify, measurement.instructions));
            figures.push(figure(Quantity::SetUpAndClassify, measurement.with_set_up));
        }
        for (scene, scalar, bytes) in &protocol.stacks {
            figures.push(Figure {
                subject: Subject {
                    core: board.core.to_owned(),
                    scene: scene.clone(),
                    scalar: scalar.clone(),
                    impact: String::new(),
                    quantity: Quantity::Stack,
                },
                value: *bytes,
            });
        }
    }
    figures
}

/// The firmware that each scene makes larger, on the core of the promises.
const FLASH: [(&str, &str); 8] = [
    ("normal/coefficient", "flash_normal"),
    ("normal/work", "flash_normal_work"),
    ("planar/coefficient", "flash_planar"),
    ("planar/work", "flash_planar_work"),
    ("simulation/fixed-1e-5", "flash_contact_fixed"),
    ("simulation/fixed-oblique-1e-5", "flash_contact_fixed_oblique"),
    ("simulation/normal", "flash_contact_normal"),
    ("simulation/oblique", "flash_contact_oblique"),
];

/// The same, built for flash rather than speed.
const SMALL_FLASH: [(&str, &str); 2] =
    [("small/fixed-1e-5", "flash_contact_fixed"), ("small/fixed-oblique-1e-5", "flash_contact_fixed_oblique")];

fn flash(toolchain: &Toolchain) -> Result<Vec<Figure>, String> {
    let mut figures = Vec::new();
    for board in BOARDS.iter().filter(|board| board.core == REFERENCE_CORE) {
        let binaries = |scenes: &[(&'static str, &'static str)]| {
            let mut binaries = vec!["flash_empty"];
            binaries.extend(scenes.iter().map(|(_, binary)| *binary));
            binaries
        };
        let fast = firmware::build(toolchain, board, &binaries(&FLASH))?;
        let small = firmware::build_small(toolchain, board, &binaries(&SMALL_FLASH))?;
        for (folder, scenes) in [(fast, &FLASH[..]), (small, &SMALL_FLASH[..])] {
            let empty = Footprint::of(&folder.join("flash_empty"))?;
            for (scene, binary) in scenes {
                let added = Footprint::of(&folder.join(binary))?.minus(empty);
                let figure = |quantity, value| Figure {
                    subject: Subject {
                        core: board.core.to_owned(),
                        scene: (*scene).to_owned(),
                        scalar: "f32".to_owned(),
                        impact: String::new(),
                        quantity,
                    },
                    value,
                };
                figures.push(figure(Quantity::Flash, added.flash));
                figures.push(figure(Quantity::StaticMemory, added.static_memory));
            }
        }
    }
    Ok(figures)
}

/// What became worse since the figures were stored.
fn compare(stored: &Stored, toolchain: &Toolchain, figures: &[Figure]) -> Vec<String> {
    let comparison = stored.compare(&toolchain.compiler, figures);
    if comparison.stored == 0 {
        eprintln!(
            "no figures are stored for {}, so nothing is compared; `cargo qemu --overwrite` stores them",
            toolchain.compiler
        );
    } else if comparison.unknown > 0 {
        eprintln!("figures not stored yet: {}; `cargo qemu --overwrite` stores them", comparison.unknown);
    }
    comparison.worse
}
