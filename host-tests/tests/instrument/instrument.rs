//! The way from an interrupt to a class: nothing is lost silently, and statistics stay exact.

use embedded_hal_mock::eh1::MockError;
use embedded_hal_mock::eh1::digital::{Mock, State, Transaction};
use microimpact::contact::{Collocation, Contact, FixedCost, Impulses, RingScene};
use microimpact::instrument::{
    ClassLines, ClassSet, Classifier, Instrument, NoLines, NormalReading, ObliqueReading, PlanarReading, Queue,
    Reading, Rejection, Simulated, SpeedBins, Statistics, Tabulated, TabulatedClass, Tally, Verdict,
};
use microimpact::table::{BoundaryTable, RestitutionTable, TableOutcome, TableRebound};
use microimpact::{
    Class, Coulomb, Dual, Fault, FixedPoint, InputError, NoFriction, NormalMotion, Outcome, Parameter, RigidBody,
    SpeedRestitution, Sphere, Stiffness,
};
use proptest::prelude::*;
use reference::repetitions;

type Scene = RigidBody<f64, SpeedRestitution<f64>, microimpact::rigid::WorkOfAdhesion<f64>, Coulomb<f64>>;

fn scene() -> Scene {
    let sphere = Sphere::solid(5.06e-6, 2600.0).unwrap();
    let scene = RigidBody::new(sphere, SpeedRestitution::new(130.0).unwrap());
    scene.with_work_of_adhesion(2.22e-12).unwrap().with_friction(0.1).unwrap()
}

fn bins() -> SpeedBins<f64, 3> {
    SpeedBins::new([1.0, 3.0, 10.0]).unwrap()
}

/// Readings good and bad.
fn readings() -> impl Strategy<Value = PlanarReading<f64>> {
    let number = prop_oneof![6 => -20.0..20.0, 1 => Just(f64::NAN), 1 => Just(1e300), 1 => Just(f64::NEG_INFINITY)];
    let speed = prop_oneof![8 => 0.01..50.0, 1 => -1.0..0.0, 1 => Just(f64::INFINITY)];
    (speed, number.clone(), number).prop_map(|(approach, tangential, peripheral)| PlanarReading {
        approach,
        tangential,
        peripheral,
    })
}

/// The class, or the parameter at fault, found without the pipeline.
fn expected(reading: &PlanarReading<f64>) -> Result<Class, Parameter> {
    let within = |parameter: Parameter, value: f64| {
        let (smallest, largest) = parameter.range();
        if (smallest..=largest).contains(&value) { Ok(value) } else { Err(parameter) }
    };
    let motion = NormalMotion::new(within(Parameter::ApproachSpeed, reading.approach)?).unwrap();
    let motion = motion.with_tangential(within(Parameter::TangentialVelocity, reading.tangential)?).unwrap();
    let velocity = within(Parameter::PeripheralVelocity, reading.peripheral)?;
    Ok(scene().classify(&motion.with_peripheral_velocity(velocity).unwrap()).class())
}

proptest! {
    #[test]
    fn every_reading_is_counted_once(readings in prop::collection::vec(readings(), 1..200), room in 1usize..64) {
        let mut instrument: Instrument<_, _, _, 6, 3> = Instrument::new(scene(), NoLines, bins());
        let mut queue = Queue::<PlanarReading<f64>, 32>::new();
        let (mut interrupt, mut main_loop) = queue.split();
        let (mut classes, mut rejected, mut lost, mut fast) = ([0; 6], 0, 0, 0);
        for burst in readings.chunks(room) {
            for (sent, reading) in burst.iter().enumerate() {
                // 31 find room.
                prop_assert_eq!(interrupt.send(*reading).is_ok(), sent < 31);
                match (sent < 31).then(|| expected(reading)) {
                    None => lost += 1,
                    Some(Err(_)) => rejected += 1,
                    Some(Ok(class)) => {
                        classes[class.index()] += 1;
                        let rebounds = matches!(class, Class::ReboundSliding | Class::ReboundRolling);
                        fast += u64::from(rebounds && reading.approach >= 10.0);
                    }
                }
            }
            let mut answered = burst.iter();
            while let Some(reading) = main_loop.receive() {
                let verdict = instrument.process(&reading);
                prop_assert_eq!(
                    verdict.map(|verdict| verdict.class).map_err(|rejection| match rejection {
                        Rejection::Input(error) => error.parameter,
                        other => panic!("{other}"),
                    }),
                    expected(answered.next().unwrap())
                );
            }
        }
        let tally = instrument.tally();
        prop_assert_eq!(Class::ALL.iter().map(|&class| tally.count(class)).collect::<Vec<_>>(), classes);
        prop_assert_eq!((tally.rejections().input, tally.rejections().unsolved), (rejected, 0));
        prop_assert_eq!(main_loop.lost(), lost);
        let counted: u64 = tally.restitution().iter().map(Statistics::count).sum();
        prop_assert_eq!(counted + fast, tally.count(Class::ReboundSliding) + tally.count(Class::ReboundRolling));
        prop_assert_eq!(tally.restitution_beyond().count(), fast);
    }
}

