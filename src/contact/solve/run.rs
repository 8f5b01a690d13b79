//! Statistics of a solution, and whether it came to its end.

use super::path::{End, NormalPath};
use crate::Real;

/// Whether a run came to its end.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, Status};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let impact = scene.solve(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9)?)?;
/// assert_eq!(impact.run.status, Status::Solved);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Status {
    /// The motion was followed to its end, within the tolerance if the method has one. The outcome may be undecided.
    Solved,
    /// The iterations did not converge, or the intervals ran out, of which a [`Budgeted`](crate::contact::Budgeted) method says how
    /// many there are; the result is not to be relied on.
    BudgetSpent,
    /// The method cannot represent the law of contact, the force that friction is proportional to, or tangential compliance; there is
    /// no result.
    Unsupported,
}

impl Status {
    pub(crate) fn of<T>(path: &NormalPath<T>) -> Self {
        match path.end {
            End::Separation | End::Capture | End::Undecided => Self::Solved,
            End::Budget => Self::BudgetSpent,
            End::Unsupported => Self::Unsupported,
        }
    }
}

/// Statistics of the solver.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, RunReport};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(10.0)?;
/// let run: RunReport<f64> = scene.solve(&NormalMotion::new(1.0)?, &Collocation::<9, f64>::new(1e-9)?)?.run;
/// assert!(run.steps + run.refused <= Collocation::<9, f64>::MOST_INTERVALS);
/// assert!(run.evaluations >= 9 * run.steps);
/// assert!(run.estimated_error <= 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RunReport<T> {
    /// Whether the run came to its end.
    pub status: Status,
    /// Intervals, phases or steps in time that the motion was divided into.
    pub steps: u32,
    /// Those that were tried and refused.
    pub refused: u32,
    /// Evaluations of a speed from the forces, or of the forces in time.
    pub evaluations: u32,
    /// Bound of the error of e^2, and of the energy with which the sphere passes a barrier, over the kinetic energy before the
    /// impact. If either differs from zero by less, the outcome is undecided: in front of the barrier of a force out of the surface
    /// e^2 may then be anything.
    pub error_bound: T,
    /// Largest estimated error of an interval or phase, over the energy there; zero where a method has no estimate.
    pub estimated_error: T,
}

impl<T: Real> RunReport<T> {
    pub(crate) fn new(path: &NormalPath<T>) -> Self {
        let statistics = &path.statistics;
        Self {
            status: Status::of(path),
            steps: statistics.intervals,
            refused: statistics.refused,
            evaluations: statistics.evaluations,
            error_bound: path.error_bound,
            estimated_error: statistics.error,
        }
    }
}
