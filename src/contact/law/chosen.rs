//! Laws that are chosen at run time: one type, and so one copy of the solver, for all of them.

use super::hertz::HertzUnits;
use super::{
    Attraction, ConstantDamping, ConstantForce, ContactLaw, Damping, Dmt, Fraction, HertzLaw, HystereticDamping,
    JkrEnd, JkrLaw, NoDamping, NoTension, Ring, Units, ViscoelasticDamping,
};
use crate::{Fault, InputError, NoAdhesion, Parameter, Real, Sphere, Stiffness};

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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
#[non_exhaustive]
pub enum AnyLaw<T> {
    /// Hertz's contact without adhesion.
    Hertz(HertzLaw<T, AnyDamping<T>, NoAdhesion, AnyForce<T>>),
    /// Hertz's contact with the paper's ring of adhesion.
    Ring(HertzLaw<T, AnyDamping<T>, Ring<T>, AnyForce<T>>),
    /// Hertz's contact with the adhesion of Derjaguin, Muller and Toporov.
    Dmt(HertzLaw<T, AnyDamping<T>, Dmt<T>, AnyForce<T>>),
    /// Hertz's contact without adhesion, which ends where damping cancels the elastic force.
    WithoutTension(HertzLaw<T, AnyDamping<T>, NoTension>),
    /// The contact of Johnson, Kendall and Roberts.
    Jkr(JkrLaw<T, AnyDamping<T>>),
}

/// Does the same with the law that is there, and with its variant.
macro_rules! for_law {
    ($self:expr, $variant:ident, $law:ident => $result:expr) => {
        match $self {
            AnyLaw::Hertz($law) => for_law!(Hertz, $variant => $result),
            AnyLaw::Ring($law) => for_law!(Ring, $variant => $result),
            AnyLaw::Dmt($law) => for_law!(Dmt, $variant => $result),
            AnyLaw::WithoutTension($law) => for_law!(WithoutTension, $variant => $result),
            AnyLaw::Jkr($law) => for_law!(Jkr, $variant => $result),
        }
    };
    ($name:ident, $variant:ident => $result:expr) => {{
        let $variant = Self::$name;
        $result
    }};
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
        Self::Hertz(plain(stiffness, NoAdhesion))
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
        Ok(Self::Ring(plain(stiffness, Ring::new(strength, zeta)?)))
    }

    /// Hertz's contact with the adhesion of Derjaguin, Muller and Toporov, of a work of adhesion G >= 0, J/m^2.
    ///
    /// # Errors
    /// A work outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::dmt(Stiffness::new(1e10)?, -0.1).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn dmt(stiffness: Stiffness<T>, work: T) -> Result<Self, InputError> {
        Ok(Self::Dmt(plain(stiffness, Dmt::new(work)?)))
    }

    /// The contact of Johnson, Kendall and Roberts with a work of adhesion G >= 0, J/m^2.
    ///
    /// # Errors
    /// A work outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::{AnyLaw, JkrEnd}};
    ///
    /// assert!(AnyLaw::jkr(Stiffness::new(1e10)?, -0.1, JkrEnd::SnapOff).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn jkr(stiffness: Stiffness<T>, work: T, end: JkrEnd) -> Result<Self, InputError> {
        Ok(Self::Jkr(JkrLaw::new(stiffness, work)?.ending_at(end).damped(AnyDamping::None)))
    }

    /// Hertz's contact without adhesion, which ends where damping cancels the elastic force.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::without_tension(Stiffness::new(1e10)?).with_external_force(1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn without_tension(stiffness: Stiffness<T>) -> Self {
        Self::WithoutTension(HertzLaw::new(stiffness).without_tension().damped(AnyDamping::None))
    }

    fn damped(self, damping: AnyDamping<T>) -> Self {
        for_law!(self, variant, law => variant(law.damped(damping)))
    }

    /// The same law with hysteretic damping of strength zeta_H >= 0 in the materials. [`HystereticDamping`] says how zeta_H
    /// relates to a damping constant in s/m.
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
    pub fn with_damping(self, zeta: T) -> Result<Self, InputError> {
        Ok(self.damped(AnyDamping::Hysteretic(HystereticDamping::new(zeta)?)))
    }

    /// The same law with viscoelastic damping of the relaxation time A >= 0, s.
    ///
    /// # Errors
    /// A time outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::hertz(Stiffness::new(1e10)?).with_viscoelastic_damping(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_viscoelastic_damping(self, time: T) -> Result<Self, InputError> {
        Ok(self.damped(AnyDamping::Viscoelastic(ViscoelasticDamping::new(time)?)))
    }

    /// The same law with damping that, without adhesion, leaves a restitution e at every speed.
    ///
    /// # Errors
    /// A restitution outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::AnyLaw};
    ///
    /// assert!(AnyLaw::hertz(Stiffness::new(1e10)?).with_constant_damping(0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_constant_damping(self, restitution: T) -> Result<Self, InputError> {
        Ok(self.damped(AnyDamping::Constant(ConstantDamping::new(restitution)?)))
    }

    /// The same law with a constant external force, N, positive out of the surface.
    ///
    /// # Errors
    /// A force outside its range, or not zero where the law takes none.
    ///
    /// ```
    /// use microimpact::{Fault, Stiffness, contact::{AnyLaw, JkrEnd}};
    ///
    /// let stiffness = Stiffness::new(1e10)?;
    /// assert!(AnyLaw::hertz(stiffness).with_external_force(f64::NAN).is_err());
    /// let refused = AnyLaw::jkr(stiffness, 0.1, JkrEnd::SnapOff)?.with_external_force(1e-9).unwrap_err();
    /// assert_eq!(refused.fault, Fault::OtherLaw);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_external_force(mut self, force: T) -> Result<Self, InputError> {
        let constant = AnyForce::Constant(ConstantForce::new(force)?);
        match &mut self {
            Self::Hertz(law) => law.force = constant,
            Self::Ring(law) => law.force = constant,
            Self::Dmt(law) => law.force = constant,
            Self::WithoutTension(_) | Self::Jkr(_) if force == T::ZERO => {}
            Self::WithoutTension(_) | Self::Jkr(_) => {
                let (parameter, value) = (Parameter::ExternalForce, force.to_f64() as f32);
                return Err(InputError { parameter, fault: Fault::OtherLaw, value });
            }
        }
        Ok(self)
    }
}

