//! Adhesion as a ring force around the contact.

use core::f64::consts::PI;

use super::hertz::HertzUnits;
use super::{Attraction, Fraction};
use crate::{InputError, NoAdhesion, Parameter, Real, Sphere};

/// The ring force 2 pi f0 a of the paper, with the damping factor 1 - c_A delta' on rebound (B6), c_A = zeta_A C (B5).
///
/// ```
/// use microimpact::contact::Ring;
///
/// assert!(Ring::new(250.0, 6.25).is_ok());
/// assert!(Ring::new(-250.0, 6.25).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Ring<T> {
    /// f0 in N/m or, in units of an impact, p: the energy of the ring is (p/2) s^3.
    pub(crate) strength: T,
    /// zeta_A or, in units of an impact, c_A U.
    pub(crate) damping: T,
}

impl<T: Real> Ring<T> {
    /// A ring of strength f0 >= 0 (N/m) with damping zeta_A >= 0.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::Ring::new(250.0, -1.0).is_err());
    /// ```
    #[inline]
    pub fn new(strength: T, zeta: T) -> Result<Self, InputError> {
        let strength = Parameter::AdhesionStrength.check(strength)?;
        Ok(Self { strength, damping: Parameter::AdhesionDamping.check(zeta)? })
    }
}

/// A ring or no adhesion, on which the dimensionless groups of an impact depend: [`Ring`] or [`NoAdhesion`].
///
/// ```
/// use microimpact::{NoAdhesion, contact::RingStrength};
///
/// assert_eq!(RingStrength::<f32>::strength(&NoAdhesion), 0.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not the adhesion of a ring",
    label = "this needs a scene without adhesion or with a ring"
)]
pub trait RingStrength<T: Real>: Attraction<T> {
    /// Strength p in units of an impact: the energy of the ring is (p/2) s^3.
    fn strength(&self) -> T;
}

impl<T: Real> RingStrength<T> for NoAdhesion {
    #[inline]
    fn strength(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> RingStrength<T> for Ring<T> {
    #[inline]
    fn strength(&self) -> T {
        self.strength
    }
}

impl<T: Real> Attraction<T> for Ring<T> {
    #[inline]
    fn in_units(&self, _sphere: &Sphere<T>, units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self { strength: units.adhesion, damping: Parameter::DampingRatio.check(self.damping * units.damping)? })
    }

    #[inline]
    fn moves_peak(&self) -> bool {
        false
    }

    /// delta_eq = 2 pi f0/K.
    #[inline]
    fn equilibrium(&self, _sphere: &Sphere<T>, stiffness: T) -> T {
        T::constant(2.0 * PI) * self.strength / stiffness
    }

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
    fn mean_slope(&self, p: T, s: T) -> T {
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
    fn energy_drop(&self, peak: T, fraction: &Fraction<T>) -> T {
        T::constant(0.5) * self.strength * peak * peak * peak * fraction.cubic
    }

    #[inline]
    fn loss_over_square(&self, peak: T, _fraction: &Fraction<T>) -> T {
        T::constant(1.5) * self.damping * self.strength * peak * peak
    }

    #[inline]
    fn damping_rate(&self) -> T {
        self.damping
    }
}
