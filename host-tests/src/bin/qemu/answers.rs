//! What the boards answered, and what the host answers with the same library.

use std::collections::{BTreeMap, HashMap};
use std::fmt::{self, Display};

use scenes::{Answer, Number, Scene, Visitor, visit_scenes};

#[expect(unreachable_pub, reason = "part of the firmware, and public there")]
#[path = "../../../../examples/firmware/src/impacts.rs"]
mod impacts;
#[expect(unreachable_pub, reason = "part of the firmware, and public there")]
#[path = "../../../../examples/firmware/src/scenes.rs"]
mod scenes;

/// One impact in one scene with one number type.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Case {
    pub(crate) scene: String,
    pub(crate) scalar: String,
    pub(crate) impact: String,
}

/// Class and margins, as text: every digit counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Verdict {
    pub(crate) class: String,
    speed_margin: String,
    friction_margin: String,
}

/// What a board said of one case.
pub(crate) struct Measurement {
    pub(crate) case: Case,
    pub(crate) verdict: Verdict,
    pub(crate) instructions: u32,
    pub(crate) with_set_up: u32,
}

/// All that a board said.
pub(crate) struct Protocol {
    pub(crate) measurements: Vec<Measurement>,
    /// Bytes of stack of each scene and number type.
    pub(crate) stacks: Vec<(String, String, u32)>,
}

impl Protocol {
    /// Reads the lines that the firmware prints.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut protocol = Self { measurements: Vec::new(), stacks: Vec::new() };
        let mut done = false;
        for line in text.lines() {
            let mut words = line.split_whitespace();
            let kind = words.next().unwrap_or_default();
            let fields = Fields { line, values: words.filter_map(|word| word.split_once('=')).collect() };
            match kind {
                "impact" => protocol.measurements.push(fields.measurement()?),
                "stack" => {
                    protocol.stacks.push((fields.text("scene")?, fields.text("scalar")?, fields.number("bytes")?))
                }
                "done" => done = true,
                _ => return Err(format!("the firmware printed an unknown line: {line}")),
            }
        }
        if done { Ok(protocol) } else { Err("the firmware's output stops before its end".to_owned()) }
    }

    /// Every difference from what the host expects.
    pub(crate) fn differences(&self, expected: &BTreeMap<Case, Verdict>) -> Vec<String> {
        let mut differences = Vec::new();
        for Measurement { case, verdict, .. } in &self.measurements {
            match expected.get(case) {
                Some(host) if host == verdict => {}
                Some(host) => differences.push(format!("{case}: {verdict} on the board, {host} on the host")),
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

impl Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { class, speed_margin, friction_margin } = self;
        write!(f, "{class} (margins: speed {speed_margin}, friction {friction_margin})")
    }
}

struct Fields<'a> {
    line: &'a str,
    values: HashMap<&'a str, &'a str>,
}

impl Fields<'_> {
    fn measurement(&self) -> Result<Measurement, String> {
        Ok(Measurement {
            case: Case { scene: self.text("scene")?, scalar: self.text("scalar")?, impact: self.text("impact")? },
            verdict: Verdict {
                class: self.text("class")?,
                speed_margin: self.text("speed_margin")?,
                friction_margin: self.text("friction_margin")?,
            },
            instructions: self.number("instructions")?,
            with_set_up: self.number("with_set_up")?,
        })
    }

    fn text(&self, key: &str) -> Result<String, String> {
        match self.values.get(key) {
            Some(value) => Ok((*value).to_owned()),
            None => Err(format!("the firmware printed no `{key}` in: {}", self.line)),
        }
    }

    fn number(&self, key: &str) -> Result<u32, String> {
        let text = self.text(key)?;
        text.parse().map_err(|_| format!("the firmware printed no number as `{key}` in: {}", self.line))
    }
}

/// The host's verdict in every case.
pub(crate) fn expected() -> Result<BTreeMap<Case, Verdict>, String> {
    let mut host = Host { verdicts: BTreeMap::new(), refused: Vec::new() };
    visit_scenes(&mut host);
    if host.refused.is_empty() {
        Ok(host.verdicts)
    } else {
        Err(format!(
            "the library refuses {}; correct examples/firmware/src/impacts.rs or scenes.rs",
            host.refused.join(", ")
        ))
    }
}

struct Host {
    verdicts: BTreeMap<Case, Verdict>,
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
            self.verdicts.insert(case, answer.into());
        }
    }
}

impl<T: Number> From<Answer<T>> for Verdict {
    fn from(answer: Answer<T>) -> Self {
        let margin = |value: Option<T>| value.map_or_else(|| "none".to_owned(), |value| format!("{value:e}"));
        Self {
            class: answer.class.to_owned(),
            speed_margin: margin(answer.speed_margin),
            friction_margin: margin(answer.friction_margin),
        }
    }
}
