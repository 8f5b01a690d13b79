//! What a measured impact says of a curve.
//!
//! With both speeds squared the curve is smooth where a capture begins: w^2 = h(x)^2 - mu b passes through zero with a finite slope. An
//! error of the approach speed moves a rebound by the rise of the curve. Both errors and the natural scatter of e give the variance of
//! w^2 about the curve. The slopes and the variance are taken at the point of the curve that is nearest to the measured one: its error is
//! not correlated with the distance from the curve, so that the estimate has no bias from errors of the approach speed (Fuller 1987).
//!
//! What several loops call is never inlined, here and in the other files of the fit: its copies would not fit the flash of a small board
//! that computes in software.

use super::MeasuredImpact;
use super::curve::Curve;
use crate::Real;
use crate::measure::NormalDistribution;

/// An impact in units of the largest speed.
#[derive(Clone, Copy)]
pub(super) struct Row<T> {
    pub(super) x: T,
    variance: T,
    /// Rebound speed and its variance; `None` for a capture.
    pub(super) rebound: Option<(T, T)>,
    /// Median mass over that of the sphere.
    pub(super) lightness: T,
}

/// A distance from the curve, and the derivatives of the curve, over the standard deviation of the distance.
pub(super) struct Distance<T> {
    pub(super) deviates: T,
    pub(super) slopes: [T; 2],
    /// One over the standard deviation, where e^2 is one.
    pub(super) unit: T,
}

/// Part of the score of an outcome, rebound or capture, near the critical speed: its derivative with respect to w^2 over the standard
/// deviation, and the information.
pub(super) struct OutcomeScore<T> {
    pub(super) score: T,
    pub(super) information: T,
    pub(super) slopes: [T; 2],
}

/// Largest ratio of masses, so that squares stay in the range of single precision. Lighter spheres are captured at any speed.
const LARGEST_RATIO: f64 = 1e6;

/// Smallest standard deviation of w^2/x^2, for speeds without errors: numbers are written with three or four digits.
const ROUNDING: f64 = 1e-6;

/// Fraction of outcomes that are on the wrong side of the critical speed for reasons other than the errors.
const WRONG: f64 = 0.1;

/// 1/sqrt(2 pi).
const DENSITY: f64 = 0.398_942_280_401_432_7;

impl<T: Real + NormalDistribution> Row<T> {
    #[inline(never)]
    pub(super) fn new(impact: &MeasuredImpact<T>, fastest: T, median_mass: T) -> Self {
        let square = |error: T| (error / fastest) * (error / fastest);
        Self {
            x: impact.approach.value / fastest,
            variance: square(impact.approach.standard_error),
            rebound: impact.rebound.map(|rebound| (rebound.value / fastest, square(rebound.standard_error))),
            lightness: (median_mass / impact.sphere.mass()).min(T::constant(LARGEST_RATIO)),
        }
    }

    /// Speed, rebound speed and lightness.
    pub(super) fn point(&self) -> (T, T, T) {
        (self.x, self.rebound.map_or(T::ZERO, |(w, _)| w.max(T::ZERO)), self.lightness)
    }

    /// Distance of e from that of a curve.
    #[inline(never)]
    pub(super) fn deviation(&self, curve: &Curve<T>) -> T {
        let (x, w, lightness) = self.point();
        (w - curve.square(x, lightness).max(T::ZERO).sqrt()).abs() / x
    }

    /// Variance of w^2 about a curve with the square `square` at a speed x, with a natural `scatter` of e.
    #[inline(never)]
    fn spread(&self, curve: &Curve<T>, x: T, square: T, across: T) -> T {
        let rise = curve.rise(x);
        let floor = (T::constant(ROUNDING) * x * x).max(T::EPSILON);
        rise * rise * self.variance
            + T::constant(4.0) * square.max(T::ZERO) * across
            + T::constant(2.0) * across * across
            + floor * floor
    }

    /// The distance of a rebound from a curve.
    #[inline(never)]
    pub(super) fn distance(&self, curve: &Curve<T>, scatter: T) -> Option<Distance<T>> {
        let (w, variance) = self.rebound?;
        let square = curve.square(self.x, self.lightness);
        let distance = w * w.abs() - square;
        let across = variance + scatter * scatter * self.x * self.x;
        let spread = self.spread(curve, self.x, square, across);
        // The nearest point of the curve.
        let shift = curve.rise(self.x) * self.variance * distance / spread;
        let x = (self.x + shift).max(T::constant(0.5) * self.x).min(T::constant(1.5) * self.x);
        let square = curve.square(x, self.lightness);
        let unit = T::ONE / self.spread(curve, x, square, across).sqrt();
        let slopes = curve.slopes(x, self.lightness).map(|slope| slope * unit);
        Some(Distance { deviates: distance * unit, slopes, unit: unit * x * x })
    }

    /// What the outcome alone says, given the measured approach speed.
    #[inline(never)]
    pub(super) fn outcome(&self, curve: &Curve<T>, scatter: T) -> OutcomeScore<T> {
        let square = curve.square(self.x, self.lightness);
        let unit = T::ONE / self.spread(curve, self.x, square, scatter * scatter * self.x * self.x).sqrt();
        let deviates = square * unit;
        let trust = T::constant(1.0 - WRONG);
        let rebounds = T::constant(0.5 * WRONG) + trust * deviates.below();
        let density = trust * T::constant(DENSITY) * (T::constant(-0.5) * deviates * deviates).exp();
        let score = if self.rebound.is_some() { density / rebounds } else { -density / (T::ONE - rebounds) };
        let information = density * density / (rebounds * (T::ONE - rebounds));
        let slopes = curve.slopes(self.x, self.lightness).map(|slope| slope * unit);
        OutcomeScore { score, information, slopes }
    }

    /// Whether the outcome contradicts the curve by more than three standard deviations of the speed.
    pub(super) fn contradicts(&self, curve: &Curve<T>, scatter: T) -> bool {
        let square = curve.square(self.x, self.lightness);
        let spread = self.spread(curve, self.x, square, scatter * scatter * self.x * self.x).sqrt();
        let margin = if self.rebound.is_some() { -square } else { square };
        margin > T::constant(CLEARLY) * spread
    }
}

/// Standard deviations beyond which an outcome contradicts the curve.
const CLEARLY: f64 = 3.0;
