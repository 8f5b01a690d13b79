//! The link to an instrument: each event is answered once and rightly, and each fault is counted by its name.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use link::{Client, LinkError, load};
use microimpact::instrument::link::{
    Decoder, Described, Encoder, FrameFault, Inlet, Outlet, PROTOCOL, Received, Reply, ReplyFault, Report, Request,
    Schema, Station,
};
use microimpact::instrument::{Instrument, NoLines, NormalReading, PlanarReading, Queue, Verdict};
use microimpact::{Class, Outcome};
use microimpact_scenes::station::{
    BINS, CLASSES, Event, MESSAGE_BYTES, QUEUE, REPLY_BYTES, SCENE, Scenes, ToHost, ToInstrument, bins, classifier,
};
use proptest::prelude::*;
use serde::de::DeserializeOwned;

const PATIENCE: Duration = Duration::from_secs(30);

/// What an instrument may do wrong.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Defect {
    None,
    AnswersTwice,
    WrongClass,
    ForgetsOverruns,
    LosesAnEvent,
    KeepsItsScene,
}

/// The firmware of the example, without its interrupt: requests wait in the queue until a chunk of bytes has been read.
fn serve(mut stream: TcpStream, reset: &AtomicBool, defect: Defect) {
    let mut chunk = [0; 4096];
    let mut encoder = Encoder::<REPLY_BYTES>::new();
    loop {
        reset.store(false, Ordering::SeqCst);
        let instrument: Instrument<Scenes, NoLines, f32, CLASSES, BINS> =
            Instrument::new(classifier(&SCENE).unwrap(), NoLines, bins().unwrap());
        let mut station = Station::new(instrument);
        let mut queue = Queue::<ToInstrument, QUEUE>::new();
        let (mut sender, mut receiver) = queue.split();
        let mut inlet = Inlet::<MESSAGE_BYTES>::new();
        let mut ticks = 0;
        let mut tell = |stream: &mut TcpStream, reply: &ToHost| stream.write_all(encoder.frame(reply).unwrap()).is_ok();
        tell(&mut stream, &station.started::<Event>());
        while !reset.load(Ordering::SeqCst) {
            let Ok(length @ 1..) = stream.read(&mut chunk) else { return };
            for request in chunk[..length].iter().filter_map(|&byte| inlet.receive(byte)) {
                let _ = sender.send(request);
            }
            while let Some(request) = receiver.receive() {
                ticks += 1;
                let special = matches!(request, Request::Event { number: 777, .. });
                if special && defect == Defect::LosesAnEvent {
                    continue;
                }
                let lost = if defect == Defect::ForgetsOverruns { 0 } else { receiver.lost() };
                let received = Received { arrivals: inlet.arrivals(), lost, ticks };
                let mut reply = match request {
                    Request::Configure { number, scene }
                        if defect == Defect::KeepsItsScene && classifier(&scene).is_ok() =>
                    {
                        Reply::Configured { number }
                    }
                    _ => station.answer(&request, &received, classifier),
                };
                if let (Reply::Classified { verdict, .. }, Defect::WrongClass) = (&mut reply, defect) {
                    verdict.class = Class::CapturedRolling;
                }
                tell(&mut stream, &reply);
                if special && defect == Defect::AnswersTwice {
                    tell(&mut stream, &reply);
                }
            }
        }
    }
}

/// Runs the trial against the instrument above.
fn trial(defect: Defect) -> Result<load::Trial, String> {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let reset = Arc::new(AtomicBool::new(true));
    let button = Arc::clone(&reset);
    thread::spawn(move || serve(TcpStream::connect(address).unwrap(), &button, defect));
    let patience = if defect == Defect::LosesAnEvent { PATIENCE / 10 } else { PATIENCE };
    let mut client = Client::new(listener.accept().unwrap().0, patience).unwrap();
    let trial = load::run(&mut client, 20_000, 1, || reset.store(true, Ordering::SeqCst))?;
    load::overrun(&mut client, 2, || reset.store(true, Ordering::SeqCst))?;
    Ok(trial)
}

#[test]
fn every_event_is_answered_once_and_every_fault_counted() {
    let trial = trial(Defect::None).unwrap();
    // A rigid body is never undecided, the last class.
    let [decided @ .., undecided] = trial.classes;
    assert!(decided.iter().all(|&count| count > 20) && undecided == 0, "{trial}");
    assert!(trial.rejected > 0 && trial.rejected == trial.sent.impossible, "{trial}");
}

