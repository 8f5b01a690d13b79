//! Moments of the slip beyond the slip that friction stops, at a given ratio of the speed to the critical speed.

use super::expansion::{Expansion, Stopped, absolute};
use super::panels::Score;
use crate::Real;

/// The normal variable zeta on which the ratio of the speeds depends:
/// zeta = direction z + bend (z^2 - 1) - curvature (zeta^2 - 1).
pub(super) struct Zeta<T, const N: usize> {
    pub(super) direction: [T; N],
    pub(super) bend: [T; N],
    pub(super) curvature: T,
}

/// The effect of one input.
#[derive(Clone, Copy)]
pub(super) struct Part<T> {
    /// Derivative of zeta, and half of the second derivative.
    pub(super) zeta: T,
    pub(super) bend: T,
    /// Derivative of the slip for a given zeta.
    pub(super) slip: T,
    /// Products of all second derivatives of the slip with the derivatives of zeta.
    pub(super) bent_zeta: T,
}

/// What the slip that friction stops contributes to the moments of the excess slip: the stopped slip, the three coefficients
/// of its mean, its variance and covariance with the slip and their derivatives. All but the first are for a stopped slip of
/// one.
pub(super) const MOMENTS: usize = 8;

/// Moments of the excess slip, the slip less the stopped slip, for a given zeta.
///
/// The mean of a quantity is mean + along zeta + second (zeta^2 - 1). To the second degree in the deviations, the variance is
/// linear in zeta, and the third cumulant is constant. Only that of the slip itself matters.
pub(super) struct Excess<T, const N: usize> {
    pub(super) parts: [Part<T>; N],
    pub(super) curvature: T,
    pub(super) mean: T,
    pub(super) along: T,
    pub(super) second: T,
    pub(super) variance: [T; 2],
    pub(super) third: T,
}

/// Product of the mixed derivatives with a vector.
pub(super) fn product<T: Real, const N: usize>(mixed: &Option<[[T; N]; N]>, vector: [T; N]) -> [T; N] {
    mixed
        .map_or([T::ZERO; N], |rows| rows.map(|row| row.iter().zip(&vector).fold(T::ZERO, |sum, (a, b)| sum + *a * *b)))
}

impl<T: Real, const N: usize> Excess<T, N> {
    pub(super) fn new(zeta: &Zeta<T, N>, slip: &Expansion<T, N>, mixed: &Option<[[T; N]; N]>) -> Self {
        let two = T::constant(2.0);
        let zero = T::ZERO;
        let part = Part { zeta: zero, bend: zero, slip: zero, bent_zeta: zero };
        let mut parts = [part; N];
        let mut along = T::ZERO;
        for (((part, zeta), bend), slip) in parts.iter_mut().zip(zeta.direction).zip(zeta.bend).zip(slip.linear) {
            (part.zeta, part.bend) = (zeta, bend);
            along = along + zeta * slip;
        }
        let mut second = T::constant(-0.5) * zeta.curvature * along;
        let (mut variance, mut slope, mut third) = (T::ZERO, T::ZERO, T::ZERO);
        let mut slip_bends = [T::ZERO; N];
        for (((part, slip_bend), slip), square) in
            parts.iter_mut().zip(&mut slip_bends).zip(slip.linear).zip(slip.square)
        {
            let Part { zeta, bend, .. } = *part;
            part.slip = slip - along * zeta;
            *slip_bend = two * (square - along * bend);
            second = second + bend * slip * zeta;
        }
        let mixed_zeta = product(mixed, zeta.direction);
        let mixed_slip = product(mixed, parts.map(|part| part.slip));
        for (((part, slip_bend), by_zeta), by_slip) in parts.iter_mut().zip(slip_bends).zip(mixed_zeta).zip(mixed_slip)
        {
            let Part { zeta, bend, slip, .. } = *part;
            part.bent_zeta = slip_bend * zeta + by_zeta;
            second = second + T::constant(0.25) * part.bent_zeta * zeta;
            variance = variance + slip * slip;
            slope = slope + slip * (part.bent_zeta + bend * slip);
            third = third + slip * (slip_bend * slip + by_slip);
        }
        let variance = [variance, two * slope];
        let (second, third) = (two * second, T::constant(3.0) * third);
        Self { parts, curvature: zeta.curvature, mean: slip.mean, along, second, variance, third }
    }

    /// Moments of a stopped slip, which is a product of powers of the inputs: its second derivatives are the products of the
    /// first ones, and those of its logarithm.
    pub(super) fn moments(&self, stopped: &Stopped<T, N>) -> [T; MOMENTS] {
        let (half, two) = (T::constant(0.5), T::constant(2.0));
        let Expansion { mean, linear, square } = &stopped.relative;
        let along = self.parts.iter().zip(linear).fold(T::ZERO, |sum, (part, g)| sum + part.zeta * *g);
        let (mut bent, mut second) = (T::ZERO, T::ZERO);
        let (mut y, mut y_slope, mut mixed, mut mixed_slope) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        for ((part, g), square) in self.parts.iter().zip(linear).zip(square) {
            let Part { zeta, bend, slip, bent_zeta } = *part;
            let across = *g - along * zeta;
            let curved = two * (*square - along * bend);
            bent = bent + bend * *g * zeta;
            second = second + curved * zeta * zeta;
            y = y + across * across;
            y_slope = y_slope + (curved * zeta + bend * across) * across;
            mixed = mixed + across * slip;
            mixed_slope = mixed_slope + bent_zeta * across + (curved * zeta + two * bend * across) * slip;
        }
        [
            absolute(*mean, stopped.value),
            T::ONE + half * (along * along + y),
            along,
            half * (second + along * along) + two * bent - self.curvature * along,
            y,
            two * (y_slope + along * y),
            mixed,
            mixed_slope + along * mixed,
        ]
    }

    /// Scores for both directions of the slip: the probability of sliding is that of a normal variable below the score.
    pub(super) fn scores(&self, zeta: T, stopped: [T; MOMENTS]) -> [Score<T>; 2] {
        let [value, mean, along, second, y, y_slope, mixed, mixed_slope] = stopped;
        let curved = zeta * zeta - T::ONE;
        let stopped = value * (mean + along * zeta + second * curved);
        let slip = self.mean + self.along * zeta + self.second * curved;
        let [s, s_slope] = self.variance;
        let square = value * value;
        let (variance, variance_slope) = (s + square * y, s_slope + square * y_slope);
        let twice = T::constant(2.0) * value;
        let (shared, shared_slope) = (twice * mixed, twice * mixed_slope);
        [T::ONE, -T::ONE].map(|sign| {
            let constant = variance - sign * shared;
            let variance = (constant + zeta * (variance_slope - sign * shared_slope)).max(T::constant(0.25) * constant);
            Score { mean: sign * slip - stopped, variance: variance.max(T::ZERO), third: sign * self.third }
        })
    }
}
