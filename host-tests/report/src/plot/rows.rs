//! Points beside the names of rows, over one axis.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::lines::{draw_lines, legend_of};
use super::{Axis, LABELS_BELOW, Line, MARGIN, MARGIN_RIGHT, Mark, TYPE, drawn, style_mesh, text};

/// Height of a row.
const ROW: u32 = 86;
/// Width of the names.
const NAMES: u32 = 470;

/// The height of a row in the points of its lines: the first is at the top.
pub(crate) fn height_of(row: usize, rows: usize) -> f64 {
    (rows - 1 - row) as f64 + 0.5
}

/// Lines whose points stand at the heights of rows, and an upright line at `mark`.
pub(crate) fn rows(names: &[String], axis: &Axis, mark: f64, lines: &[Line]) -> Result<String, String> {
    let entries: Vec<_> = legend_of(lines, 0).collect();
    let count = names.len();
    let height = u32::try_from(count).unwrap_or(0) * ROW + LABELS_BELOW + MARGIN;
    drawn(height, &entries, |area| {
        let upright = Axis::labelled(String::new()).between(0.0, count as f64);
        let along = lines.iter().flat_map(|line| line.points.iter().map(|at| at.0)).chain([mark]);
        let mut chart = ChartBuilder::on(area)
            .margin_top(MARGIN)
            .margin_right(MARGIN_RIGHT)
            .set_label_area_size(LabelAreaPosition::Left, NAMES)
            .set_label_area_size(LabelAreaPosition::Bottom, LABELS_BELOW)
            .build_cartesian_2d(axis.over(along), upright.over(std::iter::empty()))
            .map_err(text)?;
        let mut mesh = chart.configure_mesh();
        mesh.disable_y_mesh().disable_y_axis().x_desc(&axis.label).x_labels(8);
        style_mesh(&mut mesh).draw().map_err(text)?;
        let line = Line::new("", Mark::Solid, vec![(mark, 0.0), (mark, count as f64)]).like(super::BLACK_PLACE);
        draw_lines(&mut chart, (axis, &upright), &[line], 0)?;
        draw_lines(&mut chart, (axis, &upright), lines, 0)?;
        let style = TextStyle::from(("sans-serif", TYPE).into_font()).pos(Pos::new(HPos::Right, VPos::Center));
        let left = chart.as_coord_spec().x_spec().range().start;
        for (row, name) in names.iter().enumerate() {
            let name = Text::new(name.clone(), (-20, 0), style.clone());
            chart.plotting_area().draw(&(EmptyElement::at((left, height_of(row, count))) + name)).map_err(text)?;
        }
        Ok(())
    })
}
