//! Statistics of a population: classes, capture efficiency by size, bounce fraction by speed, and moments of the restitution.

use microimpact::Parameter;
#[cfg(feature = "serde")]
use serde::Serialize;

use crate::PopulationError;
use crate::distribution::{Distribution, MASS};
use crate::interpolation::{Fineness, Interpolated};
use crate::outcome::{ADHESION, ANGLE, DIAMETER, POWERS, Problem, SPEED, Stop, VARIABLES};
use crate::quadrature::{Integrals, QUANTITIES, TOLERANCE};
use crate::response::Response;

/// Two interpolations of a response, a coarse one and a fine one. The difference of the results estimates the error.
const INTERPOLATIONS: [Fineness; 2] = [Fineness { distance: 0.3, speeds: 16 }, Fineness { distance: 0.2, speeds: 24 }];

/// Smallest and largest diameter of a sphere, m.
pub const DIAMETERS: [f64; 2] = [2.0 * Parameter::Radius.range().0, 2.0 * Parameter::Radius.range().1];

/// A population of spheres that do not spin before they meet a surface. The quantities are independent of each other.
#[derive(Clone, Debug)]
pub struct Population {
    /// Diameter, m.
    pub diameter: Distribution,
    /// The parameter of adhesion that the response takes.
    pub adhesion: Distribution,
    /// Angle between the path and the normal of the surface, rad, from 0 to less than half of pi.
    pub angle: Distribution,
    /// Speed along the path, m/s.
    pub speed: Distribution,
}

/// A number with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its error, from the differences of rules of two orders.
    pub error: f64,
}

/// Probabilities of the classes, with the restitution.
#[derive(Clone, Copy, Debug)]
pub struct Outcomes {
    integrals: Integrals,
}

/// Mean, variance and skewness.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub struct Moments {
    /// Mean.
    pub mean: Estimate,
    /// Variance.
    pub variance: Estimate,
    /// Skewness, the third central moment over the variance to the power 3/2.
    pub skewness: Estimate,
}

/// A range of diameters.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub struct SizeBin {
    /// The diameters in the range are larger than this one, m.
    #[cfg_attr(feature = "serde", serde(rename = "diameter_from_m"))]
    pub from: f64,
    /// They are not larger than this one, m.
    #[cfg_attr(feature = "serde", serde(rename = "diameter_to_m"))]
    pub to: f64,
    /// Part of the spheres, by number.
    #[cfg_attr(feature = "serde", serde(rename = "number_fraction"))]
    pub number: f64,
    /// Part of their mass.
    #[cfg_attr(feature = "serde", serde(rename = "mass_fraction"))]
    pub mass: f64,
    /// Capture efficiency by number: the part of these spheres that is captured.
    #[cfg_attr(feature = "serde", serde(rename = "capture_by_number"))]
    pub by_number: Estimate,
    /// Capture efficiency by mass: the part of their mass that is captured.
    #[cfg_attr(feature = "serde", serde(rename = "capture_by_mass"))]
    pub by_mass: Estimate,
}

impl Outcomes {
    fn sum(&self, classes: &[usize]) -> Estimate {
        let part = |numbers: &[f64; QUANTITIES]| classes.iter().map(|class| numbers[*class]).sum();
        Estimate { value: part(&self.integrals.values), error: part(&self.integrals.errors) }
    }

    /// Probability of a rebound in which the contact point slides to the end.
    pub fn rebound_sliding(&self) -> Estimate {
        self.sum(&[0])
    }

    /// Probability of a rebound in which friction stops the slip.
    pub fn rebound_rolling(&self) -> Estimate {
        self.sum(&[1])
    }

    /// Probability of a capture after which the contact point slides.
    pub fn captured_sliding(&self) -> Estimate {
        self.sum(&[2])
    }

    /// Probability of a capture after which the sphere rolls or rests.
    pub fn captured_rolling(&self) -> Estimate {
        self.sum(&[3])
    }

    /// Probability of a rebound.
    pub fn rebound(&self) -> Estimate {
        self.sum(&[0, 1])
    }

    /// Probability of a capture.
    pub fn capture(&self) -> Estimate {
        self.sum(&[2, 3])
    }