/// Hertz's contact with an adhesion, and no damping or force so far.
fn plain<T: Real, A>(stiffness: Stiffness<T>, adhesion: A) -> HertzLaw<T, AnyDamping<T>, A, AnyForce<T>> {
    HertzLaw { stiffness: stiffness.pascals(), damping: AnyDamping::None, adhesion, force: AnyForce::None }
}

/// Any damping of the materials, chosen at run time.
///
/// ```
/// use microimpact::contact::{AnyDamping, Damping};
///
/// assert_eq!(AnyDamping::<f64>::None.force(1.25, 1.0, 1.0), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
#[non_exhaustive]
pub enum AnyDamping<T> {
    /// Elastic materials.
    None,
    /// Damping of Hunt and Crossley.
    Hysteretic(HystereticDamping<T>),
    /// Damping of a viscoelastic material.
    Viscoelastic(ViscoelasticDamping<T>),
    /// Damping that leaves a constant restitution.
    Constant(ConstantDamping<T>),
}

/// Passes a call on to the damping that is there.
macro_rules! of_damping {
    ($($function:ident($($argument:ident: $type:ty),*);)*) => {
        $(
            #[inline]
            fn $function(&self, $($argument: $type),*) -> T {
                match self {
                    Self::None => NoDamping.$function($($argument),*),
                    Self::Hysteretic(damping) => damping.$function($($argument),*),
                    Self::Viscoelastic(damping) => damping.$function($($argument),*),
                    Self::Constant(damping) => damping.$function($($argument),*),
                }
            }
        )*
    };
}

impl<T: Real> Damping<T> for AnyDamping<T> {
    fn in_units(&self, units: &HertzUnits<T>) -> Result<Self, InputError> {
        match self {
            Self::None => Ok(Self::None),
            Self::Hysteretic(damping) => damping.in_units(units).map(Self::Hysteretic),
            Self::Viscoelastic(damping) => damping.in_units(units).map(Self::Viscoelastic),
            Self::Constant(damping) => damping.in_units(units).map(Self::Constant),
        }
    }

    #[inline]
    fn is_proportional(&self) -> bool {
        matches!(self, Self::None | Self::Hysteretic(_))
    }

    #[inline]
    fn needs_root(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    of_damping! {
        force(elastic: T, radius: T, root: T);
        loss_over_square(peak: T, fraction: &Fraction<T>);
        release_speed(radius: T, root: T);
    }
}

/// An external force or none, chosen at run time.
///
/// ```
/// use microimpact::contact::{AnyForce, Attraction};
///
/// assert!(!AnyForce::<f64>::None.moves_peak());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
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
    fn moves_peak(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    #[inline]
    fn is_absent(&self) -> bool {
        matches!(self, Self::None)
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

/// Passes a call on to the law that is there. Inlined into the solver, all laws would be at each of its evaluations.
macro_rules! of_law {
    ($($function:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        $(
            #[inline(never)]
            fn $function(&self, $($argument: $type),*) -> $result {
                for_law!(self, _variant, law => law.$function($($argument),*))
            }
        )*
    };
}

impl<T: Real> ContactLaw<T> for AnyLaw<T> {
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError> {
        for_law!(self, variant, law => law.in_units(sphere, approach).map(|(law, units)| (variant(law), units)))
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
        coordinate_in_contact(indentation: T) -> Option<T>;
        contact_radius(s: T) -> T;
        start() -> T;
        end() -> T;
        release_speed(s: T) -> Option<T>;
        external_force() -> T;
        may_have_barrier() -> bool;
        admits_compliance() -> bool;
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
