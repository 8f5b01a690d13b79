//! Dissipation in the materials: a force against the motion that depends on the contact radius.

use core::f64::consts::PI;

use super::Fraction;
use super::hertz::HertzUnits;
use crate::{InputError, Parameter, Real};

/// Damping of the contact, in SI units or, as [`in_units`](Self::in_units) gives it, in units of an impact.
///
/// ```
/// use microimpact::contact::{Damping, NoDamping};
///
/// assert_eq!(Damping::<f32>::force(&NoDamping, 1.25, 1.0, 1.0), 0.0);
/// ```
pub trait Damping<T: Real>: Copy {
    /// The damping in units of an impact.
    ///
    /// # Errors
    /// A ratio of forces that cannot be represented.
    fn in_units(&self, units: &HertzUnits<T>) -> Result<Self, InputError>;

    /// The damping force for each unit of speed, where this is the elastic force, the contact radius, and the root of the contact
    /// radius. The root is not to be used unless [`needs_root`](Self::needs_root).
    fn force(&self, elastic: T, radius: T, root: T) -> T;

    /// The force for each unit of speed and of 2 s, where the contact radius s is a fraction m of its `peak`, over m^2: for methods
    /// that solve whole phases. Not called where the damping [`needs_root`](Self::needs_root).
    fn loss_over_square(&self, peak: T, fraction: &Fraction<T>) -> T;

    /// Outward speed at which the damping cancels the elastic force.
    fn release_speed(&self, radius: T, root: T) -> T;

    /// Whether the force is in proportion to the elastic force, or none.
    #[inline]
    fn is_proportional(&self) -> bool {
        false
    }

    /// Whether the force is a polynomial in the root of the contact radius only. The root is then the coordinate of the law.
    #[inline]
    fn needs_root(&self) -> bool {
        false
    }
}

/// Damping in proportion to the elastic force, on which the dimensionless groups of an impact depend: [`NoDamping`] or
/// [`HystereticDamping`].
///
/// ```
/// use microimpact::contact::{NoDamping, ProportionalDamping};
///
/// assert_eq!(ProportionalDamping::<f32>::rate(&NoDamping), 0.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not in proportion to the elastic force",
    label = "this needs a scene without damping or with hysteretic damping"
)]
pub trait ProportionalDamping<T: Real>: Damping<T> {
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoDamping;

/// Damping of Hunt and Crossley (1975): the elastic force times 1 + c_H delta' (B1), with c_H = zeta_H C and
/// C = (m/(r^3 K sqrt(v)))^(2/5) (B4), for the mass m and radius r of the sphere, the stiffness K and the approach speed v.
///
/// The ratio zeta_H has no unit. C is a time over a length (s/m), and so is the damping constant c_H, which other programs take
/// for the force K sqrt(r) delta^(3/2) (1 + c delta'). Divide such a constant by C: zeta_H = c/C. Since C depends on the speed,
/// one zeta_H at all speeds is not one c at all speeds, but c ~ v^(-1/5). For two spheres m and r are those of the
/// [reduced sphere](crate::space::Pair::reduced).
///
/// Without adhesion c_H v alone determines the restitution e: c_H v (1 + e) = ln((1 + c_H v)/(1 - e c_H v)).
///
/// ```
/// use microimpact::contact::Contact;
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // A program for granular flow damps a bead by c = 0.05 s/m. At 2 m/s that is this zeta_H.
/// let (bead, stiffness, speed, c) = (Sphere::solid(1e-3_f64, 2500.0)?, 5e10, 2.0_f64, 0.05);
/// let unit = (bead.mass() / (bead.radius().powi(3) * stiffness * speed.sqrt())).powf(0.4);
/// let scene = Contact::hertz(bead, Stiffness::new(stiffness)?).with_damping(c / unit)?;
/// assert!((scene.groups(&NormalMotion::new(speed)?)?.material_damping - c * speed).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
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

/// Damping of a viscoelastic material (Kuwabara and Kono 1987; Brilliantov et al. 1996): c = (3/2) A K a, with its relaxation time A.
///
/// Its restitution falls with the fifth root of the speed: e = 1 - 1.153 x + ... with x = (3/2) A (K sqrt(r)/m)^(2/5) v^(1/5).
///
/// ```
/// use microimpact::contact::ViscoelasticDamping;
///
/// assert!(ViscoelasticDamping::new(1e-8).is_ok());
/// assert!(ViscoelasticDamping::new(-1e-8).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ViscoelasticDamping<T> {
    /// A in s or, in units of an impact, the force at s = 1.
    pub(crate) time: T,
}

