//! Boundary tables whose cells are stored elsewhere.

use super::TableOutcome;
use super::boundary_maker::BoundarySliceMaker;
use super::logarithm::{LARGEST_ERROR, OCTAVE, Single, logarithm, number};
use crate::{Approach, CriticalSpeed, Fault, InputError, Parameter, Real};

/// Cells per octave of radii. The uppermost bits of the fraction of a radius select the cell.
const CELLS_PER_OCTAVE: u32 = 4;
pub(super) const CELL: u32 = OCTAVE / CELLS_PER_OCTAVE;

/// Relative error of one unit of a logarithm.
const UNIT: f32 = core::f32::consts::LN_2 / OCTAVE as f32;

/// Parts of a cell. A place in the cell is counted in these parts.
pub(super) const PARTS: u32 = 1 << 16;
pub(super) const BITS_PER_PART: u32 = CELL / PARTS;

/// Largest margin of a table, 0.05, in units of 2^-23 octaves.
pub(super) const LARGEST_MARGIN: u32 = 590_000;

/// The logarithm of the critical speed, less the margin, as a cubic function of the radius. The coefficients start with the
/// lowest power. The variable is zero in the middle of the cell.
pub(super) type Cubic = [i32; 4];

/// A [`BoundaryTable`](super::BoundaryTable) with any number of cells, which are stored elsewhere: in flash, or in the memory
/// of a C program.
///
/// ```
/// use microimpact::table::{BoundarySlice, TableOutcome};
/// use microimpact::{CriticalSpeed, NormalMotion};
///
/// let mut cells = [[0; 4]; 3];
/// let table = BoundarySlice::fill(1e-6, &mut cells, |radius: f32| Ok(CriticalSpeed::At(1e-6 / radius)))?;
/// assert_eq!(table.classify(1.25e-6, &NormalMotion::new(0.9)?), TableOutcome::Rebound);
/// assert_eq!(table.classify(1.25e-6, &NormalMotion::new(0.7)?), TableOutcome::Capture);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BoundarySlice<'a> {
    pub(super) cells: &'a [Cubic],
    /// Bits of the radius in the middle of the first cell.
    pub(super) first: u32,
    pub(super) margin: u32,
}

/// Value of a cubic at a place, which is counted from the middle of the cell.
#[inline]
pub(super) const fn at(cubic: &Cubic, place: i32) -> i32 {
    let [constant, linear, square, cube] = *cubic;
    let square = square.wrapping_add(times(cube, place));
    let linear = linear.wrapping_add(times(square, place));
    constant.wrapping_add(times(linear, place))
}

/// A coefficient times a place.
#[inline]
const fn times(coefficient: i32, place: i32) -> i32 {
    ((coefficient as i64 * place as i64) >> 16) as i32
}

impl<'a> BoundarySlice<'a> {
    /// Fills `cells` with a table that starts at the radius `smallest` (m), like
    /// [`BoundaryTable::new`](super::BoundaryTable::new). A [`BoundarySliceMaker`] does the same in steps.
    ///
    /// # Errors
    /// Those of [`BoundaryTable::new`](super::BoundaryTable::new). Then the content of the cells is invalid.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundarySlice, BoundaryTable};
    ///
    /// let critical = |radius: f64| Ok(CriticalSpeed::At(1e-6 / radius));
    /// let mut cells = [[0; 4]; 2];
    /// let table = BoundarySlice::fill(1e-6, &mut cells, critical)?;
    /// assert_eq!(table, BoundaryTable::<2>::new(1e-6, critical)?.as_slice());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn fill<T: Single>(
        smallest: T,
        cells: &'a mut [[i32; 4]],
        critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<Self, InputError> {
        let mut maker = BoundarySliceMaker::new(smallest)?;
        maker.advance(cells, usize::MAX, critical)?;
        maker.finished(cells)
    }

