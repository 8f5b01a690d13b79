//! Restitution and elastic impulse over radius and speed.
//!
//! Where a speed is d octaves above the critical one, e rises as the root of d from zero. So e/sqrt(d) is tabulated, and
//! the elastic impulse over the momentum, I/(m v): both are smooth in sqrt(d) and in the logarithm of the radius, and
//! polynomials through 3 x 4 neighbouring nodes give them in between.

use super::logarithm::{Single, logarithm, number, octaves};
use super::table::BoundaryTable;
use crate::{Approach, Coulomb, Fault, InputError, Oblique, Parameter, Real, SurfaceMotion};

/// Restitution and elastic impulse of a rebound, as a [`RestitutionTable`] is made from.
///
/// ```
/// use microimpact::boundary::Rebound;
///
/// let rebound = Rebound { restitution: 0.8, impulse: 1.8 };
/// assert_eq!(rebound.restitution * 2.0, 1.6); // m/s, of a sphere that came with 2 m/s
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rebound<T> {
    /// Overall restitution e; zero for a capture.
    pub restitution: T,
    /// Impulse of the elastic force over the momentum before the impact, I/(m v). Friction goes by it (B8).
    pub impulse: T,
}

/// What a restitution table says of an impact.
///
/// ```
/// use microimpact::boundary::Reading;
///
/// assert_ne!(Reading::<f32>::TooCloseToCall, Reading::Capture);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Reading<T> {
    /// The sphere leaves the surface.
    Rebound {
        /// Restitution and elastic impulse.
        rebound: Rebound<T>,
        /// Greatest error of the restitution. Close to the critical speed it grows, as e is a root of the excess there.
        error: T,
    },
    /// The surface holds the sphere.
    Capture,
    /// The speed is closer to the critical one than the margin of the boundary.
    TooCloseToCall,
    /// The table does not reach there.
    OutsideTable,
}

/// The tangential motion at separation.
///
/// ```
/// use microimpact::boundary::Rebound;
/// use microimpact::{Coulomb, NormalMotion, SurfaceMotion};
///
/// let rebound = Rebound { restitution: 0.8, impulse: 2.0 };
/// let motion = NormalMotion::new(1.0)?.with_tangential(0.7)?;
/// let after = rebound.separation(&Coulomb::new(0.1)?, 0.4, &motion);
/// assert_eq!(after.motion, SurfaceMotion::Rolling);
/// assert!((after.tangential - 0.5_f64).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Separation<T> {
    /// Whether the sphere slides or rolls.
    pub motion: SurfaceMotion,
    /// Tangential velocity V_t of the centre, m/s.
    pub tangential: T,
    /// Peripheral velocity r W, m/s.
    pub peripheral: T,
}

impl<T: Real> Rebound<T> {
    /// The tangential motion at separation of a sphere of `gyration_ratio` k^2/r^2 that arrived with `motion`, as the
    /// contact simulation with Coulomb friction has it.
    ///
    /// Sliding ends when friction has turned m |v_ct|/(1 + r^2/k^2), and friction can turn f I: with adhesion that is more
    /// than f times the normal impulse, as the paper's friction goes by the elastic force alone.
    ///
    /// ```
    /// use microimpact::boundary::Rebound;
    /// use microimpact::{Coulomb, NormalMotion, SurfaceMotion};
    ///
    /// let rebound = Rebound { restitution: 0.8, impulse: 2.0 };
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let after = rebound.separation(&Coulomb::new(0.1)?, 0.4, &motion);
    /// assert_eq!(after.motion, SurfaceMotion::Sliding);
    /// assert!((after.tangential - 4.8_f64).abs() < 1e-12); // f I/m less
    /// assert!((after.peripheral - 0.5).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn separation(&self, friction: &Coulomb<T>, gyration_ratio: T, motion: &impl Oblique<T>) -> Separation<T> {
        let (slip, peripheral) = (motion.slip(), motion.peripheral());
        let most = friction.coefficient() * self.impulse * motion.normal().speed();
        let enough = slip.abs() * gyration_ratio / (T::ONE + gyration_ratio);
        let (turned, state) =
            if most >= enough { (enough, SurfaceMotion::Rolling) } else { (most, SurfaceMotion::Sliding) };
        let turned = if slip < T::ZERO { -turned } else { turned };
        let peripheral = peripheral + turned / gyration_ratio;
        let tangential = if state == SurfaceMotion::Rolling { peripheral } else { motion.tangential() - turned };
        Separation { motion: state, tangential, peripheral }
    }
}

