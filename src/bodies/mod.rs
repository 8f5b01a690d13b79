//! What collides: spheres, the materials they and the surface are made of, and the elastic contact between them.

mod adhesion;
mod hertz;
mod material;
mod sphere;
mod stiffness;

pub(crate) use adhesion::strength_at_rest;
pub use adhesion::{AdhesionRegime, Sticking};
pub use hertz::Hertz;
pub use material::Material;
pub use sphere::Sphere;
pub use stiffness::Stiffness;
