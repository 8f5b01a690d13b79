//! The rigid-body model.

use impact_arrays::{Adhesion, Restitution, RigidBodies};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::columns::Columns;
use crate::results::{ALGEBRA, Results, Statuses, quantities, results, speeds};
use crate::threads::on_all_cores;

/// Spheres and restitution laws by the names of the arguments of `RigidBody`, which has checked that one of each is given.
pub(crate) fn bodies<'a>(columns: &'a Columns<'_>) -> PyResult<RigidBodies<'a>> {
    Ok(RigidBodies {
        // A population brings its own radii.
        radius: columns.optional("radius", f64::NAN)?,
        density: columns.required("density")?,
        gyration_ratio: columns.required("gyration_ratio")?,
        restitution: if columns.has("restitution_speed") {
            Restitution::Power {
                speed: columns.required("restitution_speed")?,
                power: columns.optional("restitution_power", 1.0)?,
            }
        } else if columns.has("yield_speed") {
            Restitution::ElasticPlastic(columns.required("yield_speed")?)
        } else {
            Restitution::Constant(columns.required("restitution")?)
        },
        adhesion: if columns.has("work_of_adhesion") {
            Adhesion::Work(columns.required("work_of_adhesion")?)
        } else if columns.has("adhesion_speed") {
            Adhesion::Speed {
                speed: columns.required("adhesion_speed")?,
                power: columns.optional("adhesion_power", 1.0)?,
            }
        } else {
            Adhesion::Coefficient(columns.optional("adhesion_coefficient", 0.0)?)
        },
        friction: columns.required("friction")?,
        rolling_arm: columns.optional("rolling_arm", 0.0)?,
    })
}

/// Classifies impacts of rigid bodies.
#[pyfunction]
pub(crate) fn classify<'py>(
    python: Python<'py>,
    numbers: Columns<'py>,
    count: usize,
    outputs: Vec<String>,
) -> PyResult<Results<'py>> {
    let (bodies, motions, outputs) = (bodies(&numbers)?, numbers.motions()?, quantities(&outputs)?);
    let impacts = on_all_cores(python, || bodies.classify(&motions, count, &outputs))?;
    results(python, impacts, ALGEBRA, |row| numbers.is_second_refused(row).unwrap_or(false))
}

/// Finds critical speeds of rigid bodies, m/s.
#[pyfunction]
pub(crate) fn critical_speeds_of_bodies<'py>(
    python: Python<'py>,
    numbers: Columns<'py>,
    count: usize,
) -> PyResult<(Statuses<'py>, Bound<'py, PyArray1<f64>>)> {
    let bodies = bodies(&numbers)?;
    let found = on_all_cores(python, || bodies.critical_speeds(count))?;
    Ok(speeds(python, found))
}
