//! Terms that both models share. The type of a scene tells which terms take part. An absent term has size zero and no code.

use crate::{InputError, Parameter, Real};

/// No adhesion.
///
/// ```
/// assert_eq!(size_of::<microimpact::NoAdhesion>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoAdhesion;

/// No friction: the models neither read nor compute tangential velocity and spin.
///
/// ```
/// assert_eq!(size_of::<microimpact::NoFriction>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoFriction;

/// The elastic force alone, to which Coulomb's friction is proportional in the paper (B8).
///
/// ```
/// assert_eq!(size_of::<microimpact::contact::ElasticForce>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ElasticForce;

/// Coulomb friction between sphere and surface. The rigid body knows only the impulse of the normal force; in the simulation friction
/// is proportional to the [`PressingForce`](crate::contact::PressingForce) `P`.
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
pub struct Coulomb<T, P = ElasticForce> {
    pub(crate) coefficient: T,
    pub(crate) pressing: P,
}

impl<T: Real> Coulomb<T> {
    /// Creates friction with the `coefficient` f, zero or positive.
    ///
    /// # Errors
    /// The coefficient is outside its range.
    ///
    /// ```
    /// assert!(microimpact::Coulomb::new(f32::INFINITY).is_err());
    /// ```
    #[inline]
    pub fn new(coefficient: T) -> Result<Self, InputError> {
        let parameter = if T::IS_FIXED_POINT { Parameter::FixedPointFriction } else { Parameter::Friction };
        Ok(Self { coefficient: parameter.check(coefficient)?, pressing: ElasticForce })
    }
}

impl<T: Real, P> Coulomb<T, P> {
    /// The same friction, proportional to another force.
    #[inline]
    pub(crate) fn under<Q>(self, pressing: Q) -> Coulomb<T, Q> {
        Coulomb { coefficient: self.coefficient, pressing }
    }

    /// Friction coefficient f.
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
