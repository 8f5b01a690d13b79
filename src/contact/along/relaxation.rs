//! Decay towards a moving balance, however fast: u' = f - g u over an interval, for a spin that a peeling moment slows.
//!
//! Where the decay is slow, variation of constants gives u from two integrals; where it is fast, its exponentials are no
//! polynomials and overflow. Collocation at Radau's nodes in the order of time holds for any decay: what decays within less than
//! a node's distance is gone at the next node.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use crate::contact::solve::interval::{coefficients, dot, eliminate, series};
use crate::contact::solve::nodes::Nodes;

/// Decay over an interval up to which variation of constants is exact to the accuracy of the nodes.
pub(crate) const SLOW: f64 = 1.0;

/// Parts that an interval is divided into at most; in each the decay is to be resolved by the nodes.
const MOST_PARTS: u32 = 16;

/// u at the nodes of an interval and at its end in time, from its value before, and f and g at the nodes.
#[inline(never)]
pub(crate) fn relaxed<T: Nodes<N>, const N: usize>(
    before: T,
    drive: &[T; N],
    decay: &[T; N],
    forward: bool,
) -> ([T; N], T) {
    let whole = dot(&T::WEIGHTS, decay);
    let mut parts = 1;
    while parts < MOST_PARTS && whole > T::constant(f64::from(parts) * N as f64) {
        parts += 1;
    }
    let length = T::ONE / T::constant(f64::from(parts));
    let (drive, decay) = (coefficients(drive, N), coefficients(decay, N));
    let in_order = |z: T| if forward { z } else { T::ONE - z };
    let (mut at_nodes, mut u) = ([before; N], before);
    for part in 0..parts {
        let from = T::constant(f64::from(part)) * length;
        let (mut matrix, mut right) = ([[T::ZERO; N]; N], [u; N]);
        let places = T::Z.map(|z| in_order(from + length * z));
        let (f, g) = (series(&drive, N, &places), series(&decay, N, &places));
        for k in 0..N {
            let (f, g) = (length * f[k], length * g[k].max(T::ZERO));
            for j in 0..N {
                matrix[j][k] = T::INTEGRATION[k][j] * g;
                right[j] = right[j] + T::INTEGRATION[k][j] * f;
            }
        }
        for j in 0..N {
            matrix[j][j] = matrix[j][j] + T::ONE;
        }
        // Never singular: the decay is not negative, and all eigenvalues of the table have positive real parts.
        eliminate(&mut matrix, &mut right);
        let solution = coefficients(&right, N);
        let places = T::Z.map(|z| (in_order(z) - from) / length);
        let found = series(&solution, N, &places.map(|place| place.max(T::ZERO).min(T::ONE)));
        for j in 0..N {
            // Nodes of later parts are set again by them.
            if places[j] > T::ZERO {
                at_nodes[j] = found[j];
            }
        }
        u = right[N - 1];
    }
    (at_nodes, u)
}