/// Every kind of scene gives the class and restitution that its own functions give.
#[test]
fn classifiers_answer_for_their_scenes() {
    let sphere = Sphere::solid(5.06e-6, 2600.0).unwrap();
    let normal = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap());
    let normal = normal.with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
    let oblique = normal.with_friction(0.1).unwrap();
    let exact = Collocation::<9, f64>::new(1e-9).unwrap();
    let fixed = FixedCost::<7>::new(4).unwrap();
    let body = RigidBody::new(sphere, SpeedRestitution::new(130.0).unwrap()).with_work_of_adhesion(2.22e-12).unwrap();
    let mut classes = Vec::new();
    for speed in [0.3, 0.8, 1.7, 2.8, 9.0] {
        let straight = NormalReading { approach: speed }.motion().unwrap();
        let contact = normal.solve_normal(&straight, &fixed).unwrap();
        let verdict = Simulated { scene: normal, method: fixed }.verdict(&straight).unwrap();
        assert_eq!(
            verdict,
            Verdict { class: contact.outcome().unwrap(), restitution: Some(contact.overall_restitution()) }
        );
        let verdict: Verdict<f64, Outcome> = body.verdict(&straight).unwrap();
        assert_eq!(verdict.class, body.classify(&straight).outcome);
        assert_eq!(verdict.restitution, Some(body.impact(&straight).normal.overall_restitution()));
        for tangential in [0.0, 0.2, 30.0] {
            let moving = ObliqueReading { approach: speed, tangential }.motion().unwrap();
            let impact = oblique.solve(&moving, &exact).unwrap();
            let verdict = Simulated { scene: oblique, method: exact }.verdict(&moving).unwrap();
            assert_eq!(verdict.class, impact.class().unwrap());
            assert!((verdict.restitution.unwrap() - impact.normal.overall_restitution()).abs() < 1e-9);
            let verdict = scene().verdict(&moving).unwrap();
            assert_eq!(verdict.class, scene().classify(&moving).class());
            classes.push(verdict.class);
        }
    }
    // None is close enough to the critical speed to be undecided.
    let mut decided = Class::ALL.iter().filter(|class| **class != Class::Undecided);
    assert!(decided.all(|class| classes.contains(class)), "{classes:?}");
}

