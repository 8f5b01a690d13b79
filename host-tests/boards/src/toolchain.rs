//! A compiler that can build for the boards: the one in use, given its targets by
//! rustup, or else Debian's, which builds `core` from source.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use super::packages::{self, Permission};
use super::process;

/// The compiler that the user wants.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Choice {
    /// The compiler in use if it has the targets or rustup can add them, else Debian's
    Auto,
    /// The compiler in use, with targets from rustup
    Rustup,
    /// Debian's compiler, with `core` built from its source package
    Debian,
}

#[derive(Clone, Copy)]
enum Route {
    InUse,
    Debian,
}

/// A compiler for all targets of a run.
pub struct Toolchain {
    route: Route,
    /// What the compiler says of its version.
    pub compiler: String,
}

const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";
/// The linker for all targets: LLVM's, as rustup's compiler has it, since its map is read.
const DEBIAN_LINKER: &str = "ld.lld";
const DEBIAN_LINKER_PACKAGE: &str = "lld";
const DEBIAN_RUST_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];
/// The variable that points to the libraries of the compiler that started this program.
const LIBRARIES: &str = "LD_LIBRARY_PATH";
/// The oldest release that compiles the library: `rust-version` in its Cargo.toml.
const OLDEST_RELEASE: (u32, u32) = (1, 88);
const RUSTUP_LIMIT: Duration = Duration::from_secs(300);

impl Toolchain {
    /// A compiler for `triples`, installed if need be; or else what to install by hand.
    pub fn find(choice: Choice, triples: &[&str], permission: Permission) -> Result<Self, String> {
        let mut obstacles = Vec::new();
        if choice != Choice::Debian {
            match in_use(triples, permission) {
                Ok(toolchain) => return Ok(toolchain),
                Err(obstacle) => obstacles.push(obstacle),
            }
        }
        if choice != Choice::Rustup {
            match debian(permission) {
                Ok(toolchain) => return Ok(toolchain),
                Err(obstacle) => obstacles.push(obstacle),
            }
        }
        Err(format!("no compiler for {}; what would help:\n{}", triples.join(", "), obstacles.join("\n")))
    }

    /// A name for a folder that only this compiler builds into.
    pub fn folder(&self) -> &'static str {
        match self.route {
            Route::InUse => "rustup",
            Route::Debian => "debian",
        }
    }

    /// A build by a cargo that knows nothing of the cargo that started this program.
    pub fn cargo(&self, triple: &str) -> Command {
        let mut command = match self.route {
            Route::InUse => cargo("cargo"),
            Route::Debian => cargo(DEBIAN_CARGO),
        };
        command.arg("build").args(["--target", triple]);
        if let Route::Debian = self.route {
            command
                .env_remove("RUSTUP_TOOLCHAIN")
                .env_remove(LIBRARIES)
                .env("PATH", path_starting_with("/usr/bin"))
                .env("RUSTC_BOOTSTRAP", "1")
                .arg("-Zbuild-std=core");
            command.env(target_variable(triple, "LINKER"), DEBIAN_LINKER);
        }
        command
    }
}

/// A call of cargo that knows nothing of the cargo that started this program.
fn cargo(program: &str) -> Command {
    let mut command = Command::new(program);
    for (name, _) in env::vars_os() {
        if steers_cargo(&name) {
            command.env_remove(name);
        }
    }
    command
}

/// A call of rustup's cargo of the compiler in use.
pub fn cargo_in_use() -> Command {
    cargo("cargo")
}

/// The same of the nightly compiler.
pub fn cargo_nightly() -> Command {
    let mut command = cargo("cargo");
    command.env_remove(LIBRARIES).arg("+nightly");
    command
}

/// Installs a nightly compiler with the source of `core` if there is none, or says why there is none.
pub fn find_nightly(permission: Permission) -> Result<(), String> {
    const INSTALL: [&str; 7] = ["toolchain", "install", "nightly", "--profile", "minimal", "--component", "rust-src"];
    let remedy =
        |why: &str| format!("no nightly compiler with the source of core; `rustup {}` ({why})", INSTALL.join(" "));
    let is_there = || {
        let mut rustc = Command::new("rustc");
        rustc.env_remove(LIBRARIES).args(["+nightly", "--print", "sysroot"]);
        process::first_line(&mut rustc).is_some_and(|sysroot| has_source(&sysroot))
    };
    if is_there() {
        return Ok(());
    }
    if permission == Permission::LookOnly {
        return Err(remedy("not done, as --no-install asks"));
    }
    eprintln!("installing a nightly compiler ...");
    let mut rustup = Command::new("rustup");
    rustup.env_remove("RUST_BACKTRACE").args(INSTALL);
    let finished =
        process::run(&mut rustup, RUSTUP_LIMIT).map_err(|error| remedy(&format!("cannot run rustup: {error}")))?;
    if is_there() { Ok(()) } else { Err(remedy(&format!("{}: {}", finished.ending(), finished.tail(2)))) }
}

/// The name of the variable that sets cargo's option `option` for one target.
pub fn target_variable(triple: &str, option: &str) -> String {
    let triple = triple.to_uppercase().replace(['-', '.'], "_");
    format!("CARGO_TARGET_{triple}_{option}")
}