/// Restitution and elastic impulse of a surface and a material: a boundary of `N` cells, and nodes at `R` radii, three at
/// least, and `S` speeds, four at least.
///
/// ```
/// use microimpact::boundary::{BoundaryTable, Reading, Rebound, RestitutionTable};
/// use microimpact::simulation::{Collocation, ContactImpulses, SimulatedImpact, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Glass on steel (the paper's figure 6), from radii of 2 to 8 um, up to ten times the critical speed.
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let scene = |radius| {
///     let sphere = Sphere::solid(radius, 2600.0)?;
///     Simulation::new(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)
/// };
/// let boundary = BoundaryTable::<8>::new(2e-6, |radius| scene(radius)?.critical_speed(&method))?;
/// let table = RestitutionTable::<f64, 8, 6, 10>::new(boundary, 10.0, |radius, speed| {
///     let scene = scene(radius)?;
///     let impact: SimulatedImpact<_, _, ContactImpulses<f64>> = scene.observe(&method, &NormalMotion::new(speed)?)?;
///     let impulse = impact.outputs.elastic / (scene.sphere().mass() * speed);
///     Ok(Rebound { restitution: impact.normal.overall_restitution(), impulse })
/// })?;
/// assert!(table.error() < 1e-3);
/// let Reading::Rebound { rebound, error } = table.read(5.06e-6, &NormalMotion::new(2.8)?) else { panic!() };
/// assert!((rebound.restitution - 0.746193).abs() < error && error < 1e-3);
/// assert_eq!(table.read(5.06e-6, &NormalMotion::new(1.4)?), Reading::Capture);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RestitutionTable<T, const N: usize, const R: usize, const S: usize> {
    boundary: BoundaryTable<N>,
    /// e/sqrt(d) and I/(m v), for each radius over all speeds.
    #[cfg_attr(feature = "serde", serde(serialize_with = "in_one_row"))]
    nodes: [[[T; 2]; S]; R],
    /// Logarithm of the first radius, and nodes to an octave.
    first: i32,
    per_octave: T,
    /// Nodes to one root of an octave above the critical speed; the first is half a step above it.
    per_root: T,
    /// The largest excess over the critical speed, in units of the logarithm.
    end: i32,
    error: T,
    impulse_error: T,
    /// What the margin of the boundary makes of the error, times the root.
    near: T,
}

