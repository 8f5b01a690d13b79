//! The normal force as a function of the contact radius (B6), dimensionless.
//!
//! With the contact radius s, the indentation x = s^2 and the speed y in the units of [`Scaled`](super::scaled::Scaled)
//! the normal motion is the path y^2/2 = E - V(s), along which only the losses change the energy E. V is a polynomial:
//! no roots, and smooth where the spheres touch.

use super::nodes::Share;
use crate::{NoAdhesion, Real};

/// What the solver knows of a contact: potential and losses against the contact radius s, in units in which the peak of
/// the undamped motion lies near s = 1.
///
/// A law that is given in the contact radius by its nature, such as that of Johnson, Kendall and Roberts, implements this
/// trait as well; none of the solver depends on Hertz's relation of indentation and contact radius.
///
/// ```
/// use microimpact::simulation::NormalLaw;
///
/// /// A linear spring with viscous damping: V = s^4/2 at the indentation x = s^2.
/// #[derive(Clone, Copy)]
/// struct Spring;
///
/// impl NormalLaw<f64> for Spring {
///     fn potential(&self, s: f64) -> f64 {
///         s.powi(4) / 2.0
///     }
///     fn slope(&self, s: f64) -> f64 {
///         2.0 * s.powi(3)
///     }
///     fn curvature(&self, s: f64) -> f64 {
///         6.0 * s * s
///     }
///     fn divided(&self, p: f64, s: f64) -> f64 {
///         (p + s) * (p * p + s * s) / 2.0
///     }
///     fn material_damping(&self, _s: f64) -> f64 {
///         0.1
///     }
///     fn adhesion_damping(&self, _s: f64) -> f64 {
///         0.0
///     }
///     fn elastic_force(&self, s: f64) -> f64 {
///         s * s
///     }
///     fn adhesion_force(&self, _s: f64) -> f64 {
///         0.0
///     }
/// }
/// assert_eq!(Spring.divided(1.0, 0.5) * 0.5, Spring.potential(1.0) - Spring.potential(0.5));
/// assert_eq!(Spring.loss(0.5, false), 0.1);
/// ```
pub trait NormalLaw<T: Real>: Copy {
    /// Whether the potential may rise where the contact begins, as under a force out of the surface.
    const MAY_REPEL: bool = true;

    /// Indentation x.
    #[inline]
    fn indentation(&self, s: T) -> T {
        s * s
    }

    /// dx/ds.
    #[inline]
    fn indentation_slope(&self, s: T) -> T {
        s + s
    }

    /// Potential energy V, zero at s = 0.
    fn potential(&self, s: T) -> T;

    /// dV/ds.
    fn slope(&self, s: T) -> T;

    /// d^2V/ds^2.
    fn curvature(&self, s: T) -> T;

    /// (V(p) - V(s))/(p - s), without the cancellation of a difference.
    fn divided(&self, p: T, s: T) -> T;

    /// Damping force of the materials for each unit of speed, on approach and rebound.
    fn material_damping(&self, s: T) -> T;

    /// Damping force of adhesion for each unit of speed, on rebound.
    fn adhesion_damping(&self, s: T) -> T;

    /// Elastic force, which friction goes by (B8).
    fn elastic_force(&self, s: T) -> T;

    /// Force of adhesion without its damping.
    fn adhesion_force(&self, s: T) -> T;

    /// Force of the potential -dV/dx; a law whose indentation has no slope at s = 0 has to say what it is there.
    #[inline]
    fn conservative_force(&self, s: T) -> T {
        -(self.slope(s) / self.indentation_slope(s))
    }

    /// Damping force of both kinds on the way in or out.
    #[inline]
    fn damping(&self, s: T, rebound: bool) -> T {
        if rebound { self.material_damping(s) + self.adhesion_damping(s) } else { self.material_damping(s) }
    }

    /// Energy that damping takes for each ds and unit of speed.
    #[inline]
    fn loss(&self, s: T, rebound: bool) -> T {
        self.indentation_slope(s) * self.damping(s, rebound)
    }

    /// What the potential falls by from the peak to a share m of its contact radius, over 1 - m.
    #[inline]
    fn fall(&self, peak: T, share: &Share<T>) -> T {
        peak * self.divided(peak, peak * share.radius)
    }

    /// Energy that damping takes for each ds and unit of speed, over m^2 at the share m > 0 of the peak; a law that loses
    /// less than that close to s = 0 has it grow there.
    #[inline]
    fn loss_over_square(&self, peak: T, share: &Share<T>, rebound: bool) -> T {
        self.loss(peak * share.radius, rebound) / share.square
    }
}

/// A force besides the elastic one, conservative but for its damping on rebound. What it gives is taken from the
/// potential, so that an absent term leaves no operation behind.
///
/// ```
/// use microimpact::{NoAdhesion, simulation::Attraction};
///
/// assert_eq!(Attraction::<f32>::energy(&NoAdhesion, 0.5), 0.0);
/// ```
pub trait Attraction<T: Real>: Copy {
    /// Whether there is such a force at all.
    const PRESENT: bool;

    /// Energy that the force gives a sphere on its way to s.
    #[inline]
    fn energy(&self, _s: T) -> T {
        T::ZERO
    }

    /// Its derivative by s.
    #[inline]
    fn slope(&self, _s: T) -> T {
        T::ZERO
    }

    /// Its second derivative by s.
    #[inline]
    fn curvature(&self, _s: T) -> T {
        T::ZERO
    }

