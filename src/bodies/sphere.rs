//! The particle: a sphere whose mass distribution is spherically symmetric.

use core::f64::consts::PI;

use crate::{Fault, InputError, Parameter, Real};

/// A solid, hollow or coated sphere.
///
/// An impact depends only on the radius r, the mean density and the gyration ratio kappa = k^2/r^2, where k is the radius
/// of gyration.
///
/// ```
/// use microimpact::Sphere;
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// assert!((sphere.mass() / 1.41e-12_f64 - 1.0).abs() < 0.002);
/// assert!((sphere.radius_of_gyration() / 3.20e-6 - 1.0).abs() < 0.001);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sphere<T> {
    pub(crate) radius: T,
    pub(crate) density: T,
    pub(crate) gyration_ratio: T,
    pub(crate) contact_inertia: T,
}

impl<T: Copy> Sphere<T> {
    /// The same in another number type.
    pub(crate) fn map<U>(&self, of: impl Fn(T) -> U) -> Sphere<U> {
        Sphere {
            radius: of(self.radius),
            density: of(self.density),
            gyration_ratio: of(self.gyration_ratio),
            contact_inertia: of(self.contact_inertia),
        }
    }
}

impl<T: Real> Sphere<T> {
    /// Creates a homogeneous sphere of `radius` (m) and `density` (kg/m^3). Its gyration ratio kappa is 2/5.
    ///
    /// # Errors
    /// The radius or the density is outside its range.
    ///
    /// ```
    /// use microimpact::Sphere;
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert_eq!(sphere.gyration_ratio(), 0.4);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn solid(radius: T, density: T) -> Result<Self, InputError> {
        Self::new(radius, density, T::constant(0.4))
    }

    /// Creates a hollow sphere of outer `radius` (m) with a wall of `thickness` (m) and `density` (kg/m^3).
    ///
    /// The gyration ratio kappa is between 2/5 (no cavity) and 2/3 (thin wall).
    ///
    /// # Errors
    /// A value is outside its range, or the wall is thicker than the radius.
    ///
    /// ```
    /// use microimpact::Sphere;
    ///
    /// let balloon = Sphere::hollow(30e-6, 1e-9, 2200.0)?;
    /// assert!((balloon.gyration_ratio() - 2.0 / 3.0_f64).abs() < 3e-5);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn hollow(radius: T, thickness: T, density: T) -> Result<Self, InputError> {
        let density = Parameter::Density.check(density)?;
        Self::layered(radius, thickness, T::ZERO, density)
    }

    /// Creates a coated sphere of outer `radius` (m): a core of `core_density` (kg/m^3) under a coating of `thickness` (m)
    /// and `coating_density` (kg/m^3).
    ///
    /// # Errors
    /// A value is outside its range, or the coating is thicker than the radius.
    ///
    /// ```
    /// use microimpact::Sphere;
    ///
    /// let glass = Sphere::solid(5e-6, 2600.0)?;
    /// let silvered = Sphere::coated(5e-6, 50e-9, 2600.0, 10490.0)?;
    /// assert!(silvered.mass() > glass.mass());
    /// assert!(silvered.gyration_ratio() > 0.4_f64);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn coated(radius: T, thickness: T, core_density: T, coating_density: T) -> Result<Self, InputError> {
        let core_density = Parameter::Density.check(core_density)?;
        let coating_density = Parameter::Density.check(coating_density)?;
        Self::layered(radius, thickness, core_density, coating_density)
    }

    /// Creates a sphere from its `radius` (m), mean `density` (kg/m^3) and `gyration_ratio` kappa = k^2/r^2.
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// use microimpact::Sphere;
    ///
    /// assert_eq!(Sphere::new(1e-6, 1000.0, 0.4), Sphere::solid(1e-6, 1000.0));
    /// ```
    #[inline]
    pub fn new(radius: T, density: T, gyration_ratio: T) -> Result<Self, InputError> {
        let radius = Parameter::Radius.check(radius)?;
        let density = Parameter::Density.check(density)?;
        let gyration_ratio = Parameter::GyrationRatio.check(gyration_ratio)?;
        Ok(Self { radius, density, gyration_ratio, contact_inertia: gyration_ratio / (T::ONE + gyration_ratio) })
    }

    /// A homogeneous core under a homogeneous layer.
    ///
    /// With q = 1 - thickness/radius, the masses of core and layer are proportional to q^3 and 1 - q^3, and their moments of
    /// inertia to q^5 and 1 - q^5. Each difference is computed as (1 - q) times a sum, which is accurate for a thin layer.
    fn layered(radius: T, thickness: T, core: T, layer: T) -> Result<Self, InputError> {
        let radius = Parameter::Radius.check(radius)?;
        let thickness = Parameter::Thickness.check(thickness)?;
        if thickness > radius {
            let value = thickness.to_f64() as f32;
            return Err(InputError { parameter: Parameter::Thickness, fault: Fault::ExceedsRadius, value });
        }
        let depth = thickness / radius;
        let q = T::ONE - depth;
        let q2 = q * q;
        let q3 = q2 * q;
        let layer_mass = layer * depth * (T::ONE + q + q2);
        let layer_inertia = layer * depth * (T::ONE + q + q2 + q3 + q2 * q2);
        let density = core * q3 + layer_mass;
        let inertia = core * q3 * q2 + layer_inertia;
        Self::new(radius, density, T::constant(0.4) * inertia / density)
    }

    /// Outer radius r, m.
    ///
    /// ```
    /// assert_eq!(microimpact::Sphere::solid(1e-6, 1000.0)?.radius(), 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn radius(&self) -> T {
        self.radius
    }

    /// Mean density, kg/m^3.
    ///
    /// ```
    /// assert_eq!(microimpact::Sphere::solid(1e-6, 1000.0)?.density(), 1000.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn density(&self) -> T {
        self.density
    }

    /// Mass m = (4/3) pi density r^3, kg.
    ///
    /// ```
    /// let droplet = microimpact::Sphere::solid(1e-3, 1000.0)?;
    /// assert!((droplet.mass() - 4.18879e-6_f64).abs() < 1e-11);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn mass(&self) -> T {
        T::constant(4.0 / 3.0 * PI) * self.density * self.radius * self.radius * self.radius
    }

    /// Gyration ratio kappa = k^2/r^2.
    ///
    /// ```
    /// assert_eq!(microimpact::Sphere::solid(1e-6, 1000.0)?.gyration_ratio(), 0.4);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn gyration_ratio(&self) -> T {
        self.gyration_ratio
    }

    /// Radius of gyration k, m.
    ///
    /// ```
    /// let sphere = microimpact::Sphere::new(2e-6, 1000.0, 0.25)?;
    /// assert_eq!(sphere.radius_of_gyration(), 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn radius_of_gyration(&self) -> T {
        self.radius * self.gyration_ratio.sqrt()
    }

    /// Fraction of the mass that resists a tangential force at the contact point: kappa/(1 + kappa).
    ///
    /// A force through the centre would have to accelerate the whole mass. A force at the contact point also turns the
    /// sphere, so that the contact point gives way more easily. The fraction is 2/7 for a homogeneous sphere.
    ///
    /// ```
    /// let solid = microimpact::Sphere::solid(1e-6, 1000.0)?;
    /// assert!((solid.contact_inertia() - 2.0 / 7.0_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn contact_inertia(&self) -> T {
        self.contact_inertia
    }
}
