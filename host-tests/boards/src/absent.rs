//! The proof that an absent term costs nothing: the firmware of a scene is, byte for byte, the firmware that a library
//! yields in which the terms that the scene does not use do not exist.
//!
//! Every item of the library that names such a term is taken out of a copy of its source, and what names that item, as is
//! what the scene does not need of the firmware's own source.

use std::fs;
use std::path::{Path, PathBuf};

use object::{Object, ObjectSection};

use super::firmware::{self, FOLDER, repository};
use super::footprint::{self, Memory};
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
    absent: [&'static [Term]; 3],
}

/// What a scene may be without.
struct Term {
    /// In words.
    name: &'static str,
    modules: &'static [&'static str],
    types: &'static [&'static str],
    methods: &'static [&'static str],
}

/// A term without parts.
const TERM: Term = Term { name: "", modules: &[], types: &[], methods: &[] };

const FRICTION: [Term; 1] = [Term { name: "friction, spin", types: &["Coulomb"], methods: &["with_friction"], ..TERM }];

/// What no rigid body of the proof uses.
const OF_THE_RIGID_BODY: [Term; 5] = [
    Term {
        name: "other laws of restitution and adhesion",
        types: &[
            "PowerRestitution",
            "ElasticPlasticRestitution",
            "ViscoelasticRestitution",
            "TabulatedRestitution",
            "AnyRestitution",
            "AnyAdhesion",
            "SpeedAdhesion",
        ],
        methods: &["with_adhesion_at_speed"],
        ..TERM
    },
    Term {
        name: "rolling dissipation",
        types: &["RollingDissipation"],
        methods: &["with_rolling_dissipation"],
        ..TERM
    },
    Term {
        name: "external impulses",
        types: &["Microforce"],
        methods: &["with_external_impulses", "with_external_force"],
        ..TERM
    },
    Term { name: "constant restitution", types: &["ConstantRestitution"], ..TERM },
    // With the firmware's scenes of it.
    Term { name: "the simulation", modules: &["contact", "hertz", "contacts"], types: &["Hertz"], ..TERM },
];

/// What no simulation of the proof uses.
const OF_THE_SIMULATION: [Term; 11] = [
    Term {
        name: "compliance along the surface",
        modules: &["compliance"],
        types: &["Compliance", "CompliantMotion", "CompliantVelocities", "Unloading"],
        methods: &["with_compliance", "with_unloading", "tangential_ratio_between"],
    },
    Term {
        name: "other forces that press",
        types: &["TotalForce", "TotalAndPullOff"],
        methods: &["with_friction_under"],
        ..TERM
    },
    Term {
        name: "laws chosen at run time",
        modules: &["chosen"],
        types: &["AnyLaw", "AnyDamping", "AnyForce", "AnyRestitution", "AnyAdhesion"],
        ..TERM
    },
    Term {
        name: "other laws and dampings",
        modules: &["dmt", "jkr", "tension"],
        types: &["Dmt", "JkrLaw", "JkrEnd", "NoTension", "ViscoelasticDamping", "ConstantDamping"],
        methods: &["with_dmt", "with_viscoelastic_damping", "with_constant_damping", "without_tension"],
    },
    Term { name: "peeling", modules: &["peeling"], types: &["Peeling"], methods: &["with_peeling"] },
    Term { name: "external force", types: &["ConstantForce"], methods: &["with_external_force"], ..TERM },
    Term { name: "recording", modules: &["trajectory"], types: &["Recording", "Sample", "Trajectory"], ..TERM },
    Term { name: "motion to rest", modules: &["rest"], types: &["RestCriterion", "MotionToRest"], ..TERM },
    Term {
        name: "the search for the critical speed",
        modules: &["critical", "critical_search"],
        types: &["CriticalSpeedSearch"],
        ..TERM
    },
    Term { name: "the choice of a method", types: &["Adaptive", "AdaptiveNodes"], ..TERM },
    Term { name: "the paper's method", modules: &["gill"], types: &["RungeKuttaGill"], ..TERM },
];

/// What no impact alone uses.
const AROUND_AN_IMPACT: [Term; 7] = [
    Term { name: "configurations", modules: &["config"], ..TERM },
    Term { name: "motions in space", modules: &["space"], ..TERM },
    Term { name: "tables", modules: &["table"], ..TERM },
    Term { name: "calibration", modules: &["measure"], ..TERM },
    Term { name: "uncertainty", modules: &["dual"], types: &["Dual"], ..TERM },
    Term { name: "instrument", modules: &["instrument"], ..TERM },
    Term { name: "fixed point", modules: &["fixed"], types: &["FixedPoint", "FixedPointTerm", "InFixedPoint"], ..TERM },
];

/// The scenes of the proof.
pub const PROOFS: [Proof; 4] = [
    Proof {
        scene: "normal/coefficient",
        binary: "flash_normal",
        absent: [&FRICTION, &OF_THE_RIGID_BODY, &AROUND_AN_IMPACT],
    },
    Proof { scene: "planar/work", binary: "flash_planar_work", absent: [&[], &OF_THE_RIGID_BODY, &AROUND_AN_IMPACT] },
    Proof {
        scene: "simulation/fixed-1e-5",
        binary: "flash_contact_fixed",
        absent: [&FRICTION, &OF_THE_SIMULATION, &AROUND_AN_IMPACT],
    },
    Proof {
        scene: "simulation/oblique",
        binary: "flash_contact_oblique",
        absent: [&[], &OF_THE_SIMULATION, &AROUND_AN_IMPACT],
    },
];