impl<T: Single, const N: usize, const R: usize, const S: usize> RestitutionTable<T, N, R, S> {
    /// A table over the radii of a boundary, up to `ratio` times the critical speed, by a source of restitution and
    /// impulse at a radius (m) and a speed (m/s).
    ///
    /// Midway between the nodes, where the polynomials err most, the source is asked again. The errors stated are twice the
    /// largest differences found there, which bounds them as long as the derivatives that the polynomials leave out are
    /// nowhere more than twice what they are around those places; the error of the source is not in it.
    ///
    /// # Errors
    /// A ratio, or a restitution or an impulse of the source, outside its range; a speed beyond the range of speeds; and the
    /// errors of the source.
    ///
    /// ```
    /// use microimpact::boundary::{BoundaryTable, Rebound, RestitutionTable};
    /// use microimpact::{CriticalSpeed, Parameter};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(Rebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// assert!(RestitutionTable::<f64, 2, 4, 12>::new(boundary, 10.0, source)?.error() < 2e-3);
    /// let error = RestitutionTable::<f64, 2, 4, 12>::new(boundary, 1.0, source).unwrap_err();
    /// assert_eq!(error.parameter, Parameter::SpeedRatio);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(
        boundary: BoundaryTable<N>,
        ratio: T,
        mut source: impl FnMut(T, T) -> Result<Rebound<T>, InputError>,
    ) -> Result<Self, InputError> {
        const { assert!(R >= 3 && S >= 4 && R <= 256 && S <= 256, "3 to 256 radii, 4 to 256 speeds") };
        let count = |number: usize| T::constant(number as f64);
        let end = logarithm(Parameter::SpeedRatio.check(ratio)?.single()) - logarithm(1.0);
        let (first, last) = boundary.logarithms();
        let mut table = Self {
            boundary,
            nodes: [[[T::ZERO; 2]; S]; R],
            first,
            per_octave: count(R - 1) / octaves(last - first),
            per_root: (count(S) - T::constant(0.5)) / octaves::<T>(end).sqrt(),
            end,
            error: T::ZERO,
            impulse_error: T::ZERO,
            near: T::ZERO,
        };
        let mut steepest = T::ZERO;
        for i in 0..R {
            for j in 0..S {
                let root = (count(j) + T::constant(0.5)) / table.per_root;
                let rebound = table.sample(count(i), root, &mut source)?;
                let node = [rebound.restitution / root, rebound.impulse];
                steepest = steepest.max(node[0]);
                if let Some(place) = table.nodes.get_mut(i).and_then(|row| row.get_mut(j)) {
                    *place = node;
                }
            }
        }
        let half = T::constant(0.5);
        for i in 0..R - 1 {
            for j in 0..S {
                // Midway between the nodes, and midway from the critical speed to the first.
                let column = if j == 0 { T::constant(-0.25) } else { count(j) - half };
                let root = (column + half) / table.per_root;
                let exact = table.sample(count(i) + half, root, &mut source)?;
                let found = table.interpolated(count(i) + half, column);
                table.error = table.error.max((found.0 * root - exact.restitution).abs());
                table.impulse_error = table.impulse_error.max((found.1 - exact.impulse).abs());
            }
        }
        table.error = table.error + table.error;
        table.impulse_error = table.impulse_error + table.impulse_error;
        table.near = steepest * octaves(table.boundary.margin as i32);
        Ok(table)
    }

    /// Greatest error of the restitution, but for what [`Reading::Rebound`] adds close to the critical speed.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::{BoundaryTable, Rebound, RestitutionTable};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(Rebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// let coarse = RestitutionTable::<f64, 2, 4, 6>::new(boundary, 10.0, source)?;
    /// let fine = RestitutionTable::<f64, 2, 4, 24>::new(boundary, 10.0, source)?;
    /// assert!(fine.error() < 0.1 * coarse.error());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn error(&self) -> T {
        self.error
    }

    /// Greatest error of the elastic impulse, over the momentum m v.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::{BoundaryTable, Rebound, RestitutionTable};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(Rebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// assert!(RestitutionTable::<f64, 2, 3, 6>::new(boundary, 10.0, source)?.impulse_error() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impulse_error(&self) -> T {
        self.impulse_error
    }

    /// The boundary between capture and rebound.
    ///
    /// ```
    /// use microimpact::CriticalSpeed;
    /// use microimpact::boundary::{BoundaryTable, Rebound, RestitutionTable};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(Rebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// assert_eq!(RestitutionTable::<f64, 2, 4, 6>::new(boundary, 10.0, source)?.boundary(), &boundary);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn boundary(&self) -> &BoundaryTable<N> {
        &self.boundary
    }

    /// What becomes of a sphere of `radius` (m) that arrives with `motion`.
    ///
    /// ```
    /// use microimpact::boundary::{BoundaryTable, Reading, Rebound, RestitutionTable};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let boundary = BoundaryTable::<2>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(1.0)))?;
    /// let source = |_, speed: f64| Ok(Rebound { restitution: (1.0 - speed.powi(-2)).sqrt(), impulse: 2.0 });
    /// let table = RestitutionTable::<f64, 2, 4, 16>::new(boundary, 10.0, source)?;
    /// let read = |radius, speed| Ok::<_, microimpact::InputError>(table.read(radius, &NormalMotion::new(speed)?));
    /// let Reading::Rebound { rebound, error } = read(1e-6, 2.0)? else { panic!() };
    /// assert!((rebound.restitution - 0.75_f64.sqrt()).abs() < error);
    /// assert_eq!(read(1e-6, 0.9)?, Reading::Capture);
    /// assert_eq!(read(1e-6, 1.0)?, Reading::TooCloseToCall);
    /// assert_eq!(read(1e-6, 11.0)?, Reading::OutsideTable);
    /// assert_eq!(read(1e-3, 2.0)?, Reading::OutsideTable);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn read(&self, radius: T, motion: &impl Approach<T>) -> Reading<T> {
        let Some(critical) = self.boundary.logarithm_at(radius) else {
            return Reading::OutsideTable;
        };
        let excess = logarithm(motion.normal().speed().single()).wrapping_sub(critical);
        let margin = self.boundary.margin as i32;
        if excess <= margin {
            return if excess < -margin { Reading::Capture } else { Reading::TooCloseToCall };
        }
        if excess > self.end {
            return Reading::OutsideTable;
        }
        let root = octaves::<T>(excess).sqrt();
        let row = octaves::<T>(logarithm(radius.single()) - self.first) * self.per_octave;
        let (slope, impulse) = self.interpolated(row, root * self.per_root - T::constant(0.5));
        let rebound = Rebound { restitution: slope * root, impulse };
        Reading::Rebound { rebound, error: self.error + self.near / root }
    }

    /// e/sqrt(d) and I/(m v) at a place, counted in nodes.
    // A call would move all of the place to memory and back.
    #[inline(always)]
    fn interpolated(&self, row: T, column: T) -> (T, T) {
        let (i, across) = parabola::<T, R>(row);
        let (j, along) = cubic::<T, S>(column);
        let mut sums = [T::ZERO; 2];
        // The windows lie within the nodes, which the compiler cannot know.
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

    /// The source at a row of nodes and a root.
    fn sample(
        &self,
        row: T,
        root: T,
        source: &mut impl FnMut(T, T) -> Result<Rebound<T>, InputError>,
    ) -> Result<Rebound<T>, InputError> {
        let units = |octaves: T| (octaves.single() * super::logarithm::OCTAVE as f32) as i32;
        let radius = T::from_single(self.boundary.radius_at(self.first + units(row / self.per_octave)));
        let critical = self.boundary.logarithm_at(radius);
        let critical = critical.ok_or(InputError { parameter: Parameter::Radius, fault: Fault::TooLarge })?;
        let speed = T::from_single(number(critical.saturating_add(units(root * root))));
        let rebound = source(radius, Parameter::ApproachSpeed.check(speed)?)?;
        Ok(Rebound {
            restitution: Parameter::Restitution.check(rebound.restitution)?,
            impulse: Parameter::ImpulseOverMomentum.check(rebound.impulse)?,
        })
    }
}

