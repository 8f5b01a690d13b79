//! The damped square, which takes the place of the square of the speed where damping is strong.
//!
//! Along a path y dy/ds = -(V' + l y), with a loss l. Where the loss is in proportion to the force, l = c V', as under Hunt and
//! Crossley's damping, the variables separate: G(y) = 2 (y/c - ln(1 + c y)/c^2) falls by twice what the potential rises, however
//! strong the damping is. Elsewhere the remaining loss, l - c V', has to be integrated, and it counts less by 1 + c y.
//!
//! The unknown is w = ln(1 + c y), as then c^2 G/2 = e^w - 1 - w and c y = e^w - 1 lose no digits. On the way out c is negative:
//! force and damping act against each other, and the speed tends to -1/c, at which they are equal.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::interval::Course;
use crate::Real;
use crate::contact::law::ContactLaw;

/// Size of an exponent up to which a series has fewer roundings than the exponential function.
const SERIES: f64 = 0.5;

/// Terms of that series: the next one is below a rounding in double precision.
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

/// c, the loss over the force at s, or zero where the force vanishes. Negative on the way out.
#[inline]
pub(crate) fn loss_over_force<T: Real>(law: &impl ContactLaw<T>, s: T, course: Course) -> T {
    let (loss, slope) = (law.loss(s, course.rebound), law.slope(s));
    if slope.abs() * T::constant(LARGEST) <= loss {
        return T::ZERO;
    }
    if course.rebound { -(loss / slope) } else { loss / slope }
}

/// Roundings of a loss that count as nothing remaining.
const ROUNDINGS: f64 = 8.0;

/// What remains at s of the loss, less that in proportion to the force.
#[inline]
pub(crate) fn remaining_loss<T: Real>(law: &impl ContactLaw<T>, ratio: T, s: T, course: Course) -> T {
    let loss = law.loss(s, course.rebound);
    if ratio == T::ZERO {
        return loss;
    }
    let balanced = ratio * law.slope(s);
    let remaining = if course.rebound { loss + balanced } else { loss - balanced };
    if remaining.abs() <= T::constant(ROUNDINGS) * T::EPSILON * loss { T::ZERO } else { remaining }
}

/// G of a speed.
#[inline]
pub(crate) fn damped_square<T: Real>(ratio: T, speed: T) -> T {
    let drag = ratio * speed;
    let growth = (T::ONE + drag).max(T::SMALLEST);
    let w = growth.ln();
    // The logarithm has the rounding of 1 + c y, which a step of Newton's method takes away.
    let w = w + (drag - exponential(w).0) / growth;
    let (_, excess) = exponential(w);
    (excess + excess) / (ratio * ratio)
}

/// The speeds at the nodes of an interval, from their damped squares by Newton's method.
pub(crate) struct DampedSpeeds<T, const N: usize> {
    /// c, times z where the speeds are over z.
    ratio: [T; N],
    /// ln(1 + c y).
    w: [T; N],
    /// c y.
    rise: [T; N],
    /// c y - ln(1 + c y).
    excess: [T; N],
}

impl<T: Real, const N: usize> DampedSpeeds<T, N> {
    pub(crate) fn new(ratio: [T; N], square: &[T; N]) -> Self {
        let zeros = [T::ZERO; N];
        let mut speeds = Self { ratio, w: zeros, rise: zeros, excess: zeros };
        for j in 0..N {
            let c = ratio[j];
            let double = (c * c * square[j]).max(T::ZERO);
            let root = double.sqrt();
            // The first terms of w in powers of the root, so that large squares have about the right logarithm too.
            speeds.w[j] = if c > T::ZERO {
                (T::ONE + root + double * T::constant(1.0 / 3.0)).ln()
            } else {
                -(root + double * T::constant(1.0 / 6.0))
            };
            (speeds.rise[j], speeds.excess[j]) = exponential(speeds.w[j]);
            speeds.improve(j, square[j]);
        }
        speeds
    }

    /// A step of Newton's method towards the damped square at a node; `false` where there is none, as the sphere turns before.
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

    /// 1 + c y at a node, by which a remaining loss counts less.
    #[inline]
    pub(crate) fn divisor(&self, j: usize) -> T {
        (T::ONE + self.rise[j]).max(T::EPSILON)
    }
}
