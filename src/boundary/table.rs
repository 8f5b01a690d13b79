//! The critical speed over a range of radii.

use super::Verdict;
use super::logarithm::{GREATEST_ERROR, OCTAVE, Single, exact_logarithm, logarithm, number};
use crate::{Approach, CriticalSpeed, Fault, InputError, Parameter, Real};

/// Cells to an octave of radii: the uppermost bits of the fraction of a radius tell its cell.
const CELLS_PER_OCTAVE: u32 = 4;
const CELL: u32 = OCTAVE / CELLS_PER_OCTAVE;

/// Parts of a cell that a place in it is counted in.
const PARTS: u32 = 1 << 16;
const BITS_PER_PART: u32 = CELL / PARTS;

/// The largest margin of a table: 0.05, in units of 2^-23 octaves.
const LARGEST_MARGIN: u32 = 590_000;

/// The relative error that one unit of a logarithm is.
const UNIT: f64 = core::f64::consts::LN_2 / OCTAVE as f64;

/// The logarithm of the critical speed, less the margin, as a cubic of the radius, lowest power first, counted from the middle of a cell.
type Cubic = [i32; 4];

/// The critical speeds of a surface and a material over a range of radii, in `N` cells, with a bound for the error.
///
/// Four cells are an octave of radii; the first begins at a whole quarter of an octave. A cell takes 16 bytes, in each
/// the logarithm of the critical speed is a cubic of the radius, in integers. The table itself does not depend on the
/// number type of the queries.
///
/// ```
/// use microimpact::boundary::{BoundaryTable, Verdict};
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Glass on steel (the paper's figure 6), from radii of 2 to 8 um.
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let table = BoundaryTable::<8>::new(2e-6, |radius| {
///     let sphere = Sphere::solid(radius, 2600.0)?;
///     let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
///     scene.critical_speed(&method)
/// })?;
/// assert!(table.margin::<f64>() < 1e-4);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(5.155)?), Verdict::Capture);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(5.165)?), Verdict::Rebound);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(5.15957)?), Verdict::TooCloseToCall);
/// assert_eq!(table.classify(1e-6, &NormalMotion::new(5.0)?), Verdict::OutsideTable);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BoundaryTable<const N: usize> {
    cells: [Cubic; N],
    /// Bits of the radius in the middle of the first cell.
    first: u32,
    pub(super) margin: u32,
}

/// A cubic at a place, counted in parts of the cell from its middle.
#[inline]
const fn at(cubic: &Cubic, place: i32) -> i32 {
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

impl<const N: usize> BoundaryTable<N> {
    /// A table from the radius `smallest` (m) on, by a source of critical speeds: [`Simulation::critical_speed`],
    /// [`RigidBody::critical_speed`] or measurements.
    ///
    /// The source is asked for seven radii in each cell: four to lay the cubic through, and three where the cubic errs
    /// most. The margin is twice the largest error found there and what the arithmetic of a query errs by. That bounds
    /// the error everywhere, if nowhere in the table the fourth derivative of the curve is more than twice the smallest
    /// one in the cell where the largest error was found; the error of the source itself is not in it.
    ///
    /// # Errors
    /// A radius outside its range; [`Parameter::CriticalSpeed`] where every speed in its range rebounds (too small) or
    /// none does (too large); [`Parameter::BoundaryMargin`] where the curve is too rough for a cubic; and the errors of
    /// the source.
    ///
    /// [`Simulation::critical_speed`]: crate::simulation::Simulation::critical_speed
    /// [`RigidBody::critical_speed`]: crate::RigidBody::critical_speed
    ///
    /// ```
    /// use microimpact::boundary::BoundaryTable;
    /// use microimpact::{Parameter, RigidBody, SpeedRestitution, Sphere};
    ///
    /// // The rigid-body model, with an adhesion of 50 mJ/m^2 over a hundredth of the cross-section.
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
        mut critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<Self, InputError> {
        let smallest = Parameter::Radius.check(smallest)?.single();
        let mut table = Self { cells: [[0; 4]; N], first: Self::first_middle(smallest), margin: 0 };
        let (mut middle, mut worst, mut coarsest) = (table.first, 0_u32, 0);
        for cubic in &mut table.cells {
            let mut curve = |place: i32| {
                // A place stands for the radii up to the next one.
                let bits = middle.wrapping_add_signed(place * BITS_PER_PART as i32) + BITS_PER_PART / 2;
                exact_critical_speed(Parameter::Radius.check(of_single(bits))?, &mut critical)
            };
            *cubic = interpolated(&mut curve)?;
            let mut error = 0;
            for place in EXTREMES {
                error = curve(place)?.abs_diff(at(cubic, place)).max(error);
            }
            worst = error.max(worst);
            coarsest = half_step(cubic).max(coarsest);
            middle += CELL;
        }
        // Two units are the errors of the curve itself, three those of rounding a cubic, and three those of rounding the
        // radius and the speed of a query to single precision.
        let rounding = GREATEST_ERROR + 2 + 3 + 3 + coarsest;
        table.margin = table.widest_jump().max(worst.saturating_mul(2)).saturating_add(rounding);
        // A larger one is refused below.
        let margin = table.margin.min(LARGEST_MARGIN) as i32;
        for cubic in &mut table.cells {
            cubic[0] = cubic[0].saturating_sub(margin);
        }
        table.checked()
    }

    /// A table from its parts: the radius `smallest` (m), the margin and the cells, as [`parts`](Self::parts) gives them;
    /// for tables that are constants.
    ///
    /// # Errors
    /// A radius outside its range; [`Parameter::CriticalSpeed`] where a cell holds what is no speed;
    /// [`Parameter::BoundaryMargin`] where the margin is too large, or smaller than what neighbouring cells differ by.
    ///
    /// ```
    /// use microimpact::NormalMotion;
    /// use microimpact::boundary::{BoundaryTable, Verdict};
    ///
    /// // As the example `boundary` writes them. A mistake ends the compilation.
    /// const TABLE: BoundaryTable<2> = match BoundaryTable::from_parts(1.9073486e-6, 592, [
    ///     [1_088_728_656, -5_161_287, 647_136, -107_606],
    ///     [1_084_119_581, -4_133_047, 413_760, -54_992],
    /// ]) {
    ///     Ok(table) => table,
    ///     Err(_) => panic!("no boundary table"),
    /// };
    /// assert_eq!(TABLE.classify(2.5e-6, &NormalMotion::new(5.1)?), Verdict::Capture);
    /// assert_eq!(TABLE.classify(2.5e-6_f32, &NormalMotion::new(5.3)?), Verdict::Rebound);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn from_parts(smallest: f32, margin: u32, cells: [[i32; 4]; N]) -> Result<Self, InputError> {
        let (least, most) = Parameter::Radius.range();
        if !(smallest >= least as f32 && smallest <= most as f32) {
            let fault = match (smallest.is_finite(), smallest < least as f32) {
                (false, _) => Fault::NotFinite,
                (true, true) => Fault::TooSmall,
                (true, false) => Fault::TooLarge,
            };
            return Err(InputError { parameter: Parameter::Radius, fault });
        }
        Self { cells, first: Self::first_middle(smallest), margin }.checked()
    }

    /// Radius at which the table begins (m), margin in units of 2^-23 octaves, and cells.
    ///
    /// In each cell, the four coefficients of a cubic, lowest power first, give 2^23 (127 + log2 v_c) less the margin, v_c
    /// being the critical speed in m/s. Its variable runs from -1/2 to 1/2 over the cell, in which the radius is linear.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::BoundaryTable;
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// let (smallest, margin, cells) = table.parts();
    /// assert_eq!(BoundaryTable::from_parts(smallest, margin, *cells), Ok(table));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn parts(&self) -> (f32, u32, &[[i32; 4]; N]) {
        (f32::from_bits(self.first - CELL / 2), self.margin, &self.cells)
    }

    /// Greatest relative error of the critical speed: speeds this close to it are [`Verdict::TooCloseToCall`].
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::BoundaryTable;
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |_| Ok(CriticalSpeed::At(1.0)))?;
    /// assert!(table.margin::<f64>() < 2e-5);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn margin<T: Real>(&self) -> T {
        T::constant(f64::from(self.margin) * UNIT)
    }

    /// Radii from which, and up to but not at which, the table reaches, m.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::BoundaryTable;
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

    /// Critical speed of a `radius` (m), m/s, within the margin; `None` outside the table.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::BoundaryTable;
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert!((table.critical_speed(1.25e-6).unwrap() - 0.8_f64).abs() < 1e-4);
    /// assert_eq!(table.critical_speed(f64::NAN), None);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn critical_speed<T: Single>(&self, radius: T) -> Option<T> {
        Some(of_single(number(self.logarithm_at(radius)?).to_bits()))
    }

    /// Rebound or capture of a sphere of `radius` (m) that arrives with `motion`.
    ///
    /// ```
    /// use microimpact::boundary::{BoundaryTable, Verdict};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert_eq!(table.classify(1.25e-6_f32, &NormalMotion::new(0.9)?), Verdict::Rebound);
    /// assert_eq!(table.classify(f32::INFINITY, &NormalMotion::new(0.9)?), Verdict::OutsideTable);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn classify<T: Single>(&self, radius: T, motion: &impl Approach<T>) -> Verdict {
        let Some(edge) = self.edge_at(radius) else {
            return Verdict::OutsideTable;
        };
        let excess = logarithm(motion.normal().speed().single()).wrapping_sub(edge);
        if excess as u32 <= 2 * self.margin {
            Verdict::TooCloseToCall
        } else if excess < 0 {
            Verdict::Capture
        } else {
            Verdict::Rebound
        }
    }

    /// Logarithm of the critical speed of a radius.
    #[inline]
    pub(super) fn logarithm_at<T: Single>(&self, radius: T) -> Option<i32> {
        Some(self.edge_at(radius)?.wrapping_add_unsigned(self.margin))
    }

    /// Logarithm of the slowest speed that is too close to call.
    #[inline]
    fn edge_at<T: Single>(&self, radius: T) -> Option<i32> {
        // Whatever is no positive number, or too small, lies far beyond the last cell here.
        let from_first = radius.single().to_bits().wrapping_sub(self.first);
        let cubic = self.cells.get((from_first.wrapping_add(CELL / 2) / CELL) as usize)?;
        Some(at(cubic, i32::from((from_first / BITS_PER_PART) as i16)))
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

    /// Bits of the middle of the cell in which a radius lies.
    const fn first_middle(radius: f32) -> u32 {
        const { assert!(N > 0 && N <= 128, "a table has 1 to 128 cells") };
        radius.to_bits() / CELL * CELL + CELL / 2
    }

    /// The largest difference between neighbouring cells where they meet.
    const fn widest_jump(&self) -> u32 {
        let mut widest = 0;
        let mut cells = self.cells.as_slice();
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

    /// The table itself, if it can be one.
    const fn checked(self) -> Result<Self, InputError> {
        let (slowest, fastest) = Parameter::CriticalSpeed.range();
        // A curve at a bound may be interpolated beyond it.
        let slack = 2 * LARGEST_MARGIN as i32;
        let (slowest, fastest) = (logarithm(slowest as f32) - slack, logarithm(fastest as f32) + slack);
        let mut cells = self.cells.as_slice();
        while let [cubic, rest @ ..] = cells {
            let mut place = -(PARTS as i32) / 2;
            while place <= PARTS as i32 / 2 {
                let value = at(cubic, place);
                if value < slowest || value > fastest {
                    let fault = if value < slowest { Fault::TooSmall } else { Fault::TooLarge };
                    return Err(InputError { parameter: Parameter::CriticalSpeed, fault });
                }
                place += PARTS as i32 / 4;
            }
            cells = rest;
        }
        let fault = match self.margin {
            margin if margin > LARGEST_MARGIN => Fault::TooLarge,
            // Both cells err by the margin at most.
            margin if margin < GREATEST_ERROR || self.widest_jump() > 2 * margin => Fault::TooSmall,
            _ => return Ok(self),
        };
        Err(InputError { parameter: Parameter::BoundaryMargin, fault })
    }
}

/// By how much a cubic changes, at most, over half the step between two places.
fn half_step(cubic: &Cubic) -> u32 {
    let [_, linear, square, cube] = cubic.map(i32::unsigned_abs);
    // The slope is largest at an end of the cell: linear + square + 3/4 cube.
    linear.saturating_add(square).saturating_add(cube) / (2 * PARTS) + 1
}

/// The number with these bits in single precision.
fn of_single<T: Real>(bits: u32) -> T {
    T::constant(f64::from(f32::from_bits(bits)))
}

/// Logarithm of the critical speed of a radius, if there is one.
fn exact_critical_speed<T: Single>(
    radius: T,
    critical: &mut impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
) -> Result<i32, InputError> {
    let fault = match critical(radius)? {
        CriticalSpeed::At(speed) => return Ok(exact_logarithm(Parameter::CriticalSpeed.check(speed)?.single())),
        CriticalSpeed::AlwaysRebounds => Fault::TooSmall,
        CriticalSpeed::NeverRebounds => Fault::TooLarge,
    };
    Err(InputError { parameter: Parameter::CriticalSpeed, fault })
}

/// Chebyshev's places for a cubic, cos(pi/8)/2 and cos(3 pi/8)/2 to either side of the middle, in parts of a cell.
const OUTER: i32 = 30_274;
const INNER: i32 = 12_540;

/// Where the cubic through them errs most within the cell: 0 and cos(pi/4)/2.
const EXTREMES: [i32; 3] = [-23_170, 0, 23_170];

/// The cubic through a curve at Chebyshev's places.
fn interpolated(curve: &mut impl FnMut(i32) -> Result<i32, InputError>) -> Result<Cubic, InputError> {
    const ALPHA: f64 = OUTER as f64 / PARTS as f64;
    const BETA: f64 = INNER as f64 / PARTS as f64;
    const SPREAD: f64 = ALPHA * ALPHA - BETA * BETA;
    let [below, above] = [curve(-OUTER)?, curve(OUTER)?].map(i64::from);
    let [left, right] = [curve(-INNER)?, curve(INNER)?].map(i64::from);
    // Twice the even and the odd part of the curve at the outer and the inner places.
    let (even, odd) = ((above + below, right + left), (above - below, right - left));
    let square = scaled::<{ fixed(0.5 / SPREAD) }>(even.0 - even.1);
    let cube = scaled::<{ fixed(0.5 / ALPHA / SPREAD) }>(odd.0) - scaled::<{ fixed(0.5 / BETA / SPREAD) }>(odd.1);
    let linear = scaled::<{ fixed(0.5 / BETA) }>(odd.1) - scaled::<{ fixed(BETA * BETA) }>(cube);
    let constant = (even.1 + 1) / 2 - scaled::<{ fixed(BETA * BETA) }>(square);
    // What does not fit shows as an error of the cubic.
    Ok([constant, linear, square, cube].map(|part| part.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32))
}

/// A factor in units of 2^-24.
const fn fixed(factor: f64) -> i64 {
    (factor * (1 << 24) as f64 + 0.5) as i64
}

/// A product with a factor in units of 2^-24.
fn scaled<const FACTOR: i64>(number: i64) -> i64 {
    (number * FACTOR + (1 << 23)) >> 24
}
