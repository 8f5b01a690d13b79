//! Spheres, laws and terms that `serde` reads: their numbers are checked like those that a program gives.
//!
//! A type is read in the form in which it is written. Where that form is a number that was computed, its own range is checked.

use core::fmt;

use serde::de::{Deserialize, Deserializer, Error};

use crate::contact::{
    Compliance, ConstantDamping, ConstantForce, Dmt, HertzLaw, HystereticDamping, JkrEnd, JkrLaw, Peeling, Ring,
    TotalAndPullOff, TotalForce, Unloading, ViscoelasticDamping,
};
use crate::rigid::{
    AdhesionCoefficient, ElasticPlasticRestitution, Microforce, PowerRestitution, RollingDissipation, SpeedAdhesion,
    ViscoelasticRestitution, WorkOfAdhesion,
};
use crate::{ConstantRestitution, Coulomb, InputError, Parameter, Real, SpeedRestitution, Sphere, Stiffness};

/// Why a value was refused.
enum Refused {
    Input(InputError),
    /// A computed number outside its range, which begins at zero.
    Computed {
        name: &'static str,
        value: f64,
        largest: f64,
    },
}

impl From<InputError> for Refused {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(formatter),
            Self::Computed { name, value, largest } => {
                write!(formatter, "{name} is {value:e}, but must be 0 to {largest:e}; store the scene again")
            }
        }
    }
}

/// A bound of numbers that have none but infinity. Single precision represents it.
const UNBOUNDED: f64 = 1e38;

/// alpha of a constant damping that leaves no restitution: the root of five.
const CRITICAL: f64 = 2.236_067_977_499_79;

/// A computed number of zero to a largest value.
fn computed<T: Real>(name: &'static str, value: T, largest: f64) -> Result<T, Refused> {
    // Both comparisons fail for NaN.
    if value >= T::ZERO && value <= T::constant(largest) {
        Ok(value)
    } else {
        Err(Refused::Computed { name, value: value.to_f64(), largest })
    }
}

/// Reads the fields of a type, all of which are written, and makes it of them.
macro_rules! read {
    ($(<T $(, $parameter:ident)*> $type:ty { $($field:ident: $read:ty),+ } $made:block)+) => {$(
        const _: () = {
            #[derive(serde::Deserialize)]
            struct Read<T: Real $(, $parameter)*> {
                $($field: $read),+
            }

            impl<'de, T: Real + Deserialize<'de> $(, $parameter: Deserialize<'de>)*> Deserialize<'de> for $type {
                fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
                    let Read { $($field),+ } = Read::<T $(, $parameter)*>::deserialize(reader)?;
                    let made = || -> Result<Self, Refused> { Ok($made) };
                    made().map_err(R::Error::custom)
                }
            }
        };
    )+};
}

read! {
    // The contact inertia follows from the gyration ratio.
    <T> Sphere<T> { radius: T, density: T, gyration_ratio: T, contact_inertia: T } {
        let _ = contact_inertia;
        Self::new(radius, density, gyration_ratio)?
    }
    <T, P> Coulomb<T, P> { coefficient: T, pressing: P } { Coulomb::new(coefficient)?.under(pressing) }

    <T, D, A, X> HertzLaw<T, D, A, X> { stiffness: T, damping: D, adhesion: A, force: X } {
        Self { stiffness: Stiffness::new(stiffness)?.pascals(), damping, adhesion, force }
    }
    // The last three are zero in a law that is not in units of an impact.
    <T, D> JkrLaw<T, D> { stiffness: T, adhesion: T, damping: D, end: JkrEnd, first: T, last: T, offset: T } {
        let _ = (first, last, offset);
        JkrLaw::new(Stiffness::new(stiffness)?, adhesion)?.ending_at(end).damped(damping)
    }
    <T> HystereticDamping<T> { rate: T } { Self::new(rate)? }
    <T> ViscoelasticDamping<T> { time: T } { Self::new(time)? }
    <T> ConstantDamping<T> { alpha: T } {
        Self { alpha: computed("alpha of a constant damping", alpha, CRITICAL)? }
    }
    <T> Ring<T> { strength: T, damping: T } { Self::new(strength, damping)? }
    <T> Dmt<T> { strength: T } { Self::new(strength)? }
    <T> ConstantForce<T> { force: T } { Self::new(force)? }
    <T> Peeling<T> { friction: Coulomb<T>, lambda: T } { Self::new(friction, lambda)? }
    <T> Compliance<T> { friction: Coulomb<T>, stiffness_ratio: T, unloading: Unloading } {
        Self::new(friction, stiffness_ratio)?.with_unloading(unloading)
    }
    <T> TotalForce<T> { balance: T } {
        let _ = balance;
        Self::new()
    }
    <T> TotalAndPullOff<T> { pull_off: T } {
        let _ = pull_off;
        Self::new()
    }

    <T> ConstantRestitution<T> { restitution: T } { Self::new(restitution)? }
    <T> SpeedRestitution<T> { speed: T } { Self::new(speed)? }
    <T> PowerRestitution<T> { speed: T, power: T } { Self::new(speed, power)? }
    <T> ElasticPlasticRestitution<T> { yield_speed: T } { Self::new(yield_speed)? }
    <T> ViscoelasticRestitution<T> { strength: T } {
        Self { strength: computed("strength of a viscoelastic restitution", strength, UNBOUNDED)? }
    }
    <T> AdhesionCoefficient<T> { remainder: T } {
        Self { remainder: computed("one less the adhesion coefficient", remainder, 1.0)? }
    }
    <T> WorkOfAdhesion<T> { speed: T } {
        Self { speed: computed("speed that a work of adhesion stops, m/s,", speed, UNBOUNDED)? }
    }
    <T> SpeedAdhesion<T> { speed: T, power: T } { Self::new(speed, power)? }
    <T> RollingDissipation<T> { friction: Coulomb<T>, ratio: T } {
        Self { friction, ratio: computed("rolling-dissipation arm over the radius", ratio, UNBOUNDED)? }
    }
    <T> Microforce<T> { approach: T, rebound: T } {
        Self { approach: Parameter::VelocityChange.check(approach)?, rebound: Parameter::VelocityChange.check(rebound)? }
    }
}
