//! What a report was made with: processor, compiler, and the versions of the crates that took part.

use std::error::Error;
use std::process::Command;
use std::time::Duration;

use boards::process;
use serde::Deserialize;
use sysinfo::{CpuRefreshKind, RefreshKind, System};

const LOCK: &str = include_str!("../../../Cargo.lock");
/// The packages whose dependencies take part.
const ROOTS: [&str; 2] = ["contest", "report"];

#[derive(Deserialize)]
struct Lock {
    package: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
    #[serde(default)]
    dependencies: Vec<String>,
}

/// Names and values for the head of the page.
pub(crate) fn facts(quick: bool, elapsed: Duration) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
    let system = System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
    let processor = system.cpus().first().map_or("unknown", |cpu| cpu.brand()).trim().to_owned();
    let compiler = process::first_line(Command::new("rustc").arg("--version"));
    Ok(vec![
        ("Run", if quick { "quick" } else { "full" }.to_owned()),
        ("Time", format!("{:.1} s", elapsed.as_secs_f64())),
        ("Processor", format!("{} x {processor}, {}", system.cpus().len(), std::env::consts::ARCH)),
        ("System", System::long_os_version().unwrap_or_else(|| std::env::consts::OS.to_owned())),
        ("Compiler", compiler.unwrap_or_else(|| "unknown".to_owned())),
        ("Crates", versions()?),
    ])
}

/// The library and the crates that take part, with their versions.
fn versions() -> Result<String, Box<dyn Error>> {
    let lock: Lock = toml::from_str(LOCK)?;
    let roots: Vec<_> = lock.package.iter().filter(|package| ROOTS.contains(&&*package.name)).collect();
    let taking_part = |package: &&Package| {
        // A dependency that exists in several versions is listed with its version.
        let with_version = format!("{} {}", package.name, package.version);
        let named = |name: &String| *name == package.name || *name == with_version;
        roots.iter().any(|root| root.dependencies.iter().any(named))
    };
    let names = lock.package.iter().filter(taking_part).map(|package| format!("{} {}", package.name, package.version));
    Ok(names.collect::<Vec<_>>().join(", "))
}
