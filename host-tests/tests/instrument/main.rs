//! Tests of the instrument, of its events and sensors, and of its link to a host.

mod counting;
mod events;
mod instrument;
mod instrument_link;
mod sensors;
