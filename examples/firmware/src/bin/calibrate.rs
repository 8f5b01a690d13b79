//! Measures the calibrations in single precision.

#![no_std]
#![no_main]

#[path = "../calibration.rs"]
mod calibration;

use calibration::Measured;
use microimpact_firmware::calibrations::visit_calibrations;
use microimpact_firmware::entry;

#[entry]
fn main() -> ! {
    measurement::run(|measurement| visit_calibrations(&mut Measured(measurement)))
}
