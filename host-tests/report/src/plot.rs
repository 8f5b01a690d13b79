//! Drawings of the report, by `plotters` as SVG: lines and points over linear or logarithmic axes, and maps in colour.
//!
//! A drawing is as wide as the page and has type that can be read on a phone; what is black in it follows the page's
//! colours, and its ground is transparent. The legend stands below the axes.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::colors::colormaps::ViridisRGB;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const WIDTH: u32 = 1720;
/// Height of the row of the title.
const TITLE: u32 = 104;
const HEIGHT: u32 = 1200;
const TYPE: u32 = 68;
/// Height of a row of the legend.
const ROW: u32 = 90;
const MARGIN: u32 = 24;
/// Room for half of a number at the end of an axis.
const MARGIN_RIGHT: u32 = 84;
/// Longest name that leaves room for another beside it.
const HALF_A_ROW: usize = 24;
/// Width of the numbers and the name of an upright axis.
const LABELS: u32 = 250;
/// Height of those of the other.
const LABELS_BELOW: u32 = 176;
/// Width of the scale of colours of a map.
const BAR: u32 = 360;
/// Half the size of a symbol.
const SYMBOL: i32 = 14;
const STROKE: u32 = 6;

/// Okabe and Ito's colours, which people without all cones can tell apart, and four for drawings with more lines; all of
/// them can be seen on light and dark ground.
const COLOURS: [RGBColor; 11] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    BLACK,
    RGBColor(142, 106, 214),
    RGBColor(140, 140, 140),
    RGBColor(160, 103, 58),
    RGBColor(141, 182, 0),
];
/// Shapes of symbols; their number has no factor in common with that of the colours.
const SHAPES: usize = 5;

/// Place of the first line on a map among the colours: one that the map does not have.
const FIRST_ON_MAP: usize = 3;

/// A failure in a map, which the scale of colours does not contain.
const FAILED: RGBColor = RGBColor(213, 94, 0);
const NOT_APPLICABLE: RGBColor = RGBColor(150, 150, 150);
/// Colours that a map tells apart: fewer make a shorter file.
const LEVELS: u32 = 64;

/// A direction of a drawing.
#[derive(Clone)]
pub(crate) struct Axis {
    /// With unit.
    description: String,
    logarithmic: bool,
    range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis that reaches as far as the data.
    pub(crate) fn linear(description: &str) -> Self {
        Self { description: description.to_owned(), logarithmic: false, range: None }
    }

    /// A logarithmic axis that reaches as far as the positive data.
    pub(crate) fn logarithmic(description: &str) -> Self {
        Self { logarithmic: true, ..Self::linear(description) }
    }

    /// The axis with ends of its own.
    pub(crate) fn between(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }

    fn can_show(&self, value: f64) -> bool {
        let inside = |(low, high)| (low..=high).contains(&value);
        value.is_finite() && (value > 0.0 || !self.logarithmic) && self.range.is_none_or(inside)
    }

    /// The axis for values.
    fn over(&self, values: impl Iterator<Item = f64>) -> Scale {
        let extent = values.filter(|value| self.can_show(*value)).map(|value| Scale::flatten(value, self.logarithmic));
        let (low, high) = match self.range {
            Some((low, high)) => (Scale::flatten(low, self.logarithmic), Scale::flatten(high, self.logarithmic)),
            None => {
                let (low, high) =
                    extent.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
                let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
                let room = if high > low { 0.04 * (high - low) } else { 0.5 };
                (low - room, high + room)
            }
        };
        Scale { flat: (low..high).into(), low, high, logarithmic: self.logarithmic }
    }
}