    /// Moments of the overall restitution of all impacts; that of a capture is zero.
    pub fn restitution(&self) -> Moments {
        self.moments(|_| 1.0)
    }

    /// Moments of the overall restitution of the rebounds; `None` if there are practically none.
    pub fn restitution_of_rebounds(&self) -> Option<Moments> {
        let rebound = self.rebound();
        (rebound.value > 10.0 * rebound.error.max(f64::EPSILON)).then(|| self.moments(|values| values[0] + values[1]))
    }

    /// Moments from the powers of the restitution, divided by a probability.
    fn moments(&self, probability: fn(&[f64; QUANTITIES]) -> f64) -> Moments {
        let powers =
            |values: &[f64; QUANTITIES]| [0, 1, 2].map(|power: usize| values[POWERS + power] / probability(values));
        let variance = |values: &[f64; QUANTITIES]| {
            let [first, second, _] = powers(values);
            (second - first * first).max(0.0)
        };
        Moments {
            mean: self.derived(|values| powers(values)[0]),
            variance: self.derived(variance),
            skewness: self.derived(|values| {
                let [first, second, third] = powers(values);
                let central = third - 3.0 * first * second + 2.0 * first.powi(3);
                let spread = variance(values).powf(1.5);
                if spread > 0.0 { central / spread } else { 0.0 }
            }),
        }
    }

    /// A number computed from the integrals; its error is the sum of its changes with their errors.
    fn derived(&self, of: impl Fn(&[f64; QUANTITIES]) -> f64) -> Estimate {
        let Integrals { values, errors } = &self.integrals;
        let value = of(values);
        let change = |index: usize| {
            let mut moved = *values;
            moved[index] += errors[index];
            (of(&moved) - value).abs()
        };
        Estimate { value, error: (0..QUANTITIES).map(change).sum() }
    }
}

