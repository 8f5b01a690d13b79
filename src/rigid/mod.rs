//! The rigid-body model (Appendix A): impulses and coefficients instead of forces and time.
//!
//! A scene is a [`RigidBody`]: a sphere, a restitution law and the terms that take part. The model computes in m/s, because
//! an impulse per unit mass is a change of velocity. The mass matters only for a work of adhesion, for an external impulse,
//! and for results in N s or J.

mod adhesion;
mod energy;
mod impulses;
mod inverse;
mod lanes;
mod microforce;
mod normal;
mod restitution;
mod tangential;

pub use adhesion::{
    AdhesionCoefficient, AnyAdhesion, ReboundAdhesion, SpeedAdhesion, WorkOfAdhesion, image_charge_energy,
};
pub use energy::{EnergyLedger, NormalWorks};
pub use impulses::{NormalImpulses, Phases, TangentialImpulses};
pub use inverse::{Departure, infer, infer_assuming_rolling, infer_with_spins};
pub use microforce::{Microforce, MicroforceTerm, NoMicroforce};
pub use normal::NormalImpact;
pub use restitution::{
    AnyRestitution, ConstantRestitution, ElasticPlasticRestitution, PowerRestitution, RestitutionLaw, SpeedRestitution,
    TabulatedRestitution, ViscoelasticRestitution,
};
pub use tangential::{RollingDissipation, TangentialImpact, TangentialOutcome, TangentialTerm};

use crate::{
    Approach, Classification, Coulomb, CriticalSpeed, ImpactError, InputError, NoAdhesion, NoFriction, Oblique,
    Outcome, Parameter, Real, Sphere,
};

/// A rigid-body scene: a sphere and the physics of its impacts.
///
/// The type parameters are the number type `T`, the restitution law `L`, the adhesion `A`, what happens along the surface `S`,
/// and the external microforce `X`. An absent term has size zero and costs nothing.
///
/// ```
/// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// // Table 1 of the paper.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.978)?)
///     .with_adhesion_coefficient(0.237)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.46e5)?;
///
/// let impact = scene.impact(&before);
/// assert!((impact.normal.rebound_speed() - 2.09_f64).abs() < 0.005);
/// assert!((impact.tangential.velocity() - 0.21).abs() < 0.005);
/// assert!((impact.tangential.spin(&sphere) - 4.16e4).abs() < 0.03e4);
/// assert_eq!(scene.classify(&before).class(), Class::ReboundRolling);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        deserialize = "T: Real + serde::Deserialize<'de>, L: serde::Deserialize<'de>, A: serde::Deserialize<'de>, S: serde::Deserialize<'de>, X: serde::Deserialize<'de>"
    ))
)]
pub struct RigidBody<T, L, A = NoAdhesion, S = NoFriction, X = NoMicroforce> {
    pub(crate) sphere: Sphere<T>,
    pub(crate) restitution: L,
    pub(crate) adhesion: A,
    pub(crate) surface: S,
    pub(crate) microforce: X,
}

/// The result of an impact. `G` is `()` without friction and [`TangentialImpact`] with it.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.5)?);
/// let impact = scene.impact(&NormalMotion::new(2.0)?);
/// assert_eq!(impact.normal.rebound_speed(), 1.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Impact<T, G> {
    /// Result along the normal.
    pub normal: NormalImpact<T>,
    /// Result along the surface, `()` without friction.
    pub tangential: G,
}

impl<T: Real, L: RestitutionLaw<T>> RigidBody<T, L> {
    /// Creates a scene from a sphere and a restitution law, without other physics.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6_f32, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// assert_eq!(size_of_val(&scene), size_of::<Sphere<f32>>() + size_of::<f32>());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(sphere: Sphere<T>, restitution: L) -> Self {
        Self { sphere, restitution, adhesion: NoAdhesion, surface: NoFriction, microforce: NoMicroforce }
    }
}

