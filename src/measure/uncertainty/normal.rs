//! The standard normal distribution.

use crate::Real;

/// Number of standard errors beyond which an outcome or a motion is certain: the probability of the other is 3e-4.
pub(super) const CERTAIN: f64 = 3.4;

/// 1/sqrt(2 pi)
const FRAC_1_SQRT_2PI: f64 = 0.398_942_280_401_432_7;

/// Probability that a standard normal variable is below `x`, with an error of 1e-7, and its density there. Both are for an `x`
/// that is not beyond certainty.
///
/// Both take one exponential function (Hastings 1955; Abramowitz and Stegun 26.2.17), where `erfc` takes two more.
pub(super) fn normal<T: Real>(x: T) -> (T, T) {
    const SCALE: f64 = 0.231_641_9;
    const COEFFICIENTS: [f64; 5] = [1.330_274_429, -1.821_255_978, 1.781_477_937, -0.356_563_782, 0.319_381_530];
    let density = density(x * x);
    let t = T::ONE / (T::ONE + T::constant(SCALE) * x.abs());
    let tail = density * COEFFICIENTS.iter().fold(T::ZERO, |sum, c| (sum + T::constant(*c)) * t);
    (if x < T::ZERO { tail } else { T::ONE - tail }, density)
}

/// Density of a standard normal variable with this `square` x^2, with an error of 1e-7: the series of exp(-x^2/32), and its 16th power.
fn density<T: Real>(square: T) -> T {
    const SERIES: [f64; 5] = [-1.0 / 120.0, 1.0 / 24.0, -1.0 / 6.0, 0.5, -1.0];
    let part = square * T::constant(1.0 / 32.0);
    let root = T::ONE + SERIES.iter().fold(T::ZERO, |sum, c| (sum + T::constant(*c)) * part);
    let power = (0..4).fold(root, |power, _| power * power);
    T::constant(FRAC_1_SQRT_2PI) * power
}

/// Largest curvature of zeta, and largest skewness divided by six. With it, x + curvature (x^2 - 1) increases up to certainty.
pub(super) const LARGEST_CURVATURE: f64 = 0.14;

/// The normal variable x for which x + curvature (x^2 - 1) is `value`.
pub(super) fn quantile<T: Real>(value: T, curvature: T) -> T {
    let shifted = value + curvature;
    let root = (T::ONE + T::constant(4.0) * curvature * shifted).max(T::ZERO).sqrt();
    T::constant(2.0) * shifted / (T::ONE + root)
}

/// Points of Gauss and Legendre between 0 and 1, and their weights.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Least standard error of the bounded variable at a given zeta. With a smaller one, the bound is a step in zeta; this one is
/// narrow beside the panels of the integrals.
const LEAST_SPREAD: f64 = 0.02;

/// Distance from the bound that counts as none, where integrals end: less than they can be short.
const AT_END: f64 = 1e-3;

/// Square beyond which the density is zero: 4e-8 of the largest.
const LARGEST_SQUARE: f64 = 34.0;

/// The part of the distribution of zeta in which another normal variable is below a bound. Their correlation is strong.
pub(super) struct Cut<T> {
    /// The bound; that in the direction of zeta if the correlation is negative.
    at: T,
    opposite: bool,
    correlation: T,
    spread: T,
    /// Whether integrals end at the bound.
    ends: bool,
    /// For each point the weight, and what multiplies the square of the distance and the product of zeta and the bound.
    points: [[T; 3]; GAUSS.len()],
}

impl<T: Real> Cut<T> {
    /// At a `bound` of the other variable, by its `correlation` with zeta, for integrals from a `critical` zeta on.
    pub(super) fn new(bound: T, correlation: T, critical: T) -> Self {
        let opposite = correlation < T::ZERO;
        let correlation = correlation.abs().min(T::ONE);
        let spread = (T::ONE - correlation * correlation).max(T::ZERO).sqrt().max(T::constant(LEAST_SPREAD));
        let points = GAUSS.map(|(place, weight)| {
            let sine = spread * T::constant(place);
            let cosine = (T::ONE - sine * sine).sqrt();
            // The density takes the square, twice the exponent, and has 1/sqrt(2 pi) in it.
            let weight = spread * T::constant(weight * FRAC_1_SQRT_2PI) / cosine;
            [weight, T::ONE / (sine * sine), T::constant(2.0) / (T::ONE + cosine)]
        });
        let at = if opposite { -bound } else { bound };
        let ends = if opposite { critical - at } else { at - critical } > spread;
        Self { at, opposite, correlation, spread, ends, points }
    }

    /// Probability of a smaller zeta together with a variable below the bound, and the derivative of this probability.
    ///
    /// The distribution of two variables with a correlation r is that of r = 1 less an integral over r (Drezner and Wesolowsky
    /// 1990), here over the sine of the angle whose cosine is r.
    pub(super) fn normal(&self, zeta: T) -> (T, T) {
        let (below, density) = normal(zeta);
        let distance = zeta - self.at;
        if self.ends && distance.abs() < T::constant(AT_END) {
            return (if self.opposite { T::ZERO } else { below }, density);
        }
        let less = self.points.iter().fold(T::ZERO, |sum, [weight, of_distance, of_product]| {
            let square = distance * distance * *of_distance + zeta * self.at * *of_product;
            sum + *weight * bounded_density(square)
        });
        let both = if distance < T::ZERO { below } else { normal(self.at).0 } - less;
        let limit = T::constant(CERTAIN);
        let score = ((self.at - self.correlation * zeta) / self.spread).max(-limit).min(limit);
        let part = normal(score).0;
        if self.opposite { (below - both, density * (T::ONE - part)) } else { (both, density * part) }
    }

    /// Where an integral from the `critical` zeta in the direction of `sign` ends: at the bound, to whose mass that of the few zeta
    /// beyond it is added, unless it begins there.
    pub(super) fn certain(&self, sign: T) -> T {
        let limit = T::constant(CERTAIN);
        if self.opposite != (sign < T::ZERO) {
            return limit;
        }
        let blur = if self.ends { T::ZERO } else { limit * self.spread };
        (sign * self.at + blur).min(limit)
    }

    /// Probability that the variable is below the bound.
    pub(super) fn inside(&self) -> T {
        let below = normal(self.at).0;
        if self.opposite { T::ONE - below } else { below }
    }
}

/// The density, zero where it is too small for its series.
fn bounded_density<T: Real>(square: T) -> T {
    if square < T::constant(LARGEST_SQUARE) { density(square.max(T::ZERO)) } else { T::ZERO }
}
