//! A part of what `probe` calls, and one index that may be out of bounds: must not link,
//! or else `probe` proves nothing.

#![no_std]
#![no_main]

use core::hint::black_box;

use microimpact_firmware::{entries, entry};
use panic_never as _;

#[entry]
fn main() -> ! {
    loop {
        entries::call_rigid_body::<f32>();
        black_box([1, 2, 3][black_box(0)]);
    }
}
