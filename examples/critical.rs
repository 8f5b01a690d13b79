//! Finds the speed below which a surface captures spheres, for several radii, by both models.
//!
//! `cargo run --example critical`. The command line does the same for tables: `cargo microimpact critical`.

use microimpact::contact::{Collocation, Contact};
use microimpact::{CriticalSpeed, InputError, RigidBody, SpeedRestitution, Sphere, Stiffness};

fn main() -> Result<(), InputError> {
    // Twelve nodes, and a relative error of 1e-9 at most.
    let method = Collocation::<12, f64>::new(1e-9)?;
    for radius in [2.5e-6, 5.06e-6, 1e-5, 2.5e-5] {
        let sphere = Sphere::solid(radius, 2600.0)?;
        // Glass on steel (Brach and Dunn 1995): K in Pa; zeta_H; f0 in N/m and zeta_A.
        let contact = Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
        println!("radius {radius:e} m, simulation: {}", in_words(contact.critical_speed(&method)?));
        let rigid_body = RigidBody::new(sphere, SpeedRestitution::new(130.0)?).with_work_of_adhesion(2.22e-12)?;
        println!("radius {radius:e} m, rigid body: {}", in_words(rigid_body.critical_speed()));
    }
    Ok(())
}

fn in_words(critical: CriticalSpeed<f64>) -> String {
    match critical {
        CriticalSpeed::At(speed) => format!("captured below {speed:.4} m/s"),
        CriticalSpeed::AlwaysRebounds => "always rebounds".into(),
        CriticalSpeed::NeverRebounds => "never rebounds".into(),
    }
}
