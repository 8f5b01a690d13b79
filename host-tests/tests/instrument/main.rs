//! Tests of the instrument and of its link to a host.

mod instrument;
mod instrument_link;
