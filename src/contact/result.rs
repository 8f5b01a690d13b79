//! Results of a simulation, in SI units.

use core::f64::consts::PI;

use super::SimulatedImpact;
use super::dimensionless::DimensionlessContact;
use super::motion::{End, NormalPath};
use super::run::Status;
use super::scaled::Scaled;
use super::tangential::{NoPeeling, SpinDamping, SurfaceImpulse, SurfaceResult, TangentialMotion};
use crate::rigid::EnergyLedger;
use crate::{Class, ContactClass, Outcome, Real, Sphere, Stiffness, SurfaceMotion};

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
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalContact<T> {
    status: Status,
    outcome: Option<Outcome>,
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
        let contact = DimensionlessContact::new(path, units.energy);
        let indentation = |s: T| (s > T::ZERO).then(|| units.length * s * s);
        Self {
            status: contact.status,
            outcome: contact.outcome,
            approach,
            restitution_squared: contact.restitution_squared,
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

    /// Rebound or capture; `None` where the method has not come to a solution.
    ///
    /// ```
    /// use microimpact::simulation::{Collocation, Simulation};
    /// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
    ///
    /// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// assert_eq!(scene.normal_impact(&method, &NormalMotion::new(1.0)?)?.outcome(), Some(Outcome::Rebound));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn outcome(&self) -> Option<Outcome> {
        self.outcome
    }

    /// Overall restitution e; zero for a capture and where there is no solution.
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

    /// Rebound speed V_n, m/s; zero for a capture and where there is no solution.
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
/// assert!((contact.tangential() - 0.5).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TangentialContact<T> {
    motion: SurfaceMotion,
    /// Whether nothing moves any more.
    resting: bool,
    tangential: T,
    spin: T,
    rotation: T,
    displacement: T,
    rolls_from: Option<T>,
    /// Kinetic energy after, and what friction and peeling took, over m, m^2/s^2.
    energies: [T; 3],
}

impl<T: Real, P: SpinDamping<T>> SurfaceResult<T, TangentialContact<T>> for P {
    type Observer = TangentialMotion<T, P>;

    fn result(
        motion: &Self::Observer,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Scaled<T>,
    ) -> TangentialContact<T> {
        let energies = [motion.energy(), motion.friction_loss, motion.peeling_loss];
        TangentialContact {
            motion: surface_motion(motion.slides(), false),
            resting: path.end == End::Capture && motion.rests(),
            tangential: motion.tangential * units.speed,
            spin: motion.peripheral * units.speed / sphere.radius(),
            rotation: motion.rotation * (units.length / sphere.radius()),
            displacement: motion.displacement * units.length,
            rolls_from: motion.rolls_from.map(|time| time * units.time()),
            energies: energies.map(|energy| energy * units.speed * units.speed),
        }
    }
}

impl<T: Real> TangentialContact<T> {
    /// Whether the contact point slips or the sphere rolls, if only with no speed at all.
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
    /// assert!((contact.tangential() - 4.8).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn tangential(&self) -> T {
        self.tangential
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

/// Velocities along the surface at separation, where no more is asked for; of a captured sphere when its slip has ended,
/// as the surface goes on to press on it.
///
/// ```
/// use microimpact::simulation::{FixedCost, SimulatedImpact, Simulation, TangentialVelocities};
/// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
///
/// // Sliding throughout: friction turns f times the normal impulse against the motion.
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
/// let method = FixedCost::<7>::new(3)?.with_outputs::<10>();
/// let impact: SimulatedImpact<_, TangentialVelocities<f64>, ()> =
///     scene.observe(&method, &NormalMotion::new(1.0)?.with_tangential(5.0)?)?;
/// assert_eq!(impact.tangential.motion, SurfaceMotion::Sliding);
/// assert!((impact.tangential.tangential - 4.8).abs() < 1e-5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TangentialVelocities<T> {
    /// Whether the sphere slides, rolls or, captured, rests.
    pub motion: SurfaceMotion,
    /// Tangential velocity V_t, m/s.
    pub tangential: T,
    /// Spin W, rad/s.
    pub spin: T,
}

impl<T: Real> SurfaceResult<T, TangentialVelocities<T>> for NoPeeling {
    type Observer = SurfaceImpulse<T>;

    fn result(
        motion: &Self::Observer,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Scaled<T>,
    ) -> TangentialVelocities<T> {
        let captured = path.end == End::Capture;
        let (sliding, [tangential, peripheral]) = motion.after(captured);
        TangentialVelocities {
            motion: surface_motion(sliding, captured && motion.rests()),
            tangential: tangential * units.speed,
            spin: peripheral * units.speed / sphere.radius(),
        }
    }
}

impl<T: Real> SurfaceResult<T, ContactClass<T>> for NoPeeling {
    type Observer = SurfaceImpulse<T>;

    fn result(motion: &Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> ContactClass<T> {
        let after: TangentialVelocities<T> = Self::result(motion, path, sphere, units);
        ContactClass { motion: after.motion, friction_over_limit: motion.friction_over_limit() }
    }
}

/// How the contact point moves.
fn surface_motion(sliding: bool, resting: bool) -> SurfaceMotion {
    match (sliding, resting) {
        (true, _) => SurfaceMotion::Sliding,
        (false, true) => SurfaceMotion::Resting,
        (false, false) => SurfaceMotion::Rolling,
    }
}

/// The result of a tangential side: how the contact point moves.
///
/// ```
/// use microimpact::simulation::{SurfaceState, TangentialVelocities};
/// use microimpact::SurfaceMotion;
///
/// let slow = TangentialVelocities { motion: SurfaceMotion::Rolling, tangential: 1e-3, spin: 1e3 };
/// assert_eq!(SurfaceState::surface_motion(&slow), SurfaceMotion::Rolling);
/// ```
pub trait SurfaceState {
    /// Sliding, rolling or resting.
    fn surface_motion(&self) -> SurfaceMotion;
}

impl<T> SurfaceState for TangentialContact<T> {
    fn surface_motion(&self) -> SurfaceMotion {
        if self.resting { SurfaceMotion::Resting } else { self.motion }
    }
}

impl<T> SurfaceState for TangentialVelocities<T> {
    fn surface_motion(&self) -> SurfaceMotion {
        self.motion
    }
}

impl<T: Real, G: SurfaceState, O> SimulatedImpact<T, G, O> {
    /// Outcome and motion along the surface in one word; `None` where the method has not come to a solution.
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
    /// assert_eq!(class(8.0, 1.0), Ok::<_, microimpact::InputError>(Some(Class::ReboundRolling)));
    /// assert_eq!(class(8.0, 90.0), Ok(Some(Class::ReboundSliding)));
    /// assert_eq!(class(5.0, 1.0), Ok(Some(Class::CapturedRolling)));
    /// assert_eq!(class(5.0, 0.0), Ok(Some(Class::CapturedResting)));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn class(&self) -> Option<Class> {
        self.normal.outcome.map(|outcome| Class::of(outcome, self.tangential.surface_motion()))
    }
}

impl<T: Real> SimulatedImpact<T, TangentialContact<T>> {
    /// Where the kinetic energy went; `None` for a captured sphere, which has not yet come to rest, and where there is no
    /// solution.
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
        if self.normal.outcome != Some(Outcome::Rebound) {
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
