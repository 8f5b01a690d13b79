//! A restitution that decreases with a power of the speed.

use super::searched_approach_speed;
use crate::numbers::power;
use crate::{InputError, Parameter, Real, RestitutionLaw};

/// The law R = k^p/(k^p + v^p) (Brach and Dunn 1992), of which [`SpeedRestitution`](crate::SpeedRestitution) is the case p = 1.
///
/// With p above one R(v) v would decrease at high speeds, and fast spheres would be captured again: p is at most one.
///
/// ```
/// use microimpact::{RestitutionLaw, rigid::PowerRestitution};
///
/// let law = PowerRestitution::new(100.0, 0.5)?;
/// assert!((law.restitution(100.0) - 0.5_f64).abs() < 1e-15);
/// assert!((law.restitution(4.0) - 1.0 / 1.2).abs() < 1e-15);
/// assert!((law.approach_speed(50.0).unwrap() - 100.0).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PowerRestitution<T> {
    speed: T,
    power: T,
}

impl<T: Real> PowerRestitution<T> {
    /// Creates a law from k, the `speed` (m/s) at which R is one half, and the `power` p, 0.01 to 1.
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// assert!(microimpact::rigid::PowerRestitution::new(100.0, 1.5).is_err());
    /// ```
    pub fn new(speed: T, power: T) -> Result<Self, InputError> {
        Ok(Self { speed: Parameter::RestitutionSpeed.check(speed)?, power: Parameter::RestitutionPower.check(power)? })
    }
}

impl<T: Real> RestitutionLaw<T> for PowerRestitution<T> {
    fn restitution(&self, speed: T) -> T {
        T::ONE / (T::ONE + power(speed / self.speed, self.power))
    }

    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        searched_approach_speed(self, body_rebound)
    }
}
