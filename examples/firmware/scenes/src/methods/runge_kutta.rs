//! The classical Runge-Kutta method of order 4.

use microimpact::Real;

/// A step.
#[inline]
pub fn step<T: Real, const S: usize>(rates: impl Fn([T; S]) -> [T; S], state: [T; S], step: T) -> [T; S] {
    let moved = |rates: &[T; S], step: T| sum(&state, rates, step);
    let half = T::constant(0.5) * step;
    let first = rates(state);
    let second = rates(moved(&first, half));
    let third = rates(moved(&second, half));
    let fourth = rates(moved(&third, step));
    let (outer, inner) = (sum(&first, &fourth, T::ONE), sum(&second, &third, T::ONE));
    moved(&sum(&outer, &inner, T::constant(2.0)), step * T::constant(1.0 / 6.0))
}

#[inline]
fn sum<T: Real, const S: usize>(a: &[T; S], b: &[T; S], factor: T) -> [T; S] {
    let mut sum = *a;
    for (sum, b) in sum.iter_mut().zip(b) {
        *sum = *sum + factor * *b;
    }
    sum
}
