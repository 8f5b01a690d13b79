//! Tables that answer without a simulation.

use microimpact::contact::{Adaptive, AnyLaw, Contact, Impulses};
use microimpact::table::{self, BoundarySlice, Lookup, RestitutionParts, TableOutcome, TableRebound};
use microimpact::{CriticalSpeed, InputError, NormalMotion, Parameter, Sphere};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::columns::Columns;
use crate::contacts::{Words, contacts};
use crate::refusal::{message, message_of, refused};
use crate::results::Failure;

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
        let scene = contacts.scene(0).map_err(of_table)?;
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

/// The exception for an error of an input of a table, whose only radius is the smallest.
fn of_table(error: InputError) -> PyErr {
    match error.parameter {
        Parameter::Radius => PyValueError::new_err(message_of("smallest_radius", error)),
        Parameter::CriticalSpeed => PyValueError::new_err(format!(
            "contact: {error}; a table needs a contact that captures slow spheres and releases fast ones"
        )),
        _ => refused(error),
    }
}

/// Outcomes, restitutions and errors, and the first row that is refused.
type Reading<'py> = (Bound<'py, PyArray1<i8>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Failure);

/// The code of a row whose radius or speed is refused.
const NO_OUTCOME: i8 = -1;

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

/// The motion of a row, for a table.
fn motion(radius: f64, speed: f64) -> Result<NormalMotion<f64>, InputError> {
    Parameter::Radius.check(radius)?;
    NormalMotion::new(speed)
}

/// The readings of rows, with that of a row that is refused, and the first such row.
fn each<T: Copy>(
    (radius, speed): (&[f64], &[f64]),
    none: T,
    read: impl Fn(f64, &NormalMotion<f64>) -> T,
) -> (Vec<T>, Failure) {
    let mut failure = None;
    let row = |(row, (radius, speed)): (usize, (&f64, &f64))| match motion(*radius, *speed) {
        Ok(motion) => read(*radius, &motion),
        Err(error) => {
            failure.get_or_insert((row, message(error)));
            none
        }
    };
    let readings = radius.iter().zip(speed).enumerate().map(row).collect();
    (readings, failure)
}

/// The constants of a boundary table: smallest radius, margin in units, and cells.
type BoundaryParts = (f32, u32, Vec<[i32; 4]>);

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
        let (smallest, units) = made.map_err(of_table)?;
        Ok(Self { smallest, units, cells })
    }

    /// The table of some parts.
    #[staticmethod]
    fn from_parts(smallest: f32, units: u32, cells: Vec<[i32; 4]>) -> PyResult<Self> {
        BoundarySlice::from_parts(smallest, units, &cells).map_err(of_table)?;
        Ok(Self { smallest, units, cells })
    }

    /// Outcomes by their codes, and the first row that is refused.
    fn classify<'py>(
        &self,
        python: Python<'py>,
        radius: PyReadonlyArray1<'py, f64>,
        speed: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<(Bound<'py, PyArray1<i8>>, Failure)> {
        let rows = rows(&radius, &speed)?;
        let table = BoundarySlice::from_parts(self.smallest, self.units, &self.cells).map_err(of_table)?;
        let (codes, failure) =
            python.detach(|| each(rows, NO_OUTCOME, |radius, motion| code(table.classify(radius, motion))));
        Ok((codes.into_pyarray(python), failure))
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
    fn parts(&self) -> BoundaryParts {
        (self.smallest, self.units, self.cells.clone())
    }
}

/// Cells, radii and speeds of a restitution table.
const CELLS: usize = 8;
const RADII: usize = 6;
const SPEEDS: usize = 10;

/// The other numbers of a restitution table: first radius, nodes per octave and per root, last speed, errors of restitution and
/// impulse, and their errors by the margin.
type Scales = (i32, f64, f64, i32, f64, f64, f64, f64);

/// Restitution of spheres of one material as a function of radius and speed, over two octaves of radii.
#[pyclass(frozen, module = "microimpact._native")]
pub(crate) struct RestitutionTable {
    table: Box<table::RestitutionTable<f64, CELLS, RADII, SPEEDS>>,
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
        Ok(Self { table: made.map_err(of_table)? })
    }

    /// The table of some parts.
    #[staticmethod]
    fn from_parts(
        boundary: (f32, u32, [[i32; 4]; CELLS]),
        scales: Scales,
        nodes: [[[f64; 2]; SPEEDS]; RADII],
    ) -> PyResult<Self> {
        let (smallest, units, cells) = boundary;
        let (first, per_octave, per_root, end, error, impulse_error, near, impulse_over_restitution) = scales;
        let boundary = table::BoundaryTable::from_parts(smallest, units, cells).map_err(of_table)?;
        let parts = RestitutionParts {
            boundary,
            nodes,
            first,
            per_octave,
            per_root,
            end,
            error,
            impulse_error,
            near,
            impulse_over_restitution,
        };
        Ok(Self {
            table: Box::new(table::RestitutionTable::<f64, CELLS, RADII, SPEEDS>::from_parts(parts).map_err(of_table)?),
        })
    }

    /// The parts of the table.
    #[getter]
    fn parts(&self) -> (BoundaryParts, Scales, [[[f64; 2]; SPEEDS]; RADII]) {
        let parts = self.table.parts();
        let (smallest, units, cells) = parts.boundary.parts();
        let RestitutionParts { nodes, first, per_octave, per_root, end, error, .. } = parts;
        let RestitutionParts { impulse_error, near, impulse_over_restitution, .. } = parts;
        let scales = (first, per_octave, per_root, end, error, impulse_error, near, impulse_over_restitution);
        ((smallest, units, cells.to_vec()), scales, nodes)
    }

    /// Outcomes by their codes, restitutions, and bounds of their errors; NaN where there is no rebound. And the first row that is
    /// refused.
    fn read<'py>(
        &self,
        python: Python<'py>,
        radius: PyReadonlyArray1<'py, f64>,
        speed: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Reading<'py>> {
        let rows = rows(&radius, &speed)?;
        let unknown = |outcome: i8| (outcome, f64::NAN, f64::NAN);
        let read = |radius: f64, motion: &NormalMotion<f64>| match self.table.look_up(radius, motion) {
            Lookup::Rebound { rebound, error } => (code(TableOutcome::Rebound), rebound.restitution, error),
            Lookup::Capture => (code(TableOutcome::Capture), 0.0, 0.0),
            Lookup::TooCloseToCall => unknown(code(TableOutcome::TooCloseToCall)),
            Lookup::OutsideTable => unknown(code(TableOutcome::OutsideTable)),
        };
        let (readings, failure) = python.detach(|| each(rows, unknown(NO_OUTCOME), read));
        let codes: Vec<i8> = readings.iter().map(|(code, ..)| *code).collect();
        let (restitutions, errors): (Vec<f64>, Vec<f64>) = readings.iter().map(|(_, e, error)| (*e, *error)).unzip();
        Ok((codes.into_pyarray(python), restitutions.into_pyarray(python), errors.into_pyarray(python), failure))
    }

    /// Largest interpolation error of a restitution.
    #[getter]
    fn error(&self) -> f64 {
        self.table.error()
    }
}
