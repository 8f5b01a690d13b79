//! What all commands share: help that fits a screen, formats, the manual, completions; and the commands that list things.

use std::cell::Cell;
use std::io::{self, BufReader, Read, Write};

use clap::Parser;
use microimpact_cli::{Arguments, Streams};

use crate::classify::Written;
use crate::microimpact;

const COMMANDS: [&str; 13] = [
    "classify",
    "trajectory",
    "critical",
    "table",
    "analyse",
    "fit",
    "joint-fit",
    "population",
    "materials",
    "columns",
    "template",
    "man",
    "completions",
];

/// Lines and characters of a screen.
const SCREEN: (usize, usize) = (36, 101);

#[test]
fn help_fits_a_screen() {
    for command in COMMANDS.iter().filter(|command| **command != "fit") {
        let help = microimpact(command, &["--help"], b"").complaint();
        let widest = help.lines().map(|line| line.chars().count()).max().unwrap();
        assert!(help.lines().count() <= SCREEN.0 && widest <= SCREEN.1, "{widest}: {help}");
        assert!(help.contains("Example"), "{help}");
    }
    let help = microimpact("fit", &["--help"], b"").complaint();
    for words in ["speed-restitution", "jkr", "xlsx", "Exit status"] {
        assert!(help.contains(words), "{words}: {help}");
    }
    let help = microimpact("--help", &[], b"").complaint();
    for command in COMMANDS {
        assert!(help.contains(command), "{command}: {help}");
    }
}

/// The examples of the help run as they are given.
#[test]
fn examples_of_the_help_run() {
    let mut count = 0;
    for command in
        ["classify", "trajectory", "critical", "table", "analyse", "population", "materials", "columns", "template"]
    {
        let help = microimpact(command, &["--help"], b"").complaint().replace("\\\n", " ");
        for line in help.lines().filter_map(|line| line.strip_prefix("  cargo microimpact ")) {
            let mut words: Vec<String> = Vec::new();
            for (index, part) in line.split('\'').enumerate() {
                if index % 2 == 1 {
                    words.push(part.to_owned());
                } else {
                    words.extend(part.split_whitespace().map(str::to_owned));
                }
            }
            let words: Vec<_> = words.iter().map(String::as_str).collect();
            let output = microimpact(words[0], &words[1..], b"");
            assert!(output.status == 0 && !output.stdout.is_empty(), "{line}: {}", output.complaint());
            count += 1;
        }
    }
    assert_eq!(count, 9);
}

/// The table of --given is none of the user's, so that no option chooses its mark; a name may have a comma.
#[test]
fn given_numbers_have_a_decimal_point() {
    for (command, pair) in [("trajectory", "speed_normal_m_s=2,8"), ("population", "speed_m_s=1,900.5")] {
        let output = microimpact(command, &["--given", pair], b"");
        assert_eq!((output.status, output.stdout.len()), (2, 0));
        let complaint = output.complaint();
        assert!(complaint.contains(pair) && complaint.contains("--given takes a decimal point"), "{complaint}");
    }
    let given = "name=2,8 radius_um=5 density_kg_m3=2600 stiffness_gpa=75 speed_normal_m_s=2.8";
    let arguments: Vec<_> = ["--given"].into_iter().chain(given.split(' ')).collect();
    assert_eq!(microimpact("trajectory", &arguments, b"").status, 0);
}

