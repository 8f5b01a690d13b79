//! Front ends of sensors against drawn signals: what they state is right within their standard errors, as often as it should be.

use microimpact::contact::{Contact, FixedCost};
use microimpact::instrument::sensor::{
    ChargePulse, Clock, Doppler, DopplerBurst, ImageCharge, ImpulseSensor, PulseSum, SizedImpact, Transit,
    radius_from_impulse,
};
use microimpact::instrument::{Rejection, Simulated};
use microimpact::measure::Estimate;
use microimpact::table::BoundaryTable;
use microimpact::{
    ConstantRestitution, CriticalSpeed, InputError, NormalMotion, Parameter, RigidBody, SpeedRestitution, Sphere,
    Stiffness,
};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

const DRAWS: usize = 4000;

fn exact(value: f64) -> Estimate<f64> {
    Estimate { value, standard_error: 0.0 }
}

/// A value with a normally distributed error.
fn drawn(random: &mut StdRng, truth: f64, standard_error: f64) -> Estimate<f64> {
    let deviation: f64 = StandardNormal.sample(random);
    Estimate { value: truth + standard_error * deviation, standard_error }
}

/// The errors of many draws, divided by the stated errors, have mean zero and standard deviation one.
fn assert_as_stated(name: &str, seed: u64, draw: impl Fn(&mut StdRng) -> (Estimate<f64>, f64)) {
    let deviation = deviation(name, seed, draw);
    assert!((deviation - 1.0).abs() < 0.05, "{name}: {deviation}");
}

/// Standard deviation of the errors of many draws, divided by the stated errors. Their mean is zero.
fn deviation(name: &str, seed: u64, draw: impl Fn(&mut StdRng) -> (Estimate<f64>, f64)) -> f64 {
    let random = &mut StdRng::seed_from_u64(seed);
    let pulls: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let (estimate, truth) = draw(random);
            (estimate.value - truth) / estimate.standard_error
        })
        .collect();
    let mean = pulls.iter().sum::<f64>() / DRAWS as f64;
    assert!(mean.abs() < 0.08, "{name}: {mean}");
    (pulls.iter().map(|pull| (pull - mean).powi(2)).sum::<f64>() / DRAWS as f64).sqrt()
}

/// Ticks of a clock between two edges with errors (in ticks), from a counter of 32 bits that starts anywhere.
fn ticks(random: &mut StdRng, seconds: f64, frequency: f64, edge_error: f64) -> u32 {
    let phase: f64 = random.random();
    let start = random.random::<u32>();
    let mut edge = |time: f64| {
        let error: f64 = StandardNormal.sample(random);
        start.wrapping_add((time + edge_error * error + 1e3).floor() as u32)
    };
    let first = edge(phase);
    edge(phase + seconds * frequency).wrapping_sub(first)
}

#[test]
fn times_and_speeds_have_the_stated_errors() {
    for (index, (count, edge_error, frequency_error, length_error)) in
        [(60.3, 0.0, 0.0, 0.0), (400.0, 3.0, 0.0, 0.0), (5e4, 10.0, 1e-3, 0.0), (7e3, 20.0, 1e-4, 0.01)]
            .into_iter()
            .enumerate()
    {
        let seed = index as u64;
        let (frequency, length) = (72e6, 280e-6);
        let seconds = |random: &mut StdRng| (count + random.random::<f64>()) / frequency;
        let clock = |random: &mut StdRng| {
            Clock::new(&drawn(random, frequency, frequency_error * frequency), edge_error).unwrap()
        };
        assert_as_stated("clock", seed, |random| {
            let (seconds, clock) = (seconds(random), clock(random));
            (clock.time(ticks(random, seconds, frequency, edge_error)).unwrap(), seconds)
        });
        assert_as_stated("transit", seed, |random| {
            let (seconds, clock) = (seconds(random), clock(random));
            let beams = Transit::new(&drawn(random, length, length_error * length), clock).unwrap();
            (beams.speed(ticks(random, seconds, frequency, edge_error)).unwrap(), length / seconds)
        });
        for shift in [0.0, 40e6] {
            assert_as_stated("doppler", seed, |random| {
                let (velocity, clock) = (random.random_range(2.0..3.0), clock(random));
                let spacing = drawn(random, 3e-6, length_error * 3e-6);
                let doppler_frequency = velocity / 3e-6 + shift;
                let periods = (seconds(random) * doppler_frequency).ceil();
                let ticks = ticks(random, periods / doppler_frequency, frequency, edge_error);
                // The shift is a multiple of the frequency of the clock, and has its relative error.
                let doppler = Doppler::new(&spacing, shift, clock).unwrap();
                (doppler.velocity(&DopplerBurst { periods: periods as u32, ticks }).unwrap(), velocity)
            });
        }
    }
}

