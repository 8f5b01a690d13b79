//! What the numbers in the messages of a link mean.

use crate::instrument::{
    NormalReading, ObliqueReading, PlanarReading, SizedReading, Stamped, TabulatedClass, UncertainReading,
};
use crate::table::TableOutcome;
use crate::{Class, Outcome};

/// A number type, a kind of reading or a set of classes that a [`Schema`] can name.
///
/// ```
/// use microimpact::Class;
/// use microimpact::instrument::PlanarReading;
/// use microimpact::instrument::link::Described;
///
/// /// Classes of an instrument of your own.
/// struct Sizes;
///
/// impl Described for Sizes {
///     const ID: u8 = 128;
/// }
/// assert_eq!((<f32 as Described>::ID, PlanarReading::<f32>::ID, Class::ID, Sizes::ID), (1, 3, 2, 128));
/// ```
pub trait Described {
    /// Number of the type: those of this library are below 128. Types of your own have numbers from 128 to 143.
    const ID: u8;
}

macro_rules! described {
    ($($type:ty: $id:literal;)*) => {
        $(impl Described for $type {
            const ID: u8 = $id;
        })*
    };
}

described! {
    f32: 1;
    f64: 2;
    Outcome: 1;
    Class: 2;
    TableOutcome: 3;
    TabulatedClass: 4;
}

impl<T> Described for NormalReading<T> {
    const ID: u8 = 1;
}

impl<T> Described for ObliqueReading<T> {
    const ID: u8 = 2;
}

impl<T> Described for PlanarReading<T> {
    const ID: u8 = 3;
}

impl<T> Described for UncertainReading<T> {
    const ID: u8 = 4;
}

impl<T, R: Described> Described for SizedReading<T, R> {
    const ID: u8 = {
        assert!(R::ID & 0x30 == 0, "a sized reading is stamped, not the reading in it");
        R::ID | 0x10
    };
}

impl<R: Described> Described for Stamped<R> {
    const ID: u8 = {
        assert!(R::ID & 0x20 == 0, "a reading is stamped once");
        R::ID | 0x20
    };
}

/// What an instrument speaks of: its number type, its readings and its classes.
///
/// Messages do not say it themselves. A host of another number type would read wrong numbers out of a frame whose checksum is right,
/// so that an instrument names its schema first, and a host refuses another.
///
/// ```
/// use microimpact::instrument::PlanarReading;
/// use microimpact::instrument::link::Schema;
/// use microimpact::{Class, Outcome};
///
/// let of_firmware = Schema::of::<f32, PlanarReading<f32>, Class>();
/// assert_ne!(of_firmware, Schema::of::<f64, PlanarReading<f64>, Class>());
/// assert_ne!(of_firmware, Schema::of::<f32, PlanarReading<f32>, Outcome>());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Schema {
    /// The [`Described::ID`] of the number type.
    pub number: u8,
    /// That of the readings.
    pub reading: u8,
    /// That of the set of classes.
    pub classes: u8,
}

impl Schema {
    /// The schema of numbers `T`, readings `R` and classes `C`.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::NormalReading;
    /// use microimpact::instrument::link::Schema;
    ///
    /// let schema = Schema::of::<f32, NormalReading<f32>, Outcome>();
    /// assert_eq!(schema, Schema { number: 1, reading: 1, classes: 1 });
    /// ```
    pub const fn of<T: Described, R: Described, C: Described>() -> Self {
        Self { number: T::ID, reading: R::ID, classes: C::ID }
    }
}
