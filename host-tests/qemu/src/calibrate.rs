//! What the boards found by calibration, and what the host finds with the same library.

use std::collections::BTreeMap;
use std::fmt::{self, Display};

use boards::Board;
use boards::figures::{Figure, Quantity};
use microimpact_scenes::calibrations::{
    Calibration, CalibrationVisitor, visit_calibrations, visit_double_calibrations,
};
use microimpact_scenes::scenes::Number;

use crate::answers::{self, Code};

/// A calibration with one number type.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Case {
    scene: String,
    scalar: String,
}

/// How far a parameter or its standard error may be from the host's, relative to it: roots differ in their last bit between
/// host and board, and with them the trials of a search and the small residuals that a standard error is made of.
const TOLERANCES: [(&str, f64); 2] = [("f32", 1e-4), ("f64", 1e-9)];

/// What a board said of one calibration.
struct Calibrated {
    case: Case,
    values: Vec<f64>,
    instructions: u32,
    stack: u32,
}

/// All that a board said.
#[derive(Default)]
pub(crate) struct Protocol {
    calibrated: Vec<Calibrated>,
    pub(crate) code: Vec<Code>,
}

impl Protocol {
    /// Reads the lines that the firmware prints.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut calibrated = Vec::new();
        let code = answers::read_lines(text, |kind, fields| {
            if kind == "calibration" {
                calibrated.push(Calibrated {
                    case: Case { scene: fields.text("scene")?, scalar: fields.text("scalar")? },
                    values: numbers(&fields.text("values")?)?,
                    instructions: fields.number("instructions")?,
                    stack: fields.number("stack")?,
                });
            }
            Ok(kind == "calibration")
        })?;
        Ok(Self { calibrated, code })
    }

    /// Takes in what another binary printed.
    pub(crate) fn append(&mut self, mut other: Self) {
        self.calibrated.append(&mut other.calibrated);
        self.code.append(&mut other.code);
    }

    /// Every difference from what the host expects.
    pub(crate) fn differences(&self, expected: &BTreeMap<Case, Vec<f64>>) -> Vec<String> {
        let mut differences = Vec::new();
        for Calibrated { case, values, .. } in &self.calibrated {
            match expected.get(case) {
                Some(host) if agree(values, host, &case.scalar) => {}
                Some(host) => differences.push(format!("{case}: {values:?} on the board, {host:?} on the host")),
                None => differences.push(format!("{case}: unknown to the host")),
            }
        }
        let unanswered = expected.keys().filter(|case| self.calibrated.iter().all(|found| found.case != **case));
        differences.extend(unanswered.map(|case| format!("{case}: no answer")));
        differences
    }

    /// The figures that a board printed.
    pub(crate) fn figures(&self, board: &Board) -> Vec<Figure> {
        let figures = |Calibrated { case: Case { scene, scalar }, instructions, stack, .. }: &Calibrated| {
            [(Quantity::Calibrate, instructions), (Quantity::Stack, stack)]
                .map(|(quantity, value)| crate::of_scene(board, scene, scalar, quantity, (*value).into()))
        };
        self.calibrated.iter().flat_map(figures).collect()
    }
}

impl Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.scene, self.scalar)
    }
}

fn agree(found: &[f64], expected: &[f64], scalar: &str) -> bool {
    let tolerance = TOLERANCES.iter().find(|(of, _)| *of == scalar).map_or(0.0, |(_, tolerance)| *tolerance);
    let close = |(found, expected): (&f64, &f64)| (found - expected).abs() <= tolerance * expected.abs();
    found.len() == expected.len() && found.iter().zip(expected).all(close)
}

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let number = |word: &str| word.parse().map_err(|_| format!("the firmware printed no numbers: {text}"));
    text.split(',').map(number).collect()
}

/// What the host finds by every calibration.
pub(crate) fn expected() -> Result<BTreeMap<Case, Vec<f64>>, String> {
    let mut host = Host { found: BTreeMap::new(), refused: Vec::new() };
    visit_calibrations(&mut host);
    visit_double_calibrations(&mut host);
    if host.refused.is_empty() {
        Ok(host.found)
    } else {
        Err(format!("{}; correct examples/firmware/scenes/src/calibrations.rs", host.refused.join("; ")))
    }
}

struct Host {
    found: BTreeMap<Case, Vec<f64>>,
    refused: Vec<String>,
}

impl CalibrationVisitor for Host {
    fn visit<T: Number, C: Calibration<T>>(&mut self) {
        let case = Case { scene: C::NAME.to_owned(), scalar: T::NAME.to_owned() };
        let Some(measured) = C::new() else {
            self.refused.push(format!("{case}: a method or a measurement is refused"));
            return;
        };
        match measured.calibrate() {
            Ok(answer) => {
                // By the digits, as the board's numbers come.
                let values = answer.as_ref().iter().map(|value| format!("{value:e}").parse().unwrap_or(f64::NAN));
                self.found.insert(case, values.collect());
            }
            Err(error) => self.refused.push(format!("{case}: {error}")),
        }
    }
}
