//! What a long command says on a terminal while it works: rows, rows a second, and the time left, or what it does. Nothing in a pipe.

use std::cell::Cell;
use std::fmt;
use std::io::{self, Read};
use std::rc::Rc;
use std::time::Duration;

use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// The progress through a table.
pub struct Progress {
    bar: ProgressBar,
    /// Bytes that were read, and those of the whole file if they are known.
    read: Rc<Cell<u64>>,
    all: Option<u64>,
}

/// A reader that counts its bytes.
pub struct Counted<R> {
    source: R,
    read: Rc<Cell<u64>>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.source.read(buffer)?;
        self.read.set(self.read.get() + length as u64);
        Ok(length)
    }
}

/// The line without and with the time left.
const ROWS: &str = "{human_pos} rows, {rate} rows/s, {elapsed}";
const ROWS_OF_ALL: &str = "{bar:30} {human_pos} rows, {rate} rows/s, {eta} left";

fn style(template: &str) -> ProgressStyle {
    // The templates are valid; without one the bar has its own style.
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    style.with_key("rate", |state: &ProgressState, to: &mut dyn fmt::Write| {
        // A terminal that takes no text shows none.
        let _ = write!(to, "{}", HumanCount(state.per_sec() as u64));
    })
}

impl Progress {
    /// The progress through a file of some bytes, if that is known. Only a terminal shows it.
    pub fn new(all: Option<u64>) -> Self {
        Self { bar: ProgressBar::new_spinner().with_style(style(ROWS)), read: Rc::default(), all }
    }

    /// A reader whose bytes count.
    pub fn over<R: Read>(&self, source: R) -> Counted<R> {
        Counted { source, read: Rc::clone(&self.read) }
    }

    /// The bar, which threads advance by the rows that they have computed.
    pub fn bar(&self) -> &ProgressBar {
        &self.bar
    }

    /// Shows nothing, where the rows themselves appear on the terminal.
    pub fn hide(&self) {
        self.bar.set_draw_target(ProgressDrawTarget::hidden());
    }

    /// Takes the rows that were read for those of the bytes that were read.
    pub fn estimate(&self, rows: usize) {
        let read = self.read.get();
        if let Some(all) = self.all.filter(|all| read > 0 && read < *all) {
            if self.bar.length().is_none() {
                self.bar.set_style(style(ROWS_OF_ALL));
            }
            self.bar.set_length((rows as f64 * all as f64 / read as f64) as u64);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Work of unknown length: what it is, and how long it has taken. Only a terminal shows it.
pub struct Waiting(ProgressBar);

/// Between two turns of the sign that work goes on.
const TURN: Duration = Duration::from_millis(100);

impl Waiting {
    /// Says what the work is, until the value is dropped.
    pub fn new(work: String) -> Self {
        let bar = ProgressBar::new_spinner().with_style(style("{spinner} {msg}, {elapsed}")).with_message(work);
        bar.enable_steady_tick(TURN);
        Self(bar)
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
