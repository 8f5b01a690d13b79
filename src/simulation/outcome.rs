//! Results of a simulation, in SI units.

use core::f64::consts::PI;

use super::SimulatedImpact;
use super::motion::{End, MOST_STRETCHES, NormalPath};
use super::observer::{Impulses, Observer, Times, Works};
use super::scaled::Scaled;
use super::tangential::{SpinDamping, TangentialMotion};
use crate::rigid::EnergyLedger;
use crate::{Class, Outcome, Real, Sphere, Stiffness, SurfaceMotion};

/// The normal side of a simulated impact.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Without adhesion and damping this is Hertz's impact.
/// let scene = Simulation::new(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let contact = scene.normal_impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(2.8)?)?;
/// assert!((contact.peak_indentation().unwrap() - 1.9713e-8).abs() < 1e-12);
/// assert!((contact.peak_contact_radius().unwrap() - 2.9115e-7).abs() < 1e-11);
/// assert!((contact.peak_force().unwrap() - 4.3046e-4).abs() < 1e-8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalContact<T> {
    status: Status,
    outcome: Outcome,
    approach: T,
    restitution_squared: T,
    peak_indentation: Option<T>,
    turning_indentation: Option<T>,
    radius: T,
    stiffness: T,
}

impl<T: Real> NormalContact<T> {
    pub(super) fn new(
        path: &NormalPath<T>,
        approach: T,
        sphere: &Sphere<T>,
        stiffness: Stiffness<T>,
        units: &Scaled<T>,
    ) -> Self {
        let outcome = if path.end == End::Separation { Outcome::Rebound } else { Outcome::Capture };
        let restitution_squared = match outcome {
            Outcome::Rebound => path.energy.max(T::ZERO) / units.energy,
            Outcome::Capture => T::ZERO,
        };
        let indentation = |s: T| (s > T::ZERO).then(|| units.length * s * s);
        Self {
            status: Status::of(path),
            outcome,
            approach,
            restitution_squared,
            peak_indentation: indentation(path.peak),
            turning_indentation: indentation(path.turning),
            radius: sphere.radius(),
            stiffness: stiffness.pascals(),
        }
    }

    /// Whether the method has come to a solution.
    ///
    /// ```
    /// use microimpact::simulation::{FixedCost, Simulation, Status};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1e4)?;
    /// let contact = scene.normal_impact(&FixedCost::<5>::new(3)?, &NormalMotion::new(1.0)?)?;
    /// assert_eq!(contact.status(), Status::BudgetSpent); // too strongly damped for a method of fixed cost
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn status(&self) -> Status {
        self.status
    }

    /// Rebound or capture; not to be relied on unless the [`status`](Self::status) is that of a solution.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// assert_eq!(scene.normal_impact(&method, &NormalMotion::new(1.0)?)?.outcome(), Outcome::Rebound);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// Overall restitution e; zero for a capture.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// let contact = scene.normal_impact(&method, &NormalMotion::new(1.0)?)?;
    /// assert!((contact.overall_restitution() - 1.0).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn overall_restitution(&self) -> T {
        self.restitution_squared.sqrt()
    }

    /// Rebound speed V_n, m/s; zero for a capture.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// let contact = scene.normal_impact(&method, &NormalMotion::new(2.0)?)?;
    /// assert!((contact.rebound_speed() - 2.0).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn rebound_speed(&self) -> T {
        self.approach * self.overall_restitution()
    }

    /// Peak indentation, m; `None` where an over-damped sphere creeps in without a peak.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// assert!(scene.normal_impact(&method, &NormalMotion::new(1.0)?)?.peak_indentation().is_some());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn peak_indentation(&self) -> Option<T> {
        self.peak_indentation
    }

    /// Contact radius at the peak, m.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let contact = scene.normal_impact(&Collocation::<7, f64>::new(1e-6)?, &NormalMotion::new(1.0)?)?;
    /// let (radius, depth) = (contact.peak_contact_radius().unwrap(), contact.peak_indentation().unwrap());
    /// assert!((radius * radius / (1e-6 * depth) - 1.0).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn peak_contact_radius(&self) -> Option<T> {
        self.peak_indentation.map(|depth| (self.radius * depth).sqrt())
    }

    /// Elastic force sqrt(r) K delta^(3/2) at the peak, N.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let motion = NormalMotion::new(1.0)?;
    /// let contact = Simulation::new(sphere, stiffness).normal_impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?;
    /// assert!((contact.peak_force().unwrap() / Hertz::new(&sphere, stiffness, &motion).force - 1.0).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn peak_force(&self) -> Option<T> {
        self.peak_indentation.map(|depth| {
            let share = depth / self.radius;
            self.radius * self.radius * self.stiffness * share * share.sqrt()
        })
    }

    /// Indentation at which a captured sphere first turns back, m; `None` for a rebound, a sphere that creeps to rest, or
    /// one that was not followed so far.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?;
    /// let turning = impact.normal.turning_indentation().unwrap();
    /// assert!(turning > 0.0 && turning < impact.normal.peak_indentation().unwrap());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn turning_indentation(&self) -> Option<T> {
        self.turning_indentation
    }
}

