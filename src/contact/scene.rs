//! The contact simulation (Appendix B): forces and time during contact, solved to a tolerance.
//!
//! Hertz's force with hysteretic damping, ring adhesion, Coulomb friction with spin, a peeling moment and a constant
//! external force (B6 to B10), each a type that a scene includes or not. The normal motion is solved as kinetic energy
//! against contact radius, where it is smooth from first touch to separation, and all else follows from integrals over it.

mod adaptive;
mod critical;
mod damping;
mod dimensionless;
mod fixed_cost;
mod force;
mod integrals;
mod law;
mod motion;
mod nodes;
mod observer;
mod outcome;
mod outputs;
mod paper;
mod phase;
mod relaxation;
mod rest;
mod ring;
mod run;
mod scaled;
mod stretch;
mod tangential;
mod trajectory;

pub use adaptive::{Adaptive, AdaptiveNodes};
pub use damping::{HystereticDamping, NoDamping};
pub use dimensionless::{DimensionlessContact, DimensionlessImpact};
pub use fixed_cost::FixedCost;
pub use force::{ConstantForce, NoForce};
pub use law::{Attraction, Damping, NormalLaw};
pub use motion::Method;
pub use nodes::{Nodes, PhaseNodes, PhaseSamples, Share};
pub use outcome::{NormalContact, SurfaceState, TangentialContact, TangentialVelocities};
pub use outputs::{ContactImpulses, ContactTimes, ContactWorks, Everything, Output};
pub use paper::RungeKuttaGill;
pub use rest::{MotionToRest, RestCriterion, SettledImpact};
pub use ring::Ring;
pub use run::{RunReport, Status};
pub use scaled::{Groups, Scale};
pub use tangential::{NoPeeling, Peeling, Tangential, TangentialScene};
pub use trajectory::{Sample, Trajectory};

use crate::{
    Approach, Classification, Coulomb, CriticalSpeed, InputError, NoAdhesion, NoFriction, Parameter, Real, Sphere,
    Stiffness,
};
use integrals::Times;
use law::HertzLaw;
use motion::{End, Follower, MOST_STRETCHES, NormalPath, follow};
use observer::Observer;
use scaled::Scaled;
use stretch::Control;

/// The method that solves the normal motion: collocation at `N` nodes, in as many stretches as the tolerance needs.
///
/// Seven nodes suit a tolerance of 1e-6, nine 1e-9, twelve 1e-12; in single precision eight.
///
/// ```
/// use microimpact::simulation::Collocation;
///
/// assert!(Collocation::<9, f64>::new(1e-9).is_ok());
/// assert!(Collocation::<9, f64>::new(0.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Collocation<const N: usize, T> {
    tolerance: T,
}

impl<const N: usize, T: Real> Collocation<N, T> {
    /// A method with a tolerance for e^2; a number type's rounding limits it from below.
    ///
    /// # Errors
    /// A tolerance outside its range.
    ///
    /// ```
    /// assert!(microimpact::simulation::Collocation::<7, f32>::new(1e-6).is_ok());
    /// ```
    pub fn new(tolerance: T) -> Result<Self, InputError> {
        let tolerance = Parameter::Tolerance.check(tolerance)?;
        Ok(Self { tolerance: tolerance.max(T::constant(8.0) * T::EPSILON) })
    }

    /// Stretches after which a run gives up, refused ones included.
    ///
    /// ```
    /// assert!(microimpact::simulation::Collocation::<7, f32>::MOST_STRETCHES < 1000);
    /// ```
    pub const MOST_STRETCHES: u32 = MOST_STRETCHES;

    fn control(&self, timed: bool) -> Control<T> {
        let times = if timed { T::ONE } else { T::constant(0.1) };
        // Changes of one unit in the last place never end.
        let settled = (T::constant(0.1) * self.tolerance).max(T::constant(2.0) * T::EPSILON);
        Control { settled, error: self.tolerance, times }
    }
}

