//! Numbers in README.md are those that were measured.

use std::sync::LazyLock;

use boards::REFERENCE_CORE;
use boards::figures::{Quantity, Stored, largest};
use microimpact::contact::{Collocation, Contact, FixedCost};
use microimpact::{NormalMotion, Sphere, Stiffness};
use reference::scenes::Kind;

const README: &str = include_str!("../../../README.md");
static STORED: LazyLock<Stored> = LazyLock::new(|| Stored::read(&Stored::path()).unwrap());

/// Scenes by their names in README and in the measurements.
const SCENES: [(&str, &str); 4] = [
    ("normal, adhesion coefficient given", "normal/coefficient"),
    ("normal, W_A given", "normal/work"),
    ("friction and spin, adhesion coefficient given", "planar/coefficient"),
    ("friction and spin, W_A given", "planar/work"),
];

/// The columns of README's table.
const QUANTITIES: [Quantity; 4] = [Quantity::Classify, Quantity::SetUpAndClassify, Quantity::Flash, Quantity::Stack];

/// The largest figure of a scene on the core that README mostly speaks of, over impacts and compilers.
fn measured(scene: &str, quantity: Quantity) -> f64 {
    measured_on(REFERENCE_CORE, scene, quantity)
}

/// The same on any core.
fn measured_on(core: &str, scene: &str, quantity: Quantity) -> f64 {
    largest(STORED.all(), core, scene, "f32", quantity).unwrap()
}

/// The same of the simulation and of tables.
const SIMULATED: [(&str, &str); 9] = [
    ("`FixedCost<4>`, 2 iterations, class alone", "simulation/fixed-class"),
    ("`FixedCost<5>`, 3 iterations, error of e 1e-5", "simulation/fixed-1e-5"),
    ("`FixedCost<7>`, 3 iterations, error of e 1e-6", "simulation/fixed-1e-6"),
    ("`FixedCost<5, 7>` with friction and spin", "simulation/fixed-oblique-1e-5"),
    ("`FixedCost<7, 9>` with friction and spin", "simulation/fixed-oblique-1e-6"),
    ("`Collocation<7>`, tolerance 1e-6", "simulation/normal"),
    ("the same with friction and spin", "simulation/oblique"),
    ("boundary table", "table/boundary"),
    ("restitution table with friction and spin", "table/restitution"),
];

/// Methods with their flash when built for speed and for size.
const FLASH: [(&str, [&str; 2]); 2] = [
    ("`FixedCost<5>`", ["simulation/fixed-1e-5", "small/fixed-1e-5"]),
    ("`FixedCost<5, 7>` with friction and spin", ["simulation/fixed-oblique-1e-5", "small/fixed-oblique-1e-5"]),
];

const SIMULATED_QUANTITIES: [Quantity; 2] = [Quantity::Classify, Quantity::Stack];

