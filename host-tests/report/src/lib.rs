//! `cargo write-report`: error against run time, stability, the price of each part, the laws of contact, and the paper's
//! numbers beside ours, as one page with pictures and tables.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Parser;
use clap::builder::PossibleValuesParser;

mod committed;
mod content;
mod cost;
mod device;
mod laws;
mod look;
mod page;
mod paper;
mod plot;
mod price;
mod published;
mod stability;

use content::{Run, Section};
use device::Device;
use page::Chapter;

/// Write a report with pictures and tables into a folder: `index.html`, and the numbers of each as CSV beside it.
///
/// Exit status: 0, 1 if a section failed or a figure is not current, 2 if the report cannot be written.
#[derive(Parser)]
#[command(name = "write-report")]
pub struct Options {
    /// A reduced run within a minute; the full one takes up to a quarter of an hour
    #[arg(long)]
    quick: bool,
    /// Folder to write into [default: target/report of the repository]
    #[arg(long)]
    output: Option<PathBuf>,
    /// Only these sections
    #[arg(long, value_name = "SECTION", value_parser = PossibleValuesParser::new(SECTIONS.map(|(name, _)| name)))]
    only: Vec<String>,
    /// Open the report in Chromium without a window, if it is installed, and fail where it is too long or too wide
    #[arg(long)]
    look: bool,
    /// Draw the figures of the documentation, and nothing else
    #[arg(long, group = "other", conflicts_with_all = ["quick", "output", "only", "look"])]
    figures: bool,
    /// Check whether the figures of the documentation are current, and do nothing else
    #[arg(long, group = "other", conflicts_with_all = ["quick", "output", "only", "look"])]
    check: bool,
    /// Count the instructions of all methods on emulated boards, store them in host-tests/data/methods, and do nothing else
    #[arg(long, group = "other", conflicts_with_all = ["quick", "output", "only", "look"])]
    boards: bool,
}

type Write = fn(&Run) -> Result<Section, String>;

/// The sections in the order of the page.
const SECTIONS: [(&str, Write); 6] = [
    ("cost", cost::section),
    ("stability", stability::section),
    ("price", price::section),
    ("laws", laws::section),
    ("published", published::section),
    ("paper", paper::section),
];

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Does what the options ask for, and returns whether all of it succeeded.
///
/// # Errors
/// A file that cannot be written.
pub fn run(options: &Options) -> Result<bool, Box<dyn Error>> {
    match options {
        Options { figures: true, .. } => committed::write().map(|()| true),
        Options { check: true, .. } => check(),
        Options { boards: true, .. } => Ok(cost::store_boards(&Run { quick: false }).map(|()| true)?),
        _ => write(options),
    }
}

/// Whether the figures of the documentation are current.
fn check() -> Result<bool, Box<dyn Error>> {
    let stale = committed::stale()?;
    if let Some(path) = &stale {
        eprintln!("not current: {}; `cargo write-report --figures` draws it again", path.display());
    }
    Ok(stale.is_none())
}

/// Runs the sections, writes the page, and returns whether all of them succeeded.
fn write(options: &Options) -> Result<bool, Box<dyn Error>> {
    let run = Run { quick: options.quick };
    let begin = Instant::now();
    let mut chapters = Vec::new();
    for (name, section) in SECTIONS.iter().filter(|(name, _)| options.includes(name)) {
        let begin = Instant::now();
        eprintln!("{name} ...");
        let chapter = Chapter { name, section: section(&run), elapsed: begin.elapsed() };
        if let Err(error) = &chapter.section {
            eprintln!("{name} failed: {error}");
        }
        eprintln!("{name}: {:.1} s", chapter.elapsed.as_secs_f64());
        chapters.push(chapter);
    }
    let default = || Path::new(REPOSITORY).join("target/report");
    let folder = options.output.clone().unwrap_or_else(default);
    let device = Device::of(options.quick, begin.elapsed())?;
    let index = page::write(&folder, &device, &chapters, options.quick)?;
    eprintln!("{}", index.display());
    let fits = !options.look || look::fits(&index)?;
    Ok(fits && chapters.iter().all(|chapter| chapter.section.is_ok()))
}

impl Options {
    fn includes(&self, section: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only == section)
    }
}
