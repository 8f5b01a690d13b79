//! Collocation of the motion in intervals, as many as a tolerance needs.

use super::budgeted::Budgeted;
use super::critical::Trial;
use super::interval::Control;
use super::nodes::Nodes;
use super::observer::Observer;
use super::path::{End, Follower, MOST_INTERVALS, Method, NormalPath};
use super::rest::{RestCriterion, Settling};
use crate::contact::law::ContactLaw;
use crate::{Fault, InputError, Parameter, Real};

/// The method that solves the normal motion by collocation at `N` nodes, in as many intervals as the tolerance needs.
///
/// Seven nodes suit a tolerance of 1e-6, nine 1e-9, twelve 1e-12; in single precision eight. Few nodes cannot keep a tight
/// tolerance: four keep 1e-3, five 3e-4, six 1e-5, seven 1e-7, eight 1e-9, nine 1e-11, and ten or more any.
///
/// ```
/// use microimpact::contact::Collocation;
///
/// assert!(Collocation::<9, f64>::new(1e-9).is_ok());
/// assert!(Collocation::<7, f64>::new(1e-9).is_err());
/// assert!(Collocation::<9, f64>::new(0.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Tolerance<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct Collocation<const N: usize, T> {
    pub(super) tolerance: T,
}

/// Change at which iterations have converged, over the tolerance: errors of the iteration are small beside the others.
const CONVERGED: f64 = 0.1;

/// Weight of the error of times where times or impulses are asked for. The estimated error contains its square: an impulse counts
/// against the momentum before the impact, of which the largest force makes up five times its part of the time.
const TIMED: f64 = 2.24;

/// Weight of the error of times where only the end of the motion is asked for.
pub(super) const UNTIMED: f64 = 0.1;

/// Least tolerance, in roundings.
const LEAST_TOLERANCE: f64 = 8.0;

/// Least change of speeds at which iterations end, in roundings: a change of one unit in the last place never ends.
const LEAST_CHANGE: f64 = 2.0;

/// Least tolerance that a number of nodes keeps. The fewer nodes, the more intervals a tolerance takes, whose errors add up, and the
/// less the highest coefficients tell of the error. The test `few_nodes_keep_the_tolerances_they_accept` holds it.
const fn least_tolerance(nodes: usize) -> f64 {
    match nodes {
        ..=3 => 1e-2,
        4 => 1e-3,
        5 => 3e-4,
        6 => 1e-5,
        7 => 1e-7,
        8 => 1e-9,
        9 => 1e-11,
        _ => 0.0,
    }
}

/// Margin for the rounding of such a tolerance to the number type.
const TOLERANCE_ROUNDING: f64 = 0.999;

impl<const N: usize, T: Real> Collocation<N, T> {
    /// A method with a tolerance for e^2: at least 1e-6 in single precision and 1e-13 in double precision.
    ///
    /// # Errors
    /// A tolerance outside its range, below what the rounding of the number type allows, or below what the nodes can keep.
    ///
    /// ```
    /// assert!(microimpact::contact::Collocation::<7, f32>::new(1e-6).is_ok());
    /// assert!(microimpact::contact::Collocation::<7, f32>::new(1e-9).is_err());
    /// ```
    pub fn new(tolerance: T) -> Result<Self, InputError> {
        let tolerance = checked_tolerance(tolerance)?;
        if tolerance < T::constant(TOLERANCE_ROUNDING * least_tolerance(N)) {
            return Err(refused(tolerance, Fault::TooFewNodes));
        }
        Ok(Self { tolerance })
    }

    /// Intervals after which a run gives up, refused ones included.
    ///
    /// ```
    /// assert!(microimpact::contact::Collocation::<7, f32>::MOST_INTERVALS < 1000);
    /// ```
    pub const MOST_INTERVALS: u32 = MOST_INTERVALS;

    /// The same method with a budget of so many intervals, refused ones included, instead of [`MOST_INTERVALS`](Self::MOST_INTERVALS);
    /// a larger budget is that number.
    ///
    /// An interval takes at most 50 evaluations of the forces at each of its nodes, and a few where it converges soon. A run that
    /// spends its budget has the status [`BudgetSpent`](crate::contact::Status::BudgetSpent) and no outcome, or the outcome
    /// [`Undecided`](crate::Outcome::Undecided) where no more than that can be told; any other outcome is the one
    /// without a budget, with the same digits. A budget of zero tries one interval.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Status};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let (motion, method) = (NormalMotion::new(2.8)?, Collocation::<9, f64>::new(1e-9)?);
    /// let whole = scene.solve(&motion, &method)?;
    /// let taken = whole.run.steps + whole.run.refused;
    /// assert_eq!(scene.solve(&motion, &method.with_budget(taken + 1))?.normal, whole.normal);
    /// let spent = scene.solve(&motion, &method.with_budget(2))?;
    /// assert_eq!((spent.run.status, spent.normal.outcome()), (Status::BudgetSpent, None));
    /// assert!(spent.run.evaluations < whole.run.evaluations);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn with_budget(self, intervals: u32) -> Budgeted<Self> {
        Budgeted::new(self, if intervals < MOST_INTERVALS { intervals } else { MOST_INTERVALS })
    }

    pub(super) fn control(&self, timed: bool, observed: bool) -> Control<T> {
        let times = if timed { T::constant(TIMED) } else { T::constant(UNTIMED) };
        let converged = (T::constant(CONVERGED) * self.tolerance).max(T::constant(LEAST_CHANGE) * T::EPSILON);
        Control { converged, error: self.tolerance, times, observed, approach: T::ZERO }
    }
}

