//! Hertz's elastic impact, without adhesion or losses.

use core::f64::consts::PI;

use crate::{Approach, InputError, Parameter, Real, Sphere, Stiffness};

/// Peak values and duration of an elastic impact of a sphere on a flat surface.
///
/// ```
/// use microimpact::{Hertz, Material, NormalMotion, Sphere, Stiffness};
///
/// // The mean sphere of the paper: glass of 4.3 um radius on steel, at 2.8 m/s.
/// let stiffness = Stiffness::between(&Material::new(72e9, 0.21)?, &Material::new(207e9, 0.27)?)?;
/// let hertz = Hertz::new(&Sphere::solid(4.3e-6, 2600.0)?, stiffness, &NormalMotion::new(2.8)?);
/// assert!((hertz.indentation - 1.97e-8_f64).abs() < 0.005e-8);
/// assert!((hertz.force - 4.31e-4).abs() < 0.005e-4);
/// assert!((hertz.duration - 2.07e-8).abs() < 0.005e-8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Hertz<T> {
    /// Peak indentation delta_max, m.
    pub indentation: T,
    /// Contact radius a = sqrt(r delta_max) at the peak, m.
    pub contact_radius: T,
    /// Peak force F_max = sqrt(r) K delta_max^(3/2), N.
    pub force: T,
    /// Duration of contact T = 2.9432752 delta_max/v, s.
    pub duration: T,
}

/// v_y over (p_y^5/(E*^4 density))^(1/2): (pi/(2 E*))^2 (2/(5 density))^(1/2) p_y^(5/2) (Thornton 1997).
const YIELD_SPEED: f64 = 1.560_521_475_613_22;

impl<T: Real> Hertz<T> {
    /// Speed from which the peak pressure of an elastic impact exceeds the contact yield `pressure` p_y (Pa) of the softer material,
    /// 1.5605 (p_y^5/(E*^4 density))^(1/2) (Thornton 1997), m/s. p_y is about 1.6 times the yield stress (Johnson 1985).
    ///
    /// Faster impacts leave a dent, which the contact simulation does not know;
    /// [`ElasticPlasticRestitution`](crate::rigid::ElasticPlasticRestitution) does.
    ///
    /// # Errors
    /// The pressure is outside its range.
    ///
    /// ```
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(5e-6, 1050.0)?, Stiffness::new(4.6e9)?);
    /// let speed = Hertz::yield_speed(&sphere, stiffness, 0.3e9)?;
    /// // Hertz's pressure in the middle of the contact, 3 F/(2 pi a^2).
    /// let peak: Hertz<f64> = Hertz::new(&sphere, stiffness, &NormalMotion::new(speed)?);
    /// let pressure = 1.5 * peak.force / (core::f64::consts::PI * peak.contact_radius.powi(2));
    /// assert!((pressure / 0.3e9 - 1.0).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn yield_speed(sphere: &Sphere<T>, stiffness: Stiffness<T>, pressure: T) -> Result<T, InputError> {
        let pressure = Parameter::YieldPressure.check(pressure)?;
        // E* = (3/4) K.
        let strain = T::constant(4.0 / 3.0) * pressure / stiffness.pascals();
        Ok(T::constant(YIELD_SPEED) * strain * strain * (pressure / sphere.density()).sqrt())
    }

    /// Computes the impact of a sphere that arrives with `motion`. Only the normal velocity matters.
    ///
    /// ```
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let stiffness = Stiffness::new(1e10)?;
    /// let slow = Hertz::new(&sphere, stiffness, &NormalMotion::new(1.0)?);
    /// let fast = Hertz::new(&sphere, stiffness, &NormalMotion::new(32.0)?);
    /// assert!((fast.indentation / slow.indentation - 16.0_f64).abs() < 1e-12);
    /// assert!((fast.duration / slow.duration - 0.5).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(sphere: &Sphere<T>, stiffness: Stiffness<T>, motion: &impl Approach<T>) -> Self {
        let radius = sphere.radius();
        let speed = motion.normal().speed();
        // delta_max = (5 m v^2/(4 sqrt(r) K))^(2/5), in units of r with m/r^3 = 4 pi density/3. This form avoids the
        // mass and the energy of the sphere: f32 cannot represent those of a nanometre sphere.
        let compression = speed * (T::constant(5.0 * PI / 3.0) * sphere.density() / stiffness.pascals()).sqrt();
        let power = compression.two_fifths_power();
        let depth = power * power;
        let root = depth.sqrt();
        Self {
            indentation: radius * depth,
            contact_radius: radius * root,
            force: radius * radius * stiffness.pascals() * depth * root,
            duration: T::constant(2.943_275_2) * radius * depth / speed,
        }
    }
}
