//! Integrals with an estimate of their error.

use std::num::NonZeroUsize;

use gauss_quad::legendre::GaussLegendre;

/// Number of quantities that are integrated together.
pub(crate) const QUANTITIES: usize = 7;

/// Orders of the two rules whose difference estimates the error of an integral.
const ORDERS: [usize; 2] = [10, 14];

/// Panels with which an integral over one variable begins. Over more variables it begins with one panel.
const PANELS: usize = 3;

/// Strength of the map that moves nodes to the middle of a distribution.
const STRENGTH: f64 = 2.0;

/// Error of a panel below which it is not divided any further, for an integral over one variable, unless another is given; over two or
/// three variables it is so many times larger for each more.
pub(crate) const TOLERANCE: f64 = 2e-7;
const EASING: f64 = 10.0;

/// Number of times that a panel is halved at most. The error of a jump is below the tolerance before.
const HALVINGS: u32 = 30;

/// Integrals with the estimates of their errors.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Integrals {
    pub(crate) values: [f64; QUANTITIES],
    pub(crate) errors: [f64; QUANTITIES],
}

impl Integrals {
    /// Adds a multiple of other integrals.
    pub(crate) fn add(&mut self, weight: f64, other: &Self) {
        for index in 0..QUANTITIES {
            self.values[index] += weight * other.values[index];
            self.errors[index] += weight.abs() * other.errors[index];
        }
    }

    /// Adds the differences of the values from those of a coarser computation to the errors.
    pub(crate) fn add_differences(&mut self, coarser: &Self) {
        for index in 0..QUANTITIES {
            self.errors[index] += (self.values[index] - coarser.values[index]).abs();
        }
    }

    /// The largest difference of the values from others.
    pub(crate) fn distance(&self, other: &Self) -> f64 {
        self.values.iter().zip(other.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

/// The rule of Gauss and Legendre of an order.
pub(crate) struct Rule(GaussLegendre);

impl Rule {
    pub(crate) fn new(order: usize) -> Self {
        Self(GaussLegendre::new(NonZeroUsize::new(order).unwrap_or(NonZeroUsize::MIN)))
    }

    /// The nodes between two numbers with their weights.
    pub(crate) fn on(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        self.0.as_node_weight_pairs().iter().map(move |(node, weight)| (middle + half * node, half * weight))
    }
}

/// Adaptive integrals.
pub(crate) struct Adaptive {
    rules: [Rule; 2],
    tolerance: f64,
    panels: usize,
}

impl Adaptive {
    /// For integrals over a number of variables.
    pub(crate) fn over(variables: usize, tolerance: f64) -> Self {
        let more = i32::try_from(variables.saturating_sub(1)).unwrap_or(0);
        let panels = if more == 0 { PANELS } else { 1 };
        Self { rules: ORDERS.map(Rule::new), tolerance: tolerance * EASING.powi(more), panels }
    }

    /// Integral of a function between numbers in increasing order, at which the function may jump. Panels are halved until the
    /// two rules agree.
    ///
    /// The variable of the rules is the t in x = middle + half sinh(k t)/sinh(k): most of a distribution is in the middle.
    pub(crate) fn integral<E>(
        &self,
        breaks: &[f64],
        mut integrand: impl FnMut(f64) -> Result<Integrals, E>,
    ) -> Result<Integrals, E> {
        let [Some(low), Some(high)] = [breaks.first(), breaks.last()] else { return Ok(Integrals::default()) };
        let (middle, scale) = (0.5 * (low + high), 0.5 * (high - low) / STRENGTH.sinh());
        let mut panels = Vec::new();
        for pair in breaks.windows(2) {
            let [start, end] = [pair[0], pair[1]].map(|x| ((x - middle) / scale).asinh() / STRENGTH);
            let width = (end - start) / self.panels as f64;
            panels.extend((0..self.panels).map(|panel| (start + width * panel as f64, width, 0)));
        }
        let mut sum = Integrals::default();
        while let Some((start, width, halvings)) = panels.pop() {
            let [mut coarse, mut fine] = [Integrals::default(); 2];
            for (rule, part) in self.rules.iter().zip([&mut coarse, &mut fine]) {
                for (node, weight) in rule.on(start, start + width) {
                    let slope = scale * STRENGTH * (STRENGTH * node).cosh();
                    part.add(weight * slope, &integrand(middle + scale * (STRENGTH * node).sinh())?);
                }
            }
            if fine.distance(&coarse) > self.tolerance && halvings < HALVINGS {
                let half = 0.5 * width;
                panels.extend([(start, half, halvings + 1), (start + half, half, halvings + 1)]);
                continue;
            }
            fine.add_differences(&coarse);
            sum.add(1.0, &fine);
        }
        Ok(sum)
    }
}
