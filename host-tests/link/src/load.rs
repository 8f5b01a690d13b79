//! A trial of an instrument: many events at full speed, among frames that are damaged in every way, a reset in
//! mid-stream, and more than its queue holds.

use std::fmt::{self, Display};

use microimpact::instrument::link::{Arrivals, PROTOCOL, Refusal, Reply, Report, Request};
use microimpact::instrument::{Classifier, PlanarReading, Reading, Rejection};
use microimpact::{AdhesionConfig, Class, DampingConfig, ModelConfig, Parameter, PlanarMotion, SceneConfig};
use rand::rngs::StdRng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};

use super::{Answer, Client, LinkError};
use microimpact_scenes::station::{self, Event, MESSAGE_BYTES, QUEUE, SCENE, Scene, ToInstrument};

/// Events that are sent at once, without a look at what the queue holds.
const FLOOD: usize = 4 * QUEUE;
/// Events of which a part is on its way when the instrument is reset.
const RESET_FLOOD: usize = 4 * QUEUE;
/// One frame in so many is accompanied by a fault.
const FAULTS: u32 = 10;
/// How close to one a margin may be for the number types to disagree in class.
const ROUNDING: f64 = 1e-5;

/// What a trial has shown.
#[derive(Debug, Default)]
pub struct Trial {
    /// Events answered, each of them once and rightly.
    pub answered: u64,
    /// Answers by class, in the order of the classes.
    pub classes: [u64; station::CLASSES],
    /// Answers that an event cannot be.
    pub rejected: u64,
    /// What undamaged events at full speed took.
    pub spent: Spent,
    /// Faults that were sent, by what the instrument must call them.
    pub sent: Faults,
    /// Events that found the queue full, and were sent again.
    pub overrun: u64,
    /// Events lost in the reset or to the full queue after it, and sent again.
    pub reset: u64,
}

/// Time that requests took.
#[derive(Debug, Default, Clone, Copy)]
pub struct Spent {
    /// Requests answered.
    pub requests: u64,
    /// Ticks of the instrument's clock.
    pub ticks: u64,
}

impl Spent {
    fn between(before: &Report, after: &Report) -> Self {
        let answered = |report: &Report| report.classified + report.rejections.total() + report.reports;
        Self { requests: answered(after) - answered(before), ticks: after.ticks - before.ticks }
    }
}

/// Faults that were sent.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Faults {
    /// Frames with one bit flipped.
    pub corrupted: u64,
    /// Frames without their end.
    pub truncated: u64,
    /// Frames that came twice, at once or later.
    pub duplicated: u64,
    /// Frames longer than any message.
    pub oversized: u64,
    /// Frames with a right checksum around another message.
    pub foreign: u64,
    /// Bytes between frames.
    pub noise: u64,
    /// Events that no particle can have.
    pub impossible: u64,
}

impl Display for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Faults { corrupted, truncated, duplicated, oversized, foreign, noise, impossible } = self.sent;
        writeln!(f, "{} events answered, each once and as on the host", self.answered)?;
        writeln!(f, "  classes: {:?}; rejected as impossible: {} of {impossible}", self.classes, self.rejected)?;
        writeln!(
            f,
            "  faults recognised: {corrupted} corrupted, {truncated} truncated, {duplicated} duplicated, \
             {oversized} oversized, {foreign} foreign, {noise} of noise"
        )?;
        writeln!(f, "  sent again: {} that found the queue full, {} lost around the reset", self.overrun, self.reset)
    }
}

/// Puts an instrument on trial with `events` events; `reset` presses its button.
///
/// # Errors
/// Whatever the instrument does wrong.
pub fn run(client: &mut Client, events: usize, seed: u64, mut reset: impl FnMut()) -> Result<Trial, String> {
    let mut source = Source { random: StdRng::seed_from_u64(seed), judge: Judge::new()? };
    let mut trial = Trial::default();
    full_speed(client, &mut source, events / 2, &mut trial)?;
    faults(client, &mut source, events / 2, &mut trial)?;
    restart(client, &mut source, &mut trial, &mut reset)?;
    commands(client, &mut source, &mut trial)?;
    Ok(trial)
}