/// README in one line, as its lines break anywhere.
fn words() -> String {
    README.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn assert_rows_are_current(scenes: &[(&str, &str)], quantities: &[Quantity]) {
    for (name, scene) in scenes {
        let figure = |quantity: &Quantity| measured(scene, *quantity).to_string();
        let row = format!("| {name} | {} |", quantities.iter().map(figure).collect::<Vec<_>>().join(" | "));
        assert!(README.contains(&row), "README.md lacks the row\n{row}");
    }
}

#[test]
fn footprint_tables_are_current() {
    assert_rows_are_current(&SCENES, &QUANTITIES);
    assert_rows_are_current(&SIMULATED, &SIMULATED_QUANTITIES);
}

#[test]
fn flash_of_the_simulation_is_current() {
    let flash = |scene: &str| measured(scene, Quantity::Flash).to_string();
    for (name, scenes) in FLASH {
        let row = format!("| {name} | {} |", scenes.map(flash).join(" | "));
        assert!(README.contains(&row), "README.md lacks the row\n{row}");
    }
    let words = words();
    let (normal, oblique) = (flash("simulation/normal"), flash("simulation/oblique"));
    let statement = format!("and {normal} bytes of flash, {oblique} with friction and spin");
    assert!(words.contains(&statement), "README.md lacks: {statement}");
}

#[test]
fn instructions_in_fixed_point_are_current() {
    let count = |core: &str| measured_on(core, "simulation/fixed-point", Quantity::Classify);
    let (larger, smaller) = (count("Cortex-M3"), count("Cortex-M0"));
    let statement = format!("takes {larger} instructions on a Cortex-M3 and {smaller} on a Cortex-M0");
    assert!(words().contains(&statement), "README.md lacks: {statement}");
}

/// The error bound of the paper's figure 6 at 2.8 m/s, by four nodes and two iterations.
#[test]
fn error_bound_in_fixed_point_is_current() {
    let sphere = Sphere::solid(5.06e-6_f32, 2600.0).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap()).with_damping(10.5).unwrap();
    let scene = scene.with_ring(250.0, 6.25).unwrap();
    let impact = scene.dimensionless(&NormalMotion::new(2.8).unwrap()).unwrap().in_fixed_point().unwrap();
    let bound = impact.solve(&FixedCost::<4>::new(2).unwrap()).error_bound.to_f64();
    // Rounded up.
    let statement = format!("a bound of the error of e^2: {:.1}e-4 for the scene", (bound * 1e5).ceil() / 10.0);
    assert!(words().contains(&statement), "README.md lacks: {statement}");
}

/// What the adaptive method promises.
#[test]
fn promise_of_the_adaptive_method_is_the_tested_one() {
    let test = include_str!("../simulation/adaptive.rs");
    for (bound, words) in [
        ("const LARGEST: f64 = 3.0;", "between 0.001 and 3 times the tolerance"),
        ("const SMALLEST: f64 = 0.001;", "between 0.001 and 3 times the tolerance"),
        ("[f64; 9] = [1e-4,", "from 1e-4 to 1e-12"),
    ] {
        assert!(test.contains(bound) && README.contains(words), "{bound}, {words}");
    }
}

#[test]
fn static_memory_is_none() {
    assert!(README.contains("No static memory."));
    for (_, scene) in SCENES {
        assert_eq!(measured(scene, Quantity::StaticMemory), 0.0);
    }
}

/// The errors that the tests allow are those that README states.
#[test]
fn stated_accuracy_is_the_tested_one() {
    for (file, tolerance, statement) in [
        (include_str!("../rigid/rigid_properties.rs"), "<= 1e-11 * scale", "1e-11 of the size of its terms in `f64`"),
        (include_str!("../rigid/scalars.rs"), "<= 2e-6 * scale", "`f32` agrees with `f64` to 2e-6"),
        (include_str!("../rigid/scalars.rs"), "> 1e-5", "unless a margin is within 1e-5 of one"),
    ] {
        assert!(file.contains(tolerance), "{tolerance}");
        assert!(words().contains(statement), "{statement}");
    }
}

/// The rows of the simulation's accuracy are the bounds of its tests: nodes and tolerance, e^2, indentation, all else.
#[test]
fn accuracy_of_the_simulation_is_the_tested_one() {
    let tests = include_str!("../simulation/simulation_reference.rs");
    for (setting, run) in [
        ("14, 1e-13", "errors::<14, f64>(1e-13"),
        ("12, 1e-12", "errors::<12, f64>(1e-12"),
        ("9, 1e-9", "errors::<9, f64>(1e-9"),
        ("7, 1e-6", "errors::<7, f64>(1e-6"),
        ("8, 1e-6, `f32`", "errors::<8, f32>(1e-6"),
    ] {
        let test = tests.split("#[test]").find(|test| test.contains(run)).unwrap();
        let bound = |name: &str| test.split_once(name).unwrap().1.split_once(',').unwrap().0.trim().to_owned();
        let row =
            format!("| {setting} | {} | {} | {} |", bound("restitution:"), bound("indentation:"), bound("others:"));
        assert!(README.contains(&row), "README.md lacks the row\n{row}");
    }
}

