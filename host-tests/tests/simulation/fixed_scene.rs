//! Scenes in fixed point, friction and spin included: their error over random scenes, and their refusals.

use core::f64::consts::PI;

use microimpact::contact::{
    Adaptive, Attraction, Contact, Damping, Energy, FixedCost, HertzLaw, Impulses, Slip, Status, TangentialVelocities,
    Times,
};
use microimpact::{
    Coulomb, Fault, FixedPoint, FixedPointTerm, InFixedPoint, NormalMotion, Oblique, Outcome, Parameter, PlanarMotion,
    Real, Sphere, Stiffness,
};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::repetitions;

/// What fixed point adds to the error of velocities, over the unit of speed, and of a friction margin m, over 1 + m.
const MOST_VELOCITY_ERROR: f64 = 3e-5;
const MOST_MARGIN_ERROR: f64 = 1e-4;

/// Slip, over the unit of speed, from which that of the margin holds.
const LEAST_SLIP: f64 = 0.1;

/// How random scenes went.
#[derive(Debug, Default)]
struct Record {
    refused: u32,
    unknown: u32,
    captured: u32,
    rebounded: u32,
    /// Largest error of e^2 over its bound.
    largest: f64,
}

fn power_of_ten(random: &mut StdRng, from: f64, to: f64) -> f64 {
    10f64.powf(random.random_range(from..to))
}

/// Solves an impact of velocities over the unit of speed in fixed point, and compares with double precision.
fn judge<D, A>(
    scene: &Contact<f64, HertzLaw<f64, D, A>, Coulomb<f64>>,
    unit: f64,
    velocities: [FixedPoint; 3],
    record: &mut Record,
) where
    D: Damping<f64> + FixedPointTerm<f64, Fixed: Damping<FixedPoint>>,
    A: Attraction<f64> + FixedPointTerm<f64, Fixed: Attraction<FixedPoint>>,
{
    let [v, t, u] = velocities.map(|velocity| velocity.to_f64() * unit);
    let what = || format!("{:?} {unit} {v} {t} {u}", scene.sphere());
    let motion = PlanarMotion::in_units(velocities).unwrap();
    let method = FixedCost::<7>::new(4).unwrap().with_outputs::<9>();
    let Ok(narrow) = scene.in_fixed_point(unit).and_then(|scene| scene.solve(&motion, &method)) else {
        record.refused += 1;
        return;
    };
    let wide = NormalMotion::new(v).unwrap().with_tangential(t).unwrap().with_peripheral_velocity(u).unwrap();
    let exact = scene.solve(&wide, &Adaptive::new(1e-10).unwrap()).unwrap();
    let bound = narrow.run.error_bound.to_f64();
    let [e, e_exact] = [narrow.normal.overall_restitution().to_f64(), exact.normal.overall_restitution()];
    match narrow.normal.outcome() {
        None => {
            record.unknown += 1;
            return;
        }
        Some(Outcome::Undecided) => {
            assert!(e_exact * e_exact <= 2.0 * bound, "{}", what());
            record.unknown += 1;
            return;
        }
        outcome => assert_eq!(outcome, exact.normal.outcome(), "{}", what()),
    }
    let ratio = (e * e - e_exact * e_exact).abs() / bound;
    assert!(ratio <= 1.0, "{}: {e} {e_exact} {bound}", what());
    record.largest = record.largest.max(ratio);
    if narrow.normal.outcome() == Some(Outcome::Capture) {
        record.captured += 1;
    } else {
        record.rebounded += 1;
        let exact = scene.solve(&wide, &method).unwrap();
        judge_velocities(&narrow.tangential, &exact.tangential, scene.sphere(), unit, wide.tangential() - u, what);
    }
}

