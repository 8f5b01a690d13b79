//! Sliding and rolling along the surface: the algebra that every model shares (A6 to A16, A27, B8).
//!
//! The contact point of a sphere slips with the velocity v_t - r w, the tangential velocity less the peripheral velocity. Per
//! unit mass, a friction impulse p changes the tangential velocity by p and the peripheral velocity by -p/kappa. So it
//! changes the slip by p/c, where c = kappa/(1 + kappa) is the [contact inertia](crate::Sphere::contact_inertia). Friction
//! acts against the slip until the slip is zero. From then on, the sphere rolls.

use crate::{Oblique, Real, SurfaceMotion};

/// Motion along the surface when the impact is over.
///
/// ```
/// use microimpact::table::TableRebound;
/// use microimpact::{Coulomb, NormalMotion, SurfaceMotion};
///
/// let rebound = TableRebound { restitution: 0.8, impulse: 2.0 };
/// let before = NormalMotion::new(1.0)?.with_tangential(0.7)?;
/// let after = rebound.separation(&Coulomb::new(0.1)?, 0.4, &before);
/// assert_eq!(after.motion, SurfaceMotion::Rolling);
/// assert!((after.velocity - 0.5_f64).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Separation<T> {
    /// Whether the sphere slides or rolls.
    pub motion: SurfaceMotion,
    /// Tangential velocity V_t of the centre, m/s.
    pub velocity: T,
    /// Peripheral velocity r W, m/s.
    pub peripheral: T,
}

/// Friction impulses of one impact, per unit mass.
pub(crate) struct Friction<T> {
    /// The impulse of this impact.
    pub(crate) total: T,
    /// The impulse if the sphere slides in its first direction throughout.
    pub(crate) sliding: T,
    /// The impulse if the sphere rolls, or slips back, throughout.
    pub(crate) holding: T,
    /// The impulse after which the sphere rolls at separation.
    pub(crate) rolling: T,
    /// Whether the sphere rolls at separation.
    pub(crate) rolls: bool,
}

impl<T: Real> Friction<T> {
    /// Coulomb friction against a slip that only friction changes. The impulse is at most `limit`, so that
    /// mu = min(f, |mu_0|).
    #[inline]
    pub(crate) fn against(slip: T, limit: T, contact_inertia: T) -> Self {
        let rolling = T::ZERO - contact_inertia * slip;
        let sliding = T::ZERO.where_above(slip, limit, -limit);
        let total = rolling.abs().where_above(limit, sliding, rolling);
        Self { total, sliding, holding: T::ZERO, rolling, rolls: rolling.abs() <= limit }
    }

    /// Coulomb friction against a slip that a moment changes too. The angular impulse `moment` is divided by the radius.
    #[inline]
    pub(crate) fn against_moment(slip: T, limit: T, moment: T, gyration_ratio: T, contact_inertia: T) -> Self {
        let drive = moment / gyration_ratio;
        let rolling = contact_inertia * (drive - slip);
        // The direction of the slip or, without slip, of the slip that the moment starts.
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
        // Friction cannot hold the moment. When the first slip has ended, the sphere slips in the other direction.
        let slipping_back = if moment < T::ZERO { -limit } else { limit };
        let fraction = if slip == slip_after { T::ZERO } else { slip / (slip - slip_after) };
        let total = sliding * fraction + slipping_back * (T::ONE - fraction);
        Self { total, sliding, holding: slipping_back, rolling, rolls: false }
    }

    /// Tangential and peripheral velocity at separation, of a sphere that arrived with `before`; `moment` as above.
    #[inline]
    pub(crate) fn velocities(&self, before: &impl Oblique<T>, moment: T, gyration_ratio: T) -> (T, T) {
        let velocity = before.tangential() + self.total;
        let sliding = || before.peripheral() + (moment - self.total) / gyration_ratio;
        let peripheral = if T::HAS_LANES {
            self.rolling.abs().where_above(self.sliding.abs(), sliding(), velocity)
        } else if self.rolls {
            velocity
        } else {
            sliding()
        };
        (velocity, peripheral)
    }

    /// The motion at separation of a sphere that arrived with `before`.
    #[inline]
    pub(crate) fn separation(&self, before: &impl Oblique<T>, gyration_ratio: T) -> Separation<T> {
        let (velocity, peripheral) = self.velocities(before, T::ZERO, gyration_ratio);
        let motion = if self.rolls { SurfaceMotion::Rolling } else { SurfaceMotion::Sliding };
        Separation { motion, velocity, peripheral }
    }
}

/// The largest slip that a friction impulse `limit`, per unit mass, stops.
#[inline]
pub(crate) fn stopped_slip<T: Real>(limit: T, contact_inertia: T) -> T {
    limit / contact_inertia
}

/// The largest friction impulse divided by the impulse that ends the slip. `None` without slip.
#[inline]
pub(crate) fn friction_over_limit<T: Real>(sliding: T, rolling: T) -> Option<T> {
    let limit = rolling.abs();
    (limit > T::ZERO).then(|| sliding.abs().saturating_div(limit))
}

/// Direction of a slip: its sign, or zero.
#[inline]
pub(crate) fn direction<T: Real>(slip: T) -> T {
    if slip > T::ZERO {
        T::ONE
    } else if slip < T::ZERO {
        -T::ONE
    } else {
        T::ZERO
    }
}

/// Velocity of a sphere that rolls with the angular momentum about its contact point of two velocities.
#[inline]
pub(crate) fn rolling<T: Real>(velocity: T, peripheral: T, gyration_ratio: T) -> T {
    (velocity + gyration_ratio * peripheral) / (T::ONE + gyration_ratio)
}

/// Roundings of [`rolling`] in units of its largest term.
const ROUNDINGS: f64 = 8.0;

/// Speed that is nothing but the rounding of [`rolling`].
#[inline]
pub(crate) fn rounding<T: Real>(velocity: T, peripheral: T, gyration_ratio: T) -> T {
    T::constant(ROUNDINGS) * T::EPSILON * rolling(velocity.abs(), peripheral.abs(), gyration_ratio)
}
