//! Error against run time: every method with every setting, on the host and on microcontrollers, and what to use.

mod board;
mod choice;
mod contestants;
mod duels;
mod host;
mod lead;
mod point;

use crate::content::{Cell, Figure, Part, Run, Section, Table};
use crate::plot::{self, Axis, Line};
use contestants::METHODS;
use point::{Entrant, Point, Series, Unit, front};

const TASKS: &str = "Every method solves the impact of Table 1 of Brach and Dunn (1995), along the normal alone or with friction and \
    spin. Along the normal the error is that of e. With friction and spin it is the largest of that error and those of \
    tangential and peripheral velocity, relative to the faster of both before the impact. With contact time and impulse it is \
    the largest of all three, relative. Errors are measured against a solution of 20 digits; an error below half a unit in the \
    last place of one is drawn at that half unit.";

const LINES: &str = "A line joins those settings of a method for which none of its other settings is better in both error and \
    cost; the CSV file has all settings. Crosses at the right edge are settings that did not converge, at their cost.";

const INSTRUCTIONS: &str = "Boards are emulated, so their cost is counted in instructions. These are not cycles: a division or a \
    square root counts 1, and there are no wait states. The code for Cortex-M0 runs on a larger board than the one with that core; \
    this does not change a count.";

/// Where failures are drawn.
const FAILURE: f64 = 1.0;

/// The section.
pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let mut runners = host::runners(run);
    let times = host::times(run, &mut runners);
    drop(runners);
    let measured = if run.quick { None } else { Some(board::measured(run)) };
    let (boards, left_out) = match measured {
        Some(Ok(boards)) => (boards, None),
        Some(Err(why)) => (board::stored()?, Some(format!("a new count on boards (theirs are stored): {why}"))),
        None => (board::stored()?, Some("a new count on boards (theirs are stored)".to_owned())),
    };
    let all: Vec<Series> = [times].into_iter().chain(boards).collect();
    let (errors, scenes) = host::largest_errors(run);
    let everywhere: Vec<Series> = all.iter().map(|series| series.with_errors(&errors)).collect();

    let (lead, least) = duels::picture()?;
    let (cores, ratios) = lead::picture(&all)?;
    let caption = format!(
        "What to use: for each processor and error, the cheapest of all methods, settings and number types whose error does not \
         exceed it in any of {scenes} scenes, with its cost."
    );
    // The last figure of the first series has all crates: it is shown, the others are folded.
    let mut folded = all.iter().map(|series| figures(series, "")).collect::<Result<Vec<_>, _>>()?;
    let shown = folded.first_mut().and_then(Vec::pop);
    let mut parts = vec![Part::Table(least), Part::Table(contestants::table())];
    parts.extend(shown);
    parts.push(Part::Fold(
        "The impact of Table 1 on each core, against the crates".to_owned(),
        vec![Part::Figure(cores), Part::Table(ratios)],
    ));
    parts.push(Part::Fold(
        "What to use for which error".to_owned(),
        vec![
            Part::Table(choice::summary("cost-summary", caption, &everywhere)),
            Part::Table(choice::table(
                "cost-choice-all-scenes",
                format!("The cheapest of each number type, by the largest errors over {scenes} scenes."),
                &everywhere,
                None,
            )),
            Part::Table(choice::table(
                "cost-choice",
                "The cheapest of each number type, by the errors on the scene of Table 1.".to_owned(),
                &all,
                Some(&errors),
            )),
        ],
    ));
    for (series, figures) in all.iter().zip(folded) {
        let name = if series.unit == Unit::Seconds { "this computer" } else { &series.processor };
        parts.push(Part::Fold(format!("Every method and setting on {name}"), figures));
    }
    let mut over_scenes = vec![Part::Text(format!(
        "The error in a single scene may be small by chance. These figures have the same costs, but the largest error \
         over {scenes} scenes: the rebounds of the paper, of its figure 6 and of random scenes, with damping mild enough \
         for fixed point. A method that does not converge in one of them has failed."
    ))];
    let reference = everywhere.iter().find(|series| series.processor == boards::REFERENCE_CORE);
    for series in everywhere.iter().take(1).chain(reference) {
        over_scenes.extend(figures(series, "over all scenes")?);
    }
    parts.push(Part::Fold(format!("Every method and setting over {scenes} scenes"), over_scenes));
    let method = [duels::PLACES, TASKS, LINES, contestants::RULES, contestants::DIFFSOL, INSTRUCTIONS];
    parts.push(Part::Fold("How it is measured".to_owned(), method.map(|text| Part::Text(text.to_owned())).into()));
    Ok(Section { title: "Error against time", name: "cost", lead: Some(lead), left_out, parts })
}

