//! Intervals by the profile likelihood: the values of a parameter at which the best likelihood with this value is lower than the
//! maximum by a bounded amount.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::likelihood::Likelihood;
use crate::maximum::{Maximum, maximise};

/// A value with its interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Best value.
    pub value: f64,
    /// Lower bound.
    pub low: f64,
    /// Upper bound; infinite if the data set none.
    pub high: f64,
}

impl Interval {
    /// Whether a value lies in the interval.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// The interval of a rising function.
    #[must_use]
    pub fn map(self, function: impl Fn(f64) -> f64) -> Self {
        Self { value: function(self.value), low: function(self.low), high: function(self.high) }
    }

    /// The interval of the reciprocal, times a factor.
    #[must_use]
    pub fn reciprocal(self, factor: f64) -> Self {
        Self { value: factor / self.value, low: factor / self.high, high: factor / self.low }
    }
}

/// Standard normal deviate of the bounds of 95 %.
const DEVIATE: f64 = 1.959_963_985;

/// Twice the drop of the likelihood at the bounds.
///
/// Where the scatter is known it is the quantile of chi-squared. Where scatter with `freedom` degrees is estimated from the same
/// rows, the ratio of likelihoods follows Student's t: N ln(1 + t^2/freedom). If only a part of the variance is scatter, the
/// degrees of freedom grow by Satterthwaite's formula.
#[must_use]
pub fn drop_at_bounds(rows: usize, parameters: usize, scatter_fraction: f64) -> f64 {
    let freedom = (rows.saturating_sub(parameters)).max(1) as f64 / scatter_fraction.max(0.05).powi(2);
    let Ok(student) = StudentsT::new(0.0, 1.0, freedom) else {
        return DEVIATE * DEVIATE;
    };
    let quantile = student.inverse_cdf(0.975);
    (freedom + parameters as f64) * (1.0 + quantile * quantile / freedom).ln()
}

/// Most evaluations for a bound.
const MOST_TRIES: u32 = 14;

/// The interval of a parameter. The likelihood must be at its `maximum`, which is replaced if the search finds a higher one.
pub fn interval(likelihood: &Likelihood, maximum: &mut Maximum, index: usize, drop: f64) -> Interval {
    let best = maximum.values[index];
    let low = bound(likelihood, maximum, index, drop, -1.0);
    let high = bound(likelihood, maximum, index, drop, 1.0);
    Interval { value: best, low: low.min(best), high: high.max(best) }
}

/// A bound. The root of the drop is nearly linear in the parameter, so that the secant method converges at once.
fn bound(likelihood: &Likelihood, maximum: &Maximum, index: usize, drop: f64, side: f64) -> f64 {
    let bounds = likelihood.bounds();
    let limit = if side > 0.0 { bounds[index].1 } else { bounds[index].0 };
    let best = maximum.values[index];
    let reach = (limit - best) * side;
    if reach <= 0.0 {
        return limit;
    }
    let target = drop.sqrt();
    let error = maximum.standard_error(index, &bounds).unwrap_or(0.01 * reach);
    let mut start = maximum.values.clone();
    let mut root_at = |offset: f64| {
        start[index] = best + side * offset;
        let found = maximise(likelihood, &start, Some(index))?;
        start.clone_from(&found.values);
        Some((2.0 * (maximum.value - found.value)).max(0.0).sqrt())
    };
    let (mut inside, mut outside): ((f64, f64), Option<(f64, f64)>) = ((0.0, 0.0), None);
    let mut offset = (target * error).min(reach);
    for _ in 0..MOST_TRIES {
        let Some(root) = root_at(offset) else {
            // No curve: the bound lies before.
            outside = Some((offset, 2.0 * target));
            offset = 0.5 * (inside.0 + offset);
            continue;
        };
        if (root - target).abs() < 0.01 * target {
            return best + side * offset;
        }
        if root < target {
            if offset >= reach {
                return limit;
            }
            inside = (offset, root);
        } else {
            outside = Some((offset, root));
        }
        offset = match outside {
            Some(outside) => {
                let part = (target - inside.1) / (outside.1 - inside.1);
                // Never close to an end that does not move.
                inside.0 + part.clamp(0.05, 0.95) * (outside.0 - inside.0)
            }
            None => (offset * (target / root.max(0.2 * target)).min(4.0) * 1.02).min(reach),
        };
        if let Some(outside) = outside
            && outside.0 - inside.0 < 1e-3 * error
        {
            break;
        }
    }
    best + side * offset
}
