//! What a model says of the impacts of a population.

use microimpact::contact::{Adaptive, Contact, ContactLaw, Impulses, Status};
use microimpact::measure::Classifiable;
use microimpact::rigid::ReboundAdhesion;
use microimpact::{
    Coulomb, CriticalSpeed, InputError, NormalMotion, ObliqueMotion, Outcome, RestitutionLaw, RigidBody,
};

use crate::PopulationError;

/// A rebound of a sphere that does not spin before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// Overall restitution.
    pub restitution: f64,
    /// Tangent of the largest angle of incidence at which friction stops the slip.
    pub stopped: f64,
}

/// A model of impacts as a function of the diameter, of a parameter of adhesion, and of the normal speed.
pub trait Response {
    /// Critical speed along the normal, m/s. Spheres that are not faster are captured.
    ///
    /// # Errors
    /// The model refuses the sphere or does not converge.
    fn critical_speed(&self, diameter: f64, adhesion: f64) -> Result<CriticalSpeed<f64>, PopulationError>;

    /// The rebound at a speed above the critical speed.
    ///
    /// # Errors
    /// The model refuses the impact or does not converge.
    fn rebound(&self, diameter: f64, adhesion: f64, speed: f64) -> Result<Rebound, PopulationError>;

    /// Tangent of the largest angle of incidence at which friction stops the slip of a captured sphere.
    ///
    /// # Errors
    /// The model refuses the sphere.
    fn stopped_in_capture(&self, diameter: f64, adhesion: f64) -> Result<f64, PopulationError>;
}

/// The rigid-body model; the function makes the scene of a sphere from its diameter (m) and the parameter of adhesion.
pub struct RigidBodies<F>(pub F);

/// The contact simulation; the function makes the scene of a sphere from its diameter (m) and the parameter of adhesion.
pub struct Simulations<F> {
    /// Makes the scene, without friction.
    pub scene: F,
    /// Coulomb's coefficient of friction.
    pub friction: f64,
    /// Method of the simulation.
    pub method: Adaptive<f64>,
}

/// A motion along the normal.
fn along_normal(speed: f64) -> Result<ObliqueMotion<f64>, InputError> {
    NormalMotion::new(speed)?.with_tangential(0.0)
}

/// The tangent that goes with a slip that friction stops, at a speed; infinite if it stops every slip.
fn tangent(stopped: Option<f64>, speed: f64) -> f64 {
    stopped.map_or(f64::INFINITY, |slip| slip / speed)
}

/// A speed at which the relative slip that friction stops in a capture is asked for: it does not depend on the speed.
const ANY_SPEED: f64 = 1.0;

impl<F, L, A> Response for RigidBodies<F>
where
    F: Fn(f64, f64) -> Result<RigidBody<f64, L, A, Coulomb<f64>>, InputError>,
    L: RestitutionLaw<f64>,
    A: ReboundAdhesion<f64>,
{
    fn critical_speed(&self, diameter: f64, adhesion: f64) -> Result<CriticalSpeed<f64>, PopulationError> {
        Ok((self.0)(diameter, adhesion)?.critical_speed())
    }

    fn rebound(&self, diameter: f64, adhesion: f64, speed: f64) -> Result<Rebound, PopulationError> {
        let (scene, motion) = ((self.0)(diameter, adhesion)?, along_normal(speed)?);
        let restitution = scene.impact(&motion).normal.overall_restitution();
        let stopped = (scene, motion).stopped_slip(speed, Outcome::Rebound)?;
        Ok(Rebound { restitution, stopped: tangent(stopped, speed) })
    }

    fn stopped_in_capture(&self, diameter: f64, adhesion: f64) -> Result<f64, PopulationError> {
        let impact = ((self.0)(diameter, adhesion)?, along_normal(ANY_SPEED)?);
        Ok(tangent(impact.stopped_slip(ANY_SPEED, Outcome::Capture)?, ANY_SPEED))
    }
}

impl<F, L> Response for Simulations<F>
where
    F: Fn(f64, f64) -> Result<Contact<f64, L>, InputError>,
    L: ContactLaw<f64>,
{
    fn critical_speed(&self, diameter: f64, adhesion: f64) -> Result<CriticalSpeed<f64>, PopulationError> {
        Ok((self.scene)(diameter, adhesion)?.critical_speed(&self.method)?)
    }

    fn rebound(&self, diameter: f64, adhesion: f64, speed: f64) -> Result<Rebound, PopulationError> {
        let (scene, motion) = ((self.scene)(diameter, adhesion)?, NormalMotion::new(speed)?);
        let (impact, impulses) = scene.solve_for(&motion, &self.method, Impulses)?;
        if impact.run.status != Status::Solved {
            return Err(PopulationError::NotConverged { diameter, speed });
        }
        // Friction is proportional to the elastic force (B8); it acts on the slip through the contact's inertia (A27).
        let sphere = scene.sphere();
        let change = self.friction * impulses.elastic / (sphere.mass() * sphere.contact_inertia());
        Ok(Rebound { restitution: impact.normal.overall_restitution(), stopped: change / speed })
    }

    fn stopped_in_capture(&self, diameter: f64, adhesion: f64) -> Result<f64, PopulationError> {
        let scene = (self.scene)(diameter, adhesion)?.with_friction(self.friction)?;
        let impact = (scene, along_normal(ANY_SPEED)?, &self.method);
        Ok(tangent(impact.stopped_slip(ANY_SPEED, Outcome::Capture)?, ANY_SPEED))
    }
}