/// The paper's surface.
fn contact(radius: f64) -> Result<RingScene<f64>, InputError> {
    Contact::hertz(Sphere::solid(radius, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)
}

/// Radii of 2 to 8 um, up to ten times the critical speed.
fn table() -> RestitutionTable<f64, 8, 6, 10> {
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    let boundary = BoundaryTable::new(2e-6, |radius| contact(radius)?.critical_speed(&method)).unwrap();
    let source = |radius, speed: f64| {
        let scene = contact(radius)?;
        let (impact, impulses) = scene.solve_for(&NormalMotion::new(speed)?, &method, Impulses)?;
        let impulse = impulses.elastic / (scene.sphere().mass() * speed);
        Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
    };
    RestitutionTable::new(boundary, 10.0, source).unwrap()
}

/// Tables in the place of simulations say the same, or that they do not know.
#[test]
fn tables_classify_as_simulations_do() {
    let (table, friction) = (table(), Coulomb::new(0.1).unwrap());
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    let mut classes = Vec::new();
    let (smallest, end) = table.boundary().radii::<f64>();
    for radius in [1e-6, 2.5e-6, 5.06e-6, 7.5e-6] {
        let scene = contact(radius).unwrap();
        let sphere = *scene.sphere();
        let boundary = Tabulated { table: *table.boundary(), sphere, friction: NoFriction };
        let slice = Tabulated { table: table.boundary().as_slice(), sphere, friction: NoFriction };
        let normal = Tabulated { table, sphere, friction: NoFriction };
        let oblique = Tabulated { table, sphere, friction };
        let simulated = Simulated { scene: scene.with_friction(0.1).unwrap(), method };
        let critical = table.boundary().critical_speed(radius).unwrap_or(1.0);
        for (ratio, tangential) in
            [0.5, 0.999, 1.0, 1.001, 1.5, 4.0, 11.0].into_iter().flat_map(|ratio| [(ratio, 0.2), (ratio, 90.0)])
        {
            let reading = ObliqueReading { approach: ratio * critical, tangential };
            let motion = reading.motion().unwrap();
            let exact = simulated.verdict(&motion).unwrap();
            let outside = !(smallest..end).contains(&radius);
            let expected = match exact.class {
                _ if outside => TableOutcome::OutsideTable,
                _ if ratio == 1.0 => TableOutcome::TooCloseToCall,
                Class::ReboundSliding | Class::ReboundRolling => TableOutcome::Rebound,
                _ => TableOutcome::Capture,
            };
            for found in [boundary.verdict(&motion).unwrap(), slice.verdict(&motion).unwrap()] {
                assert_eq!(found, Verdict { class: expected, restitution: None });
            }
            // Restitution is not tabulated as far as that.
            let expected = if ratio > 10.0 { TableOutcome::OutsideTable } else { expected };
            let found = normal.verdict(&motion).unwrap();
            assert_eq!(found.class, expected);
            let known = matches!(expected, TableOutcome::Rebound | TableOutcome::Capture);
            assert_eq!(found.restitution.is_some(), known);
            if let Some(restitution) = found.restitution {
                let error = (restitution - exact.restitution.unwrap()).abs();
                assert!(error < if ratio > 1.1 { 1e-3 } else { 1e-2 }, "{radius:e} {ratio}: {error:e}");
            }
            let with_friction = oblique.verdict(&motion).unwrap();
            assert_eq!(with_friction.restitution, found.restitution);
            let expected = match expected {
                TableOutcome::Rebound if exact.class == Class::ReboundSliding => TabulatedClass::ReboundSliding,
                TableOutcome::Rebound => TabulatedClass::ReboundRolling,
                TableOutcome::Capture => TabulatedClass::Capture,
                TableOutcome::TooCloseToCall => TabulatedClass::TooCloseToCall,
                TableOutcome::OutsideTable => TabulatedClass::OutsideTable,
            };
            assert_eq!(with_friction.class, expected);
            classes.push(expected);
        }
    }
    assert!(TabulatedClass::ALL.iter().all(|class| classes.contains(class)), "{classes:?}");
    assert!(TabulatedClass::ALL.iter().enumerate().all(|(index, class)| class.index() == index));
    assert!(TableOutcome::ALL.iter().enumerate().all(|(index, class)| class.index() == index));
}

#[test]
fn an_instrument_with_a_table_counts_what_it_cannot_tell() {
    let table = table();
    let critical = table.boundary().critical_speed(5e-6).unwrap();
    let sphere = Sphere::solid(5e-6, 2600.0).unwrap();
    let classifier = Tabulated { table, sphere, friction: Coulomb::new(0.1).unwrap() };
    let mut instrument: Instrument<_, _, _, 5, 3> = Instrument::new(classifier, NoLines, bins());
    for (ratio, tangential) in [(2.0, 0.1), (2.0, 90.0), (0.5, 0.0), (1.0, 0.0), (20.0, 0.0), (-1.0, 0.0)] {
        let _ = instrument.process(&PlanarReading { approach: ratio * critical, tangential, peripheral: 0.0 });
    }
    let tally = instrument.tally();
    assert!(TabulatedClass::ALL.iter().all(|&class| tally.count(class) == 1), "{tally:?}");
    assert_eq!((tally.rejections().input, tally.classified()), (1, 5));
    assert_eq!(tally.restitution().iter().map(Statistics::count).sum::<u64>(), 2);
}

#[test]
fn what_cannot_be_solved_is_rejected_by_name() {
    let sphere = Sphere::solid(1e-6, 1000.0).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(1e10).unwrap()).with_damping(1e4).unwrap();
    let overdamped = Simulated { scene, method: FixedCost::<5>::new(3).unwrap() };
    let mut instrument: Instrument<_, _, _, 3, 3> = Instrument::new(overdamped, NoLines, bins());
    assert_eq!(instrument.process(&NormalReading { approach: 1.0 }), Err(Rejection::Unsolved));
    let error = instrument.process(&NormalReading { approach: f64::NAN }).unwrap_err();
    assert!(matches!(error, Rejection::Input(error) if error.fault == Fault::NotFinite), "{error}");
    let rejections = instrument.tally().rejections();
    assert_eq!((rejections.input, rejections.unsolved), (1, 1));
}

