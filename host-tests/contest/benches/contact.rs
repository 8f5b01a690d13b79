//! The contact of Table 1 by this library's methods and by other crates' solvers, at equal error; with `--peers`, many contacts by this
//! library and by solvers in other languages.
//!
//! All are asked for e, contact time and Hertz impulse. For each level of error each entry is represented by the fastest of its
//! settings whose errors all lie below the level; where none does, its most exact one is shown. A setting may be lucky; that goes for
//! all. Times are ratios to `Collocation` at the same level, from turns that all contestants take.
//!
//! This library starts from SI units. The peers are given the [regularised equations] ready to solve. A peer without
//! events is told a place short of each event, at one of several distances, and takes the rest with the event's own
//! variable as the independent one (Henon 1982); or it is told a place behind the event and finds it on its dense
//! output. The peer diffsol takes part with `--features diffsol`.
//!
//! `--peers` lets Boost.odeint and heyoka take part, as far as they are installed, and adds [places] along axes: damping, nearness to the
//! critical speed, and an ensemble; each for several errors, for e alone and with outputs. There the factor is the time of the best
//! peer over that of our best method. `--peers --store` keeps the factors in `host-tests/data/contest.csv`, from which the report
//! draws its first picture.
//!
//! [regularised equations]: microimpact_scenes::methods::regularised
//! [places]: contest::place

use std::error::Error;
use std::rc::Rc;

use contest::contestant::Asked;
use contest::duel::{Duel, duels};
use contest::programs::{self, Program};
use contest::scene::solution;
use contest::table::{compare, factors, turns};
use contest::{ours, peers, place, record};
use reference::{Case, case};

fn main() -> Result<(), Box<dyn Error>> {
    let has = |flag: &str| std::env::args().any(|argument| argument == flag);
    let (programs, absent) = if has("--peers") { programs::installed() } else { Default::default() };
    for reason in &absent {
        println!("{reason}");
    }
    table_1(&case("table1"), &programs);
    if programs.is_empty() {
        return Ok(());
    }
    let mut all: Vec<Duel> = Vec::new();
    for place in place::all() {
        let new = duels(&place, &programs, turns());
        println!("\n{}", factors(new.iter()));
        all.extend(new);
    }
    if has("--store") {
        if !absent.is_empty() {
            return Err("nothing is stored: a peer is absent".into());
        }
        record::store(&all, &record::machine())?;
    }
    all.sort_by(|one, other| other.factor.total_cmp(&one.factor));
    let ten = all.len().saturating_sub(10);
    println!("\nWhere we are least ahead, or behind; the worst is the last\n{}", factors(all.iter().skip(ten)));
    Ok(())
}

fn table_1(case: &Case, programs: &[Program]) {
    let exact = solution(case);
    let problem = ours::problem(case);
    let mut all = ours::normal(case);
    all.extend(peers::all(problem));
    for program in programs {
        all.extend(program.contestants(&Rc::from([problem]), Asked::Outputs));
    }
    println!("Table 1, normal motion\n{}\n", compare(all, &exact, ours::COLLOCATION));
    println!("Table 1 with friction and spin\n{}", compare(ours::oblique(case), &exact, ours::COLLOCATION));
}
