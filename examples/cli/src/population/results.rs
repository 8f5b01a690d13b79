//! The statistics that the command gives, and what it asks for.

use population::{Estimate, Moments, Outcomes, Population, PopulationError, Response, SizeBin, Statistics, wilson};
use serde::Serialize;

/// What is asked of each population.
pub(super) struct Questions {
    /// Number of ranges of diameters, if there are no edges.
    pub(super) bins: u32,
    /// Edges of the ranges, m.
    pub(super) edges: Vec<f64>,
    /// Speeds of the bounce fraction, m/s; a few of the population's own if empty.
    pub(super) speeds: Vec<f64>,
    /// Particles observed at each speed.
    pub(super) particles: u32,
}

/// Quantiles of the speeds of the bounce fraction, and their number.
const SPEEDS: [f64; 2] = [0.01, 0.99];
const SPEED_COUNT: u32 = 10;

/// Factor to either side of one value.
const AROUND: f64 = 3.0;

impl Questions {
    fn edges(&self, population: &Population) -> Vec<f64> {
        if self.edges.is_empty() { population.diameter.ranges(self.bins as usize) } else { self.edges.clone() }
    }

    pub(super) fn speeds(&self, population: &Population) -> Vec<f64> {
        if self.speeds.is_empty() {
            let [slow, fast] = SPEEDS.map(|p| population.speed.quantile(p));
            let ends = if slow < fast { [slow, fast] } else { [slow / AROUND, fast * AROUND] };
            return spaced(ends, SPEED_COUNT - 1);
        }
        self.speeds.clone()
    }
}

/// Numbers between two others, equally spaced in their logarithm.
fn spaced([low, high]: [f64; 2], intervals: u32) -> Vec<f64> {
    let ratio = (high / low).ln() / f64::from(intervals);
    (0..=intervals).map(|index| low * (ratio * f64::from(index)).exp()).collect()
}

/// A number with its error.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Number {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl From<Estimate> for Number {
    fn from(Estimate { value, error }: Estimate) -> Self {
        Self { value, error }
    }
}

/// Probabilities of the classes.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Classes {
    pub(super) rebound: Number,
    pub(super) capture: Number,
    pub(super) rebound_sliding: Number,
    pub(super) rebound_rolling: Number,
    pub(super) captured_sliding: Number,
    pub(super) captured_rolling: Number,
}

impl Classes {
    fn of(outcomes: &Outcomes) -> Self {
        Self {
            rebound: outcomes.rebound().into(),
            capture: outcomes.capture().into(),
            rebound_sliding: outcomes.rebound_sliding().into(),
            rebound_rolling: outcomes.rebound_rolling().into(),
            captured_sliding: outcomes.captured_sliding().into(),
            captured_rolling: outcomes.captured_rolling().into(),
        }
    }

    /// The probabilities with their names.
    pub(super) fn named(&self) -> [(&'static str, Number); 6] {
        [
            ("rebound", self.rebound),
            ("capture", self.capture),
            ("rebound_sliding", self.rebound_sliding),
            ("rebound_rolling", self.rebound_rolling),
            ("captured_sliding", self.captured_sliding),
            ("captured_rolling", self.captured_rolling),
        ]
    }
}

/// Capture efficiency in a range of diameters.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Size {
    pub(super) diameter_from_m: f64,
    pub(super) diameter_to_m: f64,
    /// Part of the spheres, and of their mass.
    pub(super) number_fraction: f64,
    pub(super) mass_fraction: f64,
    pub(super) capture_by_number: Number,
    pub(super) capture_by_mass: Number,
}

/// Bounce fraction at a speed.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Bounce {
    pub(super) speed_m_s: f64,
    pub(super) bounce_fraction: Number,
    /// Interval of 95 % for the number of particles.
    pub(super) interval: [f64; 2],
}

/// Moments of a restitution.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Spread {
    pub(super) mean: Number,
    pub(super) variance: Number,
    pub(super) skewness: Number,
}

impl From<Moments> for Spread {
    fn from(Moments { mean, variance, skewness }: Moments) -> Self {
        Self { mean: mean.into(), variance: variance.into(), skewness: skewness.into() }
    }
}

/// The statistics of a population.
#[derive(Clone, Serialize)]
pub(super) struct Results {
    pub(super) model: &'static str,
    pub(super) classes_by_number: Classes,
    pub(super) classes_by_mass: Classes,
    pub(super) sizes: Vec<Size>,
    pub(super) particles: u32,
    pub(super) bounces: Vec<Bounce>,
    /// Of all impacts; a capture has zero.
    pub(super) restitution: Spread,
    /// `None` if there are practically no rebounds.
    pub(super) restitution_of_rebounds: Option<Spread>,
}

impl Results {
    pub(super) fn of<R: Response>(
        model: &'static str,
        population: &Population,
        statistics: &Statistics<'_, R>,
        questions: &Questions,
    ) -> Result<Self, PopulationError> {
        let outcomes = statistics.outcomes()?;
        let mut bounces = Vec::new();
        for speed in questions.speeds(population) {
            let rebound = statistics.at_speed(speed)?.rebound();
            let interval = wilson(rebound.value.clamp(0.0, 1.0), f64::from(questions.particles));
            bounces.push(Bounce { speed_m_s: speed, bounce_fraction: rebound.into(), interval });
        }
        let size = |bin: SizeBin| Size {
            diameter_from_m: bin.from,
            diameter_to_m: bin.to,
            number_fraction: bin.number,
            mass_fraction: bin.mass,
            capture_by_number: bin.by_number.into(),
            capture_by_mass: bin.by_mass.into(),
        };
        Ok(Self {
            model,
            classes_by_number: Classes::of(&outcomes),
            classes_by_mass: Classes::of(&statistics.outcomes_by_mass()?),
            sizes: statistics.by_size(&questions.edges(population))?.into_iter().map(size).collect(),
            particles: questions.particles,
            bounces,
            restitution: outcomes.restitution().into(),
            restitution_of_rebounds: outcomes.restitution_of_rebounds().map(Spread::from),
        })
    }
}