/// An axis with its ends; positions on a logarithmic one are common logarithms.
#[derive(Clone)]
struct Scale {
    flat: RangedCoordf64,
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Scale {
    fn flatten(value: f64, logarithmic: bool) -> f64 {
        if logarithmic { value.log10() } else { value }
    }

    fn unflatten(&self, position: f64) -> f64 {
        if self.logarithmic { 10_f64.powf(position) } else { position }
    }

    /// Where a value lies between the ends, from 0 to 1.
    fn fraction(&self, value: f64) -> f64 {
        ((Self::flatten(value, self.logarithmic) - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.flat.map(&Self::flatten(*value, self.logarithmic), limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if !self.logarithmic {
            return self.flat.key_points(hint);
        }
        let room = hint.bold_points().max(1);
        let (first, last) = (self.low.ceil() as i32, self.high.floor() as i32);
        let decades = usize::try_from(last - first + 1).unwrap_or(0);
        let digits: &[f64] = match self.high - self.low {
            _ if decades >= 3 => &[1.0],
            length if length < 0.7 => &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
            _ => &[1.0, 2.0, 5.0],
        };
        let stride = decades.div_ceil(room).max(1);
        let points = (first - 1..=last).filter(|decade| (decade - first).rem_euclid(stride as i32) == 0);
        let points = points.flat_map(|decade| digits.iter().map(move |digit| digit * 10_f64.powi(decade)));
        points.filter(|value| (self.low..=self.high).contains(&value.log10())).collect()
    }

    fn range(&self) -> Range<f64> {
        self.unflatten(self.low)..self.unflatten(self.high)
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let plain = |value: f64| {
            let text = format!("{value:.6}");
            let text = text.trim_end_matches('0').trim_end_matches('.');
            if text == "-0" { "0".to_owned() } else { text.to_owned() }
        };
        if *value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
            return plain(*value);
        }
        if !self.logarithmic && value.abs() < 1e-9 * (self.high - self.low) {
            return "0".to_owned();
        }
        let scientific = format!("{value:e}");
        let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        let digits = digits.parse().map_or_else(|_| digits.to_owned(), plain);
        let power = format!("10{}", exponent.chars().map(superscript).collect::<String>());
        if digits == "1" { power } else { format!("{digits}·{power}") }
    }
}

fn superscript(digit: char) -> char {
    let place = digit.to_digit(10).and_then(|digit| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize));
    place.unwrap_or('⁻')
}

/// How the points of a line are drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    Solid,
    Dashed,
    /// Symbols alone.
    Points,
    /// Symbols on a line.
    Joined,
}

/// One set of points with a name. A point that its axes cannot show interrupts the line.
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) mark: Mark,
    pub(crate) points: Vec<(f64, f64)>,
    /// Points drawn as crosses, as far as they can be shown.
    pub(crate) failed: Vec<(f64, f64)>,
    /// Place among colours and symbols, where it is not that among the lines.
    place: Option<usize>,
}

impl Line {
    pub(crate) fn new(name: &str, mark: Mark, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.to_owned(), mark, points, failed: Vec::new(), place: None }
    }

    /// The line with the colour and symbol of a place.
    pub(crate) fn like(self, place: usize) -> Self {
        Self { place: Some(place), ..self }
    }

    /// The line with the colour of a place and another symbol.
    pub(crate) fn beside(self, place: usize) -> Self {
        self.like(place + COLOURS.len())
    }

    /// Colour and symbol where the line is one of many.
    fn style(&self, index: usize) -> Style {
        Style::of(self.place.unwrap_or(index))
    }

    /// A method with a point for each of its settings.
    pub(crate) fn settings(name: &str, points: Vec<(f64, f64)>, failed: Vec<(f64, f64)>) -> Self {
        Self { failed, ..Self::new(name, Mark::Joined, points) }
    }

    fn all(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.points.iter().chain(&self.failed)
    }
}

/// A line a method and a point a setting over two logarithmic axes; crosses are settings that failed.
pub(crate) fn log_log(caption: &str, x: &str, y: &str, lines: &[Line]) -> Result<String, String> {
    chart(caption, &Axis::logarithmic(x), &Axis::logarithmic(y), lines)
}

