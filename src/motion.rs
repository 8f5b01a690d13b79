//! The motion of the sphere before the impact: normal velocity, tangential velocity and spin.
//!
//! The normal points out of the surface. So an approaching sphere has v_n < 0, and its *approach speed* is -v_n. The spin w
//! is stored as the *peripheral velocity* r w, so that all parts of a motion are in m/s.

use crate::{InputError, Parameter, Real, Sphere};

/// A motion towards the surface: any type of motion before an impact.
///
/// ```
/// use microimpact::{Approach, NormalMotion};
///
/// fn speed(motion: &impl Approach<f32>) -> f32 {
///     motion.normal().speed()
/// }
/// let motion = NormalMotion::new(2.8)?;
/// assert_eq!(speed(&motion), 2.8);
/// assert_eq!(speed(&motion.with_tangential(1.0)?), 2.8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait Approach<T> {
    /// Whether it is the motion of two bodies towards each other, on which external forces do not act as on one.
    const OF_TWO_BODIES: bool = false;

    /// Normal part of the motion.
    fn normal(&self) -> NormalMotion<T>;
}

/// A motion with a component along the surface.
///
/// ```
/// use microimpact::{NormalMotion, Oblique};
///
/// let rolling = NormalMotion::new(1.0)?.with_tangential(3.0)?.with_peripheral_velocity(3.0)?;
/// assert_eq!(rolling.slip(), 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait Oblique<T: Real>: Approach<T> {
    /// Tangential velocity v_t of the centre, m/s.
    fn tangential(&self) -> T;

    /// Peripheral velocity r w, m/s.
    fn peripheral(&self) -> T;

    /// Slip velocity v_ct = v_t - r w of the contact point, m/s. It is zero if the sphere rolls.
    fn slip(&self) -> T;
}

/// A motion in one plane, whose spin has one axis. A peeling moment and rolling dissipation act against such a spin only: how they
/// act against others is not known.
///
/// ```
/// use microimpact::{NormalMotion, Planar};
///
/// fn spin_parameter(motion: &impl Planar<f64>) -> f64 {
///     motion.peripheral() / motion.normal().speed()
/// }
/// assert_eq!(spin_parameter(&NormalMotion::new(2.0)?.with_tangential(0.0)?.with_peripheral_velocity(1.0)?), 0.5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "a peeling moment or rolling dissipation acts against a spin about one axis, which `{Self}` may not have",
    label = "give a planar motion: `.with_tangential(v_t)?.with_spin(&sphere, w)?`"
)]
pub trait Planar<T: Real>: Oblique<T> {}

impl<T: Real> Planar<T> for ObliqueMotion<T> {}

impl<T: Real> Planar<T> for PlanarMotion<T> {}

/// Motion along the normal, without tangential velocity and spin.
///
/// ```
/// use microimpact::NormalMotion;
///
/// assert_eq!(NormalMotion::new(2.8)?.speed(), 2.8);
/// assert!(NormalMotion::new(0.0).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalMotion<T> {
    pub(crate) speed: T,
}

impl<T: Real> NormalMotion<T> {
    /// Creates a motion with the approach `speed` -v_n, a positive number in m/s.
    ///
    /// # Errors
    /// The speed is outside its range. A particle with a speed of zero or less rests or recedes.
    ///
    /// ```
    /// use microimpact::{NormalMotion, Parameter};
    ///
    /// assert_eq!(NormalMotion::new(-1.0).unwrap_err().parameter, Parameter::ApproachSpeed);
    /// ```
    #[inline]
    pub fn new(speed: T) -> Result<Self, InputError> {
        Ok(Self { speed: Parameter::ApproachSpeed.check(speed)? })
    }

    /// Creates a motion from the normal velocity v_n, a negative number in m/s.
    ///
    /// # Errors
    /// The approach speed -v_n is outside its range.
    ///
    /// ```
    /// use microimpact::NormalMotion;
    ///
    /// assert_eq!(NormalMotion::from_velocity(-2.8), NormalMotion::new(2.8));
    /// assert!(NormalMotion::from_velocity(2.8).is_err());
    /// ```
    #[inline]
    pub fn from_velocity(normal_velocity: T) -> Result<Self, InputError> {
        Self::new(-normal_velocity)
    }

