//! The tables of collocation, for every number of nodes: each integral is exact for all polynomials that it should be.

use microimpact::contact::{Nodes, PhaseNodes, PhaseSamples};

/// Rounding of a sum of some products, each of the size of one.
const ROUNDING: f64 = 1e-14;

fn dot<const N: usize>(weights: &[f64; N], values: &[f64; N]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

fn power<const N: usize>(z: &[f64; N], degree: usize) -> [f64; N] {
    z.map(|z| z.powi(degree as i32))
}

/// What a table gives at node j.
fn column<const N: usize, const M: usize>(table: &[[f64; M]; N], values: &[f64; N], j: usize) -> f64 {
    table.iter().zip(values).map(|(row, value)| row[j] * value).sum()
}

/// The shifted Legendre polynomial of a degree, at z.
fn legendre(degree: usize, z: f64) -> f64 {
    let x = 2.0 * z - 1.0;
    let (mut before, mut now) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
    }
    now
}

#[track_caller]
fn assert_close(found: f64, exact: f64, what: &str, numbers: [usize; 3]) {
    let error = (found - exact).abs();
    assert!(error <= ROUNDING, "{what}, {numbers:?}: {found} for {exact}, {error:e}");
}

/// The tables for intervals: Radau's nodes.
fn intervals<const N: usize>()
where
    f64: Nodes<N>,
{
    let z = <f64 as Nodes<N>>::Z;
    assert!(z.is_sorted_by(|a, b| a < b) && z[0] > 0.0 && z[N - 1] == 1.0, "{N}");
    assert!(<f64 as Nodes<N>>::WEIGHTS.iter().all(|weight| *weight > 0.0), "{N}");
    for degree in 0..=2 * N - 2 {
        let found = dot(&<f64 as Nodes<N>>::WEIGHTS, &power(&z, degree));
        assert_close(found, 1.0 / (degree + 1) as f64, "weights", [N, degree, 0]);
    }
    for degree in 0..=2 * N - 4 {
        let found = dot(&<f64 as Nodes<N>>::TURNING_WEIGHTS, &power(&z, degree));
        assert_close(found, 1.0 / (degree + 3) as f64, "turning weights", [N, degree, 0]);
    }
    for degree in 0..N {
        let values = power(&z, degree);
        for (j, z) in z.iter().enumerate() {
            let numbers = [N, degree, j];
            let exact = z.powi(degree as i32 + 1) / (degree + 1) as f64;
            assert_close(column(&<f64 as Nodes<N>>::INTEGRATION, &values, j), exact, "integral", numbers);
            let exact = z.powi(degree as i32 + 1) / (degree + 3) as f64;
            assert_close(column(&<f64 as Nodes<N>>::TURNING_INTEGRATION, &values, j), exact, "turning", numbers);
        }
        let polynomial = z.map(|z| legendre(degree, z));
        for (i, row) in <f64 as Nodes<N>>::LEGENDRE.iter().enumerate() {
            // The coefficients have norms of up to 2 N - 1.
            let found = dot(row, &polynomial) / (2 * N - 1) as f64;
            assert_close(found, f64::from(i == degree) / (2 * N - 1) as f64, "Legendre", [N, degree, i]);
        }
        let found = dot(&<f64 as Nodes<N>>::HIGHEST_COEFFICIENT, &polynomial) / (2 * N - 1) as f64;
        assert_close(found, f64::from(degree + 1 == N) / (2 * N - 1) as f64, "highest", [N, degree, 0]);
    }
    // In single precision they are the same numbers, rounded.
    assert_eq!(<f32 as Nodes<N>>::Z, z.map(|z| z as f32));
    assert_eq!(<f32 as Nodes<N>>::WEIGHTS, <f64 as Nodes<N>>::WEIGHTS.map(|weight| weight as f32));
    let rows = <f64 as Nodes<N>>::INTEGRATION.map(|row| row.map(|entry| entry as f32));
    assert_eq!(<f32 as Nodes<N>>::INTEGRATION, rows);
}

/// The integral from 0 to z of the weight of a phase times a power.
fn weighted(z: f64, degree: usize) -> f64 {
    let term = |power: usize| z.powi(power as i32) / power as f64;
    term(degree + 3) - 2.0 * term(degree + 5) + term(degree + 7)
}

