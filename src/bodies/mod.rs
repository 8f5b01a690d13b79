//! What collides: spheres, the materials they and the surface are made of, and the elastic contact between them.

mod adhesion;
mod hertz;
mod material;
mod materials;
mod sphere;
mod stiffness;

pub(crate) use adhesion::strength_at_rest;
pub use adhesion::{AdhesionRegime, Sticking};
pub use hertz::Hertz;
pub use material::Material;
pub use materials::{KnownMaterial, MATERIALS, Sourced};
pub use sphere::Sphere;
pub use stiffness::Stiffness;
