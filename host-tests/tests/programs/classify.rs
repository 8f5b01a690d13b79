//! The command `classify`.

use crate::{Output, microimpact};

const HEADER: &str = "name,radius_m,density_kg_m3,restitution,adhesion_coefficient,friction,speed_normal_m_s,speed_tangential_m_s,spin_rad_s\n";
const TABLE_1: &str = "Table 1,5.06e-6,2600,0.978,0.237,0.1,2.8,0,1.46e5\n";

pub fn run(arguments: &[&str], input: &[u8]) -> Output {
    microimpact("classify", arguments, input)
}

/// A table that was written, by column name and row.
pub struct Written {
    pub names: Vec<String>,
    pub rows: Vec<csv::StringRecord>,
}

impl Written {
    pub fn read(bytes: &[u8], delimiter: u8) -> Self {
        let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).from_reader(bytes);
        let names = reader.headers().unwrap().iter().map(str::to_owned).collect();
        let rows = reader.records().map(Result::unwrap).collect();
        Self { names, rows }
    }

    pub fn has(&self, column: &str) -> bool {
        self.names.iter().any(|name| name == column)
    }

    pub fn text(&self, row: usize, column: &str) -> &str {
        let index = self.names.iter().position(|name| name == column).unwrap_or_else(|| panic!("no column {column}"));
        &self.rows[row][index]
    }

    pub fn number(&self, row: usize, column: &str) -> f64 {
        self.text(row, column).parse().unwrap_or_else(|_| panic!("{column}: {}", self.text(row, column)))
    }

    /// The overall restitution e, which the tables of the reference call `restitution`.
    pub fn overall_restitution(&self, row: usize) -> f64 {
        self.number(row, if self.has("overall_restitution") { "overall_restitution" } else { "restitution" })
    }
}

fn classified(table: &str) -> (Written, u8) {
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    (Written::read(&output.stdout, b','), output.status)
}

