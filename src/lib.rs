#![cfg_attr(doc, doc = include_str!("figures.md"))]
#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::panic, clippy::unwrap_used, clippy::expect_used, clippy::indexing_slicing)]

pub mod boundary;
pub mod calibrate;
mod classify;
pub mod contact;
mod dual;
mod error;
#[cfg(feature = "fixed")]
mod fixed;
mod hertz;
#[cfg(feature = "instrument")]
pub mod instrument;
mod motion;
mod real;
pub mod rigid;
mod scene;
mod sphere;
mod surface;
pub mod uncertainty;

#[cfg(feature = "fixed")]
pub use crate::fixed::{FixedPoint, InFixedPoint};
pub use classify::{Class, Classification, ContactClass, CriticalSpeed, Outcome, SurfaceMotion};
pub use dual::Dual;
pub use error::{Fault, ImpactError, InputError, Parameter};
pub use hertz::Hertz;
pub use motion::{Approach, NormalMotion, Oblique, ObliqueMotion, PlanarMotion};
pub use real::Real;
pub use rigid::{
    ConstantRestitution, Impact, NormalImpact, RestitutionLaw, RigidBody, SpeedRestitution, TangentialImpact,
};
pub use scene::{Coulomb, NoAdhesion, NoFriction};
pub use sphere::Sphere;
pub use surface::{Material, Stiffness};
