//! Statistics of populations.

use impact_arrays::{Adhesion, Column, Law};
use microimpact::contact::{Adaptive, Contact};
use microimpact::{InputError, Parameter, RigidBody, Sphere};
use numpy::PyReadonlyArray1;
use population::{
    Distribution, DistributionError, Estimate, Moments, Outcomes, Population, PopulationError, Response, RigidBodies,
    Simulations, Statistics,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::Columns;
use crate::contacts::{Words, contacts};
use crate::refusal::{message, refused};
use crate::rigid_bodies::bodies;

/// A distribution by its kind and two numbers, or samples.
#[derive(FromPyObject)]
pub(crate) enum Shape<'py> {
    Numbers(String, f64, f64),
    Samples(PyReadonlyArray1<'py, f64>),
}

/// Diameter, speed, angle in radians, and adhesion, which is the scene's own where there is none.
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
        found.map_err(|error: DistributionError| PyValueError::new_err(format!("{name}: {error}")))
    }
}

/// Largest angle of incidence, degrees.
const LARGEST_ANGLE: f64 = 89.9;

/// Angles of incidence, rad; of a normal distribution, what lies beyond the largest is left out.
fn angles(distribution: Distribution) -> PyResult<Distribution> {
    let largest = LARGEST_ANGLE.to_radians();
    if distribution.lone_values().iter().any(|angle| !(0.0..=largest).contains(angle)) {
        let message = format!("angle_deg: an angle of incidence must be 0 to {LARGEST_ANGLE} degrees from the normal");
        return Err(PyValueError::new_err(message));
    }
    if !distribution.is_continuous() {
        return Ok(distribution);
    }
    distribution.within(0.0, largest).map_err(|error| PyValueError::new_err(format!("angle_deg: {error}")))
}

/// What is asked of a population: number of ranges of diameters or their edges, m, speeds, m/s, and the tolerance of the quadrature.
pub(crate) type Questions = (usize, Vec<f64>, Vec<f64>, f64);

fn population((diameter, speed, angle, adhesion): &Shapes<'_>, own: Column<'_>) -> PyResult<Population> {
    Ok(Population {
        diameter: diameter.distribution("diameter", false)?,
        speed: speed.distribution("speed", false)?,
        angle: angles(angle.distribution("angle_deg", true)?)?,
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
    questions: Questions,
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
    let answer = python.detach(|| {
        let statistics = Statistics::interpolated(&population, &simulations, &questions.2)?.with_tolerance(questions.3);
        Answer::of(&population, &statistics, &questions)
    });
    answer?.into_dict(python)
}

/// Statistics by the rigid-body model with a work of adhesion or a coefficient.
#[pyfunction]
pub(crate) fn population_of_bodies<'py>(
    python: Python<'py>,
    numbers: Columns<'py>,
    shapes: Shapes<'py>,
    questions: Questions,
) -> PyResult<Bound<'py, PyDict>> {
    let bodies = bodies(&numbers)?;
    let [density, gyration, friction] =
        [bodies.density, bodies.gyration_ratio, bodies.friction].map(|column| column.at(0));
    let restitution = bodies.restitution.at(0).map_err(refused)?;
    let body = |diameter: f64| {
        Ok::<_, InputError>(RigidBody::new(Sphere::new(0.5 * diameter, density, gyration)?, restitution))
    };
    let answer = match bodies.adhesion {
        Adhesion::Coefficient(own) => {
            let population = population(&shapes, own)?;
            let scene = |diameter, rho| body(diameter)?.with_adhesion_coefficient(rho)?.with_friction(friction);
            python.detach(|| direct(&population, &RigidBodies(scene), &questions))
        }
        Adhesion::Work(own) => {
            let population = population(&shapes, own)?;
            let scene = |diameter, work| body(diameter)?.with_work_of_adhesion(work)?.with_friction(friction);
            python.detach(|| direct(&population, &RigidBodies(scene), &questions))
        }
        Adhesion::Speed { speed: own, power } => {
            let (population, power) = (population(&shapes, own)?, power.at(0));
            let scene = |diameter, speed| body(diameter)?.with_adhesion_at_speed(speed, power)?.with_friction(friction);
            python.detach(|| direct(&population, &RigidBodies(scene), &questions))
        }
    };
    answer?.into_dict(python)
}

