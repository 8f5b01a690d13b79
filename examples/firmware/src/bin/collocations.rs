//! Measures a simulation to a tolerance with a term that only those have.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::variants::visit_collocations;

#[entry]
fn main() -> ! {
    measurement::run(visit_collocations)
}
