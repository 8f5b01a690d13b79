//! Measures the calibrations in single precision.

#![no_std]
#![no_main]

use microimpact_firmware::calibrations::visit_calibrations;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(visit_calibrations)
}
