//! Drawings of the report, by `plotters` as SVG: lines and points, maps in colour, stacked bars, and rows of points.
//!
//! A drawing has type that can be read on a phone. What is black in it follows the page's colours, and its ground is
//! transparent. The legend stands below the axes; the page has the title and the caption.

use plotters::chart::MeshStyle;
use plotters::coord::Shift;
use plotters::prelude::*;

mod axis;
mod bars;
mod legend;
mod lines;
mod map;
mod rows;

pub(crate) use axis::Axis;
pub(crate) use bars::{Bar, Panel, bars};
pub(crate) use lines::{Line, Mark, chart, tall_chart};
pub(crate) use map::{Flat, Map, Shade, map};
pub(crate) use rows::{height_of, rows};

use axis::Scale;
use legend::Entry;

const WIDTH: u32 = 1720;
/// Height of the axes with their numbers and names.
const HEIGHT: u32 = 1000;
const TYPE: u32 = 56;
const MARGIN: u32 = 24;
/// Room for half of a number at the end of an axis.
const MARGIN_RIGHT: u32 = 76;
/// Width of the numbers and the name of an upright axis.
const LABELS: u32 = 220;
/// Height of those of the other.
const LABELS_BELOW: u32 = 150;
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

/// The place of black among the colours.
pub(crate) const BLACK_PLACE: usize = 6;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Scale, Scale>>;

#[allow(clippy::needless_pass_by_value)]
fn text<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> String {
    format!("a drawing: {error}")
}

/// A drawing of some height, with a legend below.
fn drawn(
    height: u32,
    entries: &[Entry<'_>],
    draw: impl for<'a> FnOnce(&Area<'a>) -> Result<(), String>,
) -> Result<String, String> {
    let mut drawing = String::new();
    {
        let size = (WIDTH, height + legend::height(entries));
        let area = SVGBackend::with_string(&mut drawing, size).into_drawing_area();
        let (upper, below) = area.split_vertically(height);
        draw(&upper)?;
        legend::draw(&below, entries)?;
        area.present().map_err(text)?;
    }
    Ok(drawing)
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
    let x_labels = if area.dim_in_pixel().0 < WIDTH { 6 } else { 8 };
    let mut mesh = chart.configure_mesh();
    mesh.x_desc(&x.label).y_desc(&y.label).x_labels(x_labels).y_labels(8);
    style_mesh(&mut mesh).draw().map_err(text)?;
    Ok(chart)
}

/// Lines and type of the axes of every drawing.
fn style_mesh<'m, 'a, 'b, 'c>(
    mesh: &'m mut MeshStyle<'a, 'b, Scale, Scale, SVGBackend<'c>>,
) -> &'m mut MeshStyle<'a, 'b, Scale, Scale, SVGBackend<'c>> {
    mesh.max_light_lines(1)
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.15).stroke_width(2))
        .axis_style(BLACK.stroke_width(2))
        .set_all_tick_mark_size(12)
        .axis_desc_style(("sans-serif", TYPE))
        .label_style(("sans-serif", TYPE))
}
