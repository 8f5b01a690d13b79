//! A restitution law that is chosen at run time.

use super::{
    ConstantRestitution, ElasticPlasticRestitution, PowerRestitution, SpeedRestitution, ViscoelasticRestitution,
};
use crate::{Real, RestitutionLaw};

/// Any restitution law with a formula, chosen at run time.
///
/// A rigid body with it gives the results of one with the typed law to the last bit. It serves programs and stored
/// configurations; firmware that names a typed law contains no code of the others.
///
/// ```
/// use microimpact::rigid::{AnyRestitution, PowerRestitution};
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let laws: [AnyRestitution<f64>; 2] =
///     [ConstantRestitution::new(0.9)?.into(), PowerRestitution::new(2.0, 0.5)?.into()];
/// let restitution = laws.map(|law| NormalMotion::new(2.0).map(|before| {
///     RigidBody::new(sphere, law).impact(&before).normal.overall_restitution()
/// }));
/// assert_eq!(restitution, [Ok(0.9), Ok(0.5)]);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
#[non_exhaustive]
pub enum AnyRestitution<T> {
    /// The same at every speed.
    Constant(ConstantRestitution<T>),
    /// R = k/(k + v).
    Speed(SpeedRestitution<T>),
    /// R = k^p/(k^p + v^p).
    Power(PowerRestitution<T>),
    /// That of an elastic-plastic sphere.
    ElasticPlastic(ElasticPlasticRestitution<T>),
    /// That of a viscoelastic sphere.
    Viscoelastic(ViscoelasticRestitution<T>),
}

/// Does the same with the law that is there.
macro_rules! for_law {
    ($self:expr, $law:ident => $result:expr) => {
        match $self {
            Self::Constant($law) => $result,
            Self::Speed($law) => $result,
            Self::Power($law) => $result,
            Self::ElasticPlastic($law) => $result,
            Self::Viscoelastic($law) => $result,
        }
    };
}

impl<T: Real> RestitutionLaw<T> for AnyRestitution<T> {
    fn restitution(&self, speed: T) -> T {
        for_law!(self, law => law.restitution(speed))
    }

    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        for_law!(self, law => law.approach_speed(body_rebound))
    }
}

/// The choice of a typed law.
macro_rules! choose {
    ($($variant:ident $law:ident)*) => {$(
        impl<T> From<$law<T>> for AnyRestitution<T> {
            fn from(law: $law<T>) -> Self {
                Self::$variant(law)
            }
        }
    )*};
}

choose! {
    Constant ConstantRestitution
    Speed SpeedRestitution
    Power PowerRestitution
    ElasticPlastic ElasticPlasticRestitution
    Viscoelastic ViscoelasticRestitution
}
