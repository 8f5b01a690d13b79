//! What the boards answered, and what the host answers with the same library.

use std::collections::{BTreeMap, HashMap};
use std::fmt::{self, Display};

use microimpact_scenes::contacts::{REFUSED, visit_contacts, visit_double_contacts};
use microimpact_scenes::fixed_contacts::visit_oblique_contacts;
use microimpact_scenes::functions::visit_functions;
use microimpact_scenes::laws::{self, visit_laws};
use microimpact_scenes::scenes::UNDECIDED;
use microimpact_scenes::scenes::{Answer, Number, Scene, Visitor, visit_scenes};
use microimpact_scenes::variants::{visit_collocations, visit_recordings, visit_variants};

/// One impact in one scene with one number type.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Case {
    pub(crate) scene: String,
    pub(crate) scalar: String,
    pub(crate) impact: String,
}

/// Class, margins and restitution, as text. Every digit of class and margins counts, and of the restitution those
/// within [`RESTITUTION_TOLERANCES`].
#[derive(Debug, Clone)]
pub(crate) struct Verdict {
    pub(crate) class: String,
    speed_margin: String,
    friction_margin: String,
    restitution: String,
}

/// What a board is expected to say, and what is true.
pub(crate) struct Expected {
    verdict: Verdict,
    /// Overall restitution, where it is simulated.
    restitution: Option<f64>,
}

/// How far the restitution of a simulation may be from the host's. Roots differ in their last bit between host
/// and board, and a different last bit can change how a motion is divided.
const RESTITUTION_TOLERANCES: [(&str, f64); 2] = [("f32", 1e-5), ("f64", 1e-9)];

/// What a board said of one case.
pub(crate) struct Measurement {
    pub(crate) case: Case,
    pub(crate) verdict: Verdict,
    pub(crate) instructions: u32,
    pub(crate) with_set_up: u32,
}

/// All that a board said.
#[derive(Default)]
pub(crate) struct Protocol {
    pub(crate) measurements: Vec<Measurement>,
    /// Bytes of stack of each scene and number type.
    pub(crate) stacks: Vec<(String, String, u32)>,
    pub(crate) code: Vec<Code>,
}

/// Address of the function that sets up a scene with one number type and does its work.
pub(crate) struct Code {
    pub(crate) scene: String,
    pub(crate) scalar: String,
    pub(crate) function: u32,
}

impl Protocol {
    /// Reads the lines that the firmware prints.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let (mut measurements, mut stacks) = (Vec::new(), Vec::new());
        let code = read_lines(text, |kind, fields| {
            match kind {
                "impact" => measurements.push(fields.measurement()?),
                "stack" => stacks.push((fields.text("scene")?, fields.text("scalar")?, fields.number("bytes")?)),
                _ => return Ok(false),
            }
            Ok(true)
        })?;
        Ok(Self { measurements, stacks, code })
    }

    /// Adds what another firmware said.
    pub(crate) fn append(&mut self, mut other: Self) {
        self.measurements.append(&mut other.measurements);
        self.stacks.append(&mut other.stacks);
        self.code.append(&mut other.code);
    }

    /// The largest error in each scene and number type: that of the restitution where it is known, else that of the margins,
    /// relative to those of the same scene in f64 on the host.
    pub(crate) fn errors(&self, expected: &BTreeMap<Case, Expected>) -> Vec<(String, String, f64)> {
        let mut errors: Vec<(String, String, f64)> = Vec::new();
        for Measurement { case, verdict, .. } in &self.measurements {
            let Some(error) = verdict.error(case, expected) else { continue };
            match errors.iter_mut().find(|(scene, scalar, _)| (scene, scalar) == (&case.scene, &case.scalar)) {
                Some((.., largest)) => *largest = largest.max(error),
                None => errors.push((case.scene.clone(), case.scalar.clone(), error)),
            }
        }
        errors
    }

    /// Every difference from what the host expects.
    pub(crate) fn differences(&self, expected: &BTreeMap<Case, Expected>) -> Vec<String> {
        let mut differences = Vec::new();
        for Measurement { case, verdict, .. } in &self.measurements {
            match expected.get(case) {
                Some(Expected { verdict: host, .. }) if host.agrees(verdict, &case.scalar) => {}
                Some(Expected { verdict: host, .. }) => {
                    differences.push(format!("{case}: {verdict} on the board, {host} on the host"))
                }
                None => differences.push(format!("{case}: unknown to the host")),
            }
        }
        let answered = |case: &&Case| self.measurements.iter().any(|found| found.case == **case);
        let unanswered: Vec<String> = expected.keys().filter(|case| !answered(case)).map(Case::to_string).collect();
        if !unanswered.is_empty() {
            differences.push(format!("the board did not answer: {}", unanswered.join("; ")));
        }
        differences
    }
}

