//! Coulomb's friction: sliding, then rolling. Without a peeling moment the velocities after the impact follow from the impulse
//! of the elastic force alone.

use super::{PressingForce, SlipStart, Surface};
use crate::contact::law::{ContactLaw, Units};
use crate::contact::solve::integrals::{Integrals, observe_by_integrals};
use crate::contact::solve::interval::Interval;
use crate::contact::solve::nodes::Nodes;
use crate::contact::solve::observer::Observer;
use crate::contact::solve::path::{End, NormalPath};
use crate::contact::solve::quantities::{Quantities, Times};
use crate::rolling::{Friction, friction_over_limit, rolling, rounding};
use crate::{ContactClass, Coulomb, InputError, Oblique, Parameter, Real, Sphere, SurfaceMotion};

/// Velocities before contact and the impulse of the force that presses, from which those after it follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceImpulse<T, P> {
    friction: T,
    pressing: P,
    gyration_ratio: T,
    velocity: T,
    peripheral: T,
    pressed: T,
}

impl<T: Copy, P: Copy> SurfaceImpulse<T, P> {
    /// The same in another number type.
    pub(crate) fn map<U>(&self, of: impl Fn(T) -> U) -> SurfaceImpulse<U, P> {
        SurfaceImpulse {
            friction: of(self.friction),
            pressing: self.pressing,
            gyration_ratio: of(self.gyration_ratio),
            velocity: of(self.velocity),
            peripheral: of(self.peripheral),
            pressed: of(self.pressed),
        }
    }
}

impl<T: Real, P: PressingForce<T>> Quantities<T> for SurfaceImpulse<T, P> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self { pressed: of(self.pressed, other.pressed), ..self }
    }
}

impl<T: Real, P: PressingForce<T>> Integrals<T> for SurfaceImpulse<T, P> {
    #[inline]
    fn growth(&self, law: &impl ContactLaw<T>, s: T, _y: T, _rebound: bool) -> Self {
        Self { pressed: self.pressing.at(law, s), ..*self }
    }

    #[inline]
    fn kink(&self) -> Option<T> {
        self.pressing.kink()
    }
}

// What presses at rest too makes a captured sphere roll in the end, wherever it turns.
observe_by_integrals!(
    [T: Real, P: PressingForce<T>] SurfaceImpulse<T, P>, timed: true, to_turning_point: !P::PRESSES_AT_REST
);

#[diagnostic::do_not_recommend] // so that a message speaks of the motion, not of this bound
impl<T: Real, P: PressingForce<T>, B: Oblique<T>> Surface<T, B> for Coulomb<T, P> {
    type Start = SlipStart<T, P, false>;
    type Observer = SurfaceImpulse<T, P>;
    type After = TangentialVelocities<T>;

    #[inline]
    fn start<L: ContactLaw<T>>(
        &self,
        before: &B,
        sphere: &Sphere<T>,
        law: &L,
        units: &Units<T>,
    ) -> Result<Self::Start, InputError> {
        let friction = self.under(self.pressing.in_units(law));
        let start = SlipStart::new(&friction, before, sphere, units, T::ZERO);
        if T::IS_FIXED_POINT {
            Parameter::VelocityRatio.check(start.velocity)?;
            Parameter::VelocityRatio.check(start.peripheral)?;
        }
        Ok(start)
    }

    #[inline]
    fn observer(start: &Self::Start) -> SurfaceImpulse<T, P> {
        let SlipStart { friction, pressing, gyration_ratio, velocity, peripheral, .. } = *start;
        SurfaceImpulse { friction, pressing, gyration_ratio, velocity, peripheral, pressed: T::ZERO }
    }

