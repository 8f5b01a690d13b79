//! Methods of the contact simulation that are chosen at run time: by their names and whole numbers, which are types in the library.
//!
//! ```
//! use methods::{MethodChoice, Refusal};
//! use microimpact::contact::{AnyLaw, Contact, Times};
//! use microimpact::{NormalMotion, Sphere, Stiffness};
//!
//! let scene = Contact::new(Sphere::solid(1e-6, 1000.0)?, AnyLaw::hertz(Stiffness::new(1e10)?));
//! let scene = scene.with_friction(0.1)?;
//! let simulator = MethodChoice::Collocation { nodes: 9, tolerance: 1e-9 }.simulator(Times)?;
//! let peeling_moment = 0.0;
//! let before = NormalMotion::new(1.0)?.with_tangential(1.0)?.with_spin(scene.sphere(), 0.0)?;
//! let (impact, _) = simulator.simulate(&scene, peeling_moment, &before)?;
//! assert!((impact.normal.overall_restitution() - 1.0_f64).abs() < 1e-9);
//!
//! let refused = MethodChoice::Collocation { nodes: 4, tolerance: 1e-9 }.simulator(Times);
//! assert!(matches!(refused, Err(Refusal::Nodes { nodes: 4, .. })));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::error::Error;
use std::fmt;
use std::ops::RangeInclusive;

use microimpact::contact::{
    Adaptive, AdaptiveNodes, AnyLaw, AnyScene, Collocation, Compliance, CompliantVelocities, Contact, FixedCost,
    Method, Nodes, Output, Peeling, PhaseSamples, Recording, RestCriterion, RungeKuttaGill, SimulatedImpact, Status,
    Surface, TangentialVelocities, Trajectory,
};
use microimpact::{Coulomb, InputError, Outcome, PlanarMotion, Real};

/// A scene of any law of contact that is compliant along the surface.
pub type CompliantContact<T> = Contact<T, AnyLaw<T>, Compliance<T>>;

/// An impact with outputs `R`, and velocities `V` along the surface.
pub type Solution<T, R, V = TangentialVelocities<T>> = (SimulatedImpact<T, V>, R);

type Start<T, S> = <S as Surface<T, PlanarMotion<T>>>::Start;

/// Outputs that simulations give with friction, with a peeling moment and with compliance, as `R`.
pub trait Outputs<T: Real, R>:
    Output<T, Start<T, Coulomb<T>>, Result = R>
    + Output<T, Start<T, Peeling<T>>, Result = R>
    + Output<T, Start<T, Compliance<T>>, Result = R>
    + Copy
    + Send
    + Sync
    + 'static
{
}

impl<T: Real, R, O> Outputs<T, R> for O where
    O: Output<T, Start<T, Coulomb<T>>, Result = R>
        + Output<T, Start<T, Peeling<T>>, Result = R>
        + Output<T, Start<T, Compliance<T>>, Result = R>
        + Copy
        + Send
        + Sync
        + 'static
{
}

type Simulate<T, S, R, V = TangentialVelocities<T>> =
    Box<dyn Fn(&Contact<T, AnyLaw<T>, S>, &PlanarMotion<T>) -> Result<Solution<T, R, V>, InputError> + Send + Sync>;

/// What a method has where nothing else is said.
pub mod default {
    /// Nodes of `Collocation`.
    pub const COLLOCATION_NODES: u32 = 9;

    /// Nodes of `FixedCost`.
    pub const FIXED_COST_NODES: u32 = 7;

    /// Iterations of `FixedCost` in each phase.
    pub const ITERATIONS: u32 = 3;

    /// Steps of `RungeKuttaGill` in an undamped impact.
    pub const STEPS: u32 = 2000;

    /// Tolerance in double precision.
    pub const TOLERANCE: f64 = 1e-9;
}

/// Steps of `RungeKuttaGill` that are offered: from those that still follow the motion to those of a run of a second.
pub const STEPS: RangeInclusive<u32> = 16..=1_000_000;

/// A method of the simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MethodChoice<T> {
    /// Chooses nodes and intervals that keep the tolerance.
    Adaptive {
        /// Bound of the error of e^2 and of all outputs.
        tolerance: T,
    },
    /// As many intervals as the tolerance needs, with a fixed number of nodes in each.
    Collocation {
        /// Nodes of an interval.
        nodes: u32,
        /// Bound of the error of e^2 and of all outputs.
        tolerance: T,
    },
    /// For firmware: a fixed number of nodes and iterations.
    FixedCost {
        /// Nodes of a phase.
        nodes: u32,
        /// Iterations in each phase.
        iterations: u32,
    },
    /// The paper's own: fixed steps in time.
    RungeKuttaGill {
        /// Steps in an undamped impact.
        steps: u32,
    },
}

