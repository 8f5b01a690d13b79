//! Rows by the contact simulation.

use microimpact::contact::{
    Adaptive, AnyScene, Contact, ContactImpulses, ContactTimes, ContactWorks, Groups, NormalContact, SlipHistory,
    Status,
};
use microimpact::measure::ClassProbabilities;
use microimpact::rigid::Departure;
use microimpact::space::Departing;
use microimpact::{Approach, Class, Hertz, Oblique, Outcome, PlanarMotion, SurfaceMotion};
use sheet::{Header, Input, Row, Value};

use super::arrival::{self, Arrival};
use super::method::{Outputs, Simulation};
use super::uncertain::{Deviations, Inputs, Kind, Probabilities, Reason, Values};
use crate::command::Number;
use crate::contact_law::{LAW_INPUTS, LawName, RowLaw};
use crate::inputs::{FRICTION_INPUT, PEELING_INPUT, YIELD_INPUT};
use crate::rows::{BadRow, Work};
use crate::words::{motion_name, name_of, outcome_name};

/// The stiffness of the contact along the surface over that along the normal.
const STIFFNESS_RATIO: &str = "stiffness_ratio";

/// A solved impact and its outputs.
type Solved<T> = (NormalContact<T>, Along<T>, Outputs<T>);

/// The simulation by a method, in numbers of type `T`.
pub struct SimulationModel<T> {
    pub method: Simulation<T>,
    /// Least probability of a class that is named where numbers have standard errors.
    pub level: f64,
}

/// A simulated impact.
pub struct Simulated<T> {
    pub outcome: Outcome,
    pub class: Class,
    normal: NormalContact<T>,
    /// Whether the method follows a captured sphere to its first turning point.
    follows_captures: bool,
    tangential: Along<T>,
    times: ContactTimes<T>,
    impulses: ContactImpulses<T>,
    works: ContactWorks<T>,
    /// The motion along the surface, of a captured sphere as far as it was followed.
    slip: SlipHistory<T>,
    groups: Option<Groups<T>>,
    pub law: LawName,
    speed_over_yield: Option<T>,
    friction: T,
    pub arrival: Arrival<T>,
}

/// What happened along the surface.
#[derive(Clone, Copy)]
pub struct Along<T> {
    motion: SurfaceMotion,
    /// After a rebound, or of a captured sphere when its slip has ended.
    pub velocity: T,
    pub spin: T,
    /// Impulse ratio and number of phases, with compliance.
    compliant: Option<(T, u32)>,
}

impl<T: Number> Departing<T> for Simulated<T> {
    fn departure(&self, _tangential: T) -> Option<Departure<T>> {
        let velocities = Departure { normal: self.normal.rebound_speed(), tangential: self.tangential.velocity };
        (self.outcome != Outcome::Undecided).then_some(velocities)
    }
}

impl<T: Number> Simulated<T> {
    /// Overall restitution; `None` where the outcome is undecided.
    pub fn restitution(&self) -> Option<T> {
        (self.outcome != Outcome::Undecided).then(|| self.normal.overall_restitution())
    }

    /// Friction over the least friction that stops the slip of a rebound: the impulse of friction is proportional to the elastic
    /// impulse (B8), and the one that stops the slip is the contact's inertia times the slip (A27). `None` without slip.
    pub fn friction_over_limit(&self) -> Option<T> {
        let (sphere, slip) = (self.arrival.sphere, self.arrival.motion.slip().abs());
        let stopped = self.friction * self.impulses.elastic / (sphere.mass() * sphere.contact_inertia());
        (slip > T::ZERO).then(|| stopped / slip)
    }

    /// Velocities along the surface after a rebound, or of a captured sphere when its slip has ended; `None` where the motion
    /// was not followed so far.
    pub fn along(&self) -> Option<&Along<T>> {
        self.followed().then_some(&self.tangential)
    }

    /// Whether the motion was followed to separation, or beyond the peak of a captured sphere.
    fn followed(&self) -> bool {
        match self.outcome {
            Outcome::Rebound => true,
            Outcome::Capture => self.follows_captures,
            Outcome::Undecided => false,
        }
    }

