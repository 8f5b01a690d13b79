//! Numbers in README.md are those that were measured, and its commands run.

mod accuracy;
mod cycles;
mod footprint;

use std::sync::LazyLock;

use boards::REFERENCE_CORE;
use boards::figures::{Quantity, Stored, largest};

const README: &str = include_str!("../../../../README.md");
static STORED: LazyLock<Stored> = LazyLock::new(|| Stored::read(&Stored::path()).unwrap());

/// The largest figure of a scene on the core that the documentation mostly speaks of, over impacts and compilers.
fn measured(scene: &str, quantity: Quantity) -> f64 {
    measured_on(REFERENCE_CORE, scene, quantity)
}

/// The same on any core.
fn measured_on(core: &str, scene: &str, quantity: Quantity) -> f64 {
    measured_in("f32", core, scene, quantity)
}

/// The same in any number type.
fn measured_in(scalar: &str, core: &str, scene: &str, quantity: Quantity) -> f64 {
    largest(STORED.all(), core, scene, scalar, quantity).unwrap()
}

/// A text in one line, as its lines break anywhere.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// README's picture: a bar for each way to the class of an oblique impact, as long as the logarithm of its instructions.
#[test]
fn bars_are_as_long_as_was_measured() {
    const FROM: f64 = 10.0;
    const LETTERS_FOR_EACH_DECADE: f64 = 12.0;
    for (name, scene) in [
        ("rigid body", "planar/work"),
        ("restitution table", "table/restitution"),
        ("simulation, FixedCost", "simulation/fixed-oblique-1e-5"),
        ("simulation, Collocation", "simulation/oblique"),
    ] {
        let count = measured(scene, Quantity::Classify);
        let length = (LETTERS_FOR_EACH_DECADE * (count / FROM).log10()).round() as usize;
        let bar = "#".repeat(length);
        let count = count.to_string();
        let line = format!("{name:<29}|{bar}{count:>width$}", width = 57 - length);
        assert!(README.contains(&line), "README.md lacks\n{line}");
    }
}

#[test]
fn footprint_is_that_of_the_measurements() {
    for (name, scene) in [
        ("rigid body, normal, W_A given", "normal/work"),
        ("rigid body, friction and spin, W_A given", "planar/work"),
        ("`FixedCost<5>`, mild damping: error of e 1e-5, not controlled", "simulation/fixed-1e-5"),
        ("the same with friction and spin", "simulation/fixed-oblique-1e-5"),
        ("`Collocation<7>`, tolerance 1e-6", "simulation/normal"),
        ("the same with friction and spin", "simulation/oblique"),
    ] {
        let figures = [Quantity::Classify, Quantity::Flash, Quantity::Stack].map(|quantity| measured(scene, quantity));
        let row = format!("| {name} | {} |", figures.map(|figure| figure.to_string()).join(" | "));
        assert!(README.contains(&row), "README.md lacks the row\n{row}");
        assert_eq!(measured(scene, Quantity::StaticMemory), 0.0);
    }
    assert!(README.contains("No static memory."));
}

/// Its table of accuracy is an extract of the guide's page, which is tested against the tests' bounds.
#[test]
fn accuracy_is_that_of_the_guide() {
    let statements = words(accuracy::PAGE);
    for (on_the_page, in_readme) in [
        ("to 1e-11 of the size of its terms in `f64`", "1e-11 of the size of its terms |"),
        (
            "`f32` agrees with `f64` to 2e-6 from nanometre to centimetre spheres",
            "from nanometre to centimetre spheres | 2e-6;",
        ),
        ("unless a margin is within 1e-5 of one", "unless a margin is within 1e-5 of one |"),
        ("compared with 110 solutions to 20 digits", "| 110 solutions to 20 digits |"),
        (
            "| 9, 1e-9 | 1e-9 | 3e-9 | 3e-8 |",
            "9 nodes, 1e-9 | 110 solutions to 20 digits | e^2 1e-9, indentation 3e-9, all else 3e-8 |",
        ),
        (
            "| 8, 1e-6, `f32` | 2e-6 | 2e-6 | 1e-5 |",
            "8 nodes, 1e-6, `f32` | the same | e^2 2e-6, indentation 2e-6, all else 1e-5 |",
        ),
        (
            "| Adaptive 1e-9 | f64 | 1e-9 | 19390 | 0.046 | 0 | 1.1 | 0 | 0 |",
            "| 0 wrong classes in 19390, at 1e-9, with 1.1 % undecided |",
        ),
        ("except the final spin (0.4 %)", "except the final spin (0.4 %)"),
    ] {
        assert!(statements.contains(on_the_page), "accuracy.md lacks: {on_the_page}");
        assert!(words(README).contains(in_readme), "README.md lacks: {in_readme}");
    }
}

#[test]
fn compiler_is_the_oldest_that_is_tested() {
    let statement = format!("Rust {} or newer", env!("CARGO_PKG_RUST_VERSION"));
    assert!(words(README).contains(&statement), "README.md lacks: {statement}");
}

/// Commands of the command line run as README states them.
#[test]
fn commands_of_the_command_line_run() {
    let lines: Vec<_> = README.lines().filter_map(|line| line.strip_prefix("cargo microimpact ")).collect();
    assert!(!lines.is_empty());
    for line in lines {
        let command = line.split_once('#').map_or(line, |(command, _)| command);
        let words: Vec<_> = command.split_whitespace().collect();
        let output = crate::microimpact(words[0], &words[1..], b"");
        assert!(output.status == 0 && !output.stdout.is_empty(), "{command}: {}", output.complaint());
    }
}

/// Methods of the simulation solve the bundled impacts.
#[test]
fn methods_of_the_command_line_run() {
    for method in ["adaptive", "collocation", "runge-kutta-gill"] {
        let output = crate::microimpact("classify", &["--model", "simulation", "--method", method], b"");
        assert_eq!(output.status, 0, "{method}: {}", output.complaint());
    }
}
