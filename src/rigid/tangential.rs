//! The impact along the surface: friction, spin and rolling dissipation, per unit mass.
//!
//! The state is the tangential velocity v_t and the peripheral velocity u = r w. A friction impulse p (over m)
//! and an angular impulse j (moment over m r) change them to v_t + p and u + (j - p)/kappa, hence the slip
//! v_t - u by p (1 + 1/kappa) - j/kappa. Both impulses grow in proportion to the normal impulse.

use crate::{
    Approach, ContactClass, Coulomb, ImpactError, InputError, NoFriction, NormalImpact, Oblique, Outcome, Parameter,
    Real, Sphere, SurfaceMotion,
};

/// The tangential side of a scene, for motions `M` and rolling dissipation `D`.
///
/// ```
/// use microimpact::rigid::{NoRollingDissipation, TangentialTerm};
/// use microimpact::{ConstantRestitution, NoFriction, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let motion = NormalMotion::new(1.0)?;
/// let normal = RigidBody::new(sphere, ConstantRestitution::new(0.9)?).impact(&motion).normal;
/// assert_eq!(NoFriction.impact(&sphere, &motion, &normal, &NoRollingDissipation), ());
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait TangentialTerm<T, M, D> {
    /// What comes out.
    type Impact: TangentialOutcome<T>;

    /// The tangential impact that goes with a normal one.
    fn impact(&self, sphere: &Sphere<T>, motion: &M, normal: &NormalImpact<T>, rolling: &D) -> Self::Impact;
}

/// A tangential result that can be classified.
///
/// ```
/// use microimpact::{Outcome, rigid::TangentialOutcome};
///
/// assert_eq!(TangentialOutcome::<f32>::classify(&(), Outcome::Rebound), ());
/// ```
pub trait TangentialOutcome<T> {
    /// `()` or [`ContactClass`].
    type Class;

    /// How the contact point moves after the impact.
    fn classify(&self, outcome: Outcome) -> Self::Class;
}

impl<T> TangentialOutcome<T> for () {
    type Class = ();

    #[inline]
    fn classify(&self, _outcome: Outcome) {}
}

impl<T: Real, M: Approach<T>, D> TangentialTerm<T, M, D> for NoFriction {
    type Impact = ();

    #[inline]
    fn impact(&self, _sphere: &Sphere<T>, _motion: &M, _normal: &NormalImpact<T>, _rolling: &D) {}
}

/// A moment at the contact that resists the spin, growing with the normal impulse.
///
/// ```
/// use microimpact::rigid::{NoRollingDissipation, RollingTerm};
///
/// assert!(!<NoRollingDissipation as RollingTerm<f32>>::PRESENT);
/// ```
pub trait RollingTerm<T> {
    /// Whether there is such a moment at all.
    const PRESENT: bool;

    /// Size of its impulse over m r, for a normal impulse over m.
    fn angular_impulse(&self, normal_impulse: T) -> T;
}

/// No rolling dissipation.
///
/// ```
/// assert_eq!(size_of::<microimpact::rigid::NoRollingDissipation>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoRollingDissipation;

impl<T: Real> RollingTerm<T> for NoRollingDissipation {
    const PRESENT: bool = false;

    #[inline]
    fn angular_impulse(&self, _normal_impulse: T) -> T {
        T::ZERO
    }
}

/// Rolling dissipation: a moment impulse mu_m a_c P_n against the spin (A15, A16).
///
/// It acts against the spin that the sphere would leave with, and at most stops it, so it never adds energy.
///
/// ```
/// use microimpact::{Sphere, rigid::{RollingDissipation, RollingTerm}};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// assert_eq!(RollingDissipation::new(0.5e-6, &sphere)?.angular_impulse(3.0), 1.5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RollingDissipation<T> {
    /// mu_m a_c/r.
    ratio: T,
}

