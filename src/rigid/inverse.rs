//! The inverse model: from measured velocities to coefficients.
//!
//! Each function returns an [`Impact`], like the forward model. Its methods give e, rho, mu, the energy balance and the class.

use super::tangential::TangentialImpact;
use crate::rigid::RestitutionLaw;
use crate::{Impact, ImpactError, NormalImpact, Oblique, ObliqueMotion, Parameter, PlanarMotion, Real, Sphere};

/// Measured velocities after an impact, m/s.
///
/// ```
/// use microimpact::rigid::Departure;
///
/// let after = Departure { normal: 2.09, tangential: 0.21 };
/// assert!(after.normal > after.tangential);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Departure<T> {
    /// Normal velocity V_n; zero for a captured sphere.
    pub normal: T,
    /// Tangential velocity V_t.
    pub tangential: T,
}

/// Infers an impact whose spin was not measured, on the assumption that the sphere rolls at separation.
///
/// The assumption means mu = mu_0, which determines the spin before the impact ([`TangentialImpact::spin_before`]).
///
/// # Errors
/// A velocity is outside its range, or the rebound is faster than R allows.
///
/// ```
/// use microimpact::rigid::{Departure, infer_assuming_rolling};
/// use microimpact::{NormalMotion, Sphere, SpeedRestitution};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?;
/// let after = Departure { normal: 2.09, tangential: 0.21 };
/// let impact = infer_assuming_rolling(&sphere, &SpeedRestitution::new(130.0)?, &before, &after)?;
/// assert!((impact.normal.overall_restitution() - 0.746_f64).abs() < 0.0005);
/// assert!((impact.tangential.impulse_ratio() - 0.043).abs() < 0.0005);
/// # Ok::<(), microimpact::ImpactError>(())
/// ```
pub fn infer_assuming_rolling<T: Real>(
    sphere: &Sphere<T>,
    law: &impl RestitutionLaw<T>,
    before: &ObliqueMotion<T>,
    after: &Departure<T>,
) -> Result<Impact<T, TangentialImpact<T>>, ImpactError> {
    let after = after.checked()?;
    let friction = after.tangential - before.tangential();
    let slip = -friction / sphere.contact_inertia();
    let before = before.with_peripheral_velocity(before.tangential() - slip)?;
    measured(sphere, law, &before, &after, after.tangential, T::ZERO)
}

/// Infers an impact whose spin before the impact was measured.
///
/// `velocity_error` (m/s) is the standard error of the velocities along the surface. A smaller slip counts as rolling. An
/// impulse ratio that violates its bounds by less is accepted. Then mu can be slightly outside 0 to mu_0, and the work of
/// friction slightly below zero. The bound on the rebound, e <= R, has no such tolerance.
///
/// # Errors
/// A value is outside its range, the rebound is faster than R allows, or the impulse ratio is outside 0 to mu_0.
///
/// ```
/// use microimpact::rigid::{Departure, infer};
/// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(5e-6, 2600.0)?;
/// let law = ConstantRestitution::new(0.9)?;
/// let before = NormalMotion::new(2.0)?.with_tangential(4.0)?.with_spin(&sphere, 0.0)?;
/// let impact = infer(&sphere, &law, &before, &Departure { normal: 1.5, tangential: 3.5 }, 0.01)?;
/// assert!((impact.tangential.impulse_ratio() + 1.0 / 7.0_f64).abs() < 1e-12);
/// assert_eq!(RigidBody::new(sphere, law).classify_impact(&impact).class(), Class::ReboundSliding);
/// # Ok::<(), microimpact::ImpactError>(())
/// ```
pub fn infer<T: Real>(
    sphere: &Sphere<T>,
    law: &impl RestitutionLaw<T>,
    before: &PlanarMotion<T>,
    after: &Departure<T>,
    velocity_error: T,
) -> Result<Impact<T, TangentialImpact<T>>, ImpactError> {
    let after = after.checked()?;
    let friction = after.tangential - before.tangential();
    let peripheral = before.peripheral() - friction / sphere.gyration_ratio();
    measured(sphere, law, before, &after, peripheral, velocity_error)
}

