//! `cargo qemu instrument` and `cargo qemu load`: the instrument of `examples/firmware` on an emulated board, fed with events
//! over its serial line.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use link::load::{self as trial, Judge, Trial};
use link::{Answer, Client};
use microimpact::Class;
use microimpact::instrument::{ClassSet, PlanarReading};
use microimpact_scenes::station::{self, Event};

use crate::session::{Session, instructions};
use boards::INSTRUMENT_BOARD as BOARD;
use boards::packages::Permission;
use boards::toolchain::{Choice, Toolchain};
use sheet::{Decimal, Input, Row, Sheet};

/// An emulated processor on a busy machine is slow.
const PATIENCE: Duration = Duration::from_secs(30);
/// The data register of the port with the class lines, all pins at once.
const LINES: u32 = 0x4000_53fc;
/// What an emulated second is taken for: the board's processor, if it did one instruction in each of its cycles.
const INSTRUCTIONS_PER_SECOND: u64 = 50_000_000;

/// Events from a table.
#[derive(Args)]
pub(crate) struct Events {
    /// Table with the columns speed_normal_m_s (approach speed), speed_tangential_m_s and spin_rad_s (both 0 where empty or
    /// absent), or - for standard input; without it, impacts of the paper. Particle and surface are the instrument's own: other
    /// columns do not count. Rows are read, sent and answered one by one, so that a file may be larger than memory
    file: Option<PathBuf>,
    /// Decimal mark of the table; without it judged from the columns above, in the first 1000 rows
    #[arg(long, value_enum)]
    decimal: Option<Decimal>,
}

/// The columns of an event.
const INPUTS: [Input; 3] = [
    Input::required(&["speed_normal_m_s"]),
    Input::optional(&["speed_tangential_m_s"], "0 m/s"),
    Input::optional(&["spin_rad_s"], "0 rad/s"),
];

