//! Rows by the contact simulation.

use methods::{Simulator, Solution};
use microimpact::contact::{
    AnyLaw, AnyScene, Classified, CompliantVelocities, Contact, ContactImpulses, ContactTimes, ContactWorks, Energy,
    ErrorControl, Impulses, Method, NormalContact, SimulatedImpact, Slip, SlipHistory, Status, TangentialVelocities,
    Times, Works,
};
use microimpact::rigid::EnergyLedger;
use microimpact::space::Departing;
use microimpact::{Class, ContactClass, CriticalSpeed, InputError, Outcome, Parameter, SurfaceMotion};
use rayon::prelude::*;

use crate::impacts::{Record, gather};
use crate::motions::Arrival;
use crate::quantity::Asked;
use crate::{Column, Contacts, Impacts, Motions, Quantity, RowStatus, Surface};

/// What a simulation tells of an impact besides how it ends.
pub type Outputs =
    ((ContactTimes<f64>, ContactImpulses<f64>, ContactWorks<f64>), (SlipHistory<f64>, Option<EnergyLedger<f64>>));

/// Asks for it.
pub const OUTPUTS: ((Times, Impulses, Works), (Slip, Energy)) = ((Times, Impulses, Works), (Slip, Energy));

/// Computes the same with each law by its own type: a solver that asks for the law at every step takes more than half as much time
/// again.
macro_rules! by_law {
    ($any:expr, $law:ident => $result:expr) => {
        match $any {
            AnyLaw::Hertz($law) => $result,
            AnyLaw::WithoutTension($law) => $result,
            AnyLaw::Ring($law) => $result,
            AnyLaw::Dmt($law) => $result,
            AnyLaw::Jkr($law) => $result,
            $law => $result,
        }
    };
}

pub(crate) use by_law;

