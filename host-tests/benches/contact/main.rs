//! The contact of Table 1 by this library's methods and by other crates' solvers, at equal error.
//!
//! All are asked for e, contact time and Hertz impulse, but for `FixedCost`, which gives e alone. For each level of error each
//! entry is represented by the fastest of its settings whose errors all lie below the level; where none does, its most exact
//! one is shown. Times are ratios to `Collocation` at the same level, from rounds that visit all contestants.
//!
//! The peers are given the [regularised equations](regularised), in units in which no quantity is large, and need not
//! convert their results. A peer without events is told a place short of each event, at one of several distances, and takes
//! the rest with the event's own variable as the independent one (Henon's trick); or it is told a place behind the event and
//! finds it on its dense output. The peer diffsol takes part with `--features diffsol`.

mod contestant;
mod ours;
mod peers;
#[path = "../race/mod.rs"]
mod race;
mod regularised;

use std::hint::black_box;

use comfy_table::{CellAlignment, Table, presets};
use contestant::{Answer, Contestant};
use host_tests::{Case, cases};

const LEVELS: [f64; 3] = [1e-6, 1e-9, 1e-12];

fn main() {
    let case = cases().into_iter().find(|case| case.text("name") == "table1").expect("the reference has Table 1");
    let mut all = ours::normal(&case);
    all.extend(peers::all(&case));
    println!("Table 1, normal motion\n{}\n", compare(all, &case));
    println!("Table 1 with friction and spin\n{}", compare(ours::oblique(&case), &case));
}

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

/// The table of all entries at each level of error.
fn compare(contestants: Vec<Contestant>, case: &Case) -> Table {
    let all = perform(contestants, case);
    let mut entries: Vec<&str> = Vec::new();
    for performance in &all {
        if !entries.contains(&performance.contestant.entry) {
            entries.push(performance.contestant.entry);
        }
    }
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
        let ours = best(ours::COLLOCATION).time;
        for one in entries.iter().copied().map(best) {
            let error = |error: Option<f64>| error.map_or(String::from("-"), |error| format!("{error:.0e}"));
            let missed = if one.largest > level { ", missed" } else { "" };
            table.add_row([
                format!("{level:.0e}{missed}"),
                one.contestant.entry.into(),
                one.contestant.method.clone(),
                one.contestant.setting.clone(),
                error(one.errors[0]),
                error(one.errors[1]),
                error(one.errors[2]),
                format!("{:.2}", one.time / ours),
                format!("{:.2}", 1e6 * one.time),
                one.answer.effort.map_or(String::from("-"), |(count, what)| format!("{count} {what}")),
            ]);
        }
    }
    for column in table.column_iter_mut().skip(4).take(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Errors and times of all contestants that solve the contact.
fn perform(contestants: Vec<Contestant>, case: &Case) -> Vec<Performance> {
    let mut all = Vec::new();
    for mut contestant in contestants {
        let Some(answer) = (contestant.run)() else { continue };
        let errors = answer.errors(case);
        let largest = errors.iter().flatten().copied().fold(0.0, f64::max);
        if errors.iter().flatten().all(|error| error.is_finite()) {
            all.push(Performance { contestant, answer, errors, largest, time: 0.0 });
        }
    }
    let mut runs: Vec<_> = all.iter_mut().map(|one| || _ = black_box((one.contestant.run)())).collect();
    let mut runs: Vec<&mut dyn FnMut()> = runs.iter_mut().map(|run| run as _).collect();
    let times = race::least_times(&mut runs);
    for (one, time) in all.iter_mut().zip(times) {
        one.time = time;
    }
    all
}

/// The fastest whose errors lie below the level, or else the most exact.
fn best<'a>(all: impl Iterator<Item = &'a Performance> + Clone, level: f64) -> &'a Performance {
    let fastest = all.clone().filter(|one| one.largest <= level).min_by(|a, b| a.time.total_cmp(&b.time));
    fastest.or_else(|| all.min_by(|a, b| a.largest.total_cmp(&b.largest))).expect("every entry solves the contact")
}
