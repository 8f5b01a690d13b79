//! Statistics of all impacts: counts of classes, and parameters of the models from a sample of bounded size.

use std::collections::BTreeMap;
use std::fmt;

use impact_fit::{Law, MeasuredSphere, Observation, Response, ScatterModel, Verdict, compete};
use microimpact::Sphere;
use microimpact::measure::{Estimate, ImpulseRatios, MeasuredRebound, friction};

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
    pub sphere: Sphere<f64>,
    /// Standard errors of both normal speeds, m/s.
    errors: (f64, f64),
}

/// What the statistics take of an impact.
pub struct Note {
    class: String,
    point: Option<Point>,
}

impl Note {
    /// The note of an impact.
    pub fn of<T: Number>(measured: &Measured<T>, level: f64) -> Self {
        Self { class: measured.verdict.class(level), point: Point::of(measured) }
    }
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
    pub fn add(&mut self, note: Note) {
        *self.classes.entry(note.class).or_default() += 1;
        self.seen += 1;
        let place = if self.seen <= SAMPLE {
            self.sample.len()
        } else {
            self.random.get_or_insert_with(|| fastrand::Rng::with_seed(1)).usize(..self.seen)
        };
        let Some(point) = note.point else {
            return;
        };
        if let Some(old) = self.sample.get_mut(place) {
            *old = point;
        } else if self.sample.len() < SAMPLE {
            self.sample.push(point);
        }
    }

    /// What the impacts of spheres of the first one's material say of k and W_A. Sizes may differ.
    pub fn restitution(&self) -> Verdict {
        let alike = |point: &&Point| {
            let first = self.sample.first().unwrap_or(point);
            let (density, ratio) = (point.sphere.density(), point.sphere.gyration_ratio());
            density == first.sphere.density() && ratio == first.sphere.gyration_ratio()
        };
        let observations: Vec<_> = self.sample.iter().filter(alike).map(Point::observation).collect();
        compete(&observations, &[Law::SpeedRestitution], ScatterModel::Free)
    }
}

impl Point {
    fn observation(&self) -> Observation {
        let MeasuredRebound { speed, restitution } = self.rebound;
        let response = if restitution == 0.0 {
            Response::Capture
        } else {
            Response::Rebound { speed: restitution * speed, error: self.errors.1 }
        };
        let sphere = Some(MeasuredSphere { mass: self.sphere.mass(), relative_error: 0.0 });
        Observation { speed, speed_error: self.errors.0, response, sphere }
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
        let (before, after) = measured.normal_errors();
        let spin: f64 = tangential.spin_before(&measured.sphere).value.into();
        Some(Self {
            rebound: MeasuredRebound { speed: normal, restitution: measured.restitution().value.into() },
            slowing: if along < 0.0 { ratios.measured } else { -ratios.measured },
            ratios,
            incidence: measured.incidence(),
            peripheral: spin * radius.value.into(),
            speed: along.hypot(normal),
            errors: (before.into(), after.into()),
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
            Verdict::Fits(statement) => {
                for quantity in &statement.quantities {
                    let name = if quantity.symbol == "k" { "k of R = k/(k + v)" } else { quantity.symbol };
                    let interval = quantity.interval;
                    let [value, low, high] = [interval.value, interval.low, interval.high].map(|x| format!("{x:.4e}"));
                    let high = if interval.high.is_finite() { high } else { "no bound".into() };
                    writeln!(f, "{name}: {value} {}, 95 % from {low} to {high}", quantity.unit)?;
                }
            }
            Verdict::NoLaw(candidates) => {
                let p = candidates.first().map_or(0.0, |candidate| candidate.p_value);
                writeln!(
                    f,
                    "R = k/(k + v) with a work of adhesion does not fit (p = {p:.1e}); `fit` tries other laws"
                )?;
            }
            Verdict::NotEnough(reason) => writeln!(f, "restitution law: {reason}")?,
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
