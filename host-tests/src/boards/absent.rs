//! The proof that an absent term costs nothing: the firmware of a scene is, byte for byte, the firmware that a library yields in
//! which the terms that the scene does not use do not exist.
//!
//! Every item of the library that names such a term is taken out of a copy of its source, and what names that item, as is what
//! the scene does not need of the firmware's own source.

use std::fs;
use std::path::{Path, PathBuf};

use object::{Object, ObjectSection, SectionFlags, elf};

use super::firmware::{self, FOLDER, repository};
use super::toolchain::Toolchain;
use super::without::{self, Parts};
use super::{Board, REFERENCE_CORE};

/// The cores of the proof: one with and one without arithmetic of its own.
pub const CORES: [&str; 2] = [REFERENCE_CORE, "Cortex-M3"];

/// A scene, and what it does not use.
pub struct Proof {
    /// Its name among the figures.
    pub scene: &'static str,
    /// Its firmware.
    binary: &'static str,
    /// What is absent, in words.
    pub absent: &'static str,
    parts: Parts<'static>,
}

/// Modules that no scene of the rigid body uses, that of the firmware with scenes of the simulation among them.
const OUTSIDE_THE_RIGID_BODY: [&str; 9] =
    ["simulation", "boundary", "calibrate", "dual", "uncertainty", "instrument", "fixed", "hertz", "contacts"];

/// Modules that no simulation of an impact alone uses: tables, calibration, derivatives, recording, motion to rest ...
const OUTSIDE_THE_SIMULATION: [&str; 9] =
    ["boundary", "calibrate", "dual", "uncertainty", "instrument", "fixed", "trajectory", "rest", "paper"];

/// The scenes of the proof.
pub const PROOFS: [Proof; 4] = [
    Proof {
        scene: "normal/coefficient",
        binary: "flash_normal",
        absent: "friction, spin, rolling dissipation, external impulses, the simulation, tables, calibration, uncertainty, \
                 instrument, fixed point",
        parts: Parts {
            modules: &OUTSIDE_THE_RIGID_BODY,
            types: &["Coulomb", "RollingDissipation", "Microforce", "ConstantRestitution"],
            methods: &["with_friction", "with_rolling_dissipation", "with_external_impulses", "with_external_force"],
        },
    },
    Proof {
        scene: "planar/work",
        binary: "flash_planar_work",
        absent: "rolling dissipation, external impulses, the simulation, tables, calibration, uncertainty, instrument, fixed \
                 point",
        parts: Parts {
            modules: &OUTSIDE_THE_RIGID_BODY,
            types: &["RollingDissipation", "Microforce", "ConstantRestitution"],
            methods: &["with_rolling_dissipation", "with_external_impulses", "with_external_force"],
        },
    },
    Proof {
        scene: "simulation/fixed-1e-5",
        binary: "flash_contact_fixed",
        absent: "friction, spin, peeling, external force, recording, motion to rest, the paper's method, tables, calibration, \
                 uncertainty, instrument, fixed point",
        parts: Parts {
            modules: &OUTSIDE_THE_SIMULATION,
            types: &["Coulomb", "Peeling", "ConstantForce"],
            methods: &["with_friction", "with_peeling", "with_external_force"],
        },
    },
    Proof {
        scene: "simulation/oblique",
        binary: "flash_contact_oblique",
        absent: "peeling, external force, recording, motion to rest, the paper's method, tables, calibration, uncertainty, \
                 instrument, fixed point",
        parts: Parts {
            modules: &OUTSIDE_THE_SIMULATION,
            types: &["Peeling", "ConstantForce"],
            methods: &["with_peeling", "with_external_force"],
        },
    },
];

