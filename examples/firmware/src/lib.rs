//! What the firmware binaries share: the scenes that the host knows too, and calls of all of the library.

#![no_std]

/// Marks the function that the runtime starts.
#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
pub use microimpact_scenes::*;
/// Marks the function that the runtime starts.
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

pub mod entries;
pub mod flash;