fn full_speed(client: &mut Client, source: &mut Source, events: usize, trial: &mut Trial) -> Result<(), String> {
    let before = client.report().map_err(text)?;
    for _ in 0..events {
        let event = source.event();
        client.send(event).map_err(text)?;
    }
    client.settle().map_err(text)?;
    let after = client.report().map_err(text)?;
    let arrivals = Arrivals {
        events: before.arrivals.events + events as u64,
        reports: before.arrivals.reports + 1,
        ..before.arrivals
    };
    same("at full speed", arrivals, after.arrivals)?;
    trial.spent = Spent::between(&before, &after);
    source.judge.take(client, trial)
}

fn faults(client: &mut Client, source: &mut Source, events: usize, trial: &mut Trial) -> Result<(), String> {
    let before = client.report().map_err(text)?;
    let (mut sent, mut past) = (Faults::default(), Vec::new());
    let mut missing = 0;
    for _ in 0..events {
        if source.random.random_ratio(1, FAULTS) {
            fault(client, source, &mut sent, &mut missing, &past).map_err(text)?;
        }
        let event = if source.random.random_ratio(1, FAULTS) {
            sent.impossible += 1;
            source.impossible()
        } else {
            source.event()
        };
        client.send(event).map_err(text)?;
        past.push((client.latest, event));
        past.drain(..past.len().saturating_sub(100));
    }
    client.settle().map_err(text)?;
    let after = client.report().map_err(text)?;
    let faults = &after.arrivals.faults;
    let new = |after: u64, before: u64| after - before;
    let start = &before.arrivals.faults;
    for (name, sent, counted) in [
        ("oversized", sent.oversized, new(faults.oversized, start.oversized)),
        ("foreign", sent.foreign, new(faults.content, start.content)),
        (
            "corrupted, truncated or noise",
            sent.corrupted + sent.truncated + sent.noise,
            new(faults.stuffing + faults.checksum, start.stuffing + start.checksum),
        ),
        ("duplicated", sent.duplicated, new(after.arrivals.duplicates, before.arrivals.duplicates)),
        ("missing", missing, new(after.arrivals.missing, before.arrivals.missing)),
        ("accepted", events as u64, new(after.arrivals.events, before.arrivals.events)),
        ("impossible", sent.impossible, new(after.rejections.input, before.rejections.input)),
        ("lost", 0, u64::from(after.lost - before.lost)),
    ] {
        same(name, sent, counted)?;
    }
    complete(&after)?;
    trial.sent = sent;
    source.judge.take(client, trial)
}

/// Sends one fault; the event after it must be understood.
fn fault(
    client: &mut Client,
    source: &mut Source,
    sent: &mut Faults,
    missing: &mut u64,
    past: &[(u32, Event)],
) -> Result<(), LinkError> {
    let random = &mut source.random;
    let kind = random.random_range(0..7);
    let bytes = match kind {
        0 | 1 => {
            *missing += 1;
            let event = source.event();
            let random = &mut source.random;
            let mut frame = client.frame(event);
            if kind == 0 {
                sent.corrupted += 1;
                // Neither makes nor takes away the zero of an end.
                let place = random.random_range(1..frame.len() - 1);
                let flips: Vec<u8> = (0..8).map(|bit| frame[place] ^ (1 << bit)).filter(|&byte| byte != 0).collect();
                frame[place] = *flips.choose(random).unwrap_or(&1);
            } else {
                sent.truncated += 1;
                frame.truncate(random.random_range(2..frame.len() - 1));
            }
            frame
        }
        2 | 3 if !past.is_empty() => {
            sent.duplicated += 1;
            let place = if kind == 2 { past.len() - 1 } else { random.random_range(0..past.len()) };
            let (number, reading) = past[place];
            client.encode(&ToInstrument::Event { number, reading })
        }
        4 => {
            sent.oversized += 1;
            let length = random.random_range(MESSAGE_BYTES + 3..300);
            // No byte that COBS takes for a run without a zero at its end, which would add nothing to the length.
            [vec![0], (0..length).map(|_| random.random_range(1..255)).collect(), vec![0]].concat()
        }
        5 => {
            sent.foreign += 1;
            client.encode(&(random.random_range(6..100_u8), random.random::<f32>()))
        }
        _ => {
            sent.noise += 1;
            (0..random.random_range(1..20)).map(|_| random.random_range(1..255)).collect()
        }
    };
    client.write(&bytes)
}

