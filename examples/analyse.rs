//! Analyses measured impacts: the coefficients of one, and the parameters of a material from several.
//!
//! `cargo run --example analyse`. The command line does the same for tables: `cargo microimpact analyse`.

use std::error::Error;

use microimpact::measure::{MeasuredRebound, RestitutionFit};
use microimpact::rigid::{Departure, infer_assuming_rolling};
use microimpact::{CriticalSpeed, NormalMotion, SpeedRestitution, Sphere};

fn main() -> Result<(), Box<dyn Error>> {
    let sphere = Sphere::solid(5.06e-6, 2600.0)?;

    // One impact (Brach and Dunn 1995, Table 1), whose spin was not measured.
    let before = NormalMotion::new(2.8)?.with_tangential(0.0)?;
    let after = Departure { normal: 2.09, tangential: 0.21 };
    let impact = infer_assuming_rolling(&sphere, &SpeedRestitution::new(130.0)?, &before, &after)?;
    println!("e = {:.4}", impact.normal.overall_restitution());
    println!("adhesion coefficient {:.3}", impact.normal.adhesion_coefficient());
    println!("impulse ratio {:.4}", impact.tangential.impulse_ratio());
    let energy = impact.energy(&sphere);
    println!("lost {:.1} % of {:.2e} J", 100.0 * energy.lost() / energy.before, energy.before);

    // Several: approach and rebound speed in m/s.
    let speeds = [(2.0, 1.1), (2.8, 2.09), (4.0, 3.43), (6.0, 5.46), (9.0, 8.25), (14.0, 12.5), (20.0, 17.2)];
    let rebounds = speeds.map(|(approach, rebound)| MeasuredRebound::from_speeds(approach, rebound));
    let fit = RestitutionFit::of(&sphere, &rebounds.into_iter().collect::<Result<Vec<_>, _>>()?)?;
    let (k, work) = (fit.restitution_speed, fit.work_of_adhesion);
    println!("k = {:.0} ± {:.0} m/s", k.value, k.standard_error);
    println!("work of adhesion {:.2e} ± {:.0e} J", work.value, work.standard_error);
    if let CriticalSpeed::At(speed) = fit.critical_speed()? {
        println!("captured below {:.2} ± {:.0e} m/s", speed.value, speed.standard_error);
    }
    Ok(())
}
