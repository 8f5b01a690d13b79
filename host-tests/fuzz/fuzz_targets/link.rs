//! The link of an instrument, from both ends. From this package's folder:
//!
//! ```text
//! cargo fuzz run --sanitizer none link
//! ```
//!
//! The bytes arrive as they are or, since hardly any bytes have the right checksum by chance, as the contents of frames that
//! may be damaged. Checked:
//!
//! * nothing panics;
//! * what is decoded is encoded again, and decoded to the same message;
//! * the counts of the instrument's end add up to what the decoder found;
//! * the instrument answers each reading with a verdict whose restitution is 0 to 1, or with a rejection.
#![no_main]

use std::fmt::Debug;

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use microimpact::instrument::link::{Decoder, Encoder, FrameFault, Inlet, Request};
use microimpact::instrument::{Instrument, NoLines, NormalReading, ObliqueReading};
use microimpact_scenes::station::{
    BINS, CLASSES, Event, MESSAGE_BYTES, REPLY_BYTES, Scene, ToHost, ToInstrument, bins, scene,
};
use serde::de::DeserializeOwned;
use serde::ser::{Serialize, SerializeTuple, Serializer};

/// Enough for any message here with its checksum, stuffed.
const FRAME_BYTES: usize = 512;

fuzz_target!(|data: &[u8]| {
    let Ok(stream) = stream(&mut Unstructured::new(data)) else {
        return;
    };
    decode::<ToInstrument, MESSAGE_BYTES>(&stream);
    decode::<ToHost, REPLY_BYTES>(&stream);
    decode::<Request<NormalReading<f64>>, MESSAGE_BYTES>(&stream);
    decode::<Request<ObliqueReading<f32>>, 8>(&stream);
    decode::<(), 0>(&stream);
    serve(&stream);
});

/// The bytes themselves, or frames of them.
fn stream(bytes: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    if bytes.arbitrary::<u8>()? & 1 == 0 {
        return Ok(bytes.bytes(bytes.len())?.to_vec());
    }
    let (mut stream, mut encoder) = (Vec::new(), Encoder::<FRAME_BYTES>::new());
    while !bytes.is_empty() {
        let (length, damage) = (bytes.arbitrary::<u8>()?, bytes.arbitrary::<u8>()?);
        let content = bytes.bytes(usize::from(length).min(bytes.len()))?;
        let mut frame = encoder.frame(&Content(content)).expect("a frame has room for 255 bytes").to_vec();
        // A quarter of the frames has a wrong byte or lacks one.
        let place = usize::from(damage >> 2) % frame.len();
        match damage & 15 {
            1 => frame[place] ^= 1 << (damage >> 5),
            2 => drop(frame.remove(place)),
            3 => frame.truncate(place),
            4 => frame.insert(place, damage),
            _ => (),
        }
        stream.extend(frame);
    }
    Ok(stream)
}

/// Bytes that are the content of a message without more.
struct Content<'a>(&'a [u8]);

impl Serialize for Content<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(self.0.len())?;
        for byte in self.0 {
            tuple.serialize_element(byte)?;
        }
        tuple.end()
    }
}

/// Decodes messages; each is encoded and decoded again. As text, since a number that is none differs from itself.
fn decode<M: Serialize + DeserializeOwned + Debug, const N: usize>(stream: &[u8]) {
    let mut decoder = Decoder::<N>::new();
    for message in stream.iter().filter_map(|&byte| decoder.push::<M>(byte)).filter_map(Faultless::ok) {
        let mut encoder = Encoder::<FRAME_BYTES>::new();
        let frame = encoder.frame(&message).unwrap_or_else(|fault| panic!("{fault}: {message:?}"));
        // The content of a received frame may be longer than it need be, but never shorter.
        let mut decoder = Decoder::<N>::new();
        let again: Vec<_> = frame.iter().filter_map(|&byte| decoder.push::<M>(byte)).collect();
        let [Ok(again)] = &again[..] else { panic!("{message:?} became {again:?}") };
        assert_eq!(format!("{message:?}"), format!("{again:?}"));
        assert_eq!(Encoder::<FRAME_BYTES>::new().frame(again), Ok(frame));
    }
}

type Faultless<M> = std::result::Result<M, FrameFault>;

/// Receives requests as an instrument does.
fn serve(stream: &[u8]) {
    let (mut inlet, mut decoder) = (Inlet::<MESSAGE_BYTES>::new(), Decoder::<MESSAGE_BYTES>::new());
    let (Ok(scene), Ok(bins)) = (scene(), bins()) else { panic!("the instrument's scene is refused") };
    let mut station: Instrument<Scene<f32>, NoLines, f32, CLASSES, BINS> = Instrument::new(scene, NoLines, bins);
    let (mut frames, mut readings) = (0, 0);
    for &byte in stream {
        frames += u64::from(decoder.push::<ToInstrument>(byte).is_some());
        let Some(Request::Event { reading, .. }) = inlet.receive::<Event, f32>(byte) else {
            continue;
        };
        readings += 1;
        if let Ok(verdict) = station.process(&reading) {
            let e = verdict.restitution.expect("the rigid-body model always has a restitution");
            assert!((0.0..=1.0).contains(&e), "{reading:?}: {verdict:?}");
        }
    }
    let arrivals = inlet.arrivals();
    assert_eq!(arrivals.events, readings);
    assert_eq!(
        arrivals.events + arrivals.duplicates + arrivals.reports + arrivals.commands + arrivals.faults.total(),
        frames
    );
    let tally = station.tally();
    assert_eq!(tally.classified() + tally.rejections().total(), readings);
}