/// Infers an impact whose spin was measured before and after it; `spin_after` is in rad/s.
///
/// The part of the change of spin that friction does not explain is attributed to rolling dissipation
/// ([`TangentialImpact::rolling_arm`]).
///
/// # Errors
/// Those of [`infer`], or the kinetic energy is larger after the impact than before it.
///
/// ```
/// use microimpact::rigid::{Departure, infer_with_spins};
/// use microimpact::{ConstantRestitution, ImpactError, NormalMotion, Sphere};
///
/// let sphere = Sphere::solid(5e-6, 2600.0)?;
/// let law = ConstantRestitution::new(0.9)?;
/// let before = NormalMotion::new(2.0)?.with_tangential(4.0)?.with_spin(&sphere, 0.0)?;
/// let after = Departure { normal: 1.5, tangential: 3.5 };
/// assert!(infer_with_spins(&sphere, &law, &before, &after, 2.4e5, 0.01).is_ok());
/// assert_eq!(infer_with_spins(&sphere, &law, &before, &after, -1.5e6, 0.01), Err(ImpactError::EnergyGained));
/// # Ok::<(), ImpactError>(())
/// ```
pub fn infer_with_spins<T: Real>(
    sphere: &Sphere<T>,
    law: &impl RestitutionLaw<T>,
    before: &PlanarMotion<T>,
    after: &Departure<T>,
    spin_after: T,
    velocity_error: T,
) -> Result<Impact<T, TangentialImpact<T>>, ImpactError> {
    let after = after.checked()?;
    let peripheral = sphere.radius() * Parameter::Spin.check(spin_after)?;
    measured(sphere, law, before, &after, Parameter::PeripheralVelocity.check(peripheral)?, velocity_error)
}

/// The impact from the complete motions before and after it.
fn measured<T: Real>(
    sphere: &Sphere<T>,
    law: &impl RestitutionLaw<T>,
    before: &PlanarMotion<T>,
    after: &Departure<T>,
    peripheral: T,
    velocity_error: T,
) -> Result<Impact<T, TangentialImpact<T>>, ImpactError> {
    let normal = NormalImpact::from_measurement(law, before, after.normal)?;
    let (kappa, contact_inertia) = (sphere.gyration_ratio(), sphere.contact_inertia());
    let velocities = before.tangential().abs() + before.peripheral().abs() + after.tangential.abs() + peripheral.abs();
    let rounding = T::constant(8.0) * T::EPSILON * velocities / contact_inertia;
    let tolerance = Parameter::VelocityError.check(velocity_error)? + rounding;

    let friction = after.tangential - before.tangential();
    let moment = friction + kappa * (peripheral - before.peripheral());
    let (slip_before, slip_after) = (before.slip(), after.tangential - peripheral);
    let drives = (slip_before > T::ZERO && friction > tolerance) || (slip_before < T::ZERO && -friction > tolerance);
    let reverses =
        (slip_before > T::ZERO && -slip_after > tolerance) || (slip_before < T::ZERO && slip_after > tolerance);
    if drives || reverses {
        return Err(ImpactError::ImpulseRatioOutsideBounds);
    }
    let rolls = slip_after.abs() <= tolerance;
    let tangential = TangentialImpact {
        gyration_ratio: kappa,
        contact_inertia,
        approach: normal.approach_speed(),
        normal_impulse: normal.impulse(),
        velocity_before: before.tangential(),
        peripheral_before: before.peripheral(),
        slip_before,
        velocity: after.tangential,
        peripheral,
        rolls,
        friction,
        sliding_friction: friction,
        holding_friction: T::ZERO,
        rolling_friction: contact_inertia * (moment / kappa - slip_before),
        moment,
    };
    if !conserves_energy(&normal, &tangential, tolerance) {
        return Err(ImpactError::EnergyGained);
    }
    Ok(Impact { normal, tangential })
}

/// Whether the kinetic energy per unit mass grows by no more than the tolerance of the velocities allows.
fn conserves_energy<T: Real>(normal: &NormalImpact<T>, impact: &TangentialImpact<T>, tolerance: T) -> bool {
    let gain = |before: T, after: T| (after - before) * (after + before);
    let scale = |before: T, after: T| before.abs() + after.abs();
    let (n_before, n_after) = (normal.approach_speed(), normal.rebound_speed());
    let (t_before, t_after) = (impact.velocity_before, impact.velocity);
    let (u_before, u_after) = (impact.peripheral_before, impact.peripheral);
    let gained = gain(n_before, n_after) + gain(t_before, t_after) + impact.gyration_ratio * gain(u_before, u_after);
    gained <= tolerance * (scale(n_before, n_after) + scale(t_before, t_after) + scale(u_before, u_after))
}

impl<T: Real> Departure<T> {
    fn checked(&self) -> Result<Self, ImpactError> {
        Ok(Self {
            normal: Parameter::ReboundSpeed.check(self.normal)?,
            tangential: Parameter::TangentialVelocity.check(self.tangential)?,
        })
    }
}
