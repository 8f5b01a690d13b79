//! Results as arrays of numpy.

use impact_arrays::{Impacts, Quantity, RowStatus};
use microimpact::{Class, CriticalSpeed, InputError, Parameter};
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::refusal::message;

/// The code of a row in which nothing was refused.
const NO_PARAMETER: i16 = -1;

/// The code of a row without a class.
const NO_CLASS: i8 = -1;

/// Status codes of rows.
fn status_code(status: &RowStatus) -> i8 {
    match status {
        RowStatus::Solved => 0,
        RowStatus::NotConverged => 1,
        RowStatus::Unsupported => 2,
        RowStatus::Refused(_) => 3,
    }
}

/// The place of the refused parameter among all.
fn parameter_code(status: &RowStatus) -> i16 {
    let RowStatus::Refused(error) = status else { return NO_PARAMETER };
    let place = Parameter::ALL.iter().position(|parameter| *parameter == error.parameter);
    place.and_then(|place| i16::try_from(place).ok()).unwrap_or(NO_PARAMETER)
}

/// The code of a class, which is that of the C interface.
fn class_code(class: &Option<Class>) -> i8 {
    match class {
        None => NO_CLASS,
        Some(Class::ReboundSliding) => 0,
        Some(Class::ReboundRolling) => 1,
        Some(Class::CapturedSliding) => 2,
        Some(Class::CapturedRolling) => 3,
        Some(Class::CapturedResting) => 4,
        Some(Class::Undecided) => 5,
    }
}

/// The first row without a result, and why.
type Failure = Option<(usize, String)>;

fn reason(status: RowStatus) -> String {
    match status {
        RowStatus::Refused(error) => message(error),
        RowStatus::Unsupported => "this method cannot represent this law of contact".into(),
        RowStatus::Solved | RowStatus::NotConverged => {
            "tolerance: the simulation did not converge; use a larger tolerance".into()
        }
    }
}

/// Status and refused parameter of each row, and the first failure.
pub(crate) type Statuses<'py> = (Bound<'py, PyArray1<i8>>, Bound<'py, PyArray1<i16>>, Failure);

fn statuses<'py>(python: Python<'py>, rows: &[RowStatus]) -> Statuses<'py> {
    let first = rows.iter().position(|status| *status != RowStatus::Solved);
    (
        rows.iter().map(status_code).collect::<Vec<_>>().into_pyarray(python),
        rows.iter().map(parameter_code).collect::<Vec<_>>().into_pyarray(python),
        first.map(|row| (row, reason(rows[row]))),
    )
}

/// Statuses, classes and quantities by their names.
pub(crate) type Results<'py> = (Statuses<'py>, Bound<'py, PyArray1<i8>>, Bound<'py, PyDict>);

/// The results of impacts.
pub(crate) fn results(python: Python<'_>, impacts: Impacts) -> PyResult<Results<'_>> {
    let quantities = PyDict::new(python);
    for (quantity, numbers) in impacts.quantities {
        quantities.set_item(quantity.name(), numbers.into_pyarray(python))?;
    }
    let classes: Vec<_> = impacts.class.iter().map(class_code).collect();
    Ok((statuses(python, &impacts.status), classes.into_pyarray(python), quantities))
}

/// The quantities of some names.
pub(crate) fn quantities(names: &[String]) -> PyResult<Vec<Quantity>> {
    let of = |name: &String| Quantity::ALL.into_iter().find(|quantity| quantity.name() == name);
    names.iter().map(|name| of(name).ok_or_else(|| unknown(name))).collect()
}

fn unknown(name: &str) -> PyErr {
    let names = Quantity::ALL.map(Quantity::name).join(", ");
    PyValueError::new_err(format!("outputs: \"{name}\" is refused: it must be one of {names}"))
}

/// Critical speeds: zero where every speed rebounds, and infinite where none does.
pub(crate) fn speeds(
    python: Python<'_>,
    found: Vec<Result<CriticalSpeed<f64>, InputError>>,
) -> (Statuses<'_>, Bound<'_, PyArray1<f64>>) {
    let speed = |row: &Result<CriticalSpeed<f64>, InputError>| match row {
        Ok(CriticalSpeed::AlwaysRebounds) => 0.0,
        Ok(CriticalSpeed::At(speed)) => *speed,
        Ok(CriticalSpeed::NeverRebounds) => f64::INFINITY,
        Err(_) => f64::NAN,
    };
    let status = |row: &Result<_, InputError>| {
        row.as_ref().map_or_else(|error| RowStatus::Refused(*error), |_| RowStatus::Solved)
    };
    let rows: Vec<_> = found.iter().map(status).collect();
    (statuses(python, &rows), found.iter().map(speed).collect::<Vec<_>>().into_pyarray(python))
}
