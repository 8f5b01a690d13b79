//! Figures of the rigid-body model: 2, 4 and A2.

use microimpact::{ConstantRestitution, InputError, NormalMotion, RigidBody, SpeedRestitution, Sphere};

use super::{LAW_SPEED, Outcome, RADIUS, SPEED, SPIN, WORK, column, figure, glass, spaced};
use crate::content::Part;
use crate::plot::{self, Axis, Line, Mark};

/// Density of steel, kg/m^3.
const STEEL: f64 = 7800.0;
/// Radius of the steel spheres of figure 4, m.
const STEEL_RADIUS: f64 = 25e-6;
/// Mean restitution and speed of their normal impacts.
const STEEL_RESTITUTION: f64 = 0.601;
const STEEL_SPEED: f64 = 2.3;
/// Peripheral velocity r w of the bounds of figure 4, m/s.
const PERIPHERAL: f64 = 1.51;

pub(super) fn parts() -> Outcome<Vec<Part>> {
    Ok(vec![figure_2()?, figure_4()?, figure_a2()?])
}

/// Impulse ratio mu_0 that ends sliding (equation 1), for a sphere that comes in against t at a given angle from the surface.
fn rolling_ratio(sphere: Sphere<f64>, e: f64, speed: f64, angle: f64, peripheral: f64) -> Result<f64, InputError> {
    let (normal, tangential) = angle.to_radians().sin_cos();
    let motion = NormalMotion::new(speed * normal)?.with_tangential(-speed * tangential)?;
    let scene = RigidBody::new(sphere, ConstantRestitution::new(e)?).with_friction(0.0)?;
    Ok(scene.impact(&motion.with_peripheral_velocity(peripheral)?).tangential.rolling_ratio())
}

/// Angles of incidence from glancing to normal.
fn angles() -> impl Iterator<Item = f64> {
    (10..=180).map(|half| 0.5 * f64::from(half))
}

fn angle_axis() -> Axis {
    Axis::linear("angle of incidence", "α", "°").between(0.0, 92.0)
}

fn figure_2() -> Outcome<Part> {
    let sphere = glass(RADIUS)?;
    let row = |angle| {
        let ratio = |e, peripheral| rolling_ratio(sphere, e, SPEED, angle, peripheral);
        let spin = RADIUS * SPIN;
        Ok([angle, ratio(0.0, 0.0)?, ratio(1.0, 0.0)?, ratio(0.0, spin)?, ratio(1.0, spin)?])
    };
    let rows = angles().map(row).collect::<Result<Vec<_>, InputError>>()?;
    let lines = [
        Line::new("I: R = 0, no spin", Mark::Solid, column(&rows, 1)),
        Line::new("II: R = 1, no spin", Mark::Solid, column(&rows, 2)),
        Line::new("III: R = 0, with spin", Mark::Dashed, column(&rows, 3)),
        Line::new("IV: R = 1, with spin", Mark::Dashed, column(&rows, 4)),
        Line::new("points A and B of the paper", Mark::Points, vec![(90.0, 0.0), (90.0, 0.043)]),
    ];
    let y = Axis::linear("impulse ratio", "µ₀", "1").between(-0.05, 0.8);
    Ok(figure(
        "Figure 2: impulse ratio that ends sliding",
        plot::chart(&angle_axis(), &y, &lines)?,
        "figure-2",
        "Figure 2: spheres that leave rolling have an impulse ratio between the curves of R = 0 and R = 1. The paper draws \
         it without scales or values; ours has the sphere, speed (2.8 m/s) and spin of Table 1. Its text places point A, \
         normal incidence without spin, at zero, and point B, the impact of Table 1, at 0.043.",
        ["angle of incidence, degrees", "I", "II", "III", "IV"],
        rows,
    ))
}

fn figure_4() -> Outcome<Part> {
    let sphere = Sphere::solid(STEEL_RADIUS, STEEL)?;
    let row = |angle| {
        let ratio = |peripheral| rolling_ratio(sphere, STEEL_RESTITUTION, STEEL_SPEED, angle, peripheral);
        Ok([angle, ratio(PERIPHERAL)?, ratio(0.0)?, ratio(-PERIPHERAL)?])
    };
    let rows = angles().map(row).collect::<Result<Vec<_>, InputError>>()?;
    let lines = [
        Line::new("r ω = 1.51 m/s", Mark::Solid, column(&rows, 1)),
        Line::new("no spin", Mark::Dashed, column(&rows, 2)),
        Line::new("r ω = -1.51 m/s", Mark::Solid, column(&rows, 3)),
        Line::new("the paper's range at 90°", Mark::Points, vec![(90.0, 0.12), (90.0, -0.12)]),
    ];
    let y = Axis::linear("impulse ratio", "µ", "1").between(-0.4, 0.8);
    Ok(figure(
        "Figure 4: bounds of the impulse ratio",
        plot::chart(&angle_axis(), &y, &lines)?,
        "figure-4",
        "Figure 4: bounds of constant spin for stainless-steel spheres with e = 0.601, drawn for a total speed of 2.3 m/s, \
         the paper's mean at normal incidence. Points: the range that its text gives there, 0.12 to both sides; its \
         measured points are not given as numbers.",
        ["angle of incidence, degrees", "mu, r w = 1.51 m/s", "mu, no spin", "mu, r w = -1.51 m/s"],
        rows,
    ))
}

fn figure_a2() -> Outcome<Part> {
    let scene = RigidBody::new(glass(RADIUS)?, SpeedRestitution::new(LAW_SPEED)?).with_work_of_adhesion(WORK)?;
    let row = |speed| {
        let normal = scene.impact(&NormalMotion::new(speed)?).normal;
        let e = normal.overall_restitution();
        Ok([speed, e * e, normal.restitution().powi(2), normal.adhesion_loss()])
    };
    let rows = spaced(0.5, 100.0, 241).map(row).collect::<Result<Vec<_>, InputError>>()?;
    let lines = [
        Line::new("e²", Mark::Solid, column(&rows, 1)),
        Line::new("R²", Mark::Dashed, column(&rows, 2)),
        Line::new("lost to adhesion", Mark::Dashed, column(&rows, 3)),
    ];
    let x = Axis::logarithmic("approach speed", "v", "m/s");
    let y = Axis::linear("fraction of the energy", "T/T_i", "1").between(0.0, 1.05);
    Ok(figure(
        "Figure A2: energy restitution",
        plot::chart(&x, &y, &lines)?,
        "figure-a2",
        "Figure A2: e² = R² - B (A34). The paper draws it without scales or values; ours has R = k/(k + v), k = 130 m/s, and \
         W_A = 2.22e-12 J on the sphere of Table 1. A captured sphere loses to adhesion all the energy that remains after the loss in the materials.",
        ["approach speed, m/s", "e^2", "R^2", "fraction lost to adhesion"],
        rows,
    ))
}
