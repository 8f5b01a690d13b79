//! Nodes on 0..1 and the integrals that collocation needs, computed by the compiler: Radau's for an interval and Gauss's for a
//! whole phase of the motion, for any number of nodes.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use core::f64::consts::PI;

use crate::contact::law::Fraction;
use crate::{Real, lift_tables};

/// A number type with the tables for `N` nodes: a function f on 0..1 is given by its values at the nodes.
///
/// ```
/// use microimpact::contact::Nodes;
///
/// // Radau's quadrature with three nodes is exact for z^4.
/// let integral: f64 = <f64 as Nodes<3>>::Z.iter().zip(<f64 as Nodes<3>>::WEIGHTS).map(|(z, weight)| weight * z.powi(4)).sum();
/// assert!((integral - 0.2).abs() < 1e-15);
/// ```
pub trait Nodes<const N: usize>: Real {
    /// The nodes, in rising order; the last is 1.
    const Z: [Self; N];
    /// Integral of f from 0 to node j: sum over k of `INTEGRATION[k][j]` f(k).
    const INTEGRATION: [[Self; N]; N];
    /// Integral of z^2 f from 0 to node j, over the square of that node: sum over k of `TURNING_INTEGRATION[k][j]` f(k).
    const TURNING_INTEGRATION: [[Self; N]; N];
    /// Integral of f from 0 to 1.
    const WEIGHTS: [Self; N];
    /// Integral of z^2 f from 0 to 1.
    const TURNING_WEIGHTS: [Self; N];
    /// Coefficient of the highest Legendre polynomial in f: a measure of what N nodes cannot represent.
    ///
    /// Up to a common factor these are the weights of barycentric interpolation too.
    const HIGHEST_COEFFICIENT: [Self; N];
    /// Coefficient of the shifted Legendre polynomial of degree i in f: sum over k of `LEGENDRE[i][k]` f(k).
    const LEGENDRE: [[Self; N]; N];
}

impl<const N: usize> Nodes<N> for f64 {
    const Z: [Self; N] = Table::<N>::Z;
    const INTEGRATION: [[Self; N]; N] = Table::<N>::INTEGRATION;
    const TURNING_INTEGRATION: [[Self; N]; N] = Table::<N>::TURNING_INTEGRATION;
    const WEIGHTS: [Self; N] = last_column(&Table::<N>::INTEGRATION);
    const TURNING_WEIGHTS: [Self; N] = last_column(&Table::<N>::TURNING_INTEGRATION);
    const HIGHEST_COEFFICIENT: [Self; N] = Table::<N>::HIGHEST_COEFFICIENT;
    const LEGENDRE: [[Self; N]; N] = Table::<N>::LEGENDRE;
}

lift_tables!(f32, |wide: f64| wide as f32);

struct Table<const N: usize>;

impl<const N: usize> Table<N> {
    const Z: [f64; N] = nodes();
    const WEIGHTS: [f64; N] = weights(&Self::Z);
    const INTEGRATION: [[f64; N]; N] = integrals(&Self::Z, &Self::WEIGHTS, false);
    const TURNING_INTEGRATION: [[f64; N]; N] = integrals(&Self::Z, &Self::WEIGHTS, true);
    const HIGHEST_COEFFICIENT: [f64; N] = tail(&Self::Z);
    const LEGENDRE: [[f64; N]; N] = {
        let (mut table, mut i) = ([[0.0; N]; N], 0);
        while i < N {
            let mut k = 0;
            while k < N {
                let x = 2.0 * Self::Z[k] - 1.0;
                let value = if i == 0 { 1.0 } else { legendre(i, x).0 };
                let norm = (2 * i + 1) as f64;
                table[i][k] = norm * Self::WEIGHTS[k] * value;
                k += 1;
            }
            i += 1;
        }
        table
    };
}

