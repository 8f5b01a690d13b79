//! The methods of the simulation that a command can ask for.

use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum};
use methods::{MethodChoice, Refusal, STEPS, default};
use microimpact::contact::{
    Adaptive, AnyScene, ContactImpulses, ContactTimes, ContactWorks, Impulses, Slip, SlipHistory, Status, Times, Works,
};
use microimpact::{InputError, Parameter, PlanarMotion};
use sheet::reason;

use crate::command::{Number, SimulationOptions};
use crate::words::name_of;

/// Options of the simulation's method.
#[derive(Args, Default)]
pub struct MethodOptions {
    /// Method of the simulation [default: adaptive]
    #[arg(long, value_enum)]
    method: Option<MethodName>,
    /// Nodes of collocation, 5 to 14 [default: 9], or of fixed-cost, 5 to 9 [default: 7]
    #[arg(long, value_name = "N")]
    nodes: Option<u32>,
    /// Iterations of fixed-cost for each phase, 1 to 40 [default: 3]
    #[arg(long, value_name = "N")]
    iterations: Option<u32>,
    /// Time steps of runge-kutta-gill in an undamped impact, 16 to 1000000 [default: 2000]
    #[arg(long, value_name = "N", value_parser = steps())]
    steps: Option<u32>,
    #[command(flatten)]
    simulation: SimulationOptions,
}

/// Method of the simulation.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodName {
    // Chooses nodes and intervals that keep the tolerance.
    Adaptive,
    // As many intervals as the tolerance needs, with a fixed number of nodes in each.
    Collocation,
    // For firmware: a fixed number of nodes and iterations. It does not follow a captured sphere beyond its peak, and cannot
    // represent the law jkr and the end rule no-force.
    FixedCost,
    // The paper's own: fixed steps in time. It does not follow a captured sphere to its turning point, and cannot represent
    // the law jkr and the end rule no-force.
    RungeKuttaGill,
}

/// What a simulation tells of an impact besides how it ends.
pub type Outputs<T> = ((ContactTimes<T>, ContactImpulses<T>, ContactWorks<T>), SlipHistory<T>);

type Simulator<T> = methods::Simulator<T, Outputs<T>>;

/// The method of a simulation, in numbers of type `T`.
pub struct Simulation<T> {
    /// Its name.
    pub method: String,
    pub simulator: Simulator<T>,
    /// The method for probabilities, where this one has a tolerance.
    pub control: Option<Adaptive<T>>,
    /// Whether it follows a captured sphere to its first turning point.
    pub follows_captures: bool,
    /// What to do where it did not converge.
    advice: &'static str,
    /// The same method with the most iterations, if it has a number of iterations below that.
    with_most_iterations: Option<Simulator<T>>,
}

impl<T: Number> Simulation<T> {
    /// Why a method has no solution, and what to do. More iterations are advised only if the largest number of them solves the
    /// impact.
    pub fn refusal(&self, status: Status, scene: &AnyScene<T>, peeling: T, before: &PlanarMotion<T>) -> String {
        if status == Status::Unsupported {
            return "this method cannot represent this law of contact; use --method adaptive or collocation".into();
        }
        let more_help = self.with_most_iterations.as_ref().is_some_and(|simulator| {
            simulator.simulate(scene, peeling, before).is_ok_and(|(impact, _)| impact.run.status == Status::Solved)
        });
        let more = if more_help { "more --iterations, or " } else { "" };
        format!("the simulation did not converge; use {more}{}", self.advice)
    }
}

impl MethodOptions {
    /// Each option with its name, whether it was given, and the methods that it applies to.
    fn options(&self) -> [(&'static str, bool, &'static [MethodName]); 4] {
        use MethodName::{Adaptive, Collocation, FixedCost, RungeKuttaGill};
        [
            ("--nodes", self.nodes.is_some(), &[Collocation, FixedCost]),
            ("--iterations", self.iterations.is_some(), &[FixedCost]),
            ("--steps", self.steps.is_some(), &[RungeKuttaGill]),
            ("--tolerance", self.simulation.is_given(), &[Adaptive, Collocation]),
        ]
    }

