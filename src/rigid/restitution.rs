//! Restitution laws: the kinetic restitution R of the materials, without adhesion (A11).

use crate::{InputError, Parameter, Real};

/// A restitution law: how the kinetic restitution R depends on the approach speed v.
///
/// You can implement your own law. R must be between 0 and 1, and R(v) v must not decrease with v, so that one critical speed
/// separates capture from rebound.
///
/// ```
/// use microimpact::{ConstantRestitution, CriticalSpeed, NormalMotion, RestitutionLaw, RigidBody, Sphere};
///
/// /// R = (v_y/v)^(1/4) above the speed v_y = 1 m/s, at which the material starts to yield.
/// struct Yielding;
///
/// impl RestitutionLaw<f64> for Yielding {
///     fn restitution(&self, speed: f64) -> f64 {
///         speed.max(1.0).powf(-0.25)
///     }
///
///     fn approach_speed(&self, body_rebound: f64) -> Option<f64> {
///         Some(if body_rebound < 1.0 { body_rebound } else { body_rebound.powf(4.0 / 3.0) })
///     }
/// }
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, Yielding);
/// assert_eq!(scene.impact(&NormalMotion::new(16.0)?).normal.overall_restitution(), 0.5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait RestitutionLaw<T> {
    /// Kinetic restitution R at an approach `speed` (m/s).
    fn restitution(&self, speed: T) -> T;

    /// Approach speed v (m/s) for which R(v) v is `body_rebound` (m/s). `None` if no speed is fast enough.
    fn approach_speed(&self, body_rebound: T) -> Option<T>;
}

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
