//! Events of sized particles: their scenes, their confidence, and whether what was observed agrees with what was expected.

use microimpact::contact::{Adaptive, Contact};
use microimpact::instrument::link::{Decoder, Encoder, Inlet, Reply, Request};
use microimpact::instrument::{
    ClassSet, Classifier, Confident, Drift, DriftAlarm, Instrument, NoLines, ObliqueReading, ObservedRebound,
    PerParticle, Reading, Rejection, Scatter, SizeBins, SizedReading, SizedTally, SpeedBins, Stamped, UncertainMotion,
    UncertainReading, Verdict,
};
use microimpact::measure::Estimate;
use microimpact::rigid::{Departure, WorkOfAdhesion};
use microimpact::{
    Approach, Class, Coulomb, CriticalSpeed, Fault, InputError, NormalMotion, Oblique, Outcome, Parameter,
    PlanarMotion, RigidBody, SpeedRestitution, Sphere, Stiffness,
};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

type Scene = RigidBody<f64, SpeedRestitution<f64>, WorkOfAdhesion<f64>, Coulomb<f64>>;

/// Density (kg/m^3), restitution speed (m/s) and work of adhesion over radius (J/m).
struct Material(f64, f64, f64);

const MATERIALS: [Material; 2] = [Material(2600.0, 130.0, 4.4e-7), Material(1050.0, 40.0, 1e-7)];

fn scene(material: &Material, radius: f64) -> Result<Scene, InputError> {
    let &Material(density, speed, work) = material;
    RigidBody::new(Sphere::solid(radius, density)?, SpeedRestitution::new(speed)?)
        .with_work_of_adhesion(work * radius)?
        .with_friction(0.1)
}

fn normal(random: &mut StdRng) -> f64 {
    StandardNormal.sample(random)
}

/// Mean and standard deviation.
fn moments(numbers: &[f64]) -> (f64, f64) {
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let squares: f64 = numbers.iter().map(|x| (x - mean).powi(2)).sum();
    (mean, (squares / (numbers.len() - 1) as f64).sqrt())
}

#[test]
fn each_particle_has_its_own_scene() {
    let classifier = PerParticle { materials: &MATERIALS, scene };
    let bins = SpeedBins::new([1.0, 10.0]).unwrap();
    let mut instrument: Instrument<_, _, f64, 6, 2> = Instrument::new(classifier, NoLines, bins);
    let mut classes = Vec::new();
    for radius in [0.5e-6, 2e-6, 5e-6, 2e-5] {
        for (material, properties) in MATERIALS.iter().enumerate() {
            for tangential in [0.0, 20.0] {
                let reading = ObliqueReading { approach: 1.7, tangential };
                let reading = Stamped { ticks: 3, reading: SizedReading { radius, material: material as u8, reading } };
                let expected = scene(properties, radius).unwrap().verdict(&reading.reading.reading.motion().unwrap());
                assert_eq!(instrument.process(&reading), expected, "{radius:e} {material}");
                classes.push(expected.unwrap().class);
            }
        }
    }
    assert!(classes.contains(&Class::CapturedResting) && classes.contains(&Class::ReboundSliding), "{classes:?}");
    for (radius, material, parameter, fault) in [
        (5e-6, 2, Parameter::MaterialIndex, Fault::NotInTable),
        (5.0, 0, Parameter::Radius, Fault::TooLarge),
        (f64::NAN, 0, Parameter::Radius, Fault::NotFinite),
    ] {
        let reading = ObliqueReading { approach: 1.7, tangential: 0.0 };
        match instrument.process(&SizedReading { radius, material, reading }) {
            Err(Rejection::Input(error)) => assert_eq!((error.parameter, error.fault), (parameter, fault)),
            other => panic!("{other:?}"),
        }
    }
    assert_eq!((instrument.tally().rejections().input, instrument.tally().classified()), (3, 16));
}

