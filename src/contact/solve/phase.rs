//! A whole phase of the motion, approach or rebound, as one polynomial.
//!
//! With the coordinate s = a (1 - z^2) below its peak a and the speed y = z u, both phases run from z = 0 at the peak to z = 1
//! at s = 0, and u^2 = free(z) +- integral of z^2 loss(z) u dz / z^2. The sign is plus for the approach, which is seen
//! backwards. If damping is mild and the sphere is not slow, u is so smooth that few nodes represent it everywhere. All
//! outputs are integrals over it.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::interval::{Interval, Point, coefficients, series};
use super::nodes::{Nodes, PhaseNodes, PhaseSamples};
use crate::Real;
use crate::contact::law::{ContactLaw, Fraction};

/// Weights of the losses at the first and the last node in the estimate of the energy that they take: as if the losses were
/// linear in the square of the coordinate, and the speed everywhere that of the middle of the phase. An estimate, which the
/// iterations correct: the better it is, the fewer of them a method of fixed cost needs for an error.
const FIRST_LOSS_WEIGHT: f64 = 0.56;
const LAST_LOSS_WEIGHT: f64 = 0.36;

/// Estimated error of e^2 over the square of the part of the losses that the nodes do not resolve: Gauss quadrature is exact
/// to twice the degree of interpolation, so that errors go with squares.
const ENERGY_ERROR: f64 = 0.5;

/// The same for the reciprocal speed, over the energy that a phase loses. The tests of `Adaptive` against the reference fail
/// if the estimates are too low or too high.
const SLOWNESS_ERROR: f64 = 0.03;

/// Factor that makes a bound of the square of the part that the nodes do not resolve, and the fraction of it on both phases that does
/// not cancel: damping in the materials is about the same on the way in and out.
const LOSSES_BOUND: f64 = 1.5;
const UNCANCELLED: f64 = 0.1;

/// Bound of the error by the slow end, over the energy lost, times N^7 for N nodes. Losses vanish with the square of the
/// distance from there at least, and the speed with its root at most: Gauss quadrature of the power 5/2 leaves an error that falls with
/// N^-7. Over random rebounds with five, seven and nine nodes the error is below the bound.
const SLOW_END_BOUND: f64 = 10.0;

/// Estimated relative error of times over the parts of the losses and, to the fourth power, of the reciprocal speed that the
/// nodes do not resolve. The same tests hold them, and those of impulses under Hunt and Crossley's damping.
const TIME_ERROR_OF_LOSSES: f64 = 6e-3;
const TIME_ERROR_OF_SLOWNESS: f64 = 0.06;

/// Speeds over z at the nodes, and what they follow from.
#[derive(Clone)]
pub(crate) struct Phase<T, const N: usize> {
    /// Peak coordinate.
    pub(crate) peak: T,
    /// Squares without losses.
    pub(crate) free: [T; N],
    /// Loss for each dz, over the weight of the nodes; negative on rebound.
    pub(crate) loss: [T; N],
    pub(crate) speed: [T; N],
    /// Half the reciprocals of the speeds, or of earlier ones.
    half_inverse: [T; N],
    /// Energy that the losses are estimated to give over the whole approach.
    pub(crate) estimate: T,
}

/// Energy that a phase loses, and estimates of the parts that its nodes do not resolve.
pub(crate) struct Tails<T> {
    pub(crate) lost: T,
    /// Of the lost energy.
    pub(crate) power: T,
    /// Of the reciprocal speed, as a fraction of it.
    pub(crate) slowness: T,
}

impl<T: Real> Tails<T> {
    /// Estimated error of the energy after the phase.
    pub(crate) fn error_of_energy(&self) -> T {
        let slowness = self.slowness.min(T::ONE);
        T::constant(ENERGY_ERROR) * self.unresolved().max(T::constant(SLOWNESS_ERROR) * self.lost * slowness * slowness)
    }

    /// A bound of the error of the energy after an approach and the rebound `after` it.
    pub(crate) fn bound_with<const N: usize>(&self, after: &Self) -> T {
        let (on_approach, on_rebound) = (self.unresolved(), after.unresolved());
        let (n, cube) = (N as f64, (N * N * N) as f64);
        let difference = (on_rebound - on_approach).abs() + T::constant(UNCANCELLED) * (on_approach + on_rebound);
        T::constant(LOSSES_BOUND) * difference
            + (self.lost + after.lost) * T::constant(SLOW_END_BOUND / (n * cube * cube))
    }

