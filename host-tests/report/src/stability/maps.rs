//! Maps of the error, steps and status of each method, and the regions in which a bound fails.

use std::sync::atomic::{AtomicUsize, Ordering};

use reference::grids::{PLANES, Plane};

use super::regions::{Region, regions};
use super::trial::{Assessment, MOST_INTERVALS, Method, Point, Trial};
use crate::content::{Cell, Figure, Part, Run, Table};
use crate::plot::{self, Axis, Shade};

/// Errors below this are shown as this.
const SMALLEST: f64 = 1e-16;

/// The points of a plane.
pub(super) struct Map {
    pub(super) plane: &'static Plane,
    columns: Vec<f64>,
    rows: Vec<f64>,
    /// By row, then by column.
    points: Vec<Vec<Point>>,
}

impl Map {
    /// All planes.
    pub(super) fn all(run: &Run) -> Vec<Self> {
        let (columns, rows) = if run.quick { (12, 10) } else { (40, 30) };
        let bar = run.progress(PLANES.len() * rows, "maps");
        let solve = |plane: &'static Plane| {
            let (columns, rows) = (plane.x.values(columns), plane.y.values(rows));
            let points = in_parallel(&rows, |row| {
                let points = columns.iter().map(|column| Point::at((plane.impact)(*column, *row))).collect();
                bar.inc(1);
                points
            });
            Self { plane, columns, rows, points }
        };
        PLANES.iter().map(solve).collect()
    }

    pub(super) fn points(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().flatten()
    }

    /// A paragraph, and the figures.
    pub(super) fn parts(&self) -> Result<Vec<Part>, String> {
        let Plane { title, text, .. } = self.plane;
        let mut parts = vec![Part::Heading(format!("Map: {title}")), Part::Text((*text).to_owned())];
        if self.points().any(|point| point.restitution > Some(0.0)) {
            let scale = Axis::linear("e").between(0.0, 1.0);
            parts.push(self.figure("restitution", &format!("Restitution e, {title}"), &scale, &[], |point| {
                point.restitution.map_or(Shade::NotApplicable, Shade::Value)
            })?);
        } else {
            parts.push(Part::Text("All of these impacts are captures.".to_owned()));
        }
        let error = Axis::logarithmic("error").between(SMALLEST, 1.0);
        for method in Method::ALL {
            let shade = |point: &Point| {
                let trial = point.trial(method);
                match (trial.assessment, trial.error) {
                    (Assessment::Refused | Assessment::Declined, _) => Shade::NotApplicable,
                    (Assessment::Within, Some(error)) => Shade::Value(error.max(SMALLEST)),
                    _ => Shade::Failed,
                }
            };
            if self.points().all(|point| matches!(shade(point), Shade::NotApplicable)) {
                parts.push(Part::Text(format!("All of these impacts lie outside the range of {}.", method.name())));
                continue;
            }
            let (caption, name) = (format!("Error, {}, {title}", method.name()), format!("error-{}", method.file()));
            parts.push(self.figure(&name, &caption, &error, &[method], shade)?);
        }
        let steps = Axis::logarithmic("intervals").between(1.0, f64::from(MOST_INTERVALS));
        for method in [Method::Double, Method::Single] {
            let caption = format!("Intervals, {}, {title}", method.name());
            parts.push(self.figure(&format!("steps-{}", method.file()), &caption, &steps, &[method], |point| {
                match point.trial(method).steps {
                    Some(steps) => Shade::Value(f64::from(steps)),
                    None => Shade::NotApplicable,
                }
            })?);
        }
        Ok(parts)
    }

    /// A map, with the restitution, and error, steps and status of methods, in its file.
    fn figure(
        &self,
        name: &str,
        caption: &str,
        scale: &Axis,
        methods: &[Method],
        shade: impl Fn(&Point) -> Shade,
    ) -> Result<Part, String> {
        let Plane { x, y, .. } = self.plane;
        let cells: Vec<Vec<_>> = self.points.iter().map(|row| row.iter().map(&shade).collect()).collect();
        let map = plot::Map { columns: &self.columns, rows: &self.rows, cells: &cells, scale: scale.clone() };
        let drawing =
            plot::map(caption, &Axis::logarithmic(x.description), &Axis::logarithmic(y.description), &map, &[])?;
        let row = |(row, column, point): (f64, f64, &Point)| {
            let place = [Cell::from(column), Cell::from(row), Cell::from(point.restitution)];
            let of_methods = methods.iter().flat_map(|method| {
                let trial = point.trial(*method);
                [trial.error.into(), count(trial.steps), trial.residual.into(), trial.assessment.text().into()]
            });
            place.into_iter().chain(of_methods).collect()
        };
        let places =
            self.rows.iter().zip(&self.points).flat_map(|(row, points)| {
                self.columns.iter().zip(points).map(|(column, point)| (*row, *column, point))
            });
        let mut columns = vec![x.description, y.description, "e"];
        columns.extend(methods.iter().flat_map(|_| ["error", "steps", "energy balance error", "status"]));
        let data = Table {
            name: format!("stability-{}-{name}", self.plane.name),
            caption: caption.to_owned(),
            columns: columns.into_iter().map(str::to_owned).collect(),
            rows: places.map(row).collect(),
        };
        Ok(Part::Figure(Figure { drawing, data }))
    }

    /// A row for each method: how many points there are, and the largest error and number of steps.
    fn summary(&self) -> impl Iterator<Item = Vec<Cell>> {
        Method::ALL.into_iter().map(|method| {
            let trials = || self.points().map(|point| point.trial(method));
            let number = |wanted: &dyn Fn(Assessment) -> bool| {
                Cell::Count(trials().filter(|trial| wanted(trial.assessment)).count() as u64)
            };
            let largest = trials().filter_map(|trial| trial.error).reduce(f64::max);
            let most = trials().filter_map(|trial| trial.steps).max();
            vec![
                Cell::from(self.plane.title),
                Cell::from(method.name()),
                Cell::from(method.bound()),
                number(&|_| true),
                number(&|assessment| matches!(assessment, Assessment::Refused | Assessment::Declined)),
                number(&|assessment| assessment.fails()),
                Cell::from(largest),
                count(most),
            ]
        })
    }

    /// A row for each region in which a method fails.
    fn failures(&self, method: Method) -> Vec<Vec<Cell>> {
        let fails = |trial: &Trial| trial.assessment.fails();
        self.regions(method, method.bound(), fails, |trial| trial.error, |trial| trial.assessment.text())
    }

    /// A row for each region in which the energy balance error of a method exceeds its bound.
    pub(super) fn unbalanced(&self, method: Method) -> Vec<Vec<Cell>> {
        let bound = method.ledger_bound();
        let fails = |trial: &Trial| trial.residual.is_some_and(|residual| residual > bound);
        self.regions(method, bound, fails, |trial| trial.residual, |_| "energy balance error")
    }

    fn regions(
        &self,
        method: Method,
        bound: f64,
        fails: impl Fn(&Trial) -> bool,
        size: impl Fn(&Trial) -> Option<f64>,
        reason: impl Fn(&Trial) -> &'static str,
    ) -> Vec<Vec<Cell>> {
        let marked = |row: &Vec<Point>| row.iter().map(|point| fails(point.trial(method))).collect();
        let marked: Vec<Vec<bool>> = self.points.iter().map(marked).collect();
        let row = |region: Region| {
            let trials = || region.cells.iter().map(|(row, column)| self.points[*row][*column].trial(method));
            let mut reasons: Vec<_> = trials().map(&reason).collect();
            reasons.sort_unstable();
            reasons.dedup();
            vec![
                Cell::from(self.plane.title),
                Cell::from(method.name()),
                Cell::Text(reasons.join(", ")),
                Cell::Count(region.cells.len() as u64),
                Cell::from(trials().filter_map(&size).reduce(f64::max)),
                Cell::from(bound),
                Cell::from(self.plane.x.description),
                Cell::from(self.columns[region.columns.0]),
                Cell::from(self.columns[region.columns.1]),
                Cell::from(self.plane.y.description),
                Cell::from(self.rows[region.rows.0]),
                Cell::from(self.rows[region.rows.1]),
            ]
        };
        regions(&marked).into_iter().map(row).collect()
    }
}

