//! A constant external force along the normal.

use super::law::Attraction;
use super::nodes::Share;
use crate::{InputError, Parameter, Real};

/// No external force.
///
/// ```
/// assert_eq!(size_of::<microimpact::simulation::NoForce>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoForce;

/// A constant external force, positive out of the surface.
///
/// ```
/// use microimpact::simulation::ConstantForce;
///
/// assert!(ConstantForce::new(-1e-9).is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConstantForce<T> {
    pub(super) force: T,
}

impl<T: Real> ConstantForce<T> {
    /// A force in N.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::simulation::ConstantForce::new(f32::INFINITY).is_err());
    /// ```
    #[inline]
    pub fn new(force: T) -> Result<Self, InputError> {
        Ok(Self { force: Parameter::ExternalForce.check(force)? })
    }
}

/// The force into the surface in units of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledForce<T>(pub(super) T);

impl<T: Real> Attraction<T> for NoForce {
    const PRESENT: bool = false;
}

impl<T: Real> Attraction<T> for ScaledForce<T> {
    const PRESENT: bool = true;

    #[inline]
    fn energy(&self, s: T) -> T {
        self.0 * s * s
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        T::constant(2.0) * self.0 * s
    }

    #[inline]
    fn curvature(&self, _s: T) -> T {
        T::constant(2.0) * self.0
    }

    #[inline]
    fn divided(&self, p: T, s: T) -> T {
        self.0 * (p + s)
    }

    #[inline]
    fn fall(&self, peak: T, share: &Share<T>) -> T {
        self.0 * peak * peak * (T::ONE + share.radius)
    }

    #[inline]
    fn force(&self, _s: T) -> T {
        self.0
    }
}
