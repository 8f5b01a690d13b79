//! Tables that classify an impact in tens of instructions.
//!
//! A table belongs to one sphere material and one surface. For them, the critical speed is a smooth function of the radius. A
//! [`BoundaryTable`] holds this function together with a bound of its own error. The lookup returns
//! [`TooCloseToCall`](TableOutcome::TooCloseToCall) if the speed is within this error of the critical speed, and
//! [`OutsideTable`](TableOutcome::OutsideTable) if the table does not cover the radius. A [`RestitutionTable`] also holds
//! restitution and elastic impulse as functions of radius and speed. They determine the rebound speed, and whether the sphere
//! slides or rolls.
//!
//! A table can be computed on the device at start-up, from any source of critical speeds, or on the host as a constant. On the
//! device it takes hundreds of simulations, which a [`BoundaryTableMaker`] and a [`RestitutionTableMaker`] divide into steps. The
//! cells of a boundary are part of the table or, in a [`BoundarySlice`], stored elsewhere.

mod boundary;
mod boundary_maker;
mod logarithm;
mod parts;
mod restitution;
mod restitution_maker;
mod slice;

pub use boundary::BoundaryTable;
pub use boundary_maker::{BoundarySliceMaker, BoundaryTableMaker};
pub use logarithm::Single;
pub use parts::RestitutionParts;
pub use restitution::{Lookup, RestitutionTable, TableRebound};
pub use restitution_maker::RestitutionTableMaker;
pub use slice::BoundarySlice;

/// Outcome of an impact according to a table.
///
/// ```
/// use microimpact::table::{BoundaryTable, TableOutcome};
/// use microimpact::{CriticalSpeed, NormalMotion};
///
/// // A critical speed proportional to r^(-5/3), 1 m/s at 1 um.
/// let table = BoundaryTable::<4>::new(1e-6, |radius: f64| Ok(CriticalSpeed::At((radius / 1e-6).powf(-5.0 / 3.0))))?;
/// assert_eq!(table.classify(1.5e-6, &NormalMotion::new(0.509)?), TableOutcome::Rebound);
/// assert_eq!(table.classify(1.5e-6, &NormalMotion::new(0.508)?), TableOutcome::Capture);
/// assert_eq!(table.classify(1.5e-6, &NormalMotion::new(1.5_f64.powf(-5.0 / 3.0))?), TableOutcome::TooCloseToCall);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(0.509)?), TableOutcome::OutsideTable);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TableOutcome {
    /// The sphere leaves the surface.
    Rebound,
    /// The surface holds the sphere.
    Capture,
    /// The speed is within the error margin of the critical speed.
    TooCloseToCall,
    /// The table does not cover this radius.
    OutsideTable,
}
