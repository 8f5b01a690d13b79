//! The number types that the models compute with.

mod cube_root;
mod dual;
#[cfg(feature = "fixed")]
mod fixed;
mod inverse;
mod norm;
mod real;
mod root;
mod tables;

pub(crate) use cube_root::cube_root;
pub use dual::Dual;
#[cfg(feature = "fixed")]
pub use fixed::{FixedPoint, FixedPointTerm, InFixedPoint};
pub(crate) use inverse::{inverse, power};
pub(crate) use norm::norm;
pub use real::Real;
pub(crate) use root::{NotConverged, root};