    /// Checks that no option was given, for a model without methods.
    ///
    /// # Errors
    /// An option that does not apply.
    pub fn refuse(&self, model: &str) -> Result<(), String> {
        let method = ("--method", self.method.is_some());
        let others = self.options().map(|(option, given, _)| (option, given));
        match [method].into_iter().chain(others).find(|(_, given)| *given) {
            Some((option, _)) => {
                Err(format!("{option} does not apply to --model {model}, only to --model simulation or both"))
            }
            None => Ok(()),
        }
    }

    /// The method that these options ask for.
    ///
    /// # Errors
    /// An option that does not apply to the method, or a value that is not offered or outside its range.
    pub fn simulation<T: Number>(&self) -> Result<Simulation<T>, String> {
        let name = self.method.unwrap_or(MethodName::Adaptive);
        if let Some((option, _, methods)) =
            self.options().into_iter().find(|(_, given, methods)| *given && !methods.contains(&name))
        {
            let methods: Vec<_> = methods.iter().map(name_of).collect();
            let (name, methods) = (name_of(&name), methods.join(" and "));
            return Err(format!("{option} does not apply to --method {name}, only to {methods}"));
        }
        let tolerance = self.simulation.tolerance();
        let nodes = |default| self.nodes.unwrap_or(default);
        let choice = match name {
            MethodName::Adaptive => MethodChoice::Adaptive { tolerance },
            MethodName::Collocation => {
                MethodChoice::Collocation { nodes: nodes(default::COLLOCATION_NODES), tolerance }
            }
            MethodName::FixedCost => MethodChoice::FixedCost {
                nodes: nodes(default::FIXED_COST_NODES),
                iterations: self.iterations.unwrap_or(default::ITERATIONS),
            },
            MethodName::RungeKuttaGill => MethodChoice::RungeKuttaGill { steps: self.steps.unwrap_or(default::STEPS) },
        };
        let most = Parameter::Iterations.range().1 as u32;
        let with_most_iterations = match choice {
            MethodChoice::FixedCost { nodes, iterations } if iterations < most => {
                Some(MethodChoice::FixedCost { nodes, iterations: most })
            }
            _ => None,
        };
        let simulator = |choice: MethodChoice<T>| {
            choice.simulator(((Times, Impulses, Works), Slip)).map_err(|refusal| refused(name, refusal))
        };
        let has_tolerance = matches!(name, MethodName::Adaptive | MethodName::Collocation);
        Ok(Simulation {
            method: name_of(&name),
            simulator: simulator(choice)?,
            control: if has_tolerance { Some(self.simulation.method().map_err(reason)?) } else { None },
            with_most_iterations: with_most_iterations.map(simulator).transpose()?,
            follows_captures: has_tolerance,
            advice: if has_tolerance { "a larger --tolerance" } else { "--method adaptive" },
        })
    }
}

/// Reads a number of steps.
fn steps() -> RangedU64ValueParser<u32> {
    RangedU64ValueParser::new().range(u64::from(*STEPS.start())..=u64::from(*STEPS.end()))
}

/// What to say of a method that is refused, with the options that help instead of the types of the library.
fn refused(method: MethodName, refusal: Refusal) -> String {
    match refusal {
        Refusal::Nodes { nodes, offered } => {
            let offered: Vec<_> = offered.iter().map(u32::to_string).collect();
            format!("--nodes {nodes} is not offered by {}; choose one of {}", name_of(&method), offered.join(", "))
        }
        Refusal::Input(error) if error.parameter == Parameter::Tolerance => too_small(error),
        Refusal::Input(error) => reason(error),
    }
}

/// What to say of a tolerance that a method refuses.
fn too_small(error: InputError) -> String {
    format!("--{}", reason(error).replace("more nodes or `Adaptive`", "more --nodes or --method adaptive"))
}