    /// Creates a table from its [`parts`](Self::parts): the radius `smallest` (m), the margin and the cells.
    ///
    /// # Errors
    /// Those of [`BoundaryTable::from_parts`](super::BoundaryTable::from_parts).
    ///
    /// ```
    /// use microimpact::table::BoundarySlice;
    ///
    /// // The example `boundary` writes these numbers.
    /// static CELLS: [[i32; 4]; 2] =
    ///     [[1_088_728_656, -5_161_287, 647_136, -107_606], [1_084_119_581, -4_133_047, 413_760, -54_992]];
    /// assert!(BoundarySlice::from_parts(1.9073486e-6, 592, &CELLS).is_ok());
    /// assert!(BoundarySlice::from_parts(1.9073486e-6, 592, &[CELLS[0], CELLS[0]]).is_err());
    /// ```
    pub const fn from_parts(smallest: f32, margin: u32, cells: &'a [[i32; 4]]) -> Result<Self, InputError> {
        match Self::unchecked(smallest, margin, cells) {
            Ok(table) => table.checked(),
            Err(error) => Err(error),
        }
    }

    /// Returns the one cell that contains a `radius` (m), as a table of its own; `None` if no cell does.
    ///
    /// This function checks only that cell. Use it for a table whose cells must be checked at every lookup.
    ///
    /// # Errors
    /// Those of [`BoundaryTable::from_parts`](super::BoundaryTable::from_parts), for this cell.
    ///
    /// ```
    /// use microimpact::NormalMotion;
    /// use microimpact::table::{BoundarySlice, TableOutcome};
    ///
    /// // The example `boundary` writes these numbers. The second cell is damaged on purpose.
    /// static CELLS: [[i32; 4]; 2] = [[1_088_728_656, -5_161_287, 647_136, -107_606], [0, 0, 0, 0]];
    /// let cell = BoundarySlice::cell(1.9073486e-6, 592, &CELLS, 2e-6_f32)?;
    /// assert_eq!(cell.map(|cell| cell.classify(2e-6_f32, &NormalMotion::new(5.3).unwrap())), Some(TableOutcome::Capture));
    /// assert!(BoundarySlice::cell(1.9073486e-6, 592, &CELLS, 2.5e-6).is_err());
    /// assert_eq!(BoundarySlice::cell(1.9073486e-6, 592, &CELLS, 1e-3), Ok(None));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn cell<T: Single>(
        smallest: f32,
        margin: u32,
        cells: &'a [[i32; 4]],
        radius: T,
    ) -> Result<Option<Self>, InputError> {
        let whole = Self::unchecked(smallest, margin, cells)?;
        let (index, _) = whole.place_of(radius);
        match cells.get(index..index + 1) {
            Some(cells) => Self { cells, first: whole.first + index as u32 * CELL, margin }.checked().map(Some),
            None => Ok(None),
        }
    }

    /// Smallest radius (m), margin and cells, as in [`BoundaryTable::parts`](super::BoundaryTable::parts).
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundarySlice, BoundaryTable};
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// let (smallest, margin, cells) = table.as_slice().parts();
    /// assert_eq!(BoundarySlice::from_parts(smallest, margin, cells), Ok(table.as_slice()));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn parts(&self) -> (f32, u32, &'a [[i32; 4]]) {
        // The first cell may begin below the range of radii.
        let (least, _) = Parameter::Radius.range();
        (f32::from_bits(self.first - CELL / 2).max(least as f32), self.margin, self.cells)
    }

    /// Classifies the impact of a sphere of `radius` (m) that arrives with `motion`.
    ///
    /// ```
    /// use microimpact::table::{BoundaryTable, TableOutcome};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// let table = table.as_slice();
    /// assert_eq!(table.classify(1.25e-6_f32, &NormalMotion::new(0.9)?), TableOutcome::Rebound);
    /// assert_eq!(table.classify(f32::INFINITY, &NormalMotion::new(0.9)?), TableOutcome::OutsideTable);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn classify<T: Single>(&self, radius: T, motion: &impl Approach<T>) -> TableOutcome {
        let Some(edge) = self.edge_at(radius) else {
            return TableOutcome::OutsideTable;
        };
        let excess = logarithm(motion.normal().speed().single()).wrapping_sub(edge);
        if excess as u32 <= 2 * self.margin {
            TableOutcome::TooCloseToCall
        } else if excess < 0 {
            TableOutcome::Capture
        } else {
            TableOutcome::Rebound
        }
    }

    /// Logarithm of the lowest speed that is too close to call.
    #[inline]
    pub(super) fn edge_at<T: Single>(&self, radius: T) -> Option<i32> {
        let (index, place) = self.place_of(radius);
        Some(at(self.cells.get(index)?, place))
    }

    /// Index of the cell that contains a radius, and the place in the cell.
    #[inline]
    fn place_of<T: Single>(&self, radius: T) -> (usize, i32) {
        // A radius that is too small or not a positive number gets an index far beyond the last cell.
        let from_first = radius.single().to_bits().wrapping_sub(self.first);
        ((from_first.wrapping_add(CELL / 2) / CELL) as usize, i32::from((from_first / BITS_PER_PART) as i16))
    }

    /// Creates a table and checks its radius only.
    const fn unchecked(smallest: f32, margin: u32, cells: &'a [Cubic]) -> Result<Self, InputError> {
        let (least, most) = Parameter::Radius.range();
        if !(smallest >= least as f32 && smallest <= most as f32) {
            let fault = match (smallest.is_finite(), smallest < least as f32) {
                (false, _) => Fault::NotFinite,
                (true, true) => Fault::TooSmall,
                (true, false) => Fault::TooLarge,
            };
            return Err(InputError { parameter: Parameter::Radius, fault, value: smallest });
        }
        Ok(Self { cells, first: middle_of_cell(smallest), margin })
    }

    /// Returns the table if its cells and its margin are valid.
    pub(super) const fn checked(self) -> Result<Self, InputError> {
        let (slowest, fastest) = Parameter::CriticalSpeed.range();
        // The interpolation may exceed a bound slightly.
        let slack = 2 * LARGEST_MARGIN as i32;
        let (slowest, fastest) = (logarithm(slowest as f32) - slack, logarithm(fastest as f32) + slack);
        let mut cells = self.cells;
        while let [cubic, rest @ ..] = cells {
            let mut place = -(PARTS as i32) / 2;
            while place <= PARTS as i32 / 2 {
                let value = at(cubic, place);
                if value < slowest || value > fastest {
                    let fault = if value < slowest { Fault::TooSmall } else { Fault::TooLarge };
                    let value = number(value);
                    return Err(InputError { parameter: Parameter::CriticalSpeed, fault, value });
                }
                place += PARTS as i32 / 4;
            }
            cells = rest;
        }
        let fault = match self.margin {
            margin if margin > LARGEST_MARGIN => Fault::TooLarge,
            // The error of each of two neighbouring cells is at most the margin.
            margin if margin < LARGEST_ERROR || widest_jump(self.cells) > 2 * margin => Fault::TooSmall,
            _ => return Ok(self),
        };
        let value = self.margin as f32 * UNIT;
        Err(InputError { parameter: Parameter::BoundaryMargin, fault, value })
    }
}

