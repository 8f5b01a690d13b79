//! Maps in colour: values over a grid, with a colour of its own for each thing that is no value.

use plotters::prelude::*;
use plotters::style::colors::colormaps::ViridisRGB;

use super::legend::{Entry, Symbol};
use super::lines::{draw_lines, legend_of};
use super::{Area, Axis, HEIGHT, LABELS, LABELS_BELOW, Line, MARGIN, Scale, TYPE, WIDTH, axes, drawn, text};

/// Width of the scale of colours.
const BAR: u32 = 320;
/// Number of colours of a map: fewer make a shorter file.
const LEVELS: u32 = 64;
/// Place of the first line on a map among the colours: one that the map does not have.
const FIRST_LINE: usize = 3;

/// What a cell of a map shows.
#[derive(Clone, Copy)]
pub(crate) enum Shade {
    Value(f64),
    Flat(Flat),
}

/// What has one colour, which the scale of values does not contain.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flat {
    Captured,
    Exact,
    Undecided,
    Failed,
    NotApplicable,
}

impl Flat {
    const ALL: [Self; 5] = [Self::Captured, Self::Exact, Self::Undecided, Self::Failed, Self::NotApplicable];

    const fn colour_and_name(self) -> (RGBColor, &'static str) {
        match self {
            Self::Captured => (RGBColor(240, 196, 220), "captured"),
            Self::Exact => (RGBColor(190, 222, 244), "exact to rounding"),
            Self::Undecided => (RGBColor(90, 90, 90), "undecided"),
            Self::Failed => (RGBColor(213, 94, 0), "failed"),
            Self::NotApplicable => (RGBColor(150, 150, 150), "not applicable"),
        }
    }
}

/// Values over a grid.
pub(crate) struct Map<'a> {
    /// Middles of the columns, rising; evenly spaced on their axis.
    pub(crate) columns: &'a [f64],
    /// Middles of the rows, rising; evenly spaced on their axis.
    pub(crate) rows: &'a [f64],
    /// By row, then by column.
    pub(crate) cells: &'a [Vec<Shade>],
    /// What the colours mean.
    pub(crate) scale: Axis,
}

/// A map in colour, with lines on it.
pub(crate) fn map(x: &Axis, y: &Axis, map: &Map<'_>, lines: &[Line]) -> Result<String, String> {
    let cells = || map.cells.iter().flatten();
    let values = cells().filter_map(|shade| if let Shade::Value(value) = shade { Some(*value) } else { None });
    let scale = map.scale.over(values);
    let mut entries: Vec<_> = legend_of(lines, FIRST_LINE).collect();
    let shown = |flat: &Flat| cells().any(|shade| matches!(shade, Shade::Flat(shown) if shown == flat));
    entries.extend(Flat::ALL.into_iter().filter(shown).map(|flat| {
        let (colour, name) = flat.colour_and_name();
        Entry { name, symbol: Symbol::Field(colour) }
    }));
    let whole =
        |rows: usize, columns: usize| rows == map.rows.len() && columns == map.columns.len() && rows * columns > 0;
    if !map.cells.iter().all(|row| whole(map.cells.len(), row.len())) || map.cells.is_empty() {
        return Err(format!("a map of {} lacks cells", map.scale.label));
    }
    let (columns, rows) = (edges(map.columns, x.logarithmic), edges(map.rows, y.logarithmic));
    drawn(HEIGHT, &entries, |area| {
        let (area, bar) = area.split_horizontally(WIDTH - BAR);
        let corners = columns.iter().copied().zip(rows.iter().copied().cycle());
        let corners = corners.chain(rows.iter().map(|row| (columns[0], *row)));
        let between = |axis: &Axis, edges: &[f64]| match (axis.range, edges) {
            (None, [low, .., high]) => axis.clone().between(*low, *high),
            _ => axis.clone(),
        };
        let (x, y) = (between(x, &columns), between(y, &rows));
        let mut chart = axes(&area, (&x, &y), corners)?;
        for (cells, low_high) in map.cells.iter().zip(rows.windows(2)) {
            let colours: Vec<_> = cells.iter().map(|shade| shade.colour(&scale)).collect();
            let mut begin = 0;
            // Neighbours of one colour are one rectangle.
            for run in colours.chunk_by(PartialEq::eq) {
                let end = begin + run.len();
                let corners = [(columns[begin], low_high[0]), (columns[end], low_high[1])];
                chart.draw_series([Rectangle::new(corners, run[0].filled())]).map_err(text)?;
                begin = end;
            }
        }
        draw_lines(&mut chart, (&x, &y), lines, FIRST_LINE)?;
        draw_scale(&bar, &map.scale, &scale)
    })
}

