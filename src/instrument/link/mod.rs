//! A serial link between an instrument and its host. The host sends readings, and the instrument answers with classes.
//!
//! A frame contains a message in the format of postcard and its CRC-32. COBS encodes both, so that zero bytes mark the start
//! and the end of a frame and occur nowhere else. Noise between frames, or a damaged frame, does not affect the next frame.
//! Readings have consecutive numbers, so that the instrument recognises repeated and missing readings, and answers no reading
//! twice. This module needs the feature `link`.

mod frame;
mod message;

pub use frame::{Decoder, Encoder, FrameFault};
pub use message::{Arrivals, FrameFaults, Inlet, PROTOCOL, Reply, Report, Request};
