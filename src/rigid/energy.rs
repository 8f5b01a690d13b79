//! Where the kinetic energy goes (A29 to A34).

use crate::{Impact, NormalImpact, Real, Sphere, TangentialImpact};

/// Works of the normal impulses (A31), J: positive where the sphere gains.
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
    /// Of the body's impulse during approach.
    pub body_approach: T,
    /// Of the body's impulse during rebound.
    pub body_rebound: T,
    /// Of the adhesion impulse.
    pub adhesion: T,
    /// Of the external microforce.
    pub external: T,
}

/// Kinetic energy before and after an impact, and what took the difference, J.
///
/// The losses add up to the difference, to rounding. In single precision the energy of a slow nanometre sphere
/// falls below the smallest normal number, 1e-38 J; double precision holds it.
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
    /// Kinetic energy before, J. Without friction only that of the normal motion counts, before and after.
    pub before: T,
    /// Kinetic energy after, J.
    pub after: T,
    /// Lost in the materials; (1 - R^2) m v_n^2/2 of a rigid body.
    pub material: T,
    /// Lost to adhesion; (R^2 - e^2) m v_n^2/2 of a rigid body (A33).
    pub adhesion: T,
    /// Lost to friction on the slip.
    pub friction: T,
    /// Lost to rolling dissipation, or to the peeling moment of a simulation.
    pub rolling: T,
    /// Given to the external microforce; negative where it drives the sphere.
    pub external: T,
}

impl<T: Real> EnergyLedger<T> {
    /// Sum of all losses T_L, J.
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

/// Half the mass times a difference of squares.
#[inline]
fn kinetic<T: Real>(mass: T, faster: T, slower: T) -> T {
    mass * (faster - slower) * (faster + slower) / T::constant(2.0)
}

impl<T: Real> NormalImpact<T> {
    /// The works of the normal impulses on a given sphere.
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
        // An impulse that grows in proportion to the others works at the mean of the velocities it acts between.
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
    /// The energy of this impact on a given sphere.
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
    /// The energy of this impact on a given sphere.
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
        let along_surface = |tangential_velocity, peripheral| {
            kinetic(mass, tangential_velocity, T::ZERO) + sphere.gyration_ratio() * kinetic(mass, peripheral, T::ZERO)
        };
        EnergyLedger {
            before: normal.before + along_surface(tangential.tangential_before, tangential.peripheral_before),
            after: normal.after + along_surface(tangential.tangential, tangential.peripheral),
            friction: mass * friction,
            rolling: mass * rolling,
            ..normal
        }
    }

    /// Energy loss 2 T_L/(m v_n^2) in terms of the coefficients (A29).
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
        let arm = impact.couple / impact.normal_impulse;
        let whole = T::ONE + e;
        let rotation = (mu - arm) * whole;
        let normal = (T::ONE - e) * whole;
        let translation = whole * mu * (two * eta - whole * mu);
        let moment = two * arm * whole * (impact.peripheral_before / impact.approach);
        normal + translation - rotation * rotation / impact.gyration_ratio - moment
    }
}

impl<T: Real> TangentialImpact<T> {
    /// Work that friction and the resisting moment take, per unit mass: impulse times mean velocity in each of the
    /// two stretches of constant friction.
    fn losses(&self) -> (T, T) {
        let two = T::constant(2.0);
        let share = self.sliding_share();
        let first_friction = self.sliding_friction * share;
        let first_couple = self.couple * share;
        let turning = self.peripheral_before + (first_couple - first_friction) / self.gyration_ratio;
        let slipping = self.tangential_before + first_friction - turning;
        let friction = first_friction * (self.slip_before + slipping)
            + (self.friction - first_friction) * (slipping + self.slip());
        let rolling = first_couple * (self.peripheral_before + turning)
            + (self.couple - first_couple) * (turning + self.peripheral);
        (-friction / two, -rolling / two)
    }
}
