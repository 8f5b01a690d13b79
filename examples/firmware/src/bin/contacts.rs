//! Measures the scenes of the contact simulation in single precision.

#![no_std]
#![no_main]

use microimpact_firmware::contacts::visit_contacts;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(visit_contacts)
}