/// Why there is no such method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// A number of nodes that is not offered.
    Nodes {
        /// The number.
        nodes: u32,
        /// Those that are offered.
        offered: &'static [u32],
    },
    /// A number outside its range.
    Input(InputError),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nodes { nodes, offered } => write!(f, "{nodes} nodes are not offered; choose one of {offered:?}"),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl Error for Refusal {}

impl From<InputError> for Refusal {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

/// Simulates impacts by a method, in numbers of type `T` and with outputs `R`.
pub struct Simulator<T, R> {
    simulate: Simulate<T, Peeling<T>, R>,
    /// The same without a peeling moment, which takes time even where it is zero, if the method is compiled for it.
    simulate_without_peeling: Option<Simulate<T, Coulomb<T>, R>>,
    simulate_compliant: Option<Simulate<T, Compliance<T>, R, CompliantVelocities<T>>>,
}

impl<T: OfferedNodes, R> Simulator<T, R> {
    fn by(method: impl Method<T> + Send + Sync + 'static, outputs: impl Outputs<T, R>) -> Self {
        let simulate = Box::new(move |scene: &Contact<_, _, _>, before: &_| scene.solve_for(before, &method, outputs));
        Self { simulate, simulate_without_peeling: None, simulate_compliant: None }
    }

    /// By the method that long tables are computed by, which alone is compiled for each scene.
    fn adaptive(method: Adaptive<T>, outputs: impl Outputs<T, R>) -> Self {
        Self {
            simulate_without_peeling: Some(Box::new(move |scene, before| scene.solve_for(before, &method, outputs))),
            simulate_compliant: Some(Box::new(move |scene, before| scene.solve_for(before, &method, outputs))),
            ..Self::by(method, outputs)
        }
    }

    /// Simulates an impact with a `peeling` moment, N m.
    ///
    /// # Errors
    /// As [`Contact::solve_for`], and a moment outside its range.
    pub fn simulate(
        &self,
        scene: &AnyScene<T>,
        peeling: T,
        before: &PlanarMotion<T>,
    ) -> Result<Solution<T, R>, InputError> {
        // Without a moment this is the same motion.
        match &self.simulate_without_peeling {
            Some(simulate) if peeling == T::ZERO => simulate(scene, before),
            _ => (self.simulate)(&scene.with_peeling(peeling)?, before),
        }
    }

    /// Simulates an impact with compliance along the surface; `None` by a method that is not offered for it: only `Adaptive` is.
    pub fn simulate_compliant(
        &self,
        scene: &CompliantContact<T>,
        before: &PlanarMotion<T>,
    ) -> Option<Result<Solution<T, R, CompliantVelocities<T>>, InputError>> {
        self.simulate_compliant.as_ref().map(|simulate| simulate(scene, before))
    }
}

impl<T: OfferedNodes> MethodChoice<T> {
    /// The simulation by this method.
    ///
    /// # Errors
    /// A number outside its range.
    pub fn simulator<R>(self, outputs: impl Outputs<T, R>) -> Result<Simulator<T, R>, Refusal> {
        match self {
            Self::Adaptive { tolerance } => Ok(Simulator::adaptive(Adaptive::new(tolerance)?, outputs)),
            Self::Collocation { nodes, tolerance } => collocation(nodes, tolerance, outputs),
            Self::FixedCost { nodes, iterations } => fixed_cost(nodes, iterations, outputs),
            Self::RungeKuttaGill { steps } => Ok(Simulator::by(RungeKuttaGill::new(steps), outputs)),
        }
    }
}

/// What is done with a `FixedCost` whose nodes are chosen at run time: by [`with_fixed_cost`].
pub trait WithFixedCost {
    /// Its result.
    type Result;

