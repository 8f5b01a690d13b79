//! Fits that are asked to end.

use std::thread;
use std::time::{Duration, Instant};

use fastrand::Rng;
use impact_fit::{Law, Observation, Response, ScatterModel, Stop, Verdict, compete, compete_until};

/// The paper's law with scatter.
fn measured(rows: u32) -> Vec<Observation> {
    let mut random = Rng::with_seed(1);
    let mut row = |_| {
        let speed = 1.0 + 20.0 * random.f64();
        let restitution = 130.0 / (130.0 + speed) + 0.02 * (random.f64() - 0.5);
        let response = Response::Rebound { speed: restitution * speed, error: 0.01 };
        Observation { speed, speed_error: 0.01, response, sphere: None }
    };
    (0..rows).map(&mut row).collect()
}

#[test]
fn a_fit_that_is_not_asked_to_end_has_its_verdict() {
    let observations = measured(40);
    let fit = || compete_until(&Stop::default(), &observations, &[Law::SpeedRestitution], ScatterModel::Free);
    let expected = compete(&observations, &[Law::SpeedRestitution], ScatterModel::Free);
    let (Some(Verdict::Fits(found)), Verdict::Fits(expected)) = (fit(), expected) else {
        panic!("no fit");
    };
    assert_eq!(found.fit.aic(), expected.fit.aic());
}

#[test]
fn a_fit_ends_soon_after_it_is_asked_to() {
    let observations = measured(100_000);
    let (stop, laws) = (Stop::default(), [Law::SpeedRestitution, Law::Viscoelastic]);
    thread::scope(|scope| {
        let fit = scope.spawn(|| compete_until(&stop, &observations, &laws, ScatterModel::Free));
        thread::sleep(Duration::from_millis(100));
        assert!(!fit.is_finished());
        stop.ask();
        let asked = Instant::now();
        assert!(fit.join().unwrap().is_none());
        assert!(asked.elapsed() < Duration::from_secs(1));
    });
}