/// Something that a simulation can be asked for besides how it ends; chosen by its type, and absent where not named.
///
/// ```
/// use microimpact::simulation::{ContactTimes, Output};
///
/// assert!(<(ContactTimes<f64>, ()) as Output<f64>>::TIMED);
/// ```
pub trait Output<T: Real>: Sized {
    /// Whether the time that a stretch takes has to meet the tolerance too.
    const TIMED: bool;
    /// What is integrated along the motion.
    type Observer: Observer<T>;

    /// The state at first touch.
    fn begin() -> Self::Observer;

    /// The output in SI units.
    fn finish(observer: Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self;
}

impl<T: Real> Output<T> for () {
    const TIMED: bool = false;
    type Observer = ();

    fn begin() {}

    fn finish((): (), _path: &NormalPath<T>, _sphere: &Sphere<T>, _units: &Scaled<T>) {}
}

impl<T: Real, A: Output<T>, B: Output<T>> Output<T> for (A, B) {
    const TIMED: bool = A::TIMED || B::TIMED;
    type Observer = (A::Observer, B::Observer);

    fn begin() -> Self::Observer {
        (A::begin(), B::begin())
    }

    fn finish((a, b): Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        (A::finish(a, path, sphere, units), B::finish(b, path, sphere, units))
    }
}

/// All outputs of a simulation.
///
/// ```
/// use microimpact::simulation::{Collocation, Everything, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
/// let Everything { times, impulses, works } =
///     scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?.outputs;
/// assert!(times.contact.is_some() && impulses.elastic > 0.0 && works.material > 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Everything<T> {
    /// When the peak and the separation came.
    pub times: ContactTimes<T>,
    /// Impulses of the elastic force and of adhesion.
    pub impulses: ContactImpulses<T>,
    /// Works of the two kinds of damping.
    pub works: ContactWorks<T>,
}

impl<T: Real> Output<T> for Everything<T> {
    const TIMED: bool = true;
    type Observer = (Times<T>, (Impulses<T>, Works<T>));

    fn begin() -> Self::Observer {
        (Times::new(), (Impulses::new(), Works::new()))
    }

    fn finish(observer: Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        let (times, (impulses, works)) = observer;
        Self {
            times: Output::finish(times, path, sphere, units),
            impulses: Output::finish(impulses, path, sphere, units),
            works: Output::finish(works, path, sphere, units),
        }
    }
}

/// Times of a simulated impact, s, from first touch.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
///
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let motion = NormalMotion::new(1.0)?;
/// let times = Simulation::new(sphere, stiffness).impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?.outputs.times;
/// assert!((times.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0).abs() < 1e-7);
/// assert!((times.peak.unwrap() / times.contact.unwrap() - 0.5).abs() < 1e-7);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactTimes<T> {
    /// Time of the peak; `None` where there is none.
    pub peak: Option<T>,
    /// Time of separation; `None` for a capture.
    pub contact: Option<T>,
}

impl<T: Real> Output<T> for ContactTimes<T> {
    const TIMED: bool = true;
    type Observer = Times<T>;

    fn begin() -> Times<T> {
        Times::new()
    }

    fn finish(times: Times<T>, path: &NormalPath<T>, _sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        Self::new(&times, path, units)
    }
}

impl<T: Real> ContactTimes<T> {
    pub(super) fn new(times: &Times<T>, path: &NormalPath<T>, units: &Scaled<T>) -> Self {
        let unit = units.time();
        Self {
            peak: (path.peak > T::ZERO).then(|| times.peak * unit),
            contact: (path.end == End::Separation).then(|| times.now * unit),
        }
    }
}

/// Normal impulses of a simulated impact, N s.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Without adhesion and damping the elastic force reverses the momentum.
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = Simulation::new(sphere, Stiffness::new(1e10)?);
/// let impulses = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?.outputs.impulses;
/// assert!((impulses.elastic / (2.0 * sphere.mass()) - 1.0).abs() < 1e-8);
/// assert_eq!(impulses.adhesion_rebound, 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactImpulses<T> {
    /// Integral of the elastic force sqrt(r) K delta^(3/2).
    pub elastic: T,
    /// Size of the impulse of adhesion on rebound, its damping included.
    pub adhesion_rebound: T,
}

impl<T: Real> Output<T> for ContactImpulses<T> {
    const TIMED: bool = true;
    type Observer = Impulses<T>;

    fn begin() -> Impulses<T> {
        Impulses::new()
    }

