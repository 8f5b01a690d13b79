//! Frames: messages with a checksum, between two zero bytes.

use core::fmt;

use cobs::{CobsEncoder, DecodeResult, DecoderState};
use crc::{CRC_32_ISO_HDLC, Crc, Digest, Table};
use heapless::Vec;
use serde::{Serialize, de::DeserializeOwned};

static CHECKSUM: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);
const CHECKSUM_BYTES: usize = size_of::<u32>();
const END: u8 = 0;

/// Fault of a received frame.
///
/// ```
/// use microimpact::instrument::link::{Decoder, FrameFault};
///
/// let mut decoder = Decoder::<16>::new();
/// let received: Vec<_> = [9, 2, 3, 0].iter().filter_map(|&byte| decoder.push::<u8>(byte)).collect();
/// assert_eq!(received, [Err(FrameFault::Stuffing)]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub enum FrameFault {
    /// The frame is longer than any message.
    Oversized,
    /// The frame is cut off, or it contains a byte that COBS does not allow.
    Stuffing,
    /// The checksum is wrong or missing.
    Checksum,
    /// The checksum is right, but the content is not a known message.
    Content,
}

impl fmt::Display for FrameFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Oversized => "frame is longer than any message",
            Self::Stuffing => "frame is cut off or not encoded by COBS",
            Self::Checksum => "checksum of a frame is wrong",
            Self::Content => "frame contains no known message",
        })
    }
}

impl core::error::Error for FrameFault {}

/// Encoder of frames with up to `N` bytes.
///
/// ```
/// use microimpact::instrument::link::{Decoder, Encoder};
///
/// let mut encoder = Encoder::<32>::new();
/// let frame = encoder.frame(&(7_u8, 2.8_f32)).unwrap();
/// let mut decoder = Decoder::<32>::new();
/// assert_eq!(frame.iter().find_map(|&byte| decoder.push(byte)), Some(Ok((7_u8, 2.8_f32))));
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Encoder<const N: usize> {
    message: [u8; N],
    frame: [u8; N],
}

impl<const N: usize> Encoder<N> {
    /// Creates an encoder.
    ///
    /// ```
    /// assert!(microimpact::instrument::link::Encoder::<16>::new().frame(&1_u32).is_ok());
    /// ```
    pub const fn new() -> Self {
        Self { message: [0; N], frame: [0; N] }
    }

    /// Encodes a message. The frame includes both zero bytes.
    ///
    /// # Errors
    /// The message is too long.
    ///
    /// ```
    /// use microimpact::instrument::link::{Encoder, FrameFault};
    ///
    /// assert_eq!(Encoder::<8>::new().frame(&[1.0_f64; 2]), Err(FrameFault::Oversized));
    /// ```
    pub fn frame(&mut self, message: &impl Serialize) -> Result<&[u8], FrameFault> {
        let message = postcard::to_slice(message, &mut self.message).map_err(|_| FrameFault::Oversized)?;
        let checksum = CHECKSUM.checksum(message).to_le_bytes();
        let (start, rest) = self.frame.split_first_mut().ok_or(FrameFault::Oversized)?;
        *start = END;
        let mut stuffed = CobsEncoder::new(rest);
        stuffed.push(message).and_then(|()| stuffed.push(&checksum)).map_err(|_| FrameFault::Oversized)?;
        let length = stuffed.finalize();
        *rest.get_mut(length).ok_or(FrameFault::Oversized)? = END;
        self.frame.get(..length + 2).ok_or(FrameFault::Oversized)
    }
}

impl<const N: usize> Default for Encoder<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// Decoder that finds frames in a stream of bytes. A message with its checksum has up to `N` bytes.
///
/// ```
/// use microimpact::instrument::link::{Decoder, Encoder, FrameFault};
///
/// let mut encoder = Encoder::<32>::new();
/// let mut stream = b"noise".to_vec();
/// stream.extend(encoder.frame(&1_u32).unwrap());
/// stream.extend(&encoder.frame(&2_u32).unwrap()[..4]);
/// stream.extend(encoder.frame(&3_u32).unwrap());
/// let mut decoder = Decoder::<32>::new();
/// let received: Vec<_> = stream.iter().filter_map(|&byte| decoder.push::<u32>(byte)).collect();
/// assert_eq!(received, [Err(FrameFault::Stuffing), Ok(1), Err(FrameFault::Stuffing), Ok(3)]);
/// ```
#[derive(Debug)]
pub struct Decoder<const N: usize> {
    stuffing: DecoderState,
    message: Vec<u8, N>,
    oversized: bool,
}

