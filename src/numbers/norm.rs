//! The Euclidean norm.

use crate::Real;

/// Root of the sum of squares, as of independent errors.
pub(crate) fn norm<T: Real>(parts: impl IntoIterator<Item = T>) -> T {
    parts.into_iter().fold(T::ZERO, |sum, part| sum + part * part).sqrt()
}
