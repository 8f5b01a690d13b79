//! The command `population`, and the statistics behind it.

mod statistics;

use std::collections::HashMap;
use std::path::PathBuf;

use population::{Distribution, Population, RigidBodies, Statistics, wilson};

use crate::{Output, microimpact};

fn run(arguments: &[&str], input: &str) -> Output {
    microimpact("population", arguments, input.as_bytes())
}

/// A file of this test in the system's folder for temporary files.
fn file(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("microimpact-population-{}-{name}", std::process::id()))
}

/// Rows of the CSV format, by their columns.
fn rows(output: &Output) -> Vec<HashMap<String, String>> {
    csv::Reader::from_reader(output.stdout.as_slice()).deserialize().map(Result::unwrap).collect()
}

/// The one row of a quantity.
fn number(rows: &[HashMap<String, String>], quantity: &str) -> f64 {
    let mut found = rows.iter().filter(|row| row["quantity"] == quantity);
    let value = found.next().unwrap_or_else(|| panic!("no {quantity}"))["value"].parse().unwrap();
    assert!(found.next().is_none(), "{quantity} twice");
    value
}

const RIGID: &str = "diameter_median_m,diameter_geometric_deviation,speed_median_m_s,speed_geometric_deviation,angle_deg,\
                     density_kg_m3,restitution_speed_m_s,work_of_adhesion_j,friction\n\
                     8.6e-6,1.2,2.7,1.3,40,2600,130,2.22e-12,0.1\n";

#[test]
fn shows_populations_of_the_paper() {
    for model in ["simulation", "rigid-body"] {
        let output = run(&["--model", model], "");
        assert_eq!(output.status, 0, "{}", output.complaint());
        let text = String::from_utf8(output.stdout).unwrap();
        for words in ["Mean of figure 6: 8.6 um", "captured rolling", "by mass", "bounce", "95 % of 100", "skewness"] {
            assert!(text.contains(words), "{text}");
        }
        assert!(!text.contains("bad row"), "{text}");
    }
}

/// The numbers of the command are those of the library.
#[test]
fn a_row_is_a_population() {
    let output = run(&["-", "--model", "rigid-body", "--format", "csv", "--speeds", "2,4", "--particles", "50"], RIGID);
    assert_eq!(output.status, 0, "{}", output.complaint());
    let rows = rows(&output);
    let population = Population {
        diameter: Distribution::log_normal(8.6e-6, 1.2).unwrap(),
        adhesion: Distribution::fixed(2.22e-12).unwrap(),
        angle: Distribution::fixed(40.0_f64.to_radians()).unwrap(),
        speed: Distribution::log_normal(2.7, 1.3).unwrap(),
    };
    let bodies = RigidBodies(|diameter: f64, work: f64| {
        let sphere = microimpact::Sphere::solid(0.5 * diameter, 2600.0)?;
        let law = microimpact::SpeedRestitution::new(130.0)?;
        microimpact::RigidBody::new(sphere, law).with_work_of_adhesion(work)?.with_friction(0.1)
    });
    let statistics = Statistics::direct(&population, &bodies);
    let outcomes = statistics.outcomes().unwrap();
    let restitution = outcomes.restitution();
    for (quantity, expected) in [
        ("probability_capture", outcomes.capture()),
        ("probability_rebound_sliding", outcomes.rebound_sliding()),
        ("probability_captured_sliding", outcomes.captured_sliding()),
        ("probability_capture_by_mass", statistics.outcomes_by_mass().unwrap().capture()),
        ("restitution_mean", restitution.mean),
        ("restitution_skewness", restitution.skewness),
    ] {
        assert!((number(&rows, quantity) - expected.value).abs() < 1e-9, "{quantity}");
    }
    assert!(outcomes.rebound_sliding().value > 0.01 && outcomes.captured_sliding().value > 0.01);
    let bounces: Vec<_> = rows.iter().filter(|row| row["quantity"] == "bounce_fraction").collect();
    assert_eq!(bounces.len(), 2);
    for (row, speed) in bounces.iter().zip([2.0, 4.0]) {
        let rebound = statistics.at_speed(speed).unwrap().rebound().value;
        let [low, high] = wilson(rebound, 50.0);
        for (column, expected) in [("from", speed), ("value", rebound), ("low", low), ("high", high)] {
            assert!((row[column].parse::<f64>().unwrap() - expected).abs() < 1e-9, "{column} at {speed}");
        }
    }
    // Ranges cover all but a thousandth to either side.
    let parts: f64 = rows
        .iter()
        .filter(|row| row["quantity"] == "number_fraction")
        .map(|row| row["value"].parse::<f64>().unwrap())
        .sum();
    assert!((parts - 0.998).abs() < 1e-6);
}

