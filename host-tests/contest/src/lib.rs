//! Methods that compete for the least run time at the same error: contestants with one setting each, their race, the
//! table of winners, and the equations that peers are given; by how much this library is ahead along axes of hard impacts.

// The scenes are those of the reference, which the library does not refuse.
#![allow(clippy::missing_panics_doc)]

pub mod contestant;
pub mod duel;
mod lanes;
pub mod ours;
pub mod peers;
pub mod place;
pub mod problem;
pub mod programs;
pub mod race;
pub mod record;
pub mod runge_kutta;
pub mod scene;
pub mod table;
