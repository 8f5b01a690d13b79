//! Measures scenes with one term after the other: as rigid bodies, and simulated at a fixed cost.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::variants::visit_variants;

#[entry]
fn main() -> ! {
    measurement::run(visit_variants)
}