/// Truths that are drawn about a reading have the stated class as often as stated, by both models.
#[test]
fn stated_classes_are_as_certain_as_stated() {
    const CONFIDENCE: f64 = 0.8;
    let rigid_body = Confident::new(CONFIDENCE, |radius, motion| Ok((scene(&MATERIALS[0], radius)?, motion))).unwrap();
    let method = Adaptive::new(1e-6).unwrap();
    let contact = |radius| {
        Contact::hertz(Sphere::solid(radius, 2600.0)?, Stiffness::new(7.5e10)?)
            .with_damping(10.5)?
            .with_ring(250.0, 6.25)?
            .with_friction(0.1)
    };
    let simulation = Confident::new(CONFIDENCE, |radius, motion| Ok((contact(radius)?, motion, &method))).unwrap();
    let by_scene = |radius, motion: &PlanarMotion<f64>| scene(&MATERIALS[0], radius).unwrap().classify(motion).class();
    let by_contact =
        |radius, motion: &PlanarMotion<f64>| contact(radius).unwrap().solve(motion, &method).unwrap().class();
    certain(1.8, 200, 400, |motion| rigid_body.verdict(motion), by_scene);
    let critical = contact(5.06e-6).unwrap().critical_speed(&method).unwrap();
    let CriticalSpeed::At(critical) = critical else { panic!("{critical:?}") };
    certain(
        critical,
        24,
        100,
        |motion| simulation.verdict(motion),
        |radius, motion| by_contact(radius, motion).unwrap(),
    );
}

/// Readings near the boundaries of the classes.
fn certain(
    critical: f64,
    readings: usize,
    draws: usize,
    verdict: impl Fn(&UncertainMotion<f64>) -> Result<Verdict<f64, Class>, Rejection>,
    class: impl Fn(f64, &PlanarMotion<f64>) -> Class,
) {
    let random = &mut StdRng::seed_from_u64(1);
    let (mut undecided, mut stated, mut right) = (0, 0, 0);
    for _ in 0..readings {
        let estimate = |value, standard_error| Estimate { value, standard_error };
        let approach = estimate(critical * (0.2 * normal(random)).exp(), 0.06);
        let tangential = estimate(0.5 * normal(random), 0.1);
        let peripheral = estimate(0.5 * normal(random), 0.1);
        let radius = estimate(5.06e-6, 0.1e-6);
        let reading = UncertainReading { approach, tangential, peripheral, radius };
        let decided = verdict(&reading.motion().unwrap()).unwrap().class;
        if decided == Class::Undecided {
            undecided += 1;
            continue;
        }
        let mut as_stated = 0;
        for _ in 0..draws {
            let [approach, tangential, peripheral, radius] = [approach, tangential, peripheral, radius]
                .map(|input| input.value + input.standard_error * normal(random));
            let motion = NormalMotion::new(approach).unwrap().with_tangential(tangential).unwrap();
            let class = match class(radius, &motion.with_peripheral_velocity(peripheral).unwrap()) {
                Class::CapturedResting => Class::CapturedRolling,
                class => class,
            };
            as_stated += usize::from(class == decided);
        }
        // Four standard errors of the draws, and the error of a probability.
        let least = 0.8 - 4.0 * (0.16 / draws as f64).sqrt() - 0.01;
        assert!(as_stated as f64 >= least * draws as f64, "{reading:?} {decided}: {as_stated} of {draws}");
        (stated, right) = (stated + draws, right + as_stated);
    }
    // The readings are such that some are too close to call.
    assert!(undecided * 20 > readings && undecided * 2 < readings, "{undecided} of {readings}");
    assert!(right * 100 > stated * 85, "{right} of {stated}");
}

/// The alarms in a number of readings, and the sum of the weights 4 p (1 - p). The odds of the class are those expected, times a
/// factor.
fn alarms(odds_ratio: f64, factor: f64, probability: fn(&mut StdRng) -> f64, readings: usize) -> (Vec<Drift>, f64) {
    let random = &mut StdRng::seed_from_u64(2);
    let mut alarm = DriftAlarm::new(odds_ratio, INTERVAL).unwrap();
    let (mut found, mut weights) = (Vec::new(), 0.0);
    for _ in 0..readings {
        let expected = probability(random);
        let truly = factor * expected / (1.0 - expected + factor * expected);
        weights += 4.0 * expected * (1.0 - expected);
        found.extend(alarm.observe(random.random_bool(truly), expected).unwrap());
    }
    (found, weights)
}

/// Weights between two false alarms.
const INTERVAL: f64 = 500.0;

