//! Impacts in space: on a wall of any direction that may move, and between two spheres.
//!
//! Both models are planar. In three dimensions an impact still takes place in a plane, that of the normal and the slip of the contact
//! point: friction acts against the slip and turns the sphere about the axis across the plane, so that the direction of the slip never
//! changes. Nothing else changes either: not the velocity across the plane, nor the spin about the normal and about the slip.
//!
//! So a [`Wall`] or a [`Pair`] turns a [`SpatialMotion`] into an incidence, which is a planar motion and goes wherever one goes; the
//! incidence turns the result back into motions in space.
//!
//! ```
//! use microimpact::contact::{Adaptive, Contact};
//! use microimpact::space::{Pair, SpatialMotion};
//! use microimpact::{Material, Sphere, Stiffness};
//!
//! // Two glass beads with damping, friction, and a contact that gives sideways.
//! let glass = Material::new(7e10, 0.22)?;
//! let beads = [Sphere::solid(1e-3, 2500.0)?, Sphere::solid(2e-3, 2500.0)?];
//! let pair = Pair::new(beads[0], beads[1]);
//! let scene = Contact::hertz(pair.reduced(), Stiffness::between(&glass, &glass)?)
//!     .with_damping(5.0)?
//!     .with_friction(0.2)?
//!     .with_compliance(Stiffness::tangential_ratio_between(&glass, &glass))?;
//! let motions = [
//!     SpatialMotion::new([0.5, 0.2, -1.0], [0.0, 100.0, 0.0])?,
//!     SpatialMotion::new([0.0, 0.0, 0.5], [50.0, 0.0, 0.0])?,
//! ];
//! let before = pair.incidence([0.0, 0.0, 1.0], [&motions[0], &motions[1]])?;
//! let after = before.after(&scene.solve(&before, &Adaptive::new(1e-9)?)?).ok_or("undecided")?;
//! let energy = |motions: &[SpatialMotion<f64>; 2]| motions[0].energy(&beads[0]) + motions[1].energy(&beads[1]);
//! assert!(energy(&after) < energy(&motions) && after[0].velocity()[2] > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::space::Departing;
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let impact = scene.solve(&NormalMotion::new(1.0)?.with_tangential(5.0)?, &Adaptive::new(1e-9)?)?;
    /// assert!((impact.departure(5.0).unwrap().tangential - 4.8_f64).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
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
        // Without the sign of a zero.
        let value = (speed + T::ZERO).to_f64() as f32;
        return Err(InputError { parameter: Parameter::ApproachSpeed, fault: Fault::Receding, value });
    }
    NormalMotion::new(speed)
}
