//! Messages of the link.

use heapless::Vec;

use super::{FrameFault, Schema};
use crate::instrument::{Rejection, Rejections, Verdict};
use crate::{InputError, SceneConfig};

/// Version of the messages. Both ends must have the same version.
///
/// ```
/// assert_eq!(microimpact::instrument::link::PROTOCOL, 3);
/// ```
pub const PROTOCOL: u16 = 3;

/// Message from the host to the instrument. `R` is a [`Reading`](crate::instrument::Reading), and `T` the number type of scenes.
///
/// Every request but an event has any number, which the reply repeats. Its reply follows the replies to all earlier requests.
///
/// ```
/// use microimpact::instrument::NormalReading;
/// use microimpact::instrument::link::{Encoder, Request};
///
/// let request: Request<_> = Request::Event { number: 1, reading: NormalReading { approach: 2.8_f32 } };
/// assert!(Encoder::<32>::new().frame(&request).is_ok_and(|frame| frame.len() == 13));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub enum Request<R, T = f32> {
    /// A reading to classify.
    ///
    /// A number is used only once, even if the frame is damaged or the queue is full. A reading that is sent again gets a new
    /// number.
    Event {
        /// The number of the previous reading plus one; zero follows the largest number.
        number: u32,
        /// The reading.
        reading: R,
    },
    /// Asks for a [`Report`], which tells the health of the instrument too.
    Report {
        /// Any number.
        number: u32,
    },
    /// Asks for version and schema, as a host that comes later does.
    Describe {
        /// Any number.
        number: u32,
    },
    /// Asks for the number of readings in each class.
    Counts {
        /// Any number.
        number: u32,
    },
    /// Empties the tally. The reply has what it held. A [`Report`] still counts from the start.
    Reset {
        /// Any number.
        number: u32,
    },
    /// Sets the scene by which later readings are classified. The counts go on.
    Configure {
        /// Any number.
        number: u32,
        /// The scene.
        scene: SceneConfig<T>,
    },
}

/// Message from the instrument to the host, for verdicts with numbers `T` and classes `C`.
///
/// ```
/// use microimpact::Class;
/// use microimpact::instrument::Verdict;
/// use microimpact::instrument::link::{Encoder, Reply};
///
/// let verdict = Verdict { class: Class::ReboundRolling, restitution: Some(0.746_f32) };
/// let reply = Reply::Classified { number: 1, verdict };
/// assert!(Encoder::<32>::new().frame(&reply).is_ok_and(|frame| frame.len() <= 16));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub enum Reply<T, C> {
    /// The instrument has started or restarted. All counts are zero, and earlier requests without a reply are lost.
    Started {
        /// The [`PROTOCOL`] of the instrument.
        protocol: u16,
        /// What it speaks of.
        schema: Schema,
    },
    /// The verdict on a reading.
    Classified {
        /// Number of the reading.
        number: u32,
        /// The verdict.
        verdict: Verdict<T, C>,
    },
    /// The reading has no class.
    Rejected {
        /// Number of the reading.
        number: u32,
        /// The reason.
        rejection: Rejection,
    },
    /// All counts of requests.
    Report {
        /// Number of the request.
        number: u32,
        /// The counts.
        report: Report,
    },
    /// What the instrument speaks of.
    Description {
        /// Number of the request.
        number: u32,
        /// The [`PROTOCOL`] of the instrument.
        protocol: u16,
        /// What it speaks of.
        schema: Schema,
    },
    /// The number of readings in each class since the tally was emptied, in the order of the classes.
    Counts {
        /// Number of the request.
        number: u32,
        /// The counts.
        counts: Vec<u64, MOST_CLASSES>,
    },
    /// The tally was emptied.
    Reset {
        /// Number of the request.
        number: u32,
        /// The number of readings in each class until then.
        counts: Vec<u64, MOST_CLASSES>,
    },
    /// The scene was set.
    Configured {
        /// Number of the request.
        number: u32,
    },
    /// The scene was not set, and the earlier one is still there.
    Refused {
        /// Number of the request.
        number: u32,
        /// The reason.
        refusal: Refusal,
    },
}

/// Classes whose counts find room in a reply.
///
/// ```
/// use microimpact::{Class, instrument::{ClassSet, link::MOST_CLASSES}};
///
/// assert!(Class::COUNT <= MOST_CLASSES);
/// ```
pub const MOST_CLASSES: usize = 16;

