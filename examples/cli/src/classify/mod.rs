//! Classifies impacts by either model, or by both.
//!
//! `cargo microimpact classify` shows impacts of the paper;
//! `cargo microimpact classify FILE.csv --format csv` adds the result to each row of a table.

mod agreement;
mod arrival;
mod contact;
mod method;
mod rigid_body;
mod uncertain;

use clap::{Args, ValueEnum};
use sheet::{Header, Input, Row, Value};

use crate::Streams;
use crate::command::{BadRows, Number, TableCommand, TableOptions};
use crate::rows::{BadRow, Work};
use crate::words::name_of;
use method::MethodOptions;
pub use method::OfferedNodes;

/// Classify impacts of microspheres: rebound or capture, sliding, rolling or resting. Without a table, classify impacts of
/// the paper.
///
/// Input columns, in SI units. Brackets give the value that an empty or absent cell has; the other columns are required.
///   radius_m, density_kg_m3, speed_normal_m_s (approach speed, a positive number),
///   gyration_ratio (k^2/r^2) [0.4, a solid sphere], speed_tangential_m_s [0], spin_rad_s [0],
///   friction (Coulomb's coefficient f) [0].
/// In space instead of these speeds and the spin
///   velocity_x_m_s, velocity_y_m_s, velocity_z_m_s and spin_x_rad_s, spin_y_rad_s, spin_z_rad_s [each 0],
///   normal_x, normal_y, normal_z (of unit length, from the wall to the sphere) [0, 0, 1],
///   wall_velocity_x_m_s, wall_velocity_y_m_s, wall_velocity_z_m_s (of the wall at the contact) [0].
/// Two spheres, in space or in a plane, the normal from the second to the first:
///   radius_2_m, density_2_kg_m3 [as the first], gyration_ratio_2 [0.4],
///   velocity_2_x_m_s, velocity_2_y_m_s, velocity_2_z_m_s, spin_2_x_rad_s, spin_2_y_rad_s, spin_2_z_rad_s [each 0].
///   In a plane the speeds and the spin are those of the first sphere: x is tangential, z normal, and y the axis of the spin.
/// The rigid-body model also reads
///   restitution (R), or restitution_speed_m_s and restitution_power (k and p of R = k^p/(k^p + v^p)) [p = 1],
///   or yield_speed_m_s (elastic-plastic, Thornton 1997),
///   adhesion_coefficient (rho), or work_of_adhesion_j, or adhesion_speed_m_s and adhesion_power
///   (l and q of rho = l^q/(l^q + v^q)) [no adhesion; q = 1],
///   impulse_ratio (mu) instead of friction, rolling_arm_m (mu_m a_c) [0].
/// The simulation also reads
///   stiffness_pa (K), adhesion_n_m (f0) [0], zeta_h [0], zeta_a [0], peeling_n_m (lambda) [0],
///   external_force_n (positive out of the surface) [0],
///   stiffness_ratio (chi = k_t/((3/2) K a), 2 (1 - nu)/(2 - nu) for equal materials; only law hertz, damping none or
///   hysteretic, and the default method adaptive) [the contact does not give sideways],
///   law, work_of_adhesion_j_m2, damping, damping_value, end_rule (below),
///   yield_pressure_pa (contact yield pressure) [not known].
///
/// Standard errors: each of radius_m, density_kg_m3, speed_normal_m_s, speed_tangential_m_s, spin_rad_s, friction,
/// restitution, restitution_speed_m_s, yield_speed_m_s, adhesion_coefficient, work_of_adhesion_j, adhesion_speed_m_s,
/// stiffness_pa, adhesion_n_m, work_of_adhesion_j_m2, zeta_h, zeta_a and external_force_n may have one, in a column with
/// _error before the unit: speed_normal_error_m_s, restitution_error. Errors are independent and normal; a number beyond its range
/// takes the nearest value of the range. A table with such a column gets probability_capture, probability_sliding,
/// probability_rolling (a sphere that rests counts as rolling), those of the four classes (as probability_rebound_sliding), the
/// largest error of these in probability_error, and the class. probability_by is `expansion` where errors are at most a tenth
/// and no number is near the end of its range, and else `random rows`, of which 40000 are computed by the rigid body and 5000
/// by the simulation. class is the most probable class, or `cannot tell` below --level.
///
/// Computed by the simulation: restitution is the overall restitution. motion is sliding, rolling or resting, at separation
/// or, for a captured sphere, when its slip has ended. time_roll_s is the time at which slip ends: 0 if there was no slip,
/// -1 if slip does not end. A cell is empty if its quantity does not exist or is not computed. A captured sphere is followed
/// to its first turning point: velocities, impulses and works are those there, and time_roll_s is empty if slip ends later.
/// A sphere that creeps to rest has no turning point. The methods fixed-cost and runge-kutta-gill do not follow a captured
/// sphere so far. In both cases the cells of a turning point are empty. The summary gives the velocities when slip has
/// ended. The outcome is undecided where a method cannot distinguish rebound from capture; the cells that depend on it are
/// then empty. A row that a method cannot solve has its reason in the column error, and no outcome. The column law holds the
/// law of contact: hertz, ring, dmt or jkr. Above 1, speed_over_yield marks impacts that leave a dent, which the simulation
/// does not know; it is empty without a yield_pressure_pa. With both models, columns of the rigid body begin with rigid_body_.
/// With a stiffness_ratio, impulse_ratio_out is P_t/P_n, negative for a positive slip, and phases is the number of times that the
/// contact sticks or slips; time_roll_s is empty.
///
/// In space, velocity_out_x_m_s .. _z_ and spin_out_x_rad_s .. _z_ are the motion after the impact, and energy_in_j and
/// energy_out_j the kinetic energy of the sphere before and after it, seen as the velocities are given. Of two spheres these
/// are those of the first; velocity_2_out_x_m_s, .. energy_2_in_j and energy_2_out_j are those of the second. energy_before_j of
/// the rigid body is then the energy of both spheres, or of one as seen from the wall; less the works it is that energy after
/// the impact. The simulation has no column for the work of friction. All other computed columns describe the plane of the normal and the slip; of two spheres they are those of one sphere with
/// the reduced mass, which hits a wall with the closing speed and the slip, so that its speed_tangential_out_m_s and its
/// spin_out_rad_s are those of neither sphere. In the summary V_n of two spheres is the speed with which they separate, and the
/// energy lost is a part of that of both.
#[derive(Args)]
#[command(verbatim_doc_comment, after_long_help = crate::command::TABLE_MANUAL)]
pub struct Options {
    /// Model that classifies.
    #[arg(long, value_enum, default_value_t = Model::RigidBody)]
    model: Model,
    /// Least probability of a class in the column `class` of a row with standard errors; below it the class is `cannot tell`.
    #[arg(long, default_value_t = 0.9)]
    level: f64,
    #[command(flatten)]
    method: MethodOptions,
    #[command(flatten)]
    table: TableOptions,
}