/// Bits of the radius in the middle of the cell that contains a radius.
pub(super) const fn middle_of_cell(radius: f32) -> u32 {
    radius.to_bits() / CELL * CELL + CELL / 2
}

/// Largest jump between neighbouring cells.
pub(super) const fn widest_jump(mut cells: &[Cubic]) -> u32 {
    let mut widest = 0;
    while let [left, rest @ ..] = cells {
        if let [right, ..] = rest {
            let jump = at(left, PARTS as i32 / 2).abs_diff(at(right, -(PARTS as i32) / 2));
            if jump > widest {
                widest = jump;
            }
        }
        cells = rest;
    }
    widest
}

/// The number that has these bits as an f32.
pub(super) fn of_single<T: Real>(bits: u32) -> T {
    T::constant(f64::from(f32::from_bits(bits)))
}

#[cfg(test)]
mod tests {
    use super::BoundarySlice;
    use crate::{InputError, Parameter};

    /// The first cell begins below the least radius, and the last one contains the largest.
    #[test]
    fn parts_at_the_ends_of_the_range_make_the_same_table() -> Result<(), InputError> {
        let (least, most) = Parameter::Radius.range();
        let cells = [[1_065_353_216, 0, 0, 0]];
        for smallest in [least as f32, most as f32] {
            let table = BoundarySlice::from_parts(smallest, 1000, &cells)?;
            let (smallest, margin, cells) = table.parts();
            assert_eq!(BoundarySlice::from_parts(smallest, margin, cells), Ok(table));
        }
        Ok(())
    }
}