    /// Square of the unresolved part of the losses over the lost energy.
    #[inline]
    fn unresolved(&self) -> T {
        // Beyond one there is nothing to estimate, and fixed point would overflow.
        self.power * self.power.saturating_div(self.lost + T::SMALLEST).min(T::ONE)
    }

    /// Estimated relative error of integrals over time, if the quadrature itself is exact, for a sphere that arrives with a kinetic
    /// energy.
    pub(crate) fn error_of_times(&self, energy: T) -> T {
        let square = self.slowness * self.slowness;
        let losses = T::constant(TIME_ERROR_OF_LOSSES) * self.power.saturating_div(energy);
        losses.max(T::constant(TIME_ERROR_OF_SLOWNESS) * square * square)
    }
}

impl<T: PhaseNodes<N>, const N: usize> Phase<T, N> {
    /// The approach to the peak that an energy reaches, with an estimate of the energy that damping takes; without the
    /// reciprocals of the speeds.
    pub(crate) fn approach<L: ContactLaw<T>>(law: &L, energy: T) -> Self {
        let zeros = [T::ZERO; N];
        let mut phase =
            Self { peak: T::ONE, free: zeros, loss: zeros, speed: zeros, half_inverse: zeros, estimate: T::ZERO };
        if law.may_have_barrier() {
            phase.peak = phase.peak - (law.potential(phase.peak) - energy) / law.slope(phase.peak);
        }
        let half_loss = |fraction| T::constant(2.0) * phase.peak * law.loss_over_square(phase.peak, fraction, false);
        let ends = (half_loss(&T::FRACTIONS[0]), half_loss(&T::FRACTIONS[N - 1]));
        for j in 0..N {
            let free = Self::free_square(law, phase.peak, &T::FRACTIONS[j]);
            let root = if law.may_have_barrier() { free.max(T::SMALLEST).sqrt() } else { free.sqrt() };
            phase.speed[j] = root + Self::gain(ends, j);
        }
        let (first, last) =
            (T::constant(FIRST_LOSS_WEIGHT) * T::END_WEIGHTS.0, T::constant(LAST_LOSS_WEIGHT) * T::END_WEIGHTS.1);
        phase.estimate = (first * ends.0 + last * ends.1) * (phase.speed[(N - 1) / 2] + phase.speed[N / 2]);
        let before = phase.peak;
        phase.correct_peak(law, energy, phase.estimate);
        // The speed goes with the root of the elastic energy, a power of the peak: two terms of its binomial series.
        let (growth, power) = ((phase.peak - before) / before, law.energy_power() / 2.0);
        let factor = T::ONE + growth * (T::constant(power) + T::constant(power * (power - 1.0) / 2.0) * growth);
        phase.describe(law, false);
        phase.speed = phase.speed.map(|speed| speed * factor);
        phase
    }

    /// From the approach to the rebound from the same peak, with an estimate of the losses; without the reciprocals of the
    /// speeds.
    pub(crate) fn turn(&mut self, law: &impl ContactLaw<T>) {
        let before = self.ends();
        self.describe(law, true);
        let after = self.ends();
        // Seen backwards, damping adds energy to the approach; it takes energy from the rebound.
        let change = (before.0 + after.0, before.1 + after.1);
        for j in 0..N {
            let speed = self.free[j] / self.speed[j] + Self::gain(change, j);
            self.speed[j] = speed.max(T::SLOWEST);
        }
    }

    /// Takes the reciprocal at the slow end, where the speed changes most.
    #[inline]
    pub(crate) fn renew_slowest(&mut self) {
        self.half_inverse[N - 1] = T::constant(0.5) / self.speed[N - 1];
    }

    /// Takes the reciprocals of the present speeds.
    #[inline]
    pub(crate) fn renew(&mut self) {
        for j in 0..N {
            self.half_inverse[j] = T::constant(0.5) / self.speed[j];
        }
    }

    /// The same at the first nodes, where a number is above another.
    #[inline]
    pub(crate) fn renew_where(&mut self, number: T, limit: T, nodes: usize) {
        if number.any_above(limit) {
            for j in 0..nodes {
                let inverse = T::constant(0.5) / self.speed[j];
                self.half_inverse[j] = number.where_above(limit, inverse, self.half_inverse[j]);
            }
        }
    }

