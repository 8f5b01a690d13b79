//! The command `classify` with standard errors, and with both models.

use microimpact::contact::{Adaptive, AnyLaw, Contact};
use microimpact::measure::NormalDistribution;
use microimpact::{
    Class, ConstantRestitution, CriticalSpeed, NormalMotion, RigidBody, SpeedRestitution, Sphere, Stiffness,
};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution, StandardNormal};

use crate::classify::{Written, run};

const HEADER: &str = "radius_m,density_kg_m3,restitution_speed_m_s,work_of_adhesion_j,friction,stiffness_pa,adhesion_n_m,\
                      zeta_h,zeta_a,speed_normal_m_s,speed_tangential_m_s";
const CELLS: &str = "5.06e-6,2600,130,2.22e-12,0.1,7.5e10,250,10.5,6.25";

/// Classes of one row: its velocities, then columns of standard errors and their cells.
fn classified(model: &str, level: &str, velocities: &str, errors: &[(&str, &str)]) -> (Written, u8) {
    let names: String = errors.iter().map(|(name, _)| format!(",{name}")).collect();
    let cells: String = errors.iter().map(|(_, cell)| format!(",{cell}")).collect();
    let table = format!("{HEADER}{names}\n{CELLS},{velocities}{cells}\n");
    let output = run(&["-", "--format", "csv", "--model", model, "--level", level], table.as_bytes());
    (Written::read(&output.stdout, b','), output.status)
}

fn critical(model: &str) -> f64 {
    let sphere = Sphere::solid(5.06e-6, 2600.0).unwrap();
    let found = if model == "simulation" {
        let law = AnyLaw::ring(Stiffness::new(7.5e10).unwrap(), 250.0, 6.25).unwrap().with_damping(10.5).unwrap();
        Contact::new(sphere, law).critical_speed(&Adaptive::new(1e-9).unwrap()).unwrap()
    } else {
        let scene = RigidBody::new(sphere, SpeedRestitution::new(130.0).unwrap());
        scene.with_work_of_adhesion(2.22e-12).unwrap().critical_speed()
    };
    let CriticalSpeed::At(speed) = found else { panic!("{found:?}") };
    speed
}

/// Where the speed alone has an error, the probability of a capture is that of a slower speed. An error of 5 % is expanded, and
/// one of 20 % drawn.
#[test]
fn an_error_of_the_speed() {
    for model in ["rigid-body", "simulation"] {
        let critical = critical(model);
        for (relative, by) in [(0.05, "expansion"), (0.2, "random rows")] {
            for offset in [-1.5, 0.3, 1.0] {
                let speed = critical / (1.0 - relative * offset);
                let error = relative * speed;
                let (written, status) =
                    classified(model, "0.9", &format!("{speed},0"), &[("speed_normal_error_m_s", &error.to_string())]);
                assert_eq!(status, 0, "{}", written.text(0, "error"));
                let capture = written.number(0, "probability_capture");
                let expected = (-offset).below();
                assert!(
                    (capture - expected).abs() <= written.number(0, "probability_error"),
                    "{model} {relative} {offset}: {capture} {expected}"
                );
                assert_eq!(written.text(0, "probability_by"), by);
                assert!(written.number(0, "probability_error") < 0.03);
            }
        }
    }
}

/// A table may give the size as a diameter, with its own error.
#[test]
fn an_error_of_the_diameter_is_twice_that_of_the_radius() {
    for (model, error) in [("rigid-body", 1.0), ("simulation", 1.0), ("rigid-body", 6.0)] {
        let probabilities = |size: &str, number: f64, error: f64| {
            let header = HEADER.replace("radius_m", size);
            let cells = CELLS.replace("5.06e-6", &number.to_string());
            let speed = 0.99 * critical(model);
            let table = format!("{header},{}_error_um\n{cells},{speed},0,{error}\n", &size[..size.len() - 2]);
            let output = run(&["-", "--format", "csv", "--model", model], table.as_bytes());
            assert_eq!(output.status, 0, "{}", output.complaint());
            Written::read(&output.stdout, b',').number(0, "probability_capture")
        };
        let (by_radius, by_diameter) =
            (probabilities("radius_m", 5.06e-6, 0.1 * error), probabilities("diameter_m", 1.012e-5, 0.2 * error));
        assert!((0.01..0.99).contains(&by_radius), "{model}: {by_radius}");
        assert!((by_radius - by_diameter).abs() < 1e-6, "{model}: {by_radius} {by_diameter}");
    }
}

