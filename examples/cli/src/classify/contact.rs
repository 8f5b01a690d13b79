//! Rows by the contact simulation.

use comfy_table::Cell;
use microimpact::contact::{Adaptive, AdaptiveNodes, Groups, SimulatedImpact, Contact, TangentialContact};
use microimpact::{Class, InputError, Outcome, Sphere, Stiffness, SurfaceMotion};
use sheet::{Row, Scalar, reason};

use super::sphere_and_motion;
use crate::command::Work;
use crate::words::{motion_name, outcome_name};

/// The simulation to a tolerance, in numbers of type `T`.
pub struct SimulationModel<T> {
    method: Adaptive<T>,
}

/// A simulated impact.
pub struct Simulated<T> {
    sphere: Sphere<T>,
    groups: Groups<T>,
    outcome: Outcome,
    pub class: Class,
    pub impact: SimulatedImpact<T, TangentialContact<T>>,
}

impl<T: Scalar + AdaptiveNodes> SimulationModel<T> {
    pub fn new(tolerance: f64) -> Result<Self, InputError> {
        Ok(Self { method: Adaptive::new(T::constant(tolerance))? })
    }

    /// Builds the scene of a row and simulates its impact.
    pub fn compute(&self, row: &Row<'_>) -> Result<Simulated<T>, String> {
        let (sphere, before) = sphere_and_motion(row)?;
        let stiffness = Stiffness::new(row.required("stiffness_pa")?).map_err(reason)?;
        let (zeta_h, zeta_a) = (row.or_zero("zeta_h")?, row.or_zero("zeta_a")?);
        let (strength, friction) = (row.or_zero("adhesion_n_m")?, row.or_zero("friction")?);
        let (peeling, force) = (row.or_zero::<T>("peeling_n_m")?, row.or_zero("external_force_n")?);
        let scene = Contact::hertz(sphere, stiffness)
            .with_damping(zeta_h)
            .and_then(|scene| scene.with_ring(strength, zeta_a))
            .and_then(|scene| scene.with_friction(friction))
            .map_err(reason)?;
        // Terms that are zero are left out, so that they cost nothing.
        let impact = match (peeling == T::ZERO, force == T::ZERO) {
            (true, true) => scene.impact(&self.method, &before),
            (true, false) => scene.with_external_force(force).and_then(|scene| scene.impact(&self.method, &before)),
            (false, true) => scene.with_peeling(peeling).and_then(|scene| scene.impact(&self.method, &before)),
            (false, false) => scene
                .with_peeling(peeling)
                .and_then(|scene| scene.with_external_force(force))
                .and_then(|scene| scene.impact(&self.method, &before)),
        };
        let impact = impact.map_err(reason)?;
        let groups = scene.groups(&before).map_err(reason)?;
        match (impact.normal.outcome(), impact.class()) {
            (Some(outcome), Some(class)) => Ok(Simulated { sphere, groups, outcome, class, impact }),
            _ => Err("the simulation has spent its budget of stretches".into()),
        }
    }
}

impl<T: Scalar + AdaptiveNodes> Work for SimulationModel<T> {
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

    fn cells(&self, row: &Row<'_>) -> (Vec<String>, Result<(), String>) {
        let Simulated { impact, groups, outcome, .. } = match self.compute(row) {
            Ok(computed) => computed,
            Err(reason) => return (Vec::new(), Err(reason)),
        };
        let SimulatedImpact { normal, tangential, outputs, .. } = &impact;
        let optional = |value: Option<T>| value.map(|value| row.cell(value)).unwrap_or_default();
        let cells = vec![
            outcome_name(outcome).into(),
            motion_name(tangential.motion()).into(),
            row.cell(normal.overall_restitution()),
            optional(normal.peak_indentation()),
            optional(normal.turning_indentation()),
            optional(outputs.times.peak),
            optional(outputs.times.contact),
            row.cell(tangential.rolls_from().unwrap_or(-T::ONE)),
            row.cell(outputs.impulses.elastic),
            row.cell(outputs.impulses.adhesion_rebound),
            row.cell(outputs.works.material),
            row.cell(outputs.works.adhesion),
            row.cell(tangential.tangential()),
            row.cell(tangential.spin()),
            row.cell(tangential.rotation()),
            row.cell(tangential.displacement()),
            row.cell(groups.elasticity),
            row.cell(groups.adhesion),
            row.cell(groups.material_damping),
            row.cell(groups.adhesion_damping),
        ];
        (cells, Ok(()))
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

    fn words(&self) -> usize {
        2
    }

    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<Cell>, String> {
        let Simulated { sphere, impact, class, .. } = self.compute(row)?;
        let SimulatedImpact { normal, tangential, outputs, .. } = &impact;
        let nano = |value: Option<T>| value.map_or("-".into(), |value| format!("{:.2}", value * T::constant(1e9)));
        let lost = impact.energy(&sphere).map(|ledger| T::constant(100.0) * ledger.lost() / ledger.before);
        let cells = [
            name,
            class.to_string(),
            format!("{:.4}", normal.overall_restitution()),
            format!("{:.3}", normal.rebound_speed()),
            format!("{:.3}", tangential.tangential() + T::ZERO),
            format!("{:.2e}", tangential.spin() + T::ZERO),
            nano(normal.peak_indentation()),
            nano(outputs.times.contact),
            match tangential.motion() {
                SurfaceMotion::Sliding => "always".into(),
                _ => nano(tangential.rolls_from()),
            },
            lost.map_or("-".into(), |lost| format!("{lost:.1}")),
        ];
        Ok(cells.into_iter().map(Cell::new).collect())
    }
}
