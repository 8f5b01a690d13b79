//! Nodes on 0..1 and the integrals that collocation needs, computed by the compiler: Radau's for a stretch, for any number
//! of nodes, and Gauss's for a whole phase of the motion.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing)]

use core::f64::consts::PI;

use crate::Real;

/// A number type with the tables for `N` nodes: a function f on 0..1 is given by its values at the nodes.
///
/// ```
/// use microimpact::simulation::Nodes;
///
/// // Radau's quadrature with three nodes is exact for z^4.
/// let integral: f64 = <f64 as Nodes<3>>::Z.iter().zip(<f64 as Nodes<3>>::WHOLE).map(|(z, weight)| weight * z.powi(4)).sum();
/// assert!((integral - 0.2).abs() < 1e-15);
/// ```
pub trait Nodes<const N: usize>: Real {
    /// The nodes, in rising order; the last is 1.
    const Z: [Self; N];
    /// Integral of f from 0 to node j: sum over k of `RUNNING[k][j]` f(k).
    const RUNNING: [[Self; N]; N];
    /// Integral of z^2 f from 0 to node j, over the square of that node: sum over k of `TURNING[k][j]` f(k).
    const TURNING: [[Self; N]; N];
    /// Integral of f from 0 to 1.
    const WHOLE: [Self; N];
    /// Integral of z^2 f from 0 to 1.
    const WHOLE_TURNING: [Self; N];
    /// Coefficient of the highest Legendre polynomial in f: a measure of what N nodes cannot represent.
    ///
    /// Up to a common factor these are the weights of barycentric interpolation too.
    const TAIL: [Self; N];
}

macro_rules! impl_nodes {
    ($float:ident) => {
        impl<const N: usize> Nodes<N> for $float {
            const Z: [Self; N] = narrowed!($float, Table::<N>::Z);
            const RUNNING: [[Self; N]; N] = narrowed_square!($float, Table::<N>::RUNNING);
            const TURNING: [[Self; N]; N] = narrowed_square!($float, Table::<N>::TURNING);
            const WHOLE: [Self; N] = narrowed!($float, last_column(&Table::<N>::RUNNING));
            const WHOLE_TURNING: [Self; N] = narrowed!($float, last_column(&Table::<N>::TURNING));
            const TAIL: [Self; N] = narrowed!($float, Table::<N>::TAIL);
        }
    };
}

macro_rules! narrowed {
    ($float:ident, $wide:expr) => {{
        let wide = $wide;
        let mut narrow = [0.0; N];
        let mut i = 0;
        while i < N {
            narrow[i] = wide[i] as $float;
            i += 1;
        }
        narrow
    }};
}

macro_rules! narrowed_square {
    ($float:ident, $wide:expr) => {{
        let wide = $wide;
        let mut narrow = [[0.0; N]; N];
        let mut i = 0;
        while i < N {
            narrow[i] = narrowed!($float, wide[i]);
            i += 1;
        }
        narrow
    }};
}

impl_nodes!(f32);
impl_nodes!(f64);

struct Table<const N: usize>;

