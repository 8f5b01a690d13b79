//! The end of contact before damping pulls.

use super::Attraction;
use super::hertz::HertzUnits;
use crate::{InputError, Real, Sphere};

/// No adhesion and no tension: contact ends where damping cancels the elastic force (Schwager and Poeschel 2008), and not at zero
/// indentation. Damping other than hysteretic would draw the surfaces together there.
///
/// ```
/// assert_eq!(size_of::<microimpact::contact::NoTension>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoTension;

impl<T: Real> Attraction<T> for NoTension {
    #[inline]
    fn in_units(&self, _sphere: &Sphere<T>, _units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self)
    }

    #[inline]
    fn moves_peak(&self) -> bool {
        false
    }

    #[inline]
    fn ends_without_force(&self) -> bool {
        true
    }
}
