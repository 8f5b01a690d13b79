//! The methods that `classify --model simulation` offers.

use crate::Output;
use crate::classify::{Written, run};

const CASES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/cases.csv");
const HARD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/hard.csv");

/// Columns that depend on where the motion ends.
const AT_END: [&str; 9] = [
    "time_roll_s",
    "impulse_hertz_n_s",
    "impulse_adhesion_rebound_n_s",
    "work_material_j",
    "work_adhesion_j",
    "speed_tangential_out_m_s",
    "spin_out_rad_s",
    "rotation_rad",
    "displacement_tangential_m",
];

/// A sphere that rebounds, one that is captured, and one that is damped too strongly for a few iterations or steps.
const THREE: &str = "radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,friction,speed_normal_m_s,speed_tangential_m_s\n\
                     5.06e-6,2600,7.5e10,250,10.5,6.25,0.1,2.8,1\n\
                     5.06e-6,2600,7.5e10,250,10.5,6.25,0.1,1,1\n\
                     1e-6,1000,1e10,0,1e4,0,0.1,1,1\n";

fn simulated(arguments: &str, table: &str) -> Output {
    let arguments = arguments.split(' ').filter(|word| !word.is_empty());
    let arguments: Vec<_> = ["-", "--format", "csv", "--model", "simulation"].into_iter().chain(arguments).collect();
    run(&arguments, table.as_bytes())
}

fn written(arguments: &str, table: &str) -> Written {
    Written::read(&simulated(arguments, table).stdout, b',')
}

/// Largest errors, over a reference table, of e^2 and of the tangential velocity over the larger of the velocities before;
/// and the number of rows without a solution, each of which says so.
fn errors(path: &str, arguments: &str) -> (f64, f64, usize) {
    let table = std::fs::read_to_string(path).unwrap();
    let given = Written::read(table.as_bytes(), b',');
    let output = simulated(arguments, &table);
    let found = Written::read(&output.stdout, b',');
    assert_eq!(found.rows.len(), given.rows.len(), "{arguments}: {}", output.complaint());
    let (mut squares, mut velocities, mut unsolved) = (0.0_f64, 0.0_f64, 0);
    for row in 0..given.rows.len() {
        let name = given.text(row, "name");
        if !found.text(row, "error").is_empty() {
            assert!(found.text(row, "error").contains("did not converge; use "), "{name}");
            assert_eq!(found.text(row, "outcome"), "", "{name}");
            unsolved += 1;
            continue;
        }
        let outcome = found.text(row, "outcome");
        if outcome == "undecided" {
            assert_eq!(found.text(row, "overall_restitution"), "", "{name}");
            continue;
        }
        let square = |table: &Written| table.overall_restitution(row).powi(2);
        squares = squares.max((square(&found) - square(&given)).abs());
        if outcome == "rebound" && given.text(row, "outcome") == "rebound" {
            let peripheral = given.number(row, "radius_m") * given.number(row, "spin_rad_s");
            let before = given.number(row, "speed_tangential_m_s").abs().max(peripheral.abs());
            let after = |table: &Written| table.number(row, "speed_tangential_out_m_s");
            let error = (after(&found) - after(&given)).abs();
            velocities = velocities.max(if error > 0.0 { error / before } else { 0.0 });
        }
    }
    assert_eq!(output.status, u8::from(unsolved > 0), "{arguments}");
    (squares, velocities, unsolved)
}