impl Contacts<'_> {
    /// Simulates the impacts of `count` rows on all threads. The result of a row is that of a single call of the method. A
    /// `FixedCost` needs [`with_outputs`](microimpact::contact::FixedCost::with_outputs) for quantities of the motion in contact, such as a
    /// work; without it those rows are unsupported.
    pub fn simulate(
        &self,
        motions: &Motions<'_>,
        count: usize,
        method: &(impl Method<f64> + Sync),
        quantities: &[Quantity],
    ) -> Impacts {
        self.simulate_until(motions, count, method, quantities, || false)
    }

    /// The same until `stop` is true: then all rows that are left end without convergence.
    ///
    /// ```
    /// use impact_arrays::{Column, Contacts, Motions, RowStatus};
    /// use microimpact::contact::Adaptive;
    ///
    /// let all = Column::All;
    /// let contacts = Contacts { radius: all(1e-6), density: all(2600.0), stiffness: all(7.5e10), ..Contacts::default() };
    /// let motions = Motions::Planar { speed_normal: all(2.8), speed_tangential: all(0.0), spin: all(0.0) };
    /// let stopped = contacts.simulate_until(&motions, 2, &Adaptive::new(1e-6)?, &[], || true);
    /// assert_eq!(stopped.status, [RowStatus::NotConverged; 2]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn simulate_until(
        &self,
        motions: &Motions<'_>,
        count: usize,
        method: &(impl Method<f64> + Sync),
        quantities: &[Quantity],
        stop: impl Fn() -> bool + Sync,
    ) -> Impacts {
        let asked = Asked::by(quantities);
        gather(count, quantities, |row| {
            if stop() { Ok(Record::without(RowStatus::NotConverged)) } else { self.row(motions, row, method, asked) }
        })
    }

    /// Simulates the impacts of `count` rows on all threads, by a method that is chosen at run time and may be slow. With compliance
    /// along the surface, a row is unsupported unless the method is `Adaptive`, which alone has the margin of friction. Once `stop` is
    /// true, all rows that are left end without convergence.
    ///
    /// ```
    /// use impact_arrays::{Column, Contacts, Motions, OUTPUTS, Quantity, RowStatus};
    /// use methods::{MethodChoice, Refusal};
    ///
    /// let radii = [1e-6, 2e-6];
    /// let (radius, density, stiffness) = (Column::Each(&radii), Column::All(2600.0), Column::All(7.5e10));
    /// let contacts = Contacts { radius, density, stiffness, ..Contacts::default() };
    /// let all = Column::All;
    /// let motions = Motions::Planar { speed_normal: all(2.8), speed_tangential: all(0.0), spin: all(0.0) };
    /// let simulator = MethodChoice::FixedCost { nodes: 7, iterations: 3 }.simulator(OUTPUTS)?;
    /// let impacts = contacts.simulate_by(&simulator, &motions, radii.len(), &[Quantity::ContactTime], || false);
    /// assert_eq!(impacts.status, [RowStatus::Solved; 2]);
    /// # Ok::<(), Refusal>(())
    /// ```
    pub fn simulate_by(
        &self,
        simulator: &Simulator<f64, Outputs>,
        motions: &Motions<'_>,
        count: usize,
        quantities: &[Quantity],
        stop: impl Fn() -> bool + Sync,
    ) -> Impacts {
        gather(count, quantities, |row| {
            if stop() {
                return Ok(Record::without(RowStatus::NotConverged));
            }
            let (arrival, scene) = self.start(motions, row)?;
            let before = &arrival.motion;
            let moment = match self.surface {
                Surface::Coulomb { .. } => 0.0,
                Surface::Peeling { moment, .. } => checked_moment(&arrival, moment.at(row))?,
                Surface::Compliant { stiffness_ratio, .. } => {
                    let scene = scene.with_compliance(stiffness_ratio.at(row))?;
                    return match simulator.simulate_compliant(&scene, before) {
                        Some(solution) => Ok(compliant_record(&arrival, &solution?)),
                        None => Ok(Record::without(RowStatus::Unsupported)),
                    };
                }
            };
            let (impact, outputs) = simulator.simulate(&scene, moment, before)?;
            Ok(record(&arrival, &impact, Some(outputs.into())))
        })
    }

    /// The arrival of a row.
    fn arrival(&self, motions: &Motions<'_>, row: usize) -> Result<Arrival, InputError> {
        let arrival = motions.arrival(self.sphere(row)?, row)?;
        arrival.check_on_one_body(self.external_force.at(row))?;
        Ok(arrival)
    }

    /// The same and its scene, with friction but without a peeling moment or compliance.
    fn start(&self, motions: &Motions<'_>, row: usize) -> Result<(Arrival, AnyScene<f64>), InputError> {
        let arrival = self.arrival(motions, row)?;
        let scene = self.scene_of(arrival.sphere, |column| column.at(row))?;
        Ok((arrival, scene))
    }

    /// The result of a row.
    pub(crate) fn row(
        &self,
        motions: &Motions<'_>,
        row: usize,
        method: &impl Method<f64>,
        asked: Asked,
    ) -> Result<Record, InputError> {
        if let Surface::Coulomb { friction } = self.surface
            && asked == Asked::End
        {
            let arrival = self.arrival(motions, row)?;
            return by_law!(self.law(|column: &Column<'_>| column.at(row))?, law => {
                let scene = Contact::new(arrival.sphere, law).with_friction(friction.at(row))?;
                Ok(record(&arrival, &scene.solve(&arrival.motion, method)?, None))
            });
        }
        let (arrival, scene) = self.start(motions, row)?;
        let before = &arrival.motion;
        match self.surface {
            Surface::Coulomb { .. } if asked == Asked::Times => {
                let (impact, outputs) = scene.solve_for(before, method, (Times, Impulses))?;
                Ok(record(&arrival, &impact, Some(outputs.into())))
            }
            Surface::Coulomb { .. } => {
                let (impact, outputs) = scene.solve_for(before, method, OUTPUTS)?;
                Ok(record(&arrival, &impact, Some(outputs.into())))
            }
            Surface::Peeling { moment, .. } => {
                let moment = checked_moment(&arrival, moment.at(row))?;
                let (impact, outputs) = scene.with_peeling(moment)?.solve_for(before, method, OUTPUTS)?;
                Ok(record(&arrival, &impact, Some(outputs.into())))
            }
            Surface::Compliant { stiffness_ratio, .. } => {
                let scene = scene.with_compliance(stiffness_ratio.at(row))?;
                Ok(compliant_record(&arrival, &scene.solve_for(before, method, OUTPUTS)?))
            }
        }
    }

    /// The critical speed of each of `count` rows, to the tolerance of the method; `None` once `stop` is true.
    pub fn critical_speeds(
        &self,
        count: usize,
        method: &(impl ErrorControl<f64> + Sync),
        stop: impl Fn() -> bool + Sync,
    ) -> Option<Vec<Result<CriticalSpeed<f64>, InputError>>> {
        let speed = |row: usize| self.scene(row)?.critical_speed(method);
        (0..count).into_par_iter().map(|row| if stop() { None } else { Some(speed(row)) }).collect()
    }
}

/// A peeling moment, which is known where the sphere spins about one axis.
fn checked_moment(arrival: &Arrival, moment: f64) -> Result<f64, InputError> {
    arrival.check_about_one_axis(Parameter::PeelingMoment, moment)?;
    Ok(moment)
}

/// The result of an impact with compliance along the surface.
fn compliant_record(arrival: &Arrival, (impact, outputs): &Solution<f64, Outputs, CompliantVelocities<f64>>) -> Record {
    let mut record = record(arrival, impact, Some((*outputs).into()));
    if is_decided(&impact.normal) {
        record.put(Quantity::ImpulseRatioOut, impact.tangential.impulse_ratio());
        record.put(Quantity::Phases, f64::from(impact.tangential.phases()));
        // It slips and sticks several times.
        record.put(Quantity::TimeRoll, f64::NAN);
    }
    record
}

