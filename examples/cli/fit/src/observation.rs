//! Measured impacts: an approach speed, what followed, and the errors of both.

use std::fmt;

use microimpact::Parameter;

/// A measured impact along the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// Measured approach speed, m/s, positive.
    pub speed: f64,
    /// Its standard error, m/s; zero if it is exact or unknown.
    pub speed_error: f64,
    /// What followed.
    pub response: Response,
    /// The sphere, if it was measured.
    pub sphere: Option<MeasuredSphere>,
}

/// What followed an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Response {
    /// The sphere rebounded at a measured speed, m/s, which has a standard error, m/s. Errors may make the speed negative.
    Rebound {
        /// Measured rebound speed, m/s.
        speed: f64,
        /// Its standard error, m/s; zero if it is exact or unknown.
        error: f64,
    },
    /// The surface captured the sphere.
    Capture,
}

/// Mass and radius of one sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredSphere {
    /// Mass, kg.
    pub mass: f64,
    /// Standard error of the mass over the mass.
    pub relative_error: f64,
}

/// A measured number of an impact that is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservationError {
    /// What was measured.
    pub quantity: Measured,
    /// The number.
    pub value: f64,
    /// The range in which it must lie.
    pub range: (f64, f64),
}

/// What was measured of an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// Approach speed, m/s.
    Speed,
    /// Standard error of the approach speed, m/s.
    SpeedError,
    /// Rebound speed, m/s.
    Rebound,
    /// Rebound speed of a captured sphere, m/s.
    ReboundOfCapture,
    /// Standard error of the rebound speed, m/s.
    ReboundError,
    /// Mass, kg.
    Mass,
    /// Standard error of the mass over the mass.
    MassError,
}

impl Measured {
    /// Its name and its unit.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Speed => ("approach speed", " m/s"),
            Self::SpeedError => ("standard error of the approach speed", " m/s"),
            Self::Rebound => ("rebound speed", " m/s"),
            Self::ReboundOfCapture => ("rebound speed of a captured sphere", " m/s"),
            Self::ReboundError => ("standard error of the rebound speed", " m/s"),
            Self::Mass => ("mass", " kg"),
            Self::MassError => ("relative standard error of the mass", ""),
        }
    }

    fn check(self, value: f64, (low, high): (f64, f64)) -> Result<(), ObservationError> {
        if (low..=high).contains(&value) {
            Ok(())
        } else {
            Err(ObservationError { quantity: self, value, range: (low, high) })
        }
    }
}

impl fmt::Display for ObservationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((name, unit), (low, high)) = (self.quantity.words(), self.range);
        write!(f, "{name} is {}{unit}, but must be {low:.3e} to {high:.3e}{unit}", self.value)
    }
}

impl std::error::Error for ObservationError {}

/// Standard errors by which a measured rebound speed may lie outside the possible range. Rows beyond are mistakes, not outliers.
const FARTHEST: f64 = 6.0;

/// By how much a restitution without stated error may lie outside the range 0 to 1.
const UNSTATED: f64 = 0.2;

/// Largest standard error of a speed, m/s: that of the largest speed.
const LARGEST_ERROR: f64 = 1e6;

/// Masses of spheres, kg: smaller and larger ones than the library has.
const MASSES: (f64, f64) = (1e-40, 1e10);

/// Largest relative standard error of a mass.
const LARGEST_MASS_ERROR: f64 = 1e3;

impl Observation {
    /// An impact as it was measured: approach and rebound speed, m/s, each with its standard error. Where it was not recorded whether
    /// the surface `captured` the sphere, a rebound speed of exactly zero is a capture.
    ///
    /// # Errors
    /// A number outside its range. The rebound speed must lie between zero and the approach speed, give or take six standard errors,
    /// or a fifth of the approach speed if both speeds have none; that of a captured sphere must be as close to zero.
    pub fn measured(
        (speed, speed_error): (f64, f64),
        (rebound, rebound_error): (f64, f64),
        captured: Option<bool>,
        sphere: Option<MeasuredSphere>,
    ) -> Result<Self, ObservationError> {
        let captured = captured.unwrap_or(rebound == 0.0);
        let response =
            if captured { Response::Capture } else { Response::Rebound { speed: rebound, error: rebound_error } };
        let observation = Self { speed, speed_error, response, sphere };
        Measured::Speed.check(speed, Parameter::ApproachSpeed.range())?;
        Measured::SpeedError.check(speed_error, (0.0, LARGEST_ERROR))?;
        Measured::ReboundError.check(rebound_error, (0.0, LARGEST_ERROR))?;
        let error = speed_error.hypot(rebound_error);
        let reach = if error == 0.0 { UNSTATED * speed } else { FARTHEST * error };
        Measured::Rebound.check(rebound, (-reach, speed + reach))?;
        if captured {
            Measured::ReboundOfCapture.check(rebound, (-reach, reach))?;
        }
        observation.check()?;
        Ok(observation)
    }

    /// Checks that each number is one that a fit can compute with.
    pub(crate) fn check(&self) -> Result<(), ObservationError> {
        Measured::Speed.check(self.speed, Parameter::ApproachSpeed.range())?;
        Measured::SpeedError.check(self.speed_error, (0.0, LARGEST_ERROR))?;
        if let Response::Rebound { speed, error } = self.response {
            let (_, fastest) = Parameter::ApproachSpeed.range();
            Measured::Rebound.check(speed, (-fastest, fastest))?;
            Measured::ReboundError.check(error, (0.0, LARGEST_ERROR))?;
        }
        if let Some(MeasuredSphere { mass, relative_error }) = self.sphere {
            Measured::Mass.check(mass, MASSES)?;
            Measured::MassError.check(relative_error, (0.0, LARGEST_MASS_ERROR))?;
        }
        Ok(())
    }

    /// Whether the sphere rebounded.
    #[must_use]
    pub fn rebounds(&self) -> bool {
        matches!(self.response, Response::Rebound { .. })
    }

    /// Measured restitution, zero for a capture.
    #[must_use]
    pub fn restitution(&self) -> f64 {
        match self.response {
            Response::Rebound { speed, .. } => speed / self.speed,
            Response::Capture => 0.0,
        }
    }

    /// Standard error of the measured restitution, by its first derivatives.
    #[must_use]
    pub fn restitution_error(&self) -> f64 {
        match self.response {
            Response::Rebound { error, .. } => (self.restitution() * self.speed_error).hypot(error) / self.speed,
            Response::Capture => 0.0,
        }
    }
}

/// Mass of the sphere with the median mass, kg; `None` if a row has no mass.
#[must_use]
pub fn median_mass(observations: &[Observation]) -> Option<f64> {
    let masses: Option<Vec<f64>> = observations.iter().map(|o| o.sphere.map(|sphere| sphere.mass)).collect();
    let mut masses = masses?;
    masses.sort_by(f64::total_cmp);
    masses.get(masses.len() / 2).copied()
}
