//! The picture of all that is tried on stiff and extreme scenes: error against damping, with the bound of each method.

use super::maps::{Map, count};
use super::trial::{Assessment, Method, Point, ROUNDING};
use crate::content::{Cell, Figure, Table};
use crate::plot::{self, Axis, Line, Mark};

/// The damping of the picture; stronger or weaker is drawn at its ends.
const DAMPING: (f64, f64) = (1e-6, 1e6);
/// Dots of one method that lie in one of so many fields of a decade are one: more cannot be seen.
const FIELDS: f64 = 6.0;

/// The methods drawn, ours on top.
const DRAWN: [Method; 4] = [Method::Paper, Method::Fixed, Method::Single, Method::Double];

/// Those of this library that bound their error.
const OURS: [Method; 3] = [Method::Double, Method::Single, Method::Fixed];

/// Where a method is on a point: the stronger damping, and the error; 1 where it fails without one.
fn place(point: &Point, method: Method) -> Option<(f64, f64)> {
    let trial = point.trial(method);
    let error = match trial.error {
        Some(error) if error.is_finite() => error.clamp(ROUNDING, 1.0),
        _ if trial.assessment.fails() => 1.0,
        _ => return None,
    };
    Some((point.damping?.clamp(DAMPING.0, DAMPING.1), error))
}

/// One of each field of the picture.
fn thinned(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let field = |at: f64| (FIELDS * at.log10()).round() as i32;
    let fields: std::collections::BTreeSet<_> = points.map(|(x, y)| (field(x), field(y))).collect();
    let back = |field: i32| 10_f64.powf(f64::from(field) / FIELDS);
    fields.into_iter().map(|(x, y)| (back(x), back(y))).collect()
}

/// The picture, and the table of counts.
pub(super) fn picture(maps: &[Map]) -> Result<(Figure, Table), String> {
    let points = || maps.iter().flat_map(Map::points);
    let (mut lines, mut bounds, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for method in DRAWN {
        // Ours have the first colours.
        let colour = method as usize;
        let places = || points().filter_map(move |point| place(point, method));
        rows.extend(places().map(|at| vec![method.name().into(), at.0.into(), at.1.into()]));
        lines.push(Line::new(method.name(), Mark::Dots, thinned(places())).like(colour));
        let ends = [DAMPING.0, DAMPING.1].map(|damping| (damping, method.bound()));
        bounds.push(Line::new("", Mark::Dashed, ends.to_vec()).like(colour));
    }
    lines.extend(bounds);
    let x = Axis::logarithmic("stronger damping", "max(h, g)", "1").between(DAMPING.0, DAMPING.1);
    let y = Axis::logarithmic("error", "ε", "1").between(0.5 * ROUNDING, 2.0);
    let figure = Figure {
        title: "How often is an answer wrong?".to_owned(),
        drawing: plot::tall_chart(&x, &y, &lines)?,
        data: Table {
            name: "stability-lead".to_owned(),
            caption: sentence(maps),
            columns: ["method", "stronger damping", "error"].map(str::to_owned).to_vec(),
            rows,
        },
    };
    Ok((figure, counts(maps)))
}

/// How many answers lie beyond their bounds.
fn sentence(maps: &[Map]) -> String {
    let points = || maps.iter().flat_map(Map::points);
    let beyond = |methods: &[Method]| {
        let trials = || points().flat_map(|point| methods.iter().map(|method| point.trial(*method)));
        let tried = trials().filter(|trial| trial.assessment.applies()).count();
        (tried, trials().filter(|trial| trial.assessment.fails()).count())
    };
    let scenes = points().filter(|point| point.restitution.is_some()).count();
    let (tried, ours) = beyond(&OURS);
    let (by_paper, paper) = beyond(&[Method::Paper]);
    let undecided = points().flat_map(|point| OURS.map(|method| point.trial(method)));
    let undecided = undecided.filter(|trial| trial.assessment == Assessment::Undecided).count();
    format!(
        "On {scenes} stiff and extreme scenes, {ours} of our {tried} answers lie beyond their bound (dashed line), and {undecided} say \
         that they are undecided. Of the paper's method {paper} of {by_paper} lie beyond 0.001, a limit set here; those at the top failed."
    )
}

/// A row for each method: how many points there are, and the largest error and number of steps.
fn counts(maps: &[Map]) -> Table {
    let row = |method: Method| {
        let trials = || maps.iter().flat_map(Map::points).map(move |point| point.trial(method));
        let applies = trials().filter(|trial| trial.assessment.applies()).count();
        let fails = trials().filter(|trial| trial.assessment.fails()).count();
        vec![
            Cell::from(method.name()),
            Cell::from(method.text()),
            Cell::Count(applies as u64),
            Cell::Count((trials().count() - applies) as u64),
            Cell::from(method.bound()),
            Cell::Count(fails as u64),
            Cell::Count(trials().filter(|trial| trial.assessment == Assessment::Undecided).count() as u64),
            Cell::from(trials().filter_map(|trial| trial.error).reduce(f64::max)),
            count(trials().filter_map(|trial| trial.steps).max()),
        ]
    };
    let columns = [
        "number type",
        "method",
        "answers",
        "refused",
        "bound of ε",
        "beyond it",
        "undecided",
        "largest ε",
        "most intervals",
    ];
    Table {
        name: "stability-bounds".to_owned(),
        caption: "Answers within and beyond their bounds, over all maps. A refusal is an input outside the range of the library or of \
                  fixed point, or damping too strong for a fixed cost."
            .to_owned(),
        columns: columns.map(str::to_owned).to_vec(),
        rows: Method::ALL.map(row).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_dot_stands_for_its_field() {
        let points = [(1.0, 1e-12), (1.01, 1.01e-12), (100.0, 1e-12), (1.0, 1e-3)];
        let thinned = thinned(points.into_iter());
        assert_eq!(thinned.len(), 3);
        assert!(thinned.iter().all(|at| points.iter().any(|point| (at.0 / point.0 - 1.0).abs() < 1e-9)));
    }
}
