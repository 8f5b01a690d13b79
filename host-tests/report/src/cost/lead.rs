//! The picture of error against time for each core, and how many times longer the best peer takes.

use super::contestants::is_ours;
use super::host;
use super::point::{Point, Series, Unit, cheapest, front};
use crate::content::{Cell, Figure, Table};
use crate::plot::{self, Axis, Line, Mark};

/// Exponents of the errors at which both are compared.
const LEVELS: std::ops::RangeInclusive<i32> = 3..=12;

/// Instructions of a board in a microsecond, for the picture: 100 MHz and one instruction a cycle.
const PER_MICROSECOND: f64 = 100.0;

/// The best of this library and of its peers on a core, on the normal impact of Table 1.
struct Core<'a> {
    name: String,
    /// What one of its costs is in microseconds.
    unit: f64,
    /// Ours, and those of peers: the cheapest for each error.
    fronts: [Vec<&'a Point>; 2],
    /// By how much the best peer is more expensive at each level that both reach.
    ratios: Vec<(i32, f64, &'a Point)>,
}

impl<'a> Core<'a> {
    fn of(series: &'a Series) -> Self {
        // Peers on the host answer with contact time and impulse, which cost more: they meet ours that do so too.
        let has_outputs = |point: &&Point| point.entrant.task == host::OUTPUTS;
        let task = if series.points.iter().any(|point| has_outputs(&point)) { host::OUTPUTS } else { "normal" };
        let of = |ours: bool| {
            let points = series.points.iter().filter(move |point| point.entrant.task == task);
            points.filter(move |point| is_ours(&point.entrant.method) == ours)
        };
        let ratio = |level: i32| {
            let [ours, peer] = [true, false].map(|ours| cheapest(of(ours), 10_f64.powi(-level)));
            let (ours, peer) = (ours?, peer?);
            Some((level, peer.cost / ours.cost, peer))
        };
        let (unit, name) = match series.unit {
            Unit::Seconds => (1e6, "this computer".to_owned()),
            Unit::Instructions => (PER_MICROSECOND.recip(), series.processor.clone()),
        };
        let fronts = [front(of(true)), front(of(false))];
        Self { name, unit, fronts, ratios: LEVELS.filter_map(ratio).collect() }
    }

    /// Least and largest ratio.
    fn range(&self) -> Option<(f64, f64)> {
        let ratios = || self.ratios.iter().map(|ratio| ratio.1);
        Some((ratios().reduce(f64::min)?, ratios().reduce(f64::max)?))
    }
}

/// The picture, and the table of all ratios.
pub(super) fn picture(all: &[Series]) -> Result<(Figure, Table), String> {
    let cores: Vec<Core<'_>> = all.iter().map(Core::of).collect();
    let mut lines = Vec::new();
    let mut rows = Vec::new();
    for (place, core) in cores.iter().enumerate() {
        // The legend names a core once, with its ratios.
        let name = core
            .range()
            .map_or_else(|| core.name.clone(), |range| format!("{}: peer {} as long", core.name, times(range)));
        let kinds = [("ours", Mark::Joined, &*name), ("best peer", Mark::Dashed, "")];
        for (points, (who, mark, name)) in core.fronts.iter().zip(kinds) {
            let at = |point: &&Point| Some((point.error?, core.unit * point.cost));
            let points: Vec<_> = points.iter().filter_map(at).collect();
            rows.extend(points.iter().map(|at| vec![core.name.as_str().into(), who.into(), at.0.into(), at.1.into()]));
            lines.push(Line::new(name, mark, points).like(place));
        }
    }
    lines.push(Line::new("solid: ours; dashed: the best peer", Mark::Dashed, Vec::new()).like(plot::BLACK_PLACE));
    let data = Table {
        name: "cost-cores".to_owned(),
        caption: sentence(&cores),
        columns: ["core", "who", "error", "time, us"].map(str::to_owned).to_vec(),
        rows,
    };
    let (x, y) = (Axis::logarithmic("error", "ε", "1"), Axis::logarithmic("time of an impact", "t", "µs"));
    let drawing = plot::tall_chart(&x.between(1e-13, 1e-2), &y, &lines)?;
    Ok((Figure { title: "How long does an impact take to compute?".to_owned(), drawing, data }, ratios(&cores)))
}

/// How far ahead, and where behind.
fn sentence(cores: &[Core<'_>]) -> String {
    let behind = |core: &Core<'_>| {
        let levels = core.ratios.iter().filter(|ratio| ratio.1 < 1.0).map(|ratio| format!("1e-{}", ratio.0));
        let levels: Vec<_> = levels.collect();
        (!levels.is_empty()).then(|| format!("on {} at {}", core.name, levels.join(", ")))
    };
    let behind: Vec<_> = cores.iter().filter_map(behind).collect();
    let behind = if behind.is_empty() { "nowhere ahead".to_owned() } else { format!("ahead {}", behind.join("; ")) };
    let boards = if cores.len() > 1 {
        " On boards 100 instructions count as 1 µs. The largest factors are at 1e-7, where f32 still serves us and a peer needs f64."
    } else {
        ""
    };
    let range = cores.iter().filter_map(Core::range).reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)));
    format!(
        "In the impact of Table 1, the best peer takes {} as long as our best method for the same error, and is {behind}.{boards}",
        range.map_or_else(|| "an unknown number of times".to_owned(), times),
    )
}

