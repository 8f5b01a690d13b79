//! Whether a law fits.
//!
//! Scatter is free, so that its size proves nothing. A law is refuted by a trend of the residuals over speed, by residuals that are
//! alike at neighbouring speeds, by rebounds and captures on the wrong side of the critical speed, and, if the errors are stated to be all of the scatter, by its size.

use fastrand::Rng;
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF, DiscreteCDF, FisherSnedecor, Poisson};

use crate::law::Coordinate;
use crate::likelihood::{Likelihood, Nuisance};
use crate::maximum::{Maximum, maximise};
use crate::scatter::normal_below;

/// Probabilities of data at least as far from the law as these, if the law is true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// By the trend of the residuals over speed.
    pub trend: f64,
    /// By how much residuals at neighbouring speeds are alike.
    pub neighbours: f64,
    /// By rebounds and captures on the wrong side of the critical speed.
    pub outcomes: f64,
    /// By the size of the residuals; `None` if the scatter is free.
    pub size: Option<f64>,
}

impl Judgement {
    /// Probability that one of the tests finds the data as far from a true law as it does (Sidak 1967).
    #[must_use]
    pub fn p_value(&self) -> f64 {
        let least = self.trend.min(self.neighbours).min(self.outcomes).min(self.size.unwrap_or(1.0));
        let tests = if self.size.is_some() { 4.0 } else { 3.0 };
        // 1 - (1 - p)^tests, without cancellation.
        -(tests * (-least).ln_1p()).exp_m1()
    }
}

/// Legendre polynomials of the trend, for few rebounds and for many.
const FEW: usize = 3;
const MANY: usize = 5;
const MANY_REBOUNDS: usize = 30;

/// A probability below which an outcome is on the wrong side of the critical speed.
const UNLIKELY: f64 = 0.02;

/// The tests of a law at its maximum.
pub fn judge(likelihood: &mut Likelihood, maximum: &Maximum, scatter_is_known: bool) -> Judgement {
    let outcomes = outcomes(likelihood, maximum);
    let size = scatter_is_known.then(|| size(likelihood, maximum));
    let neighbours = neighbours(likelihood, maximum);
    Judgement { trend: trend(likelihood, maximum), neighbours, outcomes, size }
}

/// Test of polynomials that are added to the curve.
///
/// Near the critical speed the rebound speed is no linear function of the parameters, so that the ratio of likelihoods is larger than
/// its distribution for many rows says. Where it looks unlikely, its mean is therefore found by simulation (Bartlett 1937).
fn trend(likelihood: &mut Likelihood, maximum: &Maximum) -> f64 {
    let Some(Gain { statistic, terms, freedom }) = Gain::of(likelihood, &maximum.values) else {
        return 1.0;
    };
    let p_value =
        |statistic: f64| FisherSnedecor::new(terms, freedom).map_or(1.0, |distribution| distribution.sf(statistic));
    if p_value(statistic) > DOUBTFUL {
        return p_value(statistic);
    }
    if p_value(statistic / LARGEST_MEAN) < CERTAIN {
        return p_value(statistic / LARGEST_MEAN);
    }
    let gain = |seed: u64| {
        let mut simulated = likelihood.simulated(&maximum.values, &mut Rng::with_seed(seed))?;
        Some(Gain::of(&mut simulated, &maximum.values)?.statistic)
    };
    let gains: Vec<f64> = (0..SIMULATIONS).into_par_iter().filter_map(gain).collect();
    let mean = gains.iter().sum::<f64>() / gains.len() as f64;
    p_value(statistic / mean.max(1.0))
}

/// Probability below which the distribution of the ratio is found by simulation.
const DOUBTFUL: f64 = 0.02;

/// A mean of the ratio that is never reached: the largest seen, with half of the spheres captured, is two. Where even it leaves the law
/// unlikely, there is nothing to simulate.
const LARGEST_MEAN: f64 = 4.0;
const CERTAIN: f64 = 1e-6;

/// Simulated sets: they give the mean of the ratio with an error of a tenth.
const SIMULATIONS: u64 = 50;

/// What a trend gains: the ratio of likelihoods as a statistic of Fisher's distribution with `terms` and `freedom` degrees of freedom.
struct Gain {
    statistic: f64,
    terms: f64,
    freedom: f64,
}

