//! A serial link between an instrument and its host. The host sends readings, and the instrument answers with classes.
//!
//! A frame contains a message in the format of postcard and its CRC-32. COBS encodes both, so that zero bytes mark the start
//! and the end of a frame and occur nowhere else. Noise between frames, or a damaged frame, does not affect the next frame.
//! Readings have consecutive numbers, so that the instrument recognises repeated and missing readings, and answers no reading
//! twice. This module needs the feature `link`.
#![doc = include_str!("protocol.md")]

mod frame;
mod inlet;
mod message;
mod outlet;
mod schema;
mod station;

pub use frame::{Decoder, Encoder, FrameFault};
pub use inlet::Inlet;
pub use message::{Arrivals, FrameFaults, MOST_CLASSES, PROTOCOL, Refusal, Reply, Report, Request};
pub use outlet::{Outlet, ReplyFault};
pub use schema::{Described, Schema};
pub use station::{Received, Station, fixed_scene};
