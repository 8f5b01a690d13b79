//! Tables of restitution for simulation programs: read back, they hold the restitution of the simulation.

use std::fs;
use std::process::Command;

use microimpact::contact::{Adaptive, AnyLaw, Contact, JkrEnd};
use microimpact::{NormalMotion, Sphere, Stiffness};

use crate::microimpact;

/// What the tables are asked for: six radii from 2 um to 16 um.
const ARGUMENTS: [&str; 8] =
    ["--smallest-radius", "2e-6", "--cells", "12", "--restitution-error", "0.004", "--fastest", "60"];
const ERROR: f64 = 0.004;

/// The restitution of a sphere of the paper's material by the simulation, zero if it is captured.
fn simulated(radius: f64, speed: f64) -> f64 {
    let sphere = Sphere::solid(radius, 2600.0).unwrap();
    let contact = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap()).with_damping(10.5).unwrap();
    let contact = contact.with_ring(250.0, 6.25).unwrap();
    let impact = contact.solve(&NormalMotion::new(speed).unwrap(), &Adaptive::new(1e-9).unwrap()).unwrap();
    impact.normal.overall_restitution()
}

fn written(format: &str, further: &[&str]) -> String {
    let output = microimpact("table", &[&["--format", format], &ARGUMENTS[..], further].concat(), b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    String::from_utf8(output.stdout).unwrap()
}

/// The numbers in a text, whatever lies between them.
fn numbers(text: &str) -> Vec<f64> {
    let is_mark = |c: char| c.is_whitespace() || ",;(){}=".contains(c);
    text.split(is_mark).filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect()
}

/// What lies between two words of a text.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    text.split_once(from).and_then(|(_, rest)| rest.split_once(to)).unwrap_or_else(|| panic!("{from} {to}")).0
}

/// Checks pairs of speed and restitution of spheres of one radius, and that lines between them keep the error.
fn check(radius: f64, pairs: &[f64]) {
    let points: Vec<_> = pairs.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    assert!(points.len() > 10 && points.is_sorted_by(|a, b| a.0 < b.0), "{points:?}");
    let positive = points.iter().position(|point| point.1 > 0.0).unwrap();
    let critical = points[positive - 1].0;
    assert!(simulated(radius, critical * (1.0 - 1e-6)) == 0.0 && simulated(radius, critical * (1.0 + 1e-6)) > 0.0);
    assert!(points.last().unwrap().0 >= 60.0);
    for two in points.windows(2) {
        let ((slow, low), (fast, high)) = (two[0], two[1]);
        for part in [0.0, 0.1, 0.3, 0.6, 0.9] {
            let speed = slow + part * (fast - slow);
            let expected = if speed > 0.0 { simulated(radius, speed) } else { 0.0 };
            assert!((low + part * (high - low) - expected).abs() <= ERROR, "{radius} {speed}");
        }
    }
}

#[test]
fn tables_of_one_radius() {
    let acutrace = written("acutrace", &[]);
    assert_eq!(acutrace.matches('{').count(), acutrace.matches('}').count());
    check(2e-6, &numbers(between(&acutrace, "wall_en_curve_fit_values =", "}\n}")));

    let comsol = written("comsol", &[]);
    let data: Vec<_> = comsol.lines().filter(|line| !line.starts_with('%')).collect();
    assert!(data.iter().all(|line| numbers(line).len() == 2));
    check(2e-6, &numbers(&data.join("\n")));
}

#[test]
fn dictionary_for_openfoam() {
    let text = written("openfoam", &["--radii", "3"]);
    let (_, body) = text.split_once("// Linear").unwrap();
    for (number, radius) in [2e-6, 2e-6 * 8.0_f64.sqrt(), 16e-6].into_iter().enumerate() {
        let entry = between(body, &format!("radius{number}\n{{"), "\n}\n");
        let value = |key: &str| numbers(between(entry, key, ";"))[0];
        assert!((value("radius ") / radius - 1.0).abs() < 1e-12);
        let pairs = numbers(between(entry, "values\n", ";"));
        // Below the critical speed it is zero, and beyond the last speed it is an error.
        assert_eq!(pairs[..4], [0.0, 0.0, value("criticalSpeed"), 0.0]);
        assert!(entry.contains("outOfBounds error;"));
        check(radius, &pairs);
    }
}

#[test]
fn rows_of_csv() {
    let text = written("restitution-csv", &["--radii", "2"]);
    let mut rows = csv::Reader::from_reader(text.as_bytes());
    assert_eq!(
        rows.headers().unwrap(),
        &["radius_m", "critical_speed_m_s", "speed_normal_m_s", "overall_restitution"][..]
    );
    let rows: Vec<[f64; 4]> = rows.deserialize().collect::<Result<_, _>>().unwrap();
    for radius in [2e-6, 16e-6] {
        let own: Vec<_> = rows.iter().filter(|row| (row[0] / radius - 1.0).abs() < 1e-12).collect();
        assert!(own.iter().all(|row| row[1] == own[0][2]));
        check(radius, &own.iter().flat_map(|row| [row[2], row[3]]).collect::<Vec<_>>());
    }
}

