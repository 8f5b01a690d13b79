//! A joint fit of the contact simulation to many measured impacts: strength of adhesion f0, both dampings, and the
//! distribution of the particles' diameters, which are not known one by one.
//!
//! Diameters are log-normal. At each speed the scene of every diameter gives a restitution, so the distribution of diameters
//! gives a mean and a variance of the restitution. The variance of the instrument is added. The fit uses both at once
//! (generalised least squares with an estimated variance function, Carroll and Ruppert 1988), with derivatives by dual
//! numbers.
//!
//! The restitution depends on f0 and on the diameter only through their ratio: speeds and restitutions alone cannot
//! determine both. A measured mean diameter with its standard error is therefore part of the data.

use std::fmt;
use std::num::NonZeroUsize;

use gauss_quad::hermite::GaussHermite;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use microimpact::contact::{AnyLaw, Collocation, Contact, Nodes};
use microimpact::{Dual, Fault, InputError, NormalMotion, Parameter, Real, Sphere, Stiffness};
use nalgebra::storage::Owned;
use nalgebra::{Const, DVector, Dyn, OMatrix, SMatrix, SVector};

/// Number of parameters.
pub const COUNT: usize = 5;

/// Names and units of the parameters, in their order.
pub const NAMES: [(&str, &str); COUNT] =
    [("f0", "N/m"), ("zeta_H", "1"), ("zeta_A", "1"), ("mean diameter", "m"), ("relative spread of diameters", "1")];

/// f0, zeta_H, zeta_A, mean diameter, and the standard deviation of the logarithm of diameters.
pub type Parameters = [f64; COUNT];

/// The index of zeta_A, whose error may be as large as its value: it is fitted directly, all others by their logarithms.
const PLAIN: usize = 2;

/// The value of a parameter at a deviation from another value of it.
fn deviated<T: Real>(parameter: usize, value: f64, deviation: T) -> T {
    if parameter == PLAIN { T::constant(value) + deviation } else { T::constant(value) * deviation.exp() }
}

/// The deviation of a parameter from another value of it.
fn deviation(parameter: usize, value: f64, from: f64) -> f64 {
    if parameter == PLAIN { value - from } else { (value / from).ln() }
}

/// What is known before the fit.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Hertz stiffness, Pa.
    pub stiffness: f64,
    /// Density of the particles, kg/m^3.
    pub density: f64,
    /// Standard error of a measured restitution.
    pub noise: f64,
    /// Mean diameter as measured by other means, m, and its standard error.
    pub diameter: (f64, f64),
}

/// A measured impact: approach speed, m/s, and restitution, zero for a capture.
#[derive(Clone, Copy, Debug)]
pub struct Impact {
    /// Approach speed, m/s.
    pub speed: f64,
    /// Restitution.
    pub restitution: f64,
}

/// Why there is no fit.
#[derive(Debug)]
pub enum FitError {
    /// A value outside its range.
    Input(InputError),
    /// Fewer impacts than three times the parameters.
    TooFew,
    /// The least squares did not converge.
    NotConverged(String),
    /// The impacts do not determine all parameters.
    Singular,
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::TooFew => write!(f, "there are too few impacts: a joint fit needs {} impacts at least", 3 * COUNT),
            Self::NotConverged(reason) => {
                write!(f, "the least squares did not converge: {reason}; use other values of --first")
            }
            Self::Singular => f.write_str("the impacts do not determine all parameters; add impacts at other speeds"),
        }
    }
}

impl std::error::Error for FitError {}

impl From<InputError> for FitError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

/// Mean and variance of the restitution over the diameters, at one speed.
#[derive(Clone, Copy, Debug)]
pub struct Moments<T> {
    /// Mean.
    pub mean: T,
    /// Variance.
    pub variance: T,
}

