//! A method of fixed cost for firmware: approach and rebound are one polynomial each, in a fixed number of iterations.

#[cfg(doc)]
use super::Collocation;
use super::adaptive::show;
use super::nodes::{PhaseSamples, WEIGHT_POWER};
use super::observer::Observer;
use super::path::{End, Method, NormalPath, Statistics};
use super::phase::{Phase, Tails};
use super::well::barrier;
use crate::contact::law::ContactLaw;
use crate::{InputError, Parameter, Real};

/// A method that costs about the same for every impact: `N` nodes and a fixed number of iterations for each phase, and `M`
/// nodes for outputs.
///
/// The error of e over the scenes of the paper and others as mildly damped is 1e-5 with five nodes and 1e-6 with seven, both
/// in three iterations. Stronger damping needs more iterations. The bound of the error of e^2 consists of what the iterations leave,
/// what the nodes do not resolve, and rounding; the chapter on the [method](crate::contact::method) derives it. If it exceeds 0.003,
/// the status of a rebound is not *solved*; if e^2 is smaller, the outcome is *undecided*. Use [`Collocation`] for such impacts. The bound
/// holds for the paper's law, for the adhesion of [`Dmt`](crate::contact::Dmt), and for viscoelastic and constant damping, the latter
/// down to a nominal restitution of 0.2. A contact that begins or ends elsewhere than at zero indentation is
/// [`Unsupported`](super::Status::Unsupported).
///
/// ```
/// use microimpact::contact::{Contact, FixedCost};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(5.06e-6_f32, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let impact = scene.solve(&NormalMotion::new(2.8)?, &FixedCost::<5>::new(3)?)?;
/// assert!((impact.normal.overall_restitution() - 0.746193).abs() < 1e-5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Iterations"))]
pub struct FixedCost<const N: usize, const M: usize = 9> {
    iterations: u32,
}

impl<const N: usize> FixedCost<N> {
    /// A method with a number of iterations for each phase, 1 to 40, and nine nodes for outputs.
    ///
    /// # Errors
    /// A number outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::FixedCost::<5>::new(0).is_err());
    /// ```
    pub fn new(iterations: u32) -> Result<Self, InputError> {
        Parameter::Iterations.check(f64::from(iterations))?;
        Ok(Self { iterations })
    }

    /// The same method, with velocities along the surface and outputs from `M` nodes of each phase. Where neither is
    /// asked for, no code for them is generated.
    ///
    /// With two nodes more than `N` velocities along the surface are as exact as e, relative to the slip; impulses take three
    /// more, and times near the critical speed twice as many. Outputs that look for the end of sliding
    /// ([`Slip`](crate::contact::Slip), [`Energy`](crate::contact::Energy)) and a peeling moment need four more; with fewer
    /// the status is [`Unsupported`](super::Status::Unsupported).
    ///
    /// ```
    /// use microimpact::contact::{Contact, FixedCost, Times};
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let motion = NormalMotion::new(1.0)?;
    /// let method = FixedCost::<7>::new(3)?.with_outputs::<10>();
    /// let (_, times) = Contact::hertz(sphere, stiffness).solve_for(&motion, &method, Times)?;
    /// assert!((times.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0_f64).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_outputs<const M: usize>(self) -> FixedCost<N, M> {
        FixedCost { iterations: self.iterations }
    }
}

/// A number of iterations that was read and is not checked yet.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Iterations {
    iterations: u32,
}

#[cfg(feature = "serde")]
impl<const N: usize, const M: usize> TryFrom<Iterations> for FixedCost<N, M> {
    type Error = InputError;

    fn try_from(read: Iterations) -> Result<Self, InputError> {
        Ok(FixedCost::<N>::new(read.iterations)?.with_outputs())
    }
}

/// Nodes beyond those of a phase that the end of sliding needs: the square of the speed is that much a higher polynomial.
const NODES_OF_EVENTS: usize = 4;

/// Roundings that each node adds to the remaining energy.
const ROUNDINGS: f64 = 2.0;

/// Largest bound of the error of e^2, and of the relative error of times, with which a result counts as solved.
const LARGEST_ERROR: f64 = 3e-3;

/// Largest reciprocal of the slope of the potential, over the peak, where there is no barrier and a sphere can rebound.
const LARGEST_FLATNESS: f64 = 2.0;

/// Change of the remaining energy by an iteration, over the energy before, above which the reciprocals of the speeds are
/// renewed: below it their error changes the energy by less than its square.
const UNSTEADY: f64 = 0.01;