/// Both reference tables are read as they are, by every method in every setting that is offered.
#[test]
fn every_method_solves_the_reference() {
    // No tolerance is less than its number of nodes keeps.
    let collocation = [5, 6, 7, 8, 9, 10, 11, 12, 13, 14]
        .into_iter()
        .zip([3e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-10, 1e-11, 1e-12, 1e-12, 1e-13]);
    let controlled = collocation.map(|(nodes, tolerance)| {
        (format!("--method collocation --nodes {nodes} --tolerance {tolerance:e}"), tolerance)
    });
    let adaptive = [(String::new(), 1e-9), ("--method adaptive --tolerance 1e-12".into(), 1e-12)];
    let single = [("--scalar f32 --tolerance 1e-6".into(), 1e-6)];
    for (arguments, tolerance) in controlled.chain(adaptive).chain(single) {
        for path in [CASES, HARD] {
            let (squares, velocities, unsolved) = errors(path, &arguments);
            assert!(squares <= 3.0 * tolerance, "{arguments}, {path}: e^2 {squares:e}");
            assert!(velocities <= 3.0 * tolerance, "{arguments}, {path}: V_t {velocities:e}");
            assert_eq!(unsolved, 0, "{arguments}, {path}");
        }
    }
    let fixed_cost = [5, 6, 7, 8, 9].map(|nodes| (format!("--method fixed-cost --nodes {nodes} --iterations 8"), 1e-4));
    let steps = [("--method runge-kutta-gill".into(), 1e-3), ("--method fixed-cost --scalar f32".into(), 2e-4)];
    for (arguments, bound) in fixed_cost.into_iter().chain(steps) {
        for path in [CASES, HARD] {
            let (squares, velocities, unsolved) = errors(path, &arguments);
            assert!(squares <= bound && velocities <= bound, "{arguments}, {path}: {squares:e}, {velocities:e}");
            assert!(unsolved <= 20, "{arguments}, {path}: {unsolved} without a solution");
        }
    }
}

/// All inputs of the harder reference are used; none of them is taken for a default.
#[test]
fn moment_of_inertia_and_external_force_are_read() {
    let table = std::fs::read_to_string(HARD).unwrap();
    let output = simulated("", &table);
    let used = output.complaint().lines().find(|line| line.contains("columns used")).unwrap().to_owned();
    for column in ["gyration_ratio", "external_force_n", "peeling_n_m", "zeta_a", "spin_rad_s"] {
        assert!(used.contains(column), "{used}");
    }
    // Hertz's contact with a ring needs no other columns, and yields by one of its own.
    let absent = output.complaint().lines().find(|line| line.contains("columns absent")).unwrap().to_owned();
    let (_, absent) = absent.split_once("what is used: ").unwrap();
    let listed: Vec<_> = absent.split("), ").filter_map(|input| Some(input.split_once(" (")?.0)).collect();
    let laws = ["law", "work_of_adhesion_j_m2", "damping", "damping_value", "end_rule", "yield_pressure_pa"];
    assert_eq!(listed, laws, "{absent}");
    for column in ["gyration_ratio", "external_force_n"] {
        let changed = written("", &table.replacen(column, "remark", 1));
        let found = Written::read(&output.stdout, b',');
        let differs = |row: usize| AT_END.iter().any(|at_end| found.text(row, at_end) != changed.text(row, at_end));
        assert!((0..found.rows.len()).any(differs), "{column}");
    }
}

/// Each option changes the result in the direction that it is meant to.
#[test]
fn options_change_the_result() {
    let error = |arguments: &str| (written(arguments, THREE).number(0, "overall_restitution") - 0.746193259_f64).abs();
    for (coarse, fine) in [
        ("--tolerance 1e-3", "--tolerance 1e-9"),
        ("--method collocation --nodes 5 --tolerance 1e-2", "--method collocation --nodes 9"),
        ("--method fixed-cost --iterations 2", "--method fixed-cost --iterations 8"),
        ("--method fixed-cost --nodes 5 --iterations 8", "--method fixed-cost --nodes 9 --iterations 8"),
        ("--method runge-kutta-gill --steps 50", "--method runge-kutta-gill"),
    ] {
        let (coarse, fine) = ((coarse, error(coarse)), (fine, error(fine)));
        assert!(fine.1 < 0.5 * coarse.1 && fine.1 < 1e-4, "{coarse:?} {fine:?}");
    }
    assert_eq!(error(""), error("--method adaptive --scalar f64 --tolerance 1e-9"));
}

