//! A simulated response, interpolated between spheres and speeds: an integral needs thousands of impacts.
//!
//! The logarithm of the critical speed is nearly linear in the logarithms of diameter and adhesion. Where damping takes so much
//! of a rebound that spheres of every speed are captured, the inverse of the critical speed falls to zero. Close to such spheres
//! the inverse is interpolated, elsewhere the logarithm.
//!
//! Above the critical speed v_c, a rebound is a smooth function of the t in v = v_c cosh t: just above, the restitution rises
//! as the root of v - v_c, which is proportional to t, and far above, t is nearly the logarithm of the speed. Without a
//! critical speed, t is that logarithm.

mod nodes;

use std::cell::{RefCell, RefMut};

use microimpact::CriticalSpeed;

use self::nodes::{Chebyshev, Grid};
use crate::PopulationError;
use crate::response::{Rebound, Response};

/// How fine an interpolation is.
#[derive(Clone, Copy)]
pub(crate) struct Fineness {
    /// Largest distance of the nodes in the logarithms of diameter and adhesion.
    pub(crate) distance: f64,
    /// Nodes of the speeds.
    pub(crate) speeds: usize,
}

/// Least ratio of the largest speed to a critical speed that the nodes cover.
const LEAST_RATIO: f64 = 1.1;

/// Relative distance of the least speed from the critical speed, larger than the tolerance of a simulation.
const CLOSE: f64 = 1e-8;

/// Largest speed of a node, m/s. The speeds of the population are much smaller where the library knows an impact.
const FASTEST: f64 = 1e6;

/// A response at nodes.
pub(crate) struct Interpolated<'a, R> {
    response: &'a R,
    diameters: Grid,
    adhesions: Grid,
    speeds: Chebyshev,
    /// Inverses of the critical speeds at the nodes and their logarithms, the adhesions innermost; `None` if all spheres rebound.
    inverses: Option<Vec<[f64; 2]>>,
    /// The least and the largest t.
    reach: [f64; 2],
    /// Rebounds at the speeds of each pair of nodes.
    rebounds: Vec<Vec<Rebound>>,
    /// The last adhesion that was asked for: most integrals are over spheres of one.
    last: RefCell<OneAdhesion>,
}

/// A response to spheres of one adhesion at the nodes of the diameters, as far as it was asked for.
#[derive(Default)]
struct OneAdhesion {
    adhesion: f64,
    /// Index of the first neighbour among the nodes of the adhesions, and the weights of the neighbours.
    columns: (usize, Vec<f64>),
    /// Inverse of the critical speed and its logarithm.
    inverses: Vec<Option<[f64; 2]>>,
    /// Rebounds at the nodes of the speeds.
    rebounds: Vec<Option<Vec<Rebound>>>,
}

impl OneAdhesion {
    /// Adds up what the nodes near the adhesion have at a node of the diameters.
    fn near(&self, row: usize, count: usize, mut add: impl FnMut(f64, usize)) {
        let (first, weights) = &self.columns;
        weights.iter().enumerate().for_each(|(column, weight)| add(*weight, row * count + first + column));
    }
}

