//! From measurements to the parameters of the models.
//!
//! One impact gives one parameter of a contact, by a bracketed search of bounded length: damping, the strength of
//! adhesion, the radius; derivatives give its standard error. Many impacts give the restitution law and the work of adhesion,
//! the friction coefficient or the spin, each with its standard error and whatever the outliers are. What a measurement
//! cannot tell is a [`CalibrationError`] that says why.

mod contact;
mod error;
mod restitution;
mod robust;
mod root;
mod tangential;

pub use contact::{adhesion_damping, estimate, material_damping, parameter, ring_strength};
pub use error::CalibrationError;
pub use restitution::RestitutionFit;
pub use robust::{Estimate, Location};
pub use tangential::{ImpulseRatios, friction, rolling_motion};

use crate::{InputError, NormalMotion, Parameter, Real};

/// A measured impact along the normal.
///
/// ```
/// use microimpact::calibrate::Rebound;
///
/// let rebound = Rebound::from_speeds(2.80, 2.09)?;
/// assert!((rebound.restitution - 0.746_f64).abs() < 0.0005);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rebound<T> {
    /// Approach speed -v_n, m/s.
    pub speed: T,
    /// Restitution e, or R where adhesion plays no part; zero for a capture.
    pub restitution: T,
}

impl<T: Real> Rebound<T> {
    /// The impact whose speeds before and after were measured, m/s.
    ///
    /// # Errors
    /// A speed outside its range, or a rebound faster than the approach.
    ///
    /// ```
    /// use microimpact::calibrate::Rebound;
    ///
    /// assert!(Rebound::from_speeds(2.0, 2.1).is_err());
    /// ```
    pub fn from_speeds(approach: T, rebound: T) -> Result<Self, InputError> {
        let motion = NormalMotion::new(approach)?;
        let rebound = Parameter::ReboundSpeed.check(rebound)?;
        let restitution = Parameter::Restitution.check(rebound.saturating_div(motion.speed()))?;
        Ok(Self { speed: motion.speed(), restitution })
    }

    /// The motion before the impact and the square of the restitution.
    fn checked(&self) -> Result<(NormalMotion<T>, T), InputError> {
        let restitution = Parameter::Restitution.check(self.restitution)?;
        Ok((NormalMotion::new(self.speed)?, restitution * restitution))
    }
}
