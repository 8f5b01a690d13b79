//! What a method with a setting costs, and how exact it is.

use std::collections::HashMap;

/// A method with a setting, as figures and tables name it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Entrant {
    /// What is asked for.
    pub(super) task: String,
    /// The number type.
    pub(super) scalar: String,
    pub(super) method: String,
    pub(super) setting: String,
}

/// What an entrant reached on a processor.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) entrant: Entrant,
    /// Its largest error on the scene; `None` where it failed.
    pub(super) error: Option<f64>,
    /// Instructions, or seconds.
    pub(super) cost: f64,
}

/// What a cost counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Instructions,
    Seconds,
}

impl Unit {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Instructions => "instructions",
            Self::Seconds => "s",
        }
    }
}

/// All points of a processor.
pub(super) struct Series {
    pub(super) processor: String,
    pub(super) unit: Unit,
    pub(super) points: Vec<Point>,
}

impl Series {
    /// Axis and column of the cost.
    pub(super) fn cost(&self) -> String {
        match self.unit {
            Unit::Instructions => "instructions".to_owned(),
            Unit::Seconds => "least time, s".to_owned(),
        }
    }

    /// The series with the errors of other scenes; an entrant that has none there is left out.
    pub(super) fn with_errors(&self, errors: &HashMap<Entrant, Option<f64>>) -> Self {
        let renewed = self.points.iter().filter_map(|point| {
            let error = *errors.get(&point.entrant)?;
            Some(Point { error, ..point.clone() })
        });
        Self { processor: self.processor.clone(), unit: self.unit, points: renewed.collect() }
    }
}

/// Half a unit in the last place of one: an error below it is luck.
pub(super) fn rounding(scalar: &str) -> f64 {
    match scalar {
        "f64" => 0.5 * f64::EPSILON,
        "f32" => 0.5 * f64::from(f32::EPSILON),
        _ => 0.5 / f64::from(1 << 24),
    }
}

/// Points that no other undercuts in both error and cost, from the cheapest to the most exact.
pub(super) fn front<'a>(points: impl Iterator<Item = &'a Point>) -> Vec<&'a Point> {
    let mut solved: Vec<(f64, &Point)> = points.filter_map(|point| Some((point.error?, point))).collect();
    solved.sort_by(|a, b| a.1.cost.total_cmp(&b.1.cost).then(a.0.total_cmp(&b.0)));
    let mut front: Vec<&Point> = Vec::new();
    let mut least = f64::INFINITY;
    for (error, point) in solved {
        if error < least {
            least = error;
            front.push(point);
        }
    }
    front
}

/// The cheapest point whose error is at most `level`.
pub(super) fn cheapest<'a>(points: impl Iterator<Item = &'a Point>, level: f64) -> Option<&'a Point> {
    let within = points.filter(|point| point.error.is_some_and(|error| error <= level));
    within.min_by(|a, b| a.cost.total_cmp(&b.cost))
}

#[cfg(test)]
mod tests {
    use super::{Entrant, Point, cheapest, front};

    fn point(setting: &str, error: Option<f64>, cost: f64) -> Point {
        let entrant = Entrant {
            task: "normal".to_owned(),
            scalar: "f64".to_owned(),
            method: "a method".to_owned(),
            setting: setting.to_owned(),
        };
        Point { entrant, error, cost }
    }

    fn points() -> Vec<Point> {
        vec![
            point("exact", Some(1e-9), 50.0),
            point("worse in both", Some(1e-4), 30.0),
            point("failed", None, 1.0),
            point("rough", Some(1e-3), 10.0),
            point("good", Some(1e-6), 20.0),
        ]
    }

    #[test]
    fn the_cheapest_within_an_error_is_chosen() {
        let points = points();
        let chosen = |level| cheapest(points.iter(), level).map(|point| &*point.entrant.setting);
        assert_eq!(chosen(1e-2), Some("rough"));
        assert_eq!(chosen(1e-3), Some("rough"));
        assert_eq!(chosen(9e-4), Some("good"));
        assert_eq!(chosen(1e-8), Some("exact"));
        assert_eq!(chosen(1e-10), None);
    }

    #[test]
    fn a_front_leaves_out_what_is_undercut() {
        let points = points();
        let names: Vec<&str> = front(points.iter()).iter().map(|point| &*point.entrant.setting).collect();
        assert_eq!(names, ["rough", "good", "exact"]);
    }
}
