//! Numbers and scenes from arbitrary bytes. Most numbers are in the range of their parameter, so that scenes are solved; the
//! others lie at its ends, are zero, or are any 64 bits, so that refusals are tested too.

use std::f64::consts::PI;

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use microimpact::contact::Contact;
use microimpact::{Hertz, InputError, NormalMotion, Parameter, Sphere, Stiffness};
use truth::Scene;

/// The first byte of a number, if it is not one in a range: any 64 bits, special numbers, zero, and the ends of the range.
const BITS: u8 = 255;
const SPECIAL: u8 = 254;
const ZERO: u8 = 253;
const END: u8 = 252;

/// A number from its first byte and what follows: evenly distributed over the decades of a range of positive numbers, unless
/// the first byte says otherwise.
///
/// # Errors
/// None that bytes can cause.
pub fn size(bytes: &mut Unstructured<'_>, (low, high): (f64, f64)) -> Result<f64> {
    let special = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, -low];
    Ok(match bytes.arbitrary::<u8>()? {
        BITS => f64::from_bits(bytes.arbitrary()?),
        SPECIAL => *bytes.choose(&special)?,
        ZERO => 0.0,
        END => *bytes.choose(&[low, high, low.next_down(), low.next_up(), high.next_down(), high.next_up()])?,
        _ => {
            // Bytes that have run out are zeros, which mean the middle.
            let fraction = f64::from(bytes.arbitrary::<u32>()? ^ (1 << 31)) / f64::from(u32::MAX);
            (low * (high / low).powf(fraction)).clamp(low, high)
        }
    })
}

/// A number as by [`size`], with a sign.
///
/// # Errors
/// None that bytes can cause.
pub fn signed(bytes: &mut Unstructured<'_>, range: (f64, f64)) -> Result<f64> {
    Ok(if bytes.arbitrary()? { -size(bytes, range)? } else { size(bytes, range)? })
}

/// A scene: in SI units over all of their ranges or, more often, in ratios that make its terms matter.
///
/// # Errors
/// None that bytes can cause.
pub fn scene(bytes: &mut Unstructured<'_>) -> Result<Scene> {
    let kind = bytes.arbitrary::<u8>()?;
    let wide = wide(bytes)?;
    Ok(if kind & 3 == 0 { wide } else { in_ratios(&wide, bytes)?.unwrap_or(wide) })
}

fn wide(bytes: &mut Unstructured<'_>) -> Result<Scene> {
    Ok(Scene {
        radius: size(bytes, Parameter::Radius.range())?,
        density: size(bytes, Parameter::Density.range())?,
        gyration_ratio: size(bytes, Parameter::GyrationRatio.range())?,
        stiffness: size(bytes, Parameter::Stiffness.range())?,
        adhesion: size(bytes, (1e-12, Parameter::AdhesionStrength.range().1))?,
        material_damping: size(bytes, (1e-9, Parameter::MaterialDamping.range().1))?,
        adhesion_damping: size(bytes, (1e-9, Parameter::AdhesionDamping.range().1))?,
        friction: size(bytes, (1e-6, Parameter::Friction.range().1))?,
        peeling: size(bytes, (1e-30, Parameter::PeelingMoment.range().1))?,
        force: signed(bytes, (1e-18, Parameter::ExternalForce.range().1))?,
        speed: size(bytes, Parameter::ApproachSpeed.range())?,
        tangential: signed(bytes, (1e-9, Parameter::TangentialVelocity.range().1))?,
        spin: signed(bytes, (1e-3, Parameter::Spin.range().1))?,
    })
}

/// The sphere and the speed of a scene, with adhesion, damping, force and moment in proportion to them; `None` where one of
/// the four numbers of Hertz's impact is refused.
fn in_ratios(scene: &Scene, bytes: &mut Unstructured<'_>) -> Result<Option<Scene>> {
    let Ok((hertz, damping)) = unit(scene) else {
        return Ok(None);
    };
    let (h, g) = (size(bytes, (1e-4, 1e2))?, size(bytes, (1e-4, 1e2))?);
    let inertia = scene.gyration_ratio * 4.0 / 3.0 * PI * scene.density * scene.radius.powi(5);
    let decay = g * hertz.indentation * hertz.contact_radius / inertia / (scene.speed * scene.speed);
    Ok(Some(Scene {
        adhesion: size(bytes, (1e-3, 10.0))? * hertz.indentation * scene.stiffness / (2.0 * PI),
        material_damping: h / damping,
        adhesion_damping: g / damping,
        friction: size(bytes, (1e-2, 2.0))?,
        peeling: size(bytes, (1e-3, 1e2))? / decay,
        force: signed(bytes, (1e-4, 2.0))? * hertz.force,
        tangential: signed(bytes, (1e-2, 1e1))? * scene.speed,
        spin: signed(bytes, (1e-2, 1e1))? * scene.speed / scene.radius,
        ..*scene
    }))
}

/// Hertz's impact of the sphere, and the damping by a strength of one.
fn unit(scene: &Scene) -> std::result::Result<(Hertz<f64>, f64), InputError> {
    let sphere = Sphere::new(scene.radius, scene.density, scene.gyration_ratio)?;
    let (stiffness, motion) = (Stiffness::new(scene.stiffness)?, NormalMotion::new(scene.speed)?);
    let damping = Contact::hertz(sphere, stiffness).with_damping(1.0)?.groups(&motion)?.material_damping;
    Ok((Hertz::new(&sphere, stiffness, &motion), damping))
}
