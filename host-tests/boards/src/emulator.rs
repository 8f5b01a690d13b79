//! QEMU, a program for each architecture: found or installed, and a firmware run in it.

use std::ops::Range;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use super::Board;
use super::packages::{self, Permission};
use super::process;

/// The emulator of an architecture.
pub struct Emulator {
    /// Its name as a command.
    pub program: &'static str,
    /// The package that has it on Debian and Ubuntu.
    package: &'static str,
    /// How long an instruction takes in emulated time.
    instruction_time: &'static str,
    /// What else it needs to start a firmware.
    options: &'static [&'static str],
}

/// For Cortex-M.
pub const ARM: Emulator = Emulator {
    program: "qemu-system-arm",
    package: "qemu-system-arm",
    // 2^8 ns: several ticks of the boards' timers (40 to 62.5 ns), so that a tick more or less cannot change a count.
    instruction_time: "shift=8",
    options: &[],
};

/// For RISC-V with 32 bits.
pub const RISCV32: Emulator = Emulator {
    program: "qemu-system-riscv32",
    package: "qemu-system-misc",
    // 1 ns, which is what its register `minstret` counts.
    instruction_time: "shift=0",
    options: &["-bios", "none"],
};

const LIMIT: Duration = Duration::from_secs(60);

impl Emulator {
    /// Its version; it is installed if need be.
    pub fn find(&self, permission: Permission) -> Result<String, String> {
        let Self { program, package, .. } = self;
        let elsewhere = format!(", `dnf install {program}` on Fedora, `brew install qemu` on macOS");
        let version = packages::find(program, &[package], &elsewhere, permission)?;
        Ok(format!("{program}: {version}"))
    }
}

/// Runs a firmware to its end and returns what it printed.
pub fn run(board: &Board, firmware: &Path) -> Result<String, String> {
    run_within(LIMIT, board, firmware)
}

/// The same with a time limit of its own.
pub fn run_within(limit: Duration, board: &Board, firmware: &Path) -> Result<String, String> {
    run_with(&[], limit, board, firmware)
}

/// Runs a firmware to its end and writes to a file what it executes, one instruction after the other and each in words when it is
/// met first; but not what lies in `left_out`, functions in the order of their addresses.
pub fn trace(board: &Board, firmware: &Path, left_out: &[Range<u32>], log: &Path) -> Result<String, String> {
    let starts = [0].into_iter().chain(left_out.iter().map(|function| function.end));
    let ends = left_out.iter().map(|function| function.start).chain([u32::MAX]);
    let ranges: Vec<String> = starts.zip(ends).map(|(start, end)| format!("{start:#x}..{:#x}", end - 1)).collect();
    let one_by_one: &[&str] = match major_version(board.emulator.program) {
        Some(version) if version >= SINGLE_STEPS_ARE_AN_ACCELERATOR => &["-accel", "tcg,one-insn-per-tb=on"],
        _ => &["-singlestep"],
    };
    let (ranges, log) = (ranges.join(","), log.display().to_string());
    let options = [one_by_one, &["-d", "in_asm,exec,nochain", "-dfilter", &ranges, "-D", &log]].concat();
    run_with(&options, LIMIT, board, firmware)
}

/// The version of QEMU from which on single steps are asked for in another way.
const SINGLE_STEPS_ARE_AN_ACCELERATOR: u32 = 9;

/// 7 of `QEMU emulator version 7.2.22 (...)`.
fn major_version(program: &str) -> Option<u32> {
    let line = process::first_line(Command::new(program).arg("--version"))?;
    line.split_once("version ")?.1.split('.').next()?.parse().ok()
}

fn run_with(more: &[&str], limit: Duration, board: &Board, firmware: &Path) -> Result<String, String> {
    let Emulator { program, instruction_time, options, .. } = board.emulator;
    let mut command = Command::new(program);
    command
        .args(["-machine", board.machine])
        .args(["-display", "none", "-monitor", "none", "-serial", "none"])
        .args(["-icount", instruction_time])
        .args(options)
        .args(more)
        .args(["-semihosting-config", "enable=on,target=native"])
        .arg("-kernel")
        .arg(firmware);
    let finished =
        process::run(&mut command, limit).map_err(|error| format!("{}: cannot run {program}: {error}", board.core))?;
    if !finished.success() {
        let ending = match finished.status {
            None => format!("did not end within {} s", limit.as_secs()),
            Some(_) => format!("failed ({})", finished.ending()),
        };
        return Err(format!("{}: the firmware {ending}; it printed:\n{}", board.core, finished.tail(5)));
    }
    Ok(finished.stdout)
}