impl<'a, R: Response> Interpolated<'a, R> {
    /// Computes a response at the nodes that cover bounds of the diameters, the adhesion and the normal speeds.
    pub(crate) fn new(response: &'a R, bounds: [[f64; 2]; 3], fineness: Fineness) -> Result<Self, PopulationError> {
        let [diameters, adhesions, [slowest, fastest]] = bounds;
        let grid = |[low, high]: [f64; 2]| {
            // Adhesion that does not vary may be zero.
            Grid::between(if low == high { [0.0; 2] } else { [low.ln(), high.ln()] }, fineness.distance)
        };
        let values = |grid: &Grid, [low, _]: [f64; 2]| -> Vec<f64> {
            // The logarithm would round a value that does not vary.
            if grid.count() == 1 { vec![low] } else { grid.positions().map(f64::exp).collect() }
        };
        let (grid_d, grid_a) = (grid(diameters), grid(adhesions));
        let adhesion_values = values(&grid_a, adhesions);
        let spheres: Vec<[f64; 2]> = values(&grid_d, diameters)
            .into_iter()
            .flat_map(|diameter| adhesion_values.iter().map(move |adhesion| [diameter, *adhesion]))
            .collect();
        let critical: Result<Vec<_>, _> =
            spheres.iter().map(|[diameter, adhesion]| response.critical_speed(*diameter, *adhesion)).collect();
        let inverses = inverses(&critical?)?;
        let reach = match &inverses {
            Some(inverses) => {
                let largest = inverses.iter().map(|[inverse, _]| *inverse).fold(0.0, f64::max);
                [0.0, (fastest * largest).max(LEAST_RATIO).acosh()]
            }
            None => [slowest.ln(), fastest.ln()],
        };
        let mut interpolated = Self {
            response,
            diameters: grid_d,
            adhesions: grid_a,
            speeds: Chebyshev::between(reach, fineness.speeds),
            inverses,
            reach,
            rebounds: Vec::new(),
            last: RefCell::default(),
        };
        interpolated.rebounds = interpolated.at_nodes(&spheres)?;
        Ok(interpolated)
    }

    /// The rebounds of spheres at the nodes of the speeds. A sphere that never rebounds takes those of the nearest one that
    /// does, so that the polynomials of its neighbours stay smooth.
    fn at_nodes(&self, spheres: &[[f64; 2]]) -> Result<Vec<Vec<Rebound>>, PopulationError> {
        let mut rebounds = Vec::new();
        for index in 0..spheres.len() {
            let Some(source) = self.nearest_that_rebounds(index) else {
                // None does.
                rebounds.push(vec![Rebound { restitution: 0.0, stopped: f64::INFINITY }; self.speeds.count()]);
                continue;
            };
            let [diameter, adhesion] = spheres[source];
            let mut row = Vec::new();
            for position in self.speeds.positions() {
                let speed = match &self.inverses {
                    Some(inverses) => position.cosh().max(1.0 + CLOSE) / inverses[source][0],
                    None => position.exp(),
                };
                row.push(self.response.rebound(diameter, adhesion, speed.min(FASTEST))?);
            }
            rebounds.push(row);
        }
        Ok(rebounds)
    }

    fn nearest_that_rebounds(&self, index: usize) -> Option<usize> {
        let Some(inverses) = &self.inverses else { return Some(index) };
        let place = |index: usize| (index / self.adhesions.count(), index % self.adhesions.count());
        let (row, column) = place(index);
        let distance = |other: &usize| {
            let (other_row, other_column) = place(*other);
            row.abs_diff(other_row) + column.abs_diff(other_column)
        };
        (0..inverses.len()).filter(|other| inverses[*other][0] > 0.0).min_by_key(distance)
    }

    /// What was asked for of spheres of an adhesion.
    fn of_adhesion(&self, adhesion: f64) -> RefMut<'_, OneAdhesion> {
        let mut last = self.last.borrow_mut();
        if last.inverses.is_empty() || last.adhesion != adhesion {
            let columns =
                if self.adhesions.count() == 1 { (0, vec![1.0]) } else { self.adhesions.weights(adhesion.ln()) };
            let rows = self.diameters.count();
            *last = OneAdhesion { adhesion, columns, inverses: vec![None; rows], rebounds: vec![None; rows] };
        }
        last
    }

    /// Inverse of the critical speed and its logarithm at a node of the diameters.
    fn inverse_at(&self, last: &mut OneAdhesion, inverses: &[[f64; 2]], row: usize) -> [f64; 2] {
        if let Some(known) = last.inverses[row] {
            return known;
        }
        let mut sums = [0.0; 2];
        last.near(row, self.adhesions.count(), |weight, index| {
            sums = [0, 1].map(|part: usize| sums[part] + weight * inverses[index][part]);
        });
        last.inverses[row] = Some(sums);
        sums
    }

    /// The rebounds at the nodes of the speeds, at a node of the diameters.
    fn rebounds_at<'b>(&self, last: &'b mut OneAdhesion, row: usize) -> &'b [Rebound] {
        if last.rebounds[row].is_none() {
            let mut sums = vec![Rebound { restitution: 0.0, stopped: 0.0 }; self.speeds.count()];
            last.near(row, self.adhesions.count(), |weight, index| {
                for (sum, rebound) in sums.iter_mut().zip(&self.rebounds[index]) {
                    sum.restitution += weight * rebound.restitution;
                    sum.stopped += weight * rebound.stopped;
                }
            });
            last.rebounds[row] = Some(sums);
        }
        last.rebounds[row].as_deref().unwrap_or_default()
    }
}