/// Legendre's polynomials of degree n and n - 1 and their derivatives at x inside -1..1.
const fn legendre(n: usize, x: f64) -> (f64, f64, f64, f64) {
    let (mut before, mut p) = (1.0, x);
    let (mut slope_before, mut slope) = (0.0, 1.0);
    let mut k = 1;
    while k < n {
        let (a, b) = ((2 * k + 1) as f64, k as f64);
        let next = (a * x * p - b * before) / (b + 1.0);
        let next_slope = slope_before + a * p;
        (before, p) = (p, next);
        (slope_before, slope) = (slope, next_slope);
        k += 1;
    }
    (p, before, slope, slope_before)
}

/// cos x by its series, for 0 <= x <= pi: a first value for Newton's method.
const fn cosine(x: f64) -> f64 {
    let (mut sum, mut term, mut k) = (1.0, 1.0, 1);
    while k < 24 {
        term *= -x * x / ((2 * k - 1) * (2 * k)) as f64;
        sum += term;
        k += 1;
    }
    sum
}

/// Zeros of P_N - P_(N-1), from -1..1 to 0..1.
const fn nodes<const N: usize>() -> [f64; N] {
    const { assert!(N >= 3, "collocation needs three nodes") };
    let mut z = [1.0; N];
    let mut j = 0;
    while j + 1 < N {
        let mut x = cosine(2.0 * PI * (N - 1 - j) as f64 / (2 * N - 1) as f64);
        let mut step = 0;
        while step < 12 {
            let (p, before, slope, slope_before) = legendre(N, x);
            x -= (p - before) / (slope - slope_before);
            step += 1;
        }
        z[j] = (1.0 + x) / 2.0;
        j += 1;
    }
    z
}

/// Weights of Radau's quadrature, exact for polynomials of degree 2 N - 2.
const fn weights<const N: usize>(z: &[f64; N]) -> [f64; N] {
    let square = (N * N) as f64;
    let mut weights = [1.0 / square; N];
    let mut j = 0;
    while j + 1 < N {
        let (_, before, _, _) = legendre(N, 2.0 * z[j] - 1.0);
        weights[j] = z[j] / (square * before * before);
        j += 1;
    }
    weights
}

/// Lagrange's polynomial k at x.
const fn lagrange<const N: usize>(z: &[f64; N], k: usize, x: f64) -> f64 {
    let (mut product, mut i) = (1.0, 0);
    while i < N {
        if i != k {
            product *= (x - z[i]) / (z[k] - z[i]);
        }
        i += 1;
    }
    product
}

/// Integrals of each of Lagrange's polynomials, times z^2 where `turning`, from 0 to each node.
const fn integrals<const N: usize>(z: &[f64; N], weights: &[f64; N], turning: bool) -> [[f64; N]; N] {
    let mut table = [[0.0; N]; N];
    let mut k = 0;
    while k < N {
        let mut j = 0;
        while j < N {
            let (mut sum, mut q) = (0.0, 0);
            while q < N {
                let weight = if turning { weights[q] * z[q] * z[q] } else { weights[q] };
                sum += weight * lagrange(z, k, z[j] * z[q]);
                q += 1;
            }
            table[k][j] = z[j] * sum;
            j += 1;
        }
        k += 1;
    }
    table
}

const fn last_column<const N: usize>(table: &[[f64; N]; N]) -> [f64; N] {
    let mut column = [0.0; N];
    let mut k = 0;
    while k < N {
        column[k] = table[k][N - 1];
        k += 1;
    }
    column
}

/// Leading coefficients of Lagrange's polynomials over that of the shifted Legendre polynomial of degree N - 1.
const fn tail<const N: usize>(z: &[f64; N]) -> [f64; N] {
    let mut legendre_leading = 1.0;
    let mut i = 1;
    while i < N {
        legendre_leading *= (N - 1 + i) as f64 / i as f64;
        i += 1;
    }
    let mut tail = [0.0; N];
    let mut k = 0;
    while k < N {
        let (mut product, mut i) = (legendre_leading, 0);
        while i < N {
            if i != k {
                product *= z[k] - z[i];
            }
            i += 1;
        }
        tail[k] = 1.0 / product;
        k += 1;
    }
    tail
}

