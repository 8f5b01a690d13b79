//! Rows by the contact simulation.

use methods::{MethodChoice, Refusal, Simulator, Solution, WithFixedCost, with_fixed_cost};
use microimpact::contact::{
    Adaptive, AnyLaw, AnyScene, Contact, ContactImpulses, ContactTimes, ContactWorks, Energy, ErrorControl, FixedCost,
    Impulses, Method, SimulatedImpact, Slip, SlipHistory, Times, Works,
};
use microimpact::rigid::EnergyLedger;
use microimpact::space::Departing;
use microimpact::{CriticalSpeed, InputError, Parameter};
use rayon::prelude::*;

use crate::impacts::{Slot, fill};
use crate::motions::Arrival;
use crate::quantity::Asked;
use crate::simulated::{Along, Followed, Simulated};
use crate::{Column, Contacts, Damping, Impacts, Law, Motions, Quantity, RowStatus, Surface};

/// What a simulation tells of an impact besides how it ends.
pub(crate) type Outputs =
    ((ContactTimes<f64>, ContactImpulses<f64>, ContactWorks<f64>), (SlipHistory<f64>, Option<EnergyLedger<f64>>));

/// Asks for it.
const OUTPUTS: ((Times, Impulses, Works), (Slip, Energy)) = ((Times, Impulses, Works), (Slip, Energy));