/// Lines and points over two axes.
pub(crate) fn chart(caption: &str, x: &Axis, y: &Axis, lines: &[Line]) -> Result<String, String> {
    let entries: Vec<_> = legend_of(lines, 0).collect();
    drawn(caption, &entries, |area| {
        let mut chart = axes(area, (x, y), lines.iter().flat_map(Line::all).copied())?;
        draw_lines(&mut chart, (x, y), lines, 0)
    })
}

/// What a cell of a map shows.
#[derive(Clone, Copy)]
pub(crate) enum Shade {
    Value(f64),
    Failed,
    NotApplicable,
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

/// A map in colour, with lines on it. Cells that failed, and cells without a value, have colours of their own.
pub(crate) fn map(caption: &str, x: &Axis, y: &Axis, map: &Map<'_>, lines: &[Line]) -> Result<String, String> {
    let values = || map.cells.iter().flatten();
    let shown = values().filter_map(|shade| if let Shade::Value(value) = shade { Some(*value) } else { None });
    let scale = map.scale.over(shown);
    let mut entries: Vec<_> = legend_of(lines, FIRST_ON_MAP).collect();
    if values().any(|shade| matches!(shade, Shade::Failed)) {
        entries.push(Entry { name: "failed", symbol: Symbol::Field(FAILED) });
    }
    if values().any(|shade| matches!(shade, Shade::NotApplicable)) {
        entries.push(Entry { name: "not applicable", symbol: Symbol::Field(NOT_APPLICABLE) });
    }
    let whole =
        |rows: usize, columns: usize| rows == map.rows.len() && columns == map.columns.len() && rows * columns > 0;
    if !map.cells.iter().all(|row| whole(map.cells.len(), row.len())) || map.cells.is_empty() {
        return Err(format!("the map \"{caption}\" lacks cells"));
    }
    let (columns, rows) = (edges(map.columns, x.logarithmic), edges(map.rows, y.logarithmic));
    drawn(caption, &entries, |area| {
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
        draw_lines(&mut chart, (&x, &y), lines, FIRST_ON_MAP)?;
        draw_scale(&bar, &map.scale, &scale)
    })
}

impl Shade {
    fn colour(self, scale: &Scale) -> RGBColor {
        match self {
            Self::Value(value) => {
                let level = (scale.fraction(value) * f64::from(LEVELS - 1)).round();
                colour(level / f64::from(LEVELS - 1))
            }
            Self::Failed => FAILED,
            Self::NotApplicable => NOT_APPLICABLE,
        }
    }
}

fn colour(fraction: f64) -> RGBColor {
    ViridisRGB.get_color(fraction)
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

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Scale, Scale>>;

#[allow(clippy::needless_pass_by_value)]
fn text<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> String {
    format!("a drawing: {error}")
}

/// A drawing with its title above and a legend below.
fn drawn(
    title: &str,
    entries: &[Entry<'_>],
    draw: impl for<'a> FnOnce(&Area<'a>) -> Result<(), String>,
) -> Result<String, String> {
    let columns = if entries.iter().all(|entry| entry.name.chars().count() <= HALF_A_ROW) { 2 } else { 1 };
    let rows = u32::try_from(entries.len().div_ceil(columns)).map_err(|error| error.to_string())?;
    let mut drawing = String::new();
    {
        let size = (WIDTH, TITLE + HEIGHT + rows * ROW + MARGIN);
        let area = SVGBackend::with_string(&mut drawing, size).into_drawing_area();
        let (head, below) = area.split_vertically(TITLE);
        draw_title(&head, title)?;
        let (upper, legend) = below.split_vertically(HEIGHT);
        draw(&upper)?;
        for (index, entry) in entries.iter().enumerate() {
            let place = |index: usize, size: u32| i32::try_from(index).unwrap_or(0) * size.cast_signed();
            let left = 76 + place(index % columns, WIDTH / 2);
            entry.draw(&legend, (left, place(index / columns, ROW) + ROW.cast_signed() / 2))?;
        }
        area.present().map_err(text)?;
    }
    Ok(drawing)
}

fn draw_title(area: &Area<'_>, title: &str) -> Result<(), String> {
    // A letter is half as wide as high, of the whole height of a line.
    let letters = u32::try_from(title.chars().count().max(1)).unwrap_or(u32::MAX);
    let size = (TYPE + 8).min((WIDTH - 2 * MARGIN) * 5 / 2 / letters);
    let style = TextStyle::from(("sans-serif", size).into_font()).pos(Pos::new(HPos::Center, VPos::Center));
    area.draw(&Text::new(title.to_owned(), (WIDTH.cast_signed() / 2, TITLE.cast_signed() / 2), style)).map_err(text)
}

/// Axes around a field that holds the points.
fn axes<'a>(
    area: &Area<'a>,
    (x, y): (&Axis, &Axis),
    points: impl Iterator<Item = (f64, f64)>,
) -> Result<Chart<'a>, String> {
    let (abscissas, ordinates): (Vec<_>, Vec<_>) = points.filter(|at| x.can_show(at.0) && y.can_show(at.1)).unzip();
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN)
        .margin_right(MARGIN_RIGHT)
        .set_label_area_size(LabelAreaPosition::Left, LABELS)
        .set_label_area_size(LabelAreaPosition::Bottom, LABELS_BELOW)
        .build_cartesian_2d(x.over(abscissas.into_iter()), y.over(ordinates.into_iter()))
        .map_err(text)?;
    chart
        .configure_mesh()
        .x_desc(&x.description)
        .y_desc(&y.description)
        .x_labels(if area.dim_in_pixel().0 < WIDTH { 6 } else { 8 })
        .y_labels(8)
        .max_light_lines(1)
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.15).stroke_width(2))
        .axis_style(BLACK.stroke_width(2))
        .set_all_tick_mark_size(12)
        .axis_desc_style(("sans-serif", TYPE))
        .label_style(("sans-serif", TYPE))
        .draw()
        .map_err(text)?;
    Ok(chart)
}

