//! The contract of headers: units, preambles, encodings, workbooks, and results that are read again.

use crate::classify::{Written, run};
use crate::{Output, microimpact};

/// The impact of the paper's Table 1 in SI units.
const TABLE_1: &str = "radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,restitution,work_of_adhesion_j,friction,\
                       speed_normal_m_s,spin_rad_s\n5.06e-6,2600,75e9,250,10.5,6.25,0.978,2.22e-12,0.1,2.8,1.46e5\n";

/// The same in units as people write them.
const OTHER_UNITS: &str = "Radius [µm];density_g_cm3;Stiffness (GPa);adhesion [mN/m];zeta_h;zeta_a;restitution [%];\
                           work_of_adhesion_pj;friction;speed_normal_cm_s;spin_krad_s\n\
                           5.06;2.6;75;250e3;10.5;6.25;97.8;2.22;0.1;280;146\n";

fn classified(table: &[u8], model: &str) -> Output {
    run(&["-", "--format", "csv", "--model", model], table)
}

/// What a run computed, without the columns of its input.
fn computed(output: &Output, delimiter: u8) -> Vec<String> {
    assert_eq!(output.status, 0, "{}", output.complaint());
    let written = Written::read(&output.stdout, delimiter);
    ["outcome", "overall_restitution", "rebound_speed_m_s", "speed_tangential_out_m_s", "spin_out_rad_s"]
        .map(|column| written.text(0, column).to_owned())
        .into()
}

#[test]
fn units_are_those_of_the_header() {
    for model in ["rigid-body", "simulation"] {
        let si = classified(TABLE_1.as_bytes(), model);
        let other = classified(OTHER_UNITS.as_bytes(), model);
        assert_eq!(computed(&si, b','), computed(&other, b';'), "{model}: {}", other.complaint());
    }
    let said = classified(OTHER_UNITS.as_bytes(), "simulation").complaint();
    for words in [
        "Radius [µm] (radius_m in um)",
        "density_g_cm3 (density_kg_m3 in g/cm3)",
        "adhesion [mN/m] (adhesion_n_m in mN/m)",
    ] {
        assert!(said.contains(words), "{said}");
    }
    // The same letters are a force per length, and a moment.
    let oblique = "peeling_nn_m,speed_tangential_m_s,radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,friction,speed_normal_m_s\n\
                   5,1,5e-6,2600,75e9,250,0.1,2.8\n";
    let si = oblique.replace("peeling_nn_m", "peeling_n_m").replace("\n5,1", "\n5e-9,1");
    assert_eq!(
        computed(&classified(oblique.as_bytes(), "simulation"), b','),
        computed(&classified(si.as_bytes(), "simulation"), b',')
    );
}

/// Spaces beside separators leave the quotes in the cells.
#[test]
fn quotes_with_spaces_around_separators() {
    let plain = "radius_um,density_kg_m3,restitution,speed_normal_m_s\n5.06,2600,0.978,2.8\n";
    let quoted = plain.replacen("radius_um,density_kg_m3", "\"radius_micron\" , \"density_kg_m3\"", 1);
    let computed = |table: &str| computed(&classified(table.as_bytes(), "rigid-body"), b',');
    assert_eq!(computed(plain), computed(&quoted));
}

