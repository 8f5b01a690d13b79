//! Tests of the instrument and of its link to a host.

mod configuration;
mod instrument;
mod instrument_link;
mod protocol;
mod storage;