/// The fitted parameters with their uncertainty.
pub struct JointFit {
    /// The parameters.
    pub parameters: Parameters,
    /// Covariance of the logarithms of the parameters, but of zeta_A itself.
    pub covariance: SMatrix<f64, COUNT, COUNT>,
    /// The impacts with what the fit predicts for each.
    pub predictions: Vec<(Impact, Moments<f64>)>,
    /// Standard error of a measured restitution.
    noise: f64,
}

/// Nodes over the distribution of diameters.
const DIAMETERS: usize = 9;

/// Rounds of least squares; each uses the variances of the previous one.
const ROUNDS: usize = 4;

/// Standard errors by which a measured restitution may lie outside its range.
const FARTHEST: f64 = 5.0;

/// Bounds that hold 95 % of a standard normal variable, and of the sum of squares of two.
const WITHIN: (f64, f64) = (1.959_964, 5.991_465);

impl JointFit {
    /// The fit to some impacts, from a first value of the parameters.
    ///
    /// # Errors
    /// A value outside its range, too few impacts, or impacts that do not determine the parameters.
    pub fn of(known: &Known, impacts: &[Impact], first: Parameters) -> Result<Self, FitError> {
        if impacts.len() < 3 * COUNT {
            return Err(FitError::TooFew);
        }
        for error in [known.noise, known.diameter.1] {
            // Both are divisors.
            if Parameter::StandardError.check(error)? <= 0.0 {
                let (parameter, fault) = (Parameter::StandardError, Fault::TooSmall);
                return Err(InputError { parameter, fault, value: error as f32 }.into());
            }
        }
        // Errors may carry a measurement beyond its range, but not far.
        let reach = FARTHEST * known.noise;
        for impact in impacts.iter().filter(|impact| !(-reach..=1.0 + reach).contains(&impact.restitution)) {
            Parameter::Restitution.check(impact.restitution)?;
        }
        let mut speeds: Vec<f64> = impacts.iter().map(|impact| impact.speed).collect();
        speeds.sort_by(f64::total_cmp);
        speeds.dedup();
        let mut problem = Problem {
            model: Model { known: *known, speeds, quadrature: quadrature() },
            impacts: impacts.to_vec(),
            first,
            deviations: SVector::zeros(),
            before: Vec::new(),
            scatter: false,
        };
        problem.before = problem.model.moments(first)?;
        for round in 0..ROUNDS {
            // Only deviations from a fitted mean contain the variance.
            problem.scatter = round > 0;
            // A short first step in unscaled deviations keeps the parameters within their ranges.
            let method = LevenbergMarquardt::new().with_tol(1e-9).with_patience(40);
            let (solved, report) = method.with_scale_diag(false).with_stepbound(0.3).minimize(problem);
            problem = solved;
            if !report.termination.was_successful() {
                return Err(FitError::NotConverged(format!("{:?}", report.termination)));
            }
            problem.before = problem.model.moments(problem.parameters())?;
        }
        let covariance = problem.covariance()?;
        let predictions =
            impacts.iter().map(|impact| (*impact, problem.before[problem.model.index(impact.speed)])).collect();
        Ok(Self { parameters: problem.parameters(), covariance, predictions, noise: known.noise })
    }

    /// Bounds of a parameter that hold it with 95 % probability.
    #[must_use]
    pub fn interval(&self, parameter: usize) -> (f64, f64) {
        let reach = WITHIN.0 * self.covariance[(parameter, parameter)].sqrt();
        let bound = |reach: f64| deviated(parameter, self.parameters[parameter], reach);
        (bound(-reach), bound(reach))
    }

