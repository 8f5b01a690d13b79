//! Fits of measured impacts.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use impact_fit::{
    Candidate, Law, Measured, MeasuredSphere, Observation, ObservationError, ScatterModel, Statement, Verdict,
    compete_until,
};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::threads::until_interrupted;

/// A law by its name.
fn law(name: &str) -> PyResult<Law> {
    Law::ALL.into_iter().find(|law| law.name() == name).ok_or_else(|| {
        let names = Law::ALL.map(Law::name).join(", ");
        PyValueError::new_err(format!("laws: \"{name}\" is refused: it must be one of {names}"))
    })
}

/// Name, difference of Akaike's criterion, and probability of a law that was tried.
fn candidates(candidates: &[Candidate]) -> Vec<(&'static str, f64, f64)> {
    candidates.iter().map(|candidate| (candidate.law.name(), candidate.aic, candidate.p_value)).collect()
}

/// A number to four digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.3e}").parse().unwrap_or(number)
}

/// The exception for a refused number of a row, in the name and the unit of its argument. Rebounds and their errors are in multiples of
/// `unit`, m/s, if they were given as restitutions.
fn refused(error: ObservationError, columns: &[&[f64]], unit: Option<f64>, row: usize) -> PyErr {
    let (column, name, scale) = match (error.quantity, unit) {
        (Measured::Speed, _) => (0, "speed_normal", None),
        (Measured::SpeedError, _) => (1, "speed_normal_error", None),
        (Measured::Rebound | Measured::ReboundOfCapture, None) => (2, "rebound_speed", None),
        (Measured::Rebound | Measured::ReboundOfCapture, _) => (2, "overall_restitution", unit),
        (Measured::ReboundError, None) => (3, "rebound_speed_error", None),
        (Measured::ReboundError, _) => (3, "overall_restitution_error", unit),
        (Measured::Mass, _) => (4, "mass", None),
        (Measured::MassError, _) => (5, "mass_relative_error", None),
    };
    let words = match (error.quantity, scale) {
        (Measured::Mass, _) => " kg",
        (Measured::MassError, _) | (_, Some(_)) => "",
        _ => " m/s",
    };
    let advice = match error.quantity {
        Measured::Rebound => ", which is what is possible with room for errors; check units and signs",
        Measured::ReboundOfCapture => ", because the sphere was captured",
        _ => "",
    };
    let value = columns[column].get(row).copied().unwrap_or(f64::NAN);
    let (low, high) = (rounded(error.range.0 / scale.unwrap_or(1.0)), rounded(error.range.1 / scale.unwrap_or(1.0)));
    PyValueError::new_err(format!(
        "{name}: {value:?} is refused: it must be {low:?} to {high:?}{words}{advice} (at index {row})"
    ))
}

/// Fits laws to observations: speed, its error, rebound speed, its error, mass and its relative error in as many rows, and where it is
/// known whether the sphere was captured. Rebounds and their errors may be restitutions.
#[pyfunction]
pub(crate) fn fit<'py>(
    python: Python<'py>,
    numbers: [PyReadonlyArray1<'py, f64>; 6],
    captured: Option<PyReadonlyArray1<'py, bool>>,
    has_mass: bool,
    are_restitutions: bool,
    laws: Vec<String>,
    natural_scatter: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let laws = laws.iter().map(|name| law(name)).collect::<PyResult<Vec<_>>>()?;
    let laws = if laws.is_empty() { Law::ALL.to_vec() } else { laws };
    let captured = captured.as_ref().map(|captured| captured.as_slice()).transpose()?;
    let columns = numbers.iter().map(|column| Ok(column.as_slice()?)).collect::<PyResult<Vec<_>>>()?;
    let observation = |row: usize| {
        let [speed, speed_error, rebound, rebound_error, mass, relative_error] =
            [0, 1, 2, 3, 4, 5].map(|column: usize| columns[column].get(row).copied().unwrap_or(f64::NAN));
        let unit = if are_restitutions { speed } else { 1.0 };
        Observation::measured(
            (speed, speed_error),
            (unit * rebound, unit * rebound_error),
            captured.map(|captured| captured.get(row).copied().unwrap_or(false)),
            has_mass.then_some(MeasuredSphere { mass, relative_error }),
        )
        .map_err(|error| refused(error, &columns, are_restitutions.then_some(speed), row))
    };
    let observations = (0..columns[0].len()).map(observation).collect::<PyResult<Vec<_>>>()?;
    let scatter = if natural_scatter { ScatterModel::Free } else { ScatterModel::Errors };
    let fit = |stop: &Arc<AtomicBool>| compete_until(&stop.clone().into(), &observations, &laws, scatter);
    let Some(verdict) = until_interrupted(python, fit)? else {
        return Err(PyKeyboardInterrupt::new_err(()));
    };
    let answer = PyDict::new(python);
    match verdict {
        Verdict::NotEnough(reason) => answer.set_item("reason", reason)?,
        Verdict::NoLaw(tried) => answer.set_item("candidates", candidates(&tried))?,
        Verdict::Fits(statement) => state(&answer, &statement)?,
    }
    Ok(answer)
}

/// Speeds of the fitted curve.
const SPEEDS: u32 = 100;

fn state(answer: &Bound<'_, PyDict>, statement: &Statement) -> PyResult<()> {
    let fit = &statement.fit;
    answer.set_item("law", fit.law.name())?;
    answer.set_item("p_value", fit.judgement.p_value())?;
    answer.set_item("candidates", candidates(&statement.candidates))?;
    let alike: Vec<_> = statement.not_told_apart().into_iter().map(Law::name).collect();
    answer.set_item("indistinguishable_laws", alike)?;
    answer.set_item("natural_scatter", fit.scatter())?;
    answer.set_item("outlier_fraction", fit.outliers())?;
    let quantity = |found: &impact_fit::Quantity| {
        let impact_fit::Interval { value, low, high } = found.interval;
        (found.name, found.unit, value, low, high)
    };
    answer.set_item("quantities", statement.quantities.iter().map(quantity).collect::<Vec<_>>())?;
    // The reference speed is the largest of the data.
    let speed = |step: u32| fit.reference() * f64::from(step) / f64::from(SPEEDS);
    let speeds: Vec<f64> = (1..=SPEEDS).map(speed).collect();
    let (low, high): (Vec<f64>, Vec<f64>) = fit.band(&speeds).into_iter().unzip();
    let curve: Vec<f64> = speeds.iter().map(|speed| fit.restitution(*speed)).collect();
    answer.set_item("curve", (speeds, curve, low, high))
}
