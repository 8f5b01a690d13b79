//! The likelihood of measured impacts.
//!
//! The true approach speed V of a row is normal about the measured one; the rebound speed is w(V) + V d, with the curve w and the
//! natural scatter d of the restitution, and is measured with an error. V is integrated out. A capture is a scatter that takes more
//! than the whole rebound: w(V) + V d < 0, where w continues below zero. Few rows may be outliers, with any restitution.

mod residual;
mod row;
mod simulate;
mod straight;

use std::num::NonZeroUsize;

use gauss_quad::hermite::GaussHermite;

use crate::approach::log_density_slopes;
use crate::law::{Coordinate, Curve, Law, Size};
use crate::observation::{Observation, Response, median_mass};
use crate::scatter::Scatter;
use crate::stop::Stop;
use straight::Border;

/// A row in reference speeds.
#[derive(Clone, Copy, Debug)]
struct Datum {
    /// Measured approach speed.
    speed: f64,
    /// Mean of the true approach speed, given the measured one.
    mean: f64,
    variance: f64,
    /// Measured rebound speed and its variance; `None` for a capture.
    rebound: Option<(f64, f64)>,
    size: Size,
    /// Relative error of the mass.
    mass_error: f64,
    /// Rank of the speed, from -1 to 1.
    rank: f64,
}

/// Parameters besides those of the law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nuisance {
    /// Variance of the core of the scatter.
    Variance,
    /// Probability of an outlier.
    Outlier,
    /// Weight of the tail of the scatter.
    TailWeight,
    /// Mean of the tail less that of the core.
    TailOffset,
    /// Median of the scatter, which the shape of a skewed distribution determines roughly only.
    Median,
    /// Coefficient of a Legendre polynomial in the rank of the speed, which is added to the curve.
    Trend(usize),
}

/// The likelihood of a law.
pub struct Likelihood {
    data: Vec<Datum>,
    law: Law,
    coordinates: Vec<Coordinate>,
    /// Parameters after those of the law.
    nuisances: Vec<Nuisance>,
    /// The reference speed, m/s: the largest measured approach speed.
    pub reference: f64,
    radii: (f64, f64),
    captures: usize,
    nodes: Vec<(f64, f64)>,
    least_variance: f64,
    /// Squared steepness of the curve at rows over whose error it is straight, from a first fit.
    straight: Vec<Option<f64>>,
    border: Option<Border>,
    without_adhesion: bool,
    /// Whether the steepness at straight rows is kept altogether, so that a trend cannot hide behind a steeper curve.
    keep_steepness: bool,
    /// There are no more curves once it is asked.
    stop: Stop,
}

/// Restitutions of outliers reach beyond one by as much as errors do.
const OUTLIER_REACH: f64 = 1.2;

/// Probability that an outlier is a capture, where captures are recorded.
const OUTLIER_CAPTURE: f64 = 0.5;

/// Rows of a beta prior that are no outliers. It keeps few rows from being explained as outliers.
const PRIOR_ROWS: f64 = 14.0;

/// Standard deviation of the median of a skewed scatter, over that of the core: distributions that fit the glass beads in
/// `host-tests/data` equally well have medians that differ by as much.
const MEDIAN_ERROR: f64 = 0.15;

/// Largest speed over the yield speed for which the elastic-plastic law holds: the sphere must stay larger than the contact.
const SLOWEST_YIELD: f64 = 100.0;

/// Largest variance of the scatter: restitutions lie between 0 and 1.
const LARGEST_VARIANCE: f64 = 1.0;

/// Nodes of the integrals, for standard normal variables.
const NODES: usize = 9;

