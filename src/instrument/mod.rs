//! Classification in an instrument: from the interrupt of a detector to a class and its statistics.
//!
//! ```text
//!  interrupt        main loop
//!  reading ──> Queue ──> Motion ──> Classifier ──> Tally
//!                │          │            │     └──> Signal: class lines
//!              lost      refused     unsolved             └──> failed
//! ```
//!
//! The instrument counts each kind of failure: a reading that finds the queue full (lost), a reading with an invalid value
//! (refused), a motion for which the classifier does not converge (unsolved), and a class line that does not switch (failed).
//! The type of the classifier decides whether a rigid-body model, a simulation or a table classifies the impacts. This module
//! needs the feature `instrument`.
//!
//! | an instrument that | uses |
//! | --- | --- |
//! | has a sensor that delivers integers | [`sensor`], without floating point in the interrupt |
//! | measures the size, or knows the material | [`SizedReading`] and [`PerParticle`]: a scene for each particle |
//! | knows the errors of its readings | [`UncertainReading`] and [`Confident`]: a class with a confidence, or undecided |
//! | has many events | [`Stamped`], [`EventCounter`] and [`corrected_rate`]: dead time and coincidence |
//! | sees the rebound too | [`ObservedRebound`]: e, mu, and how well they agree with the model |
//! | runs for long | [`SizedTally`]: counts against expectation; [`DriftAlarm`], with a stated rate of false alarms |

mod bins;
mod classes;
mod classifier;
mod confidence;
mod counting;
mod drift;
mod lines;
#[cfg(feature = "link")]
pub mod link;
mod observed;
mod pipeline;
mod queue;
mod reading;
pub mod sensor;
mod sized;
mod sized_tally;
mod statistics;
mod tabulated;
mod tally;

pub use bins::{SizeBins, SpeedBins};
pub use classes::ClassSet;
pub use classifier::{Classified, Classifier, Rejection, Simulated, Verdict};
pub use confidence::{Confident, UncertainMotion, UncertainReading};
pub use counting::{Arrival, EventCounter, EventCounts, EventRate, corrected_rate};
pub use drift::{Drift, DriftAlarm};
pub use lines::{ClassLines, NoLines, Signal};
pub use observed::{Agreement, Comparison, ObservedRebound, Scatter};
pub use pipeline::Instrument;
pub use queue::{Queue, Receiver, Sender};
pub use reading::{NormalReading, ObliqueReading, PlanarReading, Reading};
pub use sized::{PerParticle, SizedMotion, SizedReading, Stamped};
pub use sized_tally::{SizedTally, TallyCell};
pub use statistics::Statistics;
pub use tabulated::{Tabulated, TabulatedClass};
pub use tally::{Rejections, Tally};
