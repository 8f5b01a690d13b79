//! Class lines: digital outputs that show the class of the latest impact.

use core::convert::Infallible;

use embedded_hal::digital::OutputPin;

use super::ClassSet;

/// An output that shows the class of the latest impact.
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
    /// Error of the output.
    type Error;

    /// Shows a class; `None` if the latest reading has no class.
    ///
    /// # Errors
    /// An output does not switch.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{NoLines, Signal};
    ///
    /// assert!(NoLines.show(Some(Outcome::Rebound)).is_ok());
    /// ```
    fn show(&mut self, class: Option<C>) -> Result<(), Self::Error>;
}

/// No class lines.
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

/// One line for each class, in the order of [`ClassSet::ALL`]. Two lines are never high at the same time.
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
/// let mut lines = ClassLines::new([Line(false), Line(true), Line(false)]);
/// assert!(lines.show(Some(Outcome::Rebound)).is_ok());
/// assert_eq!(lines.release(), [Line(true), Line(false), Line(false)]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClassLines<P, const CLASSES: usize> {
    pins: [P; CLASSES],
}

impl<P, const CLASSES: usize> ClassLines<P, CLASSES> {
    /// Creates lines from pins. Pins of different types can be passed as `&mut dyn OutputPin`.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::ClassLines::new([0, 1]).release(), [0, 1]);
    /// ```
    pub const fn new(pins: [P; CLASSES]) -> Self {
        Self { pins }
    }

    /// Returns the pins.
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

    /// Switches lines off before it switches one on, so that two lines are never high. If a line fails, the others still
    /// switch off.
    fn show(&mut self, class: Option<C>) -> Result<(), P::Error> {
        const { assert!(CLASSES == C::COUNT, "there must be one line for each class") };
        let high = class.map(C::index);
        let mut result = Ok(());
        for (index, pin) in self.pins.iter_mut().enumerate() {
            if Some(index) != high {
                result = result.and(pin.set_low());
            }
        }
        // If another line stays high, switching on this one would show two classes.
        result?;
        match high.and_then(|index| self.pins.get_mut(index)) {
            Some(pin) => pin.set_high(),
            None => Ok(()),
        }
    }
}
