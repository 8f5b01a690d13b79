//! Integrals over the ratio of the speed to the critical speed.

use super::normal::{CERTAIN, LARGEST_CURVATURE, normal};
use crate::Real;

/// Largest score, far beyond certainty.
const LARGEST_SCORE: f64 = 1e3;

/// Largest change of a score between two edges. The square of this number is well within the digits of f32.
const LARGEST_STEP: f64 = 100.0;

/// Change of a score between two edges below which closed forms lose digits.
const FLAT: f64 = 0.3;

/// The distribution of the excess slip in one direction: mean, variance and third cumulant.
#[derive(Clone, Copy)]
pub(super) struct Score<T> {
    pub(super) mean: T,
    pub(super) variance: T,
    pub(super) third: T,
}

impl<T: Real> Score<T> {
    /// Probability of sliding in this direction (Edgeworth 1905).
    pub(super) fn probability(self) -> T {
        let [probability, ..] = Sliding::new(self, T::ZERO).integrals;
        probability
    }
}

/// What a score says about sliding.
#[derive(Clone, Copy)]
struct Sliding<T> {
    mean: T,
    variance: T,
    /// The score: the mean divided by the standard error. The largest if the probability is certain.
    value: T,
    /// Probability that the excess slip is positive, and its first and second integral over the score.
    integrals: [T; 3],
}

impl<T: Real> Sliding<T> {
    /// The standard error is at least `least`.
    fn new(Score { mean, variance, third }: Score<T>, least: T) -> Self {
        let error = variance.sqrt().max(least);
        let largest = T::constant(LARGEST_SCORE);
        let x = if mean.abs() < largest * error { mean / error } else { with_sign(largest, mean) };
        let (below, density) = if x.abs() < T::constant(CERTAIN) {
            normal(x)
        } else {
            (if x > T::ZERO { T::ONE } else { T::ZERO }, T::ZERO)
        };
        let bound = T::constant(LARGEST_CURVATURE);
        let cube = variance * error;
        let skew = if cube > T::ZERO { (third * T::constant(1.0 / 6.0)).saturating_div(cube) } else { T::ZERO };
        let skewed = skew.max(-bound).min(bound) * density;
        let first = x * below + density;
        let second = T::constant(0.5) * (x * first + below) + skewed;
        let integrals = [below + skewed * (x * x - T::ONE), first - skewed * x, second];
        Self { mean, variance, value: x, integrals }
    }

    /// Without the integrals if the probability is certain.
    fn at_edge(score: Score<T>) -> Self {
        let Score { mean, variance, .. } = score;
        if mean * mean < T::constant(CERTAIN * CERTAIN) * variance {
            return Self::new(score, T::ZERO);
        }
        Self { mean, variance, value: with_sign(T::constant(LARGEST_SCORE), mean), integrals: [T::ZERO; 3] }
    }

    /// The same with a standard error of at least `least`, and with the integrals.
    fn blurred(&self, least: T) -> Self {
        if self.is_certain() || self.variance < least * least {
            // The skewness of a step does not matter.
            return Self::new(Score { mean: self.mean, variance: self.variance, third: T::ZERO }, least);
        }
        *self
    }

    fn is_certain(&self) -> bool {
        self.value.abs() >= T::constant(LARGEST_SCORE)
    }
}

/// The number or its negative, with the sign of another number.
fn with_sign<T: Real>(number: T, sign: T) -> T {
    if sign > T::ZERO { number } else { -number }
}

/// The integrand at an edge of a panel.
pub(super) struct Edge<T> {
    /// Coordinate in which the score is nearly linear.
    position: T,
    /// Probability of a smaller zeta.
    below: T,
    /// Density of the coordinate.
    density: T,
    /// Both directions of the slip.
    sliding: [Sliding<T>; 2],
}

impl<T: Real> Edge<T> {
    pub(super) fn new((below, density): (T, T), position: T, stretch: T, scores: [Score<T>; 2]) -> Self {
        Self { position, below, density: density * stretch, sliding: scores.map(Sliding::at_edge) }
    }