fn judge_velocities(
    narrow: &TangentialVelocities<FixedPoint>,
    exact: &TangentialVelocities<f64>,
    sphere: &Sphere<f64>,
    unit: f64,
    slip: f64,
    what: impl Fn() -> String,
) {
    let near = |narrow: FixedPoint, exact: f64| (narrow.to_f64() - exact).abs() <= MOST_VELOCITY_ERROR;
    assert!(near(narrow.velocity(), exact.velocity() / unit), "{}: {narrow:?} {exact:?}", what());
    assert!(near(narrow.spin(), exact.spin() * sphere.radius() / unit), "{}: {narrow:?} {exact:?}", what());
    if let (Some(margin), Some(exact_margin)) = (narrow.friction_over_limit(), exact.friction_over_limit()) {
        let error = (margin.to_f64() - exact_margin).abs();
        if slip.abs() >= LEAST_SLIP * unit && exact_margin < 100.0 {
            assert!(error <= MOST_MARGIN_ERROR * (1.0 + exact_margin), "{}: {margin:?} {exact_margin}", what());
            // How it moves is in question only at the limit itself.
            assert!(narrow.motion() == exact.motion() || error >= (exact_margin - 1.0).abs(), "{}", what());
        }
    }
}

/// Outcomes are right, e^2 within its bound, and velocities and margins within what is documented: with a ring and hysteretic damping,
/// with DMT's adhesion and viscoelastic damping, and with elasticity alone.
#[test]
fn random_scenes_agree_with_double_precision() {
    let (mut random, mut records) = (StdRng::seed_from_u64(31), <[Record; 3]>::default());
    let scenes = repetitions(200_000, 2_000);
    for _ in 0..scenes {
        let mut decade = |from, to| power_of_ten(&mut random, from, to);
        let (unit, density) = (decade(0.0, 1.0), decade(3.0, 4.0));
        let (radius, stiffness) = (decade(-6.0, -4.0), decade(9.0, 11.0));
        // (m U^2/(r^3 K))^(2/5), in which damping and adhesion are about one.
        let scale = (4.0 * PI / 3.0 * density * unit * unit / stiffness).powf(0.4);
        let (material, of_adhesion, adhesion) = (decade(-3.0, -0.4), decade(-3.0, -0.4), decade(-3.0, 0.1));
        let (friction, speed) = (decade(-2.0, 0.5), decade(-1.1, 0.9));
        let sphere = Sphere::new(radius, density, random.random_range(0.2..0.67)).unwrap();
        let mut along = || {
            let velocity: f64 = random.random_range(-8.0..8.0);
            // Some are much faster than the approach, and some about as fast.
            if random.random_bool(0.5) { velocity * speed / 8.0 } else { velocity }
        };
        let velocities = [speed, along(), along()].map(FixedPoint::nearest);
        let elastic = Contact::hertz(sphere, Stiffness::new(stiffness).unwrap()).with_friction(friction).unwrap();
        let ring = elastic.with_damping(material / scale).unwrap();
        let ring = ring.with_ring(adhesion * stiffness * radius * scale, of_adhesion / scale).unwrap();
        let dmt = elastic.with_viscoelastic_damping(material * radius * scale / unit).unwrap();
        let dmt = dmt.with_dmt(adhesion * stiffness * radius * scale * scale).unwrap();
        judge(&ring, unit, velocities, &mut records[0]);
        judge(&dmt, unit, velocities, &mut records[1]);
        judge(&elastic, unit, velocities, &mut records[2]);
    }
    println!("{records:?} of {scenes}");
    for record in &records {
        assert!(record.rebounded > scenes / 4, "{record:?}");
    }
    assert!(records[..2].iter().all(|record| record.captured > scenes / 50), "{records:?}");
}