#[derive(Clone, Copy, ValueEnum)]
enum Model {
    RigidBody,
    Simulation,
    Both,
}

impl TableCommand for Options {
    const NAME: &'static str = "classify";

    fn options(&self) -> &TableOptions {
        &self.table
    }

    fn run_in<T: Number>(&self, streams: &mut Streams<'_>) -> BadRows {
        let bundled = include_str!("impacts.csv");
        let level = self.level;
        if !(0.0..=1.0).contains(&level) {
            return Err(format!("--level {level} is refused: it is a probability; enter a number from 0 to 1").into());
        }
        let rigid_body = rigid_body::RigidBodyModel::<T>::new(level);
        let simulation =
            || Ok::<_, String>(contact::SimulationModel::<T> { simulator: self.method.simulator()?, level });
        match self.model {
            Model::RigidBody => {
                self.method.refuse("rigid-body")?;
                self.table.work(Self::NAME, bundled, &rigid_body, streams)
            }
            Model::Simulation => self.table.work(Self::NAME, bundled, &simulation()?, streams),
            Model::Both => {
                self.table.work(Self::NAME, bundled, &Both { rigid_body, simulation: simulation()? }, streams)
            }
        }
    }
}

/// Both models side by side.
struct Both<T> {
    rigid_body: rigid_body::RigidBodyModel<T>,
    simulation: contact::SimulationModel<T>,
}

