//! The method that chooses for itself: whole phases if damping is mild and the tolerance not too small, else intervals.

use super::budgeted::Budgeted;
#[cfg(feature = "serde")]
use super::collocation::Tolerance;
use super::collocation::{Collocation, ErrorControl, checked_tolerance};
use super::critical::Trial;
use super::interval::{Interval, tail_of_times};
use super::nodes::{Nodes, PhaseSamples, WEIGHT_POWER};
use super::observer::Observer;
use super::path::{End, MOST_INTERVALS, Method, NormalPath, Statistics, energy_bound};
use super::phase::Phase;
use super::rest::{RestCriterion, Settling};
use super::split::{FirstPart, find_end_of_slip};
use crate::contact::law::ContactLaw;
use crate::{InputError, Real};

/// The method to use where code size does not matter. It controls its error, and chooses what is fastest for a scene and a
/// tolerance.
///
/// If damping is mild, each phase is one polynomial with as many nodes as the tolerance needs. Everything else goes to
/// [`Collocation`]. The method contains the code for every number of nodes. In firmware that knows its scenes,
/// [`FixedCost`](super::FixedCost) or one [`Collocation`] is smaller.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // From no damping to so much that the sphere hardly leaves the surface: d (1 + e) = ln((1 + d)/(1 - e d)).
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let motion = NormalMotion::new(1.0)?;
/// for zeta in [0.1, 10.0, 1e3, 1e5] {
///     let scene = Contact::hertz(sphere, stiffness).with_damping(zeta)?;
///     let e = scene.solve(&motion, &Adaptive::new(1e-9)?)?.normal.overall_restitution();
///     let d: f64 = scene.groups(&motion)?.material_damping;
///     assert!((1.0 - e * d - (1.0 + d) * (-d * (1.0 + e)).exp()).abs() < 1e-6 * d.max(1.0));
/// }
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Tolerance<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct Adaptive<T> {
    tolerance: T,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Tolerance<T>> for Adaptive<T> {
    type Error = InputError;

    fn try_from(read: Tolerance<T>) -> Result<Self, InputError> {
        Self::new(read.tolerance)
    }
}

/// A number type with the tables for every number of nodes that a tolerance may need.
///
/// ```
/// fn restitution<T: microimpact::contact::AdaptiveNodes>() {}
///
/// restitution::<f32>();
/// restitution::<f64>();
/// ```
pub trait AdaptiveNodes:
    PhaseSamples<5, 10>
    + PhaseSamples<7, 13>
    + PhaseSamples<9, 16>
    + PhaseSamples<10, 18>
    + PhaseSamples<13, 24>
    + PhaseSamples<14, 26>
    + Nodes<7>
    + Nodes<9>
    + Nodes<10>
    + Nodes<12>
    + Nodes<14>
{
}

impl<T> AdaptiveNodes for T where
    T: PhaseSamples<5, 10>
        + PhaseSamples<7, 13>
        + PhaseSamples<9, 16>
        + PhaseSamples<10, 18>
        + PhaseSamples<13, 24>
        + PhaseSamples<14, 26>
        + Nodes<7>
        + Nodes<9>
        + Nodes<10>
        + Nodes<12>
        + Nodes<14>
{
}

impl<T: Real> Adaptive<T> {
    /// A method with a tolerance for e^2 and for all outputs asked for: at least 1e-6 in single precision and 1e-13 in double
    /// precision. Errors of outputs are relative to the approach speed, the momentum and the energy before the impact, the
    /// contact time and the peak indentation.
    ///
    /// # Errors
    /// A tolerance outside its range, or below what the rounding of the number type allows.
    ///
    /// ```
    /// assert!(microimpact::contact::Adaptive::new(1e-6).is_ok());
    /// assert!(microimpact::contact::Adaptive::new(0.0).is_err());
    /// let error = microimpact::contact::Adaptive::new(1e-9_f32).unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "tolerance is 1e-9, but must be at least 1e-6 in single and 1e-13 in double precision; in fixed point use `FixedCost`"
    /// );
    /// ```
    pub fn new(tolerance: T) -> Result<Self, InputError> {
        Ok(Self { tolerance: checked_tolerance(tolerance)? })
    }

    /// Intervals after which a run gives up, refused ones included. Each attempt at whole phases counts as two.
    ///
    /// ```
    /// assert!(microimpact::contact::Adaptive::<f32>::MOST_INTERVALS < 1000);
    /// ```
    pub const MOST_INTERVALS: u32 = MOST_INTERVALS + ATTEMPTS * INTERVALS_OF_AN_ATTEMPT;

    /// The same method with a budget of so many intervals, refused ones included, instead of [`MOST_INTERVALS`](Self::MOST_INTERVALS);
    /// a larger budget is that number. An attempt at whole phases takes two of them, whether or not it succeeds, and a budget
    /// below two allows none.
    ///
    /// An interval takes at most 700 evaluations of the forces: 50 at each of at most 14 nodes. What the status and the outcome say is
    /// as for [`Collocation::with_budget`].
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, Status};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let (motion, method) = (NormalMotion::new(2.8)?, Adaptive::new(1e-9)?);
    /// assert_eq!(scene.solve(&motion, &method.with_budget(40))?, scene.solve(&motion, &method)?);
    /// let spent = scene.solve(&motion, &method.with_budget(1))?;
    /// assert_eq!((spent.run.status, spent.normal.outcome()), (Status::BudgetSpent, None));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn with_budget(self, intervals: u32) -> Budgeted<Self>
    where
        T: Copy,
    {
        Budgeted::new(self, if intervals < Self::MOST_INTERVALS { intervals } else { Self::MOST_INTERVALS })
    }
}

