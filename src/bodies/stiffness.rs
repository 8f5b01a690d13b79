//! The Hertz stiffness of a sphere on a surface.

use core::f64::consts::PI;

use crate::{InputError, Material, Parameter, Real};

/// Hertz stiffness K of a sphere on a flat surface, Pa.
///
/// At the indentation delta, the contact force is sqrt(r) K delta^(3/2).
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
    /// Creates a stiffness from its value in Pa.
    ///
    /// # Errors
    /// The value is outside its range.
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
    /// The stiffness is outside its range, because both materials are almost rigid.
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

    /// Stiffness ratio chi = k_t/((3/2) K a) of a sphere and a surface, with Mindlin's (1949) tangential stiffness k_t = 8 G* a of a
    /// contact of radius a, and 1/G* the sum of (2 - nu)/G of both materials.
    ///
    /// It is 2/3 to 1 for two equal materials of a Poisson's ratio nu from 1/2 to 0: chi = 2 (1 - nu)/(2 - nu).
    ///
    /// ```
    /// use microimpact::{Material, Stiffness};
    ///
    /// let alumina = Material::new(360e9, 0.23)?;
    /// let chi: f64 = Stiffness::tangential_ratio_between(&alumina, &alumina);
    /// assert!((chi - 2.0 * 0.77 / 1.77).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn tangential_ratio_between(sphere: &Material<T>, surface: &Material<T>) -> T {
        let elastic_constants = sphere.elastic_constant() + surface.elastic_constant();
        T::constant(2.0) * elastic_constants / (sphere.tangential_constant() + surface.tangential_constant())
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
