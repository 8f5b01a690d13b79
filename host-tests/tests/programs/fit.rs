//! `microimpact fit`: what it states holds, and what it cannot know it says.

use std::fmt::Write;

use microimpact::contact::{Adaptive, Contact, JkrLaw};
use microimpact::{CriticalSpeed, NormalMotion, Sphere, Stiffness};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal};
use serde_json::Value;

use crate::{Output, microimpact};

pub const DENSITY: f64 = 2600.0;
pub const DIAMETER: f64 = 1.012e-5;
pub const K: f64 = 130.0;
pub const WORK: f64 = 2.22e-12;

fn mass(diameter: f64) -> f64 {
    std::f64::consts::PI / 6.0 * diameter.powi(3) * DENSITY
}

/// e of the paper's law (A34), zero for a capture.
pub fn restitution(speed: f64, diameter: f64) -> f64 {
    let r = K / (K + speed);
    (r * r - 2.0 * WORK / (mass(diameter) * speed * speed)).max(0.0).sqrt()
}

fn critical_speed(diameter: f64) -> f64 {
    let without = (2.0 * WORK / mass(diameter)).sqrt();
    K * without / (K - without)
}

const HEADER: &str = "diameter_m,density_kg_m3,velocity_error_m_s,speed_normal_m_s,rebound_speed_m_s\n";

/// A table of rebounds and captures by the paper's law, measured with an error, of spheres whose diameters differ.
fn table(rows: usize, error: f64, diameters: f64, speeds: (f64, f64)) -> String {
    let mut random = StdRng::seed_from_u64(11);
    let noise = Normal::new(0.0, 1.0).unwrap();
    let mut table = HEADER.to_owned();
    for _ in 0..rows {
        let speed = random.random_range(speeds.0..speeds.1);
        let diameter = DIAMETER * (1.0 + diameters * noise.sample(&mut random));
        let rebound = restitution(speed, diameter) * speed;
        let measured = if rebound > 0.0 { rebound + error * noise.sample(&mut random) } else { 0.0 };
        let speed = speed + error * noise.sample(&mut random);
        writeln!(table, "{diameter},{DENSITY},{error},{speed},{measured}").unwrap();
    }
    table
}

fn fit(table: &str, options: &[&str]) -> Output {
    microimpact("fit", &[&["-"], options].concat(), table.as_bytes())
}

