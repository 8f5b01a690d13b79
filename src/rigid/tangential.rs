//! The impact along the surface: friction, spin and rolling dissipation, per unit mass.
//!
//! The friction impulse and the impulse of the resisting moment are proportional to the normal impulse. The algebra of
//! sliding and rolling is that of all models (`rolling`).

use crate::rolling::{Friction, friction_over_limit};
use crate::{
    Approach, ContactClass, Coulomb, ImpactError, InputError, NoFriction, NormalImpact, Oblique, Outcome, Parameter,
    Planar, Real, Sphere, SurfaceMotion,
};

/// What happens along the surface to a sphere that arrives with a motion `M`.
///
/// The crate provides [`NoFriction`], [`Coulomb`] and [`RollingDissipation`].
///
/// ```
/// use microimpact::rigid::TangentialTerm;
/// use microimpact::{ConstantRestitution, NoFriction, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let motion = NormalMotion::new(1.0)?;
/// let normal = RigidBody::new(sphere, ConstantRestitution::new(0.9)?).impact(&motion).normal;
/// assert_eq!(NoFriction.impact(&sphere, &motion, &normal), ());
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait TangentialTerm<T, M> {
    /// Result along the surface.
    type Impact: TangentialOutcome<T>;

    /// Computes the impact along the surface from the impact along the normal.
    fn impact(&self, sphere: &Sphere<T>, motion: &M, normal: &NormalImpact<T>) -> Self::Impact;
}

/// A result along the surface that can be classified.
///
/// ```
/// use microimpact::{Outcome, rigid::TangentialOutcome};
///
/// assert_eq!(TangentialOutcome::<f32>::classify(&(), Outcome::Rebound), ());
/// ```
pub trait TangentialOutcome<T> {
    /// `()` without friction, [`ContactClass`] with it.
    type Class;

    /// How the contact point moves after the impact.
    fn classify(&self, outcome: Outcome) -> Self::Class;
}

impl<T> TangentialOutcome<T> for () {
    type Class = ();

    #[inline]
    fn classify(&self, _outcome: Outcome) {}
}

impl<T: Real, M: Approach<T>> TangentialTerm<T, M> for NoFriction {
    type Impact = ();

    #[inline]
    fn impact(&self, _sphere: &Sphere<T>, _motion: &M, _normal: &NormalImpact<T>) {}
}

impl<T: Real, M: Oblique<T>> TangentialTerm<T, M> for Coulomb<T> {
    type Impact = TangentialImpact<T>;

    #[inline]
    fn impact(&self, sphere: &Sphere<T>, motion: &M, normal: &NormalImpact<T>) -> TangentialImpact<T> {
        let limit = self.coefficient() * normal.impulse();
        let friction = Friction::against(motion.slip(), limit, sphere.contact_inertia());
        TangentialImpact::new(sphere, motion, normal, friction, T::ZERO)
    }
}

/// Coulomb friction with rolling dissipation: a moment impulse mu_m a_c P_n against the spin (A15, A16).
///
/// The moment acts against the spin that the sphere would have at separation without it. It stops at most that spin and, where
/// friction reverses the spin, the mean spin during the impact, so it never adds energy.
///
/// ```
/// use microimpact::rigid::{RollingDissipation, TangentialTerm};
/// use microimpact::{ConstantRestitution, Coulomb, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let motion = NormalMotion::new(1.0)?.with_tangential(0.5)?;
/// let normal = RigidBody::new(sphere, ConstantRestitution::new(0.9)?).impact(&motion).normal;
/// let dissipation = RollingDissipation::new(Coulomb::new(0.5)?, 2e-9, &sphere)?;
/// let impact = dissipation.impact(&sphere, &motion, &normal);
/// assert!((impact.rolling_arm(&sphere) + 2e-9_f64).abs() < 1e-20);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RollingDissipation<T> {
    pub(crate) friction: Coulomb<T>,
    /// mu_m a_c/r.
    pub(crate) ratio: T,
}

impl<T: Real> RollingDissipation<T> {
    /// Creates the dissipation from the `friction` and the `arm` mu_m a_c (m, zero or positive) of a sphere.
    ///
    /// # Errors
    /// The arm is outside its range.
    ///
    /// ```
    /// use microimpact::{Coulomb, Sphere, rigid::RollingDissipation};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert!(RollingDissipation::new(Coulomb::new(0.1)?, -1e-9, &sphere).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(friction: Coulomb<T>, arm: T, sphere: &Sphere<T>) -> Result<Self, InputError> {
        Ok(Self { friction, ratio: Parameter::RollingArm.check(arm)? / sphere.radius() })
    }
}

impl<T: Real, M: Planar<T>> TangentialTerm<T, M> for RollingDissipation<T> {
    type Impact = TangentialImpact<T>;

