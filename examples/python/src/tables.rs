//! Tables that answer without a simulation.

use microimpact::contact::{Adaptive, AnyLaw, Contact, Impulses};
use microimpact::table::{self, BoundarySlice, Lookup, TableOutcome, TableRebound};
use microimpact::{CriticalSpeed, InputError, NormalMotion, Sphere};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::columns::Columns;
use crate::contacts::{Words, contacts};
use crate::refusal::refused;

/// Largest number of cells: that of a table whose cells are part of its type.
const MOST_CELLS: usize = 128;

/// Relative error of one unit of a logarithm, of which an octave has 2^23.
const UNIT: f64 = std::f64::consts::LN_2 / 8_388_608.0;

/// Spheres of one material on one surface.
struct Material {
    law: AnyLaw<f64>,
    density: f64,
    gyration: f64,
    method: Adaptive<f64>,
}

impl Material {
    fn read(words: &Words, numbers: &Columns<'_>, radius: f64, tolerance: f64) -> PyResult<Self> {
        let mut contacts = contacts(words, numbers)?;
        contacts.radius = radius.into();
        let scene = contacts.scene(0).map_err(refused)?;
        let (density, gyration) = (contacts.density.at(0), contacts.gyration_ratio.at(0));
        Ok(Self { law: *scene.law(), density, gyration, method: Adaptive::new(tolerance).map_err(refused)? })
    }

    fn scene(&self, radius: f64) -> Result<Contact<f64, AnyLaw<f64>>, InputError> {
        Ok(Contact::new(Sphere::new(radius, self.density, self.gyration)?, self.law))
    }

    fn critical_speed(&self, radius: f64) -> Result<CriticalSpeed<f64>, InputError> {
        self.scene(radius)?.critical_speed(&self.method)
    }

    fn rebound(&self, radius: f64, speed: f64) -> Result<TableRebound<f64>, InputError> {
        let scene = self.scene(radius)?;
        let (impact, impulses) = scene.solve_for(&NormalMotion::new(speed)?, &self.method, Impulses)?;
        let impulse = impulses.elastic / (scene.sphere().mass() * speed);
        Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
    }
}

/// Outcomes, restitutions and errors.
type Reading<'py> = (Bound<'py, PyArray1<i8>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// The code of an outcome, which is that of the C interface.
fn code(outcome: TableOutcome) -> i8 {
    match outcome {
        TableOutcome::Rebound => 0,
        TableOutcome::Capture => 1,
        TableOutcome::TooCloseToCall => 2,
        TableOutcome::OutsideTable => 3,
    }
}

/// Radii and speeds of as many rows.
fn rows<'a>(
    radius: &'a PyReadonlyArray1<'_, f64>,
    speed: &'a PyReadonlyArray1<'_, f64>,
) -> PyResult<(&'a [f64], &'a [f64])> {
    let (radius, speed) = (radius.as_slice()?, speed.as_slice()?);
    if radius.len() == speed.len() {
        return Ok((radius, speed));
    }
    let message = format!("radius: {} numbers are refused: there are {} speeds", radius.len(), speed.len());
    Err(PyValueError::new_err(message))
}

/// The critical speed of spheres of one material as a function of the radius.
#[pyclass(frozen, module = "microimpact._native")]
pub(crate) struct BoundaryTable {
    smallest: f32,
    units: u32,
    cells: Vec<[i32; 4]>,
}

#[pymethods]
impl BoundaryTable {
    #[new]
    fn new(
        python: Python<'_>,
        words: Words,
        numbers: Columns<'_>,
        smallest_radius: f64,
        cells: usize,
        tolerance: f64,
    ) -> PyResult<Self> {
        if !(1..=MOST_CELLS).contains(&cells) {
            return Err(PyValueError::new_err(format!("cells: {cells} is refused: it must be 1 to {MOST_CELLS}")));
        }
        let material = Material::read(&words, &numbers, smallest_radius, tolerance)?;
        let mut cells = vec![[0; 4]; cells];
        let made = python.detach(|| {
            let table = BoundarySlice::fill(smallest_radius, &mut cells, |radius| material.critical_speed(radius))?;
            let (smallest, units, _) = table.parts();
            Ok((smallest, units))
        });
        let (smallest, units) = made.map_err(refused)?;
        Ok(Self { smallest, units, cells })
    }