/// Measures the boards, and stores their figures.
pub(crate) fn store_boards(run: &Run) -> Result<(), String> {
    board::store(&board::measured(run)?)
}

/// A figure for each task and number type; a number type with few methods is drawn with another.
fn figures(series: &Series, errors: &str) -> Result<Vec<Part>, String> {
    let panels = [
        ("normal", &["f32", "fixed point"][..]),
        ("normal", &["f64"]),
        ("oblique", &["f32"]),
        ("oblique", &["f64"]),
        (host::OUTPUTS, &["f64", "f32"]),
    ];
    let mut figures = Vec::new();
    for (task, scalars) in panels {
        let of_panel = |point: &&Point| point.entrant.task == task && scalars.contains(&&*point.entrant.scalar);
        let points: Vec<&Point> = series.points.iter().filter(of_panel).collect();
        if !points.is_empty() {
            figures.push(Part::Figure(figure(series, errors, task, scalars, &points)?));
        }
    }
    Ok(figures)
}

fn figure(series: &Series, errors: &str, task: &str, scalars: &[&str], points: &[&Point]) -> Result<Figure, String> {
    let mut lines: Vec<(String, Vec<&Point>)> = Vec::new();
    for point in points {
        let Entrant { method, scalar, .. } = &point.entrant;
        let name = if scalar == scalars[0] { method.clone() } else { format!("{method}, {scalar}") };
        match lines.iter_mut().find(|(known, _)| *known == name) {
            Some((_, points)) => points.push(point),
            None => lines.push((name, vec![point])),
        }
    }
    let drawn: Vec<Line> = lines
        .iter()
        .map(|(name, points)| {
            let place = |point: &Point| point.error.map(|error| (error, point.cost));
            let solved = front(points.iter().copied()).into_iter().filter_map(place).collect();
            let failed = points.iter().filter(|point| point.error.is_none()).map(|point| (FAILURE, point.cost));
            let line = Line::settings(name, solved, failed.collect());
            let method = points.first().map(|point| &*point.entrant.method);
            match METHODS.iter().position(|known| Some(known.name) == method) {
                Some(place) if name == METHODS[place].name => line.like(place),
                Some(place) => line.beside(place),
                None => line,
            }
        })
        .collect();
    let comma = if errors.is_empty() { "" } else { ", " };
    let title = format!("{}: {task}, {}{comma}{errors}", series.processor, scalars.join(" and "));
    let name = ["cost", &series.processor, series.unit.name(), task, scalars[0], errors];
    let data = Table {
        name: name.iter().filter(|part| !part.is_empty()).map(|part| file_name(part)).collect::<Vec<_>>().join("-"),
        caption: String::new(),
        columns: ["method", "number type", "setting", "error", &series.cost()].map(str::to_owned).to_vec(),
        rows: points.iter().map(|point| row(point)).collect(),
    };
    let y = match series.unit {
        Unit::Instructions => Axis::logarithmic("instructions", "N", "1"),
        Unit::Seconds => Axis::logarithmic("least time", "t", "s"),
    };
    Ok(Figure { title, drawing: plot::chart(&Axis::logarithmic("error", "ε", "1"), &y, &drawn)?, data })
}

fn row(point: &Point) -> Vec<Cell> {
    let Entrant { method, scalar, setting, .. } = &point.entrant;
    vec![method.as_str().into(), scalar.as_str().into(), setting.as_str().into(), point.error.into(), point.cost.into()]
}

fn file_name(text: &str) -> String {
    let words = text.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}
