//! Boundary tables: the critical speed as a function of the radius.

use super::TableOutcome;
use super::logarithm::{OCTAVE, Single, logarithm, number};
use super::slice::{BoundarySlice, CELL, of_single};
use crate::{Approach, CriticalSpeed, InputError, Real};

/// Relative error of one unit of a logarithm.
const UNIT: f64 = core::f64::consts::LN_2 / OCTAVE as f64;

/// The critical speed as a function of the radius, in `N` cells, with a bound of the error.
///
/// An octave of radii has four cells. The first cell begins at a multiple of a quarter of an octave. In each cell, the
/// logarithm of the critical speed is a cubic function of the radius with integer coefficients, which takes 16 bytes. The
/// table does not depend on the number type of the lookup.
///
/// ```
/// use microimpact::table::{BoundaryTable, TableOutcome};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Glass on steel (the paper's figure 6), from radii of 2 to 8 um.
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let table = BoundaryTable::<8>::new(2e-6, |radius| {
///     let sphere = Sphere::solid(radius, 2600.0)?;
///     let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
///     scene.critical_speed(&method)
/// })?;
/// assert!(table.margin::<f64>() < 1e-4);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(5.155)?), TableOutcome::Capture);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(5.165)?), TableOutcome::Rebound);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(5.15957)?), TableOutcome::TooCloseToCall);
/// assert_eq!(table.classify(1e-6, &NormalMotion::new(5.0)?), TableOutcome::OutsideTable);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "Parts<N>", try_from = "Parts<N>"))]
pub struct BoundaryTable<const N: usize> {
    pub(super) cells: [[i32; 4]; N],
    /// Bits of the radius in the middle of the first cell.
    pub(super) first: u32,
    pub(super) margin: u32,
}

impl<const N: usize> BoundaryTable<N> {
    /// Fills a table that starts at the radius `smallest` (m).
    ///
    /// The source of critical speeds is [`Contact::critical_speed`], [`RigidBody::critical_speed`] or a measurement. It is
    /// called for seven radii in each cell: the cubic interpolates four of them, and its error is measured at the other three,
    /// where it is largest. The margin is twice the largest error found, plus the rounding error of a lookup. It bounds the
    /// error of the whole table if the fourth derivative of the curve is nowhere more than twice its smallest value in the
    /// cell with the largest error. The error of the source is not included. A
    /// [`BoundaryTableMaker`](super::BoundaryTableMaker) does the same in steps, of one call of the source or more.
    ///
    /// # Errors
    /// A radius is outside its range; [`Parameter::CriticalSpeed`] if every speed rebounds (too small) or if no speed rebounds
    /// (too large); [`Parameter::BoundaryMargin`] if a cubic does not fit the curve; and the errors of the source.
    ///
    /// [`Contact::critical_speed`]: crate::contact::Contact::critical_speed
    /// [`RigidBody::critical_speed`]: crate::RigidBody::critical_speed
    /// [`Parameter::CriticalSpeed`]: crate::Parameter::CriticalSpeed
    /// [`Parameter::BoundaryMargin`]: crate::Parameter::BoundaryMargin
    ///
    /// ```
    /// use microimpact::table::BoundaryTable;
    /// use microimpact::{Parameter, RigidBody, SpeedRestitution, Sphere};
    ///
    /// // The rigid-body model with a work of adhesion of 50 mJ/m^2 on one hundredth of the cross-section.
    /// let critical = |radius: f64| {
    ///     let scene = RigidBody::new(Sphere::solid(radius, 2600.0)?, SpeedRestitution::new(130.0)?);
    ///     Ok(scene.with_work_of_adhesion(0.05 * 0.0314 * radius * radius)?.critical_speed())
    /// };
    /// assert!(BoundaryTable::<8>::new(2e-6, critical)?.margin::<f64>() < 1e-4);
    /// let bare = |radius| Ok(RigidBody::new(Sphere::solid(radius, 2600.0)?, SpeedRestitution::new(130.0)?).critical_speed());
    /// assert_eq!(BoundaryTable::<8>::new(2e-6, bare).unwrap_err().parameter, Parameter::CriticalSpeed);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new<T: Single>(
        smallest: T,
        critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<Self, InputError> {
        const { Self::COUNTED }
        let mut cells = [[0; 4]; N];
        let BoundarySlice { first, margin, .. } = BoundarySlice::fill(smallest, &mut cells, critical)?;
        Ok(Self { cells, first, margin })
    }

    /// Creates a table from its [`parts`](Self::parts): the radius `smallest` (m), the margin and the cells.
    ///
    /// The function can be evaluated at compile time, so that a table can be a constant.
    ///
    /// # Errors
    /// The radius is outside its range; [`Parameter::CriticalSpeed`] if a cell holds values that are not speeds;
    /// [`Parameter::BoundaryMargin`] if the margin is too large, or smaller than the jumps between neighbouring cells.
    ///
    /// [`Parameter::CriticalSpeed`]: crate::Parameter::CriticalSpeed
    /// [`Parameter::BoundaryMargin`]: crate::Parameter::BoundaryMargin
    ///
    /// ```
    /// use microimpact::NormalMotion;
    /// use microimpact::table::{BoundaryTable, TableOutcome};
    ///
    /// // The example `boundary` writes these numbers. An invalid table stops the compilation.
    /// const TABLE: BoundaryTable<2> = match BoundaryTable::from_parts(1.9073486e-6, 592, [
    ///     [1_088_728_656, -5_161_287, 647_136, -107_606],
    ///     [1_084_119_581, -4_133_047, 413_760, -54_992],
    /// ]) {
    ///     Ok(table) => table,
    ///     Err(_) => panic!("no boundary table"),
    /// };
    /// assert_eq!(TABLE.classify(2.5e-6, &NormalMotion::new(5.1)?), TableOutcome::Capture);
    /// assert_eq!(TABLE.classify(2.5e-6_f32, &NormalMotion::new(5.3)?), TableOutcome::Rebound);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn from_parts(smallest: f32, margin: u32, cells: [[i32; 4]; N]) -> Result<Self, InputError> {
        const { Self::COUNTED }
        match BoundarySlice::from_parts(smallest, margin, &cells) {
            Ok(BoundarySlice { first, margin, .. }) => Ok(Self { cells, first, margin }),
            Err(error) => Err(error),
        }
    }

    pub(super) const COUNTED: () = assert!(N > 0 && N <= 128, "a table has 1 to 128 cells");

    /// The same table as a [`BoundarySlice`], whose type does not contain the number of cells.
    ///
    /// ```
    /// use microimpact::table::{BoundaryTable, TableOutcome};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert_eq!(table.as_slice().classify(1.25e-6, &NormalMotion::new(0.9)?), TableOutcome::Rebound);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub const fn as_slice(&self) -> BoundarySlice<'_> {
        BoundarySlice { cells: &self.cells, first: self.first, margin: self.margin }
    }

    /// Smallest radius (m), margin in units of 2^-23 octaves, and cells.
    ///
    /// A cell holds the four coefficients of a cubic, lowest power first. The value of the cubic is 2^23 (127 + log2 v_c) less
    /// the margin, where v_c is the critical speed in m/s. Its variable is linear in the radius, from -1/2 at the start of the
    /// cell to 1/2 at the end.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundaryTable;
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// let (smallest, margin, cells) = table.parts();
    /// assert_eq!(BoundaryTable::from_parts(smallest, margin, *cells), Ok(table));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn parts(&self) -> (f32, u32, &[[i32; 4]; N]) {
        let (smallest, margin, _) = self.as_slice().parts();
        (smallest, margin, &self.cells)
    }

    /// Bound of the relative error of the critical speed. Speeds within it are [`TableOutcome::TooCloseToCall`].
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundaryTable;
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |_| Ok(CriticalSpeed::At(1.0)))?;
    /// assert!(table.margin::<f64>() < 2e-5);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn margin<T: Real>(&self) -> T {
        T::constant(f64::from(self.margin) * UNIT)
    }

    /// Smallest radius in the table and first radius beyond it, m.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundaryTable;
    ///
    /// let table = BoundaryTable::<8>::new(1e-6, |_| Ok(CriticalSpeed::At(1.0)))?;
    /// let (smallest, end) = table.radii::<f64>();
    /// assert!(smallest <= 1e-6 && smallest > 0.8e-6);
    /// assert!((end / smallest - 4.0).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn radii<T: Real>(&self) -> (T, T) {
        let (smallest, largest) = self.ends();
        (of_single(smallest), of_single(largest + 1))
    }

    /// Critical speed of a `radius` (m), in m/s, with an error of at most the margin. `None` outside the table.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundaryTable;
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert!((table.critical_speed(1.25e-6).unwrap() - 0.8_f64).abs() < 1e-4);
    /// assert_eq!(table.critical_speed(f64::NAN), None);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn critical_speed<T: Single>(&self, radius: T) -> Option<T> {
        Some(of_single(number(self.logarithm_at(radius)?).to_bits()))
    }

    /// Classifies the impact of a sphere of `radius` (m) that arrives with `motion`.
    ///
    /// ```
    /// use microimpact::table::{BoundaryTable, TableOutcome};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert_eq!(table.classify(1.25e-6_f32, &NormalMotion::new(0.9)?), TableOutcome::Rebound);
    /// assert_eq!(table.classify(f32::INFINITY, &NormalMotion::new(0.9)?), TableOutcome::OutsideTable);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn classify<T: Single>(&self, radius: T, motion: &impl Approach<T>) -> TableOutcome {
        self.as_slice().classify(radius, motion)
    }

    /// Logarithm of the critical speed of a radius.
    #[inline]
    pub(super) fn logarithm_at<T: Single>(&self, radius: T) -> Option<i32> {
        Some(self.as_slice().edge_at(radius)?.wrapping_add_unsigned(self.margin))
    }

    /// Bits of the first and the last radius.
    fn ends(&self) -> (u32, u32) {
        let smallest = self.first - CELL / 2;
        (smallest, smallest + N as u32 * CELL - 1)
    }

    /// Logarithms of the first and the last radius.
    pub(super) fn logarithms(&self) -> (i32, i32) {
        let (smallest, largest) = self.ends();
        (logarithm(f32::from_bits(smallest)), logarithm(f32::from_bits(largest)))
    }

    /// The radius in the table whose logarithm is nearest to the given one.
    pub(super) fn radius_at(&self, logarithm: i32) -> f32 {
        let (smallest, largest) = self.ends();
        f32::from_bits(number(logarithm).to_bits().max(smallest).min(largest))
    }
}

