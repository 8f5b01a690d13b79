//! Measures the functions of the models, each alone.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::functions::visit_functions;

#[entry]
fn main() -> ! {
    measurement::run(visit_functions)
}