#[test]
fn one_line_is_high_for_the_latest_class() {
    let (low, high) = (|| Transaction::set(State::Low), || Transaction::set(State::High));
    let stuck = || Transaction::set(State::Low).with_error(MockError::Io(std::io::ErrorKind::Other));
    let mut rebound = Mock::new(&[high(), low(), low(), stuck()]);
    let mut capture = Mock::new(&[low(), high(), low()]);
    let mut undecided = Mock::new(&[low(), low(), low(), low()]);
    let lines = ClassLines::new([rebound.clone(), capture.clone(), undecided.clone()]);
    let sphere = Sphere::solid(5.06e-6, 2600.0).unwrap();
    let body = RigidBody::new(sphere, SpeedRestitution::new(130.0).unwrap()).with_work_of_adhesion(2.22e-12).unwrap();
    let mut instrument: Instrument<_, _, _, 3, 3> = Instrument::new(body, lines, bins());
    let mut class = |approach| instrument.process(&NormalReading { approach }).ok().map(|verdict| verdict.class);
    assert_eq!(class(2.8), Some(Outcome::Rebound));
    assert_eq!(class(0.5), Some(Outcome::Capture));
    assert_eq!(class(f64::NAN), None);
    // A line that stays high keeps the next one low, and the failure is counted; the class is answered all the same.
    assert_eq!(class(0.5), Some(Outcome::Capture));
    assert_eq!(instrument.tally().signal_failures(), 1);
    rebound.done();
    capture.done();
    undecided.done();
}

/// f32 against f64, for a thousand million numbers (a tenth without MICROIMPACT_EXHAUSTIVE): sixty times as many as f32 can
/// count.
#[test]
fn single_precision_statistics_do_not_stand_still() {
    let numbers: u32 = repetitions(1_000_000_000, 100_000_000);
    let (mut single, mut plain_mean) = (Statistics::<f32>::new(), 0.0_f32);
    let (mut sum, mut squares) = (0.0_f64, 0.0_f64);
    // Restitutions that drift upwards, so that a mean that stands still falls behind.
    let restitution = |i: u32| 0.6 + 0.3 * (i as f32 / numbers as f32) + 0.1 * ((i % 1000) as f32 / 1000.0 - 0.5);
    for i in 0..numbers {
        let e = restitution(i);
        single.add(e);
        plain_mean += (e - plain_mean) / (i + 1) as f32;
        sum += f64::from(e);
        squares += f64::from(e).powi(2);
    }
    let mean = sum / f64::from(numbers);
    let variance = (squares - sum * mean) / f64::from(numbers - 1);
    assert_eq!(single.count(), u64::from(numbers));
    assert!((f64::from(single.mean()) - mean).abs() < 1e-7, "{} {mean}", single.mean());
    assert!((f64::from(single.variance().unwrap()) / variance - 1.0).abs() < 1e-6);
    // The same without what rounding drops.
    assert!((f64::from(plain_mean) - mean).abs() > 1e-3, "{plain_mean} {mean}");
}

/// After a thousand million numbers every number still counts.
#[test]
fn statistics_hold_beyond_a_thousand_million_numbers() {
    let mut single = Statistics::<f32>::new();
    for i in 0..1000 {
        single.add(0.7 + 0.2 * (i as f32 / 1000.0 - 0.5));
    }
    let start = (f64::from(single.mean()), f64::from(single.variance().unwrap()));
    while single.count() < 1_000_000_000 {
        let copy = single;
        single.merge(&copy);
    }
    let before = single.count() as f64;
    let population = start.1 * 999.0 / 1000.0;
    assert!((f64::from(single.mean()) - start.0).abs() < 1e-7);
    assert!((f64::from(single.variance().unwrap()) / population - 1.0).abs() < 1e-6);
    // Two million numbers of 0.9 move a mean of 0.7 by 0.0004 and the variance with it.
    let added = 2_000_000;
    for _ in 0..added {
        single.add(0.9);
    }
    let (x, added) = (f64::from(0.9_f32), f64::from(added));
    let mean = (start.0 * before + x * added) / (before + added);
    assert!((f64::from(single.mean()) - mean).abs() < 1e-7, "{} {mean}", single.mean());
    let squares = population * before + (x - start.0).powi(2) * before * added / (before + added);
    let variance = squares / (before + added - 1.0);
    assert!((f64::from(single.variance().unwrap()) / variance - 1.0).abs() < 1e-6);
}

