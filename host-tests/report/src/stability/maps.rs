//! Maps of the error of each method over planes through the space of scenes.

use rayon::prelude::*;
use reference::grids::{PLANES, Plane};

use super::trial::{Assessment, Method, Point, ROUNDING};
use crate::content::{Cell, Figure, Part, Run, Table};
use crate::plot::{self, Axis, Flat, Shade};

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
            let solve_row = |row: &f64| {
                let points = columns.iter().map(|column| Point::at((plane.impact)(*column, *row))).collect();
                bar.inc(1);
                points
            };
            let points = rows.par_iter().map(solve_row).collect();
            Self { plane, columns, rows, points }
        };
        PLANES.iter().map(solve).collect()
    }

    pub(super) fn points(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().flatten()
    }

    /// The restitution, or that there is none.
    pub(super) fn restitution(&self) -> Result<Part, String> {
        if self.points().all(|point| point.restitution.unwrap_or(0.0) == 0.0) {
            return Ok(Part::Text(format!("{}: all impacts are captures.", self.plane.title)));
        }
        let scale = Axis::linear("restitution", "e", "1").between(0.0, 1.0);
        self.figure("restitution", "Restitution".to_owned(), &scale, None, |point| match point.restitution {
            Some(0.0) => Shade::Flat(Flat::Captured),
            Some(restitution) => Shade::Value(restitution),
            None => Shade::Flat(Flat::NotApplicable),
        })
    }

    /// The error of a method, or that it is nowhere in its range.
    pub(super) fn error(&self, method: Method) -> Result<Part, String> {
        let shade = |point: &Point| {
            let trial = point.trial(method);
            match (trial.assessment, trial.error) {
                (Assessment::Refused | Assessment::Declined, _) => Shade::Flat(Flat::NotApplicable),
                (Assessment::Undecided, _) => Shade::Flat(Flat::Undecided),
                (Assessment::Within, Some(error)) if error > ROUNDING => Shade::Value(error),
                (Assessment::Within, _) if point.restitution == Some(0.0) => Shade::Flat(Flat::Captured),
                (Assessment::Within, Some(_)) => Shade::Flat(Flat::Exact),
                _ => Shade::Flat(Flat::Failed),
            }
        };
        let outside = |point: &Point| matches!(shade(point), Shade::Flat(Flat::NotApplicable));
        if self.points().all(outside) {
            let text = format!("{}: all impacts lie outside the range of {}.", self.plane.title, method.name());
            return Ok(Part::Text(text));
        }
        let scale = Axis::logarithmic("error", "ε", "1").between(ROUNDING, 1.0);
        let name = format!("error-{}", method.file());
        self.figure(&name, format!("Error, {}", method.name()), &scale, Some(method), shade)
    }

    /// A map, with the restitution, and error, steps and status of a method, in its file.
    fn figure(
        &self,
        name: &str,
        title: String,
        scale: &Axis,
        method: Option<Method>,
        shade: impl Fn(&Point) -> Shade,
    ) -> Result<Part, String> {
        let Plane { x, y, .. } = self.plane;
        let cells: Vec<Vec<_>> = self.points.iter().map(|row| row.iter().map(&shade).collect()).collect();
        let map = plot::Map { columns: &self.columns, rows: &self.rows, cells: &cells, scale: scale.clone() };
        let [across, up] = [x, y].map(|axis| Axis::logarithmic(axis.name, axis.symbol, axis.unit));
        let drawing = plot::map(&across, &up, &map, &[])?;
        let row = |(row, column, point): (f64, f64, &Point)| {
            let place = [Cell::from(column), Cell::from(row), Cell::from(point.restitution)];
            let of_method = method.iter().flat_map(|method| {
                let trial = point.trial(*method);
                [trial.error.into(), count(trial.steps), trial.residual.into(), trial.assessment.text().into()]
            });
            place.into_iter().chain(of_method).collect()
        };
        let places =
            self.rows.iter().zip(&self.points).flat_map(|(row, points)| {
                self.columns.iter().zip(points).map(|(column, point)| (*row, *column, point))
            });
        let mut columns: Vec<String> =
            [x, y].map(|axis| format!("{} {}, {}", axis.name, axis.symbol, axis.unit)).to_vec();
        columns.push("e".to_owned());
        if method.is_some() {
            columns.extend(["error", "steps", "energy balance error", "status"].map(str::to_owned));
        }
        let data = Table {
            name: format!("stability-{}-{name}", self.plane.name),
            caption: String::new(),
            columns,
            rows: places.map(row).collect(),
        };
        Ok(Part::Figure(Figure { title: format!("{title}, {}", self.plane.title), drawing, data }))
    }
}

pub(super) fn count(number: Option<u32>) -> Cell {
    number.map_or(Cell::Number(None), |number| Cell::Count(number.into()))
}
