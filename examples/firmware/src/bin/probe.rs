//! Calls all of the library and links only if nothing in it can panic: the panic
//! handler refers to a symbol that does not exist.

#![no_std]
#![no_main]

use microimpact_firmware::{entries, entry};
use panic_never as _;

#[entry]
fn main() -> ! {
    loop {
        entries::call_all::<f32>();
        entries::call_all::<f64>();
    }
}
