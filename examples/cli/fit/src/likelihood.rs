//! The likelihood of measured impacts.
//!
//! The true approach speed V of a row is normal about the measured one; the rebound speed is w(V) + V d, with the curve w and the
//! natural scatter d of the restitution, and is measured with an error. V is integrated out. A capture is a scatter that takes more
//! than the whole rebound: w(V) + V d < 0, where w continues below zero. Few rows may be outliers, with any restitution.

use std::num::NonZeroUsize;

use gauss_quad::hermite::GaussHermite;

use crate::approach::log_density_slopes;
use crate::law::{Coordinate, Curve, Law, Size};
use crate::observation::{Observation, Response, median_mass};
use crate::scatter::{Part, Scatter, normal_below, normal_density};

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
}

/// Where straight rows begin, among others below.
///
/// The scores of straight rows have the mean zero if all rows with the same true speed are among them. Errors carry rows across the
/// border: of n f(u) rows per unit of speed, the mean score is -n f s^2 w' dw/dtheta/sigma^2. A term that is linear in w(u) takes it
/// away.
#[derive(Clone, Copy, Debug)]
struct Border {
    /// The slowest straight row.
    row: usize,
    factor: f64,
    /// Its rebound speed in the first fit, where the term is zero.
    rebound: f64,
}

/// Restitutions of outliers reach beyond one by as much as errors do.
const OUTLIER_REACH: f64 = 1.2;

/// Probability that an outlier is a capture, where captures are recorded.
const OUTLIER_CAPTURE: f64 = 0.5;

/// Rows of a beta prior that are no outliers. It keeps few rows from being explained as outliers.
const PRIOR_ROWS: f64 = 14.0;

/// Standard deviations of V over which the curve may be taken as straight: the distance to the critical speed must be larger.
const STRAIGHT: f64 = 12.0;

/// Largest curvature of a straight curve: the change of the mean rebound speed that it makes, in standard deviations of the row.
const CURVATURE: f64 = 0.03;

/// Standard deviation of the median of a skewed scatter, over that of the core: distributions that fit the glass beads in
/// `host-tests/data` equally well have medians that differ by as much.
const MEDIAN_ERROR: f64 = 0.15;

/// Largest speed over the yield speed for which the elastic-plastic law holds: the sphere must stay larger than the contact.
const SLOWEST_YIELD: f64 = 100.0;

/// Ratio of speeds within which rows count as near the border of straight rows.
const BORDER: f64 = 1.25;

/// Nodes of the integrals, for standard normal variables.
const NODES: usize = 9;

/// Least probability of a rebound that the likelihood is conditioned on.
const LEAST: f64 = 1e-3;

