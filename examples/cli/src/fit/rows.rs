//! The measured impacts of a table.

use std::f64::consts::PI;
use std::io::{BufRead, Write};

use clap::ValueEnum;
use impact_fit::{Measured, MeasuredSphere, Observation, ObservationError};
use microimpact::{Parameter, Sphere};
use sheet::{Input, Row};

use crate::command::Reading;
use crate::words::word;

/// The columns that a fit reads.
pub const INPUTS: [Input; 10] = [
    Input::required(&["speed_normal_m_s"]),
    Input::required(&["rebound_speed_m_s", "overall_restitution"]),
    Input::optional(&["outcome"], "capture where the rebound speed is exactly 0, otherwise rebound"),
    Input::further(&["velocity_error_m_s"]),
    Input::further(&["speed_normal_error_m_s"]),
    Input::further(&["rebound_speed_error_m_s"]),
    Input::further(&["overall_restitution_error"]),
    Input::optional(&["diameter_m", "radius_m", "mass_kg"], "not known; works are in J/kg"),
    Input::further(&["diameter_error_m"]),
    Input::optional(&["density_kg_m3"], "not known; works are in J/kg").without(&["mass_kg"]),
];

/// Standard error of a velocity where the row gives a rebound speed and no error, m/s.
pub const VELOCITY_ERROR: f64 = 0.01;

