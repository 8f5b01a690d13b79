//! Methods that solve the normal motion. They know a law of contact by its functions alone.

mod adaptive;
mod budgeted;
mod collocation;
pub(super) mod critical;
pub(super) mod critical_search;
mod damped_square;
mod fixed_cost;
mod gill;
pub(super) mod integrals;
pub(super) mod interval;
pub(super) mod nodes;
pub(super) mod observer;
pub(super) mod path;
mod phase;
pub(super) mod quantities;
mod rest;
mod run;
mod split;
mod strong_damping;
mod well;

pub use adaptive::{Adaptive, AdaptiveNodes};
pub use budgeted::Budgeted;
pub use collocation::{Collocation, ErrorControl};
pub use critical_search::CriticalSpeedSearch;
pub use fixed_cost::FixedCost;
pub use gill::RungeKuttaGill;
pub use nodes::{Nodes, PhaseNodes, PhaseSamples};
pub use path::Method;
pub use rest::{MotionToRest, RestCriterion};
pub use run::{RunReport, Status};
