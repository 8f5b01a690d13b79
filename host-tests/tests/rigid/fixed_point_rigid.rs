//! The rigid-body model in fixed point: its error against double precision over all of its range, and its refusals.

use std::fmt::Debug;

use microimpact::rigid::ReboundAdhesion;
use microimpact::{
    Approach, ConstantRestitution, Fault, FixedPoint, InFixedPoint, InputError, NormalMotion, Oblique, Parameter,
    PlanarMotion, RestitutionLaw, RigidBody, SpeedRestitution, Sphere, SurfaceMotion,
};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::repetitions;

/// Speed, in its unit, below which a rebound may count as a capture.
const SLOWEST_REBOUND: f64 = 1e-6;

/// The largest errors met so far, velocities in units of speed.
#[derive(Default, Debug)]
struct Errors {
    rebound: f64,
    /// Of the square of the rebound speed, over the approach speed.
    energy: f64,
    /// Of velocities along the surface.
    along: f64,
    /// Relative, of critical speeds from 0.1 to 8 where R exceeds 0.1.
    speed_margin: f64,
    /// Over one more than the margin, where the slip exceeds 0.1.
    friction_margin: f64,
    /// Impacts so close to a boundary that they were not compared.
    close: u32,
    compared: u32,
}

/// A value between two bounds, and a bound itself every eighth time.
fn draw(random: &mut StdRng, low: f64, high: f64) -> f64 {
    match random.random_range(0..16) {
        0 => low,
        1 => high,
        _ => random.random_range(low..high),
    }
}

fn draw_motion(random: &mut StdRng, unit: f64) -> PlanarMotion<f64> {
    let speed = (draw(random, 0.0041_f64.ln(), 7.99_f64.ln())).exp();
    let (along, around) = (draw(random, -7.99, 7.99), draw(random, -7.99, 7.99));
    let oblique = NormalMotion::new(unit * speed).unwrap().with_tangential(unit * along).unwrap();
    oblique.with_peripheral_velocity(unit * around).unwrap()
}

/// Compares an impact with friction, and the same without.
fn compare<L, A>(random: &mut StdRng, scene: RigidBody<f64, L, A>, unit: f64, errors: &mut Errors)
where
    L: RestitutionLaw<f64> + InFixedPoint<f64, Fixed: RestitutionLaw<FixedPoint>> + Copy + Debug,
    A: ReboundAdhesion<f64> + InFixedPoint<f64, Fixed: ReboundAdhesion<FixedPoint>> + Copy + Debug,
{
    let motion = draw_motion(random, unit);
    let friction = if random.random() { draw(random, 0.0, 1.0) } else { draw(random, 0.0, 7.0) };
    let planar = scene.with_friction(friction).unwrap();
    let (fixed, fixed_motion) = (planar.in_fixed_point(unit).unwrap(), motion.in_fixed_point(unit).unwrap());
    let (wide, narrow) = (planar.impact(&motion), fixed.impact(&fixed_motion));
    let (class, fixed_class) = (planar.classify(&motion), fixed.classify(&fixed_motion));
    let approach = motion.normal().speed() / unit;

    let (rebound, fixed_rebound) = (wide.normal.rebound_speed() / unit, narrow.normal.rebound_speed().to_f64());
    errors.rebound = errors.rebound.max((fixed_rebound - rebound).abs());
    errors.energy = errors.energy.max((fixed_rebound.powi(2) - rebound.powi(2)).abs() / approach);
    if let (Some(margin), Some(fixed_margin)) = (class.speed_over_critical, fixed_class.speed_over_critical) {
        let critical = approach / margin;
        let restitution = |speed: f64| scene.impact(&NormalMotion::new(unit * speed).unwrap()).normal.restitution();
        if (0.1..8.0).contains(&critical) && restitution(critical) > 0.1 {
            errors.speed_margin = errors.speed_margin.max((fixed_margin.to_f64() / margin - 1.0).abs());
        }
    }
    let normal_scene = scene.in_fixed_point(unit).unwrap();
    let normal = normal_scene.classify(&fixed_motion.normal());
    assert_eq!(normal.outcome, fixed_class.outcome);
    assert_eq!(normal.speed_over_critical, fixed_class.speed_over_critical);

    let critical_is_close = class.speed_over_critical.is_some_and(|margin| {
        let critical = approach / margin;
        (approach - critical).abs() < 1e-5 * (1.0 + approach)
    });
    if let (Some(margin), Some(fixed_margin)) =
        (class.contact.friction_over_limit, fixed_class.contact.friction_over_limit)
    {
        let slip = (motion.slip() / unit).abs();
        if slip > 0.1 && margin < 100.0 {
            let error = (fixed_margin.to_f64() - margin).abs() / (1.0 + margin);
            errors.friction_margin = errors.friction_margin.max(error);
        }
    }
    let limit_is_close = class.contact.friction_over_limit.is_some_and(|margin| (margin - 1.0).abs() < 1e-4);
    let hardly_rebounds = rebound > 0.0 && rebound < SLOWEST_REBOUND;
    if critical_is_close || limit_is_close || hardly_rebounds {
        errors.close += 1;
        return;
    }
    errors.compared += 1;
    assert_eq!(fixed_class.outcome, class.outcome, "{planar:?} {motion:?}");
    let slides = |motion| motion == SurfaceMotion::Sliding;
    assert_eq!(slides(fixed_class.contact.motion), slides(class.contact.motion), "{planar:?} {motion:?}");
    for (wide, narrow) in [
        (wide.tangential.velocity(), narrow.tangential.velocity()),
        (wide.tangential.peripheral(), narrow.tangential.peripheral()),
    ] {
        errors.along = errors.along.max((narrow.to_f64() - wide / unit).abs());
    }
}