impl<T: Nodes<N>, O: Observer<T>, const N: usize> Method<T, O> for Collocation<N, T> {
    fn solve<L: NormalLaw<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        follow::<T, N, _, _>(law, energy, self.control(O::TIMED), O::TO_TURNING_POINT, observer)
    }
}

/// A sphere, the stiffness of its contact, and the physics of its impacts: `D` damping in the materials, `A` adhesion,
/// `F` friction, `P` peeling moment, `X` external force. A term that is not named has size zero and costs nothing.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Table 1 of the paper. Its program halves the damping of adhesion: 6.25 stands for the printed 12.5.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
/// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &before)?;
/// assert!((impact.normal.overall_restitution() - 0.746193).abs() < 1e-6);
/// assert!((impact.normal.peak_indentation().unwrap() - 4.251e-8).abs() < 1e-11);
/// assert!((impact.tangential.tangential() - 0.2102).abs() < 1e-4);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Simulation<T, D = NoDamping, A = NoAdhesion, F = NoFriction, P = NoPeeling, X = NoForce> {
    sphere: Sphere<T>,
    stiffness: Stiffness<T>,
    damping: D,
    adhesion: A,
    friction: F,
    peeling: P,
    force: X,
}

/// The result of a simulation, with `O` for the outputs asked for and `G` for the tangential side: `()`,
/// [`TangentialContact`] or [`TangentialVelocities`].
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let impact = scene.impact(&Collocation::<7, f64>::new(1e-6)?, &NormalMotion::new(1.0)?)?;
/// assert_eq!(impact.normal.outcome(), Some(Outcome::Rebound));
/// assert!((impact.normal.overall_restitution() - 1.0).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SimulatedImpact<T, G, O = Everything<T>> {
    /// Along the normal.
    pub normal: NormalContact<T>,
    /// Along the surface, where friction takes part.
    pub tangential: G,
    /// What else was asked for.
    pub outputs: O,
    /// What the run took.
    pub run: RunReport<T>,
}

impl<T: Real> Simulation<T> {
    /// A scene of a sphere and the stiffness of its contact, with no other physics.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6_f32, 1000.0)?, Stiffness::new(1e10)?);
    /// assert_eq!(size_of_val(&scene), size_of::<Sphere<f32>>() + size_of::<f32>());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(sphere: Sphere<T>, stiffness: Stiffness<T>) -> Self {
        Self {
            sphere,
            stiffness,
            damping: NoDamping,
            adhesion: NoAdhesion,
            friction: NoFriction,
            peeling: NoPeeling,
            force: NoForce,
        }
    }
}

/// Adding terms.
impl<T: Real, D, A, F, P, X> Simulation<T, D, A, F, P, X> {
    /// The same scene with hysteretic damping of strength zeta_H >= 0 in the materials.
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_damping(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_damping(self, zeta: T) -> Result<Simulation<T, HystereticDamping<T>, A, F, P, X>, InputError> {
        let Self { sphere, stiffness, adhesion, friction, peeling, force, .. } = self;
        let damping = HystereticDamping::new(zeta)?;
        Ok(Simulation { sphere, stiffness, damping, adhesion, friction, peeling, force })
    }

    /// The same scene with Coulomb friction of `coefficient` f >= 0, which goes by the elastic force alone (B8).
    ///
    /// # Errors
    /// A coefficient outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_friction(-0.1).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_friction(self, coefficient: T) -> Result<Simulation<T, D, A, Coulomb<T>, P, X>, InputError> {
        let Self { sphere, stiffness, damping, adhesion, peeling, force, .. } = self;
        let friction = Coulomb::new(coefficient)?;
        Ok(Simulation { sphere, stiffness, damping, adhesion, friction, peeling, force })
    }

    /// The same scene with a constant external force, N, positive out of the surface.
    ///
    /// # Errors
    /// A force outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_external_force(f64::INFINITY).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_external_force(self, force: T) -> Result<Simulation<T, D, A, F, P, ConstantForce<T>>, InputError> {
        let Self { sphere, stiffness, damping, adhesion, friction, peeling, .. } = self;
        let force = ConstantForce::new(force)?;
        Ok(Simulation { sphere, stiffness, damping, adhesion, friction, peeling, force })
    }
}

