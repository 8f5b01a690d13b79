//! Units of one impact, between SI and the motion that the solver sees.

use crate::Real;

/// The units in which a law describes one impact, and the energy that the sphere brings in them.
///
/// The unit of mass is that of the sphere.
///
/// ```
/// use microimpact::contact::{ContactLaw, HertzLaw};
/// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
///
/// // Without adhesion the unit of length is the peak indentation of Hertz's impact, and the elastic energy is s^5/2.
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let (_, units) = HertzLaw::new(stiffness).in_units(&sphere, 2.0)?;
/// let hertz = Hertz::new(&sphere, stiffness, &NormalMotion::new(2.0)?);
/// assert!((units.length / hertz.indentation - 1.0_f64).abs() < 1e-14);
/// assert!((units.energy - 0.5_f64).abs() < 1e-15);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Units<T> {
    /// Length L, m; indentations are in units of it.
    pub length: T,
    /// Speed U, m/s.
    pub speed: T,
    /// Kinetic energy before the impact, m v^2/2 over m U^2.
    pub energy: T,
}

impl<T: Real> Units<T> {
    /// The same in another number type.
    pub(super) fn map<U>(&self, of: impl Fn(T) -> U) -> Units<U> {
        Units { length: of(self.length), speed: of(self.speed), energy: of(self.energy) }
    }

    /// Unit of time L/U, s.
    ///
    /// ```
    /// use microimpact::contact::Units;
    ///
    /// assert_eq!(Units { length: 1e-8, speed: 2.0, energy: 0.5 }.time(), 0.5e-8);
    /// ```
    pub fn time(&self) -> T {
        self.length / self.speed
    }
}
