//! Every number that the paper computes, with ours beside it.

use microimpact::contact::{Contact, Energy, Slip};
use microimpact::measure::{MeasuredRebound, adhesion_damping, material_damping, ring_strength};
use microimpact::rigid::{Departure, infer_assuming_rolling};
use microimpact::{
    ConstantRestitution, CriticalSpeed, Hertz, Material, NormalImpact, NormalMotion, RestitutionLaw, RigidBody,
    SpeedRestitution, Sphere, Stiffness,
};
use microimpact_scenes::table_1::ADHESION_COEFFICIENT;

use super::{
    ADHESION, FRICTION, GLASS, LAW_SPEED, MEAN_RADIUS, Outcome, RADIUS, SPEED, SPIN, SPIN_DEGREES, STIFFNESS,
    TOLERANCE, ZETA_A, ZETA_H, contact, glass, method, table_motion,
};
use crate::content::{Part, Table};

/// Velocities after the impact of Table 1, m/s.
const DEPARTURE: Departure<f64> = Departure { normal: 2.09, tangential: 0.21 };
/// R of Table 1.
const RESTITUTION: f64 = 0.978;
/// Damping of adhesion as it is printed.
const PRINTED_ZETA_A: f64 = 12.5;
/// Speed at which the restitution law and the simulation without adhesion have the same loss, m/s.
const FAST: f64 = 13.0;

/// Half a unit in the last of three digits, relative: up to it a number counts as equal.
const CLOSE: f64 = 0.005;

/// A number of the paper.
struct Number {
    /// With unit.
    quantity: &'static str,
    paper: f64,
    ours: f64,
    remark: &'static str,
}

impl Number {
    /// Of ours, relative.
    fn difference(&self) -> f64 {
        self.ours / self.paper - 1.0
    }
}

fn number(quantity: &'static str, paper: f64, ours: f64, remark: &'static str) -> Number {
    Number { quantity, paper, ours, remark }
}

/// How many numbers agree, and the tables of all of them.
pub(super) fn parts() -> Outcome<(String, Vec<Part>)> {
    let tables = [
        ("numbers-rigid-body", "Table 1 by the rigid-body model (A5-A34) and Hertz's theory.", rigid_body()?),
        ("numbers-figure-4", "The impacts of figure 4 at normal incidence (equation 1).", figure_4()?),
        (
            "numbers-simulation",
            "The simulation (B6-B10) with the paper's constants, the damping of adhesion halved to 6.25.",
            simulation()?,
        ),
        ("numbers-parameters", "How the paper finds its parameters.", parameters()?),
    ];
    let numbers = || tables.iter().flat_map(|(_, _, numbers)| numbers);
    let agree = numbers().filter(|number| number.difference().abs() <= CLOSE).count();
    let largest = numbers().map(|number| number.difference().abs()).fold(0.0, f64::max);
    let agreement = format!(
        "Of the {} numbers that Brach and Dunn (1995) print for the impact of silver-coated glass on steel, {agree} agree with ours \
         within {:.1}\u{a0}%, all within {:.1}\u{a0}%. The damping of adhesion is half of what is printed, which does not give the \
         paper's results.",
        numbers().count(),
        100.0 * CLOSE,
        100.0 * largest,
    );
    let mut parts: Vec<_> = tables.into_iter().map(|(name, caption, numbers)| table(name, caption, numbers)).collect();
    let caption = "The simulation with zeta_A = 12.5 as it is printed; the paper's results need half of it.";
    parts.push(table("numbers-printed", caption, printed()?));
    Ok((agreement, parts))
}

fn table(name: &str, caption: &str, numbers: Vec<Number>) -> Part {
    let row = |number: Number| {
        let difference = number.difference();
        vec![number.quantity.into(), number.paper.into(), number.ours.into(), difference.into(), number.remark.into()]
    };
    Part::Table(Table {
        name: name.to_owned(),
        caption: caption.to_owned(),
        columns: ["quantity", "paper", "ours", "relative difference", "remark"].map(str::to_owned).into(),
        rows: numbers.into_iter().map(row).collect(),
    })
}

