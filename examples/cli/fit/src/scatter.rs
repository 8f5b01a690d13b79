//! Natural scatter of the restitution about its median: a mixture of two normal distributions.
//!
//! Repeated impacts of equal spheres differ: surfaces are rough. The scatter is often skewed, with a tail of low restitutions.

use fastrand::Rng;
use statrs::function::erf::{erfc, erfc_inv};

/// Distribution of the restitution less the curve. Its median is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Weight, mean and variance of core and tail.
    pub parts: [Part; 2],
}

/// A normal part of the scatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Weight.
    pub weight: f64,
    /// Mean.
    pub mean: f64,
    /// Variance.
    pub variance: f64,
}

impl Scatter {
    /// A core of some `variance`, and a tail of some `weight` whose mean lies by `offset` from that of the core. The standard
    /// deviation of the tail about its mean is as large as the offset, as for an exponential distribution.
    #[must_use]
    pub fn new(variance: f64, weight: f64, offset: f64) -> Self {
        let core = Part { weight: 1.0 - weight, mean: 0.0, variance };
        let tail = Part { weight, mean: offset, variance: variance + offset * offset };
        let mut scatter = Self { parts: [core, tail] };
        if weight > 0.0 && offset != 0.0 {
            let median = scatter.median();
            scatter.parts.iter_mut().for_each(|part| part.mean -= median);
        }
        scatter
    }

    /// Probability that the scatter is less than a value.
    #[must_use]
    pub fn below(&self, value: f64) -> f64 {
        self.parts.iter().map(|part| part.weight * part.below(value)).sum()
    }

    /// A random scatter.
    pub fn draw(&self, random: &mut Rng) -> f64 {
        let part = &self.parts[usize::from(random.f64() < self.parts[1].weight)];
        part.mean + part.variance.sqrt() * deviate(random)
    }

    /// Variance.
    #[must_use]
    pub fn variance(&self) -> f64 {
        let mean: f64 = self.parts.iter().map(|part| part.weight * part.mean).sum();
        let square = |part: &Part| part.weight * (part.variance + (part.mean - mean).powi(2));
        self.parts.iter().map(square).sum()
    }

    /// The median lies between the means of both parts.
    fn median(&self) -> f64 {
        let [core, tail] = self.parts;
        let (mut low, mut high) = (core.mean.min(tail.mean), core.mean.max(tail.mean));
        // Halving to the resolution of a double.
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if self.below(middle) < 0.5 {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

impl Part {
    fn below(&self, value: f64) -> f64 {
        if self.variance > 0.0 {
            normal_below((value - self.mean) / self.variance.sqrt())
        } else if value < self.mean {
            0.0
        } else {
            1.0
        }
    }
}

/// A random standard normal deviate.
pub fn deviate(random: &mut Rng) -> f64 {
    // Between zero and two, both excluded.
    -std::f64::consts::SQRT_2 * erfc_inv(2.0 * (random.f64() + f64::EPSILON).min(1.0 - f64::EPSILON))
}

/// Standard normal distribution function.
#[must_use]
pub fn normal_below(deviate: f64) -> f64 {
    0.5 * erfc(-deviate * std::f64::consts::FRAC_1_SQRT_2)
}

/// Standard normal density over a standard deviation.
#[must_use]
pub fn normal_density(deviation: f64, variance: f64) -> f64 {
    (-0.5 * deviation * deviation / variance).exp() / (std::f64::consts::TAU * variance).sqrt()
}

#[cfg(test)]
mod tests {
    use super::Scatter;

    #[test]
    fn the_median_is_zero() {
        for (weight, offset) in [(0.0, 0.0), (0.1, -0.05), (0.4, 0.2), (0.3, -1.0)] {
            let scatter = Scatter::new(1e-4, weight, offset);
            assert!((scatter.below(0.0) - 0.5).abs() < 1e-9, "{weight} {offset}");
        }
    }
}
