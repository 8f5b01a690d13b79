//! Impacts of many microspheres in one call: structures of arrays in, structures of arrays out, on all cores.
//!
//! [`Contacts`] and [`RigidBodies`] describe spheres and the physics of their impacts by either model, [`Motions`] how they arrive, in
//! a plane or in space. Every number is a [`Column`]: one value for all rows, or a value for each. A row gives the result of a
//! single call of the library with the same numbers, and each row has a status of its own.
//!
//! ```
//! use impact_arrays::{Column, Contacts, Damping, Law, Motions, Quantity, Surface};
//! use microimpact::{Class, contact::Adaptive};
//!
//! // The paper's spheres of four radii, at one speed.
//! let radii = [2.5e-6, 4.3e-6, 5.06e-6, 6.5e-6];
//! let contacts = Contacts {
//!     radius: Column::Each(&radii),
//!     density: Column::All(2600.0),
//!     stiffness: Column::All(7.5e10),
//!     law: Law::Ring { strength: Column::All(250.0), damping: Column::All(6.25) },
//!     damping: Damping::Hysteretic(Column::All(10.5)),
//!     surface: Surface::Coulomb { friction: Column::All(0.1) },
//!     ..Contacts::default()
//! };
//! let motions = Motions::Planar { speed_normal: Column::All(2.8), speed_tangential: Column::All(1.0), spin: Column::All(0.0) };
//! let impacts = contacts.simulate(&motions, radii.len(), &Adaptive::new(1e-9)?, &[Quantity::OverallRestitution]);
//! assert_eq!(impacts.class[0], Some(Class::CapturedRolling));
//! let restitution = impacts.numbers(Quantity::OverallRestitution).unwrap();
//! assert!(restitution[0] == 0.0 && (restitution[2] - 0.746193).abs() < 1e-6);
//! # Ok::<(), microimpact::InputError>(())
//! ```
//!
//! [`RigidBodies::classify`] computes four rows at once on each thread, and so does [`Contacts::simulate_in_lanes`], by a method of fixed
//! cost.
//!
//! The number of threads is rayon's: that of the cores, or `RAYON_NUM_THREADS`.

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
