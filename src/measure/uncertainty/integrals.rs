//! Probabilities from the expansions.

use super::Uncertain;
use super::excess::{Excess, Zeta};
use super::expansion::{Expanded, REBOUNDS, absolute, relative, squares};
use super::normal::{CERTAIN, Cut, LARGEST_CURVATURE, normal, quantile};
use super::panels::{CAPTURE_EDGES, Edge, REBOUND_EDGES, TAIL, integral};
use crate::{Outcome, Real};

/// Rebounds for which the stopped slip is computed: the square root of the part of the energy that remains, without the loss of
/// the material. The last one is that of 1.25 times the critical speed.
pub(super) const REMAINDERS: [f64; REBOUNDS] = [0.15, 0.6];

/// The middle, where the stopped slip without deviations is computed too: it is a parabola, and its derivatives are linear.
pub(super) const MIDDLE: f64 = 0.5 * (REMAINDERS[0] + REMAINDERS[1]);

/// Distance of a bound, in standard errors, from which on it has no effect: the probability to be beyond is 2e-3.
const BEYOND: f64 = 2.9;

/// Square root of the part of the energy that remains at a multiple of the critical speed, without the loss of the material.
pub(super) fn remainder<T: Real>(multiple: T) -> T {
    let held = T::ONE / multiple;
    (T::ONE - held * held).max(T::ZERO).sqrt()
}

/// Inverse of [`remainder`].
pub(super) fn multiple<T: Real>(remainder: T) -> T {
    T::ONE / (T::ONE - remainder * remainder).sqrt()
}

impl<T: Real, const N: usize> Expanded<T, N> {
    /// The variable zeta, its value at the critical speed, and the standard error of the ratio of the speeds.
    pub(super) fn zeta(&self) -> (Zeta<T, N>, T, T) {
        let Self { ratio, speeds, .. } = self;
        let square = squares(&speeds.linear);
        let error = (square + T::constant(2.0) * squares(&speeds.square)).sqrt();
        let at_critical = relative(T::ONE, *ratio) - speeds.mean;
        let limit = T::constant(CERTAIN);
        let none = [T::ZERO; N];
        if square <= T::ZERO || at_critical.abs() >= T::constant(2.0) * limit * error {
            let critical = if at_critical > T::ZERO { limit } else { -limit };
            return (Zeta { direction: none, bend: none, curvature: T::ZERO }, critical, error);
        }
        let root = square.sqrt();
        let direction = speeds.linear.map(|part| part / root);
        let bend = speeds.square.map(|part| part / error);
        let bound = T::constant(LARGEST_CURVATURE);
        let curvature = direction.iter().zip(&bend).fold(T::ZERO, |sum, (beta, bend)| sum + *beta * *beta * *bend);
        let curvature = curvature.max(-bound).min(bound);
        let critical = quantile(at_critical / error, curvature).max(-limit).min(limit);
        (Zeta { direction, bend, curvature }, critical, error)
    }

    /// Probabilities of a rebound, and of sliding together with rebound and with capture; with a `cut`, together with an input
    /// within its bound.
    pub(super) fn probabilities(&self, cut: Option<&Cut<T>>) -> [T; 3] {
        let measure = |zeta: T| cut.map_or_else(|| normal(zeta), |cut| cut.normal(zeta));
        let (certain, tail) = (T::constant(CERTAIN), T::constant(TAIL));
        let towards = |sign: T| {
            let end = cut.map_or(certain, |cut| cut.certain(sign));
            (sign, end, if end < certain { T::ZERO } else { tail })
        };
        let (variable, critical, error) = self.zeta();
        let excess = Excess::new(&variable, &self.slip, &self.mixed);
        let ratio_at = |zeta: T| {
            let step = zeta + variable.curvature * (zeta * zeta - T::ONE);
            let speed = self.speeds.mean + error * step;
            let ratio = absolute(speed, self.ratio);
            let two = T::constant(2.0);
            // d ratio/d speed is (ratio + reference)^2/(4 reference).
            let sum = ratio + self.ratio;
            let slope = sum * sum * T::constant(0.25) / self.ratio * error * (T::ONE + two * variable.curvature * zeta);
            (ratio, slope)
        };
        let [a, b, captured] = self.stopped.map(|stopped| stopped.map(|stopped| excess.moments(&stopped)));
        let (mut both, mut other) = (T::ZERO, T::ZERO);
        if let (Some(a), Some(b)) = (a, b) {
            let [p, _] = REMAINDERS.map(T::constant);
            both = integral(critical, towards(T::ONE), &REBOUND_EDGES, |zeta| {
                let (ratio, slope) = ratio_at(zeta);
                let x = remainder(ratio.max(T::ONE));
                let part = (x - p) * T::constant(1.0 / (REMAINDERS[1] - REMAINDERS[0]));
                let mut moments = a;
                for (a, b) in moments.iter_mut().zip(b) {
                    *a = *a + part * (b - *a);
                }
                let [value, ..] = &mut moments;
                *value = *value * (T::ONE + self.stopped_bend * part * (T::ONE - part));
                // The score is nearly linear in x, which rises as a root: d zeta/d x = ratio^3 x/(d ratio/d zeta).
                let stretch = (ratio * ratio * ratio * x).saturating_div(slope.max(T::SMALLEST));
                let (position, stretch) = if error > T::ZERO { (x, stretch) } else { (zeta, T::ONE) };
                Edge::new(measure(zeta), position, stretch, excess.scores(zeta, moments))
            });
        }
        if let Some(captured) = captured {
            other = integral(critical, towards(-T::ONE), &CAPTURE_EDGES, |zeta| {
                Edge::new(measure(zeta), zeta, T::ONE, excess.scores(zeta, captured))
            });
        }
        let inside = cut.map_or(T::ONE, Cut::inside);
        [inside - measure(critical).0, both, other]
    }