fn draw_lines(chart: &mut Chart<'_>, (x, y): (&Axis, &Axis), lines: &[Line], first: usize) -> Result<(), String> {
    let visible = |at: &(f64, f64)| x.can_show(at.0) && y.can_show(at.1);
    for (index, line) in lines.iter().enumerate() {
        let style = line.style(first + index);
        if line.mark != Mark::Points {
            for piece in line.points.split(|at| !visible(at)) {
                let (points, stroke) = (piece.iter().copied(), style.colour.stroke_width(STROKE));
                if line.mark == Mark::Dashed {
                    chart.draw_series(DashedLineSeries::new(points, 24, 16, stroke)).map_err(text)?;
                } else {
                    chart.draw_series(LineSeries::new(points, stroke)).map_err(text)?;
                }
            }
        }
        if matches!(line.mark, Mark::Points | Mark::Joined) {
            for at in line.points.iter().filter(|at| visible(at)) {
                chart.draw_series([EmptyElement::at(*at) + style.symbol((0, 0))]).map_err(text)?;
            }
        }
        for at in line.failed.iter().filter(|at| visible(at)) {
            chart.draw_series([Cross::new(*at, SYMBOL, style.colour.stroke_width(STROKE))]).map_err(text)?;
        }
    }
    Ok(())
}

/// The colours of a map with their values.
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
        Rectangle::new(ends, colour(f64::from(level) / f64::from(LEVELS - 1)).filled())
    });
    chart.draw_series(fields).map_err(text)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .disable_x_axis()
        .axis_style(BLACK.stroke_width(2))
        .set_all_tick_mark_size(12)
        .y_labels(8)
        .y_desc(&axis.description)
        .axis_desc_style(("sans-serif", TYPE))
        .label_style(("sans-serif", TYPE))
        .draw()
        .map_err(text)
}

/// Colour and shape of the line in a place of the order.
#[derive(Clone, Copy)]
struct Style {
    colour: RGBColor,
    shape: usize,
}

impl Style {
    fn of(index: usize) -> Self {
        Self { colour: COLOURS[index % COLOURS.len()], shape: index % SHAPES }
    }

