//! Measures the scenes of the contact simulation in double precision.

#![no_std]
#![no_main]

use microimpact_firmware::contacts::visit_double_contacts;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(visit_double_contacts)
}
