//! What a scene wants to know of a motion besides how it ends: each a type that costs nothing where it is not named.
//!
//! Methods that divide the motion into intervals show them in the order of time. The method with a fixed time step carries
//! the observer's own state along with the motion.

use super::interval::Interval;
use super::nodes::Nodes;
use super::quantities::{Quantities, Times};
use crate::Real;
use crate::contact::law::ContactLaw;

/// Something that is integrated along the motion, one interval after the other in the order of time.
pub trait Observer<T: Real> {
    /// Whether it looks for the end of sliding.
    const EVENTS: bool = false;

    /// Whether it wants to see the motion at all.
    const OBSERVES: bool = true;

    /// Whether the time that an interval takes has to meet the tolerance too.
    const TIMED: bool = false;

    /// Whether it can need shorter intervals than the motion does.
    const DEMANDS: bool = false;

    /// Whether a method with a time step can carry it.
    const IN_STEPS: bool = true;

    /// Whether a captured sphere is to be followed until it first turns back, and not only until it cannot escape.
    const TO_TURNING_POINT: bool = true;

    /// A coordinate at which what it integrates has a kink: intervals are divided there.
    #[inline]
    fn kink(&self) -> Option<T> {
        None
    }

    /// Adds an interval.
    fn observe<const N: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, rebound: bool)
    where
        T: Nodes<N>;

    /// Estimated error of what it integrates over an interval, as a fraction of its scale. It is no larger than the error `allowed`
    /// where the interval is short enough.
    #[inline]
    fn error<const N: usize>(&self, _law: &impl ContactLaw<T>, _interval: &Interval<T, N>, _allowed: T) -> T
    where
        T: Nodes<N>,
    {
        T::ZERO
    }

    /// Fraction of an interval, in the order of time, after which the sphere rolls, if it begins to.
    #[inline]
    fn rolls_at<const N: usize>(&self, _law: &impl ContactLaw<T>, _interval: &Interval<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        None
    }

    /// By how much time an interval ends after the sphere has begun to roll.
    #[inline]
    fn residual<const N: usize>(&self, _law: &impl ContactLaw<T>, _interval: &Interval<T, N>) -> T
    where
        T: Nodes<N>,
    {
        T::ZERO
    }

    /// Adds an interval in which the sphere begins to roll: `before` is its part up to there, but for a time `late` by which that
    /// part ends too late, and `after` makes the rest.
    #[inline]
    fn observe_rolling<const N: usize>(
        &mut self,
        law: &impl ContactLaw<T>,
        whole: &Interval<T, N>,
        _before: &Interval<T, N>,
        _late: T,
        _after: &mut dyn FnMut() -> Interval<T, N>,
        rebound: bool,
    ) where
        T: Nodes<N>,
    {
        self.observe(law, whole, rebound);
    }

    /// What a method with a time step integrates along with the motion.
    type State: Quantities<T>;

    /// The state before contact.
    fn state(&self) -> Self::State;

    /// Its rate of change in time at the coordinate s and a speed of size y, on the way in or out.
    fn rates(&self, state: &Self::State, law: &impl ContactLaw<T>, s: T, y: T, rebound: bool) -> Self::State;

    /// The largest rate at which something decays at the coordinate s: no time step may be longer than its inverse.
    #[inline]
    fn fastest_decay(&self, _law: &impl ContactLaw<T>, _s: T) -> T {
        T::ZERO
    }

    /// Slip in its first direction while the sphere slides.
    #[inline]
    fn slip(&self, _state: &Self::State) -> Option<T> {
        None
    }

    /// The sphere rolls from this time on.
    #[inline]
    fn rolls_from(&mut self, _time: T) {}

    /// A time step, or the peak, has brought the sphere here.
    #[inline]
    fn stepped(&mut self, _law: &impl ContactLaw<T>, _time: T, _s: T, _y: T, _rebound: bool) {}

    /// Takes in the state at the end.
    fn ended(&mut self, state: &Self::State, times: &Times<T>);
}

