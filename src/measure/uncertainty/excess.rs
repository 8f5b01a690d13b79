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
    /// Derivative of the slip for a given zeta, and the second derivative.
    pub(super) slip: T,
    pub(super) slip_bend: T,
    /// Products of all second derivatives of the slip with the derivatives of zeta and of the slip.
    pub(super) bent_zeta: T,
    pub(super) bent_slip: T,
}

/// What the slip that friction stops contributes to the moments of the excess slip: the stopped slip, the three coefficients
/// of its mean, its variance and covariance with the slip and their derivatives, and three third cumulants. All but the first
/// are for a stopped slip of one.
pub(super) const MOMENTS: usize = 11;

/// Moments of the excess slip, the slip less the stopped slip, for a given zeta.
///
/// The mean of a quantity is mean + along zeta + second (zeta^2 - 1). To the second degree in the deviations, the variance is
/// linear in zeta, and the third cumulant is constant.
pub(super) struct Excess<T, const N: usize> {
    pub(super) parts: [Part<T>; N],
    pub(super) curvature: T,
    pub(super) mean: T,
    pub(super) along: T,
    pub(super) second: T,
    pub(super) variance: [T; 2],
    pub(super) third: T,
    /// Mixed second derivatives of the slip.
    pub(super) mixed: Option<[[T; N]; N]>,
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
        let part = Part { zeta: zero, bend: zero, slip: zero, slip_bend: zero, bent_zeta: zero, bent_slip: zero };
        let mut parts = [part; N];
        let mut along = T::ZERO;
        for (((part, zeta), bend), slip) in parts.iter_mut().zip(zeta.direction).zip(zeta.bend).zip(slip.linear) {
            (part.zeta, part.bend) = (zeta, bend);
            along = along + zeta * slip;
        }
        let mut second = T::constant(-0.5) * zeta.curvature * along;
        let (mut variance, mut slope, mut third) = (T::ZERO, T::ZERO, T::ZERO);
        for ((part, slip), square) in parts.iter_mut().zip(slip.linear).zip(slip.square) {
            let Part { zeta, bend, .. } = *part;
            part.slip = slip - along * zeta;
            part.slip_bend = two * (square - along * bend);
            second = second + bend * slip * zeta;
        }
        let mixed_zeta = product(mixed, zeta.direction);
        let mixed_slip = product(mixed, parts.map(|part| part.slip));
        for ((part, by_zeta), by_slip) in parts.iter_mut().zip(mixed_zeta).zip(mixed_slip) {
            let Part { zeta, bend, slip, slip_bend, .. } = *part;
            (part.bent_zeta, part.bent_slip) = (slip_bend * zeta + by_zeta, slip_bend * slip + by_slip);
            second = second + T::constant(0.25) * part.bent_zeta * zeta;
            variance = variance + slip * slip;
            slope = slope + slip * (part.bent_zeta + bend * slip);
            third = third + slip * part.bent_slip;
        }
        let variance = [variance, two * slope];
        let (second, third) = (two * second, T::constant(3.0) * third);
        Self { parts, curvature: zeta.curvature, mean: slip.mean, along, second, variance, third, mixed: *mixed }
    }

    /// Moments of a stopped slip, which is a product of powers of the inputs: its second derivatives are the products of the
    /// first ones, and those of its logarithm.
    pub(super) fn moments(&self, stopped: &Stopped<T, N>) -> [T; MOMENTS] {
        let (half, two, three) = (T::constant(0.5), T::constant(2.0), T::constant(3.0));
        let Expansion { mean, linear, square } = &stopped.relative;
        let along = self.parts.iter().zip(linear).fold(T::ZERO, |sum, (part, g)| sum + part.zeta * *g);
        let (mut bent, mut second) = (T::ZERO, T::ZERO);
        let (mut y, mut y_slope, mut mixed, mut mixed_slope) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        let (mut ssy, mut sys, mut syy, mut yys, mut yyy) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        let mut across = *linear;
        for (across, part) in across.iter_mut().zip(&self.parts) {
            *across = *across - along * part.zeta;
        }
        let mixed_y = product(&self.mixed, across);
        for ((((part, g), square), across), mixed_y) in
            self.parts.iter().zip(linear).zip(square).zip(across).zip(mixed_y)
        {
            let Part { zeta, bend, slip, slip_bend, bent_zeta, bent_slip } = part;
            let curved = two * (*square - along * *bend);
            let by_y = curved * across;
            bent = bent + *bend * *g * *zeta;
            second = second + curved * *zeta * *zeta;
            y = y + across * across;
            y_slope = y_slope + by_y * *zeta + *bend * across * across;
            mixed = mixed + across * *slip;
            mixed_slope = mixed_slope + *bent_zeta * across + curved * *slip * *zeta + two * *bend * *slip * across;
            ssy = ssy + *bent_slip * across;
            sys = sys + curved * *slip * *slip;
            syy = syy + by_y * *slip;
            yys = yys + (*slip_bend * across + mixed_y) * across;
            yyy = yyy + by_y * across;
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
            two * ssy + sys + mixed * mixed,
            two * (syy + y * mixed) + yys,
            three * (yyy + y * y),
        ]
    }

    /// Scores for both directions of the slip: the probability of sliding is that of a normal variable below the score.
    pub(super) fn scores(&self, zeta: T, stopped: [T; MOMENTS]) -> [Score<T>; 2] {
        let [value, mean, along, second, y, y_slope, mixed, mixed_slope, ssy, syy, yyy] = stopped;
        let curved = zeta * zeta - T::ONE;
        let (two, three) = (T::constant(2.0), T::constant(3.0));
        let stopped = value * (mean + along * zeta + second * curved);
        let slip = self.mean + self.along * zeta + self.second * curved;
        let [s, s_slope] = self.variance;
        let variance = s + value * value * y;
        let variance_slope = s_slope + value * value * y_slope;
        [T::ONE, -T::ONE].map(|sign| {
            let twice = sign * two * value;
            let constant = variance - twice * mixed;
            let variance = (constant + zeta * (variance_slope - twice * mixed_slope)).max(T::constant(0.25) * constant);
            let third = sign * (self.third + three * value * value * syy) - value * (three * ssy + value * value * yyy);
            Score::new(sign * slip - stopped, variance, third)
        })
    }
}