impl Likelihood {
    /// The likelihood of a law.
    #[must_use]
    pub fn new(observations: &[Observation], law: Law) -> Self {
        let reference = observations.iter().map(|o| o.speed).fold(1e-300, f64::max);
        let median = median_mass(observations);
        let datum = |observation: &Observation| {
            let (size, mass_error) = match (observation.sphere, median) {
                (Some(sphere), Some(median)) => (Size::of_mass(sphere.mass, median), sphere.relative_error),
                _ => (Size::MEDIAN, 0.0),
            };
            let rebound = match observation.response {
                Response::Rebound { speed, error } => Some((speed / reference, (error / reference).powi(2))),
                Response::Capture => None,
            };
            let (speed, variance) = (observation.speed / reference, (observation.speed_error / reference).powi(2));
            Datum { speed, mean: speed, variance, rebound, size, mass_error, rank: 0.0 }
        };
        let mut data: Vec<Datum> = observations.iter().map(datum).collect();
        arrange(&mut data);
        let radius = |datum: &Datum| datum.size.log_radius;
        let (low, high) = data.iter().map(radius).fold((0.0_f64, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        let rule = GaussHermite::new(NonZeroUsize::new(NODES).unwrap_or(NonZeroUsize::MIN));
        let root = std::f64::consts::PI.sqrt();
        let nodes = rule.as_node_weight_pairs();
        Self {
            law,
            coordinates: law.coordinates(Coordinate::Work),
            nuisances: vec![Nuisance::Variance, Nuisance::Outlier],
            reference,
            radii: (low.exp(), high.exp()),
            captures: data.iter().filter(|datum| datum.rebound.is_none()).count(),
            nodes: nodes.iter().map(|(node, weight)| (std::f64::consts::SQRT_2 * node, weight / root)).collect(),
            straight: vec![None; data.len()],
            data,
            border: None,
            without_adhesion: false,
            keep_steepness: false,
            stop: Stop::default(),
            least_variance: 1e-12,
        }
    }

    /// Whatever is computed with it ends soon after `stop` is asked, without a result.
    pub fn until(&mut self, stop: &Stop) {
        self.stop = stop.clone();
    }

    /// What ends its computations.
    pub fn stop(&self) -> &Stop {
        &self.stop
    }

    /// The same rows with other parameters.
    pub fn set_parameters(&mut self, adhesion: Coordinate, nuisances: &[Nuisance]) {
        self.coordinates = self.law.coordinates(adhesion);
        self.nuisances = nuisances.to_vec();
    }

    /// The least variance of the scatter that a fit may find, so that no curve through two exact rows has an infinite likelihood.
    pub fn set_least_variance(&mut self, variance: f64) {
        self.least_variance = variance.min(LARGEST_VARIANCE);
    }

    /// The parameters of the law.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// The other parameters.
    pub fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.data.len()
    }

    /// Number of captures.
    pub fn captures(&self) -> usize {
        self.captures
    }

    /// Variance of the errors of a row's restitution, without scatter.
    pub fn error_variances(&self) -> impl Iterator<Item = f64> + '_ {
        self.data.iter().filter_map(|datum| {
            let (rebound, variance) = datum.rebound?;
            let restitution = rebound / datum.speed;
            Some((variance + restitution * restitution * datum.variance) / (datum.speed * datum.speed))
        })
    }

    /// Bounds of each parameter.
    pub fn bounds(&self) -> Vec<(f64, f64)> {
        let law = self.coordinates.iter().map(|coordinate| match coordinate {
            Coordinate::Restitution => (1e-3, 1.0),
            Coordinate::Loss => (0.0, 1e3),
            Coordinate::YieldSpeed => (-SLOWEST_YIELD.ln(), 0.5),
            Coordinate::Viscosity => (0.0, 50.0),
            Coordinate::Work | Coordinate::CriticalSpeed if self.without_adhesion => (0.0, 0.0),
            Coordinate::Work => (0.0, 1.0),
            Coordinate::CriticalSpeed => (0.0, 1.0),
            Coordinate::Damping => (1e-3, 50.0),
            Coordinate::AdhesionDamping => (0.0, 5.0),
        });
        let nuisances = self.nuisances.iter().map(|nuisance| match nuisance {
            Nuisance::Variance => (self.least_variance, LARGEST_VARIANCE),
            Nuisance::Outlier => (1e-6, 0.4),
            Nuisance::TailWeight => (0.0, 0.45),
            Nuisance::TailOffset => (-1.0, 1.0),
            Nuisance::Trend(_) | Nuisance::Median => (-2.0, 2.0),
        });
        law.chain(nuisances).collect()
    }

    /// The curve of some parameters.
    pub fn curve(&self, values: &[f64]) -> Option<Curve> {
        if self.stop.is_asked() {
            return None;
        }
        self.law.curve(&self.coordinates, &values[..self.coordinates.len()], self.radii, 1.0)
    }

    /// A nuisance among some parameters, or its value where it is none of them.
    pub fn nuisance(&self, values: &[f64], wanted: Nuisance) -> f64 {
        let place = self.nuisances.iter().position(|nuisance| *nuisance == wanted);
        place.map_or(0.0, |place| values[self.coordinates.len() + place])
    }

