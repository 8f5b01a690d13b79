//! The host's end of the link to an instrument: events go out, replies come in, and each event is answered once.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use microimpact::Class;
use microimpact::instrument::link::{Encoder, FrameFault, Outlet, ReplyFault, Report, Request};
use microimpact::instrument::{Rejection, Verdict};
use serde::Serialize;

use microimpact_scenes::station::{Event, QUEUE, REPLY_BYTES, ToHost, ToInstrument};

pub mod load;

/// How long a report may take before it is asked for again, and how often that is.
const REPORT_PATIENCE: (Duration, u32) = (Duration::from_secs(2), 10);
/// Events on their way at a time, so few that all find room in the instrument's queue.
pub const WINDOW: usize = QUEUE / 2;

/// What an instrument says of an event.
pub type Answer = Result<Verdict<f32, Class>, Rejection>;

/// Why a link does not work.
#[derive(Debug)]
pub enum LinkError {
    /// The connection is broken.
    Broken(io::Error),
    /// No reply, although one was due.
    Silence,
    /// A reply that was damaged.
    Damaged(FrameFault),
    /// The instrument has another version or schema.
    Other(ReplyFault),
    /// A reply that nobody has asked for, or a second one.
    Unexpected(Box<ToHost>),
    /// The instrument has started anew, and what it had not answered is lost.
    Restarted,
}

impl fmt::Display for LinkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken(error) => write!(f, "the link is broken: {error}"),
            Self::Silence => f.write_str("no reply in time"),
            Self::Damaged(fault) => write!(f, "a reply was damaged: {fault}"),
            Self::Other(fault) => fault.fmt(f),
            Self::Unexpected(reply) => write!(f, "a reply to nothing: {reply:?}"),
            Self::Restarted => f.write_str("the instrument has started anew"),
        }
    }
}

impl std::error::Error for LinkError {}

impl From<io::Error> for LinkError {
    fn from(error: io::Error) -> Self {
        Self::Broken(error)
    }
}

/// The host's end of a link.
pub struct Client {
    output: TcpStream,
    replies: Receiver<Result<ToHost, ReplyFault>>,
    patience: Duration,
    encoder: Encoder<96>,
    latest: u32,
    reports: u32,
    open: BTreeMap<u32, Event>,
    answers: Vec<(u32, Event, Answer)>,
}

impl Client {
    /// A client of the instrument at the other end, which must say that it has started; no reply may take longer than
    /// `patience`.
    ///
    /// # Errors
    /// A broken connection, silence, or an instrument of another version.
    pub fn new(stream: TcpStream, patience: Duration) -> Result<Self, LinkError> {
        stream.set_nodelay(true)?;
        let input = stream.try_clone()?;
        let (sender, replies) = mpsc::channel();
        thread::spawn(move || receive(input, |reply| sender.send(reply).is_ok()));
        let mut client = Self {
            output: stream,
            replies,
            patience,
            encoder: Encoder::new(),
            latest: 0,
            reports: 0,
            open: BTreeMap::new(),
            answers: Vec::new(),
        };
        match client.reply() {
            Err(LinkError::Restarted) => Ok(client),
            Ok(reply) => Err(LinkError::Unexpected(Box::new(reply))),
            Err(error) => Err(error),
        }
    }

    /// Sends an event under a number of its own and waits while too many are on their way.
    ///
    /// # Errors
    /// A link that does not work, or an instrument that has started anew.
    pub fn send(&mut self, event: Event) -> Result<u32, LinkError> {
        while self.open.len() >= WINDOW {
            self.await_answer()?;
        }
        let frame = self.frame(event);
        self.expect(event);
        self.write(&frame)?;
        Ok(self.latest)
    }

    /// Waits for the answers to all events that were sent.
    ///
    /// # Errors
    /// A link that does not work, or an instrument that has started anew.
    pub fn settle(&mut self) -> Result<(), LinkError> {
        while !self.open.is_empty() {
            self.await_answer()?;
        }
        Ok(())
    }

    /// All answers since the last call, in the order in which they came.
    pub fn answers(&mut self) -> Vec<(u32, Event, Answer)> {
        std::mem::take(&mut self.answers)
    }

