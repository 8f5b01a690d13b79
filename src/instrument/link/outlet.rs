//! The end of the link in the host.

use core::fmt;
use core::marker::PhantomData;

use serde::de::DeserializeOwned;

use super::{Decoder, Described, FrameFault, PROTOCOL, Reply, Schema};

/// Why there is no reply to read.
///
/// ```
/// use microimpact::instrument::link::ReplyFault;
///
/// assert!(ReplyFault::Protocol { found: 2 }.to_string().contains("version 2"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub enum ReplyFault {
    /// The frame is damaged.
    Frame(FrameFault),
    /// The instrument has another version of the messages.
    Protocol {
        /// Its version.
        found: u16,
    },
    /// The instrument speaks of other numbers, readings or classes.
    Schema {
        /// What it speaks of.
        found: Schema,
        /// What this host speaks of.
        expected: Schema,
    },
    /// The instrument has not said yet what it speaks of.
    Unannounced,
}

impl fmt::Display for ReplyFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Frame(fault) => fault.fmt(f),
            Self::Protocol { found } => write!(f, "the instrument speaks version {found}, but this host {PROTOCOL}"),
            Self::Schema { found, expected } => {
                let words = |schema: &Schema| [schema.number, schema.reading, schema.classes];
                let (found, expected) = (words(found), words(expected));
                write!(
                    f,
                    "the instrument speaks of numbers, readings and classes {found:?}, but this host of {expected:?}; use the types \
                     of the instrument"
                )
            }
            Self::Unannounced => {
                f.write_str("the instrument has not said what it speaks of; ask it by Request::Describe")
            }
        }
    }
}

impl core::error::Error for ReplyFault {}

/// The end of the link in the host: it turns received bytes into replies with numbers `T` and classes `C` to readings `R`.
///
/// It passes replies on only when the instrument has named its version and its schema, and both are those of the host. A message
/// with its checksum has up to `N` bytes.
///
/// ```
/// use microimpact::instrument::PlanarReading;
/// use microimpact::instrument::link::{Encoder, Outlet, PROTOCOL, Reply, ReplyFault, Schema};
/// use microimpact::{Class, Outcome};
///
/// let mut encoder = Encoder::<32>::new();
/// let schema = Schema::of::<f32, PlanarReading<f32>, Class>();
/// let started: Reply<f32, Class> = Reply::Started { protocol: PROTOCOL, schema };
/// let frame = encoder.frame(&started).unwrap();
/// let mut host = Outlet::<f32, PlanarReading<f32>, Class, 32>::new();
/// assert_eq!(frame.iter().find_map(|&byte| host.receive(byte)), Some(Ok(started)));
///
/// let mut other = Outlet::<f32, PlanarReading<f32>, Outcome, 32>::new();
/// let refused = frame.iter().find_map(|&byte| other.receive(byte));
/// assert!(matches!(refused, Some(Err(ReplyFault::Schema { found, .. })) if found == schema));
/// ```
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outlet<T, R, C, const N: usize> {
    decoder: Decoder<N>,
    announced: bool,
    spoken: PhantomData<fn() -> (T, R, C)>,
}

impl<T, R, C, const N: usize> Outlet<T, R, C, N>
where
    T: Described + DeserializeOwned,
    R: Described,
    C: Described + DeserializeOwned,
{
    /// Creates the end of a link that has received nothing yet.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::{NormalReading, link::Outlet};
    ///
    /// assert_eq!(Outlet::<f32, NormalReading<f32>, Outcome, 32>::new().receive(0), None);
    /// ```
    pub const fn new() -> Self {
        Self { decoder: Decoder::new(), announced: false, spoken: PhantomData }
    }

    /// Takes a byte. If it ends a frame, returns the reply in it.
    ///
    /// # Errors
    /// The fault of the frame, or what keeps the reply from being understood.
    ///
    /// ```
    /// use microimpact::Outcome;
    /// use microimpact::instrument::NormalReading;
    /// use microimpact::instrument::link::{Encoder, Outlet, Reply, ReplyFault};
    ///
    /// let reply: Reply<f32, Outcome> = Reply::Configured { number: 1 };
    /// let mut encoder = Encoder::<16>::new();
    /// let mut host = Outlet::<f32, NormalReading<f32>, Outcome, 16>::new();
    /// let received = encoder.frame(&reply).unwrap().iter().find_map(|&byte| host.receive(byte));
    /// assert_eq!(received, Some(Err(ReplyFault::Unannounced)));
    /// ```
    pub fn receive(&mut self, byte: u8) -> Option<Result<Reply<T, C>, ReplyFault>> {
        // Of an instrument with other types a frame may be no message of this host's. Its announcement is one in any case.
        Some(match self.decoder.push::<Reply<T, C>>(byte)? {
            Ok(reply) => self.understood(reply),
            Err(fault) if self.announced || fault != FrameFault::Content => Err(ReplyFault::Frame(fault)),
            Err(_) => Err(ReplyFault::Unannounced),
        })
    }

    fn understood(&mut self, reply: Reply<T, C>) -> Result<Reply<T, C>, ReplyFault> {
        if let Reply::Started { protocol: found, schema } | Reply::Description { protocol: found, schema, .. } = reply {
            self.announced = false;
            if found != PROTOCOL {
                return Err(ReplyFault::Protocol { found });
            }
            let expected = Schema::of::<T, R, C>();
            if schema != expected {
                return Err(ReplyFault::Schema { found: schema, expected });
            }
            self.announced = true;
        }
        if self.announced { Ok(reply) } else { Err(ReplyFault::Unannounced) }
    }
}

impl<T, R, C, const N: usize> Default for Outlet<T, R, C, N>
where
    T: Described + DeserializeOwned,
    R: Described,
    C: Described + DeserializeOwned,
{
    fn default() -> Self {
        Self::new()
    }
}
