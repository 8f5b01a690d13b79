//! The command `analyse`.

use std::collections::HashMap;
use std::path::PathBuf;

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal};

use crate::{Output, microimpact};

const HEADER: &str = "name,diameter_m,density_kg_m3,restitution_speed_m_s,velocity_error_m_s,speed_normal_m_s,speed_tangential_m_s,spin_rad_s,rebound_speed_m_s,speed_tangential_out_m_s,spin_out_rad_s\n";
const TABLE_1: &str = "Table 1,1.012e-5,2600,130,0.02,2.8,0,,2.09,0.21,\n";

fn run(arguments: &[&str], input: &[u8]) -> Output {
    microimpact("analyse", arguments, input)
}

/// The rows of a table that was written, by column name.
fn rows(bytes: &[u8]) -> Vec<HashMap<String, String>> {
    csv::Reader::from_reader(bytes).deserialize().map(Result::unwrap).collect()
}

fn analysed(table: &str) -> (Vec<HashMap<String, String>>, Output) {
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    (rows(&output.stdout), output)
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

/// A folder of this test run that is removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        Self(std::env::temp_dir().join(format!("microimpact-{name}-{}", std::process::id())))
    }

    fn read(&self, file: &str) -> String {
        std::fs::read_to_string(self.0.join(file)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn bundled_impacts_without_arguments() {
    let output = run(&[], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    let line = text.lines().find(|line| line.contains("Table 1: glass on steel")).unwrap();
    for word in ["rebound, assumed rolling", "0.7464", "0.237", "0.0429", "1.45e5", "39.0"] {
        assert!(line.contains(word), "{word}: {line}");
    }
    // The bundled impacts were made with k = 130 m/s, W_A = 2.22e-12 J and f = 0.15.
    let summary = String::from_utf8(output.stderr).unwrap();
    let line = |name: &str| summary.lines().find(|line| line.starts_with(name)).unwrap();
    let number = |text: &str| text.trim().parse::<f64>().unwrap();
    for (name, unit, truth) in [("k of R", " m/s", 130.0), ("W_A", " J", 2.22e-12)] {
        let (_, bounds) = line(name).split_once(&format!("{unit}, 95 % from ")).unwrap();
        let (low, high) = bounds.split_once(" to ").unwrap();
        let (low, high) = (number(low), number(high));
        assert!(low < truth && truth < high && high - low < 0.2 * truth, "{}", line(name));
    }
    let (value, rest) = line("friction").rsplit_once(": ").unwrap().1.split_once(" ± ").unwrap();
    let (value, error) = (number(value), number(rest.split(' ').next().unwrap()));
    assert!((value - 0.15).abs() < 3.0 * error && error < 0.0075, "{}", line("friction"));
}

#[test]
fn numbers_of_table_1() {
    let (rows, output) = analysed(&(HEADER.to_owned() + TABLE_1));
    assert_eq!(output.status, 0);
    let row = &rows[0];
    assert_eq!((&*row["outcome"], &*row["motion"], &*row["confidence"]), ("rebound", "assumed rolling", ""));
    assert!((number(row, "overall_restitution") - 0.746).abs() < 5e-4);
    assert!((number(row, "impulse_ratio_out") - 0.043).abs() < 5e-4);
    assert!((number(row, "adhesion_coefficient") - 0.237).abs() < 1e-3);
    assert!((number(row, "spin_implied_rad_s") - 1.46e5).abs() < 0.01e5);
    let before = number(row, "energy_before_j");
    assert!((before - 5.68e-12).abs() < 0.02e-12);
    let works = ["work_material_j", "work_adhesion_j", "work_friction_j", "work_rolling_j"];
    let lost: f64 = works.iter().map(|work| number(row, work)).sum();
    assert!((lost / before - 0.451).abs() < 2e-3);
    // Errors of 0.02 m/s in both velocities: the error of e = V/v is 0.02 sqrt(1 + e^2)/v.
    assert!((number(row, "overall_restitution_error") - 0.02 / 2.8 * (1.0 + 0.7464_f64.powi(2)).sqrt()).abs() < 1e-6);
    assert_eq!(row["incidence_deg"], "90");
}

/// Impossible data is flagged by name, and every row comes out again.
#[test]
fn impossible_rows_say_why() {
    let bad = [
        ("faster than R,1.012e-5,2600,130,0.02,2.8,0,,2.84,0.21,", "rebound speed exceeds R times the approach speed"),
        ("faster than it came,1e-5,2600,,0.02,2.8,0,,3,0,", "the sphere leaves faster than it came"),
        ("gains slip,1e-5,2600,130,0.02,2.8,1,0,2,2,", "impulse ratio is outside its bounds, 0 to mu_0"),
        ("slip reversed,1e-5,2600,130,0.02,2.8,1,0,2,0.2,", "impulse ratio is outside its bounds, 0 to mu_0"),
        ("gains energy,1e-5,2600,130,0.02,2.8,4,0,2,3.5,-2e6", "kinetic energy after the impact exceeds"),
        (
            "receding,1e-5,2600,130,0.02,-2.8,0,,2,0,",
            "speed_normal_m_s: \"-2.8\" is refused: approach speed must be 1e-12 to 1e6 m/s; enter -2.8 m/s as 2.8",
        ),
        (
            "through the wall,1e-5,2600,130,0.02,2.8,0,,-2,0,",
            "rebound_speed_m_s: \"-2\" is refused: rebound speed must be 0 to 1e6 m/s",
        ),
        (
            "too large,10,2600,130,0.02,2.8,0,,2,0,",
            "diameter_m: \"10\" is refused: diameter must be 2e-10 to 2 m; enter 10 um as 10e-6",
        ),
        (
            "out too fast,1e-5,2600,130,0.02,2.8,1,0,2,-1e300,",
            "speed_tangential_out_m_s: \"-1e300\" is refused: tangential velocity must be -1e7 to 1e7 m/s",
        ),
        ("no size,,2600,130,0.02,2.8,0,,2,0,", "radius_m: missing; give radius_m or diameter_m"),
        ("error of a sign,1e-5,2600,130,-0.02,2.8,0,,2,0,", "velocity_error_m_s"),
        ("half of the spins,1e-5,2600,130,0.02,2.8,0,,2,0,10", "spin_out_rad_s: not without spin_rad_s"),
        ("words,1e-5,heavy,130,0.02,2.8,0,,2,0,", "density_kg_m3: \"heavy\" is not a number"),
        (
            "not a number,1e-5,2600,130,0.02,2.8,0,,nan,0,",
            "rebound_speed_m_s: \"nan\" is refused: rebound speed must be a number from 0 to 1e6 m/s",
        ),
    ];
    let table: Vec<_> = bad.iter().map(|(row, _)| format!("{row}\n")).collect();
    let (rows, output) = analysed(&(HEADER.to_owned() + TABLE_1 + &table.concat()));
    assert_eq!(output.status, 1);
    assert_eq!(rows.len(), 1 + bad.len());
    assert_eq!(rows[0]["error"], "");
    for (row, (_, reason)) in rows[1..].iter().zip(bad) {
        assert!(row["error"].contains(reason), "{}: {}", row["name"], row["error"]);
        assert_eq!(row["outcome"], "");
    }
}

/// What `classify` computes, `analyse` infers again.
#[test]
fn analysis_undoes_classification() {
    let classified = microimpact("classify", &["--format", "csv"], b"");
    let analysed = run(&["-", "--format", "csv"], &classified.stdout);
    let mut compared = 0;
    for (before, after) in rows(&classified.stdout).iter().zip(rows(&analysed.stdout)) {
        // The spin after the impact is read too; a rolling resistance is told from it.
        if after["error"].is_empty() && before["outcome"] == "rebound" {
            compared += 1;
            assert_eq!(before["outcome"], after["outcome"]);
            assert!((number(before, "overall_restitution") - number(&after, "overall_restitution")).abs() < 1e-12);
            assert!((number(before, "impulse_ratio_out") - number(&after, "impulse_ratio_out")).abs() < 1e-12);
            let energy = number(before, "energy_before_j");
            assert!((number(before, "work_friction_j") - number(&after, "work_friction_j")).abs() < 1e-9 * energy);
        }
    }
    assert!(compared >= 10, "{compared} {}", String::from_utf8_lossy(&analysed.stdout));
}

/// A class is as sure as its margin is wide.
#[test]
fn confidence_follows_the_margin() {
    // Friction stops some 1.4 m/s of slip; the tangential velocity left makes the class.
    let row = |out: f64| format!("slip,1e-5,2600,130,0.01,2,4,0,1.6,{out},\n");
    let table: Vec<_> = [3.2, 2.91, 2.89, 2.857].map(row).into();
    let (rows, _) = analysed(&(HEADER.to_owned() + &table.concat()));
    let results: Vec<_> = rows.iter().map(|row| (&*row["motion"], number(row, "confidence"))).collect();
    assert!(results[0].0 == "sliding" && results[0].1 > 0.999, "{results:?}");
    assert!(results[1].0 == "sliding" && (0.9..0.999).contains(&results[1].1), "{results:?}");
    assert!(results[2].0 == "cannot tell" && results[2].1 < 0.9, "{results:?}");
    assert!(results[3].0 == "rolling" && results[3].1 > 0.98, "{results:?}");
}

/// Of random impacts, half of which slide with any slip, as many have the stated class as its confidence says.
#[test]
fn confidence_is_the_fraction_of_right_classes() {
    const ROWS: usize = 4000;
    let mut random = StdRng::seed_from_u64(3);
    let (mut table, mut truths) = (HEADER.to_owned(), Vec::new());
    for _ in 0..ROWS {
        let error = 10f64.powf(random.random_range(-2.0..0.5));
        let noise = Normal::new(0.0, error).unwrap();
        let (slides, rest) = (random.random_bool(0.5), random.random_range(0.0..1.0));
        // A solid sphere that rolls keeps 5/7 of its tangential velocity.
        let out = 4.0 * (5.0 + if slides { 2.0 * rest } else { 0.0 }) / 7.0;
        truths.push(if slides { "sliding" } else { "rolling" });
        let mut measured = |velocity: f64| velocity + noise.sample(&mut random);
        let [tangential, out] = [4.0, out].map(&mut measured);
        table.push_str(&format!("a,1e-5,2600,1e6,{error},20,{tangential},0,16,{out},\n"));
    }
    let (rows, _) = analysed(&table);
    let (mut stated, mut right, mut expected) = (0.0, 0.0, 0.0);
    for (row, truth) in rows.iter().zip(truths) {
        if row["error"].is_empty() && row["motion"] != "cannot tell" {
            stated += 1.0;
            right += f64::from(u8::from(row["motion"] == truth));
            expected += number(row, "confidence");
        }
    }
    assert!(stated > 0.3 * ROWS as f64, "{stated}");
    assert!((right - expected).abs() < 0.01 * stated, "{right} of {stated}, expected {expected}");
}

/// What is possible within three standard errors is data.
#[test]
fn noise_above_a_bound_is_possible() {
    let (rows, output) = analysed(
        &(HEADER.to_owned()
            + "above R,1e-5,2600,1e6,0.05,2,0,,2.08,0.1,\n\
               negative,1e-5,2600,130,0.05,2,0,,-0.01,0.1,\n\
               gains energy,1e-5,2600,1e6,0.05,2,4,0,2.05,4.05,0\n\
               R not known,1e-5,2600,,0.05,2,4,0,1.5,3.5,\n\
               captured,1e-5,2600,130,0.05,2,4,0,0,3.9,\n"),
    );
    assert_eq!(output.status, 0, "{rows:?}");
    assert_eq!((number(&rows[0], "overall_restitution"), number(&rows[0], "adhesion_coefficient")), (1.04, 0.0));
    assert_eq!((&*rows[1]["outcome"], number(&rows[1], "overall_restitution")), ("cannot tell", -0.005));
    assert_eq!((&*rows[3]["adhesion_coefficient"], &*rows[3]["work_material_j"]), ("", ""));
    assert!(number(&rows[3], "work_friction_j") > 0.0);
    assert_eq!(rows[4]["outcome"], "capture");
}

/// Each velocity may have its own error.
#[test]
fn errors_of_single_velocities() {
    let header = HEADER.trim_end().to_owned() + ",speed_normal_error_m_s,rebound_speed_error_m_s\n";
    let (rows, _) = analysed(&(header + &TABLE_1.replace('\n', ",0,0.05\n")));
    assert!((number(&rows[0], "overall_restitution_error") - 0.05 / 2.8).abs() < 1e-6);
}

#[test]
fn single_precision_has_the_same_classes() {
    let [double, single] =
        ["f64", "f32"].map(|scalar| rows(&run(&["--format", "csv", "--scalar", scalar], b"").stdout));
    assert_eq!(double.len(), single.len());
    for (double, single) in double.iter().zip(&single) {
        assert_eq!(double["motion"], single["motion"]);
        let restitution = |row| number(row, "overall_restitution");
        assert!((restitution(double) - restitution(single)).abs() < 1e-6);
    }
}

#[test]
fn figures_show_every_impact() {
    let folder = Folder::new("figures");
    let output = run(&["--format", "csv", "--plots", folder.0.to_str().unwrap()], b"");
    assert_eq!(output.status, 0);
    let impacts = rows(&output.stdout).len();
    for (file, title, curves) in
        [("velocity_ratio.svg", "Velocity ratio", 1), ("impulse_ratio.svg", "Impulse ratio", 3)]
    {
        let figure = folder.read(file);
        assert!(figure.contains(title));
        assert_eq!(figure.matches("<circle").count(), impacts, "{file}");
        // The frame of axes is drawn with two lines.
        assert!(figure.matches("<polyline").count() >= curves, "{file}");
    }
}

/// Of a long table the figures show a sample of bounded size; all rows are written.
#[test]
fn long_tables_are_sampled() {
    const ROWS: usize = 25_000;
    let folder = Folder::new("sample");
    let mut table = HEADER.to_owned();
    for index in 0..ROWS {
        let speed = 2.0 + 20.0 * index as f64 / ROWS as f64;
        let rebound = speed * 100.0 / (100.0 + speed) * 0.99;
        table.push_str(&format!("{index},1e-5,2600,130,0.02,{speed},0,,{},0.1,\n", rebound.min(speed * 0.8)));
    }
    let arguments = ["-", "--format", "csv", "--plots", folder.0.to_str().unwrap()];
    let output = run(&arguments, table.as_bytes());
    assert_eq!(output.status, 0, "{}", output.complaint());
    assert_eq!(rows(&output.stdout).len(), ROWS);
    let figure = folder.read("velocity_ratio.svg");
    assert_eq!(figure.matches("<circle").count(), 10_000);
}

#[test]
fn nothing_to_read() {
    assert_eq!(run(&["-"], b"").status, 2);
    let output = run(&["-", "--format", "csv"], HEADER.as_bytes());
    assert_eq!(output.status, 2);
    assert!(output.complaint().contains("the table has no rows below its header"), "{}", output.complaint());
}
