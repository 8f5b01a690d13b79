//! Rows by the rigid-body model.

use std::marker::PhantomData;

use microimpact::measure::ClassProbabilities;
use microimpact::rigid::{AdhesionCoefficient, AnyAdhesion, AnyRestitution, SpeedAdhesion, WorkOfAdhesion};
use microimpact::{
    Class, Classification, ContactClass, Impact, ImpactError, RigidBody, Sphere, SurfaceMotion, TangentialImpact,
};
use sheet::{Header, Input, Row, Value};

use super::arrival::{self, Arrival};
use super::uncertain::{Deviations, Inputs, Kind, Probabilities, Reason, Values};
use crate::command::Number;
use crate::inputs::{FRICTION_INPUT, POWER_INPUT, RESTITUTION_INPUT, restitution_law};
use crate::rows::{BadRow, Work};
use crate::words::{motion_name, outcome_name};

/// The numbers that only this model reads.
const INPUTS: [Input; 6] = [
    RESTITUTION_INPUT,
    POWER_INPUT,
    Input::optional(&["adhesion_coefficient", "work_of_adhesion_j", "adhesion_speed_m_s"], "no adhesion"),
    Input::optional(&["adhesion_power"], "1"),
    Input::optional(&["impulse_ratio"], "as friction gives it")
        .replacing("friction", "the rigid body takes it instead of friction"),
    Input::optional(&["rolling_arm_m"], "0 m"),
];

/// The rigid-body model in numbers of type `T`.
pub struct RigidBodyModel<T> {
    scalar: PhantomData<T>,
    /// Least probability of a class that is named where numbers have standard errors.
    level: f64,
}

/// An impact and its class.
pub struct Classified<T> {
    pub sphere: Sphere<T>,
    pub impact: Impact<T, TangentialImpact<T>>,
    pub classification: Classification<T, ContactClass<T>>,
    arrival: Arrival<T>,
}

impl<T: Number> Classified<T> {
    /// How the contact point moves after the impact.
    fn motion(&self) -> SurfaceMotion {
        self.arrival.motion_after(self.classification.contact.motion)
    }

    pub fn class(&self) -> Class {
        Class::of(self.classification.outcome, self.motion())
    }
}

impl<T: Number> RigidBodyModel<T> {
    pub fn new(level: f64) -> Self {
        Self { scalar: PhantomData, level }
    }

    /// The class of a row in words: with its probability if numbers have standard errors.
    pub fn class_in_words(&self, row: &Row<'_>, classified: &Classified<T>) -> Result<String, String> {
        let probabilities = self.probabilities(row)?;
        Ok(probabilities.map_or_else(|| classified.class().to_string(), |found| found.in_words(self.level)))
    }

    /// The probabilities of the classes of a row; `None` if it has no standard errors.
    pub fn probabilities(&self, row: &Row<'_>) -> Result<Option<Probabilities>, String> {
        let Some(deviations) = Deviations::read::<T>(row, &Kind::RigidBody)? else { return Ok(None) };
        let is_empty = |column: &&str| !row.has(column);
        let is_expanded = deviations.are_small() && ["impulse_ratio", "rolling_arm_m"].iter().all(is_empty);
        let probabilities = if is_expanded {
            deviations.expanded::<T>(|inputs, row_of| expand(row, inputs, row_of))
        } else {
            deviations.drawn::<T>(DRAWS, |row| Ok(self.compute(row)?.class()))
        };
        probabilities.map(Some)
    }

