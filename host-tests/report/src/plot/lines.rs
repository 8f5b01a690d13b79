//! Lines and points over two axes.

use plotters::prelude::*;

use super::legend::{Entry, Symbol};
use super::{Axis, COLOURS, Chart, HEIGHT, STROKE, axes, drawn, text};

/// Half the size of a symbol.
pub(super) const SYMBOL: i32 = 14;
/// Radius of a dot.
const DOT: i32 = 8;
/// Shapes of symbols; their number has no factor in common with that of the colours.
const SHAPES: usize = 5;

/// How the points of a line are drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    Solid,
    Dashed,
    /// Symbols alone.
    Points,
    /// Small dots alone, for many points.
    Dots,
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
    /// A line without a name is not in the legend.
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

    /// A method with a point for each of its settings.
    pub(crate) fn settings(name: &str, points: Vec<(f64, f64)>, failed: Vec<(f64, f64)>) -> Self {
        Self { failed, ..Self::new(name, Mark::Joined, points) }
    }

    /// Colour and symbol where the line is one of many.
    fn style(&self, index: usize) -> Style {
        Style::of(self.place.unwrap_or(index))
    }

    fn all(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.points.iter().chain(&self.failed)
    }
}

/// Lines and points over two axes; crosses are what failed.
pub(crate) fn chart(x: &Axis, y: &Axis, lines: &[Line]) -> Result<String, String> {
    of_height(HEIGHT, x, y, lines)
}

/// The same for a narrow column.
pub(crate) fn tall_chart(x: &Axis, y: &Axis, lines: &[Line]) -> Result<String, String> {
    of_height(3 * HEIGHT / 2, x, y, lines)
}

fn of_height(height: u32, x: &Axis, y: &Axis, lines: &[Line]) -> Result<String, String> {
    let entries: Vec<_> = legend_of(lines, 0).collect();
    drawn(height, &entries, |area| {
        let mut chart = axes(area, (x, y), lines.iter().flat_map(Line::all).copied())?;
        draw_lines(&mut chart, (x, y), lines, 0)
    })
}

pub(super) fn draw_lines(
    chart: &mut Chart<'_>,
    (x, y): (&Axis, &Axis),
    lines: &[Line],
    first: usize,
) -> Result<(), String> {
    let visible = |at: &(f64, f64)| x.can_show(at.0) && y.can_show(at.1);
    for (index, line) in lines.iter().enumerate() {
        let style = line.style(first + index);
        let shown = line.points.iter().filter(|at| visible(at));
        if !matches!(line.mark, Mark::Points | Mark::Dots) {
            for piece in line.points.split(|at| !visible(at)) {
                let (points, stroke) = (piece.iter().copied(), style.colour.stroke_width(STROKE));
                if line.mark == Mark::Dashed {
                    chart.draw_series(DashedLineSeries::new(points, 24, 16, stroke)).map_err(text)?;
                } else {
                    chart.draw_series(LineSeries::new(points, stroke)).map_err(text)?;
                }
            }
        }
        match line.mark {
            Mark::Points | Mark::Joined => {
                chart.draw_series(shown.map(|at| EmptyElement::at(*at) + style.symbol((0, 0)))).map_err(text)?;
            }
            Mark::Dots => {
                chart.draw_series(shown.map(|at| Circle::new(*at, DOT, style.colour.filled()))).map_err(text)?;
            }
            Mark::Solid | Mark::Dashed => {}
        }
        for at in line.failed.iter().filter(|at| visible(at)) {
            chart.draw_series([Cross::new(*at, SYMBOL, style.colour.stroke_width(STROKE))]).map_err(text)?;
        }
    }
    Ok(())
}

pub(super) fn legend_of(lines: &[Line], first: usize) -> impl Iterator<Item = Entry<'_>> {
    let named = lines.iter().enumerate().filter(|(_, line)| !line.name.is_empty());
    let names = named.map(move |(index, line)| Entry {
        name: &line.name,
        symbol: Symbol::Line(line.style(first + index), line.mark),
    });
    let failed = lines.iter().any(|line| !line.failed.is_empty());
    names.chain(failed.then_some(Entry { name: "cross: failed", symbol: Symbol::Failed }))
}

/// Colour and shape of the line in a place of the order.
#[derive(Clone, Copy)]
pub(super) struct Style {
    pub(super) colour: RGBColor,
    shape: usize,
}

impl Style {
    fn of(index: usize) -> Self {
        Self { colour: COLOURS[index % COLOURS.len()], shape: index % SHAPES }
    }

    /// The symbol around a place in pixels.
    pub(super) fn symbol(self, (x, y): (i32, i32)) -> Polygon<(i32, i32)> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_axis_cannot_show_is_left_out() {
        let points = vec![(1.0, 1.0), (2.0, f64::NAN), (3.0, 0.0), (4.0, 1.0), (5.0, 2.0)];
        let axis = Axis::logarithmic("length", "x", "m");
        let drawing = chart(&axis, &axis, &[Line::settings("", points, vec![(0.0, 1.0)])]).unwrap();
        assert_eq!(drawing.matches("<polygon").count(), 3);
        assert_eq!(drawing.matches("length x [m]").count(), 2);
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
}
