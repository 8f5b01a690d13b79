//! Classifies impacts by either model, or by both.
//!
//! `cargo microimpact classify` shows impacts of the paper;
//! `cargo microimpact classify FILE.csv --format csv` adds the result to each row of a table.

mod agreement;
pub mod arrival;
mod contact;
mod method;
mod rigid_body;
mod uncertain;

use clap::{Args, ValueEnum};
use sheet::{Header, Input, Row, Value};

use crate::Streams;
use crate::columns::Used;
use crate::command::{BadRows, Number, STATUS, TABLE_MANUAL, TableCommand, TableOptions};
use crate::rows::{BadRow, Work};
use crate::words::{LEVEL, name_of, probability};
pub use contact::scene;
pub use method::MethodOptions;

/// Classify impacts of microspheres: rebound or capture, sliding, rolling or resting
#[derive(Args)]
#[command(after_help = format!("{EXAMPLE}\n{STATUS}"), after_long_help = format!("{EXAMPLE}\n\n{MANUAL}\n\n{TABLE_MANUAL}\n\n{STATUS}"))]
pub struct Options {
    /// Model that classifies
    #[arg(long, value_enum, default_value_t = Model::RigidBody)]
    model: Model,
    /// Least probability of a class that is named where the row has standard errors
    #[arg(long, value_name = "P", default_value_t = LEVEL, value_parser = probability)]
    level: f64,
    #[command(flatten)]
    method: MethodOptions,
    #[command(flatten)]
    table: TableOptions,
}

const EXAMPLE: &str = "\
Example: impacts of the paper by both models
  cargo microimpact classify --model both
`cargo microimpact columns classify` lists the columns that it reads and writes.";

/// What the manual says besides the columns.
const MANUAL: &str = "\
Standard errors: a column with _error before its unit, as speed_normal_error_m_s, gives the standard error of another. Errors are \
independent and normal; a number beyond its range takes the nearest value of the range. A table with such a column gets the \
probabilities of the classes and their largest error. probability_by is `expansion` where errors are at most a tenth and no number \
is near the end of its range, and else `random rows`, of which 40000 are computed by the rigid body and 5000 by the simulation. \
class is the most probable class, or `cannot tell` below --level.

The simulation: a captured sphere is followed to its first turning point. Velocities, impulses and works are those there, and \
time_roll_s is empty if slip ends later. A sphere that creeps to rest has no turning point. The methods fixed-cost and \
runge-kutta-gill do not follow a captured sphere so far. In both cases the cells of a turning point are empty. The summary gives the \
velocities when slip has ended. The outcome is undecided where a method cannot distinguish rebound from capture; the cells that \
depend on it are then empty. A row that a method cannot solve has its reason in the column error, and no outcome. Only the ring \
takes adhesion_n_m, zeta_a and peeling_n_m; dmt and jkr require work_of_adhesion_j_m2. With both models, columns of the rigid body \
begin with rigid_body_.

--tolerance bounds the error of the squared restitution, and the relative error of a critical speed. Rounding limits it: it must be at \
least 1e-13 in f64, and 1e-6 in f32. The least tolerance of collocation depends on its nodes: 3e-4 with 5 nodes, 1e-5 with 6, 1e-7 \
with 7, 1e-9 with 8, 1e-11 with 9. With 10 or more, only rounding limits it. Of the methods, adaptive chooses nodes and intervals that \
keep the tolerance; collocation uses as many intervals as the tolerance needs, with a fixed number of nodes in each; fixed-cost, for \
firmware, has a fixed number of nodes and iterations; runge-kutta-gill is the paper's own, with fixed steps in time. These two \
cannot represent jkr and no-force.

In space the velocities, spins and the normal take the place of the speeds and the spin in a plane. With radius_2_m there are two \
spheres, in space or in a plane, and the normal points from the second to the first; in a plane the speeds and the spin are those of \
the first sphere: x is tangential, z normal, and y the axis of the spin. Columns that do not name an axis describe the plane of the \
normal and the slip; of two spheres they are those of one sphere with the reduced mass, which hits a wall with the closing speed and \
the slip, so that its speed_tangential_out_m_s and its spin_out_rad_s are those of neither sphere. In the summary V_n of two spheres \
is the speed with which they separate, and the energy lost is a part of that of both.";

/// A model of impacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Model {
    RigidBody,
    Simulation,
    Both,
}

/// The columns of a model.
pub fn model_columns(model: Model, options: &MethodOptions) -> Used {
    let rigid_body = rigid_body::RigidBodyModel::<f64>::new(LEVEL);
    // The default method is offered.
    let simulation = options.simulation().map(|method| contact::SimulationModel::<f64> { method, level: LEVEL });
    match (model, simulation) {
        (Model::RigidBody, _) | (_, Err(_)) => Used::by(&rigid_body),
        (Model::Simulation, Ok(simulation)) => Used::by(&simulation),
        (Model::Both, Ok(simulation)) => Used::by(&Both { rigid_body, simulation }),
    }
}

impl TableCommand for Options {
    const NAME: &'static str = "classify";

    fn options(&self) -> &TableOptions {
        &self.table
    }

    fn run_in<T: Number>(&self, streams: &mut Streams<'_>) -> BadRows {
        let bundled = include_str!("impacts.csv");
        let level = self.level;
        let rigid_body = rigid_body::RigidBodyModel::<T>::new(level);
        let simulation = || Ok::<_, String>(contact::SimulationModel::<T> { method: self.method.simulation()?, level });
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
            cells.extend([
                if difference.is_none() { "yes" } else { "no" }.into(),
                difference.unwrap_or_default().into(),
            ]);
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