impl<const N: usize> Table<N> {
    const Z: [f64; N] = nodes();
    const WEIGHTS: [f64; N] = weights(&Self::Z);
    const RUNNING: [[f64; N]; N] = integrals(&Self::Z, &Self::WEIGHTS, false);
    const TURNING: [[f64; N]; N] = integrals(&Self::Z, &Self::WEIGHTS, true);
    const TAIL: [f64; N] = tail(&Self::Z);
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
/// They are those of Gauss for the weight z^2 (1 - z^2)^2 of losses that grow at least with the square of the contact radius
/// s = a (1 - z^2). The weight is part of the integrals.
///
/// ```
/// use microimpact::simulation::PhaseNodes;
///
/// let weight: f64 = <f64 as PhaseNodes<5>>::WHOLE.iter().sum();
/// assert!((weight - 8.0 / 105.0).abs() < 1e-15);
/// ```
pub trait PhaseNodes<const N: usize>: Real {
    /// 1 - z^2 at the nodes: the contact radius over its peak.
    const M: [Self; N];
    /// Integral of the weighted f from 0 to node j, over the square of that node: sum over k of `RUNNING[k][j]` f(k).
    const RUNNING: [[Self; N]; N];
    /// Integral of the weighted f from 0 to 1.
    const WHOLE: [Self; N];
}

macro_rules! impl_phase_nodes {
    ($($n:literal: $z:expr),*) => {
        $(
            impl Phase<$n> {
                const Z: [f64; $n] = $z;
            }

            impl_phase_nodes!(f32, $n);
            impl_phase_nodes!(f64, $n);
        )*
    };
    ($float:ident, $n:literal) => {
        impl PhaseNodes<$n> for $float {
            const M: [Self; $n] = {
                const N: usize = $n;
                narrowed!($float, Phase::<N>::contact_radii(&Phase::<N>::Z))
            };
            const RUNNING: [[Self; $n]; $n] = {
                const N: usize = $n;
                narrowed_square!($float, Phase::<N>::integrals(&Phase::<N>::Z))
            };
            const WHOLE: [Self; $n] = {
                const N: usize = $n;
                narrowed!($float, Phase::<N>::whole(&Phase::<N>::Z))
            };
        }
    };
}

struct Phase<const N: usize>;

impl<const N: usize> Phase<N> {
    const fn contact_radii(z: &[f64; N]) -> [f64; N] {
        let mut m = [0.0; N];
        let mut j = 0;
        while j < N {
            m[j] = 1.0 - z[j] * z[j];
            j += 1;
        }
        m
    }

    /// Weighted integral of Lagrange's polynomial k from 0 to `end`, exact with Radau's 16 nodes.
    const fn integral(z: &[f64; N], k: usize, end: f64) -> f64 {
        let (mut sum, mut q) = (0.0, 0);
        while q < 16 {
            let x = end * Table::<16>::Z[q];
            let m = 1.0 - x * x;
            sum += Table::<16>::WEIGHTS[q] * x * x * m * m * lagrange(z, k, x);
            q += 1;
        }
        end * sum
    }

    const fn integrals(z: &[f64; N]) -> [[f64; N]; N] {
        let mut table = [[0.0; N]; N];
        let mut k = 0;
        while k < N {
            let mut j = 0;
            while j < N {
                table[k][j] = Self::integral(z, k, z[j]) / (z[j] * z[j]);
                j += 1;
            }
            k += 1;
        }
        table
    }

    const fn whole(z: &[f64; N]) -> [f64; N] {
        let mut whole = [0.0; N];
        let mut k = 0;
        while k < N {
            whole[k] = Self::integral(z, k, 1.0);
            k += 1;
        }
        whole
    }
}

impl_phase_nodes! {
    4: [0.168_848_643_306_250_23, 0.400_478_437_938_044_4, 0.648_109_617_548_724_5, 0.858_882_474_005_624],
    5: [
        0.126_557_189_417_750_3, 0.310_043_870_426_936_04, 0.522_411_788_307_857, 0.727_305_133_842_193_1,
        0.892_545_619_488_074_3
    ],
    6: [
        0.098_160_669_059_215_35, 0.245_742_548_552_825_94, 0.425_618_808_246_569_9, 0.612_676_900_154_884_7,
        0.782_853_661_600_094_8, 0.915_451_689_718_810_6
    ],
    7: [
        0.078_252_305_111_601_93, 0.198_877_908_670_727_03, 0.351_242_977_929_878_6, 0.517_744_883_928_144,
        0.680_563_644_311_726_4, 0.823_197_376_456_624, 0.931_744_552_722_608
    ],
    8: [
        0.063_790_269_425_280_9, 0.163_890_160_193_141_99, 0.293_617_787_423_141_04, 0.440_415_820_055_981_7,
        0.591_028_743_025_116_5, 0.732_568_378_965_366_8, 0.853_364_086_043_577_4, 0.943_746_098_565_475_6
    ]
}
