//! Adhesion as a constant force, of Derjaguin, Muller and Toporov.

use core::f64::consts::PI;

use super::hertz::HertzUnits;
use super::{Attraction, ConstantForce, Fraction};
use crate::numbers::cube_root;
use crate::{InputError, Parameter, Real, Sphere};

/// The adhesion of Derjaguin, Muller and Toporov (1975): the constant force 2 pi G r as long as there is contact, with the work
/// of adhesion G in J/m^2. It suits small and stiff spheres.
///
/// ```
/// use microimpact::contact::Dmt;
///
/// assert!(Dmt::new(0.1).is_ok());
/// assert!(Dmt::new(-0.1).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Dmt<T> {
    /// G in J/m^2 or, in units of an impact, the force.
    pub(crate) strength: T,
}

impl<T: Real> Dmt<T> {
    /// Adhesion of a work G >= 0, J/m^2.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::Dmt::new(f64::NAN).is_err());
    /// ```
    #[inline]
    pub fn new(work: T) -> Result<Self, InputError> {
        Ok(Self { strength: Parameter::AdhesionEnergy.check(work)? })
    }

    /// The force into the surface, in units of an impact.
    #[inline]
    fn pull(&self) -> ConstantForce<T> {
        ConstantForce::inwards(self.strength)
    }
}

impl<T: Real> Attraction<T> for Dmt<T> {
    #[inline]
    fn in_units(&self, sphere: &Sphere<T>, units: &HertzUnits<T>) -> Result<Self, InputError> {
        let force = T::constant(2.0 * PI) * self.strength * sphere.radius();
        Ok(Self { strength: Parameter::AdhesionRatio.check(units.force(force, sphere))? })
    }

    /// The contact radius is the cube root of 2 pi G r^2/K.
    #[inline]
    fn equilibrium(&self, sphere: &Sphere<T>, stiffness: T) -> T {
        let ratio = cube_root(T::constant(2.0 * PI) * self.strength / stiffness / sphere.radius());
        ratio * ratio * sphere.radius()
    }

    #[inline]
    fn energy(&self, s: T) -> T {
        self.pull().energy(s)
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        self.pull().slope(s)
    }

    #[inline]
    fn curvature(&self, s: T) -> T {
        self.pull().curvature(s)
    }

    #[inline]
    fn mean_slope(&self, p: T, s: T) -> T {
        self.pull().mean_slope(p, s)
    }

    #[inline]
    fn energy_drop(&self, peak: T, fraction: &Fraction<T>) -> T {
        self.pull().energy_drop(peak, fraction)
    }

    #[inline]
    fn force(&self, _s: T) -> T {
        self.strength
    }
}
