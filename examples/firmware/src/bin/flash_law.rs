//! Simulates normal impacts with one law of contact by one method only, in f32: the scene at the place `MICROIMPACT_LAW` in
//! the list of laws, when this is built. The size of this binary, less that of `flash_empty`, is the flash that the
//! library needs for it.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::flash::{MEASURED, classify_for_ever, do_nothing_for_ever};
use microimpact_firmware::impacts::TABLE_1;
use microimpact_firmware::laws::chosen;
use microimpact_firmware::scenes::{Measured, Number, Scene, Visitor};
use panic_halt as _;

// As a constant, or the compiler would build all laws.
const CLASSIFY: fn(&mut Alone) = chosen(option_env!("MICROIMPACT_LAW"));

#[entry]
fn main() -> ! {
    CLASSIFY(&mut Alone);
    do_nothing_for_ever(MEASURED)
}

struct Alone;

impl Visitor for Alone {
    fn visit<T: Number, S: Scene<T>>(&mut self) {
        classify_for_ever::<T, S>(Measured::from(&TABLE_1));
    }
}