/// JSON and CSV have the same numbers; a cell that is empty is null.
#[test]
fn formats_agree() {
    for (command, arguments) in [
        ("classify", &["--model", "both"][..]),
        ("classify", &["--model", "simulation", "--scalar", "f32"]),
        ("critical", &[]),
        ("analyse", &[]),
        ("trajectory", &[]),
        ("materials", &[]),
        ("columns", &[]),
        ("table", &["--cells", "3"]),
    ] {
        let run = |format: &str| microimpact(command, &[arguments, &["--format", format]].concat(), b"");
        let csv = run("csv");
        let json: serde_json::Value = serde_json::from_slice(&run("json").stdout).unwrap();
        let mut reader = csv::Reader::from_reader(&csv.stdout[..]);
        let names = reader.headers().unwrap().clone();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let objects = json.as_array().unwrap();
        assert_eq!(objects.len(), rows.len(), "{command}");
        for (row, object) in rows.iter().zip(objects) {
            assert_eq!(object.as_object().unwrap().len(), names.len(), "{command}");
            for (name, cell) in names.iter().zip(row) {
                match &object[name] {
                    serde_json::Value::Null => assert_eq!(cell, "", "{command}, {name}"),
                    serde_json::Value::String(text) => assert_eq!(cell, text, "{command}, {name}"),
                    number => {
                        let (cell, number) = (cell.parse::<f64>().unwrap(), number.as_f64().unwrap());
                        // The parser of JSON may miss the last digit.
                        assert!((cell - number).abs() <= 2.0 * f64::EPSILON * cell.abs(), "{command}, {name}");
                    }
                }
            }
        }
        assert!(!run("table").stdout.is_empty());
    }
}

/// What `trajectory` writes agrees with the impact: peak, end, speed of the rebound.
#[test]
fn a_trajectory_is_that_of_its_impact() {
    let table = "name;radius_um;density_kg_m3;stiffness_gpa;adhesion_n_m;zeta_h;zeta_a;friction;speed_normal_m_s;spin_rad_s\n\
                 a;5,06;2600;75;250;10,5;6,25;0,1;2,8;146000\nb;5,06;2600;75;250;10,5;6,25;0,1;-2,8;0\n";
    let course = microimpact("trajectory", &["-", "--format", "csv"], table.as_bytes());
    let impact = microimpact("classify", &["-", "--format", "csv", "--model", "simulation"], table.as_bytes());
    assert_eq!(course.status, 1, "{}", course.complaint());
    let course = Written::read(&course.stdout, b',');
    let impact = Written::read(&impact.stdout, b';');
    let number = |column: &str| impact.text(0, column).replace(',', ".").parse::<f64>().unwrap();
    let row_of = |event: &str| (0..course.rows.len()).find(|row| course.text(*row, "event") == event).unwrap();
    let (peak, rolls, end) = (row_of("peak"), row_of("rolls"), row_of("end"));
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    assert!(close(course.number(peak, "indentation_m"), number("max_indentation_m")));
    assert!(close(course.number(peak, "time_s"), number("time_peak_s")));
    assert!(close(course.number(rolls, "time_s"), number("time_roll_s")));
    assert!(close(course.number(end, "time_s"), number("contact_time_s")));
    assert!(close(course.number(end, "indentation_rate_m_s"), -number("rebound_speed_m_s")));
    let last = course.rows.len() - 1;
    assert!(
        course.text(last, "error").contains("speed_normal_m_s: \"-2,8\" is refused"),
        "{}",
        course.text(last, "error")
    );
    let times: Vec<f64> = (0..last).map(|row| course.number(row, "time_s")).collect();
    assert!(times.len() > 20 && times.is_sorted());
}

/// Two materials give the stiffness that the paper uses for them (B2, Table 1).
#[test]
fn materials_by_name() {
    let output = microimpact("materials", &["Glass", "steel", "--format", "csv"], b"");
    let stiffness = Written::read(&output.stdout, b',').number(0, "stiffness_pa");
    assert!((stiffness / 7.5e10 - 1.0).abs() < 0.01, "{stiffness:e}");
    let output = microimpact("materials", &["cheese"], b"");
    assert!(
        output.status == 2 && output.complaint().contains("choose one of: aluminium alloy, "),
        "{}",
        output.complaint()
    );
}

