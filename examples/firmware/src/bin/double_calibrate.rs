//! Measures the calibrations in double precision.

#![no_std]
#![no_main]

#[path = "../calibration.rs"]
mod calibration;

use calibration::Measured;
use microimpact_firmware::calibrations::visit_double_calibrations;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(|measurement| visit_double_calibrations(&mut Measured(measurement)))
}