/// What a method does not answer has a reason and no outcome; what it does not follow is left empty.
#[test]
fn what_a_method_does_not_know_is_empty() {
    for (arguments, follows, solved) in [
        ("--method adaptive", true, true),
        ("--method collocation --nodes 6 --tolerance 1e-5", true, true),
        ("--method fixed-cost", false, false),
        ("--method runge-kutta-gill", false, true),
    ] {
        let output = simulated(arguments, THREE);
        let found = Written::read(&output.stdout, b',');
        assert_eq!(found.text(0, "outcome"), "rebound", "{arguments}");
        let decided = (found.text(1, "outcome"), found.text(1, "overall_restitution"));
        if decided == ("", "") && !solved {
            // The method says no more than that it does not know.
            assert!(!found.text(1, "error").is_empty(), "{arguments}");
            continue;
        }
        assert_eq!((decided, found.text(1, "motion")), (("capture", "0"), "rolling"), "{arguments}");
        for column in AT_END {
            assert!(!found.text(0, column).is_empty(), "{arguments}, {column}");
            assert_eq!(!found.text(1, column).is_empty(), follows, "{arguments}, {column}");
        }
        assert_eq!(!found.text(1, "turning_indentation_m").is_empty(), follows, "{arguments}");
        assert!(found.number(1, "max_indentation_m") > 0.0 && found.number(1, "time_peak_s") > 0.0, "{arguments}");
        assert_eq!(found.text(2, "error").is_empty(), solved, "{arguments}");
        assert_eq!(output.status, u8::from(!solved), "{arguments}");
        if !solved {
            let computed = AT_END.iter().chain(&[
                "outcome",
                "motion",
                "overall_restitution",
                "max_indentation_m",
                "contact_time_s",
            ]);
            assert!(computed.into_iter().all(|column| found.text(2, column).is_empty()), "{arguments}");
        }
    }
    let summary = run(&["-", "--model", "simulation", "--method", "fixed-cost"], THREE.as_bytes());
    let text = String::from_utf8(summary.stdout).unwrap();
    assert!(text.contains("captured rolling") && text.contains("bad row: the simulation did not converge"), "{text}");
    let both = run(&["-", "--model", "both", "--method", "fixed-cost", "--nodes", "8"], b"");
    assert!(both.complaint().contains("empty"), "{}", both.complaint());
}

#[test]
fn options_that_do_not_apply_are_refused() {
    for (arguments, words) in [
        ("--iterations 3", "--iterations does not apply to --method adaptive, only to fixed-cost"),
        ("--nodes 7", "--nodes does not apply to --method adaptive, only to collocation and fixed-cost"),
        ("--steps 100", "--steps does not apply to --method adaptive, only to runge-kutta-gill"),
        ("--method collocation --steps 100", "--steps does not apply to --method collocation"),
        ("--method collocation --iterations 3", "--iterations does not apply to --method collocation"),
        ("--method fixed-cost --tolerance 1e-6", "--tolerance does not apply to --method fixed-cost"),
        ("--method runge-kutta-gill --nodes 7", "--nodes does not apply to --method runge-kutta-gill"),
        ("--method runge-kutta-gill --tolerance 1e-6", "--tolerance does not apply to --method runge-kutta-gill"),
        ("--method collocation --nodes 15", "choose one of 5, 6, 7, 8, 9, 10, 11, 12, 13, 14"),
        ("--method fixed-cost --nodes 4", "choose one of 5, 6, 7, 8, 9"),
        ("--method fixed-cost --iterations 41", "number of iterations is 41, but must be 1 to 40"),
        ("--method collocation --tolerance 0", "tolerance is 0"),
        (
            "--method collocation --nodes 5",
            "--tolerance is 1e-9, but must be at least 1e-3 with four nodes, 3e-4 with five",
        ),
        ("--method collocation --nodes 5", "with nine; use more --nodes or --method adaptive\n"),
        ("--method runge-kutta-gill --steps 15", "15 is not in 16..=1000000"),
        ("--method runge-kutta-gill --steps 1000001", "1000001 is not in 16..=1000000"),
        ("--method euler", "[possible values: adaptive, collocation, fixed-cost, runge-kutta-gill]"),
    ] {
        let output = simulated(arguments, THREE);
        assert_eq!((output.status, output.stdout.len()), (2, 0), "{arguments}");
        assert!(output.complaint().contains(words), "{arguments}: {}", output.complaint());
    }
    for arguments in
        [["--method", "adaptive"], ["--nodes", "7"], ["--iterations", "3"], ["--steps", "16"], ["--tolerance", "1e-6"]]
    {
        let output = run(&[&["--model", "rigid-body"], &arguments[..]].concat(), b"");
        let words = format!("{} does not apply to --model rigid-body", arguments[0]);
        assert!(output.status == 2 && output.complaint().contains(&words), "{}", output.complaint());
        assert_eq!(run(&arguments, b"").status, 2, "the rigid body is the default");
    }
}

