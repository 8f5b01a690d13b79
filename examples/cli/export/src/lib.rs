//! Restitution against approach speed as a table, in the formats of simulation programs.
//!
//! A [`Curve`] holds the restitution of spheres of one radius, in points between which it is linear; a [`Table`] holds curves of
//! several radii. Each format has a module with a function `write`.

pub mod acutrace;
mod bound;
pub mod comsol;
pub mod csv;
mod curve;
pub mod fluent;
pub mod openfoam;
mod table;

pub use bound::rounded_up;
pub use curve::{Curve, Point};
pub use table::{Difference, Table};
