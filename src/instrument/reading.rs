//! Readings of a detector: plain numbers that are not checked yet.

use crate::{InputError, NormalMotion, ObliqueMotion, PlanarMotion, Real};

/// A reading of a detector: unchecked numbers that describe the motion of a particle before its impact.
///
/// The interrupt only copies a reading. The main loop checks it.
///
/// ```
/// use microimpact::instrument::{NormalReading, Reading};
///
/// assert!(NormalReading { approach: 2.8 }.motion().is_ok());
/// assert!(NormalReading { approach: f32::NAN }.motion().is_err());
/// ```
pub trait Reading {
    /// The motion that a valid reading describes.
    type Motion;

    /// Checks the reading and returns the motion.
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// use microimpact::instrument::{ObliqueReading, Reading};
    /// use microimpact::Parameter;
    ///
    /// let receding = ObliqueReading { approach: -1.0, tangential: 0.5 };
    /// assert_eq!(receding.motion().unwrap_err().parameter, Parameter::ApproachSpeed);
    /// ```
    fn motion(&self) -> Result<Self::Motion, InputError>;
}

/// Reading of a detector that measures the approach speed only.
///
/// ```
/// use microimpact::instrument::{NormalReading, Reading};
///
/// assert_eq!(NormalReading { approach: 2.8 }.motion()?.speed(), 2.8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalReading<T> {
    /// Approach speed, m/s.
    pub approach: T,
}

/// Reading of a detector that measures the velocity in a plane.
///
/// ```
/// use microimpact::Oblique;
/// use microimpact::instrument::{ObliqueReading, Reading};
///
/// assert_eq!(ObliqueReading { approach: 2.8, tangential: 1.0 }.motion()?.slip(), 1.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObliqueReading<T> {
    /// Approach speed, m/s.
    pub approach: T,
    /// Tangential velocity, m/s.
    pub tangential: T,
}

/// Reading of a detector that measures the velocity in a plane and the spin.
///
/// ```
/// use microimpact::Oblique;
/// use microimpact::instrument::{PlanarReading, Reading};
///
/// let reading = PlanarReading { approach: 2.8, tangential: 1.0, peripheral: 0.25 };
/// assert_eq!(reading.motion()?.slip(), 0.75);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlanarReading<T> {
    /// Approach speed, m/s.
    pub approach: T,
    /// Tangential velocity, m/s.
    pub tangential: T,
    /// Peripheral velocity, spin times radius, m/s.
    pub peripheral: T,
}

impl<T: Real> Reading for NormalReading<T> {
    type Motion = NormalMotion<T>;

    #[inline]
    fn motion(&self) -> Result<Self::Motion, InputError> {
        NormalMotion::new(self.approach)
    }
}

impl<T: Real> Reading for ObliqueReading<T> {
    type Motion = ObliqueMotion<T>;

    #[inline]
    fn motion(&self) -> Result<Self::Motion, InputError> {
        NormalMotion::new(self.approach)?.with_tangential(self.tangential)
    }
}

impl<T: Real> Reading for PlanarReading<T> {
    type Motion = PlanarMotion<T>;

    #[inline]
    fn motion(&self) -> Result<Self::Motion, InputError> {
        NormalMotion::new(self.approach)?.with_tangential(self.tangential)?.with_peripheral_velocity(self.peripheral)
    }
}
