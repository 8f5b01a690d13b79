//! Statistics of all impacts: counts of classes, and parameters of the models from a sample of bounded size.

use std::collections::BTreeMap;
use std::fmt;

use microimpact::measure::{CalibrationError, Estimate, ImpulseRatios, MeasuredRebound, RestitutionFit, friction};
use microimpact::{CriticalSpeed, Sphere};

use super::measured::Measured;
use crate::command::Number;

/// Impacts that are kept for figures and parameters.
const SAMPLE: usize = 10_000;

/// An impact of the sample.
pub struct Point {
    /// Approach speed, m/s, and overall restitution.
    pub rebound: MeasuredRebound<f64>,
    /// mu and mu_0.
    pub ratios: ImpulseRatios<f64>,
    /// Impulse ratio, positive where it slows the tangential motion.
    pub slowing: f64,
    /// Angle of incidence, degrees.
    pub incidence: f64,
    /// Peripheral velocity before the impact, m/s.
    pub peripheral: f64,
    /// Speed before the impact, m/s.
    pub speed: f64,
    sphere: Sphere<f64>,
}

/// Counts of classes and a sample of the impacts.
#[derive(Default)]
pub struct Summary {
    classes: BTreeMap<String, usize>,
    seen: usize,
    pub sample: Vec<Point>,
    random: Option<fastrand::Rng>,
}

impl Summary {
    /// Counts an impact. Each has the same chance to be in the sample (Vitter's algorithm R).
    pub fn add<T: Number>(&mut self, measured: &Measured<T>) {
        *self.classes.entry(measured.classification.class().to_string()).or_default() += 1;
        self.seen += 1;
        let place = if self.seen <= SAMPLE {
            self.sample.len()
        } else {
            self.random.get_or_insert_with(|| fastrand::Rng::with_seed(1)).usize(..self.seen)
        };
        let Some(point) = Point::of(measured) else {
            return;
        };
        if let Some(old) = self.sample.get_mut(place) {
            *old = point;
        } else if self.sample.len() < SAMPLE {
            self.sample.push(point);
        }
    }

    /// Restitution law and work of adhesion of the spheres that equal the first.
    pub fn restitution(&self) -> Result<RestitutionFit<f64>, CalibrationError> {
        let first = self.sample.first().ok_or(CalibrationError::TooFew)?;
        let alike = self.sample.iter().filter(|point| point.sphere == first.sphere);
        RestitutionFit::of(&first.sphere, &alike.map(|point| point.rebound).collect::<Vec<_>>())
    }
}

impl Point {
    /// The sphere.
    pub fn sphere(&self) -> &Sphere<f64> {
        &self.sphere
    }

    fn of<T: Number>(measured: &Measured<T>) -> Option<Self> {
        let tangential = &measured.impact.tangential;
        let [radius, density, kappa] =
            [measured.sphere.radius(), measured.sphere.density(), measured.sphere.gyration_ratio()];
        let [along, normal] = measured.velocities();
        let ratios = ImpulseRatios {
            measured: tangential.impulse_ratio().value.into(),
            rolling: tangential.rolling_ratio().value.into(),
        };
        let spin: f64 = tangential.spin_before(&measured.sphere).value.into();
        Some(Self {
            rebound: MeasuredRebound { speed: normal, restitution: measured.restitution().value.into() },
            slowing: if along < 0.0 { ratios.measured } else { -ratios.measured },
            ratios,
            incidence: measured.incidence(),
            peripheral: spin * radius.value.into(),
            speed: along.hypot(normal),
            sphere: Sphere::new(radius.value.into(), density.value.into(), kappa.value.into()).ok()?,
        })
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts: Vec<_> = self.classes.iter().map(|(class, count)| format!("{count} {class}")).collect();
        writeln!(f, "impacts: {}", if counts.is_empty() { "none".into() } else { counts.join(", ") })?;
        let plus_minus = |estimate: Estimate<f64>| format!("{:.4e} ± {:.1e}", estimate.value, estimate.standard_error);
        match self.restitution() {
            Ok(fit) => {
                writeln!(f, "k of R = k/(k + v): {} m/s", plus_minus(fit.restitution_speed))?;
                writeln!(f, "work of adhesion: {} J", plus_minus(fit.work_of_adhesion))?;
                if let Ok(CriticalSpeed::At(speed)) = fit.critical_speed() {
                    writeln!(f, "critical speed: {} m/s", plus_minus(speed))?;
                }
                writeln!(f, "rebounds of the first sphere: {}, of which outliers: {}", fit.rebounds, fit.outliers)?;
            }
            Err(error) => writeln!(f, "restitution law: {error}")?,
        }
        let ratios: Vec<_> = self.sample.iter().map(|point| point.ratios).collect();
        match friction(&ratios) {
            Ok(plateau) => {
                writeln!(f, "friction: {} from {} that slide", plus_minus(plateau.estimate), plateau.count)
            }
            Err(error) => writeln!(f, "friction: {error}"),
        }
    }
}