/// A rigid body whose restitution and adhesion are chosen at run time, with Coulomb friction.
///
/// ```
/// use microimpact::rigid::{AnyAdhesion, AnyRigidBody};
/// use microimpact::{ConstantRestitution, RigidBody, Sphere};
///
/// let body: AnyRigidBody<f64> = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?.into())
///     .with_adhesion(AnyAdhesion::None)
///     .with_friction(0.1)?;
/// assert_eq!(body.sphere().radius(), 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub type AnyRigidBody<T> = RigidBody<T, AnyRestitution<T>, AnyAdhesion<T>, Coulomb<T>>;

/// Methods that add a term.
impl<T: Real, L, A, S, X> RigidBody<T, L, A, S, X> {
    /// Adds adhesion of any kind: of this library, one of your own, or [`AnyAdhesion`].
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere, rigid::SpeedAdhesion};
    ///
    /// let body = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?);
    /// let impact = body.with_adhesion(SpeedAdhesion::new(1.0, 1.0)?).impact(&NormalMotion::new(1.0)?);
    /// assert_eq!(impact.normal.overall_restitution(), 0.4);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_adhesion<B>(self, adhesion: B) -> RigidBody<T, L, B, S, X> {
        let Self { sphere, restitution, surface, microforce, .. } = self;
        RigidBody { sphere, restitution, adhesion, surface, microforce }
    }

    /// Adds adhesion with the coefficient rho, 0 to 1.
    ///
    /// # Errors
    /// The coefficient is outside its range.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?)
    ///     .with_adhesion_coefficient(0.25)?;
    /// assert!((scene.impact(&NormalMotion::new(1.0)?).normal.overall_restitution() - 0.6_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_adhesion_coefficient(
        self,
        coefficient: T,
    ) -> Result<RigidBody<T, L, AdhesionCoefficient<T>, S, X>, InputError> {
        Ok(self.with_adhesion(AdhesionCoefficient::new(coefficient)?))
    }

    /// Adds adhesion with a coefficient that decreases with speed, rho = l^q/(l^q + v^q), from the `speed` l (m/s) and the `power`
    /// q, 0.01 to 16.
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?)
    ///     .with_adhesion_at_speed(0.5, 2.0)?;
    /// let slow = scene.impact(&NormalMotion::new(0.5)?).normal;
    /// assert!((slow.adhesion_coefficient() - 0.5_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_adhesion_at_speed(
        self,
        speed: T,
        power: T,
    ) -> Result<RigidBody<T, L, SpeedAdhesion<T>, S, X>, InputError> {
        Ok(self.with_adhesion(SpeedAdhesion::new(speed, power)?))
    }

    /// Adds adhesion with the `work` W_A, J (A34).
    ///
    /// # Errors
    /// The work is outside its range.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, CriticalSpeed, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let energy_at_2_m_s = sphere.mass() * 2.0 * 2.0 / 2.0;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_work_of_adhesion(energy_at_2_m_s)?;
    /// assert_eq!(scene.critical_speed(), CriticalSpeed::At(2.0));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_work_of_adhesion(self, work: T) -> Result<RigidBody<T, L, WorkOfAdhesion<T>, S, X>, InputError> {
        let adhesion = WorkOfAdhesion::new(work, &self.sphere)?;
        Ok(self.with_adhesion(adhesion))
    }

    /// Adds an external microforce with these impulses during approach and rebound, in N s, positive out of the surface.
    ///
    /// # Errors
    /// An impulse is outside its range.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-3, 1000.0)?;
    /// let pull = -0.1 * sphere.mass();
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_external_impulses(0.0, pull)?;
    /// let impact = scene.impact(&NormalMotion::new(1.0)?);
    /// assert!((impact.normal.rebound_speed() - 0.9_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_external_impulses(
        self,
        approach: T,
        rebound: T,
    ) -> Result<RigidBody<T, L, A, S, Microforce<T>>, InputError> {
        let Self { sphere, restitution, adhesion, surface, .. } = self;
        let microforce = Microforce::from_impulses(approach, rebound, &sphere)?;
        Ok(RigidBody { sphere, restitution, adhesion, surface, microforce })
    }

    /// Adds a constant external `force` (N, positive out of the surface) that acts for the `duration` (s) of the contact.
    ///
    /// Approach and rebound take half of the duration each.
    ///
    /// # Errors
    /// The force or the duration is outside its range.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-3, 1000.0)?;
    /// let weight = -9.81 * sphere.mass();
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_external_force(weight, 1e-4)?;
    /// let impact = scene.impact(&NormalMotion::new(1.0)?);
    /// assert!((impact.normal.rebound_speed() - 1.0_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_external_force(
        self,
        force: T,
        duration: T,
    ) -> Result<RigidBody<T, L, A, S, Microforce<T>>, InputError> {
        let force = Parameter::ExternalForce.check(force)?;
        let impulse = force * Parameter::Duration.check(duration)? / T::constant(2.0);
        self.with_external_impulses(impulse, impulse)
    }

    /// The sphere of this scene.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert_eq!(RigidBody::new(sphere, ConstantRestitution::new(0.9)?).sphere(), &sphere);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn sphere(&self) -> &Sphere<T> {
        &self.sphere
    }
}

