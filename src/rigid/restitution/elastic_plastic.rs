//! The restitution of a sphere that yields.

use super::searched_approach_speed;
use crate::{Hertz, InputError, Parameter, Real, RestitutionLaw, Sphere, Stiffness};

/// The law of an elastic, perfectly plastic contact (Thornton 1997): R = 1 up to the yield speed v_y, and beyond it, with
/// y = v_y/v,
///
/// R = (6 sqrt(3)/5)^(1/2) (1 - y^2/6)^(1/2) (y/(y + 2 sqrt(6/5 - y^2/5)))^(1/4).
///
/// R approaches 1.18 (v_y/v)^(1/4) at high speeds. The sphere must stay much larger than the contact: up to about 100 v_y.
///
/// ```
/// use microimpact::{RestitutionLaw, rigid::ElasticPlasticRestitution};
///
/// let law = ElasticPlasticRestitution::new(0.5)?;
/// assert_eq!(law.restitution(0.4), 1.0);
/// assert!((law.restitution(5.0) - 0.658_558_336_665_f64).abs() < 1e-12);
/// assert!((law.approach_speed(5.0 * 0.658_558_336_665).unwrap() - 5.0).abs() < 1e-10);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ElasticPlasticRestitution<T> {
    yield_speed: T,
}

impl<T: Real> ElasticPlasticRestitution<T> {
    /// Creates a law from the yield speed v_y, m/s.
    ///
    /// # Errors
    /// The speed is outside its range.
    ///
    /// ```
    /// assert!(microimpact::rigid::ElasticPlasticRestitution::new(0.0).is_err());
    /// ```
    pub fn new(yield_speed: T) -> Result<Self, InputError> {
        Ok(Self { yield_speed: Parameter::YieldSpeed.check(yield_speed)? })
    }

    /// Creates a law from the contact yield pressure p_y (Pa), by [`Hertz::yield_speed`].
    ///
    /// # Errors
    /// The pressure or the yield speed is outside its range.
    ///
    /// ```
    /// use microimpact::{RestitutionLaw, Sphere, Stiffness, rigid::ElasticPlasticRestitution};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(5e-6, 1050.0)?, Stiffness::new(4.6e9)?);
    /// let law = ElasticPlasticRestitution::from_yield_pressure(&sphere, stiffness, 0.3e9)?;
    /// assert!(law.restitution(100.0_f64) < 1.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn from_yield_pressure(sphere: &Sphere<T>, stiffness: Stiffness<T>, pressure: T) -> Result<Self, InputError> {
        Self::new(Hertz::yield_speed(sphere, stiffness, pressure)?)
    }
}

impl<T: Real> RestitutionLaw<T> for ElasticPlasticRestitution<T> {
    fn restitution(&self, speed: T) -> T {
        if speed <= self.yield_speed {
            return T::ONE;
        }
        let y = self.yield_speed / speed;
        let [one, six, two] = [1.2 * 1.732_050_807_568_877_2, 6.0, 2.0].map(T::constant);
        let square = y * y;
        let elastic = one * (T::ONE - square / six);
        let returned = y / (y + two * ((six - square) / T::constant(5.0)).sqrt());
        // In lanes a sphere yields beside one that does not.
        speed.where_above(self.yield_speed, (elastic.sqrt() * returned.sqrt().sqrt()).min(T::ONE), T::ONE)
    }

    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        if body_rebound <= self.yield_speed {
            return Some(body_rebound);
        }
        searched_approach_speed(self, body_rebound)
    }
}