/// Largest bound with which an outcome counts as undecided.
const LARGEST_UNDECIDED: f64 = 0.05;

/// Largest error of the energy lost, over the largest kinetic energy without losses, twice, with which a capture is certain: iterations
/// that diverge lose more than there is.
const LARGEST_LOSS_ERROR: f64 = 0.1;

/// Largest part of the reciprocal speed that the nodes may leave unresolved where there can be a barrier.
const LARGEST_SLOWNESS: f64 = 0.01;

/// Least energy at the peak beyond that of a barrier, and least difference on the way out, over the energy before: close to a
/// barrier the sphere is slow in the middle of its way, which a polynomial may miss.
const BARRIER_MARGIN: f64 = 0.1;

/// Loss over speed at the peak above which iterations can converge to a wrong value: the error that an iteration leaves is in
/// proportion to it.
const STRONGEST: f64 = 8.0;

/// Tolerance to which the end of sliding is found within a phase, for outputs that need it.
const END_OF_SLIP: f64 = 1e-9;

/// Bound of the error that iterations leave, over Aitken's estimate from the last two changes,
const CHANGE_MARGIN: f64 = 2.0;

/// and over the last change alone: at least, and at most. Both changes may be alike because they are rounding.
const LEAST_MARGIN: f64 = 0.5;
const LARGEST_MARGIN: f64 = 10.0;

/// Largest factor by which an iteration multiplies an error, over the drag at the peak: the last change may be small by chance, the one
/// before is not as well.
const CONTRACTION: f64 = 0.15;

/// The same over the last change after fewer iterations than three, when it says little of the next,
const EARLY_MARGIN: f64 = 2.0;

/// and the part of the energy lost that they may miss: there is no earlier change to show that the last is small by chance.
const EARLY_LOSSES: f64 = 1e-3;

