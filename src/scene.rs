//! Which physics takes part in an impact, as types: an absent term has size zero and no code.

use crate::{InputError, Parameter, Real};

/// No adhesion: nothing holds the sphere back on rebound.
///
/// ```
/// assert_eq!(size_of::<microimpact::NoAdhesion>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoAdhesion;

/// No friction: the tangential motion and the spin stay as they are and are neither read nor computed.
///
/// ```
/// assert_eq!(size_of::<microimpact::NoFriction>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoFriction;

/// Coulomb's friction between sphere and surface.
///
/// ```
/// use microimpact::Coulomb;
///
/// assert_eq!(Coulomb::new(0.1)?.coefficient(), 0.1);
/// assert!(Coulomb::new(-0.1).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Coulomb<T> {
    pub(crate) coefficient: T,
}

impl<T: Real> Coulomb<T> {
    /// Friction with coefficient f >= 0.
    ///
    /// # Errors
    /// A coefficient outside its range.
    ///
    /// ```
    /// assert!(microimpact::Coulomb::new(f32::INFINITY).is_err());
    /// ```
    #[inline]
    pub fn new(coefficient: T) -> Result<Self, InputError> {
        Ok(Self { coefficient: Parameter::Friction.check(coefficient)? })
    }

    /// Coefficient f.
    ///
    /// ```
    /// assert_eq!(microimpact::Coulomb::new(0.25)?.coefficient(), 0.25);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn coefficient(&self) -> T {
        self.coefficient
    }
}
