//! The guide's page of the footprint has the figures that were measured.

use boards::REFERENCE_CORE;
use boards::figures::Quantity;
use microimpact::contact::{Contact, FixedCost};
use microimpact::{NormalMotion, Sphere, Stiffness};

use super::{measured, measured_in, measured_on, words};

const PAGE: &str = include_str!("../../../../examples/guide/pages/footprint.md");

/// Scenes by their names on the page and in the measurements.
const SCENES: [(&str, &str); 4] = [
    ("normal, adhesion coefficient given", "normal/coefficient"),
    ("normal, W_A given", "normal/work"),
    ("friction and spin, adhesion coefficient given", "planar/coefficient"),
    ("friction and spin, W_A given", "planar/work"),
];

/// The columns of its table.
const QUANTITIES: [Quantity; 4] = [Quantity::Classify, Quantity::SetUpAndClassify, Quantity::Flash, Quantity::Stack];

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

fn assert_rows_are_current(scenes: &[(&str, &str)], quantities: &[Quantity]) {
    for (name, scene) in scenes {
        let figure = |quantity: &Quantity| measured(scene, *quantity).to_string();
        let row = format!("| {name} | {} |", quantities.iter().map(figure).collect::<Vec<_>>().join(" | "));
        assert!(PAGE.contains(&row), "the page lacks the row\n{row}");
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
        assert!(PAGE.contains(&row), "the page lacks the row\n{row}");
    }
    let words = words(PAGE);
    let (normal, oblique) = (flash("simulation/normal"), flash("simulation/oblique"));
    let statement = format!("and {normal} bytes of flash, {oblique} with friction and spin");
    assert!(words.contains(&statement), "the page lacks: {statement}");
}

#[test]
fn instructions_in_fixed_point_are_current() {
    let words = words(PAGE);
    for (scene, statement) in [
        ("simulation/fixed-point", "takes {M3} instructions on a Cortex-M3 and {M0} on a Cortex-M0"),
        (
            "simulation/fixed-point-oblique",
            "with friction and spin takes {M3} and {M0}, the units of the impact included",
        ),
        ("simulation/fixed-oblique-1e-5", "in f32 `FixedCost<5, 7>` takes {M3} and {M0} there"),
    ] {
        let count = |core: &str| measured_on(core, scene, Quantity::Classify).to_string();
        let statement = statement.replace("{M3}", &count("Cortex-M3")).replace("{M0}", &count("Cortex-M0"));
        assert!(words.contains(&statement), "the page lacks: {statement}");
    }
}

/// Functions by their names on the page and in the measurements.
const FUNCTIONS: [(&str, &str); 4] = [
    ("square root", "function/root"),
    ("power 2/5", "function/two-fifths-power"),
    ("exponential function", "function/decay"),
    ("standard error", "function/standard-error"),
];

#[test]
fn functions_of_micromath_are_current() {
    for (name, scene) in FUNCTIONS {
        let both = |core: &str| {
            ["f32", "micromath"]
                .map(|scalar| measured_in(scalar, core, scene, Quantity::Classify).to_string())
                .join(" / ")
        };
        let counts = ["Cortex-M0", "Cortex-M3", "Cortex-M4F", "RV32IMAC"].map(both).join(" | ");
        let bytes =
            ["f32", "micromath"].map(|scalar| measured_in(scalar, "Cortex-M0", scene, Quantity::Code).to_string());
        let error = measured_in("micromath", REFERENCE_CORE, scene, Quantity::Error);
        let row = format!("| {name} | {counts} | {} | {error:.0e} |", bytes.join(" / "));
        assert!(PAGE.contains(&row), "the page lacks the row\n{row}");
    }
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
    assert!(words(PAGE).contains(&statement), "the page lacks: {statement}");
}

#[test]
fn static_memory_is_none() {
    assert!(PAGE.contains("No static memory."));
    for (_, scene) in SCENES {
        assert_eq!(measured(scene, Quantity::StaticMemory), 0.0);
    }
}

/// The errors of the methods of fixed cost stand in the names of their rows.
#[test]
fn errors_of_fixed_cost_are_the_tested_ones() {
    let tests = include_str!("../../simulation/fixed_cost.rs");
    let added = 1e-6;
    let statement = format!("closer to the critical speed they are up to {added:e} larger");
    assert!(words(PAGE).contains(&statement), "the page lacks: {statement}");
    for (method, row, scene) in [
        ("&FixedCost::<5>::new(3)", "`FixedCost<5>`, 3 iterations, error of e", "simulation/fixed-1e-5"),
        ("&FixedCost::<7>::new(3)", "`FixedCost<7>`, 3 iterations, error of e", "simulation/fixed-1e-6"),
    ] {
        let test = tests.split("#[test]").find(|test| test.contains(method)).unwrap();
        let bound = test.split_once("error < ").unwrap().1.split_once(',').unwrap().0;
        assert!(PAGE.contains(&format!("{row} {bound} |")), "the page lacks: {row} {bound}");
        let error = measured(scene, Quantity::Error);
        assert!(error < bound.parse::<f64>().unwrap() + added, "{scene}: {error:e} on the board");
    }
}