proptest! {
    /// Merged statistics are those of all numbers together.
    #[test]
    fn statistics_merge(numbers in prop::collection::vec(0.0..1.0, 0..50), split in 0usize..50) {
        let all = |numbers: &[f64]| numbers.iter().fold(Statistics::new(), |mut all, &x| { all.add(x); all });
        let (first, second) = numbers.split_at(split.min(numbers.len()));
        let (mut merged, whole) = (all(first), all(&numbers));
        merged.merge(&all(second));
        prop_assert_eq!(merged.count(), whole.count());
        prop_assert!((merged.mean() - whole.mean()).abs() < 1e-14);
        match (merged.variance(), whole.variance()) {
            (Some(merged), Some(whole)) => prop_assert!((merged - whole).abs() < 1e-14),
            (merged, whole) => prop_assert_eq!(merged, whole),
        }
    }
}

#[test]
fn a_tally_survives_a_restart_and_its_bins_are_checked() {
    let mut tally = Tally::<f64, 3, 3>::new(bins());
    tally.record(2.0, &Verdict { class: Outcome::Rebound, restitution: Some(0.7) });
    tally.reject(&Rejection::Unsolved);
    let text = serde_json::to_string(&tally).unwrap();
    assert_eq!(serde_json::from_str::<Tally<f64, 3, 3>>(&text).unwrap(), tally);
    let descending = text.replace("[1.0,3.0,10.0]", "[1.0,3.0,2.0]");
    assert_ne!(descending, text);
    let error = serde_json::from_str::<Tally<f64, 3, 3>>(&descending).unwrap_err();
    assert!(error.to_string().contains("approach speed"), "{error}");
}

/// Compiles only if the types that a host keeps can be written to a file.
#[test]
fn results_and_scenes_can_be_written() {
    fn written(value: &impl serde::Serialize) -> serde_json::Value {
        serde_json::to_value(value).unwrap()
    }
    let scene = scene();
    let reading = PlanarReading { approach: 2.8, tangential: 1.0, peripheral: 0.0 };
    let motion = reading.motion().unwrap();
    let impact = scene.impact(&motion);
    let simulation = Contact::hertz(*scene.sphere(), Stiffness::new(7.5e10).unwrap()).with_friction(0.1).unwrap();
    let contact = simulation.solve(&motion, &Collocation::<9, f64>::new(1e-9).unwrap()).unwrap();
    assert_eq!(written(&scene)["sphere"]["radius"], 5.06e-6);
    assert_eq!(written(&simulation)["surface"]["coefficient"], 0.1);
    assert_eq!(written(&motion)["peripheral"], 0.0);
    assert_eq!(written(&reading)["approach"], 2.8);
    assert_eq!(written(&impact)["normal"]["rebound"], impact.normal.rebound_speed());
    assert_eq!(written(&contact)["normal"]["approach"], 2.8);
    assert_eq!(written(&impact.energy(scene.sphere()))["before"], impact.energy(scene.sphere()).before);
    assert_eq!(written(&scene.classify(&motion))["outcome"], "Rebound");
    let error = NormalMotion::new(-1.0).unwrap_err();
    assert_eq!(serde_json::from_value::<InputError>(written(&error)).unwrap(), error);
}

/// A table that was made on a host comes back whole, and one that was damaged on the way does not.
#[test]
fn tables_and_numbers_can_be_written_and_read() {
    let table = table();
    let written = serde_json::to_value(table).unwrap();
    assert_eq!(written["nodes"].as_array().unwrap().len(), 2 * 6 * 10);
    let boundary = *table.boundary();
    let text = serde_json::to_string(&boundary).unwrap();
    assert_eq!(serde_json::from_str::<BoundaryTable<8>>(&text).unwrap(), boundary);
    let damaged = text.replace(&format!("\"margin\":{}", boundary.parts().1), "\"margin\":1");
    assert_ne!(damaged, text);
    assert!(serde_json::from_str::<BoundaryTable<8>>(&damaged).unwrap_err().to_string().contains("margin"));

    let number = FixedPoint::nearest(0.1);
    let text = serde_json::to_string(&number).unwrap();
    assert_eq!(serde_json::from_str::<FixedPoint>(&text).unwrap(), number);
    for beyond in ["128.0", "-129.0", "1e300"] {
        assert!(serde_json::from_str::<FixedPoint>(beyond).is_err(), "{beyond}");
    }
    let [dual] = Dual::variables([2.5]);
    assert_eq!(serde_json::to_string(&dual).unwrap(), "{\"value\":2.5,\"partials\":[1.0]}");
}