/// Computes the same with each law by its own type, whose numbers `at` takes from the columns: a solver that asks for the law at every
/// step takes more than half as much time again, and one that asks for the damping a fifth.
macro_rules! by_law {
    ($contacts:expr, $at:expr, $law:ident => $result:expr) => {{
        let Contacts { law, damping, external_force, .. } = $contacts;
        match (law, damping, external_force) {
            (Law::Hertz, Damping::Hysteretic(zeta), Column::All(0.0)) => {
                let $law = $contacts.hertz($at)?.with_damping($at(zeta))?;
                $result
            }
            (Law::Ring { strength, damping }, Damping::Hysteretic(zeta), Column::All(0.0)) => {
                let $law = $contacts.hertz($at)?.with_ring($at(strength), $at(damping))?.with_damping($at(zeta))?;
                $result
            }
            (Law::Dmt { work }, Damping::Hysteretic(zeta), Column::All(0.0)) => {
                let $law = $contacts.hertz($at)?.with_dmt($at(work))?.with_damping($at(zeta))?;
                $result
            }
            _ => match $contacts.law($at)? {
                AnyLaw::Hertz($law) => $result,
                AnyLaw::WithoutTension($law) => $result,
                AnyLaw::Ring($law) => $result,
                AnyLaw::Dmt($law) => $result,
                AnyLaw::Jkr($law) => $result,
                $law => $result,
            },
        }
    }};
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
        fill(count, quantities, |row, slot| if stop() { Ok(()) } else { self.row(motions, row, method, asked, slot) })
    }

    /// Simulates the impacts of `count` rows on all threads, by a method that is chosen at run time. `FixedCost` computes four rows at a
    /// time where [`simulate_in_lanes`](Self::simulate_in_lanes) does, `Collocation` and `RungeKuttaGill` are slow. With compliance along
    /// the surface, a row is unsupported unless the method is `Adaptive`, which alone has the margin of friction. Once `stop` is true,
    /// all rows that are left end without convergence.
    ///
    /// # Errors
    /// A number of the method that is not offered.
    ///
    /// ```
    /// use impact_arrays::{Column, Contacts, Motions, Quantity, RowStatus};
    /// use methods::{MethodChoice, Refusal};
    ///
    /// let radii = [1e-6, 2e-6];
    /// let (radius, density, stiffness) = (Column::Each(&radii), Column::All(2600.0), Column::All(7.5e10));
    /// let contacts = Contacts { radius, density, stiffness, ..Contacts::default() };
    /// let all = Column::All;
    /// let motions = Motions::Planar { speed_normal: all(2.8), speed_tangential: all(0.0), spin: all(0.0) };
    /// let method = MethodChoice::FixedCost { nodes: 7, iterations: 3 };
    /// let impacts = contacts.simulate_by(method, &motions, radii.len(), &[Quantity::ContactTime], || false)?;
    /// assert_eq!(impacts.status, [RowStatus::Solved; 2]);
    /// # Ok::<(), Refusal>(())
    /// ```
    pub fn simulate_by(
        &self,
        method: MethodChoice<f64>,
        motions: &Motions<'_>,
        count: usize,
        quantities: &[Quantity],
        stop: impl Fn() -> bool + Sync,
    ) -> Result<Impacts, Refusal> {
        match (method, self.surface) {
            (MethodChoice::Adaptive { tolerance }, _) => {
                Ok(self.simulate_until(motions, count, &Adaptive::new(tolerance)?, quantities, stop))
            }
            (MethodChoice::FixedCost { nodes, iterations }, Surface::Coulomb { .. }) => {
                with_fixed_cost(nodes, iterations, InGroups { contacts: self, motions, count, quantities, stop })
            }
            _ => Ok(self.simulate_slowly(&method.simulator(OUTPUTS)?, motions, count, quantities, stop)),
        }
    }

    /// Simulates them with the law and the method as values, of which there is one copy.
    fn simulate_slowly(
        &self,
        simulator: &Simulator<f64, Outputs>,
        motions: &Motions<'_>,
        count: usize,
        quantities: &[Quantity],
        stop: impl Fn() -> bool + Sync,
    ) -> Impacts {
        fill(count, quantities, |row, slot| {
            if stop() {
                return Ok(());
            }
            let (arrival, scene) = self.start(motions, row)?;
            let before = &arrival.motion;
            let moment = match self.surface {
                Surface::Coulomb { .. } => 0.0,
                Surface::Peeling { moment, .. } => checked_moment(&arrival, moment.at(row))?,
                Surface::Compliant { stiffness_ratio, .. } => {
                    let scene = scene.with_compliance(stiffness_ratio.at(row))?;
                    match simulator.simulate_compliant(&scene, before) {
                        Some(solution) => put(slot, &arrival, &solution?),
                        None => slot.fail(RowStatus::Unsupported),
                    }
                    return Ok(());
                }
            };
            put(slot, &arrival, &simulator.simulate(&scene, moment, before)?);
            Ok(())
        })
    }

    /// The arrival of a row.
    fn arrival(&self, motions: &Motions<'_>, row: usize) -> Result<Arrival, InputError> {
        let arrival = motions.arrival(self.sphere(row)?, row)?;
        arrival.place.check_on_one_body(self.external_force.at(row))?;
        Ok(arrival)
    }

    /// The same and its scene, with friction but without a peeling moment or compliance.
    fn start(&self, motions: &Motions<'_>, row: usize) -> Result<(Arrival, AnyScene<f64>), InputError> {
        let arrival = self.arrival(motions, row)?;
        let scene = self.scene_of(arrival.sphere, |column| column.at(row))?;
        Ok((arrival, scene))
    }

    /// Puts the result of a row into its slot.
    pub(crate) fn row(
        &self,
        motions: &Motions<'_>,
        row: usize,
        method: &impl Method<f64>,
        asked: Asked,
        slot: &mut Slot<'_, '_>,
    ) -> Result<(), InputError> {
        if matches!(self.surface, Surface::Coulomb { .. }) && asked == Asked::End {
            let arrival = self.arrival(motions, row)?;
            let at = |column: &Column<'_>| column.at(row);
            return by_law!(self, at, law => {
                let scene = Contact::new(arrival.sphere, law).with_friction(self.friction().at(row))?;
                slot.put(&Simulated::new(&arrival.place, &scene.solve(&arrival.motion, method)?, None));
                Ok(())
            });
        }
        let (arrival, scene) = self.start(motions, row)?;
        let before = &arrival.motion;
        match self.surface {
            Surface::Coulomb { .. } if asked == Asked::Times => {
                put(slot, &arrival, &scene.solve_for(before, method, (Times, Impulses))?);
            }
            Surface::Coulomb { .. } => put(slot, &arrival, &scene.solve_for(before, method, OUTPUTS)?),
            Surface::Peeling { moment, .. } => {
                let moment = checked_moment(&arrival, moment.at(row))?;
                put(slot, &arrival, &scene.with_peeling(moment)?.solve_for(before, method, OUTPUTS)?);
            }
            Surface::Compliant { stiffness_ratio, .. } => {
                let scene = scene.with_compliance(stiffness_ratio.at(row))?;
                put(slot, &arrival, &scene.solve_for(before, method, OUTPUTS)?);
            }
        }
        Ok(())
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

/// Simulates rows by a `FixedCost` whose nodes are chosen at run time.
struct InGroups<'a, S> {
    contacts: &'a Contacts<'a>,
    motions: &'a Motions<'a>,
    count: usize,
    quantities: &'a [Quantity],
    stop: S,
}

impl<S: Fn() -> bool + Sync> WithFixedCost for InGroups<'_, S> {
    type Result = Impacts;

    fn with<const N: usize, const M: usize>(self, method: &FixedCost<N, M>) -> Impacts {
        let Self { contacts, motions, count, quantities, stop } = self;
        contacts.simulate_groups(motions, count, method, quantities, stop, |_, _| Ok(()))
    }
}

/// A peeling moment, which is known where the sphere spins about one axis.
fn checked_moment(arrival: &Arrival, moment: f64) -> Result<f64, InputError> {
    arrival.place.check_about_one_axis(Parameter::PeelingMoment, moment)?;
    Ok(moment)
}

/// Puts an impact with its outputs into a slot.
fn put<V: Along>(
    slot: &mut Slot<'_, '_>,
    arrival: &Arrival,
    (impact, outputs): &Solution<f64, impl Into<Followed> + Copy, V>,
) where
    SimulatedImpact<f64, V>: Departing<f64>,
{
    slot.put(&Simulated::new(&arrival.place, impact, Some((*outputs).into())));
}
