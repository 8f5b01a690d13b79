//! Microforces other than adhesion, such as gravity or an electric field: known external impulses along the normal.

use crate::{InputError, Parameter, Real, Sphere};

/// A microforce term: how external impulses change the normal motion.
///
/// Per unit mass, an impulse is a change of velocity (m/s).
///
/// ```
/// use microimpact::rigid::{MicroforceTerm, NoMicroforce};
///
/// assert_eq!(NoMicroforce.body_approach(2.0), 2.0);
/// assert_eq!(NoMicroforce.rebound(1.5), 1.5);
/// ```
pub trait MicroforceTerm<T> {
    /// Whether it acts at all.
    const ACTS: bool = true;

    /// Part of the approach `speed` that the body has to stop (A5).
    fn body_approach(&self, speed: T) -> T;

    /// Approach speed for which the body has to stop `body_approach`: the inverse of [`body_approach`](Self::body_approach).
    fn approach_speed(&self, body_approach: T) -> T;

    /// Rebound speed of a sphere with the speed `departure` after body and adhesion (A8). It is zero if the microforce holds
    /// the sphere.
    fn rebound(&self, departure: T) -> T;

    /// Largest departure speed that the microforce stops, zero or more. `None` if it pushes the sphere away.
    fn pull(&self) -> Option<T>;
}

/// No external microforce.
///
/// ```
/// assert_eq!(size_of::<microimpact::rigid::NoMicroforce>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoMicroforce;

impl<T: Real> MicroforceTerm<T> for NoMicroforce {
    const ACTS: bool = false;

    #[inline]
    fn body_approach(&self, speed: T) -> T {
        speed
    }

    #[inline]
    fn approach_speed(&self, body_approach: T) -> T {
        body_approach
    }

    #[inline]
    fn rebound(&self, departure: T) -> T {
        departure
    }

    #[inline]
    fn pull(&self) -> Option<T> {
        Some(T::ZERO)
    }
}

/// External impulses during approach and rebound, positive out of the surface.
///
/// If an impulse would stop the approach before the body does, only the part up to that point acts. If an impulse stops the
/// rebound, it acts until the sphere rests, and the sphere is captured.
///
/// ```
/// use microimpact::{Sphere, rigid::{Microforce, MicroforceTerm}};
///
/// let sphere = Sphere::solid(1e-3, 1000.0)?;
/// let field = Microforce::from_impulses(0.25 * sphere.mass(), -0.5 * sphere.mass(), &sphere)?;
/// assert_eq!(field.body_approach(1.0), 0.75);
/// assert_eq!(field.rebound(0.25), 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Microforce<T> {
    pub(crate) approach: T,
    pub(crate) rebound: T,
}

impl<T: Real> Microforce<T> {
    /// Creates a microforce from its impulses during `approach` and `rebound` (N s) on a given `sphere`.
    ///
    /// # Errors
    /// An impulse, or the change of velocity by it, is outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, rigid::Microforce};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert!(Microforce::from_impulses(0.0, f64::NAN, &sphere).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn from_impulses(approach: T, rebound: T, sphere: &Sphere<T>) -> Result<Self, InputError> {
        let change_of_velocity = |impulse| {
            let impulse = Parameter::ExternalImpulse.check(impulse)?;
            Parameter::VelocityChange.check(impulse / sphere.mass())
        };
        Ok(Self { approach: change_of_velocity(approach)?, rebound: change_of_velocity(rebound)? })
    }
}

impl<T: Real> MicroforceTerm<T> for Microforce<T> {
    #[inline]
    fn body_approach(&self, speed: T) -> T {
        (speed - self.approach).max(T::ZERO)
    }

    #[inline]
    fn approach_speed(&self, body_approach: T) -> T {
        body_approach + self.approach
    }

    #[inline]
    fn rebound(&self, departure: T) -> T {
        (departure + self.rebound).max(T::ZERO)
    }

    #[inline]
    fn pull(&self) -> Option<T> {
        (self.rebound <= T::ZERO).then(|| -self.rebound)
    }
}
