//! What a scene wants to know of a motion besides how it ends: each a type that costs nothing where it is not named.

use super::law::NormalLaw;
use super::nodes::Nodes;
use super::stretch::Stretch;
use crate::Real;

/// Something that is integrated along the motion, one stretch after the other in the order of time.
pub trait Observer<T: Real> {
    /// Whether it looks for the end of sliding.
    const EVENTS: bool = false;

    /// Whether it wants to see the motion at all.
    const OBSERVES: bool = true;

    /// Whether the time that a stretch takes has to meet the tolerance too.
    const TIMED: bool = false;

    /// Whether a captured sphere is to be followed until it first turns back, and not only until it cannot escape.
    const TO_TURNING_POINT: bool = true;

    /// Adds a stretch.
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>;

    /// Share of a stretch, in the order of time, after which the sphere rolls, if it begins to.
    #[inline]
    fn rolls_at<const N: usize>(&self, _law: &impl NormalLaw<T>, _stretch: &Stretch<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        None
    }

    /// By how much of its length a stretch ends after the sphere has begun to roll.
    #[inline]
    fn lateness<const N: usize>(&self, _law: &impl NormalLaw<T>, _stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        T::ZERO
    }

    /// Adds a stretch in which the sphere begins to roll: `before` is its part up to there, but for a time `late` by which that
    /// part ends too late, and `after` makes the rest.
    #[inline]
    fn observe_rolling<const N: usize>(
        &mut self,
        law: &impl NormalLaw<T>,
        whole: &Stretch<T, N>,
        _before: &Stretch<T, N>,
        _late: T,
        _after: &mut dyn FnMut() -> Stretch<T, N>,
        rebound: bool,
    ) where
        T: Nodes<N>,
    {
        self.observe(law, whole, rebound);
    }
}

/// Nothing besides the end.
impl<T: Real> Observer<T> for () {
    const OBSERVES: bool = false;
    const TO_TURNING_POINT: bool = false;

    #[inline]
    fn observe<const N: usize>(&mut self, _law: &impl NormalLaw<T>, _stretch: &Stretch<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
    }
}

impl<T: Real, A: Observer<T>, B: Observer<T>> Observer<T> for (A, B) {
    const EVENTS: bool = A::EVENTS || B::EVENTS;
    const OBSERVES: bool = A::OBSERVES || B::OBSERVES;
    const TIMED: bool = A::TIMED || B::TIMED;
    const TO_TURNING_POINT: bool = A::TO_TURNING_POINT || B::TO_TURNING_POINT;

    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        self.0.observe(law, stretch, rebound);
        self.1.observe(law, stretch, rebound);
    }

    #[inline]
    fn rolls_at<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        if A::EVENTS { self.0.rolls_at(law, stretch) } else { self.1.rolls_at(law, stretch) }
    }

    #[inline]
    fn lateness<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        if A::EVENTS { self.0.lateness(law, stretch) } else { self.1.lateness(law, stretch) }
    }

    #[inline]
    fn observe_rolling<const N: usize>(
        &mut self,
        law: &impl NormalLaw<T>,
        whole: &Stretch<T, N>,
        before: &Stretch<T, N>,
        late: T,
        after: &mut dyn FnMut() -> Stretch<T, N>,
        rebound: bool,
    ) where
        T: Nodes<N>,
    {
        self.0.observe_rolling(law, whole, before, late, after, rebound);
        self.1.observe_rolling(law, whole, before, late, after, rebound);
    }
}