    /// Outline of the region that holds two parameters together with 95 % probability.
    #[must_use]
    pub fn region(&self, first: usize, second: usize) -> Vec<(f64, f64)> {
        let (a, b) = (self.covariance[(first, first)].sqrt(), self.covariance[(second, second)].sqrt());
        let correlation = self.covariance[(first, second)] / (a * b);
        let (reach, rest) = (WITHIN.1.sqrt(), (1.0 - correlation * correlation).max(0.0).sqrt());
        let at = |step: u32| {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(step) / 120.0).sin_cos();
            let (x, y) = (reach * a * cosine, reach * b * (correlation * cosine + rest * sine));
            (deviated(first, self.parameters[first], x), deviated(second, self.parameters[second], y))
        };
        (0..=120).map(at).collect()
    }

    /// Whether a pair of values lies in the region of 95 %.
    #[must_use]
    pub fn region_holds(&self, first: (usize, f64), second: (usize, f64)) -> bool {
        let indices = [first.0, second.0];
        let off = |(index, value): (usize, f64)| deviation(index, value, self.parameters[index]);
        let off = nalgebra::Vector2::new(off(first), off(second));
        let covariance = nalgebra::Matrix2::from_fn(|i, j| self.covariance[(indices[i], indices[j])]);
        covariance.try_inverse().is_some_and(|inverse| (off.transpose() * inverse * off)[0] <= WITHIN.1)
    }

    /// Residuals of the impacts over their standard deviation, noise and spread of diameters together, with their speeds.
    pub fn residuals(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.predictions.iter().map(|(impact, moments)| {
            let deviation = (moments.variance + self.noise * self.noise).sqrt();
            (impact.speed, (impact.restitution - moments.mean) / deviation)
        })
    }
}

/// Deviates and weights of a standard normal distribution.
fn quadrature() -> Vec<(f64, f64)> {
    let nodes = GaussHermite::new(NonZeroUsize::new(DIAMETERS).unwrap_or(NonZeroUsize::MIN));
    let root = std::f64::consts::PI.sqrt();
    nodes.as_node_weight_pairs().iter().map(|(node, weight)| (std::f64::consts::SQRT_2 * node, weight / root)).collect()
}

/// The restitution of a sphere.
///
/// # Errors
/// A value outside its range.
pub fn restitution<T: Nodes<9>>(
    known: &Known,
    [f0, zeta_h, zeta_a, diameter]: [T; 4],
    speed: f64,
) -> Result<T, InputError> {
    let sphere = Sphere::solid(T::constant(0.5) * diameter, T::constant(known.density))?;
    let law = AnyLaw::ring(Stiffness::new(T::constant(known.stiffness))?, f0, zeta_a)?.with_damping(zeta_h)?;
    let (scene, method) = (Contact::new(sphere, law), Collocation::<9, T>::new(T::constant(1e-9))?);
    Ok(scene.solve_normal(&NormalMotion::new(T::constant(speed))?, &method)?.overall_restitution())
}

/// Restitutions at all speeds, each once.
struct Model {
    known: Known,
    /// In rising order.
    speeds: Vec<f64>,
    quadrature: Vec<(f64, f64)>,
}

impl Model {
    fn index(&self, speed: f64) -> usize {
        self.speeds.partition_point(|other| *other < speed)
    }

    fn moments<T: Nodes<9>>(&self, parameters: [T; COUNT]) -> Result<Vec<Moments<T>>, InputError> {
        let [f0, zeta_h, zeta_a, mean, spread] = parameters;
        let half = T::constant(0.5);
        let at = |speed: &f64| {
            let (mut first, mut second) = (T::ZERO, T::ZERO);
            for (deviate, weight) in &self.quadrature {
                let diameter = mean * (spread * T::constant(*deviate) - half * spread * spread).exp();
                let e = restitution(&self.known, [f0, zeta_h, zeta_a, diameter], *speed)?;
                first = first + T::constant(*weight) * e;
                second = second + T::constant(*weight) * e * e;
            }
            Ok(Moments { mean: first, variance: (second - first * first).max(T::ZERO) })
        };
        self.speeds.iter().map(at).collect()
    }
}

/// Least squares of deviations from the mean, and of their squares from the variance. The means and variances of the previous
/// round stand where a quantity must not depend on the parameters.
struct Problem {
    model: Model,
    impacts: Vec<Impact>,
    first: Parameters,
    /// Deviations of the parameters from their first values.
    deviations: SVector<f64, COUNT>,
    before: Vec<Moments<f64>>,
    /// Whether the spread is fitted too, to the squares of the deviations.
    scatter: bool,
}