    /// The symbol around a place in pixels.
    fn symbol(self, (x, y): (i32, i32)) -> Polygon<(i32, i32)> {
        const S: i32 = SYMBOL;
        let corners: &[(i32, i32)] = match self.shape {
            0 => &[(-6, -S), (6, -S), (S, -6), (S, 6), (6, S), (-6, S), (-S, 6), (-S, -6)],
            1 => &[(-S, S - 1), (S, S - 1), (0, -S - 1)],
            2 => &[(-S + 1, -S + 1), (S - 1, -S + 1), (S - 1, S - 1), (-S + 1, S - 1)],
            3 => &[(0, -S - 2), (S + 2, 0), (0, S + 2), (-S - 2, 0)],
            _ => &[(-S, -S + 1), (S, -S + 1), (0, S + 1)],
        };
        Polygon::new(corners.iter().map(|at| (x + at.0, y + at.1)).collect::<Vec<_>>(), self.colour.filled())
    }
}

/// A name in the legend.
struct Entry<'a> {
    name: &'a str,
    symbol: Symbol,
}

enum Symbol {
    Line(Style, Mark),
    Failed,
    Field(RGBColor),
}

fn legend_of(lines: &[Line], first: usize) -> impl Iterator<Item = Entry<'_>> {
    let named = lines.iter().enumerate().filter(|(_, line)| !line.name.is_empty());
    let names = named.map(move |(index, line)| Entry {
        name: &line.name,
        symbol: Symbol::Line(line.style(first + index), line.mark),
    });
    let failed = lines.iter().any(|line| !line.failed.is_empty());
    names.chain(failed.then_some(Entry { name: "cross: failed", symbol: Symbol::Failed }))
}

