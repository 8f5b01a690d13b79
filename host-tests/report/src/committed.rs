//! Figures that the documentation shows: kept in the repository, on a background of their own that suits light and dark pages.
//!
//! They show results alone, never times, and their coordinates are whole numbers: every machine draws the same.

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use percent_encoding::{AsciiSet, CONTROLS, utf8_percent_encode};

use crate::content::{Part, Run, Section};
use crate::paper;

/// Figures by their names, all of one section.
const NAMES: [&str; 2] = ["figure-6", "figure-7"];

/// The file of the documentation, which has no files beside it: each figure is an address that contains the drawing.
const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../src/figures.md");

/// What may not stand in an address, or means something in Markdown.
const ENCODED: &AsciiSet =
    &CONTROLS.add(b' ').add(b'"').add(b'#').add(b'%').add(b'&').add(b'(').add(b')').add(b'<').add(b'>');

/// What the file should contain.
fn drawn() -> Result<String, String> {
    let section = paper::section(&Run { quick: true })?;
    let mut embedded = String::new();
    for name in NAMES {
        let drawing = drawing(&section, name)?;
        embedded += &format!("[{name}]: data:image/svg+xml,{}\n", utf8_percent_encode(&drawing, ENCODED));
    }
    Ok(embedded)
}

fn drawing(section: &Section, name: &str) -> Result<String, String> {
    let figure = section.parts.iter().find_map(|part| match part {
        Part::Figure(figure) if figure.data.name == name => Some(figure),
        _ => None,
    });
    let figure = figure.ok_or_else(|| format!("no figure has the name {name}"))?;
    let (head, rest) = figure.drawing.split_once('\n').ok_or_else(|| format!("{name} is no drawing"))?;
    Ok(format!("{head}\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{rest}"))
}

/// Draws the figures again.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    fs::write(PATH, drawn()?)?;
    eprintln!("{PATH}");
    Ok(())
}

/// The file, if it differs from what would be drawn now.
pub(crate) fn stale() -> Result<Option<PathBuf>, Box<dyn Error>> {
    let current = drawn()?;
    let is_current = fs::read_to_string(PATH).is_ok_and(|text| text == current);
    Ok((!is_current).then(|| PathBuf::from(PATH)))
}