impl<T: Real, D, F, X> Simulation<T, D, NoAdhesion, F, NoPeeling, X> {
    /// The same scene with a ring force of strength f0 >= 0 (N/m) and its damping zeta_A >= 0 on rebound.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_ring(-1.0, 0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_ring(self, strength: T, zeta: T) -> Result<Simulation<T, D, Ring<T>, F, NoPeeling, X>, InputError> {
        let Self { sphere, stiffness, damping, friction, peeling, force, .. } = self;
        let adhesion = Ring::new(strength, zeta)?;
        Ok(Simulation { sphere, stiffness, damping, adhesion, friction, peeling, force })
    }
}

impl<T: Real, D, X> Simulation<T, D, Ring<T>, Coulomb<T>, NoPeeling, X> {
    /// The same scene with a peeling moment of strength lambda >= 0 (N m), which goes by the damping of the ring (B10).
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?)
    ///     .with_ring(10.0, 1.0)?
    ///     .with_friction(0.1)?;
    /// assert!(scene.with_peeling(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_peeling(self, lambda: T) -> Result<Simulation<T, D, Ring<T>, Coulomb<T>, Peeling<T>, X>, InputError> {
        let Self { sphere, stiffness, damping, adhesion, friction, force, .. } = self;
        let peeling = Peeling::new(lambda)?;
        Ok(Simulation { sphere, stiffness, damping, adhesion, friction, peeling, force })
    }
}

