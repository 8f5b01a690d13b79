//! The methods of the simulation that a command can ask for.

use clap::{Args, ValueEnum};
use microimpact::contact::{
    Adaptive, AnyLaw, Collocation, Compliance, CompliantVelocities, Contact, ContactImpulses, ContactTimes,
    ContactWorks, FixedCost, Impulses, Method, Nodes, Output, Peeling, PhaseSamples, RungeKuttaGill, SimulatedImpact,
    Slip, SlipHistory, Status, Surface, TangentialVelocities, Times, Works,
};
use microimpact::{Coulomb, InputError, Parameter, PlanarMotion};
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
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=1_000_000))]
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
    // the law jkr.
    RungeKuttaGill,
}

const COLLOCATION_NODES: u32 = 9;
const FIXED_COST_NODES: u32 = 7;
const ITERATIONS: u32 = 3;
const STEPS: u32 = 2000;

/// A scene of any law of contact, with any friction and peeling moment.
pub type AnyContact<T> = Contact<T, AnyLaw<T>, Peeling<T>>;

/// An impact with velocities `V` along the surface, and its outputs.
pub type Solution<T, V = TangentialVelocities<T>> = (SimulatedImpact<T, V>, Outputs<T>);

/// What a simulation tells of an impact.
pub type Outputs<T> = ((ContactTimes<T>, ContactImpulses<T>, ContactWorks<T>), SlipHistory<T>);

/// Simulates an impact in a scene with `S` along the surface, which gives the velocities `V`.
type Simulate<T, S = Peeling<T>, V = TangentialVelocities<T>> =
    Box<dyn Fn(&Contact<T, AnyLaw<T>, S>, &PlanarMotion<T>) -> Result<Solution<T, V>, InputError> + Send + Sync>;

/// A method of the simulation, in numbers of type `T`.
pub struct Simulator<T> {
    /// Its name.
    pub method: String,
    pub simulate: Simulate<T>,
    /// The same without a peeling moment, which takes time even where it is zero, if the method is compiled for it.
    pub simulate_without_peeling: Option<Simulate<T, Coulomb<T>>>,
    /// The same with compliance along the surface, where the method is offered for it.
    pub simulate_compliant: Option<Simulate<T, Compliance<T>, CompliantVelocities<T>>>,
    /// The method for probabilities, where this one has a tolerance.
    pub control: Option<Adaptive<T>>,
    /// Whether it follows a captured sphere to its first turning point.
    pub follows_captures: bool,
    /// What to do where it did not converge.
    advice: &'static str,
    /// The same method with the most iterations, if it has a number of iterations below that.
    with_most_iterations: Option<Simulate<T>>,
}

