//! How the commands read tables: one decimal mark a file, and what they say about columns.

use std::cell::Cell;
use std::fmt::Write as _;
use std::io::{self, BufReader, Read, Write};

use clap::Parser;
use microimpact_cli::{Arguments, Streams};

use crate::classify::{Written, run};
use crate::{Output, microimpact};

const HEADER: &str = "name;radius_m;density_kg_m3;restitution_speed_m_s;work_of_adhesion_j;speed_normal_m_s\n";

fn classified(rows: &str, arguments: &[&str]) -> Output {
    run(&[&["-", "--format", "csv"], arguments].concat(), (HEADER.to_owned() + rows).as_bytes())
}

fn written(output: &Output) -> Written {
    Written::read(&output.stdout, b';')
}

/// The density that the mark of a row leaves open decides between capture and rebound.
#[test]
fn three_digits_behind_a_mark_are_ambiguous() {
    for cell in ["2.600", "2,600", "-2.600", "12.600", "126.600"] {
        let output = classified(&format!("a;5E-6;{cell};130;2E-12;3\n"), &[]);
        assert_eq!((output.status, output.stdout.len()), (2, 0));
        for words in [&format!("density_kg_m3: \"{cell}\" is ambiguous in row 1"), "--decimal point or --decimal comma"]
        {
            assert!(output.complaint().contains(words), "{}", output.complaint());
        }
    }
    // A number that nobody writes with a thousands separator.
    for (cell, density) in [
        ("2600.000", 2600.0),
        ("2.6000", 2.6),
        ("0.260", 0.26),
        ("2.600e3", 2600.0),
        ("2600,5", 2600.5),
        ("0002.600", 2.6),
    ] {
        let output = classified(&format!("a;5E-6;{cell};130;2E-12;3\n"), &[]);
        let table = written(&output);
        assert_eq!(output.status, 0, "{cell}: {}", output.complaint());
        let comma = cell.contains(',');
        let energy = table.text(0, "energy_before_j").replace(',', ".").parse::<f64>().unwrap();
        let exact = 0.5 * density * 4.0 / 3.0 * std::f64::consts::PI * 5e-6_f64.powi(3) * 9.0;
        assert!((energy / exact - 1.0).abs() < 1e-12, "{cell}: {energy:e} for {exact:e}");
        assert_eq!(table.text(0, "speed_over_critical").contains(','), comma, "{cell}");
    }
}

/// Another cell, in any column that is read and in any row, settles it; so does the option.
#[test]
fn the_file_or_the_option_settles_the_mark() {
    let energy = |output: &Output, row: usize| {
        assert_eq!(output.status, 0, "{}", output.complaint());
        written(output).text(row, "energy_before_j").replace(',', ".").parse::<f64>().unwrap()
    };
    let light = energy(&classified("a;5E-6;2.6e0;130;2E-12;3\n", &[]), 0);
    let heavy = energy(&classified("a;5E-6;2600;130;2E-12;3\n", &[]), 0);
    assert!((heavy / light - 1000.0).abs() < 1e-6);
    let later = "a;5E-6;2.600;130;2E-12;3\nb;5E-6;2600;130;2.2E-12;3\n";
    assert_eq!(energy(&classified(later, &[]), 0), light);
    assert_eq!(energy(&classified("a;5E-6;2.600;130;2E-12;3\n", &["--decimal", "point"]), 0), light);
    assert_eq!(energy(&classified("a;5E-6;2,600;130;2E-12;3\n", &["--decimal", "comma"]), 0), light);
    // A decimal comma does not make thousands of 2.600.
    for (rows, arguments) in [
        ("a;5E-6;2.600;130;2,2E-12;3\n", &[][..]),
        ("a;5E-6;2.600;130;2E-12;3\n", &["--decimal", "comma"]),
        ("a;5E-6;2,600;130;2E-12;3\n", &["--decimal", "point"]),
    ] {
        let output = classified(rows, arguments);
        let error = written(&output).text(0, "error").to_owned();
        assert_eq!((output.status, written(&output).text(0, "outcome")), (1, ""));
        assert!(error.contains("is ambiguous in row 1") && error.contains("without thousands separators"), "{error}");
    }
}