/// A rigid body with errors of all its numbers against draws of this test.
#[test]
fn errors_of_all_numbers() {
    const DRAWS: usize = 100_000;
    let values = [5.06e-6, 2600.0, 130.0, 2.22e-12, 0.08, 1.95, 0.55];
    for relative in [0.03, 0.15] {
        let errors = values.map(|value| relative * value);
        let mut random = StdRng::seed_from_u64(9);
        let mut counts = [0.0; 4];
        for _ in 0..DRAWS {
            let mut drawn = values;
            for (value, error) in drawn.iter_mut().zip(errors) {
                let z: f64 = StandardNormal.sample(&mut random);
                *value += error * z;
            }
            let [radius, density, k, work, friction, normal, tangential] = drawn;
            let scene = RigidBody::new(Sphere::solid(radius, density).unwrap(), SpeedRestitution::new(k).unwrap())
                .with_work_of_adhesion(work)
                .unwrap()
                .with_friction(friction)
                .unwrap();
            let motion = NormalMotion::new(normal).unwrap().with_tangential(tangential).unwrap();
            let class = match scene.classify(&motion).class() {
                Class::ReboundSliding => 0,
                Class::ReboundRolling => 1,
                Class::CapturedSliding => 2,
                _ => 3,
            };
            counts[class] += 1.0 / DRAWS as f64;
        }
        let names = [
            "radius_error_m",
            "density_error_kg_m3",
            "restitution_speed_error_m_s",
            "work_of_adhesion_error_j",
            "friction_error",
            "speed_normal_error_m_s",
            "speed_tangential_error_m_s",
        ];
        let cells = errors.map(|error| error.to_string());
        let header = format!("{HEADER},{}", names.join(","));
        let row = CELLS.replace(",0.1,", ",0.08,");
        let table = format!("{header}\n{row},1.95,0.55,{}\n", cells.join(","));
        let output = run(&["-", "--format", "csv"], table.as_bytes());
        let written = Written::read(&output.stdout, b',');
        let noise = written.number(0, "probability_error") + 3.0 * 0.5 / (DRAWS as f64).sqrt();
        let mut sum = 0.0;
        for (name, expected) in
            ["rebound_sliding", "rebound_rolling", "captured_sliding", "captured_rolling"].into_iter().zip(counts)
        {
            let found = written.number(0, &format!("probability_{name}"));
            assert!((found - expected).abs() <= noise, "{relative} {name}: {found} {expected}");
            sum += found;
        }
        assert!((sum - 1.0).abs() < 1e-6);
        let sliding = written.number(0, "probability_sliding");
        assert!((sliding + written.number(0, "probability_rolling") - 1.0).abs() < 1e-6);
        assert!(counts.iter().all(|fraction| *fraction > 0.001), "all classes occur: {counts:?}");
    }
}

/// A restitution close to one is drawn: half of its values are one.
#[test]
fn an_error_at_the_bound_of_a_range() {
    let sphere = Sphere::solid(5e-6, 1000.0).unwrap();
    let work = 0.5 * sphere.mass();
    let table = format!(
        "radius_m,density_kg_m3,restitution,work_of_adhesion_j,speed_normal_m_s,restitution_error\n\
         5e-6,1000,1,{work},1.001,0.03\n"
    );
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    let written = Written::read(&output.stdout, b',');
    assert_eq!(written.text(0, "probability_by"), "random rows");
    // R v must exceed 1 m/s, so that R must exceed 0.999.
    let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0).unwrap()).with_work_of_adhesion(work).unwrap();
    assert!(scene.critical_speed() != CriticalSpeed::NeverRebounds);
    let expected = ((1.0 / 1.001 - 1.0) / 0.03_f64).below();
    assert!((written.number(0, "probability_capture") - expected).abs() <= written.number(0, "probability_error"));
}