fn is_decided(normal: &NormalContact<f64>) -> bool {
    matches!(normal.outcome(), Some(Outcome::Rebound | Outcome::Capture))
}

/// The velocities along the surface that all scenes have.
pub(crate) trait Along: Classified<f64, Contact = ContactClass<f64>> {
    fn velocity_and_spin(&self) -> (f64, f64);
}

impl Along for TangentialVelocities<f64> {
    fn velocity_and_spin(&self) -> (f64, f64) {
        (self.velocity(), self.spin())
    }
}

impl Along for CompliantVelocities<f64> {
    fn velocity_and_spin(&self) -> (f64, f64) {
        (self.velocity(), self.spin())
    }
}

/// What a simulation tells of a contact that it follows.
pub(crate) struct Followed {
    times: ContactTimes<f64>,
    impulses: ContactImpulses<f64>,
    rest: Option<(ContactWorks<f64>, SlipHistory<f64>, Option<EnergyLedger<f64>>)>,
}

impl From<Outputs> for Followed {
    fn from(((times, impulses, works), (slip, ledger)): Outputs) -> Self {
        Self { times, impulses, rest: Some((works, slip, ledger)) }
    }
}

impl From<(ContactTimes<f64>, ContactImpulses<f64>)> for Followed {
    fn from((times, impulses): (ContactTimes<f64>, ContactImpulses<f64>)) -> Self {
        Self { times, impulses, rest: None }
    }
}

/// The result of an impact.
pub(crate) fn record<V: Along>(
    arrival: &Arrival,
    impact: &SimulatedImpact<f64, V>,
    followed: Option<Followed>,
) -> Record
where
    SimulatedImpact<f64, V>: Departing<f64>,
{
    match impact.run.status {
        Status::Solved => {}
        Status::BudgetSpent => return Record::without(RowStatus::NotConverged),
        Status::Unsupported => return Record::without(RowStatus::Unsupported),
    }
    let (normal, along) = (&impact.normal, impact.tangential.contact());
    let Some(outcome) = normal.outcome() else {
        return Record::without(RowStatus::NotConverged);
    };
    let motion = arrival.motion_after(along.motion);
    let mut record = Record::of(Class::of(outcome, motion));
    record.put_some(Quantity::MaxIndentation, normal.peak_indentation());
    if let Some(Followed { times, .. }) = &followed {
        record.put_some(Quantity::TimePeak, times.peak);
    }
    if outcome == Outcome::Undecided {
        return record;
    }
    let (velocity, spin) = impact.tangential.velocity_and_spin();
    record.put(Quantity::OverallRestitution, normal.overall_restitution());
    record.put(Quantity::ReboundSpeed, normal.rebound_speed());
    record.put(Quantity::SpeedTangentialOut, velocity);
    record.put(Quantity::SpinOut, spin);
    record.put_some(Quantity::FrictionOverLimit, along.friction_over_limit);
    record.put_departure(arrival, impact);
    if let Some(followed) = followed {
        put_followed(&mut record, outcome, motion, normal, followed);
    }
    record
}

/// What the simulation tells of a contact that it followed to separation, or to the turning point of a captured sphere. A sphere
/// that creeps to rest has none.
fn put_followed(
    record: &mut Record,
    outcome: Outcome,
    motion: SurfaceMotion,
    normal: &NormalContact<f64>,
    Followed { times, impulses, rest }: Followed,
) {
    let ends = outcome == Outcome::Rebound || normal.turning_indentation().is_some();
    record.put_some(Quantity::ContactTime, times.contact);
    if ends {
        record.put(Quantity::ImpulseHertz, impulses.elastic);
        record.put(Quantity::ImpulseAdhesionRebound, impulses.adhesion_rebound);
    }
    let Some((works, slip, ledger)) = rest else {
        return;
    };
    record.put_some(Quantity::TurningIndentation, normal.turning_indentation());
    record.put_some(Quantity::TimeRoll, slip.rolls_from.filter(|_| motion != SurfaceMotion::Sliding));
    if ends {
        record.put(Quantity::WorkMaterial, works.material);
        record.put(Quantity::WorkAdhesion, works.adhesion);
        record.put(Quantity::Rotation, slip.rotation);
        record.put(Quantity::DisplacementTangential, slip.displacement);
    }
    if let Some(ledger) = ledger {
        record.put(Quantity::WorkFriction, ledger.friction);
        record.put(Quantity::WorkRolling, ledger.rolling);
        record.put(Quantity::EnergyBefore, ledger.before);
        record.put(Quantity::EnergyAfter, ledger.after);
    }
}
