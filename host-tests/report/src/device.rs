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
    /// None for the packages of this repository.
    source: Option<String>,
    #[serde(default)]
    dependencies: Vec<String>,
}

/// What a report was made with.
#[derive(Default)]
pub(crate) struct Device {
    /// Names and values.
    pub(crate) facts: Vec<(&'static str, String)>,
    /// Crates from elsewhere that take part, with their versions.
    pub(crate) crates: Vec<(String, String)>,
}

impl Device {
    /// This machine and this program.
    ///
    /// # Errors
    /// The list of crates cannot be read.
    pub(crate) fn of(quick: bool, elapsed: Duration) -> Result<Self, Box<dyn Error>> {
        let system = System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
        let processor = system.cpus().first().map_or("unknown", |cpu| cpu.brand()).trim().to_owned();
        let compiler = process::first_line(Command::new("rustc").arg("--version"));
        let facts = vec![
            ("Run", if quick { "quick" } else { "full" }.to_owned()),
            ("Time", format!("{:.1} s", elapsed.as_secs_f64())),
            ("Processor", format!("{} x {processor}, {}", system.cpus().len(), std::env::consts::ARCH)),
            ("System", System::long_os_version().unwrap_or_else(|| std::env::consts::OS.to_owned())),
            ("Compiler", compiler.unwrap_or_else(|| "unknown".to_owned())),
        ];
        Ok(Self { facts, crates: crates()? })
    }
}

fn crates() -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let lock: Lock = toml::from_str(LOCK)?;
    let roots: Vec<_> = lock.package.iter().filter(|package| ROOTS.contains(&&*package.name)).collect();
    let takes_part = |package: &&Package| {
        // A dependency that exists in several versions is listed with its version.
        let with_version = format!("{} {}", package.name, package.version);
        let named = |name: &String| *name == package.name || *name == with_version;
        package.source.is_some() && roots.iter().any(|root| root.dependencies.iter().any(named))
    };
    Ok(lock.package.iter().filter(takes_part).map(|package| (package.name.clone(), package.version.clone())).collect())
}