impl<const N: usize> Decoder<N> {
    /// Creates a decoder that has received nothing yet.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::link::Decoder::<16>::new().push::<u8>(0), None);
    /// ```
    pub const fn new() -> Self {
        Self { stuffing: DecoderState::Idle, message: Vec::new(), oversized: false }
    }

    /// Takes a byte. If it ends a frame, returns the message or the fault of the frame.
    ///
    /// # Errors
    /// The fault of the frame.
    ///
    /// ```
    /// use microimpact::instrument::link::{Decoder, Encoder};
    ///
    /// let mut encoder = Encoder::<16>::new();
    /// let mut decoder = Decoder::<16>::new();
    /// let (last, first) = encoder.frame(&5_u8).unwrap().split_last().unwrap();
    /// assert!(first.iter().all(|&byte| decoder.push::<u8>(byte).is_none()));
    /// assert_eq!(decoder.push::<u8>(*last), Some(Ok(5)));
    /// ```
    pub fn push<M: DeserializeOwned>(&mut self, byte: u8) -> Option<Result<M, FrameFault>> {
        let end = match self.stuffing.feed(byte) {
            Ok(DecodeResult::NoData) => return None,
            Ok(DecodeResult::DataContinue(byte)) => {
                self.oversized |= self.message.push(byte).is_err();
                return None;
            }
            Ok(DecodeResult::DataComplete) => Ok(()),
            Err(_) => Err(FrameFault::Stuffing),
        };
        let oversized = core::mem::take(&mut self.oversized);
        let message = match end {
            _ if oversized => Err(FrameFault::Oversized),
            Ok(()) => message(&self.message),
            Err(fault) => Err(fault),
        };
        self.message.clear();
        Some(message)
    }
}

/// Checks the checksum at the end of a frame and returns the message before it.
fn message<M: DeserializeOwned>(frame: &[u8]) -> Result<M, FrameFault> {
    let (message, checksum) = frame.split_last_chunk::<CHECKSUM_BYTES>().ok_or(FrameFault::Checksum)?;
    let mut digest: Digest<'_, u32, Table<1>> = CHECKSUM.digest();
    digest.update(message);
    if digest.finalize() != u32::from_le_bytes(*checksum) {
        return Err(FrameFault::Checksum);
    }
    match postcard::take_from_bytes(message) {
        Ok((message, [])) => Ok(message),
        _ => Err(FrameFault::Content),
    }
}

impl<const N: usize> Default for Decoder<N> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(feature = "defmt")]
impl<const N: usize> defmt::Format for Decoder<N> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "Decoder {{ received: {=usize}, oversized: {=bool} }}", self.message.len(), self.oversized);
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use core::num::ParseIntError;
    use std::vec::Vec;

    use super::{Decoder, Encoder};
    use crate::Class;
    use crate::instrument::link::{Reply, Request};
    use crate::instrument::{PlanarReading, Verdict};

    /// The bytes that the page of the protocol has below a title.
    fn printed(title: &str) -> Option<Result<Vec<u8>, ParseIntError>> {
        let mut lines = include_str!("protocol.md").lines().skip_while(|line| *line != title);
        let bytes = lines.nth(1)?.split_whitespace();
        Some(bytes.map(|byte| u8::from_str_radix(byte, 16)).collect())
    }

    /// In an interpreter of a processor whose most significant byte is first, this shows that frames do not depend on the order of
    /// bytes.
    #[test]
    fn frames_are_those_of_the_page_in_both_directions() {
        let reading = PlanarReading { approach: 2.8_f32, tangential: 0.0, peripheral: 0.739 };
        let request = Request::<_, f32>::Event { number: 1, reading };
        let event = printed("Event, number 1: 2.8, 0 and 0.739 m/s");
        assert_eq!(Encoder::<64>::new().frame(&request).map(Vec::from).ok(), event.clone().and_then(Result::ok));
        let mut decoder = Decoder::<64>::new();
        let received = event.into_iter().flatten().flatten().find_map(|byte| decoder.push(byte));
        assert_eq!(received, Some(Ok(request)));

        let verdict = Verdict { class: Class::ReboundRolling, restitution: Some(0.746_f32) };
        let reply = Reply::<f32, Class>::Classified { number: 1, verdict };
        let classified = printed("Classified, number 1: rebound, rolling, e = 0.746");
        assert_eq!(Encoder::<64>::new().frame(&reply).map(Vec::from).ok(), classified.and_then(Result::ok));
    }
}
