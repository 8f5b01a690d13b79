//! The energy balance error of each impact: the works of damping and friction are integrals of their own.

use super::maps::Map;
use super::trial::Method;
use crate::content::{Cell, Figure, Part, Table};
use crate::plot::{self, Axis, Line, Mark};

/// The methods that keep a ledger.
const METHODS: [Method; 3] = [Method::Double, Method::Single, Method::Paper];

pub(super) fn parts(maps: &[Map]) -> Result<Vec<Part>, String> {
    let mut rows = Vec::new();
    let mut lines = Vec::new();
    for method in METHODS {
        let residuals = sorted(maps.iter().flat_map(Map::points).filter_map(|point| point.trial(method).residual));
        let (Some(median), Some(largest)) = (quantile(&residuals, 0.5), residuals.last()) else { continue };
        rows.push(vec![
            Cell::from(method.name()),
            Cell::Count(residuals.len() as u64),
            Cell::from(median),
            Cell::from(quantile(&residuals, 0.99)),
            Cell::from(*largest),
            Cell::from(method.ledger_bound()),
            Cell::Count(residuals.iter().filter(|residual| **residual > method.ledger_bound()).count() as u64),
        ]);
        lines.push(Line::new(method.name(), Mark::Solid, exceeding(&residuals)));
    }
    let x = Axis::logarithmic("energy balance error", "ΔT/T_i", "1").between(1e-17, 1.0);
    let y = Axis::logarithmic("fraction of impacts", "n/N", "1");
    let drawing = plot::chart(&x, &y, &lines)?;
    let points = lines.iter().flat_map(|line| {
        line.points.iter().map(|at| vec![Cell::Text(line.name.clone()), Cell::from(at.0), Cell::from(at.1)])
    });
    let data = Table {
        name: "stability-ledger-fractions".to_owned(),
        caption: "Fraction of the impacts of all maps whose energy balance error exceeds a value.".to_owned(),
        columns: ["method", "energy balance error", "fraction of the impacts"].map(str::to_owned).to_vec(),
        rows: points.collect(),
    };
    let table = Table {
        name: "stability-ledger".to_owned(),
        caption: "Energy balance error over the energy of the motion".to_owned(),
        columns: ["method", "impacts", "median", "99 of 100 below", "largest", "bound", "beyond it"]
            .map(str::to_owned)
            .to_vec(),
        rows,
    };
    let text = "The kinetic energy before an impact equals that after it and the works of damping and friction. Each work \
                is an integral of its own, so that the error of their sum shows the error of a run. For a rebound it is \
                relative to the energy before. For a capture it covers the motion along the normal up to the first \
                turning point, relative to the largest kinetic energy of the undamped motion. Left out are spheres that \
                creep to rest, which have no turning point, and energies too small in joules for single precision. The \
                paper's method reports no turning point: its ledger covers rebounds only. Where its steps are unstable \
                they create energy.";
    let title = "Energy balance error".to_owned();
    Ok(vec![Part::Text(text.to_owned()), Part::Figure(Figure { title, drawing, data }), Part::Table(table)])
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<_> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}

/// The value that a fraction of the sorted values does not exceed.
fn quantile(sorted: &[f64], fraction: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    sorted.get((fraction * last as f64).round() as usize).copied()
}

/// Values with the fraction of all that exceed them, thinned to a few hundred points.
fn exceeding(sorted: &[f64]) -> Vec<(f64, f64)> {
    let count = sorted.len();
    // Evenly over the logarithm of the fraction.
    let mut points = Vec::new();
    let mut above = count as f64;
    while above >= 1.0 {
        let rank = above as usize;
        points.push((sorted[count - rank].max(1e-17), rank as f64 / count as f64));
        above = (0.97 * above).min(above - 1.0);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_fall_from_all_to_one() {
        let values = sorted([3e-9, 1e-9, 4e-9, 2e-9].into_iter());
        assert_eq!(exceeding(&values), [(1e-9, 1.0), (2e-9, 0.75), (3e-9, 0.5), (4e-9, 0.25)]);
        assert_eq!(quantile(&values, 1.0), Some(4e-9));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