    /// Does it.
    fn with<const N: usize, const M: usize>(self, method: &FixedCost<N, M>) -> Self::Result;
}

/// Energy of a sphere that has crept to rest, over the depth of the well: it is within a thousandth of its place.
const ENERGY_AT_REST: f64 = 1e-6;

/// Turning points on the way to rest; one that creeps has none.
const TURNING_POINTS: u32 = 1000;

/// An impact in time. A captured sphere is followed until it first turns back after the peak or, where damping lets it creep
/// instead, to rest. `None` if the simulation does not converge.
///
/// # Errors
/// As [`Contact::solve_for`].
///
/// ```
/// use methods::course;
/// use microimpact::contact::{Adaptive, AnyLaw, Contact};
/// use microimpact::{NormalMotion, Oblique, Sphere, Stiffness};
///
/// // Ten times smaller than in the paper, a sphere creeps in: it is at rest 2 pi f_0/K below the surface.
/// let law = AnyLaw::ring(Stiffness::new(7.5e10)?, 250.0, 6.25)?.with_damping(10.5)?;
/// let scene = Contact::new(Sphere::solid(1e-7, 2600.0)?, law).with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_peripheral_velocity(0.0)?;
/// let last = course::<_, 64>(&scene, &before, &Adaptive::new(1e-9)?)?.unwrap().samples().last().unwrap();
/// assert!((last.indentation / 20.944e-9 - 1.0).abs() < 2e-3 && last.velocity.abs() < 1.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn course<S, const N: usize>(
    scene: &Contact<f64, AnyLaw<f64>, S>,
    before: &PlanarMotion<f64>,
    method: &Adaptive<f64>,
) -> Result<Option<Trajectory<f64, N>>, InputError>
where
    S: Surface<f64, PlanarMotion<f64>>,
    Recording<N>: Output<f64, Start<f64, S>, Result = Trajectory<f64, N>>,
{
    let (impact, trajectory) = scene.solve_for(before, method, Recording::<N>)?;
    let turned = impact.normal.outcome() != Some(Outcome::Capture) || impact.normal.turning_indentation().is_some();
    let (run, trajectory) = if turned || impact.run.status != Status::Solved {
        (impact.run, trajectory)
    } else {
        let criterion = RestCriterion::new(ENERGY_AT_REST, TURNING_POINTS)?;
        let settled = scene.solve_to_rest(before, method, &criterion, Recording::<N>)?;
        (settled.impact.run, settled.outputs)
    };
    Ok((run.status == Status::Solved).then_some(trajectory))
}

/// The numbers of nodes that are offered, each of which is a type of its own; `with` the nodes for outputs.
macro_rules! offer {
    (collocation: $($nodes:literal)*; fixed_cost: $($phase:literal with $outputs:literal),*) => {
        /// A number type with the tables for the numbers of nodes that are offered.
        pub trait OfferedNodes:
            AdaptiveNodes $(+ Nodes<$nodes>)* $(+ PhaseSamples<$phase, $outputs>)* + Send + Sync + 'static
        {
        }

        impl<T> OfferedNodes for T where
            T: AdaptiveNodes $(+ Nodes<$nodes>)* $(+ PhaseSamples<$phase, $outputs>)* + Send + Sync + 'static
        {
        }

        /// Nodes that `Collocation` is offered with.
        pub const COLLOCATION_NODES: &[u32] = &[$($nodes),*];

        /// Nodes that `FixedCost` is offered with.
        pub const FIXED_COST_NODES: &[u32] = &[$($phase),*];

        fn collocation<T: OfferedNodes, R>(
            nodes: u32,
            tolerance: T,
            outputs: impl Outputs<T, R>,
        ) -> Result<Simulator<T, R>, Refusal> {
            match nodes {
                $($nodes => Ok(Simulator::by(Collocation::<$nodes, T>::new(tolerance)?, outputs)),)*
                _ => Err(Refusal::Nodes { nodes, offered: COLLOCATION_NODES }),
            }
        }

        fn fixed_cost<T: OfferedNodes, R>(
            nodes: u32,
            iterations: u32,
            outputs: impl Outputs<T, R>,
        ) -> Result<Simulator<T, R>, Refusal> {
            match nodes {
                $($phase => {
                    Ok(Simulator::by(FixedCost::<$phase>::new(iterations)?.with_outputs::<$outputs>(), outputs))
                })*
                _ => Err(Refusal::Nodes { nodes, offered: FIXED_COST_NODES }),
            }
        }

        /// Does something with `FixedCost`, with as many nodes for outputs as they need.
        ///
        /// # Errors
        /// A number of nodes that is not offered, or of iterations outside its range.
        ///
        /// ```
        /// use methods::{Refusal, WithFixedCost, with_fixed_cost};
        /// use microimpact::contact::FixedCost;
        ///
        /// struct Nodes;
        ///
        /// impl WithFixedCost for Nodes {
        ///     type Result = usize;
        ///
        ///     fn with<const N: usize, const M: usize>(self, _: &FixedCost<N, M>) -> usize {
        ///         N
        ///     }
        /// }
        ///
        /// assert_eq!(with_fixed_cost(7, 3, Nodes), Ok(7));
        /// assert!(matches!(with_fixed_cost(4, 3, Nodes), Err(Refusal::Nodes { nodes: 4, .. })));
        /// ```
        pub fn with_fixed_cost<A: WithFixedCost>(
            nodes: u32,
            iterations: u32,
            action: A,
        ) -> Result<A::Result, Refusal> {
            match nodes {
                $($phase => {
                    Ok(action.with(&FixedCost::<$phase>::new(iterations)?.with_outputs::<$outputs>()))
                })*
                _ => Err(Refusal::Nodes { nodes, offered: FIXED_COST_NODES }),
            }
        }
    };
}

// The end of slip needs four nodes more than the phase, times near the critical speed about twice as many.
offer!(collocation: 5 6 7 8 9 10 11 12 13 14; fixed_cost: 5 with 10, 6 with 12, 7 with 13, 8 with 15, 9 with 16);
