//! What the Python package `microimpact` computes in Rust: arrays of numbers in, arrays of numbers out, with the interpreter's lock
//! released. The package's own modules check shapes, and name and document everything.

mod columns;
mod contacts;
mod fit;
mod method;
mod population;
mod refusal;
mod results;
mod rigid_bodies;
mod tables;
mod threads;
mod trajectory;

use ::population::DIAMETERS;
use impact_arrays::Quantity;
use microimpact::Parameter;
use pyo3::prelude::*;

/// Computes impacts of microspheres.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::contacts::{critical_speeds, simulate};
    #[pymodule_export]
    use super::fit::fit;
    #[pymodule_export]
    use super::population::{population_of_bodies, population_of_contacts};
    #[pymodule_export]
    use super::rigid_bodies::{classify, critical_speeds_of_bodies};
    #[pymodule_export]
    use super::tables::{BoundaryTable, RestitutionTable};
    #[pymodule_export]
    use super::trajectory::trajectory;
    use super::*;

    /// The version, the names of the parameters in the order of their codes, the names of the quantities, and
    /// what the methods take.
    #[pymodule_init]
    fn names(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        let second = refusal::OF_SECOND.map(|(_, keyword)| keyword);
        module.add("PARAMETERS", [&Parameter::ALL.map(refusal::keyword)[..], &second].concat())?;
        module.add("QUANTITIES", Quantity::ALL.map(Quantity::name))?;
        module.add("LARGEST_DIAMETER", DIAMETERS[1])?;
        method::add_ranges(module)
    }
}