impl Entry<'_> {
    fn draw(&self, area: &Area<'_>, (x, y): (i32, i32)) -> Result<(), String> {
        const REACH: i32 = 48;
        match self.symbol {
            Symbol::Line(style, mark) => {
                let piece = |from: i32, to: i32| {
                    let points = vec![(x + from, y), (x + to, y)];
                    area.draw(&PathElement::new(points, style.colour.stroke_width(STROKE))).map_err(text)
                };
                match mark {
                    Mark::Solid | Mark::Joined => piece(-REACH, REACH)?,
                    Mark::Dashed => {
                        [(-REACH, -24), (-12, 12), (24, REACH)].iter().try_for_each(|at| piece(at.0, at.1))?
                    }
                    Mark::Points => {}
                }
                if matches!(mark, Mark::Points | Mark::Joined) {
                    area.draw(&style.symbol((x, y))).map_err(text)?;
                }
            }
            Symbol::Failed => area.draw(&Cross::new((x, y), SYMBOL, BLACK.stroke_width(STROKE))).map_err(text)?,
            Symbol::Field(colour) => {
                let corners = [(x - REACH, y - 24), (x + REACH, y + 24)];
                area.draw(&Rectangle::new(corners, colour.filled())).map_err(text)?;
            }
        }
        let style = TextStyle::from(("sans-serif", TYPE).into_font());
        let position = style.pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(self.name.to_owned(), (x + REACH + 28, y), position)).map_err(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(axis: &Axis, low: f64, high: f64) -> Scale {
        axis.clone().between(low, high).over(std::iter::empty())
    }

    #[test]
    fn decades_are_marked_as_far_as_there_is_room() {
        let logarithmic = |low, high| scale(&Axis::logarithmic(""), low, high).key_points(8);
        assert_eq!(logarithmic(0.5, 2000.0), [1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(logarithmic(1.5, 60.0), [2.0, 5.0, 10.0, 20.0, 50.0]);
        let many = logarithmic(1e-14, 1.0);
        assert_eq!(logarithmic(2e4, 8e4), [2e4, 3e4, 5e4, 7e4]);
        assert!(many.len() <= 8 && many.len() > 4 && many.iter().all(|value| value.log10().fract().abs() < 1e-9));
    }

    #[test]
    fn marks_are_readable() {
        let logarithmic = scale(&Axis::logarithmic(""), 1e-9, 1e9);
        for (value, text) in [(1e-6, "10⁻⁶"), (2e7, "2·10⁷"), (0.01, "0.01"), (10.0, "10")] {
            assert_eq!(logarithmic.format_ext(&value), text);
        }
        let linear = scale(&Axis::linear(""), -1.0, 1.0);
        for (value, text) in [(0.1 + 0.2, "0.3"), (-1e-17, "0"), (-0.5, "-0.5")] {
            assert_eq!(linear.format_ext(&value), text);
        }
    }

    #[test]
    fn what_an_axis_cannot_show_is_left_out() {
        let points = vec![(1.0, 1.0), (2.0, f64::NAN), (3.0, 0.0), (4.0, 1.0), (5.0, 2.0)];
        let drawing = log_log("", "x", "y", &[Line::settings("", points, vec![(0.0, 1.0)])]).unwrap();
        assert_eq!(drawing.matches("<polygon").count(), 3);
    }

    /// Width of a title by the size of its type, where letters are as wide as in common type without serifs.
    #[test]
    fn a_long_title_stays_within_the_drawing() {
        let title = "m".repeat(90);
        let drawing = log_log(&title, "x", "y", &[Line::new("", Mark::Solid, vec![(1.0, 1.0)])]).unwrap();
        let (before, _) = drawing.split_once(&title).unwrap();
        let (_, size) = before.rsplit_once("font-size=\"").unwrap();
        let size: f64 = size.split_once('"').unwrap().0.parse().unwrap();
        assert!(size * 0.5 * 90.0 < f64::from(WIDTH), "{size}");
    }

    #[test]
    fn a_place_decides_on_colour_and_symbol() {
        let line = || Line::new("", Mark::Points, Vec::new());
        let [first, like, beside] = [line(), line().like(3), line().beside(3)].map(|line| line.style(1));
        assert_eq!((first.colour, first.shape), (COLOURS[1], 1));
        assert_eq!((like.colour, like.shape), (COLOURS[3], 3));
        assert_eq!(beside.colour, COLOURS[3]);
        assert_ne!(beside.shape, 3);
    }

    #[test]
    fn cells_of_a_map_meet() {
        assert_eq!(edges(&[1.0, 2.0, 3.0], false), [0.5, 1.5, 2.5, 3.5]);
        let edges = edges(&[1.0, 100.0], true);
        assert!(edges.iter().zip([0.1, 10.0, 1000.0]).all(|(edge, exact)| (edge / exact - 1.0).abs() < 1e-12));
    }

    #[test]
    fn map_without_its_cells_is_refused() {
        let (axis, grid) = (Axis::logarithmic("x"), [1.0, 10.0]);
        for cells in [vec![], vec![vec![Shade::Failed; 2]], vec![vec![Shade::Failed; 2], vec![Shade::Failed]]] {
            let map = Map { columns: &grid, rows: &grid, cells: &cells, scale: Axis::linear("error") };
            assert!(super::map("", &axis, &axis, &map, &[]).is_err());
        }
    }

    #[test]
    fn failures_and_gaps_of_a_map_have_colours_and_names_of_their_own() {
        let cells = [vec![Shade::Value(1.0), Shade::Failed], vec![Shade::NotApplicable, Shade::Value(2.0)]];
        let grid = [1.0, 10.0];
        let map = Map { columns: &grid, rows: &grid, cells: &cells, scale: Axis::linear("error") };
        let axis = Axis::logarithmic("x");
        let drawing = super::map("", &axis, &axis, &map, &[]).unwrap();
        for (colour, name) in [("#D55E00", "failed"), ("#969696", "not applicable")] {
            // A cell and its entry in the legend.
            assert_eq!(drawing.matches(colour).count(), 2, "{name}");
            assert!(drawing.contains(name));
        }
    }
}
