//! Times that can be compared on a machine that others use too: all contestants take turns, and the least time counts.

use std::time::Instant;

/// A turn repeats a run until it takes about this long, s.
const TURN: f64 = 1e-4;

/// Time of a run.
#[derive(Clone, Copy)]
pub struct Sample {
    /// All of it, s.
    pub whole: f64,
    /// What of it is not the solver's but that of the language which calls it, s.
    pub beside: f64,
}

impl Sample {
    /// The least of both.
    fn least(self, other: Self) -> Self {
        Self { whole: self.whole.min(other.whole), beside: self.beside.min(other.beside) }
    }

    /// What is the solver's, s.
    pub fn solver(self) -> f64 {
        self.whole - self.beside
    }
}

/// Least time of a run of each contestant in so many turns, s; `turn_ends` is told of each.
pub fn least_times(contestants: &mut [&mut dyn FnMut()], turns: u32, turn_ends: impl FnMut()) -> Vec<f64> {
    let mut clocks: Vec<_> = contestants.iter_mut().map(|run| |repeats| time(*run, repeats)).collect();
    let mut clocks: Vec<&mut dyn FnMut(u32) -> Sample> = clocks.iter_mut().map(|clock| clock as _).collect();
    least_samples(&mut clocks, turns, turn_ends)
}

/// The same of contestants that time so many runs themselves.
pub fn least_samples(
    contestants: &mut [&mut dyn FnMut(u32) -> Sample],
    turns: u32,
    mut turn_ends: impl FnMut(),
) -> Vec<f64> {
    // The first run is not counted; the second says how often a turn repeats it.
    let repeats: Vec<u32> = contestants
        .iter_mut()
        .map(|clock| {
            clock(1);
            (TURN / clock(1).whole).clamp(1.0, 1e4) as u32
        })
        .collect();
    let mut least = vec![Sample { whole: f64::INFINITY, beside: f64::INFINITY }; contestants.len()];
    for _ in 0..turns {
        for ((clock, &repeats), least) in contestants.iter_mut().zip(&repeats).zip(&mut least) {
            *least = least.least(clock(repeats));
        }
        turn_ends();
    }
    least.into_iter().map(Sample::solver).collect()
}

/// Time of a run that is repeated.
pub fn time(run: &mut dyn FnMut(), repeats: u32) -> Sample {
    let start = Instant::now();
    for _ in 0..repeats {
        run();
    }
    Sample { whole: start.elapsed().as_secs_f64() / f64::from(repeats), beside: 0.0 }
}
