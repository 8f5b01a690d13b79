//! The norm of independent errors.

use crate::Real;

/// Standard error of a sum whose parts have independent errors: the root of the sum of their squares.
pub(crate) fn norm<T: Real>(parts: impl IntoIterator<Item = T>) -> T {
    parts.into_iter().fold(T::ZERO, |sum, part| sum + part * part).root_of_variance()
}