#[test]
fn bundled_impacts_without_arguments() {
    let output = run(&[], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    let line = text.lines().find(|line| line.contains("Table 1: glass on steel")).unwrap();
    for word in ["rebound rolling", "0.746", "2.089", "0.0432", "45.1"] {
        assert!(line.contains(word), "{line}");
    }
    assert!(!text.contains("bad row"));
}

#[test]
fn one_row_out_for_every_row_in() {
    let rows = [
        TABLE_1,
        "negative radius,-1,2600,0.978,0.237,0.1,2.8,0,0\n",
        "receding,1e-6,2600,0.978,0.237,0.1,-2.8,0,0\n",
        "not a number,1e-6,2600,nan,0,0.1,2.8,0,0\n",
        "words,1e-6,heavy,0.9,0,0.1,2.8,0,0\n",
        "no restitution,1e-6,2600,,0,0.1,2.8,0,0\n",
        "short row,1e-6,2600,0.9\n",
        "long row,1e-6,2600,0.9,0,0.1,2.8,0,0,surplus\n",
        "blank optional cells,1e-6,2600,0.9,,,2.8,,\n",
    ];
    let (written, status) = classified(&(HEADER.to_owned() + &rows.concat()));
    assert_eq!(status, 1);
    assert_eq!(written.rows.len(), rows.len());
    for (row, reason) in [
        (1, "radius_m: \"-1\" is refused: radius must be 1e-10 to 1 m"),
        (2, "\"-2.8\" is refused: approach speed must be 1e-12 to 1e6 m/s; enter -2.8 m/s as 2.8"),
        (3, "restitution: \"nan\" is refused: restitution must be a number from 0 to 1"),
        (4, "density_kg_m3: \"heavy\" is not a number"),
        (5, "restitution: missing"),
        (6, "speed_normal_m_s: missing"),
        (7, "surplus"),
    ] {
        assert!(written.text(row, "error").contains(reason), "{}", written.text(row, "error"));
        assert_eq!(written.text(row, "outcome"), "");
    }
    for row in [0, 8] {
        assert_eq!((written.text(row, "error"), written.text(row, "outcome")), ("", "rebound"));
    }
}

#[test]
fn numbers_of_table_1() {
    let (written, status) = classified(&(HEADER.to_owned() + TABLE_1));
    assert_eq!(status, 0);
    assert_eq!(written.text(0, "motion"), "rolling");
    assert!((written.number(0, "overall_restitution") - 0.746).abs() < 5e-4);
    assert!((written.number(0, "rebound_speed_m_s") - 2.09).abs() < 5e-3);
    assert!((written.number(0, "energy_before_j") - 5.68e-12).abs() < 5e-15);
    assert_eq!(written.number(0, "restitution"), 0.978, "the input column stays as it was");
}

#[test]
fn all_ways_to_give_a_term() {
    let header = "radius_m,density_kg_m3,restitution,restitution_speed_m_s,adhesion_coefficient,work_of_adhesion_j,friction,impulse_ratio,rolling_arm_m,gyration_ratio,speed_normal_m_s,speed_tangential_m_s\n";
    let rows = [
        "5e-6,2600,,130,,2e-12,0.1,,,,2.8,1\n",
        "5e-6,2600,,130,,2e-12,0.1,,,,1,1\n",
        "5e-6,2600,0.9,,0,,,-0.02,,,2.8,1\n",
        "5e-6,2600,0.9,,0,,,0.02,,,2.8,1\n",
        "5e-6,2600,0.9,,0,,0.5,,1e-8,0.6,2.8,1\n",
        "5e-6,2600,0.9,130,0,,0.5,,,,2.8,1\n",
        "5e-6,2600,0.9,,0,1e-12,0.5,,,,2.8,1\n",
        "5e-6,2600,0.9,,0,,,-0.02,1e-8,,2.8,1\n",
    ];
    let (written, status) = classified(&(header.to_owned() + &rows.concat()));
    assert_eq!(status, 1);
    assert!(written.number(0, "speed_over_critical") > 1.0);
    assert_eq!(written.text(1, "outcome"), "capture");
    assert!(written.number(1, "speed_over_critical") < 1.0);
    assert!((written.number(2, "impulse_ratio_out") + 0.02).abs() < 1e-12);
    // mu_0 = 2 eta/(7 (1 + e)) with eta = 1/-2.8 (eq. 1).
    let refused =
        written.text(3, "error").strip_prefix("impulse_ratio: \"0.02\" is refused: it must be 0 to mu_0, here ");
    let bound: f64 = refused.and_then(|rest| rest.split_once(',')).unwrap().0.parse().unwrap();
    assert!((bound + 2.0 / (7.0 * 1.9 * 2.8)).abs() < 1e-12, "{bound}");
    assert!(!written.text(3, "error").contains("velocity error"));
    assert!(written.number(4, "work_rolling_j") > 0.0);
    for (row, word) in [(5, "restitution: given twice"), (6, "adhesion: given twice"), (7, "rolling_arm_m")] {
        assert!(written.text(row, "error").contains(word), "{}", written.text(row, "error"));
    }
}

/// Other laws of restitution and of adhesion of the rigid body, and the yield speed of the simulation.
#[test]
fn laws_that_depend_on_speed() {
    let header = "radius_m,density_kg_m3,restitution,restitution_speed_m_s,restitution_power,yield_speed_m_s,adhesion_speed_m_s,adhesion_power,speed_normal_m_s\n";
    let rows = [
        "5e-6,2600,,4,0.5,,,,1\n",
        "5e-6,2600,,,,0.5,,,5\n",
        "5e-6,2600,1,,,,2,2,4\n",
        "5e-6,2600,1,,,,4,,4\n",
        "5e-6,2600,1,,0.5,,,,4\n",
        "5e-6,2600,1,,,,,2,4\n",
        "5e-6,2600,1,,,0.5,,,4\n",
        "5e-6,2600,,4,1.5,,,,1\n",
    ];
    let (written, status) = classified(&(header.to_owned() + &rows.concat()));
    assert_eq!(status, 1);
    for (row, e) in [(0, 1.0 / 1.5), (1, 0.658558336665), (2, 0.8), (3, 0.5)] {
        assert!((written.number(row, "overall_restitution") - e).abs() < 1e-11, "{row}");
    }
    for (row, words) in [
        (4, "restitution_power: restitution_speed_m_s is missing"),
        (5, "adhesion_power: adhesion_speed_m_s is missing"),
        (6, "restitution: given twice"),
        (7, "restitution_power: \"1.5\" is refused: power of the restitution law must be 0.01 to 1"),
    ] {
        assert!(written.text(row, "error").contains(words), "{}", written.text(row, "error"));
    }

    let table = "radius_m,density_kg_m3,stiffness_pa,yield_pressure_pa,speed_normal_m_s\n5e-6,1050,4.6e9,3e8,20\n5e-6,1050,4.6e9,,20\n";
    let output = run(&["-", "--model", "simulation", "--format", "csv"], table.as_bytes());
    let written = Written::read(&output.stdout, b',');
    // 1.56052 (4 p/(3 K))^2 (p/density)^(1/2)
    let speed = 1.56052147561322 * (4.0 * 3e8 / (3.0 * 4.6e9_f64)).powi(2) * (3e8_f64 / 1050.0).sqrt();
    assert!((written.number(0, "speed_over_yield") * speed / 20.0 - 1.0).abs() < 1e-9);
    assert_eq!(written.text(1, "speed_over_yield"), "");
}

/// What Excel writes where commas are decimal marks: semicolons, a byte-order mark and CRLF.
#[test]
fn spreadsheet_dialects() {
    let table = "\u{feff}Name;Radius_M ;density_kg_m3;restitution;speed_normal_m_s;\"note; free\"\r\n\
                 \"a \"\"quoted\"\" name\";5,06e-6;2600;0,5;2,5;\"x;y\"\r\n";
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("\u{feff}Name;Radius_M ;"), "{text}");
    assert_eq!(text.matches("\r\n").count(), 2);
    assert!(
        text.contains("\"a \"\"quoted\"\" name\";5,06e-6;2600;0,5;2,5;\"x;y\";rebound;rolling;0,5;1,25;"),
        "{text}"
    );

    let tabs =
        run(&["-", "--format", "csv"], b"radius_m\tdensity_kg_m3\trestitution\tspeed_normal_m_s\n1e-6\t1000\t0.5\t2\n");
    assert_eq!(Written::read(&tabs.stdout, b'\t').text(0, "rebound_speed_m_s"), "1");
}

