//! Debian packages, installed where that is allowed.

use std::process::Command;
use std::time::Duration;

use super::process;

const INSTALL: &[&str] = &["install", "-y", "--no-install-recommends"];

/// Never at the price of a package that is there: Debian's compilers exclude each other.
const KEEP: &[&str] = &["--no-remove"];

/// But for parts of an emulator from another release, which exclude those of this one.
const REPLACEABLE: &str = "qemu-";
const LIMIT: Duration = Duration::from_secs(900);

/// Whether this run may change what is installed on the machine.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Permission {
    /// What is missing is installed.
    Install,
    /// What is missing is named.
    LookOnly,
}

/// The version of a program, which is installed from its packages if need be; `elsewhere` says how on other systems.
pub fn find(program: &str, packages: &[&str], elsewhere: &str, permission: Permission) -> Result<String, String> {
    let version = || process::first_line(Command::new(program).arg("--version"));
    if let Some(version) = version() {
        return Ok(version);
    }
    let names = packages.join(" ");
    install(packages, permission).map_err(|why| {
        format!("no {program}; install it: `apt-get install {names}` on Debian and Ubuntu{elsewhere} ({why})")
    })?;
    version().ok_or_else(|| format!("{program} is installed but does not run"))
}

/// Installs packages with apt-get, or says why it did not.
pub fn install(packages: &[&str], permission: Permission) -> Result<(), String> {
    if permission == Permission::LookOnly {
        return Err("not installed, as --no-install asks".to_owned());
    }
    if !process::succeeds(Command::new("apt-get").arg("--version")) {
        return Err("not installed: this system has no apt-get".to_owned());
    }
    if process::first_line(Command::new("id").arg("-u")).as_deref() != Some("0") {
        return Err("not installed: only root may".to_owned());
    }
    eprintln!("installing Debian packages: {} ...", packages.join(" "));
    apt_get(&["update"])?;
    let kept = apt_get(&[INSTALL, KEEP, packages].concat());
    if kept.is_ok() || !replaces_emulators_only(packages) {
        return kept;
    }
    apt_get(&[INSTALL, packages].concat())
}

/// Whether an installation removes packages, and no others than those of an emulator.
fn replaces_emulators_only(packages: &[&str]) -> bool {
    let simulated = Command::new("apt-get").arg("--simulate").args(INSTALL).args(packages).output();
    let Ok(simulated) = simulated else { return false };
    let text = String::from_utf8_lossy(&simulated.stdout);
    let mut removed = text.lines().filter_map(|line| line.strip_prefix("Remv ")).peekable();
    removed.peek().is_some() && removed.all(|package| package.starts_with(REPLACEABLE))
}

fn apt_get(arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new("apt-get");
    command.env("DEBIAN_FRONTEND", "noninteractive").args(arguments);
    let finished = process::run(&mut command, LIMIT).map_err(|error| format!("apt-get: {error}"))?;
    finished.succeeded(&format!("`apt-get {}`", arguments.join(" ")), 5).map(drop)
}
