//! The motion of a sphere in space.

use super::vector::{Vector, add, dot};
use crate::{InputError, Parameter, Real, Sphere};

/// Velocity of the centre (m/s) and spin (rad/s) of a sphere, as vectors.
///
/// ```
/// use microimpact::{Sphere, space::SpatialMotion};
///
/// let motion = SpatialMotion::new([3.0, 0.0, -4.0], [0.0; 3])?;
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// assert!((motion.energy(&sphere) / sphere.mass() - 12.5_f64).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SpatialMotion<T> {
    velocity: Vector<T>,
    spin: Vector<T>,
}

impl<T: Real> SpatialMotion<T> {
    /// A motion from the velocity of the centre, m/s, and the spin, rad/s.
    ///
    /// # Errors
    /// A component outside its range.
    ///
    /// ```
    /// use microimpact::{Parameter, space::SpatialMotion};
    ///
    /// let error = SpatialMotion::new([0.0, 0.0, f64::NAN], [0.0; 3]).unwrap_err();
    /// assert_eq!(error.parameter, Parameter::VelocityComponent);
    /// ```
    pub fn new(velocity: [T; 3], spin: [T; 3]) -> Result<Self, InputError> {
        for component in velocity {
            Parameter::VelocityComponent.check(component)?;
        }
        for component in spin {
            Parameter::Spin.check(component)?;
        }
        Ok(Self { velocity, spin })
    }

    /// Velocity of the centre, m/s.
    ///
    /// ```
    /// use microimpact::space::SpatialMotion;
    ///
    /// assert_eq!(SpatialMotion::new([1.0, 0.0, -2.0], [0.0; 3])?.velocity(), [1.0, 0.0, -2.0]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn velocity(&self) -> [T; 3] {
        self.velocity
    }

    /// Spin, rad/s.
    ///
    /// ```
    /// use microimpact::space::SpatialMotion;
    ///
    /// assert_eq!(SpatialMotion::new([0.0, 0.0, -2.0], [0.0, 5.0, 0.0])?.spin(), [0.0, 5.0, 0.0]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn spin(&self) -> [T; 3] {
        self.spin
    }

    /// Kinetic energy of the motion and the spin of a sphere, J.
    ///
    /// ```
    /// use microimpact::{Sphere, space::SpatialMotion};
    ///
    /// // A solid sphere that rolls has 7/5 of the energy of one that does not spin.
    /// let (sphere, rolls) = (Sphere::solid(0.5, 1.0)?, SpatialMotion::new([1.0, 0.0, 0.0], [0.0, 2.0, 0.0])?);
    /// assert!((rolls.energy(&sphere) / (0.7 * sphere.mass()) - 1.0_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn energy(&self, sphere: &Sphere<T>) -> T {
        let peripheral = self.spin.map(|spin| sphere.radius() * spin);
        let squares = dot(self.velocity, self.velocity) + sphere.gyration_ratio() * dot(peripheral, peripheral);
        T::constant(0.5) * sphere.mass() * squares
    }

    /// The motion changed by a velocity, and by a spin about an axis.
    #[inline]
    pub(super) fn changed(&self, velocity: Vector<T>, (spin, axis): (T, Vector<T>)) -> Self {
        Self { velocity: add(self.velocity, T::ONE, velocity), spin: add(self.spin, spin, axis) }
    }
}