/// A number type with the tables for `N` nodes over a whole phase, from the peak z = 0 to the contact radius zero, z = 1.
///
/// They are those of Gauss for the weight z^2 (1 - z^2)^2 of losses that grow at least with the power two of the
/// coordinate s = a (1 - z^2). The weight is part of the integrals.
///
/// ```
/// use microimpact::contact::PhaseNodes;
///
/// let weight: f64 = <f64 as PhaseNodes<5>>::WEIGHTS.iter().sum();
/// assert!((weight - 8.0 / 105.0).abs() < 1e-15);
/// ```
pub trait PhaseNodes<const N: usize>: Real {
    /// The nodes, in rising order.
    const Z: [Self; N];
    /// The contact radii.
    const FRACTIONS: [Fraction<Self>; N];
    /// Integral of the weighted f from 0 to node j, over the square of that node: sum over k of `INTEGRATION[k][j]` f(k).
    const INTEGRATION: [[Self; N]; N];
    /// The same for two f linear in m^2: one at the first node and zero at the last, and the reverse.
    const END_INTEGRATION: [(Self, Self); N];
    /// Integral of the weighted f from 0 to 1.
    const WEIGHTS: [Self; N];
    /// The same for two f linear in m^2, as in [`END_INTEGRATION`](Self::END_INTEGRATION).
    const END_WEIGHTS: (Self, Self);
    /// Fraction in f of the highest polynomial orthogonal under the weight, in units of the weighted integral of f.
    ///
    /// Up to a common factor these are the weights of barycentric interpolation too.
    const HIGHEST_COEFFICIENT: [Self; N];
    /// Speed, over z, below which the sphere has turned; a type holds the reciprocal of twice as much.
    const SLOWEST: Self;

    /// Adds to each sum what the weighted product f g gives up to its node, as [`INTEGRATION`](Self::INTEGRATION) has it.
    ///
    /// A type of few digits rounds each sum once.
    ///
    /// ```
    /// use microimpact::contact::PhaseNodes;
    ///
    /// let mut sums = [0.0_f64; 5];
    /// PhaseNodes::add_integrals(&mut sums, &[2.0; 5], &[0.5; 5]);
    /// for (sum, ends) in sums.iter().zip(<f64 as PhaseNodes<5>>::END_INTEGRATION) {
    ///     assert!((sum - (ends.0 + ends.1)).abs() < 1e-15);
    /// }
    /// ```
    #[inline]
    fn add_integrals(sums: &mut [Self; N], f: &[Self; N], g: &[Self; N]) {
        for k in 0..N {
            let product = f[k] * g[k];
            for j in 0..N {
                sums[j] = sums[j] + Self::INTEGRATION[k][j] * product;
            }
        }
    }
}

/// A number type that can pass from the `N` nodes of a phase to `M` of Radau's.
///
/// ```
/// use microimpact::contact::{Nodes, PhaseNodes, PhaseSamples};
///
/// // At z = 1 the integral is that of the whole phase.
/// let table = <f64 as PhaseSamples<5, 8>>::INTEGRATION;
/// for (row, whole) in table.iter().zip(<f64 as PhaseNodes<5>>::WEIGHTS) {
///     assert!((row[7] - whole).abs() < 1e-15);
/// }
/// ```
pub trait PhaseSamples<const N: usize, const M: usize>: PhaseNodes<N> + Nodes<M> {
    /// The contact radii at Radau's nodes.
    const FRACTIONS: [Fraction<Self>; M];
    /// Integral of the weighted f from 0 to Radau's node q, over the square of that node: sum over k of `INTEGRATION[k][q]` f(k).
    const INTEGRATION: [[Self; M]; N];
}