/// Cells that are not read, labels among them, have no say.
#[test]
fn labels_do_not_influence_the_mark() {
    let header = "name;remark;stiffness_pa;radius_m;density_kg_m3;restitution_speed_m_s;speed_normal_m_s\n";
    let table = |row: &str| run(&["-", "--format", "csv"], (header.to_owned() + row).as_bytes());
    let output = table("1,5;2,5;7,5e10;5.1e-6;2600;130;2.8\n");
    assert_eq!(output.status, 0, "{}", output.complaint());
    assert_eq!(written(&output).number(0, "rebound_speed_m_s"), 2.8 * 130.0 / 132.8);
    let output = table("1.5;2.5;7.5e10;5,1e-6;2600;130;2,8\n");
    assert!(written(&output).text(0, "rebound_speed_m_s").starts_with("2,7"));
    // They do not settle an ambiguous cell either.
    assert_eq!(table("1.5;2.5;7.5e10;5e-6;2.600;130;3\n").status, 2);
}

#[test]
fn contradictions_name_row_and_cell() {
    let comma = "a;5,06e-6;2600;130;2E-12;2,8\n";
    let output = classified(&(comma.repeat(3) + "d;5.06e-6;2600;130;2E-12;2,8\n" + comma), &[]);
    let table = written(&output);
    assert_eq!((output.status, table.rows.len()), (1, 5));
    let error = table.text(3, "error");
    for words in
        ["radius_m: \"5.06e-6\" in row 4 has a decimal point", "decimal comma, as radius_m \"5,06e-6\" in row 1"]
    {
        assert!(error.contains(words), "{error}");
    }
    for row in [0, 1, 2, 4] {
        assert_eq!((table.text(row, "error"), table.text(row, "outcome")), ("", "rebound"));
    }
    // Where the marks are mixed, none settles what is ambiguous.
    let mixed = comma.repeat(3) + "d;5.06e-6;2600;130;2E-12;2,8\ne;5E-6;2,600;130;2E-12;3\n";
    assert!(written(&classified(&mixed, &[])).text(4, "error").contains("\"2,600\" is ambiguous in row 5"));
    // The option decides which of the rows are wrong.
    let output = classified(&mixed, &["--decimal", "point"]);
    let wrong: Vec<_> = (0..5).map(|row| written(&output).text(row, "error").is_empty()).collect();
    assert_eq!(wrong, [false, false, false, false, false], "row 4 has both marks");
    let output = classified("a;5.06e-6;2600;130;2E-12;3\nb;5,06e-6;2600;130;2E-12;3\n", &["--decimal", "comma"]);
    assert!(written(&output).text(0, "error").contains("--decimal chooses the decimal comma"));
    assert_eq!(written(&output).text(1, "error"), "");
}

/// Marks that come after the rows that are judged.
#[test]
fn later_rows_follow_the_first_thousand() {
    let unmarked = "a;5E-6;2600;130;2E-12;3\n";
    for (head, cell, words) in [
        (unmarked, "2600,5", "\"2600,5\" in row 1001 has a decimal comma"),
        (unmarked, "2.600", "\"2.600\" is ambiguous in row 1001"),
        (unmarked, "2600.5", ""),
        ("a;5,1E-6;2600;130;2E-12;3\n", "2600.5", "\"2600.5\" in row 1001 has a decimal point"),
        ("a;5.1E-6;2600;130;2E-12;3\n", "2600,5", "\"2600,5\" in row 1001 has a decimal comma"),
        ("a;5.1E-6;2600;130;2E-12;3\n", "2.600", ""),
    ] {
        let output = classified(&(head.repeat(1000) + &unmarked.replace("2600", cell)), &[]);
        let table = written(&output);
        let error = table.text(1000, "error");
        assert!(error.contains(words) && error.is_empty() == words.is_empty(), "{cell}: {error}");
        assert!((0..1000).all(|row| table.text(row, "error").is_empty()));
        assert_eq!(output.status, u8::from(!words.is_empty()));
    }
}

/// Commas that separate cells make the point the decimal mark, unless quoted cells have decimal commas.
#[test]
fn commas_that_separate_cells_settle_the_mark() {
    let header = "radius_m,density_kg_m3,restitution,speed_normal_m_s\n";
    let table = |row: &str| run(&["-", "--format", "csv"], (header.to_owned() + row).as_bytes());
    let point = table("5E-6,2.600,1,3\n");
    assert_eq!(point.status, 0, "{}", point.complaint());
    let comma = table("5E-6,\"2,6\",1,3\n");
    assert_eq!(comma.status, 0, "{}", comma.complaint());
    let energy = |output: &Output| Written::read(&output.stdout, b',').text(0, "energy_before_j").replace(',', ".");
    assert_eq!(energy(&point), energy(&comma));
    let thousands = table("5.1E-6,\"2,600\",1,3\n");
    let error = Written::read(&thousands.stdout, b',').text(0, "error").to_owned();
    assert!(error.contains("\"2,600\" is ambiguous"), "{error}");
}

