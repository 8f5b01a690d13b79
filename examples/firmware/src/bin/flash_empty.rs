//! The runtime and the inputs of the other `flash_*` binaries, without a
//! classification: what is to be subtracted from their sizes.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::flash::{MEASURED, do_nothing_for_ever};
use panic_halt as _;

#[entry]
fn main() -> ! {
    do_nothing_for_ever(MEASURED)
}
