//! Where the search for the maximum starts: the best of a grid.

use crate::law::{Coordinate, Law};
use crate::likelihood::{Likelihood, Nuisance};
use crate::observation::Observation;

/// Least scatter of restitutions whose errors are not stated: they are written with two or three digits.
const ROUNDING: f64 = 1e-3;

/// Rows that are tried on the grid.
const ROWS: usize = 60;

/// Probability of an outlier on the grid.
const OUTLIER: f64 = 0.05;

/// Values of the first parameters, from which a grid is made.
fn axis(coordinate: Coordinate, observations: &[Observation], reference: f64) -> Vec<f64> {
    let powers = |low: f64, high: f64, count: u32| -> Vec<f64> {
        (0..=count).map(|step| low * (high / low).powf(f64::from(step) / f64::from(count))).collect()
    };
    match coordinate {
        Coordinate::Restitution => vec![0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98],
        Coordinate::Loss => powers(0.005, 30.0, 14),
        Coordinate::YieldSpeed => powers(1e-4, 1.5, 14).into_iter().map(f64::ln).collect(),
        Coordinate::Viscosity => powers(0.003, 3.0, 12),
        Coordinate::Damping => powers(0.02, 5.0, 6),
        Coordinate::AdhesionDamping => vec![0.5],
        Coordinate::Work | Coordinate::CriticalSpeed => {
            let mut speeds: Vec<f64> = observations.iter().map(|o| o.speed / reference).collect();
            speeds.sort_by(f64::total_cmp);
            let place = |part: f64| speeds[(part * (speeds.len() - 1) as f64) as usize];
            let slowest = speeds[0];
            let mut axis =
                vec![0.02 * slowest, 0.2 * slowest, 0.4 * slowest, 0.6 * slowest, 0.8 * slowest, 0.95 * slowest];
            axis.extend([0.03, 0.08, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65].map(place));
            axis
        }
    }
}

/// Start values for a law, and the least variance of the scatter; the best first. `None` if no curve can be had.
pub fn starts(observations: &[Observation], likelihood: &mut Likelihood, law: Law) -> Vec<Vec<f64>> {
    let mut sample: Vec<&Observation> = observations.iter().collect();
    sample.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    let stride = sample.len().div_ceil(ROWS);
    let sample: Vec<Observation> = sample.into_iter().step_by(stride).copied().collect();
    let mut few = Likelihood::new(&sample, law);
    few.until(likelihood.stop());
    few.set_parameters(Coordinate::CriticalSpeed, likelihood.nuisances());
    // The same units and sizes as with all rows.
    let factor = likelihood.reference / few.reference;
    let coordinates = likelihood.coordinates().to_vec();
    let mut grid: Vec<Vec<f64>> = vec![Vec::new()];
    for coordinate in few.coordinates() {
        let axis = axis(*coordinate, &sample, few.reference);
        grid = grid.iter().flat_map(|point| axis.iter().map(|value| [&point[..], &[*value]].concat())).collect();
    }
    let mut error: Vec<f64> = few.error_variances().collect();
    error.sort_by(f64::total_cmp);
    let error = error.get(error.len() / 2).copied().unwrap_or(0.0);
    let mut rows = vec![0.0; sample.len()];
    let mut found: Vec<(f64, Vec<f64>, f64)> = Vec::new();
    for point in grid {
        let Some(curve) = few.curve(&[&point[..], &[1e-6, OUTLIER]].concat()) else {
            continue;
        };
        let mut off: Vec<f64> = few.deviations(&curve).collect();
        off.sort_by(f64::total_cmp);
        let median = off.get(off.len() / 2).copied().unwrap_or(0.1);
        // The median deviation of normal scatter is 0.6745 standard deviations.
        let scatter = (median / 0.6745).powi(2);
        let variance = (scatter - error).max(0.04 * scatter).max(1e-8);
        let point = [&point[..], &[variance, OUTLIER]].concat();
        if few.rows(&point, &mut rows) {
            found.push((rows.iter().sum(), point, scatter));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let least = found.iter().take(20).map(|point| point.2).fold(f64::MAX, f64::min);
    if error < 0.01 * least {
        likelihood.set_least_variance((0.01 * least).max(ROUNDING * ROUNDING));
    }
    let convert = |(_, mut point, _): (f64, Vec<f64>, f64)| {
        let curve = few.curve(&point)?;
        for (index, coordinate) in coordinates.iter().enumerate() {
            match coordinate {
                Coordinate::Work => point[index] = curve.pull()? / (factor * factor),
                Coordinate::CriticalSpeed => point[index] /= factor,
                Coordinate::Loss | Coordinate::Damping => point[index] *= factor,
                Coordinate::YieldSpeed => point[index] -= factor.ln(),
                _ => {}
            }
        }
        Some(point)
    };
    let mut points: Vec<Vec<f64>> = found.into_iter().filter_map(convert).collect();
    // The best, and the best with another adhesion.
    if let Some(other) = points.iter().position(|point| (point[1] / points[0][1] - 1.0).abs() > 0.5) {
        points.swap(1, other);
    }
    points.truncate(2);
    points
}

/// Nuisances of the plain scatter.
pub const PLAIN: [Nuisance; 2] = [Nuisance::Variance, Nuisance::Outlier];

/// Nuisances of the skewed scatter.
pub const SKEWED: [Nuisance; 5] =
    [Nuisance::Variance, Nuisance::Outlier, Nuisance::TailWeight, Nuisance::TailOffset, Nuisance::Median];
