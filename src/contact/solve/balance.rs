//! Strong damping: what takes the place of the square of the speed.
//!
//! Along a path y dy/ds = -(V' + l y), with a loss l. Where the loss is in proportion to the force, l = c V', the variables separate:
//! G(y) = 2 (y/c - ln(1 + c y)/c^2) decreases by twice the potential, however strong the damping is. Elsewhere only the rest, l - c V',
//! remains to be integrated, and for c > 0 it counts less by 1 + c y.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::interval::Course;
use crate::Real;
use crate::contact::law::ContactLaw;

/// Size of an exponent up to which a series has fewer roundings than the exponential function.
const SERIES: f64 = 0.5;

/// Terms of that series.
const TERMS: u32 = 14;

/// e^w - 1 and e^w - 1 - w, without cancellation.
#[inline]
fn exponential<T: Real>(w: T) -> (T, T) {
    if w.abs() > T::constant(SERIES) {
        let rise = w.exp() - T::ONE;
        return (rise, rise - w);
    }
    let mut sum = T::ZERO;
    for term in (0..TERMS).rev() {
        sum = (T::ONE + sum * w) * T::constant(1.0 / f64::from(term + 2));
    }
    // Now (e^w - 1 - w)/w^2.
    let excess = w * w * sum;
    (w + excess, excess)
}

/// Largest c: its square times that of a speed must not overflow.
const LARGEST: f64 = 1e10;

/// c, the reciprocal of the speed at which the loss and the force balance at s: negative where they act against each other.
#[inline]
pub(crate) fn ratio<T: Real>(law: &impl ContactLaw<T>, s: T, course: Course) -> T {
    let (loss, slope) = (law.loss(s, course.rebound), law.slope(s));
    if slope.abs() * T::constant(LARGEST) <= loss {
        return T::ZERO;
    }
    if course.rebound { -(loss / slope) } else { loss / slope }
}

/// Roundings of a loss that count as nothing left.
const ROUNDINGS: f64 = 8.0;

/// What is left of the loss at s.
#[inline]
pub(crate) fn unbalanced<T: Real>(law: &impl ContactLaw<T>, ratio: T, s: T, course: Course) -> T {
    let (loss, balanced) = (law.loss(s, course.rebound), ratio * law.slope(s));
    let rest = if course.rebound { loss + balanced } else { loss - balanced };
    if rest.abs() <= T::constant(ROUNDINGS) * T::EPSILON * loss { T::ZERO } else { rest }
}

/// G of a speed.
#[inline]
pub(crate) fn square<T: Real>(ratio: T, speed: T) -> T {
    let drag = ratio * speed;
    let mut w = (T::ONE + drag).max(T::SMALLEST).ln();
    let (rise, _) = exponential(w);
    w = w + (drag - rise) / (T::ONE + drag);
    let (_, excess) = exponential(w);
    (excess + excess) / (ratio * ratio)
}

/// The speeds of an interval while they are iterated.
pub(crate) struct Balance<T, const N: usize> {
    /// c at each node, times z where the speeds are over z.
    ratio: [T; N],
    /// ln(1 + c y).
    w: [T; N],
    /// c y.
    rise: [T; N],
    /// c y - ln(1 + c y).
    excess: [T; N],
}

impl<T: Real, const N: usize> Balance<T, N> {
    pub(crate) fn new(ratio: [T; N], square: &[T; N]) -> Self {
        let zeros = [T::ZERO; N];
        let mut balance = Self { ratio, w: zeros, rise: zeros, excess: zeros };
        for j in 0..N {
            let c = ratio[j];
            let double = (c * c * square[j]).max(T::ZERO);
            let root = double.sqrt();
            balance.w[j] = if c > T::ZERO {
                (T::ONE + root + double * T::constant(1.0 / 3.0)).ln()
            } else {
                -(root + double * T::constant(1.0 / 6.0))
            };
            (balance.rise[j], balance.excess[j]) = exponential(balance.w[j]);
            balance.improve(j, square[j]);
        }
        balance
    }

    /// A step of Newton's method towards the square at a node; `false` where there is none, as the sphere turns before.
    #[inline]
    pub(crate) fn improve(&mut self, j: usize, square: T) -> bool {
        let (half, c) = (T::constant(0.5), self.ratio[j]);
        let target = half * c * c * square;
        if target > T::ZERO {
            self.w[j] = self.w[j] + (target - self.excess[j]) / self.rise[j];
        } else {
            self.w[j] = half * self.w[j];
        }
        if (self.w[j] > T::ZERO) != (c > T::ZERO) {
            self.w[j] = if c > T::ZERO { T::SMALLEST } else { -T::SMALLEST };
        }
        (self.rise[j], self.excess[j]) = exponential(self.w[j]);
        target > T::ZERO
    }

    /// The speed at a node.
    #[inline]
    pub(crate) fn speed(&self, j: usize) -> T {
        self.rise[j] / self.ratio[j]
    }

    /// 1 + c y at a node.
    #[inline]
    pub(crate) fn growth(&self, j: usize) -> T {
        (T::ONE + self.rise[j]).max(T::EPSILON)
    }
}
