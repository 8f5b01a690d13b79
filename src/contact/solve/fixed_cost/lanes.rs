//! Several impacts at once, by a number type that holds a number of each in a lane.

// The lanes are those of the arrays.
#![allow(clippy::indexing_slicing)]

use super::iterations::{self, Found, STRONGEST};
use super::verdict::Seen;
use super::{FixedCost, Observer};
use crate::Real;
use crate::contact::law::ContactLaw;
use crate::contact::solve::nodes::PhaseSamples;
use crate::contact::solve::path::{End, NormalPath};
use crate::contact::solve::phase::Phase;

/// What the iterations find of several impacts, and what is observed of them.
pub(crate) struct Lanes<T, V, O, const W: usize> {
    /// `None` where the method cannot represent the law.
    found: Option<Found<[T; W]>>,
    /// [`Phase::drag_beside`] of both phases.
    drags: [([T; W], [T; W]); 2],
    slowest: ([T; W], T),
    /// Before the impact, at the peak, and at the end of contact.
    observers: [O; 3],
    /// Coordinates of the peaks.
    pub(crate) peak: V,
    timed: bool,
    followed: bool,
}

impl<T: Real, V, O, const W: usize> Lanes<T, V, O, W> {
    /// The motion in a lane, and what is observed of it.
    #[inline]
    pub(crate) fn path<const N: usize, const M: usize>(
        &self,
        index: usize,
        method: &FixedCost<N, M>,
    ) -> (NormalPath<T>, &O) {
        let [before, at_peak, at_end] = &self.observers;
        let Some(found) = &self.found else {
            return (NormalPath::unsupported(T::ZERO), before);
        };
        let [arrives, returns] = [0, 1].map(|phase| self.drags[phase].0[index] <= self.drags[phase].1[index]);
        let found = found.map(|numbers| numbers[index]);
        let seen = Seen {
            arrives,
            represented: arrives && returns && found.peak > T::ZERO,
            barrier: None,
            timed: self.timed,
            followed: self.followed,
            observed: T::ZERO,
        };
        let path = found.path::<N>(&seen, method.iterations, || self.slowest.0[index] > self.slowest.1);
        let observed = if path.end == End::Separation {
            at_end
        } else if arrives {
            at_peak
        } else {
            before
        };
        (path, observed)
    }
}

impl<const N: usize, const M: usize> FixedCost<N, M> {
    /// The motion in each lane, as by [`solve`](crate::contact::Method::solve). A law that may have a barrier is unsupported: the
    /// search for it would differ from lane to lane.
    #[inline]
    pub(crate) fn solve_lanes<T, V, L, O, const W: usize>(&self, law: &L, energy: V, observer: O) -> Lanes<T, V, O, W>
    where
        T: PhaseSamples<N, M>,
        V: PhaseSamples<N, M> + Into<[T; W]>,
        L: ContactLaw<V>,
        O: Observer<V> + Copy,
    {
        const { assert!(!O::EVENTS && !O::DEMANDS, "what looks for events differs from lane to lane") };
        let zeros = [T::ZERO; W];
        let mut lanes = Lanes {
            found: None,
            drags: [(zeros, zeros); 2],
            slowest: (zeros, T::SLOWEST),
            observers: [observer; 3],
            peak: energy,
            timed: O::TIMED,
            followed: O::TO_TURNING_POINT,
        };
        if law.may_have_barrier() || !Self::represents(law, &observer) {
            return lanes;
        }
        let observe = |phase: &Phase<V, N>, before: O, rebound| {
            let mut observer = before;
            if O::OBSERVES {
                observer.observe(law, &phase.samples::<M>(law, rebound), rebound);
            }
            observer
        };
        let drag_beside = |phase: &Phase<V, N>| {
            let (drag, free) = phase.drag_beside(STRONGEST);
            (drag.into(), free.into())
        };
        let mut phase = Phase::<V, N>::approach(law, energy);
        let (at_peak, found) = iterations::run(&mut phase, law, energy, self.iterations, |phase| {
            (drag_beside(phase), observe(phase, observer, false))
        });
        lanes.drags = [at_peak.0, drag_beside(&phase)];
        lanes.observers = [observer, at_peak.1, observe(&phase, at_peak.1, true)];
        lanes.found = Some(found.map(|numbers| (*numbers).into()));
        lanes.slowest.0 = phase.slowest().into();
        lanes.peak = phase.peak;
        lanes
    }
}