    fn finish(impulses: Impulses<T>, _path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        Self::new(&impulses, sphere, units)
    }
}

impl<T: Real> ContactImpulses<T> {
    pub(super) fn new(impulses: &Impulses<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        let unit = sphere.mass() * units.speed;
        Self { elastic: impulses.elastic * unit, adhesion_rebound: impulses.adhesion_rebound * unit }
    }
}

/// Energies that the two kinds of damping take from the normal motion, J.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
/// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(2.8)?)?;
/// let e = impact.normal.overall_restitution();
/// let lost = 0.5 * sphere.mass() * 2.8 * 2.8 * (1.0 - e * e);
/// assert!(((impact.outputs.works.material + impact.outputs.works.adhesion) / lost - 1.0).abs() < 1e-8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactWorks<T> {
    /// Lost to the damping in the materials.
    pub material: T,
    /// Lost to the damping of adhesion.
    pub adhesion: T,
}

impl<T: Real> Output<T> for ContactWorks<T> {
    const TIMED: bool = false;
    type Observer = Works<T>;

    fn begin() -> Works<T> {
        Works::new()
    }

    fn finish(works: Works<T>, _path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        Self::new(&works, sphere, units)
    }
}

impl<T: Real> ContactWorks<T> {
    pub(super) fn new(works: &Works<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        // In this order no factor leaves the range of single precision.
        let energy = |work: T| sphere.mass() * units.speed * (units.speed * work);
        Self { material: energy(works.material), adhesion: energy(works.adhesion) }
    }
}

/// The tangential side of a simulated impact, at separation or where a captured sphere was left.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
///
/// // Rolling at separation: V_t = 5 v_t/7 for a solid sphere, whatever the force law.
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
/// let motion = NormalMotion::new(1.0)?.with_tangential(0.7)?;
/// let contact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?.tangential;
/// assert_eq!(contact.motion(), SurfaceMotion::Rolling);
/// assert!((contact.velocity() - 0.5).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentialContact<T> {
    motion: SurfaceMotion,
    velocity: T,
    spin: T,
    rotation: T,
    displacement: T,
    rolls_from: Option<T>,
    /// Kinetic energy after, and what friction and peeling took, over m, m^2/s^2.
    energies: [T; 3],
}

impl<T: Real> TangentialContact<T> {
    pub(super) fn new<P: SpinDamping<T>>(
        motion: &TangentialMotion<T, P>,
        sphere: &Sphere<T>,
        units: &Scaled<T>,
    ) -> Self {
        let energies = [motion.energy(), motion.friction_loss, motion.peeling_loss];
        Self {
            motion: if motion.slides() { SurfaceMotion::Sliding } else { SurfaceMotion::Rolling },
            velocity: motion.tangential * units.speed,
            spin: motion.peripheral * units.speed / sphere.radius(),
            rotation: motion.rotation * (units.length / sphere.radius()),
            displacement: motion.displacement * units.length,
            rolls_from: motion.rolls_from.map(|time| time * units.time()),
            energies: energies.map(|energy| energy * units.speed * units.speed),
        }
    }

    /// Whether the sphere slides or rolls.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let contact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?.tangential;
    /// assert_eq!(contact.motion(), SurfaceMotion::Sliding);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn motion(&self) -> SurfaceMotion {
        self.motion
    }

    /// Tangential velocity V_t, m/s.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // Sliding throughout, friction turns f times the normal impulse against the motion.
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let contact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?.tangential;
    /// assert!((contact.velocity() - 4.8).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn velocity(&self) -> T {
        self.velocity
    }

    /// Spin W, rad/s.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let contact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?.tangential;
    /// assert!((contact.spin() / 0.5e6 - 1.0).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn spin(&self) -> T {
        self.spin
    }

    /// Angle through which the sphere has turned, rad.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.0)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?.with_peripheral_velocity(2.0)?;
    /// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?;
    /// assert!((impact.tangential.rotation() / (2e6 * impact.outputs.times.contact.unwrap()) - 1.0).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn rotation(&self) -> T {
        self.rotation
    }

    /// Rotation in degrees.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // Table 1: the sphere turns by 0.12 degrees during contact.
    /// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
    /// let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
    /// let contact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &before)?.tangential;
    /// assert!((contact.rotation_degrees() - 0.1234).abs() < 1e-4);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn rotation_degrees(&self) -> T {
        self.rotation * T::constant(180.0 / PI)
    }

    /// Way of the centre along the surface, m.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.0)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?;
    /// assert!((impact.tangential.displacement() / (5.0 * impact.outputs.times.contact.unwrap()) - 1.0).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn displacement(&self) -> T {
        self.displacement
    }

    /// Time at which the slip ended, s; zero if there was none, `None` if it never ended.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let straight = NormalMotion::new(1.0)?.with_tangential(0.0)?;
    /// let contact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &straight)?.tangential;
    /// assert_eq!(contact.rolls_from(), Some(0.0));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn rolls_from(&self) -> Option<T> {
        self.rolls_from
    }
}