impl<T> Simulator<T> {
    /// Why a method has no solution, and what to do. More iterations are advised only if the largest number of them solves the
    /// impact.
    pub fn refusal(&self, status: Status, scene: &AnyContact<T>, before: &PlanarMotion<T>) -> String {
        if status == Status::Unsupported {
            return "this method cannot represent this law of contact; use --method adaptive or collocation".into();
        }
        let more_help = self.with_most_iterations.as_ref().is_some_and(|simulate| {
            simulate(scene, before).is_ok_and(|(impact, _)| impact.run.status == Status::Solved)
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
    pub fn simulator<T: Number>(&self) -> Result<Simulator<T>, String> {
        let name = self.method.unwrap_or(MethodName::Adaptive);
        if let Some((option, _, methods)) =
            self.options().into_iter().find(|(_, given, methods)| *given && !methods.contains(&name))
        {
            let methods: Vec<_> = methods.iter().map(name_of).collect();
            let (name, methods) = (name_of(&name), methods.join(" and "));
            return Err(format!("{option} does not apply to --method {name}, only to {methods}"));
        }
        let (fixed_cost_nodes, iterations) =
            (self.nodes.unwrap_or(FIXED_COST_NODES), self.iterations.unwrap_or(ITERATIONS));
        let simulate = match name {
            MethodName::Adaptive => by(self.simulation.method().map_err(too_small)?),
            MethodName::Collocation => {
                collocation(self.nodes.unwrap_or(COLLOCATION_NODES), self.simulation.tolerance())?
            }
            MethodName::FixedCost => fixed_cost(fixed_cost_nodes, iterations)?,
            MethodName::RungeKuttaGill => by(RungeKuttaGill::new(self.steps.unwrap_or(STEPS))),
        };
        let most = Parameter::Iterations.range().1 as u32;
        let with_most_iterations = match name {
            MethodName::FixedCost if iterations < most => Some(fixed_cost(fixed_cost_nodes, most)?),
            _ => None,
        };
        // Each scene is compiled for this method alone, which is the one that long tables are computed by.
        let (simulate_without_peeling, simulate_compliant) = match name {
            MethodName::Adaptive => {
                let method = self.simulation.method().map_err(too_small)?;
                (Some(by(method)), Some(by(method)))
            }
            _ => (None, None),
        };
        let control = match name {
            MethodName::Adaptive | MethodName::Collocation => Some(self.simulation.method().map_err(reason)?),
            MethodName::FixedCost | MethodName::RungeKuttaGill => None,
        };
        Ok(Simulator {
            method: name_of(&name),
            simulate,
            control,
            simulate_without_peeling,
            simulate_compliant,
            with_most_iterations,
            follows_captures: matches!(name, MethodName::Adaptive | MethodName::Collocation),
            advice: match name {
                MethodName::Adaptive | MethodName::Collocation => "a larger --tolerance",
                MethodName::FixedCost | MethodName::RungeKuttaGill => "--method adaptive",
            },
        })
    }
}

/// Simulates by a method.
fn by<T: Number, S, V>(method: impl Method<T> + Send + Sync + 'static) -> Simulate<T, S, V>
where
    S: Surface<T, PlanarMotion<T>, After = V>,
    Slip: Output<T, S::Start, Result = SlipHistory<T>>,
{
    Box::new(move |scene, before| scene.solve_for(before, &method, ((Times, Impulses, Works), Slip)))
}

/// What to say of a tolerance that a method refuses, with the options that help instead of the types of the library.
fn too_small(error: InputError) -> String {
    format!("--{}", reason(error).replace("more nodes or `Adaptive`", "more --nodes or --method adaptive"))
}

/// What to say of a number of nodes that is not offered.
fn not_offered(nodes: u32, method: MethodName, offered: &[u32]) -> String {
    let offered: Vec<_> = offered.iter().map(u32::to_string).collect();
    format!("--nodes {nodes} is not offered by {}; choose one of {}", name_of(&method), offered.join(", "))
}

/// The numbers of nodes that are offered, each of which is a type of its own; `with` the nodes for outputs.
macro_rules! offer {
    (collocation: $($nodes:literal)*; fixed_cost: $($phase:literal with $outputs:literal),*) => {
        /// A number type with the tables for the numbers of nodes that are offered.
        pub trait OfferedNodes: $(Nodes<$nodes> +)* $(PhaseSamples<$phase, $outputs> +)* {}

        impl<T: $(Nodes<$nodes> +)* $(PhaseSamples<$phase, $outputs> +)*> OfferedNodes for T {}

        fn collocation<T: Number>(nodes: u32, tolerance: T) -> Result<Simulate<T>, String> {
            match nodes {
                $($nodes => Ok(by(Collocation::<$nodes, T>::new(tolerance).map_err(too_small)?)),)*
                _ => Err(not_offered(nodes, MethodName::Collocation, &[$($nodes),*])),
            }
        }

        fn fixed_cost<T: Number>(nodes: u32, iterations: u32) -> Result<Simulate<T>, String> {
            match nodes {
                $($phase => {
                    Ok(by(FixedCost::<$phase>::new(iterations).map_err(reason)?.with_outputs::<$outputs>()))
                })*
                _ => Err(not_offered(nodes, MethodName::FixedCost, &[$($phase),*])),
            }
        }
    };
}

// The end of slip needs four nodes more than the phase, times near the critical speed about twice as many.
offer!(collocation: 5 6 7 8 9 10 11 12 13 14; fixed_cost: 5 with 10, 6 with 12, 7 with 13, 8 with 15, 9 with 16);