impl<T, const N: usize, const M: usize> Method<T> for FixedCost<N, M>
where
    T: PhaseSamples<N, M>,
{
    #[inline]
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        let kinked = observer.kink().is_some();
        if law.loss_power() < WEIGHT_POWER || kinked || (O::EVENTS && M < N + NODES_OF_EVENTS) {
            return NormalPath::unsupported(energy);
        }
        // Shows a phase, and returns the error of what is observed.
        let mut observe = |phase: &Phase<T, N>, rebound| {
            if !O::OBSERVES {
                return T::ZERO;
            }
            let whole = phase.samples::<M>(law, rebound);
            let error = if O::DEMANDS { observer.error(law, &whole, T::constant(LARGEST_ERROR)) } else { T::ZERO };
            show(law, phase, &whole, rebound, T::constant(END_OF_SLIP).max(T::EPSILON), observer);
            error
        };
        let moves = |by: T| by.abs() > T::constant(UNSTEADY) * energy;
        let mut phase = Phase::<T, N>::approach(law, energy);
        let mut lost = phase.estimate;
        // Change of the energy lost by the last iteration; before the first as large as takes the reciprocals.
        let (mut moved, mut earlier, mut at_peak) = (energy, energy, energy);
        for iteration in 0..self.iterations {
            if iteration > 0 {
                phase.describe(law, false);
            }
            if moves(moved) {
                phase.renew();
            }
            let before = lost;
            lost = phase.iterate::<false>().0;
            (earlier, moved) = (moved, lost - before);
            at_peak = phase.correct_peak(law, energy, lost);
        }
        let (moved_in, earlier_in) = (moved, earlier);
        let approach = phase.tails(lost);
        // Where the approach comes to a stand before its peak, there is another one.
        let arrives = phase.is_represented(STRONGEST) && (!law.may_have_barrier() || phase.is_moving());
        let approach_error = if arrives { observe(&phase, false) } else { T::ZERO };
        phase.turn(law);
        let mut gained = T::ZERO;
        moved = energy;
        for _ in 0..self.iterations {
            if moves(moved) {
                phase.renew();
            } else {
                phase.renew_slowest();
            }
            let before = gained;
            gained = phase.iterate::<false>().0;
            (earlier, moved) = (moved, gained - before);
        }
        let rebound = phase.tails(gained);
        let mut represented = arrives && phase.is_represented(STRONGEST) && phase.peak > T::ZERO;
        let lost_in_all = approach.lost + rebound.lost;
        // One step for the peak leaves an error there, which changes the losses; large where the potential is flat.
        let misplaced = (law.potential(phase.peak) - at_peak).abs();
        let mut growth = T::constant(law.energy_power()) * lost_in_all;
        growth = if law.may_have_barrier() {
            growth.saturating_div(phase.peak * law.slope(phase.peak)).abs()
        } else {
            T::constant(LARGEST_FLATNESS) * growth
        };
        let roundings = T::constant(ROUNDINGS * N as f64);
        let rounding = roundings * T::EPSILON * (energy + lost_in_all) + roundings * T::SMALLEST;
        // On the way out damping is at least as strong as on the way in.
        let drag_squared = phase.drag_squared(STRONGEST);
        let of_approach = self.unconverged(moved_in, earlier_in, drag_squared, lost) + misplaced * growth + rounding;
        let mut uncertain = of_approach + self.unconverged(moved, earlier, drag_squared, gained);
        uncertain = uncertain + approach.bound_with::<N>(&rebound).min(T::ONE);
        if law.may_have_barrier() {
            // In front of a barrier the sphere may be slowest on its way, where no polynomial is exact.
            represented &= approach.slowness.max(rebound.slowness) <= T::constant(LARGEST_SLOWNESS);
        }
        let largest = T::constant(LARGEST_ERROR);
        let in_time = |tails: &Tails<T>| !O::TIMED || tails.error_of_times(energy) <= largest;
        let observed_in = in_time(&approach) && (!O::DEMANDS || approach_error <= largest);
        let timely = observed_in && in_time(&rebound);
        let left = at_peak + gained;
        // A sphere that comes slower than a barrier is high, or loses so much on its way there, never meets the peak computed here.
        let (_, escape) = barrier(law);
        let excess = left - escape;
        let clear = T::constant(BARRIER_MARGIN) * energy;
        let passes =
            !law.may_have_barrier() || (at_peak - escape > clear && (escape == T::ZERO || excess.abs() > clear));
        let captured = uncertain <= T::constant(LARGEST_LOSS_ERROR) && excess < -(uncertain + uncertain);
        // What is told of a capture ends at the peak, where the energy is that of the adhesion too.
        let arrived = arrives && of_approach <= largest * (energy + approach.lost);
        let observed = !O::TO_TURNING_POINT || (arrived && observed_in);
        let known = represented && passes;
        let mut end = if known && captured && observed {
            End::Capture
        } else if known && !captured && excess <= uncertain && uncertain <= T::constant(LARGEST_UNDECIDED) * energy {
            End::Undecided
        } else if known && timely && uncertain <= largest * energy && phase.is_moving() && left - energy <= uncertain {
            End::Separation
        } else if observed && !law.may_have_barrier() && at_peak + at_peak < -approach.lost {
            // The approach loses twice the energy that there is, so that the sphere comes to a stand where the potential is negative,
            // even if iterations that have not converged are wrong by half. Losses on the way out only add to that.
            End::Capture
        } else {
            End::Budget
        };
        if end == End::Separation && observe(&phase, true) > largest {
            end = End::Budget;
        }
        // Between the bound and twice the bound a capture is not certain.
        let bound = if end == End::Undecided { uncertain.max(excess.abs()) } else { uncertain };
        // Of what diverges not even the bound is a number.
        let error = if bound < energy { bound.saturating_div(energy) } else { T::ONE };
        let peak = if arrived { phase.peak } else { T::ZERO };
        let statistics =
            Statistics { intervals: 2, refused: 0, iterations: 2 * self.iterations, nodes: N as u32, error };
        NormalPath { end, energy: left, peak, turning: T::ZERO, error_bound: error, statistics }
    }
}

impl<const N: usize, const M: usize> FixedCost<N, M> {
    /// Bound of the error that iterations leave, from the changes by the last and the one before, the drag, and the energy lost.
    #[inline]
    fn unconverged<T: Real>(&self, last: T, before: T, drag_squared: T, lost: T) -> T {
        let size = last.abs();
        if self.iterations < 3 {
            return T::constant(EARLY_MARGIN) * size + T::constant(EARLY_LOSSES) * lost.abs();
        }
        let contraction_squared = T::constant(CONTRACTION * CONTRACTION) * drag_squared;
        let apart = (before - last).abs().max(T::constant(CHANGE_MARGIN / LARGEST_MARGIN) * size).max(T::SMALLEST);
        let of_changes = T::constant(CHANGE_MARGIN) * size * size.saturating_div(apart);
        (T::constant(LEAST_MARGIN) * size).max(of_changes).max(contraction_squared * before.abs())
    }
}
