//! Statistics of populations.

use std::sync::atomic::Ordering;

use impact_arrays::{Adhesion, Column, Law};
use microimpact::contact::{Adaptive, Contact};
use microimpact::{InputError, Parameter, RigidBody, Sphere};
use numpy::PyReadonlyArray1;
use population::{
    Classes, DIAMETERS, Distribution, DistributionError, Estimate, Moments, Population, PopulationError, Questions,
    Response, Results, RigidBodies, Simulations, SizeBin, Statistics, Stop,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::Columns;
use crate::contacts::{Words, contacts};
use crate::refusal::{message, refused};
use crate::rigid_bodies::bodies;
use crate::threads::until_interrupted;

/// A distribution by its kind and two numbers, or samples.
#[derive(FromPyObject)]
pub(crate) enum Shape<'py> {
    Numbers(String, f64, f64),
    Samples(PyReadonlyArray1<'py, f64>),
}

/// Diameter, speed, angle in degrees, and adhesion, which is the scene's own where there is none.
pub(crate) type Shapes<'py> = (Shape<'py>, Shape<'py>, Shape<'py>, Option<Shape<'py>>);

impl Shape<'_> {
    fn distribution(&self, name: &str, may_be_zero: bool) -> PyResult<Distribution> {
        let found = match self {
            Self::Numbers(kind, first, second) => match kind.as_str() {
                "log-normal" => Distribution::log_normal(*first, *second),
                "normal" if may_be_zero => Distribution::normal_from(*first, *second, 0.0),
                "normal" => Distribution::normal(*first, *second),
                _ if may_be_zero => Distribution::fixed(*first),
                _ => Distribution::samples(vec![*first]),
            },
            Self::Samples(values) if may_be_zero => Distribution::samples_of_any_sign(values.as_slice()?.to_vec()),
            Self::Samples(values) => Distribution::samples(values.as_slice()?.to_vec()),
        };
        found.map_err(|error| refused_shape(name, error))
    }
}

fn refused_shape(name: &str, error: DistributionError) -> PyErr {
    PyValueError::new_err(format!("{name}: {error}"))
}

/// What is asked of a population: number of ranges of diameters or their edges, m, speeds, m/s, particles at each of them, and the
/// tolerance of the quadrature.
#[derive(FromPyObject)]
pub(crate) struct Asked(u32, Vec<f64>, Vec<f64>, u32, f64);

impl Asked {
    fn questions(self) -> (Questions, f64) {
        let Self(bins, edges, speeds, particles, tolerance) = self;
        (Questions { bins, edges, speeds: Some(speeds), particles }, tolerance)
    }
}

fn population((diameter, speed, angle, adhesion): &Shapes<'_>, own: Column<'_>) -> PyResult<Population> {
    Ok(Population {
        diameter: (diameter.distribution("diameter", false)?.lengths_within(DIAMETERS))
            .map_err(|error| refused_shape("diameter", error))?,
        speed: speed.distribution("speed", false)?,
        angle: angle.distribution("angle_deg", true)?.incidence().map_err(|error| refused_shape("angle_deg", error))?,
        adhesion: match adhesion {
            Some(shape) => shape.distribution("adhesion", false)?,
            None => Shape::Numbers("fixed".into(), own.at(0), 0.0).distribution("adhesion", true)?,
        },
    })
}

/// Statistics by the contact simulation.
#[pyfunction]
pub(crate) fn population_of_contacts<'py>(
    python: Python<'py>,
    words: Words,
    numbers: Columns<'py>,
    shapes: Shapes<'py>,
    asked: Asked,
    tolerance: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let contacts = contacts(&words, &numbers)?;
    let own = match contacts.law {
        Law::Ring { strength: own, .. } | Law::Dmt { work: own } | Law::Jkr { work: own, .. } => own,
        Law::Hertz | Law::WithoutTension => Column::All(0.0),
    };
    let population = population(&shapes, own)?;
    let method = Adaptive::new(tolerance).map_err(refused)?;
    let friction = Parameter::Friction.check(numbers.required("friction")?.at(0)).map_err(refused)?;
    let scene = |diameter: f64, adhesion: f64| {
        let mut contacts = contacts;
        contacts.radius = Column::All(0.5 * diameter);
        match &mut contacts.law {
            Law::Ring { strength: own, .. } | Law::Dmt { work: own } | Law::Jkr { work: own, .. } => {
                *own = adhesion.into()
            }
            Law::Hertz | Law::WithoutTension => {}
        }
        let scene = contacts.scene(0)?;
        Ok::<_, InputError>(Contact::new(*scene.sphere(), *scene.law()))
    };
    let simulations = Simulations { scene, friction, method };
    let (questions, tolerance) = asked.questions();
    answer(python, &population, &questions, |stop| {
        let statistics = Statistics::interpolated(&population, &simulations, &questions.speeds(&population))?;
        Results::of(&population, &statistics.with_tolerance(tolerance).until(stop), &questions)
    })
}