/// The serialized form of a table.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Parts<const N: usize> {
    /// Smallest radius, m.
    smallest_radius: f32,
    margin: u32,
    #[serde(with = "serde_big_array::BigArray")]
    cells: [[i32; 4]; N],
}

#[cfg(feature = "serde")]
impl<const N: usize> From<BoundaryTable<N>> for Parts<N> {
    fn from(table: BoundaryTable<N>) -> Self {
        let (smallest_radius, margin, cells) = table.parts();
        Self { smallest_radius, margin, cells: *cells }
    }
}

#[cfg(feature = "serde")]
impl<const N: usize> TryFrom<Parts<N>> for BoundaryTable<N> {
    type Error = InputError;

    fn try_from(outside: Parts<N>) -> Result<Self, InputError> {
        Self::from_parts(outside.smallest_radius, outside.margin, outside.cells)
    }
}

#[cfg(all(test, feature = "link"))]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::BoundaryTable;

    /// Postcard's form of whole numbers: seven bits a byte, the least significant first, all but the last with the top bit set.
    fn variable_length(mut number: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        while number > 127 {
            bytes.push(number as u8 | 128);
            number >>= 7;
        }
        bytes.push(number as u8);
        bytes
    }

    /// In an interpreter of a processor whose most significant byte is first, this shows that a table stored in the link's format
    /// does not depend on the order of bytes.
    #[test]
    fn stored_bytes_are_numbers_with_the_least_significant_byte_first() {
        // A cell that the example `boundary` writes.
        const CELLS: [[i32; 4]; 1] = [[1_088_728_656, -5_161_287, 647_136, -107_606]];
        const MARGIN: u32 = 592;
        let table = BoundaryTable::from_parts(1.907_348_6e-6, MARGIN, CELLS);
        let smallest = table.map(|table| table.parts().0).unwrap_or_default();
        let mut expected = Vec::from(smallest.to_le_bytes());
        expected.extend(variable_length(MARGIN));
        // A sign is the last bit, so that small numbers are short.
        expected.extend(
            CELLS.into_iter().flatten().flat_map(|number| variable_length(((number << 1) ^ (number >> 31)) as u32)),
        );
        let mut bytes = [0; 64];
        let stored = table.ok().and_then(|table| postcard::to_slice(&table, &mut bytes).ok().map(Vec::from));
        assert_eq!(stored, Some(expected));
        assert_eq!(postcard::from_bytes(&bytes).ok(), table.ok());
    }
}
