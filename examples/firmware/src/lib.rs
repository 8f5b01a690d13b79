//! What the firmware binaries share: the impacts, the scenes that classify
//! them, and calls of all of the library.
//!
//! `impacts`, `scenes`, `contacts`, `fixed_contacts` and `tables` know nothing of a microcontroller; the
//! runner `cargo qemu` compiles the same five files for the host and compares.

#![no_std]

/// Marks the function that the runtime starts.
#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
/// Marks the function that the runtime starts.
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

pub mod contacts;
pub mod entries;
pub mod fixed_contacts;
pub mod flash;
pub mod impacts;
pub mod scenes;
#[cfg(feature = "instrument")]
pub mod station;
pub mod tables;