/// A call of [`Collocation`] with the number of nodes that suits a tolerance.
macro_rules! by_intervals {
    ($tolerance:expr, $method:ident($($argument:expr),*)) => {{
        let tolerance = $tolerance;
        if tolerance >= T::constant(3e-7) {
            Collocation::<7, T> { tolerance }.$method($($argument),*)
        } else if tolerance >= T::constant(3e-10) {
            Collocation::<9, T> { tolerance }.$method($($argument),*)
        } else if tolerance >= T::constant(1e-11) {
            Collocation::<10, T> { tolerance }.$method($($argument),*)
        } else if tolerance >= T::constant(3e-13) {
            Collocation::<12, T> { tolerance }.$method($($argument),*)
        } else {
            Collocation::<14, T> { tolerance }.$method($($argument),*)
        }
    }};
}

#[diagnostic::do_not_recommend] // the message names the methods already
impl<T: AdaptiveNodes> ErrorControl<T> for Adaptive<T> {
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
        by_intervals!(self.tolerance, solve_to_rest(law, energy, observer, criterion))
    }

    fn try_energy<L: ContactLaw<T>>(&self, tolerance: T, law: &L, energy: T) -> Trial<T> {
        by_intervals!(tolerance, try_energy(tolerance, law, energy))
    }
}

impl<T: AdaptiveNodes> Method<T> for Adaptive<T> {
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        self.solve_within(None, law, energy, observer)
    }
}

impl<T: AdaptiveNodes> Adaptive<T> {
    /// The motion, if it takes no more than the `budget` of intervals. Without one, that of the intervals is a constant, which costs
    /// no comparison with a variable.
    #[inline]
    pub(super) fn solve_within<L, O>(&self, budget: Option<u32>, law: &L, energy: T, observer: &mut O) -> NormalPath<T>
    where
        L: ContactLaw<T>,
        O: Observer<T>,
    {
        let tolerance = self.tolerance;
        let whole_phases = law.loss_power() >= WEIGHT_POWER
            && energy >= T::constant(LEAST_PHASE_ENERGY)
            && !law.may_have_barrier()
            && !O::DEMANDS
            && observer.kink().is_none();
        let affordable = budget.map_or(ATTEMPTS, |intervals| ATTEMPTS.min(intervals / INTERVALS_OF_AN_ATTEMPT));
        let allowed = if whole_phases { affordable } else { 0 };
        let mut attempts = Attempts { tolerance, allowed, made: 0, evaluations: 0 };
        // Nodes of a phase and of its outputs, and the range of tolerances for which they are tried. It begins where most
        // mildly damped scenes reach the tolerance, with times and without, and ends where fewer nodes always do.
        macro_rules! try_phases {
            ($nodes:literal, $outputs:literal, timed $timed:literal, untimed $untimed:literal, to $largest:literal) => {
                let smallest = T::constant(if O::TIMED { $timed } else { $untimed });
                if tolerance >= smallest
                    && tolerance < T::constant($largest)
                    && let Some(path) = attempts.phases::<L, O, $nodes, $outputs>(law, energy, observer)
                {
                    return path;
                }
            };
        }
        try_phases!(5, 10, timed 3e-4, untimed 1e-5, to 1.0);
        try_phases!(7, 13, timed 5e-7, untimed 3e-7, to 3e-4);
        try_phases!(9, 16, timed 2e-8, untimed 1e-8, to 1e-5);
        try_phases!(10, 18, timed 7e-9, untimed 2e-9, to 2e-7);
        // Dividing a phase of so many nodes where the sphere begins to roll costs more than intervals do.
        if !O::EVENTS {
            try_phases!(13, 24, timed 6e-10, untimed 3e-11, to 5e-8);
            try_phases!(14, 26, timed 2e-10, untimed 8e-12, to 2e-9);
        }
        let mut path = match budget {
            None => by_intervals!(tolerance, solve(law, energy, observer)),
            Some(intervals) => {
                let remaining = intervals.saturating_sub(attempts.made * INTERVALS_OF_AN_ATTEMPT).min(MOST_INTERVALS);
                by_intervals!(tolerance, solve_within(remaining, law, energy, observer))
            }
        };
        path.statistics.evaluations += attempts.evaluations;
        path
    }
}