#[test]
fn drift_alarms_are_as_rarely_false_as_stated_and_soon_true() {
    const READINGS: usize = 300_000;
    let probabilities: [fn(&mut StdRng) -> f64; 3] = [|_| 0.5, |_| 0.05, |random| random.random_range(0.0..1.0)];
    for probability in probabilities {
        for ratio in [1.5, 3.0] {
            let (found, weights) = alarms(ratio, 1.0, probability, READINGS);
            let (found, most) = (found.len() as f64, weights / INTERVAL);
            // Intervals are nearly exponentially distributed, so that the counts are nearly Poisson distributed.
            assert!(found < most + 3.0 * most.sqrt() && found > 0.5 * most, "{ratio}: {found} of {most}");
            for (factor, expected) in [(ratio, Drift::MoreFrequent), (1.0 / ratio, Drift::LessFrequent)] {
                let (found, _) = alarms(ratio, factor, probability, READINGS / 3);
                let wrong = found.iter().filter(|drift| **drift != expected).count();
                assert!(wrong * 50 <= found.len(), "{ratio} {factor}: {wrong} of {}", found.len());
                // Wald: at most the logarithm of the limit over the mean Kullback-Leibler information of a reading.
                let random = &mut StdRng::seed_from_u64(3);
                let information = |p: f64| {
                    let q = factor * p / (1.0 - p + factor * p);
                    q * (q / p).ln() + (1.0 - q) * ((1.0 - q) / (1.0 - p)).ln()
                };
                let information = (0..10_000).map(|_| information(probability(random))).sum::<f64>() / 10_000.0;
                let delay = (READINGS / 3) as f64 / found.len() as f64;
                let wald = (2.0 * INTERVAL).ln() / information;
                assert!((0.25..1.2).contains(&(delay / wald)), "{ratio} {factor}: {delay} {wald}");
            }
        }
    }
    // Readings whose class is certain raise no alarm, however many they are.
    let mut alarm = DriftAlarm::new(2.0, 10.0).unwrap();
    assert!((0..10_000).all(|reading| alarm.observe(reading % 2 == 0, f64::from(1 - reading % 2)) == Ok(None)));
}

#[test]
fn counts_agree_with_expectations_if_the_expectations_are_right() {
    let random = &mut StdRng::seed_from_u64(4);
    let sizes = SizeBins::new([2e-6, 4e-6, 8e-6]).unwrap();
    let speeds = SpeedBins::new([1.0, 3.0]).unwrap();
    let (mut residuals, mut shifted) = (Vec::new(), Vec::new());
    for _ in 0..60 {
        let mut tallies = [SizedTally::<f32, 3, 3, 2>::new(sizes, speeds); 2];
        let mut counted = [[[0_u64; 3]; 2]; 3];
        for reading in 0..3000 {
            let (size, speed) = (random.random_range(0..4), random.random_range(0..3));
            let (radius, velocity) = ([1e-6, 2e-6, 7.9e-6, 9e-6][size], [0.5, 1.0, 3.0][speed]);
            let rebound: f32 = random.random_range(0.0..1.0);
            let observe = |truly: f32, random: &mut StdRng| {
                if random.random_bool(f64::from(truly)) { Outcome::Rebound } else { Outcome::Capture }
            };
            let expected = [rebound, 1.0 - rebound, 0.0];
            let class = observe(rebound, random);
            tallies[0].record(radius, velocity, class, Some(&expected)).unwrap();
            let later = observe(0.8 * rebound, random);
            tallies[1].record(radius, velocity, later, Some(&expected)).unwrap();
            if reading % 10 == 0 {
                tallies[0].record(radius, velocity, Outcome::Undecided, None).unwrap();
            }
            if size < 3 && speed < 2 {
                counted[size][speed][class.index()] += 1;
                counted[size][speed][2] += u64::from(reading % 10 == 0);
            }
        }
        for (size, row) in counted.iter().enumerate() {
            for (speed, counts) in row.iter().enumerate() {
                let cell = tallies[0].cell(size, speed).unwrap();
                assert_eq!(Outcome::ALL.iter().map(|&class| cell.count(class)).collect::<Vec<_>>(), counts);
                residuals.push(f64::from(cell.residual(Outcome::Rebound).unwrap()));
                shifted.push(f64::from(tallies[1].cell(size, speed).unwrap().residual(Outcome::Rebound).unwrap()));
            }
        }
        let total = tallies[0].total();
        let inside: u64 = counted.iter().flatten().flatten().sum();
        assert_eq!((total.readings(), tallies[0].beyond().readings()), (3300, 3300 - inside));
        assert!(total.residual(Outcome::Capture).unwrap().abs() < 5.0);
        assert_eq!(total.residual(Outcome::Undecided), None);
    }
    let (mean, deviation) = moments(&residuals);
    assert!(mean.abs() < 0.2 && (deviation - 1.0).abs() < 0.15, "{mean} {deviation}");
    assert!(moments(&shifted).0 < -3.0, "{:?}", moments(&shifted));
}

