//! Restitution tables made in steps, each of a limited number of calls of the source.

use super::boundary::BoundaryTable;
use super::logarithm::{OCTAVE, Single, logarithm, number, octaves};
use super::{RestitutionTable, TableRebound};
use crate::{Fault, InputError, Parameter, Real};

/// Makes a [`RestitutionTable`] in steps, between which a firmware does other work.
///
/// The simulation of one impact takes a Cortex-M3 without floating-point unit up to a million instructions, and a table takes
/// [`CALLS`](Self::CALLS) of them, several hundred. A step makes at most as many calls of the source as its budget allows. What
/// is done is kept in the maker, which is a little larger than the table; nothing is allocated. The table is that of
/// [`RestitutionTable::new`] to the last bit.
///
/// ```
/// use microimpact::CriticalSpeed;
/// use microimpact::table::{BoundaryTable, RestitutionTable, RestitutionTableMaker, TableRebound};
///
/// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
/// let source = |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
/// let mut maker = RestitutionTableMaker::<f64, 2, 3, 12>::new(boundary, 10.0)?;
/// let table = loop {
///     // Here a firmware feeds its watchdog and answers its host.
///     if let Some(table) = maker.step(20, source)? {
///         break *table;
///     }
/// };
/// assert_eq!(maker.calls(), RestitutionTableMaker::<f64, 2, 3, 12>::CALLS);
/// assert_eq!(table, RestitutionTable::new(boundary, 10.0, source)?);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RestitutionTableMaker<T, const N: usize, const R: usize, const S: usize> {
    /// The table, without errors as yet.
    table: RestitutionTable<T, N, R, S>,
    /// The next place: the rows of nodes, and after them those of the grid on which the table is compared with its source.
    row: usize,
    column: usize,
    calls: usize,
    /// Root and impulse of the place before in the same row.
    before: (T, T),
    /// Largest impulse at a node, at least one.
    largest: T,
    /// Largest slopes, between the nodes alone and between all places.
    between_nodes: Slopes<T>,
    slopes: Slopes<T>,
    /// Largest differences between the table and its source.
    differences: TableRebound<T>,
}

/// Smallest number of places, in each direction, at which a table is compared with its source: enough to find the largest
/// error of the polynomials of three or four nodes.
const LEAST_PLACES: usize = 12;

/// Places from one node of a table to the next, one of the nodes included.
const fn places_per_cell(nodes: usize) -> usize {
    let places = LEAST_PLACES.div_ceil(nodes - 1);
    if places > 2 { places } else { 2 }
}

/// The same for radii: an odd number, since in the middle of a cell one parabola takes the place of another, whose error may
/// be larger. So there are places on both sides of the middle.
const fn rows_per_cell(nodes: usize) -> usize {
    places_per_cell(nodes) | 1
}

/// Columns below the first node at which a table is compared with its source. The polynomials extrapolate there, to the
/// critical speed at -0.5.
const EXTRAPOLATED_COLUMNS: [f64; 2] = [-0.45, -0.25];

/// Smallest distance of these columns from the critical speed, in margins of the boundary, so that the source yields a rebound.
const MARGINS_FROM_BOUNDARY: f64 = 2.0;

/// Stated errors over the largest differences found. The test of random tables finds errors of 1.4 times those differences.
const SAFETY: f64 = 2.0;

/// Rounding errors of a lookup, in units of the largest value of a node: up to 7 times that value is extrapolated to the
/// critical speed, in a few operations.
const ROUNDINGS: f64 = 32.0;

/// Largest changes over that of sqrt(d).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Slopes<T> {
    restitution: T,
    impulse: T,
}

impl<T: Real> Slopes<T> {
    /// Takes account of a place, and of the one before it in the same row. At the critical speed the restitution is zero.
    fn take(&mut self, root: T, rebound: &TableRebound<T>, before: Option<(T, T)>) {
        self.restitution = self.restitution.max(rebound.restitution / root);
        if let Some((place, impulse)) = before
            && root > place
        {
            self.impulse = self.impulse.max((rebound.impulse - impulse).abs() / (root - place));
        }
    }
}

/// A place in a table, counted in nodes.
struct Place<T> {
    row: T,
    column: T,
    /// Whether it lies below the first column of nodes.
    extrapolated: bool,
    /// Whether the table agrees with its source there, because it is a node.
    agrees: bool,
}

impl<T: Single, const N: usize, const R: usize, const S: usize> RestitutionTableMaker<T, N, R, S> {
    /// Rows and columns of places at which the table is compared with its source.
    const ROWS: usize = rows_per_cell(R) * (R - 1) + 1;
    const COLUMNS: usize = EXTRAPOLATED_COLUMNS.len() + places_per_cell(S) * (S - 1) + 1;

