//! Decay towards a moving balance, however fast: u' = f - g u over a stretch, for a spin that a peeling moment slows.
//!
//! Where the decay is slow, variation of constants gives u from two integrals; where it is fast, its exponentials are no
//! polynomials and overflow. Collocation at Radau's nodes in the order of time holds for any decay: what decays within less than
//! a node's distance is gone at the next node.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::nodes::Nodes;
use super::stretch::{dot, eliminate};
use crate::Real;

/// Decay over a stretch up to which variation of constants is exact to the accuracy of the nodes.
pub(super) const SLOW: f64 = 1.0;

/// Parts that a stretch is divided into at most; in each the decay is to be resolved by the nodes.
const MOST_PARTS: u32 = 16;

/// u at the nodes of a stretch and at its end in time, from its value before, and f and g at the nodes.
#[inline(never)]
pub(super) fn relaxed<T: Nodes<N>, const N: usize>(
    before: T,
    drive: &[T; N],
    decay: &[T; N],
    forward: bool,
) -> ([T; N], T) {
    let whole = dot(&T::WHOLE, decay);
    let mut parts = 1;
    while parts < MOST_PARTS && whole > T::constant(f64::from(parts) * N as f64) {
        parts += 1;
    }
    let length = T::ONE / T::constant(f64::from(parts));
    let (drive, decay) = (coefficients(drive), coefficients(decay));
    let (mut at_nodes, mut u) = ([before; N], before);
    for part in 0..parts {
        let from = T::constant(f64::from(part)) * length;
        let (mut matrix, mut right) = ([[T::ZERO; N]; N], [u; N]);
        for k in 0..N {
            let time = from + length * T::Z[k];
            let z = if forward { time } else { T::ONE - time };
            let (f, g) = (length * series(&drive, z), length * series(&decay, z).max(T::ZERO));
            for j in 0..N {
                matrix[j][k] = T::RUNNING[k][j] * g;
                right[j] = right[j] + T::RUNNING[k][j] * f;
            }
        }
        for j in 0..N {
            matrix[j][j] = matrix[j][j] + T::ONE;
        }
        // Never singular: the decay is not negative, and all eigenvalues of the table have positive real parts.
        eliminate(&mut matrix, &mut right);
        let solution = coefficients(&right);
        for j in 0..N {
            let time = if forward { T::Z[j] } else { T::ONE - T::Z[j] };
            let place = (time - from) / length;
            if place > T::ZERO {
                // Nodes of later parts are set again by them.
                at_nodes[j] = series(&solution, place.min(T::ONE));
            }
        }
        u = right[N - 1];
    }
    (at_nodes, u)
}

/// Coefficients of shifted Legendre polynomials, from values at the nodes.
fn coefficients<T: Nodes<N>, const N: usize>(values: &[T; N]) -> [T; N] {
    let mut coefficients = [T::ZERO; N];
    for i in 0..N {
        coefficients[i] = dot(&T::LEGENDRE[i], values);
    }
    coefficients
}

/// The sum of shifted Legendre polynomials at a place between 0 and 1, by Clenshaw's recurrence.
fn series<T: Real, const N: usize>(coefficients: &[T; N], place: T) -> T {
    let x = place + place - T::ONE;
    let (mut now, mut before) = (T::ZERO, T::ZERO);
    for i in (0..N).rev() {
        let (up, down) = ((2 * i + 1) as f64 / (i + 1) as f64, (i + 1) as f64 / (i + 2) as f64);
        let next = coefficients[i] + T::constant(up) * x * now - T::constant(down) * before;
        (before, now) = (now, next);
    }
    now
}