/// All commands that read tables write the decimal mark of the file.
#[test]
fn what_goes_in_with_commas_comes_out_with_commas() {
    let critical = "radius_m;density_kg_m3;stiffness_pa;adhesion_n_m;zeta_h;zeta_a\n2,5e-6;2600;7,5e10;250;10,5;6,25\n";
    let classify = "radius_m;density_kg_m3;stiffness_pa;adhesion_n_m;zeta_h;zeta_a;speed_normal_m_s;restitution\n\
                    2,5e-6;2600;7,5e10;250;10,5;6,25;8;0,9\n2500e-9;2600;75e9;250;105e-1;625e-2;8;1\n";
    let analyse = "diameter_m;density_kg_m3;restitution;speed_normal_m_s;rebound_speed_m_s;speed_tangential_out_m_s\n\
                   1,012e-5;2600;0,978;2,8;2,09;0,21\n";
    for (command, table, arguments) in [
        ("critical", critical, &[][..]),
        ("classify", classify, &["--model", "both"]),
        ("classify", classify, &["--model", "simulation", "--method", "runge-kutta-gill"]),
        ("analyse", analyse, &[]),
    ] {
        let output = microimpact(command, &[&["-", "--format", "csv"], arguments].concat(), table.as_bytes());
        let text = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status, 0, "{}{text}", String::from_utf8_lossy(&output.stderr));
        assert!(!text.contains('.'), "{text}");
        let again = microimpact(command, &[&["-", "--format", "csv"], arguments].concat(), text.as_bytes());
        assert_eq!(again.status, 0, "{}", again.complaint());
    }
}

/// A reader that counts what was read.
struct Counted<'a, R>(R, &'a Cell<usize>);

impl<R: Read> Read for Counted<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.0.read(buffer)?;
        self.1.set(self.1.get() + length);
        Ok(length)
    }
}

/// A writer that keeps how much had been read before the first result came.
struct First<'a> {
    read: &'a Cell<usize>,
    at_first: Option<usize>,
}