    /// Free squares and losses for the present peak.
    pub(crate) fn describe(&mut self, law: &impl ContactLaw<T>, rebound: bool) {
        // A copy, which the compiler knows to stay the same from node to node.
        let (peak, four) = (self.peak, T::constant(if rebound { -4.0 } else { 4.0 }));
        for j in 0..N {
            let fraction = &T::FRACTIONS[j];
            self.free[j] = Self::free_square(law, peak, fraction);
            self.loss[j] = four * peak * law.loss_over_square(peak, fraction, rebound);
        }
    }

    #[inline]
    fn free_square(law: &impl ContactLaw<T>, peak: T, fraction: &Fraction<T>) -> T {
        let drop = law.potential_drop(peak, fraction);
        drop + drop
    }

    /// One iteration, with a step of Newton's method for the root at every node. Returns the energy of the losses and, if the
    /// change is `MEASURED`, the square of the change of the speeds.
    ///
    /// It multiplies by reciprocals of earlier speeds. That converges as fast as a division while the speeds change little.
    #[inline(never)]
    pub(crate) fn iterate<const MEASURED: bool>(&mut self) -> (T, T) {
        let half = T::constant(0.5);
        let mut square = self.free;
        T::add_integrals(&mut square, &self.loss, &self.speed);
        let (before, inverse) = (self.speed, self.half_inverse);
        for j in 0..N {
            // A captured sphere turns before s = 0. The floor keeps the speed positive, so that the loss exceeds the energy.
            let speed = before[j] + inverse[j] * (square[j] - before[j] * before[j]);
            self.speed[j] = speed.max(T::SLOWEST);
        }
        let (mut gained, mut change) = (T::ZERO, T::ZERO);
        for j in 0..N {
            if MEASURED {
                let step = self.speed[j] - before[j];
                change = change + step * step;
            }
            gained = gained + T::WEIGHTS[j] * self.loss[j] * self.speed[j];
        }
        (half * gained, change)
    }

    /// A step of Newton's method for the peak, where the potential and the losses add up to the energy. Returns the energy
    /// at the peak.
    #[inline]
    pub(crate) fn correct_peak(&mut self, law: &impl ContactLaw<T>, energy: T, lost: T) -> T {
        let excess = law.potential(self.peak) + lost - energy;
        // Losses are about proportional to the elastic energy.
        let growth = T::constant(law.energy_power()) * lost / self.peak;
        let step = excess / (law.slope(self.peak) + growth);
        self.peak = self.peak - step;
        energy - (lost - growth * step)
    }

    /// The unresolved parts of the losses, and of the reciprocal speed, which is smooth except near the slow end of a phase.
    ///
    /// `gained` is what the last iteration returned.
    pub(crate) fn tails(&self, gained: T) -> Tails<T> {
        let (mut power_tail, mut slowness_tail, mut slowness) = (T::ZERO, T::ZERO, T::ZERO);
        for k in 0..N {
            // As good as the reciprocal of the present speed: it is as smooth.
            let inverse = self.half_inverse[k];
            power_tail = power_tail + T::HIGHEST_COEFFICIENT[k] * (self.loss[k] * self.speed[k]);
            slowness_tail = slowness_tail + T::HIGHEST_COEFFICIENT[k] * inverse;
            slowness = slowness + T::WEIGHTS[k] * inverse;
        }
        let slowness = slowness_tail.abs().saturating_div(slowness);
        Tails { lost: gained.abs(), power: T::constant(0.5) * power_tail.abs(), slowness }
    }

    /// Whether damping is so mild that iterations converge to the solution.
    #[inline]
    pub(crate) fn is_represented(&self, strongest: f64) -> bool {
        let (drag, free) = self.drag_beside(strongest);
        drag <= free
    }

    /// Squares of the losses next to the peak over the `strongest`, and of the speed without losses there.
    #[inline]
    pub(crate) fn drag_beside(&self, strongest: f64) -> (T, T) {
        let part = T::constant(1.0 / strongest) * self.loss[0];
        (part * part, self.free[0])
    }

    /// Square of the drag, losses over the speed without losses next to the peak, up to that of the `strongest`: fixed point holds no
    /// larger one.
    #[inline]
    pub(crate) fn drag_squared(&self, strongest: f64) -> T {
        let square = self.loss[0] * self.loss[0];
        square.saturating_div(self.free[0].max(square * T::constant(1.0 / (strongest * strongest))).max(T::SMALLEST))
    }

    /// Whether the sphere moves at all nodes.
    #[inline]
    pub(crate) fn is_moving(&self) -> bool {
        self.speed.iter().all(|speed| *speed > T::SLOWEST)
    }