/// What fixed point does not hold is refused, with its value: of the scene at the unit of speed, of an impact at its own.
#[test]
fn what_does_not_fit_is_refused() {
    let sphere = Sphere::solid(2e-6, 1050.0).unwrap();
    let elastic = Contact::hertz(sphere, Stiffness::new(5e9).unwrap());
    let refused = |ring: f64, zeta: f64, unit: f64| {
        let scene = elastic.with_ring(ring, 0.0).unwrap().with_damping(zeta).unwrap();
        scene.in_fixed_point(unit).map(drop).unwrap_err()
    };
    let error = refused(1e4, 0.0, 1.0);
    assert_eq!((error.parameter, error.fault), (Parameter::DimensionlessAdhesion, Fault::TooLarge));
    assert_eq!(refused(0.0, 1e3, 1.0).parameter, Parameter::DimensionlessDamping);
    assert_eq!(refused(0.0, 0.0, 0.0).parameter, Parameter::SpeedUnit);
    let nearly_a_point = Sphere::new(2e-6, 1050.0, 0.19).unwrap();
    let scene = Contact::hertz(nearly_a_point, Stiffness::new(5e9).unwrap());
    assert_eq!(scene.in_fixed_point(1.0).unwrap_err().parameter, Parameter::FixedPointGyration);
    let rough = elastic.in_fixed_point(1.0).unwrap().with_friction(FixedPoint::nearest(8.0));
    assert_eq!(rough.unwrap_err().parameter, Parameter::FixedPointFriction);

    let method = FixedCost::<5>::new(3).unwrap().with_outputs::<7>();
    let solve = |ring: f64, velocities: [f64; 3]| {
        let scene = elastic.with_ring(ring, 0.0)?.with_friction(0.1)?.in_fixed_point(2.0)?;
        let motion = PlanarMotion::in_units(velocities.map(FixedPoint::nearest))?;
        scene.solve(&motion, &method).map(drop)
    };
    assert_eq!(solve(0.02, [1.0, 0.0, 0.0]), Ok(()));
    let parameter = |ring, velocities| solve(ring, velocities).unwrap_err().parameter;
    assert_eq!(parameter(0.02, [0.11, 7.5, 0.0]), Parameter::VelocityRatio);
    assert_eq!(parameter(0.02, [0.11, 0.0, -7.5]), Parameter::VelocityRatio);
    assert_eq!(parameter(30.0, [0.11, 0.0, 0.0]), Parameter::DimensionlessAdhesion);
    assert_eq!(parameter(0.02, [0.09, 0.0, 0.0]), Parameter::ContactSpeedInUnits);
    assert_eq!(parameter(0.02, [9.0, 0.0, 0.0]), Parameter::SpeedInUnits);
}

/// The way along the surface may be too long for fixed point, and is not computed; times and impulses are those of f64.
#[test]
fn outputs_are_right_or_refused() {
    let sphere = Sphere::<f64>::solid(5.06e-6, 2600.0).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap()).with_damping(10.5).unwrap();
    let scene = scene.with_ring(250.0, 6.25).unwrap().with_friction(0.1).unwrap();
    let motion = NormalMotion::new(2.8).unwrap().with_tangential(0.0).unwrap().with_spin(&sphere, 1.454e5).unwrap();
    let (unit, method) = (4.0_f64, FixedCost::<5>::new(4).unwrap().with_outputs::<9>());
    let (fixed, narrow) = (scene.in_fixed_point(unit).unwrap(), motion.in_fixed_point(unit).unwrap());
    let (impact, _) = fixed.solve_for(&narrow, &method, Slip).unwrap();
    assert_eq!((impact.run.status, impact.class()), (Status::Unsupported, None));
    let (impact, _) = fixed.solve_for(&narrow, &method, Energy).unwrap();
    assert_eq!((impact.run.status, impact.class()), (Status::Unsupported, None));

    let (impact, (times, impulses)) = fixed.solve_for(&narrow, &method, (Times, Impulses)).unwrap();
    let (exact, (exact_times, exact_impulses)) = scene.solve_for(&motion, &method, (Times, Impulses)).unwrap();
    let mass = sphere.mass();
    let length = sphere.radius() * (mass * unit * unit / (sphere.radius().powi(3) * 7.5e10)).powf(0.4);
    let near = |narrow: FixedPoint, exact: f64| assert!((narrow.to_f64() - exact).abs() < 1e-4, "{narrow:?} {exact}");
    near(times.contact.unwrap(), exact_times.contact.unwrap() * unit / length);
    near(times.peak.unwrap(), exact_times.peak.unwrap() * unit / length);
    near(impulses.elastic, exact_impulses.elastic / (mass * unit));
    near(impact.normal.peak_indentation().unwrap(), exact.normal.peak_indentation().unwrap() / length);
    near(impact.normal.rebound_speed(), exact.normal.rebound_speed() / unit);
}

/// Tolerances are of the size of its units.
#[test]
fn methods_with_a_tolerance_say_what_to_use() {
    for tolerance in [1e-2, 1e-4] {
        let error = Adaptive::new(FixedPoint::constant(tolerance)).unwrap_err();
        assert_eq!((error.parameter, error.fault), (Parameter::Tolerance, Fault::BelowPrecision));
        assert!(error.to_string().ends_with("in fixed point use `FixedCost`"), "{error}");
    }
}
