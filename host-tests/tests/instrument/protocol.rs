//! The page that describes the protocol: its frames and its numbers are those of the library.

use std::fmt::Write;

use microimpact::contact::JkrEnd;
use microimpact::instrument::link::{
    Arrivals, Encoder, FrameFaults, PROTOCOL, Refusal, Reply, Report, Request, Schema,
};
use microimpact::instrument::{PlanarReading, Rejection, Rejections, Verdict};
use microimpact::{
    AdhesionConfig, Class, DampingConfig, Fault, ModelConfig, Parameter, ReboundAdhesionConfig, RestitutionConfig,
    SceneConfig,
};
use serde::Serialize;

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../src/instrument/link/protocol.md");

/// What the page has between these lines is written by the test `write_protocol`.
const BEGIN: &str = "<!-- written by the test write_protocol -->";
const END: &str = "<!-- end -->";

type ToInstrument = Request<PlanarReading<f32>>;
type ToHost = Reply<f32, Class>;

fn frame(message: &impl Serialize) -> String {
    let mut encoder = Encoder::<256>::new();
    encoder.frame(message).unwrap().iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ")
}

/// The scene of Table 1, as a rigid body.
fn rigid() -> SceneConfig<f32> {
    let restitution = RestitutionConfig::Speed { speed: 130.0 };
    let adhesion = ReboundAdhesionConfig::Work { work: 2.22e-12 };
    SceneConfig {
        friction: 0.1,
        ..SceneConfig::solid(5.06e-6, 2600.0, ModelConfig::RigidBody { restitution, adhesion })
    }
}

fn jkr() -> SceneConfig<f32> {
    let (damping, adhesion) =
        (DampingConfig::Hysteretic { zeta: 10.5 }, AdhesionConfig::Jkr { work: 0.2, end: JkrEnd::SnapOff });
    SceneConfig::solid(5.06e-6, 2600.0, ModelConfig::Contact { stiffness: 7.5e10, damping, adhesion, force: 0.0 })
}

fn requests() -> [(&'static str, ToInstrument); 7] {
    let reading = PlanarReading { approach: 2.8, tangential: 0.0, peripheral: 0.739 };
    [
        ("`Event`, number 1: 2.8, 0 and 0.739 m/s", Request::Event { number: 1, reading }),
        ("`Report`, number 300", Request::Report { number: 300 }),
        ("`Describe`, number 2", Request::Describe { number: 2 }),
        ("`Counts`, number 3", Request::Counts { number: 3 }),
        ("`Reset`, number 4", Request::Reset { number: 4 }),
        ("`Configure`, number 5: Table 1 as a rigid body", Request::Configure { number: 5, scene: rigid() }),
        (
            "`Configure`, number 6: the law of Johnson, Kendall and Roberts",
            Request::Configure { number: 6, scene: jkr() },
        ),
    ]
}

fn replies() -> [(&'static str, ToHost); 10] {
    let schema = Schema::of::<f32, PlanarReading<f32>, Class>();
    let error = Parameter::ApproachSpeed.check(-2.8_f32).unwrap_err();
    let faults = FrameFaults { checksum: 2, ..FrameFaults::default() };
    let arrivals = Arrivals { events: 1000, reports: 1, commands: 2, missing: 2, faults, ..Arrivals::default() };
    let rejections = Rejections { input: 3, unsolved: 0 };
    let report =
        Report { arrivals, classified: 997, rejections, reports: 1, commands: 2, ticks: 123_456, ..Report::default() };
    let verdict = Verdict { class: Class::ReboundRolling, restitution: Some(0.746) };
    let capture = Verdict { class: Class::CapturedResting, restitution: Some(0.0) };
    let counts = || [12, 800, 5, 80, 100, 0].into_iter().collect();
    [
        ("`Started`", Reply::Started { protocol: PROTOCOL, schema }),
        ("`Classified`, number 1: rebound, rolling, e = 0.746", Reply::Classified { number: 1, verdict }),
        ("`Classified`, number 2: captured, resting", Reply::Classified { number: 2, verdict: capture }),
        ("`Rejected`, number 3: approach speed of -2.8 m/s", Reply::Rejected { number: 3, rejection: error.into() }),
        ("`Rejected`, number 4: unsolved", Reply::Rejected { number: 4, rejection: Rejection::Unsolved }),
        ("`Report`, number 300", Reply::Report { number: 300, report }),
        ("`Description`, number 2", Reply::Description { number: 2, protocol: PROTOCOL, schema }),
        ("`Counts`, number 3: 12, 800, 5, 80, 100 and 0", Reply::Counts { number: 3, counts: counts() }),
        ("`Configured`, number 5", Reply::Configured { number: 5 }),
        ("`Refused`, number 6: the scene is fixed", Reply::Refused { number: 6, refusal: Refusal::Fixed }),
    ]
}

/// The number of a variant in a message.
fn number_of(variant: &impl Serialize) -> u8 {
    let mut bytes = [0; 16];
    postcard::to_slice(variant, &mut bytes).unwrap()[0]
}

fn written() -> String {
    let mut page =
        String::from("# Frames\n\nFrom the host, with readings of three numbers in single precision:\n\n```text\n");
    for (text, request) in requests() {
        writeln!(page, "{}\n    {}", text.replace('`', ""), frame(&request)).unwrap();
    }
    page.push_str("```\n\nFrom the instrument, with classes of friction:\n\n```text\n");
    for (text, reply) in replies() {
        writeln!(page, "{}\n    {}", text.replace('`', ""), frame(&reply)).unwrap();
    }
    page.push_str("```\n\n# Numbers of errors\n\n| number | parameter | unit | range |\n| --- | --- | --- | --- |\n");
    for parameter in Parameter::ALL {
        let (smallest, largest) = parameter.range();
        writeln!(
            page,
            "| {} | {} | {} | {} to {} |",
            number_of(&parameter),
            parameter.name(),
            parameter.unit(),
            number(smallest),
            number(largest)
        )
        .unwrap();
    }
    page.push_str("\n| number | fault |\n| --- | --- |\n");
    for (fault, text) in FAULTS {
        writeln!(page, "| {} | {text} |", number_of(&fault)).unwrap();
    }
    page
}

/// A number as people write it.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e4).contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
}

/// Every fault in words.
const FAULTS: [(Fault, &str); 12] = [
    (Fault::NotFinite, "not a number, or infinite"),
    (Fault::TooSmall, "below the range"),
    (Fault::TooLarge, "above the range"),
    (Fault::ExceedsRadius, "a thickness above the radius"),
    (Fault::BelowPrecision, "a tolerance below the precision of the number type"),
    (Fault::TooFewNodes, "a tolerance below what the nodes can keep"),
    (Fault::OtherLaw, "a quantity that the law of contact does not take"),
    (Fault::OutOfOrder, "values that do not rise"),
    (Fault::TwoBodies, "a quantity of one body where two meet"),
    (Fault::Receding, "bodies that move apart"),
    (Fault::NotInTable, "an index beyond the end of a table"),
    (Fault::TooUncertain, "a standard error above three tenths of the value"),
];

#[test]
fn page_of_the_protocol_is_current() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let (_, rest) = page.split_once(BEGIN).unwrap();
    let (found, _) = rest.split_once(END).unwrap();
    assert_eq!(found.trim(), written().trim(), "run the ignored test write_protocol");
}

/// Writes the frames and the numbers into the page.
#[test]
#[ignore = "writes into the source"]
fn write_protocol() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let (before, rest) = page.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    std::fs::write(PAGE, format!("{before}{BEGIN}\n\n{}\n{END}{after}", written())).unwrap();
}
