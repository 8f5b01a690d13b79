//! Times that can be compared on a machine that others use too: all contestants take turns, and the least time counts.

use std::time::Instant;

/// A turn repeats a run until it takes about this long, s.
const TURN: f64 = 1e-4;

/// Least time of a run of each contestant in so many turns, s; `turn_ends` is told of each.
pub fn least_times(contestants: &mut [&mut dyn FnMut()], turns: u32, mut turn_ends: impl FnMut()) -> Vec<f64> {
    // The first run is not counted; the second says how often a turn repeats it.
    let repeats: Vec<u32> = contestants
        .iter_mut()
        .map(|run| {
            time(*run, 1);
            (TURN / time(*run, 1)).clamp(1.0, 1e4) as u32
        })
        .collect();
    let mut least = vec![f64::INFINITY; contestants.len()];
    for _ in 0..turns {
        for ((run, &repeats), least) in contestants.iter_mut().zip(&repeats).zip(&mut least) {
            *least = least.min(time(*run, repeats));
        }
        turn_ends();
    }
    least
}

fn time(run: &mut dyn FnMut(), repeats: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..repeats {
        run();
    }
    start.elapsed().as_secs_f64() / f64::from(repeats)
}
