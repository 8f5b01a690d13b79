//! `cargo targets lowest`: the library with the lowest versions of its dependencies.

use std::fs;

use boards::packages::Permission;
use boards::process;
use boards::without::{self, Parts};
use boards::{absent, firmware, toolchain};

use crate::check::LIMIT;

/// All features, with and without `portable-atomic`, which takes the place of what the queue otherwise uses.
const FEATURES: [&str; 2] = ["fixed,link,defmt,std", "fixed,link,defmt,std,portable-atomic"];

/// Compiles a copy of the library whose dependencies have the lowest versions. Only a nightly compiler finds these.
pub(crate) fn check(permission: Permission) -> Result<(), String> {
    if let Err(obstacle) = toolchain::find_nightly(permission) {
        println!("the lowest versions are not checked: {obstacle}");
        return Ok(());
    }
    let copy = firmware::builds().join("lowest");
    let source = copy.join("src");
    if source.exists() {
        fs::remove_dir_all(&source).map_err(|error| format!("cannot remove {}: {error}", source.display()))?;
    }
    without::copy(&firmware::repository().join("src"), &source, &Parts::default())?;
    let lock = copy.join("Cargo.lock");
    if lock.exists() {
        fs::remove_file(&lock).map_err(|error| format!("cannot remove {}: {error}", lock.display()))?;
    }
    let wrong = |error: std::io::Error| format!("cannot write to {}: {error}", copy.display());
    fs::copy(firmware::repository().join("README.md"), copy.join("README.md")).map_err(wrong)?;
    fs::write(copy.join("Cargo.toml"), absent::manifest()?).map_err(wrong)?;

    let mut update = toolchain::cargo_nightly();
    update.current_dir(&copy).args(["update", "-Zdirect-minimal-versions"]);
    process::run(&mut update, LIMIT)
        .map_err(|error| format!("cannot run cargo: {error}"))?
        .succeeded("resolving the lowest versions", 40)?;
    for features in FEATURES {
        let mut check = toolchain::cargo_in_use();
        check.current_dir(&copy).args(["check", "--locked", "--features", features]);
        check.arg("--target-dir").arg(firmware::builds().join("targets"));
        process::run(&mut check, LIMIT)
            .map_err(|error| format!("cannot run cargo: {error}"))?
            .succeeded(&format!("compiling with the lowest versions and {features}"), 40)?;
    }
    println!("the library compiles with the lowest versions of its dependencies");
    Ok(())
}
