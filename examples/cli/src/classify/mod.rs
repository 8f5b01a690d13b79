//! Classifies impacts with either model, or with both.
//!
//! `cargo microimpact classify` shows impacts of the paper;
//! `cargo microimpact classify FILE.csv --format csv` adds the result to each row of a table.

mod contact;
mod rigid_body;

use clap::{Args, ValueEnum};
use comfy_table::Cell;
use microimpact::contact::AdaptiveNodes;
use microimpact::{NormalMotion, PlanarMotion, Sphere};
use sheet::{Row, Scalar, reason};

use crate::Streams;
use crate::command::{BadRows, TableOptions, Work};

/// Classify impacts of microspheres: rebound sliding or rolling, or capture; without a table, those of the paper.
///
/// Columns read, in SI units; an empty cell means what stands in brackets:
///   radius_m, density_kg_m3, speed_normal_m_s (approach speed),
///   gyration_ratio (k^2/r^2; 0.4, solid), speed_tangential_m_s (0), spin_rad_s (0), friction (Coulomb's f; 0).
/// Of the rigid-body model besides:
///   restitution (R) or restitution_speed_m_s (k of R = k/(k + v)),
///   adhesion_coefficient (rho) or work_of_adhesion_j (none),
///   impulse_ratio (mu, instead of friction), rolling_arm_m (mu_m a_c; none).
/// Of the simulation besides:
///   stiffness_pa (K), adhesion_n_m (f0; 0), zeta_h (0), zeta_a (0), peeling_n_m (lambda; 0),
///   external_force_n (positive out of the surface; 0).
/// All other columns pass through; one that is named like a computed column is kept as input_NAME.
///
/// Computed by the simulation: restitution is the overall one; time_roll_s is 0 for a sphere that never slid and -1 for
/// one that never stopped; what does not exist is left empty; a captured sphere at rest rolls. With both models the
/// columns of the rigid body begin with rigid_body_.
///
/// Exit status: 0, or 1 if a row was bad (its reason stands in the column `error`), or 2 if nothing could be read.
#[derive(Args)]
#[command(verbatim_doc_comment)]
pub struct Options {
    /// The model that classifies.
    #[arg(long, value_enum, default_value_t = Model::RigidBody)]
    model: Model,
    /// Largest error of the square of the restitution by the simulation.
    #[arg(long, default_value_t = 1e-9)]
    tolerance: f64,
    #[command(flatten)]
    table: TableOptions,
}

#[derive(Clone, Copy, ValueEnum)]
enum Model {
    RigidBody,
    Simulation,
    Both,
}

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        self.table.run("classify", streams, |streams| run::<f32>(self, streams), |streams| run::<f64>(self, streams))
    }
}

fn run<T: Scalar + AdaptiveNodes>(options: &Options, streams: &mut Streams<'_>) -> BadRows {
    let (table, bundled) = (&options.table, include_str!("impacts.csv"));
    let rigid_body = rigid_body::RigidBodyModel::<T>::new();
    let simulation = contact::SimulationModel::<T>::new(options.tolerance)?;
    match options.model {
        Model::RigidBody => table.work(bundled, &rigid_body, streams),
        Model::Simulation => table.work(bundled, &simulation, streams),
        Model::Both => table.work(bundled, &Both { rigid_body, simulation }, streams),
    }
}

/// Both models side by side.
struct Both<T: Scalar> {
    rigid_body: rigid_body::RigidBodyModel<T>,
    simulation: contact::SimulationModel<T>,
}

impl<T: Scalar + AdaptiveNodes> Work for Both<T> {
    fn columns(&self) -> Vec<String> {
        let rigid_body = self.rigid_body.columns();
        let named = rigid_body.iter().map(|column| format!("rigid_body_{column}"));
        self.simulation.columns().into_iter().chain(named).collect()
    }

    fn cells(&self, row: &Row<'_>) -> (Vec<String>, Result<(), String>) {
        let (mut cells, simulated) = self.simulation.cells(row);
        cells.resize(self.simulation.columns().len(), String::new());
        let (rigid_body, computed) = self.rigid_body.cells(row);
        cells.extend(rigid_body);
        let result = match (simulated, computed) {
            (Err(simulated), Err(computed)) if simulated == computed => Err(simulated),
            (Err(simulated), Err(computed)) => Err(format!("simulation: {simulated}; rigid body: {computed}")),
            (Err(simulated), Ok(())) => Err(format!("simulation: {simulated}")),
            (Ok(()), Err(computed)) => Err(format!("rigid body: {computed}")),
            (Ok(()), Ok(())) => Ok(()),
        };
        (cells, result)
    }

    fn heads(&self) -> Vec<&'static str> {
        vec![
            "impact",
            "simulation",
            "rigid body",
            "e\nsimulation",
            "e\nrigid body",
            "V_t, m/s\nsimulation",
            "V_t, m/s\nrigid body",
            "spin, rad/s\nsimulation",
            "spin, rad/s\nrigid body",
        ]
    }

    fn words(&self) -> usize {
        3
    }

    fn line(&self, row: &Row<'_>, name: String) -> Result<Vec<Cell>, String> {
        let (simulated, body) = (self.simulation.compute(row)?, self.rigid_body.compute(row)?);
        let contact = &simulated.impact;
        let cells = [
            name,
            simulated.class.to_string(),
            body.classification.class().to_string(),
            format!("{:.4}", contact.normal.overall_restitution()),
            format!("{:.4}", body.impact.normal.overall_restitution()),
            format!("{:.4}", contact.tangential.tangential() + T::ZERO),
            format!("{:.4}", body.impact.tangential.velocity() + T::ZERO),
            format!("{:.2e}", contact.tangential.spin() + T::ZERO),
            format!("{:.2e}", body.impact.tangential.spin(&body.sphere) + T::ZERO),
        ];
        Ok(cells.into_iter().map(Cell::new).collect())
    }
}

/// The sphere of a row and its motion before the impact.
fn sphere_and_motion<T: Scalar>(row: &Row<'_>) -> Result<(Sphere<T>, PlanarMotion<T>), String> {
    let gyration_ratio = row.number("gyration_ratio")?.unwrap_or(T::constant(0.4));
    let sphere = Sphere::new(row.required("radius_m")?, row.required("density_kg_m3")?, gyration_ratio);
    let sphere = sphere.map_err(reason)?;
    let (speed, tangential) = (row.required("speed_normal_m_s")?, row.or_zero("speed_tangential_m_s")?);
    let spin = row.or_zero("spin_rad_s")?;
    let motion = NormalMotion::new(speed)
        .and_then(|motion| motion.with_tangential(tangential))
        .and_then(|motion| motion.with_spin(&sphere, spin))
        .map_err(reason)?;
    Ok((sphere, motion))
}
