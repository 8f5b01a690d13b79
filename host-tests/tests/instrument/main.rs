//! Tests of the instrument, of its configuration, events and sensors, and of its link to a host.

mod configuration;
mod counting;
mod events;
mod instrument;
mod instrument_link;
mod protocol;
mod sensors;
mod storage;
