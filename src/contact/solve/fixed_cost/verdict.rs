//! How an impact ends, by what the iterations found.

use super::iterations::Found;
use crate::Real;
use crate::contact::solve::path::{End, NormalPath, Statistics};

/// Largest bound of the error of e^2, and of the relative error of times, with which a result counts as solved.
pub(super) const LARGEST_ERROR: f64 = 3e-3;

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

/// What the phases show besides numbers, and what is asked for.
pub(super) struct Seen<T> {
    /// Whether the sphere comes to the peak, and whether iterations converge.
    pub(super) arrives: bool,
    pub(super) represented: bool,
    /// Height of the barrier, where a law may have one.
    pub(super) barrier: Option<T>,
    /// Whether times have to be exact, and whether a captured sphere has been followed to its peak.
    pub(super) timed: bool,
    pub(super) followed: bool,
    /// Error of what is observed on the approach.
    pub(super) observed: T,
}

impl<T: Real> Found<T> {
    /// The motion, whose sphere `is_moving` at all nodes on its way out.
    // As the iterations.
    #[inline(always)]
    pub(super) fn path<const N: usize>(
        &self,
        seen: &Seen<T>,
        iterations: u32,
        is_moving: impl FnOnce() -> bool,
    ) -> NormalPath<T> {
        let (energy, uncertain, largest) = (self.energy, self.uncertain, T::constant(LARGEST_ERROR));
        // In front of a barrier the sphere may be slowest on its way, where no polynomial is exact.
        let resolved = seen.barrier.is_none() || self.slowness <= T::constant(LARGEST_SLOWNESS);
        let in_time = |error: T| !seen.timed || error <= largest;
        let observed_in = in_time(self.error_of_times.0) && seen.observed <= largest;
        let timely = observed_in && in_time(self.error_of_times.1);
        // A sphere that comes slower than a barrier is high, or loses so much on its way there, never meets the peak computed here.
        let escape = seen.barrier.unwrap_or(T::ZERO);
        let excess = self.left - escape;
        let clear = T::constant(BARRIER_MARGIN) * energy;
        let passes =
            seen.barrier.is_none() || (self.at_peak - escape > clear && (escape == T::ZERO || excess.abs() > clear));
        let captured = uncertain <= T::constant(LARGEST_LOSS_ERROR) && excess < -(uncertain + uncertain);
        // What is told of a capture ends at the peak, where the energy is that of the adhesion too.
        let arrived = seen.arrives && self.uncertain_at_peak <= largest * (energy + self.lost);
        let observed = !seen.followed || (arrived && observed_in);
        let known = seen.represented && resolved && passes;
        let end = if known && captured && observed {
            End::Capture
        } else if known && !captured && excess <= uncertain && uncertain <= T::constant(LARGEST_UNDECIDED) * energy {
            End::Undecided
        } else if known && timely && uncertain <= largest * energy && is_moving() && self.left - energy <= uncertain {
            End::Separation
        } else if observed && seen.barrier.is_none() && self.at_peak + self.at_peak < -self.lost {
            // The approach loses twice the energy that there is, so that the sphere comes to a stand where the potential is negative,
            // even if iterations that have not converged are wrong by half. Losses on the way out only add to that.
            End::Capture
        } else {
            End::Budget
        };
        // Between the bound and twice the bound a capture is not certain.
        let bound = if end == End::Undecided { uncertain.max(excess.abs()) } else { uncertain };
        // Of what diverges not even the bound is a number.
        let error = if bound < energy { bound.saturating_div(energy) } else { T::ONE };
        let peak = if arrived { self.peak } else { T::ZERO };
        let statistics = Statistics { intervals: 2, refused: 0, evaluations: 2 * iterations * N as u32, error };
        NormalPath { end, energy: self.left, peak, turning: T::ZERO, error_bound: error, statistics }
    }
}