#[test]
fn ambiguous_decimal_points_are_refused() {
    let table = "radius_m;density_kg_m3;restitution;speed_normal_m_s\n5,06e-6;2.600;0,5;2,5\n";
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    assert_eq!(output.status, 1);
    assert!(String::from_utf8_lossy(&output.stdout).contains("density_kg_m3: \"\"2.600\"\" is ambiguous"));
}

/// A result can be classified again and again.
#[test]
fn output_is_input() {
    let mut table = HEADER.to_owned() + TABLE_1;
    for _ in 0..4 {
        let output = run(&["-", "--format", "csv"], table.as_bytes());
        assert_eq!(output.status, 0, "{}", output.complaint());
        table = String::from_utf8(output.stdout).unwrap();
    }
    assert!(table.contains("input_input_input_outcome"));
}

#[test]
fn unknown_columns_pass_through() {
    let table =
        "outcome,radius_m,density_kg_m3,restitution,speed_normal_m_s,remark\nseen,1e-6,1000,0.5,2,\"kept, as is\"\n";
    let (written, status) = classified(table);
    assert_eq!(status, 0);
    assert_eq!(written.text(0, "input_outcome"), "seen");
    assert_eq!(written.text(0, "outcome"), "rebound");
    assert_eq!(written.text(0, "remark"), "kept, as is");
}

#[test]
fn reference_cases_are_accepted() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/cases.csv");
    let given = Written::read(&std::fs::read(path).unwrap(), b',');
    let output = run(&[path, "--format", "csv"], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    assert_eq!(written.rows.len(), given.rows.len());
    for row in 0..given.rows.len() {
        // The table's restitution is e, which this model takes for R of an impact without adhesion.
        let (e, computed) = (given.number(row, "restitution"), written.number(row, "overall_restitution"));
        assert!((computed - e).abs() <= 1e-15, "row {row}: {computed} against {e}");
        assert_eq!(written.text(row, "outcome"), given.text(row, "outcome"), "row {row}");
    }
}

