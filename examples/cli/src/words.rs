//! Words of computed columns.

use microimpact::{Outcome, SurfaceMotion};

/// How an impact ends.
pub fn outcome_name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Rebound => "rebound",
        Outcome::Capture => "capture",
        Outcome::Undecided => "undecided",
    }
}

/// How the contact point moves.
pub fn motion_name(motion: SurfaceMotion) -> &'static str {
    match motion {
        SurfaceMotion::Sliding => "sliding",
        SurfaceMotion::Rolling => "rolling",
        SurfaceMotion::Resting => "resting",
    }
}