/// The trial finds what it is there to find.
#[test]
fn defects_are_found() {
    for (defect, sign) in [
        (Defect::AnswersTwice, "a reply to nothing"),
        (Defect::WrongClass, "but it is"),
        (Defect::ForgetsOverruns, "full queue"),
        (Defect::LosesAnEvent, "no reply in time"),
        (Defect::KeepsItsScene, "by the other scene"),
    ] {
        let found = trial(defect).unwrap_err();
        assert!(found.contains(sign), "{found}");
    }
}

#[test]
fn an_instrument_of_another_version_is_refused() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let mut instrument = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
    let schema = Schema::of::<f32, Event, Class>();
    let hello: ToHost = Reply::Started { protocol: PROTOCOL + 1, schema };
    instrument.write_all(Encoder::<REPLY_BYTES>::new().frame(&hello).unwrap()).unwrap();
    let refused = Client::new(listener.accept().unwrap().0, PATIENCE).err();
    assert!(matches!(refused, Some(LinkError::Other(ReplyFault::Protocol { found })) if found == PROTOCOL + 1));
}

/// What an outlet of these types makes of frames.
fn heard<T, R, C>(frames: &[u8]) -> Vec<Result<Reply<T, C>, ReplyFault>>
where
    T: Described + DeserializeOwned,
    R: Described,
    C: Described + DeserializeOwned,
{
    let mut outlet = Outlet::<T, R, C, REPLY_BYTES>::new();
    frames.iter().filter_map(|&byte| outlet.receive(byte)).collect()
}

/// A class of one instrument may be an outcome of another: its frames are right, but are not understood.
#[test]
fn a_host_of_other_types_is_told_so() {
    let verdict = Verdict { class: Class::ReboundRolling, restitution: Some(0.5_f32) };
    let schema = Schema::of::<f32, Event, Class>();
    let replies: [ToHost; 2] =
        [Reply::Started { protocol: PROTOCOL, schema }, Reply::Classified { number: 1, verdict }];
    let frames = replies.clone().map(|reply| Encoder::<REPLY_BYTES>::new().frame(&reply).unwrap().to_vec());
    let both = frames.concat();
    assert_eq!(heard::<f32, Event, Class>(&both), replies.map(Ok));
    let refused =
        |fault: Option<&ReplyFault>| matches!(fault, Some(ReplyFault::Schema { found, .. }) if *found == schema);
    let others = heard::<f32, Event, Outcome>(&both);
    assert!(refused(others[0].as_ref().err()) && others[1] == Err(ReplyFault::Unannounced), "{others:?}");
    let others = heard::<f64, PlanarReading<f64>, Class>(&both);
    assert!(refused(others[0].as_ref().err()) && others[1] == Err(ReplyFault::Unannounced), "{others:?}");
    let others = heard::<f32, NormalReading<f32>, Class>(&both);
    assert!(refused(others[0].as_ref().err()) && others[1] == Err(ReplyFault::Unannounced), "{others:?}");
    // Who comes later asks first.
    assert_eq!(heard::<f32, Event, Class>(&frames[1]), [Err(ReplyFault::Unannounced)]);
}

fn events() -> impl Strategy<Value = Event> {
    (any::<f32>(), any::<f32>(), any::<f32>()).prop_map(|(approach, tangential, peripheral)| PlanarReading {
        approach,
        tangential,
        peripheral,
    })
}

fn frame(request: &ToInstrument) -> Vec<u8> {
    Encoder::<64>::new().frame(request).unwrap().to_vec()
}

