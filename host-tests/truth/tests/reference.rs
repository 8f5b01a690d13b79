//! The solver against reference solutions with 20 digits.

use std::f64::consts::PI;

use truth::{Double, Outcome, Truth, solve_exactly};

/// More than any scene of the reference needs.
const STEPS: u32 = 1000;

/// The columns of the 13 numbers of a scene, each with its value where a file lacks it.
const INPUTS: [(&str, &str); 13] = [
    ("radius_m", ""),
    ("density_kg_m3", ""),
    ("gyration_ratio", "0.4"),
    ("stiffness_pa", ""),
    ("adhesion_n_m", ""),
    ("zeta_h", ""),
    ("zeta_a", ""),
    ("friction", ""),
    ("peeling_n_m", ""),
    ("external_force_n", "0"),
    ("speed_normal_m_s", ""),
    ("speed_tangential_m_s", ""),
    ("spin_rad_s", ""),
];

/// What a capture has, and what only a rebound has.
fn outputs(truth: &Truth) -> [(&'static str, Option<Double>); 14] {
    [
        ("max_indentation_m", truth.peak),
        ("turning_indentation_m", truth.turning),
        ("time_peak_s", truth.peak_time),
        ("restitution", Some(truth.restitution_squared.sqrt())),
        ("contact_time_s", Some(truth.time)),
        ("time_roll_s", Some(truth.roll_time.unwrap_or(Double::from(-1.0)))),
        ("impulse_hertz_n_s", Some(truth.elastic_impulse)),
        ("impulse_adhesion_rebound_n_s", Some(truth.adhesion_impulse)),
        ("work_material_j", Some(truth.material_work)),
        ("work_adhesion_j", Some(truth.adhesion_work)),
        ("speed_tangential_out_m_s", Some(truth.velocity)),
        ("spin_out_rad_s", Some(truth.spin)),
        ("rotation_rad", Some(truth.rotation)),
        ("displacement_tangential_m", Some(truth.displacement)),
    ]
}

const OF_CAPTURES: usize = 3;

/// Relative error that is allowed. Near the critical speed a difference of energies is that much larger than itself.
fn allowed(name: &str, digits: f64) -> f64 {
    let distance = name.split_once("_vc").and_then(|(_, distance)| distance.parse::<f64>().ok());
    distance.map_or(digits, |distance| digits / distance.abs().min(1.0))
}

fn assert_agrees(file: &str, digits: f64) {
    let mut reader = csv::Reader::from_reader(file.as_bytes());
    let names = reader.headers().unwrap().clone();
    let mut compared = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let cell = |column: &str| names.iter().position(|name| name == column).map(|index| &row[index]);
        let name = cell("name").unwrap();
        let numbers = INPUTS.map(|(column, missing)| cell(column).unwrap_or(missing).parse::<Double>().unwrap());
        let [radius, density, .., speed, _, _] = numbers.map(Double::to_f64);
        let energy = 2.0 / 3.0 * PI * radius.powi(3) * density * speed * speed;
        let truth = solve_exactly(&numbers, STEPS);
        let rebounds = cell("outcome") == Some("rebound");
        assert!(truth.complete, "{name}: {truth:?}");
        assert_eq!(truth.outcome == Some(Outcome::Rebound), rebounds, "{name}");
        assert!(!rebounds || truth.rolls == (cell("motion") == Some("rolling")), "{name}");
        for (column, found) in &outputs(&truth)[..if rebounds { 14 } else { OF_CAPTURES }] {
            let text = cell(column).unwrap();
            if text == "nan" || (text == "-1" && *column != "time_roll_s") {
                assert!(found.is_none(), "{name}, {column}: {found:?}");
                continue;
            }
            let expected: Double = text.parse().unwrap();
            let found = found.unwrap_or_else(|| panic!("{name}, {column} is missing"));
            // The work of the materials is what the other energies leave.
            let scale = match *column {
                "work_material_j" => energy,
                _ if expected == Double::ZERO => 1.0,
                _ => expected.to_f64(),
            };
            let error = (found - expected).to_f64() / scale;
            assert!(error.abs() < allowed(name, digits), "{name}, {column}: {error:.1e}");
            compared += 1;
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// Twenty digits of inputs and outputs.
#[test]
fn cases() {
    assert_agrees(include_str!("../../data/cases.csv"), 1e-17);
}

/// Their inputs are given with 16 digits.
#[test]
fn hard_cases() {
    assert_agrees(include_str!("../../data/hard.csv"), 1e-14);
}
