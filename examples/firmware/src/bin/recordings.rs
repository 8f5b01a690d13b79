//! Measures simulations that record the motion.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::variants::visit_recordings;

#[entry]
fn main() -> ! {
    measurement::run(visit_recordings)
}
