//! The fit of one law, and the statements that follow from it.

use crate::judgement::{Judgement, judge};
use crate::law::{Coordinate, Curve, Law, Size};
use crate::likelihood::{Likelihood, Nuisance};
use crate::maximum::{Maximum, maximise};
use crate::observation::Observation;
use crate::profile::{Interval, drop_at_bounds, interval};
use crate::start::{PLAIN, SKEWED, starts};
use crate::stop::Stop;

/// How rows scatter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ScatterModel {
    /// Natural scatter is a parameter.
    #[default]
    Free,
    /// The stated errors are all of the scatter.
    Errors,
}

/// The most likely curve of one law.
pub struct LawFit {
    /// The law.
    pub law: Law,
    likelihood: Likelihood,
    maximum: Maximum,
    scatter_model: ScatterModel,
    /// Whether adhesion is part of the law, or the data do not show it.
    pub has_adhesion: bool,
    /// Number of parameters that are not at a bound.
    pub parameters: usize,
    /// Whether it fits.
    pub judgement: Judgement,
}

/// Gain of the likelihood, beyond that of two parameters by chance, that shows that the scatter is skewed.
const SKEWED_GAIN: f64 = 4.0;

/// Twice the gain of the likelihood that shows adhesion: chi-squared of one degree of freedom exceeds it in one of a thousand.
const ADHESION_GAIN: f64 = 10.83;

/// Rebounds from which on the tail of the scatter can be estimated.
const SKEWED_REBOUNDS: usize = 30;

/// Points of the ellipse that a band is made of.
const ELLIPSE: u32 = 24;

/// Weight and offset (in standard deviations) of the tail at the start.
const TAIL: (f64, f64) = (0.15, 3.0);

impl LawFit {
    /// Fits a law; `None` if no curve of it comes near the data.
    #[must_use]
    pub fn of(observations: &[Observation], law: Law, scatter_model: ScatterModel) -> Option<Self> {
        Self::until(&Stop::default(), observations, law, scatter_model)
    }

    /// The same, which ends soon after `stop` is asked; what it then gives is of no use.
    pub(crate) fn until(
        stop: &Stop,
        observations: &[Observation],
        law: Law,
        scatter_model: ScatterModel,
    ) -> Option<Self> {
        let mut likelihood = Likelihood::new(observations, law);
        likelihood.until(stop);
        let nuisances: &[Nuisance] = match scatter_model {
            ScatterModel::Free => &PLAIN,
            ScatterModel::Errors => &[Nuisance::Outlier],
        };
        let mut starts = starts(observations, &mut likelihood, law);
        if scatter_model == ScatterModel::Errors {
            starts.iter_mut().for_each(|start| {
                start.remove(law.coordinates(Coordinate::Work).len());
            });
        }
        likelihood.set_parameters(Coordinate::Work, nuisances);
        let maxima = starts.iter().filter_map(|start| maximise(&likelihood, start, None));
        let mut maximum = maxima.max_by(|a, b| a.value.total_cmp(&b.value))?;
        let rebounds = likelihood.len() - likelihood.captures();
        if scatter_model == ScatterModel::Free && rebounds >= SKEWED_REBOUNDS {
            let scale = (likelihood.scatter(&maximum.values).variance() + 1e-8).sqrt();
            likelihood.set_parameters(Coordinate::Work, &SKEWED);
            let count = likelihood.coordinates().len();
            let skewed = [-TAIL.1, TAIL.1].into_iter().filter_map(|offset| {
                let mut start = maximum.values.clone();
                start[count] *= 0.5;
                start.extend([TAIL.0, offset * scale, 0.0]);
                maximise(&likelihood, &start, None)
            });
            match skewed.max_by(|a, b| a.value.total_cmp(&b.value)) {
                Some(skewed) if skewed.value > maximum.value + SKEWED_GAIN => maximum = skewed,
                _ => likelihood.set_parameters(Coordinate::Work, nuisances),
            }
        }
        likelihood.keep_straight_rows(&maximum.values);
        maximum = maximise(&likelihood, &maximum.values, None)?;
        let mut has_adhesion = true;
        // The paper's law states how weak adhesion may be; other restitution laws have adhesion only if the data show it.
        if law.is_rigid() && law != Law::SpeedRestitution {
            let mut start = maximum.values.clone();
            start[1] = 0.0;
            let without = maximise(&likelihood, &start, Some(1));
            if let Some(without) = without.filter(|without| 2.0 * (maximum.value - without.value) < ADHESION_GAIN) {
                likelihood.leave_adhesion_out();
                (maximum, has_adhesion) = (without, false);
            }
        }
        let judgement = judge(&mut likelihood, &maximum, scatter_model == ScatterModel::Errors);
        let inside = |(value, (low, high)): (&f64, (f64, f64))| *value > low && *value < high;
        let parameters = maximum.values.iter().zip(likelihood.bounds()).filter(|pair| inside(*pair)).count();
        Some(Self { law, likelihood, maximum, scatter_model, has_adhesion, parameters, judgement })
    }

