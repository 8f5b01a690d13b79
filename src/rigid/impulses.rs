//! Impulses during approach and rebound, in SI units (A5 to A16).

use crate::{NormalImpact, Real, Sphere, TangentialImpact};

/// A quantity for each phase of an impact: approach, up to the deepest point, and rebound, from there to separation.
///
/// ```
/// use microimpact::rigid::Phases;
///
/// assert_eq!(Phases { approach: 1.0, rebound: 0.5 }.total(), 1.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Phases<T> {
    /// Value for the approach.
    pub approach: T,
    /// Value for the rebound.
    pub rebound: T,
}

impl<T: Real> Phases<T> {
    /// Sum over the whole impact.
    ///
    /// ```
    /// assert_eq!(microimpact::rigid::Phases { approach: 3.0, rebound: -1.0 }.total(), 2.0);
    /// ```
    #[inline]
    pub fn total(&self) -> T {
        self.approach + self.rebound
    }

    #[inline]
    fn times(approach: T, rebound: T, mass: T) -> Self {
        Self { approach: mass * approach, rebound: mass * rebound }
    }
}

/// Normal impulses, N s, positive out of the surface.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.978)?).with_adhesion_coefficient(0.237)?;
/// let impulses = scene.impact(&NormalMotion::new(2.8)?).normal.impulses(&sphere);
/// let body = sphere.mass() * (1.0 + 0.978) * 2.8; // A24
/// let adhesion = -0.237 * 0.978 * sphere.mass() * 2.8; // A25
/// assert!((impulses.body.total() / body - 1.0_f64).abs() < 1e-12);
/// assert!((impulses.adhesion_rebound / adhesion - 1.0).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalImpulses<T> {
    /// Impulse P_D of the body's deformation (A5, A11).
    pub body: Phases<T>,
    /// Impulse P_A of adhesion during rebound; it is zero during approach (A14).
    pub adhesion_rebound: T,
    /// Impulse P_E of the external microforce, for the time that the impact lasts.
    pub external: Phases<T>,
}

/// Friction impulses (N s) and moment impulses (N m s).
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5)?).with_friction(0.1)?;
/// let impulses = scene.impact(&NormalMotion::new(1.0)?.with_tangential(5.0)?).tangential.impulses(&sphere);
/// assert!((impulses.friction.approach / sphere.mass() + 0.1_f64).abs() < 1e-12);
/// assert!((impulses.friction.rebound / sphere.mass() + 0.05).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TangentialImpulses<T> {
    /// Impulse P_t of friction (A6, A9, A12, A13).
    pub friction: Phases<T>,
    /// Impulse M of the moment that resists the spin (A7, A10, A15, A16).
    pub moment: Phases<T>,
}

impl<T: Real> NormalImpact<T> {
    /// Normal impulses on a given `sphere`.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5)?);
    /// let body = scene.impact(&NormalMotion::new(1.0)?).normal.impulses(&sphere).body;
    /// assert_eq!(body.rebound, 0.5 * body.approach);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impulses(&self, sphere: &Sphere<T>) -> NormalImpulses<T> {
        let mass = sphere.mass();
        let (approach, rebound) = (self.approach_speed(), self.rebound_speed());
        NormalImpulses {
            body: Phases::times(self.body_approach(), self.body_rebound(), mass),
            adhesion_rebound: mass * (self.departure() - self.body_rebound()),
            external: Phases::times(approach - self.body_approach(), rebound - self.departure(), mass),
        }
    }
}

impl<T: Real> TangentialImpact<T> {
    /// Impulses along the surface on a given `sphere`. Friction acts until the slip ends, which may be in either phase.
    ///
    /// If the impact was measured or is given by its impulse ratio, the friction coefficient is unknown. Then both phases have
    /// the same impulse ratio.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // Strong friction stops the slip during approach, so that the rebound has no friction impulse.
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5)?).with_friction(1.0)?;
    /// let impulses = scene.impact(&NormalMotion::new(1.0)?.with_tangential(1.0)?).tangential.impulses(&sphere);
    /// assert!((impulses.friction.approach / sphere.mass() + 2.0 / 7.0_f64).abs() < 1e-12);
    /// assert!(impulses.friction.rebound.abs() < 1e-12 * sphere.mass());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn impulses(&self, sphere: &Sphere<T>) -> TangentialImpulses<T> {
        let mass = sphere.mass();
        let phases = self.phases();
        let moment_arm = mass * sphere.radius();
        TangentialImpulses {
            friction: Phases::times(phases.friction.approach, phases.friction.rebound, mass),
            moment: Phases::times(phases.moment.approach, phases.moment.rebound, moment_arm),
        }
    }

    /// Tangential and peripheral velocity at the deepest point, between approach and rebound, m/s.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.5)?).with_friction(0.1)?;
    /// let (tangential, peripheral) =
    ///     scene.impact(&NormalMotion::new(1.0)?.with_tangential(5.0)?).tangential.at_deepest_point();
    /// assert!((tangential - 4.9_f64).abs() < 1e-12);
    /// assert!((peripheral - 0.25).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn at_deepest_point(&self) -> (T, T) {
        let phases = self.phases();
        (
            self.velocity_before + phases.friction.approach,
            self.peripheral_before + (phases.moment.approach - phases.friction.approach) / self.gyration_ratio,
        )
    }

    /// Impulses per unit mass. The moment impulse is divided by the radius.
    fn phases(&self) -> TangentialImpulses<T> {
        let approach_fraction = self.approach / self.normal_impulse;
        let sliding = self.sliding_fraction().min(approach_fraction);
        let friction = self.sliding_friction * sliding + self.holding_friction * (approach_fraction - sliding);
        let moment = self.moment * approach_fraction;
        TangentialImpulses {
            friction: Phases { approach: friction, rebound: self.friction - friction },
            moment: Phases { approach: moment, rebound: self.moment - moment },
        }
    }
}
