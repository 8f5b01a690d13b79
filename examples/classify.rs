//! Classifies impacts by both models: the algebra of the rigid body, and the simulated contact.
//!
//! `cargo run --example classify`. The command line does the same for tables: `cargo microimpact classify`.

use microimpact::contact::{Collocation, Contact};
use microimpact::{InputError, NormalMotion, RigidBody, SpeedRestitution, Sphere, Stiffness};

fn main() -> Result<(), InputError> {
    // Silver-coated glass on steel, radius 5.06 um (Brach and Dunn 1995, Table 1).
    let sphere = Sphere::solid(5.06e-6_f64, 2600.0)?;
    // R = k/(k + v) with k = 130 m/s; W_A in J; Coulomb's coefficient.
    let rigid_body =
        RigidBody::new(sphere, SpeedRestitution::new(130.0)?).with_work_of_adhesion(2.22e-12)?.with_friction(0.1)?;
    // K in Pa; zeta_H; f0 in N/m and zeta_A.
    let contact = Contact::hertz(sphere, Stiffness::new(7.5e10)?)
        .with_damping(10.5)?
        .with_ring(250.0, 6.25)?
        .with_friction(0.1)?;
    // Nine nodes, and an error of e^2 of 1e-9 at most.
    let method = Collocation::<9, f64>::new(1e-9)?;

    for (approach, tangential, spin) in [(2.8, 0.0, 1.46e5), (2.8, 20.0, 0.0), (0.5, 0.0, 0.0)] {
        let before = NormalMotion::new(approach)?.with_tangential(tangential)?.with_spin(&sphere, spin)?;
        println!("approach {approach} m/s, tangential {tangential} m/s, spin {spin:e} rad/s");

        let classification = rigid_body.classify(&before);
        print!("  rigid body: {}", classification.class());
        match classification.speed_over_critical {
            Some(margin) => println!(", at {margin:.2} times the critical speed"),
            None => println!(),
        }

        let impact = contact.solve(&before, &method)?;
        match impact.class() {
            Some(class) => println!("  simulation: {class}, e = {:.4}", impact.normal.overall_restitution()),
            None => println!("  simulation: no result within its budget"),
        }
    }
    Ok(())
}
