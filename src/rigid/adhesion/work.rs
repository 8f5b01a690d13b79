//! Adhesion by its work.

use core::f64::consts::PI;

use super::ReboundAdhesion;
use crate::{InputError, Parameter, Real, RestitutionLaw, Sphere};

/// Adhesion that takes a fixed work W_A from the rebound: e^2 = R^2 - B, where B = 2 W_A/(m v_n^2) (A33, A34).
///
/// ```
/// use microimpact::{Sphere, rigid::{ReboundAdhesion, WorkOfAdhesion, image_charge_energy}};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let adhesion = WorkOfAdhesion::new(sphere.mass() * 9.0 / 2.0, &sphere)?;
/// assert_eq!(adhesion.departure(6.0, 5.0), 4.0);
/// assert_eq!(adhesion.departure(6.0, 3.0), 0.0);
///
/// // The work that Johnson, Kendall and Roberts' adhesion takes from an elastic sphere, and an image charge's energy.
/// let (stiffness, surface) = (microimpact::Stiffness::new(1e10)?, 0.1);
/// let work = microimpact::Sticking::new(&sphere, stiffness, surface)?.work;
/// let adhesion = WorkOfAdhesion::new(work + image_charge_energy(&sphere, 1e-16)?, &sphere)?;
/// # assert!(adhesion.departure(1.0, 1.0) < 1.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WorkOfAdhesion<T> {
    /// Rebound speed whose energy equals the work of adhesion, sqrt(2 W_A/m), m/s.
    pub(crate) speed: T,
}

impl<T: Real> WorkOfAdhesion<T> {
    /// Creates adhesion from its `work` W_A (J, zero or positive) on a given `sphere`.
    ///
    /// # Errors
    /// The value is outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, rigid::WorkOfAdhesion};
    ///
    /// assert!(WorkOfAdhesion::new(-1e-12, &Sphere::solid(1e-6, 1000.0)?).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(work: T, sphere: &Sphere<T>) -> Result<Self, InputError> {
        let work = Parameter::WorkOfAdhesion.check(work)?;
        Ok(Self { speed: (T::constant(2.0) * work / sphere.mass()).sqrt() })
    }
}

impl<T: Real> ReboundAdhesion<T> for WorkOfAdhesion<T> {
    #[inline]
    fn departure(&self, _approach: T, body_rebound: T) -> T {
        if !T::HAS_LANES && body_rebound <= self.speed {
            return T::ZERO;
        }
        let excess = body_rebound - self.speed;
        // In lanes a sphere is captured beside one that rebounds.
        let excess = if T::HAS_LANES { excess.max(T::ZERO) } else { excess };
        // A difference of squares loses digits close to capture. The product of the factors does not.
        excess.geometric_mean(body_rebound + self.speed)
    }

    #[inline]
    fn holding_speed(&self, law: &impl RestitutionLaw<T>, pull: T) -> Option<T> {
        let held = if pull > T::ZERO { (self.speed * self.speed + pull * pull).sqrt() } else { self.speed };
        law.approach_speed(held)
    }
}

/// Permittivity of free space, F/m (CODATA 2018).
const FREE_SPACE: f64 = 8.854_187_812_8e-12;

/// Energy that takes a charged sphere off a conducting surface, q^2/(16 pi epsilon_0 r), J: a part of the work of adhesion.
///
/// The charge q (C) acts at the centre, as one that is spread evenly over the sphere does. On an insulator of the relative
/// permittivity k the energy is (k - 1)/(k + 1) times as large.
///
/// # Errors
/// A charge outside its range.
///
/// ```
/// use microimpact::{Sphere, rigid::image_charge_energy};
///
/// // 1000 elementary charges on a sphere of 1 um radius.
/// let energy = image_charge_energy(&Sphere::solid(1e-6, 1000.0)?, 1.602_176_634e-16)?;
/// assert!((energy / 5.767e-17_f64 - 1.0).abs() < 1e-3);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn image_charge_energy<T: Real>(sphere: &Sphere<T>, charge: T) -> Result<T, InputError> {
    let charge = Parameter::Charge.check(charge)?;
    // In this order no product leaves the range of single precision.
    Ok(charge * (charge / T::constant(16.0 * PI * FREE_SPACE) / sphere.radius()))
}
