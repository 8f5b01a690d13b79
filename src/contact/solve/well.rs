//! The well of the potential in which a captured sphere moves: its minimum, and the barrier that holds the sphere.

use crate::Real;
use crate::contact::law::ContactLaw;

/// Steps towards the bottom: doublings to a place beyond it, then those of Newton's method. If the force is a power of the
/// coordinate, each of these takes a fixed fraction off.
const WELL_STEPS: u32 = 250;

/// Relative step at which it ends: the potential is flat there.
const WELL_ACCURACY: f64 = 1e-5;

/// Halvings for the barrier, down to rounding.
const BARRIER_HALVINGS: u32 = 60;

/// Coordinates of the barrier that holds a sphere, the end of contact without an external force, and of the minimum of the
/// potential; `None` where nothing holds a sphere.
pub(crate) fn well<T: Real>(law: &impl ContactLaw<T>) -> Option<(T, T)> {
    let end = law.end();
    // Newton's method from above.
    let (mut bottom, mut above) = (T::ONE, false);
    for _ in 0..WELL_STEPS {
        let (slope, curvature) = (law.slope(bottom), law.curvature(bottom));
        above = above || is_beyond_bottom(law, bottom, slope, curvature);
        if !above {
            bottom = bottom + bottom;
            continue;
        }
        if curvature <= T::ZERO {
            return None;
        }
        let step = slope / curvature;
        bottom = bottom - step;
        if bottom - end <= T::EPSILON * T::EPSILON {
            return None;
        }
        if step.abs() <= T::constant(WELL_ACCURACY) * bottom {
            break;
        }
    }
    let mut barrier = end;
    if law.slope(end + T::EPSILON * T::EPSILON * (bottom - end)) > T::ZERO {
        let mut inner = bottom;
        for _ in 0..BARRIER_HALVINGS {
            let middle = (barrier + inner) * T::constant(0.5);
            if law.slope(middle) > T::ZERO {
                barrier = middle;
            } else {
                inner = middle;
            }
        }
    }
    // A difference of potentials may be less than their rounding, as in the depth.
    (law.mean_slope(barrier, bottom) < T::ZERO).then_some((barrier, bottom))
}

/// Depth of the well between a barrier and the bottom. Where a force has nearly flattened it, a difference of potentials is less than
/// their rounding.
#[inline]
pub(super) fn depth<T: Real>(law: &impl ContactLaw<T>, (barrier, bottom): (T, T)) -> T {
    law.mean_slope(barrier, bottom) * (barrier - bottom)
}

/// Whether a coordinate is no smaller than that of the minimum of the potential, by slope and curvature there.
#[inline]
pub(super) fn is_beyond_bottom<T: Real>(law: &impl ContactLaw<T>, s: T, slope: T, curvature: T) -> bool {
    // In front of the barrier of a force out of the surface the potential rises too, but by a low power of the coordinate.
    let power = T::constant(0.5 * law.energy_power());
    slope >= T::ZERO && (!law.may_have_barrier() || s * curvature >= power * slope)
}

/// Coordinate and height of the barrier that holds a sphere; where there is none, the end of contact and zero.
#[inline]
pub(crate) fn barrier<T: Real, L: ContactLaw<T>>(law: &L) -> (T, T) {
    let end = law.end();
    if !law.may_have_barrier() {
        return (end, T::ZERO);
    }
    // So close to the end of contact it is no higher than rounding errors.
    let seen = well(law).filter(|(barrier, bottom)| *barrier - end > T::EPSILON * (*bottom - end));
    let barrier = seen.map_or(end, |(barrier, _)| barrier);
    (barrier, law.potential(barrier).max(T::ZERO))
}
