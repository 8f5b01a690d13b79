//! Instant classification: tables of a surface and a material, made once, that are read in tens of instructions.
//!
//! At a fixed density, stiffness, adhesion and damping the critical speed depends on the radius alone, and smoothly. A
//! [`BoundaryTable`] holds that curve, with a bound for its own error; a query closer to the curve than that is too
//! close to call, and one outside the table is told so. Tables are made on the device at start-up from any source of
//! critical speeds, or on a host as constants, in an array or in [cells](BoundarySlice) that lie elsewhere. A
//! [`RestitutionTable`] adds a surface over radius and speed, from which rebound speed and sliding or rolling follow
//! without an integration.

mod logarithm;
mod restitution;
mod slice;
mod table;

pub use logarithm::Single;
pub use restitution::{Reading, Rebound, RestitutionTable, Separation};
pub use slice::BoundarySlice;
pub use table::BoundaryTable;

/// What a table says of an impact.
///
/// ```
/// use microimpact::boundary::{BoundaryTable, Verdict};
/// use microimpact::{CriticalSpeed, NormalMotion};
///
/// // A critical speed that falls as r^(-5/3), 1 m/s at 1 um.
/// let table = BoundaryTable::<4>::new(1e-6, |radius: f64| Ok(CriticalSpeed::At((radius / 1e-6).powf(-5.0 / 3.0))))?;
/// assert_eq!(table.classify(1.5e-6, &NormalMotion::new(0.509)?), Verdict::Rebound);
/// assert_eq!(table.classify(1.5e-6, &NormalMotion::new(0.508)?), Verdict::Capture);
/// assert_eq!(table.classify(1.5e-6, &NormalMotion::new(1.5_f64.powf(-5.0 / 3.0))?), Verdict::TooCloseToCall);
/// assert_eq!(table.classify(2.5e-6, &NormalMotion::new(0.509)?), Verdict::OutsideTable);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Verdict {
    /// The sphere leaves the surface.
    Rebound,
    /// The surface holds the sphere.
    Capture,
    /// The speed is closer to the critical one than the error of the table.
    TooCloseToCall,
    /// The table does not reach there.
    OutsideTable,
}