impl Gain {
    fn of(likelihood: &mut Likelihood, values: &[f64]) -> Option<Self> {
        let rebounds = likelihood.len() - likelihood.captures();
        let terms = if rebounds < MANY_REBOUNDS { FEW } else { MANY };
        let nuisances = likelihood.nuisances().to_vec();
        let more: Vec<Nuisance> = nuisances.iter().copied().chain((0..terms).map(Nuisance::Trend)).collect();
        let adhesion = adhesion(likelihood);
        let fraction = likelihood.scatter_fraction(values);
        likelihood.keep_steepness(true);
        let without = maximise(likelihood, values, None);
        likelihood.set_parameters(adhesion, &more);
        let start: Vec<f64> = values.iter().copied().chain((0..terms).map(|_| 0.0)).collect();
        let with = maximise(likelihood, &start, None);
        likelihood.set_parameters(adhesion, &nuisances);
        likelihood.keep_steepness(false);
        let ratio = 2.0 * (with?.value - without?.value).max(0.0);
        let (terms, parameters) = (terms as f64, start.len() as f64);
        let freedom = (rebounds as f64 - parameters).max(1.0) / fraction.max(0.05).powi(2);
        let statistic = (ratio / (freedom + parameters)).exp_m1() * freedom / terms;
        Some(Self { statistic, terms, freedom })
    }
}

/// Test of the products of residuals at neighbouring speeds: a curve of another shape makes them alike, chance does not.
fn neighbours(likelihood: &Likelihood, maximum: &Maximum) -> f64 {
    let mut residuals = likelihood.residuals_by_speed(&maximum.values);
    residuals.iter_mut().for_each(|residual| *residual = residual.clamp(-LARGEST, LARGEST));
    let count = residuals.len() as f64;
    let mean = residuals.iter().sum::<f64>() / count;
    let size = residuals.iter().map(|residual| (residual - mean).powi(2)).sum::<f64>() / count;
    // Residuals much smaller than the errors are no reason to doubt a law.
    if size.is_nan() || size < NEGLIGIBLE * NEGLIGIBLE {
        return 1.0;
    }
    let (mut sum, mut variance) = (0.0, 0.0);
    for pair in residuals.windows(2) {
        let product = (pair[0] - mean) * (pair[1] - mean);
        (sum, variance) = (sum + product, variance + product * product);
    }
    if variance > 0.0 { 1.0 - normal_below(sum / variance.sqrt()) } else { 1.0 }
}

/// Standard deviation of residuals, over that of the errors and the scatter, below which there is nothing to explain.
const NEGLIGIBLE: f64 = 0.3;

/// Largest residual that counts, so that no outlier decides.
const LARGEST: f64 = 3.0;

/// The coordinate of adhesion in use.
pub fn adhesion(likelihood: &Likelihood) -> Coordinate {
    likelihood.coordinates()[1]
}

/// Test of the number of outcomes that the law makes unlikely.
fn outcomes(likelihood: &Likelihood, maximum: &Maximum) -> f64 {
    let recorded = likelihood.captures() > 0;
    let (mut seen, mut expected) = (0_u64, 0.0);
    for (rebound, rebounds) in likelihood.rebound_probabilities(&maximum.values).into_iter().zip(likelihood.outcomes())
    {
        let (unlikely, happened) = if rebound < 0.5 { (rebound, rebounds) } else { (1.0 - rebound, !rebounds) };
        if unlikely < UNLIKELY + OUTLIERS {
            expected += unlikely;
            seen += u64::from(happened);
        }
    }
    // Where captures are not recorded, every row is a rebound, and only those that no error explains count.
    if !recorded {
        expected = expected.max(1.0);
    }
    if seen == 0 {
        return 1.0;
    }
    Poisson::new(expected.max(1e-12)).map_or(1.0, |distribution| distribution.sf(seen - 1))
}

/// Outliers may be on either side.
const OUTLIERS: f64 = 0.1;

/// Test of the sum of squared residuals.
fn size(likelihood: &Likelihood, maximum: &Maximum) -> f64 {
    let residuals: Vec<f64> = likelihood.residuals(&maximum.values).into_iter().flatten().collect();
    let freedom = residuals.len().saturating_sub(likelihood.coordinates().len()).max(1) as f64;
    let sum: f64 = residuals.iter().map(|residual| residual * residual).sum();
    ChiSquared::new(freedom).map_or(1.0, |distribution| distribution.sf(sum))
}
