//! How far the rows are from a curve.

use super::{Datum, Likelihood, Nuisance};
use crate::law::Curve;

impl Likelihood {
    /// Distances of the measured restitutions from a curve.
    pub fn deviations<'a>(&'a self, curve: &'a Curve) -> impl Iterator<Item = f64> + 'a {
        self.data.iter().map(|datum| {
            let measured = datum.rebound.map_or(0.0, |(rebound, _)| rebound / datum.speed);
            (measured - curve.restitution(datum.speed, datum.size)).abs()
        })
    }

    /// Residuals of the rebounds that are no outliers: normal deviates of the measured rebound speed.
    pub fn residuals(&self, values: &[f64]) -> Vec<Option<f64>> {
        let Some(curve) = self.curve(values) else {
            return vec![None; self.data.len()];
        };
        let scatter = self.scatter(values);
        let residual = |datum: &Datum| {
            let (rebound, error) = datum.rebound?;
            let (square, slope) = curve.square(datum.mean, datum.size);
            let root = square.max(0.0).sqrt();
            // Close to the critical speed the curve is steep over the whole error of the speed.
            let deviation = self.approach_variance(&curve, datum).sqrt();
            let rise = (square.max(0.0) + slope * deviation).sqrt() - root;
            let steepness = if root > 0.0 { (0.5 * slope / root * deviation).min(rise) } else { rise };
            let variance = error + steepness.powi(2) + scatter.variance() * datum.speed * datum.speed;
            Some((rebound - root) / variance.sqrt())
        };
        self.data.iter().map(residual).collect()
    }

    /// The residuals in the order of the speeds, of rows over whose error the curve is straight: elsewhere their mean is not zero.
    pub fn residuals_by_speed(&self, values: &[f64]) -> Vec<f64> {
        let rows = self.data.iter().zip(&self.straight).zip(self.residuals(values));
        let straight = rows.filter(|((_, straight), _)| straight.is_some());
        let mut pairs: Vec<(f64, f64)> = straight.filter_map(|((datum, _), own)| Some((datum.speed, own?))).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        pairs.into_iter().map(|(_, residual)| residual).collect()
    }

    /// Probability of each row that its sphere rebounds.
    pub fn rebound_probabilities(&self, values: &[f64]) -> Vec<f64> {
        let Some(curve) = self.curve(values) else {
            return vec![1.0; self.data.len()];
        };
        let (scatter, outlier) = (self.scatter(values), self.nuisance(values, Nuisance::Outlier));
        let probability = |datum: &Datum| {
            let regular = 1.0 - self.capture(&curve, &scatter, datum);
            (1.0 - outlier) * regular + outlier * self.outlier_rebound()
        };
        self.data.iter().map(probability).collect()
    }

    /// Whether each row is a rebound.
    pub fn outcomes(&self) -> impl Iterator<Item = bool> + '_ {
        self.data.iter().map(|datum| datum.rebound.is_some())
    }

    /// Part of the variance of the rebounds that is scatter.
    pub fn scatter_fraction(&self, values: &[f64]) -> f64 {
        let scatter = self.scatter(values).variance();
        let (sum, count) = self
            .error_variances()
            .fold((0.0, 0.0), |(sum, count), error| (sum + scatter / (scatter + error), count + 1.0));
        if count > 0.0 { sum / count } else { 1.0 }
    }
}