/// The JSON answer, of a run that succeeded.
fn answer(table: &str, options: &[&str]) -> Value {
    let output = fit(table, &[&["--format", "json"], options].concat());
    assert_eq!(output.status, 0, "{}", output.complaint());
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Whether an interval, made half as wide again, holds the truth: how often it does without is measured by `cargo coverage`.
fn holds(answer: &Value, parameter: &str, truth: f64) -> bool {
    let at = |key: &str| answer["parameters"][parameter][key].as_f64().unwrap_or(f64::INFINITY);
    assert!(at("low") <= at("value") && at("value") <= at("high"), "{answer}");
    let bound = |key: &str| at("value") + 1.5 * (at(key) - at("value"));
    (bound("low")..=bound("high")).contains(&truth)
}

#[test]
fn the_papers_law_is_found_with_its_parameters() {
    let answer = answer(&table(300, 0.03, 0.0, (1.4, 12.0)), &[]);
    assert_eq!((answer["law"].as_str(), answer["fits"].as_bool()), (Some("speed-restitution"), Some(true)));
    assert!(answer["p_value"].as_f64().unwrap() > 0.001 && answer["told_apart"] == true, "{answer}");
    assert!(holds(&answer, "restitution_speed_m_s", K), "{answer}");
    assert!(holds(&answer, "work_of_adhesion_j", WORK), "{answer}");
    assert!(holds(&answer, "critical_speed_m_s", critical_speed(DIAMETER)), "{answer}");
    assert!(answer["captures"].as_u64().unwrap() > 3);
}

/// 10 +- 0.5 um spheres are one set of data, whose statements are for the median diameter.
#[test]
fn spheres_of_different_sizes_are_fitted_together() {
    let table = table(200, 0.03, 0.05, (1.4, 12.0));
    let answer = answer(&table, &["--law", "speed-restitution"]);
    let median = answer["median_diameter_m"].as_f64().unwrap();
    assert!((median / DIAMETER - 1.0).abs() < 0.02);
    assert!(holds(&answer, "work_of_adhesion_j", WORK) && holds(&answer, "restitution_speed_m_s", K), "{answer}");
    assert!(holds(&answer, "critical_speed_m_s", critical_speed(median)), "{answer}");
    let text = String::from_utf8(fit(&table, &["--law", "speed-restitution"]).stdout).unwrap();
    assert!(text.contains("for the median diameter"), "{text}");
}

/// Impacts of the contact simulation without noise: the paper's law is refuted, and the ring is found with its critical speed.
#[test]
fn a_law_that_does_not_fit_is_said_not_to_fit() {
    let sphere = Sphere::solid(5.06e-6, DENSITY).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap()).with_damping(10.5).unwrap();
    let scene = scene.with_ring(250.0, 6.25).unwrap();
    let mut table = String::from("diameter_m,density_kg_m3,speed_normal_m_s,rebound_speed_m_s\n");
    for step in 0..150 {
        let speed = 1.0 + 29.0 * f64::from(step) / 149.0;
        let impact = scene.solve(&NormalMotion::new(speed).unwrap(), &Adaptive::new(1e-9).unwrap()).unwrap();
        writeln!(table, "1.012e-5,2600,{speed},{}", impact.normal.rebound_speed()).unwrap();
    }
    let paper = answer(&table, &["--law", "speed-restitution"]);
    assert_eq!((paper["law"].as_str(), paper["fits"].as_bool()), (Some("none"), Some(false)));
    assert!(paper["p_value"].as_f64().unwrap() < 0.001);
    assert!(paper["parameters"].as_object().unwrap().is_empty(), "{paper}");
    let output = fit(&table, &["--format", "json"]);
    let all: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((all["law"].as_str(), all["fits"].as_bool()), (Some("ring"), Some(true)), "{all}");
    assert!(holds(&all, "critical_speed_m_s", 1.414_811_425), "{all}");
    // The default error of the speeds is named.
    assert!(output.complaint().contains("0.01 m/s of both speeds is assumed"), "{}", output.complaint());
    assert_eq!(all["assumed_velocity_error_m_s"].as_f64(), Some(0.01));
}

/// Few impacts of the theory of Johnson, Kendall and Roberts: other laws fit as well, and the critical speed is that of any of them.
#[test]
fn laws_not_told_apart_widen_the_critical_speed() {
    let stiffness = Stiffness::new(7.5e10).unwrap();
    let law = JkrLaw::new(stiffness, 0.2).unwrap().with_damping(10.5).unwrap();
    let scene = Contact::new(Sphere::solid(5.06e-6, DENSITY).unwrap(), law);
    let method = Adaptive::new(1e-9).unwrap();
    let CriticalSpeed::At(critical) = scene.critical_speed(&method).unwrap() else { panic!("no critical speed") };
    let mut random = StdRng::seed_from_u64(3);
    let noise = Normal::new(0.0, 0.05).unwrap();
    let mut table = HEADER.to_owned();
    for _ in 0..50 {
        let speed = random.random_range(0.9 * critical..8.0 * critical);
        let impact = scene.solve(&NormalMotion::new(speed).unwrap(), &method).unwrap();
        let rebound = impact.normal.rebound_speed();
        let measured = if rebound > 0.0 { rebound + noise.sample(&mut random) } else { 0.0 };
        writeln!(table, "1.012e-5,2600,0.05,{},{measured}", speed + noise.sample(&mut random)).unwrap();
    }
    let all = answer(&table, &[]);
    assert_eq!(all["told_apart"], false, "{all}");
    let at = |answer: &Value, key: &str| answer["parameters"]["critical_speed_m_s"][key].as_f64().unwrap();
    assert!(at(&all, "low") <= critical && critical <= at(&all, "high"), "{critical}: {all}");
    let alone = answer(&table, &["--law", all["law"].as_str().unwrap()]);
    assert!(at(&all, "high") - at(&all, "low") > at(&alone, "high") - at(&alone, "low"), "{alone} {all}");
}

