//! Results as arrays of numpy.

use impact_arrays::{Impacts, Quantity, RowStatus};
use microimpact::{Class, CriticalSpeed, InputError, Parameter};
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::refusal::{OF_SECOND, message, message_of};

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

/// A refused number, and whether it is one of the second of two spheres.
#[derive(Clone, Copy)]
struct Refused {
    error: InputError,
    of_second: bool,
}

impl Refused {
    /// The place of the argument among those of the second sphere, and its name.
    fn of_second(&self) -> Option<(usize, &'static str)> {
        let place = OF_SECOND.iter().position(|(parameter, _)| *parameter == self.error.parameter)?;
        self.of_second.then_some((place, OF_SECOND[place].1))
    }

    /// The place of the argument among all, of which those of the second sphere are the last.
    fn code(&self) -> i16 {
        let place = match self.of_second() {
            Some((place, _)) => Some(Parameter::ALL.len() + place),
            None => Parameter::ALL.iter().position(|parameter| *parameter == self.error.parameter),
        };
        place.and_then(|place| i16::try_from(place).ok()).unwrap_or(NO_PARAMETER)
    }

    fn message(&self) -> String {
        self.of_second().map_or_else(|| message(self.error), |(_, keyword)| message_of(keyword, self.error))
    }
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

/// The reasons of what either has a result or is refused.
pub(crate) const ALGEBRA: [&str; 2] = [""; 2];

/// The first row without a result, and why.
pub(crate) type Failure = Option<(usize, String)>;

/// Status and refused parameter of each row, and the first failure.
pub(crate) type Statuses<'py> = (Bound<'py, PyArray1<i8>>, Bound<'py, PyArray1<i16>>, Failure);

/// The statuses of rows, why there is no result without convergence and with a law that the method cannot represent, and a function
/// that says of a row whether a sphere that is refused there is the second of two.
fn statuses<'py>(
    python: Python<'py>,
    rows: &[RowStatus],
    [not_converged, unsupported]: [&str; 2],
    of_second: impl Fn(usize) -> bool,
) -> Statuses<'py> {
    let refused = |row: usize| match rows[row] {
        RowStatus::Refused(error) => Some(Refused { error, of_second: of_second(row) }),
        _ => None,
    };
    let reason = |row: usize| match (rows[row], refused(row)) {
        (_, Some(refused)) => refused.message(),
        (RowStatus::Unsupported, _) => unsupported.into(),
        _ => not_converged.into(),
    };
    let parameter = |row| refused(row).map_or(NO_PARAMETER, |refused| refused.code());
    let first = rows.iter().position(|status| *status != RowStatus::Solved);
    (
        rows.iter().map(status_code).collect::<Vec<_>>().into_pyarray(python),
        (0..rows.len()).map(parameter).collect::<Vec<_>>().into_pyarray(python),
        first.map(|row| (row, reason(row))),
    )
}

/// Statuses, classes and quantities by their names.
pub(crate) type Results<'py> = (Statuses<'py>, Bound<'py, PyArray1<i8>>, Bound<'py, PyDict>);

/// The results of impacts, with the reasons of those that have none; the function says of a row whether a sphere that is refused there is the second of two.
pub(crate) fn results<'py>(
    python: Python<'py>,
    impacts: Impacts,
    failures: [&str; 2],
    of_second: impl Fn(usize) -> bool,
) -> PyResult<Results<'py>> {
    let quantities = PyDict::new(python);
    for (quantity, numbers) in impacts.quantities {
        quantities.set_item(quantity.name(), numbers.into_pyarray(python))?;
    }
    let classes: Vec<_> = impacts.class.iter().map(class_code).collect();
    Ok((statuses(python, &impacts.status, failures, of_second), classes.into_pyarray(python), quantities))
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
    (statuses(python, &rows, ALGEBRA, |_| false), found.iter().map(speed).collect::<Vec<_>>().into_pyarray(python))
}