impl<T: Real> RollingDissipation<T> {
    /// Dissipation with a given `arm` mu_m a_c >= 0 (m) on a given sphere.
    ///
    /// # Errors
    /// An arm outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, rigid::RollingDissipation};
    ///
    /// assert!(RollingDissipation::new(-1e-9, &Sphere::solid(1e-6, 1000.0)?).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(arm: T, sphere: &Sphere<T>) -> Result<Self, InputError> {
        Ok(Self { ratio: Parameter::RollingArm.check(arm)? / sphere.radius() })
    }
}

impl<T: Real> RollingTerm<T> for RollingDissipation<T> {
    const PRESENT: bool = true;

    #[inline]
    fn angular_impulse(&self, normal_impulse: T) -> T {
        self.ratio * normal_impulse
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
/// assert_eq!((after.tangential(), after.peripheral(), after.impulse_ratio()), (2.0, 2.0, 0.0));
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
    pub(super) tangential_before: T,
    pub(super) peripheral_before: T,
    pub(super) slip_before: T,
    pub(super) tangential: T,
    pub(super) peripheral: T,
    pub(super) rolls: bool,
    /// Friction impulse P_t.
    pub(super) friction: T,
    /// Friction impulse of an impact that slides throughout.
    pub(super) sliding_friction: T,
    /// Friction impulse of an impact that rolls, or slips back, throughout.
    pub(super) holding_friction: T,
    /// Friction impulse after which the sphere rolls at separation: mu_0 P_n.
    pub(super) rolling_friction: T,
    /// Angular impulse M over r.
    pub(super) couple: T,
}

/// Friction impulses of one impact, over m.
struct Friction<T> {
    total: T,
    sliding: T,
    holding: T,
    rolling: T,
    rolls: bool,
}

impl<T: Real> Friction<T> {
    /// Coulomb friction of at most `limit` = f P_n against a slip that nothing else changes: mu = min(f, |mu_0|).
    #[inline]
    fn against(slip: T, limit: T, contact_inertia: T) -> Self {
        let rolling = T::ZERO - contact_inertia * slip;
        let sliding = if slip < T::ZERO { limit } else { -limit };
        let rolls = rolling.abs() <= limit;
        Self { total: if rolls { rolling } else { sliding }, sliding, holding: T::ZERO, rolling, rolls }
    }

    /// The same where an angular impulse `couple` changes the slip as well.
    #[inline]
    fn against_driven(slip: T, limit: T, couple: T, gyration_ratio: T, contact_inertia: T) -> Self {
        let drive = couple / gyration_ratio;
        let rolling = contact_inertia * (drive - slip);
        // The slip that is there or, without any, the one that the couple starts.
        let positive = slip > T::ZERO || (slip == T::ZERO && drive < T::ZERO);
        let sliding = if positive { -limit } else { limit };
        let slip_after = slip + sliding / contact_inertia - drive;
        if slip_after != T::ZERO && (slip_after > T::ZERO) == positive {
            return Self { total: sliding, sliding, holding: T::ZERO, rolling, rolls: false };
        }
        let holding = contact_inertia * drive;
        if holding.abs() <= limit {
            return Self { total: rolling, sliding, holding, rolling, rolls: true };
        }
        // Friction cannot hold the couple: once the first slip has ended, the sphere slips the other way.
        let slipping_back = if couple < T::ZERO { -limit } else { limit };
        let share = if slip == slip_after { T::ZERO } else { slip / (slip - slip_after) };
        let total = sliding * share + slipping_back * (T::ONE - share);
        Self { total, sliding, holding: slipping_back, rolling, rolls: false }
    }
}

impl<T: Real, M: Oblique<T>, D: RollingTerm<T>> TangentialTerm<T, M, D> for Coulomb<T> {
    type Impact = TangentialImpact<T>;

