//! Methods of the simulation by the attributes of Python's classes.

use std::sync::atomic::Ordering;

use impact_arrays::{Contacts, Impacts, Motions, Quantity};
use methods::{COLLOCATION_NODES, FIXED_COST_NODES, MethodChoice, Refusal, STEPS, default};
use microimpact::Parameter;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::refusal::refused;
use crate::threads::until_interrupted;

/// A method of Python's module `methods`, which has checked whole numbers. Each is told by its attributes.
#[derive(FromPyObject)]
pub(crate) enum Method {
    RungeKuttaGill { steps: u32 },
    FixedCost { nodes: u32, iterations: u32 },
    Collocation { nodes: u32, tolerance: f64 },
    Adaptive { tolerance: f64 },
}

impl Method {
    fn choice(&self) -> MethodChoice<f64> {
        match *self {
            Self::RungeKuttaGill { steps } => MethodChoice::RungeKuttaGill { steps },
            Self::FixedCost { nodes, iterations } => MethodChoice::FixedCost { nodes, iterations },
            Self::Collocation { nodes, tolerance } => MethodChoice::Collocation { nodes, tolerance },
            Self::Adaptive { tolerance } => MethodChoice::Adaptive { tolerance },
        }
    }

    /// Simulates impacts on all cores.
    pub(crate) fn simulate(
        &self,
        python: Python<'_>,
        contacts: &Contacts<'_>,
        motions: &Motions<'_>,
        count: usize,
        outputs: &[Quantity],
    ) -> PyResult<Impacts> {
        until_interrupted(python, |stop| {
            contacts.simulate_by(self.choice(), motions, count, outputs, || stop.load(Ordering::Relaxed))
        })?
        .map_err(of_method)
    }

    /// Why an impact has no result where the method does not converge, and where it cannot represent the law.
    pub(crate) const fn failures(&self) -> [&'static str; 2] {
        let not_converged = match self {
            Self::Adaptive { .. } | Self::Collocation { .. } => {
                "tolerance: the simulation did not converge; use a larger tolerance"
            }
            Self::FixedCost { .. } => "method: FixedCost did not converge; use more iterations or nodes, or Adaptive",
            Self::RungeKuttaGill { .. } => "method: RungeKuttaGill did not converge; use Adaptive",
        };
        [not_converged, "method: it cannot represent this law of contact; use Adaptive or Collocation"]
    }
}

/// The exception for a method that is refused, with the names of Python's classes.
fn of_method(refusal: Refusal) -> PyErr {
    match refusal {
        Refusal::Input(error) => refused(error),
        Refusal::Nodes { nodes, offered } => {
            PyValueError::new_err(format!("nodes: {nodes} is refused: it must be one of {offered:?}"))
        }
    }
}

/// Adds to a module what its classes take: the least number, the largest, and the default.
pub(crate) fn add_ranges(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let ends = |offered: &[u32]| (offered.first().copied(), offered.last().copied());
    let (least, most) = ends(COLLOCATION_NODES);
    module.add("COLLOCATION_NODES", (least, most, default::COLLOCATION_NODES))?;
    let (least, most) = ends(FIXED_COST_NODES);
    module.add("FIXED_COST_NODES", (least, most, default::FIXED_COST_NODES))?;
    let (least, most) = Parameter::Iterations.range();
    module.add("ITERATIONS", (least as u32, most as u32, default::ITERATIONS))?;
    module.add("STEPS", (*STEPS.start(), *STEPS.end(), default::STEPS))?;
    module.add("TOLERANCE", default::TOLERANCE)
}
