//! Why a measurement does not give a parameter.

use core::fmt;

use crate::InputError;

/// A measurement that no value of the parameter explains, or that does not determine it.
///
/// ```
/// use microimpact::calibrate::{CalibrationError, Rebound, material_damping};
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{Sphere, Stiffness};
///
/// // With this adhesion even an undamped sphere is captured.
/// let scene = Simulation::new(Sphere::solid(1e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_ring(250.0, 50.0)?;
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let found = material_damping(&scene, &method, &Rebound { speed: 2.8, restitution: 0.6 }, 1e-9);
/// assert_eq!(found, Err(CalibrationError::ReboundTooFast));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CalibrationError {
    /// An input lies outside its range.
    Input(InputError),
    /// The measured rebound is faster than with any value of the parameter.
    ReboundTooFast,
    /// The measured rebound is slower than with any value of the parameter.
    ReboundTooSlow,
    /// A capture bounds the parameter and does not determine it.
    Captured,
    /// The simulation, or the search, has spent its budget.
    BudgetSpent,
    /// Fewer measurements than the parameters need.
    TooFew,
    /// The measurements are too alike, or too scattered, to tell the parameters apart.
    Undetermined,
    /// The rebounds do not slow down with speed: the restitution speed k has no upper bound.
    NoMaterialLoss,
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
            Self::ReboundTooFast => "the measured rebound is faster than with any value of the parameter",
            Self::ReboundTooSlow => "the measured rebound is slower than with any value of the parameter",
            Self::Captured => "a capture bounds the parameter and does not determine it",
            Self::BudgetSpent => "the search has spent its budget",
            Self::TooFew => "there are fewer measurements than the parameters need",
            Self::Undetermined => "the measurements do not tell the parameters apart",
            Self::NoMaterialLoss => "rebounds do not slow down with speed: the restitution speed has no upper bound",
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
