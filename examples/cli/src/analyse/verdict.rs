//! The class of a measured impact, as far as the errors of its velocities let it be told.

use microimpact::measure::NormalDistribution;
use microimpact::{Outcome, SurfaceMotion};

use crate::words::{CANNOT_TELL, motion_name, outcome_name};

/// How an impact ended and how the sphere moved along the surface, each with its probability.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    rebounds: f64,
    /// Probability of rolling; `None` where rolling was assumed.
    rolls: Option<f64>,
}

/// A quotient of numbers that are not negative; of zeros, certainty.
fn share(part: f64, rest: f64) -> f64 {
    if part + rest > 0.0 { part / (part + rest) } else { 1.0 }
}

impl Verdict {
    /// The verdict on a measured rebound speed and a slip, each with its standard error. `slip` is `None` if the spin was not
    /// measured. A rebound speed of exactly zero is an observed capture.
    ///
    /// Before the measurement, rolling is taken to be as likely as sliding with any slip up to that before the impact.
    pub fn new(rebound: (f64, f64), slip: Option<(f64, f64)>, slip_before: f64) -> Self {
        let rebounds = match rebound {
            (0.0, _) => 0.0,
            (speed, error) if error > 0.0 => (speed / error).below(),
            (speed, _) => f64::from(u8::from(speed > 0.0)),
        };
        let rolls = slip.map(|(slip, error)| {
            // The slip after an impact has the direction of that before it.
            let (slip, most) = (slip * slip_before.signum(), slip_before.abs());
            if error <= 0.0 {
                return f64::from(u8::from(slip.abs() <= ROUNDING * most));
            }
            let deviate = slip / error;
            let rolling = (-0.5 * deviate * deviate).exp() / (std::f64::consts::TAU.sqrt() * error);
            // Without slip before the impact, nothing distinguishes both.
            let sliding = if most > 0.0 { (deviate.below() - ((slip - most) / error).below()) / most } else { rolling };
            share(rolling, sliding)
        });
        Self { rebounds, rolls }
    }

    fn outcome(&self, level: f64) -> Option<(Outcome, f64)> {
        likely(self.rebounds, level, Outcome::Rebound, Outcome::Capture)
    }

    fn motion(&self, level: f64) -> Option<(SurfaceMotion, f64)> {
        likely(self.rolls?, level, SurfaceMotion::Rolling, SurfaceMotion::Sliding)
    }

    /// How the impact ended, in a word.
    pub fn outcome_word(&self, level: f64) -> &'static str {
        self.outcome(level).map_or(CANNOT_TELL, |(outcome, _)| outcome_name(outcome))
    }

    /// How the sphere moves along the surface, in a word.
    pub fn motion_word(&self, level: f64) -> &'static str {
        match self.rolls {
            None => ASSUMED,
            Some(_) => self.motion(level).map_or(CANNOT_TELL, |(motion, _)| motion_name(motion)),
        }
    }

    /// Both in words.
    pub fn class(&self, level: f64) -> String {
        match (self.outcome_word(level), self.motion_word(level)) {
            (CANNOT_TELL, CANNOT_TELL) => CANNOT_TELL.into(),
            (outcome, CANNOT_TELL) => format!("{outcome}, rolling or sliding"),
            (CANNOT_TELL, motion) => format!("rebound or capture, {motion}"),
            (outcome, ASSUMED) => format!("{outcome}, {ASSUMED}"),
            (outcome, motion) => format!("{outcome} {motion}"),
        }
    }

    /// Probability of the most likely class; `None` where rolling was assumed.
    pub fn confidence(&self) -> Option<f64> {
        let larger = |probability: f64| probability.max(1.0 - probability);
        Some(larger(self.rebounds) * larger(self.rolls?))
    }
}

/// Standard errors within which a measurement is possible.
pub const POSSIBLE: f64 = 3.0;

/// The motion of a sphere whose spin was not measured.
const ASSUMED: &str = "assumed rolling";

/// Slip over that before the impact that rounding explains.
const ROUNDING: f64 = 1e-9;

/// Which of two is true, with its probability, if that reaches a level.
fn likely<V>(probability: f64, level: f64, first: V, second: V) -> Option<(V, f64)> {
    let (value, probability) = if probability >= 0.5 { (first, probability) } else { (second, 1.0 - probability) };
    (probability >= level).then_some((value, probability))
}