/// Nothing besides the end.
impl<T: Real> Observer<T> for () {
    const OBSERVES: bool = false;
    const TO_TURNING_POINT: bool = false;

    #[inline]
    fn observe<const N: usize>(&mut self, _law: &impl ContactLaw<T>, _interval: &Interval<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
    }

    type State = ();

    #[inline]
    fn state(&self) {}

    #[inline]
    fn rates(&self, (): &(), _law: &impl ContactLaw<T>, _s: T, _y: T, _rebound: bool) {}

    #[inline]
    fn ended(&mut self, (): &(), _times: &Times<T>) {}
}

impl<T: Real, A: Observer<T>, B: Observer<T>> Observer<T> for (A, B) {
    const EVENTS: bool = A::EVENTS || B::EVENTS;
    const OBSERVES: bool = A::OBSERVES || B::OBSERVES;
    const TIMED: bool = A::TIMED || B::TIMED;
    const DEMANDS: bool = A::DEMANDS || B::DEMANDS;
    const IN_STEPS: bool = A::IN_STEPS && B::IN_STEPS;
    const TO_TURNING_POINT: bool = A::TO_TURNING_POINT || B::TO_TURNING_POINT;

    #[inline]
    fn kink(&self) -> Option<T> {
        self.0.kink().or(self.1.kink())
    }

    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        self.0.observe(law, interval, rebound);
        self.1.observe(law, interval, rebound);
    }

    #[inline]
    fn error<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, allowed: T) -> T
    where
        T: Nodes<N>,
    {
        self.0.error(law, interval, allowed).max(self.1.error(law, interval, allowed))
    }

    #[inline]
    fn rolls_at<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        if A::EVENTS { self.0.rolls_at(law, interval) } else { self.1.rolls_at(law, interval) }
    }

    #[inline]
    fn residual<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> T
    where
        T: Nodes<N>,
    {
        if A::EVENTS { self.0.residual(law, interval) } else { self.1.residual(law, interval) }
    }

    #[inline]
    fn observe_rolling<const N: usize>(
        &mut self,
        law: &impl ContactLaw<T>,
        whole: &Interval<T, N>,
        before: &Interval<T, N>,
        late: T,
        after: &mut dyn FnMut() -> Interval<T, N>,
        rebound: bool,
    ) where
        T: Nodes<N>,
    {
        self.0.observe_rolling(law, whole, before, late, after, rebound);
        self.1.observe_rolling(law, whole, before, late, after, rebound);
    }

    type State = (A::State, B::State);

    #[inline]
    fn state(&self) -> Self::State {
        (self.0.state(), self.1.state())
    }

    #[inline]
    fn rates(&self, state: &Self::State, law: &impl ContactLaw<T>, s: T, y: T, rebound: bool) -> Self::State {
        (self.0.rates(&state.0, law, s, y, rebound), self.1.rates(&state.1, law, s, y, rebound))
    }

    #[inline]
    fn fastest_decay(&self, law: &impl ContactLaw<T>, s: T) -> T {
        self.0.fastest_decay(law, s).max(self.1.fastest_decay(law, s))
    }

    #[inline]
    fn slip(&self, state: &Self::State) -> Option<T> {
        if A::EVENTS { self.0.slip(&state.0) } else { self.1.slip(&state.1) }
    }

    #[inline]
    fn rolls_from(&mut self, time: T) {
        self.0.rolls_from(time);
        self.1.rolls_from(time);
    }

    #[inline]
    fn stepped(&mut self, law: &impl ContactLaw<T>, time: T, s: T, y: T, rebound: bool) {
        self.0.stepped(law, time, s, y, rebound);
        self.1.stepped(law, time, s, y, rebound);
    }

    #[inline]
    fn ended(&mut self, state: &Self::State, times: &Times<T>) {
        self.0.ended(&state.0, times);
        self.1.ended(&state.1, times);
    }
}
