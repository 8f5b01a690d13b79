//! An adhesion that is chosen at run time.

use super::{AdhesionCoefficient, ReboundAdhesion, SpeedAdhesion, WorkOfAdhesion};
use crate::{NoAdhesion, Real, RestitutionLaw};

/// Any adhesion of a rigid body, or none, chosen at run time.
///
/// A rigid body with it gives the results of one with the typed adhesion to the last bit.
///
/// ```
/// use microimpact::rigid::{AdhesionCoefficient, AnyAdhesion};
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let body = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.75)?);
/// let before = NormalMotion::new(1.0)?;
/// let e = |adhesion| body.with_adhesion(adhesion).impact(&before).normal.overall_restitution();
/// assert_eq!(e(AnyAdhesion::None), 0.75);
/// assert_eq!(e(AdhesionCoefficient::new(0.5)?.into()), 0.375);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
#[non_exhaustive]
pub enum AnyAdhesion<T> {
    /// No adhesion.
    None,
    /// A coefficient rho.
    Coefficient(AdhesionCoefficient<T>),
    /// A work W_A.
    Work(WorkOfAdhesion<T>),
    /// A coefficient that decreases with speed.
    Speed(SpeedAdhesion<T>),
}

/// Does the same with the adhesion that is there.
macro_rules! for_adhesion {
    ($self:expr, $adhesion:ident => $result:expr) => {
        match $self {
            Self::None => {
                let $adhesion = NoAdhesion;
                $result
            }
            Self::Coefficient($adhesion) => $result,
            Self::Work($adhesion) => $result,
            Self::Speed($adhesion) => $result,
        }
    };
}

impl<T: Real> ReboundAdhesion<T> for AnyAdhesion<T> {
    fn departure(&self, approach: T, body_rebound: T) -> T {
        for_adhesion!(self, adhesion => adhesion.departure(approach, body_rebound))
    }

    fn holding_speed(&self, law: &impl RestitutionLaw<T>, pull: T) -> Option<T> {
        for_adhesion!(self, adhesion => adhesion.holding_speed(law, pull))
    }
}

/// The choice of a typed adhesion.
macro_rules! choose {
    ($($variant:ident $adhesion:ident)*) => {$(
        impl<T> From<$adhesion<T>> for AnyAdhesion<T> {
            fn from(adhesion: $adhesion<T>) -> Self {
                Self::$variant(adhesion)
            }
        }
    )*};
}

choose! {
    Coefficient AdhesionCoefficient
    Work WorkOfAdhesion
    Speed SpeedAdhesion
}
