//! Laws that are chosen at run time: one type, and so one copy of the solver, for all of them.

use super::hertz::HertzUnits;
use super::{Attraction, ConstantForce, ContactLaw, Damping, Fraction, HertzLaw, HystereticDamping, Ring, Units};
use crate::{InputError, NoAdhesion, Real, Sphere, Stiffness};

/// Any law of contact, chosen at run time.
///
/// A scene with it gives the results of a scene with the typed law to the last bit. It serves programs and stored
/// configurations; firmware that names a typed law contains no code of the others.
///
/// ```
/// use microimpact::contact::{Adaptive, AnyLaw, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let (sphere, stiffness) = (Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let (method, before) = (Adaptive::new(1e-9)?, NormalMotion::new(2.8)?);
/// let mut restitutions = Vec::new();
/// for law in [AnyLaw::hertz(stiffness), AnyLaw::ring(stiffness, 250.0, 6.25)?] {
///     let scene = Contact::new(sphere, law.with_damping(10.5)?);
///     restitutions.push(scene.solve(&before, &method)?.normal.overall_restitution());
/// }
/// let typed = Contact::hertz(sphere, stiffness).with_damping(10.5)?;
/// assert_eq!(restitutions[0], typed.solve(&before, &method)?.normal.overall_restitution());
/// assert!((restitutions[1] - 0.746193_f64).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum AnyLaw<T> {
    /// Hertz's contact without adhesion.
    Hertz(HertzLaw<T, AnyDamping<T>, NoAdhesion, AnyForce<T>>),
    /// Hertz's contact with the paper's ring of adhesion.
    Ring(HertzLaw<T, AnyDamping<T>, Ring<T>, AnyForce<T>>),
}

impl<T: Real> AnyLaw<T> {
    /// Hertz's contact, with nothing else.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(matches!(AnyLaw::hertz(Stiffness::new(1e10)?), AnyLaw::Hertz(_)));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn hertz(stiffness: Stiffness<T>) -> Self {
        Self::Hertz(HertzLaw {
            stiffness: stiffness.pascals(),
            damping: AnyDamping::None,
            adhesion: NoAdhesion,
            force: AnyForce::None,
        })
    }

    /// Hertz's contact with a ring force of strength f0 >= 0 (N/m) and its damping zeta_A >= 0 on rebound.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::ring(Stiffness::new(1e10)?, -1.0, 0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn ring(stiffness: Stiffness<T>, strength: T, zeta: T) -> Result<Self, InputError> {
        Ok(Self::Ring(HertzLaw {
            stiffness: stiffness.pascals(),
            damping: AnyDamping::None,
            adhesion: Ring::new(strength, zeta)?,
            force: AnyForce::None,
        }))
    }

    /// The same law with hysteretic damping of strength zeta_H >= 0 in the materials.
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::hertz(Stiffness::new(1e10)?).with_damping(f64::NAN).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_damping(mut self, zeta: T) -> Result<Self, InputError> {
        let damping = AnyDamping::Hysteretic(HystereticDamping::new(zeta)?);
        match &mut self {
            Self::Hertz(law) => law.damping = damping,
            Self::Ring(law) => law.damping = damping,
        }
        Ok(self)
    }

    /// The same law with a constant external force, N, positive out of the surface.
    ///
    /// # Errors
    /// A force outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::hertz(Stiffness::new(1e10)?).with_external_force(f64::NAN).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_external_force(mut self, force: T) -> Result<Self, InputError> {
        let force = AnyForce::Constant(ConstantForce::new(force)?);
        match &mut self {
            Self::Hertz(law) => law.force = force,
            Self::Ring(law) => law.force = force,
        }
        Ok(self)
    }
}

/// Any damping of the materials, chosen at run time.
///
/// ```
/// use microimpact::contact::{AnyDamping, Damping};
///
/// assert_eq!(AnyDamping::<f64>::None.rate(), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum AnyDamping<T> {
    /// Elastic materials.
    None,
    /// Damping of Hunt and Crossley.
    Hysteretic(HystereticDamping<T>),
}

impl<T: Real> Damping<T> for AnyDamping<T> {
    fn in_units(&self, unit: T) -> Result<Self, InputError> {
        match self {
            Self::None => Ok(Self::None),
            Self::Hysteretic(damping) => damping.in_units(unit).map(Self::Hysteretic),
        }
    }

    #[inline]
    fn rate(&self) -> T {
        match self {
            Self::None => T::ZERO,
            Self::Hysteretic(damping) => damping.rate(),
        }
    }
}

/// An external force or none, chosen at run time.
///
/// ```
/// use microimpact::contact::{AnyForce, Attraction};
///
/// assert!(!AnyForce::<f64>::None.is_present());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum AnyForce<T> {
    /// No external force.
    None,
    /// A constant force.
    Constant(ConstantForce<T>),
}

/// Passes a call on to the variant that is there; without a force it gives zero.
macro_rules! of_force {
    ($($function:ident($($argument:ident: $type:ty),*);)*) => {
        $(
            #[inline]
            fn $function(&self, $($argument: $type),*) -> T {
                match self {
                    Self::None => T::ZERO,
                    Self::Constant(force) => force.$function($($argument),*),
                }
            }
        )*
    };
}

impl<T: Real> Attraction<T> for AnyForce<T> {
    fn in_units(&self, sphere: &Sphere<T>, units: &HertzUnits<T>) -> Result<Self, InputError> {
        match self {
            Self::None => Ok(Self::None),
            Self::Constant(force) => force.in_units(sphere, units).map(Self::Constant),
        }
    }

    #[inline]
    fn is_present(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    of_force! {
        energy(s: T);
        slope(s: T);
        curvature(s: T);
        mean_slope(p: T, s: T);
        force(s: T);
        energy_drop(peak: T, fraction: &Fraction<T>);
    }
}

/// Passes a call on to the law that is there.
macro_rules! of_law {
    ($($function:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        $(
            #[inline]
            fn $function(&self, $($argument: $type),*) -> $result {
                match self {
                    Self::Hertz(law) => law.$function($($argument),*),
                    Self::Ring(law) => law.$function($($argument),*),
                }
            }
        )*
    };
}

impl<T: Real> ContactLaw<T> for AnyLaw<T> {
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError> {
        match self {
            Self::Hertz(law) => law.in_units(sphere, approach).map(|(law, units)| (Self::Hertz(law), units)),
            Self::Ring(law) => law.in_units(sphere, approach).map(|(law, units)| (Self::Ring(law), units)),
        }
    }

    of_law! {
        loss_power() -> u32;
        potential(s: T) -> T;
        slope(s: T) -> T;
        curvature(s: T) -> T;
        mean_slope(p: T, s: T) -> T;
        elastic_force(s: T) -> T;
        material_damping(s: T) -> T;
        adhesion_force(s: T) -> T;
        adhesion_damping(s: T) -> T;
        adhesion_damping_rate() -> T;
        indentation(s: T) -> T;
        indentation_slope(s: T) -> T;
        coordinate(indentation: T) -> Option<T>;
        contact_radius(s: T) -> T;
        start() -> T;
        end() -> T;
        may_have_barrier() -> bool;
        energy_power() -> f64;
        speed_of_adhesion(sphere: &Sphere<T>) -> T;
        duration(energy: T) -> T;
        conservative_force(s: T) -> T;
        damping(s: T, rebound: bool) -> T;
        loss(s: T, rebound: bool) -> T;
        potential_drop(peak: T, fraction: &Fraction<T>) -> T;
        loss_over_square(peak: T, fraction: &Fraction<T>, rebound: bool) -> T;
    }
}