#[test]
fn random_scenes_agree_with_double_precision() {
    let (mut random, mut errors) = (StdRng::seed_from_u64(8), Errors::default());
    let scenes = repetitions(200_000, 20_000);
    for _ in 0..scenes {
        let unit = 10f64.powf(random.random_range(-3.0..4.0));
        let sphere =
            Sphere::new(10f64.powf(random.random_range(-9.0..-4.0)), 1000.0, draw(&mut random, 0.2, 1.0)).unwrap();
        let speed = unit * draw(&mut random, 0.0101_f64.ln(), 99.0_f64.ln()).exp();
        let held = unit * draw(&mut random, 0.0, 7.99);
        let work = 0.5 * sphere.mass() * held * held;
        let adhesion = draw(&mut random, 0.0, 1.0);
        let constant = RigidBody::new(sphere, ConstantRestitution::new(draw(&mut random, 0.0, 1.0)).unwrap());
        let falling = RigidBody::new(sphere, SpeedRestitution::new(speed).unwrap());
        let (random, errors) = (&mut random, &mut errors);
        compare(random, constant, unit, errors);
        compare(random, falling, unit, errors);
        compare(random, constant.with_adhesion_coefficient(adhesion).unwrap(), unit, errors);
        compare(random, falling.with_adhesion_coefficient(adhesion).unwrap(), unit, errors);
        compare(random, constant.with_work_of_adhesion(work).unwrap(), unit, errors);
        compare(random, falling.with_work_of_adhesion(work).unwrap(), unit, errors);
    }
    assert!(errors.rebound < 1e-5 && errors.energy < 1e-6 && errors.along < 1e-5, "{errors:?}");
    assert!(errors.speed_margin < 1e-4 && errors.friction_margin < 1e-5, "{errors:?}");
    assert!(errors.close < scenes / 200 && errors.compared > 5 * scenes, "{errors:?}");
}

#[test]
fn what_does_not_fit_is_refused() {
    fn kind<T>(result: Result<T, InputError>) -> Result<(), (Parameter, Fault)> {
        result.map(drop).map_err(|error| (error.parameter, error.fault))
    }
    let refused = |parameter, fault| Err((parameter, fault));
    let sphere = Sphere::solid(1e-6, 1000.0).unwrap();
    let scene = RigidBody::new(sphere, SpeedRestitution::new(50.0).unwrap());
    let motion = NormalMotion::new(1.0).unwrap();
    for (unit, fault) in [(f64::NAN, Fault::NotFinite), (0.0, Fault::TooSmall), (1e7, Fault::TooLarge)] {
        assert_eq!(kind(motion.in_fixed_point(unit)), refused(Parameter::SpeedUnit, fault));
        assert_eq!(kind(scene.in_fixed_point(unit)), refused(Parameter::SpeedUnit, fault));
    }
    // Speeds that a unit makes too large or too small.
    assert_eq!(kind(motion.in_fixed_point(0.1)), refused(Parameter::SpeedInUnits, Fault::TooLarge));
    assert_eq!(kind(motion.in_fixed_point(300.0)), refused(Parameter::SpeedInUnits, Fault::TooSmall));
    assert!(motion.in_fixed_point(0.125).is_ok() && motion.in_fixed_point(250.0).is_ok());
    assert_eq!(kind(scene.in_fixed_point(0.1)), refused(Parameter::RestitutionSpeedInUnits, Fault::TooLarge));
    assert_eq!(kind(scene.in_fixed_point(1e4)), refused(Parameter::RestitutionSpeedInUnits, Fault::TooSmall));
    let oblique = |velocity| motion.with_tangential(velocity).unwrap();
    assert_eq!(kind(oblique(8.1).in_fixed_point(1.0)), refused(Parameter::VelocityInUnits, Fault::TooLarge));
    assert_eq!(kind(oblique(-8.1).in_fixed_point(1.0)), refused(Parameter::VelocityInUnits, Fault::TooSmall));
    let spinning = oblique(0.0).with_peripheral_velocity(-8.1).unwrap();
    assert_eq!(kind(spinning.in_fixed_point(1.0)), refused(Parameter::VelocityInUnits, Fault::TooSmall));
    // A work that takes a rebound of nine units.
    let work = 0.5 * sphere.mass() * 81.0;
    let held = scene.with_work_of_adhesion(work).unwrap();
    assert_eq!(kind(held.in_fixed_point(1.0)), refused(Parameter::VelocityInUnits, Fault::TooLarge));
    let rough = scene.with_friction(7.1).unwrap();
    assert_eq!(kind(rough.in_fixed_point(1.0)), refused(Parameter::FixedPointFriction, Fault::TooLarge));
}