/// The simulation's columns have the names of the reference and its values.
#[test]
fn reference_cases_by_the_simulation() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/cases.csv");
    let given = Written::read(&std::fs::read(path).unwrap(), b',');
    let output = run(&[path, "--format", "csv", "--model", "simulation", "--tolerance", "1e-13"], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    for row in 0..given.rows.len() {
        let name = given.text(row, "name");
        assert_eq!(written.text(row, "outcome"), given.text(row, "outcome"), "{name}");
        let columns: &[&str] = if given.text(row, "outcome") == "rebound" {
            assert_eq!(written.text(row, "motion"), given.text(row, "motion"), "{name}");
            &[
                "max_indentation_m",
                "time_peak_s",
                "contact_time_s",
                "time_roll_s",
                "impulse_hertz_n_s",
                "impulse_adhesion_rebound_n_s",
                "work_material_j",
                "work_adhesion_j",
                "speed_tangential_out_m_s",
                "spin_out_rad_s",
                "rotation_rad",
                "displacement_tangential_m",
            ]
        } else {
            &["max_indentation_m", "turning_indentation_m"]
        };
        let (e, exact) = (written.overall_restitution(row), given.overall_restitution(row));
        assert!((e - exact).abs() <= exact * if name.contains("e-06") { 1e-8 } else { 1e-10 }, "{name}: {e} {exact}");
        for column in columns.iter().chain(&["group_a", "group_b", "group_h", "group_g"]) {
            let exact = given.number(row, column);
            if exact.is_nan() {
                assert_eq!(written.text(row, column), "", "{name}, {column}");
                continue;
            }
            let (found, close) = (written.number(row, column), name.contains("e-06"));
            let allowed = exact.abs() * if close { 1e-8 } else { 1e-10 };
            assert!((found - exact).abs() <= allowed, "{name}, {column}: {found} against {exact}");
        }
    }
}

#[test]
fn both_models_side_by_side() {
    let header = "radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,friction,restitution,adhesion_coefficient,speed_normal_m_s,speed_tangential_m_s,spin_rad_s\n";
    let rows = [
        "5.06e-6,2600,7.5e10,250,10.5,6.25,0.1,0.978,0.237,2.8,0,145400\n",
        "5.06e-6,2600,7.5e10,250,10.5,6.25,0.1,,,2.8,0,145400\n",
        "5.06e-6,2600,,250,10.5,6.25,0.1,0.978,0.237,2.8,0,145400\n",
        "5.06e-6,2600,,250,10.5,6.25,0.1,0.978,0.237,-2.8,0,145400\n",
    ];
    let table = header.to_owned() + &rows.concat();
    let output = run(&["-", "--format", "csv", "--model", "both"], table.as_bytes());
    assert_eq!(output.status, 1);
    let written = Written::read(&output.stdout, b',');
    assert_eq!((written.text(0, "outcome"), written.text(0, "rigid_body_motion")), ("rebound", "rolling"));
    assert!((written.number(0, "overall_restitution") - 0.746193).abs() < 1e-6);
    assert!((written.number(0, "rigid_body_overall_restitution") - 0.746214).abs() < 1e-6);
    assert_eq!(written.text(0, "restitution"), "0.978", "an input stays as it was");
    assert_eq!(written.text(1, "outcome"), "rebound");
    assert!(written.text(1, "error").starts_with("rigid body: restitution: missing"));
    assert_eq!(written.text(2, "rigid_body_outcome"), "rebound");
    assert!(written.text(2, "error").starts_with("simulation: stiffness_pa: missing"));
    assert!(
        written
            .text(3, "error")
            .starts_with("speed_normal_m_s: \"-2.8\" is refused: approach speed must be 1e-12 to 1e6 m/s; enter")
    );

    for model in ["simulation", "both"] {
        let output = run(&["--model", model], b"");
        assert_eq!(output.status, 0);
        assert!(String::from_utf8_lossy(&output.stdout).contains("rebound rolling"));
    }
}

#[test]
fn single_precision() {
    let table = HEADER.to_owned() + TABLE_1;
    let output = run(&["-", "--format", "csv", "--scalar", "f32"], table.as_bytes());
    let (single, double) = (Written::read(&output.stdout, b','), classified(&table).0);
    for column in ["overall_restitution", "speed_tangential_out_m_s", "spin_out_rad_s", "energy_before_j"] {
        let (single, double) = (single.number(0, column), double.number(0, column));
        assert!((single / double - 1.0).abs() < 1e-6, "{column}: {single} against {double}");
    }
    assert_ne!(single.number(0, "energy_before_j"), double.number(0, "energy_before_j"));
}