/// A trial.
#[derive(Args)]
pub(crate) struct Load {
    /// Events to be answered
    #[arg(long, default_value_t = 100_000)]
    events: usize,
    /// Start of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Sends the events of a table and prints their classes.
pub(crate) fn classify(events: &Events, choice: Choice, permission: Permission) -> Result<Vec<String>, String> {
    let mut sheet = Sheet::open(source(events)?, &INPUTS, events.decimal)?;
    eprint!("{}", sheet.columns_in_words(&[]));
    let toolchain = crate::tools(choice, &[BOARD], permission)?;
    let (mut session, mut client) = start(&toolchain, "instrument")?;
    let judge = Judge::new()?;
    let radius = station::scene::<f64>().map_err(|error| error.to_string())?.sphere().radius();
    let mut answers = csv::Writer::from_writer(io::stdout().lock());
    // Nobody may want the rest of the answers, as `head` does not.
    let mut wanted = written(&mut answers, &["event", "class", "restitution", "lines", "reason"].map(String::from))?;
    let (mut failures, mut number, mut unreadable) = (Vec::new(), 0_u64, 0_u64);
    while let Some(row) = sheet.next_row()?.filter(|_| wanted) {
        number += 1;
        let event = match row.check().and_then(|()| event(&row, radius)) {
            Ok(event) => event,
            Err(reason) => {
                unreadable += 1;
                wanted =
                    written(&mut answers, &[number.to_string(), String::new(), String::new(), String::new(), reason])?;
                continue;
            }
        };
        client.send(event).and_then(|_| client.settle()).map_err(|error| error.to_string())?;
        let lines = session.word(LINES)?;
        for (_, event, answer) in client.answers() {
            wanted = wanted && written(&mut answers, &cells(number, &answer, lines))?;
            failures.extend(judge.check(&event, &answer).err());
            let high = answer.ok().map_or(0, |verdict| 1 << verdict.class.index());
            if lines != high {
                failures.push(format!("event {number}: lines {lines:05b} instead of {high:05b}"));
            }
        }
    }
    let report = client.report().map_err(|error| error.to_string())?;
    if !report.is_complete() {
        failures.push(format!("the counts do not add up: {report:?}"));
    }
    if unreadable > 0 {
        failures.push(format!("rows that are no events: {unreadable}, each with its reason"));
    }
    Ok(failures)
}

/// Writes a row at once, and says whether anybody still reads.
fn written(answers: &mut csv::Writer<impl Write>, cells: &[String; 5]) -> Result<bool, String> {
    let result = answers.write_record(cells).map_err(io::Error::from).and_then(|()| answers.flush());
    match result {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(error.to_string()),
    }
}

fn cells(number: u64, answer: &Answer, lines: u32) -> [String; 5] {
    let (class, restitution, reason) = match answer {
        Ok(verdict) => {
            let restitution = verdict.restitution.map_or_else(String::new, |e| format!("{e:.4}"));
            (verdict.class.to_string(), restitution, String::new())
        }
        Err(rejection) => (String::new(), String::new(), rejection.to_string()),
    };
    [number.to_string(), class, restitution, format!("{lines:05b}"), reason]
}

/// Puts the instrument on trial and says what it takes.
pub(crate) fn load(load: &Load, choice: Choice, permission: Permission) -> Result<Vec<String>, String> {
    let toolchain = crate::tools(choice, &[BOARD], permission)?;
    let (mut session, mut client) = start(&toolchain, "instrument")?;
    let begin = Instant::now();
    let mut failures = Vec::new();
    let trial = trial::run(&mut client, load.events, load.seed, || failures.extend(session.reset().err()))?;
    let time = begin.elapsed().as_secs_f64();
    drop(session);
    // Otherwise the processor may be faster than its line, and would never have its queue full.
    let (mut session, mut client) = start(&toolchain, "busy")?;
    let overrun = trial::overrun(&mut client, load.seed, || failures.extend(session.reset().err()))?;
    println!("At full speed, damaged frames, reset:\n{trial}");
    println!("With a main loop slower than the line, full queue, reset:\n{overrun}");
    let each = each_of(&trial);
    println!("{each} instructions for an event, from the first byte of its frame to the last of its answer:");
    println!(
        "  {} events/s at {} million instructions/s; here {:.0} events/s of the host's time",
        INSTRUCTIONS_PER_SECOND / each.max(1),
        INSTRUCTIONS_PER_SECOND / 1_000_000,
        trial.answered as f64 / time,
    );
    // The other work is known, which shows whether ticks are counted right.
    let (other_work, expected) = (each_of(&overrun).saturating_sub(each), 2 * u64::from(station::OTHER_WORK));
    if other_work.abs_diff(expected) > expected / 10 {
        failures.push(format!("{other_work} instructions counted where there are {expected}"));
    }
    // The rigid-body model decides every impact.
    for class in Class::ALL {
        let events = trial.classes[class.index()];
        if (events == 0) != (*class == Class::Undecided) {
            failures.push(format!("{events} events were {class}"));
        }
    }
    Ok(failures)
}

/// Instructions for a request.
fn each_of(trial: &Trial) -> u64 {
    instructions(trial.spent.ticks) / trial.spent.requests.max(1)
}

/// The running instrument.
fn start(toolchain: &Toolchain, feature: &str) -> Result<(Session, Client), String> {
    let folder = crate::built(toolchain, &BOARD, feature, &["instrument"])?;
    let (session, serial) = Session::start(&BOARD, &folder.join("instrument"))?;
    let client = Client::new(serial, PATIENCE).map_err(|error| error.to_string())?;
    Ok((session, client))
}

/// The table of events, or that of the paper.
fn source(events: &Events) -> Result<Box<dyn BufRead>, String> {
    Ok(match &events.file {
        None => Box::new(include_str!("../../../examples/cli/src/classify/impacts.csv").as_bytes()),
        Some(path) if path.as_os_str() == "-" => Box::new(io::stdin().lock()),
        Some(path) => {
            Box::new(BufReader::new(File::open(path).map_err(|error| format!("{}: {error}", path.display()))?))
        }
    })
}

/// The event of a row, whose sphere has the given radius.
fn event(row: &Row<'_>, radius: f64) -> Result<Event, String> {
    let spin: f64 = row.or_zero("spin_rad_s")?;
    Ok(PlanarReading {
        approach: row.required("speed_normal_m_s")?,
        tangential: row.or_zero("speed_tangential_m_s")?,
        peripheral: (spin * radius) as f32,
    })
}