/// How a response is evaluated.
enum Evaluation<'a, R> {
    Direct(&'a R),
    /// A coarse and a fine interpolation.
    Interpolated(Box<[Interpolated<'a, R>; 2]>),
}

/// The statistics of a population by a response.
pub struct Statistics<'a, R> {
    distributions: [Distribution; VARIABLES],
    evaluation: Evaluation<'a, R>,
    tolerance: f64,
    stop: &'a Stop<'a>,
}

impl<'a, R: Response> Statistics<'a, R> {
    /// Statistics that evaluate the response at every impact, for a response that takes microseconds.
    pub fn direct(population: &Population, response: &'a R) -> Self {
        Self {
            distributions: distributions(population),
            evaluation: Evaluation::Direct(response),
            tolerance: TOLERANCE,
            stop: &|| false,
        }
    }

    /// Statistics that interpolate the response between some hundred impacts, for a simulation. `speeds` (m/s) are those at
    /// which a [bounce fraction](Self::at_speed) will be asked for.
    ///
    /// # Errors
    /// The model refuses an impact of the population, or a part of the spheres rebounds at every speed.
    pub fn interpolated(population: &Population, response: &'a R, speeds: &[f64]) -> Result<Self, PopulationError> {
        let distributions = distributions(population);
        let bounds = [0, 1, 2, 3].map(|variable: usize| distributions[variable].bounds());
        let [slowest, fastest] =
            speeds.iter().fold(bounds[SPEED], |[low, high], speed| [low.min(*speed), high.max(*speed)]);
        let normal = [slowest * bounds[ANGLE][1].cos(), fastest];
        // The mass moves the largest diameter.
        let diameters = [bounds[DIAMETER][0], distributions[DIAMETER].clone().weighted(MASS).bounds()[1]];
        let interpolated = |fineness| Interpolated::new(response, [diameters, bounds[ADHESION], normal], fineness);
        let [coarse, fine] = INTERPOLATIONS;
        let evaluation = Evaluation::Interpolated(Box::new([interpolated(coarse)?, interpolated(fine)?]));
        Ok(Self { distributions, evaluation, tolerance: TOLERANCE, stop: &|| false })
    }

    /// The same with another tolerance of the quadrature than 2e-7: the error of a panel of an integral over one variable below which
    /// the panel is not divided, and ten times that for each further variable.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The same, which fail soon after `stop` has become true.
    pub fn until(mut self, stop: &'a Stop<'a>) -> Self {
        self.stop = stop;
        self
    }

    fn integrals(
        &self,
        distributions: &[Distribution; VARIABLES],
        with_powers: bool,
    ) -> Result<Outcomes, PopulationError> {
        let integrals = match &self.evaluation {
            Evaluation::Direct(response) => {
                Problem::new(distributions, *response, with_powers, self.tolerance, self.stop)?.integrals()?
            }
            Evaluation::Interpolated(responses) => {
                let [coarse, fine] = &**responses;
                let coarse =
                    Problem::new(distributions, coarse, with_powers, self.tolerance, self.stop)?.integrals()?;
                let mut fine =
                    Problem::new(distributions, fine, with_powers, self.tolerance, self.stop)?.integrals()?;
                fine.add_differences(&coarse);
                fine
            }
        };
        Ok(Outcomes { integrals })
    }

    /// Probabilities of the classes, and the restitution.
    ///
    /// # Errors
    /// The model refuses an impact, or there are too many combinations of samples.
    pub fn outcomes(&self) -> Result<Outcomes, PopulationError> {
        self.integrals(&self.distributions, true)
    }

    /// Probabilities of the classes by mass: the part of the mass of the spheres that each class has.
    ///
    /// # Errors
    /// As those of [`outcomes`](Self::outcomes).
    pub fn outcomes_by_mass(&self) -> Result<Outcomes, PopulationError> {
        self.integrals(&self.with(DIAMETER, self.distributions[DIAMETER].clone().weighted(MASS)), false)
    }

    /// Probabilities of the classes of the spheres that arrive at a speed, m/s.
    ///
    /// # Errors
    /// As those of [`outcomes`](Self::outcomes), and the speed is not positive.
    pub fn at_speed(&self, speed: f64) -> Result<Outcomes, PopulationError> {
        let speed = Distribution::samples(vec![speed])?;
        self.integrals(&self.with(SPEED, speed), false)
    }

    /// Capture efficiency in ranges of the diameter between edges, m, in increasing order. Ranges without spheres are left out.
    ///
    /// # Errors
    /// As those of [`outcomes`](Self::outcomes).
    pub fn by_size(&self, edges: &[f64]) -> Result<Vec<SizeBin>, PopulationError> {
        let number = &self.distributions[DIAMETER];
        let mass = number.clone().weighted(MASS);
        let mut bins = Vec::new();
        for pair in edges.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let (Ok(by_number), Ok(by_mass)) = (number.clone().within(from, to), mass.clone().within(from, to)) else {
                continue;
            };
            bins.push(SizeBin {
                from,
                to,
                number: number.part(from, to),
                mass: mass.part(from, to),
                by_number: self.integrals(&self.with(DIAMETER, by_number), false)?.capture(),
                by_mass: self.integrals(&self.with(DIAMETER, by_mass), false)?.capture(),
            });
        }
        Ok(bins)
    }

    fn with(&self, variable: usize, distribution: Distribution) -> [Distribution; VARIABLES] {
        let mut distributions = self.distributions.clone();
        distributions[variable] = distribution;
        distributions
    }
}

fn distributions(population: &Population) -> [Distribution; VARIABLES] {
    let Population { diameter, adhesion, angle, speed } = population.clone();
    [diameter, adhesion, angle, speed]
}

/// Standard deviations of a two-sided interval of 95 %.
const DEVIATIONS: f64 = 1.959_963_984_540_054;

/// The interval of Wilson (1927) with a confidence of 95 % for a probability, from the fraction that was observed on a number
/// of particles.
///
/// ```
/// // 5 of 10.
/// let [low, high] = population::wilson(0.5, 10.0);
/// assert!((low - 0.2366).abs() < 1e-4 && (high - 0.7634).abs() < 1e-4);
/// ```
pub fn wilson(fraction: f64, particles: f64) -> [f64; 2] {
    let square = DEVIATIONS * DEVIATIONS;
    let middle = fraction + square / (2.0 * particles);
    let half =
        DEVIATIONS * (fraction * (1.0 - fraction) / particles + square / (4.0 * particles * particles)).max(0.0).sqrt();
    [middle - half, middle + half].map(|end| (end / (1.0 + square / particles)).clamp(0.0, 1.0))
}