    /// Calls of the source that the table takes in all: about six for each node, and at least 195.
    ///
    /// ```
    /// use microimpact::table::RestitutionTableMaker;
    ///
    /// assert_eq!(RestitutionTableMaker::<f32, 8, 6, 10>::CALLS, 336);
    /// ```
    // Of the places, the nodes take no second call.
    pub const CALLS: usize = Self::ROWS * Self::COLUMNS;

    /// The maker of a table over the radii of a boundary, up to `ratio` times the critical speed. Nothing is computed yet.
    ///
    /// # Errors
    /// The ratio is outside its range.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTableMaker};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// assert!(RestitutionTableMaker::<f64, 2, 4, 12>::new(boundary, 10.0).is_ok());
    /// assert!(RestitutionTableMaker::<f64, 2, 4, 12>::new(boundary, 1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(boundary: BoundaryTable<N>, ratio: T) -> Result<Self, InputError> {
        Ok(Self::with_range(boundary, range(ratio)?))
    }

    /// The same up to a logarithm of speed over critical speed.
    pub(super) fn with_range(boundary: BoundaryTable<N>, end: i32) -> Self {
        const { RestitutionTable::<T, N, R, S>::COUNTED }
        let (first, last) = boundary.logarithms();
        let none = Slopes { restitution: T::ZERO, impulse: T::ZERO };
        let table = RestitutionTable {
            boundary,
            nodes: [[[T::ZERO; 2]; S]; R],
            first,
            per_octave: count::<T>(R - 1) / octaves(last - first),
            per_root: (count::<T>(S) - T::constant(0.5)) / octaves::<T>(end).sqrt(),
            end,
            error: T::ZERO,
            impulse_error: T::ZERO,
            near: T::ZERO,
            impulse_over_restitution: T::ZERO,
        };
        Self {
            table,
            row: 0,
            column: 0,
            calls: 0,
            before: (T::ZERO, T::ZERO),
            largest: T::ONE,
            between_nodes: none,
            slopes: none,
            differences: TableRebound { restitution: T::ZERO, impulse: T::ZERO },
        }
    }

    /// Goes on with at most `budget` calls of the source, which must be the same function in every step. Returns the table once
    /// it is complete, also if it is asked again; it stays in the maker until it is copied. A budget of zero makes no call.
    ///
    /// # Errors
    /// Those of [`RestitutionTable::new`]. The maker keeps what was done before: the next step calls the source for the same
    /// radius and speed again.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTableMaker, TableRebound};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: 1.0 - 1.0 / speed, impulse: 2.0 });
    /// let mut maker = RestitutionTableMaker::<f64, 2, 3, 4>::new(boundary, 10.0)?;
    /// assert_eq!(maker.step(1, source)?, None);
    /// assert!(maker.step(1000, source)?.is_some());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn step(
        &mut self,
        budget: usize,
        source: impl FnMut(T, T) -> Result<TableRebound<T>, InputError>,
    ) -> Result<Option<&RestitutionTable<T, N, R, S>>, InputError> {
        Ok(if self.advance(budget, source)? { Some(self.finished()) } else { None })
    }

    /// Calls of the source so far, of [`CALLS`](Self::CALLS).
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTableMaker};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// assert_eq!(RestitutionTableMaker::<f64, 2, 3, 4>::new(boundary, 10.0)?.calls(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn calls(&self) -> usize {
        self.calls
    }

    /// Goes on with at most `budget` calls of the source; whether all places are done.
    pub(super) fn advance(
        &mut self,
        budget: usize,
        mut source: impl FnMut(T, T) -> Result<TableRebound<T>, InputError>,
    ) -> Result<bool, InputError> {
        let mut left = budget;
        while self.row < R + Self::ROWS {
            let place = self.place();
            let root = (place.column + T::constant(0.5)) / self.table.per_root;
            let exact = if place.agrees {
                None
            } else if left == 0 {
                return Ok(false);
            } else {
                left -= 1;
                let exact = sample(&self.table, place.row, root, &mut source)?;
                self.calls += 1;
                Some(exact)
            };
            match exact {
                Some(node) if self.row < R => self.take_node(root, &node),
                _ => self.compare(&place, root, exact),
            }
            self.column += 1;
            if self.column >= if self.row < R { S } else { Self::COLUMNS } {
                (self.row, self.column) = (self.row + 1, 0);
            }
        }
        Ok(true)
    }

    /// The next place.
    fn place(&self) -> Place<T> {
        let (across, along) = const { (rows_per_cell(R), places_per_cell(S)) };
        let Some(i) = self.row.checked_sub(R) else {
            let (row, column) = (count(self.row), count(self.column));
            return Place { row, column, extrapolated: false, agrees: false };
        };
        let row = count::<T>(i) / count(across);
        if let Some(&column) = EXTRAPOLATED_COLUMNS.get(self.column) {
            let margin = octaves::<T>(self.table.boundary.margin as i32);
            let nearest = (T::constant(MARGINS_FROM_BOUNDARY) * margin).sqrt() * self.table.per_root - T::constant(0.5);
            return Place { row, column: T::constant(column).max(nearest), extrapolated: true, agrees: false };
        }
        let j = self.column - EXTRAPOLATED_COLUMNS.len();
        let agrees = i.is_multiple_of(across) && j.is_multiple_of(along);
        Place { row, column: count::<T>(j) / count(along), extrapolated: false, agrees }
    }

    /// Takes in what the source says of a node.
    fn take_node(&mut self, root: T, node: &TableRebound<T>) {
        self.largest = self.largest.max(node.impulse);
        self.take_slopes(root, node);
        self.between_nodes = self.slopes;
        if let Some(place) = self.table.nodes.get_mut(self.row).and_then(|row| row.get_mut(self.column)) {
            *place = [node.restitution / root, node.impulse];
        }
    }

    /// Takes in the slopes up to a place.
    fn take_slopes(&mut self, root: T, rebound: &TableRebound<T>) {
        self.slopes.take(root, rebound, (self.column > 0).then_some(self.before));
        self.before = (root, rebound.impulse);
    }

    /// Compares the table with what the source says, or with itself at a node. Differences next to the critical speed are less what
    /// the margin of the boundary accounts for, by the slopes between the nodes.
    fn compare(&mut self, place: &Place<T>, root: T, exact: Option<TableRebound<T>>) {
        let (slope, impulse) = self.table.interpolated(place.row, place.column);
        let found = TableRebound { restitution: slope * root, impulse };
        let exact = exact.unwrap_or(found);
        self.take_slopes(root, &exact);
        let uncertain = if place.extrapolated {
            let (half, margin) = (T::constant(0.5), octaves::<T>(self.table.boundary.margin as i32));
            [half * margin * self.between_nodes.restitution, half * margin * self.between_nodes.impulse]
        } else {
            [T::ZERO; 2]
        };
        let differences = &mut self.differences;
        let off = (found.restitution - exact.restitution).abs() - uncertain[0] / root;
        differences.restitution = differences.restitution.max(off);
        differences.impulse = differences.impulse.max((impulse - exact.impulse).abs() - uncertain[1] / root);
    }

    /// The table with its errors, once all places are done.
    pub(super) fn finished(&mut self) -> &RestitutionTable<T, N, R, S> {
        let rounding = T::constant(ROUNDINGS) * T::EPSILON * self.largest;
        let table = &mut self.table;
        table.error = T::constant(SAFETY) * self.differences.restitution + rounding;
        table.impulse_error = T::constant(SAFETY) * self.differences.impulse + rounding;
        // The margin is the uncertainty of d: that of sqrt(d) is at most the margin over sqrt(d), as no d is below the margin.
        table.near = self.slopes.restitution * octaves(table.boundary.margin as i32);
        table.impulse_over_restitution = self.slopes.impulse / self.slopes.restitution.max(T::EPSILON);
        table
    }
}

