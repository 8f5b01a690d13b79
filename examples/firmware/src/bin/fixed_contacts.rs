//! Measures the scenes of the contact simulation in fixed point, their units included.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::fixed_contacts::visit_oblique_contacts;

#[entry]
fn main() -> ! {
    measurement::run(visit_oblique_contacts)
}
