//! The critical speed over a range of radii.

use super::Verdict;
use super::logarithm::{OCTAVE, Single, logarithm, number};
use super::slice::{BoundarySlice, CELL, of_single};
use crate::{Approach, CriticalSpeed, InputError, Real};

/// The relative error that one unit of a logarithm is.
const UNIT: f64 = core::f64::consts::LN_2 / OCTAVE as f64;

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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "Parts<N>", try_from = "Parts<N>"))]
pub struct BoundaryTable<const N: usize> {
    cells: [[i32; 4]; N],
    /// Bits of the radius in the middle of the first cell.
    first: u32,
    pub(super) margin: u32,
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
    /// [`Parameter::CriticalSpeed`]: crate::Parameter::CriticalSpeed
    /// [`Parameter::BoundaryMargin`]: crate::Parameter::BoundaryMargin
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
        critical: impl FnMut(T) -> Result<CriticalSpeed<T>, InputError>,
    ) -> Result<Self, InputError> {
        const { Self::COUNTED }
        let mut cells = [[0; 4]; N];
        let BoundarySlice { first, margin, .. } = BoundarySlice::fill(smallest, &mut cells, critical)?;
        Ok(Self { cells, first, margin })
    }

    /// A table from its parts: the radius `smallest` (m), the margin and the cells, as [`parts`](Self::parts) gives them;
    /// for tables that are constants.
    ///
    /// # Errors
    /// A radius outside its range; [`Parameter::CriticalSpeed`] where a cell holds what is no speed;
    /// [`Parameter::BoundaryMargin`] where the margin is too large, or smaller than what neighbouring cells differ by.
    ///
    /// [`Parameter::CriticalSpeed`]: crate::Parameter::CriticalSpeed
    /// [`Parameter::BoundaryMargin`]: crate::Parameter::BoundaryMargin
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
        const { Self::COUNTED }
        match BoundarySlice::from_parts(smallest, margin, &cells) {
            Ok(BoundarySlice { first, margin, .. }) => Ok(Self { cells, first, margin }),
            Err(error) => Err(error),
        }
    }

    const COUNTED: () = assert!(N > 0 && N <= 128, "a table has 1 to 128 cells");

    /// The table without its number of cells.
    ///
    /// ```
    /// use microimpact::boundary::{BoundaryTable, Verdict};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let table = BoundaryTable::<2>::new(1e-6, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
    /// assert_eq!(table.as_slice().classify(1.25e-6, &NormalMotion::new(0.9)?), Verdict::Rebound);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub const fn as_slice(&self) -> BoundarySlice<'_> {
        BoundarySlice { cells: &self.cells, first: self.first, margin: self.margin }
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

/// What a table is outside.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Parts<const N: usize> {
    /// Radius at which the table begins, m.
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
