//! A symmetric matrix of two rows.

use crate::Real;

/// A symmetric matrix of two rows.
#[derive(Clone, Copy)]
pub(super) struct Symmetric<T> {
    pub(super) first: T,
    pub(super) mixed: T,
    pub(super) second: T,
}

impl<T: Real> Symmetric<T> {
    pub(super) const ZERO: Self = Self { first: T::ZERO, mixed: T::ZERO, second: T::ZERO };

    /// Adds a weight times the outer product of a vector with itself.
    pub(super) fn add(&mut self, weight: T, [a, b]: [T; 2]) {
        self.first = self.first + weight * a * a;
        self.mixed = self.mixed + weight * a * b;
        self.second = self.second + weight * b * b;
    }

    /// Adds the outer product of two vectors and its transpose.
    pub(super) fn add_product(&mut self, [a, b]: [T; 2], [c, d]: [T; 2]) {
        self.first = self.first + T::constant(2.0) * a * c;
        self.mixed = self.mixed + a * d + b * c;
        self.second = self.second + T::constant(2.0) * b * d;
    }

    /// The sum of two matrices.
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { first: self.first + other.first, mixed: self.mixed + other.mixed, second: self.second + other.second }
    }

    /// A multiple of the matrix.
    pub(super) fn scaled(&self, factor: T) -> Self {
        Self { first: factor * self.first, mixed: factor * self.mixed, second: factor * self.second }
    }

    /// The covariance matrix with the same correlation, whose variances are at least those of another.
    pub(super) fn at_least(&self, other: &Self) -> Self {
        let factor = |own: T, other: T| if other > own { (other / own).sqrt() } else { T::ONE };
        let (first, second) = (factor(self.first, other.first), factor(self.second, other.second));
        Self {
            first: first * first * self.first,
            mixed: first * second * self.mixed,
            second: second * second * self.second,
        }
    }

    /// Product N M N with another matrix N.
    pub(super) fn between(&self, outer: &Self) -> Self {
        let (first, second) = ([outer.first, outer.mixed], [outer.mixed, outer.second]);
        let [a, b] = self.times(second);
        Self { first: self.form(first), mixed: first[0] * a + first[1] * b, second: self.form(second) }
    }

    /// Product with a vector.
    pub(super) fn times(&self, [a, b]: [T; 2]) -> [T; 2] {
        [self.first * a + self.mixed * b, self.mixed * a + self.second * b]
    }

    /// Product v' M v.
    pub(super) fn form(&self, vector: [T; 2]) -> T {
        let [a, b] = self.times(vector);
        a * vector[0] + b * vector[1]
    }

    /// The inverse of a positive definite matrix. `None` if rounding makes it singular.
    pub(super) fn inverse(&self) -> Option<Self> {
        let product = self.first * self.second;
        let determinant = product - self.mixed * self.mixed;
        let regular =
            self.first > T::ZERO && self.second > T::ZERO && determinant > T::constant(64.0) * T::EPSILON * product;
        regular.then(|| Self {
            first: self.second / determinant,
            mixed: -(self.mixed / determinant),
            second: self.first / determinant,
        })
    }
}
