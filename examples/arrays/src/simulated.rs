//! The result of a row by the contact simulation.

use microimpact::contact::{
    Classified, CompliantVelocities, ContactImpulses, ContactTimes, ContactWorks, SimulatedImpact, SlipHistory, Status,
    TangentialVelocities,
};
use microimpact::rigid::EnergyLedger;
use microimpact::space::Departing;
use microimpact::{Class, ContactClass, Outcome, SurfaceMotion};

use crate::departure::Departure;
use crate::impacts::Answer;
use crate::motions::Place;
use crate::simulate::Outputs;
use crate::{Quantity, RowStatus};

/// The velocities along the surface that all scenes have.
pub(crate) trait Along: Classified<f64, Contact = ContactClass<f64>> {
    fn velocity_and_spin(&self) -> (f64, f64);

    /// A number that only these have, or that is another one with these.
    fn own(&self, quantity: Quantity) -> Option<f64>;
}

impl Along for TangentialVelocities<f64> {
    fn velocity_and_spin(&self) -> (f64, f64) {
        (self.velocity(), self.spin())
    }

    #[inline]
    fn own(&self, _: Quantity) -> Option<f64> {
        None
    }
}

impl Along for CompliantVelocities<f64> {
    fn velocity_and_spin(&self) -> (f64, f64) {
        (self.velocity(), self.spin())
    }

    fn own(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::ImpulseRatioOut => Some(self.impulse_ratio()),
            Quantity::Phases => Some(f64::from(self.phases())),
            // It slips and sticks several times.
            Quantity::TimeRoll => Some(f64::NAN),
            _ => None,
        }
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

/// The impact of a row, with what the simulation tells of the contact if it follows it.
pub(crate) struct Simulated<'a, V> {
    place: &'a Place,
    impact: &'a SimulatedImpact<f64, V>,
    followed: Option<Followed>,
    contact: ContactClass<f64>,
    /// How the impact ends, or why there is no result.
    end: Result<(Outcome, SurfaceMotion), RowStatus>,
    departure: Departure,
}

impl<'a, V: Along> Simulated<'a, V> {
    pub(crate) fn new(place: &'a Place, impact: &'a SimulatedImpact<f64, V>, followed: Option<Followed>) -> Self {
        let contact = impact.tangential.contact();
        let end = match (impact.run.status, impact.normal.outcome()) {
            (Status::Solved, Some(outcome)) => Ok((outcome, place.motion_after(contact.motion))),
            (Status::Unsupported, _) => Err(RowStatus::Unsupported),
            _ => Err(RowStatus::NotConverged),
        };
        Self { place, impact, followed, contact, end, departure: Departure::default() }
    }

    /// A number of the contact that the simulation follows to separation, or to the turning point of a captured sphere.
    fn followed(&self, quantity: Quantity, outcome: Outcome, motion: SurfaceMotion) -> Option<f64> {
        let turning = self.impact.normal.turning_indentation();
        let Followed { times, impulses, rest } = self.followed.as_ref()?;
        // A sphere that creeps to rest has no end of contact.
        let at_end = |number: f64| (outcome == Outcome::Rebound || turning.is_some()).then_some(number);
        let (works, slip, ledger) = match quantity {
            Quantity::ContactTime => return times.contact,
            Quantity::ImpulseHertz => return at_end(impulses.elastic),
            Quantity::ImpulseAdhesionRebound => return at_end(impulses.adhesion_rebound),
            _ => rest.as_ref()?,
        };
        match quantity {
            Quantity::TurningIndentation => turning,
            Quantity::TimeRoll => slip.rolls_from.filter(|_| motion != SurfaceMotion::Sliding),
            Quantity::WorkMaterial => at_end(works.material),
            Quantity::WorkAdhesion => at_end(works.adhesion),
            Quantity::Rotation => at_end(slip.rotation),
            Quantity::DisplacementTangential => at_end(slip.displacement),
            Quantity::WorkFriction => ledger.as_ref().map(|ledger| ledger.friction),
            Quantity::WorkRolling => ledger.as_ref().map(|ledger| ledger.rolling),
            Quantity::EnergyBefore => ledger.as_ref().map(|ledger| ledger.before),
            Quantity::EnergyAfter => ledger.as_ref().map(|ledger| ledger.after),
            _ => None,
        }
    }
}

impl<V: Along> Answer for Simulated<'_, V>
where
    SimulatedImpact<f64, V>: Departing<f64>,
{
    fn status(&self) -> RowStatus {
        self.end.err().unwrap_or(RowStatus::Solved)
    }

    fn class(&self) -> Option<Class> {
        self.end.ok().map(|(outcome, motion)| Class::of(outcome, motion))
    }

    fn number(&self, quantity: Quantity) -> f64 {
        let Ok((outcome, motion)) = self.end else {
            return f64::NAN;
        };
        let SimulatedImpact { normal, tangential, .. } = self.impact;
        let number = match quantity {
            Quantity::MaxIndentation => normal.peak_indentation(),
            Quantity::TimePeak => self.followed.as_ref().and_then(|followed| followed.times.peak),
            _ if outcome == Outcome::Undecided => None,
            Quantity::OverallRestitution => Some(normal.overall_restitution()),
            Quantity::ReboundSpeed => Some(normal.rebound_speed()),
            Quantity::SpeedTangentialOut => Some(tangential.velocity_and_spin().0),
            Quantity::SpinOut => Some(tangential.velocity_and_spin().1),
            Quantity::FrictionOverLimit => self.contact.friction_over_limit,
            Quantity::ImpulseRatioOut | Quantity::Phases | Quantity::TimeRoll => {
                tangential.own(quantity).or_else(|| self.followed(quantity, outcome, motion))
            }
            _ => self
                .followed(quantity, outcome, motion)
                .or_else(|| self.departure.number(quantity, self.place, self.impact)),
        };
        number.unwrap_or(f64::NAN)
    }
}
