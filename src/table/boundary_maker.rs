//! Boundary tables made in steps, each of a limited number of calls of the source.

use super::logarithm::{LARGEST_ERROR, Single, exact_logarithm};
use super::slice::{BITS_PER_PART, CELL, Cubic, LARGEST_MARGIN, PARTS, at, middle_of_cell, of_single, widest_jump};
use super::{BoundarySlice, BoundaryTable};
use crate::{CriticalSpeed, Fault, InputError, Parameter};

/// Makes a [`BoundaryTable`] in steps, between which a firmware does other work.
///
/// A critical speed of a [`Contact`](crate::contact::Contact) takes a Cortex-M3 without floating-point unit ten to thirty million
/// instructions, and a cell takes seven of them. A step makes at most as many calls of the source of critical speeds as its
/// budget allows. What is done is kept in the maker, which takes 60 bytes besides the cells on a 32-bit processor; nothing is
/// allocated. The table is that of [`BoundaryTable::new`] to the last bit.
///
/// ```
/// use microimpact::table::{BoundaryTable, BoundaryTableMaker};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{InputError, Sphere, Stiffness};
///
/// let method = Collocation::<7, f32>::new(1e-6)?;
/// let critical = |radius| {
///     let sphere = Sphere::solid(radius, 2600.0)?;
///     let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
///     scene.critical_speed(&method)
/// };
/// let mut maker = BoundaryTableMaker::<4>::new(2e-6_f32)?;
/// let mut rounds = 0;
/// let table = loop {
///     rounds += 1; // here a firmware feeds its watchdog and answers its host
///     if let Some(table) = maker.step(1, critical)? {
///         break *table;
///     }
/// };
/// assert_eq!(rounds, BoundaryTableMaker::<4>::CALLS);
/// assert_eq!(table, BoundaryTable::new(2e-6_f32, critical)?);
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BoundaryTableMaker<const N: usize> {
    maker: BoundarySliceMaker,
    /// Without its margin until the last step.
    table: BoundaryTable<N>,
}

impl<const N: usize> BoundaryTableMaker<N> {
    /// Calls of the source that the table takes in all: seven for each cell.
    ///
    /// ```
    /// assert_eq!(microimpact::table::BoundaryTableMaker::<12>::CALLS, 84);
    /// ```
    pub const CALLS: usize = N * BoundarySliceMaker::CALLS_PER_CELL;

    /// The maker of a table that starts at the radius `smallest` (m). Nothing is computed yet.
    ///
    /// # Errors
    /// The radius is outside its range.
    ///
    /// ```
    /// use microimpact::table::BoundaryTableMaker;
    ///
    /// assert!(BoundaryTableMaker::<8>::new(2e-6).is_ok());
    /// assert!(BoundaryTableMaker::<8>::new(-2e-6).is_err());
    /// ```
    pub fn new<T: Single>(smallest: T) -> Result<Self, InputError> {
        const { BoundaryTable::<N>::COUNTED }
        let maker = BoundarySliceMaker::new(smallest)?;
        Ok(Self { maker, table: BoundaryTable { cells: [[0; 4]; N], first: maker.first, margin: 0 } })
    }

    /// Goes on with at most `budget` calls of the source, which must be the same function in every step. Returns the table once
    /// it is complete, also if it is asked again; it stays in the maker until it is copied. A budget of zero makes no call.
    ///
    /// # Errors
    /// Those of [`BoundaryTable::new`]. The maker keeps what was done before: the next step calls the source for the same radius
    /// again. If a complete table is refused, every further step returns the same error.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundaryTableMaker;
    ///
    /// let critical = |radius: f64| Ok(CriticalSpeed::At(1e-6 / radius));
    /// let mut maker = BoundaryTableMaker::<2>::new(1e-6)?;
    /// assert_eq!(maker.step(10, critical)?, None);
    /// assert!(maker.step(4, critical)?.is_some()); // 2 cells: 14 calls
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn step<T: Single>(
        &mut self,
        budget: usize,
        critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<Option<&BoundaryTable<N>>, InputError> {
        let Self { maker, table } = self;
        let Some(BoundarySlice { margin, .. }) = maker.step(&mut table.cells, budget, critical)? else {
            return Ok(None);
        };
        table.margin = margin;
        Ok(Some(table))
    }

    /// Calls of the source so far, of [`CALLS`](Self::CALLS).
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundaryTableMaker;
    ///
    /// let mut maker = BoundaryTableMaker::<2>::new(1e-6)?;
    /// maker.step(3, |radius: f64| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert_eq!(maker.calls(), 3);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn calls(&self) -> usize {
        self.maker.calls()
    }
}