/// A spreadsheet of e against v and nothing else: granite with e = 0.83 +- 0.06 (Durda et al. 2011) has no critical speed, and ice
/// with a power law is not of the paper's form.
#[test]
fn restitutions_alone_are_enough() {
    let mut random = StdRng::seed_from_u64(3);
    let mut spreadsheet = |curve: &dyn Fn(f64) -> f64, scatter: f64, speeds: (f64, f64)| {
        let noise = Normal::new(0.0, scatter).unwrap();
        let mut table = String::from("speed_normal_m_s;overall_restitution\n");
        for step in 0..40 {
            let speed = speeds.0 * (speeds.1 / speeds.0).powf(f64::from(step) / 39.0);
            writeln!(table, "{speed};{}", (curve(speed) + noise.sample(&mut random)).min(1.0)).unwrap();
        }
        table
    };
    let granite = answer(&spreadsheet(&|_| 0.83, 0.06, (0.1, 1.5)), &[]);
    assert_eq!((granite["law"].as_str(), granite["fits"].as_bool()), (Some("constant"), Some(true)), "{granite}");
    assert!(holds(&granite, "restitution", 0.83), "{granite}");
    assert!(granite["parameters"].get("critical_speed_m_s").is_none(), "{granite}");
    let ice = spreadsheet(&|speed| 0.34 * (100.0 * speed).powf(-0.234), 0.02, (1.5e-4, 0.05));
    assert_eq!(answer(&ice, &["--law", "speed-restitution"])["fits"].as_bool(), Some(false));
    let glass = spreadsheet(&|speed| restitution(speed, DIAMETER), 0.01, (2.0, 12.0));
    let glass = answer(&glass, &["--law", "speed-restitution"]);
    assert!(holds(&glass, "work_of_adhesion_j_kg", WORK / mass(DIAMETER)), "{glass}");
}

/// Noise that carries a speed beyond what is possible is noise.
#[test]
fn possible_within_its_error_is_possible() {
    let table = table(200, 0.1, 0.0, (1.85, 8.0)) + "1.012e-5,2600,0.1,1.85,-0.05\n1.012e-5,2600,0.1,2.0,2.1\n";
    let answer = answer(&table, &["--law", "speed-restitution"]);
    assert!(holds(&answer, "restitution_speed_m_s", K) && holds(&answer, "work_of_adhesion_j", WORK), "{answer}");
    let output = fit(&(table + "1.012e-5,2600,0.1,2.0,4.0\n"), &[]);
    assert!(output.status == 2 && output.complaint().contains("row 203: the rebound speed 4 m/s is refused"));
}

/// Scatter does not explain a pattern over speed, however large it is.
#[test]
fn a_pattern_over_speed_is_no_scatter() {
    let mut random = StdRng::seed_from_u64(5);
    let noise = Normal::new(0.0, 0.005).unwrap();
    let mut table = String::from("speed_normal_m_s,overall_restitution\n");
    for step in 0..40 {
        let speed = 1.0 + 0.12 * f64::from(step);
        let e = 0.5 + 0.35 * (2.0 * speed).sin() + noise.sample(&mut random);
        writeln!(table, "{speed},{e}").unwrap();
    }
    for law in ["constant", "speed-restitution"] {
        let found = answer(&table, &["--law", law]);
        assert_eq!(found["fits"].as_bool(), Some(false), "{found}");
    }
}

/// A rebound speed and a restitution of the same row must agree.
#[test]
fn contradictory_columns_are_refused() {
    let header = "speed_normal_m_s,rebound_speed_m_s,overall_restitution,velocity_error_m_s\n";
    let output = fit(&format!("{header}3,2.4,0.8,0.02\n2,1,0.8,0.02\n"), &[]);
    assert_eq!(output.status, 2);
    assert!(
        output.complaint().contains("row 2: overall_restitution: it makes a rebound speed of 1.6"),
        "{}",
        output.complaint()
    );
}