/// Wrong units are one error of the file, not results that are a million times too large.
#[test]
fn wrong_units_are_refused() {
    for (header, words) in [
        (
            "Radius [um/s];density_kg_m3;restitution;speed_normal_m_s",
            "radius: the unit \"um/s\" is refused; give one of m, cm",
        ),
        (
            "radius_m [um];density_kg_m3;restitution;speed_normal_m_s",
            "radius_m: the unit in brackets is not that in the name",
        ),
        ("radius_m;radius_um;density_kg_m3;speed_normal_m_s", "radius_m twice, as radius_m and radius_um"),
        ("radius_furlong;density_kg_m3;restitution;speed_normal_m_s", "did you mean it by `radius_furlong`?"),
    ] {
        let output = classified(format!("{header}\n5;2600;1;2\n").as_bytes(), "rigid-body");
        assert_eq!((output.status, output.stdout.len()), (2, 0), "{header}");
        assert!(output.complaint().contains(words), "{words}: {}", output.complaint());
    }
    // One unit that is not known leaves the row one of units.
    let table = "radius,density,restitution,speed_normal\num,kg/m3,1,furlong\n5,2600,0.5,2\n";
    let complaint = classified(table.as_bytes(), "rigid-body").complaint();
    assert!(complaint.contains("speed_normal: the unit \"furlong\" is refused; give one of m/s, cm/s"), "{complaint}");
    let in_per_cent = classified(table.replace("1,furlong", "%,m/s").as_bytes(), "rigid-body");
    assert_eq!(Written::read(&in_per_cent.stdout, b',').number(0, "rebound_speed_m_s"), 0.01);
    // A row of units may repeat that of the name, and a dash states none.
    let repeated = "name,radius_um,density_kg_m3,restitution,speed_normal_cm_s\n-,µm,-,1,CM/S\na,5,2600,0.5,200\n";
    let output = classified(repeated.as_bytes(), "rigid-body");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    assert_eq!((written.text(0, "name"), written.number(0, "rebound_speed_m_s")), ("a", 1.0));
    // A row of units that contradicts the header.
    let output =
        classified(b"radius_m;density_kg_m3;restitution;speed_normal_m_s\num;kg/m3;-;m/s\n5;2600;1;2\n", "rigid-body");
    assert!(output.status == 2 && output.complaint().contains("says \"um\""), "{}", output.complaint());
}

/// What a message names is what the header and the cell have.
#[test]
fn messages_name_the_header() {
    let table =
        "Radius [um],density_kg_m3,restitution,speed_normal_cm_s\n-5,2600,0.9,280\n5,2600,0.9,-280\n5,x,0.9,1\n";
    let output = classified(table.as_bytes(), "rigid-body");
    let written = Written::read(&output.stdout, b',');
    for (row, words) in [
        (0, "Radius [um]: \"-5\" (-5e-6 m) is refused: radius must be 1e-10 to 1 m"),
        (
            1,
            "speed_normal_cm_s: \"-280\" (-2.8 m/s) is refused: approach speed must be 1e-12 to 1e6 m/s; enter -280 as 280",
        ),
        (2, "density_kg_m3: \"x\" is not a number"),
    ] {
        assert_eq!(written.text(row, "error"), words);
    }
}

/// What spreadsheets, instruments and people put before a header, below it and after the cells.
#[test]
fn preambles_unit_rows_and_padding() {
    let table = "sep=;\r\n# an instrument\r\n;;;\r\nName;Radius;density;restitution;speed_normal;remark\r\n;µm;g/cm3;-;cm/s;\r\n\
                 a;5,06;2,6;0,978;280;x;;\r\n;;;;;\r\n\r\nb;5,06;2,6;0,978;280\r\n;;;;;;\r\n";
    let output = classified(table.as_bytes(), "rigid-body");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<_> = text.split("\r\n").collect();
    assert_eq!(lines.len(), 6, "{text}");
    assert_eq!(lines[..2], ["sep=;", "# an instrument"]);
    assert!(
        lines[2].starts_with("Name;Radius [µm];density [g/cm3];restitution;speed_normal [cm/s];remark;outcome;"),
        "{text}"
    );
    assert!(lines[3].starts_with("a;5,06;2,6;0,978;280;x;rebound;rolling;0,978"), "{text}");
    // The result is read again, with the same numbers.
    let again = classified(text.as_bytes(), "rigid-body");
    let (first, second) = (text.as_bytes(), &again.stdout[..]);
    let body = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        Written::read(text.split_once("instrument\r\n").unwrap().1.as_bytes(), b';')
            .text(1, "energy_before_j")
            .to_owned()
    };
    assert_eq!((again.status, body(first)), (0, body(second)), "{}", again.complaint());
}