/// Least kinetic energy before the impact for whole phases, where one half is the largest on the way. If adhesion multiplies the
/// energy by more, a phase is slow at its end, and its estimated error is no longer a bound: over random scenes with ever smaller
/// energies (test `laws::random`) the true error is up to 50 times as large.
const LEAST_PHASE_ENERGY: f64 = 0.05;

/// Attempts at whole phases: a second one, with more nodes, only if the error of the first was a little too large.
const ATTEMPTS: u32 = 2;

/// Intervals of a budget that an attempt takes: one for each phase.
const INTERVALS_OF_AN_ATTEMPT: u32 = 2;

/// Estimated error over the tolerance, up to which more nodes may be enough: two more gain about two digits.
const NEARLY: f64 = 100.0;

/// Iterations that a phase may take. Converging ones take half as many at the smallest tolerance.
const MOST_PHASE_ITERATIONS: u32 = 12;

/// Square of the change of the speeds, over that of the tolerance, at which the iterations end. The error that remains is of
/// the order of the square of the change.
const CONVERGED: f64 = 0.1;

/// Square of the change of the speeds above which their reciprocals are renewed: below it their error does not slow down
/// convergence.
const UNSTEADY: f64 = 1e-3;

/// Loss over speed at the peak above which iterations take longer than intervals.
const STRONGEST: f64 = 5.0;

/// Estimated error of times over the square of the part of them that the nodes for outputs do not resolve.
const TIME_TAIL_ERROR: f64 = 0.1;

/// Error of an impulse over the momentum before the impact, over the relative error of the time.
const IMPULSE_WEIGHT: f64 = 5.0;

/// Remaining energy over the bound of its error, up to which the outcome is left to intervals.
const UNDECIDED: f64 = 4.0;

