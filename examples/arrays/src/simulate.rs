//! Rows by the contact simulation.

use microimpact::contact::{
    AnyLaw, Classified, CompliantVelocities, Contact, ContactImpulses, ContactTimes, ContactWorks, Energy,
    ErrorControl, Impulses, Method, NormalContact, SimulatedImpact, Slip, SlipHistory, Status, TangentialVelocities,
    Times, Works,
};
use microimpact::rigid::EnergyLedger;
use microimpact::space::Departing;
use microimpact::{Class, ContactClass, CriticalSpeed, InputError, Outcome, Parameter, SurfaceMotion};
use rayon::prelude::*;

use crate::impacts::{Record, gather};
use crate::motions::Arrival;
use crate::{Contacts, Impacts, Motions, Quantity, RowStatus, Surface};

/// What a simulation tells of a contact that it follows.
type Followed =
    ((ContactTimes<f64>, ContactImpulses<f64>, ContactWorks<f64>), (SlipHistory<f64>, Option<EnergyLedger<f64>>));

/// Asks for it.
const FOLLOWED: ((Times, Impulses, Works), (Slip, Energy)) = ((Times, Impulses, Works), (Slip, Energy));

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
    /// Simulates the impacts of `count` rows on all threads. The result of a row is that of a single call of the method.
    pub fn simulate(
        &self,
        motions: &Motions<'_>,
        count: usize,
        method: &(impl Method<f64> + Sync),
        quantities: &[Quantity],
    ) -> Impacts {
        let follow = quantities.iter().any(|quantity| quantity.is_followed());
        gather(count, quantities, |row| self.row(motions, row, method, follow))
    }

    /// The result of a row.
    pub(crate) fn row(
        &self,
        motions: &Motions<'_>,
        row: usize,
        method: &impl Method<f64>,
        follow: bool,
    ) -> Result<Record, InputError> {
        let arrival = motions.arrival(self.sphere(row)?, row)?;
        arrival.check_on_one_body(self.external_force.at(row))?;
        let scene = self.scene_of(arrival.sphere, |column| column.at(row))?;
        let before = &arrival.motion;
        match self.surface {
            Surface::Coulomb { friction } if !follow => {
                let (sphere, friction) = (*scene.sphere(), friction.at(row));
                by_law!(*scene.law(), law => {
                    let scene = Contact::new(sphere, law).with_friction(friction)?;
                    Ok(record(&arrival, &scene.solve(before, method)?, None))
                })
            }
            Surface::Coulomb { .. } => {
                let (impact, followed) = scene.solve_for(before, method, FOLLOWED)?;
                Ok(record(&arrival, &impact, Some(&followed)))
            }
            Surface::Peeling { moment, .. } => {
                let moment = moment.at(row);
                arrival.check_about_one_axis(Parameter::PeelingMoment, moment)?;
                let (impact, followed) = scene.with_peeling(moment)?.solve_for(before, method, FOLLOWED)?;
                Ok(record(&arrival, &impact, Some(&followed)))
            }
            Surface::Compliant { stiffness_ratio, .. } => {
                let scene = scene.with_compliance(stiffness_ratio.at(row))?;
                let (impact, followed) = scene.solve_for(before, method, FOLLOWED)?;
                let mut record = record(&arrival, &impact, Some(&followed));
                if is_decided(&impact.normal) {
                    record.put(Quantity::ImpulseRatioOut, impact.tangential.impulse_ratio());
                    record.put(Quantity::Phases, f64::from(impact.tangential.phases()));
                    // It slips and sticks several times.
                    record.put(Quantity::TimeRoll, f64::NAN);
                }
                Ok(record)
            }
        }
    }

    /// The critical speed of each of `count` rows, to the tolerance of the method.
    pub fn critical_speeds(
        &self,
        count: usize,
        method: &(impl ErrorControl<f64> + Sync),
    ) -> Vec<Result<CriticalSpeed<f64>, InputError>> {
        (0..count).into_par_iter().map(|row| self.scene(row)?.critical_speed(method)).collect()
    }
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

/// The result of an impact.
pub(crate) fn record<V: Along>(
    arrival: &Arrival,
    impact: &SimulatedImpact<f64, V>,
    followed: Option<&Followed>,
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
    if let Some(((times, ..), _)) = followed {
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
    ((times, impulses, works), (slip, ledger)): &Followed,
) {
    record.put_some(Quantity::TurningIndentation, normal.turning_indentation());
    record.put_some(Quantity::ContactTime, times.contact);
    record.put_some(Quantity::TimeRoll, slip.rolls_from.filter(|_| motion != SurfaceMotion::Sliding));
    if outcome == Outcome::Rebound || normal.turning_indentation().is_some() {
        record.put(Quantity::ImpulseHertz, impulses.elastic);
        record.put(Quantity::ImpulseAdhesionRebound, impulses.adhesion_rebound);
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
