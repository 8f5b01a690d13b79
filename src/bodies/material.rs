//! Elastic materials.

use core::f64::consts::PI;

use crate::{InputError, Parameter, Real};

/// An isotropic elastic material, given by Young's modulus and Poisson's ratio.
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
    /// Creates a material from `youngs_modulus` E (Pa) and `poisson_ratio` nu (-0.999 to 0.5).
    ///
    /// # Errors
    /// A value is outside its range.
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

    /// The same for a tangential force: (2 - nu)(1 + nu)/(pi E), half of (2 - nu)/G over pi with the shear modulus G.
    pub(super) fn tangential_constant(&self) -> T {
        let two = T::constant(2.0);
        (two - self.poisson_ratio) * (T::ONE + self.poisson_ratio) / (T::constant(PI) * self.youngs_modulus)
    }
}