impl Likelihood {
    /// The likelihood of a law.
    #[must_use]
    pub fn new(observations: &[Observation], law: Law) -> Self {
        let reference = observations.iter().map(|o| o.speed).fold(1e-300, f64::max);
        let speeds: Vec<f64> = observations.iter().map(|o| o.speed / reference).collect();
        let slopes = log_density_slopes(&speeds);
        let median = median_mass(observations);
        let mut order: Vec<usize> = (0..speeds.len()).collect();
        order.sort_by(|a, b| speeds[*a].total_cmp(&speeds[*b]));
        let mut rank = vec![0.0; speeds.len()];
        for (place, index) in order.into_iter().enumerate() {
            rank[index] = (2.0 * place as f64 + 1.0) / speeds.len() as f64 - 1.0;
        }
        let datum = |(index, observation): (usize, &Observation)| {
            let variance = (observation.speed_error / reference).powi(2);
            let (size, mass_error) = match (observation.sphere, median) {
                (Some(sphere), Some(median)) => (Size::of_mass(sphere.mass, median), sphere.relative_error),
                _ => (Size::MEDIAN, 0.0),
            };
            let rebound = match observation.response {
                Response::Rebound { speed, error } => Some((speed / reference, (error / reference).powi(2))),
                Response::Capture => None,
            };
            let speed = speeds[index];
            let mean = (speed + variance * slopes[index]).clamp(0.5 * speed, 1.5 * speed);
            Datum { speed, mean, variance, rebound, size, mass_error, rank: rank[index] }
        };
        let data: Vec<Datum> = observations.iter().enumerate().map(datum).collect();
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
            least_variance: 1e-12,
        }
    }

    /// The same rows with other parameters.
    pub fn set_parameters(&mut self, adhesion: Coordinate, nuisances: &[Nuisance]) {
        self.coordinates = self.law.coordinates(adhesion);
        self.nuisances = nuisances.to_vec();
    }

    /// The least variance of the scatter that a fit may find, so that no curve through two exact rows has an infinite likelihood.
    pub fn set_least_variance(&mut self, variance: f64) {
        self.least_variance = variance;
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
            Nuisance::Variance => (self.least_variance, 1.0),
            Nuisance::Outlier => (1e-6, 0.4),
            Nuisance::TailWeight => (0.0, 0.45),
            Nuisance::TailOffset => (-1.0, 1.0),
            Nuisance::Trend(_) | Nuisance::Median => (-2.0, 2.0),
        });
        law.chain(nuisances).collect()
    }

    /// The curve of some parameters.
    pub fn curve(&self, values: &[f64]) -> Option<Curve> {
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

    /// Finds the rows over whose error a curve is straight.
    ///
    /// The likelihood of such a row shall depend on the curve through its distance alone (total least squares, Fuller 1987), so that
    /// the distribution of the true speeds does not matter. The steepness in its normalising factor is therefore kept.
    pub fn keep_straight_rows(&mut self, values: &[f64]) {
        let Some(curve) = self.curve(values) else {
            return;
        };
        let scatter = self.scatter(values);
        let straight = |datum: &Datum| {
            let (_, error) = datum.rebound?;
            let deviation = self.approach_variance(&curve, datum).sqrt();
            let at = |deviations: f64| curve.square(datum.speed + deviations * deviation, datum.size);
            let [before, (square, slope), after] = [-2.0, 0.0, 2.0].map(at);
            if before.0 <= 0.0 {
                return None;
            }
            let bend = (before.0.sqrt() + after.0.sqrt() - 2.0 * square.sqrt()).abs() / 8.0;
            let steepness = 0.25 * slope * slope / square;
            let variance =
                error + scatter.parts[0].variance * datum.speed * datum.speed + steepness * deviation * deviation;
            (bend * bend < CURVATURE * CURVATURE * variance).then_some(steepness)
        };
        self.straight = self.data.iter().map(straight).collect();
        let rows = || self.data.iter().zip(&self.straight).filter(|(datum, _)| datum.rebound.is_some());
        let fastest =
            rows().filter(|(_, straight)| straight.is_none()).map(|(datum, _)| datum.speed).fold(0.0, f64::max);
        for (datum, straight) in self.data.iter().zip(&mut self.straight) {
            if datum.speed <= fastest {
                *straight = None;
            }
        }
        self.border = if fastest > 0.0 { self.border_of(&curve, &scatter) } else { None };
    }

    fn border_of(&self, curve: &Curve, scatter: &Scatter) -> Option<Border> {
        let straight = |row: &usize| self.straight[*row].is_some();
        let row =
            (0..self.data.len()).filter(straight).min_by(|a, b| self.data[*a].speed.total_cmp(&self.data[*b].speed))?;
        let (datum, kept) = (self.data[row], self.straight[row]?);
        let near = |other: &&Datum| (1.0 / BORDER..BORDER).contains(&(other.speed / datum.speed));
        let density = self.data.iter().filter(near).count() as f64 / (datum.speed * (BORDER - 1.0 / BORDER));
        let variance = self.approach_variance(curve, &datum);
        let across = datum.rebound?.1 + scatter.parts[0].variance * datum.speed * datum.speed;
        let factor = density * variance * kept.sqrt() / (across + kept * variance);
        let rebound = curve.rebound(datum.speed, datum.size);
        factor.is_finite().then_some(Border { row, factor, rebound })
    }

    /// Likelihood of a row that is no outlier.
    fn regular(&self, curve: &Curve, scatter: &Scatter, datum: &Datum, straight: Option<f64>, shift: f64) -> f64 {
        let Some((rebound, error)) = datum.rebound else {
            return self.capture(curve, scatter, datum);
        };
        let rebound = rebound - shift * datum.speed;
        let parts = scatter.parts.iter().filter(|part| part.weight > 0.0);
        let density: f64 =
            parts.map(|part| part.weight * self.rebound(curve, part, datum, straight, (rebound, error))).sum();
        if self.captures > 0 {
            return density;
        }
        // A table without captures says nothing of the spheres that were not seen again.
        density / (1.0 - self.capture(curve, scatter, datum)).max(LEAST)
    }

    /// Variance of the true approach speed. An error of the mass acts as one of the speed at which adhesion takes the same part of
    /// the energy.
    fn approach_variance(&self, curve: &Curve, datum: &Datum) -> f64 {
        if datum.mass_error == 0.0 {
            return datum.variance;
        }
        let critical = curve.critical_speed(datum.size);
        datum.variance + (0.5 * datum.mass_error * critical * critical / datum.mean).powi(2)
    }

    /// Density of a measured rebound speed, with the scatter of one part.
    fn rebound(
        &self,
        curve: &Curve,
        part: &Part,
        datum: &Datum,
        straight: Option<f64>,
        (rebound, error): (f64, f64),
    ) -> f64 {
        let variance = self.approach_variance(curve, datum);
        let across = error + part.variance * datum.speed * datum.speed;
        let target = rebound - part.mean * datum.speed;
        if let Some(kept) = straight {
            let (square, slope) = curve.square(datum.speed, datum.size);
            if square <= 0.0 {
                return 0.0;
            }
            let steepness = if self.keep_steepness { kept } else { 0.25 * slope * slope / square };
            let total = across + steepness * variance;
            let density = normal_density(target - square.sqrt(), total);
            return density * (total / (across + kept * variance)).sqrt();
        }
        let (square, slope) = curve.square(datum.mean, datum.size);
        let deviation = variance.sqrt();
        let root = square.signum() * square.abs().sqrt();
        if square > STRAIGHT * slope * deviation || variance == 0.0 {
            let steepness = if root > 0.0 { 0.5 * slope / root } else { 0.0 };
            return normal_density(target - root, across + steepness * steepness * variance);
        }
        let (mode, width) = mode(curve, datum, variance, target, across, root);
        // The integral over rebound speeds, where the curve is smooth.
        let integrand = |w: f64| {
            let (speed, steepness) = curve.approach(w, datum.size);
            let exponent = (speed - datum.mean).powi(2) / variance + (target - w).powi(2) / across;
            steepness.abs() * (-0.5 * exponent).exp()
        };
        let sum: f64 = self
            .nodes
            .iter()
            .map(|(node, weight)| weight * integrand(mode + width * node) * (0.5 * node * node).exp())
            .sum();
        sum * width / (std::f64::consts::TAU * variance * across).sqrt()
    }

    /// Probability of a capture.
    fn capture(&self, curve: &Curve, scatter: &Scatter, datum: &Datum) -> f64 {
        let variance = self.approach_variance(curve, datum);
        let deviation = variance.sqrt();
        let root = curve.rebound(datum.mean, datum.size);
        let (low, high) = (datum.mean - 5.0 * deviation, datum.mean + 5.0 * deviation);
        if low <= 0.0 || variance == 0.0 || root > 0.5 * datum.mean {
            return scatter.below(-root / datum.mean);
        }
        // Far on either side of the critical speed, there is nothing to integrate.
        let bound = |speed: f64| scatter.below(-curve.rebound(speed, datum.size) / speed);
        let (most, least) = (bound(low), bound(high));
        if most - least < 1e-6 {
            return 0.5 * (most + least);
        }
        // A scatter d captures below the speed at which w(V) = -d V.
        let mut captured = 0.0;
        for part in scatter.parts.iter().filter(|part| part.weight > 0.0) {
            for (node, weight) in &self.nodes {
                let scattered = part.mean + part.variance.sqrt() * node;
                let (speed, _) = curve.approach(-scattered * datum.mean, datum.size);
                captured += part.weight * weight * normal_below((speed - datum.mean) / deviation);
            }
        }
        captured
    }

    /// Distances of the measured restitutions from a curve.
    pub fn deviations<'a>(&'a self, curve: &'a Curve) -> impl Iterator<Item = f64> + 'a {
        self.data.iter().map(|datum| {
            let measured = datum.rebound.map_or(0.0, |(rebound, _)| rebound / datum.speed);
            (measured - curve.restitution(datum.speed, datum.size)).abs()
        })
    }

    /// Residuals of the rebounds that are no outliers: normal deviates of the measured rebound speed.
    pub fn residuals(&self, values: &[f64]) -> Vec<Option<f64>> {
        let Some(curve) = self.curve(values) else {
            return vec![None; self.data.len()];
        };
        let scatter = self.scatter(values);
        let residual = |datum: &Datum| {
            let (rebound, error) = datum.rebound?;
            let (square, slope) = curve.square(datum.mean, datum.size);
            let root = square.max(0.0).sqrt();
            // Close to the critical speed the curve is steep over the whole error of the speed.
            let deviation = self.approach_variance(&curve, datum).sqrt();
            let rise = (square.max(0.0) + slope * deviation).sqrt() - root;
            let steepness = if root > 0.0 { (0.5 * slope / root * deviation).min(rise) } else { rise };
            let variance = error + steepness.powi(2) + scatter.variance() * datum.speed * datum.speed;
            Some((rebound - root) / variance.sqrt())
        };
        self.data.iter().map(residual).collect()
    }

    /// Probability of each row that its sphere rebounds.
    pub fn rebound_probabilities(&self, values: &[f64]) -> Vec<f64> {
        let Some(curve) = self.curve(values) else {
            return vec![1.0; self.data.len()];
        };
        let (scatter, outlier) = (self.scatter(values), self.nuisance(values, Nuisance::Outlier));
        let probability = |datum: &Datum| {
            let regular = 1.0 - self.capture(&curve, &scatter, datum);
            (1.0 - outlier) * regular + outlier * self.outlier_rebound()
        };
        self.data.iter().map(probability).collect()
    }

    /// Whether each row is a rebound.
    pub fn outcomes(&self) -> impl Iterator<Item = bool> + '_ {
        self.data.iter().map(|datum| datum.rebound.is_some())
    }

    /// Part of the variance of the rebounds that is scatter.
    pub fn scatter_fraction(&self, values: &[f64]) -> f64 {
        let scatter = self.scatter(values).variance();
        let (sum, count) = self
            .error_variances()
            .fold((0.0, 0.0), |(sum, count), error| (sum + scatter / (scatter + error), count + 1.0));
        if count > 0.0 { sum / count } else { 1.0 }
    }
}

/// The most likely rebound speed between the measured one and that of the curve, and its standard deviation.
fn mode(curve: &Curve, datum: &Datum, variance: f64, target: f64, across: f64, root: f64) -> (f64, f64) {
    let (mut low, mut high) = (target.min(root), target.max(root));
    let mut w = target.clamp(low, high);
    let mut precision = 1.0 / across;
    // Newton's method between bounds.
    for _ in 0..MOST_STEPS {
        let (speed, steepness) = curve.approach(w, datum.size);
        let gradient = (w - target) / across + (speed - datum.mean) * steepness / variance;
        precision = 1.0 / across + steepness * steepness / variance;
        if gradient > 0.0 {
            high = w;
        } else {
            low = w;
        }
        let next = w - gradient / precision;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        let step = (next - w).abs();
        w = next;
        if step * step * precision < 1e-4 {
            break;
        }
    }
    (w, 1.0 / precision.sqrt())
}

/// Steps to a mode; halving alone would come within a millionth of the bounds.
const MOST_STEPS: u32 = 20;

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