/// The table of random scenes has the stored statistics, which the test `trials` compares with a run.
#[test]
fn statistics_of_random_scenes_are_the_stored_ones() {
    let table = trials::readme_table(&trials::stored().unwrap()).unwrap();
    assert!(README.contains(&table), "README.md lacks the table; `cargo trials --store` writes it\n{table}");
    let (scenes, kinds) = (trials::SCENES, Kind::ALL.len());
    let statement = format!("`cargo trials` solves {scenes} random scenes of each of {kinds} kinds");
    assert!(words().contains(&statement), "README.md lacks: {statement}");
    let data = include_str!("../../data/README.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let statement = format!("over {scenes} random scenes of each kind, seed {},", trials::SEED);
    assert!(data.contains(&statement), "the description of the data lacks: {statement}");
}

/// Numbers in prose come from the data, the library or the bound of the test that checks them.
#[test]
fn numbers_in_prose_are_the_tested_ones() {
    let words = words();
    let intervals = Collocation::<9, f64>::MOST_INTERVALS;
    for statement in [
        format!("compared with {} solutions to 20 digits", reference::cases().len()),
        format!("end in finite numbers within {intervals} intervals"),
        format!("Rust {} or newer", env!("CARGO_PKG_RUST_VERSION")),
    ] {
        assert!(words.contains(&statement), "README.md lacks: {statement}");
    }
    for (file, bound, statement) in [
        (
            include_str!("../simulation/simulation_exact.rs"),
            "const SCENES: u32 = 1_000_000;",
            "One million scenes over twelve decades of every input, or over its range",
        ),
        (
            include_str!("../simulation/simulation_exact.rs"),
            "assert!(spent < all / 500,",
            "fewer than one in two thousand",
        ),
        (include_str!("../rigid/table1.rs"), "(spin / 4.16e4 - 1.0).abs() < 0.004", "except the final spin (0.4 %)"),
    ] {
        assert!(file.contains(bound) && words.contains(statement), "{bound}: {statement}");
    }
}

/// The errors of the methods of fixed cost stand in the names of their rows.
#[test]
fn errors_of_fixed_cost_are_the_tested_ones() {
    let tests = include_str!("../simulation/fixed_cost.rs");
    let added = 1e-6;
    let statement = format!("closer to the critical speed they are up to {added:e} larger");
    assert!(words().contains(&statement), "README.md lacks: {statement}");
    for (method, row, scene) in [
        ("&FixedCost::<5>::new(3)", "`FixedCost<5>`, 3 iterations, error of e", "simulation/fixed-1e-5"),
        ("&FixedCost::<7>::new(3)", "`FixedCost<7>`, 3 iterations, error of e", "simulation/fixed-1e-6"),
    ] {
        let test = tests.split("#[test]").find(|test| test.contains(method)).unwrap();
        let bound = test.split_once("error < ").unwrap().1.split_once(',').unwrap().0;
        assert!(README.contains(&format!("{row} {bound} |")), "README.md lacks: {row} {bound}");
        let error = measured(scene, Quantity::Error);
        assert!(error < bound.parse::<f64>().unwrap() + added, "{scene}: {error:e} on the board");
    }
}

/// Commands of the command line run as README states them, and by the methods that it names.
#[test]
fn commands_of_the_command_line_run() {
    let lines: Vec<_> = README.lines().filter_map(|line| line.strip_prefix("cargo microimpact ")).collect();
    assert!(lines.len() >= 2);
    let mut named = Vec::new();
    for line in lines {
        let (command, remark) = line.split_once('#').unwrap();
        let words: Vec<_> = command.split_whitespace().collect();
        let output = crate::microimpact(words[0], &words[1..], b"");
        // The bundled impacts may include one that a method does not solve.
        assert!(output.status <= 1 && !output.stdout.is_empty(), "{command}: {}", output.complaint());
        if command.contains("--method") {
            named.extend(remark.split([',', ' ']).filter(|word| word.len() > 2));
        }
    }
    assert_eq!(named, ["adaptive", "collocation", "runge-kutta-gill"]);
    for method in named {
        let output = crate::microimpact("classify", &["--model", "simulation", "--method", method], b"");
        assert_eq!(output.status, 0, "{method}: {}", output.complaint());
    }
}
