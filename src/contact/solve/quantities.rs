//! Quantities that are integrated along a motion, and its times.

use crate::Real;

/// Quantities that are integrated together; none at all is `()`.
pub trait Quantities<T: Real>: Copy {
    /// `of` each quantity and its counterpart.
    #[must_use]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self;
}

impl<T: Real> Quantities<T> for () {
    #[inline]
    fn combine(self, (): Self, _of: impl Fn(T, T) -> T + Copy) {}
}

impl<T: Real> Quantities<T> for [T; 2] {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        let ([a, b], [c, d]) = (self, other);
        [of(a, c), of(b, d)]
    }
}

impl<T: Real, A: Quantities<T>, B: Quantities<T>> Quantities<T> for (A, B) {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        (self.0.combine(other.0, of), self.1.combine(other.1, of))
    }
}

/// Times since first contact and up to the peak, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times<T> {
    pub(crate) now: T,
    pub(crate) peak: T,
}

impl<T: Real> Times<T> {
    pub(crate) fn new() -> Self {
        Self { now: T::ZERO, peak: T::ZERO }
    }

    /// The same in another number type.
    pub(crate) fn map<U>(self, of: impl Fn(T) -> U) -> Times<U> {
        Times { now: of(self.now), peak: of(self.peak) }
    }
}