#[test]
fn a_class_below_the_level_is_not_told() {
    let error = [("speed_normal_error_m_s", "0.05")];
    for (level, class) in [("0.9", "rebound rolling"), ("0.999", "cannot tell")] {
        let (written, _) = classified("rigid-body", level, "1.95,0", &error);
        assert_eq!(written.text(0, "class"), class, "{}", written.number(0, "probability_capture"));
    }
    let (written, status) = classified("rigid-body", "0.9", "2.1,0", &[("speed_normal_error_m_s", "")]);
    assert_eq!((status, written.text(0, "class")), (0, ""), "a row without errors has no probabilities");
    let (written, _) = classified("rigid-body", "0.9", "2.1,0", &[]);
    assert!(!written.has("class") && !written.has("probability_capture"));
    let table = format!("{HEADER},speed_normal_error_m_s\n{CELLS},1.83,0,0.05\n{CELLS},3,0,0.05\n");
    for model in ["rigid-body", "simulation", "both"] {
        let output = run(&["-", "--model", model], table.as_bytes());
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains("rebound rolling"), "{text}");
        assert_eq!(text.contains("cannot tell"), model != "simulation", "{text}");
    }
    assert_eq!(run(&["--level", "2"], b"").status, 2);
}

#[test]
fn refuses_errors_that_mean_nothing() {
    for (column, cell, words) in [
        ("speed_normal_error_m_s", "-1", "speed_normal_error_m_s: standard error is -1"),
        ("restitution_error", "0.1", "restitution_error: restitution is empty"),
        ("friction_error", "x", "friction_error: \"x\" is not a number"),
    ] {
        let (written, status) = classified("rigid-body", "0.9", "2.1,0", &[(column, cell)]);
        assert_eq!(status, 1);
        assert!(written.text(0, "error").contains(words), "{}", written.text(0, "error"));
        assert_eq!(written.text(0, "outcome"), "rebound", "the impact itself is computed");
    }
}

/// Both models with the numbers of each, and why they differ.
#[test]
fn both_models_and_their_difference() {
    let output = run(&["--model", "both", "--format", "csv"], b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let written = Written::read(&output.stdout, b',');
    let mut differences = 0;
    for row in 0..written.rows.len() {
        let name = written.text(row, "name");
        let classes = ["", "rigid_body_"].map(|model| {
            let motion = written.text(row, &format!("{model}motion"));
            let rests = motion == "resting" && written.text(row, &format!("{model}outcome")) == "capture";
            (written.text(row, &format!("{model}outcome")), if rests { "rolling" } else { motion })
        });
        let reason = written.text(row, "models_differ_because");
        let agree = written.text(row, "models_agree") == "yes";
        assert_eq!(agree, classes[0] == classes[1], "{name}");
        assert_eq!(agree, reason.is_empty(), "{name}: {reason}");
        differences += usize::from(!agree);
        if name == "Figure 2, D: slides" {
            assert!(reason.contains("proportional to the elastic force alone"), "{reason}");
            // One model stops the slip, the other does not.
            let numbers: Vec<f64> = reason.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            assert!(numbers.len() == 2 && (numbers[0] - 1.0) * (numbers[1] - 1.0) < 0.0, "{reason}");
        }
    }
    assert!(differences >= 1);
    let header = "radius_m,density_kg_m3,restitution_speed_m_s,work_of_adhesion_j,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,\
                  speed_normal_m_s";
    let table = format!("{header}\n5.06e-6,2600,130,2.22e-12,7.5e10,250,10.5,6.25,1.6\n");
    let output = run(&["-", "--model", "both", "--format", "csv"], table.as_bytes());
    let written = Written::read(&output.stdout, b',');
    let reason = written.text(0, "models_differ_because");
    assert!(reason.contains("of the critical speed of the rigid body, but the simulation has e ="), "{reason}");
}

/// A standard error in another unit than its number: the refusal says that a random number is to blame.
#[test]
fn a_standard_error_in_the_wrong_unit() {
    let (written, _) = classified("simulation", "0.9", "2.8,0", &[("stiffness_error_pa", "1e15")]);
    let error = written.text(0, "error");
    assert!(error.starts_with("with random numbers of these standard errors: "), "{error}");
    assert!(error.ends_with("; check the standard errors"), "{error}");
}
