//! Fits of restitution laws and laws of contact to measured impacts, by maximum likelihood.

mod approach;
mod competition;
mod contact;
mod fit;
mod judgement;
mod law;
mod likelihood;
mod maximum;
mod monotone;
mod observation;
mod profile;
mod scatter;
mod start;
mod stop;

pub use competition::{
    Candidate, LEAST_P_VALUE, LEAST_REBOUNDS, Quantity, Statement, TOLD_APART, Verdict, compete, compete_until,
};
pub use fit::{LawFit, ScatterModel};
pub use judgement::Judgement;
pub use law::{Coordinate, Curve, Law, Size};
pub use maximum::information;
pub use observation::{Measured, MeasuredSphere, Observation, ObservationError, Response, median_mass};
pub use profile::Interval;
pub use stop::Stop;