    /// Outcomes by their codes.
    fn classify<'py>(
        &self,
        python: Python<'py>,
        radius: PyReadonlyArray1<'py, f64>,
        speed: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i8>>> {
        let (radius, speed) = rows(&radius, &speed)?;
        let codes = python.detach(|| {
            let table = BoundarySlice::from_parts(self.smallest, self.units, &self.cells)?;
            let outcome =
                |(radius, speed): (&f64, &f64)| Ok(code(table.classify(*radius, &NormalMotion::new(*speed)?)));
            radius.iter().zip(speed).map(outcome).collect::<Result<Vec<_>, InputError>>()
        });
        Ok(codes.map_err(refused)?.into_pyarray(python))
    }

    /// Smallest radius, m.
    #[getter]
    fn smallest_radius(&self) -> f64 {
        f64::from(self.smallest)
    }

    /// Largest relative error of a critical speed.
    #[getter]
    fn margin(&self) -> f64 {
        UNIT * f64::from(self.units)
    }

    /// The constants of the table, for firmware: the margin in units, and the cells.
    #[getter]
    fn parts(&self) -> (f32, u32, Vec<[i32; 4]>) {
        (self.smallest, self.units, self.cells.clone())
    }
}

/// Restitution of spheres of one material as a function of radius and speed, over two octaves of radii.
#[pyclass(frozen, module = "microimpact._native")]
pub(crate) struct RestitutionTable {
    table: Box<table::RestitutionTable<f64, 8, 6, 10>>,
}

#[pymethods]
impl RestitutionTable {
    #[new]
    fn new(
        python: Python<'_>,
        words: Words,
        numbers: Columns<'_>,
        smallest_radius: f64,
        speed_ratio: f64,
        tolerance: f64,
    ) -> PyResult<Self> {
        let material = Material::read(&words, &numbers, smallest_radius, tolerance)?;
        let made = python.detach(|| {
            let boundary = table::BoundaryTable::new(smallest_radius, |radius| material.critical_speed(radius))?;
            let rebound = |radius, speed| material.rebound(radius, speed);
            table::RestitutionTable::new(boundary, speed_ratio, rebound).map(Box::new)
        });
        Ok(Self { table: made.map_err(refused)? })
    }

    /// Outcomes by their codes, restitutions, and bounds of their errors; NaN where there is no rebound.
    fn read<'py>(
        &self,
        python: Python<'py>,
        radius: PyReadonlyArray1<'py, f64>,
        speed: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Reading<'py>> {
        let (radius, speed) = rows(&radius, &speed)?;
        let (mut codes, mut restitutions, mut errors) = (Vec::new(), Vec::new(), Vec::new());
        for (radius, speed) in radius.iter().zip(speed) {
            let motion = NormalMotion::new(*speed).map_err(refused)?;
            let (outcome, restitution, error) = match self.table.look_up(*radius, &motion) {
                Lookup::Rebound { rebound, error } => (TableOutcome::Rebound, rebound.restitution, error),
                Lookup::Capture => (TableOutcome::Capture, 0.0, 0.0),
                Lookup::TooCloseToCall => (TableOutcome::TooCloseToCall, f64::NAN, f64::NAN),
                Lookup::OutsideTable => (TableOutcome::OutsideTable, f64::NAN, f64::NAN),
            };
            codes.push(code(outcome));
            restitutions.push(restitution);
            errors.push(error);
        }
        Ok((codes.into_pyarray(python), restitutions.into_pyarray(python), errors.into_pyarray(python)))
    }

    /// Largest interpolation error of a restitution.
    #[getter]
    fn error(&self) -> f64 {
        self.table.error()
    }
}