#[test]
fn few_rebounds_are_not_enough() {
    let mut few = String::from("speed_normal_m_s,overall_restitution\n");
    for speed in [0.1, 0.2, 0.4, 0.6, 0.9, 1.2] {
        writeln!(few, "{speed},0.8").unwrap();
    }
    let answer = answer(&few, &[]);
    assert!(answer["fits"].is_null() && answer["parameters"].as_object().unwrap().is_empty(), "{answer}");
    assert!(
        answer["reason"]
            .as_str()
            .unwrap()
            .contains("not enough data: a fit needs at least 12 rebounds; the table has 6"),
        "{answer}"
    );
    // Nor is one speed, however often.
    let alike = String::from("speed_normal_m_s,overall_restitution\n") + &"2,0.8\n".repeat(30);
    for (table, reason) in [(few, ""), (alike, "all rebounds have approach speeds of 2.0000 m/s")] {
        let text = String::from_utf8(fit(&table, &[]).stdout).unwrap();
        assert!(text.contains("not enough data") && text.contains(reason), "{text}");
    }
}

/// With scatter twice as large as the stated errors, a law fits only if natural scatter is allowed.
#[test]
fn stated_errors_can_be_taken_for_all_of_the_scatter() {
    let table = table(100, 0.06, 0.0, (2.5, 12.0)).replace(",0.06,", ",0.03,");
    assert_eq!(answer(&table, &["--law", "speed-restitution"])["fits"].as_bool(), Some(true));
    let known = ["--law", "speed-restitution", "--no-natural-scatter"];
    assert_eq!(answer(&table, &known)["fits"].as_bool(), Some(false));
}

#[test]
fn what_cannot_be_read_says_where() {
    let header = "speed_normal_m_s,rebound_speed_m_s,velocity_error_m_s,outcome\n";
    for (row, words) in [
        ("-2.8,2,0.1,", "speed_normal_m_s: \"-2.8\" is refused: an approach speed must be positive"),
        ("2.8,2,-0.1,", "velocity_error_m_s: \"-0.1\" is refused: a standard error must be zero or positive"),
        ("2.8,2,0.1,capture", "outcome: \"capture\" is refused: the rebound speed is 2 m/s"),
        ("2.8,2,0.1,lost", "outcome: \"lost\" is refused"),
        ("2.8,,0.1,", "rebound_speed_m_s: missing"),
    ] {
        let output = fit(&format!("{header}3,2.5,0.1,\n{row}\n"), &[]);
        assert!(output.status == 2 && output.complaint().contains(words), "{row}: {}", output.complaint());
        assert!(output.complaint().contains("row 2: "), "{}", output.complaint());
    }
    let output = fit("speed_normal_m_s,e\n3,0.5\n", &[]);
    assert!(output.complaint().contains("rebound_speed_m_s or overall_restitution"), "{}", output.complaint());
    let unknown = fit(header, &["--law", "magic"]).complaint();
    assert!(unknown.contains("possible values") && unknown.contains("speed-restitution"), "{unknown}");
    let several = fit(&format!("{header}-3,2.5,0.1,\n3,2.5,0.1,\n2.8,,0.1,\n"), &[]).complaint();
    assert!(["row 1: ", "row 3: ", "2 rows are refused"].iter().all(|words| several.contains(words)), "{several}");
}

/// The example of the help runs, and the figure shows every impact with a legend.
#[test]
fn csv_and_figure() {
    let table = table(60, 0.03, 0.0, (1.4, 12.0));
    let path = std::env::temp_dir().join(format!("microimpact-fit-{}.svg", std::process::id()));
    let options = ["--law", "speed-restitution", "--format", "csv", "--figure", path.to_str().unwrap()];
    let output = fit(&table, &options);
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("law,fits,p_value,parameter,value,low,high\n"), "{text}");
    assert!(text.contains("\nspeed-restitution,true,") && text.contains(",critical_speed_m_s,"), "{text}");
    let figure = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert!(figure.matches("<circle").count() > 60);
    for words in ["approach speed, m/s", "restitution e", "critical speed, with interval", "capture", "Residuals"] {
        assert!(figure.contains(words), "{words}");
    }
}
