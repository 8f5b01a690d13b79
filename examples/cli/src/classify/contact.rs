//! Rows by the contact simulation.

use microimpact::contact::{
    Adaptive, AnyLaw, AnyScene, Contact, ContactImpulses, ContactTimes, ContactWorks, Energy, Groups, Impulses,
    NormalContact, Slip, SlipHistory, TangentialVelocities, Times, Works,
};
use microimpact::rigid::EnergyLedger;
use microimpact::{Class, InputError, Outcome, PlanarMotion, SurfaceMotion};
use sheet::{Row, reason};

use super::sphere_and_motion;
use crate::command::{BadRow, Number, Work};
use crate::inputs::contact_law;
use crate::words::{motion_name, outcome_name};

/// The simulation to a tolerance, in numbers of type `T`.
pub struct SimulationModel<T> {
    pub method: Adaptive<T>,
}

/// A simulated impact.
pub struct Simulated<T> {
    pub outcome: Outcome,
    pub class: Class,
    pub normal: NormalContact<T>,
    /// Velocities after a rebound, or of a captured sphere when its slip has ended.
    pub tangential: TangentialVelocities<T>,
    times: ContactTimes<T>,
    impulses: ContactImpulses<T>,
    works: ContactWorks<T>,
    /// The motion along the surface, of a captured sphere as far as it was followed.
    slip: SlipHistory<T>,
    energy: Option<EnergyLedger<T>>,
    groups: Option<Groups<T>>,
}

impl<T: Number> SimulationModel<T> {
    /// Builds the scene of a row and simulates its impact.
    pub fn compute(&self, row: &Row<'_>) -> Result<Simulated<T>, String> {
        let (sphere, before) = sphere_and_motion(row)?;
        let scene = Contact::new(sphere, contact_law(row)?).with_friction(row.or_zero("friction")?).map_err(reason)?;
        let groups = groups(&scene, &before).map_err(reason)?;
        // Without a moment this is the same motion; so the solver is compiled for one scene only.
        let scene = scene.with_peeling(row.or_zero("peeling_n_m")?).map_err(reason)?;
        let (impact, ((times, impulses, works), (slip, energy))) =
            scene.solve_for(&before, &self.method, ((Times, Impulses, Works), (Slip, Energy))).map_err(reason)?;
        let (normal, tangential) = (impact.normal, impact.tangential);
        let (Some(outcome), Some(class)) = (normal.outcome(), impact.class()) else {
            return Err("the simulation did not converge; use a larger --tolerance".into());
        };
        Ok(Simulated { outcome, class, normal, tangential, times, impulses, works, slip, energy, groups })
    }
}

/// The dimensionless groups of an impact, of laws that have them.
fn groups<T: Number>(scene: &AnyScene<T>, before: &PlanarMotion<T>) -> Result<Option<Groups<T>>, InputError> {
    match *scene.law() {
        AnyLaw::Hertz(law) => Contact::new(*scene.sphere(), law).groups(before).map(Some),
        AnyLaw::Ring(law) => Contact::new(*scene.sphere(), law).groups(before).map(Some),
        _ => Ok(None),
    }
}

impl<T: Number> Work for SimulationModel<T> {
    fn columns(&self) -> Vec<String> {
        [
            "outcome",
            "motion",
            "restitution",
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
        ]
        .map(String::from)
        .into()
    }

    fn cells(&self, row: &Row<'_>) -> Result<Vec<String>, BadRow> {
        let Simulated { outcome, normal, times, impulses, works, slip, groups, .. } = self.compute(row)?;
        let optional = |value: Option<T>| value.map(|value| row.cell(value)).unwrap_or_default();
        let motion = if slip.slides { SurfaceMotion::Sliding } else { SurfaceMotion::Rolling };
        Ok(vec![
            outcome_name(outcome).into(),
            motion_name(motion).into(),
            row.cell(normal.overall_restitution()),
            optional(normal.peak_indentation()),
            optional(normal.turning_indentation()),
            optional(times.peak),
            optional(times.contact),
            row.cell(slip.rolls_from.unwrap_or(-T::ONE)),
            row.cell(impulses.elastic),
            row.cell(impulses.adhesion_rebound),
            row.cell(works.material),
            row.cell(works.adhesion),
            row.cell(slip.velocity),
            row.cell(slip.spin),
            row.cell(slip.rotation),
            row.cell(slip.displacement),
            optional(groups.map(|groups| groups.elasticity)),
            optional(groups.map(|groups| groups.adhesion)),
            optional(groups.map(|groups| groups.material_damping)),
            optional(groups.map(|groups| groups.adhesion_damping)),
        ])
    }

    fn heads(&self) -> Vec<&'static str> {
        vec![
            "impact",
            "class",
            "e",
            "V_n\nm/s",
            "V_t\nm/s",
            "spin\nrad/s",
            "peak\nnm",
            "contact\nns",
            "slips for\nns",
            "energy\nlost %",
        ]
    }

    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<String>, String> {
        let Simulated { outcome, class, normal, tangential, times, slip, energy, .. } = self.compute(row)?;
        let nano = |value: Option<T>| value.map_or("-".into(), |value| format!("{:.2}", value * T::constant(1e9)));
        let lost = energy.map(|ledger| T::constant(100.0) * ledger.lost() / ledger.before);
        Ok(vec![
            name,
            class.to_string(),
            format!("{:.4}", normal.overall_restitution()),
            format!("{:.3}", normal.rebound_speed()),
            format!("{:.3}", tangential.velocity() + T::ZERO),
            format!("{:.2e}", tangential.spin() + T::ZERO),
            nano(normal.peak_indentation()),
            nano(times.contact),
            match (outcome, slip.slides) {
                (Outcome::Rebound, true) => "always".into(),
                _ => nano(slip.rolls_from),
            },
            lost.map_or("-".into(), |lost| format!("{lost:.1}")),
        ])
    }
}