/// What an error of the library holds as f32, the message shows as it was written.
#[test]
fn refused_cells_are_quoted() {
    let refused = |scalar: &str, radius: &str, speed: &str| {
        let table = format!("radius_m;density_kg_m3;restitution;speed_normal_m_s\n{radius};1;1;{speed}\n");
        let output = run(&["-", "--format", "csv", "--scalar", scalar], table.as_bytes());
        assert_eq!(output.status, 1, "{speed}");
        Written::read(&output.stdout, b';').text(0, "error").to_owned()
    };
    for (scalar, radius, speed, words) in [
        ("f64", "1", "1e300", "speed_normal_m_s: \"1e300\" is refused: approach speed must be 1e-12 to 1e6 m/s"),
        ("f32", "1", "1e300", "speed_normal_m_s: \"1e300\" is refused: approach speed must be a number from 1e-12"),
        ("f64", "1", "1e-300", "speed_normal_m_s: \"1e-300\" is refused: approach speed must be 1e-12 to 1e6 m/s"),
        ("f64", "1", "2,5e-300", "speed_normal_m_s: \"2,5e-300\" is refused: approach speed must be 1e-12 to 1e6 m/s"),
        ("f64", "1", "1e-400", "speed_normal_m_s: \"1e-400\" is refused: it is too small for f64"),
        ("f32", "1", "1e-50", "speed_normal_m_s: \"1e-50\" is refused: it is too small for f32"),
        ("f64", "1", "0e-400", "speed_normal_m_s: \"0e-400\" is refused: approach speed must be 1e-12 to 1e6 m/s"),
        ("f64", "5", "1", "radius_m: \"5\" is refused: radius must be 1e-10 to 1 m; enter 5 um as 5e-6"),
    ] {
        let error = refused(scalar, radius, speed);
        assert!(error.starts_with(words), "{error}");
    }
}

#[test]
fn unusable_input_is_said_and_exits_with_2() {
    for (arguments, input, word) in [
        (["missing.csv", "--format", "csv"], "", "missing.csv"),
        (["-", "--format", "csv"], "", "empty"),
        (["-", "--format", "csv"], HEADER, "no rows below its header"),
        (["-", "--decimal", "point"], HEADER, "no rows below its header"),
        (["-", "--format", "csv"], "radius_m,RADIUS_M\n1,2\n", "twice"),
        (["-", "--format", "pdf"], "", "pdf"),
        (["-", "--tolerance", "0"], "radius_m\n", "tolerance"),
    ] {
        let output = run(&arguments, input.as_bytes());
        assert_eq!(output.status, 2);
        assert!(output.complaint().contains(word));
    }
}

/// The results of simulated impacts with compliance among the inputs of both models: an impulse ratio is one of the rigid body.
#[test]
fn a_result_that_the_other_model_takes_for_an_input() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/tangential.csv");
    let output = run(&[path, "--format", "csv", "--model", "both"], b"");
    let used = "impulse_ratio (the rigid body takes it instead of friction)";
    assert!(output.complaint().lines().next().unwrap().contains(used), "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    let mut refused = 0;
    for row in 0..written.rows.len() {
        let (given, computed) = (written.number(row, "impulse_ratio"), written.number(row, "impulse_ratio_out"));
        assert!((given - computed).abs() < 1e-8, "{row}: {given} {computed}");
        let error = written.text(row, "error");
        match error.strip_prefix("rigid body: impulse_ratio: ") {
            Some(reason) => {
                assert!(reason.contains("neither increases nor reverses the slip; enter such a ratio"), "{reason}");
                refused += 1;
            }
            None => {
                assert_eq!(error, "");
                assert!((written.number(row, "rigid_body_impulse_ratio_out") - given).abs() < 1e-15, "{row}");
            }
        }
    }
    assert!(refused > 0 && refused < written.rows.len(), "{refused}");
}

/// Numbers that only together are out of range are all named.
#[test]
fn numbers_that_are_wrong_together() {
    // The stiffness of 75 GPa, entered as if the column were in GPa.
    let table = "radius_m,density_kg_m3,stiffness_pa,zeta_h,adhesion_n_m,zeta_a,speed_normal_m_s\n5e-6,2600,75,10.5,250,6.25,2.8\n";
    let output = run(&["-", "--format", "csv", "--model", "simulation"], table.as_bytes());
    assert_eq!(output.status, 1);
    let written = Written::read(&output.stdout, b',');
    let error = written.text(0, "error");
    assert!(
        error.starts_with("stiffness_pa, zeta_h, zeta_a, speed_normal_m_s: damping over elasticity is "),
        "{error}"
    );
    assert!(error.ends_with("but must be 0 to 1e9"), "{error}");

    let output = run(
        &["-", "--format", "csv", "--model", "rigid-body"],
        b"radius_um,density_kg_m3,restitution,speed_normal_m_s\n5e6,2600,1,2.8\n",
    );
    let written = Written::read(&output.stdout, b',');
    assert_eq!(written.text(0, "error"), "radius_um: \"5e6\" (5.0 m) is refused: radius must be 1e-10 to 1 m");
}