    /// Akaike's criterion: small for a likely law of few parameters.
    #[must_use]
    pub fn aic(&self) -> f64 {
        2.0 * (self.parameters as f64 - self.maximum.value)
    }

    /// Reference speed, m/s: the unit of the curve.
    #[must_use]
    pub fn reference(&self) -> f64 {
        self.likelihood.reference
    }

    /// The curve in reference speeds.
    #[must_use]
    pub fn curve(&self) -> Option<Curve> {
        self.likelihood.curve(&self.maximum.values)
    }

    /// Median restitution of the sphere of median mass at a speed, m/s.
    #[must_use]
    pub fn restitution(&self, speed: f64) -> f64 {
        self.curve().map_or(f64::NAN, |curve| curve.restitution(speed / self.reference(), Size::MEDIAN))
    }

    /// Bounds of 95 % of the median restitution at each of some speeds, m/s: the envelope of the curves whose parameters lie on the
    /// ellipse of one degree of freedom.
    #[must_use]
    pub fn band(&self, speeds: &[f64]) -> Vec<(f64, f64)> {
        let mut band: Vec<(f64, f64)> =
            speeds.iter().map(|speed| (self.restitution(*speed), self.restitution(*speed))).collect();
        let bounds = self.likelihood.bounds();
        let count = if self.has_adhesion { 2 } else { 1 };
        let Some(root) = self.maximum.root_of_covariance(count, &bounds) else {
            return band;
        };
        for step in 0..ELLIPSE {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(step) / f64::from(ELLIPSE)).sin_cos();
            let direction = [cosine, sine];
            let mut values = self.maximum.values.clone();
            for index in 0..count {
                let off: f64 = (0..count).map(|other| root[(index, other)] * direction[other]).sum();
                values[index] = (values[index] + self.drop().sqrt() * off).clamp(bounds[index].0, bounds[index].1);
            }
            let Some(curve) = self.likelihood.curve(&values) else {
                continue;
            };
            for (speed, (low, high)) in speeds.iter().zip(&mut band) {
                let restitution = curve.restitution(speed / self.reference(), Size::MEDIAN);
                (*low, *high) = (low.min(restitution), high.max(restitution));
            }
        }
        band
    }

    /// Standard deviation of the natural scatter of the restitution.
    #[must_use]
    pub fn scatter(&self) -> f64 {
        self.likelihood.scatter(&self.maximum.values).variance().sqrt()
    }

    /// Whether the scatter is skewed.
    #[must_use]
    pub fn is_skewed(&self) -> bool {
        self.likelihood.nuisances().contains(&Nuisance::TailWeight)
    }

    /// Fraction of outliers.
    #[must_use]
    pub fn outliers(&self) -> f64 {
        self.likelihood.nuisance(&self.maximum.values, Nuisance::Outlier)
    }

    /// Residuals of the rebounds over their standard deviations, in the order of the rows; `None` for captures.
    #[must_use]
    pub fn residuals(&self) -> Vec<Option<f64>> {
        self.likelihood.residuals(&self.maximum.values)
    }

    fn drop(&self) -> f64 {
        let fraction = match self.scatter_model {
            ScatterModel::Free => self.likelihood.scatter_fraction(&self.maximum.values),
            ScatterModel::Errors => 0.0,
        };
        let rebounds = self.likelihood.len() - self.likelihood.captures();
        drop_at_bounds(rebounds, self.likelihood.coordinates().len(), fraction)
    }

    /// Interval of the first parameter of the law, in the units of the fit.
    #[must_use]
    pub fn first(&mut self) -> Interval {
        let drop = self.drop();
        interval(&self.likelihood, &mut self.maximum, 0, drop)
    }

    /// Interval of 2 W_A/m over the square of the reference speed.
    #[must_use]
    pub fn work(&mut self) -> Option<Interval> {
        let drop = self.drop();
        self.law.is_rigid().then(|| interval(&self.likelihood, &mut self.maximum, 1, drop))
    }

    /// Interval of the critical speed, m/s.
    #[must_use]
    pub fn critical_speed(&mut self) -> Option<Interval> {
        let nuisances = self.likelihood.nuisances().to_vec();
        let mut at_speed = self.maximum.clone();
        at_speed.values[1] = self.curve()?.critical_speed(Size::MEDIAN);
        let drop = self.drop();
        self.likelihood.set_parameters(Coordinate::CriticalSpeed, &nuisances);
        let found = maximise(&self.likelihood, &at_speed.values, None).map(|mut maximum| {
            // A higher maximum in other coordinates is one of the same law.
            maximum.value = maximum.value.max(self.maximum.value);
            interval(&self.likelihood, &mut maximum, 1, drop)
        });
        self.likelihood.set_parameters(Coordinate::Work, &nuisances);
        let reference = self.reference();
        found.map(|interval| interval.map(|speed| speed * reference))
    }
}
