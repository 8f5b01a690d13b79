//! The end of the link in the instrument.

use serde::de::DeserializeOwned;

use super::{Arrivals, Decoder, Report, Request};

/// The end of the link in the instrument: it turns received bytes into requests.
///
/// A message with its checksum has up to `N` bytes.
///
/// ```
/// use microimpact::instrument::NormalReading;
/// use microimpact::instrument::link::{Encoder, Inlet, Request};
///
/// let request: Request<_> = Request::Event { number: 1, reading: NormalReading { approach: 2.8 } };
/// let mut encoder = Encoder::<32>::new();
/// let frame = encoder.frame(&request).unwrap();
/// let mut inlet = Inlet::<32>::new();
/// let mut receive = |bytes: &[u8]| bytes.iter().find_map(|&byte| inlet.receive::<NormalReading<f32>, f32>(byte));
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
        Self { decoder: Decoder::new(), latest: None, arrivals: Report::NONE.arrivals }
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
    pub fn receive<R: DeserializeOwned, T: DeserializeOwned>(&mut self, byte: u8) -> Option<Request<R, T>> {
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
            Request::Describe { .. } | Request::Counts { .. } | Request::Reset { .. } | Request::Configure { .. } => {
                self.arrivals.commands = self.arrivals.commands.saturating_add(1);
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
    ///     assert!(inlet.receive::<u8, f32>(byte).is_none());
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
