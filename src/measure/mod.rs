//! From measurements to parameters and probabilities.
//!
//! * **One impact** determines one parameter of a contact, such as the damping, the strength of adhesion or the radius:
//!   [`material_damping`], [`adhesion_damping`], [`ring_strength`] and [`parameter`]. The search is bracketed and ends after a
//!   bounded number of steps. [`estimate`] adds the standard error, from derivatives.
//! * **Many impacts** determine the restitution law and the work of adhesion ([`RestitutionFit`]), the friction coefficient
//!   ([`friction`]) or the spin ([`rolling_motion`]), each with its standard error. Outliers do not change the result.
//! * **Uncertain inputs** give [probabilities of the classes](ClassProbabilities), of the rigid body and of the simulation. With
//!   standard errors of up to 10 %, the error of a probability is below 0.01, but for a few motions that are close to capture and to
//!   the limit of slip at once: there it may be 0.03.
//!
//! If a measurement does not determine a parameter, the result is a [`CalibrationError`] with the reason.

mod contact;
mod error;
mod restitution;
mod robust;
mod tangential;
mod uncertainty;

pub use contact::{adhesion_damping, estimate, material_damping, parameter, ring_strength};
pub use error::CalibrationError;
pub use restitution::{Interval, MeasuredImpact, RestitutionFit};
pub use robust::{Estimate, Location};
pub use tangential::{ImpulseRatios, friction, rolling_motion};
pub use uncertainty::{ClassProbabilities, Classifiable, NormalDistribution, Uncertain};

use crate::{InputError, NormalMotion, Parameter, Real};

/// A measured impact along the normal.
///
/// ```
/// use microimpact::measure::MeasuredRebound;
///
/// let rebound = MeasuredRebound::from_speeds(2.80, 2.09)?;
/// assert!((rebound.restitution - 0.746_f64).abs() < 0.0005);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeasuredRebound<T> {
    /// Approach speed -v_n, m/s.
    pub speed: T,
    /// Restitution: e, or R if adhesion is negligible; zero for a capture.
    pub restitution: T,
}

impl<T: Real> MeasuredRebound<T> {
    /// Creates the impact from its speeds before and after, m/s.
    ///
    /// # Errors
    /// A speed is outside its range, or the rebound is faster than the approach.
    ///
    /// ```
    /// use microimpact::measure::MeasuredRebound;
    ///
    /// assert!(MeasuredRebound::from_speeds(2.0, 2.1).is_err());
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
