//! Tables of restitution and elastic impulse as functions of radius and speed.
//!
//! Let d be the base-2 logarithm of the speed divided by the critical speed. Close to the critical speed, e is proportional to
//! sqrt(d). So the table holds e/sqrt(d) and the elastic impulse divided by the momentum, I/(m v). Both are smooth functions
//! of sqrt(d) and of the logarithm of the radius. Polynomials through 3 x 4 neighbouring nodes interpolate them.

#[cfg(feature = "serde")]
use super::RestitutionParts;
use super::boundary::BoundaryTable;
use super::logarithm::{Single, logarithm, octaves};
use super::restitution_maker::{RestitutionTableMaker, range};
use crate::rolling::Friction;
use crate::{Approach, Coulomb, InputError, Oblique, Real, Separation};

/// Restitution and elastic impulse of a rebound: what a [`RestitutionTable`] holds for each radius and speed.
///
/// ```
/// use microimpact::table::TableRebound;
///
/// let rebound = TableRebound { restitution: 0.8, impulse: 1.8 };
/// assert_eq!(rebound.restitution * 2.0, 1.6); // rebound speed in m/s for an approach speed of 2 m/s
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TableRebound<T> {
    /// Overall restitution e, 0 to 1; zero for a capture.
    pub restitution: T,
    /// Impulse of the elastic force divided by the momentum before the impact, I/(m v). Friction is proportional to it (B8).
    pub impulse: T,
}

/// Result of a lookup in a [`RestitutionTable`].
///
/// ```
/// use microimpact::table::Lookup;
///
/// assert_ne!(Lookup::<f32>::TooCloseToCall, Lookup::Capture);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Lookup<T> {
    /// The sphere leaves the surface.
    Rebound {
        /// Restitution and elastic impulse.
        rebound: TableRebound<T>,
        /// Bound of the error of the restitution. It grows towards the critical speed, where e is proportional to sqrt(d).
        /// That of the impulse is [`RestitutionTable::impulse_error_of`].
        error: T,
    },
    /// The surface holds the sphere.
    Capture,
    /// The speed is within the error margin of the critical speed.
    TooCloseToCall,
    /// The table does not cover this radius or this speed.
    OutsideTable,
}

impl<T: Real> TableRebound<T> {
    /// Motion along the surface at separation, of a sphere with `gyration_ratio` k^2/r^2 that arrived with `motion`.
    ///
    /// The result is that of the contact simulation with Coulomb friction. Sliding ends when the friction impulse reaches
    /// m |v_ct|/(1 + r^2/k^2). The friction impulse is at most f I, because the friction of the paper is proportional to the
    /// elastic force. With adhesion, f I exceeds f times the normal impulse.
    ///
    /// ```
    /// use microimpact::table::TableRebound;
    /// use microimpact::{Coulomb, NormalMotion, SurfaceMotion};
    ///
    /// let rebound = TableRebound { restitution: 0.8, impulse: 2.0 };
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let after = rebound.separation(&Coulomb::new(0.1)?, 0.4, &motion);
    /// assert_eq!(after.motion, SurfaceMotion::Sliding);
    /// assert!((after.velocity - 4.8_f64).abs() < 1e-12); // f I/m less
    /// assert!((after.peripheral - 0.5).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn separation(&self, friction: &Coulomb<T>, gyration_ratio: T, motion: &impl Oblique<T>) -> Separation<T> {
        let limit = friction.coefficient() * self.impulse * motion.normal().speed();
        let contact_inertia = gyration_ratio / (T::ONE + gyration_ratio);
        Friction::against(motion.slip(), limit, contact_inertia).separation(motion, gyration_ratio)
    }
}

