//! By how much this library is ahead of the best peer in each place of the contest, or behind it.

use contest::contestant::Asked;
use contest::duel::{Duel, LEVELS};
use contest::place::{DAMPING, NEARNESS};
use contest::record::{self, asked_for};

use crate::content::{Cell, Figure, Table};
use crate::plot::{self, Axis, Line, Mark};

/// What the picture shows.
pub(super) const PLACES: &str = "The impacts of the first picture are that of Table 1; the same without adhesion and with another damping \
    d, the product of approach speed and damping constant; the same at a speed above the critical speed v_c by a fraction; and an \
    ensemble of many speeds and radii, solved one after another. Peers are heyoka, Boost.odeint, and for time and impulse also the \
    crates below. A setting counts if the error of every impact is at most the given one, with that setting and with the next tighter \
    ones of its method. Both sides take turns on one core. Calls from Python do not count.";

/// The picture, and the places where we are least ahead.
pub(super) fn picture() -> Result<(Figure, Table), String> {
    let (duels, machine) = record::stored()?;
    let mut names: Vec<String> = Vec::new();
    for duel in &duels {
        let name = name(duel);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let at = |duel: &Duel| {
        let row = names.iter().position(|known| *known == name(duel)).unwrap_or(0);
        (duel.factor, plot::height_of(row, names.len()))
    };
    let mut lines = Vec::new();
    for (place, level) in LEVELS.into_iter().enumerate() {
        for asked in [Asked::Restitution, Asked::Outputs] {
            let points = duels.iter().filter(|duel| duel.level == level && duel.asked == asked).map(at).collect();
            let line = Line::new(&format!("{level:.0e}, {}", asked_for(asked)), Mark::Points, points);
            lines.push(if asked == Asked::Restitution { line.like(place) } else { line.beside(place) });
        }
    }
    let axis = Axis::logarithmic("time of the best peer over ours", "", "1");
    let drawing = plot::rows(&names, &axis, 1.0, &lines)?;
    let columns = ["axis", "value", "error", "asked for", "ours", "best peer", "factor", "factor of Adaptive"];
    let table = |name: &str, caption: String, duels: &[&Duel]| Table {
        name: name.to_owned(),
        caption,
        columns: columns.map(str::to_owned).to_vec(),
        rows: duels.iter().map(|duel| row(duel)).collect(),
    };
    let mut sorted: Vec<&Duel> = duels.iter().collect();
    let data = table("cost-contest", sentence(&duels), &sorted);
    sorted.sort_by(|one, other| one.factor.total_cmp(&other.factor));
    sorted.truncate(LEAST);
    let caption = format!("Where we are least ahead of the best peer, or behind it. All measured on {machine}.");
    let least = table("cost-contest-least", caption, &sorted);
    Ok((Figure { title: "How far ahead of other solvers is it?".to_owned(), drawing, data }, least))
}

/// How many places the table shows.
const LEAST: usize = 10;

/// How the picture names a place.
fn name(duel: &Duel) -> String {
    match &*duel.axis {
        DAMPING => format!("d = {}", duel.value),
        NEARNESS => format!("v_c + {} %", 100.0 * duel.value),
        axis => axis.to_owned(),
    }
}

fn row(duel: &Duel) -> Vec<Cell> {
    vec![
        duel.axis.as_str().into(),
        duel.value.into(),
        duel.level.into(),
        asked_for(duel.asked).into(),
        format!("{}, {}", duel.ours.entry, duel.ours.setting).as_str().into(),
        format!("{}, {}", duel.peer.entry, duel.peer.setting).as_str().into(),
        duel.factor.into(),
        duel.adaptive.into(),
    ]
}

/// How far ahead, and how often behind.
fn sentence(duels: &[Duel]) -> String {
    let by_factor = |one: &&Duel, other: &&Duel| one.factor.total_cmp(&other.factor);
    let (Some(least), Some(most)) = (duels.iter().min_by(by_factor), duels.iter().max_by(by_factor)) else {
        return "No contest is stored.".to_owned();
    };
    let behind = duels.iter().filter(|duel| duel.factor < 1.0).count();
    format!(
        "At the same error, the best of heyoka, Boost.odeint and the crates takes {:.2} ({}) to {:.0} times ({}) as long as our best \
         method; in {behind} of {} comparisons a peer is faster.",
        least.factor,
        name(least),
        most.factor,
        name(most),
        duels.len()
    )
}

#[cfg(test)]
mod tests {
    use contest::duel::Winner;

    use super::*;

    fn duel(damping: f64, factor: f64) -> Duel {
        let winner = || Winner { entry: String::new(), setting: String::new() };
        let (ours, peer, asked) = (winner(), winner(), Asked::Outputs);
        Duel { axis: DAMPING.to_owned(), value: damping, level: 1e-6, asked, ours, peer, factor, adaptive: None }
    }

    #[test]
    fn the_sentence_says_where_a_peer_is_ahead() {
        let text = sentence(&[duel(0.5, 7.0), duel(14.0, 0.75), duel(44.0, 0.9)]);
        assert!(text.contains("0.75 (d = 14) to 7 times (d = 0.5)"), "{text}");
        assert!(text.ends_with("in 2 of 3 comparisons a peer is faster."), "{text}");
    }
}
