//! Restitution laws: the kinetic restitution R of the materials, without adhesion (A11).

mod chosen;
mod constant;
mod elastic_plastic;
mod power;
mod speed;
mod tabulated;
mod viscoelastic;

use crate::Real;
use crate::numbers::inverse;

pub use chosen::AnyRestitution;
pub use constant::ConstantRestitution;
pub use elastic_plastic::ElasticPlasticRestitution;
pub use power::PowerRestitution;
pub use speed::SpeedRestitution;
pub use tabulated::TabulatedRestitution;
pub use viscoelastic::ViscoelasticRestitution;

/// A restitution law: how the kinetic restitution R depends on the approach speed v.
///
/// You can implement your own law. R must be between 0 and 1, and R(v) v must not decrease with v, so that one critical speed
/// separates capture from rebound.
///
/// ```
/// use microimpact::{ConstantRestitution, CriticalSpeed, NormalMotion, RestitutionLaw, RigidBody, Sphere};
///
/// /// R = (v_y/v)^(1/4) above the speed v_y = 1 m/s, at which the material starts to yield.
/// struct Yielding;
///
/// impl RestitutionLaw<f64> for Yielding {
///     fn restitution(&self, speed: f64) -> f64 {
///         speed.max(1.0).powf(-0.25)
///     }
///
///     fn approach_speed(&self, body_rebound: f64) -> Option<f64> {
///         Some(if body_rebound < 1.0 { body_rebound } else { body_rebound.powf(4.0 / 3.0) })
///     }
/// }
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, Yielding);
/// assert_eq!(scene.impact(&NormalMotion::new(16.0)?).normal.overall_restitution(), 0.5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait RestitutionLaw<T> {
    /// Kinetic restitution R at an approach `speed` (m/s).
    fn restitution(&self, speed: T) -> T;

    /// Approach speed v (m/s), the largest one, for which R(v) v is `body_rebound` (m/s). `None` if no speed is fast enough.
    fn approach_speed(&self, body_rebound: T) -> Option<T>;
}

/// The approach speed of a law that has no formula for it. R is at most one, so that the speed is no less than the rebound.
fn searched_approach_speed<T: Real>(law: &impl RestitutionLaw<T>, body_rebound: T) -> Option<T> {
    inverse(|speed| law.restitution(speed) * speed, body_rebound, body_rebound)
}