impl<T: Real, L, A, X> RigidBody<T, L, A, NoFriction, X> {
    /// Adds Coulomb friction with the `coefficient` f, zero or positive.
    ///
    /// # Errors
    /// The coefficient is outside its range.
    ///
    /// ```
    /// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?).with_friction(0.3)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.5)?;
    /// assert_eq!(scene.classify(&motion).class(), Class::ReboundRolling);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_friction(self, coefficient: T) -> Result<RigidBody<T, L, A, Coulomb<T>, X>, InputError> {
        let Self { sphere, restitution, adhesion, microforce, .. } = self;
        let surface = Coulomb::new(coefficient)?;
        Ok(RigidBody { sphere, restitution, adhesion, surface, microforce })
    }
}

impl<T: Real, L, A, X> RigidBody<T, L, A, Coulomb<T>, X> {
    /// Adds a moment mu_m a_c P_n that resists the spin (A15, A16); the `arm` mu_m a_c (m) is zero or positive.
    ///
    /// # Errors
    /// The arm is outside its range.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?).with_friction(0.3)?;
    /// let resisted = scene.with_rolling_dissipation(2e-8)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.5)?;
    /// let (free, slowed) = (scene.impact(&motion).tangential, resisted.impact(&motion).tangential);
    /// assert!(slowed.velocity() < free.velocity());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn with_rolling_dissipation(self, arm: T) -> Result<RigidBody<T, L, A, RollingDissipation<T>, X>, InputError> {
        let Self { sphere, restitution, adhesion, surface, microforce } = self;
        let surface = RollingDissipation::new(surface, arm, &sphere)?;
        Ok(RigidBody { sphere, restitution, adhesion, surface, microforce })
    }
}

