//! The energy balance of an impact (A29 to A34).

use crate::{Impact, NormalImpact, Real, Sphere, TangentialImpact};

/// Works of the normal impulses (A31), J. A positive work increases the energy of the sphere.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let (r, rho) = (0.9, 0.2);
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(r)?).with_adhesion_coefficient(rho)?;
/// let works = scene.impact(&NormalMotion::new(1.0)?).normal.works(&sphere);
/// let energy = sphere.mass() / 2.0;
/// assert!((works.body_approach / energy + 1.0_f64).abs() < 1e-12);
/// assert!((works.body_rebound / energy - r * r * (1.0 - rho)).abs() < 1e-12);
/// assert!((works.adhesion / energy + r * r * rho * (1.0 - rho)).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalWorks<T> {
    /// Work of the body impulse during approach.
    pub body_approach: T,
    /// Work of the body impulse during rebound.
    pub body_rebound: T,
    /// Work of the adhesion impulse.
    pub adhesion: T,
    /// Work of the external microforce.
    pub external: T,
}

/// Energy balance: kinetic energy before and after an impact, and each loss, J.
///
/// The losses add up to the difference of the energies, except for rounding. Use f64 for slow nanometre spheres: their energy
/// is below 1e-38 J, the smallest normal number of f32.
///
/// ```
/// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// // Table 1: 5.68e-12 J before the impact, 45.1 % of them lost.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.978)?)
///     .with_adhesion_coefficient(0.237)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.46e5)?;
/// let ledger = scene.impact(&before).energy(&sphere);
/// assert!((ledger.before - 5.68e-12_f64).abs() < 0.005e-12);
/// assert!((ledger.lost() / ledger.before - 0.451).abs() < 0.0005);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnergyLedger<T> {
    /// Kinetic energy before the impact, J. Without friction, both energies include the normal motion only.
    pub before: T,
    /// Kinetic energy after the impact, J.
    pub after: T,
    /// Loss in the materials; (1 - R^2) m v_n^2/2 for a rigid body.
    pub material: T,
    /// Loss to adhesion; (R^2 - e^2) m v_n^2/2 for a rigid body (A33).
    pub adhesion: T,
    /// Loss to friction while the contact point slips.
    pub friction: T,
    /// Loss to rolling dissipation, or to the peeling moment of a simulation.
    pub rolling: T,
    /// Loss to the external microforce; negative if it drives the sphere.
    pub external: T,
}

impl<T: Real> EnergyLedger<T> {
    /// Sum T_L of all losses, J.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.6)?);
    /// let ledger = scene.impact(&NormalMotion::new(1.0)?).energy(&sphere);
    /// assert!((ledger.lost() / ledger.before - 0.64_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn lost(&self) -> T {
        self.material + self.adhesion + self.friction + self.rolling + self.external
    }
}

/// Difference of two kinetic energies: half the mass times the difference of the squared velocities.
#[inline]
fn kinetic<T: Real>(mass: T, faster: T, slower: T) -> T {
    mass * (faster - slower) * (faster + slower) / T::constant(2.0)
}

impl<T: Real> NormalImpact<T> {
    /// Works of the normal impulses on a given `sphere`, J.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5)?);
    /// let works = scene.impact(&NormalMotion::new(1.0)?).normal.works(&sphere);
    /// assert_eq!(works.body_rebound, -0.25 * works.body_approach);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn works(&self, sphere: &Sphere<T>) -> NormalWorks<T> {
        let impulses = self.impulses(sphere);
        // All impulses of a phase grow in proportion. So each one works at the mean of the velocities before and after it.
        let approach = -self.approach_speed() / T::constant(2.0);
        let rebound = self.rebound_speed() / T::constant(2.0);
        NormalWorks {
            body_approach: impulses.body.approach * approach,
            body_rebound: impulses.body.rebound * rebound,
            adhesion: impulses.adhesion_rebound * rebound,
            external: impulses.external.approach * approach + impulses.external.rebound * rebound,
        }
    }

    fn ledger(&self, mass: T) -> EnergyLedger<T> {
        EnergyLedger {
            before: kinetic(mass, self.approach_speed(), T::ZERO),
            after: kinetic(mass, self.rebound_speed(), T::ZERO),
            material: kinetic(mass, self.body_approach(), self.body_rebound()),
            adhesion: kinetic(mass, self.body_rebound(), self.departure()),
            friction: T::ZERO,
            rolling: T::ZERO,
            external: kinetic(mass, self.approach_speed(), self.body_approach())
                + kinetic(mass, self.departure(), self.rebound_speed()),
        }
    }
}

