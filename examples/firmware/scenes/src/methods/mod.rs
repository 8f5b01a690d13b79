//! Methods that compete for the least cost at the same error: this library's, the paper's, plain Runge-Kutta methods,
//! and two crates that run without an operating system.
//!
//! Nothing here knows of a microcontroller: the report of the host runs the same methods.

pub mod inputs;
pub mod ours;
pub mod peers;
pub mod raw;
pub mod regularised;
pub mod runge_kutta;

use core::fmt::{self, Display};

use microimpact::{FixedPoint, Real};

use inputs::Inputs;
use ours::Tables;
use peers::PeerNumber;

/// A number type of the comparison.
pub trait Number: Real {
    /// Its name in tables.
    const NAME: &'static str;
    /// Distance from one to the next larger number.
    const ROUNDING: f64;

    /// Its value, exactly.
    fn value(self) -> f64;
}

impl Number for f32 {
    const NAME: &'static str = "f32";
    const ROUNDING: f64 = f32::EPSILON as f64;

    fn value(self) -> f64 {
        f64::from(self)
    }
}

impl Number for f64 {
    const NAME: &'static str = "f64";
    const ROUNDING: f64 = f64::EPSILON;

    fn value(self) -> f64 {
        self
    }
}

impl Number for FixedPoint {
    const NAME: &'static str = "fixed point";
    const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

    fn value(self) -> f64 {
        self.to_f64()
    }
}

/// What a method is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Task {
    /// Restitution of a motion along the normal.
    Normal,
    /// Restitution, tangential velocity and spin of a motion with friction and spin.
    Oblique,
}

impl Task {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Oblique => "oblique",
        }
    }
}

/// What sets the error of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Iterations of each phase.
    Iterations(u32),
    /// Steps in the duration of an undamped impact.
    Steps(u32),
    /// The error asked for.
    Tolerance(f64),
}

/// A method with one setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contestant {
    /// What it is asked for.
    pub task: Task,
    /// Whose settings are drawn as one line.
    pub method: &'static str,
    /// Nodes, algorithm or events, where the method has a choice.
    pub variant: Variant,
    /// What sets the error.
    pub amount: Amount,
}

/// What a method leaves open besides its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variant {
    /// Nothing.
    Only,
    /// The number of nodes.
    Nodes(usize),
    /// An algorithm of a crate, and how far towards an event it goes before the variable changes.
    Algorithm(&'static str, f64),
}

impl Display for Contestant {
    /// The setting.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.variant {
            Variant::Only => {}
            Variant::Nodes(nodes) => write!(f, "{nodes} nodes, ")?,
            Variant::Algorithm(name, fraction) => write!(f, "{name} to {fraction} of an event, ")?,
        }
        match self.amount {
            Amount::Iterations(iterations) => write!(f, "{iterations} iterations"),
            Amount::Steps(steps) => write!(f, "{steps} steps"),
            Amount::Tolerance(tolerance) => write!(f, "{tolerance:.0e}"),
        }
    }
}

/// What a method answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply<T> {
    /// e.
    pub restitution: T,
    /// Tangential velocity, m/s, and spin, rad/s, where the task asks for them.
    pub surface: Option<[T; 2]>,
}

impl<T> Reply<T> {
    /// e alone.
    pub fn normal(restitution: T) -> Self {
        Self { restitution, surface: None }
    }
}

/// Work to do for every contestant.
pub trait Visitor {
    /// Does it for one of them; `run` gives `None` where the method comes to no solution.
    fn visit<T: Number>(&mut self, contestant: Contestant, run: impl FnMut() -> Option<Reply<T>> + 'static);
}

/// How far the settings go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Extent {
    /// Most steps of the methods on the equations in time.
    pub most_steps: u32,
    /// Whether every other setting is left out.
    pub sparse: bool,
}

impl Extent {
    /// Numbers of steps, each twice that before.
    fn steps(self, from: u32) -> impl Iterator<Item = u32> {
        let factor = if self.sparse { 4 } else { 2 };
        core::iter::successors(Some(from), move |steps| steps.checked_mul(factor))
            .take_while(move |&n| n <= self.most_steps)
    }

    /// Tolerances by decades, down to the rounding of a number type.
    fn tolerances<T: Number>(self) -> impl Iterator<Item = f64> {
        const DECADES: [f64; 13] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];
        let factor = if self.sparse { 2 } else { 1 };
        DECADES.into_iter().step_by(factor).filter(|&tolerance| tolerance >= 4.0 * T::ROUNDING)
    }
}

/// Goes through all contestants in one number type.
pub fn visit<T: Tables + PeerNumber>(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    ours::normal::<T>(inputs, extent, visitor);
    ours::oblique::<T>(inputs, extent, visitor);
    raw::visit::<T>(inputs, extent, visitor);
    regularised::visit::<T>(inputs, extent, visitor);
    peers::visit::<T>(inputs, extent, visitor);
}

/// Goes through those in fixed point, whose set-up is done before.
pub fn visit_fixed_point(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    ours::fixed_point(inputs, extent, visitor);
    regularised::visit_fixed_point(inputs, extent, visitor);
}