impl<T, D, A, F, P, X> Simulation<T, D, A, F, P, X>
where
    T: Real,
    D: Scale<T, Scaled: Damping<T>>,
    A: Scale<T, Scaled: Attraction<T>>,
    X: Scale<T, Scaled: Attraction<T>>,
{
    /// The impact of a sphere that arrives with `motion`, with everything there is to know of it.
    ///
    /// A captured sphere is followed until it first turns back; [`observe_to_rest`](Self::observe_to_rest) goes on.
    ///
    /// # Errors
    /// A ratio of the scene's forces outside its range, so that the motion cannot be represented.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
    ///
    /// // A sphere of 5 um diameter, as in figure 6, is captured at 5 m/s and rebounds at 8 m/s.
    /// let scene = Simulation::new(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// assert_eq!(scene.impact(&method, &NormalMotion::new(5.0)?)?.normal.outcome(), Some(Outcome::Capture));
    /// assert_eq!(scene.impact(&method, &NormalMotion::new(8.0)?)?.normal.outcome(), Some(Outcome::Rebound));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impact<M, S>(
        &self,
        method: &S,
        motion: &M,
    ) -> Result<SimulatedImpact<T, <F as Tangential<T>>::Contact>, InputError>
    where
        M: Approach<T>,
        F: Tangential<T> + TangentialScene<T, M, A, P, <F as Tangential<T>>::Contact>,
        S: Method<
                T,
                (
                    <Everything<T> as Output<T>>::Observer,
                    <F as TangentialScene<T, M, A, P, <F as Tangential<T>>::Contact>>::Observer,
                ),
            >,
    {
        self.observe(method, motion)
    }

    /// The impact of a sphere that arrives with `motion`, with what the type of the result names: outputs `O`
    /// ([`ContactTimes`], [`ContactImpulses`], [`ContactWorks`], [`Trajectory`], pairs of them, or `()` for none) and a tangential side `G`.
    /// What is not named is not computed.
    ///
    /// # Errors
    /// As [`impact`](Self::impact).
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, ContactTimes, SimulatedImpact, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
    /// let motion = NormalMotion::new(1.0)?;
    /// let method = Collocation::<9, f64>::new(1e-9)?;
    /// let impact: SimulatedImpact<_, (), ContactTimes<f64>> = scene.observe(&method, &motion)?;
    /// assert_eq!(impact.outputs, scene.impact(&method, &motion)?.outputs.times);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn observe<M, S, G, O>(&self, method: &S, motion: &M) -> Result<SimulatedImpact<T, G, O>, InputError>
    where
        M: Approach<T>,
        F: TangentialScene<T, M, A, P, G>,
        O: Output<T>,
        S: Method<T, (O::Observer, F::Observer)>,
    {
        let approach = motion.normal().speed();
        let units = self.units(approach)?;
        let tangential = self.friction.start(&self.sphere, &self.adhesion, &self.peeling, motion, &units)?;
        let mut observer = (O::begin(), tangential);
        let path = method.solve(&self.law(&units)?, units.energy, &mut observer);
        let (observer, tangential) = observer;
        Ok(SimulatedImpact {
            normal: NormalContact::new(&path, approach, &self.sphere, self.stiffness, &units),
            tangential: F::finish(tangential, &path, &self.sphere, &units),
            outputs: O::finish(observer, &path, &self.sphere, &units),
            run: RunReport::new(&path),
        })
    }

    /// The impact of a sphere that arrives with `motion`, with outputs as of [`observe`](Self::observe). A captured sphere
    /// is followed until it rests, as the `criterion` defines it, with all that is observed.
    ///
    /// # Errors
    /// As [`impact`](Self::impact).
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, RestCriterion, SettledImpact, Simulation, TangentialContact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
    ///
    /// let scene = Simulation::new(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let (method, criterion) = (Collocation::<9, f64>::new(1e-9)?, RestCriterion::new(1e-6, 1000)?);
    /// let motion = NormalMotion::new(1.0)?.with_tangential(70.0)?;
    /// // It still slides where it first turns back. At rest along the normal it rolls, with 5/7 of its velocity.
    /// assert_eq!(scene.impact(&method, &motion)?.tangential.motion(), SurfaceMotion::Sliding);
    /// let settled: SettledImpact<_, TangentialContact<f64>> = scene.observe_to_rest(&method, &motion, &criterion)?;
    /// assert_eq!(settled.impact.tangential.motion(), SurfaceMotion::Rolling);
    /// assert!((settled.impact.tangential.tangential() - 50.0).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn observe_to_rest<const N: usize, M, G, O>(
        &self,
        method: &Collocation<N, T>,
        motion: &M,
        criterion: &RestCriterion<T>,
    ) -> Result<SettledImpact<T, G, O>, InputError>
    where
        T: Nodes<N>,
        M: Approach<T>,
        F: TangentialScene<T, M, A, P, G, Observer: Observer<T>>,
        O: Output<T>,
    {
        let approach = motion.normal().speed();
        let units = self.units(approach)?;
        let tangential = self.friction.start(&self.sphere, &self.adhesion, &self.peeling, motion, &units)?;
        let mut observer = (Times::new(), (O::begin(), tangential));
        let law = self.law(&units)?;
        let mut follower = Follower::arriving(&law, units.energy, method.control(true), &mut observer);
        let mut path = follower.contact::<N>(true);
        let settling = (path.end == End::Capture).then(|| follower.settle::<N>(&mut path, criterion));
        let (times, (observer, tangential)) = observer;
        let mut run = RunReport::new(&path);
        if settling.as_ref().is_some_and(|settling| !settling.at_rest) {
            run.status = Status::BudgetSpent;
        }
        let impact = SimulatedImpact {
            normal: NormalContact::new(&path, approach, &self.sphere, self.stiffness, &units),
            tangential: F::finish(tangential, &path, &self.sphere, &units),
            outputs: O::finish(observer, &path, &self.sphere, &units),
            run,
        };
        Ok(SettledImpact { impact, motion: settling.map(|settling| settling.in_units(times.now, &units)) })
    }

    /// The normal motion alone, by any method: how it ends and how fast, without times, impulses, works or anything tangential.
    ///
    /// # Errors
    /// As [`impact`](Self::impact).
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let contact = scene.normal_impact(&Collocation::<7, f64>::new(1e-6)?, &NormalMotion::new(2.8)?)?;
    /// assert!((contact.overall_restitution() - 0.62).abs() < 0.001);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn normal_impact(
        &self,
        method: &impl Method<T, ()>,
        motion: &impl Approach<T>,
    ) -> Result<NormalContact<T>, InputError> {
        let approach = motion.normal().speed();
        let units = self.units(approach)?;
        let path = method.solve(&self.law(&units)?, units.energy, &mut ());
        Ok(NormalContact::new(&path, approach, &self.sphere, self.stiffness, &units))
    }

    /// The class of the impact of a sphere that arrives with `motion`, with its margins as in the rigid-body model: approach
    /// over [`critical_speed`](Self::critical_speed) and, with friction, what it can change of the slip over the slip. `None`
    /// where the method has not come to a solution.
    ///
    /// # Errors
    /// As [`impact`](Self::impact).
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{Class, Classification, ContactClass, NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let motion = NormalMotion::new(8.0)?.with_tangential(1.0)?;
    /// let result: Classification<f64, ContactClass<f64>> = scene.classify(&Collocation::<9, f64>::new(1e-9)?, &motion)?.unwrap();
    /// assert_eq!(result.class(), Class::ReboundRolling);
    /// assert!((result.speed_over_critical.unwrap() - 8.0 / 5.159_566_762).abs() < 1e-8);
    /// assert!(result.contact.friction_over_limit.unwrap() > 1.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn classify<const N: usize, M, C>(
        &self,
        method: &Collocation<N, T>,
        motion: &M,
    ) -> Result<Option<Classification<T, C>>, InputError>
    where
        T: Nodes<N>,
        M: Approach<T>,
        F: TangentialScene<T, M, A, P, C, Observer: Observer<T>>,
    {
        let SimulatedImpact { normal, tangential, .. } = self.observe::<M, _, C, ()>(method, motion)?;
        let speed_over_critical = match self.critical_speed(method)? {
            CriticalSpeed::At(speed) => Some(motion.normal().speed().saturating_div(speed)),
            CriticalSpeed::AlwaysRebounds | CriticalSpeed::NeverRebounds => None,
        };
        let class = |outcome| Classification { outcome, speed_over_critical, contact: tangential };
        Ok(normal.outcome().map(class))
    }

    /// The dimensionless groups of the impact of a sphere that arrives with `motion`; the external force is not among them.
    ///
    /// # Errors
    /// As [`impact`](Self::impact).
    ///
    /// ```
    /// use microimpact::simulation::Simulation;
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert_eq!(scene.groups(&NormalMotion::new(1.0)?)?.adhesion, 0.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn groups(&self, motion: &impl Approach<T>) -> Result<Groups<T>, InputError> {
        let units = self.units(motion.normal().speed())?;
        let material = self.damping.scale(&self.sphere, &units)?.rate();
        let adhesion = self.adhesion.scale(&self.sphere, &units)?.damping_rate();
        Ok(units.groups(material, adhesion))
    }

    /// The sphere of this scene.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, simulation::Simulation};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert_eq!(Simulation::new(sphere, Stiffness::new(1e10)?).sphere(), &sphere);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn sphere(&self) -> &Sphere<T> {
        &self.sphere
    }

    fn units(&self, approach: T) -> Result<Scaled<T>, InputError> {
        Scaled::new(&self.sphere, self.stiffness, self.adhesion.equilibrium(self.stiffness), approach)
    }

    fn law(&self, units: &Scaled<T>) -> Result<HertzLaw<D::Scaled, A::Scaled, X::Scaled>, InputError> {
        Ok(HertzLaw {
            damping: self.damping.scale(&self.sphere, units)?,
            adhesion: self.adhesion.scale(&self.sphere, units)?,
            force: self.force.scale(&self.sphere, units)?,
        })
    }
}
