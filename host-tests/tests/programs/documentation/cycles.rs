//! The guide's modelled cycles are the stored ones.

use std::collections::HashMap;

use super::words;

const PAGE: &str = include_str!("../../../../examples/guide/pages/footprint.md");
const STORED: &str = include_str!("../../../data/cycles.csv");

/// The columns of the page.
const CORES: [&str; 6] = ["Cortex-M0", "Cortex-M3", REFERENCE, "Cortex-M33", "Cortex-M7", "RV32IMAC"];
const REFERENCE: &str = "Cortex-M4F";
/// The clock of the microseconds on the page, in MHz.
const CLOCK: f64 = 168.0;

const DEFAULT_BUILD: &str = "opt-level 3, fat LTO";
const BUILDS: [&str; 4] = [DEFAULT_BUILD, "no LTO", "opt-level s", FOR_CPU];
const FOR_CPU: &str = "target-cpu=cortex-m4";
/// The scene whose builds are compared.
const COMPARED: &str = "simulation/fixed-1e-6";

/// Scenes by their names on the page and in the file.
const SCENES: [(&str, &str); 9] = [
    ("rigid body, normal", "normal/work"),
    ("rigid body, friction and spin", "planar/work"),
    ("`FixedCost<5>`", "simulation/fixed-1e-5"),
    ("`FixedCost<7>`", COMPARED),
    ("`FixedCost<5, 7>` with friction and spin", "simulation/fixed-oblique-1e-5"),
    ("rigid body in fixed point, normal", "normal/work-fixed-point"),
    ("`FixedCost<4>` in fixed point", "simulation/fixed-point"),
    ("`Collocation<7>`", "simulation/normal"),
    ("`Collocation<7>` with friction and spin", "simulation/oblique"),
];

/// Instructions, and the fewest and the most cycles.
fn stored(core: &str, build: &str, scene: &str) -> [f64; 3] {
    let mut reader = csv::Reader::from_reader(STORED.as_bytes());
    let rows = reader.deserialize::<HashMap<String, String>>().map(Result::unwrap);
    let mut own = rows.filter(|row| row["core"] == core && row["build"] == build && row["scene"] == scene);
    let row = own.next().unwrap_or_else(|| panic!("no cycles of {core}, {build}, {scene}"));
    ["instructions", "cycles, least", "cycles, most"].map(|column| row[column].parse().unwrap())
}

fn range([_, least, most]: [f64; 3]) -> String {
    if least == most { least.to_string() } else { format!("{least} to {most}") }
}

fn assert_has(text: &str, part: &str) {
    assert!(text.contains(part), "the page lacks\n{part}");
}

#[test]
fn cycles_are_the_stored_ones() {
    for (name, scene) in SCENES {
        let cells = CORES.map(|core| range(stored(core, DEFAULT_BUILD, scene)));
        assert_has(PAGE, &format!("| {name} | {} |", cells.join(" | ")));
    }
    for build in BUILDS {
        let figures = stored(REFERENCE, build, COMPARED);
        assert_has(PAGE, &format!("| {build} | {} | {} |", figures[0], range(figures)));
    }
}

#[test]
fn microseconds_follow_from_the_cycles() {
    let at_clock = |scene| {
        let [_, least, most] = stored(REFERENCE, DEFAULT_BUILD, scene);
        format!("{:.1} to {:.1}", least / CLOCK, most / CLOCK)
    };
    let [rigid, fixed, collocation] =
        ["planar/work", "simulation/fixed-oblique-1e-5", "simulation/oblique"].map(at_clock);
    let statement = format!(
        "At {CLOCK} MHz a {REFERENCE} takes {rigid} microseconds for the rigid body with friction and spin, {fixed} for \
         `FixedCost<5, 7>` and {collocation} for `Collocation<7>`"
    );
    assert_has(&words(PAGE), &statement);
}

#[test]
fn more_instructions_can_be_fewer_cycles() {
    let [default, for_cpu] = [DEFAULT_BUILD, FOR_CPU].map(|build| stored(REFERENCE, build, COMPARED));
    let more = 100.0 * (for_cpu[0] / default[0] - 1.0);
    let fewer = 100.0 * (1.0 - (for_cpu[1] + for_cpu[2]) / (default[1] + default[2]));
    assert_has(&words(PAGE), &format!("it takes {more:.0} % more instructions and {fewer:.0} % fewer cycles"));
}