    /// Adds the tangential `velocity` v_t, m/s.
    ///
    /// # Errors
    /// The velocity is outside its range.
    ///
    /// ```
    /// use microimpact::{NormalMotion, Oblique};
    ///
    /// assert_eq!(NormalMotion::new(2.8)?.with_tangential(-4.0)?.slip(), -4.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_tangential(self, velocity: T) -> Result<ObliqueMotion<T>, InputError> {
        Ok(ObliqueMotion { normal: self, tangential: Parameter::TangentialVelocity.check(velocity)? })
    }

    /// Approach speed -v_n, m/s.
    ///
    /// ```
    /// assert_eq!(microimpact::NormalMotion::new(2.8)?.speed(), 2.8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn speed(&self) -> T {
        self.speed
    }
}

impl<T: Real> Approach<T> for NormalMotion<T> {
    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        *self
    }
}

/// Motion with normal and tangential velocity, without spin.
///
/// ```
/// use microimpact::{NormalMotion, Oblique};
///
/// let motion = NormalMotion::new(2.0)?.with_tangential(3.0)?;
/// assert_eq!((motion.tangential(), motion.peripheral()), (3.0, 0.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ObliqueMotion<T> {
    pub(crate) normal: NormalMotion<T>,
    pub(crate) tangential: T,
}

impl<T: Real> ObliqueMotion<T> {
    /// Adds the `spin` w (rad/s) of a given `sphere`.
    ///
    /// # Errors
    /// The spin or the peripheral velocity r w is outside its range.
    ///
    /// ```
    /// use microimpact::{NormalMotion, Oblique, Sphere};
    ///
    /// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
    /// let motion = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.46e5)?;
    /// assert!((motion.slip() + 0.73876_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_spin(self, sphere: &Sphere<T>, spin: T) -> Result<PlanarMotion<T>, InputError> {
        self.with_peripheral_velocity(sphere.radius() * Parameter::Spin.check(spin)?)
    }

    /// Adds the spin, given by the peripheral `velocity` r w, m/s.
    ///
    /// # Errors
    /// The velocity is outside its range.
    ///
    /// ```
    /// use microimpact::{NormalMotion, Oblique};
    ///
    /// let motion = NormalMotion::new(2.8)?.with_tangential(1.0)?.with_peripheral_velocity(0.25)?;
    /// assert_eq!(motion.slip(), 0.75);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_peripheral_velocity(self, velocity: T) -> Result<PlanarMotion<T>, InputError> {
        Ok(PlanarMotion { oblique: self, peripheral: Parameter::PeripheralVelocity.check(velocity)? })
    }
}

impl<T: Real> Approach<T> for ObliqueMotion<T> {
    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        self.normal
    }
}

impl<T: Real> Oblique<T> for ObliqueMotion<T> {
    #[inline]
    fn tangential(&self) -> T {
        self.tangential
    }

    #[inline]
    fn peripheral(&self) -> T {
        T::ZERO
    }

    #[inline]
    fn slip(&self) -> T {
        self.tangential
    }
}

/// Motion with normal velocity, tangential velocity and spin: the complete planar motion.
///
/// ```
/// use microimpact::{NormalMotion, Oblique};
///
/// let motion = NormalMotion::new(2.8)?.with_tangential(1.0)?.with_peripheral_velocity(0.25)?;
/// assert_eq!((motion.tangential(), motion.peripheral()), (1.0, 0.25));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlanarMotion<T> {
    pub(crate) oblique: ObliqueMotion<T>,
    pub(crate) peripheral: T,
}

impl<T: Real> Approach<T> for PlanarMotion<T> {
    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        self.oblique.normal
    }
}

impl<T: Real> Oblique<T> for PlanarMotion<T> {
    #[inline]
    fn tangential(&self) -> T {
        self.oblique.tangential
    }

    #[inline]
    fn peripheral(&self) -> T {
        self.peripheral
    }

    #[inline]
    fn slip(&self) -> T {
        self.oblique.tangential - self.peripheral
    }
}