impl Write for First<'_> {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.at_first.get_or_insert(self.read.get());
        Ok(buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// However long a table is, the command holds its first thousand rows at most.
#[test]
fn tables_are_read_as_they_are_written() {
    const ROW: &str = "a;5E-6;2600;130;2E-12;3\n";
    let table = HEADER.to_owned() + &ROW.repeat(20_000);
    let first = |arguments: &[&str]| {
        let words = ["microimpact", "classify", "-", "--format", "csv"].iter().chain(arguments);
        let arguments = Arguments::try_parse_from(words).unwrap();
        let read = Cell::new(0);
        let mut output = First { read: &read, at_first: None };
        let mut input = BufReader::with_capacity(100, Counted(table.as_bytes(), &read));
        let status = arguments.run(&mut Streams { input: &mut input, output: &mut output, errors: &mut Vec::new() });
        assert_eq!((status, read.get()), (0, table.len()));
        output.at_first.unwrap() / ROW.len()
    };
    // The buffers of the table's reader and writer hold some hundred rows besides.
    let (judged, chosen) = (first(&[]), first(&["--decimal", "point"]));
    assert!((1000..2000).contains(&judged), "{judged}");
    assert!(chosen < 1000, "{chosen}");
}

fn said(table: &str, command: &str, arguments: &[&str]) -> String {
    microimpact(command, &[&["-", "--format", "csv"], arguments].concat(), table.as_bytes()).complaint()
}

/// A misspelt column is said, with what is used in its place.
#[test]
fn columns_used_defaulted_and_not_read() {
    let table = "Radius_m,density_kg_m3,restitution_speed_m_s,work_of_adhesion,fricton,speed_normal_m_s,name,remark\n\
                 5e-6,2600,130,2e-12,0.1,1,a,b\n5e-6,2600,130,2e-12,0.1,1,a,b\n";
    let complaint = said(table, "classify", &[]);
    let lines: Vec<_> = complaint.lines().collect();
    assert_eq!(
        lines,
        [
            "classify: columns used: radius_m, density_kg_m3, restitution_speed_m_s, speed_normal_m_s",
            "  columns absent, and what is used: gyration_ratio (0.4, a solid sphere), speed_tangential_m_s (0 m/s), \
             spin_rad_s (0 rad/s), friction (0), restitution_power (1), adhesion_coefficient or work_of_adhesion_j or \
             adhesion_speed_m_s (no adhesion), adhesion_power (1), \
             impulse_ratio (as friction gives it), rolling_arm_m (0 m)",
            "  columns not read: work_of_adhesion (did you mean `work_of_adhesion_j`?), fricton (did you mean \
             `friction`?), remark",
        ]
    );
    let line = |complaint: &str, title: &str| complaint.lines().find(|line| line.contains(title)).map(str::to_owned);
    for (name, near) in [
        ("adhesion", "adhesion_n_m"),
        ("zetah", "zeta_h"),
        ("external_force", "external_force_n"),
        ("spin_rads", "spin_rad_s"),
        ("friction_coefficient", "friction"),
        ("peeling", "peeling_n_m"),
        ("speed_tangential", "speed_tangential_m_s"),
        ("force_n", "external_force_n"),
        ("lambda", "peeling_n_m"),
        ("lambda_n_m", "peeling_n_m"),
        ("f0", "adhesion_n_m"),
    ] {
        let table = format!("radius_m,density_kg_m3,stiffness_pa,speed_normal_m_s,{name}\n5e-6,2600,7.5e10,3,1\n");
        let complaint = said(&table, "classify", &["--model", "simulation"]);
        let unread = line(&complaint, "columns not read").unwrap();
        assert!(unread.ends_with(&format!("{name} (did you mean `{near}`?)")), "{unread}");
    }
    // What was computed before, and what the other model reads, is no mistake.
    for (path, model) in [("cases", "rigid-body"), ("cases", "simulation"), ("hard", "simulation")] {
        let table = std::fs::read_to_string(format!("{}/data/{path}.csv", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let complaint = said(&table, "classify", &["--model", model]);
        assert!(!complaint.contains("did you mean"), "{complaint}");
    }
    // Without unread or absent columns there is no such line.
    let all = "radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,external_force_n,law,work_of_adhesion_j_m2,damping,\
               damping_value,end_rule\n2.5e-6,2600,7.5e10,250,10.5,6.25,0,,,,,\n";
    let complaint = said(all, "critical", &[]);
    let lines: Vec<_> = complaint.lines().collect();
    assert!(
        lines.len() == 2 && lines[1].starts_with("critical: empty cells, and what is used: law in 1"),
        "{complaint}"
    );
    let absent = said("radius_m,density_kg_m3,stiffness_pa,zeta\n2.5e-6,2600,7.5e10,1\n", "critical", &[]);
    assert!(absent.contains("adhesion_n_m (0 N/m), zeta_h (0), zeta_a (0), external_force_n (0 N)"), "{absent}");
    let measured = said(
        "diameter_m,density_kg_m3,restitution,speed_normal_m_s,rebound_speed_m_s,speed_tangential_out_m_s\n1e-5,1,1,1,1,0\n",
        "analyse",
        &[],
    );
    for words in ["analyse: columns used: diameter_m", "spin_rad_s (that of", "velocity_error_m_s (0.01 m/s)"] {
        assert!(measured.contains(words), "{measured}");
    }
}

/// One error for the table, not one for each row.
#[test]
fn absent_required_columns_are_one_error() {
    let mut table = String::from("Radius;density;restitution_speed_m_s;velocity;remark\n");
    for _ in 0..100 {
        writeln!(table, "5e-6;2600;130;3;a").unwrap();
    }
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    assert_eq!((output.status, output.stdout.len(), output.complaint().lines().count()), (2, 0, 1));
    for words in [
        "radius_m or diameter_m (did you mean it by `radius`?)",
        "density_kg_m3 (did you mean it by `density`?)",
        "speed_normal_m_s or velocity_x_m_s or velocity_y_m_s or velocity_z_m_s (did you mean it by `velocity`?); ",
        "the header is: Radius, density, restitution_speed_m_s, velocity, remark",
    ] {
        assert!(output.complaint().contains(words), "{words}: {}", output.complaint());
    }
    for (command, arguments, words) in [
        ("classify", &["--model", "simulation"][..], "stiffness_pa"),
        ("classify", &["--model", "both"], "stiffness_pa"),
        ("critical", &[], "stiffness_pa"),
        ("analyse", &[], "rebound_speed_m_s, speed_tangential_out_m_s; "),
    ] {
        let output = microimpact(command, &[&["-"], arguments].concat(), table.as_bytes());
        assert_eq!((output.status, output.stdout.len()), (2, 0), "{command}");
        assert!(output.complaint().contains(words), "{}", output.complaint());
    }
    let neither = said("radius_m,density_kg_m3,speed_normal_m_s\n", "classify", &[]);
    assert!(neither.contains("restitution or restitution_speed_m_s or yield_speed_m_s; "), "{neither}");
}

/// The list of columns names all columns that a command reads, each with a meaning, and the manual too.
#[test]
fn the_list_names_all_columns() {
    let required = "radius_m,density_kg_m3,stiffness_pa,restitution,speed_normal_m_s,rebound_speed_m_s,speed_tangential_out_m_s\n1\n";
    let in_space = "radius_m,density_kg_m3,stiffness_pa,velocity_z_m_s,stiffness_ratio\n1\n";
    let of_two = "radius_m,density_kg_m3,stiffness_pa,velocity_z_m_s,radius_2_m\n1\n";
    for (command, arguments, table) in [
        ("classify", &["--model", "both"][..], required),
        ("classify", &["--model", "simulation"], required),
        ("classify", &["--model", "simulation"], in_space),
        ("classify", &["--model", "simulation"], of_two),
        ("critical", &[], required),
        ("analyse", &[], required),
    ] {
        let list = microimpact("columns", &[command, "--format", "csv"], b"");
        let list = Written::read(&list.stdout, b',');
        let manual = String::from_utf8(microimpact("man", &[command], b"").stdout).unwrap().replace('\\', "");
        let said = said(table, command, arguments);
        let mut count = 0;
        for line in said.lines().filter(|line| !line.contains("not read")) {
            let names = line.split_once(": ").unwrap().1.split([' ', ',', ':', '(', ')']);
            for name in names.filter(|name| name.contains('_')) {
                let row = (0..list.rows.len()).find(|row| list.text(*row, "column") == name);
                let row = row.unwrap_or_else(|| panic!("{command}: {name}"));
                assert!(!list.text(row, "meaning").is_empty() && list.text(row, "read_by") == command, "{name}");
                assert!(manual.contains(name), "{command}: {name}");
                count += 1;
            }
        }
        assert!(count >= 7, "{said}");
    }
}

/// A default that takes the place of an empty cell is named, but none that the row replaces by another column.
#[test]
fn empty_cells_and_what_is_used() {
    let words = |command: &str, arguments: &[&str], table: &str| {
        let output = microimpact(command, &[&["-"], arguments].concat(), table.as_bytes());
        assert_eq!(output.status, 0, "{}", output.complaint());
        let complaint = output.complaint();
        complaint.lines().find_map(|line| Some(line.split_once("empty cells, and what is used: ")?.1.to_owned()))
    };
    let header = "radius_um,density_kg_m3,friction,restitution,restitution_speed_m_s,speed_normal_m_s,spin_rad_s,impulse_ratio\n";
    let filled = "5,2600,0.1,0.9,,3,1e3,\n";
    for format in ["table", "csv"] {
        let of = |rows: &str| words("classify", &["--format", format], &(header.to_owned() + rows));
        // An impulse ratio that is empty leaves the matter to friction.
        assert_eq!(of(filled).as_deref(), Some("impulse_ratio in 1 of 1 rows (as friction gives it)"));
        assert_eq!(of("5,2600,,0.9,,3,1e3,0\n"), None);
        assert_eq!(
            of(&("5,2600, ,,130,3,\u{a0},\n".to_owned() + &"5,2600,0.1,0.9,,3,1e3,0\n".repeat(200))).as_deref(),
            Some(
                "spin_rad_s in 1 of 201 rows (0 rad/s), friction in 1 of 201 rows (0), \
                 impulse_ratio in 1 of 201 rows (as friction gives it)"
            )
        );
    }
    let measured = "radius_um,density_kg_m3,speed_normal_m_s,rebound_speed_m_s,speed_tangential_out_m_s,velocity_error_mm_s\n\
                    5,2600,3,2,0,20\n5,2600,3,2,0,\n";
    assert_eq!(words("analyse", &[], measured).as_deref(), Some("velocity_error_mm_s in 1 of 2 rows (0.01 m/s)"));
    // Components of a vector have a default, the vector of a row in a plane none.
    let mixed = "radius_um,density_kg_m3,restitution,speed_normal_m_s,velocity_x_m_s,velocity_z_m_s,normal_z,spin_rad_s\n\
                 5,2600,0.9,3,,,,1\n5,2600,0.9,,,-3,1,\n";
    assert_eq!(words("classify", &[], mixed).as_deref(), Some("velocity_x_m_s in 1 of 2 rows (0 m/s)"));
    let forces = "radius_um,density_kg_m3,stiffness_pa,speed_normal_m_s,zeta_h\n5,2600,7.5e10,3,\n";
    assert_eq!(words("trajectory", &[], forces).as_deref(), Some("zeta_h in 1 of 1 rows (0)"));
}
