//! Interpolation of one variable.

use std::f64::consts::PI;

/// Number of neighbours that a local polynomial takes.
const NEIGHBOURS: usize = 6;

/// Most nodes of a grid.
const MOST: f64 = 160.0;

/// Equally spaced numbers, between which a polynomial through the nearest six interpolates: what happens far away, where a
/// function may not be smooth, does not matter.
pub(super) struct Grid {
    low: f64,
    step: f64,
    count: usize,
}

impl Grid {
    /// A grid between two numbers with at most a distance between the nodes; one node if the numbers are equal.
    pub(super) fn between([low, high]: [f64; 2], distance: f64) -> Self {
        let width = high - low;
        if width == 0.0 {
            return Self { low, step: 0.0, count: 1 };
        }
        let intervals = (width / distance).ceil().clamp(NEIGHBOURS as f64, MOST);
        Self { low, step: width / intervals, count: intervals as usize + 1 }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    pub(super) fn positions(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|index| self.low + self.step * index as f64)
    }

    /// Index of the first neighbour of a position, and the weights of the neighbours (Lagrange).
    pub(super) fn weights(&self, position: f64) -> (usize, Vec<f64>) {
        if self.count == 1 {
            return (0, vec![1.0]);
        }
        let place = ((position - self.low) / self.step).clamp(0.0, (self.count - 1) as f64);
        let first = (place as usize).saturating_sub(NEIGHBOURS / 2 - 1).min(self.count - NEIGHBOURS);
        let at = place - first as f64;
        let weight = |index: usize| {
            let others = (0..NEIGHBOURS).filter(|other| *other != index);
            others.map(|other| (at - other as f64) / (index as f64 - other as f64)).product()
        };
        (first, (0..NEIGHBOURS).map(weight).collect())
    }
}

/// The nodes of Chebyshev between two numbers.
pub(super) struct Chebyshev {
    middle: f64,
    half: f64,
    /// Sines and cosines of the angles of the nodes.
    angles: Vec<(f64, f64)>,
}

impl Chebyshev {
    /// Nodes between two numbers; one node if the numbers are equal.
    pub(super) fn between([low, high]: [f64; 2], count: usize) -> Self {
        let half = 0.5 * (high - low);
        let count = if half == 0.0 { 1 } else { count };
        let angles = (0..count).map(|index| (PI * (index as f64 + 0.5) / count as f64).sin_cos()).collect();
        Self { middle: 0.5 * (low + high), half, angles }
    }

    pub(super) fn count(&self) -> usize {
        self.angles.len()
    }

    pub(super) fn positions(&self) -> impl Iterator<Item = f64> + '_ {
        self.angles.iter().map(|(_, cosine)| self.middle + self.half * cosine)
    }

    /// Weights with which the values at the nodes make the value at a position, by the barycentric formula.
    pub(super) fn weights(&self, position: f64) -> Vec<f64> {
        if self.half == 0.0 {
            return vec![1.0];
        }
        let place = (position - self.middle) / self.half;
        if let Some(at) = self.angles.iter().position(|(_, cosine)| *cosine == place) {
            return (0..self.count()).map(|index| if index == at { 1.0 } else { 0.0 }).collect();
        }
        let signs = [1.0, -1.0].into_iter().cycle();
        let mut weights: Vec<f64> =
            self.angles.iter().zip(signs).map(|((sine, cosine), sign)| sign * sine / (place - cosine)).collect();
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        weights
    }
}