    /// The computed cells of a row, from its impact.
    pub fn cells_of(&self, row: &Row<'_>, classified: &Classified<T>) -> Result<Vec<Value>, BadRow> {
        let Classified { sphere, impact, classification, .. } = classified;
        let Impact { normal, tangential } = impact;
        let ledger = impact.energy(sphere);
        let in_plane = [
            outcome_name(classification.outcome).into(),
            motion_name(classified.motion()).into(),
            normal.overall_restitution().value(),
            normal.rebound_speed().value(),
            tangential.velocity().value(),
            tangential.spin(sphere).value(),
            tangential.impulse_ratio().value(),
            tangential.rolling_ratio().value(),
            classification.speed_over_critical.into(),
            classification.contact.friction_over_limit.into(),
            classified.arrival.energy_before().unwrap_or(ledger.before).value(),
            ledger.material.value(),
            ledger.adhesion.value(),
            ledger.friction.value(),
            ledger.rolling.value(),
        ];
        let mut cells = Vec::from(in_plane);
        cells.extend(classified.arrival.cells(row, Some(impact)));
        match self.probabilities(row) {
            Ok(found) => {
                cells.extend(found.iter().flat_map(|found| found.cells(self.level)));
                Ok(cells)
            }
            Err(reason) => Err(BadRow { reason, cells }),
        }
    }

    /// Builds the scene of a row and classifies its impact.
    pub fn compute(&self, row: &Row<'_>) -> Result<Classified<T>, String> {
        let arrival = Arrival::read(row)?;
        arrival.refuse(row, &["rolling_arm_m"], &[])?;
        let scene = RigidBody::new(arrival.sphere, restitution_law(row, |number: T| number)?)
            .with_adhesion(adhesion(row, &arrival.sphere)?);
        along_surface(row, arrival, scene)
    }
}

/// The adhesion of a row.
fn adhesion<T: Number>(row: &Row<'_>, sphere: &Sphere<T>) -> Result<AnyAdhesion<T>, String> {
    let power = row.number("adhesion_power")?;
    let given =
        [row.number("adhesion_coefficient")?, row.number("work_of_adhesion_j")?, row.number("adhesion_speed_m_s")?];
    if power.is_some() && given[2].is_none() {
        return Err("adhesion_power: adhesion_speed_m_s is missing; give it too or leave the cell empty".into());
    }
    let adhesion = match given {
        [None, None, None] => Ok(AnyAdhesion::None),
        [Some(rho), None, None] => AdhesionCoefficient::new(rho).map(Into::into),
        [None, Some(work), None] => WorkOfAdhesion::new(work, sphere).map(Into::into),
        [None, None, Some(speed)] => SpeedAdhesion::new(speed, power.unwrap_or(T::ONE)).map(Into::into),
        _ => {
            let columns = "adhesion_coefficient, work_of_adhesion_j and adhesion_speed_m_s";
            return Err(format!("adhesion: given twice; of {columns} leave all but one empty"));
        }
    };
    adhesion.map_err(|error| row.reason(error))
}

/// Random rows that are classified for standard errors too large for an expansion.
const DRAWS: u32 = 40_000;

/// The probabilities by an expansion.
fn expand<'a, T: Number>(
    row: &Row<'_>,
    inputs: &Inputs<T>,
    row_of: &dyn Fn(Values<T>) -> Row<'a>,
) -> Result<ClassProbabilities<T>, String> {
    let reason = Reason::new();
    let scene = |row: &Row<'_>| {
        let arrival = Arrival::read(row)?;
        let scene = RigidBody::new(arrival.sphere, restitution_law(row, |number: T| number)?);
        let scene = scene.with_adhesion(adhesion(row, &arrival.sphere)?).with_friction(row.or_zero("friction")?);
        Ok((scene.map_err(|error| row.reason(error))?, arrival.motion))
    };
    let found = ClassProbabilities::new(inputs, |values| reason.keep(scene(&row_of(values))));
    found.map_err(|error| reason.of(row, error))
}

/// Chooses the tangential process that the row gives, and computes.
fn along_surface<T: Number>(
    row: &Row<'_>,
    arrival: Arrival<T>,
    scene: RigidBody<T, AnyRestitution<T>, AnyAdhesion<T>>,
) -> Result<Classified<T>, String> {
    let (before, friction) = (&arrival.motion, row.or_zero("friction")?);
    let impact = match (row.number("impulse_ratio")?, row.number("rolling_arm_m")?) {
        (Some(mu), None) => scene.impact_with_ratio(before, mu).map_err(|error| match error {
            ImpactError::ImpulseRatioOutsideBounds => {
                let without = scene.impact_with_ratio(before, T::ZERO);
                out_of_bounds(row, without.map_or(T::ZERO, |impact| impact.tangential.rolling_ratio()))
            }
            error => row.reason(error),
        })?,
        (None, None) => scene.with_friction(friction).map_err(|error| row.reason(error))?.impact(before),
        (None, Some(arm)) => {
            let scene = scene.with_friction(friction).and_then(|scene| scene.with_rolling_dissipation(arm));
            scene.map_err(|error| row.reason(error))?.impact(before)
        }
        (Some(_), Some(_)) => {
            return Err("rolling_arm_m: impulse_ratio is given too and includes it; leave one of them empty".into());
        }
    };
    let classification = scene.classify_impact(&impact);
    Ok(Classified { sphere: arrival.sphere, classification, impact, arrival })
}

