//! Numbers in README.md are those that were measured.

use std::collections::HashMap;

const README: &str = include_str!("../../README.md");
const FOOTPRINT: &str = include_str!("../data/footprint.csv");

/// Scenes by their names in README and in the measurements.
const SCENES: [(&str, &str); 4] = [
    ("normal, rho given", "normal/coefficient"),
    ("normal, W_A given", "normal/work"),
    ("friction and spin, rho given", "planar/coefficient"),
    ("friction and spin, W_A given", "planar/work"),
];

/// The columns of README's table, by the names of the measured quantities.
const QUANTITIES: [&str; 4] = ["classify", "set up and classify", "flash", "stack"];

/// The largest figure of each scene and quantity on the core that README speaks of, over impacts and compilers.
fn measured() -> HashMap<(String, String), u32> {
    let mut largest = HashMap::new();
    let mut reader = csv::Reader::from_reader(FOOTPRINT.as_bytes());
    let names = reader.headers().unwrap().clone();
    let column = |name: &str| names.iter().position(|column| column == name).unwrap();
    let (core, scalar, scene) = (column("core"), column("scalar"), column("scene"));
    let (quantity, value) = (column("quantity"), column("value"));
    for record in reader.records() {
        let record = record.unwrap();
        if &record[core] == "Cortex-M4F" && &record[scalar] == "f32" {
            let figure = largest.entry((record[scene].to_owned(), record[quantity].to_owned())).or_insert(0);
            *figure = record[value].parse::<u32>().unwrap().max(*figure);
        }
    }
    largest
}

#[test]
fn footprint_table_is_current() {
    let measured = measured();
    for (name, scene) in SCENES {
        let figures: Vec<String> =
            QUANTITIES.iter().map(|quantity| measured[&(scene.into(), (*quantity).into())].to_string()).collect();
        let row = format!("| {name} | {} |", figures.join(" | "));
        assert!(README.contains(&row), "README.md lacks the row\n{row}");
    }
}

#[test]
fn static_memory_is_none() {
    assert!(README.contains("No static memory."));
    for (_, scene) in SCENES {
        assert_eq!(measured()[&(scene.into(), "static memory".into())], 0);
    }
}

/// The errors that the tests allow are those that README states.
#[test]
fn stated_accuracy_is_the_tested_one() {
    for (file, tolerance, statement) in [
        (include_str!("rigid_properties.rs"), "<= 1e-11 * scale", "1e-11 of the size of its terms in `f64`"),
        (include_str!("scalars.rs"), "<= 2e-6 * scale", "`f32` agrees with `f64` to 2e-6"),
        (include_str!("scalars.rs"), "> 1e-5", "wherever a margin is farther than 1e-5 from one"),
    ] {
        assert!(file.contains(tolerance), "{tolerance}");
        assert!(README.split_whitespace().collect::<Vec<_>>().join(" ").contains(statement), "{statement}");
    }
}