impl Shade {
    fn colour(self, scale: &Scale) -> RGBColor {
        match self {
            Self::Value(value) => {
                let level = (scale.fraction(value) * f64::from(LEVELS - 1)).round();
                ViridisRGB.get_color(level / f64::from(LEVELS - 1))
            }
            Self::Flat(flat) => flat.colour_and_name().0,
        }
    }
}

/// Borders of cells with these middles.
fn edges(middles: &[f64], logarithmic: bool) -> Vec<f64> {
    let flat: Vec<_> = middles.iter().map(|middle| Scale::flatten(*middle, logarithmic)).collect();
    let (Some(first), Some(last)) = (flat.first(), flat.last()) else {
        return Vec::new();
    };
    let half = if flat.len() > 1 { (last - first) / (flat.len() - 1) as f64 / 2.0 } else { 0.5 };
    let inner = flat.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let all = [first - half].into_iter().chain(inner).chain([last + half]);
    all.map(|edge| if logarithmic { 10_f64.powf(edge) } else { edge }).collect()
}

/// The colours with their values.
fn draw_scale(area: &Area<'_>, axis: &Axis, scale: &Scale) -> Result<(), String> {
    let mut chart = ChartBuilder::on(area)
        .margin_top(MARGIN)
        .margin_bottom(LABELS_BELOW + MARGIN)
        .set_label_area_size(LabelAreaPosition::Right, LABELS)
        .build_cartesian_2d(0.0..1.0, scale.clone())
        .map_err(text)?;
    let position = |level: u32| scale.low + (scale.high - scale.low) * f64::from(level) / f64::from(LEVELS);
    let fields = (0..LEVELS).map(|level| {
        let ends = [(0.0, scale.unflatten(position(level))), (1.0, scale.unflatten(position(level + 1)))];
        Rectangle::new(ends, ViridisRGB.get_color(f64::from(level) / f64::from(LEVELS - 1)).filled())
    });
    chart.draw_series(fields).map_err(text)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .disable_x_axis()
        .axis_style(BLACK.stroke_width(2))
        .set_all_tick_mark_size(12)
        .y_labels(8)
        .y_desc(&axis.label)
        .axis_desc_style(("sans-serif", TYPE))
        .label_style(("sans-serif", TYPE))
        .draw()
        .map_err(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: [f64; 2] = [1.0, 10.0];

    fn drawing(cells: &[Vec<Shade>]) -> Result<String, String> {
        let axis = Axis::logarithmic("length", "x", "m");
        let scale = Axis::linear("error", "ε", "1");
        map(&axis, &axis, &Map { columns: &GRID, rows: &GRID, cells, scale }, &[])
    }

    #[test]
    fn cells_of_a_map_meet() {
        assert_eq!(edges(&[1.0, 2.0, 3.0], false), [0.5, 1.5, 2.5, 3.5]);
        let edges = edges(&[1.0, 100.0], true);
        assert!(edges.iter().zip([0.1, 10.0, 1000.0]).all(|(edge, exact)| (edge / exact - 1.0).abs() < 1e-12));
    }

    #[test]
    fn map_without_its_cells_is_refused() {
        let failed = Shade::Flat(Flat::Failed);
        for cells in [vec![], vec![vec![failed; 2]], vec![vec![failed; 2], vec![failed]]] {
            assert!(drawing(&cells).is_err());
        }
    }

    #[test]
    fn what_is_no_value_has_a_colour_and_a_name_of_its_own() {
        for flat in Flat::ALL {
            let drawing = drawing(&[vec![Shade::Value(1.0); 2], vec![Shade::Flat(flat), Shade::Value(2.0)]]).unwrap();
            let shown = Flat::ALL.map(Flat::colour_and_name).into_iter().filter(|(_, name)| drawing.contains(name));
            let shown: Vec<_> = shown.collect();
            assert_eq!(shown, [flat.colour_and_name()]);
            let (RGBColor(red, green, blue), name) = shown[0];
            // A cell and its entry in the legend.
            assert_eq!(drawing.matches(&format!("#{red:02X}{green:02X}{blue:02X}")).count(), 2, "{name}");
        }
    }
}
