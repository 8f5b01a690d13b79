//! Dissipation in the materials.

use super::law::Damping;
use crate::{InputError, Parameter, Real};

/// No damping: the materials are elastic.
///
/// ```
/// assert_eq!(size_of::<microimpact::simulation::NoDamping>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoDamping;

/// Damping of Hunt and Crossley: the elastic force times 1 + c_H delta' (B1), with c_H = zeta_H C (B4).
///
/// ```
/// use microimpact::simulation::HystereticDamping;
///
/// assert!(HystereticDamping::new(10.5).is_ok());
/// assert!(HystereticDamping::new(-1.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HystereticDamping<T> {
    pub(super) zeta: T,
}

impl<T: Real> HystereticDamping<T> {
    /// Damping of strength zeta_H >= 0.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::simulation::HystereticDamping::new(f64::NAN).is_err());
    /// ```
    #[inline]
    pub fn new(zeta: T) -> Result<Self, InputError> {
        Ok(Self { zeta: Parameter::MaterialDamping.check(zeta)? })
    }
}

/// c_H in units of the inverse speed unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledDamping<T>(pub(super) T);

impl<T: Real> Damping<T> for NoDamping {
    #[inline]
    fn rate(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> Damping<T> for ScaledDamping<T> {
    #[inline]
    fn rate(&self) -> T {
        self.0
    }
}
