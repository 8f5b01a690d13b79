//! Adhesion that weakens with speed.

use super::ReboundAdhesion;
use crate::numbers::{inverse, power};
use crate::{InputError, Parameter, Real, RestitutionLaw};

/// Adhesion with a coefficient that decreases with the approach speed, rho = l^q/(l^q + v^q) (Brach and Dunn 1992).
///
/// A sphere always rebounds, however slowly, unless a microforce holds it.
///
/// ```
/// use microimpact::rigid::{ReboundAdhesion, SpeedAdhesion};
///
/// let adhesion = SpeedAdhesion::new(0.5, 2.0)?;
/// assert!((adhesion.departure(0.5, 0.4) - 0.2_f64).abs() < 1e-15);
/// assert!((adhesion.departure(1.0, 0.8) - 0.64).abs() < 1e-15);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SpeedAdhesion<T> {
    speed: T,
    power: T,
}

impl<T: Real> SpeedAdhesion<T> {
    /// Creates adhesion from l, the `speed` (m/s) at which rho is one half, and the `power` q, 0.01 to 16.
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// assert!(microimpact::rigid::SpeedAdhesion::new(0.5, 0.0).is_err());
    /// ```
    pub fn new(speed: T, power: T) -> Result<Self, InputError> {
        Ok(Self { speed: Parameter::AdhesionSpeed.check(speed)?, power: Parameter::AdhesionPower.check(power)? })
    }
}

impl<T: Real> ReboundAdhesion<T> for SpeedAdhesion<T> {
    fn departure(&self, approach: T, body_rebound: T) -> T {
        // 1 - rho
        body_rebound / (T::ONE + power(self.speed.saturating_div(approach), self.power))
    }

    fn holding_speed(&self, law: &impl RestitutionLaw<T>, pull: T) -> Option<T> {
        if pull <= T::ZERO {
            return Some(T::ZERO);
        }
        let unslowed = law.approach_speed(pull)?;
        inverse(|speed| self.departure(speed, law.restitution(speed) * speed), pull, unslowed)
    }
}