/// Sends an instrument that is slower than its line more than its queue holds, and again what found no room, until all is
/// answered; then `reset` presses its button while the queue is full.
///
/// # Errors
/// Whatever the instrument does wrong, or a queue that was never full.
pub fn overrun(client: &mut Client, seed: u64, mut reset: impl FnMut()) -> Result<Trial, String> {
    let mut source = Source { random: StdRng::seed_from_u64(seed), judge: Judge::new()? };
    let mut trial = Trial::default();
    let events: Vec<Event> = (0..FLOOD).map(|_| source.event()).collect();
    let (lost, spent) = flood(client, &events)?;
    trial.spent = spent;
    trial.overrun = lost.len() as u64;
    if lost.is_empty() {
        return Err("the queue was never full".into());
    }
    for &event in &lost {
        client.send(event).map_err(text)?;
    }
    client.settle().map_err(text)?;
    source.judge.take(client, &mut trial)?;
    same("events of the flood", FLOOD as u64, trial.answered)?;
    restart(client, &mut source, &mut trial, &mut reset)?;
    if trial.reset == 0 {
        return Err("the reset lost no event, although the queue was full".into());
    }
    Ok(trial)
}

/// Sends events at once and returns those that found the queue full, of which the instrument must know how many they were,
/// and what the others took.
fn flood(client: &mut Client, events: &[Event]) -> Result<(Vec<Event>, Spent), String> {
    let before = client.report().map_err(text)?;
    let mut bytes = Vec::new();
    for &event in events {
        bytes.extend(client.frame(event));
        client.expect(event);
    }
    client.write(&bytes).map_err(text)?;
    let after = client.report().map_err(text)?;
    let lost = client.give_up();
    let asked = after.arrivals.reports - before.arrivals.reports;
    let reports_lost = asked - (after.reports - before.reports);
    same("lost to a full queue", lost.len() as u64 + reports_lost, u64::from(after.lost - before.lost))?;
    complete(&after)?;
    Ok((lost, Spent::between(&before, &after)))
}

/// Resets the instrument while its queue holds events and more of them are on their way.
fn restart(
    client: &mut Client,
    source: &mut Source,
    trial: &mut Trial,
    reset: &mut impl FnMut(),
) -> Result<(), String> {
    let before = trial.answered;
    let mut bytes = Vec::new();
    for _ in 0..RESET_FLOOD {
        let event = source.event();
        bytes.extend(client.frame(event));
        client.expect(event);
    }
    let (first, second) = bytes.split_at(bytes.len() / 2 - 10);
    client.write(first).map_err(text)?;
    while client.open.len() > RESET_FLOOD - 10 {
        client.await_answer().map_err(text)?;
    }
    reset();
    client.write(second).map_err(text)?;
    // The first report ends in the news of the restart, or the restart comes before it.
    let mut restarted = false;
    let report = loop {
        match client.report() {
            Ok(report) if restarted => break report,
            Ok(_) => {}
            Err(LinkError::Restarted) => restarted = true,
            // A reply that the reset cut off.
            Err(LinkError::Damaged(_)) => {}
            Err(error) => return Err(text(error)),
        }
    };
    complete(&report)?;
    let lost = client.give_up();
    trial.reset = lost.len() as u64;
    for &event in &lost {
        client.send(event).map_err(text)?;
    }
    client.settle().map_err(text)?;
    complete(&client.report().map_err(text)?)?;
    source.judge.take(client, trial)?;
    same("events around the reset", RESET_FLOOD as u64, trial.answered - before)
}