/// A tolerance that was read and is not checked yet.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
pub(super) struct Tolerance<T> {
    pub(super) tolerance: T,
}

#[cfg(feature = "serde")]
impl<T: Real, const N: usize> TryFrom<Tolerance<T>> for Collocation<N, T> {
    type Error = InputError;

    fn try_from(read: Tolerance<T>) -> Result<Self, InputError> {
        Self::new(read.tolerance)
    }
}

/// A tolerance in its range, and no less than the rounding of the number type allows.
pub(super) fn checked_tolerance<T: Real>(tolerance: T) -> Result<T, InputError> {
    // Its units are of the size of the tolerances.
    if T::IS_FIXED_POINT {
        return Err(refused(tolerance, Fault::BelowPrecision));
    }
    let tolerance = Parameter::Tolerance.check(tolerance)?;
    if tolerance < T::constant(LEAST_TOLERANCE) * T::EPSILON {
        return Err(refused(tolerance, Fault::BelowPrecision));
    }
    Ok(tolerance)
}

fn refused<T: Real>(tolerance: T, fault: Fault) -> InputError {
    InputError { parameter: Parameter::Tolerance, fault, value: tolerance.to_f64() as f32 }
}

impl<T: Nodes<N>, const N: usize> Method<T> for Collocation<N, T> {
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        self.solve_within(MOST_INTERVALS, law, energy, observer)
    }
}

impl<T: Nodes<N>, const N: usize> Collocation<N, T> {
    /// The motion, if it takes no more than so many intervals.
    pub(super) fn solve_within<L, O>(&self, intervals: u32, law: &L, energy: T, observer: &mut O) -> NormalPath<T>
    where
        L: ContactLaw<T>,
        O: Observer<T>,
    {
        let mut follower = Follower::arriving(law, energy, self.control(O::TIMED, O::OBSERVES), observer);
        follower.most_intervals = intervals;
        let mut path = follower.contact::<N>(O::TO_TURNING_POINT);
        if path.statistics.intervals + path.statistics.refused >= intervals && path.end != End::Undecided {
            // Of a capture, peak or turning point are still out of sight.
            path.end = End::Budget;
        }
        path
    }
}

/// A method that controls its error: [`Adaptive`](super::Adaptive) or [`Collocation`]. Only these follow a captured sphere to
/// rest and find critical speeds.
///
/// ```
/// use microimpact::contact::{Collocation, ErrorControl};
///
/// assert_eq!(Collocation::<9, f64>::new(1e-9)?.tolerance(), 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not control its error",
    label = "give `Adaptive` or `Collocation` here"
)]
pub trait ErrorControl<T: Real>: Method<T> {
    /// The tolerance for e^2.
    fn tolerance(&self) -> T;

    /// The motion as by [`Method::solve`]; a captured sphere is followed until it rests.
    fn solve_to_rest<L: ContactLaw<T>, O: Observer<T>>(
        &self,
        law: &L,
        energy: T,
        observer: &mut O,
        criterion: &RestCriterion<T>,
    ) -> (NormalPath<T>, Option<Settling<T>>);

    /// Whether a sphere that arrives with a kinetic energy rebounds, and by how much, to a tolerance.
    fn try_energy<L: ContactLaw<T>>(&self, tolerance: T, law: &L, energy: T) -> Trial<T>;
}

#[diagnostic::do_not_recommend] // the message names the methods already
impl<T: Nodes<N>, const N: usize> ErrorControl<T> for Collocation<N, T> {
    fn tolerance(&self) -> T {
        self.tolerance
    }

    fn solve_to_rest<L: ContactLaw<T>, O: Observer<T>>(
        &self,
        law: &L,
        energy: T,
        observer: &mut O,
        criterion: &RestCriterion<T>,
    ) -> (NormalPath<T>, Option<Settling<T>>) {
        let mut follower = Follower::arriving(law, energy, self.control(true, true), observer);
        let mut path = follower.contact::<N>(true);
        let settling = (path.end == End::Capture).then(|| follower.settle::<N>(&mut path, criterion));
        (path, settling)
    }

    fn try_energy<L: ContactLaw<T>>(&self, tolerance: T, law: &L, energy: T) -> Trial<T> {
        super::critical::try_energy::<N, T, L>(tolerance, law, energy)
    }
}
