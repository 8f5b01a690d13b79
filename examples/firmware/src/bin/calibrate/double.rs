//! Measures the calibrations in double precision.

#![no_std]
#![no_main]

mod measured;

use measured::Measured;
use microimpact_firmware::calibrations::visit_double_calibrations;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(|measurement| visit_double_calibrations(&mut Measured(measurement)))
}