/// A scene that is simulated: the paper's, with a smaller sphere, which is captured more often.
const OTHER: SceneConfig<f32> = SceneConfig {
    radius: 2.5e-6,
    model: ModelConfig::Contact {
        stiffness: 7.5e10,
        damping: DampingConfig::Hysteretic { zeta: 10.5 },
        adhesion: AdhesionConfig::Ring { strength: 250.0, zeta: 6.25 },
        force: 0.0,
    },
    ..SCENE
};

/// Events that are classified by that scene.
const SIMULATED: usize = 200;

/// Asks for all that is neither an event nor a report, and has the scene changed and changed back.
fn commands(client: &mut Client, source: &mut Source, trial: &mut Trial) -> Result<(), String> {
    let mut ask = |request: &dyn Fn(u32) -> ToInstrument| client.ask(request).map_err(text);
    match ask(&|number| Request::Describe { number })? {
        Reply::Description { protocol: PROTOCOL, .. } => {}
        reply => return Err(format!("no description: {reply:?}")),
    }
    let Reply::Counts { counts, .. } = ask(&|number| Request::Counts { number })? else {
        return Err("no counts".into());
    };
    match ask(&|number| Request::Reset { number })? {
        Reply::Reset { counts: last, .. } => same("counts", &counts, &last)?,
        reply => return Err(format!("not reset: {reply:?}")),
    }
    match ask(&|number| Request::Counts { number })? {
        Reply::Counts { counts, .. } => same("counts after a reset", 0, counts.iter().sum())?,
        reply => return Err(format!("no counts: {reply:?}")),
    }
    let too_large = SceneConfig { radius: 5.0, ..SCENE };
    match ask(&|number| Request::Configure { number, scene: too_large })? {
        Reply::Refused { refusal: Refusal::Input(error), .. } => same("refused", Parameter::Radius, error.parameter)?,
        reply => return Err(format!("not refused: {reply:?}")),
    }
    match ask(&|number| Request::Configure { number, scene: OTHER })? {
        Reply::Configured { .. } => {}
        reply => return Err(format!("not configured: {reply:?}")),
    }
    let other = station::classifier(&OTHER).map_err(|refusal| format!("{refusal:?}"))?;
    for _ in 0..SIMULATED {
        client.send(source.event()).map_err(text)?;
    }
    client.settle().map_err(text)?;
    for (_, event, answer) in client.answers() {
        let expected = event.motion().map_err(Rejection::from).and_then(|motion| other.verdict(&motion));
        // Processors round alike, but their compilers may join a product and a sum.
        let close = |one: Option<f32>, other: Option<f32>| match (one, other) {
            (Some(one), Some(other)) => (one * one - other * other).abs() < 1e-4,
            (one, other) => one == other,
        };
        let alike = match (&answer, &expected) {
            (Ok(one), Ok(other)) => one.class == other.class && close(one.restitution, other.restitution),
            _ => answer == expected,
        };
        if !alike {
            return Err(format!("by the other scene {event:?}: {answer:?}, but it is {expected:?}"));
        }
    }
    match client.ask(|number| Request::Configure { number, scene: SCENE }).map_err(text)? {
        Reply::Configured { .. } => {}
        reply => return Err(format!("not configured: {reply:?}")),
    }
    for _ in 0..SIMULATED {
        client.send(source.event()).map_err(text)?;
    }
    client.settle().map_err(text)?;
    complete(&client.report().map_err(text)?)?;
    source.judge.take(client, trial)
}

fn complete(report: &Report) -> Result<(), String> {
    if report.is_complete() { Ok(()) } else { Err(format!("the counts do not add up: {report:?}")) }
}

fn same<N: PartialEq + fmt::Debug>(what: &str, sent: N, counted: N) -> Result<(), String> {
    if sent == counted { Ok(()) } else { Err(format!("{what}: {sent:?} expected, {counted:?} counted")) }
}

