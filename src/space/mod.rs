//! Impacts in space: on a wall of any direction that may move, and between two spheres.
//!
//! Both models are planar. In three dimensions an impact still takes place in a plane, that of the normal and the slip of the contact
//! point: friction acts against the slip and turns the sphere about the axis across the plane, so that the direction of the slip never
//! changes. Nothing else changes either: not the velocity across the plane, nor the spin about the normal and about the slip.
//!
//! So a [`Wall`] or a [`Pair`] turns a [`SpatialMotion`] into an incidence, which is a planar motion and goes wherever one goes; the
//! incidence turns the result back into motions in space.

mod motion;
mod pair;
mod plane;
mod vector;
mod wall;

pub use motion::SpatialMotion;
pub use pair::{Pair, PairIncidence};
pub use wall::{Wall, WallIncidence};

use crate::contact::{CompliantVelocities, SimulatedImpact, TangentialVelocities};
use crate::rigid::{Departure, Impact, TangentialImpact};
use crate::{Fault, InputError, NormalMotion, Outcome, Parameter, Real};

/// The result of an impact of either model, from which the motion after it follows.
///
/// ```
/// use microimpact::space::Departing;
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.5)?);
/// let after = scene.impact(&NormalMotion::new(2.0)?).departure(3.0).unwrap();
/// assert_eq!((after.normal, after.tangential), (1.0, 3.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait Departing<T> {
    /// Velocities after the impact of a sphere with a tangential velocity, which it keeps without friction. A captured sphere has no
    /// normal velocity. `None` where the outcome is not known.
    fn departure(&self, tangential: T) -> Option<Departure<T>>;
}

impl<T: Real> Departing<T> for Impact<T, ()> {
    fn departure(&self, tangential: T) -> Option<Departure<T>> {
        Some(Departure { normal: self.normal.rebound_speed(), tangential })
    }
}

impl<T: Real> Departing<T> for Impact<T, TangentialImpact<T>> {
    fn departure(&self, _tangential: T) -> Option<Departure<T>> {
        Some(Departure { normal: self.normal.rebound_speed(), tangential: self.tangential.velocity() })
    }
}

impl<T: Real> Departing<T> for SimulatedImpact<T, ()> {
    fn departure(&self, tangential: T) -> Option<Departure<T>> {
        with_tangential(self, tangential)
    }
}

impl<T: Real> Departing<T> for SimulatedImpact<T, TangentialVelocities<T>> {
    fn departure(&self, _tangential: T) -> Option<Departure<T>> {
        with_tangential(self, self.tangential.velocity())
    }
}

impl<T: Real> Departing<T> for SimulatedImpact<T, CompliantVelocities<T>> {
    fn departure(&self, _tangential: T) -> Option<Departure<T>> {
        with_tangential(self, self.tangential.velocity())
    }
}

/// The velocities after a simulated impact whose outcome is known.
fn with_tangential<T: Real, V>(impact: &SimulatedImpact<T, V>, tangential: T) -> Option<Departure<T>> {
    let decided = impact.normal.outcome().filter(|outcome| *outcome != Outcome::Undecided);
    decided.map(|_| Departure { normal: impact.normal.rebound_speed(), tangential })
}

/// The motion along the normal of two bodies that approach with a speed.
#[inline]
fn approach<T: Real>(speed: T) -> Result<NormalMotion<T>, InputError> {
    if speed <= T::ZERO {
        let value = speed.to_f64() as f32;
        return Err(InputError { parameter: Parameter::ApproachSpeed, fault: Fault::Receding, value });
    }
    NormalMotion::new(speed)
}
