//! What the firmware binaries share: the impacts, the scenes that classify
//! them, and calls of all of the library.
//!
//! `approximate`, `impacts`, `scenes`, `contacts`, `fixed_contacts`, `table_1`, `tables`, `variants` and `calibrations` know
//! nothing of a microcontroller; the runner `cargo qemu` compiles the same nine files for the host and compares.

#![no_std]

/// Marks the function that the runtime starts.
#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
/// Marks the function that the runtime starts.
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

pub mod approximate;
pub mod calibrations;
pub mod contacts;
pub mod entries;
pub mod fixed_contacts;
pub mod flash;
pub mod impacts;
#[cfg(feature = "methods")]
pub mod methods;
pub mod scenes;
#[cfg(feature = "instrument")]
pub mod station;
pub mod table_1;
pub mod tables;
pub mod variants;