    /// Whether the motion was followed to separation, or to the turning point of a captured sphere. A sphere that creeps to
    /// rest has none.
    fn followed_to_end(&self) -> bool {
        self.followed() && (self.outcome == Outcome::Rebound || self.normal.turning_indentation().is_some())
    }

    /// The cells of the columns that the model computes.
    fn cells(&self, row: &Row<'_>) -> Vec<Value> {
        let Self { outcome, normal, times, impulses, works, slip, groups, law, speed_over_yield, .. } = self;
        let (followed, to_end) = (self.followed(), self.followed_to_end());
        let optional = |value: Option<T>| Value::from(value);
        let at_end = |value: T| optional(to_end.then_some(value));
        let motion = (*outcome != Outcome::Undecided).then(|| self.motion());
        // The slip of a captured sphere may end after it was followed; then the time is not known.
        let slip_ends = match (slip.rolls_from, motion) {
            // It slips and sticks several times.
            _ if self.tangential.compliant.is_some() => None,
            (None, Some(SurfaceMotion::Sliding)) => Some(-T::ONE),
            (time, _) => time,
        };
        let in_space = self.arrival.cells(row, followed.then_some(self));
        let compliant = self.tangential.compliant.filter(|_| followed);
        let compliance = [
            optional(compliant.map(|(ratio, _)| ratio)),
            compliant.map_or(Value::Empty, |(_, phases)| Value::Integer(phases.into())),
        ];
        let in_plane = [
            outcome_name(*outcome).into(),
            motion.map_or(Value::Empty, |motion| motion_name(motion).into()),
            optional(self.restitution()),
            optional(self.restitution().map(|_| normal.rebound_speed())),
            optional(normal.peak_indentation()),
            optional(normal.turning_indentation().filter(|_| followed)),
            optional(times.peak),
            optional(times.contact.filter(|_| followed)),
            optional(slip_ends.filter(|_| followed)),
            at_end(impulses.elastic),
            at_end(impulses.adhesion_rebound),
            at_end(works.material),
            at_end(works.adhesion),
            at_end(slip.velocity),
            at_end(slip.spin),
            at_end(slip.rotation),
            at_end(slip.displacement),
            optional(groups.map(|groups| groups.elasticity)),
            optional(groups.map(|groups| groups.adhesion)),
            optional(groups.map(|groups| groups.material_damping)),
            optional(groups.map(|groups| groups.adhesion_damping)),
            law.word().into(),
            optional(*speed_over_yield),
        ];
        let mut cells = Vec::from(in_plane);
        if row.header().has(STIFFNESS_RATIO) {
            cells.extend(compliance);
        }
        cells.extend(in_space);
        cells
    }

    /// How the contact point moves after the impact.
    fn motion(&self) -> SurfaceMotion {
        self.arrival.motion_after(self.tangential.motion)
    }

    /// The energy that a rebound loses over that before; `None` of other impacts.
    fn energy_lost(&self) -> Option<T> {
        let Self { arrival, normal, tangential, .. } = self;
        let (sphere, motion) = (arrival.sphere, arrival.motion);
        let energy = |normal: T, along: T, peripheral: T| {
            let squares = normal * normal + along * along + sphere.gyration_ratio() * peripheral * peripheral;
            T::constant(0.5) * sphere.mass() * squares
        };
        let before = energy(motion.normal().speed(), motion.tangential(), motion.peripheral());
        let after = energy(normal.rebound_speed(), tangential.velocity, tangential.spin * sphere.radius());
        (self.outcome == Outcome::Rebound)
            .then(|| (before - after).max(T::ZERO) / arrival.energy_before().unwrap_or(before))
    }