    /// The least speed over z at the nodes.
    #[inline]
    pub(crate) fn slowest(&self) -> T {
        self.speed.iter().fold(self.speed[0], |least, speed| least.min(*speed))
    }

    /// Half the losses at the first and the last node.
    #[inline]
    fn ends(&self) -> (T, T) {
        (T::constant(0.5) * self.loss[0], T::constant(0.5) * self.loss[N - 1])
    }

    /// Speed that losses linear in m^2 add at node j, from half their [`ends`](Self::ends): to first order, and as if the
    /// speed were the same everywhere.
    #[inline]
    fn gain((first, last): (T, T), j: usize) -> T {
        let (of_first, of_last) = T::END_INTEGRATION[j];
        first * of_first + last * of_last
    }

    /// The whole phase at Radau's nodes, for integrals along it. On approach z runs against time.
    pub(crate) fn samples<const M: usize>(&self, law: &impl ContactLaw<T>, rebound: bool) -> Interval<T, M>
    where
        T: PhaseSamples<N, M>,
    {
        let two = T::constant(2.0);
        let fractions = &<T as PhaseSamples<N, M>>::FRACTIONS;
        let mut square = [T::ZERO; M];
        for q in 0..M {
            square[q] = two * law.potential_drop(self.peak, &fractions[q]);
        }
        self.add_gains(&mut square);
        let (mut s, mut y, mut rate) = ([T::ZERO; M], [T::ZERO; M], [T::ZERO; M]);
        for q in 0..M {
            let speed = square[q].max(T::SLOWEST * T::SLOWEST).sqrt();
            s[q] = self.peak * fractions[q].value;
            y[q] = speed * <T as Nodes<M>>::Z[q];
            rate[q] = two * self.peak * law.indentation_slope(s[q]) / speed;
        }
        let (place, speed) = if rebound { (T::ZERO, y[M - 1]) } else { (self.peak, T::ZERO) };
        let end = Point { s: place, energy: T::ZERO, speed_squared: speed * speed };
        Interval { s, y, rate, end, accepted: true, error: T::ZERO, forward: rebound }
    }

    /// Adds what the losses give to the squares at Radau's nodes.
    #[inline]
    fn add_gains<const M: usize>(&self, square: &mut [T; M])
    where
        T: PhaseSamples<N, M>,
    {
        for k in 0..N {
            let power = self.loss[k] * self.speed[k];
            for q in 0..M {
                square[q] = square[q] + <T as PhaseSamples<N, M>>::INTEGRATION[k][q] * power;
            }
        }
    }

    /// Gains over z as a series of Legendre polynomials, from which [`part`](Self::part) evaluates the phase anywhere.
    pub(crate) fn gains<const M: usize>(&self) -> [T; M]
    where
        T: PhaseSamples<N, M>,
    {
        let mut gains = [T::ZERO; M];
        self.add_gains(&mut gains);
        for q in 0..M {
            gains[q] = gains[q] / <T as Nodes<M>>::Z[q];
        }
        // The integral of N powers of z under the weight, over z^3.
        coefficients(&gains, N + 4)
    }

    /// The phase between two places z, in the order of time.
    pub(crate) fn part<const M: usize>(
        &self,
        law: &impl ContactLaw<T>,
        gains: &[T; M],
        from: T,
        to: T,
    ) -> Interval<T, M>
    where
        T: PhaseSamples<N, M>,
    {
        let two = T::constant(2.0);
        let mut z = [T::ZERO; M];
        for q in 0..M {
            z[q] = from + (to - from) * <T as Nodes<M>>::Z[q];
        }
        let gained = series(gains, N + 4, &z);
        let length = (to - from).abs();
        let (mut s, mut y, mut rate) = ([T::ZERO; M], [T::ZERO; M], [T::ZERO; M]);
        for q in 0..M {
            let fraction = Fraction::new(T::ONE - z[q] * z[q]);
            let square = two * law.potential_drop(self.peak, &fraction) + z[q] * gained[q];
            let speed = square.max(T::SLOWEST * T::SLOWEST).sqrt();
            s[q] = self.peak * fraction.value;
            y[q] = speed * z[q];
            rate[q] = two * length * self.peak * law.indentation_slope(s[q]) / speed;
        }
        let end = Point { s: s[M - 1], energy: T::ZERO, speed_squared: y[M - 1] * y[M - 1] };
        Interval { s, y, rate, end, accepted: true, error: T::ZERO, forward: true }
    }
}
