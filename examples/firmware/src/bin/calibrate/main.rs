//! Measures the calibrations in single precision.

#![no_std]
#![no_main]

mod measured;

use measured::Measured;
use microimpact_firmware::calibrations::visit_calibrations;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(|measurement| visit_calibrations(&mut Measured(measurement)))
}