    #[inline]
    fn impact(&self, sphere: &Sphere<T>, motion: &M, normal: &NormalImpact<T>) -> TangentialImpact<T> {
        let (gyration_ratio, contact_inertia) = (sphere.gyration_ratio(), sphere.contact_inertia());
        let slip = motion.slip();
        let limit = self.friction.coefficient() * normal.impulse();
        // The peripheral velocity at separation without the moment,
        let free = Friction::against(slip, limit, contact_inertia);
        let (_, spinning) = free.velocities(motion, T::ZERO, gyration_ratio);
        let mut most = spinning.abs();
        let before = if spinning > T::ZERO { motion.peripheral() } else { -motion.peripheral() };
        if before < T::ZERO {
            // and, where friction reverses it, twice the mean over the impact in its direction.
            let slides = if free.rolls { free.total / free.sliding } else { T::ONE };
            most = most.min((most * (T::constant(2.0) - slides) + before * slides).max(T::ZERO));
        }
        let size = (self.ratio * normal.impulse()).min(gyration_ratio * most);
        let moment = if spinning > T::ZERO { -size } else { size };
        let friction = Friction::against_moment(slip, limit, moment, gyration_ratio, contact_inertia);
        TangentialImpact::new(sphere, motion, normal, friction, moment)
    }
}

/// The tangential part of an impact with friction.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// // A sphere that arrives without slip keeps its motion.
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?).with_friction(0.5)?;
/// let rolling = NormalMotion::new(1.0)?.with_tangential(2.0)?.with_peripheral_velocity(2.0)?;
/// let after = scene.impact(&rolling).tangential;
/// assert_eq!((after.velocity(), after.peripheral(), after.impulse_ratio()), (2.0, 2.0, 0.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TangentialImpact<T> {
    pub(super) gyration_ratio: T,
    pub(super) contact_inertia: T,
    pub(super) approach: T,
    pub(super) normal_impulse: T,
    pub(super) velocity_before: T,
    pub(super) peripheral_before: T,
    pub(super) slip_before: T,
    pub(super) velocity: T,
    pub(super) peripheral: T,
    pub(super) rolls: bool,
    /// Friction impulse P_t, per unit mass.
    pub(super) friction: T,
    /// Friction impulse if the sphere slides in its first direction throughout.
    pub(super) sliding_friction: T,
    /// Friction impulse if the sphere rolls, or slips back, throughout.
    pub(super) holding_friction: T,
    /// Friction impulse after which the sphere rolls at separation: mu_0 P_n.
    pub(super) rolling_friction: T,
    /// Impulse M of the resisting moment, divided by the radius.
    pub(super) moment: T,
}

impl<T: Real> TangentialImpact<T> {
    #[inline]
    fn new(
        sphere: &Sphere<T>,
        motion: &impl Oblique<T>,
        normal: &NormalImpact<T>,
        friction: Friction<T>,
        moment: T,
    ) -> Self {
        let (velocity, peripheral) = friction.velocities(motion, moment, sphere.gyration_ratio());
        Self {
            gyration_ratio: sphere.gyration_ratio(),
            contact_inertia: sphere.contact_inertia(),
            approach: normal.approach_speed(),
            normal_impulse: normal.impulse(),
            velocity_before: motion.tangential(),
            peripheral_before: motion.peripheral(),
            slip_before: motion.slip(),
            velocity,
            peripheral,
            rolls: friction.rolls,
            friction: friction.total,
            sliding_friction: friction.sliding,
            holding_friction: friction.holding,
            rolling_friction: friction.rolling,
            moment,
        }
    }

    /// The impact with a given impulse ratio.
    pub(super) fn with_ratio(
        sphere: &Sphere<T>,
        motion: &impl Oblique<T>,
        normal: &NormalImpact<T>,
        ratio: T,
    ) -> Result<Self, ImpactError> {
        let impulse = ratio * normal.impulse();
        let rolling = T::ZERO - sphere.contact_inertia() * motion.slip();
        let rounding = T::constant(4.0) * T::EPSILON * rolling.abs();
        let drives = (impulse > T::ZERO && rolling <= T::ZERO) || (impulse < T::ZERO && rolling >= T::ZERO);
        if drives || impulse.abs() > rolling.abs() + rounding {
            return Err(ImpactError::ImpulseRatioOutsideBounds);
        }
        let rolls = impulse.abs() >= rolling.abs() - rounding;
        let total = if rolls { rolling } else { impulse };
        let friction = Friction { total, sliding: total, holding: T::ZERO, rolling, rolls };
        Ok(Self::new(sphere, motion, normal, friction, T::ZERO))
    }

