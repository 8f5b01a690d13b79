//! Gauss's nodes on 0..1 and the integrals that collocation needs.

use gauss_quad::GaussLegendre;

/// Nodes in rising order.
pub struct Nodes<const N: usize> {
    pub z: [f64; N],
    /// Integral from 0 to 1.
    pub weights: [f64; N],
    /// Integrals from 0 to each node: the sum over k of `integration[k][j]` f(k).
    pub integration: [[f64; N]; N],
}

impl<const N: usize> Nodes<N> {
    pub fn new() -> Self {
        let rule = GaussLegendre::new(N.try_into().expect("there are nodes"));
        let mut pairs: Vec<_> = rule.iter().map(|(x, weight)| (0.5 * (1.0 + x), 0.5 * weight)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (z, weights): ([f64; N], [f64; N]) =
            (std::array::from_fn(|j| pairs[j].0), std::array::from_fn(|j| pairs[j].1));
        let lagrange =
            |k: usize, x: f64| -> f64 { (0..N).filter(|&i| i != k).map(|i| (x - z[i]) / (z[k] - z[i])).product() };
        let integral = |k, end: f64| end * (0..N).map(|q| weights[q] * lagrange(k, end * z[q])).sum::<f64>();
        Self { z, weights, integration: std::array::from_fn(|k| std::array::from_fn(|j| integral(k, z[j]))) }
    }
}
