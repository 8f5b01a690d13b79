//! Error against run time: every method with every setting, on the host and on microcontrollers, and what to use.

mod board;
mod callgrind;
mod choice;
mod host;
mod point;

pub use callgrind::is_counted;

use microimpact_scenes::methods::{ours, raw, regularised};

use crate::content::{Cell, Figure, Part, Run, Section, Table};
use crate::plot::{self, Line};
use point::{Entrant, Point, Series, Unit, front};

const INTRODUCTION: &str = "Every method solves the impact of Table 1 of Brach and Dunn (1995), along the normal alone or with friction and \
    spin. Errors are measured against a solution of 20 digits. Along the normal the error is that of e. With friction and \
    spin it is the largest of that error and those of tangential and peripheral velocity, relative to the faster of both \
    before the impact. With contact time and Hertz impulse it is the largest of all three, relative. A line joins those \
    settings of a method for which none of its other settings is better in both error and cost; the CSV file has all \
    settings. Crosses at the right edge are settings that did not converge, at their cost. An error below half a unit in \
    the last place of one is drawn at that half unit.";

const CONTESTANTS: &str = "This library's methods, the paper's Runge-Kutta-Gill and RK4 in time start from SI units. RK4 in time is the \
    classical Runge-Kutta method on equations B6 to B10 as they are printed. RK4 in z and the crates solve the \
    regularised equations in the contact radius, which are set up before. A crate that does not find events is given a \
    place shortly before each event and integrates the rest against the event's own variable; other entries find the \
    event on the dense output of a crate or by its own search. The crates take part in normal scenes only: friction and \
    spin are quadratures after the normal motion, so the comparison would be the same. RK4 in time and the crates do not \
    run in fixed point, which cannot hold SI units. In fixed point the groups of the scene are computed before.";

const INSTRUCTIONS: &str = "Instructions are not cycles: a division or a square root counts 1, and there are no wait states. The code for \
    Cortex-M0 runs on a larger board than the one with that core; this does not change a count.";

/// Whether the crate takes part that needs a newer compiler.
const DIFFSOL: &str = if cfg!(feature = "diffsol") {
    "The crate diffsol takes part, with its own search for events and without."
} else {
    "The crate diffsol, which takes minutes to build, takes part in \
     `cargo run --release --package report --features diffsol`."
};

/// Methods in the order of their colours, which they have in every figure.
const METHODS: [&str; 11] = [
    ours::FIXED_COST,
    ours::COLLOCATION,
    ours::ADAPTIVE,
    ours::PAPER,
    raw::NAME,
    regularised::NAME,
    "numeris",
    "multicalc",
    "ode_solvers",
    "differential-equations",
    "diffsol",
];

/// Where failures are drawn.
const FAILURE: f64 = 1.0;

/// The section.
pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let mut runners = host::runners(run);
    let times = host::times(run, &mut runners);
    drop(runners);
    let mut notes = Vec::new();
    let mut all = vec![times];
    if run.quick {
        notes.push("The quick run counts no instructions on the host.".to_owned());
    } else {
        match host::instructions(run, &all[0]) {
            Ok(series) => all.push(series),
            Err(why) => notes.push(format!("No instructions are counted on the host: {why}.")),
        }
    }
    let (boards, missing) = board::series(run)?;
    all.extend(boards);
    notes.extend(missing.into_iter().map(|why| format!("Without microcontrollers: {why}")));
    let (errors, scenes) = host::largest_errors(run);
    let everywhere: Vec<Series> = all.iter().map(|series| series.with_errors(&errors)).collect();

    let mut parts: Vec<Part> = [INTRODUCTION, CONTESTANTS, DIFFSOL, INSTRUCTIONS].map(text).into();
    parts.extend(notes.into_iter().map(Part::Text));
    parts.push(Part::Heading("What to use".to_owned()));
    let caption = format!(
        "Recommended method for each processor and error, with its cost: the cheapest of all methods, settings and number \
         types whose error does not exceed the one named in any of {scenes} scenes."
    );
    parts.push(Part::Table(choice::summary("cost-summary", caption, &everywhere)));
    for series in &all {
        parts.push(Part::Heading(format!("{}, {}", series.processor, series.cost())));
        parts.extend(figures(series, "")?);
    }
    parts.push(Part::Heading("Over many scenes".to_owned()));
    parts.push(Part::Text(format!(
        "The error in a single scene may be small by chance. The next figures have the same costs, but the largest error \
         over {scenes} scenes: the rebounds of the paper, of its figure 6 and of random scenes, with damping mild enough \
         for fixed point. A method that does not converge in one of them has failed."
    )));
    let elsewhere: Vec<Series> = shown_elsewhere(&all).map(|series| series.with_errors(&errors)).collect();
    for series in &elsewhere {
        parts.extend(figures(series, "over all scenes")?);
    }
    parts.push(Part::Heading("The cheapest of each number type".to_owned()));
    let caption = format!("From the largest errors over {scenes} scenes.");
    parts.push(Part::Table(choice::table("cost-choice-all-scenes", caption, &everywhere, None)));
    let caption = "From the errors on the scene of Table 1.";
    parts.push(Part::Table(choice::table("cost-choice", caption.to_owned(), &all, Some(&errors))));
    parts.push(Part::Heading("The API's default".to_owned()));
    parts.push(text("The default is Adaptive, with the required error as its tolerance."));
    parts.extend(everywhere.iter().filter_map(choice::sentence).map(Part::Text));
    parts.push(Part::Table(choice::comparison(&everywhere)));
    Ok(Section { title: "Error against run time", name: "cost", parts })
}

fn text(text: &str) -> Part {
    Part::Text(text.to_owned())
}

/// The series whose errors over many scenes are drawn: one for each unit.
fn shown_elsewhere(all: &[Series]) -> impl Iterator<Item = &Series> {
    let reference = all.iter().find(|series| series.processor == boards::REFERENCE_CORE);
    reference.or(all.first()).into_iter().chain(all.iter().find(|series| series.unit == Unit::Seconds))
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
        let points: Vec<&Point> = series
            .points
            .iter()
            .filter(|point| point.entrant.task == task && scalars.contains(&&*point.entrant.scalar))
            .collect();
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
            match METHODS.iter().position(|known| Some(*known) == method) {
                Some(place) if name == METHODS[place] => line.like(place),
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
        caption: format!("{title}: error against {}.", series.cost()),
        columns: ["method", "number type", "setting", "error", &series.cost()].map(str::to_owned).to_vec(),
        rows: points.iter().map(|point| row(point)).collect(),
    };
    let drawing = plot::log_log(&title, "error", &series.cost(), &drawn)?;
    Ok(Figure { drawing, data })
}

fn row(point: &Point) -> Vec<Cell> {
    let Entrant { method, scalar, setting, .. } = &point.entrant;
    vec![method.as_str().into(), scalar.as_str().into(), setting.as_str().into(), point.error.into(), point.cost.into()]
}

fn file_name(text: &str) -> String {
    let words = text.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}
