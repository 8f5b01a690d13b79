//! Instructions on the host, counted by valgrind's callgrind: this program runs itself there.

use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use boards::process;

use super::host::runners;
use crate::content::Run;

/// Tells this program that it is being counted, and whether the run is a quick one.
const COUNTED: &str = "MICROIMPACT_COUNTED";

const LIMIT: Duration = Duration::from_secs(300);

/// Runs every entrant twice, the second time as a [`counted`] call, where callgrind has started this program; whether
/// it has.
pub fn is_counted() -> bool {
    if std::env::var_os(COUNTED).is_none() {
        return false;
    }
    for mut runner in runners(&Run { quick: false }) {
        (runner.run)();
        counted(&mut runner.run);
    }
    true
}

/// The call that callgrind counts, known by its name.
#[inline(never)]
fn counted(run: &mut dyn FnMut() -> Option<f64>) {
    black_box(run());
}

/// Instructions of every entrant, in their order.
pub(super) fn counts(entrants: usize) -> Result<Vec<u64>, String> {
    let version = process::first_line(Command::new("valgrind").arg("--version"));
    version.ok_or("valgrind is not installed")?;
    let program = std::env::current_exe().map_err(|error| format!("this program has no path: {error}"))?;
    let folder = std::env::temp_dir().join(format!("microimpact-counted-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let counts = count(&program, &folder, entrants);
    // What cannot be removed is left to the system.
    let _ = fs::remove_dir_all(&folder);
    counts
}

fn count(program: &Path, folder: &Path, entrants: usize) -> Result<Vec<u64>, String> {
    let output = folder.join("counts");
    let mut command = Command::new("valgrind");
    command
        // Two patterns: of two options with the same one only the first counts.
        .args(["--tool=callgrind", "--toggle-collect=*callgrind::counted", "--dump-after=*::counted"])
        .arg(format!("--callgrind-out-file={}", output.display()))
        .arg(program)
        .env(COUNTED, "1");
    let finished = process::run(&mut command, LIMIT).map_err(|error| format!("cannot run valgrind: {error}"))?;
    if !finished.success() {
        return Err(format!("valgrind failed ({}):\n{}", finished.ending(), finished.tail(5)));
    }
    (1..=entrants).map(|number| total(&folder.join(format!("counts.{number}")))).collect()
}

/// The sum in a file of callgrind.
fn total(file: &PathBuf) -> Result<u64, String> {
    let wrong = || format!("callgrind wrote no sum into {}", file.display());
    let text = fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let sum = text.lines().find_map(|line| line.strip_prefix("summary: ")).ok_or_else(wrong)?;
    sum.trim().parse().map_err(|_| wrong())
}
