//! The protocol's frames in C and in Python: both read and write those of the documentation.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use microimpact::Class;
use microimpact::instrument::link::{Decoder, Encoder, PROTOCOL, Refusal, Reply, Schema};
use microimpact::instrument::{ClassSet, Rejection};
use serde::Serialize;

const PAGE: &str = include_str!("../../../src/instrument/link/protocol.md");

/// The frames of the documentation from a line on that begins a list.
fn golden(list: &str) -> Vec<Vec<u8>> {
    let (_, rest) = PAGE.split_once(list).unwrap();
    let (frames, _) = rest.split_once("```\n\n").unwrap();
    let hexadecimal = frames.lines().filter_map(|line| line.strip_prefix("    "));
    let byte = |text: &str| u8::from_str_radix(text, 16).unwrap();
    hexadecimal.map(|line| line.split(' ').map(byte).collect()).collect()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples")
}

/// The example in C, compiled once.
fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("link");
        let mut compiler = Command::new("cc");
        compiler.args(["-std=c90", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-g"]);
        #[cfg(target_os = "linux")]
        compiler.args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]);
        compiler.arg("-I").arg(folder().join("c/include")).arg(folder().join("c/link.c"));
        assert!(compiler.arg("-o").arg(&program).status().unwrap().success());
        program
    })
}

/// What the program prints of bytes.
fn printed(bytes: &[u8], argument: Option<&str>) -> String {
    let mut command = Command::new(program());
    command.args(argument).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let bytes = bytes.to_vec();
    let writer = std::thread::spawn(move || input.write_all(&bytes));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

/// The same in Rust.
fn expected(bytes: &[u8]) -> String {
    let mut decoder = Decoder::<256>::new();
    let replies = bytes.iter().filter_map(|byte| decoder.push::<Reply<f32, Class>>(*byte));
    replies.map(|reply| line(&reply.unwrap()) + "\n").collect()
}

fn line(reply: &Reply<f32, Class>) -> String {
    let schema = |protocol: &u16, Schema { number, reading, classes }: &Schema| {
        format!(" version {protocol} schema {number} {reading} {classes}")
    };
    let numbers = |counts: &[u64]| counts.iter().map(|count| format!(" {count}")).collect::<String>();
    match reply {
        Reply::Started { protocol, schema: of } => format!("0 0{}", schema(protocol, of)),
        Reply::Classified { number, verdict } => {
            let e = verdict.restitution.map_or(String::new(), |e| format!(" e {e}"));
            format!("1 {number} class {}{e}", verdict.class.index())
        }
        Reply::Rejected { number, rejection: Rejection::Input(error) } => {
            let (parameter, fault) = (error.parameter as u32, error.fault as u32);
            format!("2 {number} parameter {parameter} fault {fault} value {}", error.value)
        }
        Reply::Rejected { number, .. } => format!("2 {number} without"),
        Reply::Report { number, report } => {
            let (arrivals, faults) = (report.arrivals, report.arrivals.faults);
            let of_arrivals =
                [arrivals.events, arrivals.reports, arrivals.commands, arrivals.duplicates, arrivals.missing];
            let of_frames = [faults.oversized, faults.stuffing, faults.checksum, faults.content];
            let rejections = [report.rejections.input, report.rejections.unsolved];
            let others = [report.reports, report.commands, report.signal_failures, report.ticks];
            let all = [&of_arrivals[..], &of_frames, &[report.lost.into(), report.classified], &rejections, &others];
            format!("3 {number}{}", numbers(&all.concat()))
        }
        Reply::Description { number, protocol, schema: of } => format!("4 {number}{}", schema(protocol, of)),
        Reply::Counts { number, counts } => format!("5 {number}{}", numbers(counts)),
        Reply::Reset { number, counts } => format!("6 {number}{}", numbers(counts)),
        Reply::Configured { number } => format!("7 {number}"),
        Reply::Refused { number, refusal: Refusal::Input(error) } => {
            let (parameter, fault) = (error.parameter as u32, error.fault as u32);
            format!("8 {number} parameter {parameter} fault {fault} value {}", error.value)
        }
        Reply::Refused { number, .. } => format!("8 {number} without"),
    }
}

fn frame(message: &impl Serialize) -> Vec<u8> {
    Encoder::<256>::new().frame(message).unwrap().to_vec()
}

#[test]
fn c_reads_the_frames_of_the_documentation() {
    let frames = golden("From the instrument");
    assert_eq!(frames.len(), 10);
    let bytes = frames.concat();
    assert_eq!(printed(&bytes, None), expected(&bytes));
}

#[test]
fn c_writes_the_frames_of_the_documentation() {
    let written = printed(&[], Some("requests"));
    let text = |frame: &Vec<u8>| frame.iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ");
    let frames: Vec<_> = golden("From the host").iter().map(text).collect();
    assert_eq!(written.lines().collect::<Vec<_>>(), frames[..5]);
}

/// Every byte of every frame changed in every bit: nothing is read as another message, and the next frame is read.
#[test]
fn c_refuses_damaged_frames() {
    let frames = golden("From the instrument");
    let after = frame(&Reply::<f32, Class>::Configured { number: 77 });
    for frame in &frames {
        let mut bytes = Vec::new();
        let mut damaged = 0;
        for index in 1..frame.len() - 1 {
            for bit in 0..8 {
                let mut copy = frame.clone();
                copy[index] ^= 1 << bit;
                bytes.extend(copy);
                bytes.extend(&after);
                damaged += 1;
            }
        }
        let printed = printed(&bytes, None);
        let good = printed.lines().filter(|line| *line == "7 77").count();
        let bad = ["stuffing", "checksum", "content", "oversized"];
        assert_eq!(good, damaged);
        assert!(printed.lines().all(|line| line == "7 77" || bad.contains(&line)), "{printed}");
    }
}

/// An instrument of another number type, reading, set of classes or version is refused by name, and too long a frame is one.
#[test]
fn c_refuses_other_instruments() {
    let own = Schema { number: 1, reading: 3, classes: 2 };
    let schemas = [Schema { number: 2, ..own }, Schema { reading: 2, ..own }, Schema { classes: 1, ..own }];
    for schema in schemas {
        let started = frame(&Reply::<f32, Class>::Started { protocol: PROTOCOL, schema });
        let described = frame(&Reply::<f32, Class>::Description { number: 5, protocol: PROTOCOL, schema });
        assert_eq!(printed(&[started, described].concat(), None), "schema\nschema\n");
    }
    let older = frame(&Reply::<f32, Class>::Started { protocol: PROTOCOL - 1, schema: own });
    assert_eq!(printed(&older, None), "schema\n");
    let long: Vec<u8> = [0].into_iter().chain([1; 600]).chain([0]).collect();
    assert_eq!(printed(&long, None), "oversized\n");
}
