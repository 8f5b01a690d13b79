//! `cargo qemu`: builds the firmware of `examples/firmware` for one processor core or all six, runs it in QEMU, compares
//! every class with the host's, and reports what the library costs: instructions, flash, static memory and stack.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::builder::PossibleValuesParser;
use clap::{Parser, Subcommand, ValueEnum};

use answers::{Case, Code, Expected, Protocol};
use boards::emulator::Emulator;
use boards::figures::{Figure, Quantity, Stored, Subject};
use boards::footprint::Footprint;
use boards::packages::Permission;
use boards::reachable::Pieces;
use boards::toolchain::{Choice, Toolchain};
use boards::{BOARDS, Board, REFERENCE_CORE, absent, emulator, figures, firmware};

mod answers;
mod c;
mod calibrate;
mod costs;
mod counts;
mod cycles;
mod instrument;
mod limits;
mod panics;
mod report;
mod session;
mod templates;
mod worst;

/// Runs the firmware on an emulated Cortex-M4F, or on Cortex-M0, M3, M4F, M7, M33 and RISC-V, and
/// says whether every class is the host's, what a classification takes at most, and whether a panicking
/// path is left; --details prints all figures.
///
/// What is missing is installed where that is possible: targets by rustup, or else
/// Debian's compiler, and QEMU.
#[derive(Parser)]
#[command(name = "cargo qemu", bin_name = "cargo qemu")]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Core to run on
    #[arg(long, value_name = "NAME", default_value = REFERENCE_CORE, value_parser = PossibleValuesParser::new(BOARDS.map(|board| board.core)))]
    core: String,
    /// Run on all cores
    #[arg(long, conflicts_with = "core")]
    all_cores: bool,
    /// The largest figures of each scene, number type and core in one row: instructions, flash, stack, static memory and error;
    /// panicking paths are not looked for
    #[arg(long)]
    counts: bool,
    /// Every figure after the verdict: each impact's class and instructions, each scene's flash, stack and static memory
    #[arg(long)]
    details: bool,
    /// Form of the figures on standard output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Compiler for the boards
    #[arg(long, global = true, value_enum, default_value_t = Choice::Auto)]
    toolchain: Choice,
    /// Run on all cores and store the figures as those that later runs are compared with
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
    /// Runs the C example, compares its results with those of Rust, and counts what every function takes
    C,
    /// Puts the instrument on trial: full speed, damaged frames, a full queue and a reset
    Load(instrument::Load),
    /// Runs the templates, without a framework, within RTIC, within Embassy and on RISC-V, and compares their counts with the host's
    Templates,
    /// Runs every method over a grid of impacts, and says what each takes at most, in instructions and in stack
    Worst,
    /// Models the cycles of some scenes on all cores, from the manuals' timings of every executed instruction
    Cycles,
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
        Some(Command::C) => c::compare(arguments.toolchain, permission, arguments.overwrite),
        Some(Command::Worst) => worst::compare(arguments.toolchain, permission, arguments.overwrite),
        Some(Command::Cycles) => cycles::compare(arguments.toolchain, permission, arguments.overwrite),
        Some(Command::Templates) => templates::compare(arguments.toolchain, permission),
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
    let calibrated = calibrate::expected()?;
    let is_chosen = |board: &Board| arguments.all_cores || arguments.overwrite || board.core == arguments.core;
    let boards: Vec<Board> = BOARDS.into_iter().filter(is_chosen).collect();
    let toolchain = tools(arguments.toolchain, &boards, permission)?;

    let mut failures = Vec::new();
    let mut protocols = Vec::new();
    let mut figures = Vec::new();
    let mut proved = Vec::new();
    for board in &boards {
        let expected = answers::expected(measures_laws(board))?;
        match run_board(&toolchain, board) {
            Ok((protocol, code)) => {
                let differences = protocol.differences(&expected);
                failures.extend(differences.iter().map(|text| format!("{}: {text}", board.core)));
                figures.extend(measured(board, &protocol, &expected));
                figures.extend(code);
                protocols.push((board, protocol));
            }
            Err(error) => failures.push(error),
        }
        match run_calibrations(&toolchain, board) {
            Ok((protocol, code)) => {
                let differences = protocol.differences(&calibrated);
                failures.extend(differences.iter().map(|text| format!("{}: {text}", board.core)));
                figures.extend(protocol.figures(board));
                figures.extend(code);
            }
            Err(error) => failures.push(error),
        }
        if !arguments.counts {
            eprintln!("looking for panicking paths on {} ...", board.core);
            let doubts = panics::doubts(&toolchain, board);
            proved.push((board, doubts.is_empty()));
            failures.extend(doubts);
        }
    }
    for board in boards.iter().filter(|board| absent::CORES.contains(&board.core)) {
        eprintln!("looking for bytes of absent terms on {} ...", board.core);
        match absent::differing(&toolchain, board) {
            Ok(bytes) => figures.extend(absent::PROOFS.iter().zip(bytes).map(|(proof, bytes)| {
                of_scene(board, proof.scene, limits::SCALAR, Quantity::AbsentTerms, bytes.into())
            })),
            Err(error) => failures.push(error),
        }
    }
    for board in boards.iter().filter(|board| board.core == REFERENCE_CORE) {
        match flash(&toolchain, board) {
            Ok(sizes) => figures.extend(sizes),
            Err(error) => failures.push(error),
        }
    }
    let checked = limits::check(&figures);
    failures.extend(limits::broken(&checked));
    failures.extend(limits::broken_elsewhere(&figures));
    failures.extend(limits::doubtful_bytes(&figures));

    match arguments.format {
        Format::Table if arguments.counts => {
            println!("{}", counts::table(&figures));
            println!("{}", counts::absent_terms(&figures));
        }
        Format::Csv if arguments.counts => counts::write(&toolchain.compiler, &figures, io::stdout())?,
        Format::Table => {
            print!("{}", report::verdict(&protocols, &checked, &figures, &proved));
            if arguments.details {
                println!("\n{}", report::classes(&protocols));
                println!("{}", report::footprint(&checked));
                println!("{}", counts::absent_terms(&figures));
                println!("{}", report::panics(&proved));
            }
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

/// The compiler, once it and the emulators are there; else everything that is missing.
fn tools(choice: Choice, boards: &[Board], permission: Permission) -> Result<Toolchain, String> {
    let mut triples: Vec<&str> = boards.iter().map(|board| board.triple).collect();
    triples.dedup();
    let mut emulators: Vec<&Emulator> = boards.iter().map(|board| &board.emulator).collect();
    emulators.dedup_by_key(|emulator| emulator.program);
    let (mut versions, mut missing) = (Vec::new(), Vec::new());
    let toolchain = Toolchain::find(choice, &triples, permission).map_err(|why| missing.push(why));
    for emulator in emulators {
        match emulator.find(permission) {
            Ok(version) => versions.push(version),
            Err(why) => missing.push(why),
        }
    }
    let toolchain = toolchain.ok().filter(|_| missing.is_empty()).ok_or_else(|| missing.join("\n"))?;
    eprintln!("compiler: {}\nemulator: {}", toolchain.compiler, versions.join("; "));
    Ok(toolchain)
}

/// The binaries that measure; together they hold more than the smallest board does.
const MEASURING: [&str; 8] = [
    "classify",
    "contacts",
    "double_contacts",
    "fixed_contacts",
    "variants",
    "collocations",
    "recordings",
    "functions",
];

/// What the firmware says on a board, and what each scene needs of it.
fn run_board(toolchain: &Toolchain, board: &Board) -> Result<(Protocol, Vec<Figure>), String> {
    let (mut all, mut figures) = (Protocol::default(), Vec::new());
    let folder = built(toolchain, board, firmware::PROBE, &MEASURING)?;
    for binary in MEASURING {
        figures.extend(run_binary(board, &folder.join(binary), &mut all)?);
    }
    if measures_laws(board) {
        eprintln!("building and running each law of contact on {} ...", board.core);
        for (place, law) in answers::laws().enumerate() {
            let folder = firmware::build_law(toolchain, board, place, &["law", "flash_law", "flash_empty"])?;
            figures.extend(run_binary(board, &folder.join("law"), &mut all)?);
            let flash = |binary| Footprint::of(&folder.join(binary));
            let added = flash("flash_law")?.minus(flash("flash_empty")?);
            figures.push(of_scene(board, law, limits::SCALAR, Quantity::Flash, added.flash.into()));
        }
    }
    Ok((all, figures))
}

/// Whether a board measures all laws of contact, each in a firmware of its own.
fn measures_laws(board: &Board) -> bool {
    board.core == REFERENCE_CORE
}

/// Adds what a binary says to a protocol, and returns what each of its scenes needs.
fn run_binary(board: &Board, firmware: &Path, all: &mut Protocol) -> Result<Vec<Figure>, String> {
    let protocol = Protocol::parse(&emulator::run(board, firmware)?)
        .map_err(|error| format!("{}, {}: {error}", board.core, firmware.display()))?;
    let figures = needs(board, firmware, &protocol.code)?;
    all.append(protocol);
    Ok(figures)
}

/// The binaries that calibrate.
const CALIBRATING: [&str; 2] = ["calibrate", "double_calibrate"];

/// The same of calibrations.
fn run_calibrations(toolchain: &Toolchain, board: &Board) -> Result<(calibrate::Protocol, Vec<Figure>), String> {
    let folder = built(toolchain, board, firmware::PROBE, &CALIBRATING)?;
    let (mut all, mut figures) = (calibrate::Protocol::default(), Vec::new());
    for binary in CALIBRATING {
        let firmware = folder.join(binary);
        let protocol = calibrate::Protocol::parse(&emulator::run(board, &firmware)?)
            .map_err(|error| format!("{}, {binary}: {error}", board.core))?;
        figures.extend(needs(board, &firmware, &protocol.code)?);
        all.append(protocol);
    }
    Ok((all, figures))
}

/// The folder in which binaries for a board are, which then run.
fn built(toolchain: &Toolchain, board: &Board, feature: &str, binaries: &[&str]) -> Result<PathBuf, String> {
    eprintln!("building {} for {} ({}) ...", binaries.join(", "), board.core, board.triple);
    let folder = firmware::build_with(toolchain, board, feature, binaries)?;
    eprintln!("running on {} ({}) ...", board.core, board.machine);
    Ok(folder)
}

/// What the functions need whose addresses a firmware has printed.
fn needs(board: &Board, firmware: &Path, code: &[Code]) -> Result<Vec<Figure>, String> {
    let pieces = Pieces::of(firmware)?;
    let mut figures = Vec::new();
    for Code { scene, scalar, function } in code {
        let needed = pieces.needed_by(*function)?;
        figures.push(of_scene(board, scene, scalar, Quantity::Code, needed.flash.into()));
        figures.push(of_scene(board, scene, scalar, Quantity::StaticMemory, needed.static_memory.into()));
    }
    Ok(figures)
}

/// The figures that a board printed.
fn measured(board: &Board, protocol: &Protocol, expected: &BTreeMap<Case, Expected>) -> Vec<Figure> {
    let mut figures = Vec::new();
    for measurement in &protocol.measurements {
        let Case { scene, scalar, impact } = &measurement.case;
        let counts =
            [(Quantity::Classify, measurement.instructions), (Quantity::SetUpAndClassify, measurement.with_set_up)];
        for (quantity, count) in counts {
            let mut figure = of_scene(board, scene, scalar, quantity, count.into());
            figure.subject.impact.clone_from(impact);
            figures.push(figure);
        }
    }
    for (scene, scalar, bytes) in &protocol.stacks {
        figures.push(of_scene(board, scene, scalar, Quantity::Stack, (*bytes).into()));
    }
    for (scene, scalar, error) in protocol.errors(expected) {
        figures.push(of_scene(board, &scene, &scalar, Quantity::Error, error));
    }
    figures
}

/// A figure of a whole scene.
fn of_scene(board: &Board, scene: &str, scalar: &str, quantity: Quantity, value: f64) -> Figure {
    let (core, scene, scalar) = (board.core.to_owned(), scene.to_owned(), scalar.to_owned());
    Figure { subject: Subject { core, scene, scalar, impact: String::new(), quantity }, value }
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

fn flash(toolchain: &Toolchain, board: &Board) -> Result<Vec<Figure>, String> {
    let mut figures = Vec::new();
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
            figures.push(of_scene(board, scene, limits::SCALAR, Quantity::Flash, added.flash.into()));
            if limits::is_small(scene) {
                let variables = added.static_memory.into();
                figures.push(of_scene(board, scene, limits::SCALAR, Quantity::StaticMemory, variables));
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