/// Velocities with errors, of impacts that scatter about the model: e and mu have the stated errors, and the residuals are
/// standard normal variables.
#[test]
fn observed_rebounds_agree_with_their_model() {
    let random = &mut StdRng::seed_from_u64(5);
    let body = scene(&MATERIALS[0], 5.06e-6).unwrap();
    let after = |before: &PlanarMotion<f64>| {
        let impact = body.impact(before);
        Departure { normal: impact.normal.rebound_speed(), tangential: impact.tangential.velocity() }
    };
    for (scatter, errors) in [
        (Scatter { restitution: 0.0, impulse_ratio: 0.0 }, [0.03, 0.02, 0.05, 0.02, 0.03]),
        (Scatter { restitution: 0.04, impulse_ratio: 0.01 }, [0.06, 0.005, 0.01, 0.01, 0.005]),
    ] {
        let (mut residuals, mut improbable) = ([Vec::new(), Vec::new()], 0);
        let (mut measured, mut stated) = ([Vec::new(), Vec::new()], [0.0; 2]);
        for _ in 0..4000 {
            let before =
                NormalMotion::new(4.0).unwrap().with_tangential(3.0).unwrap().with_peripheral_velocity(0.5).unwrap();
            let exact = after(&before);
            let v = before.normal().speed();
            let e = exact.normal / v + scatter.restitution * normal(random);
            let mu =
                (exact.tangential - before.tangential()) / (v + exact.normal) + scatter.impulse_ratio * normal(random);
            let truth = [v, before.tangential(), before.peripheral(), e * v, before.tangential() + mu * (1.0 + e) * v];
            let mut index = 0;
            let [approach, tangential, peripheral, rebound, tangential_after] = truth.map(|value| {
                let standard_error = errors[index];
                index += 1;
                Estimate { value: value + standard_error * normal(random), standard_error }
            });
            let observed = ObservedRebound { approach, tangential, peripheral, rebound, tangential_after };
            let found = observed.compare(&scatter, |before| Ok::<_, InputError>(after(before))).unwrap();
            for (index, agreement) in [found.restitution, found.impulse_ratio].iter().enumerate() {
                residuals[index].push(agreement.residual().unwrap());
                measured[index].push(agreement.measured.value);
                stated[index] += agreement.measured.standard_error / 4000.0;
            }
            improbable += u32::from(found.restitution.probability().unwrap() < 0.05);
        }
        for index in 0..2 {
            let (mean, deviation) = moments(&residuals[index]);
            assert!(mean.abs() < 0.06 && (deviation - 1.0).abs() < 0.05, "{index}: {mean} {deviation}");
            let own = [scatter.restitution, scatter.impulse_ratio][index];
            let spread = moments(&measured[index]).1;
            assert!((stated[index].hypot(own) / spread - 1.0).abs() < 0.05, "{index}: {} {spread}", stated[index]);
        }
        // 4000 x 0.05 = 200, four standard deviations.
        assert!((145..255).contains(&improbable), "{improbable}");
    }
}

/// A sized event with errors and a time goes over the link, and an undecided class comes back.
#[test]
fn undecided_classes_are_counted_and_sent() {
    let classifier = Confident::new(0.95, |radius, motion| Ok((scene(&MATERIALS[0], radius)?, motion))).unwrap();
    let mut instrument: Instrument<_, _, f64, 6, 1> =
        Instrument::new(classifier, NoLines, SpeedBins::new([10.0]).unwrap());
    let estimate = |value, standard_error| Estimate { value, standard_error };
    let (mut inlet, mut encoder, mut decoder) = (Inlet::<128>::new(), Encoder::<128>::new(), Decoder::<128>::new());
    for (number, (approach, expected)) in
        [(2.8, Class::ReboundRolling), (1.8, Class::Undecided)].into_iter().enumerate()
    {
        let reading = UncertainReading {
            approach: estimate(approach, 0.05),
            tangential: estimate(0.0, 0.01),
            peripheral: estimate(0.2, 0.01),
            radius: estimate(5.06e-6, 1e-8),
        };
        let request = Request::Event { number: number as u32, reading: Stamped { ticks: u32::MAX, reading } };
        let frame = encoder.frame(&request).unwrap();
        let received = frame.iter().find_map(|&byte| inlet.receive::<Stamped<UncertainReading<f64>>, f64>(byte));
        assert_eq!(received, Some(request));
        let Some(Request::Event { number, reading }) = received else { panic!("{received:?}") };
        let verdict = instrument.process(&reading).unwrap();
        assert_eq!(verdict.class, expected);
        let reply = Reply::Classified { number, verdict };
        let answered = encoder.frame(&reply).unwrap().iter().find_map(|&byte| decoder.push::<Reply<f64, Class>>(byte));
        assert_eq!(answered, Some(Ok(reply)));
    }
    assert_eq!((instrument.tally().count(Class::Undecided), instrument.tally().classified()), (1, 2));
}
