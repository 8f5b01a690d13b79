//! Errors of a calibration.

use core::fmt;

use crate::InputError;
use crate::numbers::NotConverged;

/// Why a measurement does not determine a parameter.
///
/// ```
/// use microimpact::measure::{CalibrationError, MeasuredRebound, material_damping};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Sphere, Stiffness};
///
/// // With this adhesion even an undamped sphere is captured.
/// let scene = Contact::hertz(Sphere::solid(1e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_ring(250.0, 50.0)?;
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let found = material_damping(&scene, &method, &MeasuredRebound { speed: 2.8, restitution: 0.6 }, 1e-9);
/// assert_eq!(found, Err(CalibrationError::ReboundTooFast));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CalibrationError {
    /// An input is outside its range.
    Input(InputError),
    /// The measured rebound is faster than that for any value of the parameter.
    ReboundTooFast,
    /// The measured rebound is slower than that for any value of the parameter.
    ReboundTooSlow,
    /// The measured sphere was captured. A capture bounds the parameter but does not determine it.
    Captured,
    /// The simulation or the search did not converge within its largest number of steps.
    NotConverged,
    /// There are fewer measurements than the fit needs.
    TooFew,
    /// The measurements are too similar, or too scattered, to determine each parameter.
    Undetermined,
    /// The restitution does not decrease with speed, so that the restitution speed k has no upper bound.
    NoMaterialLoss,
}

impl From<NotConverged> for CalibrationError {
    fn from(_: NotConverged) -> Self {
        Self::NotConverged
    }
}

impl From<InputError> for CalibrationError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl fmt::Display for CalibrationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Input(error) => return error.fmt(f),
            Self::ReboundTooFast => {
                "the measured rebound is faster than that for any value of the parameter; check the speeds and the other \
                 parameters"
            },
            Self::ReboundTooSlow => {
                "the measured rebound is slower than that for any value of the parameter; check the speeds and the other \
                 parameters"
            },
            Self::Captured => "the sphere was captured, which does not determine the parameter; use a rebound",
            Self::NotConverged => "the search did not converge; use a larger tolerance",
            Self::TooFew => "there are fewer measurements than the fit needs; add measurements",
            Self::Undetermined => "the measurements do not determine each parameter; add measurements at other speeds",
            Self::NoMaterialLoss => {
                "the restitution does not decrease with speed, so the restitution speed has no upper bound; add faster rebounds"
            },
        })
    }
}

impl core::error::Error for CalibrationError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Input(error) => Some(error),
            _ => None,
        }
    }
}