    /// Tangential velocity V_t after the impact (A22), m/s.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // Rolling at separation: V_t = (5 v_t + 2 r w)/7 for a solid sphere.
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.7)?.with_peripheral_velocity(1.4)?;
    /// assert!((scene.impact(&motion).tangential.velocity() - 0.9_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn velocity(&self) -> T {
        self.velocity
    }

    /// Peripheral velocity r W after the impact, m/s.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(1.0)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(7.0)?;
    /// assert!((scene.impact(&motion).tangential.peripheral() - 2.5_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn peripheral(&self) -> T {
        self.peripheral
    }

    /// Spin W after the impact (A23), rad/s.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(0.5, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(7.0)?;
    /// assert!((scene.impact(&motion).tangential.spin(&sphere) - 5.0_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn spin(&self, sphere: &Sphere<T>) -> T {
        self.peripheral / sphere.radius()
    }

    /// Spin w before the impact, rad/s: the given one, or the one that [`infer_assuming_rolling`] found.
    ///
    /// [`infer_assuming_rolling`]: crate::rigid::infer_assuming_rolling
    ///
    /// ```
    /// use microimpact::rigid::{Departure, infer_assuming_rolling};
    /// use microimpact::{NormalMotion, Sphere, SpeedRestitution};
    ///
    /// // Table 1: a sphere that arrives along the normal and leaves with V_t = 0.21 m/s must have been spinning.
    /// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
    /// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?;
    /// let after = Departure { normal: 2.09, tangential: 0.211 };
    /// let impact = infer_assuming_rolling(&sphere, &SpeedRestitution::new(130.0)?, &before, &after)?;
    /// assert!((impact.tangential.spin_before(&sphere) - 1.46e5_f64).abs() < 0.005e5);
    /// # Ok::<(), microimpact::ImpactError>(())
    /// ```
    #[inline]
    pub fn spin_before(&self, sphere: &Sphere<T>) -> T {
        self.peripheral_before / sphere.radius()
    }

    /// Velocity V_ct = V_t - r W of the contact point after the impact (A26), m/s. It is zero if the sphere rolls.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(1.0)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(7.0)?;
    /// assert!((scene.impact(&motion).tangential.slip() - 3.5_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn slip(&self) -> T {
        self.velocity - self.peripheral
    }

    /// Impulse ratio mu = P_t/P_n (A20).
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(1.0)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(7.0)?;
    /// assert_eq!(scene.impact(&motion).tangential.impulse_ratio(), -0.5);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn impulse_ratio(&self) -> T {
        self.friction / self.normal_impulse
    }

    /// Impulse ratio mu_0 at which sliding just stops (A27, eq. 1). With friction alone, mu is between zero and mu_0.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // 2 eta/(7(1 + e)) for a solid sphere.
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.75)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(3.5)?;
    /// assert!((scene.impact(&motion).tangential.rolling_ratio() + 4.0 / 7.0_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn rolling_ratio(&self) -> T {
        self.rolling_friction / self.normal_impulse
    }

    /// Largest impulse ratio that does not create energy, 2 mu_0, for a tangential process of any kind without rolling
    /// dissipation.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.75)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(3.5)?;
    /// assert!((scene.impact(&motion).tangential.energy_bound() + 8.0 / 7.0_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn energy_bound(&self) -> T {
        T::ZERO - T::constant(2.0) * self.contact_inertia * self.slip_before / self.normal_impulse
    }

    /// Ratio eta = (v_t - r w)/v_n of the tangential and the normal velocity of the contact point before the impact (A28).
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(2.0)?.with_tangential(3.0)?.with_peripheral_velocity(-1.0)?;
    /// assert_eq!(scene.impact(&motion).tangential.velocity_ratio(), -2.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn velocity_ratio(&self) -> T {
        T::ZERO - self.slip_before / self.approach
    }

    /// Signed rolling-dissipation arm mu_m a_c, m. It is negative if it resists a positive spin.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.9)?)
    ///     .with_friction(0.5)?
    ///     .with_rolling_dissipation(2e-9)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.5)?;
    /// assert!((scene.impact(&motion).tangential.rolling_arm(&sphere) + 2e-9_f64).abs() < 1e-20);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn rolling_arm(&self, sphere: &Sphere<T>) -> T {
        self.moment / self.normal_impulse * sphere.radius()
    }

    /// Fraction of the normal impulse during which the sphere slides in its first direction.
    pub(super) fn sliding_fraction(&self) -> T {
        let difference = self.sliding_friction - self.holding_friction;
        if difference == T::ZERO {
            return T::ONE;
        }
        ((self.friction - self.holding_friction) / difference).max(T::ZERO).min(T::ONE)
    }
}

impl<T: Real> TangentialOutcome<T> for TangentialImpact<T> {
    type Class = ContactClass<T>;

    #[inline]
    fn classify(&self, outcome: Outcome) -> ContactClass<T> {
        let friction_over_limit = friction_over_limit(self.sliding_friction, self.rolling_friction);
        let motion = if !self.rolls {
            SurfaceMotion::Sliding
        } else if outcome == Outcome::Rebound {
            SurfaceMotion::Rolling
        } else {
            // V_t is computed from the velocities before the impact. If it is within their rounding, it is zero.
            let rounding = T::constant(4.0) * T::EPSILON * (self.velocity_before.abs() + self.peripheral_before.abs());
            if self.velocity.abs() <= rounding { SurfaceMotion::Resting } else { SurfaceMotion::Rolling }
        };
        ContactClass { motion, friction_over_limit }
    }
}
