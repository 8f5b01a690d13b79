//! The iterations of both phases, and what they find, in arithmetic alone: nothing here branches on a number, so that a number type may
//! hold the numbers of several impacts.

use crate::Real;
use crate::contact::law::ContactLaw;
use crate::contact::solve::nodes::PhaseNodes;
use crate::contact::solve::phase::{Phase, Tails};

/// Roundings that each node adds to the remaining energy.
const ROUNDINGS: f64 = 2.0;

/// Largest reciprocal of the slope of the potential, over the peak, where there is no barrier and a sphere can rebound.
const LARGEST_FLATNESS: f64 = 2.0;

/// Change of the remaining energy by an iteration, over the energy before, above which the reciprocals of the speeds are
/// renewed: below it their error changes the energy by less than its square.
const UNSTEADY: f64 = 0.01;

/// Loss over speed at the peak above which iterations can converge to a wrong value: the error that an iteration leaves is in
/// proportion to it.
pub(super) const STRONGEST: f64 = 8.0;

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

/// A phase after its iterations.
struct Iterated<T> {
    tails: Tails<T>,
    /// Energy of the losses, negative on rebound.
    gained: T,
    /// Its changes by the last iteration and the one before.
    changes: (T, T),
}

/// What the iterations of both phases find.
pub(super) struct Found<T> {
    /// Kinetic energy before the impact.
    pub(super) energy: T,
    /// Energies at the peak and at the end of contact.
    pub(super) at_peak: T,
    pub(super) left: T,
    /// Energy that the approach loses.
    pub(super) lost: T,
    pub(super) peak: T,
    /// Bounds of the error of the energy, at the peak and at the end.
    pub(super) uncertain_at_peak: T,
    pub(super) uncertain: T,
    /// Largest part of the reciprocal speed that the nodes of a phase leave unresolved.
    pub(super) slowness: T,
    /// Estimated relative errors of the times of both phases.
    pub(super) error_of_times: (T, T),
}

impl<T> Found<T> {
    /// The same in another number type.
    #[inline]
    pub(super) fn map<U>(&self, of: impl Fn(&T) -> U) -> Found<U> {
        Found {
            energy: of(&self.energy),
            at_peak: of(&self.at_peak),
            left: of(&self.left),
            lost: of(&self.lost),
            peak: of(&self.peak),
            uncertain_at_peak: of(&self.uncertain_at_peak),
            uncertain: of(&self.uncertain),
            slowness: of(&self.slowness),
            error_of_times: (of(&self.error_of_times.0), of(&self.error_of_times.1)),
        }
    }
}

/// Iterates an approach, looks at it `at_peak`, and iterates the rebound, which takes its place. Returns what was seen and found.
// Always inlined, before other functions are inlined into it: a microcontroller's code is then smallest.
#[inline(always)]
pub(super) fn run<T, L, S, const N: usize>(
    phase: &mut Phase<T, N>,
    law: &L,
    energy: T,
    iterations: u32,
    at_peak: impl FnOnce(&Phase<T, N>) -> S,
) -> (S, Found<T>)
where
    T: PhaseNodes<N>,
    L: ContactLaw<T>,
{
    let unsteady = T::constant(UNSTEADY) * energy;
    let mut lost = phase.estimate;
    // Change of the energy lost by the last iteration; before the first as large as takes the reciprocals.
    let (mut moved, mut earlier, mut energy_at_peak) = (energy, energy, energy);
    for iteration in 0..iterations {
        if iteration > 0 {
            phase.describe(law, false);
        }
        phase.renew_where(moved.abs(), unsteady, N);
        let before = lost;
        lost = phase.iterate::<false>().0;
        (earlier, moved) = (moved, lost - before);
        energy_at_peak = phase.correct_peak(law, energy, lost);
    }
    let approach = Iterated { tails: phase.tails(lost), gained: lost, changes: (moved, earlier) };
    let seen = at_peak(phase);
    phase.turn(law);
    let mut gained = T::ZERO;
    moved = energy;
    for _ in 0..iterations {
        phase.renew_slowest();
        phase.renew_where(moved.abs(), unsteady, N - 1);
        let before = gained;
        gained = phase.iterate::<false>().0;
        (earlier, moved) = (moved, gained - before);
    }
    let rebound = Iterated { tails: phase.tails(gained), gained, changes: (moved, earlier) };
    let lost_in_all = approach.tails.lost + rebound.tails.lost;
    // One step for the peak leaves an error there, which changes the losses; large where the potential is flat.
    let misplaced = (law.potential(phase.peak) - energy_at_peak).abs();
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
    let uncertain_at_peak = approach.unconverged(iterations, drag_squared) + misplaced * growth + rounding;
    let uncertain = uncertain_at_peak + rebound.unconverged(iterations, drag_squared);
    let found = Found {
        energy,
        at_peak: energy_at_peak,
        left: energy_at_peak + gained,
        lost: approach.tails.lost,
        peak: phase.peak,
        uncertain_at_peak,
        uncertain: uncertain + approach.tails.bound_with::<N>(&rebound.tails).min(T::ONE),
        slowness: approach.tails.slowness.max(rebound.tails.slowness),
        error_of_times: (approach.tails.error_of_times(energy), rebound.tails.error_of_times(energy)),
    };
    (seen, found)
}

impl<T: Real> Iterated<T> {
    /// Bound of the error that iterations leave, from the changes by the last and the one before, the drag, and the energy lost.
    #[inline]
    fn unconverged(&self, iterations: u32, drag_squared: T) -> T {
        let ((last, before), lost) = (self.changes, self.gained);
        let size = last.abs();
        if iterations < 3 {
            return T::constant(EARLY_MARGIN) * size + T::constant(EARLY_LOSSES) * lost.abs();
        }
        let contraction_squared = T::constant(CONTRACTION * CONTRACTION) * drag_squared;
        let apart = (before - last).abs().max(T::constant(CHANGE_MARGIN / LARGEST_MARGIN) * size).max(T::SMALLEST);
        let of_changes = T::constant(CHANGE_MARGIN) * size * size.saturating_div(apart);
        (T::constant(LEAST_MARGIN) * size).max(of_changes).max(contraction_squared * before.abs())
    }
}
