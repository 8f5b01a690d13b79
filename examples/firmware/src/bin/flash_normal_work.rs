//! Classifies normal impacts only, with a work of adhesion, in f32. The size of this
//! binary, less that of `flash_empty`, is the flash that the library needs for it.

#![no_std]
#![no_main]

use microimpact::rigid::WorkOfAdhesion;
use microimpact_firmware::entry;
use microimpact_firmware::flash::{MEASURED, classify_for_ever};
use microimpact_firmware::scenes::Normal;
use panic_halt as _;

#[entry]
fn main() -> ! {
    classify_for_ever::<f32, Normal<f32, WorkOfAdhesion<f32>>>(MEASURED)
}