/// The first of four neighbouring nodes around a place, and their weights in the cubic through them.
#[inline]
fn cubic<T: Single, const COUNT: usize>(place: T) -> (usize, [T; 4]) {
    // Conversion to an integer saturates, so that the window lies within the nodes wherever the place is.
    let first = ((place - T::ONE).single() as usize).min(COUNT - 4);
    let a = place - T::from_single(first as f32);
    let (b, c, d) = (a - T::ONE, a - T::constant(2.0), a - T::constant(3.0));
    let (left, right) = (a * b, c * d);
    let (half, sixth) = (T::constant(0.5), T::constant(1.0 / 6.0));
    let (outer, inner) = (sixth * right, half * right);
    (first, [-(outer * b), inner * a, -(half * left * d), sixth * left * c])
}

/// The first of three neighbouring nodes around a place, and their weights in the parabola through them.
#[inline]
fn parabola<T: Single, const COUNT: usize>(place: T) -> (usize, [T; 3]) {
    let half = T::constant(0.5);
    let first = ((place - half).single() as usize).min(COUNT - 3);
    let a = place - T::from_single(first as f32);
    let (b, c) = (a - T::ONE, a - T::constant(2.0));
    (first, [half * b * c, -(a * c), half * a * b])
}

/// The nodes as one sequence: serde knows arrays of some lengths alone.
#[cfg(feature = "serde")]
fn in_one_row<T, Z, const R: usize, const S: usize>(nodes: &[[[T; 2]; S]; R], serializer: Z) -> Result<Z::Ok, Z::Error>
where
    T: serde::Serialize,
    Z: serde::Serializer,
{
    serializer.collect_seq(nodes.iter().flatten().flatten())
}
