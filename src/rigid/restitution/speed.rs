//! A restitution that decreases with speed as in the paper.

use crate::{InputError, Parameter, Real, RestitutionLaw};

/// The law R = k/(k + v): restitution decreases with speed.
///
/// For silver-coated glass on steel, k is about 130 m/s.
///
/// ```
/// use microimpact::{RestitutionLaw, SpeedRestitution};
///
/// let law = SpeedRestitution::new(130.0)?;
/// assert!((law.restitution(2.8) - 0.979_f64).abs() < 0.0005);
/// assert_eq!(law.approach_speed(65.0), Some(130.0));
/// assert_eq!(law.approach_speed(130.0), None);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SpeedRestitution<T> {
    pub(crate) speed: T,
}

impl<T: Real> SpeedRestitution<T> {
    /// Creates a law from k, the `speed` (m/s) at which R is one half.
    ///
    /// # Errors
    /// The value is outside its range.
    ///
    /// ```
    /// assert!(microimpact::SpeedRestitution::new(0.0).is_err());
    /// ```
    #[inline]
    pub fn new(speed: T) -> Result<Self, InputError> {
        Ok(Self { speed: Parameter::RestitutionSpeed.check(speed)? })
    }
}

impl<T: Real> RestitutionLaw<T> for SpeedRestitution<T> {
    #[inline]
    fn restitution(&self, speed: T) -> T {
        self.speed / (self.speed + speed)
    }

    #[inline]
    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        // R(v) v is always below k.
        (body_rebound < self.speed).then(|| body_rebound * (self.speed / (self.speed - body_rebound)))
    }
}