    /// (energy(p) - energy(s))/(p - s), without the cancellation of a difference.
    #[inline]
    fn divided(&self, _p: T, _s: T) -> T {
        T::ZERO
    }

    /// The force itself.
    #[inline]
    fn force(&self, _s: T) -> T {
        T::ZERO
    }

    /// Its damping force for each unit of speed.
    #[inline]
    fn damping(&self, _s: T) -> T {
        T::ZERO
    }

    /// As [`NormalLaw::fall`], of the energy.
    #[inline]
    fn fall(&self, _peak: T, _share: &Share<T>) -> T {
        T::ZERO
    }

    /// As [`NormalLaw::loss_over_square`].
    #[inline]
    fn loss_over_square(&self, _peak: T, _share: &Share<T>) -> T {
        T::ZERO
    }

    /// Share of the force that its damping adds for each unit of speed.
    #[inline]
    fn damping_rate(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> Attraction<T> for NoAdhesion {
    const PRESENT: bool = false;
}

/// Damping of the elastic force.
///
/// ```
/// use microimpact::simulation::{Damping, NoDamping};
///
/// assert_eq!(Damping::<f32>::rate(&NoDamping), 0.0);
/// ```
pub trait Damping<T: Real>: Copy {
    /// Share of the elastic force that is added for each unit of speed.
    fn rate(&self) -> T;
}

/// Hertz's elastic force (5/4) s^3 with its damping, adhesion and an external force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzLaw<D, A, X> {
    pub(super) damping: D,
    pub(super) adhesion: A,
    pub(super) force: X,
}

impl<T: Real, D: Damping<T>, A: Attraction<T>, X: Attraction<T>> NormalLaw<T> for HertzLaw<D, A, X> {
    const MAY_REPEL: bool = X::PRESENT;

    #[inline]
    fn potential(&self, s: T) -> T {
        let s2 = s * s;
        T::constant(0.5) * s2 * s2 * s - self.adhesion.energy(s) - self.force.energy(s)
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        let s2 = s * s;
        T::constant(2.5) * s2 * s2 - self.adhesion.slope(s) - self.force.slope(s)
    }

    #[inline]
    fn curvature(&self, s: T) -> T {
        T::constant(10.0) * s * s * s - self.adhesion.curvature(s) - self.force.curvature(s)
    }

    #[inline]
    fn divided(&self, p: T, s: T) -> T {
        let (p2, s2, product) = (p * p, s * s, p * s);
        let elastic = T::constant(0.5) * (p2 * p2 + s2 * s2 + product * (p2 + product + s2));
        elastic - self.adhesion.divided(p, s) - self.force.divided(p, s)
    }

    #[inline]
    fn material_damping(&self, s: T) -> T {
        self.damping.rate() * self.elastic_force(s)
    }

    #[inline]
    fn adhesion_damping(&self, s: T) -> T {
        self.adhesion.damping(s)
    }

    #[inline]
    fn fall(&self, peak: T, share: &Share<T>) -> T {
        let square = peak * peak;
        let elastic = T::constant(0.5) * square * square * peak * share.quintic;
        elastic - self.adhesion.fall(peak, share) - self.force.fall(peak, share)
    }

    #[inline]
    fn loss_over_square(&self, peak: T, share: &Share<T>, rebound: bool) -> T {
        let square = peak * peak;
        let material = T::constant(2.5) * self.damping.rate() * square * square * share.square;
        if rebound { material + self.adhesion.loss_over_square(peak, share) } else { material }
    }

    #[inline]
    fn elastic_force(&self, s: T) -> T {
        T::constant(1.25) * s * s * s
    }

    #[inline]
    fn adhesion_force(&self, s: T) -> T {
        self.adhesion.force(s)
    }

    #[inline]
    fn conservative_force(&self, s: T) -> T {
        self.adhesion_force(s) + self.force.force(s) - self.elastic_force(s)
    }
}

/// Contact radii of the brink that holds a sphere, zero without an external force, and of the minimum of the potential.
pub(super) fn well<T: Real>(law: &impl NormalLaw<T>) -> Option<(T, T)> {
    // Newton's method from above; where the force grows with a power it takes a fixed share off each time.
    let mut bottom = T::ONE;
    for _ in 0..250 {
        let curvature = law.curvature(bottom);
        if curvature <= T::ZERO {
            return None;
        }
        let step = law.slope(bottom) / curvature;
        bottom = bottom - step;
        if bottom <= T::EPSILON * T::EPSILON {
            return None;
        }
        if step.abs() <= T::constant(1e-5) * bottom {
            break;
        }
    }
    let mut brink = T::ZERO;
    if law.slope(T::EPSILON * T::EPSILON * bottom) > T::ZERO {
        let mut inner = bottom;
        for _ in 0..60 {
            let middle = (brink + inner) * T::constant(0.5);
            if law.slope(middle) > T::ZERO {
                brink = middle;
            } else {
                inner = middle;
            }
        }
    }
    (law.potential(brink) > law.potential(bottom)).then_some((brink, bottom))
}

/// Contact radius and height of the barrier that holds a sphere; both zero where there is none but separation itself.
#[inline]
pub(super) fn brink<T: Real, L: NormalLaw<T>>(law: &L) -> (T, T) {
    if !L::MAY_REPEL {
        return (T::ZERO, T::ZERO);
    }
    // So close to first touch it is no higher than rounding errors.
    let seen = well(law).filter(|(brink, bottom)| *brink > T::EPSILON * *bottom);
    let brink = seen.map_or(T::ZERO, |(brink, _)| brink);
    (brink, law.potential(brink).max(T::ZERO))
}
