//! microimpact for C: scenes, classification, simulation and tables, in single precision.
//!
//! A scene is a plain structure of numbers, initialised by a function that checks them, or a constant. Every function checks
//! all of them again, so that a scene that was never initialised is reported, and there is nothing to be freed. Every function is total: whatever it is given, it returns, and says what was wrong.
//! A pointer must be null or point to what its type says; null and misaligned pointers are reported.

#![no_std]

mod memory;
mod rigid;
mod simulation;
mod space;
mod status;
mod tables;
mod tangential;
mod trajectory;

pub use rigid::{Classification, RigidScene, microimpact_classify, microimpact_rigid_init};
pub use simulation::{Contact, ContactScene, microimpact_contact_init, microimpact_simulate};
pub use space::{
    Pair, SpatialMotion, Wall, microimpact_pair_after, microimpact_pair_incidence, microimpact_wall_after,
    microimpact_wall_incidence, microimpact_wall_sideways,
};
pub use status::{Class, Error, Fault, Motion, Status, microimpact_parameter_name};
pub use tables::{
    BoundaryTable, RestitutionTable, SurfaceMotion, TableReading, Verdict, microimpact_boundary_check,
    microimpact_boundary_classify, microimpact_boundary_make, microimpact_restitution_make,
    microimpact_restitution_read,
};
pub use tangential::{CompliantContact, CompliantScene, microimpact_compliant_init, microimpact_simulate_compliant};
pub use trajectory::{LARGEST_TRAJECTORY, SMALLEST_TRAJECTORY, Sample, microimpact_simulate_trajectory};

use panic_halt as _;
