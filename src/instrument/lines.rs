//! Lines that tell other electronics the class: one for each, high for the latest impact.

use core::convert::Infallible;

use embedded_hal::digital::OutputPin;

use super::ClassSet;

/// Shows the class of the latest impact to the outside.
///
/// ```
/// use core::convert::Infallible;
/// use microimpact::{Outcome, instrument::Signal};
///
/// /// Counts captures.
/// struct Counter(u32);
/// impl Signal<Outcome> for Counter {
///     type Error = Infallible;
///     fn show(&mut self, class: Option<Outcome>) -> Result<(), Infallible> {
///         self.0 += u32::from(class == Some(Outcome::Capture));
///         Ok(())
///     }
/// }
/// let mut counter = Counter(0);
/// assert_eq!(counter.show(Some(Outcome::Capture)), Ok(()));
/// assert_eq!(counter.0, 1);
/// ```
pub trait Signal<C> {
    /// Why a class cannot be shown.
    type Error;

    /// Shows a class, or that the latest reading has none.
    ///
    /// # Errors
    /// An output that does not switch.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{NoLines, Signal};
    ///
    /// assert!(NoLines.show(Some(Outcome::Rebound)).is_ok());
    /// ```
    fn show(&mut self, class: Option<C>) -> Result<(), Self::Error>;
}

/// No lines.
///
/// ```
/// assert_eq!(size_of::<microimpact::instrument::NoLines>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NoLines;

impl<C> Signal<C> for NoLines {
    type Error = Infallible;

    #[inline]
    fn show(&mut self, _class: Option<C>) -> Result<(), Infallible> {
        Ok(())
    }
}

/// A line for each class, in the order of [`ClassSet::ALL`]; never two are high at a time.
///
/// ```
/// use embedded_hal::digital::{ErrorType, OutputPin};
/// use microimpact::Outcome;
/// use microimpact::instrument::{ClassLines, Signal};
///
/// #[derive(Debug, PartialEq)]
/// struct Line(bool);
/// impl ErrorType for Line {
///     type Error = core::convert::Infallible;
/// }
/// impl OutputPin for Line {
///     fn set_low(&mut self) -> Result<(), Self::Error> {
///         Ok(self.0 = false)
///     }
///     fn set_high(&mut self) -> Result<(), Self::Error> {
///         Ok(self.0 = true)
///     }
/// }
///
/// let mut lines = ClassLines::new([Line(false), Line(true)]);
/// assert!(lines.show(Some(Outcome::Rebound)).is_ok());
/// assert_eq!(lines.release(), [Line(true), Line(false)]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClassLines<P, const CLASSES: usize> {
    pins: [P; CLASSES],
}

impl<P, const CLASSES: usize> ClassLines<P, CLASSES> {
    /// Lines on these pins, which may be `&mut dyn OutputPin` where their types differ.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::ClassLines::new([0, 1]).release(), [0, 1]);
    /// ```
    pub const fn new(pins: [P; CLASSES]) -> Self {
        Self { pins }
    }

    /// The pins.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::ClassLines::new(["a", "b"]).release(), ["a", "b"]);
    /// ```
    pub fn release(self) -> [P; CLASSES] {
        self.pins
    }
}

impl<C: ClassSet, P: OutputPin, const CLASSES: usize> Signal<C> for ClassLines<P, CLASSES> {
    type Error = P::Error;

    /// Switches off first, so that no two lines are high at any time; one that fails keeps none of the others from switching.
    fn show(&mut self, class: Option<C>) -> Result<(), P::Error> {
        const { assert!(CLASSES == C::COUNT, "there is a line for each class") };
        let high = class.map(C::index);
        let mut result = Ok(());
        for (index, pin) in self.pins.iter_mut().enumerate() {
            if Some(index) != high {
                result = result.and(pin.set_low());
            }
        }
        // With another line stuck high, this one would show a second class.
        result?;
        match high.and_then(|index| self.pins.get_mut(index)) {
            Some(pin) => pin.set_high(),
            None => Ok(()),
        }
    }
}
