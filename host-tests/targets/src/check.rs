//! What the compiler says of each target with each feature.

use std::process::Command;
use std::time::Duration;

use boards::firmware;
use boards::packages::Permission;
use boards::process::{self, Finished};
use boards::toolchain::{self, Choice, Toolchain, target_variable};

/// Each feature alone, and none. `instrument` and `link` have the queue, which needs atomic instructions.
pub(crate) const FEATURES: [&str; 7] = ["", "std", "fixed", "serde", "defmt", "instrument", "link"];

/// Sets of features that are checked at once. Where a set compiles, each feature in it does: no source depends on a feature and a
/// target together, and `.ci/run features` checks each feature alone.
const TOGETHER: [&str; 2] = ["fixed,serde,defmt,instrument,link", "fixed,serde,defmt"];

/// A target, and the flags that it cannot be compiled without.
type Target = (&'static str, &'static str);

/// Those of microcontrollers from the smallest to the largest, then a browser's, and one whose most significant byte is first.
const TARGETS: [Target; 14] = [
    // The compiler demands a processor; this one is the most common.
    ("avr-none", "-C target-cpu=atmega328p"),
    ("msp430-none-elf", ""),
    ("thumbv6m-none-eabi", ""),
    ("thumbv7m-none-eabi", ""),
    ("thumbv7em-none-eabi", ""),
    ("thumbv7em-none-eabihf", ""),
    ("thumbv8m.base-none-eabi", ""),
    ("thumbv8m.main-none-eabi", ""),
    ("thumbv8m.main-none-eabihf", ""),
    ("riscv32imc-unknown-none-elf", ""),
    ("riscv32imac-unknown-none-elf", ""),
    ("riscv32imafc-unknown-none-elf", ""),
    ("wasm32-unknown-unknown", ""),
    ("powerpc-unknown-linux-gnu", ""),
];

/// The longest that one call of cargo may take.
pub(crate) const LIMIT: Duration = Duration::from_secs(600);

/// What the compiler says where the target has no standard library.
const NO_STANDARD_LIBRARY: &str = "can't find crate for `std`";

/// Whether the library compiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Support {
    Yes,
    /// With the feature of that name.
    PortableAtomic,
    /// With that feature, and with a feature of the package of that name.
    ChosenPortableAtomic,
    NoStandardLibrary,
}

/// What is known of a target: nothing if there is no compiler for it.
pub(crate) struct Row {
    pub(crate) triple: &'static str,
    pub(crate) support: Option<[Support; FEATURES.len()]>,
}

/// A compiler that has a target.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Compiler {
    InUse,
    /// It compiles `core` from source.
    Nightly,
}

impl Compiler {
    /// One that has a target, installed if need be; or else what to install by hand.
    fn find(triple: &str, permission: Permission) -> Result<Self, String> {
        // `rustup` has these two for no compiler.
        let obstacle = if ["avr-none", "msp430-none-elf"].contains(&triple) {
            None
        } else {
            match Toolchain::find(Choice::Rustup, &[triple], permission) {
                Ok(_) => return Ok(Self::InUse),
                Err(obstacle) => Some(obstacle),
            }
        };
        toolchain::find_nightly(permission).map(|()| Self::Nightly).map_err(|why| match obstacle {
            Some(obstacle) => format!("{obstacle}\n{why}"),
            None => why,
        })
    }

    /// A check of the library for some targets.
    fn check<'a>(self, targets: impl Iterator<Item = &'a Target>, features: &str) -> Command {
        let mut cargo = match self {
            Self::InUse => toolchain::cargo_in_use(),
            Self::Nightly => toolchain::cargo_nightly(),
        };
        cargo.current_dir(firmware::repository()).args(["check", "--locked", "--keep-going", "--lib"]);
        cargo.args(["--package", "microimpact", "--features", features]);
        cargo.arg("--target-dir").arg(firmware::builds().join("targets"));
        if self == Self::Nightly {
            cargo.arg("-Zbuild-std=core");
        }
        for (triple, flags) in targets {
            cargo.args(["--target", triple]);
            if !flags.is_empty() {
                cargo.env(target_variable(triple, "RUSTFLAGS"), flags);
            }
        }
        cargo
    }
}

/// A row for each target.
pub(crate) fn rows(permission: Permission) -> Result<Vec<Row>, String> {
    let compilers = TARGETS.map(|(triple, _)| match Compiler::find(triple, permission) {
        Ok(compiler) => Some(compiler),
        Err(obstacle) => {
            eprintln!("{triple} is left out: {obstacle}");
            None
        }
    });
    let targets: Vec<_> = TARGETS.iter().zip(compilers).collect();
    // Cargo uses all cores for several targets at once. Which of them fail is seen afterwards.
    for compiler in [Compiler::InUse, Compiler::Nightly] {
        let with_it = || targets.iter().filter(|(_, found)| *found == Some(compiler)).map(|(target, _)| *target);
        if with_it().next().is_some() {
            eprintln!("checking {} targets ...", with_it().count());
            run(&mut compiler.check(with_it(), TOGETHER[0]))?;
        }
    }
    let row = |(&(triple, flags), compiler): (&Target, Option<Compiler>)| {
        let Some(compiler) = compiler else { return Ok(Row { triple, support: None }) };
        eprintln!("checking {triple} ...");
        let target = (triple, flags);
        let mut compiled = None;
        for set in TOGETHER {
            if compiled.is_none() && check(compiler, target, set)?.success() {
                compiled = Some(set);
            }
        }
        let mut support = [Support::Yes; FEATURES.len()];
        for (support, feature) in support.iter_mut().zip(FEATURES) {
            *support = match compiled {
                Some(set) if feature.is_empty() || set.split(',').any(|one| one == feature) => Support::Yes,
                // With the same features its dependencies are not compiled again.
                Some(set) if feature == "std" => of_target(compiler, target, &format!("std,{set}"))?,
                _ => of_target(compiler, target, feature)?,
            };
        }
        Ok(Row { triple, support: Some(support) })
    };
    targets.into_iter().map(row).collect()
}

/// What a target needs for the library with a feature; an error if it compiles in no way and for no known reason.
fn of_target(compiler: Compiler, target: Target, features: &str) -> Result<Support, String> {
    let alone = check(compiler, target, features)?;
    if alone.success() {
        return Ok(Support::Yes);
    }
    if alone.stderr.contains(NO_STANDARD_LIBRARY) {
        return Ok(Support::NoStandardLibrary);
    }
    let portable = format!("{features},portable-atomic");
    if check(compiler, target, &portable)?.success() {
        return Ok(Support::PortableAtomic);
    }
    if check(compiler, target, &format!("{portable},portable-atomic/unsafe-assume-single-core"))?.success() {
        return Ok(Support::ChosenPortableAtomic);
    }
    Err(format!("{} with features {features:?} ({}):\n{}", target.0, alone.ending(), alone.tail(40)))
}

fn check(compiler: Compiler, target: Target, features: &str) -> Result<Finished, String> {
    run(&mut compiler.check([&target].into_iter(), features))
}

fn run(cargo: &mut Command) -> Result<Finished, String> {
    process::run(cargo, LIMIT).map_err(|error| format!("cannot run cargo: {error}"))
}