/// Restitution and elastic impulse for a sphere material and a surface.
///
/// The table consists of a boundary with `N` cells, and of nodes at `R` radii (at least three) and `S` speeds (at least four).
///
/// ```
/// use microimpact::table::{BoundaryTable, Lookup, RestitutionTable, TableRebound};
/// use microimpact::contact::{Collocation, Contact, Impulses};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Glass on steel (the paper's figure 6), from radii of 2 to 8 um, up to ten times the critical speed.
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let scene = |radius| {
///     let sphere = Sphere::solid(radius, 2600.0)?;
///     Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)
/// };
/// let boundary = BoundaryTable::<8>::new(2e-6, |radius| scene(radius)?.critical_speed(&method))?;
/// let table = RestitutionTable::<f64, 8, 6, 10>::new(boundary, 10.0, |radius, speed| {
///     let scene = scene(radius)?;
///     let (impact, impulses) = scene.solve_for(&NormalMotion::new(speed)?, &method, Impulses)?;
///     let impulse = impulses.elastic / (scene.sphere().mass() * speed);
///     Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
/// })?;
/// assert!(table.error() < 1e-3);
/// let Lookup::Rebound { rebound, error } = table.look_up(5.06e-6, &NormalMotion::new(2.8)?) else { panic!() };
/// assert!((rebound.restitution - 0.746193).abs() < error && error < 1e-3);
/// assert_eq!(table.look_up(5.06e-6, &NormalMotion::new(1.4)?), Lookup::Capture);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        into = "RestitutionParts<T, N, R, S>",
        try_from = "RestitutionParts<T, N, R, S>",
        bound(
            serialize = "T: Copy + serde::Serialize",
            deserialize = "T: Copy + Default + serde::Deserialize<'de>, Self: TryFrom<RestitutionParts<T, N, R, S>, Error = InputError>"
        )
    )
)]
pub struct RestitutionTable<T, const N: usize, const R: usize, const S: usize> {
    pub(super) boundary: BoundaryTable<N>,
    /// e/sqrt(d) and I/(m v): one row of speeds for each radius.
    pub(super) nodes: [[[T; 2]; S]; R],
    /// Logarithm of the first radius.
    pub(super) first: i32,
    /// Nodes per octave of radii.
    pub(super) per_octave: T,
    /// Nodes per unit of sqrt(d). The first node is half a step above the critical speed.
    pub(super) per_root: T,
    /// Largest logarithm of speed over critical speed.
    pub(super) end: i32,
    pub(super) error: T,
    pub(super) impulse_error: T,
    /// Error of the restitution by the margin of the boundary, times sqrt(d).
    pub(super) near: T,
    /// The same error of the impulse over that of the restitution.
    pub(super) impulse_over_restitution: T,
}

impl<T, const N: usize, const R: usize, const S: usize> RestitutionTable<T, N, R, S> {
    pub(super) const COUNTED: () = assert!(R >= 3 && S >= 4 && R <= 256 && S <= 256, "3 to 256 radii, 4 to 256 speeds");
}

