#![doc = include_str!("../README.md")]

mod column;
mod contacts;
mod departure;
mod groups;
mod impacts;
mod in_lanes;
mod lanes;
mod motions;
mod quantity;
mod rigid_bodies;
mod simulate;
mod simulated;

pub use column::Column;
pub use contacts::{Contacts, Damping, Law, Surface};
pub use impacts::{Impacts, RowStatus};
pub use lanes::{F32x8, F64x4};
pub use motions::Motions;
pub use quantity::Quantity;
pub use rigid_bodies::{Adhesion, Restitution, RigidBodies};
