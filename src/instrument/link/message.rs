//! Messages of the link, and the end of the link in the instrument.

use serde::de::DeserializeOwned;

use super::{Decoder, FrameFault};
use crate::instrument::{Rejection, Rejections, Verdict};

/// Version of the messages. Both ends must have the same version.
///
/// ```
/// assert_eq!(microimpact::instrument::link::PROTOCOL, 2);
/// ```
pub const PROTOCOL: u16 = 2;

/// Message from the host to the instrument. `R` is a [`Reading`](crate::instrument::Reading).
///
/// ```
/// use microimpact::instrument::NormalReading;
/// use microimpact::instrument::link::{Encoder, Request};
///
/// let request = Request::Event { number: 1, reading: NormalReading { approach: 2.8_f32 } };
/// assert!(Encoder::<32>::new().frame(&request).is_ok_and(|frame| frame.len() == 13));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub enum Request<R> {
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
    /// Asks for a [`Report`]. The report follows the replies to all earlier requests.
    Report {
        /// Any number. The reply repeats it.
        number: u32,
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
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub enum Reply<T, C> {
    /// The instrument has started or restarted. All counts are zero, and earlier requests without a reply are lost.
    Started {
        /// The [`PROTOCOL`] of the instrument.
        protocol: u16,
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
    /// All counts.
    Report {
        /// Number of the request.
        number: u32,
        /// The counts.
        report: Report,
    },
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
    /// Number of times that the class lines did not switch.
    pub signal_failures: u64,
    /// Clock ticks while the instrument was awake; zero if it does not count them.
    pub ticks: u64,
}

impl Report {
    /// Whether every valid request was either answered or lost. If not, some requests still wait in the queue.
    ///
    /// ```
    /// use microimpact::instrument::link::Report;
    ///
    /// assert!(!Report { classified: 1, ..Report::default() }.is_complete());
    /// ```
    pub fn is_complete(&self) -> bool {
        let answered = self.classified.saturating_add(self.rejections.total()).saturating_add(self.reports);
        answered.saturating_add(self.lost.into()) == self.arrivals.events.saturating_add(self.arrivals.reports)
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

/// The end of the link in the instrument: it turns received bytes into requests.
///
/// A message with its checksum has up to `N` bytes.
///
/// ```
/// use microimpact::instrument::NormalReading;
/// use microimpact::instrument::link::{Encoder, Inlet, Request};
///
/// let request = Request::Event { number: 1, reading: NormalReading { approach: 2.8 } };
/// let mut encoder = Encoder::<32>::new();
/// let frame = encoder.frame(&request).unwrap();
/// let mut inlet = Inlet::<32>::new();
/// let mut receive = |bytes: &[u8]| bytes.iter().find_map(|&byte| inlet.receive::<NormalReading<f32>>(byte));
/// assert_eq!(receive(frame), Some(request));
/// assert_eq!(receive(frame), None); // a repetition
/// assert_eq!((inlet.arrivals().events, inlet.arrivals().duplicates), (1, 1));
/// ```
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Inlet<const N: usize> {
    decoder: Decoder<N>,
    latest: Option<u32>,
    arrivals: Arrivals,
}

impl<const N: usize> Inlet<N> {
    /// Creates the end of a link that has received nothing yet.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::link::Inlet::<32>::new().arrivals().events, 0);
    /// ```
    pub const fn new() -> Self {
        let faults = FrameFaults { oversized: 0, stuffing: 0, checksum: 0, content: 0 };
        let arrivals = Arrivals { events: 0, reports: 0, duplicates: 0, missing: 0, faults };
        Self { decoder: Decoder::new(), latest: None, arrivals }
    }

    /// Takes a byte. If it completes a request, returns the request. Faults and repetitions are only counted.
    ///
    /// ```
    /// use microimpact::instrument::link::{Encoder, Inlet, Request};
    ///
    /// let mut inlet = Inlet::<32>::new();
    /// let request: Request<f32> = Request::Report { number: 9 };
    /// let mut encoder = Encoder::<32>::new();
    /// let frame = encoder.frame(&request).unwrap();
    /// assert_eq!(frame.iter().find_map(|&byte| inlet.receive(byte)), Some(request));
    /// ```
    pub fn receive<R: DeserializeOwned>(&mut self, byte: u8) -> Option<Request<R>> {
        let request = match self.decoder.push(byte)? {
            Ok(request) => request,
            Err(fault) => {
                self.arrivals.faults.add(fault);
                return None;
            }
        };
        match request {
            Request::Event { number, .. } => self.is_new(number).then_some(request),
            Request::Report { .. } => {
                self.arrivals.reports = self.arrivals.reports.saturating_add(1);
                Some(request)
            }
        }
    }

    /// Whether a number is new, by serial number arithmetic (RFC 1982): it is at most half of the range ahead of the latest.
    /// The first number is always new.
    fn is_new(&mut self, number: u32) -> bool {
        let ahead = self.latest.map_or(1, |latest| number.wrapping_sub(latest));
        let new = ahead != 0 && ahead <= u32::MAX / 2;
        if new {
            self.latest = Some(number);
            self.arrivals.missing = self.arrivals.missing.saturating_add(u64::from(ahead - 1));
            self.arrivals.events = self.arrivals.events.saturating_add(1);
        } else {
            self.arrivals.duplicates = self.arrivals.duplicates.saturating_add(1);
        }
        new
    }

    /// Counts of what was received so far.
    ///
    /// ```
    /// let mut inlet = microimpact::instrument::link::Inlet::<32>::new();
    /// for byte in [0, 1, 2, 3, 0] {
    ///     assert!(inlet.receive::<u8>(byte).is_none());
    /// }
    /// assert_eq!(inlet.arrivals().faults.total(), 1);
    /// ```
    #[inline]
    pub fn arrivals(&self) -> Arrivals {
        self.arrivals
    }
}

impl<const N: usize> Default for Inlet<N> {
    fn default() -> Self {
        Self::new()
    }
}