/// Table 1: what follows from the measured velocities, and what the coefficients predict.
fn rigid_body() -> Outcome<Vec<Number>> {
    let (sphere, mean) = (glass(RADIUS)?, glass(MEAN_RADIUS)?);
    let stiffness = Stiffness::between(&Material::new(72e9, 0.21)?, &Material::new(207e9, 0.27)?)?;
    let motion = NormalMotion::new(SPEED)?;

    let constant = ConstantRestitution::new(RESTITUTION)?;
    let measured = infer_assuming_rolling(&sphere, &constant, &motion.with_tangential(0.0)?, &DEPARTURE)?;
    let scene = RigidBody::new(sphere, constant).with_adhesion_coefficient(ADHESION_COEFFICIENT)?;
    let impact = scene.with_friction(FRICTION)?.impact(&table_motion(SPIN)?);
    let ledger = impact.energy(&sphere);

    let law = SpeedRestitution::new(LAW_SPEED)?;
    let by_law = NormalImpact::from_measurement(&law, &motion, measured.normal.overall_restitution() * SPEED)?;
    let normal_energy = 0.5 * sphere.mass() * SPEED * SPEED;

    let hertz = Hertz::new(&mean, stiffness, &motion);
    let on_mean = RigidBody::new(mean, constant).with_adhesion_coefficient(ADHESION_COEFFICIENT)?.impact(&motion);
    let adhesion = on_mean.normal.impulses(&mean).adhesion_rebound;
    let angle = impact.tangential.velocity().atan2(impact.normal.rebound_speed()).to_degrees();
    Ok(vec![
        number("mass m, kg", 1.41e-12, sphere.mass(), ""),
        number("radius of gyration k, m", 3.20e-6, sphere.radius_of_gyration(), ""),
        number("Hertz stiffness K, Pa", STIFFNESS, stiffness.pascals(), "B2, B3"),
        number("R by k/(k + v)", RESTITUTION, law.restitution(SPEED), "the paper's k is approximately 130 m/s"),
        number("e, measured", 0.746, measured.normal.overall_restitution(), ""),
        number("rho, measured", ADHESION_COEFFICIENT, measured.normal.adhesion_coefficient(), ""),
        number("mu, measured", 0.043, measured.tangential.impulse_ratio(), ""),
        number("spin before, rad/s", SPIN, measured.tangential.spin_before(&sphere), "V_t = 0.21 m/s has two digits"),
        number(
            "spin before, degrees/s",
            SPIN_DEGREES,
            measured.tangential.spin_before(&sphere).to_degrees(),
            "the spin of the simulation",
        ),
        number("V_n, m/s", DEPARTURE.normal, impact.normal.rebound_speed(), "A21"),
        number("V_t, m/s", DEPARTURE.tangential, impact.tangential.velocity(), "A22"),
        number("spin after, rad/s", 4.16e4, impact.tangential.spin(&sphere), "A23; the paper uses its rounded mu"),
        number("rebound angle, degrees", 5.75, angle, ""),
        number("T_i, J", 5.68e-12, ledger.before, ""),
        number("T_L/T_i", 0.451, ledger.lost() / ledger.before, "A29"),
        number(
            "W_A, J",
            2.27e-12,
            impact.normal.adhesion_loss() * ledger.before,
            "R^2 - e^2 times the whole energy, spin included",
        ),
        number(
            "W_A by A34, J",
            2.22e-12,
            by_law.adhesion_loss() * normal_energy,
            "R^2 - e^2 times the energy of the normal motion, R by the law; not printed",
        ),
        number("Hertz indentation, m", 1.97e-8, hertz.indentation, "of the mean sphere, 4.3 um"),
        number("Hertz contact radius, m", 3.16e-7, (RADIUS * hertz.indentation).sqrt(), "mixes 5.06 um and 4.3 um"),
        number("Hertz force, N", 4.31e-4, hertz.force, "of the mean sphere"),
        number("Hertz duration, s", 2.07e-8, hertz.duration, "of the mean sphere"),
        number(
            "average adhesion force, N",
            5.43e-5,
            -adhesion / (hertz.duration / 2.0),
            "of the mean sphere: P_A over half the duration",
        ),
    ])
}

/// Steel on steel at normal incidence, from mu_0 = 0.12 and e = 0.601.
fn figure_4() -> Outcome<Vec<Number>> {
    let (speed, e, ratio) = (2.3, 0.601, 0.12);
    let steel = Sphere::solid(25e-6, 7800.0)?;
    let after = Departure { normal: e * speed, tangential: ratio * (1.0 + e) * speed };
    let before = NormalMotion::new(speed)?.with_tangential(0.0)?;
    let impact = infer_assuming_rolling(&steel, &ConstantRestitution::new(1.0)?, &before, &after)?.tangential;
    let spin = impact.spin_before(&steel);
    Ok(vec![
        number("r w, m/s", 1.54, spin * steel.radius(), "drawn as 1.51"),
        number("V_t, m/s", 0.44, impact.velocity(), ""),
        number("spin before, rad/s", 6.2e4, spin, "radius 25 um"),
    ])
}