/// Why the impulse ratio of a row is refused: no friction of a rigid body has it.
fn out_of_bounds<T: Number>(row: &Row<'_>, rolling_ratio: T) -> String {
    let (text, end) = (row.text("impulse_ratio").unwrap_or_default(), row.text_of(rolling_ratio));
    format!(
        "impulse_ratio: \"{text}\" is refused: it must be 0 to mu_0, here {end}, at which the slip ends: the friction of a rigid body \
         neither increases nor reverses the slip; enter such a ratio, or leave the cell empty and give friction"
    )
}

impl<T: Number> Work for RigidBodyModel<T> {
    type Notes = ();

    fn inputs(&self) -> Vec<Input> {
        [&arrival::INPUTS[..], &[FRICTION_INPUT], &INPUTS, &Kind::RigidBody.inputs()].concat()
    }

    fn columns(&self, header: &Header<'_>) -> Vec<String> {
        let in_plane = [
            "outcome",
            "motion",
            "overall_restitution",
            "rebound_speed_m_s",
            "speed_tangential_out_m_s",
            "spin_out_rad_s",
            "impulse_ratio_out",
            "rolling_ratio",
            "speed_over_critical",
            "friction_over_limit",
            "energy_before_j",
            "work_material_j",
            "work_adhesion_j",
            "work_friction_j",
            "work_rolling_j",
        ];
        let known = in_plane.map(String::from).into_iter().chain(arrival::columns(header));
        known.chain(Kind::RigidBody.columns(header)).collect()
    }

    fn cells(&self, row: &Row<'_>, (): &mut ()) -> Result<Vec<Value>, BadRow> {
        self.cells_of(row, &self.compute(row)?)
    }

    fn heads(&self, header: &Header<'_>) -> Vec<&'static str> {
        let in_plane = [
            "impact",
            "class",
            "e",
            "V_n\nm/s",
            "V_t\nm/s",
            "spin\nrad/s",
            "mu",
            "mu_0",
            "speed over\ncritical",
            "friction\nover mu_0",
            "energy\nlost %",
        ];
        [&in_plane, arrival::heads(header)].concat()
    }

    fn line(&self, row: &Row<'_>, name: String, (): &mut ()) -> Result<Vec<String>, String> {
        let classified = self.compute(row)?;
        let Classified { sphere, impact, classification, arrival } = &classified;
        let Impact { normal, tangential } = impact;
        let ledger = impact.energy(sphere);
        let optional = |value: Option<T>| value.map_or("-".into(), |value| format!("{value:.3}"));
        let in_plane = vec![
            name,
            self.class_in_words(row, &classified)?,
            format!("{:.3}", normal.overall_restitution()),
            format!("{:.3}", normal.rebound_speed()),
            arrival.of_one_body(format!("{:.3}", tangential.velocity() + T::ZERO)),
            arrival.of_one_body(format!("{:.2e}", tangential.spin(sphere) + T::ZERO)),
            format!("{:.4}", tangential.impulse_ratio()),
            format!("{:.4}", tangential.rolling_ratio()),
            optional(classification.speed_over_critical),
            optional(classification.contact.friction_over_limit),
            format!("{:.1}", T::constant(100.0) * ledger.lost() / arrival.energy_before().unwrap_or(ledger.before)),
        ];
        Ok([in_plane, arrival.summary(&row.header(), Some(impact))].concat())
    }
}
