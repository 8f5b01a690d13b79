//! Measures the simulation with one law of contact by one method: the scene at the place `MICROIMPACT_LAW` in the list of
//! laws, when this is built.

#![no_std]
#![no_main]

use measurement::Measurement;
use microimpact_firmware::entry;
use microimpact_firmware::laws::chosen;

// As a constant, or the compiler would build all laws.
const MEASURE: fn(&mut Measurement) = chosen(option_env!("MICROIMPACT_LAW"));

#[entry]
fn main() -> ! {
    measurement::run(MEASURE)
}