/// Logarithm of the largest over the critical speed.
pub(super) fn range<T: Single>(ratio: T) -> Result<i32, InputError> {
    Ok(logarithm(Parameter::SpeedRatio.check(ratio)?.single()) - logarithm(1.0))
}

/// A number of nodes or places.
fn count<T: Real>(number: usize) -> T {
    T::constant(number as f64)
}

/// What the source says of a row of nodes and of `root` = sqrt(d).
fn sample<T: Single, const N: usize, const R: usize, const S: usize>(
    table: &RestitutionTable<T, N, R, S>,
    row: T,
    root: T,
    source: &mut impl FnMut(T, T) -> Result<TableRebound<T>, InputError>,
) -> Result<TableRebound<T>, InputError> {
    let units = |octaves: T| (octaves.single() * OCTAVE as f32) as i32;
    let radius = T::from_single(table.boundary.radius_at(table.first + units(row / table.per_octave)));
    let critical = table.boundary.logarithm_at(radius);
    let outside = || InputError { parameter: Parameter::Radius, fault: Fault::TooLarge, value: radius.single() };
    let critical = critical.ok_or_else(outside)?;
    let speed = T::from_single(number(critical.saturating_add(units(root * root))));
    let rebound = source(radius, Parameter::ApproachSpeed.check(speed)?)?;
    Ok(TableRebound {
        restitution: Parameter::Restitution.check(rebound.restitution)?,
        impulse: Parameter::ImpulseOverMomentum.check(rebound.impulse)?,
    })
}