/// The tables for phases: Gauss's nodes for the weight z^2 (1 - z^2)^2.
fn phases<const N: usize>()
where
    f64: PhaseNodes<N>,
{
    let z = <f64 as PhaseNodes<N>>::Z;
    assert!(z.is_sorted_by(|a, b| a < b) && z[0] > 0.0 && z[N - 1] < 1.0, "{N}");
    assert!(<f64 as PhaseNodes<N>>::WEIGHTS.iter().all(|weight| *weight > 0.0), "{N}");
    for degree in 0..2 * N {
        let found = dot(&<f64 as PhaseNodes<N>>::WEIGHTS, &power(&z, degree));
        assert_close(found, weighted(1.0, degree), "weights", [N, degree, 0]);
    }
    for degree in 0..N {
        let values = power(&z, degree);
        for (j, z) in z.iter().enumerate() {
            let found = column(&<f64 as PhaseNodes<N>>::INTEGRATION, &values, j);
            assert_close(found, weighted(*z, degree) / (z * z), "integral", [N, degree, j]);
        }
    }
    // A function linear in m^2, m = 1 - z^2, by its values at the first and the last node.
    let square = z.map(|z| (1.0 - z * z).powi(2));
    for (j, ends) in <f64 as PhaseNodes<N>>::END_INTEGRATION.iter().enumerate() {
        let found = ends.0 * square[0] + ends.1 * square[N - 1];
        let integral = weighted(z[j], 0) - 2.0 * weighted(z[j], 2) + weighted(z[j], 4);
        // Through fewer nodes no polynomial of the degree four goes.
        if N > 4 {
            assert_close(found, integral / (z[j] * z[j]), "ends", [N, j, 0]);
        }
        assert_close(ends.0 + ends.1, weighted(z[j], 0) / (z[j] * z[j]), "ends of a constant", [N, j, 0]);
    }
    let ends = <f64 as PhaseNodes<N>>::END_WEIGHTS;
    let whole = weighted(1.0, 0) - 2.0 * weighted(1.0, 2) + weighted(1.0, 4);
    assert_close(ends.0 * square[0] + ends.1 * square[N - 1], whole, "weights of the ends", [N, 0, 0]);
    assert_close(ends.0 + ends.1, weighted(1.0, 0), "weights of the ends", [N, 0, 1]);
    for (j, fraction) in <f64 as PhaseNodes<N>>::FRACTIONS.iter().enumerate() {
        let m = 1.0 - z[j] * z[j];
        assert_close(fraction.value, m, "fraction", [N, j, 0]);
        assert_close(fraction.cubic * (1.0 - m), 1.0 - m.powi(3), "cubic", [N, j, 0]);
        assert_close(fraction.quintic * (1.0 - m), 1.0 - m.powi(5), "quintic", [N, j, 0]);
    }
    // The highest coefficient sees no polynomial of a lower degree.
    let scale: f64 = <f64 as PhaseNodes<N>>::HIGHEST_COEFFICIENT.iter().map(|entry| entry.abs()).sum();
    for degree in 0..N - 1 {
        let found = dot(&<f64 as PhaseNodes<N>>::HIGHEST_COEFFICIENT, &power(&z, degree)) / scale;
        assert_close(found, 0.0, "highest", [N, degree, 0]);
    }
    assert!(dot(&<f64 as PhaseNodes<N>>::HIGHEST_COEFFICIENT, &power(&z, N - 1)).abs() > 0.0);
    assert_eq!(<f32 as PhaseNodes<N>>::Z, z.map(|z| z as f32));
    assert_eq!(<f32 as PhaseNodes<N>>::WEIGHTS, <f64 as PhaseNodes<N>>::WEIGHTS.map(|weight| weight as f32));
}

/// The tables from a phase to Radau's nodes.
fn samples<const N: usize, const M: usize>()
where
    f64: PhaseSamples<N, M>,
{
    let (from, to) = (<f64 as PhaseNodes<N>>::Z, <f64 as Nodes<M>>::Z);
    for degree in 0..N {
        let values = power(&from, degree);
        for (q, z) in to.iter().enumerate() {
            let found = column(&<f64 as PhaseSamples<N, M>>::INTEGRATION, &values, q);
            assert_close(found, weighted(*z, degree) / (z * z), "samples", [N, M, q]);
        }
    }
}

/// Calls a function for each number of nodes.
macro_rules! each {
    ($function:ident: $($nodes:literal)*) => {
        $($function::<$nodes>();)*
    };
}

#[test]
fn of_intervals() {
    each!(intervals: 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24);
}

#[test]
fn of_phases() {
    each!(phases: 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20);
}

/// As the adaptive method combines them, and at their extremes.
#[test]
fn from_phases_to_intervals() {
    samples::<3, 3>();
    samples::<5, 10>();
    samples::<7, 13>();
    samples::<9, 16>();
    samples::<10, 18>();
    samples::<13, 24>();
    samples::<14, 26>();
    samples::<20, 24>();
}
