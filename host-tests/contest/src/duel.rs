//! By how much this library is ahead of the best peer in a place, or behind it, at equal error.

use std::rc::Rc;

use crate::contestant::{Answer, Asked, Contestant};
use crate::place::{ENSEMBLE, Place};
use crate::problem::Problem;
use crate::programs::Program;
use crate::race::{Sample, least_samples};
use crate::{lanes, ours, peers};

/// Errors at which they meet.
pub const LEVELS: [f64; 4] = [1e-4, 1e-6, 1e-9, 1e-12];

/// A setting counts where as many tighter ones of its method reach the level too: then it does not by luck with its error.
const CONFIRMATIONS: usize = 2;

/// Settings of a method that are timed for each level: the loosest that reaches it is not always the fastest.
const TIMED: usize = 2;

/// A setting that takes so many times as long as another in one run is not timed again: it cannot be the fastest, however much other
/// work there is on the machine.
const HOPELESS: f64 = 10.0;

/// The fastest of both sides in a place.
pub struct Duel {
    /// Axis of the place.
    pub axis: String,
    /// Where on the axis.
    pub value: f64,
    /// Bound of the error.
    pub level: f64,
    /// What both are asked for.
    pub asked: Asked,
    /// Method and setting of this library.
    pub ours: Winner,
    /// The same of the peers.
    pub peer: Winner,
    /// Time of the best peer over that of our best.
    pub factor: f64,
    /// The same over that of `Adaptive`; `None` where it does not reach the level.
    pub adaptive: Option<f64>,
}

/// Who is the fastest.
#[derive(Clone)]
pub struct Winner {
    /// Method of this library, or a peer.
    pub entry: String,
    /// Its algorithm and setting.
    pub setting: String,
}

/// A contestant, and what it reached.
struct Tried {
    contestant: Contestant,
    is_ours: bool,
    /// The largest error over all impacts.
    error: f64,
    /// Whether it reaches each level, and so do tighter settings.
    reaches: [bool; LEVELS.len()],
    /// s
    time: f64,
}

/// The duels in a place, for e alone and with contact time and impulse, from so many turns of all contestants. A level that one side
/// does not reach has none.
pub fn duels(place: &Place, programs: &[Program], turns: u32) -> Vec<Duel> {
    [Asked::Restitution, Asked::Outputs]
        .into_iter()
        .flat_map(|asked| duels_for(place, programs, asked, turns))
        .collect()
}

fn duels_for(place: &Place, programs: &[Program], asked: Asked, turns: u32) -> Vec<Duel> {
    let mut ours = ours::in_turn(&place.cases, asked);
    if place.axis == ENSEMBLE {
        ours.extend(lanes::contestants(&place.cases, asked));
    }
    let problems: Rc<[Problem]> = place.cases.iter().map(ours::problem).collect();
    let mut others: Vec<Contestant> = Vec::new();
    // The crates are asked for outputs, and for one impact.
    if let (&[problem], Asked::Outputs) = (&*problems, asked) {
        others.extend(peers::all(problem));
    }
    for program in programs {
        others.extend(program.contestants(&problems, asked));
    }
    let mut all = tried(ours, true, place, asked);
    all.extend(tried(others, false, place, asked));
    all.retain(|one| one.reaches.contains(&true));
    only_loosest(&mut all);
    only_fast(&mut all);

    let mut clocks: Vec<_> = all.iter_mut().map(|one| |repeats| one.contestant.solver.time(repeats)).collect();
    let mut clocks: Vec<&mut dyn FnMut(u32) -> Sample> = clocks.iter_mut().map(|clock| clock as _).collect();
    let times = least_samples(&mut clocks, turns, || ());
    for (one, time) in all.iter_mut().zip(times) {
        one.time = time;
    }
    let title = |entry: &str| programs.iter().map(Program::title).find(|title| title.starts_with(entry));
    let duel = |index: usize| {
        let fastest = |counts: &dyn Fn(&&Tried) -> bool| {
            let reach = all.iter().filter(|one| one.reaches[index]).filter(counts);
            reach.min_by(|a, b| a.time.total_cmp(&b.time))
        };
        let (ours, peer) = (fastest(&|one| one.is_ours)?, fastest(&|one| !one.is_ours)?);
        let adaptive = fastest(&|one| one.contestant.entry == ours::ADAPTIVE);
        let winner = |one: &Tried| Winner {
            entry: title(one.contestant.entry).unwrap_or_else(|| one.contestant.entry.to_owned()),
            setting: format!("{}, {}", one.contestant.method, one.contestant.setting)
                .trim_start_matches(", ")
                .to_owned(),
        };
        Some(Duel {
            axis: place.axis.to_owned(),
            value: place.value,
            level: LEVELS[index],
            asked,
            ours: winner(ours),
            peer: winner(peer),
            factor: peer.time / ours.time,
            adaptive: adaptive.map(|adaptive| peer.time / adaptive.time),
        })
    };
    (0..LEVELS.len()).filter_map(duel).collect()
}