#[test]
fn charge_speed_and_size_have_the_stated_errors() {
    let (frequency, length, sensitivity, voltage, density) = (10e6, 0.05, 1.6e-17, 20e3, 2600.0);
    for noise in [0.0, 4.0] {
        let particle = |random: &mut StdRng| {
            let speed = random.random_range(100.0..200.0);
            // Spread over one count, so that rounding is seen.
            let charge = -sensitivity * random.random_range(200.0..201.0);
            let clock = Clock::new(&exact(frequency), 5.0).unwrap();
            let tube = ImageCharge::new(
                &drawn(random, length, 2e-4),
                &drawn(random, sensitivity, 0.01 * sensitivity * f64::from(noise > 0.0)),
                noise,
                clock,
            );
            let deviation: f64 = StandardNormal.sample(random);
            let height = (charge / sensitivity + noise * deviation).round() as i32;
            let width = ticks(random, length / speed, frequency, 5.0);
            (tube.unwrap().particle(&ChargePulse { height, width }).unwrap(), charge, speed)
        };
        assert_as_stated("charge", 10, |random| {
            let (found, charge, _) = particle(random);
            (found.charge, charge)
        });
        assert_as_stated("speed", 11, |random| {
            let (found, _, speed) = particle(random);
            (found.speed, speed)
        });
        assert_as_stated("size", 12, |random| {
            let (found, charge, speed) = particle(random);
            let mass = 2.0 * charge.abs() * voltage / (speed * speed);
            let radius = (mass * 3.0 / (4.0 * std::f64::consts::PI * density)).cbrt();
            let (voltage, density) = (drawn(random, voltage, 200.0), drawn(random, density, 50.0));
            (found.radius(&voltage, &density).unwrap(), radius)
        });
    }
}

#[test]
fn impulses_have_the_stated_errors() {
    for (noise, baseline_error) in [(0.0, 0.0), (3.0, 0.0), (3.0, 0.4)] {
        assert_as_stated("impulse", 20, |random| {
            let sensitivity = drawn(random, 1e-14, 1e-16);
            let sensor = ImpulseSensor::new(&sensitivity, noise, baseline_error).unwrap();
            let baseline = drawn(random, 2048.0, baseline_error).value - 2048.0;
            let (mut pulse, mut truth) = (PulseSum::new(2048), 0.0);
            let height = random.random_range(500.0..1500.0);
            for sample in 0..200 {
                let force = height * (std::f64::consts::PI * f64::from(sample) / 200.0).sin();
                truth += force;
                let deviation: f64 = StandardNormal.sample(random);
                pulse.add((2048.0 + baseline + force + noise * deviation).round() as i32);
            }
            (sensor.impulse(&pulse).unwrap(), truth * 1e-14)
        });
    }
}

const DENSITY: f64 = 2600.0;

/// Work of adhesion in proportion to the radius: small particles are captured.
fn body(
    radius: f64,
) -> Result<RigidBody<f64, SpeedRestitution<f64>, microimpact::rigid::WorkOfAdhesion<f64>>, InputError> {
    RigidBody::new(Sphere::solid(radius, DENSITY)?, SpeedRestitution::new(130.0)?)
        .with_work_of_adhesion(4.4e-7 * radius)
}

