//! Quantities that are integrals over the time of contact: each is its rate of growth, whatever the method that sums it up.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::interval::{Interval, dot};
use super::nodes::Nodes;
use super::observer::Observer;
use super::quantities::{Quantities, Times};
use crate::Real;
use crate::contact::law::ContactLaw;

/// Integrals over the motion.
pub trait Integrals<T: Real>: Quantities<T> {
    /// What they grow by in time at contact radius s and a speed of size y, on the way in or out.
    #[must_use]
    fn growth(&self, law: &impl ContactLaw<T>, s: T, y: T, rebound: bool) -> Self;

    /// The coordinate at which the growth has a kink.
    #[inline]
    fn kink(&self) -> Option<T> {
        None
    }

    /// Adds an interval of the motion by its nodes.
    #[inline]
    fn add<const N: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        for j in 0..N {
            let duration = T::WEIGHTS[j] * interval.rate[j];
            let growth = self.growth(law, interval.s[j], interval.y[j], rebound);
            *self = self.combine(growth, |sum, rate| sum + duration * rate);
        }
    }
}

/// An observer that only integrates.
macro_rules! observe_by_integrals {
    ([$($parameters:tt)*] $integrals:ty, timed: $timed:literal, to_turning_point: $followed:expr) => {
        impl<$($parameters)*> Observer<T> for $integrals {
            const TIMED: bool = $timed;
            const TO_TURNING_POINT: bool = $followed;

            #[inline]
            fn kink(&self) -> Option<T> {
                Integrals::kink(self)
            }

            #[inline]
            fn observe<const N: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, rebound: bool)
            where
                T: Nodes<N>,
            {
                self.add(law, interval, rebound);
            }

            type State = Self;

            #[inline]
            fn state(&self) -> Self {
                *self
            }

            #[inline]
            fn rates(&self, state: &Self, law: &impl ContactLaw<T>, s: T, y: T, rebound: bool) -> Self {
                state.growth(law, s, y, rebound)
            }

            #[inline]
            fn ended(&mut self, state: &Self, _times: &Times<T>) {
                *self = *state;
            }
        }
    };
}

pub(crate) use observe_by_integrals;

impl<T: Real> Quantities<T> for Times<T> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self { now: of(self.now, other.now), peak: of(self.peak, other.peak) }
    }
}

impl<T: Real> Integrals<T> for Times<T> {
    #[inline]
    fn growth(&self, _law: &impl ContactLaw<T>, _s: T, _y: T, rebound: bool) -> Self {
        // Only until the sphere turns back for the first time.
        let approaches = !rebound && self.peak == self.now;
        Self { now: T::ONE, peak: if approaches { T::ONE } else { T::ZERO } }
    }
}

impl<T: Real> Observer<T> for Times<T> {
    const TIMED: bool = true;

    // As all that follows a motion in time adds it up, to the last digit.
    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        let duration = dot(&T::WEIGHTS, &interval.rate);
        let growth = self.growth(law, T::ZERO, T::ZERO, rebound);
        *self = self.combine(growth, |sum, rate| sum + duration * rate);
    }

    type State = ();

    #[inline]
    fn state(&self) {}

    #[inline]
    fn rates(&self, (): &(), _law: &impl ContactLaw<T>, _s: T, _y: T, _rebound: bool) {}

    #[inline]
    fn ended(&mut self, (): &(), times: &Times<T>) {
        *self = *times;
    }
}

/// Impulses of the elastic force and of adhesion on rebound, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulses<T> {
    pub(crate) elastic: T,
    pub(crate) adhesion_rebound: T,
}

impl<T: Real> Impulses<T> {
    pub(crate) fn new() -> Self {
        Self { elastic: T::ZERO, adhesion_rebound: T::ZERO }
    }

    /// The same in another number type.
    pub(crate) fn map<U>(self, of: impl Fn(T) -> U) -> Impulses<U> {
        Impulses { elastic: of(self.elastic), adhesion_rebound: of(self.adhesion_rebound) }
    }
}

impl<T: Real> Quantities<T> for Impulses<T> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self {
            elastic: of(self.elastic, other.elastic),
            adhesion_rebound: of(self.adhesion_rebound, other.adhesion_rebound),
        }
    }
}

impl<T: Real> Integrals<T> for Impulses<T> {
    #[inline]
    fn growth(&self, law: &impl ContactLaw<T>, s: T, y: T, rebound: bool) -> Self {
        let adhesion_rebound = if rebound { law.adhesion_force(s) + law.adhesion_damping(s) * y } else { T::ZERO };
        Self { elastic: law.elastic_force(s), adhesion_rebound }
    }
}

observe_by_integrals!([T: Real] Impulses<T>, timed: true, to_turning_point: true);

/// Works of the two kinds of damping, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Works<T> {
    pub(crate) material: T,
    pub(crate) adhesion: T,
}

impl<T: Real> Works<T> {
    pub(crate) fn new() -> Self {
        Self { material: T::ZERO, adhesion: T::ZERO }
    }
}

impl<T: Real> Quantities<T> for Works<T> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self { material: of(self.material, other.material), adhesion: of(self.adhesion, other.adhesion) }
    }
}

impl<T: Real> Integrals<T> for Works<T> {
    #[inline]
    fn growth(&self, law: &impl ContactLaw<T>, s: T, y: T, rebound: bool) -> Self {
        let square = y * y;
        let adhesion = if rebound { law.adhesion_damping(s) * square } else { T::ZERO };
        Self { material: law.material_damping(s) * square, adhesion }
    }
}

observe_by_integrals!([T: Real] Works<T>, timed: false, to_turning_point: true);