impl<const N: usize> PhaseNodes<N> for f64 {
    const Z: [Self; N] = Phase::<N>::Z;
    const FRACTIONS: [Fraction<Self>; N] = fractions(&Phase::<N>::Z);
    const INTEGRATION: [[Self; N]; N] = Phase::<N>::INTEGRATION;
    const END_INTEGRATION: [(Self, Self); N] = Phase::<N>::END_INTEGRATION;
    const WEIGHTS: [Self; N] = Phase::<N>::WEIGHTS;
    const END_WEIGHTS: (Self, Self) = Phase::<N>::END_WEIGHTS;
    const HIGHEST_COEFFICIENT: [Self; N] = Phase::<N>::HIGHEST_COEFFICIENT;
    const SLOWEST: Self = 1e-3;
}

impl<const N: usize, const M: usize> PhaseSamples<N, M> for f64 {
    const FRACTIONS: [Fraction<Self>; M] = fractions(&Table::<M>::Z);
    const INTEGRATION: [[Self; M]; N] = Phase::<N>::integrals(&Table::<M>::Z);
}

/// The fractions of the peak at nodes z.
const fn fractions<const N: usize>(z: &[f64; N]) -> [Fraction<f64>; N] {
    let (mut fractions, mut j) = ([Fraction::at(1.0); N], 0);
    while j < N {
        fractions[j] = Fraction::at(1.0 - z[j] * z[j]);
        j += 1;
    }
    fractions
}

/// Nodes of the quadrature by which the integrals over a phase are computed; exact up to `Z`'s own 24.
const FINE: usize = 24;

struct Phase<const N: usize>;

impl<const N: usize> Phase<N> {
    const ORTHOGONAL: Orthogonal<N> = Orthogonal::new();
    const Z: [f64; N] = Self::ORTHOGONAL.zeros();
    const INTEGRATION: [[f64; N]; N] = Self::integrals(&Self::Z);
    const WEIGHTS: [f64; N] = {
        let rows = Self::integrals(&[1.0]);
        let mut whole = [0.0; N];
        let mut k = 0;
        while k < N {
            whole[k] = rows[k][0];
            k += 1;
        }
        whole
    };
    const END_INTEGRATION: [(f64, f64); N] = {
        let (mut ends, mut j) = ([(0.0, 0.0); N], 0);
        while j < N {
            let (mut column, mut k) = ([0.0; N], 0);
            while k < N {
                column[k] = Self::INTEGRATION[k][j];
                k += 1;
            }
            ends[j] = Self::of_ends(&column);
            j += 1;
        }
        ends
    };
    const END_WEIGHTS: (f64, f64) = Self::of_ends(&Self::WEIGHTS);

    /// Sums with weights of two f linear in m^2: one at the first node and zero at the last, and the reverse.
    const fn of_ends(weights: &[f64; N]) -> (f64, f64) {
        let (mut ends, last_square, mut k) = ((0.0, 0.0), square(Self::Z[N - 1]), 0);
        while k < N {
            let first = (square(Self::Z[k]) - last_square) / (square(Self::Z[0]) - last_square);
            ends.0 += weights[k] * first;
            ends.1 += weights[k] * (1.0 - first);
            k += 1;
        }
        ends
    }

    /// Leading coefficients of Lagrange's polynomials, times the norm of the highest orthogonal one.
    const HIGHEST_COEFFICIENT: [f64; N] = {
        let (mut norm, mut n) = (1.0, 1);
        while n < N {
            norm *= root(Self::ORTHOGONAL.b[n]);
            n += 1;
        }
        let (mut tail, mut k) = ([0.0; N], 0);
        while k < N {
            let (mut product, mut i) = (1.0, 0);
            while i < N {
                if i != k {
                    product *= Self::Z[k] - Self::Z[i];
                }
                i += 1;
            }
            // 8/105 is the integral of the weight.
            tail[k] = 8.0 / 105.0 * norm / product;
            k += 1;
        }
        tail
    };