/// Damping with a restitution that does not depend on the speed (Tsuji, Tanaka and Ishida 1992): c = alpha sqrt(m K a), with
/// alpha = -sqrt(5) ln(e)/sqrt(ln(e)^2 + pi^2).
///
/// Without adhesion e is the restitution of a contact that ends at zero indentation.
///
/// ```
/// use microimpact::contact::ConstantDamping;
///
/// assert!(ConstantDamping::new(0.9).is_ok());
/// assert!(ConstantDamping::new(0.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConstantDamping<T> {
    /// alpha.
    pub(crate) alpha: T,
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

impl<T: Real> ViscoelasticDamping<T> {
    /// Damping with a relaxation time A >= 0 of the material, s.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::ViscoelasticDamping::new(f64::INFINITY).is_err());
    /// ```
    #[inline]
    pub fn new(time: T) -> Result<Self, InputError> {
        Ok(Self { time: Parameter::RelaxationTime.check(time)? })
    }
}

impl<T: Real> ConstantDamping<T> {
    /// Damping that leaves a restitution e.
    ///
    /// # Errors
    /// A restitution outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::ConstantDamping::new(1.1).is_err());
    /// ```
    pub fn new(restitution: T) -> Result<Self, InputError> {
        let e = Parameter::NominalRestitution.check(restitution)?;
        let logarithm = e.ln();
        let alpha = -(T::constant(5.0).sqrt() * logarithm / (logarithm * logarithm + T::constant(PI * PI)).sqrt());
        Ok(Self { alpha })
    }
}

impl<T: Real> Damping<T> for NoDamping {
    #[inline]
    fn is_proportional(&self) -> bool {
        true
    }

    #[inline]
    fn in_units(&self, _units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self)
    }

    #[inline]
    fn force(&self, _elastic: T, _radius: T, _root: T) -> T {
        T::ZERO
    }

    #[inline]
    fn loss_over_square(&self, _peak: T, _fraction: &Fraction<T>) -> T {
        T::ZERO
    }

    #[inline]
    fn release_speed(&self, _radius: T, _root: T) -> T {
        T::ONE / T::EPSILON
    }
}

impl<T: Real> ProportionalDamping<T> for NoDamping {
    #[inline]
    fn rate(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> Damping<T> for HystereticDamping<T> {
    #[inline]
    fn is_proportional(&self) -> bool {
        true
    }

    #[inline]
    fn in_units(&self, units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self { rate: Parameter::DampingRatio.check(self.rate * units.damping)? })
    }

    #[inline]
    fn force(&self, elastic: T, _radius: T, _root: T) -> T {
        self.rate * elastic
    }

    #[inline]
    fn loss_over_square(&self, peak: T, fraction: &Fraction<T>) -> T {
        let square = peak * peak;
        T::constant(2.5) * self.rate * square * square * fraction.square
    }

    #[inline]
    fn release_speed(&self, _radius: T, _root: T) -> T {
        // 1/c_H, which no rebound reaches: the damping would stop it.
        T::ONE / T::EPSILON
    }
}

impl<T: Real> ProportionalDamping<T> for HystereticDamping<T> {
    #[inline]
    fn rate(&self) -> T {
        self.rate
    }
}

impl<T: Real> Damping<T> for ViscoelasticDamping<T> {
    #[inline]
    fn in_units(&self, units: &HertzUnits<T>) -> Result<Self, InputError> {
        // The elastic force K a^3/r is (5/4) s^3.
        let time = T::constant(1.5 * 1.25) * self.time * (units.speed / units.length);
        Ok(Self { time: Parameter::DampingRatio.check(time)? })
    }

    #[inline]
    fn force(&self, _elastic: T, radius: T, _root: T) -> T {
        self.time * radius
    }

    #[inline]
    fn loss_over_square(&self, peak: T, _fraction: &Fraction<T>) -> T {
        T::constant(2.0) * self.time * peak * peak
    }

    #[inline]
    fn release_speed(&self, radius: T, _root: T) -> T {
        (T::constant(1.25) * radius * radius).saturating_div(self.time)
    }
}

/// Root of the elastic force K a^3/r at a contact radius of one: that of 5/4.
const ROOT_OF_ELASTICITY: f64 = 1.118_033_988_749_895;

impl<T: Real> Damping<T> for ConstantDamping<T> {
    #[inline]
    fn in_units(&self, _units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(*self)
    }

    #[inline]
    fn force(&self, _elastic: T, _radius: T, root: T) -> T {
        T::constant(ROOT_OF_ELASTICITY) * self.alpha * root
    }

    #[inline]
    fn loss_over_square(&self, _peak: T, _fraction: &Fraction<T>) -> T {
        T::ZERO
    }

    #[inline]
    fn release_speed(&self, radius: T, root: T) -> T {
        (T::constant(ROOT_OF_ELASTICITY) * radius * radius * root).saturating_div(self.alpha)
    }

    #[inline]
    fn needs_root(&self) -> bool {
        true
    }
}