impl<T: Real> Impact<T, ()> {
    /// Energy balance of this impact on a given `sphere`, J.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_adhesion_coefficient(1.0)?;
    /// let ledger = scene.impact(&NormalMotion::new(1.0)?).energy(&sphere);
    /// assert_eq!((ledger.after, ledger.material, ledger.adhesion), (0.0, 0.0, ledger.before));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn energy(&self, sphere: &Sphere<T>) -> EnergyLedger<T> {
        self.normal.ledger(sphere.mass())
    }
}

impl<T: Real> Impact<T, TangentialImpact<T>> {
    /// Energy balance of this impact on a given `sphere`, J.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // Friction that stops a slip s takes kappa/(1 + kappa) m s^2/2, whatever its coefficient.
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_friction(1.0)?;
    /// let ledger = scene.impact(&NormalMotion::new(1.0)?.with_tangential(0.5)?).energy(&sphere);
    /// assert!((ledger.friction / (sphere.mass() * 0.125) - 2.0 / 7.0_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn energy(&self, sphere: &Sphere<T>) -> EnergyLedger<T> {
        let mass = sphere.mass();
        let normal = self.normal.ledger(mass);
        let tangential = &self.tangential;
        let (friction, rolling) = tangential.losses();
        let along_surface = |velocity, peripheral| {
            kinetic(mass, velocity, T::ZERO) + sphere.gyration_ratio() * kinetic(mass, peripheral, T::ZERO)
        };
        EnergyLedger {
            before: normal.before + along_surface(tangential.velocity_before, tangential.peripheral_before),
            after: normal.after + along_surface(tangential.velocity, tangential.peripheral),
            friction: mass * friction,
            rolling: mass * rolling,
            ..normal
        }
    }

    /// Energy loss 2 T_L/(m v_n^2), computed from the coefficients (A29).
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.8)?).with_friction(0.2)?;
    /// let impact = scene.impact(&NormalMotion::new(1.0)?.with_tangential(0.5)?);
    /// let ledger = impact.energy(&sphere);
    /// assert!((impact.loss_ratio() * sphere.mass() / 2.0 / ledger.lost() - 1.0_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn loss_ratio(&self) -> T {
        let two = T::constant(2.0);
        let impact = &self.tangential;
        let e = self.normal.overall_restitution();
        let (mu, eta) = (impact.impulse_ratio(), impact.velocity_ratio());
        let arm = impact.moment / impact.normal_impulse;
        let whole = T::ONE + e;
        let rotation = (mu - arm) * whole;
        let normal = (T::ONE - e) * whole;
        let translation = whole * mu * (two * eta - whole * mu);
        let moment = two * arm * whole * (impact.peripheral_before / impact.approach);
        normal + translation - rotation * rotation / impact.gyration_ratio - moment
    }
}

impl<T: Real> TangentialImpact<T> {
    /// Losses to friction and to the resisting moment, per unit mass.
    ///
    /// Friction is constant in each of two intervals. There, the work is the impulse times the mean velocity.
    fn losses(&self) -> (T, T) {
        let two = T::constant(2.0);
        let fraction = self.sliding_fraction();
        let first_friction = self.sliding_friction * fraction;
        let first_moment = self.moment * fraction;
        let turning = self.peripheral_before + (first_moment - first_friction) / self.gyration_ratio;
        let slipping = self.velocity_before + first_friction - turning;
        let friction = first_friction * (self.slip_before + slipping)
            + (self.friction - first_friction) * (slipping + self.slip());
        let rolling = first_moment * (self.peripheral_before + turning)
            + (self.moment - first_moment) * (turning + self.peripheral);
        (-friction / two, -rolling / two)
    }
}