impl Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, {}", self.scene, self.scalar, self.impact)
    }
}

impl Verdict {
    fn agrees(&self, other: &Self, scalar: &str) -> bool {
        self.class == other.class
            && self.speed_margin == other.speed_margin
            && self.friction_margin == other.friction_margin
            && (self.restitution == other.restitution || self.restitution_is_close(other, scalar))
    }

    fn restitution_is_close(&self, other: &Self, scalar: &str) -> bool {
        let tolerance = RESTITUTION_TOLERANCES.iter().find(|(of, _)| *of == scalar).map(|(_, tolerance)| *tolerance);
        match (self.restitution.parse::<f64>(), other.restitution.parse::<f64>(), tolerance) {
            (Ok(own), Ok(other), Some(tolerance)) => (own - other).abs() <= tolerance,
            _ => false,
        }
    }

    fn error(&self, case: &Case, expected: &BTreeMap<Case, Expected>) -> Option<f64> {
        if let Some(exact) = expected.get(case)?.restitution {
            let answered = self.class != UNDECIDED && self.class != REFUSED;
            return self.restitution.parse::<f64>().ok().filter(|_| answered).map(|found| (found - exact).abs());
        }
        let Expected { verdict: exact, .. } = expected.get(&Case { scalar: "f64".to_owned(), ..case.clone() })?;
        let relative = |found: &str, exact: &str| {
            let (found, exact) = (found.parse::<f64>().ok()?, exact.parse::<f64>().ok()?);
            Some(((found - exact) / exact).abs())
        };
        let speed = relative(&self.speed_margin, &exact.speed_margin);
        let friction = relative(&self.friction_margin, &exact.friction_margin);
        speed.into_iter().chain(friction).reduce(f64::max)
    }
}

impl Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { class, speed_margin, friction_margin, restitution } = self;
        write!(f, "{class} (margins: speed {speed_margin}, friction {friction_margin}; restitution {restitution})")
    }
}

/// Reads the lines that a firmware prints, the last of which is `done`, and returns where its code is. All other lines go to
/// `take`, which says whether it knows their kind.
pub(crate) fn read_lines(
    text: &str,
    mut take: impl FnMut(&str, &Fields<'_>) -> Result<bool, String>,
) -> Result<Vec<Code>, String> {
    let (mut code, mut done) = (Vec::new(), false);
    for line in text.lines() {
        match Fields::of(line) {
            ("code", fields) => code.push(fields.code()?),
            ("done", _) => done = true,
            (kind, fields) if take(kind, &fields)? => {}
            _ => return Err(format!("the firmware printed an unknown line: {line}")),
        }
    }
    if done { Ok(code) } else { Err("the firmware's output stops before its end".to_owned()) }
}

/// A line of a firmware: a word, and values by their keys.
pub(crate) struct Fields<'a> {
    line: &'a str,
    values: HashMap<&'a str, &'a str>,
}

