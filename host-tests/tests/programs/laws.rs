//! The columns of `classify` and `critical` that choose a law of contact.

use crate::classify::Written;
use crate::{Output, microimpact};

const IMPACTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/laws.csv");
const CRITICAL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/laws_critical.csv");

/// What chooses a law, with a part of the reason for which the row is refused.
type Refusal<'a> = (&'a [(&'a str, &'a str)], &'a str);

fn run(command: &str, table: &str, arguments: &[&str]) -> Output {
    microimpact(command, &[&["-", "--format", "csv"], arguments].concat(), table.as_bytes())
}

fn simulated(table: &str, arguments: &[&str]) -> Written {
    let arguments = [&["--model", "simulation"], arguments].concat();
    Written::read(&run("classify", table, &arguments).stdout, b',')
}

/// A table of one sphere with these cells besides.
fn table(cells: &[(&str, &str)]) -> String {
    let column = |index: fn(&(&str, &str)) -> String| cells.iter().map(index).collect::<Vec<_>>().concat();
    let (names, values) = (column(|cell| format!(",{}", cell.0)), column(|cell| format!(",{}", cell.1)));
    format!(
        "radius_m,density_kg_m3,stiffness_pa,friction,speed_normal_m_s,speed_tangential_m_s{names}\n\
         5e-6,2600,7.5e10,0.1,3,1{values}\n"
    )
}

/// The impact of that sphere, which must not be refused.
fn impact(cells: &[(&str, &str)]) -> Written {
    let impact = simulated(&table(cells), &[]);
    assert_eq!(impact.text(0, "error"), "", "{cells:?}");
    impact
}

/// The results in which two tables of one row must agree.
fn results(written: &Written) -> Vec<String> {
    ["outcome", "overall_restitution", "max_indentation_m", "contact_time_s", "work_material_j", "group_a", "group_h"]
        .map(|column| written.text(0, column).to_owned())
        .into()
}

