//! Adhesion by a coefficient.

use super::ReboundAdhesion;
use crate::{InputError, Parameter, Real, RestitutionLaw};

/// Adhesion that cancels the fraction rho of the body's rebound impulse (A14).
///
/// ```
/// use microimpact::rigid::{AdhesionCoefficient, ReboundAdhesion};
///
/// assert_eq!(AdhesionCoefficient::new(0.25)?.departure(3.0, 2.0), 1.5);
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
    fn departure(&self, _approach: T, body_rebound: T) -> T {
        self.remainder * body_rebound
    }

    #[inline]
    fn holding_speed(&self, law: &impl RestitutionLaw<T>, pull: T) -> Option<T> {
        if self.remainder > T::ZERO { law.approach_speed(pull.saturating_div(self.remainder)) } else { None }
    }
}