/// Solves the impacts of a place by all contestants.
fn tried(contestants: Vec<Contestant>, is_ours: bool, place: &Place, asked: Asked) -> Vec<Tried> {
    let largest = |answers: Vec<Answer>| {
        let errors = answers.iter().zip(&place.exact).flat_map(|(answer, exact)| {
            let [restitution, time, impulse] = answer.errors(exact).map(|error| error.unwrap_or(f64::INFINITY));
            match asked {
                Asked::Restitution => [restitution; 3],
                Asked::Outputs => [restitution, time, impulse],
            }
        });
        errors.fold(0.0, f64::max)
    };
    let attempt = |mut contestant: Contestant| {
        let error = contestant.answers().map(largest).filter(|error| error.is_finite())?;
        Some(Tried { contestant, is_ours, error, reaches: Default::default(), time: f64::INFINITY })
    };
    let mut all: Vec<Tried> = contestants.into_iter().filter_map(attempt).collect();
    for method in all.chunk_by_mut(same_method) {
        let errors: Vec<f64> = method.iter().map(|one| one.error).collect();
        for (first, one) in method.iter_mut().enumerate() {
            let error = confirmed(&errors[first..]);
            one.reaches = LEVELS.map(|level| error <= level);
        }
    }
    all
}

/// The error that a setting and the next tighter ones all reach.
fn confirmed(errors: &[f64]) -> f64 {
    errors.iter().take(1 + CONFIRMATIONS).copied().fold(0.0, f64::max)
}

/// Settings follow each other from loose to tight.
fn same_method(one: &Tried, next: &Tried) -> bool {
    one.contestant.entry == next.contestant.entry && one.contestant.method == next.contestant.method
}

/// Leaves those that are the loosest of their method for a level.
fn only_loosest(all: &mut Vec<Tried>) {
    let mut kept = Vec::new();
    for method in all.chunk_by(same_method) {
        for one in method {
            let looser = &method[..method.iter().position(|other| std::ptr::eq(one, other)).unwrap_or(0)];
            let is_first =
                |index: usize| one.reaches[index] && looser.iter().filter(|other| other.reaches[index]).count() < TIMED;
            kept.push((0..LEVELS.len()).any(is_first));
        }
    }
    let mut kept = kept.into_iter();
    all.retain(|_| kept.next() == Some(true));
}

/// Leaves those that may be the fastest of their side for a level, as far as one run shows.
fn only_fast(all: &mut Vec<Tried>) {
    for one in all.iter_mut() {
        one.contestant.solver.time(1);
        one.time = one.contestant.solver.time(1).solver();
    }
    let fastest = [true, false].map(|is_ours| {
        let side = || all.iter().filter(move |one| one.is_ours == is_ours);
        std::array::from_fn::<f64, { LEVELS.len() }, _>(|index| {
            side().filter(|one| one.reaches[index]).map(|one| one.time).fold(f64::INFINITY, f64::min)
        })
    });
    let may_win = |one: &Tried| {
        let fastest = &fastest[usize::from(!one.is_ours)];
        one.reaches.iter().zip(fastest).any(|(reaches, fastest)| *reaches && one.time < HOPELESS * fastest)
    };
    // The times of `Adaptive` are shown in any case.
    all.retain(|one| one.contestant.entry == ours::ADAPTIVE || may_win(one));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lucky_setting_does_not_count() {
        let errors = [1e-3, 1e-9, 1e-5, 1e-6, 1e-8, 1e-7];
        let confirmed: Vec<f64> = (0..errors.len()).map(|first| confirmed(&errors[first..])).collect();
        assert_eq!(confirmed, [1e-3, 1e-5, 1e-5, 1e-6, 1e-7, 1e-7]);
    }
}