    /// Integral of the probability of sliding between this edge and the next one.
    ///
    /// Between the edges, the score is linear, and so is the density of the position. The integral is exact for any slope of
    /// the score, so that steps of the probability are integrated too.
    fn panel(&self, next: &Self, bends: &mut [Bend<T>; 2]) -> T {
        let (half, twelfth) = (T::constant(0.5), T::constant(1.0 / 12.0));
        let width = next.position - self.position;
        let inverse_width = if width == T::ZERO { T::ZERO } else { T::ONE / width };
        let mass = next.below - self.below;
        // First moment about the middle, divided by the width.
        let tilt = (next.density - self.density) * width * twelfth;
        let mut sum = T::ZERO;
        for ((start, end), bend) in self.sliding.iter().zip(&next.sliding).zip(bends) {
            let slides = end.mean > T::ZERO;
            if start.is_certain() && end.is_certain() && (start.mean > T::ZERO) == slides {
                sum = sum + if slides { mass } else { T::ZERO };
                bend.width = T::ZERO;
                continue;
            }
            // With a very small error, the probability is a step where the mean is zero. The mean is linear too.
            let least = (end.mean - start.mean).abs() * T::constant(1.0 / LARGEST_STEP);
            let (start, end) = (start.blurred(least), end.blurred(least));
            let ([below, first, second], [next_below, next_first, next_second]) = (start.integrals, end.integrals);
            let (step, rise) = (end.value - start.value, next_below - below);
            let sag = bend.sag(step, inverse_width, width);
            let (mean, slope) = if step.abs() < T::constant(FLAT) {
                (half * (below + next_below), rise)
            } else {
                let moment = half * step * (first + next_first) - (next_second - second);
                ((next_first - first) / step, T::constant(12.0) * moment / (step * step))
            };
            sum = sum + mass * (mean - sag * rise) + tilt * slope;
        }
        sum
    }
}

/// The slope of a score in the panel before, and the width of that panel; zero before the first one.
#[derive(Clone, Copy)]
struct Bend<T> {
    slope: T,
    width: T,
}

impl<T: Real> Bend<T> {
    /// Mean distance of the score below its chord in a panel, as a part of its `step`, by the difference of the slopes.
    fn sag(&mut self, step: T, inverse_width: T, width: T) -> T {
        let last = *self;
        *self = Self { slope: step * inverse_width, width };
        if last.width == T::ZERO || step == T::ZERO {
            return T::ZERO;
        }
        let curvature = (self.slope - last.slope) / (last.width + width);
        let limit = T::constant(0.1) * step.abs();
        (curvature * width * width * T::constant(1.0 / 6.0)).max(-limit).min(limit) / step
    }
}

/// Distances in zeta of the edges of panels from the critical speed.
pub(super) const REBOUND_EDGES: [f64; 6] = [0.2, 0.8, 1.8, 3.0, 4.8, 9.0];

/// The same from the critical speed downwards.
pub(super) const CAPTURE_EDGES: [f64; 4] = [1.2, 2.6, 4.4, 9.0];

/// Distance from the end within which the panel that begins there is the last one, where little of the probability is there.
pub(super) const TAIL: f64 = 1.6;

/// Integral of the probability of sliding over panels, from `start` to where zeta is `certain` in the direction of `sign`. A panel
/// that begins within the `tail` is the last one.
pub(super) fn integral<T: Real>(
    start: T,
    (sign, certain, tail): (T, T, T),
    distances: &[f64],
    edge_at: impl Fn(T) -> Edge<T>,
) -> T {
    let largest = certain - sign * start;
    if largest <= T::ZERO {
        return T::ZERO;
    }
    let (mut edge, mut edge_distance) = (edge_at(start), T::ZERO);
    let mut bends = [Bend { slope: T::ZERO, width: T::ZERO }; 2];
    let mut sum = T::ZERO;
    for distance in distances {
        if edge_distance >= largest {
            break;
        }
        let distance = if edge_distance >= largest - tail { largest } else { T::constant(*distance).min(largest) };
        let next = edge_at(start + sign * distance);
        sum = sum + edge.panel(&next, &mut bends);
        (edge, edge_distance) = (next, distance);
    }
    sign * sum
}
