//! A constant external force along the normal.

use super::hertz::HertzUnits;
use super::{Attraction, Fraction};
use crate::{InputError, Parameter, Real, Sphere};

/// No external force.
///
/// ```
/// assert_eq!(size_of::<microimpact::contact::NoForce>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoForce;

/// A constant external force, positive out of the surface.
///
/// ```
/// use microimpact::contact::ConstantForce;
///
/// assert!(ConstantForce::new(-1e-9).is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConstantForce<T> {
    /// The force out of the surface in N or, in units of an impact, the force into it.
    force: T,
}

impl<T: Real> ConstantForce<T> {
    /// A force in N.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::ConstantForce::new(f32::INFINITY).is_err());
    /// ```
    #[inline]
    pub fn new(force: T) -> Result<Self, InputError> {
        Ok(Self { force: Parameter::ExternalForce.check(force)? })
    }

    /// A force into the surface, in units of an impact.
    #[inline]
    pub(super) fn inwards(force: T) -> Self {
        Self { force }
    }
}

impl<T: Real> Attraction<T> for NoForce {
    #[inline]
    fn in_units(&self, _sphere: &Sphere<T>, _units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self)
    }

    #[inline]
    fn is_absent(&self) -> bool {
        true
    }

    #[inline]
    fn moves_peak(&self) -> bool {
        false
    }
}

impl<T: Real> Attraction<T> for ConstantForce<T> {
    #[inline]
    fn in_units(&self, sphere: &Sphere<T>, units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self { force: Parameter::ForceRatio.check(-units.force(self.force, sphere))? })
    }

    #[inline]
    fn energy(&self, s: T) -> T {
        self.force * s * s
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        T::constant(2.0) * self.force * s
    }

    #[inline]
    fn curvature(&self, _s: T) -> T {
        T::constant(2.0) * self.force
    }

    #[inline]
    fn mean_slope(&self, p: T, s: T) -> T {
        self.force * (p + s)
    }

    #[inline]
    fn energy_drop(&self, peak: T, fraction: &Fraction<T>) -> T {
        self.force * peak * peak * (T::ONE + fraction.value)
    }

    #[inline]
    fn force(&self, _s: T) -> T {
        self.force
    }
}
