//! The likelihood of one row.

use super::{Datum, Likelihood};
use crate::law::Curve;
use crate::scatter::{Part, Scatter, normal_below, normal_density};

/// Standard deviations of V over which the curve may be taken as straight: the distance to the critical speed must be larger.
const STRAIGHT: f64 = 12.0;

/// Least probability of a rebound that the likelihood is conditioned on.
const LEAST: f64 = 1e-3;

impl Likelihood {
    /// Likelihood of a row that is no outlier.
    pub(super) fn regular(
        &self,
        curve: &Curve,
        scatter: &Scatter,
        datum: &Datum,
        straight: Option<f64>,
        shift: f64,
    ) -> f64 {
        let Some((rebound, error)) = datum.rebound else {
            return self.capture(curve, scatter, datum);
        };
        let rebound = rebound - shift * datum.speed;
        let parts = scatter.parts.iter().filter(|part| part.weight > 0.0);
        let density: f64 =
            parts.map(|part| part.weight * self.rebound(curve, part, datum, straight, (rebound, error))).sum();
        if self.captures > 0 {
            return density;
        }
        // A table without captures says nothing of the spheres that were not seen again.
        density / (1.0 - self.capture(curve, scatter, datum)).max(LEAST)
    }

    /// Variance of the true approach speed. An error of the mass acts as one of the speed at which adhesion takes the same part of
    /// the energy.
    pub(super) fn approach_variance(&self, curve: &Curve, datum: &Datum) -> f64 {
        if datum.mass_error == 0.0 {
            return datum.variance;
        }
        let critical = curve.critical_speed(datum.size);
        datum.variance + (0.5 * datum.mass_error * critical * critical / datum.mean).powi(2)
    }

    /// Density of a measured rebound speed, with the scatter of one part.
    fn rebound(
        &self,
        curve: &Curve,
        part: &Part,
        datum: &Datum,
        straight: Option<f64>,
        (rebound, error): (f64, f64),
    ) -> f64 {
        let variance = self.approach_variance(curve, datum);
        let across = error + part.variance * datum.speed * datum.speed;
        let target = rebound - part.mean * datum.speed;
        if let Some(kept) = straight {
            let (square, slope) = curve.square(datum.speed, datum.size);
            if square <= 0.0 {
                return 0.0;
            }
            let steepness = if self.keep_steepness { kept } else { 0.25 * slope * slope / square };
            let total = across + steepness * variance;
            let density = normal_density(target - square.sqrt(), total);
            return density * (total / (across + kept * variance)).sqrt();
        }
        let (square, slope) = curve.square(datum.mean, datum.size);
        let deviation = variance.sqrt();
        let root = square.signum() * square.abs().sqrt();
        if square > STRAIGHT * slope * deviation || variance == 0.0 {
            let steepness = if root > 0.0 { 0.5 * slope / root } else { 0.0 };
            return normal_density(target - root, across + steepness * steepness * variance);
        }
        let (mode, width) = mode(curve, datum, variance, target, across, root);
        // The integral over rebound speeds, where the curve is smooth.
        let integrand = |w: f64| {
            let (speed, steepness) = curve.approach(w, datum.size);
            let exponent = (speed - datum.mean).powi(2) / variance + (target - w).powi(2) / across;
            steepness.abs() * (-0.5 * exponent).exp()
        };
        let sum: f64 = self
            .nodes
            .iter()
            .map(|(node, weight)| weight * integrand(mode + width * node) * (0.5 * node * node).exp())
            .sum();
        sum * width / (std::f64::consts::TAU * variance * across).sqrt()
    }

    /// Probability of a capture.
    pub(super) fn capture(&self, curve: &Curve, scatter: &Scatter, datum: &Datum) -> f64 {
        let variance = self.approach_variance(curve, datum);
        let deviation = variance.sqrt();
        let root = curve.rebound(datum.mean, datum.size);
        let (low, high) = (datum.mean - 5.0 * deviation, datum.mean + 5.0 * deviation);
        if low <= 0.0 || variance == 0.0 || root > 0.5 * datum.mean {
            return scatter.below(-root / datum.mean);
        }
        // Far on either side of the critical speed, there is nothing to integrate.
        let bound = |speed: f64| scatter.below(-curve.rebound(speed, datum.size) / speed);
        let (most, least) = (bound(low), bound(high));
        if most - least < 1e-6 {
            return 0.5 * (most + least);
        }
        // A scatter d captures below the speed at which w(V) = -d V.
        let mut captured = 0.0;
        for part in scatter.parts.iter().filter(|part| part.weight > 0.0) {
            for (node, weight) in &self.nodes {
                let scattered = part.mean + part.variance.sqrt() * node;
                let (speed, _) = curve.approach(-scattered * datum.mean, datum.size);
                captured += part.weight * weight * normal_below((speed - datum.mean) / deviation);
            }
        }
        captured
    }
}

/// The most likely rebound speed between the measured one and that of the curve, and its standard deviation.
fn mode(curve: &Curve, datum: &Datum, variance: f64, target: f64, across: f64, root: f64) -> (f64, f64) {
    let (mut low, mut high) = (target.min(root), target.max(root));
    let mut w = target.clamp(low, high);
    let mut precision = 1.0 / across;
    // Newton's method between bounds.
    for _ in 0..MOST_STEPS {
        let (speed, steepness) = curve.approach(w, datum.size);
        let gradient = (w - target) / across + (speed - datum.mean) * steepness / variance;
        precision = 1.0 / across + steepness * steepness / variance;
        if gradient > 0.0 {
            high = w;
        } else {
            low = w;
        }
        let next = w - gradient / precision;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        let step = (next - w).abs();
        w = next;
        if step * step * precision < 1e-4 {
            break;
        }
    }
    (w, 1.0 / precision.sqrt())
}

/// Steps to a mode; halving alone would come within a millionth of the bounds.
const MOST_STEPS: u32 = 20;
