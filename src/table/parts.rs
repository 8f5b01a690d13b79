//! The numbers of a restitution table, from which it is made as a constant or read back.

use super::{BoundaryTable, RestitutionTable};
use crate::{Fault, InputError, Parameter};

/// The numbers of a [`RestitutionTable`], as `microimpact table --format restitution-rust` writes them.
///
/// ```
/// use microimpact::CriticalSpeed;
/// use microimpact::table::{BoundaryTable, RestitutionTable, TableRebound};
///
/// let boundary = BoundaryTable::<2>::new(1e-6, |_: f32| Ok(CriticalSpeed::At(1.0)))?;
/// let source = |_, speed: f32| Ok(TableRebound { restitution: 1.0 - 1.0 / speed, impulse: 2.0 });
/// let table = RestitutionTable::<f32, 2, 3, 4>::new(boundary, 10.0, source)?;
/// assert_eq!(RestitutionTable::<f32, 2, 3, 4>::from_parts(table.parts()), Ok(table));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: serde::Serialize", deserialize = "T: Copy + Default + serde::Deserialize<'de>"))
)]
pub struct RestitutionParts<T, const N: usize, const R: usize, const S: usize> {
    /// The boundary between capture and rebound.
    pub boundary: BoundaryTable<N>,
    /// e/sqrt(d) and I/(m v) at the nodes: one row of speeds for each radius.
    #[cfg_attr(feature = "serde", serde(serialize_with = "in_one_row", deserialize_with = "from_one_row"))]
    pub nodes: [[[T; 2]; S]; R],
    /// Logarithm of the first radius, in units of 2^-23 octaves.
    pub first: i32,
    /// Nodes per octave of radii.
    pub per_octave: T,
    /// Nodes per unit of sqrt(d).
    pub per_root: T,
    /// Largest logarithm of speed over critical speed, in units of 2^-23 octaves.
    pub end: i32,
    /// Bound of the interpolation error of the restitution.
    pub error: T,
    /// Bound of the interpolation error of the impulse over m v.
    pub impulse_error: T,
    /// Error of the restitution by the margin of the boundary, times sqrt(d).
    pub near: T,
    /// The same error of the impulse over that of the restitution.
    pub impulse_over_restitution: T,
}

macro_rules! of_number {
    ($number:ty) => {
        impl<const N: usize, const R: usize, const S: usize> RestitutionTable<$number, N, R, S> {
            /// The table with these numbers, which a `const` or `static` can hold.
            ///
            /// # Errors
            /// [`Parameter::SpeedRatio`] if the range of speeds or radii does not belong to a table, [`Parameter::Restitution`] or
            /// [`Parameter::ImpulseOverMomentum`] if a node or an error is negative or not finite.
            ///
            /// ```
            /// use microimpact::CriticalSpeed;
            /// use microimpact::table::{BoundaryTable, RestitutionParts, RestitutionTable, TableRebound};
            ///
            /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
            /// let source = |_, speed: f64| Ok(TableRebound { restitution: 1.0 - 1.0 / speed, impulse: 2.0 });
            /// let parts = RestitutionTable::<f64, 2, 3, 4>::new(boundary, 10.0, source)?.parts();
            /// let damaged = RestitutionParts { error: f64::NAN, ..parts };
            /// assert!(RestitutionTable::<f64, 2, 3, 4>::from_parts(damaged).is_err());
            /// # Ok::<(), microimpact::InputError>(())
            /// ```
            pub const fn from_parts(parts: RestitutionParts<$number, N, R, S>) -> Result<Self, InputError> {
                const { Self::COUNTED }
                const fn holds(value: $number) -> bool {
                    value >= 0.0 && value.is_finite()
                }
                const fn refused(parameter: Parameter, value: $number) -> InputError {
                    let fault = if value.is_finite() { Fault::TooSmall } else { Fault::NotFinite };
                    InputError { parameter, fault, value: value as f32 }
                }
                let RestitutionParts { boundary, nodes, first, per_octave, per_root, end, .. } = parts;
                let RestitutionParts { error, impulse_error, near, impulse_over_restitution, .. } = parts;
                if end <= 0 || !holds(per_root) || !holds(per_octave) {
                    return Err(refused(Parameter::SpeedRatio, end as $number));
                }
                let mut rows = nodes.as_slice();
                while let [row, rest @ ..] = rows {
                    let mut places = row.as_slice();
                    while let [[restitution, impulse], rest @ ..] = places {
                        if !holds(*restitution) {
                            return Err(refused(Parameter::Restitution, *restitution));
                        }
                        if !holds(*impulse) {
                            return Err(refused(Parameter::ImpulseOverMomentum, *impulse));
                        }
                        places = rest;
                    }
                    rows = rest;
                }
                if !holds(error) || !holds(near) {
                    return Err(refused(Parameter::Restitution, if holds(error) { near } else { error }));
                }
                if !holds(impulse_error) || !holds(impulse_over_restitution) {
                    let wrong = if holds(impulse_error) { impulse_over_restitution } else { impulse_error };
                    return Err(refused(Parameter::ImpulseOverMomentum, wrong));
                }
                Ok(Self {
                    boundary,
                    nodes,
                    first,
                    per_octave,
                    per_root,
                    end,
                    error,
                    impulse_error,
                    near,
                    impulse_over_restitution,
                })
            }
        }

        #[cfg(feature = "serde")]
        impl<const N: usize, const R: usize, const S: usize> TryFrom<RestitutionParts<$number, N, R, S>>
            for RestitutionTable<$number, N, R, S>
        {
            type Error = InputError;

            fn try_from(parts: RestitutionParts<$number, N, R, S>) -> Result<Self, InputError> {
                Self::from_parts(parts)
            }
        }
    };
}

