//! Who is how fast at which error.

use comfy_table::{CellAlignment, ColumnConstraint, Table, presets};

use super::contestant::{Answer, Contestant};
use super::duel::{Duel, Winner};
use super::race::{Sample, least_samples};
use super::record::asked_for;

/// Turns of each contestant.
const TURNS: u32 = 50;

const LEVELS: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// What a contestant reached.
struct Performance {
    contestant: Contestant,
    answer: Answer,
    /// Error of e, and relative errors of contact time and impulse.
    errors: [Option<f64>; 3],
    largest: f64,
    /// s
    time: f64,
}

/// The fastest setting of each entry at each level of error, with times as ratios to that of the entry `standard`.
///
/// A setting counts where all of its errors lie below the level. Where none does, the most exact is shown as missed.
pub fn compare(contestants: Vec<Contestant>, exact: &Answer, standard: &str) -> Table {
    let mut entries: Vec<&str> = Vec::new();
    for contestant in &contestants {
        if !entries.contains(&contestant.entry) {
            entries.push(contestant.entry);
        }
    }
    let all = perform(contestants, exact);
    let mut table = Table::new();
    table.load_preset(presets::ASCII_MARKDOWN);
    table.set_header([
        "error",
        "entry",
        "method",
        "setting",
        "error of e",
        "of time",
        "of impulse",
        "time, ratio",
        "time, us",
        "effort",
    ]);
    for level in LEVELS {
        let best = |entry| best(all.iter().filter(|one| one.contestant.entry == entry), level);
        let Some(standard) = best(standard).map(|one| one.time) else { continue };
        for &entry in &entries {
            let Some(one) = best(entry) else {
                table.add_row([&format!("{level:.0e}, missed"), entry, "no setting solves it"]);
                continue;
            };
            let error = |error: Option<f64>| error.map_or(String::from("-"), |error| format!("{error:.0e}"));
            let missed = if one.largest > level { ", missed" } else { "" };
            table.add_row([
                format!("{level:.0e}{missed}"),
                entry.into(),
                one.contestant.method.clone(),
                one.contestant.setting.clone(),
                error(one.errors[0]),
                error(one.errors[1]),
                error(one.errors[2]),
                format!("{:.2}", one.time / standard),
                format!("{:.2}", 1e6 * one.time),
                one.answer.effort.map_or(String::from("-"), |(count, what)| format!("{count} {what}")),
            ]);
        }
    }
    for column in table.column_iter_mut().skip(4).take(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    if exact.impulse.is_none() {
        table.column_mut(6).expect("the impulse has a column").set_constraint(ColumnConstraint::Hidden);
    }
    table
}

/// By how much we are ahead in places.
pub fn factors<'a>(duels: impl Iterator<Item = &'a Duel>) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::ASCII_MARKDOWN);
    table.set_header(["place", "error", "asked for", "ours", "best peer", "factor", "of Adaptive"]);
    for duel in duels {
        let value = if duel.value == 0.0 { String::new() } else { format!(" {}", duel.value) };
        let who = |winner: &Winner| format!("{}, {}", winner.entry, winner.setting);
        table.add_row([
            format!("{}{value}", duel.axis),
            format!("{:.0e}", duel.level),
            asked_for(duel.asked).to_owned(),
            who(&duel.ours),
            who(&duel.peer),
            format!("{:.2}", duel.factor),
            duel.adaptive.map_or(String::from("-"), |factor| format!("{factor:.2}")),
        ]);
    }
    for column in table.column_iter_mut().skip(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Turns of each contestant. Cargo names its purpose: a benchmark that is only tested takes one.
pub fn turns() -> u32 {
    if std::env::args().any(|argument| argument == "--bench") { TURNS } else { 1 }
}

/// Errors and times of all contestants that solve the contact.
fn perform(contestants: Vec<Contestant>, exact: &Answer) -> Vec<Performance> {
    let mut all = Vec::new();
    for mut contestant in contestants {
        let Some(answer) = contestant.answer() else { continue };
        let errors = answer.errors(exact);
        let largest = errors.iter().flatten().copied().fold(0.0, f64::max);
        if errors.iter().flatten().all(|error| error.is_finite()) {
            all.push(Performance { contestant, answer, errors, largest, time: 0.0 });
        }
    }
    let mut clocks: Vec<_> = all.iter_mut().map(|one| |repeats| one.contestant.solver.time(repeats)).collect();
    let mut clocks: Vec<&mut dyn FnMut(u32) -> Sample> = clocks.iter_mut().map(|clock| clock as _).collect();
    let times = least_samples(&mut clocks, turns(), || ());
    for (one, time) in all.iter_mut().zip(times) {
        one.time = time;
    }
    all
}

/// The fastest whose errors lie below the level, or else the most exact.
fn best<'a>(all: impl Iterator<Item = &'a Performance> + Clone, level: f64) -> Option<&'a Performance> {
    let fastest = all.clone().filter(|one| one.largest <= level).min_by(|a, b| a.time.total_cmp(&b.time));
    fastest.or_else(|| all.min_by(|a, b| a.largest.total_cmp(&b.largest)))
}
