//! Classifies the impact that takes most instructions in each of the scenes whose cycles are modelled, and prints the instructions
//! of each call. `cargo qemu cycles` follows the same calls instruction by instruction.

#![no_std]
#![no_main]

use microimpact::contact::{Collocation, FixedCost, Slip};
use microimpact::rigid::WorkOfAdhesion;
use microimpact_firmware::contacts::{NormalContacts, ObliqueContacts};
use microimpact_firmware::entry;
use microimpact_firmware::fixed_contacts::{FixedPointContacts, FixedPointNormal};
use microimpact_firmware::scenes::{Normal, Planar};

#[entry]
fn main() -> ! {
    measurement::run(|measurement| {
        measurement.count::<f32, Normal<f32, WorkOfAdhesion<f32>>>("straight");
        measurement.count::<f32, Planar<f32, WorkOfAdhesion<f32>>>("oblique");
        measurement.count::<f32, NormalContacts<f32, FixedCost<5>>>("straight");
        measurement.count::<f32, NormalContacts<f32, FixedCost<7>>>("straight");
        measurement.count::<f32, ObliqueContacts<f32, FixedCost<5, 7>, ()>>("table-1");
        measurement.count::<f32, FixedPointNormal>("straight");
        measurement.count::<f32, FixedPointContacts>("straight");
        measurement.count::<f32, NormalContacts<f32, Collocation<7, f32>>>("just-rebounds");
        measurement.count::<f32, ObliqueContacts<f32, Collocation<7, f32>, Slip>>("slides-on");
    })
}
