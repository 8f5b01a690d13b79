//! A template is a table that its command reads, as it is and with the rows of a user.

use std::collections::BTreeSet;

use crate::classify::Written;
use crate::fit::{DIAMETER, restitution};
use crate::{Output, microimpact};

/// A way to compute a table: the command, the options that it shares with its template, and those of its own.
type Way = (&'static str, &'static [&'static str], &'static [&'static str]);

const WAYS: [Way; 10] = [
    ("classify", &["--model", "rigid-body"], CSV),
    ("classify", &["--model", "simulation"], CSV),
    ("classify", &["--model", "both"], CSV),
    ("trajectory", &[], CSV),
    ("critical", &[], CSV),
    ("analyse", &[], CSV),
    // One law of seven, which compete for half a minute where a test is compiled without optimization.
    ("fit", &[], &["--format", "csv", "--law", "speed-restitution"]),
    ("joint-fit", &[], &["--format", "csv", "--diameter", "1.012e-5", "--diameter-error", "1e-7"]),
    ("population", &[], CSV),
    ("population", &["--model", "rigid-body"], CSV),
];
const CSV: &[&str] = &["--format", "csv"];

/// Fewest impacts of a joint fit; for a fit they are enough.
const FITTED: i32 = 15;

fn template(command: &str, options: &[&str], decimal: &str) -> String {
    let template = microimpact("template", &[&[command, "--decimal", decimal], options].concat(), b"");
    assert_eq!(template.status, 0, "{}", template.complaint());
    String::from_utf8(template.stdout).unwrap()
}

/// The row of a template again and again, with measurements by the paper's law in the columns of speeds.
fn filled(template: &str, decimal: &str, count: i32) -> String {
    let delimiter = if decimal == "comma" { b';' } else { b',' };
    let row = Written::read(template.as_bytes(), delimiter);
    let mut rows = csv::WriterBuilder::new().delimiter(delimiter).from_writer(Vec::new());
    rows.write_record(&row.names).unwrap();
    let number = |value: f64| format!("{value:.4}").replace('.', if decimal == "comma" { "," } else { "." });
    for index in 0..count {
        let speed = 2.0 * 1.1_f64.powi(index);
        let e = restitution(speed, DIAMETER);
        let cells = row.names.iter().map(|name| match name.as_str() {
            "name" => format!("impact {index}"),
            "speed_normal_m_s" => number(speed),
            "rebound_speed_m_s" => number(e * speed),
            "overall_restitution" => number(e),
            other => row.text(0, other).to_owned(),
        });
        rows.write_record(cells).unwrap();
    }
    String::from_utf8(rows.into_inner().unwrap()).unwrap()
}

fn computed(command: &str, options: &[&str], table: &str) -> Output {
    let output = microimpact(command, &[&["-"], options].concat(), table.as_bytes());
    assert_eq!(output.status, 0, "{command}: {}{}", output.complaint(), String::from_utf8_lossy(&output.stdout));
    assert!(!output.complaint().contains("not read"), "{}", output.complaint());
    output
}

/// All commands that read a table compute their template with rows in it, in either convention.
#[test]
fn filled_templates_are_computed() {
    for (command, options, own) in WAYS {
        for decimal in ["point", "comma"] {
            let template = template(command, options, decimal);
            assert_eq!(template.contains(';'), decimal == "comma");
            let count = if command.ends_with("fit") { FITTED } else { 2 };
            computed(command, &[options, own].concat(), &filled(&template, decimal, count));
            // One impact is too few for a joint fit.
            if command != "joint-fit" {
                computed(command, &[options, own].concat(), &template);
            }
        }
    }
    let columns = Written::read(&microimpact("columns", CSV, b"").stdout, b',');
    let readers = (0..columns.rows.len()).flat_map(|row| columns.text(row, "read_by").split(", "));
    let readers: BTreeSet<_> = readers.filter(|command| !command.is_empty()).collect();
    assert_eq!(readers, WAYS.map(|(command, ..)| command).into());
}

/// The template of a fit asks for all that its answer needs: works are in J, and the critical speed has the size of the sphere.
#[test]
fn a_fit_of_its_template_knows_the_mass() {
    let table = filled(&template("fit", &[], "point"), "point", FITTED);
    let answer = computed("fit", &["--format", "json", "--law", "speed-restitution"], &table);
    let answer: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert!(answer["parameters"]["work_of_adhesion_j"].is_object(), "{answer}");
    // What it misses it says.
    let without: Vec<_> = table.lines().map(|line| line.rsplit_once(',').unwrap().0).collect();
    let output = computed("fit", &["--law", "speed-restitution"], &without.join("\n"));
    assert!(output.complaint().contains("density_kg_m3 (not known; works are in J/kg)"), "{}", output.complaint());
}
