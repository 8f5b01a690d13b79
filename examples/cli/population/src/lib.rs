//! Impacts of a population of microspheres: from the distributions of diameter, speed, angle of incidence and adhesion to the
//! probabilities of the classes, the capture efficiency by size, the bounce fraction by speed, and the moments of the
//! restitution, each with an estimate of its error.
//!
//! A [`Population`] holds the distributions. A [`Response`] is a model: [`RigidBodies`] or [`Simulations`], or one's own.
//! [`Statistics`] integrates the response over the population.
//!
//! ```
//! use microimpact::{InputError, RigidBody, SpeedRestitution, Sphere};
//! use population::{Distribution, Population, RigidBodies, Statistics};
//!
//! let population = Population {
//!     diameter: Distribution::log_normal(5e-6, 1.3)?,
//!     adhesion: Distribution::fixed(2.22e-12)?,
//!     angle: Distribution::fixed(0.0)?,
//!     speed: Distribution::log_normal(2.8, 1.2)?,
//! };
//! let spheres = RigidBodies(|diameter: f64, work: f64| {
//!     RigidBody::new(Sphere::solid(0.5 * diameter, 2600.0)?, SpeedRestitution::new(130.0)?)
//!         .with_work_of_adhesion(work)?
//!         .with_friction(0.1)
//! });
//! let capture = Statistics::direct(&population, &spheres).outcomes()?.capture();
//! assert!((0.0..1.0).contains(&capture.value) && capture.error < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod distribution;
mod interpolation;
mod outcome;
mod quadrature;
mod response;
mod results;
mod statistics;

use std::fmt;

use microimpact::InputError;

pub use distribution::{Distribution, DistributionError};
pub use outcome::Stop;
pub use response::{Rebound, Response, RigidBodies, Simulations};
pub use results::{Bounce, Classes, Questions, Results};
pub use statistics::{DIAMETERS, Estimate, Moments, Outcomes, Population, SizeBin, Statistics, wilson};

/// Why there are no statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PopulationError {
    /// The model refuses a value.
    Input(InputError),
    /// There is no such distribution.
    Distribution(DistributionError),
    /// A simulation did not converge.
    NotConverged {
        /// Diameter of the sphere, m.
        diameter: f64,
        /// Its normal speed, m/s.
        speed: f64,
    },
    /// They were asked to end before their time.
    Stopped,
    /// A part of the spheres rebounds at every speed.
    ReboundsOfAPart,
    /// Samples of several quantities have too many combinations.
    TooManySamples {
        /// How many.
        combinations: usize,
        /// The largest number.
        most: usize,
    },
}

impl fmt::Display for PopulationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Distribution(error) => error.fmt(f),
            Self::NotConverged { diameter, speed } => write!(
                f,
                "the simulation of a sphere of {diameter:.3e} m at {speed:.3e} m/s did not converge; use narrower \
                 distributions or a larger tolerance"
            ),
            Self::Stopped => f.write_str("the computation was stopped"),
            Self::ReboundsOfAPart => f.write_str(
                "some spheres of the population rebound at every speed and others do not; divide the population by \
                 diameter or adhesion",
            ),
            Self::TooManySamples { combinations, most } => write!(
                f,
                "the samples have {combinations} combinations, but at most {most} are offered; give fewer samples or a \
                 log-normal distribution"
            ),
        }
    }
}

impl std::error::Error for PopulationError {}

impl From<InputError> for PopulationError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl From<DistributionError> for PopulationError {
    fn from(error: DistributionError) -> Self {
        Self::Distribution(error)
    }
}
