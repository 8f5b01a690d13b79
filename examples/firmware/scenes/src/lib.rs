//! What the boards and the host compute alike: the scenes that classify impacts, calibrations, methods to compare, and the
//! station of the instrument. Nothing here knows of a microcontroller; `cargo qemu` compares what both find.

#![no_std]

pub mod approximate;
pub mod calibrations;
pub mod contacts;
pub mod fixed_contacts;
pub mod functions;
pub mod impacts;
pub mod laws;
#[cfg(feature = "methods")]
pub mod methods;
pub mod scenes;
#[cfg(feature = "station")]
pub mod station;
pub mod table_1;
pub mod tables;
pub mod uncertain;
pub mod variants;
