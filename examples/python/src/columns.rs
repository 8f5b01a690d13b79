//! The numbers that Python hands over by name.

use std::collections::HashMap;

use impact_arrays::{Column, Motions};
use microimpact::Sphere;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

enum Cell<'py> {
    Number(f64),
    Array(PyReadonlyArray1<'py, f64>),
}

/// Numbers by the name of their argument: each a float, or an array with a number for each row.
pub(crate) struct Columns<'py> {
    cells: HashMap<String, Cell<'py>>,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Columns<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let mut cells = HashMap::new();
        for (name, value) in object.cast::<PyDict>()?.iter() {
            let name: String = name.extract()?;
            let cell = match value.extract::<f64>() {
                Ok(number) => Cell::Number(number),
                Err(_) => Cell::Array(value.extract::<PyReadonlyArray1<'py, f64>>()?),
            };
            cells.insert(name, cell);
        }
        Ok(Self { cells })
    }
}

impl Columns<'_> {
    /// Whether there is a number of a name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.cells.contains_key(name)
    }

    /// The numbers of a name.
    pub(crate) fn required(&self, name: &str) -> PyResult<Column<'_>> {
        match self.cells.get(name) {
            Some(Cell::Number(number)) => Ok(Column::All(*number)),
            Some(Cell::Array(array)) => Ok(Column::Each(array.as_slice()?)),
            None => Err(PyValueError::new_err(format!("{name}: missing; give a number or an array"))),
        }
    }

    /// The numbers of a name, or a number for all rows.
    pub(crate) fn optional(&self, name: &str, default: f64) -> PyResult<Column<'_>> {
        if self.has(name) { self.required(name) } else { Ok(Column::All(default)) }
    }

    /// The three components of a vector.
    fn vector(&self, name: &str) -> PyResult<[Column<'_>; 3]> {
        let component = |axis: &str| self.required(&format!("{name}_{axis}"));
        Ok([component("x")?, component("y")?, component("z")?])
    }

    /// Whether a sphere that is refused in a row is the second of two: the first is not.
    pub(crate) fn is_second_refused(&self, row: usize) -> PyResult<bool> {
        let first = Sphere::new(
            self.required("radius")?.at(row),
            self.required("density")?.at(row),
            self.required("gyration_ratio")?.at(row),
        );
        Ok(self.has("radius_2") && first.is_ok())
    }

    /// The motions before the impact: of two spheres if there is a second velocity, in space if there is one, else in a plane.
    pub(crate) fn motions(&self) -> PyResult<Motions<'_>> {
        if self.has("velocity_2_x") {
            return Ok(Motions::Pair {
                velocities: [self.vector("velocity")?, self.vector("velocity_2")?],
                spins: [self.vector("spin")?, self.vector("spin_2")?],
                normal: self.vector("normal")?,
                radius: self.required("radius_2")?,
                density: self.required("density_2")?,
                gyration_ratio: self.required("gyration_ratio_2")?,
            });
        }
        if self.has("velocity_x") {
            return Ok(Motions::Wall {
                velocity: self.vector("velocity")?,
                spin: self.vector("spin")?,
                normal: self.vector("normal")?,
                wall_velocity: self.vector("wall_velocity")?,
            });
        }
        Ok(Motions::Planar {
            speed_normal: self.required("speed_normal")?,
            speed_tangential: self.required("speed_tangential")?,
            spin: self.required("spin")?,
        })
    }
}