    /// Weighted integrals of Lagrange's polynomials from 0 to each end, over the square of that end.
    const fn integrals<const M: usize>(ends: &[f64; M]) -> [[f64; M]; N] {
        let mut table = [[0.0; M]; N];
        let mut k = 0;
        while k < N {
            let mut j = 0;
            while j < M {
                let (mut sum, mut q) = (0.0, 0);
                while q < FINE {
                    let x = ends[j] * Table::<FINE>::Z[q];
                    sum += Table::<FINE>::WEIGHTS[q] * phase_weight(x) * lagrange(&Self::Z, k, x);
                    q += 1;
                }
                table[k][j] = sum / ends[j];
                j += 1;
            }
            k += 1;
        }
        table
    }
}

/// Power of the coordinate in the weight of the nodes of a phase: losses of a lower power are not carried by them.
pub(crate) const WEIGHT_POWER: u32 = 2;

const fn phase_weight(z: f64) -> f64 {
    z * z * square(z)
}

/// Square m^2 of the contact radius at z, as a fraction of the peak's.
const fn square(z: f64) -> f64 {
    let m = 1.0 - z * z;
    m * m
}

/// Square root by Newton's method, from above.
const fn root(x: f64) -> f64 {
    let (mut root, mut step) = (1.0 + x, 0);
    while step < 60 {
        root = 0.5 * (root + x / root);
        step += 1;
    }
    root
}

/// Polynomials orthogonal under the weight of a phase: p_(n+1) = (z - a_n) p_n - b_n p_(n-1).
struct Orthogonal<const N: usize> {
    a: [f64; N],
    b: [f64; N],
}

impl<const N: usize> Orthogonal<N> {
    /// Stieltjes's procedure: the coefficients are ratios of integrals of p_n^2.
    const fn new() -> Self {
        const { assert!(N >= 3 && N <= 20, "a phase has three to twenty nodes") };
        let (mut a, mut b) = ([0.0; N], [0.0; N]);
        let (mut before, mut now) = ([0.0; FINE], [1.0; FINE]);
        let (mut square_before, mut n) = (1.0, 0);
        while n < N {
            let (mut square, mut moment, mut q) = (0.0, 0.0, 0);
            while q < FINE {
                let part = Table::<FINE>::WEIGHTS[q] * phase_weight(Table::<FINE>::Z[q]) * now[q] * now[q];
                square += part;
                moment += part * Table::<FINE>::Z[q];
                q += 1;
            }
            a[n] = moment / square;
            b[n] = if n == 0 { 0.0 } else { square / square_before };
            square_before = square;
            q = 0;
            while q < FINE {
                let next = (Table::<FINE>::Z[q] - a[n]) * now[q] - b[n] * before[q];
                before[q] = now[q];
                now[q] = next;
                q += 1;
            }
            n += 1;
        }
        Self { a, b }
    }

    const fn value(&self, degree: usize, z: f64) -> f64 {
        let (mut last, mut value, mut n) = (0.0, 1.0, 0);
        while n < degree {
            (last, value) = (value, (z - self.a[n]) * value - self.b[n] * last);
            n += 1;
        }
        value
    }

    /// Zeros of the polynomial of degree N; those of each degree lie between those of the one before.
    const fn zeros(&self) -> [f64; N] {
        let (mut zeros, mut degree) = ([1.0; N], 1);
        while degree <= N {
            let (below, mut j) = (zeros, 0);
            while j < degree {
                let mut low = if j == 0 { 0.0 } else { below[j - 1] };
                let mut high = if j + 1 == degree { 1.0 } else { below[j] };
                let rises = (degree - j) % 2 == 1;
                let mut step = 0;
                while step < 54 {
                    let z = 0.5 * (low + high);
                    if (self.value(degree, z) < 0.0) == rises {
                        low = z;
                    } else {
                        high = z;
                    }
                    step += 1;
                }
                zeros[j] = 0.5 * (low + high);
                j += 1;
            }
            degree += 1;
        }
        zeros
    }
}
