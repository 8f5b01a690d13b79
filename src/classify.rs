//! Classes of impacts, and the margins between them.

use core::fmt;

/// Outcome of an impact: rebound, capture, or too close to the critical speed to decide.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, Outcome, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
/// assert_eq!(scene.classify(&NormalMotion::new(1.0)?).outcome, Outcome::Rebound);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Outcome {
    /// The sphere leaves the surface.
    Rebound,
    /// The surface holds the sphere.
    Capture,
    /// The remaining energy, or that with which the sphere passes the barrier of an external force, is smaller than its error bound,
    /// so that a simulation knows neither. The rigid-body model always decides.
    Undecided,
}

/// Motion of the contact point when the impact is over.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere, SurfaceMotion};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.0)?).with_friction(0.2)?;
/// let motion_after = |v_t| Ok(scene.classify(&NormalMotion::new(1.0)?.with_tangential(v_t)?).contact.motion);
/// assert_eq!(motion_after(0.0), Ok::<_, microimpact::InputError>(SurfaceMotion::Resting));
/// assert_eq!(motion_after(0.5), Ok(SurfaceMotion::Rolling));
/// assert_eq!(motion_after(5.0), Ok(SurfaceMotion::Sliding));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SurfaceMotion {
    /// The contact point slips over the surface.
    Sliding,
    /// The contact point is at rest, and the sphere turns.
    Rolling,
    /// The sphere is at rest. All kinetic energy is lost.
    Resting,
}

/// The class of an impact with friction.
///
/// ```
/// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?).with_friction(0.1)?;
/// let class = scene.classify(&NormalMotion::new(1.0)?.with_tangential(5.0)?).class();
/// assert_eq!(class, Class::ReboundSliding);
/// assert_eq!(class.to_string(), "rebound sliding");
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Class {
    /// The sphere leaves the surface while its contact point slips.
    ReboundSliding,
    /// The sphere leaves the surface rolling. The slip ended during contact.
    ReboundRolling,
    /// The sphere is captured and slides along the surface.
    CapturedSliding,
    /// The sphere is captured and rolls along the surface.
    CapturedRolling,
    /// The sphere is captured and at rest.
    CapturedResting,
    /// Rebound and capture are too close to each other to decide.
    Undecided,
}

impl Class {
    /// The class of an impact with this outcome, whose contact point moves so.
    ///
    /// ```
    /// use microimpact::{Class, Outcome, SurfaceMotion};
    ///
    /// assert_eq!(Class::of(Outcome::Capture, SurfaceMotion::Rolling), Class::CapturedRolling);
    /// ```
    #[inline]
    pub const fn of(outcome: Outcome, motion: SurfaceMotion) -> Self {
        match (outcome, motion) {
            (Outcome::Rebound, SurfaceMotion::Sliding) => Self::ReboundSliding,
            (Outcome::Rebound, SurfaceMotion::Rolling | SurfaceMotion::Resting) => Self::ReboundRolling,
            (Outcome::Capture, SurfaceMotion::Sliding) => Self::CapturedSliding,
            (Outcome::Capture, SurfaceMotion::Rolling) => Self::CapturedRolling,
            (Outcome::Capture, SurfaceMotion::Resting) => Self::CapturedResting,
            (Outcome::Undecided, _) => Self::Undecided,
        }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::ReboundSliding => "rebound sliding",
            Self::ReboundRolling => "rebound rolling",
            Self::CapturedSliding => "captured sliding",
            Self::CapturedRolling => "captured rolling",
            Self::CapturedResting => "captured resting",
            Self::Undecided => "undecided",
        })
    }
}

/// Critical speed: the approach speed that separates capture from rebound, m/s.
///
/// ```
/// use microimpact::{ConstantRestitution, CriticalSpeed, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
/// assert_eq!(scene.critical_speed(), CriticalSpeed::AlwaysRebounds);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CriticalSpeed<T> {
    /// Spheres of every speed rebound.
    AlwaysRebounds,
    /// Spheres of this speed and of every lower speed are captured.
    At(T),
    /// Spheres of every speed are captured.
    NeverRebounds,
}

/// Class of an impact with its margins. `C` is `()` without friction and [`ContactClass`] with it.
///
/// ```
/// use microimpact::{Class, NormalMotion, RigidBody, Sphere, SpeedRestitution};
///
/// let scene = RigidBody::new(Sphere::solid(4.3e-6, 2600.0)?, SpeedRestitution::new(130.0)?)
///     .with_work_of_adhesion(1e-12)?
///     .with_friction(0.1)?;
/// let classification = scene.classify(&NormalMotion::new(2.8)?.with_tangential(0.2)?);
/// assert_eq!(classification.class(), Class::ReboundRolling);
/// assert!(classification.speed_over_critical.is_some_and(|margin| (margin - 1.82_f64).abs() < 0.01));
/// assert!(classification.contact.friction_over_limit.is_some_and(|margin| margin > 1.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Classification<T, C> {
    /// Rebound or capture.
    pub outcome: Outcome,
    /// Approach speed divided by the critical speed, above one for a rebound. `None` if every speed has the same outcome.
    pub speed_over_critical: Option<T>,
    /// Motion of the contact point; `()` without friction.
    pub contact: C,
}

/// The part of a [`Classification`] that describes the motion along the surface.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.75)?).with_friction(0.1)?;
/// let contact = scene.classify(&NormalMotion::new(1.0)?.with_tangential(1.225)?).contact;
/// assert!(contact.friction_over_limit.is_some_and(|margin| (margin - 0.5_f64).abs() < 1e-12));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactClass<T> {
    /// Sliding, rolling or resting.
    pub motion: SurfaceMotion,
    /// Friction coefficient f divided by |mu_0|: the sphere rolls from one on, and slides below. `None` without slip, where any
    /// friction lets the sphere roll.
    ///
    /// In a measured impact, f is unknown, and |mu| takes its place.
    pub friction_over_limit: Option<T>,
}

impl<T> Classification<T, ContactClass<T>> {
    /// Outcome and motion along the surface, as one class.
    ///
    /// ```
    /// use microimpact::{Class, Classification, ContactClass, Outcome, SurfaceMotion};
    ///
    /// let contact = ContactClass { motion: SurfaceMotion::Rolling, friction_over_limit: Some(2.0) };
    /// let classification = Classification { outcome: Outcome::Capture, speed_over_critical: Some(0.5), contact };
    /// assert_eq!(classification.class(), Class::CapturedRolling);
    /// ```
    #[inline]
    pub fn class(&self) -> Class {
        Class::of(self.outcome, self.contact.motion)
    }
}
