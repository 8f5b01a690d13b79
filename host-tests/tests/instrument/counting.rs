//! Dead time and coincidence, against events that are drawn.

use microimpact::Parameter;
use microimpact::instrument::{Arrival, EventCounter, corrected_rate};
use microimpact::measure::Estimate;
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution, Exp, StandardNormal};

/// Ticks in a second: the counter of 32 bits goes around every four seconds.
const CLOCK: f64 = 1e9;

/// Mean and standard deviation.
fn moments(numbers: &[f64]) -> (f64, f64) {
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let squares: f64 = numbers.iter().map(|x| (x - mean).powi(2)).sum();
    (mean, (squares / (numbers.len() - 1) as f64).sqrt())
}

/// A thousandth to two thirds of the time are dead. The rates and the lost events scatter as stated about the truth.
#[test]
fn rates_are_corrected_for_dead_time() {
    let random = &mut StdRng::seed_from_u64(6);
    for (rate, dead_time, dead_error) in [(10.0, 1e-4, 0.0), (1000.0, 1e-3, 0.0), (1000.0, 2e-3, 1e-4)] {
        let (duration, gaps) = (1000.0 / rate + 10.0, Exp::new(rate).unwrap());
        let (mut rates, mut losses, mut followed, mut recorded) = (Vec::new(), Vec::new(), 0.0, 0.0);
        for _ in 0..400 {
            let mut counter =
                EventCounter::new(u32::MAX - 5, (dead_time * CLOCK) as u32, (dead_time * CLOCK / 4.0) as u32);
            let ticks = |time: f64| ((u64::from(u32::MAX) - 5 + (time * CLOCK) as u64) & u64::from(u32::MAX)) as u32;
            let (mut time, mut events, mut alone) = (gaps.sample(random), 0, false);
            while time < duration {
                let arrival = counter.arrive(ticks(time));
                followed += f64::from(arrival == Arrival::Coincident && alone);
                alone = arrival == Arrival::Recorded;
                events += 1;
                time += gaps.sample(random);
            }
            counter.wait(ticks(duration));
            assert_eq!(counter.elapsed(), (duration * CLOCK) as u64);
            let counts = counter.counts();
            assert_eq!(counts.recorded + counts.coincident + counts.dead, events);
            recorded += counts.recorded as f64;
            let deviation: f64 = StandardNormal.sample(random);
            let dead_time = Estimate { value: dead_time + dead_error * deviation, standard_error: dead_error };
            let corrected = corrected_rate(counts.recorded, duration, &dead_time).unwrap();
            rates.push((corrected.rate.value - rate) / corrected.rate.standard_error);
            let lost = (counts.coincident + counts.dead) as f64;
            losses.push((corrected.lost.value - lost) / corrected.lost.standard_error);
            assert!((corrected.coincidence(0.0).unwrap()).abs() < 1e-12);
        }
        for pulls in [&rates, &losses] {
            let (mean, deviation) = moments(pulls);
            assert!(mean.abs() < 0.2 && (deviation - 1.0).abs() < 0.15, "{rate} {dead_time}: {mean} {deviation}");
        }
        let events = 1_000_000;
        let exact = corrected_rate(events, events as f64 / rate, &Estimate { value: 0.0, standard_error: 0.0 });
        let expected = exact.unwrap().coincidence(dead_time / 4.0).unwrap();
        let found = followed / recorded;
        let error = (expected / recorded).sqrt();
        assert!((found - expected).abs() < 4.0 * error, "{rate} {dead_time}: {found} {expected}");
    }
}

#[test]
fn rates_that_cannot_be_corrected_are_refused() {
    let dead_time = |value| Estimate { value, standard_error: 0.0 };
    let parameter = |result: Result<_, microimpact::InputError>| result.map(drop).unwrap_err().parameter;
    // As many dead times as the time holds, and more.
    for recorded in [1000, 2000, u64::MAX] {
        assert_eq!(parameter(corrected_rate(recorded, 1.0, &dead_time(1e-3))), Parameter::DeadFraction);
    }
    assert_eq!(parameter(corrected_rate(1, 0.0, &dead_time(1e-3))), Parameter::ObservationTime);
    assert_eq!(parameter(corrected_rate(1, f64::NAN, &dead_time(1e-3))), Parameter::ObservationTime);
    assert_eq!(parameter(corrected_rate(1, 1.0, &dead_time(-1e-3))), Parameter::Duration);
    let nothing = corrected_rate(0, 10.0, &dead_time(1e-3)).unwrap();
    assert_eq!((nothing.rate.value, nothing.rate.standard_error, nothing.lost.value), (0.0, 0.1, 0.0));
    // The small probability keeps its digits in single precision.
    let rare = corrected_rate(1000, 10.0_f32, &Estimate { value: 0.0, standard_error: 0.0 }).unwrap();
    assert!((rare.coincidence(1e-9).unwrap() / 1e-7 - 1.0).abs() < 1e-6);
}
