//! Stacked bars, which lie: a panel with an axis of its own for each thing that is compared.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::legend::{self, Entry, Symbol};
use super::{Axis, COLOURS, LABELS_BELOW, MARGIN, MARGIN_RIGHT, TYPE, WIDTH, style_mesh, text};

/// Height of a bar with its gap.
const ROW: u32 = 84;
/// Width of the names of the bars.
const NAMES: u32 = 400;
/// Height of the title of a panel.
const TITLE: u32 = 76;

/// A bar with the lengths of its pieces, in the order of the panel's names.
pub(crate) struct Bar {
    pub(crate) name: String,
    pub(crate) pieces: Vec<f64>,
}

/// Bars over one axis.
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) axis: Axis,
    /// Names of the pieces.
    pub(crate) names: Vec<&'static str>,
    pub(crate) bars: Vec<Bar>,
}

impl Panel {
    fn entries(&self) -> Vec<Entry<'_>> {
        let entry = |(index, name)| Entry { name, symbol: Symbol::Field(COLOURS[index]) };
        self.names.iter().copied().enumerate().map(entry).collect()
    }

    fn height(&self) -> u32 {
        TITLE + u32::try_from(self.bars.len()).unwrap_or(0) * ROW + LABELS_BELOW + legend::height(&self.entries())
    }

    fn draw(&self, area: &super::Area<'_>) -> Result<(), String> {
        let entries = self.entries();
        let (upper, below) = area.split_vertically(self.height() - legend::height(&entries));
        let style = |position| TextStyle::from(("sans-serif", TYPE).into_font()).pos(position);
        let title = style(Pos::new(HPos::Left, VPos::Center));
        let place = (MARGIN.cast_signed(), TITLE.cast_signed() / 2);
        upper.draw(&Text::new(self.title.clone(), place, title)).map_err(text)?;

        let ends = self.bars.iter().map(|bar| bar.pieces.iter().sum());
        let axis = self.axis.clone().between(0.0, ends.fold(f64::MIN_POSITIVE, f64::max) * 1.02);
        let rows = Axis::labelled(String::new()).between(0.0, self.bars.len() as f64);
        let mut chart = ChartBuilder::on(&upper)
            .margin_top(TITLE)
            .margin_right(MARGIN_RIGHT)
            .set_label_area_size(LabelAreaPosition::Left, NAMES)
            .set_label_area_size(LabelAreaPosition::Bottom, LABELS_BELOW)
            .build_cartesian_2d(axis.over(std::iter::empty()), rows.over(std::iter::empty()))
            .map_err(text)?;
        let mut mesh = chart.configure_mesh();
        mesh.disable_y_mesh().disable_y_axis().x_desc(&axis.label).x_labels(6);
        style_mesh(&mut mesh).draw().map_err(text)?;
        for (index, bar) in self.bars.iter().enumerate() {
            // The first is at the top.
            let bottom = (self.bars.len() - 1 - index) as f64;
            let mut left = 0.0;
            for (piece, colour) in bar.pieces.iter().zip(COLOURS) {
                let corners = [(left, bottom + 0.12), (left + piece, bottom + 0.88)];
                chart.draw_series([Rectangle::new(corners, colour.filled())]).map_err(text)?;
                left += piece;
            }
            let name = Text::new(bar.name.clone(), (-20, 0), style(Pos::new(HPos::Right, VPos::Center)));
            chart.plotting_area().draw(&(EmptyElement::at((0.0, bottom + 0.5)) + name)).map_err(text)?;
        }
        legend::draw(&below, &entries)
    }
}

/// Panels one above the other. No piece is shorter than nothing, and there are no more names than colours.
pub(crate) fn bars(panels: &[Panel]) -> Result<String, String> {
    let pieces = |panel: &Panel| panel.bars.iter().flat_map(|bar| bar.pieces.clone()).collect::<Vec<_>>();
    if let Some(panel) = panels.iter().find(|panel| pieces(panel).iter().any(|piece| !(0.0..).contains(piece))) {
        return Err(format!("a piece of a bar of \"{}\" is negative or no number; draw it as a point", panel.title));
    }
    if panels.iter().any(|panel| panel.names.len() > COLOURS.len()) {
        return Err(format!("a bar has more than {} pieces; join some of them", COLOURS.len()));
    }
    let mut drawing = String::new();
    {
        let height = panels.iter().map(Panel::height).sum();
        let mut area = SVGBackend::with_string(&mut drawing, (WIDTH, height)).into_drawing_area();
        let whole = area.clone();
        for panel in panels {
            let (upper, below) = area.split_vertically(panel.height());
            panel.draw(&upper)?;
            area = below;
        }
        whole.present().map_err(text)?;
    }
    Ok(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(pieces: Vec<f64>) -> Panel {
        Panel {
            title: "a title".to_owned(),
            axis: Axis::linear("instructions", "N", "1"),
            names: vec!["first", "second"],
            bars: vec![Bar { name: "a core".to_owned(), pieces }],
        }
    }

    #[test]
    fn pieces_are_as_long_as_their_numbers() {
        let drawing = bars(&[panel(vec![30.0, 60.0])]).unwrap();
        let width = |colour: &str| {
            let rectangle = drawing.lines().find(|line| line.contains("<rect") && line.contains(colour)).unwrap();
            let (_, rest) = rectangle.split_once(" width=\"").unwrap();
            rest.split_once('"').unwrap().0.parse::<f64>().unwrap()
        };
        // Those of the legend come after the bars.
        let (first, second) = (width("#0072B2"), width("#D55E00"));
        assert!((second / first - 2.0).abs() < 0.01, "{first}, {second}");
        assert!(["a core", "a title", "first", "instructions N [1]"].iter().all(|text| drawing.contains(text)));
    }

    #[test]
    fn what_cannot_be_stacked_is_refused() {
        assert!(bars(&[panel(vec![1.0, -1.0])]).is_err() && bars(&[panel(vec![f64::NAN])]).is_err());
    }
}