/// Why a scene was not set.
///
/// ```
/// use microimpact::Parameter;
/// use microimpact::instrument::link::Refusal;
///
/// let refusal = Refusal::from(Parameter::Radius.check(-1.0).unwrap_err());
/// assert!(matches!(refusal, Refusal::Input(error) if error.parameter == Parameter::Radius));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub enum Refusal {
    /// A number is outside its range.
    Input(InputError),
    /// The scene of this instrument does not change.
    Fixed,
}

impl From<InputError> for Refusal {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

/// Counts of all requests since the instrument started.
///
/// ```
/// use microimpact::instrument::link::{Arrivals, Report};
///
/// let arrivals = Arrivals { events: 10, reports: 1, ..Arrivals::default() };
/// let report = Report { arrivals, lost: 2, classified: 8, reports: 1, ..Report::default() };
/// assert!(report.is_complete());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Report {
    /// Received requests.
    pub arrivals: Arrivals,
    /// Requests that found the queue full.
    pub lost: u32,
    /// Readings with a class.
    pub classified: u64,
    /// Readings without a class.
    pub rejections: Rejections,
    /// Reports, including this one.
    pub reports: u64,
    /// Answers to other requests than events and reports.
    pub commands: u64,
    /// Number of times that the class lines did not switch.
    pub signal_failures: u64,
    /// Clock ticks while the instrument was awake; zero if it does not count them.
    pub ticks: u64,
}

impl Report {
    /// No requests so far.
    pub(super) const NONE: Self = Self {
        arrivals: Arrivals {
            events: 0,
            reports: 0,
            commands: 0,
            duplicates: 0,
            missing: 0,
            faults: FrameFaults { oversized: 0, stuffing: 0, checksum: 0, content: 0 },
        },
        lost: 0,
        classified: 0,
        rejections: Rejections { input: 0, unsolved: 0 },
        reports: 0,
        commands: 0,
        signal_failures: 0,
        ticks: 0,
    };

    /// Whether every valid request was either answered or lost. If not, some requests still wait in the queue.
    ///
    /// ```
    /// use microimpact::instrument::link::Report;
    ///
    /// assert!(!Report { classified: 1, ..Report::default() }.is_complete());
    /// ```
    pub fn is_complete(&self) -> bool {
        let sum = |counts: &[u64]| counts.iter().fold(0_u64, |sum, &count| sum.saturating_add(count));
        let Arrivals { events, reports, commands, .. } = self.arrivals;
        let answered = [self.classified, self.rejections.total(), self.reports, self.commands, self.lost.into()];
        sum(&answered) == sum(&[events, reports, commands])
    }
}

/// Counts of what the instrument received over the link.
///
/// ```
/// assert_eq!(microimpact::instrument::link::Arrivals::default().faults.total(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Arrivals {
    /// Valid readings, without repetitions.
    pub events: u64,
    /// Requests for a report.
    pub reports: u64,
    /// Other requests.
    pub commands: u64,
    /// Repeated readings: their number is not above the latest number.
    pub duplicates: u64,
    /// Missing readings: numbers that were skipped.
    pub missing: u64,
    /// Faulty frames.
    pub faults: FrameFaults,
}

/// Counts of faulty frames, by fault.
///
/// ```
/// use microimpact::instrument::link::{FrameFault, FrameFaults};
///
/// let mut faults = FrameFaults::default();
/// faults.add(FrameFault::Checksum);
/// assert_eq!((faults.checksum, faults.total()), (1, 1));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub struct FrameFaults {
    /// [`FrameFault::Oversized`].
    pub oversized: u64,
    /// [`FrameFault::Stuffing`].
    pub stuffing: u64,
    /// [`FrameFault::Checksum`].
    pub checksum: u64,
    /// [`FrameFault::Content`].
    pub content: u64,
}

impl FrameFaults {
    /// Counts a fault.
    ///
    /// ```
    /// use microimpact::instrument::link::{FrameFault, FrameFaults};
    ///
    /// let mut faults = FrameFaults::default();
    /// faults.add(FrameFault::Content);
    /// assert_eq!(faults.content, 1);
    /// ```
    pub fn add(&mut self, fault: FrameFault) {
        let count = match fault {
            FrameFault::Oversized => &mut self.oversized,
            FrameFault::Stuffing => &mut self.stuffing,
            FrameFault::Checksum => &mut self.checksum,
            FrameFault::Content => &mut self.content,
        };
        *count = count.saturating_add(1);
    }

    /// Number of all faulty frames.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::link::FrameFaults::default().total(), 0);
    /// ```
    pub fn total(&self) -> u64 {
        [self.oversized, self.stuffing, self.checksum, self.content].iter().fold(0, |sum, &n| sum.saturating_add(n))
    }
}
