//! The recommended method for each processor and error, with the cost of `Adaptive` over it.

use std::collections::{BTreeSet, HashMap};

use microimpact_scenes::methods::ours::ADAPTIVE;

use super::point::{Entrant, Point, Series, Unit, cheapest};
use crate::content::{Cell, Table};

/// Exponents of the errors asked for.
const LEVELS: std::ops::RangeInclusive<i32> = 3..=12;
/// Those of the summary.
const SUMMARY: [i32; 6] = [3, 4, 5, 6, 9, 12];

/// The cheapest entrant of a series for one task, number type and range of errors.
struct Choice<'a> {
    series: &'a Series,
    /// Exponents of the smallest and the largest error that it is the choice for.
    levels: (i32, i32),
    point: &'a Point,
}

/// Tasks and number types in the order of their points.
fn groups(series: &Series) -> Vec<(&str, &str)> {
    let mut groups = Vec::new();
    for point in &series.points {
        let group = (&*point.entrant.task, &*point.entrant.scalar);
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    groups
}

fn of<'a>(series: &'a Series, (task, scalar): (&'a str, &'a str)) -> impl Iterator<Item = &'a Point> + Clone {
    series.points.iter().filter(move |point| point.entrant.task == task && point.entrant.scalar == scalar)
}

fn choices(all: &[Series]) -> Vec<Choice<'_>> {
    let mut choices: Vec<Choice<'_>> = Vec::new();
    for series in all {
        for group in groups(series) {
            let begin = choices.len();
            for level in LEVELS {
                let Some(point) = cheapest(of(series, group), 10f64.powi(-level)) else { break };
                match choices[begin..].last_mut() {
                    Some(last) if last.point.entrant == point.entrant => last.levels.1 = level,
                    _ => choices.push(Choice { series, levels: (level, level), point }),
                }
            }
        }
    }
    choices
}

/// The cheapest of all number types for each task of the first series and some errors, a column for each series.
pub(super) fn summary(name: &str, caption: String, all: &[Series]) -> Table {
    let tasks: BTreeSet<&str> = all.first().into_iter().flat_map(groups).map(|(task, _)| task).collect();
    let cell = |series: &Series, task: &str, level: f64| {
        let of_task = series.points.iter().filter(|point| point.entrant.task == task);
        let Some(Point { entrant, cost, .. }) = cheapest(of_task, level) else { return Cell::from("none") };
        let cost = match series.unit {
            Unit::Instructions => format!("{cost:.0}"),
            Unit::Seconds => format!("{:.2} µs", 1e6 * cost),
        };
        Cell::Text(format!("{cost}: {}, {}, {}", entrant.method, entrant.setting, entrant.scalar))
    };
    let heading = |series: &Series| match series.unit {
        Unit::Instructions => format!("{}, instructions", series.processor),
        Unit::Seconds => format!("{}, least time", series.processor),
    };
    let row = |task: &str, level: i32| {
        let level = 10f64.powi(-level);
        let cells = all.iter().map(|series| cell(series, task, level));
        [Cell::from(task), Cell::from(level)].into_iter().chain(cells).collect()
    };
    let columns = ["asked for", "error"].map(str::to_owned).into_iter();
    Table {
        name: name.to_owned(),
        caption,
        columns: columns.chain(all.iter().map(heading)).collect(),
        rows: tasks.iter().flat_map(|task| SUMMARY.map(|level| row(task, level))).collect(),
    }
}

/// The table of choices; `elsewhere` holds the largest errors over other scenes.
pub(super) fn table(
    name: &str,
    caption: String,
    all: &[Series],
    elsewhere: Option<&HashMap<Entrant, Option<f64>>>,
) -> Table {
    let mut columns: Vec<String> = [
        "processor",
        "number type",
        "asked for",
        "error from",
        "error to",
        "method",
        "setting",
        "its error",
        "cost",
        "unit",
        "Adaptive, cost ratio",
    ]
    .map(str::to_owned)
    .to_vec();
    if elsewhere.is_some() {
        columns.push("largest error over the scenes".to_owned());
    }
    let rows = choices(all).into_iter().map(|Choice { series, levels, point }| {
        let Entrant { task, scalar, method, setting } = &point.entrant;
        let group = (&**task, &**scalar);
        let ratio = cheapest(of(series, group).filter(|point| point.entrant.method == ADAPTIVE), 10f64.powi(-levels.1));
        let mut row: Vec<Cell> = vec![
            series.processor.as_str().into(),
            scalar.as_str().into(),
            task.as_str().into(),
            10f64.powi(-levels.0).into(),
            10f64.powi(-levels.1).into(),
            method.as_str().into(),
            setting.as_str().into(),
            point.error.into(),
            point.cost.into(),
            series.unit.name().into(),
            ratio.map(|adaptive| adaptive.cost / point.cost).into(),
        ];
        if let Some(errors) = elsewhere {
            row.push(errors.get(&point.entrant).copied().flatten().into());
        }
        row
    });
    Table { name: name.to_owned(), caption, rows: rows.collect(), columns }
}