fn text(error: impl Display) -> String {
    error.to_string()
}

/// Events and faults at random.
struct Source {
    random: StdRng,
    judge: Judge,
}

impl Source {
    /// An event of any class.
    fn event(&mut self) -> Event {
        let random = &mut self.random;
        let approach = random.random_range(0.2..12.0);
        // Straight, to be captured at rest, or oblique.
        let mut velocity = || if random.random_ratio(1, 4) { 0.0 } else { random.random_range(-8.0..8.0) };
        PlanarReading { approach, tangential: velocity(), peripheral: velocity() }
    }

    /// An event with one value that no particle can have.
    fn impossible(&mut self) -> Event {
        let mut event = self.event();
        let value =
            *[f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30].choose(&mut self.random).unwrap_or(&f32::NAN);
        match self.random.random_range(0..4) {
            0 => event.approach = value,
            1 => event.tangential = value,
            2 => event.peripheral = value,
            _ => event.approach = -event.approach,
        }
        event
    }
}

/// The host's own opinion.
pub struct Judge {
    single: Scene<f32>,
    double: Scene<f64>,
}

impl Judge {
    /// A judge of the station's scene.
    ///
    /// # Errors
    /// Values of the station outside their range.
    pub fn new() -> Result<Self, String> {
        Ok(Self { single: station::scene().map_err(text)?, double: station::scene().map_err(text)? })
    }

    /// Whether an answer is right: the class of f64, except where a margin is within rounding of one, and the restitution.
    ///
    /// # Errors
    /// What is wrong with the answer.
    pub fn check(&self, event: &Event, answer: &Answer) -> Result<(), String> {
        let wrong = |expected: &dyn fmt::Debug| Err(format!("{event:?}: {answer:?}, but it is {expected:?}"));
        let widened = PlanarReading {
            approach: f64::from(event.approach),
            tangential: event.tangential.into(),
            peripheral: event.peripheral.into(),
        };
        let faulty = |parameter: Parameter, value: f64| {
            let (smallest, largest) = parameter.range();
            !(smallest..=largest).contains(&value)
        };
        let values = [
            (Parameter::ApproachSpeed, widened.approach),
            (Parameter::TangentialVelocity, widened.tangential),
            (Parameter::PeripheralVelocity, widened.peripheral),
        ];
        let impossible = values.into_iter().find(|(parameter, value)| faulty(*parameter, *value));
        let verdict = match (answer, impossible) {
            (Err(Rejection::Input(error)), Some((parameter, _))) if error.parameter == parameter => return Ok(()),
            (Ok(verdict), None) => verdict,
            (_, impossible) => return wrong(&impossible),
        };
        let motion: PlanarMotion<f64> = widened.motion().map_err(text)?;
        let classification = self.double.classify(&motion);
        let margins = [classification.speed_over_critical, classification.contact.friction_over_limit];
        let close = margins.into_iter().flatten().any(|margin| (margin - 1.0).abs() < ROUNDING);
        let class = if close { self.single_class(event)? } else { classification.class() };
        if verdict.class != class {
            return wrong(&class);
        }
        let restitution = self.double.impact(&motion).normal.overall_restitution();
        // Close to capture e is the root of a small difference, and its square is what holds.
        let error = verdict.restitution.map(|single| (f64::from(single).powi(2) - restitution.powi(2)).abs());
        if error.is_some_and(|error| error < 1e-5) { Ok(()) } else { wrong(&restitution) }
    }

    fn single_class(&self, event: &Event) -> Result<Class, String> {
        let verdict = self.single.verdict(&event.motion().map_err(text)?).map_err(text)?;
        Ok(verdict.class)
    }

    fn take(&self, client: &mut Client, trial: &mut Trial) -> Result<(), String> {
        for (_, event, answer) in client.answers() {
            self.check(&event, &answer)?;
            trial.answered += 1;
            match answer {
                Ok(verdict) => trial.classes[verdict.class as usize] += 1,
                Err(_) => trial.rejected += 1,
            }
        }
        Ok(())
    }
}