fn simulation() -> Outcome<Vec<Number>> {
    let method = method()?;
    let motion = table_motion(SPIN_DEGREES.to_radians())?;
    let (impact, (slip, ledger)) =
        contact(RADIUS)?.with_friction(FRICTION)?.solve_for(&motion, &method, (Slip, Energy))?;
    let mean = contact(MEAN_RADIUS)?.solve_normal(&NormalMotion::new(SPEED)?, &method)?;
    let small = contact(2.5e-6)?.critical_speed(&method)?;
    let critical = if let CriticalSpeed::At(speed) = small { speed } else { f64::NAN };
    let ledger = ledger.ok_or("the impact of Table 1 rebounds")?;
    let rebound = impact.normal.rebound_speed();
    let angle = impact.tangential.velocity().atan2(rebound).to_degrees();
    let equilibrium = std::f64::consts::TAU * ADHESION / STIFFNESS;
    Ok(vec![
        number("e, 4.3 um", 0.62, mean.overall_restitution(), "the impact that zeta_A is chosen by"),
        number("e, 5.06 um", 0.746, impact.normal.overall_restitution(), "Table 1"),
        number("V_n, m/s", 2.09, rebound, ""),
        number("V_t, m/s", 0.21, impact.tangential.velocity(), ""),
        number("spin after, rad/s", 4.16e4, impact.tangential.spin(), ""),
        number("rebound angle, degrees", 5.76, angle, ""),
        number("rotation in contact, degrees", 0.12, slip.rotation_degrees(), ""),
        number("largest indentation, m", 4.243e-8, impact.normal.peak_indentation().unwrap_or(f64::NAN), ""),
        number("work of adhesion, J", 4.83e-13, ledger.adhesion, "lost to its damping"),
        number("T_L/T_i", 0.451, ledger.lost() / ledger.before, "identical to the rigid-body model"),
        number("equilibrium indentation, m", 2.09e-8, equilibrium, "2 pi f0/K"),
        number("critical speed, diameter 5 um, m/s", 5.0, critical, "about 5 m/s"),
    ])
}

/// K, f0 and the dissipation parameters, by the steps of the paper.
fn parameters() -> Outcome<Vec<Number>> {
    let (mean, stiffness, method) = (glass(MEAN_RADIUS)?, Stiffness::new(STIFFNESS)?, method()?);
    let strength = |ratio: f64| ring_strength(&mean, stiffness, ratio * MEAN_RADIUS);
    let (low, high) = (strength(0.05)?, strength(0.10)?);
    let fast = MeasuredRebound { speed: FAST, restitution: SpeedRestitution::new(LAW_SPEED)?.restitution(FAST) };
    let bare = Contact::hertz(mean, stiffness);
    let material = material_damping(&bare, &method, &fast, TOLERANCE)?;
    let slow = MeasuredRebound { speed: SPEED, restitution: 0.62 };
    let adhesion = adhesion_damping(&bare.with_damping(ZETA_H)?, ADHESION, &method, &slow, TOLERANCE)?;
    Ok(vec![
        number("least f0, N/m", 128.3, low, "a/r = 0.05 at rest"),
        number("largest f0, N/m", 513.3, high, "a/r = 0.10"),
        number("mean f0, N/m", 256.6, (low * high).sqrt(), "geometric mean; 250 was chosen"),
        number("zeta_H", 10.45, material, "with R by the law at 13 m/s, where adhesion hardly counts"),
        number("zeta_A", ZETA_A, adhesion, "from e = 0.62; half of the 12.5 that is printed"),
    ])
}

/// What the printed parameter gives, against what the paper found.
fn printed() -> Outcome<Vec<Number>> {
    let e = |radius| -> Outcome<f64> {
        let scene = Contact::hertz(Sphere::solid(radius, GLASS)?, Stiffness::new(STIFFNESS)?);
        let scene = scene.with_damping(ZETA_H)?.with_ring(ADHESION, PRINTED_ZETA_A)?;
        Ok(scene.solve_normal(&NormalMotion::new(SPEED)?, &method()?)?.overall_restitution())
    };
    let remark = "not reproduced: see above for half of it";
    Ok(vec![number("e, 4.3 um", 0.62, e(MEAN_RADIUS)?, remark), number("e, 5.06 um", 0.746, e(RADIUS)?, remark)])
}