impl<T: Real, O> SimulatedImpact<T, TangentialContact<T>, O> {
    /// Outcome and motion along the surface in one word; of a captured sphere, where it first turns back.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{Class, NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let class = |v_n, v_t| Ok(scene.impact(&Collocation::<7, f64>::new(1e-6)?, &NormalMotion::new(v_n)?.with_tangential(v_t)?)?.class());
    /// assert_eq!(class(8.0, 1.0), Ok::<_, microimpact::InputError>(Class::ReboundRolling));
    /// assert_eq!(class(8.0, 90.0), Ok(Class::ReboundSliding));
    /// assert_eq!(class(5.0, 1.0), Ok(Class::CapturedRolling));
    /// assert_eq!(class(5.0, 0.0), Ok(Class::CapturedResting));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn class(&self) -> Class {
        match (self.normal.outcome, self.tangential.motion) {
            (Outcome::Rebound, SurfaceMotion::Sliding) => Class::ReboundSliding,
            (Outcome::Rebound, _) => Class::ReboundRolling,
            (Outcome::Capture, SurfaceMotion::Sliding) => Class::CapturedSliding,
            (Outcome::Capture, _) if self.tangential.velocity == T::ZERO => Class::CapturedResting,
            (Outcome::Capture, _) => Class::CapturedRolling,
        }
    }
}

impl<T: Real> SimulatedImpact<T, TangentialContact<T>> {
    /// Where the kinetic energy went; `None` for a captured sphere, which has not yet come to rest.
    ///
    /// The works of damping are integrals of their own, so what the losses lack in sum shows the error of the run. The
    /// external force is conservative and gives back what it takes.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
    /// let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
    /// let impact = scene.impact(&Collocation::<12, f64>::new(1e-12)?, &before)?;
    /// let ledger = impact.energy(&sphere).unwrap();
    /// assert!((ledger.lost() / (ledger.before - ledger.after) - 1.0).abs() < 1e-12);
    /// assert!((ledger.adhesion - 4.828e-13).abs() < 1e-16); // the paper's work of adhesion
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn energy(&self, sphere: &Sphere<T>) -> Option<EnergyLedger<T>> {
        if self.normal.outcome == Outcome::Capture {
            return None;
        }
        let joules = |energy: T| sphere.mass() * energy;
        let kinetic = |speed: T| T::constant(0.5) * speed * speed;
        let [after, friction, peeling] = self.tangential.energies;
        Some(EnergyLedger {
            before: joules(kinetic(self.normal.approach) + after + friction + peeling),
            after: joules(kinetic(self.normal.rebound_speed()) + after),
            material: self.outputs.works.material,
            adhesion: self.outputs.works.adhesion,
            friction: joules(friction),
            rolling: joules(peeling),
            external: T::ZERO,
        })
    }
}

/// Whether a run came to its end.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation, Status};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?;
/// assert_eq!(impact.run.status, Status::Solved);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// The motion was followed to its end within the tolerance.
    Solved,
    /// The number of stretches was spent; the result is not to be relied on.
    BudgetSpent,
}

impl Status {
    fn of<T>(path: &NormalPath<T>) -> Self {
        if path.end == End::Budget { Self::BudgetSpent } else { Self::Solved }
    }
}

/// What a run took.
///
/// ```
/// use microimpact::simulation::{Collocation, RunReport, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(10.0)?;
/// let run: RunReport<f64> = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?.run;
/// assert!(run.stretches + run.refused <= RunReport::<f64>::MOST_STRETCHES);
/// assert!(run.estimated_error <= 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunReport<T> {
    /// Whether the run came to its end.
    pub status: Status,
    /// Stretches that the motion was divided into.
    pub stretches: u32,
    /// Stretches that were tried and refused.
    pub refused: u32,
    /// Sweeps over the nodes of a stretch, in total.
    pub sweeps: u32,
    /// Largest estimated error of a stretch, over the energy there.
    pub estimated_error: T,
}

impl<T: Real> RunReport<T> {
    /// Stretches after which a run gives up.
    ///
    /// ```
    /// assert!(microimpact::simulation::RunReport::<f32>::MOST_STRETCHES < 1000);
    /// ```
    pub const MOST_STRETCHES: u32 = MOST_STRETCHES;

    pub(super) fn new(path: &NormalPath<T>) -> Self {
        Self {
            status: Status::of(path),
            stretches: path.effort.stretches,
            refused: path.effort.refused,
            sweeps: path.effort.sweeps,
            estimated_error: path.effort.error,
        }
    }
}