    /// The line of the summary.
    fn line(&self, header: &Header<'_>, name: String) -> Vec<String> {
        let Self { outcome, class, normal, times, slip, law, arrival, .. } = self;
        let nano = |value: Option<T>| value.map_or("-".into(), |value| format!("{:.2}", value * T::constant(1e9)));
        let (restitution, followed) = (self.restitution(), self.followed());
        let lost = self.energy_lost().filter(|_| followed).map(|lost| T::constant(100.0) * lost);
        let optional = |value: Option<String>| value.unwrap_or("-".into());
        let in_plane = vec![
            name,
            class.to_string(),
            name_of(law),
            optional(restitution.map(|e| format!("{e:.4}"))),
            optional(restitution.map(|_| format!("{:.3}", normal.rebound_speed()))),
            arrival.of_one_body(optional(self.along().map(|along| format!("{:.3}", along.velocity + T::ZERO)))),
            arrival.of_one_body(optional(self.along().map(|along| format!("{:.2e}", along.spin + T::ZERO)))),
            nano(normal.peak_indentation()),
            nano(times.contact.filter(|_| followed)),
            match (outcome, self.motion()) {
                _ if self.tangential.compliant.is_some() => "-".into(),
                (Outcome::Rebound, SurfaceMotion::Sliding) => "always".into(),
                _ => nano(slip.rolls_from.filter(|_| followed)),
            },
            optional(lost.map(|lost| format!("{lost:.1}"))),
        ];
        [in_plane, arrival.summary(header, followed.then_some(self))].concat()
    }
}

/// What arrives, the law of contact and the scene of a row.
pub fn scene<T: Number>(row: &Row<'_>) -> Result<(Arrival<T>, RowLaw<T>, AnyScene<T>), String> {
    let arrival = Arrival::read(row)?;
    arrival.refuse(row, &["peeling_n_m"], &["external_force_n"])?;
    let row_law = RowLaw::read(row)?;
    let law = row_law.law().map_err(|error| row.reason(error))?;
    let scene = Contact::new(arrival.sphere, law).with_friction(row.or_zero("friction")?);
    Ok((arrival, row_law, scene.map_err(|error| row.reason(error))?))
}

/// Random rows that are simulated for standard errors too large for an expansion.
const DRAWS: u32 = 5_000;

/// The probabilities by an expansion.
fn expand<'a, T: Number>(
    row: &Row<'_>,
    inputs: &Inputs<T>,
    row_of: &dyn Fn(Values<T>) -> Row<'a>,
    method: &Adaptive<T>,
) -> Result<ClassProbabilities<T>, String> {
    let reason = Reason::new();
    let scene = |row: &Row<'_>| {
        let arrival = Arrival::read(row)?;
        let (law, friction) = (RowLaw::read(row)?.law(), row.or_zero("friction")?);
        let scene = law.and_then(|law| Contact::new(arrival.sphere, law).with_friction(friction));
        Ok((scene.map_err(|error| row.reason(error))?, arrival.motion, method))
    };
    let found = ClassProbabilities::new(inputs, |values| reason.keep(scene(&row_of(values))));
    found.map_err(|error| reason.of(row, error))
}

impl<T: Number> SimulationModel<T> {
    /// The probabilities of the classes of a row; `None` if it has no standard errors.
    pub fn probabilities(&self, row: &Row<'_>) -> Result<Option<Probabilities>, String> {
        let Some(deviations) = Deviations::read::<T>(row, &Kind::Simulation)? else { return Ok(None) };
        let is_empty = |column: &&str| !row.has(column);
        let is_known = deviations.are_small() && ["peeling_n_m", STIFFNESS_RATIO].iter().all(is_empty);
        let probabilities = match self.method.control.as_ref().filter(|_| is_known) {
            Some(method) => deviations.expanded(|inputs, row_of| expand(row, inputs, row_of, method)),
            None => deviations.drawn::<T>(DRAWS, |row| Ok(self.compute(row)?.class)),
        };
        probabilities.map(Some)
    }

    /// The class of a row in words: with its probability if numbers have standard errors.
    pub fn class_in_words(&self, row: &Row<'_>, class: Class) -> Result<String, String> {
        let probabilities = self.probabilities(row)?;
        Ok(probabilities.map_or_else(|| class.to_string(), |found| found.in_words(self.level)))
    }

    /// The computed cells of a row, from its impact.
    pub fn cells_of(&self, row: &Row<'_>, simulated: &Simulated<T>) -> Result<Vec<Value>, BadRow> {
        let mut cells = simulated.cells(row);
        match self.probabilities(row) {
            Ok(found) => {
                cells.extend(found.iter().flat_map(|found| found.cells(self.level)));
                Ok(cells)
            }
            Err(reason) => Err(BadRow { reason, cells }),
        }
    }

