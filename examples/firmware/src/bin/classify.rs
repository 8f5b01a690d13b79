//! Measures the scenes of the rigid body, of tables and of fixed point.

#![no_std]
#![no_main]

use microimpact_firmware::entry;
use microimpact_firmware::scenes::visit_scenes;

#[entry]
fn main() -> ! {
    measurement::run(visit_scenes)
}