    #[inline]
    fn impact(&self, sphere: &Sphere<T>, motion: &M, normal: &NormalImpact<T>, rolling: &D) -> TangentialImpact<T> {
        let (gyration_ratio, contact_inertia) = (sphere.gyration_ratio(), sphere.contact_inertia());
        let slip = motion.slip();
        let limit = self.coefficient() * normal.impulse();
        let friction = Friction::against(slip, limit, contact_inertia);
        if !D::PRESENT {
            return TangentialImpact::new(sphere, motion, normal, friction, T::ZERO);
        }
        let free = if friction.rolls {
            motion.tangential() + friction.total
        } else {
            motion.peripheral() - friction.total / gyration_ratio
        };
        let couple = rolling.angular_impulse(normal.impulse()).min(gyration_ratio * free.abs());
        let couple = if free > T::ZERO { -couple } else { couple };
        let friction = Friction::against_driven(slip, limit, couple, gyration_ratio, contact_inertia);
        TangentialImpact::new(sphere, motion, normal, friction, couple)
    }
}

impl<T: Real> TangentialImpact<T> {
    #[inline]
    fn new(
        sphere: &Sphere<T>,
        motion: &impl Oblique<T>,
        normal: &NormalImpact<T>,
        friction: Friction<T>,
        couple: T,
    ) -> Self {
        let tangential = motion.tangential() + friction.total;
        let peripheral = if friction.rolls {
            tangential
        } else {
            motion.peripheral() + (couple - friction.total) / sphere.gyration_ratio()
        };
        Self {
            gyration_ratio: sphere.gyration_ratio(),
            contact_inertia: sphere.contact_inertia(),
            approach: normal.approach_speed(),
            normal_impulse: normal.impulse(),
            tangential_before: motion.tangential(),
            peripheral_before: motion.peripheral(),
            slip_before: motion.slip(),
            tangential,
            peripheral,
            rolls: friction.rolls,
            friction: friction.total,
            sliding_friction: friction.sliding,
            holding_friction: friction.holding,
            rolling_friction: friction.rolling,
            couple,
        }
    }

    /// The impact with a given impulse ratio, within its bounds.
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
    /// assert!((scene.impact(&motion).tangential.tangential() - 0.9_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn tangential(&self) -> T {
        self.tangential
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

    /// Spin w before the impact, rad/s: as given, or as implied by a measurement that assumes rolling.
    ///
    /// ```
    /// use microimpact::rigid::{Departure, infer_assuming_rolling};
    /// use microimpact::{NormalMotion, Sphere, SpeedRestitution};
    ///
    /// // Table 1: a sphere that arrives straight and leaves with V_t = 0.21 m/s must have been spinning.
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

    /// Velocity of the contact point V_ct = V_t - r W after the impact (A26), m/s; zero when rolling.
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
        self.tangential - self.peripheral
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

    /// Impulse ratio mu_0 at which sliding just stops (A27, eq. 1). Friction alone gives a ratio from zero to mu_0.
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

    /// Impulse ratio 2 mu_0 up to which a tangential process of any kind does not create energy; without
    /// rolling dissipation.
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

    /// Ratio eta = (v_t - r w)/v_n of the velocities of the contact point before the impact (A28).
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

    /// Signed rolling-dissipation arm mu_m a_c, m: negative where it resists a positive spin.
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
        self.couple / self.normal_impulse * sphere.radius()
    }

    /// The share of the normal impulse during which the sphere slides in its first direction.
    pub(super) fn sliding_share(&self) -> T {
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
        let limit = self.rolling_friction.abs();
        let friction_over_limit = (limit > T::ZERO).then(|| self.sliding_friction.abs().saturating_div(limit));
        let motion = if !self.rolls {
            SurfaceMotion::Sliding
        } else if outcome == Outcome::Rebound {
            SurfaceMotion::Rolling
        } else {
            // V_t is a difference of velocities of the size before the impact: below their rounding it is zero.
            let rounding =
                T::constant(4.0) * T::EPSILON * (self.tangential_before.abs() + self.peripheral_before.abs());
            if self.tangential.abs() <= rounding { SurfaceMotion::Resting } else { SurfaceMotion::Rolling }
        };
        ContactClass { motion, friction_over_limit }
    }
}