    /// The scatter of some parameters.
    pub fn scatter(&self, values: &[f64]) -> Scatter {
        let [variance, weight, offset] = [Nuisance::Variance, Nuisance::TailWeight, Nuisance::TailOffset]
            .map(|wanted| self.nuisance(values, wanted));
        Scatter::new(variance.max(self.least_variance), weight, offset)
    }

    /// Logarithm of the likelihood of each row; `false` if there is no curve with these parameters.
    pub fn rows(&self, values: &[f64], rows: &mut [f64]) -> bool {
        let Some(curve) = self.curve(values) else {
            return false;
        };
        let (scatter, outlier) = (self.scatter(values), self.nuisance(values, Nuisance::Outlier));
        let trend = &values[self.coordinates.len()..];
        let median = self.nuisance(values, Nuisance::Median);
        for ((row, datum), straight) in rows.iter_mut().zip(&self.data).zip(&self.straight) {
            if self.stop.is_asked() {
                return false;
            }
            let mut shift = median;
            for (nuisance, coefficient) in self.nuisances.iter().zip(trend) {
                if let Nuisance::Trend(degree) = nuisance {
                    shift += coefficient * legendre(*degree, datum.rank);
                }
            }
            let regular = self.regular(&curve, &scatter, datum, *straight, shift);
            let outlying = match datum.rebound {
                None => OUTLIER_CAPTURE,
                Some(_) => self.outlier_rebound() / (OUTLIER_REACH * datum.speed),
            };
            *row = ((1.0 - outlier) * regular + outlier * outlying).max(1e-300).ln();
        }
        if let Some(Border { row, factor, rebound }) = self.border {
            let datum = &self.data[row];
            rows[row] += factor * (curve.rebound(datum.speed, datum.size) - rebound);
        }
        true
    }

    fn outlier_rebound(&self) -> f64 {
        if self.captures > 0 { 1.0 - OUTLIER_CAPTURE } else { 1.0 }
    }

    /// Logarithm of the prior.
    pub fn prior(&self, values: &[f64]) -> f64 {
        let median = self.nuisance(values, Nuisance::Median);
        PRIOR_ROWS * (1.0 - self.nuisance(values, Nuisance::Outlier)).ln()
            - 0.5 * median * median * self.median_precision(values)
    }

    /// Information of the prior on a parameter, so far as it is not in the rows.
    pub fn prior_information(&self, values: &[f64], index: usize) -> f64 {
        let nuisance = index.checked_sub(self.coordinates.len()).map(|place| self.nuisances[place]);
        if nuisance == Some(Nuisance::Median) { self.median_precision(values) } else { 0.0 }
    }

    fn median_precision(&self, values: &[f64]) -> f64 {
        let variance = self.nuisance(values, Nuisance::Variance).max(self.least_variance);
        1.0 / (MEDIAN_ERROR * MEDIAN_ERROR * variance)
    }

    /// Leaves adhesion out of the law.
    pub fn leave_adhesion_out(&mut self) {
        self.without_adhesion = true;
    }

    /// Whether the steepness at straight rows is kept altogether.
    pub fn keep_steepness(&mut self, keep: bool) {
        self.keep_steepness = keep;
    }
}

/// Finds each row's place among all: the rank of its speed, and the mean of its true approach speed.
fn arrange(data: &mut [Datum]) {
    let speeds: Vec<f64> = data.iter().map(|datum| datum.speed).collect();
    let mut order: Vec<usize> = (0..speeds.len()).collect();
    order.sort_by(|a, b| speeds[*a].total_cmp(&speeds[*b]));
    for (place, index) in order.into_iter().enumerate() {
        data[index].rank = (2.0 * place as f64 + 1.0) / speeds.len() as f64 - 1.0;
    }
    for (datum, slope) in data.iter_mut().zip(log_density_slopes(&speeds)) {
        datum.mean = (datum.speed + datum.variance * slope).clamp(0.5 * datum.speed, 1.5 * datum.speed);
    }
}

/// Legendre polynomial.
fn legendre(degree: usize, x: f64) -> f64 {
    let (mut before, mut now) = (1.0, x);
    if degree == 0 {
        return 1.0;
    }
    for n in 1..degree {
        let n = n as f64;
        (before, now) = (now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0));
    }
    now
}
