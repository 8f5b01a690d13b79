//! The guide's page of accuracy has the bounds of the tests, and the statistics that are stored.

use microimpact::contact::Collocation;
use reference::scenes::Kind;

use super::words;

pub const PAGE: &str = include_str!("../../../../examples/guide/pages/accuracy.md");

/// What the adaptive method promises.
#[test]
fn promise_of_the_adaptive_method_is_the_tested_one() {
    let test = include_str!("../../simulation/adaptive.rs");
    for (bound, words) in [
        ("const LARGEST: f64 = 3.0;", "between 0.001 and 3 times the tolerance"),
        ("const SMALLEST: f64 = 0.001;", "between 0.001 and 3 times the tolerance"),
        ("[f64; 9] = [1e-4,", "from 1e-4 to 1e-12"),
    ] {
        assert!(test.contains(bound) && PAGE.contains(words), "{bound}, {words}");
    }
}

/// The errors that the tests allow are those that the page states.
#[test]
fn stated_accuracy_is_the_tested_one() {
    for (file, tolerance, statement) in [
        (
            include_str!("../../rigid/rigid_properties.rs"),
            "<= 1e-11 * scale",
            "1e-11 of the size of its terms in `f64`",
        ),
        (include_str!("../../rigid/scalars.rs"), "<= 2e-6 * scale", "`f32` agrees with `f64` to 2e-6"),
        (include_str!("../../rigid/scalars.rs"), "> 1e-5", "unless a margin is within 1e-5 of one"),
    ] {
        assert!(file.contains(tolerance), "{tolerance}");
        assert!(words(PAGE).contains(statement), "{statement}");
    }
}

/// The rows of the simulation's accuracy are the bounds of its tests: nodes and tolerance, e^2, indentation, all else.
#[test]
fn accuracy_of_the_simulation_is_the_tested_one() {
    let tests = include_str!("../../simulation/simulation_reference.rs");
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
        assert!(PAGE.contains(&row), "the page lacks the row\n{row}");
    }
}

/// The table of random scenes has the stored statistics, which the test `trials` compares with a run.
#[test]
fn statistics_of_random_scenes_are_the_stored_ones() {
    let table = trials::guide_table(&trials::stored().unwrap()).unwrap();
    assert!(PAGE.contains(&table), "the page lacks the table; `cargo trials --store` writes it\n{table}");
    let (scenes, kinds) = (trials::SCENES, Kind::ALL.len());
    let statement = format!("`cargo trials` solves {scenes} random scenes of each of {kinds} kinds");
    assert!(words(PAGE).contains(&statement), "the page lacks: {statement}");
    let data = include_str!("../../../data/README.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let statement = format!("over {scenes} random scenes of each kind, seed {},", trials::SEED);
    assert!(data.contains(&statement), "the description of the data lacks: {statement}");
}

/// Numbers in prose come from the data, the library or the bound of the test that checks them.
#[test]
fn numbers_in_prose_are_the_tested_ones() {
    let words = words(PAGE);
    let intervals = Collocation::<9, f64>::MOST_INTERVALS;
    for statement in [
        format!("compared with {} solutions to 20 digits", reference::cases().len()),
        format!("end in finite numbers within {intervals} intervals"),
    ] {
        assert!(words.contains(&statement), "the page lacks: {statement}");
    }
    for (file, bound, statement) in [
        (
            include_str!("../../simulation/simulation_exact.rs"),
            "const SCENES: u32 = 1_000_000;",
            "One million scenes over twelve decades of every input, or over its range",
        ),
        (
            include_str!("../../simulation/simulation_exact.rs"),
            "assert!(spent < all / 500,",
            "fewer than one in two thousand",
        ),
        (include_str!("../../rigid/table1.rs"), "(spin / 4.16e4 - 1.0).abs() < 0.004", "except the final spin (0.4 %)"),
    ] {
        assert!(file.contains(bound) && words.contains(statement), "{bound}: {statement}");
    }
}