/// Both phases by `N` nodes and their outputs by `M`, unless the motion is not suited to it or the estimated error is too
/// large.
// Not inlined: intervals, which follow where it fails, would have its stack beneath theirs.
#[inline(never)]
fn phases<T, L, O, const N: usize, const M: usize>(
    law: &L,
    energy: T,
    tolerance: T,
    evaluations: &mut u32,
    observer: &mut O,
) -> Result<NormalPath<T>, Failed>
where
    T: PhaseSamples<N, M>,
    L: ContactLaw<T>,
    O: Observer<T>,
{
    let mut phase = Phase::<T, N>::approach(law, energy);
    if !phase.is_represented(STRONGEST) {
        return Err(Failed::ByFar);
    }
    let mut iterate = |phase: &mut Phase<T, N>, after: &mut dyn FnMut(&mut Phase<T, N>, T)| {
        let (enough, mut before) = (T::constant(CONVERGED) * tolerance * tolerance, T::ZERO);
        phase.renew();
        for _ in 0..MOST_PHASE_ITERATIONS {
            let (gained, change) = phase.iterate::<true>();
            *evaluations += N as u32;
            after(phase, gained);
            // The iterations converge superlinearly.
            if change <= enough || change * change <= enough * before {
                return Ok(gained);
            }
            if change > T::constant(UNSTEADY) {
                phase.renew();
            }
            before = change;
        }
        Err(Failed::ByFar)
    };
    let mut at_peak = energy;
    let lost = iterate(&mut phase, &mut |phase, lost| {
        at_peak = phase.correct_peak(law, energy, lost);
        phase.describe(law, false);
    })?;
    let peak = phase.peak;
    let tails = phase.tails(lost);
    let mut error = tails.error_of_energy() / energy;
    let judge = |error: T| match error {
        _ if error <= tolerance => Ok(()),
        _ if error <= T::constant(NEARLY) * tolerance => Err(Failed::ByLittle),
        _ => Err(Failed::ByFar),
    };
    let approach = O::OBSERVES.then(|| phase.samples::<M>(law, false));
    let timed = |interval: &Option<Interval<T, M>>, least: T| {
        let Some(interval) = interval else { return least };
        let unresolved = tail_of_times::<T, M>(&interval.rate);
        T::constant(IMPULSE_WEIGHT) * least.max(T::constant(TIME_TAIL_ERROR) * unresolved * unresolved)
    };
    if O::TIMED {
        error = error.max(timed(&approach, tails.error_of_times(energy)));
    }
    judge(error)?;
    let before = phase.clone();
    phase.turn(law);
    let gained = iterate(&mut phase, &mut |_, _| {})?;
    let tails = phase.tails(gained);
    error = error.max(tails.error_of_energy() / energy);
    let left = at_peak + gained;
    if left <= T::ZERO && O::TO_TURNING_POINT {
        return Err(Failed::ByFar);
    }
    let rebound = O::OBSERVES.then(|| phase.samples::<M>(law, true));
    if O::TIMED {
        error = error.max(timed(&rebound, tails.error_of_times(energy)));
    }
    judge(error)?;
    // Of a law in its own units no speed exceeds one.
    let bound = energy_bound(tolerance, energy, T::constant(0.5));
    if left.abs() <= T::constant(UNDECIDED) * bound {
        return Err(Failed::ByFar);
    }
    if let (Some(approach), Some(rebound)) = (&approach, &rebound) {
        show(law, &before, approach, false, tolerance, observer);
        show(law, &phase, rebound, true, tolerance, observer);
    }
    let end = if left > T::ZERO { End::Separation } else { End::Capture };
    let statistics = Statistics { intervals: 2, refused: 0, evaluations: *evaluations, error };
    Ok(NormalPath { end, energy: left, peak, turning: T::ZERO, error_bound: bound / energy, statistics })
}

/// Shows a phase to an observer, in two parts if the sphere begins to roll in it.
pub(super) fn show<T, O, const N: usize, const M: usize>(
    law: &impl ContactLaw<T>,
    phase: &Phase<T, N>,
    whole: &Interval<T, M>,
    rebound: bool,
    tolerance: T,
    observer: &mut O,
) where
    T: PhaseSamples<N, M>,
    O: Observer<T>,
{
    let rolls_at = if O::EVENTS { observer.rolls_at(law, whole) } else { None };
    let Some(fraction) = rolls_at else {
        return observer.observe(law, whole, rebound);
    };
    let gains = phase.gains::<M>();
    let place = |fraction: T| if rebound { fraction } else { T::ONE - fraction };
    let first = |fraction: T| {
        let interval = phase.part(law, &gains, place(T::ZERO), place(fraction));
        FirstPart { rate: interval.rate.last().copied().unwrap_or(T::ZERO) / fraction, interval }
    };
    let (fraction, part, late) = find_end_of_slip(law, observer, fraction, tolerance, first);
    let mut rest = || phase.part(law, &gains, place(fraction), place(T::ONE));
    observer.observe_rolling(law, whole, &part, late, &mut rest, rebound);
}

/// How an attempt failed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Failed {
    /// A few nodes more may be enough.
    ByLittle,
    /// More nodes are no use.
    ByFar,
}

/// Attempts at whole phases.
struct Attempts<T> {
    tolerance: T,
    allowed: u32,
    made: u32,
    /// Those of all attempts.
    evaluations: u32,
}

impl<T: Real> Attempts<T> {
    fn phases<L, O, const N: usize, const M: usize>(
        &mut self,
        law: &L,
        energy: T,
        observer: &mut O,
    ) -> Option<NormalPath<T>>
    where
        T: PhaseSamples<N, M>,
        L: ContactLaw<T>,
        O: Observer<T>,
    {
        if self.allowed == 0 {
            return None;
        }
        self.made += 1;
        let solved = phases::<T, L, O, N, M>(law, energy, self.tolerance, &mut self.evaluations, observer);
        self.allowed = if solved.as_ref().err() == Some(&Failed::ByLittle) { self.allowed - 1 } else { 0 };
        solved.ok()
    }
}
