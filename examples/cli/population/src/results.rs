//! All statistics of a population, and what is asked for.

#[cfg(feature = "serde")]
use serde::Serialize;

use crate::{Estimate, Moments, Outcomes, Population, PopulationError, Response, SizeBin, Statistics, wilson};

/// What is asked of a population.
#[derive(Clone, Debug)]
pub struct Questions {
    /// Number of ranges of diameters, if there are no edges.
    pub bins: u32,
    /// Edges of the ranges, m.
    pub edges: Vec<f64>,
    /// Speeds of the bounce fraction, m/s; `None` for a few of the population's own.
    pub speeds: Option<Vec<f64>>,
    /// Particles observed at each speed.
    pub particles: u32,
}

/// Quantiles of the speeds of the bounce fraction, and their number.
const SPEEDS: [f64; 2] = [0.01, 0.99];
const SPEED_COUNT: u32 = 10;

/// Factor to either side of one value.
const AROUND: f64 = 3.0;

impl Questions {
    /// Edges of the ranges of diameters, m.
    #[must_use]
    pub fn edges(&self, population: &Population) -> Vec<f64> {
        if self.edges.is_empty() { population.diameter.ranges(self.bins as usize) } else { self.edges.clone() }
    }

    /// Speeds of the bounce fraction, m/s.
    #[must_use]
    pub fn speeds(&self, population: &Population) -> Vec<f64> {
        self.speeds.clone().unwrap_or_else(|| {
            let [slow, fast] = SPEEDS.map(|p| population.speed.quantile(p));
            let ends = if slow < fast { [slow, fast] } else { [slow / AROUND, fast * AROUND] };
            spaced(ends, SPEED_COUNT - 1)
        })
    }
}

/// Numbers between two others, equally spaced in their logarithm.
fn spaced([low, high]: [f64; 2], intervals: u32) -> Vec<f64> {
    let ratio = (high / low).ln() / f64::from(intervals);
    (0..=intervals).map(|index| low * (ratio * f64::from(index)).exp()).collect()
}

/// Probabilities of the classes.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub struct Classes {
    /// Of a rebound.
    pub rebound: Estimate,
    /// Of a capture.
    pub capture: Estimate,
    /// Of a rebound in which the contact point slides to the end.
    pub rebound_sliding: Estimate,
    /// Of a rebound in which friction stops the slip.
    pub rebound_rolling: Estimate,
    /// Of a capture after which the contact point slides.
    pub captured_sliding: Estimate,
    /// Of a capture after which the sphere rolls or rests.
    pub captured_rolling: Estimate,
}

impl Classes {
    fn of(outcomes: &Outcomes) -> Self {
        Self {
            rebound: outcomes.rebound(),
            capture: outcomes.capture(),
            rebound_sliding: outcomes.rebound_sliding(),
            rebound_rolling: outcomes.rebound_rolling(),
            captured_sliding: outcomes.captured_sliding(),
            captured_rolling: outcomes.captured_rolling(),
        }
    }

    /// The probabilities with their names.
    #[must_use]
    pub fn named(&self) -> [(&'static str, Estimate); 6] {
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

/// Bounce fraction at a speed.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub struct Bounce {
    /// Speed along the path, m/s.
    #[cfg_attr(feature = "serde", serde(rename = "speed_m_s"))]
    pub speed: f64,
    /// Probability of a rebound.
    pub bounce_fraction: Estimate,
    /// Interval of 95 % for the number of particles.
    pub interval: [f64; 2],
}

/// The statistics of a population.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub struct Results {
    /// Probabilities of the classes by number.
    pub classes_by_number: Classes,
    /// The same by mass.
    pub classes_by_mass: Classes,
    /// Capture efficiency in the ranges of diameters that have spheres.
    pub sizes: Vec<SizeBin>,
    /// Particles observed at each speed, for the intervals.
    pub particles: u32,
    /// Bounce fraction by speed.
    pub bounces: Vec<Bounce>,
    /// Moments of e of all impacts; a capture has zero.
    pub restitution: Moments,
    /// Moments of e of the rebounds; `None` if there are practically no rebounds.
    pub restitution_of_rebounds: Option<Moments>,
}

impl Results {
    /// The statistics that answer some questions about a population.
    ///
    /// # Errors
    /// As those of [`Statistics::outcomes`].
    pub fn of<R: Response>(
        population: &Population,
        statistics: &Statistics<'_, R>,
        questions: &Questions,
    ) -> Result<Self, PopulationError> {
        let outcomes = statistics.outcomes()?;
        let mut bounces = Vec::new();
        for speed in questions.speeds(population) {
            let rebound = statistics.at_speed(speed)?.rebound();
            let interval = wilson(rebound.value.clamp(0.0, 1.0), f64::from(questions.particles));
            bounces.push(Bounce { speed, bounce_fraction: rebound, interval });
        }
        Ok(Self {
            classes_by_number: Classes::of(&outcomes),
            classes_by_mass: Classes::of(&statistics.outcomes_by_mass()?),
            sizes: statistics.by_size(&questions.edges(population))?,
            particles: questions.particles,
            bounces,
            restitution: outcomes.restitution(),
            restitution_of_rebounds: outcomes.restitution_of_rebounds(),
        })
    }
}