/// Regions of several maps, or that there are none.
pub(super) fn listed(name: &str, caption: &str, none: &str, rows: Vec<Vec<Cell>>) -> Part {
    const COLUMNS: [&str; 12] = [
        "map",
        "method",
        "what fails",
        "points",
        "largest",
        "bound",
        "across",
        "across from",
        "across to",
        "up",
        "up from",
        "up to",
    ];
    if rows.is_empty() {
        return Part::Text(none.to_owned());
    }
    let columns = COLUMNS.map(str::to_owned).to_vec();
    Part::Table(Table { name: name.to_owned(), caption: caption.to_owned(), columns, rows })
}

fn count(number: Option<u32>) -> Cell {
    number.map_or(Cell::Number(None), |number| Cell::Count(number.into()))
}

/// The bounds, how many points lie within them, and each region in which one is exceeded.
pub(super) fn bounds(maps: &[Map]) -> Vec<Part> {
    let columns = ["map", "method", "bound", "points", "refused", "failed", "largest error", "most steps"];
    let summary = Table {
        name: "stability-bounds".to_owned(),
        caption: "Points of the maps within and beyond their bounds".to_owned(),
        columns: columns.map(str::to_owned).to_vec(),
        rows: maps.iter().flat_map(Map::summary).collect(),
    };
    let failures = |methods: &[Method]| -> Vec<Vec<Cell>> {
        methods.iter().flat_map(|method| maps.iter().flat_map(|map| map.failures(*method))).collect()
    };
    let ours = failures(&[Method::Double, Method::Single, Method::Fixed]);
    let none = "No point of any map lies beyond a bound in f64, f32 or fixed point.";
    let caption = "Regions in which the paper's method fails";
    vec![
        Part::Table(summary),
        listed("stability-regions", "Regions in which a bound fails", none, ours),
        listed("stability-regions-paper", caption, "The paper's method fails nowhere.", failures(&[Method::Paper])),
    ]
}

/// What a function gives for each item, on all processors.
pub(super) fn in_parallel<I: Sync, R: Send>(items: &[I], solve: impl Fn(&I) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(index) else { break done };
            done.push((index, solve(item)));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut done: Vec<_> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let results = handles.into_iter().map(|handle| handle.join());
        results.flat_map(|result| result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    done.sort_unstable_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_keep_the_order_of_the_items() {
        let items: Vec<u32> = (0..1000).collect();
        assert_eq!(in_parallel(&items, |item| item * item), items.iter().map(|item| item * item).collect::<Vec<_>>());
    }
}