/// Inverses of critical speeds and their logarithms, zero where spheres of every speed are captured; `None` if spheres of every speed
/// rebound.
fn inverses(found: &[CriticalSpeed<f64>]) -> Result<Option<Vec<[f64; 2]>>, PopulationError> {
    if found.iter().all(|critical| *critical == CriticalSpeed::AlwaysRebounds) {
        return Ok(None);
    }
    let inverse = |critical: &CriticalSpeed<f64>| match critical {
        CriticalSpeed::At(speed) => Ok([1.0 / speed, -speed.ln()]),
        CriticalSpeed::NeverRebounds => Ok([0.0, f64::NEG_INFINITY]),
        CriticalSpeed::AlwaysRebounds => Err(PopulationError::ReboundsOfAPart),
    };
    found.iter().map(inverse).collect::<Result<_, _>>().map(Some)
}

impl<R: Response> Response for Interpolated<'_, R> {
    fn critical_speed(&self, diameter: f64, adhesion: f64) -> Result<CriticalSpeed<f64>, PopulationError> {
        let Some(inverses) = &self.inverses else { return Ok(CriticalSpeed::AlwaysRebounds) };
        let mut last = self.of_adhesion(adhesion);
        let (first, weights) = self.diameters.weights(diameter.ln());
        let (mut inverse, mut logarithm) = (0.0, 0.0);
        for (row, weight) in (first..).zip(weights) {
            let at_row = self.inverse_at(&mut last, inverses, row);
            (inverse, logarithm) = (inverse + weight * at_row[0], logarithm + weight * at_row[1]);
        }
        if logarithm.is_finite() {
            inverse = logarithm.exp();
        }
        Ok(if inverse > 1.0 / FASTEST { CriticalSpeed::At(1.0 / inverse) } else { CriticalSpeed::NeverRebounds })
    }

    fn rebound(&self, diameter: f64, adhesion: f64, speed: f64) -> Result<Rebound, PopulationError> {
        let position = match self.critical_speed(diameter, adhesion)? {
            CriticalSpeed::At(critical) => (speed / critical).max(1.0).acosh(),
            _ => speed.ln(),
        };
        let weights = self.speeds.weights(position.max(self.reach[0]).min(self.reach[1]));
        let mut last = self.of_adhesion(adhesion);
        let (first, rows) = self.diameters.weights(diameter.ln());
        let mut sum = Rebound { restitution: 0.0, stopped: 0.0 };
        for (row, row_weight) in (first..).zip(rows) {
            for (rebound, weight) in self.rebounds_at(&mut last, row).iter().zip(&weights) {
                sum.restitution += row_weight * weight * rebound.restitution;
                sum.stopped += row_weight * weight * rebound.stopped;
            }
        }
        Ok(Rebound { restitution: sum.restitution.clamp(0.0, 1.0), stopped: sum.stopped })
    }

    fn stopped_in_capture(&self, diameter: f64, adhesion: f64) -> Result<f64, PopulationError> {
        self.response.stopped_in_capture(diameter, adhesion)
    }
}
