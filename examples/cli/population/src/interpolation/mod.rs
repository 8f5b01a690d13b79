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

use std::cell::RefCell;

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
    /// Inverses of the critical speeds at the nodes, the adhesions innermost; `None` if all spheres rebound.
    inverses: Option<Vec<f64>>,
    /// The least and the largest t.
    reach: [f64; 2],
    /// Rebounds at the speeds of each pair of nodes.
    rebounds: Vec<Vec<Rebound>>,
    /// The last sphere that was asked for, with its rebounds at the speeds.
    last: RefCell<Option<([f64; 2], Vec<Rebound>)>>,
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
                let largest = inverses.iter().copied().fold(0.0, f64::max);
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
            last: RefCell::new(None),
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
                    Some(inverses) => position.cosh().max(1.0 + CLOSE) / inverses[source],
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
        (0..inverses.len()).filter(|other| inverses[*other] > 0.0).min_by_key(distance)
    }

    /// Adds up what the nodes near a sphere have.
    fn near(&self, diameter: f64, adhesion: f64, mut add: impl FnMut(f64, usize)) {
        let (first_row, rows) = self.diameters.weights(diameter.ln());
        let (first_column, columns) =
            if self.adhesions.count() == 1 { (0, vec![1.0]) } else { self.adhesions.weights(adhesion.ln()) };
        for (row, row_weight) in rows.iter().enumerate() {
            for (column, column_weight) in columns.iter().enumerate() {
                let index = (first_row + row) * self.adhesions.count() + first_column + column;
                add(row_weight * column_weight, index);
            }
        }
    }

    /// The rebounds of a sphere at the nodes of the speeds.
    fn rebounds_of(&self, diameter: f64, adhesion: f64) -> Vec<Rebound> {
        let mut sums = vec![Rebound { restitution: 0.0, stopped: 0.0 }; self.speeds.count()];
        self.near(diameter, adhesion, |weight, index| {
            for (sum, rebound) in sums.iter_mut().zip(&self.rebounds[index]) {
                sum.restitution += weight * rebound.restitution;
                sum.stopped += weight * rebound.stopped;
            }
        });
        sums
    }
}

/// Inverses of critical speeds, zero where spheres of every speed are captured; `None` if spheres of every speed rebound.
fn inverses(found: &[CriticalSpeed<f64>]) -> Result<Option<Vec<f64>>, PopulationError> {
    if found.iter().all(|critical| *critical == CriticalSpeed::AlwaysRebounds) {
        return Ok(None);
    }
    let inverse = |critical: &CriticalSpeed<f64>| match critical {
        CriticalSpeed::At(speed) => Ok(1.0 / speed),
        CriticalSpeed::NeverRebounds => Ok(0.0),
        CriticalSpeed::AlwaysRebounds => Err(PopulationError::ReboundsOfAPart),
    };
    found.iter().map(inverse).collect::<Result<_, _>>().map(Some)
}

impl<R: Response> Response for Interpolated<'_, R> {
    fn critical_speed(&self, diameter: f64, adhesion: f64) -> Result<CriticalSpeed<f64>, PopulationError> {
        let Some(inverses) = &self.inverses else { return Ok(CriticalSpeed::AlwaysRebounds) };
        let (mut inverse, mut logarithm) = (0.0, 0.0);
        self.near(diameter, adhesion, |weight, index| {
            inverse += weight * inverses[index];
            logarithm += weight * inverses[index].ln();
        });
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
        let mut last = self.last.borrow_mut();
        let rebounds = match &mut *last {
            Some((sphere, rebounds)) if *sphere == [diameter, adhesion] => rebounds,
            other => &mut other.insert(([diameter, adhesion], self.rebounds_of(diameter, adhesion))).1,
        };
        let sum =
            |of: fn(&Rebound) -> f64| rebounds.iter().zip(&weights).map(|(rebound, weight)| weight * of(rebound)).sum();
        let restitution: f64 = sum(|rebound| rebound.restitution);
        Ok(Rebound { restitution: restitution.clamp(0.0, 1.0), stopped: sum(|rebound| rebound.stopped) })
    }

    fn stopped_in_capture(&self, diameter: f64, adhesion: f64) -> Result<f64, PopulationError> {
        self.response.stopped_in_capture(diameter, adhesion)
    }
}