/// What a table holds.
pub struct Measurements {
    pub observations: Vec<Observation>,
    /// What was assumed, in words.
    pub assumptions: Vec<String>,
    /// Whether the default of the velocity error was used.
    pub default_error: bool,
    /// Median diameter, m, if all rows give one, and whether diameters differ.
    pub diameter: Option<(f64, bool)>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Outcome {
    Rebound,
    Capture,
}

/// What a row gives.
struct Read {
    observation: Observation,
    diameter: Option<f64>,
    /// Whether the default stands for the error of the approach speed, and of the rebound speed.
    default_errors: [bool; 2],
    without_error: bool,
}

/// Reads a table.
///
/// # Errors
/// What is wrong with the table or a row, in words.
pub fn read(
    command: &str,
    reading: &Reading,
    source: impl BufRead,
    errors: &mut dyn Write,
) -> Result<Measurements, String> {
    let mut sheet = reading.open(command, source, &INPUTS, |_| Vec::new(), errors)?;
    let (mut rows, mut refused) = (Vec::new(), Vec::new());
    while let Some(row) = sheet.next_row()? {
        match row.check().and_then(|()| read_row(&row)) {
            Ok(read) => rows.push(read),
            Err(reason) => refused.push(format!("row {}: {reason}", row.index())),
        }
    }
    if !refused.is_empty() {
        return Err(in_lines(&refused));
    }
    let with_mass = rows.iter().filter(|row| row.observation.sphere.is_some()).count();
    if with_mass > 0 && with_mass < rows.len() {
        let row = 1 + rows.iter().position(|row| row.observation.sphere.is_none()).unwrap_or(0);
        return Err(format!(
            "row {row}: the mass of the sphere is missing, though other rows have one; give each row a diameter and a density, or none"
        ));
    }
    let mut assumptions = Vec::new();
    let assumed = [0, 1].map(|speed| rows.iter().any(|row| row.default_errors[speed]));
    let default_error = assumed.contains(&true);
    let speeds = match assumed {
        [true, true] => "both speeds",
        [true, false] => "the approach speed",
        _ => "the rebound speed",
    };
    if default_error {
        assumptions.push(format!(
            "velocity_error_m_s is not given: a standard error of {VELOCITY_ERROR} m/s of {speeds} is assumed"
        ));
    }
    if rows.iter().any(|row| row.without_error) {
        assumptions.push("errors of the restitutions are not given: they are part of the natural scatter".to_owned());
    }
    for assumption in &assumptions {
        // If standard error is closed, nobody wants to know.
        let _ = writeln!(errors, "{command}: {assumption}");
    }
    let diameters: Option<Vec<f64>> = rows.iter().map(|row| row.diameter).collect();
    let diameter = diameters.and_then(|mut diameters| {
        diameters.sort_by(f64::total_cmp);
        let differ = diameters.first() != diameters.last();
        diameters.get(diameters.len() / 2).map(|median| (*median, differ))
    });
    let observations = rows.into_iter().map(|row| row.observation).collect();
    Ok(Measurements { observations, assumptions, default_error, diameter })
}

/// Refused rows that are listed.
const LISTED: usize = 10;

/// Why rows are refused, each on a line. A fit without them might be another.
fn in_lines(refused: &[String]) -> String {
    let mut lines = refused[..refused.len().min(LISTED)].join("\n");
    if refused.len() > 1 {
        lines += &format!("\n{} rows are refused, and the fit would miss them; correct or delete them", refused.len());
    }
    lines
}

fn read_row(row: &Row<'_>) -> Result<Read, String> {
    let speed: f64 = row.required("speed_normal_m_s")?;
    if speed <= 0.0 {
        return Err(format!(
            "speed_normal_m_s: \"{speed}\" is refused: an approach speed must be positive (1e-12 to 1e6 m/s); enter {speed} m/s as {}",
            speed.abs()
        ));
    }
    Parameter::ApproachSpeed.check(speed).map_err(|error| row.reason(error))?;
    let both = error(row, "velocity_error_m_s")?;
    let speed_error = error(row, "speed_normal_error_m_s")?.or(both);
    let rebound_error = error(row, "rebound_speed_error_m_s")?.or(both);
    let restitution_error = error(row, "overall_restitution_error")?;
    let (sphere, diameter) = sphere(row)?;
    let mut default_errors = [false; 2];
    let mut without_error = false;
    let outcome = word(row, "outcome", Outcome::value_variants())?;
    let (rebound, restitution) = (row.number::<f64>("rebound_speed_m_s")?, row.number::<f64>("overall_restitution")?);
    let (rebound, speed_error, rebound_error) = match (rebound, restitution) {
        (Some(rebound), restitution) => {
            default_errors = [speed_error.is_none(), rebound_error.is_none()];
            let errors = [speed_error, rebound_error].map(|error| error.unwrap_or(VELOCITY_ERROR));
            if let Some(restitution) = restitution {
                agree(rebound, restitution * speed, errors[0].hypot(errors[1]).max(ROUNDING * speed))?;
            }
            (rebound, errors[0], errors[1])
        }
        (None, Some(restitution)) => {
            // A stated error of the restitution contains those of both speeds.
            without_error = restitution_error.is_none() && speed_error.is_none() && rebound_error.is_none();
            let errors = match restitution_error {
                Some(error) => (speed_error.filter(|_| both.is_none()).unwrap_or(0.0), error * speed),
                None => (speed_error.unwrap_or(0.0), rebound_error.unwrap_or(0.0)),
            };
            (restitution * speed, errors.0, errors.1)
        }
        (None, None) if outcome == Some(Outcome::Capture) => {
            default_errors[0] = speed_error.is_none() && restitution_error.is_none();
            (0.0, speed_error.unwrap_or(VELOCITY_ERROR), 0.0)
        }
        (None, None) => {
            return Err("rebound_speed_m_s: missing; enter a number, or capture in the column outcome".into());
        }
    };
    let captured = outcome.map(|outcome| outcome == Outcome::Capture);
    let observation = Observation::measured((speed, speed_error), (rebound, rebound_error), captured, sphere)
        .map_err(|error| in_words(error, speed))?;
    Ok(Read { observation, diameter, default_errors, without_error })
}

/// Why a measured number is refused, at an approach speed.
fn in_words(error: ObservationError, speed: f64) -> String {
    let (rebound, (_, high)) = (error.value, error.range);
    match error.quantity {
        Measured::Rebound => format!(
            "the rebound speed {rebound} m/s is refused at an approach speed of {speed} m/s: it must lie between 0 and the approach \
             speed, give or take {:.3} m/s for errors; check the units and velocity_error_m_s",
            high - speed
        ),
        Measured::ReboundOfCapture => {
            format!("outcome: \"capture\" is refused: the rebound speed is {rebound} m/s; enter rebound, or 0")
        }
        _ => error.to_string(),
    }
}

/// Requires a measured rebound speed and that of the stated restitution to be the same.
fn agree(rebound: f64, stated: f64, error: f64) -> Result<(), String> {
    if (rebound - stated).abs() <= SAME * error {
        return Ok(());
    }
    Err(format!(
        "overall_restitution: it makes a rebound speed of {stated:.4} m/s, but rebound_speed_m_s is {rebound} m/s; leave one of both empty"
    ))
}

/// Standard errors within which two numbers are the same.
const SAME: f64 = 3.0;

/// Rounding of a restitution of two digits.
const ROUNDING: f64 = 0.005;

/// A standard error.
fn error(row: &Row<'_>, column: &str) -> Result<Option<f64>, String> {
    match row.number::<f64>(column)? {
        Some(error) if !(error >= 0.0 && error.is_finite()) => {
            Err(format!("{column}: \"{error}\" is refused: a standard error must be zero or positive"))
        }
        error => Ok(error),
    }
}

/// The sphere of a row and its diameter.
fn sphere(row: &Row<'_>) -> Result<(Option<MeasuredSphere>, Option<f64>), String> {
    let diameter = match (row.number::<f64>("diameter_m")?, row.number::<f64>("radius_m")?) {
        (Some(_), Some(_)) => {
            return Err("size: given twice, as radius_m and diameter_m; leave one of them empty".into());
        }
        (diameter, radius) => diameter.or(radius.map(|radius| 2.0 * radius)),
    };
    let relative = match (error(row, "diameter_error_m")?, diameter) {
        (Some(error), Some(diameter)) => 3.0 * error / diameter,
        (Some(_), None) => {
            return Err("diameter_error_m: not without diameter_m; give it or leave the cell empty".into());
        }
        (None, _) => 0.0,
    };
    if let Some(mass) = row.number::<f64>("mass_kg")? {
        if !(mass > 0.0 && mass.is_finite()) {
            return Err(format!("mass_kg: \"{mass}\" is refused: a mass must be positive"));
        }
        return Ok((Some(MeasuredSphere { mass, relative_error: relative }), diameter));
    }
    let (Some(diameter), Some(density)) = (diameter, row.number::<f64>("density_kg_m3")?) else {
        return Ok((None, diameter));
    };
    Sphere::solid(0.5 * diameter, density).map_err(|error| row.reason(error))?;
    let mass = PI / 6.0 * diameter.powi(3) * density;
    Ok((Some(MeasuredSphere { mass, relative_error: relative }), Some(diameter)))
}