fn in_use(triples: &[&str], permission: Permission) -> Result<Toolchain, String> {
    let compiler = process::first_line(Command::new("rustc").arg("-V"))
        .ok_or("- install Rust with rustup: https://rustup.rs (there is no `rustc` here)")?;
    let missing: Vec<&str> = triples.iter().copied().filter(|triple| !has_core("rustc", triple)).collect();
    if !missing.is_empty() {
        let targets = missing.join(" ");
        let remedy = |why: &str| format!("- `rustup target add {targets}` ({why})");
        if permission == Permission::LookOnly {
            return Err(remedy("not done, as --no-install asks"));
        }
        eprintln!("adding targets: {targets} ...");
        let mut rustup = Command::new("rustup");
        // Without a stack trace, its last lines say what is wrong.
        rustup.env_remove("RUST_BACKTRACE").args(["target", "add"]).args(&missing);
        let finished =
            process::run(&mut rustup, RUSTUP_LIMIT).map_err(|error| remedy(&format!("cannot run rustup: {error}")))?;
        if !finished.success() {
            let why = format!("{}: {}", finished.ending(), finished.tail(2));
            return Err(remedy(&why));
        }
        if let Some(triple) = missing.iter().find(|triple| !has_core("rustc", triple)) {
            return Err(format!(
                "- a `rustc` that belongs to rustup comes first in PATH ({compiler} has no {triple} \
                 although rustup has added it)"
            ));
        }
    }
    Ok(Toolchain { route: Route::InUse, compiler })
}

fn debian(permission: Permission) -> Result<Toolchain, String> {
    let missing = debian_missing();
    if !missing.is_empty() {
        packages::install(&missing, permission)
            .map_err(|why| format!("- on Debian, `apt-get install {}` ({why})", missing.join(" ")))?;
        let still_missing = debian_missing();
        if !still_missing.is_empty() {
            return Err(format!(
                "- on Debian, a usable {} (installed, but {DEBIAN_RUSTC}, {DEBIAN_CARGO} and \
                 {DEBIAN_LINKER} with Rust {}.{} or newer and the library's source are not all there)",
                still_missing.join(" "),
                OLDEST_RELEASE.0,
                OLDEST_RELEASE.1,
            ));
        }
    }
    let compiler = process::first_line(Command::new(DEBIAN_RUSTC).arg("-V"))
        .ok_or_else(|| format!("- a working {DEBIAN_RUSTC}"))?;
    Ok(Toolchain { route: Route::Debian, compiler })
}

fn debian_missing() -> Vec<&'static str> {
    let mut missing = Vec::new();
    if !debian_rust_is_usable() {
        missing.extend(DEBIAN_RUST_PACKAGES);
    }
    if !process::succeeds(Command::new(DEBIAN_LINKER).arg("--version")) {
        missing.push(DEBIAN_LINKER_PACKAGE);
    }
    missing
}

fn debian_rust_is_usable() -> bool {
    let version = process::first_line(Command::new(DEBIAN_RUSTC).arg("-V"));
    let sysroot = process::first_line(Command::new(DEBIAN_RUSTC).args(["--print", "sysroot"]));
    Path::new(DEBIAN_CARGO).exists()
        && sysroot.is_some_and(|sysroot| has_source(&sysroot))
        && version.is_some_and(|version| release(&version) >= Some(OLDEST_RELEASE))
}

/// Whether a compiler has the source of `core`.
fn has_source(sysroot: &str) -> bool {
    Path::new(sysroot).join("lib/rustlib/src/rust/library/core/src/lib.rs").exists()
}

/// `(1, 96)` of `rustc 1.96.0 (...)`.
fn release(version: &str) -> Option<(u32, u32)> {
    let mut numbers = version.split_whitespace().nth(1)?.split('.');
    Some((numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?))
}

/// Whether the compiler has a compiled `core` for a target.
fn has_core(rustc: &str, triple: &str) -> bool {
    let query = ["--print", "target-libdir", "--target", triple];
    process::first_line(Command::new(rustc).args(query)).and_then(|folder| fs::read_dir(folder).ok()).is_some_and(
        |mut files| files.any(|file| file.is_ok_and(|file| file.file_name().to_string_lossy().starts_with("libcore-"))),
    )
}

/// Whether a variable would make another cargo build something else: settings that
/// cargo passes to what it runs, and flags that are meant for the host.
fn steers_cargo(name: &OsStr) -> bool {
    const HARMLESS: [&str; 6] =
        ["CARGO_HOME", "CARGO_HTTP_", "CARGO_NET_", "CARGO_REGISTR", "CARGO_SOURCE_", "CARGO_TERM_"];
    let name = name.to_string_lossy();
    let steers = ["CARGO", "RUSTC", "RUSTDOC", "RUSTFLAGS"].iter().any(|prefix| name.starts_with(prefix));
    steers && !HARMLESS.iter().any(|prefix| name.starts_with(prefix))
}

fn path_starting_with(folder: &str) -> String {
    match env::var("PATH") {
        Ok(path) => format!("{folder}:{path}"),
        Err(_) => folder.to_owned(),
    }
}
