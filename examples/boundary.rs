//! Makes a table of critical speeds for one material, and classifies impacts by looking them up.
//!
//! `cargo run --example boundary`. The command line writes such a table for firmware: `cargo microimpact table`.

use microimpact::contact::{Collocation, Contact};
use microimpact::table::{BoundaryTable, TableOutcome};
use microimpact::{InputError, NormalMotion, Sphere, Stiffness};

fn main() -> Result<(), InputError> {
    let method = Collocation::<9, f64>::new(1e-9)?;
    // Twelve cells of a quarter of an octave each, from a radius of 2 um on.
    let table = BoundaryTable::<12>::new(2e-6, |radius| {
        let sphere = Sphere::solid(radius, 2600.0)?;
        Contact::hertz(sphere, Stiffness::new(7.5e10)?)
            .with_damping(10.5)?
            .with_ring(250.0, 6.25)?
            .critical_speed(&method)
    })?;
    println!("largest relative error: {:.1e}", table.margin::<f64>());

    // Looked up in single precision, as firmware does.
    for (radius, speed) in [(2.5e-6_f32, 2.8), (2.5e-6, 5.1596), (5.06e-6, 2.8), (1e-3, 2.8)] {
        let outcome = match table.classify(radius, &NormalMotion::new(speed)?) {
            TableOutcome::Rebound => "rebound",
            TableOutcome::Capture => "capture",
            TableOutcome::TooCloseToCall => "too close to the critical speed",
            TableOutcome::OutsideTable => "the table does not reach this radius",
        };
        println!("radius {radius:e} m, {speed} m/s: {outcome}");
    }
    Ok(())
}