    /// Builds the scene of a row and simulates its impact.
    pub fn compute(&self, row: &Row<'_>) -> Result<Simulated<T>, String> {
        let (arrival, row_law, scene) = scene(row)?;
        let (sphere, before) = (arrival.sphere, arrival.motion);
        let friction = row.or_zero("friction")?;
        let yield_pressure = row.number("yield_pressure_pa")?;
        let yield_speed = yield_pressure.map(|pressure| Hertz::yield_speed(&sphere, row_law.stiffness, pressure));
        let yield_speed = yield_speed.transpose().map_err(|error| row.reason(error))?;
        let groups = row_law.groups(sphere, &before).map_err(|error| row.reason(error))?;
        let (normal, tangential, ((times, impulses, works), slip)) = match row.number(STIFFNESS_RATIO)? {
            Some(ratio) => self.solve_compliant(row, &scene, &before, ratio)?,
            None => self.solve(row, &scene, &before)?,
        };
        let outcome = normal.outcome().ok_or("the simulation has no outcome")?;
        let class = Class::of(outcome, arrival.motion_after(tangential.motion));
        let follows_captures = self.method.follows_captures;
        Ok(Simulated {
            outcome,
            class,
            normal,
            follows_captures,
            tangential,
            times,
            impulses,
            works,
            slip,
            groups,
            law: row_law.name,
            speed_over_yield: yield_speed.map(|speed| before.normal().speed() / speed),
            friction,
            arrival,
        })
    }

    fn solve(&self, row: &Row<'_>, scene: &AnyScene<T>, before: &PlanarMotion<T>) -> Result<Solved<T>, String> {
        let peeling: T = row.or_zero("peeling_n_m")?;
        let solved = self.method.simulator.simulate(scene, peeling, before);
        let (impact, outputs) = solved.map_err(|error| row.reason(error))?;
        if impact.run.status != Status::Solved {
            return Err(self.method.refusal(impact.run.status, scene, peeling, before));
        }
        let along = impact.tangential;
        let (motion, velocity, spin) = (along.motion(), along.velocity(), along.spin());
        Ok((impact.normal, Along { motion, velocity, spin, compliant: None }, outputs))
    }

    fn solve_compliant(
        &self,
        row: &Row<'_>,
        scene: &AnyScene<T>,
        before: &PlanarMotion<T>,
        ratio: T,
    ) -> Result<Solved<T>, String> {
        if row.or_zero::<T>("peeling_n_m")? != T::ZERO {
            return Err("peeling_n_m: it is not known with a stiffness_ratio; leave one of them empty".into());
        }
        let scene = scene.with_compliance(ratio).map_err(|error| row.reason(error))?;
        let Some(solved) = self.method.simulator.simulate_compliant(&scene, before) else {
            return Err(format!(
                "{STIFFNESS_RATIO}: --method {} is not offered with it; use --method adaptive, or leave the cell empty",
                self.method.method
            ));
        };
        let (impact, outputs) = solved.map_err(|error| row.reason(error))?;
        if impact.run.status != Status::Solved {
            return Err(format!(
                "{STIFFNESS_RATIO}: the contact sticks and slips too often to be followed, as it does where damping leaves hardly any \
                 rebound; use less damping, or leave the cell empty for a contact that does not give sideways"
            ));
        }
        let along = impact.tangential;
        let compliant = Some((along.impulse_ratio(), along.phases()));
        let (motion, velocity, spin) = (along.motion(), along.velocity(), along.spin());
        Ok((impact.normal, Along { motion, velocity, spin, compliant }, outputs))
    }
}

impl<T: Number> Work for SimulationModel<T> {
    type Notes = ();

    fn inputs(&self) -> Vec<Input> {
        let compliance = Input::further(&[STIFFNESS_RATIO]);
        let own = [PEELING_INPUT, YIELD_INPUT, compliance];
        [&arrival::INPUTS[..], &[FRICTION_INPUT], &LAW_INPUTS, &own, &Kind::Simulation.inputs()].concat()
    }

