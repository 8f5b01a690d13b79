//! One impact in time.

use impact_arrays::Surface;
use methods::course;
use microimpact::contact::{Adaptive, Sample, Trajectory};
use microimpact::{InputError, NormalMotion};
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::Columns;
use crate::contacts::{Words, contacts};
use crate::refusal::refused;

/// Largest number of samples. The nodes of most impacts are fewer.
const SAMPLES: usize = 1024;

/// A number of a sample by its name.
type Named = (&'static str, fn(Sample<f64>) -> f64);

/// Trajectory of the first row: the samples as arrays by name.
#[pyfunction]
pub(crate) fn trajectory<'py>(
    python: Python<'py>,
    words: Words,
    numbers: Columns<'py>,
    tolerance: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let contacts = contacts(&words, &numbers)?;
    let number = |name: &str| numbers.optional(name, 0.0).map(|column| column.at(0));
    let (speed, tangential, spin) =
        (numbers.required("speed_normal")?.at(0), number("speed_tangential")?, number("spin")?);
    let solve = || -> Result<Option<Trajectory<f64, SAMPLES>>, InputError> {
        let method = Adaptive::new(tolerance)?;
        let scene = contacts.scene(0)?;
        let before = NormalMotion::new(speed)?.with_tangential(tangential)?.with_spin(scene.sphere(), spin)?;
        match contacts.surface {
            Surface::Coulomb { .. } => course(&scene, &before, &method),
            Surface::Peeling { moment, .. } => course(&scene.with_peeling(moment.at(0))?, &before, &method),
            Surface::Compliant { stiffness_ratio, .. } => {
                course(&scene.with_compliance(stiffness_ratio.at(0))?, &before, &method)
            }
        }
    };
    let Some(trajectory) = solve().map_err(refused)? else {
        return Err(PyValueError::new_err("tolerance: the simulation did not converge; use a larger tolerance"));
    };
    let samples = PyDict::new(python);
    let numbers: [Named; 5] = [
        ("time", |sample| sample.time),
        ("indentation", |sample| sample.indentation),
        ("velocity", |sample| sample.velocity),
        ("force", |sample| sample.force),
        ("elastic", |sample| sample.elastic),
    ];
    for (name, number) in numbers {
        samples.set_item(name, trajectory.samples().map(number).collect::<Vec<_>>().into_pyarray(python))?;
    }
    Ok(samples)
}
