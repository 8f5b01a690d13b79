//! What `examples/c/results.c` must print, computed in Rust.

use std::fmt::Write;

use microimpact::simulation::{Collocation, SimulatedImpact, Simulation, TangentialContact};
use microimpact::{InputError, NormalMotion, RigidBody, SpeedRestitution, Sphere, Stiffness};

/// Approach speed, tangential and peripheral velocity of each impact, m/s.
pub const MOTIONS: [[f32; 3]; 8] = [
    [2.8, 0.0, 0.0],
    [2.8, 0.0, 0.7388],
    [2.8, 20.0, 0.0],
    [2.8, 1.0, -2.5],
    [1.85, 0.0, 0.0],
    [0.5, 0.0, 0.0],
    [1.75, 0.2, 0.0],
    [1.0, 5.0, 0.0],
];

/// The lines of both models, with every bit of each number.
///
/// # Errors
/// None for the values here.
pub fn expected() -> Result<String, InputError> {
    let sphere = Sphere::solid(5.06e-6_f32, 2600.0)?;
    let body = RigidBody::new(sphere, SpeedRestitution::new(130.0)?).with_work_of_adhesion(2.22e-12)?;
    let body = body.with_friction(0.1)?;
    let contact = Simulation::new(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
    let contact = contact.with_friction(0.1)?;
    let method = Collocation::<7, f32>::new(1e-6)?;
    let (mut rigid, mut simulated) = (String::new(), String::new());
    for (index, [approach, tangential, peripheral]) in MOTIONS.into_iter().enumerate() {
        let motion = NormalMotion::new(approach)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
        let (impact, classification) = (body.impact(&motion), body.classify(&motion));
        line(
            &mut rigid,
            &format!("rigid {index} {}", classification.class() as u8),
            &[
                classification.speed_over_critical.unwrap_or(-1.0),
                classification.contact.friction_over_limit.unwrap_or(-1.0),
                impact.normal.overall_restitution(),
                impact.tangential.tangential(),
                impact.tangential.peripheral(),
            ],
        );
        let impact: SimulatedImpact<f32, TangentialContact<f32>, ()> = contact.observe(&method, &motion)?;
        line(
            &mut simulated,
            &format!("contact {index} {}", impact.class().map_or(u8::MAX, |class| class as u8)),
            &[
                impact.normal.overall_restitution(),
                impact.normal.peak_indentation().unwrap_or(-1.0),
                impact.tangential.velocity(),
                impact.tangential.spin(),
            ],
        );
    }
    Ok(rigid + &simulated)
}

fn line(text: &mut String, start: &str, numbers: &[f32]) {
    // Writing to a String cannot fail.
    let _ = write!(text, "{start}");
    for number in numbers {
        let _ = write!(text, " {:08x}", number.to_bits());
    }
    text.push('\n');
}
