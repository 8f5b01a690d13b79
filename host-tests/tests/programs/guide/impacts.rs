//! The synthetic measurements of the guide: made by the paper's law with friction, and what the program says of them.

use std::fmt::Write;
use std::fs;

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

use super::{folder, keep_current};
use crate::fit::{DENSITY, DIAMETER, K, WORK, restitution};

/// Truth: friction of the surface, and standard error of each velocity, m/s.
const FRICTION: f64 = 0.15;
const ERROR: f64 = 0.02;

const IMPACTS: usize = 80;

/// Width of an interval of 95 %, in standard errors.
const WIDTH: f64 = 3.92;

/// Speeds before the impact, m/s, and angles from the normal, degrees.
const SPEEDS: (f64, f64) = (1.3, 12.0);
const ANGLES: (f64, f64) = (5.0, 60.0);

/// Tangential velocity after the impact (A22): the sphere slides, or rolls if friction suffices (A27).
fn tangential_after(speed: f64, tangential: f64, e: f64) -> f64 {
    let impulse = (1.0 + e) * speed;
    let rolling = 2.0 / 7.0 * tangential / impulse;
    tangential - rolling.min(FRICTION) * impulse
}

fn table() -> String {
    let mut random = StdRng::seed_from_u64(3);
    let mut table = "diameter_um,density_g_cm3,speed_normal_m_s,speed_tangential_m_s,spin_rad_s,rebound_speed_m_s,\
                     speed_tangential_out_m_s,velocity_error_m_s\n"
        .to_owned();
    for _ in 0..IMPACTS {
        let along = |range: (f64, f64), fraction: f64| range.0 + (range.1 - range.0) * fraction;
        // Slow impacts are more frequent, since they decide on adhesion.
        let path = along(SPEEDS, random.random::<f64>().powi(2));
        let angle = along(ANGLES, random.random()).to_radians();
        let (speed, tangential) = (path * angle.cos(), path * angle.sin());
        let e = restitution(speed, DIAMETER);
        let exact = [speed, tangential, e * speed, tangential_after(speed, tangential, e)];
        let [speed, tangential, mut rebound, after] = exact.map(|velocity| {
            let deviate: f64 = StandardNormal.sample(&mut random);
            velocity + ERROR * deviate
        });
        if e == 0.0 {
            rebound = 0.0;
        }

        writeln!(
            table,
            "{:.2},{:.1},{speed:.3},{tangential:.3},0,{rebound:.3},{after:.3},{ERROR}",
            DIAMETER * 1e6,
            DENSITY / 1e3
        )
        .unwrap();
    }
    table
}

#[test]
fn measurements_are_what_the_guide_says() {
    keep_current(folder().join("data/impacts.csv"), &table(), false);
}

/// What the guide's fit states of its law, as value, low and high.
fn fitted(parameter: &str) -> [f64; 3] {
    let table = fs::read(folder().join("data/impacts.csv")).unwrap();
    let output = crate::microimpact("fit", &["-", "--law", "speed-restitution", "--format", "json"], &table);
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    ["value", "low", "high"].map(|key| answer["parameters"][parameter][key].as_f64().unwrap())
}

#[test]
fn intervals_hold_the_truth() {
    for (parameter, truth) in [("restitution_speed_m_s", K), ("work_of_adhesion_j", WORK)] {
        let [_, low, high] = fitted(parameter);
        assert!((low..=high).contains(&truth), "{parameter}: {low} to {high}");
    }
}

/// The impacts that page 3 classifies have the parameters of page 2, rounded, and their standard errors.
#[test]
fn station_has_the_parameters_of_the_fit() {
    let station = fs::read_to_string(folder().join("data/station.csv")).unwrap();
    let mut rows = csv::Reader::from_reader(station.as_bytes());
    let header = rows.headers().unwrap().clone();
    for row in rows.records().map(Result::unwrap) {
        let cell = |name: &str| {
            let index = header.iter().position(|other| other == name).unwrap();
            row[index].parse::<f64>().unwrap()
        };
        for (parameter, error) in [
            ("restitution_speed_m_s", "restitution_speed_error_m_s"),
            ("work_of_adhesion_j", "work_of_adhesion_error_j"),
        ] {
            let [value, low, high] = fitted(parameter);
            let deviation = (high - low) / WIDTH;
            assert!((cell(parameter) - value).abs() < 0.1 * deviation, "{parameter} {value}");
            assert!((cell(error) / deviation - 1.0).abs() < 0.05, "{error} {deviation}");
        }
    }
}

#[test]
#[ignore = "writes the synthetic measurements anew"]
fn write_measurements() {
    fs::create_dir_all(folder().join("data")).unwrap();
    keep_current(folder().join("data/impacts.csv"), &table(), true);
}
