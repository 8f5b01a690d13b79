//! Rolling: the velocity at which a sphere rolls, and how much of it is rounding.

use crate::Real;

/// Direction of a slip: its sign, or zero.
#[inline]
pub(super) fn direction<T: Real>(slip: T) -> T {
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
pub(super) fn rolling<T: Real>(velocity: T, peripheral: T, gyration_ratio: T) -> T {
    (velocity + gyration_ratio * peripheral) / (T::ONE + gyration_ratio)
}

/// Roundings of [`rolling`] in units of its largest term.
const ROUNDINGS: f64 = 8.0;

/// Speed that is nothing but the rounding of [`rolling`].
#[inline]
pub(super) fn rounding<T: Real>(velocity: T, peripheral: T, gyration_ratio: T) -> T {
    T::constant(ROUNDINGS) * T::EPSILON * rolling(velocity.abs(), peripheral.abs(), gyration_ratio)
}
