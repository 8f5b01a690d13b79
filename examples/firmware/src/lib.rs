//! What the firmware binaries share: the impacts, the scenes that classify
//! them, and the instruments that count instructions and measure stack.
//!
//! `impacts` and `scenes` know nothing of a microcontroller; the runner
//! `cargo qemu` compiles the same two files for the host and compares.

#![no_std]

pub mod counter;
pub mod entries;
pub mod flash;
pub mod impacts;
pub mod scenes;
pub mod stack;
