//! The link between an instrument and its host: readings go in, classes come out, and nothing is answered twice.
//!
//! A frame is a message in postcard's format and its CRC-32, stuffed by COBS so that a zero byte marks its two ends and
//! stands nowhere else. Noise between frames and whatever happens to one frame thus leave the next one whole. Every reading
//! has a number one above that of the one before it: what arrives twice is recognised, and what does not arrive is missed.
//! Needs the feature `link`.

mod frame;
mod message;

pub use frame::{Decoder, Encoder, FrameFault};
pub use message::{Arrivals, FrameFaults, Inlet, PROTOCOL, Reply, Report, Request};