    #[inline]
    fn after(
        observer: &SurfaceImpulse<T, P>,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> TangentialVelocities<T> {
        let captured = path.end == End::Capture;
        let SurfaceImpulse { friction, gyration_ratio, velocity: v, peripheral: u, pressed, .. } = *observer;
        let impulses = Friction::against(v - u, friction * pressed, sphere.contact_inertia());
        let ends = impulses.rolls || (captured && friction > T::ZERO && P::PRESSES_AT_REST);
        let (velocity, peripheral) = if ends {
            let rolling = rolling(v, u, gyration_ratio);
            (rolling, rolling)
        } else {
            (v + impulses.total, u - impulses.total / gyration_ratio)
        };
        let rests = captured && velocity.abs() <= rounding(v, u, gyration_ratio);
        TangentialVelocities {
            motion: surface_motion(!ends, rests),
            velocity: velocity * units.speed,
            spin: peripheral * units.speed / sphere.radius(),
            sliding_friction: impulses.sliding,
            rolling_friction: impulses.rolling,
        }
    }
}

impl<T: Real, P: Copy, const PEELS: bool> SlipStart<T, P, PEELS> {
    #[inline]
    pub(super) fn new(
        friction: &Coulomb<T, P>,
        before: &impl Oblique<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
        peeling: T,
    ) -> Self {
        Self {
            friction: friction.coefficient(),
            pressing: friction.pressing,
            gyration_ratio: sphere.gyration_ratio(),
            velocity: before.tangential() / units.speed,
            peripheral: before.peripheral() / units.speed,
            peeling,
        }
    }
}

/// How the contact point moves.
#[inline]
pub(super) fn surface_motion(sliding: bool, resting: bool) -> SurfaceMotion {
    match (sliding, resting) {
        (true, _) => SurfaceMotion::Sliding,
        (false, true) => SurfaceMotion::Resting,
        (false, false) => SurfaceMotion::Rolling,
    }
}

/// Velocities along the surface at separation; of a captured sphere when its slip has ended, as the surface goes on to press
/// on it (but for [`TotalForce`](super::TotalForce)).
///
/// ```
/// use microimpact::contact::{Contact, FixedCost};
/// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
///
/// // Sliding throughout: friction takes f times the normal impulse from the velocity.
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
/// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
/// let after = scene.solve(&motion, &FixedCost::<7>::new(3)?)?.tangential;
/// assert_eq!(after.motion(), SurfaceMotion::Sliding);
/// assert!((after.velocity() - 4.8_f64).abs() < 1e-5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TangentialVelocities<T> {
    pub(super) motion: SurfaceMotion,
    pub(super) velocity: T,
    pub(super) spin: T,
    /// Friction impulse of a sphere that slides throughout, in units of the impact.
    pub(super) sliding_friction: T,
    /// Friction impulse after which it rolls; zero where nothing slips or a peeling moment acts.
    pub(super) rolling_friction: T,
}

impl<T: Real> TangentialVelocities<T> {
    /// Whether the contact point slips, the sphere rolls or, captured, rests.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.7)?;
    /// assert_eq!(scene.solve(&motion, &Adaptive::new(1e-9)?)?.tangential.motion(), SurfaceMotion::Rolling);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn motion(&self) -> SurfaceMotion {
        self.motion
    }

    /// Tangential velocity V_t, m/s.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // Rolling at separation: V_t = 5 v_t/7 for a solid sphere, whatever the law of contact.
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.7)?;
    /// assert!((scene.solve(&motion, &Adaptive::new(1e-9)?)?.tangential.velocity() - 0.5_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn velocity(&self) -> T {
        self.velocity
    }

    /// Spin W, rad/s.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// assert!((scene.solve(&motion, &Adaptive::new(1e-9)?)?.tangential.spin() / 0.5e6 - 1.0_f64).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn spin(&self) -> T {
        self.spin
    }

    /// What friction can change of the slip, over the slip: one or more rolls, less slides. `None` where nothing slips, and
    /// with a peeling moment, which ends a slip as well.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(1.4)?;
    /// let after = scene.solve(&motion, &Adaptive::new(1e-9)?)?.tangential;
    /// assert!(after.friction_over_limit().is_some_and(|margin| (margin - 0.5_f64).abs() < 1e-8));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn friction_over_limit(&self) -> Option<T> {
        friction_over_limit(self.sliding_friction, self.rolling_friction)
    }

    /// The same as a part of a [`Classification`](crate::Classification).
    #[inline]
    pub(crate) fn class(&self) -> ContactClass<T> {
        ContactClass { motion: self.motion, friction_over_limit: self.friction_over_limit() }
    }
}
