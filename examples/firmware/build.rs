//! Link arguments of the firmware, in one place, and the memory maps they need.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The panic probes are linked and never run, so no board has to hold them.
const PROBES: &str = "probe";
const PROBE_MAP: &str = "\
MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 16M
  RAM   : ORIGIN = 0x20000000, LENGTH = 16K
}
";

/// Targets whose boards have their memories elsewhere, and so much that the probes fit too.
const MAPS: [(&str, &str); 2] = [("thumbv8m", "maps/mps2-an505.x"), ("riscv32", "maps/virt.x")];

/// Binaries whose scenes are measured, the flash of each by what its code refers to: relocations and a map say that.
const MEASURED: [&str; 11] = [
    "classify",
    "contacts",
    "double_contacts",
    "fixed_contacts",
    "variants",
    "collocations",
    "recordings",
    "functions",
    "law",
    "calibrate",
    "double_calibrate",
];

/// Binaries with so many methods in them that only the largest boards hold them, and their map.
const LARGE: ([&str; 2], &str) = (["methods", "worst"], "maps/mps2.x");

/// Binaries that log by defmt, whose strings stay out of flash.
const LOGGING: [&str; 1] = ["instrument"];

fn main() {
    let manifest = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    // That of the profile, in which cargo makes `build/PACKAGE/out`.
    let binary_folder = out.ancestors().nth(3).expect("cargo has a folder for each profile");
    let target = env::var("TARGET").expect("cargo sets it");
    let (map, probe_map) = match MAPS.iter().find(|(prefix, _)| target.starts_with(prefix)) {
        Some((_, map)) => (manifest.join(map), None),
        None => (manifest.join("../../memory.x"), Some(PROBE_MAP)),
    };
    let large_map = if probe_map.is_some() { manifest.join(LARGE.1) } else { map.clone() };
    let binaries = manifest.join("src/bin");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed={}", map.display());
    println!("cargo:rerun-if-changed={}", large_map.display());
    println!("cargo:rerun-if-changed={}", binaries.display());

    // link.x includes memory.x by its name alone: the linker looks for it in a folder that depends on the binary.
    let board_map = fs::read_to_string(&map).expect("the memory map can be read");
    let board = folder(&out, "board", &board_map);
    let large = folder(&out, "large", &fs::read_to_string(&large_map).expect("the memory map can be read"));
    let probe = folder(&out, "probe", probe_map.unwrap_or(&board_map));
    for file in fs::read_dir(&binaries).expect("the binaries can be listed").flatten() {
        if let Some(name) = file.path().file_stem().and_then(OsStr::to_str) {
            let folder = match name {
                _ if name.starts_with(PROBES) => &probe,
                _ if LARGE.0.contains(&name) => &large,
                _ => &board,
            };
            println!("cargo:rustc-link-arg-bin={name}=-L{}", folder.display());
            if MEASURED.contains(&name) {
                println!("cargo:rustc-link-arg-bin={name}=--emit-relocs");
                println!(
                    "cargo:rustc-link-arg-bin={name}=-Map={}",
                    binary_folder.join(name).with_extension("map").display()
                );
            }
            if LOGGING.contains(&name) {
                println!("cargo:rustc-link-arg-bin={name}=-Tdefmt.x");
            }
        }
    }

    // --nmagic: sections follow each other without page alignment, so that
    // bytes in the file are bytes in flash.
    println!("cargo:rustc-link-arg-bins=--nmagic");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
}

/// A new folder with a memory map in it.
fn folder(parent: &Path, name: &str, map: &str) -> PathBuf {
    let folder = parent.join(name);
    fs::create_dir_all(&folder).expect("a folder can be made in OUT_DIR");
    fs::write(folder.join("memory.x"), map).expect("a file can be written to OUT_DIR");
    folder
}
