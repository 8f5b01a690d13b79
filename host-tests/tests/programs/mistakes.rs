//! What the compiler says of a mistake: few lines, and public names only. Compiled by `cargo +1.95.0`, whose words these are,
//! and only where MICROIMPACT_EXHAUSTIVE is set, since that compiler may have to be installed first.

use std::fs;
use std::path::Path;
use std::process::Command;

const TOOLCHAIN: &str = "+1.95.0";
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
const SCENE: &str = "Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?";

/// The compiler's output for a program with one wrong line, which the compiler is required to refuse.
fn complaint(name: &str, line: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mistakes").join(name);
    fs::create_dir_all(folder.join("src")).unwrap();
    let manifest = format!(
        "[package]\nname = \"{name}\"\nedition = \"2024\"\n[dependencies]\nmicroimpact.path = {ROOT:?}\n[workspace]\n"
    );
    fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    fs::copy(Path::new(ROOT).join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let program = format!(
        "use microimpact::contact::*;\nuse microimpact::*;\n\nfn main() -> Result<(), InputError> {{\n    \
         let scene = {SCENE};\n    {line}\n    Ok(())\n}}\n"
    );
    fs::write(folder.join("src/main.rs"), program).unwrap();
    // Not the compiler that compiles this test.
    let output = Command::new("cargo")
        .args([TOOLCHAIN, "check", "--quiet", "--offline"])
        .current_dir(&folder)
        .env_remove("RUSTUP_TOOLCHAIN")
        .env_remove("CARGO")
        .env_remove("RUSTC")
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("mistakes/target"))
        .output()
        .unwrap();
    assert!(!output.status.success(), "{line} was compiled");
    String::from_utf8(output.stderr).unwrap()
}

/// Lines that say something: neither empty, nor a bar alone, nor cargo's closing words.
fn lines(complaint: &str) -> usize {
    let errors = complaint.split("\nFor more information").next().unwrap();
    errors.lines().filter(|line| line.contains(|c: char| !matches!(c, ' ' | '|'))).count()
}

/// Names in the output that the crate does not export.
fn private_names(complaint: &str) -> Vec<&str> {
    let exported =
        ["src/lib.rs", "src/contact/mod.rs"].map(|file| fs::read_to_string(Path::new(ROOT).join(file)).unwrap());
    let exports = |name: &str| {
        exported.iter().flat_map(|text| text.split(|c: char| !c.is_alphanumeric())).any(|word| word == name)
    };
    let words = complaint.split(|c: char| !c.is_alphanumeric() && c != '_');
    let name = |word: &&str| word.starts_with(|c: char| c.is_uppercase()) && word.contains(|c: char| c.is_lowercase());
    words.filter(name).filter(|word| !["Result", "For", "Some"].contains(word) && !exports(word)).collect()
}

fn check(name: &str, line: &str, most_lines: usize, says: &str) {
    if std::env::var_os("MICROIMPACT_EXHAUSTIVE").is_none() {
        return;
    }
    let complaint = complaint(name, line);
    assert!(complaint.contains(says), "{complaint}");
    assert!(lines(&complaint) <= most_lines, "{} lines:\n{complaint}", lines(&complaint));
    let private = private_names(&complaint);
    assert!(private.is_empty(), "{private:?} in:\n{complaint}");
}

#[test]
fn a_critical_speed_by_a_method_without_error_control() {
    check(
        "error-control",
        "scene.critical_speed(&FixedCost::<5>::new(4)?)?;",
        10,
        "give `Adaptive` or `Collocation` here",
    );
}

#[test]
fn the_slip_of_a_scene_without_friction() {
    check(
        "slip",
        "let slides = scene.solve_for(&NormalMotion::new(1.0)?, &FixedCost::<5>::new(4)?, Slip)?.1.slides;",
        10,
        "no field `slides` on type `()`",
    );
}