/// Bytes that differ, for each proof.
pub fn differing(toolchain: &Toolchain, board: &Board) -> Result<Vec<u32>, String> {
    let copy = firmware::target_folder(toolchain, board).join("copy");
    frame(&copy)?;
    let whole = Parts { modules: &[], types: &[], methods: &[] };
    let binaries = PROOFS.map(|proof| proof.binary);
    sources(&copy, &whole)?;
    let folder = firmware::build_copy(toolchain, board, &copy, &binaries)?;
    let complete = binaries.iter().map(|binary| contents(&folder.join(binary))).collect::<Result<Vec<_>, _>>()?;
    // That a scene does not build without a term that it uses shows that terms are taken out.
    let [_, planar, ..] = PROOFS;
    sources(&copy, &Parts { types: &["Coulomb"], ..planar.parts })?;
    if firmware::build_copy(toolchain, board, &copy, &[planar.binary]).is_ok() {
        return Err(format!("{}: {} builds without friction, so that nothing is proved", board.core, planar.scene));
    }
    PROOFS
        .iter()
        .zip(complete)
        .map(|(proof, complete)| {
            sources(&copy, &proof.parts)?;
            let folder = firmware::build_copy(toolchain, board, &copy, &[proof.binary])?;
            let reduced = contents(&folder.join(proof.binary))?;
            let same = complete.iter().zip(&reduced).filter(|(one, other)| one == other).count();
            Ok((complete.len().max(reduced.len()) - same) as u32)
        })
        .collect()
}

/// What surrounds the sources: all that a build reads, at the same place for every build, since names in machine code
/// depend on it.
fn frame(copy: &Path) -> Result<(), String> {
    let files = ["README.md", "memory.x"].map(PathBuf::from).into_iter().chain(
        ["Cargo.toml", "Cargo.lock", "build.rs", "maps/mps2.x", "maps/mps2-an505.x", "maps/virt.x"]
            .map(|file| Path::new(FOLDER).join(file)),
    );
    for file in files {
        let to = copy.join(&file);
        let wrong = |error: std::io::Error| format!("cannot copy to {}: {error}", to.display());
        fs::create_dir_all(to.parent().unwrap_or(copy)).map_err(wrong)?;
        fs::copy(repository().join(&file), &to).map_err(wrong)?;
    }
    // The library's manifest, without what only tests and examples need.
    let manifest = fs::read_to_string(repository().join("Cargo.toml")).map_err(|error| error.to_string())?;
    let manifest = manifest.split("[dev-dependencies]").next().unwrap_or_default();
    let is_kept = |line: &&str| !["members", "default-members", "exclude"].iter().any(|key| line.starts_with(key));
    let manifest: Vec<&str> = manifest.lines().filter(is_kept).collect();
    fs::write(copy.join("Cargo.toml"), manifest.join("\n")).map_err(|error| error.to_string())
}

/// What the firmware of one scene does not need.
const OTHER_FIRMWARE: [&str; 10] = [
    "approximate",
    "bin",
    "calibrations",
    "entries",
    "fixed_contacts",
    "measurement",
    "methods",
    "station",
    "tables",
    "variants",
];

/// The sources of the library and of the firmware, without some parts.
fn sources(copy: &Path, parts: &Parts<'_>) -> Result<(), String> {
    let firmware = Path::new(FOLDER).join("src");
    for folder in [Path::new("src"), &firmware] {
        let folder = copy.join(folder);
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(|error| format!("cannot remove {}: {error}", folder.display()))?;
        }
    }
    without::copy(&repository().join("src"), &copy.join("src"), parts)?;
    let modules: Vec<&str> = parts.modules.iter().chain(&OTHER_FIRMWARE).copied().collect();
    let rest = Parts { modules: &modules, ..*parts };
    without::copy(&repository().join(&firmware), &copy.join(&firmware), &rest)?;
    let whole = Parts { modules: &[], types: &[], methods: &[] };
    without::copy(&repository().join(&firmware).join("bin"), &copy.join(&firmware).join("bin"), &whole)
}

/// All bytes that a firmware puts into memory.
fn contents(firmware: &Path) -> Result<Vec<u8>, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", firmware.display());
    let bytes = fs::read(firmware).map_err(|error| wrong(&error))?;
    let file = object::File::parse(&*bytes).map_err(|error| wrong(&error))?;
    let placed = file.sections().filter(
        |section| matches!(section.flags(), SectionFlags::Elf { sh_flags, .. } if sh_flags.contains(elf::SHF_ALLOC)),
    );
    let mut contents = Vec::new();
    for section in placed {
        contents.extend_from_slice(section.data().map_err(|error| wrong(&error))?);
    }
    Ok(contents)
}