#[test]
fn manual_and_completions() {
    for command in COMMANDS {
        let page = String::from_utf8(microimpact("man", &[command], b"").stdout).unwrap();
        assert!(page.contains(".SH OPTIONS") && page.contains(".TH "), "{command}");
    }
    assert_eq!(microimpact("man", &["cook"], b"").status, 2);
    for (shell, words) in
        [("bash", "_microimpact()"), ("zsh", "#compdef microimpact"), ("fish", "complete -c microimpact")]
    {
        let script = String::from_utf8(microimpact("completions", &[shell], b"").stdout).unwrap();
        assert!(script.contains(words) && COMMANDS.iter().all(|command| script.contains(command)), "{shell}");
    }
}

/// A long table in the order of its rows, whatever core computed which; and the summary shows the first of them.
#[test]
fn long_tables_stay_in_order() {
    let mut table = String::from("name,radius_m,density_kg_m3,restitution,speed_normal_m_s\n");
    let rows = 30_000;
    for row in 0..rows {
        let speed = if row == 20_000 { "-1".to_owned() } else { format!("{}", 1.0 + f64::from(row) * 1e-3) };
        table += &format!("{row},5e-6,2600,0.5,{speed}\n");
    }
    let output = crate::classify::run(&["-", "--format", "csv"], table.as_bytes());
    assert_eq!(output.status, 1, "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    assert_eq!(written.rows.len(), rows as usize);
    for (row, record) in written.rows.iter().enumerate() {
        assert_eq!(record[0], row.to_string());
        assert_eq!(written.text(row, "rebound_speed_m_s").is_empty(), row == 20_000);
    }
    let summary = crate::classify::run(&["-"], table.as_bytes());
    let text = String::from_utf8(summary.stdout).unwrap();
    assert_eq!(summary.status, 1);
    assert!(text.contains("The first 100 of 30000 rows; --format csv writes all."), "{text}");
    assert!(text.contains("The first bad row below these is row 20001: speed_normal_m_s: \"-1\" is refused"), "{text}");
    assert!(text.lines().count() < 120, "{}", text.lines().count());
}

/// Rows that are made while they are read.
struct Made<'a> {
    rows: usize,
    made: &'a Cell<usize>,
    pending: &'static [u8],
}

impl Read for Made<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.pending.is_empty() && self.made.get() < self.rows {
            self.made.set(self.made.get() + 1);
            self.pending = b"5e-6,2600,130,2e-12,3.25\n";
        }
        let length = self.pending.read(buffer)?;
        Ok(length)
    }
}

/// Counts the rows that are written, and the most that had been read and were not yet written.
struct Lagging<'a> {
    made: &'a Cell<usize>,
    written: usize,
    most: usize,
}

impl Write for Lagging<'_> {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.most = self.most.max(self.made.get() - self.written.min(self.made.get()));
        self.written += buffer.iter().filter(|byte| **byte == b'\n').count();
        Ok(buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The rows that are held at a time do not depend on the length of the table; with MICROIMPACT_EXHAUSTIVE of five million rows.
#[test]
fn memory_is_constant() {
    let most_rows = if std::env::var_os("MICROIMPACT_EXHAUSTIVE").is_some() { 5_000_000 } else { 60_000 };
    let held = |rows: usize| {
        let made = Cell::new(0);
        let header = &b"radius_m,density_kg_m3,restitution_speed_m_s,work_of_adhesion_j,speed_normal_m_s\n"[..];
        let mut input = BufReader::new(header.chain(Made { rows, made: &made, pending: b"" }));
        let mut output = Lagging { made: &made, written: 0, most: 0 };
        let arguments = Arguments::try_parse_from(["microimpact", "classify", "-", "--format", "csv"]).unwrap();
        let status = arguments.run(&mut Streams { input: &mut input, output: &mut output, errors: &mut Vec::new() });
        assert_eq!((status, output.written), (0, rows + 1));
        output.most
    };
    let most = held(most_rows);
    // Three chunks of 8192 rows: one is read, one computed, one written. Buffers hold some more.
    assert!((16_000..30_000).contains(&most), "{most}");
}
