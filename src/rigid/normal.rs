//! The impact along the normal, per unit mass: body, adhesion and microforce.

use crate::rigid::{MicroforceTerm, ReboundAdhesion, RestitutionLaw};
use crate::{Approach, ImpactError, NormalMotion, Parameter, Real};

/// The normal part of an impact.
///
/// All speeds are positive or zero. Per unit mass, they are impulses too.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(5.06e-6, 2600.0)?, ConstantRestitution::new(0.978)?)
///     .with_adhesion_coefficient(0.237)?;
/// let normal = scene.impact(&NormalMotion::new(2.8)?).normal;
/// assert!((normal.overall_restitution() - 0.746_f64).abs() < 0.0005);
/// assert!(!normal.is_capture());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalImpact<T> {
    approach: T,
    restitution: T,
    body_approach: T,
    body_rebound: T,
    departure: T,
    rebound: T,
}

impl<T: Copy> NormalImpact<T> {
    /// The same in another number type.
    #[inline]
    pub(crate) fn map<U>(&self, of: impl Fn(T) -> U) -> NormalImpact<U> {
        NormalImpact {
            approach: of(self.approach),
            restitution: of(self.restitution),
            body_approach: of(self.body_approach),
            body_rebound: of(self.body_rebound),
            departure: of(self.departure),
            rebound: of(self.rebound),
        }
    }
}

impl<T: Real> NormalImpact<T> {
    /// Applies A5, A11, A14 and A8 in this order.
    #[inline]
    pub(crate) fn of(
        law: &impl RestitutionLaw<T>,
        adhesion: &impl ReboundAdhesion<T>,
        microforce: &impl MicroforceTerm<T>,
        motion: &NormalMotion<T>,
    ) -> Self {
        let approach = motion.speed();
        let body_approach = microforce.body_approach(approach);
        let restitution = law.restitution(body_approach);
        let body_rebound = restitution * body_approach;
        let departure = adhesion.departure(body_approach, body_rebound);
        let rebound = microforce.rebound(departure);
        Self { approach, restitution, body_approach, body_rebound, departure, rebound }
    }

    /// Creates the impact from a measured `rebound_speed` (m/s) and a restitution law.
    ///
    /// The difference between R v and the rebound speed is attributed to adhesion: rho = 1 - e/R.
    ///
    /// # Errors
    /// The rebound speed is outside its range or above R v.
    ///
    /// ```
    /// use microimpact::{NormalImpact, NormalMotion, SpeedRestitution};
    ///
    /// let normal = NormalImpact::from_measurement(&SpeedRestitution::new(130.0)?, &NormalMotion::new(2.8)?, 2.09)?;
    /// assert!((normal.adhesion_coefficient() - 0.237_f64).abs() < 0.001);
    /// # Ok::<(), microimpact::ImpactError>(())
    /// ```
    pub fn from_measurement(
        law: &impl RestitutionLaw<T>,
        before: &impl Approach<T>,
        rebound_speed: T,
    ) -> Result<Self, ImpactError> {
        let approach = before.normal().speed();
        let rebound = Parameter::ReboundSpeed.check(rebound_speed)?;
        let restitution = law.restitution(approach);
        let body_rebound = restitution * approach;
        if rebound > body_rebound * (T::ONE + T::constant(4.0) * T::EPSILON) {
            return Err(ImpactError::ReboundExceedsRestitution);
        }
        let rebound = rebound.min(body_rebound);
        Ok(Self { approach, restitution, body_approach: approach, body_rebound, departure: rebound, rebound })
    }

    /// Whether the sphere is captured: e = 0.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?)
    ///     .with_adhesion_coefficient(1.0)?;
    /// assert!(scene.impact(&NormalMotion::new(1.0)?).normal.is_capture());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn is_capture(&self) -> bool {
        self.rebound <= T::ZERO
    }

    /// Approach speed -v_n, m/s.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.8)?);
    /// assert_eq!(scene.impact(&NormalMotion::new(2.5)?).normal.approach_speed(), 2.5);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn approach_speed(&self) -> T {
        self.approach
    }

    /// Rebound speed V_n = -R(1 - rho) v_n (A21), m/s. It is zero for a capture.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.5)?)
    ///     .with_adhesion_coefficient(0.25)?;
    /// assert_eq!(scene.impact(&NormalMotion::new(2.0)?).normal.rebound_speed(), 0.75);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn rebound_speed(&self) -> T {
        self.rebound
    }

    /// Kinetic restitution R of the materials in this impact.
    ///
    /// ```
    /// use microimpact::{NormalMotion, RigidBody, Sphere, SpeedRestitution};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, SpeedRestitution::new(3.0)?);
    /// assert_eq!(scene.impact(&NormalMotion::new(1.0)?).normal.restitution(), 0.75);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn restitution(&self) -> T {
        self.restitution
    }

    /// Overall restitution e = -V_n/v_n. It is R(1 - rho) without a microforce.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.5)?)
    ///     .with_adhesion_coefficient(0.25)?;
    /// assert_eq!(scene.impact(&NormalMotion::new(2.0)?).normal.overall_restitution(), 0.375);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn overall_restitution(&self) -> T {
        self.rebound / self.approach
    }

    /// Adhesion coefficient rho: adhesion impulse divided by body impulse during rebound (A14). It is zero without a body
    /// impulse.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // A work of adhesion of 9/25 of the kinetic energy: rho = 1 - sqrt(1 - B/R^2) = 1/5.
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let work = 0.36 * sphere.mass() / 2.0;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_work_of_adhesion(work)?;
    /// assert!((scene.impact(&NormalMotion::new(1.0)?).normal.adhesion_coefficient() - 0.2_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn adhesion_coefficient(&self) -> T {
        if self.body_rebound > T::ZERO { (self.body_rebound - self.departure) / self.body_rebound } else { T::ZERO }
    }

    /// Energy loss B = R^2 - e^2 to adhesion (A34), divided by the kinetic energy m v_n^2/2.
    ///
    /// For a capture, it is the energy that adhesion has taken, not the energy that it could take.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let work = 0.36 * sphere.mass() / 2.0;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_work_of_adhesion(work)?;
    /// assert!((scene.impact(&NormalMotion::new(1.0)?).normal.adhesion_loss() - 0.36_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn adhesion_loss(&self) -> T {
        let speed = self.approach;
        (self.body_rebound - self.departure) / speed * ((self.body_rebound + self.departure) / speed)
    }

    /// Body impulse of the approach, per unit mass.
    #[inline]
    pub(crate) fn body_approach(&self) -> T {
        self.body_approach
    }

    /// Body impulse of the rebound, per unit mass.
    #[inline]
    pub(crate) fn body_rebound(&self) -> T {
        self.body_rebound
    }

    /// Speed after body and adhesion have acted.
    #[inline]
    pub(crate) fn departure(&self) -> T {
        self.departure
    }

    /// Total normal impulse P_n of the surface and the microforce, per unit mass (A17).
    #[inline]
    pub(crate) fn impulse(&self) -> T {
        self.approach + self.rebound
    }
}
