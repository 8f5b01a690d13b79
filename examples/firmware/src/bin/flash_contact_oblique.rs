//! Simulates the contact of impacts with friction and spin, in f32. The size of this
//! binary, less that of `flash_empty`, is the flash that the library needs for it.

#![no_std]
#![no_main]

use microimpact::contact::{Collocation, Slip};
use microimpact_firmware::contacts::ObliqueContacts;
use microimpact_firmware::entry;
use microimpact_firmware::flash::{MEASURED, classify_for_ever};
use panic_halt as _;

#[entry]
fn main() -> ! {
    classify_for_ever::<f32, ObliqueContacts<f32, Collocation<7, f32>, Slip>>(MEASURED)
}
