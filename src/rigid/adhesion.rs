//! Adhesion in the rigid-body model.

use crate::{InputError, NoAdhesion, Parameter, Real, Sphere};

/// An adhesion term: how adhesion slows the rebound.
///
/// Without adhesion, the sphere would leave with the body rebound speed R v.
///
/// ```
/// use microimpact::{NoAdhesion, rigid::ReboundAdhesion};
///
/// assert_eq!(NoAdhesion.departure(1.5), 1.5);
/// ```
pub trait ReboundAdhesion<T> {
    /// Speed after adhesion has acted, m/s: (1 - rho) R v. It is zero if adhesion holds the sphere.
    fn departure(&self, body_rebound: T) -> T;

    /// Largest body rebound speed (m/s) for which the departure speed is at most `pull` (m/s, zero or positive).
    ///
    /// `None` if adhesion holds every rebound.
    fn holding_speed(&self, pull: T) -> Option<T>;
}

impl<T: Real> ReboundAdhesion<T> for NoAdhesion {
    #[inline]
    fn departure(&self, body_rebound: T) -> T {
        body_rebound
    }

    #[inline]
    fn holding_speed(&self, pull: T) -> Option<T> {
        Some(pull)
    }
}

/// Adhesion that cancels the fraction rho of the body's rebound impulse (A14).
///
/// ```
/// use microimpact::rigid::{AdhesionCoefficient, ReboundAdhesion};
///
/// assert_eq!(AdhesionCoefficient::new(0.25)?.departure(2.0), 1.5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct AdhesionCoefficient<T> {
    pub(crate) remainder: T,
}

impl<T: Real> AdhesionCoefficient<T> {
    /// Creates adhesion from its coefficient rho: 0 means no adhesion, and 1 means capture.
    ///
    /// # Errors
    /// The value is outside its range.
    ///
    /// ```
    /// assert!(microimpact::rigid::AdhesionCoefficient::new(-0.1).is_err());
    /// ```
    #[inline]
    pub fn new(coefficient: T) -> Result<Self, InputError> {
        Ok(Self { remainder: T::ONE - Parameter::AdhesionCoefficient.check(coefficient)? })
    }
}

impl<T: Real> ReboundAdhesion<T> for AdhesionCoefficient<T> {
    #[inline]
    fn departure(&self, body_rebound: T) -> T {
        self.remainder * body_rebound
    }

    #[inline]
    fn holding_speed(&self, pull: T) -> Option<T> {
        (self.remainder > T::ZERO).then(|| pull.saturating_div(self.remainder))
    }
}

/// Adhesion that takes a fixed work W_A from the rebound: e^2 = R^2 - B, where B = 2 W_A/(m v_n^2) (A33, A34).
///
/// ```
/// use microimpact::{Sphere, rigid::{ReboundAdhesion, WorkOfAdhesion}};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let adhesion = WorkOfAdhesion::new(sphere.mass() * 9.0 / 2.0, &sphere)?;
/// assert_eq!(adhesion.departure(5.0), 4.0);
/// assert_eq!(adhesion.departure(3.0), 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WorkOfAdhesion<T> {
    /// Rebound speed whose energy equals the work of adhesion, sqrt(2 W_A/m), m/s.
    pub(crate) speed: T,
}

impl<T: Real> WorkOfAdhesion<T> {
    /// Creates adhesion from its `work` W_A (J, zero or positive) on a given `sphere`.
    ///
    /// # Errors
    /// The value is outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, rigid::WorkOfAdhesion};
    ///
    /// assert!(WorkOfAdhesion::new(-1e-12, &Sphere::solid(1e-6, 1000.0)?).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(work: T, sphere: &Sphere<T>) -> Result<Self, InputError> {
        let work = Parameter::WorkOfAdhesion.check(work)?;
        Ok(Self { speed: (T::constant(2.0) * work / sphere.mass()).sqrt() })
    }
}

impl<T: Real> ReboundAdhesion<T> for WorkOfAdhesion<T> {
    #[inline]
    fn departure(&self, body_rebound: T) -> T {
        if body_rebound <= self.speed {
            return T::ZERO;
        }
        // A difference of squares loses digits close to capture. The product of the factors does not.
        (body_rebound - self.speed).geometric_mean(body_rebound + self.speed)
    }

    #[inline]
    fn holding_speed(&self, pull: T) -> Option<T> {
        let held = if pull > T::ZERO { (self.speed * self.speed + pull * pull).sqrt() } else { self.speed };
        Some(held)
    }
}