#[test]
fn reference_impacts() {
    let given = Written::read(&std::fs::read(IMPACTS).unwrap(), b',');
    let output =
        microimpact("classify", &[IMPACTS, "--model", "simulation", "--format", "csv", "--tolerance", "1e-12"], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let found = Written::read(&output.stdout, b',');
    assert_eq!((given.rows.len(), found.rows.len()), (69, 69));
    for row in 0..given.rows.len() {
        let name = format!("{} {}", given.text(row, "family"), given.text(row, "name"));
        let law = given.text(row, "law");
        assert_eq!(found.text(row, "law"), law, "{name}");
        assert_eq!(found.text(row, "outcome"), given.text(row, "outcome"), "{name}");
        if !given.text(row, "restitution").is_empty() {
            let square = |table: &Written| table.overall_restitution(row).powi(2);
            let error = (square(&found) - square(&given)).abs();
            assert!(error <= 1e-11, "{name}: e^2 {error:e}");
        }
        for (column, allowed) in [("max_indentation_m", 1e-8), ("time_peak_s", 1e-8)] {
            if given.text(row, column).is_empty() {
                // The reference has no peaks of captured spheres with jkr, though they exist.
                assert!(law == "jkr" || found.text(row, column).is_empty(), "{name}, {column}");
                continue;
            }
            let error = (found.number(row, column) / given.number(row, column) - 1.0).abs();
            assert!(error <= allowed, "{name}, {column}: {error:e}");
        }
        let captured = given.text(row, "outcome") == "capture";
        assert_eq!(found.text(row, "contact_time_s").is_empty(), captured, "{name}");
        // The groups describe the ring with damping in proportion to the elastic force.
        let described =
            ["hertz", "ring"].contains(&law) && ["none", "hysteretic"].contains(&given.text(row, "damping"));
        for group in ["group_a", "group_b", "group_h", "group_g"] {
            assert_eq!(!found.text(row, group).is_empty(), described, "{name}, {group}");
        }
    }
}

#[test]
fn reference_critical_speeds() {
    let given = Written::read(&std::fs::read(CRITICAL).unwrap(), b',');
    let output = microimpact("critical", &[CRITICAL, "--format", "csv", "--tolerance", "1e-10"], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let found = Written::read(&output.stdout, b',');
    assert_eq!((given.rows.len(), found.rows.len()), (10, 10));
    for row in 0..given.rows.len() {
        let name = given.text(row, "name");
        assert_eq!((found.text(row, "law"), found.text(row, "critical")), (given.text(row, "law"), "speed"), "{name}");
        let error = (found.number(row, "critical_speed_m_s") / given.number(row, "critical_speed_m_s") - 1.0).abs();
        assert!(error <= 1e-9, "{name}: {error:e}");
    }
}

/// Results in the reference are not taken for inputs, and no column is taken for a misspelling of another.
#[test]
fn reference_tables_are_read_as_they_are() {
    for (command, path, model, unread) in [
        (
            "classify",
            IMPACTS,
            &["--model", "simulation"][..],
            "family, outcome, restitution, max_indentation_m, time_peak_s, contact_time_s",
        ),
        ("critical", CRITICAL, &[], "critical_speed_m_s"),
    ] {
        let complaint = microimpact(command, &[&[path, "--format", "csv"], model].concat(), b"").complaint();
        assert!(complaint.contains(&format!("columns not read: {unread}\n")), "{complaint}");
    }
    let bundled = microimpact("classify", &["--model", "simulation"], b"").complaint();
    assert!(bundled.contains("work_of_adhesion_j") && !bundled.contains("did you mean"), "{bundled}");
}

/// A row without a word has the law, damping and end of contact of a row that names them.
#[test]
fn absent_and_empty_cells() {
    let (strength, zeta_h) = (("adhesion_n_m", "250"), ("zeta_h", "10.5"));
    let jkr = [("law", "jkr"), ("work_of_adhesion_j_m2", "0.2")];
    let same = |short: &[(&str, &str)], long: &[(&str, &str)], law: &str| {
        let (short, long) = (impact(short), impact(long));
        assert_eq!(results(&short), results(&long));
        assert_eq!((short.text(0, "law"), long.text(0, "law")), (law, law));
    };
    same(&[zeta_h], &[("law", "hertz"), zeta_h], "hertz");
    same(&[("adhesion_n_m", ""), zeta_h], &[("law", " Hertz "), ("end_rule", "No-Indentation"), zeta_h], "hertz");
    same(&[("law", ""), strength, zeta_h], &[("law", "ring"), strength, zeta_h], "ring");
    same(&[strength, zeta_h], &[strength, ("damping", "hysteretic"), ("damping_value", "10.5")], "ring");
    same(&[strength], &[strength, ("damping", "none")], "ring");
    same(&jkr, &[jkr[0], jkr[1], ("end_rule", "snap-off")], "jkr");
    // Damping of a ring of strength zero is no damping.
    same(&[zeta_h], &[("zeta_a", "6.25"), zeta_h], "hertz");
}

/// Each word changes the result; two ends of contact that should be the same are.
#[test]
fn words_change_the_result() {
    let work = ("work_of_adhesion_j_m2", "0.2");
    let damping = |name, value| [("law", "hertz"), ("damping", name), ("damping_value", value)];
    let ended = |cells: [(&'static str, &'static str); 3], rule| [&cells[..], &[("end_rule", rule)]].concat();
    let dampings = [damping("hysteretic", "10"), damping("viscoelastic", "1e-9"), damping("constant", "0.9")];
    let impacts = [
        vec![("law", "hertz")],
        vec![("law", "dmt"), work, ("damping", "constant"), ("damping_value", "0.9")],
        vec![("law", "jkr"), work],
        vec![("law", "jkr"), work, ("end_rule", "pull-off")],
        dampings[0].to_vec(),
        dampings[1].to_vec(),
        ended(dampings[1], "no-force"),
        dampings[2].to_vec(),
        ended(dampings[2], "no-force"),
    ];
    let mut restitutions: Vec<_> =
        impacts.iter().map(|cells| impact(cells).text(0, "overall_restitution").to_owned()).collect();
    restitutions.sort_unstable();
    restitutions.dedup();
    assert_eq!(restitutions.len(), impacts.len(), "{restitutions:?}");
    let [hysteretic, without_tension] = ["no-indentation", "no-force"].map(|rule| impact(&ended(dampings[0], rule)));
    let [e, other] = [&hysteretic, &without_tension].map(|impact| impact.number(0, "overall_restitution"));
    assert!(e < 0.999 && (e - other).abs() < 1e-8, "{e} {other}");
    // The name of the law goes into the summary too.
    for (command, model) in [("classify", &["--model", "simulation"][..]), ("critical", &[])] {
        let summary = microimpact(command, &[&["-"], model].concat(), table(&impacts[2]).as_bytes());
        let text = String::from_utf8(summary.stdout).unwrap();
        assert!(text.contains(" law ") && text.contains(" jkr "), "{text}");
    }
}

#[test]
fn refused_rows_say_why() {
    const WORK: (&str, &str) = ("work_of_adhesion_j_m2", "0.2");
    const RING: (&str, &str) = ("adhesion_n_m", "250");
    const REFUSED: [Refusal<'_>; 24] = [
        (&[("law", "spring")], "law: \"spring\" is refused: it must be hertz or ring or dmt or jkr"),
        (
            &[("damping", "plastic"), ("damping_value", "1")],
            "damping: \"plastic\" is refused: it must be none or hysteretic or viscoelastic or constant",
        ),
        (
            &[("end_rule", "snap-off")],
            "end_rule: \"snap-off\" is refused: it must be no-indentation or no-force with law hertz",
        ),
        (
            &[RING, ("end_rule", "no-force")],
            "end_rule: \"no-force\" is refused: it must be no-indentation with law ring",
        ),
        (
            &[("law", "dmt"), WORK, ("end_rule", "end")],
            "end_rule: \"end\" is refused: it must be no-indentation with law dmt",
        ),
        (
            &[("law", "jkr"), WORK, ("end_rule", "no-force")],
            "end_rule: \"no-force\" is refused: it must be snap-off or pull-off with law jkr",
        ),
        (&[("law", "dmt")], "work_of_adhesion_j_m2: missing"),
        (&[("law", "jkr"), ("work_of_adhesion_j_m2", "")], "work_of_adhesion_j_m2: missing"),
        (
            &[("law", "jkr"), ("work_of_adhesion_j_m2", "-1")],
            "work_of_adhesion_j_m2: \"-1\" is refused: work of adhesion",
        ),
        (
            &[WORK],
            "work_of_adhesion_j_m2: \"0.2\" is refused: it belongs to dmt and jkr, but the law of the row is hertz",
        ),
        (
            &[("law", "jkr"), WORK, RING],
            "adhesion_n_m: \"250\" is refused: it belongs to the ring, but the law of the row is jkr",
        ),
        (
            &[("law", "dmt"), WORK, ("zeta_a", "6.25")],
            "zeta_a: \"6.25\" is refused: it belongs to the ring, but the law of the row is dmt; leave the cell empty",
        ),
        (&[("zeta_a", "-1")], "zeta_a: \"-1\" is refused: adhesion damping must be 0 to"),
        (&[("damping", "constant")], "damping_value: missing"),
        (
            &[("damping", "constant"), ("damping_value", "1.5")],
            "damping_value: \"1.5\" is refused: nominal restitution must be",
        ),
        (
            &[("damping", "viscoelastic"), ("damping_value", "-1")],
            "damping_value: \"-1\" is refused: relaxation time must be 0 to 1 s",
        ),
        (
            &[("damping", "hysteretic"), ("damping_value", "-1")],
            "damping_value: \"-1\" is refused: material damping must be",
        ),
        (
            &[("damping", "none"), ("damping_value", "0.9")],
            "damping_value: \"0.9\" is refused: the row names no damping",
        ),
        (&[("zeta_h", "1"), ("damping_value", "0.9")], "damping_value: \"0.9\" is refused: the row names no damping"),
        (
            &[("zeta_h", "1"), ("damping", "none")],
            "damping: given twice, as zeta_h and damping; leave one of them empty",
        ),
        (
            &[("law", "jkr"), WORK, ("external_force_n", "1e-9")],
            "external_force_n: \"1e-9\" is refused: external force must be zero with this law or end of contact; choose another",
        ),
        (
            &[("end_rule", "no-force"), ("external_force_n", "1e-9")],
            "external_force_n: \"1e-9\" is refused: external force must be zero with this law or end of contact; choose another",
        ),
        (
            &[("peeling_n_m", "1e-12")],
            "peeling_n_m: \"1e-12\" is refused: peeling moment must be zero with this law or end of contact; choose another",
        ),
        (
            &[("law", "dmt"), WORK, ("peeling_n_m", "1e-12")],
            "peeling_n_m: \"1e-12\" is refused: peeling moment must be zero",
        ),
    ];
    for (cells, reason) in REFUSED {
        let table = table(cells);
        let output = run("classify", &table, &["--model", "simulation"]);
        let written = Written::read(&output.stdout, b',');
        let error = written.text(0, "error");
        assert!(output.status == 1 && error.starts_with(reason), "{cells:?}: {error}");
        assert_eq!((written.text(0, "outcome"), written.text(0, "overall_restitution")), ("", ""), "{cells:?}");
        // A critical speed has no surface along which the moment acts.
        let critical = run("critical", &table, &[]);
        let written = Written::read(&critical.stdout, b',');
        let expected = if cells.iter().any(|(column, _)| *column == "peeling_n_m") { "" } else { error };
        assert_eq!(written.text(0, "error"), expected, "{cells:?}");
    }
    // Zero is no number of another law.
    impact(&[
        ("law", "jkr"),
        WORK,
        ("zeta_a", "0"),
        ("adhesion_n_m", "0"),
        ("peeling_n_m", "0"),
        ("external_force_n", "0"),
    ]);
    impact(&[("law", "hertz"), ("work_of_adhesion_j_m2", "0"), ("damping_value", "0")]);
}

/// A method that cannot represent a law says which can, and those do.
#[test]
fn methods_of_a_law() {
    const WORK: (&str, &str) = ("work_of_adhesion_j_m2", "0.2");
    const DAMPED: [(&str, &str); 2] = [("damping", "constant"), ("damping_value", "0.9")];
    let refused = "this method cannot represent this law of contact; use --method adaptive or collocation";
    let jkr = table(&[("law", "jkr"), WORK]);
    let dmt = table(&[("law", "dmt"), WORK, DAMPED[0], DAMPED[1]]);
    let without_tension = table(&[DAMPED[0], DAMPED[1], ("end_rule", "no-force")]);
    for (table, methods) in [
        (&jkr, &[("collocation", Some(1e-8)), ("fixed-cost", None), ("runge-kutta-gill", None)][..]),
        (&dmt, &[("collocation", Some(1e-8)), ("fixed-cost", Some(1e-3)), ("runge-kutta-gill", Some(1e-3))]),
        (&without_tension, &[("collocation", Some(1e-8)), ("fixed-cost", None), ("runge-kutta-gill", None)]),
    ] {
        let exact = simulated(table, &[]);
        for &(method, allowed) in methods {
            let output = run("classify", table, &["--model", "simulation", "--method", method]);
            let found = Written::read(&output.stdout, b',');
            let Some(allowed) = allowed else {
                let written = (output.status, found.text(0, "error"), found.text(0, "outcome"));
                assert_eq!(written, (1, refused, ""), "{method}");
                continue;
            };
            assert_eq!((found.text(0, "error"), found.text(0, "outcome")), ("", "rebound"), "{method}");
            let error = (found.number(0, "overall_restitution") - exact.number(0, "overall_restitution")).abs();
            assert!(error <= allowed, "{method}: {error:e} {table}");
        }
    }
}

/// Both models take a row with a law of the simulation; a result is a table for the next run.
#[test]
fn both_models_and_results_as_tables() {
    let cells =
        [("law", "jkr"), ("work_of_adhesion_j_m2", "0.2"), ("restitution", "0.9"), ("adhesion_coefficient", "0.1")];
    let mut table = table(&cells);
    let first = Written::read(&run("classify", &table, &["--model", "both"]).stdout, b',');
    for law in ["law", "input_law"] {
        assert_eq!(first.text(0, law), "jkr");
    }
    assert_eq!((first.text(0, "outcome"), first.text(0, "rigid_body_outcome")), ("rebound", "rebound"));
    for _ in 0..2 {
        let output = run("classify", &table, &["--model", "simulation"]);
        assert_eq!(output.status, 0, "{}", output.complaint());
        let again = Written::read(&output.stdout, b',');
        assert_eq!(again.text(0, "law"), "jkr");
        assert_eq!(results(&again), results(&first));
        table = String::from_utf8(output.stdout).unwrap();
    }
}

#[test]
fn misspelt_columns() {
    for (name, near) in [
        ("work_of_adhesion", "work_of_adhesion_j_m2"),
        ("g", "work_of_adhesion_j_m2"),
        ("contact_law", "law"),
        ("dampng", "damping"),
        ("damping_values", "damping_value"),
        ("endrule", "end_rule"),
    ] {
        for (command, model) in [("classify", &["--model", "simulation"][..]), ("critical", &[])] {
            let complaint = run(command, &table(&[(name, "0")]), model).complaint();
            assert!(complaint.contains(&format!("{name} (did you mean `{near}`?)")), "{complaint}");
        }
    }
    let all = run("critical", &table(&[]), &[]).complaint();
    for absent in
        ["law (ring if adhesion_n_m is not 0, otherwise hertz)", "end_rule (no-indentation; snap-off with jkr)"]
    {
        assert!(all.contains(absent), "{all}");
    }
}
