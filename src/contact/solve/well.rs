//! The well of the potential in which a captured sphere moves: its minimum, and the barrier that holds the sphere.

use crate::Real;
use crate::contact::law::ContactLaw;

/// Coordinates of the barrier that holds a sphere, the end of contact without an external force, and of the minimum of the
/// potential; `None` where nothing holds a sphere.
pub(crate) fn well<T: Real>(law: &impl ContactLaw<T>) -> Option<(T, T)> {
    let end = law.end();
    // Newton's method from above; where the force grows with a power it takes a fixed fraction off each time.
    let mut bottom = T::ONE;
    for _ in 0..250 {
        let curvature = law.curvature(bottom);
        if curvature <= T::ZERO {
            return None;
        }
        let step = law.slope(bottom) / curvature;
        bottom = bottom - step;
        if bottom - end <= T::EPSILON * T::EPSILON {
            return None;
        }
        if step.abs() <= T::constant(1e-5) * bottom {
            break;
        }
    }
    let mut barrier = end;
    if law.slope(end + T::EPSILON * T::EPSILON * (bottom - end)) > T::ZERO {
        let mut inner = bottom;
        for _ in 0..60 {
            let middle = (barrier + inner) * T::constant(0.5);
            if law.slope(middle) > T::ZERO {
                barrier = middle;
            } else {
                inner = middle;
            }
        }
    }
    (law.potential(barrier) > law.potential(bottom)).then_some((barrier, bottom))
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