#[test]
fn encodings() {
    // The code page of older spreadsheets has one byte for the sign of a micrometre.
    let old = b"name,Radius [\xb5m],density_kg_m3,restitution,speed_normal_m_s\nM\xfcller,5,2600,0.5,2\n";
    let written = String::from_utf8(classified(old, "rigid-body").stdout).unwrap();
    assert!(written.starts_with("name,Radius [µm],") && written.contains("\nMüller,5,2600,0.5,2,rebound"), "{written}");
    let text = TABLE_1.replace(',', "\t");
    let plain = computed(&classified(text.as_bytes(), "rigid-body"), b'\t');
    for (mark, bytes) in [
        (true, u16::to_le_bytes as fn(u16) -> [u8; 2]),
        (true, u16::to_be_bytes),
        (false, u16::to_le_bytes),
        (false, u16::to_be_bytes),
    ] {
        let text = if mark { format!("\u{feff}{text}") } else { text.clone() };
        let encoded: Vec<u8> = text.encode_utf16().flat_map(bytes).collect();
        let output = classified(&encoded, "rigid-body");
        assert!(output.stdout.starts_with("\u{feff}radius_m\t".as_bytes()), "{}", output.complaint());
        assert_eq!(computed(&output, b'\t'), plain);
    }
    for (bytes, words) in [
        (&b"\xd0\xcf\x11\xe0workbook"[..], "older format; save it as .xlsx or CSV"),
        (b"a\xff\x00\x00b\n", "this is no text"),
        (b"PK\x03\x04 no zip", "the workbook cannot be read"),
    ] {
        let output = classified(bytes, "rigid-body");
        assert_eq!((output.status, output.stdout.len()), (2, 0), "{words}");
        assert!(output.complaint().contains(words), "{}", output.complaint());
    }
}

/// The workbook has an empty sheet, then a header with units, an impact, an empty row, and two more rows.
#[test]
fn a_workbook() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/spreadsheets/impacts.xlsx");
    for (file, input) in [(path, Vec::new()), ("-", std::fs::read(path).unwrap())] {
        let output = run(&[file, "--format", "csv"], &input);
        assert_eq!(output.status, 1, "{}", output.complaint());
        let written = Written::read(&output.stdout, b',');
        assert_eq!(written.rows.len(), 3);
        let speeds = [0, 1].map(|row| written.number(row, "rebound_speed_m_s"));
        assert_eq!(speeds, [0.978 * 2.8, 0.978 * 1.2e-3]);
        assert_eq!(written.text(2, "error"), "density_g_cm3: \"heavy\" is not a number");
    }
}

/// The workbook has a hidden sheet before that of the impacts.
#[test]
fn cells_of_a_workbook_that_are_no_numbers() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/spreadsheets/cells.xlsx");
    let output = run(&[path, "--format", "csv"], b"");
    let sheet = "sheet \"impacts\" of the workbook is read, and not \"old\" (hidden), \"notes\"";
    assert!(output.status == 1 && output.complaint().contains(sheet), "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    let refused = |column: &str, text: &str, reason: &str| format!("{column}: \"{text}\" is {reason}");
    let date = |text: &str| refused("speed_normal_m_s", text, "a date or time; enter the number");
    let formula = refused("friction", "=B2*2", "a formula without a value; calculate the workbook");
    let reasons =
        ["", &date("2026-09-02"), &date("02:09:00"), &date("2026-09-02 02:09:00"), &date("26:09:00"), &formula];
    for (row, reason) in reasons.into_iter().enumerate() {
        let error = written.text(row, "error");
        assert!(error.starts_with(reason) && error.is_empty() == reason.is_empty(), "{row}: {error}");
        assert_eq!(written.text(row, "day"), "2026-09-02");
    }
    assert_eq!(written.rows.len(), reasons.len());
}