/// Statistics by the rigid-body model with a work of adhesion or a coefficient.
#[pyfunction]
pub(crate) fn population_of_bodies<'py>(
    python: Python<'py>,
    numbers: Columns<'py>,
    shapes: Shapes<'py>,
    asked: Asked,
) -> PyResult<Bound<'py, PyDict>> {
    let bodies = bodies(&numbers)?;
    let [density, gyration, friction] =
        [bodies.density, bodies.gyration_ratio, bodies.friction].map(|column| column.at(0));
    let restitution = bodies.restitution.at(0).map_err(refused)?;
    let body = |diameter: f64| {
        Ok::<_, InputError>(RigidBody::new(Sphere::new(0.5 * diameter, density, gyration)?, restitution))
    };
    let asked = asked.questions();
    match bodies.adhesion {
        Adhesion::Coefficient(own) => {
            let population = population(&shapes, own)?;
            let scene = |diameter, rho| body(diameter)?.with_adhesion_coefficient(rho)?.with_friction(friction);
            direct(python, &population, &RigidBodies(scene), &asked)
        }
        Adhesion::Work(own) => {
            let population = population(&shapes, own)?;
            let scene = |diameter, work| body(diameter)?.with_work_of_adhesion(work)?.with_friction(friction);
            direct(python, &population, &RigidBodies(scene), &asked)
        }
        Adhesion::Speed { speed: own, power } => {
            let (population, power) = (population(&shapes, own)?, power.at(0));
            let scene = |diameter, speed| body(diameter)?.with_adhesion_at_speed(speed, power)?.with_friction(friction);
            direct(python, &population, &RigidBodies(scene), &asked)
        }
    }
}

fn direct<'py>(
    python: Python<'py>,
    population: &Population,
    response: &(impl Response + Sync),
    (questions, tolerance): &(Questions, f64),
) -> PyResult<Bound<'py, PyDict>> {
    answer(python, population, questions, |stop| {
        let statistics = Statistics::direct(population, response).with_tolerance(*tolerance).until(stop);
        Results::of(population, &statistics, questions)
    })
}

/// The statistics as arrays by name, unless Ctrl-C ends their computation.
fn answer<'py>(
    python: Python<'py>,
    population: &Population,
    questions: &Questions,
    compute: impl FnOnce(&Stop<'_>) -> Result<Results, PopulationError> + Send,
) -> PyResult<Bound<'py, PyDict>> {
    let found = until_interrupted(python, |stop| compute(&|| stop.load(Ordering::Relaxed)))?;
    let results = found.map_err(|error| match error {
        PopulationError::Input(error) => PyValueError::new_err(message(error)),
        other => PyValueError::new_err(format!("population: {other}")),
    })?;
    let answer = PyDict::new(python);
    answer.set_item("by_number", classes(&results.classes_by_number))?;
    answer.set_item("by_mass", classes(&results.classes_by_mass))?;
    let edges = questions.edges(population);
    let sizes: Vec<Size> = edges.windows(2).map(|pair| size([pair[0], pair[1]], &results.sizes)).collect();
    answer.set_item("sizes", sizes)?;
    let bounces: Vec<_> =
        results.bounces.iter().map(|bounce| (number(bounce.bounce_fraction), bounce.interval)).collect();
    answer.set_item("bounces", bounces)?;
    answer.set_item("restitution", moments(results.restitution))?;
    answer.set_item("restitution_of_rebounds", results.restitution_of_rebounds.map(moments))?;
    Ok(answer)
}

/// A number and its error.
type Number = (f64, f64);

fn number(estimate: Estimate) -> Number {
    (estimate.value, estimate.error)
}

/// Probabilities by the names of the classes.
fn classes(classes: &Classes) -> Vec<(&'static str, Number)> {
    classes.named().map(|(name, estimate)| (name, number(estimate))).into()
}

fn moments(moments: Moments) -> [Number; 3] {
    [moments.mean, moments.variance, moments.skewness].map(number)
}

/// A range of diameters: its edges, the parts of the spheres and of their mass, and the capture efficiency by both.
type Size = ([f64; 4], Number, Number);

/// The range of diameters between two edges; without spheres it has no capture efficiency.
fn size([from, to]: [f64; 2], bins: &[SizeBin]) -> Size {
    let none = (f64::NAN, f64::NAN);
    bins.iter().find(|bin| bin.from == from).map_or(([from, to, 0.0, 0.0], none, none), |bin| {
        ([from, to, bin.number, bin.mass], number(bin.by_number), number(bin.by_mass))
    })
}