impl<'a> Fields<'a> {
    /// The word and the values of a line.
    fn of(line: &'a str) -> (&'a str, Self) {
        let mut words = line.split_whitespace();
        let kind = words.next().unwrap_or_default();
        (kind, Self { line, values: words.filter_map(|word| word.split_once('=')).collect() })
    }

    fn measurement(&self) -> Result<Measurement, String> {
        Ok(Measurement {
            case: Case { scene: self.text("scene")?, scalar: self.text("scalar")?, impact: self.text("impact")? },
            verdict: Verdict {
                class: self.text("class")?,
                speed_margin: self.text("speed_margin")?,
                friction_margin: self.text("friction_margin")?,
                restitution: self.text("restitution")?,
            },
            instructions: self.number("instructions")?,
            with_set_up: self.number("with_set_up")?,
        })
    }

    /// Where the code of a scene or a calibration is.
    fn code(&self) -> Result<Code, String> {
        Ok(Code { scene: self.text("scene")?, scalar: self.text("scalar")?, function: self.number("address")? })
    }

    pub(crate) fn text(&self, key: &str) -> Result<String, String> {
        match self.values.get(key) {
            Some(value) => Ok((*value).to_owned()),
            None => Err(format!("the firmware printed no `{key}` in: {}", self.line)),
        }
    }

    pub(crate) fn number(&self, key: &str) -> Result<u32, String> {
        let text = self.text(key)?;
        text.parse().map_err(|_| format!("the firmware printed no number as `{key}` in: {}", self.line))
    }
}

/// The host's verdict in every case; those of all laws of contact run on some boards alone.
pub(crate) fn expected(with_laws: bool) -> Result<BTreeMap<Case, Expected>, String> {
    let mut host = Host { verdicts: BTreeMap::new(), refused: Vec::new() };
    visit_scenes(&mut host);
    visit_contacts(&mut host);
    visit_double_contacts(&mut host);
    visit_oblique_contacts(&mut host);
    visit_variants(&mut host);
    visit_collocations(&mut host);
    visit_recordings(&mut host);
    visit_functions(&mut host);
    if with_laws {
        visit_laws(&mut host);
    }
    if host.refused.is_empty() {
        Ok(host.verdicts)
    } else {
        Err(format!(
            "the library refuses {}; correct what it calls in examples/firmware/scenes",
            host.refused.join(", ")
        ))
    }
}

/// Names of the scenes of all laws of contact.
pub(crate) fn laws() -> impl Iterator<Item = &'static str> {
    laws::laws::<Host>().iter().map(|(name, _)| *name)
}

struct Host {
    verdicts: BTreeMap<Case, Expected>,
    refused: Vec<String>,
}

impl Visitor for Host {
    fn visit<T: Number, S: Scene<T>>(&mut self) {
        let Some(scene) = S::new() else {
            self.refused.push(format!("scene {}", S::NAME));
            return;
        };
        for impact in S::impacts() {
            let Some(motion) = scene.motion(&impact.into()) else {
                self.refused.push(format!("impact {}", impact.name));
                continue;
            };
            let case = Case { scene: S::NAME.to_owned(), scalar: T::NAME.to_owned(), impact: impact.name.to_owned() };
            let answer: Answer<T> = scene.classify(&motion).into();
            if answer.class == REFUSED {
                self.refused.push(format!("{case}"));
            }
            let expected = Expected { verdict: answer.into(), restitution: S::restitution(impact) };
            self.verdicts.insert(case, expected);
        }
    }
}

impl<T: Number> From<Answer<T>> for Verdict {
    fn from(answer: Answer<T>) -> Self {
        let digits = |value: Option<T>| value.map_or_else(|| "none".to_owned(), |value| format!("{value:e}"));
        Self {
            class: answer.class.to_owned(),
            speed_margin: digits(answer.speed_margin),
            friction_margin: digits(answer.friction_margin),
            restitution: digits(answer.restitution),
        }
    }
}
