//! The contact simulation.

use std::sync::atomic::Ordering;

use impact_arrays::{Contacts, Damping, Law, Surface};
use microimpact::contact::{Adaptive, JkrEnd};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::columns::Columns;
use crate::method::Method;
use crate::refusal::refused;
use crate::results::{Results, Statuses, quantities, results, speeds};
use crate::threads::until_interrupted;

/// The words of a scene: law, end rule, and damping.
pub(crate) type Words = (String, String, String);

fn unknown(name: &str, word: &str) -> PyErr {
    PyValueError::new_err(format!("{name}: there is no {word}"))
}

/// Spheres and contacts by the names of the arguments of `Scene`.
pub(crate) fn contacts<'a>((law, end_rule, damping): &Words, columns: &'a Columns<'_>) -> PyResult<Contacts<'a>> {
    let friction = columns.required("friction")?;
    let work = || columns.required("work_of_adhesion");
    Ok(Contacts {
        // Tables and populations bring their own radii.
        radius: columns.optional("radius", f64::NAN)?,
        density: columns.required("density")?,
        gyration_ratio: columns.required("gyration_ratio")?,
        stiffness: columns.required("stiffness")?,
        law: match (law.as_str(), end_rule.as_str()) {
            ("hertz", "no-indentation") => Law::Hertz,
            ("hertz", "no-force") => Law::WithoutTension,
            ("ring", _) => Law::Ring { strength: columns.required("adhesion")?, damping: columns.required("zeta_a")? },
            ("dmt", _) => Law::Dmt { work: work()? },
            ("jkr", "pull-off") => Law::Jkr { work: work()?, end: JkrEnd::PullOff },
            ("jkr", "snap-off") => Law::Jkr { work: work()?, end: JkrEnd::SnapOff },
            _ => return Err(unknown("law", &format!("{law} with the end rule {end_rule}"))),
        },
        damping: match damping.as_str() {
            "none" => Damping::None,
            "hysteretic" => Damping::Hysteretic(columns.required("zeta_h")?),
            "viscoelastic" => Damping::Viscoelastic(columns.required("damping_value")?),
            "constant" => Damping::Constant(columns.required("damping_value")?),
            other => return Err(unknown("damping", other)),
        },
        external_force: columns.required("external_force")?,
        surface: if columns.has("stiffness_ratio") {
            Surface::Compliant { friction, stiffness_ratio: columns.required("stiffness_ratio")? }
        } else if columns.has("peeling") {
            Surface::Peeling { friction, moment: columns.required("peeling")? }
        } else {
            Surface::Coulomb { friction }
        },
    })
}

/// Simulates impacts by a method.
#[pyfunction]
pub(crate) fn simulate<'py>(
    python: Python<'py>,
    words: Words,
    numbers: Columns<'py>,
    count: usize,
    method: Method,
    outputs: Vec<String>,
) -> PyResult<Results<'py>> {
    let (contacts, motions, outputs) = (contacts(&words, &numbers)?, numbers.motions()?, quantities(&outputs)?);
    let impacts = method.simulate(python, &contacts, &motions, count, &outputs)?;
    results(python, impacts, method.failures(), |row| numbers.is_second_refused(row).unwrap_or(false))
}

/// Finds critical speeds, m/s.
#[pyfunction]
pub(crate) fn critical_speeds<'py>(
    python: Python<'py>,
    words: Words,
    numbers: Columns<'py>,
    count: usize,
    tolerance: f64,
) -> PyResult<(Statuses<'py>, Bound<'py, PyArray1<f64>>)> {
    let contacts = contacts(&words, &numbers)?;
    let method = Adaptive::new(tolerance).map_err(refused)?;
    let found = until_interrupted(python, |stop| {
        contacts.critical_speeds(count, &method, || stop.load(Ordering::Relaxed)).unwrap_or_default()
    })?;
    Ok(speeds(python, found))
}