/// Makes a [`BoundarySlice`] in steps, like a [`BoundaryTableMaker`], in cells that are given to each step.
///
/// ```
/// use microimpact::CriticalSpeed;
/// use microimpact::table::{BoundarySlice, BoundarySliceMaker};
///
/// let critical = |radius: f32| Ok(CriticalSpeed::At(1e-6 / radius));
/// let (mut cells, mut others) = ([[0; 4]; 3], [[0; 4]; 3]);
/// let mut maker = BoundarySliceMaker::new(1e-6_f32)?;
/// while maker.step(&mut cells, 5, critical)?.is_none() {}
/// assert_eq!(maker.step(&mut cells, 0, critical)?, Some(BoundarySlice::fill(1e-6, &mut others, critical)?));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BoundarySliceMaker {
    /// Bits of the radius in the middle of the first cell.
    first: u32,
    /// The cell that is being made, and how many of its values are known.
    cell: usize,
    known: usize,
    /// Logarithms of the critical speed at the places of that cell.
    curve: [i32; PLACES.len()],
    /// Largest error of a finished cell at the places between its nodes.
    worst: u32,
    /// Largest half step of a finished cell.
    coarsest: u32,
    /// Margin of the finished table; zero before.
    margin: u32,
}

/// Chebyshev nodes for a cubic, in parts of a cell: cos(pi/8)/2 and cos(3 pi/8)/2 on both sides of the middle.
const OUTER: i32 = 30_274;
const INNER: i32 = 12_540;

/// Places where the interpolation error is largest: 0 and cos(pi/4)/2 on both sides of the middle.
const EXTREMES: [i32; 3] = [-23_170, 0, 23_170];

/// Places in a cell at which the critical speed is computed: the nodes, and then those that show the error.
const PLACES: [i32; 7] = [-OUTER, OUTER, -INNER, INNER, EXTREMES[0], EXTREMES[1], EXTREMES[2]];

/// Roundings besides that of a logarithm: the source has an error of two units, the rounding of a cubic three, and the rounding
/// of radius and speed to f32 three.
const OTHER_ROUNDINGS: u32 = 2 + 3 + 3;

impl BoundarySliceMaker {
    /// Calls of the source that each cell takes.
    ///
    /// ```
    /// assert_eq!(microimpact::table::BoundarySliceMaker::CALLS_PER_CELL, 7);
    /// ```
    pub const CALLS_PER_CELL: usize = PLACES.len();

    /// The maker of a table that starts at the radius `smallest` (m).
    ///
    /// # Errors
    /// The radius is outside its range.
    ///
    /// ```
    /// assert!(microimpact::table::BoundarySliceMaker::new(f64::NAN).is_err());
    /// ```
    pub fn new<T: Single>(smallest: T) -> Result<Self, InputError> {
        let first = middle_of_cell(Parameter::Radius.check(smallest)?.single());
        Ok(Self { first, cell: 0, known: 0, curve: [0; PLACES.len()], worst: 0, coarsest: 0, margin: 0 })
    }

