//! The contact of Table 1 by this library's methods and by other crates' solvers, at equal error.
//!
//! All are asked for e, contact time and Hertz impulse, but for `FixedCost`, which gives e alone. For each level of
//! error each entry is represented by the fastest of its settings whose errors all lie below the level; where none
//! does, its most exact one is shown. A setting may be lucky; that goes for all. Times are ratios to `Collocation` at
//! the same level, from turns that all contestants take.
//!
//! This library starts from SI units. The peers are given the [regularised equations] ready to solve. A peer without
//! events is told a place short of each event, at one of several distances, and takes the rest with the event's own
//! variable as the independent one (Henon 1982); or it is told a place behind the event and finds it on its dense
//! output. The peer diffsol takes part with `--features diffsol`.
//!
//! [regularised equations]: microimpact_scenes::methods::regularised

use contest::scene::solution;
use contest::table::compare;
use contest::{ours, peers};
use reference::case;

fn main() {
    let case = case("table1");
    let exact = solution(&case);
    let mut all = ours::normal(&case);
    all.extend(peers::all(ours::problem(&case)));
    println!("Table 1, normal motion\n{}\n", compare(all, &exact, ours::COLLOCATION));
    println!("Table 1 with friction and spin\n{}", compare(ours::oblique(&case), &exact, ours::COLLOCATION));
}