/// The largest numbers, which take most bytes.
#[test]
fn the_longest_messages_fit() {
    let reading = PlanarReading { approach: f32::MAX, tangential: f32::MIN, peripheral: f32::MIN };
    let request = frame(&Request::Event { number: u32::MAX, reading });
    let mut inlet = Inlet::<MESSAGE_BYTES>::new();
    assert!(request.iter().find_map(|&byte| inlet.receive::<Event, f32>(byte)).is_some());
    let faults = microimpact::instrument::link::FrameFaults {
        oversized: u64::MAX,
        stuffing: u64::MAX,
        checksum: u64::MAX,
        content: u64::MAX,
    };
    let arrivals = microimpact::instrument::link::Arrivals {
        events: u64::MAX,
        reports: u64::MAX,
        commands: u64::MAX,
        duplicates: u64::MAX,
        missing: u64::MAX,
        faults,
    };
    let report = Report {
        arrivals,
        lost: u32::MAX,
        classified: u64::MAX,
        rejections: microimpact::instrument::Rejections { input: u64::MAX, unsolved: u64::MAX },
        reports: u64::MAX,
        commands: u64::MAX,
        signal_failures: u64::MAX,
        ticks: u64::MAX,
    };
    let reply: ToHost = Reply::Report { number: u32::MAX, report };
    assert!(Encoder::<REPLY_BYTES>::new().frame(&reply).is_ok());
}

proptest! {
    /// Whatever comes before it, a frame is understood: the link is in step again within one frame.
    #[test]
    fn any_noise_spoils_no_frame(noise in prop::collection::vec(any::<u8>(), 0..200), event in events()) {
        let request: ToInstrument = Request::Event { number: 5, reading: event };
        let mut decoder = Decoder::<MESSAGE_BYTES>::new();
        let mut received = Vec::new();
        for byte in noise.iter().copied().chain(frame(&request)) {
            received.extend(decoder.push::<ToInstrument>(byte));
        }
        // Compared as bytes, because NaN is unlike itself.
        let last = received.pop().unwrap().map(|last| frame(&last));
        prop_assert_eq!(last, Ok(frame(&request)));
        prop_assert!(received.iter().all(Result::is_err), "noise was understood: {:?}", received);
    }

    /// A frame in which bytes were changed, lost or added is never taken for a request.
    #[test]
    fn a_damaged_frame_is_never_understood(
        event in events(),
        place in 1usize..20,
        insert in prop::collection::vec(any::<u8>(), 0..4),
        remove in 0usize..4,
    ) {
        let whole = frame(&Request::Event { number: 5, reading: event });
        let mut damaged = whole.clone();
        let place = place.min(damaged.len() - 1);
        let end = (place + remove).min(damaged.len() - 1);
        damaged.splice(place..end, insert);
        damaged.push(0);
        let mut inlet = Inlet::<MESSAGE_BYTES>::new();
        let understood = damaged.iter().filter_map(|&byte| inlet.receive::<Event, f32>(byte)).count();
        let unharmed = damaged[..damaged.len() - 1] == whole;
        let prefixed = damaged.windows(whole.len()).any(|part| part == whole);
        prop_assert_eq!(understood > 0, unharmed || prefixed);
        prop_assert!(unharmed || prefixed || inlet.arrivals().faults.total() > 0);
    }

    /// Numbers may wrap, repeat, and leave gaps.
    #[test]
    fn numbers_tell_new_from_old(start in any::<u32>(), steps in prop::collection::vec(0u32..5, 1..50)) {
        let mut inlet = Inlet::<MESSAGE_BYTES>::new();
        let (mut number, mut duplicates, mut missing) = (start, 0, 0);
        let reading = PlanarReading { approach: 1.0, tangential: 0.0, peripheral: 0.0 };
        let mut send = |number| {
            let bytes = frame(&Request::Event { number, reading });
            bytes.iter().filter_map(|&byte| inlet.receive::<Event, f32>(byte)).count()
        };
        prop_assert_eq!(send(number), 1);
        for &step in &steps {
            number = number.wrapping_add(step);
            duplicates += u64::from(step == 0);
            missing += u64::from(step.saturating_sub(1));
            prop_assert_eq!(send(number), usize::from(step > 0));
        }
        // One from long ago.
        prop_assert_eq!(send(number.wrapping_sub(1000)), 0);
        prop_assert_eq!((inlet.arrivals().duplicates, inlet.arrivals().missing), (duplicates + 1, missing));
    }

    #[test]
    fn oversized_frames_are_named(length in MESSAGE_BYTES + 3..1000) {
        let mut decoder = Decoder::<MESSAGE_BYTES>::new();
        let long = std::iter::once(0).chain(std::iter::repeat_n(7, length)).chain([0]);
        let received: Vec<_> = long.filter_map(|byte| decoder.push::<ToInstrument>(byte)).collect();
        prop_assert_eq!(received, [Err(FrameFault::Oversized)]);
    }
}
