//! What happens along the surface: nothing, Coulomb's friction, or friction with a peeling moment or with compliance.

mod compliance;
mod coulomb;
mod motion;
mod peeling;
mod pressing;
mod relaxation;

pub use compliance::{Compliance, CompliantMotion, CompliantVelocities, Unloading};
pub use coulomb::TangentialVelocities;
pub use motion::TangentialMotion;
pub use peeling::Peeling;
pub use pressing::{PressingForce, TotalAndPullOff, TotalForce};

use super::law::{ContactLaw, Units};
use super::solve::observer::Observer;
use super::solve::path::NormalPath;
use crate::{InputError, NoFriction, Real, Sphere};

/// What happens along the surface, to a sphere that arrives with a motion `B`.
///
/// Without friction any motion will do, and nothing is computed. With friction the motion has to have a tangential velocity.
///
/// ```
/// use microimpact::contact::Surface;
/// use microimpact::{NoFriction, NormalMotion};
///
/// type Observer = <NoFriction as Surface<f32, NormalMotion<f32>>>::Observer;
/// assert_eq!(size_of::<Observer>(), 0);
/// ```
#[diagnostic::on_unimplemented(
    message = "a scene with `{Self}` does not take a motion `{B}`",
    label = "friction needs a tangential velocity, `.with_tangential(v_t)?`; a peeling moment goes with planar motions only"
)]
pub trait Surface<T: Real, B>: Copy {
    /// The state before contact, in units of the impact.
    type Start;

    /// What follows the motion along the surface.
    type Observer: Observer<T>;

    /// Velocities after the impact: `()` without friction, else [`TangentialVelocities`], or [`CompliantVelocities`] with compliance.
    type After;

    /// The state before contact.
    ///
    /// # Errors
    /// A ratio of forces that cannot be represented.
    fn start<L: ContactLaw<T>>(
        &self,
        before: &B,
        sphere: &Sphere<T>,
        law: &L,
        units: &Units<T>,
    ) -> Result<Self::Start, InputError>;

    /// An observer that starts from this state.
    fn observer(start: &Self::Start) -> Self::Observer;

    /// Velocities after the impact, in SI units.
    fn after(observer: &Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Units<T>) -> Self::After;
}

/// State along the surface before contact, in units of the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipStart<T, P, const PEELS: bool> {
    friction: T,
    /// The force that presses.
    pressing: P,
    gyration_ratio: T,
    velocity: T,
    peripheral: T,
    /// Rate at which the peeling moment slows the spin at contact radius 1.
    peeling: T,
}

#[diagnostic::do_not_recommend]
impl<T: Real, B> Surface<T, B> for NoFriction {
    type Start = ();
    type Observer = ();
    type After = ();

    #[inline]
    fn start<L: ContactLaw<T>>(&self, _: &B, _: &Sphere<T>, _: &L, _: &Units<T>) -> Result<(), InputError> {
        Ok(())
    }

    #[inline]
    fn observer((): &()) {}

    #[inline]
    fn after((): &(), _: &NormalPath<T>, _: &Sphere<T>, _: &Units<T>) {}
}
