//! The names of lines and fields, below the axes.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::lines::{Mark, SYMBOL, Style};
use super::{Area, MARGIN, STROKE, TYPE, WIDTH, text};

/// Height of a row.
const ROW: u32 = 74;
/// Longest name that leaves room for another beside it.
const HALF_A_ROW: usize = 25;
/// Half the width of what stands before a name.
const REACH: i32 = 44;

/// A name in the legend.
pub(super) struct Entry<'a> {
    pub(super) name: &'a str,
    pub(super) symbol: Symbol,
}

pub(super) enum Symbol {
    Line(Style, Mark),
    Failed,
    Field(RGBColor),
}

fn columns(entries: &[Entry<'_>]) -> usize {
    if entries.iter().all(|entry| entry.name.chars().count() <= HALF_A_ROW) { 2 } else { 1 }
}

pub(super) fn height(entries: &[Entry<'_>]) -> u32 {
    u32::try_from(entries.len().div_ceil(columns(entries))).unwrap_or(0) * ROW + MARGIN
}

pub(super) fn draw(area: &Area<'_>, entries: &[Entry<'_>]) -> Result<(), String> {
    let columns = columns(entries);
    let place = |index: usize, size: u32| i32::try_from(index).unwrap_or(0) * size.cast_signed();
    entries.iter().enumerate().try_for_each(|(index, entry)| {
        let left = 76 + place(index % columns, WIDTH / 2);
        entry.draw(area, (left, place(index / columns, ROW) + ROW.cast_signed() / 2))
    })
}

impl Entry<'_> {
    fn draw(&self, area: &Area<'_>, (x, y): (i32, i32)) -> Result<(), String> {
        match self.symbol {
            Symbol::Line(style, mark) => {
                let piece = |from: i32, to: i32| {
                    let points = vec![(x + from, y), (x + to, y)];
                    area.draw(&PathElement::new(points, style.colour.stroke_width(STROKE))).map_err(text)
                };
                match mark {
                    Mark::Solid | Mark::Joined => piece(-REACH, REACH)?,
                    Mark::Dashed => {
                        [(-REACH, -20), (-12, 12), (20, REACH)].iter().try_for_each(|at| piece(at.0, at.1))?
                    }
                    Mark::Points | Mark::Dots => {}
                }
                match mark {
                    Mark::Points | Mark::Joined => area.draw(&style.symbol((x, y))).map_err(text)?,
                    Mark::Dots => area.draw(&Circle::new((x, y), SYMBOL, style.colour.filled())).map_err(text)?,
                    Mark::Solid | Mark::Dashed => {}
                }
            }
            Symbol::Failed => area.draw(&Cross::new((x, y), SYMBOL, BLACK.stroke_width(STROKE))).map_err(text)?,
            Symbol::Field(colour) => {
                let corners = [(x - REACH, y - 22), (x + REACH, y + 22)];
                area.draw(&Rectangle::new(corners, colour.filled())).map_err(text)?;
            }
        }
        let style = TextStyle::from(("sans-serif", TYPE).into_font());
        let position = style.pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(self.name.to_owned(), (x + REACH + 24, y), position)).map_err(text)
    }
}