impl Proof {
    /// What is absent, in words.
    pub fn absent(&self) -> String {
        let names: Vec<_> = self.terms().map(|term| term.name).collect();
        names.join(", ")
    }

    /// The parts of the library that belong to it.
    fn parts(&self) -> Parts<'static> {
        let all = |parts: fn(&Term) -> &'static [&'static str]| self.terms().flat_map(parts).copied().collect();
        Parts { modules: all(|term| term.modules), types: all(|term| term.types), methods: all(|term| term.methods) }
    }

    fn terms(&self) -> impl Iterator<Item = &'static Term> {
        self.absent.into_iter().flatten()
    }
}

/// Bytes that differ, for each proof.
pub fn differing(toolchain: &Toolchain, board: &Board) -> Result<Vec<u32>, String> {
    let copy = firmware::target_folder(toolchain, board).join("copy");
    frame(&copy)?;
    let binaries = PROOFS.map(|proof| proof.binary);
    sources(&copy, &Parts::default())?;
    let folder = firmware::build_copy(toolchain, board, &copy, &binaries)?;
    let complete = binaries.iter().map(|binary| contents(&folder.join(binary))).collect::<Result<Vec<_>, _>>()?;
    // That a scene does not build without a term that it uses shows that terms are taken out.
    let [_, planar, ..] = PROOFS;
    sources(&copy, &Parts { types: vec!["Coulomb"], ..planar.parts() })?;
    if firmware::build_copy(toolchain, board, &copy, &[planar.binary]).is_ok() {
        return Err(format!("{}: {} builds without friction, so that nothing is proved", board.core, planar.scene));
    }
    PROOFS
        .iter()
        .zip(complete)
        .map(|(proof, complete)| {
            sources(&copy, &proof.parts())?;
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
        [
            "Cargo.toml",
            "Cargo.lock",
            "build.rs",
            "maps/mps2.x",
            "maps/mps2-an505.x",
            "maps/virt.x",
            "measurement/Cargo.toml",
            "scenes/Cargo.toml",
            "storage/Cargo.toml",
        ]
        .map(|file| Path::new(FOLDER).join(file)),
    );
    for file in files {
        let to = copy.join(&file);
        let wrong = |error: std::io::Error| format!("cannot copy to {}: {error}", to.display());
        fs::create_dir_all(to.parent().unwrap_or(copy)).map_err(wrong)?;
        fs::copy(repository().join(&file), &to).map_err(wrong)?;
    }
    fs::write(copy.join("Cargo.toml"), manifest()?).map_err(|error| error.to_string())
}

/// The library's manifest, without what only tests and examples need.
pub fn manifest() -> Result<String, String> {
    let path = repository().join("Cargo.toml");
    let manifest = fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let manifest = manifest.split("[dev-dependencies]").next().unwrap_or_default();
    let is_kept = |line: &&str| !["members", "default-members", "exclude"].iter().any(|key| line.starts_with(key));
    Ok(manifest.lines().filter(is_kept).collect::<Vec<_>>().join("\n"))
}

/// What the firmware of one scene does not need.
const OTHER_FIRMWARE: [&str; 11] = [
    "approximate",
    "bin",
    "calibration",
    "calibrations",
    "entries",
    "fixed_contacts",
    "laws",
    "methods",
    "station",
    "tables",
    "variants",
];

/// The sources of the library and of the firmware, without some parts.
fn sources(copy: &Path, parts: &Parts<'_>) -> Result<(), String> {
    let mut rest = parts.clone();
    rest.modules.extend(OTHER_FIRMWARE);
    let of_the_firmware = |folder: &str| Path::new(FOLDER).join(folder);
    for (folder, parts) in [
        (PathBuf::from("src"), parts),
        (of_the_firmware("src"), &rest),
        (of_the_firmware("scenes/src"), &rest),
        (of_the_firmware("measurement/src"), &rest),
        (of_the_firmware("storage/src"), &Parts::default()),
        (of_the_firmware("src/bin"), &Parts::default()),
    ] {
        let to = copy.join(&folder);
        if to.exists() {
            fs::remove_dir_all(&to).map_err(|error| format!("cannot remove {}: {error}", to.display()))?;
        }
        without::copy(&repository().join(&folder), &to, parts)?;
    }
    Ok(())
}

/// All bytes that a firmware puts into memory.
fn contents(firmware: &Path) -> Result<Vec<u8>, String> {
    let bytes = footprint::read(firmware)?;
    let mut contents = Vec::new();
    for section in footprint::parse(firmware, &bytes)?.sections().filter(|section| Memory::of(section).is_some()) {
        contents.extend_from_slice(section.data().map_err(|error| format!("{}: {error}", firmware.display()))?);
    }
    Ok(contents)
}
