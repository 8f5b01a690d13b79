//! From an interrupt to a class: what an instrument does with the impacts that its detector sees.
//!
//! ```text
//!  interrupt        main loop
//!  reading ──> Queue ──> Motion ──> Classifier ──> Tally
//!                │          │            │     └──> Signal: class lines
//!              lost      refused     unsolved             └──> failed
//! ```
//!
//! What goes wrong on the way is counted by name: a reading that finds the queue full, one that no particle can have, one
//! that the classifier cannot solve, and a line that does not switch. The type of the classifier says whether a rigid body, a
//! simulation or a table classifies. Needs the feature `instrument`.

mod classes;
mod classifier;
mod lines;
#[cfg(feature = "link")]
pub mod link;
mod pipeline;
mod queue;
mod reading;
mod statistics;
mod tabulated;
mod tally;

pub use classes::ClassSet;
pub use classifier::{Classified, Classifier, Rejection, Simulated, Verdict};
pub use lines::{ClassLines, NoLines, Signal};
pub use pipeline::Instrument;
pub use queue::{Queue, Receiver, Sender};
pub use reading::{NormalReading, ObliqueReading, PlanarReading, Reading};
pub use statistics::Statistics;
pub use tabulated::{Tabulated, TabulatedClass};
pub use tally::{Rejections, SpeedBins, Tally};