    /// The probabilities if the outcome is the same for all deviations.
    pub(super) fn certain(&self, outcome: Outcome) -> [T; 3] {
        let variable = Zeta { direction: [T::ZERO; N], bend: [T::ZERO; N], curvature: T::ZERO };
        let excess = Excess::new(&variable, &self.slip, &self.mixed);
        let [stopped, ..] = self.stopped;
        let sliding = stopped.map_or(T::ZERO, |stopped| {
            let [up, down] = excess.scores(T::ZERO, excess.moments(&stopped));
            up.probability() + down.probability()
        });
        if outcome == Outcome::Rebound { [T::ONE, sliding, T::ZERO] } else { [T::ZERO, T::ZERO, sliding] }
    }
}

/// A weight, and the mean, the standard error and a sixth of the skewness of a deviation.
type Node<T> = (T, [T; 3]);

/// Deviations that take the place of a normal one with a bound at this distance: those within the bound, and the bound itself.
fn within<T: Real>(distance: T) -> [Node<T>; 2] {
    let (inside, density) = normal(distance);
    let mean = T::ZERO - density / inside;
    let variance = T::ONE + distance * mean - mean * mean;
    // Third central moment.
    let third = mean * (distance * distance - T::ONE - mean * (T::constant(3.0) * distance - T::constant(2.0) * mean));
    let spread = variance.max(T::ZERO).sqrt();
    let skew = third / (T::constant(6.0) * variance * spread);
    [(inside, [mean, spread, skew]), (T::ONE - inside, [distance, T::ZERO, T::ZERO])]
}

/// Part of the variance of the ratio of the speeds from which on one input dominates. The ratio is then bounded like this
/// input, which is far from normal: what is inside the bound is integrated with the part of zeta that this leaves.
const DOMINANT: f64 = 0.9;

/// Takes the bounds of the inputs into account: beyond its bound, an input has the value of the bound.
///
/// Each bound is treated as if it were the only one.
pub(super) fn bounded<T: Real, const N: usize>(
    inputs: &[Uncertain<T>; N],
    expanded: &Expanded<T, N>,
    probabilities: impl Fn(&Expanded<T, N>, Option<&Cut<T>>) -> [T; 3],
) -> [T; 3] {
    let (mut sum, mut unbounded) = ([T::ZERO; 3], T::ONE);
    let mut add = |weight: T, expanded: &Expanded<T, N>, cut: Option<&Cut<T>>| {
        for (sum, part) in sum.iter_mut().zip(probabilities(expanded, cut)) {
            *sum = *sum + weight * part;
        }
    };
    let square = squares(&expanded.speeds.linear);
    let (_, critical, _) = expanded.zeta();
    for ((input, uncertain), linear) in inputs.iter().enumerate().zip(expanded.speeds.linear) {
        let [low, high] = uncertain.bounds;
        for (sign, distance) in [(-T::ONE, low), (T::ONE, high)] {
            if distance >= T::constant(BEYOND) {
                continue;
            }
            unbounded = unbounded - T::ONE;
            let mut add_node = |(weight, [mean, spread, skew]): Node<T>| {
                add(weight, &expanded.with(input, [sign * mean, spread, sign * skew]), None);
            };
            let [inside, at_bound] = within(distance);
            add_node(at_bound);
            if linear != T::ZERO && linear * linear >= T::constant(DOMINANT) * square {
                add(T::ONE, expanded, Some(&Cut::new(distance, sign * linear / square.sqrt(), critical)));
            } else {
                add_node(inside);
            }
        }
    }
    if unbounded != T::ZERO {
        add(unbounded, expanded, None);
    }
    sum
}