/// The laws that a table chooses, by distributions of both kinds.
#[test]
fn all_laws_and_distributions() {
    let table = "name,diameter_m,diameter_mean_m,diameter_deviation_m,speed_m_s,density_kg_m3,stiffness_pa,law,\
                 adhesion_median_n_m,adhesion_geometric_deviation,work_of_adhesion_mean_j_m2,work_of_adhesion_deviation_j_m2\n\
                 ring,5e-6,,,2,2600,7.5e10,,200,1.5,,\n\
                 dmt,5e-6,,,0.05,2600,7.5e10,dmt,,,0.05,0.02\n\
                 jkr,,5e-6,2e-6,0.05,2600,7.5e10,jkr,,,0.05,0.005\n\
                 hertz,,5e-6,2e-6,0.05,2600,7.5e10,,,,,\n";
    let output = run(&["-", "--format", "json"], table);
    assert_eq!(output.status, 0, "{}", output.complaint());
    let answers: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let capture = |index: usize| answers[index]["classes_by_number"]["capture"]["value"].as_f64().unwrap();
    // Undamped contacts without a barrier of adhesion, and without friction to capture them, rebound at every speed.
    for (index, name) in ["ring", "dmt", "jkr", "hertz"].iter().enumerate() {
        assert_eq!(answers[index]["population"], *name);
        assert!((0.0..=1.0).contains(&capture(index)), "{name}: {}", capture(index));
    }
    assert!(capture(2) > 0.1 && capture(2) < 0.9, "{}", capture(2));
    assert_eq!(capture(3), 0.0);
}

/// A radius is half of the diameter, in each way to give a size.
#[test]
fn a_size_is_a_diameter_or_a_radius() {
    let others = ["speed_m_s=2.7", "density_kg_m3=2600", "restitution_speed_m_s=130", "work_of_adhesion_j=2.22e-12"];
    let run = |size: &[&str], samples: &[&str]| {
        let given =
            [&["--model", "rigid-body", "--format", "csv", "--bins", "2", "--given"], &others[..], size].concat();
        run(&[&given[..], samples].concat(), "")
    };
    for [diameter, radius] in [
        [&["diameter_um=8.6"][..], &["radius_um=4.3"]],
        [
            &["diameter_median_m=8.6e-6", "diameter_geometric_deviation=1.2"],
            &["radius_median_m=4.3e-6", "radius_geometric_deviation=1.2"],
        ],
        [
            &["diameter_mean_m=8.6e-6", "diameter_deviation_m=1e-6"],
            &["radius_mean_m=4.3e-6", "radius_deviation_m=5e-7"],
        ],
    ] {
        let (diameter, radius) = (run(diameter, &[]), run(radius, &[]));
        assert_eq!((diameter.status, radius.status), (0, 0), "{}{}", diameter.complaint(), radius.complaint());
        assert!(diameter.stdout == radius.stdout && !radius.complaint().contains("not read"), "{}", radius.complaint());
    }
    let [diameters, radii] =
        [("diameter_m", [6e-6, 8e-6, 1.2e-5]), ("radius_m", [3e-6, 4e-6, 6e-6])].map(|(column, values)| {
            let path = file(&format!("{column}.csv"));
            std::fs::write(&path, format!("{column}\n{}\n{}\n{}\n", values[0], values[1], values[2])).unwrap();
            (format!("{column}={}", path.display()), path)
        });
    let of_samples = [&diameters, &radii].map(|(samples, _)| run(&[], &["--samples", samples]));
    assert_eq!(of_samples.each_ref().map(|output| output.status), [0, 0], "{}", of_samples[1].complaint());
    assert_eq!(of_samples[0].stdout, of_samples[1].stdout);
    for (size, samples, words) in [
        (&["radius_m=4e-6", "diameter_m=8e-6"][..], &[][..], "diameter_m: given twice, by diameter_m and radius_m"),
        (&["radius_m=4e-6"], &["--samples", &diameters.0], "given twice, by radius_m and --samples diameter_m"),
        (&["radius_median_m=4e-6", "diameter_geometric_deviation=1.2"], &[], "radius_geometric_deviation: missing"),
        (&["radius_m=4e-6", "diameter_deviation_m=1e-7"], &[], "diameter_deviation_m: it goes with another way"),
        (&["radius_m=-4e-6"], &[], "radius_m: -4e-6 is refused: it must be positive"),
    ] {
        let output = run(size, samples);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status == 1 && text.contains(words), "{size:?}: {text}");
    }
    for (_, path) in [diameters, radii] {
        std::fs::remove_file(path).unwrap();
    }
}