impl<T: Number> Work for Both<T> {
    type Notes = ();

    fn inputs(&self) -> Vec<Input> {
        let mut inputs = self.simulation.inputs();
        for input in self.rigid_body.inputs() {
            if !inputs.contains(&input) {
                inputs.push(input);
            }
        }
        inputs
    }

    fn columns(&self, header: &Header<'_>) -> Vec<String> {
        let rigid_body = self.rigid_body.columns(header);
        let named = rigid_body.iter().map(|column| format!("rigid_body_{column}"));
        let agreement = agreement::COLUMNS.map(String::from);
        self.simulation.columns(header).into_iter().chain(named).chain(agreement).collect()
    }

    fn cells(&self, row: &Row<'_>, (): &mut ()) -> Result<Vec<Value>, BadRow> {
        let (simulated, body) = (self.simulation.compute(row), self.rigid_body.compute(row));
        let difference = match (&simulated, &body) {
            (Ok(simulated), Ok(body)) => Some(agreement::difference(row, simulated, body)),
            _ => None,
        };
        let failed = |result: Result<Vec<Value>, BadRow>| match result {
            Ok(cells) => (cells, None),
            Err(bad) => (bad.cells, Some(bad.reason)),
        };
        let simulated = simulated.map_err(BadRow::from);
        let (mut cells, simulation) = failed(simulated.and_then(|simulated| self.simulation.cells_of(row, &simulated)));
        let body = body.map_err(BadRow::from);
        let (body_cells, rigid_body) = failed(body.and_then(|body| self.rigid_body.cells_of(row, &body)));
        let simulation_columns = self.simulation.columns(&row.header()).len();
        cells.resize(simulation_columns, Value::Empty);
        cells.extend(body_cells);
        if let Some(difference) = difference {
            cells.resize(simulation_columns + self.rigid_body.columns(&row.header()).len(), Value::Empty);
            cells.extend([if difference.is_none() { "yes" } else { "no" }.into(), difference.unwrap_or_default().into()]);
        }
        let reason = match (simulation, rigid_body) {
            (None, None) => return Ok(cells),
            (Some(simulation), Some(rigid_body)) if simulation == rigid_body => simulation,
            (Some(simulation), Some(rigid_body)) => format!("simulation: {simulation}; rigid body: {rigid_body}"),
            (Some(simulation), None) => format!("simulation: {simulation}"),
            (None, Some(rigid_body)) => format!("rigid body: {rigid_body}"),
        };
        Err(BadRow { reason, cells })
    }

    fn heads(&self, _header: &Header<'_>) -> Vec<&'static str> {
        vec![
            "impact",
            "simulation",
            "rigid body",
            "agree",
            "law",
            "e\nsimulation",
            "e\nrigid body",
            "V_t, m/s\nsimulation",
            "V_t, m/s\nrigid body",
            "spin, rad/s\nsimulation",
            "spin, rad/s\nrigid body",
        ]
    }

    fn words(&self) -> usize {
        5
    }

    fn line(&self, row: &Row<'_>, name: String, (): &mut ()) -> Result<Vec<String>, String> {
        let (simulated, body) = (self.simulation.compute(row)?, self.rigid_body.compute(row)?);
        let optional = |value: Option<T>| value.map_or("-".into(), |value| format!("{:.4}", value + T::ZERO));
        let along = simulated.along();
        let of_one = |text| simulated.arrival.of_one_body(text);
        Ok(vec![
            name,
            self.simulation.class_in_words(row, simulated.class)?,
            self.rigid_body.class_in_words(row, &body)?,
            if agreement::difference(row, &simulated, &body).is_none() { "yes" } else { "no" }.into(),
            name_of(&simulated.law),
            optional(simulated.restitution()),
            format!("{:.4}", body.impact.normal.overall_restitution()),
            of_one(optional(along.map(|along| along.velocity))),
            of_one(format!("{:.4}", body.impact.tangential.velocity() + T::ZERO)),
            of_one(along.map_or("-".into(), |along| format!("{:.2e}", along.spin + T::ZERO))),
            of_one(format!("{:.2e}", body.impact.tangential.spin(&body.sphere) + T::ZERO)),
        ])
    }
}