of_number!(f32);
of_number!(f64);

impl<T: Copy, const N: usize, const R: usize, const S: usize> RestitutionTable<T, N, R, S> {
    /// The numbers of the table, for `from_parts`, which f32 and f64 have.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTable, TableRebound};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: 1.0 - 1.0 / speed, impulse: 2.0 });
    /// let table = RestitutionTable::<f64, 2, 3, 4>::new(boundary, 10.0, source)?;
    /// assert_eq!(table.parts().error, table.error());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn parts(&self) -> RestitutionParts<T, N, R, S> {
        RestitutionParts {
            boundary: self.boundary,
            nodes: self.nodes,
            first: self.first,
            per_octave: self.per_octave,
            per_root: self.per_root,
            end: self.end,
            error: self.error,
            impulse_error: self.impulse_error,
            near: self.near,
            impulse_over_restitution: self.impulse_over_restitution,
        }
    }
}

#[cfg(feature = "serde")]
impl<T: Copy, const N: usize, const R: usize, const S: usize> From<RestitutionTable<T, N, R, S>>
    for RestitutionParts<T, N, R, S>
{
    fn from(table: RestitutionTable<T, N, R, S>) -> Self {
        table.parts()
    }
}

/// Serializes the nodes as one sequence, because serde does not support arrays of every length.
#[cfg(feature = "serde")]
fn in_one_row<T, Z, const R: usize, const S: usize>(nodes: &[[[T; 2]; S]; R], serializer: Z) -> Result<Z::Ok, Z::Error>
where
    T: serde::Serialize,
    Z: serde::Serializer,
{
    serializer.collect_seq(nodes.iter().flatten().flatten())
}

/// Reads the nodes back.
#[cfg(feature = "serde")]
fn from_one_row<'de, T, D, const R: usize, const S: usize>(deserializer: D) -> Result<[[[T; 2]; S]; R], D::Error>
where
    T: Copy + Default + serde::Deserialize<'de>,
    D: serde::Deserializer<'de>,
{
    use core::fmt;
    use core::marker::PhantomData;
    use serde::de::{Error, SeqAccess, Visitor};

    struct OneRow<T, const R: usize, const S: usize>(PhantomData<T>);

    impl<'de, T: Copy + Default + serde::Deserialize<'de>, const R: usize, const S: usize> Visitor<'de>
        for OneRow<T, R, S>
    {
        type Value = [[[T; 2]; S]; R];

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "{} numbers", 2 * R * S)
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
            let mut nodes = [[[T::default(); 2]; S]; R];
            for (read, place) in nodes.iter_mut().flatten().flatten().enumerate() {
                *place = sequence.next_element()?.ok_or_else(|| A::Error::invalid_length(read, &self))?;
            }
            if sequence.next_element::<T>()?.is_some() {
                return Err(A::Error::invalid_length(2 * R * S + 1, &self));
            }
            Ok(nodes)
        }
    }

    deserializer.deserialize_seq(OneRow(PhantomData))
}
