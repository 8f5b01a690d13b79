//! Integrals over the ratio of the speed to the critical speed.

use super::normal::{CERTAIN, LARGEST_CURVATURE, normal};
use crate::Real;

/// Largest score, far beyond certainty.
const LARGEST_SCORE: f64 = 1e3;

/// Largest change of a score between two edges. The square of this number is well within the digits of f32.
const LARGEST_STEP: f64 = 100.0;

/// Change of a score between two edges below which closed forms lose digits.
const FLAT: f64 = 0.3;

/// The distribution of the excess slip in one direction: mean, standard error, and a sixth of the skewness.
#[derive(Clone, Copy)]
pub(super) struct Score<T> {
    mean: T,
    error: T,
    skew: T,
}

impl<T: Real> Score<T> {
    pub(super) fn new(mean: T, variance: T, third: T) -> Self {
        let error = variance.max(T::ZERO).sqrt();
        let bound = T::constant(LARGEST_CURVATURE);
        let cube = variance * error;
        let skew = if cube > T::ZERO { (third / T::constant(6.0)).saturating_div(cube) } else { T::ZERO };
        Self { mean, error, skew: skew.max(-bound).min(bound) }
    }

    /// The score: the mean divided by the standard error, where the error is at least `least`.
    fn value(&self, least: T) -> T {
        let largest = T::constant(LARGEST_SCORE);
        let error = self.error.max(least);
        if self.mean.abs() >= largest * error {
            return if self.mean > T::ZERO { largest } else { -largest };
        }
        self.mean / error
    }

    /// Probability of sliding in this direction (Edgeworth 1905).
    pub(super) fn probability(&self) -> T {
        let [probability, ..] = self.integrals(self.value(T::ZERO));
        probability
    }

    /// Probability that the excess slip is positive for the score `x`, and its first and second integral over x.
    fn integrals(&self, x: T) -> [T; 3] {
        let certain = T::constant(CERTAIN);
        let (below, density) = if x <= -certain {
            (T::ZERO, T::ZERO)
        } else if x >= certain {
            (T::ONE, T::ZERO)
        } else {
            normal(x)
        };
        let (half, skew) = (T::constant(0.5), self.skew);
        [
            below + skew * (x * x - T::ONE) * density,
            x * below + density - skew * x * density,
            half * ((x * x + T::ONE) * below + x * density) + skew * density,
        ]
    }
}

/// The integrand at an edge of a panel.
pub(super) struct Edge<T> {
    /// Coordinate in which the score is nearly linear.
    pub(super) position: T,
    /// Probability of a smaller zeta.
    pub(super) below: T,
    /// Density of the coordinate.
    pub(super) density: T,
    /// Value of the score, probability of sliding and its integrals, for both directions of the slip.
    pub(super) sliding: [(Score<T>, T, [T; 3]); 2],
}

impl<T: Real> Edge<T> {
    pub(super) fn new(zeta: T, position: T, stretch: T, scores: [Score<T>; 2]) -> Self {
        let (below, density) = normal(zeta);
        let sliding = scores.map(|score| {
            let value = score.value(T::ZERO);
            (score, value, score.integrals(value))
        });
        Self { position, below, density: density * stretch, sliding }
    }

    /// Integral of the probability of sliding between this edge and the next one.
    ///
    /// Between the edges, the score is linear, and so is the density of the position. The integral is exact for any slope of
    /// the score, so that steps of the probability are integrated too.
    pub(super) fn panel(&self, next: &Self, bends: &mut [Bend<T>; 2]) -> T {
        let (half, twelfth, certain) = (T::constant(0.5), T::constant(1.0 / 12.0), T::constant(CERTAIN));
        let width = next.position - self.position;
        let inverse_width = if width == T::ZERO { T::ZERO } else { T::ONE / width };
        let mass = next.below - self.below;
        // First moment about the middle.
        let tilt = (next.density - self.density) * width * width * twelfth;
        let mut sum = T::ZERO;
        for ((start, end), bend) in self.sliding.iter().zip(&next.sliding).zip(bends) {
            let (mut start, mut end) = (*start, *end);
            // With a very small error, the probability is a step where the mean is zero. The mean is linear too.
            let least = (end.0.mean - start.0.mean).abs() * T::constant(1.0 / LARGEST_STEP);
            for (score, value, integrals) in [&mut start, &mut end] {
                if score.error < least {
                    *value = score.value(least);
                    *integrals = score.integrals(*value);
                }
            }
            let ((_, x, [start, first, second]), (_, next_x, [end, next_first, next_second])) = (start, end);
            let step = next_x - x;
            let sag = bend.sag(step * inverse_width, step, width);
            let alike = step.abs() < T::constant(FLAT) || x.min(next_x) >= certain || x.max(next_x) <= -certain;
            let (mean, slope, density) = if alike {
                let density = if x.abs() < certain { normal(half * (x + next_x)).1 } else { T::ZERO };
                (half * (start + end), (end - start) * inverse_width, density)
            } else {
                let moment = half * step * (first + next_first) - (next_second - second);
                let slope = T::constant(12.0) * moment / (step * step) * inverse_width;
                ((next_first - first) / step, slope, (end - start) / step)
            };
            sum = sum + mass * (mean - sag * density) + tilt * slope;
        }
        sum
    }
}

/// The slope of a score in the panel before, and the width of that panel; zero before the first one.
#[derive(Clone, Copy)]
pub(super) struct Bend<T> {
    pub(super) slope: T,
    pub(super) width: T,
}

impl<T: Real> Bend<T> {
    /// Mean distance of the score below its chord in a panel, by the difference of the slopes.
    pub(super) fn sag(&mut self, slope: T, step: T, width: T) -> T {
        let last = *self;
        *self = Self { slope, width };
        if last.width == T::ZERO {
            return T::ZERO;
        }
        let curvature = (self.slope - last.slope) / (last.width + width);
        let limit = T::constant(0.1) * step.abs();
        (curvature * width * width * T::constant(1.0 / 6.0)).max(-limit).min(limit)
    }
}

/// Distances in zeta of the edges of panels from the critical speed.
pub(super) const REBOUND_EDGES: [f64; 12] = [0.16, 0.64, 1.3, 2.0, 2.7, 3.4, 4.1, 4.8, 5.5, 6.2, 7.0, 9.0];

/// The same from the critical speed downwards.
pub(super) const CAPTURE_EDGES: [f64; 9] = [0.8, 1.6, 2.4, 3.2, 4.0, 5.0, 6.0, 7.0, 9.0];

/// Integral of the probability of sliding over panels, from `start` to where zeta is certain in the direction of `sign`.
pub(super) fn integral<T: Real>(start: T, sign: T, distances: &[f64], edge_at: impl Fn(T) -> Edge<T>) -> T {
    let largest = T::constant(CERTAIN) - sign * start;
    let (mut edge, mut edge_distance) = (edge_at(start), T::ZERO);
    let mut bends = [Bend { slope: T::ZERO, width: T::ZERO }; 2];
    let mut sum = T::ZERO;
    for distance in distances {
        if edge_distance >= largest {
            break;
        }
        let distance = T::constant(*distance).min(largest);
        let next = edge_at(start + sign * distance);
        sum = sum + edge.panel(&next, &mut bends);
        (edge, edge_distance) = (next, distance);
    }
    sign * sum
}