/// Samples are the distribution: the answer is the mean over single spheres.
#[test]
fn samples_of_a_file() {
    let path = file("samples.csv");
    std::fs::write(&path, "diameter_m\n6e-6\n7e-6\n8e-6\n1.2e-5\n").unwrap();
    let samples = format!("diameter_m={}", path.display());
    let given = [
        "--given",
        "speed_median_m_s=1.9",
        "speed_geometric_deviation=1.2",
        "density_kg_m3=2600",
        "stiffness_pa=7.5e10",
        "adhesion_n_m=250",
        "zeta_h=10.5",
        "zeta_a=6.25",
        "--format",
        "csv",
    ];
    let whole = run(&[&["--samples", samples.as_str(), "--bins", "4"][..], &given].concat(), "");
    assert_eq!(whole.status, 0, "{}", whole.complaint());
    let mut mean = 0.0;
    for diameter in ["6e-6", "7e-6", "8e-6", "1.2e-5"] {
        let diameter = format!("diameter_m={diameter}");
        let one = run(&[&given[..], &["--given", diameter.as_str()]].concat(), "");
        assert_eq!(one.status, 0, "{}", one.complaint());
        mean += 0.25 * number(&rows(&one), "probability_capture");
    }
    let whole = rows(&whole);
    assert!((number(&whole, "probability_capture") - mean).abs() < 1e-5, "{mean}");
    let parts: f64 = whole
        .iter()
        .filter(|row| row["quantity"] == "number_fraction")
        .map(|row| row["value"].parse::<f64>().unwrap())
        .sum();
    assert!((parts - 1.0).abs() < 1e-12, "all samples are in a range");
    std::fs::remove_file(path).unwrap();
}

#[test]
fn draws_a_population() {
    let path = file("figure.svg");
    let output = run(&["-", "--model", "rigid-body", "--figure", path.to_str().unwrap()], RIGID);
    assert_eq!(output.status, 0, "{}", output.complaint());
    let drawing = std::fs::read_to_string(&path).unwrap();
    for words in ["<svg", "diameter, um", "bounce fraction"] {
        assert!(drawing.contains(words));
    }
    std::fs::remove_file(path).unwrap();
}

#[test]
fn the_example_of_the_help_runs() {
    let help = run(&["--help"], "").complaint();
    let (_, example) = help.split_once("cargo microimpact population ").expect("an example");
    let (arguments, _) = example.split_once('`').expect("what follows it");
    let path = file("example.svg");
    let words = arguments.split_whitespace().filter(|word| *word != "\\");
    let output = run(&words.chain(["--figure"]).chain(path.to_str()).collect::<Vec<_>>(), "");
    assert_eq!(output.status, 0, "{}", output.complaint());
    assert!(String::from_utf8_lossy(&output.stdout).contains("Largest error"));
    std::fs::remove_file(path).unwrap();
}

#[test]
fn says_what_it_refuses() {
    let row = |changed: &str, value: &str| {
        let (header, cells) = RIGID.trim().split_once('\n').unwrap();
        let cells: Vec<_> = header
            .split(',')
            .zip(cells.split(','))
            .map(|(name, cell)| if name == changed { value } else { cell })
            .collect();
        format!("{header}\n{}\n", cells.join(","))
    };
    for (column, value, words) in [
        ("diameter_median_m", "-1e-6", "diameter_median_m: -1e-6 is refused: it must be positive"),
        (
            "diameter_median_m",
            "8.6",
            "diameter_median_m: 8.6 m is refused: it must be 2e-10 to 2 m; enter 8.6 um as 8.6e-6",
        ),
        ("diameter_geometric_deviation", "20", "diameter_median_m: the distribution reaches from "),
        (
            "diameter_geometric_deviation",
            "0.5",
            "diameter_geometric_deviation: a geometric standard deviation of 0.5 is refused: it must be at least 1",
        ),
        ("diameter_geometric_deviation", "", "diameter_geometric_deviation: missing"),
        ("speed_median_m_s", "", "speed_m_s or speed_median_m_s or speed_mean_m_s: missing"),
        ("angle_deg", "95", "an angle of incidence must be 0 to 89.9 degrees"),
        ("density_kg_m3", "-1", "density_kg_m3: \"-1\" is refused"),
        ("friction", "-1", "friction: \"-1\" is refused"),
        ("restitution_speed_m_s", "", "restitution: missing"),
        ("work_of_adhesion_j", "-1", "work of adhesion"),
    ] {
        let output = run(&["-", "--model", "rigid-body"], &row(column, value));
        assert_eq!(output.status, 1, "{column} {value}: {}", output.complaint());
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains(words), "{column} {value}: {text}");
    }
    for (arguments, words) in [
        (vec!["--samples", "mass_kg=x.csv"], "mass_kg has no distribution"),
        (vec!["--samples", "diameter_m=missing.csv"], "missing.csv"),
        (vec!["--given", "diameter_m"], "enter NAME=VALUE"),
        (vec!["--given", "diameter_m=1e-6"], "lacks required columns"),
        (vec!["--edges", "2e-6,1e-6"], "in increasing order"),
        (vec!["--edges", "5,8,10"], "--edges: 5 m is refused: a diameter must be at most 2 m; enter 5 um as 5e-6"),
        (vec!["--speeds=-1"], "give positive speeds"),
        (vec!["--model", "rigid-body", "--tolerance", "1e-6"], "--tolerance does not apply"),
        (vec!["--model", "rigid-body", "--figure", "x.svg"], "--figure draws one population"),
    ] {
        let output = run(&arguments, "");
        assert_eq!(output.status, 2, "{arguments:?}");
        assert!(output.complaint().contains(words), "{}", output.complaint());
    }
}
