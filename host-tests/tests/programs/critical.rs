//! The command `critical`.

use crate::{Output, microimpact};

const REFERENCE: &str = include_str!("../../data/critical.csv");

/// The critical speeds of the reference, the last of its columns.
fn reference() -> impl Iterator<Item = f64> {
    let mut reader = csv::Reader::from_reader(REFERENCE.as_bytes());
    let speeds: Vec<f64> =
        reader.records().map(|row| row.unwrap().iter().next_back().unwrap().parse().unwrap()).collect();
    speeds.into_iter()
}

fn run(arguments: &[&str], input: &str) -> Output {
    microimpact("critical", arguments, input.as_bytes())
}

/// The rows of a table that was written, without its header, and the header.
fn written(output: &Output) -> (csv::StringRecord, Vec<csv::StringRecord>) {
    let mut reader = csv::Reader::from_reader(output.stdout.as_slice());
    (reader.headers().unwrap().clone(), reader.records().map(Result::unwrap).collect())
}

#[test]
fn shows_spheres_of_the_paper() {
    let output = run(&[], "");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    for (name, critical) in [("5 um", "5.1595667"), ("10.12 um", "1.4148114"), ("no adhesion", "always rebounds")] {
        assert!(text.lines().any(|line| line.contains(name) && line.contains(critical)), "{text}");
    }
}

#[test]
fn adds_the_speed_to_each_row() {
    for (scalar, tolerance, allowed) in [("f64", "1e-12", 2e-12), ("f64", "1e-9", 1e-9), ("f32", "1e-6", 2e-6)] {
        let output = run(&["-", "--format", "csv", "--tolerance", tolerance, "--scalar", scalar], REFERENCE);
        assert_eq!(output.status, 0, "{}", output.complaint());
        let (header, rows) = written(&output);
        let names: Vec<_> = header.iter().skip(7).collect();
        assert_eq!(names, ["input_critical_speed_m_s", "critical_speed_m_s", "critical", "law", "error"]);
        for (row, exact) in rows.iter().zip(reference()) {
            let found: f64 = row[8].parse().unwrap();
            assert!((found / exact - 1.0).abs() <= allowed, "{found} for {exact}");
            assert_eq!((&row[9], &row[10], &row[11]), ("speed", "ring", ""));
        }
    }
}

#[test]
fn says_what_it_cannot_find() {
    let table = "radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,external_force_n\n\
                 2.5e-6,2600,7.5e10,,10.5,,\n\
                 2.5e-6,2600,7.5e10,250,1e5,,\n\
                 -1,2600,7.5e10,250,10.5,6.25,\n\
                 2.5e-6,2600,,250,10.5,6.25,\n\
                 2.5e-6,2600,7.5e10,250,10.5,6.25,-1e-6\n";
    let output = run(&["-", "--format", "csv"], table);
    assert_eq!(output.status, 1);
    let (_, rows) = written(&output);
    let words: Vec<_> = rows.iter().map(|row| (row[7].is_empty(), &row[8], row[10].is_empty())).collect();
    assert_eq!(
        words,
        [
            (true, "always rebounds", true),
            (true, "never rebounds", true),
            (true, "", false),
            (true, "", false),
            (false, "speed", true)
        ]
    );
    assert!(rows[2][10].contains("radius_m: \"-1\" is refused: radius must be 1e-10 to 1 m"));
    assert!(rows[3][10].contains("stiffness_pa: missing"));
}

#[test]
fn refuses_a_tolerance_or_a_file_with_2() {
    for (arguments, word) in
        [(["-", "--tolerance", "0"], "tolerance"), (["missing.csv", "--format", "csv"], "missing.csv")]
    {
        let output = run(&arguments, "");
        assert_eq!(output.status, 2);
        assert!(output.complaint().contains(word));
    }
}
