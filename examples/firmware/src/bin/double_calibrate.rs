//! Measures the calibrations in double precision.

#![no_std]
#![no_main]

use microimpact_firmware::calibrations::visit_double_calibrations;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(visit_double_calibrations)
}
