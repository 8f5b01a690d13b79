//! Adhesion in the rigid-body model, one term a file.

mod chosen;
mod coefficient;
mod speed;
mod work;

pub use chosen::AnyAdhesion;
pub use coefficient::AdhesionCoefficient;
pub use speed::SpeedAdhesion;
pub use work::{WorkOfAdhesion, image_charge_energy};

use crate::{NoAdhesion, Real, RestitutionLaw};

/// An adhesion term: how adhesion slows the rebound.
///
/// Without adhesion, a sphere that approaches at v would leave with the body rebound speed R v.
///
/// ```
/// use microimpact::{NoAdhesion, rigid::ReboundAdhesion};
///
/// assert_eq!(NoAdhesion.departure(2.0, 1.5), 1.5);
/// ```
pub trait ReboundAdhesion<T> {
    /// Speed after adhesion has acted, (1 - rho) R v, from the `approach` speed v and the body rebound speed R v, m/s. It is zero
    /// if adhesion holds the sphere.
    fn departure(&self, approach: T, body_rebound: T) -> T;

    /// Largest approach speed for which the departure speed under a restitution `law` is at most `pull` (zero or positive), m/s.
    ///
    /// `None` if every rebound is as slow.
    fn holding_speed(&self, law: &impl RestitutionLaw<T>, pull: T) -> Option<T>;
}

impl<T: Real> ReboundAdhesion<T> for NoAdhesion {
    #[inline]
    fn departure(&self, _approach: T, body_rebound: T) -> T {
        body_rebound
    }

    #[inline]
    fn holding_speed(&self, law: &impl RestitutionLaw<T>, pull: T) -> Option<T> {
        law.approach_speed(pull)
    }
}
