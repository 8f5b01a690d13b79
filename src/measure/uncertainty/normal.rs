//! The standard normal distribution.

use crate::Real;

/// Number of standard errors beyond which an outcome or a motion is certain: the probability of the other is 3e-4.
pub(super) const CERTAIN: f64 = 3.4;

/// Probability that a standard normal variable is below `x`, with an error of 1e-7, and its density there. Both are for an `x`
/// that is not beyond certainty.
///
/// Both take one exponential function (Hastings 1955; Abramowitz and Stegun 26.2.17), where `erfc` takes two more.
pub(super) fn normal<T: Real>(x: T) -> (T, T) {
    const SCALE: f64 = 0.231_641_9;
    const COEFFICIENTS: [f64; 5] = [1.330_274_429, -1.821_255_978, 1.781_477_937, -0.356_563_782, 0.319_381_530];
    let density = density(x);
    let t = T::ONE / (T::ONE + T::constant(SCALE) * x.abs());
    let tail = density * COEFFICIENTS.iter().fold(T::ZERO, |sum, c| (sum + T::constant(*c)) * t);
    (if x < T::ZERO { tail } else { T::ONE - tail }, density)
}

/// Density of a standard normal variable, with an error of 1e-7: the series of exp(-x^2/32), and its 16th power.
fn density<T: Real>(x: T) -> T {
    const FRAC_1_SQRT_2PI: f64 = 0.398_942_280_401_432_7;
    const SERIES: [f64; 5] = [-1.0 / 120.0, 1.0 / 24.0, -1.0 / 6.0, 0.5, -1.0];
    let part = x * x * T::constant(1.0 / 32.0);
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