    /// The instrument's counts, once it has dealt with all that was sent before; what is still open then is lost.
    ///
    /// A request that is lost to a full queue is made again.
    ///
    /// # Errors
    /// A link that does not work, or an instrument that has started anew.
    pub fn report(&mut self) -> Result<Report, LinkError> {
        let (patience, tries) = REPORT_PATIENCE;
        for _ in 0..tries {
            self.reports += 1;
            let request: ToInstrument = Request::Report { number: self.reports };
            let frame = self.encode(&request);
            self.write(&frame)?;
            loop {
                match self.reply_within(patience) {
                    Ok(ToHost::Report { number, report }) if number == self.reports => return Ok(report),
                    Ok(ToHost::Report { .. }) => {}
                    Ok(reply) => self.take_answer(reply)?,
                    Err(LinkError::Silence) => break,
                    Err(error) => return Err(error),
                }
            }
        }
        Err(LinkError::Silence)
    }

    /// Asks for something else than a report, and returns the reply to it; `request` makes the request under a number.
    ///
    /// # Errors
    /// A link that does not work, or an instrument that has started anew.
    pub fn ask(&mut self, request: impl FnOnce(u32) -> ToInstrument) -> Result<ToHost, LinkError> {
        self.settle()?;
        self.reports += 1;
        let frame = self.encode(&request(self.reports));
        self.write(&frame)?;
        self.reply()
    }

    /// Events that have not been answered; forgets them.
    pub fn give_up(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.open).into_values().collect()
    }

    /// The frame of an event under the next number.
    fn frame(&mut self, event: Event) -> Vec<u8> {
        self.latest = self.latest.wrapping_add(1);
        let request: ToInstrument = Request::Event { number: self.latest, reading: event };
        self.encode(&request)
    }

    /// Notes that the latest number has this event.
    fn expect(&mut self, event: Event) {
        self.open.insert(self.latest, event);
    }

    fn encode(&mut self, message: &impl Serialize) -> Vec<u8> {
        // Requests are shorter than the encoder's frames by far.
        self.encoder.frame(message).map(<[u8]>::to_vec).unwrap_or_default()
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        Ok(self.output.write_all(bytes)?)
    }

    fn await_answer(&mut self) -> Result<(), LinkError> {
        let reply = self.reply()?;
        self.take_answer(reply)
    }

    fn take_answer(&mut self, reply: ToHost) -> Result<(), LinkError> {
        let (number, answer) = match reply {
            ToHost::Classified { number, verdict } => (number, Ok(verdict)),
            ToHost::Rejected { number, rejection } => (number, Err(rejection)),
            _ => return Err(LinkError::Unexpected(Box::new(reply))),
        };
        let event = self.open.remove(&number).ok_or_else(|| LinkError::Unexpected(Box::new(reply)))?;
        self.answers.push((number, event, answer));
        Ok(())
    }

    fn reply(&mut self) -> Result<ToHost, LinkError> {
        self.reply_within(self.patience)
    }

    fn reply_within(&mut self, patience: Duration) -> Result<ToHost, LinkError> {
        match self.replies.recv_timeout(patience) {
            Ok(Ok(ToHost::Started { .. })) => Err(LinkError::Restarted),
            Ok(Ok(reply)) => Ok(reply),
            Ok(Err(ReplyFault::Frame(fault))) => Err(LinkError::Damaged(fault)),
            Ok(Err(fault)) => Err(LinkError::Other(fault)),
            Err(RecvTimeoutError::Timeout) => Err(LinkError::Silence),
            Err(RecvTimeoutError::Disconnected) => Err(LinkError::Broken(io::ErrorKind::UnexpectedEof.into())),
        }
    }
}

/// Decodes replies until the stream or the one who wants them ends.
fn receive(mut input: TcpStream, mut pass_on: impl FnMut(Result<ToHost, ReplyFault>) -> bool) {
    let mut outlet = Outlet::<f32, Event, Class, REPLY_BYTES>::new();
    let mut chunk = [0; 4096];
    while let Ok(length @ 1..) = input.read(&mut chunk) {
        if !chunk[..length].iter().filter_map(|&byte| outlet.receive(byte)).all(&mut pass_on) {
            return;
        }
    }
}