    /// Goes on with at most `budget` calls of the source. Source and cells must be the same in every step, and nothing else may
    /// write to the cells; they hold no table before the last step. Returns the table once it is complete.
    ///
    /// # Errors
    /// Those of [`BoundaryTableMaker::step`].
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::BoundarySliceMaker;
    ///
    /// let mut cells = [[0; 4]; 2];
    /// let mut maker = BoundarySliceMaker::new(1e-6)?;
    /// let critical = |radius: f64| Ok(CriticalSpeed::At(1e-6 / radius));
    /// assert_eq!(maker.step(&mut cells, 13, critical)?, None);
    /// assert!(maker.step(&mut cells, 1, critical)?.is_some());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn step<'a, T: Single>(
        &mut self,
        cells: &'a mut [[i32; 4]],
        budget: usize,
        critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<Option<BoundarySlice<'a>>, InputError> {
        if self.advance(cells, budget, critical)? { self.finished(cells).map(Some) } else { Ok(None) }
    }

    /// Calls of the source so far, [`CALLS_PER_CELL`](Self::CALLS_PER_CELL) for each finished cell.
    ///
    /// ```
    /// assert_eq!(microimpact::table::BoundarySliceMaker::new(1e-6)?.calls(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn calls(&self) -> usize {
        self.cell * Self::CALLS_PER_CELL + self.known
    }

    /// Goes on with at most `budget` calls of the source; whether all cells are made.
    pub(super) fn advance<T: Single>(
        &mut self,
        cells: &mut [Cubic],
        budget: usize,
        mut critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<bool, InputError> {
        let mut left = budget;
        while let Some(cubic) = cells.get_mut(self.cell) {
            let middle = self.first.wrapping_add((self.cell as u32).wrapping_mul(CELL));
            while let (Some(place), Some(value)) = (PLACES.get(self.known), self.curve.get_mut(self.known)) {
                if left == 0 {
                    return Ok(false);
                }
                left -= 1;
                // A place represents the radii up to the next place.
                let bits = middle.wrapping_add_signed(place * BITS_PER_PART as i32) + BITS_PER_PART / 2;
                *value = exact_critical_speed(Parameter::Radius.check(of_single(bits))?, &mut critical)?;
                self.known += 1;
            }
            let [below, above, left, right, between @ ..] = self.curve;
            *cubic = interpolated([below, above, left, right]);
            for (place, value) in EXTREMES.into_iter().zip(between) {
                self.worst = value.abs_diff(at(cubic, place)).max(self.worst);
            }
            self.coarsest = half_step(cubic).max(self.coarsest);
            (self.cell, self.known) = (self.cell + 1, 0);
        }
        Ok(true)
    }

    /// The table in cells that are all made, whose constant terms the margin is taken from once.
    pub(super) fn finished<'a>(&mut self, cells: &'a mut [Cubic]) -> Result<BoundarySlice<'a>, InputError> {
        if self.margin == 0 {
            let rounding = LARGEST_ERROR + OTHER_ROUNDINGS + self.coarsest;
            self.margin = widest_jump(cells).max(self.worst.saturating_mul(2)).saturating_add(rounding);
            // A larger margin is refused.
            let shift = self.margin.min(LARGEST_MARGIN) as i32;
            for cubic in &mut *cells {
                cubic[0] = cubic[0].saturating_sub(shift);
            }
        }
        BoundarySlice { cells, first: self.first, margin: self.margin }.checked()
    }
}

/// Largest change of a cubic over half the distance between two places.
fn half_step(cubic: &Cubic) -> u32 {
    let [_, linear, square, cube] = cubic.map(i32::unsigned_abs);
    // The slope is largest at an end of the cell, where it is linear + square + 3/4 cube.
    linear.saturating_add(square).saturating_add(cube) / (2 * PARTS) + 1
}

/// Logarithm of the critical speed of a radius.
fn exact_critical_speed<T: Single>(
    radius: T,
    critical: &mut impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
) -> Result<i32, InputError> {
    let (fault, value) = match critical(radius)? {
        CriticalSpeed::At(speed) => return Ok(exact_logarithm(Parameter::CriticalSpeed.check(speed)?.single())),
        CriticalSpeed::AlwaysRebounds => (Fault::TooSmall, 0.0),
        CriticalSpeed::NeverRebounds => (Fault::TooLarge, f32::INFINITY),
    };
    Err(InputError { parameter: Parameter::CriticalSpeed, fault, value })
}

/// The cubic through values at the Chebyshev nodes: the outer ones and the inner ones, each below and above the middle.
fn interpolated(values: [i32; 4]) -> Cubic {
    const ALPHA: f64 = OUTER as f64 / PARTS as f64;
    const BETA: f64 = INNER as f64 / PARTS as f64;
    const SPREAD: f64 = ALPHA * ALPHA - BETA * BETA;
    let [below, above, left, right] = values.map(i64::from);
    // Twice the even and the odd part of the curve at the outer and the inner nodes.
    let (even, odd) = ((above + below, right + left), (above - below, right - left));
    let square = scaled::<{ fixed(0.5 / SPREAD) }>(even.0 - even.1);
    let cube = scaled::<{ fixed(0.5 / ALPHA / SPREAD) }>(odd.0) - scaled::<{ fixed(0.5 / BETA / SPREAD) }>(odd.1);
    let linear = scaled::<{ fixed(0.5 / BETA) }>(odd.1) - scaled::<{ fixed(BETA * BETA) }>(cube);
    let constant = (even.1 + 1) / 2 - scaled::<{ fixed(BETA * BETA) }>(square);
    // A coefficient that does not fit increases the error of the cubic, which is measured.
    [constant, linear, square, cube].map(|part| part.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
}

/// Converts a factor to units of 2^-24.
const fn fixed(factor: f64) -> i64 {
    (factor * (1 << 24) as f64 + 0.5) as i64
}

/// Product of a number and a factor in units of 2^-24.
fn scaled<const FACTOR: i64>(number: i64) -> i64 {
    (number * FACTOR + (1 << 23)) >> 24
}
