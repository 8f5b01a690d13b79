//! What collides elastically: materials and the Hertz stiffness of a pair of them.

use core::f64::consts::PI;

use crate::{InputError, Parameter, Real};

/// An isotropic elastic material.
///
/// ```
/// use microimpact::{Material, Stiffness};
///
/// let glass = Material::new(72e9, 0.21)?;
/// let steel = Material::new(207e9, 0.27)?;
/// let stiffness = Stiffness::between(&glass, &steel)?;
/// assert!((stiffness.pascals() / 7.5e10_f64 - 1.0).abs() < 0.002);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Material<T> {
    youngs_modulus: T,
    poisson_ratio: T,
}

impl<T: Real> Material<T> {
    /// A material of `youngs_modulus` E (Pa) and `poisson_ratio` nu (-0.999 to 0.5).
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::{Material, Parameter};
    ///
    /// assert!(Material::new(72e9, 0.21).is_ok());
    /// assert_eq!(Material::new(72e9, 0.6).unwrap_err().parameter, Parameter::PoissonRatio);
    /// ```
    pub fn new(youngs_modulus: T, poisson_ratio: T) -> Result<Self, InputError> {
        Ok(Self {
            youngs_modulus: Parameter::YoungsModulus.check(youngs_modulus)?,
            poisson_ratio: Parameter::PoissonRatio.check(poisson_ratio)?,
        })
    }

    /// Elastic constant k_i = (1 - nu^2)/(pi E), 1/Pa (B3).
    ///
    /// ```
    /// let steel = microimpact::Material::new(207e9, 0.27)?;
    /// assert!((steel.elastic_constant() - 1.42562e-12_f64).abs() < 1e-17);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn elastic_constant(&self) -> T {
        (T::ONE - self.poisson_ratio) * (T::ONE + self.poisson_ratio) / (T::constant(PI) * self.youngs_modulus)
    }
}

/// Hertz stiffness K of a sphere on a flat surface: the contact force is sqrt(r) K delta^(3/2).
///
/// ```
/// use microimpact::Stiffness;
///
/// assert_eq!(Stiffness::new(7.5e10)?.pascals(), 7.5e10);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stiffness<T>(T);

impl<T: Real> Stiffness<T> {
    /// A known stiffness, Pa.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::Stiffness::new(0.0).is_err());
    /// ```
    pub fn new(pascals: T) -> Result<Self, InputError> {
        Ok(Self(Parameter::Stiffness.check(pascals)?))
    }

    /// Stiffness K = 4/(3 pi (k1 + k2)) of a sphere and a surface (B2).
    ///
    /// # Errors
    /// A stiffness outside its range, from two nearly rigid materials.
    ///
    /// ```
    /// use microimpact::{Material, Stiffness};
    ///
    /// let rubber = Material::new(1e6, 0.5)?;
    /// let stiffness = Stiffness::between(&rubber, &rubber)?;
    /// assert!((stiffness.pascals() - 8e6 / 9.0_f64).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn between(sphere: &Material<T>, surface: &Material<T>) -> Result<Self, InputError> {
        let elastic_constants = sphere.elastic_constant() + surface.elastic_constant();
        Self::new(T::constant(4.0 / (3.0 * PI)) / elastic_constants)
    }

    /// The stiffness in Pa.
    ///
    /// ```
    /// assert_eq!(microimpact::Stiffness::new(1e9)?.pascals(), 1e9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn pascals(&self) -> T {
        self.0
    }
}
