//! Figures that README shows: kept in the repository, on a ground of their own that reads in light and dark.
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

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/figures");

/// The same as addresses that contain the drawings, for documentation, which has no files beside it: README names its figures
/// by labels, and of two definitions of a label the first counts.
const EMBEDDED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../src/figures.md");

/// What may not stand in an address, or means something in Markdown.
const ENCODED: &AsciiSet =
    &CONTROLS.add(b' ').add(b'"').add(b'#').add(b'%').add(b'&').add(b'(').add(b')').add(b'<').add(b'>');

/// The files with what they ought to contain.
fn drawn() -> Result<Vec<(PathBuf, String)>, String> {
    let section = paper::section(&Run { quick: true })?;
    let (mut files, mut embedded) = (Vec::new(), String::new());
    for name in NAMES {
        let drawing = drawing(&section, name)?;
        embedded += &format!("[{name}]: data:image/svg+xml,{}\n", utf8_percent_encode(&drawing, ENCODED));
        files.push((PathBuf::from(FOLDER).join(format!("{name}.svg")), drawing));
    }
    files.push((PathBuf::from(EMBEDDED), embedded));
    Ok(files)
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

/// Draws them anew.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(FOLDER)?;
    for (path, drawing) in drawn()? {
        fs::write(&path, drawing)?;
        eprintln!("{}", path.display());
    }
    Ok(())
}

/// Those that differ from what would be drawn now.
pub(crate) fn stale() -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let current = |(path, drawing): &(PathBuf, String)| fs::read_to_string(path).is_ok_and(|text| text == *drawing);
    Ok(drawn()?.into_iter().filter(|file| !current(file)).map(|(path, _)| path).collect())
}