/// The defaults that the help states are those in force.
#[test]
fn help_states_the_defaults() {
    let help = run(&["--help"], b"").complaint();
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for words in [
        "Method of the simulation [default: adaptive]",
        "5 to 14 [default: 9], or of fixed-cost, 5 to 9 [default: 7]",
        "1 to 40 [default: 3]",
        "16 to 1000000 [default: 2000]",
        "Largest error of e^2 and of a critical speed [default: 1e-9 in f64, 1e-6 in f32]",
    ] {
        assert!(help.contains(words), "{words}: {help}");
    }
    let manual = String::from_utf8(crate::microimpact("man", &["classify"], b"").stdout).unwrap().replace('\\', "");
    for words in [
        "3e-4 with 5 nodes, 1e-5 with 6, 1e-7 with 7, 1e-9 with 8, 1e-11 with 9. With 10 or more, only rounding limits it",
        "The outcome is undecided where",
    ] {
        assert!(manual.contains(words), "{words}: {manual}");
    }
    let same = |short: &str, long: &str| assert_eq!(simulated(short, THREE).stdout, simulated(long, THREE).stdout);
    same("--method collocation", "--method collocation --nodes 9 --tolerance 1e-9");
    same("--method fixed-cost", "--method fixed-cost --nodes 7 --iterations 3");
    same("--method runge-kutta-gill", "--method runge-kutta-gill --steps 2000");
    same("--scalar f32", "--scalar f32 --tolerance 1e-6");
    let critical = crate::microimpact("critical", &["--scalar", "f32"], b"");
    assert_eq!((simulated("--scalar f32", THREE).status, critical.status), (0, 0), "{}", critical.complaint());
    for (nodes, least) in [(5, 3e-4), (6, 1e-5), (7, 1e-7), (8, 1e-9), (9, 1e-11)] {
        let status = |tolerance: f64| {
            let arguments = format!("--method collocation --nodes {nodes} --tolerance {tolerance:e}");
            simulated(&arguments, THREE).status
        };
        assert_eq!((status(least), status(0.5 * least)), (0, 2), "{nodes}");
    }
}

/// More iterations are advised only where they help.
#[test]
fn advice_for_fixed_cost() {
    for (iterations, row, advice) in [
        (1, 0, "; use more --iterations, or --method adaptive"),
        (3, 2, "; use --method adaptive"),
        (40, 2, "; use --method adaptive"),
    ] {
        let found = written(&format!("--method fixed-cost --iterations {iterations}"), THREE);
        let error = found.text(row, "error");
        assert!(error.ends_with(&format!("did not converge{advice}")), "{iterations}: {error}");
    }
}

/// The summary and the column `motion` give the class of the library, also of a sphere that creeps to rest while it slips. That
/// sphere has no turning point, nor velocities and works there.
#[test]
fn motion_agrees_with_the_class() {
    use microimpact::contact::{Adaptive, Contact};
    use microimpact::{Class, NormalMotion, Sphere, Stiffness};
    let table = std::fs::read_to_string(CASES).unwrap();
    let lines: Vec<_> = table.lines().filter(|line| line.starts_with("family,") || line.contains(",x001,")).collect();
    let table = lines.join("\n");
    let (given, found) = (Written::read(table.as_bytes(), b','), written("", &table));
    let number = |column: &str| given.number(0, column);
    let scene = || {
        let sphere = Sphere::solid(number("radius_m"), number("density_kg_m3"))?;
        let before = NormalMotion::new(number("speed_normal_m_s"))?.with_tangential(number("speed_tangential_m_s"))?;
        let scene = Contact::hertz(sphere, Stiffness::new(number("stiffness_pa"))?)
            .with_damping(number("zeta_h"))?
            .with_ring(number("adhesion_n_m"), number("zeta_a"))?
            .with_friction(number("friction"))?;
        scene.solve(&before.with_spin(&sphere, number("spin_rad_s"))?, &Adaptive::new(1e-9)?)
    };
    assert_eq!(scene().unwrap().class(), Some(Class::CapturedRolling));
    let summary = String::from_utf8(run(&["-", "--model", "simulation"], table.as_bytes()).stdout).unwrap();
    assert!(summary.contains("captured rolling"), "{summary}");
    assert_eq!((found.text(0, "outcome"), found.text(0, "motion")), ("capture", "rolling"));
    for column in AT_END.iter().chain(&["turning_indentation_m"]) {
        assert_eq!(found.text(0, column), "", "{column}");
    }
}
