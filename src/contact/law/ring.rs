//! Adhesion as a ring force around the contact.

use super::law::Attraction;
use super::nodes::Share;
use crate::{InputError, Parameter, Real};

/// The ring force 2 pi f0 a of the paper, with the damping factor 1 - c_A delta' on rebound (B6), c_A = zeta_A C (B5).
///
/// ```
/// use microimpact::simulation::Ring;
///
/// assert!(Ring::new(250.0, 6.25).is_ok());
/// assert!(Ring::new(-250.0, 6.25).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Ring<T> {
    pub(super) strength: T,
    pub(super) zeta: T,
}

impl<T: Real> Ring<T> {
    /// A ring of strength f0 >= 0 (N/m) with damping zeta_A >= 0.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::simulation::Ring::new(250.0, -1.0).is_err());
    /// ```
    #[inline]
    pub fn new(strength: T, zeta: T) -> Result<Self, InputError> {
        let strength = Parameter::AdhesionStrength.check(strength)?;
        Ok(Self { strength, zeta: Parameter::AdhesionDamping.check(zeta)? })
    }
}

/// The ring in units of the motion: its energy is (p/2) s^3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledRing<T> {
    /// p = (5/3) of the equilibrium indentation.
    pub(super) strength: T,
    /// c_A in units of the inverse speed unit.
    pub(super) damping: T,
}

impl<T: Real> Attraction<T> for ScaledRing<T> {
    const PRESENT: bool = true;

    #[inline]
    fn energy(&self, s: T) -> T {
        T::constant(0.5) * self.strength * s * s * s
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        T::constant(1.5) * self.strength * s * s
    }

    #[inline]
    fn curvature(&self, s: T) -> T {
        T::constant(3.0) * self.strength * s
    }

    #[inline]
    fn divided(&self, p: T, s: T) -> T {
        T::constant(0.5) * self.strength * (p * p + p * s + s * s)
    }

    #[inline]
    fn force(&self, s: T) -> T {
        T::constant(0.75) * self.strength * s
    }

    #[inline]
    fn damping(&self, s: T) -> T {
        self.damping * self.force(s)
    }

    #[inline]
    fn fall(&self, peak: T, share: &Share<T>) -> T {
        T::constant(0.5) * self.strength * peak * peak * peak * share.cubic
    }

    #[inline]
    fn loss_over_square(&self, peak: T, _share: &Share<T>) -> T {
        T::constant(1.5) * self.damping * self.strength * peak * peak
    }

    #[inline]
    fn damping_rate(&self) -> T {
        self.damping
    }
}