fn impulse(radius: f64, speed: f64) -> f64 {
    let e = body(radius).unwrap().impact(&NormalMotion::new(speed).unwrap()).normal.overall_restitution();
    Sphere::solid(radius, DENSITY).unwrap().mass() * (1.0 + e) * speed
}

fn sized(impulse: f64, speed: f64) -> Result<SizedImpact<f64>, Rejection> {
    radius_from_impulse(&exact(impulse), &exact(speed), &exact(DENSITY), body)
}

/// Captures, rebounds, and the steep rise of e between them.
#[test]
fn the_rebound_is_solved_with_the_size() {
    let (mut captured, mut uncorrected) = (0, 0.0_f64);
    for speed in [0.5, 2.8, 30.0] {
        for step in 0..400 {
            let radius = 2e-7 * 1.015_f64.powi(step);
            let found = sized(impulse(radius, speed), speed).unwrap();
            assert!((found.radius.value / radius - 1.0).abs() < 2e-5, "{radius:e} {speed}: {found:?}");
            captured += usize::from(found.restitution == 0.0);
            // What a perfect rebound, or none, would make of it.
            let without = (impulse(radius, speed) / speed / (4.0 / 3.0 * std::f64::consts::PI * DENSITY)).cbrt();
            uncorrected = uncorrected.max(without / radius - 1.0);
        }
    }
    assert!((200..1000).contains(&captured), "{captured}");
    assert!(uncorrected > 0.2, "{uncorrected}");
    // The simulation in the place of the rigid body.
    let contact = |radius| {
        let scene = Contact::hertz(Sphere::solid(radius, DENSITY)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
        Ok(Simulated { scene: scene.with_ring(250.0, 6.25)?, method: FixedCost::<7>::new(4)? })
    };
    for radius in [3e-6, 4.5e-6, 5.06e-6, 9e-6] {
        let scene = contact(radius).unwrap().scene;
        let method = FixedCost::<7>::new(4).unwrap();
        let e = scene.solve_normal(&NormalMotion::new(2.8).unwrap(), &method).unwrap().overall_restitution();
        let impulse = scene.sphere().mass() * (1.0 + e) * 2.8;
        let found = radius_from_impulse(&exact(impulse), &exact(2.8), &exact(DENSITY), contact).unwrap();
        assert!((found.radius.value / radius - 1.0).abs() < 2e-5, "{radius:e}: {found:?}");
    }
}

/// Captured and rebounding spheres. Next to the critical radius of 4.56 um the stated error is larger than the scatter.
#[test]
fn sizes_from_impulses_have_the_stated_errors() {
    for (seed, radius, speed, least) in [
        (30, 5e-6, 2.8, 0.95),
        (31, 3e-6, 2.0, 0.95),
        (32, 7e-6, 2.0, 0.95),
        (33, 4.6e-6, 2.0, 0.6),
        (34, 4.5e-6, 2.0, 0.6),
    ] {
        let deviation = deviation("size from impulse", seed, |random| {
            let impulse = impulse(radius, speed);
            let measured = drawn(random, impulse, 0.03 * impulse);
            let (speed, density) = (drawn(random, speed, 0.01 * speed), drawn(random, DENSITY, 20.0));
            (radius_from_impulse(&measured, &speed, &density, body).unwrap().radius, radius)
        });
        assert!((least..1.05).contains(&deviation), "{radius:e}: {deviation}");
    }
}

/// A restitution that falls from one to zero within a narrow range of sizes: the impulse has the same value at two sizes and more.
#[test]
fn impulses_that_do_not_determine_the_size_are_unsolved() {
    let falling = |radius: f64| {
        RigidBody::new(
            Sphere::solid(radius, DENSITY)?,
            ConstantRestitution::new(if radius < 5e-6 { 1.0 } else { 0.0 })?,
        )
        .with_adhesion_coefficient(0.0)
    };
    let mass = Sphere::solid(4.8e-6, DENSITY).unwrap().mass();
    let ambiguous = radius_from_impulse(&exact(2.0 * mass * 2.8), &exact(2.8), &exact(DENSITY), falling);
    assert_eq!(ambiguous, Err(Rejection::Unsolved));
    let mass = Sphere::solid(3e-6, DENSITY).unwrap().mass();
    let clear = radius_from_impulse(&exact(2.0 * mass * 2.8), &exact(2.8), &exact(DENSITY), falling).unwrap();
    assert!((clear.radius.value / 3e-6 - 1.0).abs() < 2e-5);
    // A table of critical speeds has no restitution.
    let table = BoundaryTable::<8>::new(1e-6_f64, |_| Ok(CriticalSpeed::At(1.0))).unwrap();
    let tabulated = |radius| {
        let sphere = Sphere::solid(radius, DENSITY)?;
        Ok(microimpact::instrument::Tabulated { table, sphere, friction: microimpact::NoFriction })
    };
    let result = radius_from_impulse(&exact(2.0 * mass * 2.8), &exact(2.8), &exact(DENSITY), tabulated);
    assert_eq!(result, Err(Rejection::Unsolved));
}

/// Bad values are refused by name, in single precision too.
#[test]
fn bad_signals_are_refused_by_name() {
    let parameter = |result: Result<_, Rejection>| match result.map(|_: SizedImpact<f64>| ()) {
        Err(Rejection::Input(error)) => error.parameter,
        other => panic!("{other:?}"),
    };
    assert_eq!(parameter(sized(f64::NAN, 2.8)), Parameter::MeasuredImpulse);
    assert_eq!(parameter(sized(0.0, 2.8)), Parameter::MeasuredImpulse);
    assert_eq!(parameter(sized(1e-11, -2.8)), Parameter::ApproachSpeed);
    assert_eq!(parameter(sized(1e6, 1e-12)), Parameter::Radius);
    let noisy = Estimate { value: 1e-11, standard_error: 0.3e-11 };
    let result = radius_from_impulse(&noisy, &exact(2.8), &exact(DENSITY), body);
    assert_eq!(parameter(result), Parameter::RelativeError);
    let clock = Clock::new(&Estimate { value: 1e6_f32, standard_error: 0.0 }, 0.0).unwrap();
    let refused = |result: Result<_, InputError>| result.map(drop).unwrap_err().parameter;
    assert_eq!(refused(clock.time(0)), Parameter::Ticks);
    assert_eq!(refused(clock.time(1)), Parameter::RelativeError);
    assert!(clock.time(u32::MAX).is_ok());
    let spacing = Estimate { value: 3e-6_f32, standard_error: 0.0 };
    let doppler = Doppler::new(&spacing, 0.0, clock).unwrap();
    assert_eq!(refused(doppler.velocity(&DopplerBurst { periods: 0, ticks: 100 })), Parameter::SignalCycles);
    let charge = Estimate { value: 1e-30_f32, standard_error: 0.0 };
    let tube = ImageCharge::new(&Estimate { value: 0.05, standard_error: 0.0 }, &charge, 0.0, clock).unwrap();
    for height in [i32::MIN, -1, 0, 1, i32::MAX] {
        let particle = tube.particle(&ChargePulse { height, width: 4000 }).unwrap();
        assert!(particle.charge.standard_error > 0.0 && particle.charge.standard_error.is_finite());
        let radius = particle
            .radius(&Estimate { value: 1e3, standard_error: 0.0 }, &Estimate { value: 1e3, standard_error: 0.0 });
        assert!(radius.is_err() || height.unsigned_abs() > 1000, "{height}: {radius:?}");
    }
    let sensor = ImpulseSensor::new(&charge, 0.0, 0.0).unwrap();
    let mut pulse = PulseSum::new(i32::MAX);
    pulse.add(i32::MIN);
    assert_eq!(pulse.sum(), i64::from(i32::MIN) - i64::from(i32::MAX));
    assert_eq!(refused(sensor.impulse(&pulse)), Parameter::MeasuredImpulse);
}