/// A range of ratios in words.
fn times((least, most): (f64, f64)) -> String {
    let digits = |ratio: f64| if ratio < 10.0 { format!("{ratio:.1}") } else { format!("{ratio:.0}") };
    format!("{} to {} times", digits(least), digits(most))
}

/// A row for each error, a column for each core.
fn ratios(cores: &[Core<'_>]) -> Table {
    let row = |level: i32| {
        let cell = |core: &Core<'_>| {
            let ratio = core.ratios.iter().find(|ratio| ratio.0 == level);
            Cell::Text(
                ratio.map_or_else(String::new, |(_, ratio, peer)| format!("{ratio:.2}, {}", peer.entrant.method)),
            )
        };
        [Cell::from(10_f64.powi(-level))].into_iter().chain(cores.iter().map(cell)).collect()
    };
    let columns = ["error".to_owned()].into_iter().chain(cores.iter().map(|core| core.name.clone()));
    Table {
        name: "cost-ratios".to_owned(),
        caption: "Cost of the best peer over that of our best method at the same error, and the peer: above 1 we are ahead, below 1 \
                  behind. On this computer with contact time and impulse, on boards e alone."
            .to_owned(),
        columns: columns.collect(),
        rows: LEVELS.map(row).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::point::Entrant;
    use super::*;

    fn point(method: &str, error: f64, cost: f64) -> Point {
        let [task, scalar, setting] = ["normal", "f64", ""].map(str::to_owned);
        Point { entrant: Entrant { task, scalar, method: method.to_owned(), setting }, error: Some(error), cost }
    }

    /// At 1e-3 the peer is slower by two, from 1e-6 on it is faster by two.
    #[test]
    fn the_sentence_says_where_we_are_behind() {
        let points = vec![
            point("FixedCost", 1e-5, 100.0),
            point("Adaptive", 1e-13, 800.0),
            point("numeris", 1e-5, 200.0),
            point("numeris", 1e-13, 400.0),
        ];
        let series = Series { processor: "Cortex-M9".to_owned(), unit: Unit::Instructions, points };
        let (figure, table) = picture(&[series]).unwrap();
        assert!(figure.data.caption.contains("0.5 to 2.0 times as long"), "{}", figure.data.caption);
        assert!(figure.data.caption.contains("is ahead on Cortex-M9 at 1e-6, 1e-7"));
        let cells: Vec<_> =
            table.rows.iter().map(|row| if let Cell::Text(text) = &row[1] { text.as_str() } else { "" }).collect();
        assert_eq!((cells[0], cells[3]), ("2.00, numeris", "0.50, numeris"));
    }
}
