//! microimpact for C: scenes, classification, simulation and tables, in single precision.
//!
//! A scene is a plain structure of numbers, initialised by a function that checks them, or a constant. Every function checks
//! all of them again, so that a scene that was never initialised is reported, and there is nothing to be freed. Every
//! function is total: whatever it is given, it returns, and says what was wrong.
//! A pointer must be null or point to what its type says; null and misaligned pointers are reported.

#![no_std]

mod abi;
mod critical_steps;
mod error;
mod event;
mod fit;
mod fixed_contact;
mod fixed_point;
mod memory;
mod probability;
mod queue;
mod rigid;
mod scene;
mod simulation;
mod space;
mod sphere;
mod status;
mod table_steps;
mod tables;
mod tally;
mod tangential;
mod terms;
mod trajectory;

pub use abi::*;
pub use critical_steps::*;
pub use error::*;
pub use event::*;
pub use fit::*;
pub use fixed_contact::*;
pub use fixed_point::*;
pub use probability::*;
pub use queue::*;
pub use rigid::*;
pub use scene::*;
pub use simulation::*;
pub use space::*;
pub use sphere::*;
pub use status::*;
pub use table_steps::*;
pub use tables::*;
pub use tally::*;
pub use tangential::*;
pub use terms::*;
pub use trajectory::*;

use panic_halt as _;
