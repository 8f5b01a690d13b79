//! Measured impacts: an approach speed, what followed, and the errors of both.

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

impl Observation {
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
