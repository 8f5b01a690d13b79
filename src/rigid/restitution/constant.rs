//! A constant restitution.

use crate::{InputError, Parameter, Real, RestitutionLaw};

/// A law with the same R at every speed.
///
/// ```
/// use microimpact::{ConstantRestitution, RestitutionLaw};
///
/// let law = ConstantRestitution::new(0.5)?;
/// assert_eq!(law.restitution(3.0), 0.5);
/// assert_eq!(law.approach_speed(3.0), Some(6.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConstantRestitution<T> {
    pub(crate) restitution: T,
}

impl<T: Real> ConstantRestitution<T> {
    /// Creates a law from R, 0 to 1.
    ///
    /// # Errors
    /// The value is outside its range.
    ///
    /// ```
    /// assert!(microimpact::ConstantRestitution::new(1.01).is_err());
    /// ```
    #[inline]
    pub fn new(restitution: T) -> Result<Self, InputError> {
        Ok(Self { restitution: Parameter::Restitution.check(restitution)? })
    }
}

impl<T: Real> RestitutionLaw<T> for ConstantRestitution<T> {
    #[inline]
    fn restitution(&self, _speed: T) -> T {
        self.restitution
    }

    #[inline]
    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        (self.restitution > T::ZERO).then(|| body_rebound.saturating_div(self.restitution))
    }
}
