//! Dissipation in the materials.

use crate::{InputError, Parameter, Real};

/// Damping of the elastic force, in SI units or, as [`in_units`](Self::in_units) gives it, in units of an impact.
///
/// ```
/// use microimpact::contact::{Damping, NoDamping};
///
/// assert_eq!(Damping::<f32>::rate(&NoDamping), 0.0);
/// ```
pub trait Damping<T: Real>: Copy {
    /// The damping in units of an impact in which the strength zeta = 1 is the rate `unit`.
    ///
    /// # Errors
    /// A ratio of forces that cannot be represented.
    fn in_units(&self, unit: T) -> Result<Self, InputError>;

    /// Fraction of the elastic force that is added for each unit of speed.
    fn rate(&self) -> T;
}

/// No damping: the materials are elastic.
///
/// ```
/// assert_eq!(size_of::<microimpact::contact::NoDamping>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoDamping;

/// Damping of Hunt and Crossley: the elastic force times 1 + c_H delta' (B1), with c_H = zeta_H C (B4).
///
/// ```
/// use microimpact::contact::HystereticDamping;
///
/// assert!(HystereticDamping::new(10.5).is_ok());
/// assert!(HystereticDamping::new(-1.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HystereticDamping<T> {
    /// zeta_H or, in units of an impact, c_H U.
    pub(crate) rate: T,
}

impl<T: Real> HystereticDamping<T> {
    /// Damping of strength zeta_H >= 0.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::HystereticDamping::new(f64::NAN).is_err());
    /// ```
    #[inline]
    pub fn new(zeta: T) -> Result<Self, InputError> {
        Ok(Self { rate: Parameter::MaterialDamping.check(zeta)? })
    }
}

impl<T: Real> Damping<T> for NoDamping {
    #[inline]
    fn in_units(&self, _unit: T) -> Result<Self, InputError> {
        Ok(Self)
    }

    #[inline]
    fn rate(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> Damping<T> for HystereticDamping<T> {
    #[inline]
    fn in_units(&self, unit: T) -> Result<Self, InputError> {
        Ok(Self { rate: Parameter::DampingRatio.check(self.rate * unit)? })
    }

    #[inline]
    fn rate(&self) -> T {
        self.rate
    }
}
