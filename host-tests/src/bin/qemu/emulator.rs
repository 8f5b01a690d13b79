//! QEMU: found or installed, and a firmware run in it.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crate::boards::Board;
use crate::packages::{self, Permission};
use crate::process;

pub(crate) const QEMU: &str = "qemu-system-arm";
/// An instruction takes 2^8 ns of emulated time: several ticks of the boards' timers
/// (40 and 62.5 ns), so that a tick more or less cannot change a count.
const INSTRUCTION_TIME: &str = "shift=8";
const LIMIT: Duration = Duration::from_secs(60);

/// The emulator's version; it is installed if need be.
pub(crate) fn find(permission: Permission) -> Result<String, String> {
    if let Some(version) = version() {
        return Ok(version);
    }
    packages::install(&[QEMU], permission).map_err(|why| {
        format!(
            "no {QEMU}; install QEMU's emulator for Arm: `apt-get install {QEMU}` on Debian and \
                 Ubuntu, `dnf install {QEMU}` on Fedora, `brew install qemu` on macOS ({why})"
        )
    })?;
    version().ok_or_else(|| format!("{QEMU} is installed but does not run"))
}

fn version() -> Option<String> {
    process::first_line(Command::new(QEMU).arg("--version"))
}

/// Runs a firmware to its end and returns what it printed.
pub(crate) fn run(board: &Board, firmware: &Path) -> Result<String, String> {
    let mut command = Command::new(QEMU);
    command
        .args(["-machine", board.machine])
        .args(["-display", "none", "-monitor", "none", "-serial", "none"])
        .args(["-icount", INSTRUCTION_TIME])
        .args(["-semihosting-config", "enable=on,target=native"])
        .arg("-kernel")
        .arg(firmware);
    let finished =
        process::run(&mut command, LIMIT).map_err(|error| format!("{}: cannot run {QEMU}: {error}", board.core))?;
    if finished.status.is_none() {
        return Err(format!(
            "{}: the firmware did not end within {} s; it printed:\n{}",
            board.core,
            LIMIT.as_secs(),
            finished.tail(5)
        ));
    }
    if !finished.success() {
        return Err(format!(
            "{}: the firmware failed ({}); it printed:\n{}",
            board.core,
            finished.ending(),
            finished.tail(5)
        ));
    }
    Ok(finished.stdout)
}