    fn columns(&self, header: &Header<'_>) -> Vec<String> {
        let in_plane = [
            "outcome",
            "motion",
            "overall_restitution",
            "rebound_speed_m_s",
            "max_indentation_m",
            "turning_indentation_m",
            "time_peak_s",
            "contact_time_s",
            "time_roll_s",
            "impulse_hertz_n_s",
            "impulse_adhesion_rebound_n_s",
            "work_material_j",
            "work_adhesion_j",
            "speed_tangential_out_m_s",
            "spin_out_rad_s",
            "rotation_rad",
            "displacement_tangential_m",
            "group_a",
            "group_b",
            "group_h",
            "group_g",
            "law",
            "speed_over_yield",
        ];
        let compliance: &[&str] = if header.has(STIFFNESS_RATIO) { &["impulse_ratio_out", "phases"] } else { &[] };
        let in_plane = in_plane.iter().chain(compliance).map(|name| name.to_string());
        in_plane.chain(arrival::columns(header)).chain(Kind::Simulation.columns(header)).collect()
    }

    fn cells(&self, row: &Row<'_>, (): &mut ()) -> Result<Vec<Value>, BadRow> {
        self.cells_of(row, &self.compute(row)?)
    }

    fn heads(&self, header: &Header<'_>) -> Vec<&'static str> {
        let in_plane = [
            "impact",
            "class",
            "law",
            "e",
            "V_n\nm/s",
            "V_t\nm/s",
            "spin\nrad/s",
            "peak\nnm",
            "contact\nns",
            "slips for\nns",
            "energy\nlost %",
        ];
        [&in_plane, arrival::heads(header)].concat()
    }

    fn words(&self) -> usize {
        3
    }

    fn line(&self, row: &Row<'_>, name: String, (): &mut ()) -> Result<Vec<String>, String> {
        let simulated = self.compute(row)?;
        let mut line = simulated.line(&row.header(), name);
        line[1] = self.class_in_words(row, simulated.class)?;
        Ok(line)
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use sheet::Sheet;

    use super::*;
    use crate::classify::method::MethodOptions;

    const TABLE: &str = "\
radius_m,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_h,zeta_a,friction,speed_normal_m_s,speed_tangential_m_s
5.06e-6,2600,7.5e10,250,10.5,6.25,0.1,2.8,1
";

    #[derive(Parser)]
    struct Arguments {
        #[command(flatten)]
        method: MethodOptions,
    }

    /// A method that cannot distinguish rebound from capture knows the approach, and nothing that depends on the outcome.
    #[test]
    fn an_undecided_impact_has_no_values_of_its_end() {
        let options = Arguments::try_parse_from(["test"]).unwrap_or_else(|error| panic!("{error}"));
        let model = SimulationModel::<f64> { method: options.method.simulation().unwrap(), level: 0.9 };
        let mut sheet = Sheet::open(TABLE.as_bytes(), &model.inputs(), None).unwrap();
        let row = sheet.next_row().unwrap().unwrap();
        let rebound = model.compute(&row).unwrap();
        let filled = |simulated: &Simulated<f64>| {
            let cells = simulated.cells(&row);
            let named = model.columns(&row.header()).into_iter().zip(cells).filter(|(_, cell)| *cell != Value::Empty);
            named.map(|(column, _)| column).collect::<Vec<_>>()
        };
        assert_eq!(
            filled(&rebound).len(),
            model.columns(&row.header()).len() - 2,
            "all but the turning point of a capture and the yield"
        );

        let undecided = Simulated { outcome: Outcome::Undecided, class: Class::Undecided, ..rebound };
        assert_eq!(undecided.cells(&row)[0], Value::Word("undecided"));
        assert_eq!(
            filled(&undecided),
            ["outcome", "max_indentation_m", "time_peak_s", "group_a", "group_b", "group_h", "group_g", "law"]
        );
        let line = undecided.line(&row.header(), "name".into());
        assert_eq!(line[1], "undecided");
        assert_eq!(line.iter().filter(|cell| *cell == "-").count(), line.len() - 4, "{line:?}");
    }
}