/// Methods that compute an impact.
impl<T, L, A, S, X> RigidBody<T, L, A, S, X>
where
    T: Real,
    L: RestitutionLaw<T>,
    A: ReboundAdhesion<T>,
    X: MicroforceTerm<T>,
{
    /// Computes the impact of a sphere that arrives with `motion`.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?).with_friction(0.1)?;
    /// let impact = scene.impact(&NormalMotion::new(1.0)?.with_tangential(5.0)?);
    /// assert!((impact.tangential.velocity() - 4.82_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn impact<M>(&self, motion: &M) -> Impact<T, S::Impact>
    where
        M: Approach<T>,
        S: TangentialTerm<T, M>,
    {
        const { assert!(!(M::OF_TWO_BODIES && X::ACTS), "external impulses act on one body, and two meet") };
        let normal = NormalImpact::of(&self.restitution, &self.adhesion, &self.microforce, &motion.normal());
        let tangential = self.surface.impact(&self.sphere, motion, &normal);
        Impact { normal, tangential }
    }

    /// Classifies the impact of a sphere that arrives with `motion`, with the margins to the other classes.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, Outcome, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?)
    ///     .with_work_of_adhesion(1e-14)?;
    /// let slow = scene.classify(&NormalMotion::new(1.0)?);
    /// assert_eq!(slow.outcome, Outcome::Capture);
    /// assert!(slow.speed_over_critical.is_some_and(|margin: f64| margin < 0.5));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn classify<M>(&self, motion: &M) -> Classification<T, <S::Impact as TangentialOutcome<T>>::Class>
    where
        M: Approach<T>,
        S: TangentialTerm<T, M>,
    {
        self.classify_impact(&self.impact(motion))
    }

    /// Classifies an impact that this scene computed, or that was measured.
    ///
    /// ```
    /// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let motion = NormalMotion::new(1.0)?.with_tangential(1.0)?;
    /// let impact = scene.impact_with_ratio(&motion, -0.1)?;
    /// assert_eq!(scene.classify_impact(&impact).class(), Class::ReboundSliding);
    /// # Ok::<(), microimpact::ImpactError>(())
    /// ```
    #[inline]
    pub fn classify_impact<G: TangentialOutcome<T>>(&self, impact: &Impact<T, G>) -> Classification<T, G::Class> {
        let outcome = if impact.normal.is_capture() { Outcome::Capture } else { Outcome::Rebound };
        let speed_over_critical = match self.critical_speed() {
            CriticalSpeed::At(critical) => Some(impact.normal.approach_speed().saturating_div(critical)),
            CriticalSpeed::AlwaysRebounds | CriticalSpeed::NeverRebounds => None,
        };
        Classification { outcome, speed_over_critical, contact: impact.tangential.classify(outcome) }
    }

    /// Critical speed: the approach speed that separates capture from rebound.
    ///
    /// For a work of adhesion, it is the speed at which e^2 = R^2 - B (A34) is zero.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, CriticalSpeed, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5)?).with_work_of_adhesion(sphere.mass() / 2.0)?;
    /// assert_eq!(scene.critical_speed(), CriticalSpeed::At(2.0));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn critical_speed(&self) -> CriticalSpeed<T> {
        let Some(pull) = self.microforce.pull() else {
            return CriticalSpeed::AlwaysRebounds;
        };
        let body_approach = self.adhesion.holding_speed(&self.restitution, pull);
        match body_approach.map(|speed| self.microforce.approach_speed(speed)) {
            Some(speed) if speed > T::ZERO => CriticalSpeed::At(speed),
            Some(_) => CriticalSpeed::AlwaysRebounds,
            None => CriticalSpeed::NeverRebounds,
        }
    }
}

impl<T, L, A, X> RigidBody<T, L, A, NoFriction, X>
where
    T: Real,
    L: RestitutionLaw<T>,
    A: ReboundAdhesion<T>,
    X: MicroforceTerm<T>,
{
    /// Computes an impact with a known impulse `ratio` mu = P_t/P_n, for a tangential process of any kind.
    ///
    /// # Errors
    /// The ratio is outside its range, or outside its bounds for this impact, 0 to mu_0 (A27).
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, ImpactError, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(1.0)?);
    /// let motion = NormalMotion::new(1.0)?.with_tangential(-0.7)?;
    /// let impact = scene.impact_with_ratio(&motion, 0.05)?;
    /// assert!((impact.tangential.velocity() + 0.6_f64).abs() < 1e-12);
    /// assert_eq!(scene.impact_with_ratio(&motion, 0.11), Err(ImpactError::ImpulseRatioOutsideBounds));
    /// # Ok::<(), ImpactError>(())
    /// ```
    pub fn impact_with_ratio<M: Oblique<T>>(
        &self,
        motion: &M,
        ratio: T,
    ) -> Result<Impact<T, TangentialImpact<T>>, ImpactError> {
        let ratio = Parameter::ImpulseRatio.check(ratio)?;
        let normal = NormalImpact::of(&self.restitution, &self.adhesion, &self.microforce, &motion.normal());
        let tangential = TangentialImpact::with_ratio(&self.sphere, motion, &normal, ratio)?;
        Ok(Impact { normal, tangential })
    }
}