/// A comment or a title over several columns is one, a value over several rows is not known of all of them.
#[test]
fn merged_cells_of_a_workbook() {
    let titled = concat!(env!("CARGO_MANIFEST_DIR"), "/data/spreadsheets/titled.xlsx");
    let output = run(&[titled, "--format", "csv", "--model", "simulation"], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    assert!(output.complaint().contains("a line above the header is not read"), "{}", output.complaint());
    let output = run(&[concat!(env!("CARGO_MANIFEST_DIR"), "/data/spreadsheets/merged.xlsx")], b"");
    assert_eq!((output.status, output.stdout.len()), (2, 0));
    assert!(output.complaint().contains("the cells C3:C4 of sheet \"Sheet\" are merged"), "{}", output.complaint());
}

#[test]
fn a_quote_that_is_not_closed() {
    let header = "name,radius_m,density_kg_m3,restitution,speed_normal_m_s\n";
    let rows = "a,5e-6,2600,1,2\n\"b,5e-6,2600,1,2\nc,5e-6,2600,1,2\n";
    let output = classified((header.to_owned() + rows).as_bytes(), "rigid-body");
    assert_eq!(output.status, 2);
    assert!(output.complaint().contains("row 2, line 3: a quote is not closed"), "{}", output.complaint());
    // Quotes that are closed, with line ends inside, and a lone one within a cell.
    let rows = "\"a\nb\",5e-6,2600,1,2\n5\" pipe,5e-6,2600,1,2\n\"c\n\",5e-6,2600,1,2\n";
    let output = classified((header.to_owned() + rows).as_bytes(), "rigid-body");
    assert_eq!(output.status, 0, "{}", output.complaint());
}

/// Comments may have quotes that are not closed. A name may begin with # in quotes, and a single dash is a value that is missing.
#[test]
fn comments_and_rules_are_no_rows() {
    let table = "=====,=====\nname,radius_m,density_kg_m3,restitution,speed_normal_m_s\n----,----,---,-,-\n# in 5\" pipe, 3 times\n\
                 a,5e-6,2600,1,2\n==,==,==,==,==\n\"# again\",,,,\n\"#2\",5e-6,2600,1,3\n#c,5e-6,2600,1,4\n-,-,-,-,-\n# end\n";
    let output = classified(table.as_bytes(), "rigid-body");
    let written = Written::read(&output.stdout, b',');
    let names: Vec<_> = (0..written.rows.len()).map(|row| written.text(row, "name")).collect();
    assert_eq!(names, ["a", "#2", "-"], "{}", output.complaint());
    assert_eq!([0, 1].map(|row| written.number(row, "rebound_speed_m_s")), [2.0, 3.0]);
    // A result is read again with all of its rows.
    assert_eq!(Written::read(&classified(&output.stdout, "rigid-body").stdout, b',').rows.len(), 3);
    assert_eq!((output.status, written.text(2, "rebound_speed_m_s")), (1, ""));
}

/// Titles above the header are no header; the result keeps them, so that it is read in the same way.
#[test]
fn titles_above_the_header_are_skipped() {
    let header = "radius_um,density_kg_m3,restitution,speed_normal_m_s\n5,2600,1,2\n";
    let titles = "Rig 3: laser Doppler, both components\n# noted later\nspeed,of,spheres\n";
    let output = classified(format!("{titles}\n{header}").as_bytes(), "rigid-body");
    assert_eq!(output.status, 0, "{}", output.complaint());
    assert!(output.complaint().contains("2 lines above the header are not read"), "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    let table = text.strip_prefix(titles).unwrap_or_else(|| panic!("{text}"));
    assert_eq!(Written::read(table.as_bytes(), b',').text(0, "rebound_speed_m_s"), "2");
    let again = String::from_utf8(classified(text.as_bytes(), "rigid-body").stdout).unwrap();
    assert!(again.starts_with(titles) && again.lines().count() == 5, "{again}");
    // A row of units may be what completes the header.
    let with_units = "My spheres\nradius,density,restitution,speed normal\num,g/cm3,,m/s\n5,2.6,1,2\n";
    assert_eq!(classified(with_units.as_bytes(), "rigid-body").status, 0);
    // Without a header that has all columns, the message quotes the line that has most of them.
    let misspelt = header.replace("density", "densty");
    let words = "(did you mean it by `densty_kg_m3`?); the header is: radius_um, densty_kg_m3";
    for titles in ["", "Rig 3\n", titles] {
        let output = classified(format!("{titles}{misspelt}").as_bytes(), "rigid-body");
        assert!(output.status == 2 && output.complaint().contains(words), "{}", output.complaint());
    }
}

/// What people and spreadsheets write for units and numbers, where it has one meaning; and where it has none, what to do.
#[test]
fn headings_and_numbers_of_spreadsheets() {
    let table = |spin: &str, speed: &str| {
        format!("Radius / µm;Density g/cm³;restitution;speed normal m/s;spin_rad_s\n5,06;2,6;1;{speed};{spin}\n")
    };
    let output = classified(table("\u{2212}100", "2,8").as_bytes(), "rigid-body");
    let plain = "radius_um;density_g_cm3;restitution;speed_normal_m_s;spin_rad_s\n5,06;2,6;1;2,8;-100\n";
    assert_eq!(computed(&output, b';'), computed(&classified(plain.as_bytes(), "rigid-body"), b';'));
    assert!(output.complaint().contains("Radius / µm (radius_m in um)"), "{}", output.complaint());
    for (speed, words) in [
        ("1.234,5", "\"\"1.234,5\"\" is not a number; write it without thousands separators and spaces"),
        ("2 600", "\"\"2 600\"\" is not a number; write it without thousands separators and spaces"),
        ("2,8 m/s", "is not a number; enter the number alone, and give its unit in the header"),
        ("2,8?", "\"\"2,8?\"\" is not a number\""),
        ("n/a", "\"\"n/a\"\" is not a number\""),
    ] {
        let output = classified(table("0", speed).as_bytes(), "rigid-body");
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status == 1 && text.contains(words), "{text}");
    }
}

/// A result means the same to every command that reads it.
#[test]
fn results_are_inputs_of_other_commands() {
    let written = |command: &str, arguments: &[&str], input: &[u8]| {
        let output = microimpact(command, &[&["-", "--format", "csv"], arguments].concat(), input);
        assert_eq!(output.status, 0, "{command} {arguments:?}: {}", output.complaint());
        output.stdout
    };
    let simulated = written("classify", &["--model", "simulation"], TABLE_1.as_bytes());
    let bodies = written("classify", &[], TABLE_1.as_bytes());
    // R of the table, not e of the simulation, is what the rigid body takes.
    let bodies_again = written("classify", &[], &simulated);
    let rebound = |bytes: &[u8]| Written::read(bytes, b',').text(0, "rebound_speed_m_s").to_owned();
    assert_eq!(rebound(&bodies), rebound(&bodies_again));
    assert_ne!(rebound(&bodies), rebound(&simulated));
    // The analysis of a simulated rebound finds its restitution e.
    let analysed = written("analyse", &[], &simulated);
    let e = |bytes: &[u8]| Written::read(bytes, b',').number(0, "overall_restitution");
    assert!((e(&analysed) / e(&simulated) - 1.0).abs() < 1e-12);
    // And its adhesion coefficient gives that rebound back.
    let kept = Written::read(&analysed, b',');
    let rho = kept.text(0, "adhesion_coefficient");
    let table = TABLE_1.replace("work_of_adhesion_j", "adhesion_coefficient").replace("2.22e-12", rho);
    assert!((e(&written("classify", &[], table.as_bytes())) / e(&simulated) - 1.0).abs() < 1e-9);
    // Critical speeds may be added to any of these.
    assert!(Written::read(&written("critical", &[], &analysed), b',').number(0, "critical_speed_m_s") < 2.8);
}
