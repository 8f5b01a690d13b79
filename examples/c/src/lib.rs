//! microimpact for C: scenes, classification, simulation and tables, in single precision.
//!
//! A scene is a plain structure of numbers. Every function checks all of them, so that there is nothing that must be called
//! first and nothing to be freed. Every function is total: whatever it is given, it returns, and says what was wrong.
//! A pointer must be null or point to what its type says; null and misaligned pointers are reported.

#![no_std]

mod memory;
mod rigid;
mod simulation;
mod status;
mod tables;

pub use rigid::{Classification, RigidScene, microimpact_classify};
pub use simulation::{Contact, ContactScene, microimpact_simulate};
pub use status::{Class, Error, Fault, Motion, Status, microimpact_parameter_name};
pub use tables::{
    BoundaryTable, RestitutionTable, SurfaceMotion, TableReading, Verdict, microimpact_boundary_check,
    microimpact_boundary_classify, microimpact_boundary_make, microimpact_restitution_make,
    microimpact_restitution_read,
};

use panic_halt as _;