fn direct(population: &Population, response: &impl Response, questions: &Questions) -> Result<Answer, Stop> {
    Answer::of(population, &Statistics::direct(population, response).with_tolerance(questions.3), questions)
}

/// A number and its error.
type Number = (f64, f64);

fn number(estimate: Estimate) -> Number {
    (estimate.value, estimate.error)
}

/// Probabilities by the names of the classes.
type Classes = Vec<(&'static str, Number)>;

fn classes(outcomes: &Outcomes) -> Classes {
    vec![
        ("rebound", number(outcomes.rebound())),
        ("capture", number(outcomes.capture())),
        ("rebound_sliding", number(outcomes.rebound_sliding())),
        ("rebound_rolling", number(outcomes.rebound_rolling())),
        ("captured_sliding", number(outcomes.captured_sliding())),
        ("captured_rolling", number(outcomes.captured_rolling())),
    ]
}

fn moments(moments: Moments) -> [Number; 3] {
    [moments.mean, moments.variance, moments.skewness].map(number)
}

/// A range of diameters: its edges, the parts of the spheres and of their mass, and the capture efficiency by both.
type Size = ([f64; 4], Number, Number);

/// What a population does.
struct Answer {
    by_number: Classes,
    by_mass: Classes,
    sizes: Vec<Size>,
    bounces: Vec<Number>,
    restitution: [Number; 3],
    restitution_of_rebounds: Option<[Number; 3]>,
}

/// Why there is no answer.
enum Stop {
    Population(PopulationError),
    /// Ctrl-C, or what another signal raises.
    Signal(PyErr),
}

impl From<PopulationError> for Stop {
    fn from(error: PopulationError) -> Self {
        Self::Population(error)
    }
}

impl From<Stop> for PyErr {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Population(PopulationError::Input(error)) => PyValueError::new_err(message(error)),
            Stop::Population(other) => PyValueError::new_err(format!("population: {other}")),
            Stop::Signal(error) => error,
        }
    }
}

/// Lets Python see signals. To be called between integrals, each of which takes up to some seconds.
fn check_signals() -> Result<(), Stop> {
    Python::attach(|python| python.check_signals()).map_err(Stop::Signal)
}

/// The range of diameters between two edges.
fn size<R: Response>(statistics: &Statistics<'_, R>, edges: &[f64]) -> Result<Size, Stop> {
    check_signals()?;
    let (none, [from, to]) = ((f64::NAN, f64::NAN), [edges[0], edges[1]]);
    Ok(statistics.by_size(&[from, to])?.first().map_or(([from, to, 0.0, 0.0], none, none), |bin| {
        ([from, to, bin.number, bin.mass], number(bin.by_number), number(bin.by_mass))
    }))
}

/// The bounce fraction at a speed.
fn bounce<R: Response>(statistics: &Statistics<'_, R>, speed: f64) -> Result<Number, Stop> {
    check_signals()?;
    Ok(number(statistics.at_speed(speed)?.rebound()))
}

impl Answer {
    fn of<R: Response>(
        population: &Population,
        statistics: &Statistics<'_, R>,
        (bins, given, speeds, _): &Questions,
    ) -> Result<Self, Stop> {
        let edges = if given.is_empty() { population.diameter.ranges(*bins) } else { given.clone() };
        let outcomes = statistics.outcomes()?;
        check_signals()?;
        Ok(Self {
            by_number: classes(&outcomes),
            by_mass: classes(&statistics.outcomes_by_mass()?),
            sizes: edges.windows(2).map(|edges| size(statistics, edges)).collect::<Result<_, _>>()?,
            bounces: speeds.iter().map(|speed| bounce(statistics, *speed)).collect::<Result<_, _>>()?,
            restitution: moments(outcomes.restitution()),
            restitution_of_rebounds: outcomes.restitution_of_rebounds().map(moments),
        })
    }

    fn into_dict(self, python: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let answer = PyDict::new(python);
        answer.set_item("by_number", self.by_number)?;
        answer.set_item("by_mass", self.by_mass)?;
        answer.set_item("sizes", self.sizes)?;
        answer.set_item("bounces", self.bounces)?;
        answer.set_item("restitution", self.restitution)?;
        answer.set_item("restitution_of_rebounds", self.restitution_of_rebounds)?;
        Ok(answer)
    }
}
