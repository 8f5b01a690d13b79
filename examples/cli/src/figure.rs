//! Charts of points and lines in SVG files.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

/// A file, or a part of it, that holds one chart.
pub type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The colour of a line that is the only one.
pub const LINE: RGBColor = RED;

/// A line of a chart with its colour.
pub type Line = (RGBColor, Vec<(f64, f64)>);

/// Opens a file to draw in.
pub fn drawing(path: &Path, size: (u32, u32)) -> Result<Panel<'_>, Box<dyn Error>> {
    let area = SVGBackend::new(path, size).into_drawing_area();
    area.fill(&WHITE)?;
    Ok(area)
}

/// Axes to draw on.
pub type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws the axes of a chart; each has a range and a name.
pub fn axes<'a, 'b>(
    area: &'a Panel<'b>,
    caption: &str,
    [(x, x_name), (y, y_name)]: [(Range<f64>, &str); 2],
) -> Result<Chart<'a, 'b>, Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(10)
        .set_label_area_size(LabelAreaPosition::Left, 60)
        .set_label_area_size(LabelAreaPosition::Bottom, 40)
        .build_cartesian_2d(x, y)?;
    chart.configure_mesh().light_line_style(TRANSPARENT).x_desc(x_name).y_desc(y_name).draw()?;
    Ok(chart)
}

/// Draws a chart.
pub fn chart(
    area: &Panel<'_>,
    caption: &str,
    ranges: [(Range<f64>, &str); 2],
    points: impl Iterator<Item = (f64, f64)>,
    lines: impl IntoIterator<Item = Line>,
) -> Result<(), Box<dyn Error>> {
    let mut chart = axes(area, caption, ranges)?;
    chart.draw_series(points.map(|at| Circle::new(at, 2, BLUE.filled())))?;
    for (colour, line) in lines {
        chart.draw_series(LineSeries::new(line, &colour))?;
    }
    Ok(())
}
