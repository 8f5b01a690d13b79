#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![warn(clippy::panic, clippy::unwrap_used, clippy::expect_used, clippy::indexing_slicing)]
// What is sent and stored has the same bytes on every processor.
#![warn(clippy::host_endian_bytes)]

#[cfg(feature = "std")]
extern crate std;

mod bodies;
mod classify;
mod config;
pub mod contact;
mod error;
#[cfg(feature = "instrument")]
pub mod instrument;
pub mod measure;
mod motion;
mod numbers;
#[cfg(feature = "serde")]
mod read;
pub mod rigid;
mod rolling;
pub mod space;
pub mod table;
mod terms;

pub use bodies::{AdhesionRegime, Hertz, KnownMaterial, MATERIALS, Material, Sourced, Sphere, Sticking, Stiffness};
pub use classify::{Class, Classification, ContactClass, CriticalSpeed, Outcome, SurfaceMotion};
pub use config::{
    AdhesionConfig, AnyModel, DampingConfig, ModelConfig, ReboundAdhesionConfig, RestitutionConfig, SceneConfig,
};
pub use error::{Fault, ImpactError, InputError, Parameter};
pub use motion::{Approach, NormalMotion, Oblique, ObliqueMotion, Planar, PlanarMotion};
pub use numbers::{Dual, Real};
#[cfg(feature = "fixed")]
pub use numbers::{FixedPoint, FixedPointTerm, InFixedPoint};
pub use rigid::{
    ConstantRestitution, Impact, NormalImpact, RestitutionLaw, RigidBody, SpeedRestitution, TangentialImpact,
};
pub use rolling::Separation;
pub use terms::{Coulomb, NoAdhesion, NoFriction};