impl Problem {
    fn parameters(&self) -> Parameters {
        std::array::from_fn(|index| deviated(index, self.first[index], self.deviations[index]))
    }

    /// Both residuals of each impact, and last that of the measured mean diameter.
    fn all_residuals<T: Nodes<9>>(&self, parameters: [T; COUNT]) -> Result<Vec<T>, InputError> {
        let moments = self.model.moments(parameters)?;
        let noise = self.model.known.noise * self.model.known.noise;
        let mut residuals = Vec::with_capacity(2 * self.impacts.len() + 1);
        for impact in &self.impacts {
            let index = self.model.index(impact.speed);
            let (now, before) = (moments[index], self.before[index]);
            let variance = before.variance + noise;
            let off = impact.restitution - before.mean;
            residuals.push((T::constant(impact.restitution) - now.mean) / T::constant(variance.sqrt()));
            let excess = T::constant(off * off - noise) - now.variance;
            let scatter = T::constant(if self.scatter { 1.0 } else { 0.0 });
            residuals.push(scatter * excess / T::constant(std::f64::consts::SQRT_2 * variance));
        }
        let (diameter, error) = self.model.known.diameter;
        residuals.push((parameters[3] - T::constant(diameter)) / T::constant(error));
        Ok(residuals)
    }

    /// The same, with derivatives by the deviations of the parameters.
    fn derivatives(&self) -> Result<Vec<Dual<f64, COUNT>>, InputError> {
        let deviations = Dual::variables(self.deviations.into());
        let parameters = std::array::from_fn(|index| {
            let fixed = index + 1 == COUNT && !self.scatter;
            let deviation = if fixed { Dual::fixed(self.deviations[index]) } else { deviations[index] };
            deviated(index, self.first[index], deviation)
        });
        self.all_residuals(parameters)
    }

    /// Covariance of the deviations, whatever the distribution of the residuals (White's sandwich).
    fn covariance(&self) -> Result<SMatrix<f64, COUNT, COUNT>, FitError> {
        let residuals = self.derivatives()?;
        let mut normal = SMatrix::<f64, COUNT, COUNT>::zeros();
        let mut squares = normal;
        for pair in residuals.chunks(2) {
            let mut gradient = SVector::<f64, COUNT>::zeros();
            for residual in pair {
                let slope = SVector::from(residual.partials);
                normal += slope * slope.transpose();
                gradient += slope * residual.value;
            }
            squares += if let [single] = pair {
                // The measured diameter is a single value, without scatter from which a variance could be estimated.
                let slope = SVector::from(single.partials);
                slope * slope.transpose()
            } else {
                gradient * gradient.transpose()
            };
        }
        let inverse = normal.try_inverse().ok_or(FitError::Singular)?;
        let freedom = self.impacts.len() as f64 / (self.impacts.len() - COUNT) as f64;
        let covariance = inverse * squares * inverse * freedom;
        if covariance.diagonal().iter().all(|variance| variance.is_finite() && *variance >= 0.0) {
            Ok(covariance)
        } else {
            Err(FitError::Singular)
        }
    }
}

impl LeastSquaresProblem<f64, Dyn, Const<COUNT>> for Problem {
    type ParameterStorage = Owned<f64, Const<COUNT>>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Const<COUNT>>;

    fn set_params(&mut self, deviations: &SVector<f64, COUNT>) {
        self.deviations = *deviations;
    }

    fn params(&self) -> SVector<f64, COUNT> {
        self.deviations
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        // Large residuals make the optimiser refuse a step that leaves the ranges of the parameters.
        let refused = || vec![1e6; 2 * self.impacts.len() + 1];
        Some(DVector::from_vec(self.all_residuals(self.parameters()).unwrap_or_else(|_| refused())))
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, Const<COUNT>>> {
        let residuals = self.derivatives().ok()?;
        Some(OMatrix::<f64, Dyn, Const<COUNT>>::from_fn(residuals.len(), |row, column| residuals[row].partials[column]))
    }
}
