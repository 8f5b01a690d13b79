//! Fits of measured impacts.

use impact_fit::{Candidate, Law, MeasuredSphere, Observation, Response, ScatterModel, Statement, Verdict, compete};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

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

/// Fits laws to observations: speed, its error, rebound speed, its error, capture, mass and its relative error in as many rows.
#[pyfunction]
pub(crate) fn fit<'py>(
    python: Python<'py>,
    numbers: [PyReadonlyArray1<'py, f64>; 6],
    captured: PyReadonlyArray1<'py, bool>,
    has_mass: bool,
    laws: Vec<String>,
    natural_scatter: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let laws = laws.iter().map(|name| law(name)).collect::<PyResult<Vec<_>>>()?;
    let laws = if laws.is_empty() { Law::ALL.to_vec() } else { laws };
    let captured = captured.as_slice()?;
    let columns = numbers.iter().map(|column| Ok(column.as_slice()?)).collect::<PyResult<Vec<_>>>()?;
    let number = |column: usize, row: usize| columns[column].get(row).copied().unwrap_or(f64::NAN);
    let observation = |(row, captured): (usize, &bool)| {
        let response = if *captured {
            Response::Capture
        } else {
            Response::Rebound { speed: number(2, row), error: number(3, row) }
        };
        let sphere = has_mass.then(|| MeasuredSphere { mass: number(4, row), relative_error: number(5, row) });
        Observation { speed: number(0, row), speed_error: number(1, row), response, sphere }
    };
    let observations: Vec<_> = captured.iter().enumerate().map(observation).collect();
    let scatter = if natural_scatter { ScatterModel::Free } else { ScatterModel::Errors };
    let verdict = python.detach(|| compete(&observations, &laws, scatter));
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
