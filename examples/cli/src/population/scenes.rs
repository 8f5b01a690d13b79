//! The scenes of a row.

use microimpact::contact::{Adaptive, Contact};
use microimpact::rigid::{AnyRestitution, ReboundAdhesion};
use microimpact::{Coulomb, InputError, Parameter, RigidBody, Sphere};
use population::{Distribution, Population, PopulationError, Questions, Results, RigidBodies, Simulations, Statistics};
use sheet::{Input, Row};

use super::Model;
use super::distributions::{DIAMETER, Quantity, RING, SPEED, SampleFiles, WORK, WORK_PER_AREA, angles};
use crate::contact_law::{LAW_INPUTS, RING_INPUT, RowLaw, WORK_INPUT};
use crate::inputs::{DENSITY_INPUT, FRICTION_INPUT, GYRATION_INPUT, POWER_INPUT, RESTITUTION_INPUT, restitution_law};

/// The ways to give adhesion to a rigid body that have no distribution.
const ADHESION: Input = Input::further(&["adhesion_coefficient", "adhesion_speed_m_s", "adhesion_power"]);

/// The columns that give the scenes, besides the distributions.
pub(super) fn inputs(model: Model) -> Vec<Input> {
    let mut inputs = vec![DENSITY_INPUT, GYRATION_INPUT, FRICTION_INPUT];
    match model {
        Model::Simulation => {
            inputs.extend(LAW_INPUTS.iter().filter(|input| !matches!(**input, RING_INPUT | WORK_INPUT)));
        }
        Model::RigidBody => inputs.extend([RESTITUTION_INPUT, POWER_INPUT, ADHESION]),
    }
    inputs
}

/// What both models read.
struct Spheres {
    diameter: Distribution,
    speed: Distribution,
    angle: Distribution,
    density: f64,
    gyration: f64,
    friction: f64,
}

impl Spheres {
    fn read(row: &Row<'_>, samples: &SampleFiles) -> Result<Self, String> {
        let checked = |parameter: Parameter, value: f64| parameter.check(value).map_err(|error| row.reason(error));
        Ok(Self {
            diameter: DIAMETER.required(row, samples)?,
            speed: SPEED.required(row, samples)?,
            angle: angles(row, samples)?,
            density: checked(Parameter::Density, row.required("density_kg_m3")?)?,
            gyration: checked(Parameter::GyrationRatio, row.number("gyration_ratio")?.unwrap_or(0.4))?,
            friction: checked(Parameter::Friction, row.or_zero("friction")?)?,
        })
    }

    fn population(&self, adhesion: Distribution) -> Population {
        let Self { diameter, speed, angle, .. } = self;
        Population { diameter: diameter.clone(), adhesion, angle: angle.clone(), speed: speed.clone() }
    }

    fn sphere(&self, diameter: f64) -> Result<Sphere<f64>, InputError> {
        Sphere::new(0.5 * diameter, self.density, self.gyration)
    }
}

/// Why there are no statistics, in terms of the row.
fn refused<'a>(row: &'a Row<'a>) -> impl Fn(PopulationError) -> String + 'a {
    move |error| match error {
        PopulationError::Input(error) => row.reason(error),
        other => other.to_string(),
    }
}

/// Adhesion that does not vary.
fn none(value: f64) -> Result<Distribution, String> {
    Distribution::fixed(value).map_err(|error| error.to_string())
}

/// The row with the median of a distribution, where there is one.
fn typical<'a>(row: &Row<'a>, quantity: &Quantity, distribution: &Option<Distribution>) -> Option<Row<'a>> {
    let median = distribution.as_ref()?.quantile(0.5);
    Some(row.with(quantity.column(), median))
}

/// The statistics of a row by the contact simulation.
pub(super) fn simulations(
    row: &Row<'_>,
    samples: &SampleFiles,
    questions: &Questions,
    method: Adaptive<f64>,
) -> Result<Results, String> {
    let spheres = Spheres::read(row, samples)?;
    let ring = RING.read(row, samples)?;
    let work = WORK_PER_AREA.read(row, samples)?;
    // The law is read from the medians, so that it refuses what does not go with it.
    let with_ring = typical(row, &RING, &ring);
    let row_of_ring = with_ring.as_ref().unwrap_or(row);
    let with_work = typical(row_of_ring, &WORK_PER_AREA, &work);
    let law = RowLaw::<f64>::read(with_work.as_ref().unwrap_or(row_of_ring))?;
    let adhesion = match (ring, work) {
        (Some(ring), None) => ring,
        (None, Some(work)) => work,
        (None, None) => none(0.0)?,
        // One of the two is zero, which the law has checked.
        (Some(ring), Some(work)) => {
            if law.has_ring() {
                ring
            } else {
                work
            }
        }
    };
    let population = spheres.population(adhesion);
    let scene =
        |diameter: f64, adhesion: f64| Ok(Contact::new(spheres.sphere(diameter)?, law.with_adhesion(adhesion).law()?));
    let simulations = Simulations { scene, friction: spheres.friction, method };
    Statistics::interpolated(&population, &simulations, &questions.speeds(&population))
        .and_then(|statistics| Results::of(&population, &statistics, questions))
        .map_err(refused(row))
}

/// The statistics of a row by the rigid-body model.
pub(super) fn rigid_bodies(row: &Row<'_>, samples: &SampleFiles, questions: &Questions) -> Result<Results, String> {
    let spheres = Spheres::read(row, samples)?;
    let law = restitution_law(row, |number: f64| number)?;
    let coefficient: Option<f64> = row.number("adhesion_coefficient")?;
    let speed: Option<f64> = row.number("adhesion_speed_m_s")?;
    let power = row.number("adhesion_power")?;
    if power.is_some() && speed.is_none() {
        return Err("adhesion_power: adhesion_speed_m_s is missing; give it too or leave the cell empty".into());
    }
    let body = |diameter: f64| Ok::<_, InputError>(RigidBody::new(spheres.sphere(diameter)?, law));
    match (WORK.read(row, samples)?, coefficient, speed) {
        (None, None, None) => of_bodies(row, questions, &spheres, none(0.0)?, |diameter, _| {
            body(diameter)?.with_friction(spheres.friction)
        }),
        (Some(work), None, None) => of_bodies(row, questions, &spheres, work, |diameter, work| {
            body(diameter)?.with_work_of_adhesion(work)?.with_friction(spheres.friction)
        }),
        (None, Some(coefficient), None) => of_bodies(row, questions, &spheres, none(coefficient)?, |diameter, rho| {
            body(diameter)?.with_adhesion_coefficient(rho)?.with_friction(spheres.friction)
        }),
        (None, None, Some(speed)) => of_bodies(row, questions, &spheres, none(speed)?, |diameter, speed| {
            body(diameter)?.with_adhesion_at_speed(speed, power.unwrap_or(1.0))?.with_friction(spheres.friction)
        }),
        _ => {
            let columns = "work_of_adhesion_j, adhesion_coefficient and adhesion_speed_m_s";
            Err(format!("adhesion: given twice; of {columns} leave all but one empty"))
        }
    }
}

fn of_bodies<A: ReboundAdhesion<f64>>(
    row: &Row<'_>,
    questions: &Questions,
    spheres: &Spheres,
    adhesion: Distribution,
    body: impl Fn(f64, f64) -> Result<RigidBody<f64, AnyRestitution<f64>, A, Coulomb<f64>>, InputError>,
) -> Result<Results, String> {
    let (population, bodies) = (spheres.population(adhesion), RigidBodies(body));
    let statistics = Statistics::direct(&population, &bodies);
    Results::of(&population, &statistics, questions).map_err(refused(row))
}
