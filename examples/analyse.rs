//! Analyses measured impacts: the coefficients of one, and the parameters of a material from several.
//!
//! `cargo run --example analyse`. The command line does the same for tables: `cargo microimpact analyse`.

use std::error::Error;

use microimpact::measure::{Estimate, MeasuredImpact, RestitutionFit};
use microimpact::rigid::{Departure, infer_assuming_rolling};
use microimpact::{NormalMotion, SpeedRestitution, Sphere};

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

    // Several: approach and rebound speed in m/s, each with a standard error of 0.02 m/s; zero for a capture.
    let speeds = [
        (1.5, 0.0),
        (1.7, 0.0),
        (2.0, 0.86),
        (2.3, 1.42),
        (2.8, 2.09),
        (3.4, 2.80),
        (4.0, 3.47),
        (5.0, 4.49),
        (6.0, 5.46),
        (7.0, 6.41),
        (9.0, 8.23),
        (11.0, 9.98),
        (14.0, 12.53),
        (17.0, 14.96),
        (20.0, 17.26),
    ];
    let speed = |value| Estimate { value, standard_error: 0.02 };
    let impacts = speeds.map(|(approach, rebound)| {
        let rebound = (rebound > 0.0).then(|| speed(rebound));
        MeasuredImpact { sphere, approach: speed(approach), rebound }
    });
    let fit = RestitutionFit::of(&impacts)?;
    let (k, work) = (fit.restitution_speed, fit.work_of_adhesion);
    println!("the law R = k/(k + v) {}", if fit.fits { "fits" } else { "does not fit" });
    println!("k = {:.0} m/s, 95 % from {:.0} to {:.0}", k.value, k.low, k.high);
    println!("work of adhesion {:.2e} J, from {:.2e} to {:.2e}", work.value, work.low, work.high);
    if let Some(speed) = fit.critical_speed {
        println!("captured below {:.2} m/s, from {:.2} to {:.2}", speed.value, speed.low, speed.high);
    }
    Ok(())
}