/// What Fluent's header declares, as far as the function needs it.
const HEADER: &str = "\
typedef struct { double velocity[3], old_velocity[3], diameter; } Tracked_Particle;
#define TP_VEL(p) ((p)->velocity)
#define TP_VEL0(p) ((p)->old_velocity)
#define TP_DIAM(p) ((p)->diameter)
enum { PATH_ACTIVE, PATH_END, PATH_ABORT };
#include <stdio.h>
#define Message(...) fprintf(stderr, __VA_ARGS__)
#define DEFINE_DPM_BC(name, p, t, f, f_normal, dim) \\
    int name(Tracked_Particle *p, void *t, int f, double *f_normal, int dim)
";

/// Reads radii and speeds; writes whether the particle goes on, its restitution, and the change of its velocity along the wall.
const MAIN: &str = "
int main(void)
{
    double normal[3] = {0.6, 0.0, 0.8}, radius, speed;
    while (scanf(\"%lf %lf\", &radius, &speed) == 2) {
        Tracked_Particle p = {{0.6 * speed - 0.8, 2.0, 0.8 * speed + 0.6}, {0}, 2.0 * radius};
        int path = microimpact(&p, 0, 0, normal, 3);
        double away = -(0.6 * p.velocity[0] + 0.8 * p.velocity[2]), along = 0.6 * p.velocity[2] - 0.8 * p.velocity[0];
        printf(\"%d %.9e %.9e\\n\", path, away / speed, along - 1.0 + p.velocity[1] - 2.0);
    }
    return 0;
}
";

#[test]
fn function_for_fluent() {
    let folder = std::env::temp_dir().join(format!("fluent-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let (source, program) = (folder.join("table.c"), folder.join("table"));
    fs::write(folder.join("udf.h"), HEADER).unwrap();
    let text = written("fluent", &["--radii", "6"]);
    fs::write(&source, text.clone() + MAIN).unwrap();
    let options = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter", "-I"];
    let mut compiler = Command::new("cc");
    let built = compiler.args(options).arg(&folder).arg("-o").arg(&program).arg(&source).arg("-lm").status().unwrap();
    assert!(built.success());

    // Between radii the table states its error for the same multiple of the critical speed, and that of the critical speed.
    let stated = between(&text, "Between two radii", "at the same");
    let percent: f64 = between(stated, "up to ", " %").parse().unwrap();
    let more: f64 = stated.rsplit_once("up to ").unwrap().1.trim().parse().unwrap();
    assert!(percent < 2.0 && more < 0.02, "{stated}");
    let ratio = 8.0_f64.powf(0.2);
    let at_radii = [0.0, 1.0, 5.0].map(|k| (k, 0.0, ERROR));
    let between_radii = [0.5, 1.5, 2.5, 3.5, 4.5].map(|k| (k, percent / 100.0, ERROR + more));
    let queries: Vec<_> = at_radii
        .into_iter()
        .chain(between_radii)
        .flat_map(|(k, shift, error)| (1..60).map(move |speed| (2e-6 * ratio.powf(k), f64::from(speed), shift, error)))
        .collect();
    // Outside the table, beside a speed and a radius at its ends.
    let outside = [(0.5e-6, 60.0), (1.99e-6, 1.0), (16.1e-6, 30.0), (4e-6, 60.1), (f64::NAN, 30.0)];
    let outside: Vec<_> = outside.map(|(radius, speed)| (radius, speed, 0.0, 0.0)).into();
    let queries = [queries, outside.clone()].concat();
    let input: String = queries.iter().map(|(radius, speed, ..)| format!("{radius:e} {speed:e}\n")).collect();
    fs::write(folder.join("queries"), input).unwrap();
    let queried = fs::File::open(folder.join("queries")).unwrap();
    let output = Command::new(&program).stdin(queried).output().unwrap();
    let answers = numbers(&String::from_utf8(output.stdout).unwrap());
    assert_eq!(answers.len(), 3 * queries.len());
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert_eq!(complaint.matches("aborted a particle of radius 5e-07 m at 60 m/s").count(), 1, "{complaint}");
    assert_eq!(complaint.lines().count(), 1, "{complaint}");
    let (queries, answers) =
        (&queries[..queries.len() - outside.len()], answers.split_at(answers.len() - 3 * outside.len()));
    let (answers, beyond) = answers;
    // The velocity stays as it was: -1 times that away from the wall.
    for answer in beyond.chunks(3) {
        assert!(answer[0] == 2.0 && (answer[1].is_nan() || (answer[1] + 1.0).abs() < 1e-9), "{answer:?}");
    }
    for ((radius, speed, shift, error), answer) in queries.iter().zip(answers.chunks(3)) {
        let restitution = if answer[0] == 1.0 { 0.0 } else { answer[1] };
        let [low, high] = [-shift, *shift].map(|shift| simulated(*radius, speed * (1.0 + shift)));
        let within = (low.min(high) - error..=low.max(high) + error).contains(&restitution);
        assert!(within, "{radius} {speed}: {restitution} and not {low} to {high}");
        if answer[0] == 0.0 {
            assert!(answer[2].abs() < 1e-7, "the velocity along the wall changes by {}", answer[2]);
        }
    }
    assert!(answers.chunks(3).any(|answer| answer[0] == 1.0));
    fs::remove_dir_all(folder).unwrap();
}

/// A law of options, with the same law of the library.
type Stated = (&'static [&'static str], AnyLaw<f64>);

#[test]
fn every_law_of_contact() {
    let stiffness = Stiffness::new(7.5e10).unwrap();
    let laws: [Stated; 4] = [
        (&["--law", "hertz"], AnyLaw::hertz(stiffness).with_damping(10.5).unwrap()),
        (
            &["--law", "dmt", "--work-of-adhesion", "0.3", "--damping", "constant", "--damping-value", "0.9"],
            AnyLaw::dmt(stiffness, 0.3).unwrap().with_constant_damping(0.9).unwrap(),
        ),
        (
            &["--law", "jkr", "--work-of-adhesion", "0.3", "--end-rule", "pull-off", "--zeta-h", "3"],
            AnyLaw::jkr(stiffness, 0.3, JkrEnd::PullOff).unwrap().with_damping(3.0).unwrap(),
        ),
        (
            &["--damping", "viscoelastic", "--damping-value", "1e-9", "--external-force", "1e-7"],
            AnyLaw::ring(stiffness, 250.0, 6.25)
                .and_then(|law| law.with_viscoelastic_damping(1e-9))
                .and_then(|law| law.with_external_force(1e-7))
                .unwrap(),
        ),
    ];
    let method = Adaptive::new(1e-9).unwrap();
    for (options, law) in &laws {
        let contact = Contact::new(Sphere::solid(2e-6, 2600.0).unwrap(), *law);
        let text = written("comsol", options);
        let data: Vec<_> = text.lines().filter(|line| !line.starts_with('%')).map(numbers).collect();
        assert!(data.len() > 3, "{text}");
        for two in data.windows(2).filter(|two| two[0][0] > 0.0) {
            let speed = (two[0][0] + two[1][0]) / 2.0;
            let impact = contact.solve(&NormalMotion::new(speed).unwrap(), &method).unwrap();
            let error = (two[0][1] + two[1][1]) / 2.0 - impact.normal.overall_restitution();
            assert!(error.abs() <= ERROR, "{options:?} {speed}: {error}");
        }
        // Firmware's table is of the same law, which must have a critical speed.
        let output = microimpact(
            "table",
            &[&["--format", "csv", "--cells", "2", "--smallest-radius", "2e-6"][..], options].concat(),
            b"",
        );
        assert_eq!(output.status, if options.contains(&"hertz") { 2 } else { 0 }, "{}", output.complaint());
    }
}

#[test]
fn the_range_is_stated() {
    let range = "It holds radii from 2e-6 to 1.6e-5 m, and approach speeds up to 60 m/s";
    // The ninth radius is the largest itself, and no power of a ratio, which would be rounded.
    for radii in ["2", "9"] {
        let arguments = [&["--format", "fluent", "--radii", radii], &ARGUMENTS[..]].concat();
        let output = microimpact("table", &arguments, b"");
        assert!(output.complaint().contains(range), "{}", output.complaint());
        assert!(String::from_utf8(output.stdout).unwrap().contains(range));
    }
}

#[test]
fn what_cannot_be_a_table_is_refused() {
    for (arguments, words) in [
        (&["--format", "comsol", "--radii", "2"][..], "--radii 2 is refused"),
        (&["--format", "csv", "--radii", "3"], "--radii is refused: a table of critical speeds has no use for it"),
        (&["--fastest", "3"], "--fastest is refused: a table of critical speeds has no use for it"),
        (&["--format", "restitution-rust", "--radii", "3"], "--radii is refused: a table of restitution for firmware"),
        (&["--format", "fluent", "--restitution-error", "0.2"], "enter a number from 0.0001 to 0.1"),
        (&["--format", "openfoam", "--fastest", "0"], "approach speed"),
        (&["--format", "fluent", "--smallest-radius", "1e-9"], "captured at every speed"),
        (&["--format", "comsol", "--smallest-radius", "5e-7"], "captured up to 2.1353e2 m/s, their critical speed"),
        // Viscoelastic damping holds small spheres at every speed.
        (
            &["--format", "c", "--cells", "1", "--damping", "viscoelastic", "--damping-value", "1e-8"],
            "captured at every speed",
        ),
        (&["--format", "comsol", "--law", "jkr"], "--work-of-adhesion: missing"),
        (
            &["--format", "comsol", "--law", "dmt", "--adhesion", "5"],
            "--adhesion: \"5e0\" is refused: it belongs to the ring",
        ),
        (&["--format", "comsol", "--damping", "viscoelastic"], "--damping-value: missing"),
        (&["--format", "comsol", "--end-rule", "snap-off"], "--end-rule: \"snap-off\" is refused"),
    ] {
        let output = microimpact("table", arguments, b"");
        assert_eq!((output.status, output.stdout.len()), (2, 0), "{arguments:?}");
        assert!(output.complaint().contains(words), "{}", output.complaint());
    }
}