impl<T: Single, const N: usize, const R: usize, const S: usize> RestitutionTable<T, N, R, S> {
    /// Fills a table over the radii of a boundary, up to `ratio` times the critical speed.
    ///
    /// The `source` computes restitution and impulse for a radius (m) and a speed (m/s). It is called at the `R` times `S`
    /// nodes and, to find the errors, on a grid of places at nodes, on the lines between them and inside the cells. The
    /// grid divides each cell in three by two, or finer if there are few cells, so that it has at least 13 by 15 places, also
    /// close to the critical speed. In all there are about six calls for each node, and at least 195. A
    /// [`RestitutionTableMaker`] makes them in steps.
    ///
    /// The bounds of the interpolation error, [`error`](Self::error) and [`impulse_error`](Self::impulse_error), are twice
    /// the largest differences found, plus rounding. They hold if between the places the difference is nowhere more than twice
    /// the largest one at a place. The effect of the margin of the boundary is added to the error of each lookup. The error of
    /// the source is not included. The interpolated restitution need not increase with the speed.
    ///
    /// # Errors
    /// The ratio, a speed, or a restitution or an impulse of the source is outside its range; and the errors of the source.
    ///
    /// ```
    /// use microimpact::table::{BoundaryTable, RestitutionTable, TableRebound};
    /// use microimpact::{CriticalSpeed, Parameter};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// assert!(RestitutionTable::<f64, 2, 4, 12>::new(boundary, 10.0, source)?.error() < 2e-3);
    /// let error = RestitutionTable::<f64, 2, 4, 12>::new(boundary, 1.0, source).unwrap_err();
    /// assert_eq!(error.parameter, Parameter::SpeedRatio);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(
        boundary: BoundaryTable<N>,
        ratio: T,
        source: impl FnMut(T, T) -> Result<TableRebound<T>, InputError>,
    ) -> Result<Self, InputError> {
        let mut maker = RestitutionTableMaker::with_range(boundary, range(ratio)?);
        maker.advance(usize::MAX, source)?;
        Ok(*maker.finished())
    }

    /// Bound of the interpolation error of the restitution: twice the largest error found when the table was made.
    ///
    /// The error in [`Lookup::Rebound`] is larger, because it includes the effect of the margin of the boundary. That is
    /// proportional to 1/sqrt(d), so it is largest close to the critical speed.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTable, TableRebound};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// let coarse = RestitutionTable::<f64, 2, 4, 6>::new(boundary, 10.0, source)?;
    /// let fine = RestitutionTable::<f64, 2, 4, 24>::new(boundary, 10.0, source)?;
    /// assert!(fine.error() < 0.1 * coarse.error());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn error(&self) -> T {
        self.error
    }

    /// Bound of the interpolation error of the elastic impulse, divided by the momentum m v: twice the largest error found
    /// when the table was made.
    ///
    /// The margin of the boundary adds to it, as [`impulse_error_of`](Self::impulse_error_of) says.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTable, TableRebound};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// assert!(RestitutionTable::<f64, 2, 3, 6>::new(boundary, 10.0, source)?.impulse_error() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impulse_error(&self) -> T {
        self.impulse_error
    }

    /// Bound of the error of the impulse that a lookup in this table has returned, divided by the momentum m v. `None` unless
    /// the sphere rebounds.
    ///
    /// It grows towards the critical speed, because it includes the effect of the margin of the boundary.
    ///
    /// ```
    /// use microimpact::table::{BoundaryTable, Lookup, RestitutionTable, TableRebound};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let impulse = |speed: f64| 1.0 + 1.0 / speed;
    /// let source =
    ///     |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: impulse(speed) });
    /// let table = RestitutionTable::<f64, 2, 3, 6>::new(boundary, 10.0, source)?;
    /// let error_at = |speed| Ok(table.impulse_error_of(&table.look_up(1e-6, &NormalMotion::new(speed)?)));
    /// assert!(error_at(1.01)? > error_at(2.0)? && error_at(2.0)? > Some(table.impulse_error()));
    /// assert_eq!(error_at(0.5)?, None);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impulse_error_of(&self, lookup: &Lookup<T>) -> Option<T> {
        match lookup {
            Lookup::Rebound { error, .. } => {
                Some(self.impulse_error + (*error - self.error) * self.impulse_over_restitution)
            }
            _ => None,
        }
    }

    /// The boundary between capture and rebound.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::table::{BoundaryTable, RestitutionTable, TableRebound};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// assert_eq!(RestitutionTable::<f64, 2, 4, 6>::new(boundary, 10.0, source)?.boundary(), &boundary);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn boundary(&self) -> &BoundaryTable<N> {
        &self.boundary
    }

    /// Looks up the impact of a sphere of `radius` (m) that arrives with `motion`. The restitution is limited to 0 to 1.
    ///
    /// ```
    /// use microimpact::table::{BoundaryTable, Lookup, RestitutionTable, TableRebound};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(TableRebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// let table = RestitutionTable::<f64, 2, 4, 16>::new(boundary, 10.0, source)?;
    /// let look_up = |radius, speed| Ok::<_, microimpact::InputError>(table.look_up(radius, &NormalMotion::new(speed)?));
    /// let Lookup::Rebound { rebound, error } = look_up(1e-6, 2.0)? else { panic!() };
    /// assert!((rebound.restitution - 0.75_f64.sqrt()).abs() < error);
    /// assert_eq!(look_up(1e-6, 0.9)?, Lookup::Capture);
    /// assert_eq!(look_up(1e-6, 1.0)?, Lookup::TooCloseToCall);
    /// assert_eq!(look_up(1e-6, 11.0)?, Lookup::OutsideTable);
    /// assert_eq!(look_up(1e-3, 2.0)?, Lookup::OutsideTable);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn look_up(&self, radius: T, motion: &impl Approach<T>) -> Lookup<T> {
        let Some(critical) = self.boundary.logarithm_at(radius) else {
            return Lookup::OutsideTable;
        };
        let excess = logarithm(motion.normal().speed().single()).wrapping_sub(critical);
        let margin = self.boundary.margin as i32;
        if excess <= margin {
            return if excess < -margin { Lookup::Capture } else { Lookup::TooCloseToCall };
        }
        if excess > self.end {
            return Lookup::OutsideTable;
        }
        let root = octaves::<T>(excess).sqrt();
        let row = octaves::<T>(logarithm(radius.single()) - self.first) * self.per_octave;
        let (slope, impulse) = self.interpolated(row, root * self.per_root - T::constant(0.5));
        // Between the nodes, polynomials exceed the range of the restitution.
        let rebound = TableRebound { restitution: (slope * root).max(T::ZERO).min(T::ONE), impulse };
        Lookup::Rebound { rebound, error: self.error + self.near / root }
    }

    /// Interpolates e/sqrt(d) and I/(m v) at a place that is counted in nodes.
    // A function call would pass all values through memory.
    #[inline(always)]
    pub(super) fn interpolated(&self, row: T, column: T) -> (T, T) {
        let (i, across) = parabola::<T, R>(row);
        let (j, along) = cubic::<T, S>(column);
        let mut sums = [T::ZERO; 2];
        // The windows are always within the nodes, but the compiler does not know it.
        let Some(rows) = self.nodes.get(i..).and_then(|rows| rows.first_chunk::<3>()) else {
            return (T::ZERO, T::ZERO);
        };
        for (row, weight) in rows.iter().zip(across) {
            if let Some([a, b, c, d]) = row.get(j..).and_then(|row| row.first_chunk::<4>()) {
                let [p, q, r, s] = along;
                sums[0] = sums[0] + weight * (p * a[0] + q * b[0] + r * c[0] + s * d[0]);
                sums[1] = sums[1] + weight * (p * a[1] + q * b[1] + r * c[1] + s * d[1]);
            }
        }
        (sums[0], sums[1])
    }
}

/// The first of the four nodes around a place, and the weights of these nodes in the cubic through them.
#[inline]
fn cubic<T: Single, const COUNT: usize>(place: T) -> (usize, [T; 4]) {
    // The conversion to an integer saturates, so that the window is within the nodes for every place.
    let first = ((place - T::ONE).single() as usize).min(COUNT - 4);
    let a = place - T::from_single(first as f32);
    let (b, c, d) = (a - T::ONE, a - T::constant(2.0), a - T::constant(3.0));
    let (left, right) = (a * b, c * d);
    let (half, sixth) = (T::constant(0.5), T::constant(1.0 / 6.0));
    let (outer, inner) = (sixth * right, half * right);
    (first, [-(outer * b), inner * a, -(half * left * d), sixth * left * c])
}

/// The first of the three nodes around a place, and the weights of these nodes in the parabola through them.
#[inline]
fn parabola<T: Single, const COUNT: usize>(place: T) -> (usize, [T; 3]) {
    let half = T::constant(0.5);
    let first = ((place - half).single() as usize).min(COUNT - 3);
    let a = place - T::from_single(first as f32);
    let (b, c) = (a - T::ONE, a - T::constant(2.0));
    (first, [half * b * c, -(a * c), half * a * b])
}
