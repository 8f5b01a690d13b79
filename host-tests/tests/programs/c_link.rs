//! The frames of a link in C: it reads and writes those of the documentation, and refuses damaged ones and other instruments.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use microimpact::contact::JkrEnd;
use microimpact::instrument::link::{Decoder, Encoder, PROTOCOL, Refusal, Reply, Request, Schema};
use microimpact::instrument::{ClassSet, PlanarReading, Rejection};
use microimpact::{
    AdhesionConfig, Class, DampingConfig, ModelConfig, ReboundAdhesionConfig, RestitutionConfig, SceneConfig,
};
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
    let frames: Vec<_> = golden("From the host").iter().map(|frame| hexadecimal(frame)).collect();
    assert_eq!(written.lines().collect::<Vec<_>>(), frames[..5]);
}

fn hexadecimal(frame: &[u8]) -> String {
    frame.iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ")
}

#[test]
fn c_repeats_the_frames_of_the_documentation() {
    for (list, argument) in [("From the host", "repeat-requests"), ("From the instrument", "repeat-replies")] {
        let frames = golden(list);
        let repeated = printed(&frames.concat(), Some(argument));
        assert_eq!(
            repeated.lines().collect::<Vec<_>>(),
            frames.iter().map(|frame| hexadecimal(frame)).collect::<Vec<_>>()
        );
    }
}

/// Scenes with each term, and the names that C has for their numbers.
fn scenes() -> Vec<(SceneConfig<f32>, String)> {
    let mut scenes = Vec::new();
    let solid = |model| SceneConfig { friction: 0.25, ..SceneConfig::solid(5e-6, 2600.0, model) };
    let sphere = "radius=5e-06 density=2600 gyration_ratio=0.4 friction=0.25 ";
    let restitutions = [
        (RestitutionConfig::Constant { restitution: 0.5 }, "restitution=0.5 "),
        (RestitutionConfig::Speed { speed: 130.0 }, "restitution_law=1 restitution_speed=130 "),
        (
            RestitutionConfig::Power { speed: 120.0, power: 0.75 },
            "restitution_law=2 restitution_speed=120 restitution_power=0.75 ",
        ),
        (RestitutionConfig::ElasticPlastic { yield_speed: 3.0 }, "restitution_law=3 yield_speed=3 "),
    ];
    let bound = [
        (ReboundAdhesionConfig::None, ""),
        (ReboundAdhesionConfig::Coefficient { coefficient: 0.125 }, "rebound_adhesion=1 adhesion_coefficient=0.125 "),
        (ReboundAdhesionConfig::Work { work: 2e-12 }, "rebound_adhesion=2 work_of_adhesion=2e-12 "),
        (
            ReboundAdhesionConfig::Speed { speed: 1.5, power: 2.0 },
            "rebound_adhesion=3 adhesion_speed=1.5 adhesion_power=2 ",
        ),
    ];
    for (restitution, of_restitution) in restitutions {
        for (adhesion, of_adhesion) in bound {
            let model = ModelConfig::RigidBody { restitution, adhesion };
            scenes.push((solid(model), format!("{sphere}{of_restitution}{of_adhesion}")));
        }
    }
    let viscoelastic = RestitutionConfig::Viscoelastic { stiffness: 7e10, relaxation_time: 1e-9 };
    let model = ModelConfig::RigidBody { restitution: viscoelastic, adhesion: ReboundAdhesionConfig::None };
    scenes.push((solid(model), format!("{sphere}restitution_law=4 stiffness=7e+10 relaxation_time=1e-09 ")));
    let dampings = [
        (DampingConfig::None, "", ""),
        (DampingConfig::Hysteretic { zeta: 10.5 }, "", "damping=1 material_damping=10.5 "),
        (DampingConfig::Viscoelastic { relaxation_time: 2e-9 }, "relaxation_time=2e-09 ", "damping=2 "),
        (DampingConfig::Constant { restitution: 0.75 }, "", "damping=3 nominal_restitution=0.75 "),
    ];
    let adhesions = [
        (AdhesionConfig::None, ""),
        (AdhesionConfig::WithoutTension, "adhesion=1 "),
        (
            AdhesionConfig::Ring { strength: 250.0, zeta: 6.25 },
            "adhesion=2 adhesion_strength=250 adhesion_damping=6.25 ",
        ),
        (AdhesionConfig::Dmt { work: 0.5 }, "adhesion=3 adhesion_energy=0.5 "),
        (AdhesionConfig::Jkr { work: 0.25, end: JkrEnd::SnapOff }, "adhesion=4 adhesion_energy=0.25 "),
        (AdhesionConfig::Jkr { work: 0.25, end: JkrEnd::PullOff }, "adhesion=5 adhesion_energy=0.25 "),
    ];
    for (damping, of_time, of_damping) in dampings {
        for (adhesion, of_adhesion) in adhesions {
            let model = ModelConfig::Contact { stiffness: 7e10, damping, adhesion, force: 1e-8 };
            let text =
                format!("{sphere}model=1 stiffness=7e+10 {of_time}{of_damping}{of_adhesion}external_force=1e-08 ");
            scenes.push((solid(model), text));
        }
    }
    scenes
}

/// Every term of a scene, from Rust to C by name, and from C to Rust.
#[test]
fn c_reads_and_writes_every_scene() {
    let scenes = scenes();
    let configured = |(number, (scene, _)): (usize, &(SceneConfig<f32>, String))| {
        frame(&Request::<PlanarReading<f32>>::Configure { number: number as u32, scene: *scene })
    };
    let frames: Vec<_> = scenes.iter().enumerate().map(configured).collect();
    let found = printed(&frames.concat(), Some("scenes"));
    assert_eq!(found.lines().collect::<Vec<_>>(), scenes.iter().map(|(_, text)| text.as_str()).collect::<Vec<_>>());
    let repeated = printed(&frames.concat(), Some("repeat-requests"));
    assert_eq!(repeated.lines().collect::<Vec<_>>(), frames.iter().map(|frame| hexadecimal(frame)).collect::<Vec<_>>());
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
