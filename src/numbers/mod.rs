//! The number types that the models compute with.

mod dual;
#[cfg(feature = "fixed")]
mod fixed;
mod real;
mod roots;
mod tables;

pub use dual::Dual;
#[cfg(feature = "fixed")]
pub use fixed::{FixedPoint, InFixedPoint};
pub use real::Real;
pub(crate) use roots::cube_root;
