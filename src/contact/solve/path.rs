//! The whole normal motion: approach, peak, rebound, and separation or capture.

use super::damped_square::{loss_over_force, remaining_loss};
use super::interval::{Control, Course, Interval, Point, TURNING_CONTRACTION, arrive, distance_to_stop, leave, pass};
use super::nodes::Nodes;
use super::observer::Observer;
use super::strong_damping::{BALANCE_ROUNDINGS, DEEPEST, LEAST_DRAG, Stop};
use super::well;
use crate::contact::law::ContactLaw;
use crate::numbers::{NotConverged, root};
use crate::{Outcome, Real};

/// How the normal motion ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The sphere separates.
    Separation,
    /// The energy is below that of a sphere that separates at rest.
    Capture,
    /// The energy differs from that of a sphere that separates at rest by less than its error bound.
    Undecided,
    /// The number of intervals is spent.
    Budget,
    /// The method cannot represent the law.
    Unsupported,
}

/// The normal motion, in units of the scene.
#[derive(Clone, Copy, Debug)]
pub struct NormalPath<T> {
    pub(crate) end: End,
    /// Energy at separation, or where the motion was left.
    pub(crate) energy: T,
    /// Contact radius at the peak; zero where an over-damped sphere has none.
    pub(crate) peak: T,
    /// Contact radius where a captured sphere first turns back; zero where it has not been followed so far, or creeps, or comes
    /// to its equilibrium within the error allowed before it turns.
    pub(crate) turning: T,
    /// Bound of the error of e^2.
    pub(crate) error_bound: T,
    pub(crate) statistics: Statistics<T>,
}

/// A method that follows the normal motion to its end.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, FixedCost, Method};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// fn restitution(method: &impl Method<f64>) -> Result<f64, microimpact::InputError> {
///     let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
///     Ok(scene.solve(&NormalMotion::new(1.0)?, method)?.normal.overall_restitution())
/// }
/// let (exact, quick) = (restitution(&Adaptive::new(1e-9)?)?, restitution(&FixedCost::<6>::new(4)?)?);
/// assert!((exact - quick).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait Method<T: Real> {
    /// The motion under a law, in units of the impact, of a sphere that arrives with a kinetic energy.
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T>;
}

/// Roundings of the largest energy of a motion that its remaining energy may be off by.
const ROUNDINGS: f64 = 16.0;

/// Bound of the error of the remaining energy for a tolerance, a sphere that arrives with a kinetic energy, and the largest energy
/// on its way.
#[inline]
pub(crate) fn energy_bound<T: Real>(tolerance: T, kinetic: T, largest: T) -> T {
    (tolerance * kinetic).max(T::constant(ROUNDINGS) * T::EPSILON * largest)
}

/// Statistics of a solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Statistics<T> {
    pub(crate) intervals: u32,
    pub(crate) refused: u32,
    /// Evaluations of a speed or of the forces.
    pub(crate) evaluations: u32,
    /// Largest estimated error of an interval.
    pub(crate) error: T,
}

impl<T: Real> NormalPath<T> {
    /// Rebound or capture; `None` where the method found no solution.
    #[inline]
    pub(crate) fn outcome(&self) -> Option<Outcome> {
        match self.end {
            End::Separation => Some(Outcome::Rebound),
            End::Capture => Some(Outcome::Capture),
            End::Undecided => Some(Outcome::Undecided),
            End::Budget | End::Unsupported => None,
        }
    }

    /// Square of the overall restitution of a sphere that came with a kinetic energy; zero unless it rebounds.
    #[inline]
    pub(crate) fn restitution_squared(&self, energy: T) -> T {
        if self.end == End::Separation { self.energy.max(T::ZERO) / energy } else { T::ZERO }
    }

    /// That of a law that the method cannot represent.
    pub(crate) fn unsupported(energy: T) -> Self {
        let (zero, statistics) = (T::ZERO, Statistics::NONE);
        Self { end: End::Unsupported, energy, peak: zero, turning: zero, error_bound: zero, statistics }
    }
}

impl<T: Real> Statistics<T> {
    pub(crate) const NONE: Self = Self { intervals: 0, refused: 0, evaluations: 0, error: T::ZERO };

    pub(crate) fn add(&mut self, other: &Self) {
        self.intervals += other.intervals;
        self.refused += other.refused;
        self.evaluations += other.evaluations;
        self.error = self.error.max(other.error);
    }
}

/// Intervals that a motion may take where no smaller budget is given, refused ones included.
pub(crate) const MOST_INTERVALS: u32 = 320;

/// First length of an interval: half the way from first contact to the undamped peak.
const FIRST_LENGTH: f64 = 0.5;

/// Fraction of the first interval at which the potential is compared with the energy, and of the potential that the energy
/// may be: the interval ends about where adhesion has added as much energy as there was.
const PULL_FRACTION: f64 = 0.5;

/// Factor on the first length where adhesion adds more.
const PULL_SHRINK: f64 = 0.4;

/// Largest loss of the first interval, over the speed: beyond it damping stops the sphere at once.
const FIRST_DRAG: f64 = 4.0;

/// Factor on the first length where damping is stronger.
const FIRST_DRAG_SHRINK: f64 = 0.7;

/// Bound of every search by factors.
const MOST_SHRINKS: u32 = 60;

/// Factor in the search for a coordinate beyond the peak.
const PEAK_GROWTH: f64 = 1.5;

/// Fraction of the energy that counts as reached there: rounding must not push the place further.
const PEAK_ENERGY: f64 = 0.999;

/// Longest interval, over the distance in which damping alone stops the sphere.
const BRAKING_FRACTION: f64 = 0.55;

/// Part of the distance to the turning point that an interval of damped squares leaves, which the interval to it can take.
const LEFT: f64 = 0.25;

/// Largest such part for which damped squares are tried: beyond it an interval is too short to be worth it.
const MOST_LEFT: f64 = 0.7;

/// c^2 G/2 at the end of such an interval whose times or works are asked for: with a margin to what the interval to the turning point
/// may have.
const SHALLOW: f64 = 5.0;

/// Longest interval, over the distance to the undamped turning point, where the speed has a root.
pub(super) const UNDAMPED_FRACTION: f64 = 0.7;

/// Longest first interval of the rebound, over the distance to the end of contact: it leaves room for another.
const DEEPEST_DEPARTURE: f64 = 0.5;

/// A first interval of the rebound that is shorter, over the same distance, had to be shortened.
const SHALLOW_DEPARTURE: f64 = 0.4;

/// The next interval then, over the first: away from the turning point the speed is smoother.
const AFTER_SHALLOW_DEPARTURE: f64 = 4.0;

/// Square of the losses of the first interval from a turning point over that of its speed; with it iterations converge.
const LEAVING_DEPTH: f64 = 0.2;

/// Fraction of the distance to the end of contact from which an interval counts as going all the way.
const WHOLE_DEPARTURE: f64 = 0.67;

/// Energy over the potential half-way, below which such an interval would come near the branch point of the speed beyond
/// the end of contact.
const SLOW_DEPARTURE: f64 = 0.5;

/// Its length then, over the distance.
const SLOW_DEPARTURE_LENGTH: f64 = 0.6;

/// Longest interval of a captured sphere, over the distance to the guess of its turning point.
const HELD_FRACTION: f64 = 0.5;

/// Largest factor on the length of a refused interval.
pub(super) const REFUSED_SHRINK: f64 = 0.7;

/// Remaining distance to the equilibrium, in roundings of the coordinate, that counts as none.
const AT_EQUILIBRIUM_ROUNDINGS: f64 = 8.0;

/// Square of the roundings of the forces near the equilibrium, times the tolerance, that an error estimate contains.
const ROUNDING_OF_FORCES: f64 = 2e-4;

/// Amplitude of a swing over the coordinate, up to which the well is a parabola.
const LINEAR_SWING: f64 = 1e-3;

/// Guess of the turning point of such a swing, over its amplitude: a little beyond.
const BEYOND_SWING: f64 = 1.01;

/// Halvings for the guess of another turning point,
const TURNING_HALVINGS: u32 = 12;

/// and steps of Newton's method after them.
const TURNING_STEPS: u32 = 3;

/// Start of Newton's method for the equilibrium: beyond the bottom of every well without an external force.
const EQUILIBRIUM_START: f64 = 2.0;

/// Its steps; where the force is a power of the coordinate, each takes a fixed fraction off.
const EQUILIBRIUM_STEPS: u32 = 100;

/// Relative error of the length of the interval to where damping cancels the elastic force, over the tolerance: times have it too.
const RELEASE_ACCURACY: f64 = 0.1;

/// Factor on the length where nothing is known of the error.
const LENGTH_AFTER_FAILURE: f64 = 0.4;

/// Factor on the length where there is no error: about the largest otherwise.
const LENGTH_WITHOUT_ERROR: f64 = 3.0;

/// Safety factor on the length, which avoids most refusals (Hairer, Norsett and Wanner 1993, section II.4).
const LENGTH_SAFETY: f64 = 0.9;

/// Steps in which the length grows: a root without a logarithm.
const LENGTH_GROWTH: f64 = 1.2;

/// Steps in which it shrinks.
const LENGTH_SHRINK: f64 = 0.85;

/// Steps at most: factors from 0.34 to 2.7.
const LENGTH_STEPS: u32 = 6;

/// A motion in progress.
pub(crate) struct Follower<'a, T, L, O> {
    pub(crate) law: &'a L,
    pub(crate) control: Control<T>,
    pub(super) observer: &'a mut O,
    pub(crate) at: Point<T>,
    /// Where the barrier stands that holds the sphere, and the energy to pass it; zero without an external force.
    pub(crate) barrier: (T, T),
    /// Place of a barrier that the sphere does not reach, on the way in.
    in_front_of: Option<T>,
    /// Kinetic energy at first contact.
    kinetic: T,
    /// Largest kinetic energy so far.
    largest: T,
    /// Intervals that the motion may take, refused ones included.
    pub(super) most_intervals: u32,
    pub(crate) statistics: Statistics<T>,
}

impl<'a, T: Real, L: ContactLaw<T>, O: Observer<T>> Follower<'a, T, L, O> {
    pub(crate) fn from(law: &'a L, control: Control<T>, observer: &'a mut O, at: Point<T>) -> Self {
        let kinetic = T::constant(0.5) * at.speed_squared;
        let (barrier, statistics) = ((law.end(), T::ZERO), Statistics::NONE);
        let (in_front_of, largest, most_intervals) = (None, kinetic, MOST_INTERVALS);
        Self { law, control, observer, at, barrier, in_front_of, kinetic, largest, most_intervals, statistics }
    }

    /// At first contact, with a kinetic energy.
    pub(crate) fn arriving(law: &'a L, energy: T, control: Control<T>, observer: &'a mut O) -> Self {
        let at = Point::arriving(law, energy);
        let control = Control { approach: at.speed_squared, ..control };
        let mut follower = Self::from(law, control, observer, at);
        follower.barrier = well::barrier(law);
        let (surplus, uncertain) = follower.surplus();
        if law.may_have_barrier() && surplus < -uncertain {
            follower.turns_in_front();
        }
        follower
    }

    /// The sphere comes slower than the barrier is high: it turns back in front of it and has none to pass on its way out.
    fn turns_in_front(&mut self) {
        // A law that starts farther in than it ends is beyond its barrier from the beginning.
        self.in_front_of = Some(self.barrier.0).filter(|place| *place > self.at.s);
        self.barrier = (self.law.end(), T::ZERO);
    }

    /// From first contact to separation or capture.
    pub(crate) fn contact<const N: usize>(&mut self, to_turning_point: bool) -> NormalPath<T>
    where
        T: Nodes<N>,
    {
        let (energy, statistics) = (self.at.energy, self.statistics);
        let zero = T::ZERO;
        let mut path =
            NormalPath { end: End::Budget, energy, peak: zero, turning: zero, error_bound: zero, statistics };
        path.end = match self.approach::<N>() {
            Err(end) => end,
            Ok(()) => {
                path.peak = self.at.s;
                match self.rebound::<N>(to_turning_point) {
                    Ok(turning) => {
                        path.turning = turning;
                        End::Capture
                    }
                    Err(end) => end,
                }
            }
        };
        path.energy = self.at.energy;
        path.error_bound = self.surplus().1.saturating_div(self.kinetic);
        path.statistics = self.statistics;
        path
    }

    /// Energy beyond that of a sphere that separates at rest, and the bound of its error: twice as large where a barrier has to be
    /// passed, whose height is as inexact.
    #[inline]
    fn surplus(&self) -> (T, T) {
        let bound = energy_bound(self.control.error, self.kinetic, self.largest);
        let barred = self.law.may_have_barrier() && self.barrier.0 > self.law.end();
        (self.at.energy - self.barrier.1, if barred { bound + bound } else { bound })
    }

    /// Whether the sphere cannot escape any more.
    #[inline]
    fn is_held(&self) -> bool {
        let (surplus, uncertain) = self.surplus();
        surplus < -uncertain && self.at.s >= self.barrier.0
    }

    /// Whether a peak lies in front of a barrier, beyond doubt.
    #[inline]
    fn turned_back_outside(&self, peak: T) -> bool {
        let (surplus, uncertain) = self.surplus();
        peak < self.barrier.0 && surplus < -uncertain
    }

    /// Energy beyond that of the barrier, where an interval passes it on the way in.
    #[inline(never)]
    fn surplus_at_barrier<const N: usize>(&self, interval: &Interval<T, N>) -> T {
        let ((place, height), end) = (self.barrier, interval.end);
        let (mut before, mut after) = ((self.at.s, self.at.energy), (end.s, end.energy));
        for (&s, &y) in interval.s.iter().zip(&interval.y) {
            let energy = T::constant(0.5) * y * y + self.law.potential(s);
            if s <= place && s > before.0 {
                before = (s, energy);
            } else if s > place && s < after.0 {
                after = (s, energy);
            }
        }
        before.1 + (after.1 - before.1) * (place - before.0) / (after.0 - before.0) - height
    }

    /// How the motion ends where no interval is short enough to go on, or none is left.
    fn stuck(&self, course: Course) -> End {
        let (surplus, uncertain) = self.surplus();
        if self.is_held() {
            End::Capture
        } else if surplus <= uncertain && (course.rebound || -surplus <= uncertain) && well::well(self.law).is_some() {
            // Losses can only bring it further down.
            End::Undecided
        } else {
            End::Budget
        }
    }

    /// From first contact to the peak; `Err` where the motion ends without one.
    pub(crate) fn approach<const N: usize>(&mut self) -> Result<(), End>
    where
        T: Nodes<N>,
    {
        let half = T::constant(0.5);
        let mut beyond = self.undamped_peak();
        let mut length = T::constant(FIRST_LENGTH);
        loop {
            if self.law.may_have_barrier()
                && let Some(place) = self.in_front_of
            {
                beyond = self.turning_point_in_front(place);
            }
            // Without an external force no peak lies beyond one.
            let farthest = if self.law.may_have_barrier() { beyond } else { T::ONE };
            if self.at.s > self.law.start() || self.takes_whole_phases(beyond, Course::APPROACH) {
                let arrival = self.arrive::<N>(beyond, Course::APPROACH);
                if self.take(&arrival, Course::APPROACH, Some(arrival.end.s))? {
                    return Ok(());
                }
                if self.is_held()
                    && (self.creeps(self.at.s, self.at.speed_squared.sqrt(), Course::APPROACH)
                        || self.is_at_equilibrium(self.rounding_of_forces()))
                {
                    return Err(End::Capture);
                }
                length = self.braked_length(length, arrival.end.s);
            } else {
                length = self.first_length();
            }
            if self.control.approach > T::ZERO
                && let Some(accepted) = self.pass_strongly_damped::<N>(beyond)?
            {
                if accepted {
                    continue;
                }
                length = self.braked_length(length, beyond);
            }
            loop {
                if self.law.may_have_barrier()
                    && let Some(place) = self.in_front_of
                {
                    length = length.min(half * (place - self.at.s));
                }
                let interval = self.pass::<N>(length, Course::APPROACH);
                let factor = self.length_factor(N, &interval);
                if self.take(&interval, Course::APPROACH, None)? {
                    length = (length * factor).min(farthest - self.at.s * half);
                    break;
                }
                length = length * factor.min(T::constant(REFUSED_SHRINK));
                if length <= T::EPSILON * T::EPSILON {
                    return Err(self.stuck(Course::APPROACH));
                }
                if self.is_held() && self.is_at_equilibrium(self.rounding_of_forces()) {
                    return Err(End::Capture);
                }
            }
        }
    }

    /// Where the potential in front of a barrier equals the energy, or a little beyond.
    fn turning_point_in_front(&self, place: T) -> T {
        let (mut below, mut above) = (self.at.s, place);
        for _ in 0..TURNING_HALVINGS {
            let middle = (below + above) * T::constant(0.5);
            if self.law.potential(middle) < self.at.energy {
                below = middle;
            } else {
                above = middle;
            }
        }
        above
    }

    /// A contact radius that the energy does not reach.
    pub(crate) fn undamped_peak(&self) -> T {
        let mut beyond = T::ONE;
        for _ in 0..MOST_SHRINKS {
            if self.law.potential(beyond) >= self.at.energy * T::constant(PEAK_ENERGY) {
                break;
            }
            beyond = beyond * T::constant(PEAK_GROWTH);
        }
        beyond
    }

    /// The first interval is short if the pull of adhesion outgrows the initial energy, or if damping takes it at once.
    fn first_length(&self) -> T {
        let half = T::constant(0.5);
        let (start, energy, speed) = (self.at.s, half * self.at.speed_squared, self.at.speed_squared.sqrt());
        let way = T::ONE - start;
        let (mut length, fraction) = (T::constant(FIRST_LENGTH) * way, T::constant(PULL_FRACTION));
        for _ in 0..MOST_SHRINKS {
            let rise = self.law.potential(start + fraction * length) - self.law.potential(start);
            if energy >= fraction * rise.abs() {
                break;
            }
            length = length * T::constant(PULL_SHRINK);
        }
        for _ in 0..MOST_SHRINKS {
            if self.law.loss(start + length, false) * length <= T::constant(FIRST_DRAG) * speed {
                break;
            }
            length = length * T::constant(FIRST_DRAG_SHRINK);
        }
        length
    }

    /// No interval goes beyond the undamped turning point, nor more than half way to where drag alone stops the sphere.
    fn braked_length(&self, length: T, undamped_turning_point: T) -> T {
        let (speed, loss) = (self.at.speed_squared.sqrt(), self.law.loss(self.at.s, false));
        let mut length = length;
        if undamped_turning_point > self.at.s {
            length = length.min(T::constant(UNDAMPED_FRACTION) * (undamped_turning_point - self.at.s));
        }
        let reach = T::constant(BRAKING_FRACTION) * speed;
        if loss * length > reach {
            length = reach / loss;
        }
        length
    }

    /// Tries intervals of damped squares on the way in, ever shorter ones along a path that is quadratic towards the turning point, where
    /// the speed has a root. Whether one was accepted; `None` where damping is too weak, or the turning point near enough.
    fn pass_strongly_damped<const N: usize>(&mut self, beyond: T) -> Result<Option<bool>, End>
    where
        T: Nodes<N>,
    {
        let (law, course, at) = (self.law, Course::APPROACH, self.at);
        let Some(stop) = Stop::damped(law, &at, beyond, course) else {
            return Ok(None);
        };
        let within = stop.square - T::constant(2.0 * SHALLOW) / (stop.ratio * stop.ratio);
        if within <= T::ZERO {
            return Ok(None);
        }
        let shallow = T::ONE - distance_to_stop(law, at.s, within, at.s + stop.distance) / stop.distance;
        let speed = at.speed_squared.max(T::ZERO).sqrt();
        let (mut accepted, mut left) = (None, T::constant(LEFT).max(shallow));
        while left < T::constant(MOST_LEFT) {
            let part = T::ONE - left.sqrt();
            let (first, second) = (T::constant(2.0) * part * stop.distance, -(part * part * stop.distance));
            let length = first + second;
            let remaining = |s: T| remaining_loss(law, stop.ratio, s, course).abs();
            let remaining = remaining(at.s).max(remaining(at.s + T::constant(0.5) * length));
            if remaining * length > T::constant(BRAKING_FRACTION) * speed * (T::ONE + stop.ratio * speed) {
                break;
            }
            let evaluations = &mut self.statistics.evaluations;
            let mut interval: Interval<T, N> =
                pass(self.law, &self.at, (first, second), course, &self.control, evaluations);
            self.check(&mut interval);
            let factor = self.length_factor(N, &interval);
            accepted = Some(self.take(&interval, course, None)?);
            if accepted == Some(true) {
                break;
            }
            left = T::ONE - (T::ONE - left) * factor.min(T::constant(REFUSED_SHRINK));
        }
        Ok(accepted)
    }

    /// From the peak to separation (`Err`) or to the turning point of a captured sphere (`Ok`, zero if not followed).
    fn rebound<const N: usize>(&mut self, to_turning_point: bool) -> Result<T, End>
    where
        T: Nodes<N>,
    {
        let (peak, outermost) = (self.at.s, self.law.end());
        let captured = self.is_held();
        if (captured && !to_turning_point) || self.creeps(peak, T::ZERO, Course::REBOUND) {
            return Ok(T::ZERO);
        }
        // An interval ends on a barrier, where the energy decides; beyond it nothing holds the sphere. Nor does anything hold one
        // that turned back in front of it.
        let mut passed = self.turned_back_outside(peak);
        let distance = peak - outermost;
        let whole = self.takes_whole_phases(peak, Course::REBOUND);
        let depth = self.leave_peak::<N>(if whole { distance } else { T::constant(DEEPEST_DEPARTURE) * distance })?;
        if depth == distance {
            self.at.s = outermost;
        }
        let mut length = if depth < T::constant(SHALLOW_DEPARTURE) * distance {
            T::constant(AFTER_SHALLOW_DEPARTURE) * depth
        } else {
            self.at.s - outermost
        };
        let mut overreached = false;
        while self.at.s > outermost {
            if !passed && self.barrier.0 > outermost && self.at.s <= self.barrier.0 {
                let (surplus, uncertain) = self.surplus();
                if surplus <= uncertain {
                    return if self.is_held() { Ok(T::ZERO) } else { Err(End::Undecided) };
                }
                passed = true;
            }
            if self.is_held() {
                if !to_turning_point || self.creeps(self.at.s, self.at.speed_squared.sqrt(), Course::REBOUND) {
                    return Ok(T::ZERO);
                }
                let guess = self.outer_turning_point();
                let arrival = self.arrive::<N>(guess, Course::REBOUND);
                if self.take(&arrival, Course::REBOUND, Some(arrival.end.s))? {
                    return Ok(self.at.s);
                }
                if self.is_at_equilibrium(self.control.error.max(T::constant(AT_EQUILIBRIUM_ROUNDINGS) * T::EPSILON)) {
                    return Ok(T::ZERO);
                }
                length = T::constant(HELD_FRACTION) * (self.at.s - guess);
                // Nor to where damping alone stops the sphere.
                let (speed, loss) = (self.at.speed_squared.sqrt(), self.law.loss(self.at.s, true));
                if loss * length > speed {
                    length = speed / loss;
                }
            } else {
                length = self.departing_length(length);
            }
            let mut refused = false;
            loop {
                let to_the_end = length >= self.at.s - outermost;
                let step = if to_the_end { outermost - self.at.s } else { -length };
                let interval = self.pass::<N>(step, Course::REBOUND);
                let factor = self.length_factor(N, &interval);
                if interval.accepted && self.is_released(&interval.end) {
                    let pass = |follower: &mut Self, length| follower.pass::<N>(length, Course::REBOUND);
                    return Err(self.release::<N>((step, &interval.end), None, pass));
                }
                if self.take(&interval, Course::REBOUND, None)? {
                    length = length * factor;
                    if !refused {
                        length = self.relaxing_length(length, (!overreached).then_some(self.at.s - outermost));
                    }
                    if to_the_end {
                        self.at.s = outermost;
                    }
                    break;
                }
                refused = true;
                overreached |= self.is_balanced();
                length = length * factor.min(T::constant(REFUSED_SHRINK));
                if length <= T::EPSILON * T::EPSILON {
                    return if self.is_held() { Ok(T::ZERO) } else { Err(self.stuck(Course::REBOUND)) };
                }
                if !passed && self.is_undecided() {
                    return Err(End::Undecided);
                }
                if self.is_held() && self.is_at_equilibrium(self.rounding_of_forces().max(self.control.error)) {
                    return Ok(T::ZERO);
                }
            }
        }
        let (surplus, uncertain) = self.surplus();
        if self.is_held() {
            Ok(T::ZERO)
        } else {
            // Where the potential has no minimum nothing holds the sphere, however little energy remains.
            let separates = passed || surplus > uncertain || well::well(self.law).is_none();
            Err(if separates { End::Separation } else { End::Undecided })
        }
    }

    /// Whether nothing remains of the loss from first contact to a place near the peak, and nothing but the end of the motion is asked for:
    /// then damped squares know the speed anywhere, whatever the nodes resolve.
    fn takes_whole_phases(&self, peak: T, course: Course) -> bool {
        let (law, control) = (self.law, &self.control);
        let ratio = loss_over_force(law, peak, course);
        let half_way = T::constant(0.5) * (peak + law.start());
        control.approach > T::ZERO
            && !control.observed
            && !law.may_have_barrier()
            && law.release_speed(peak).is_none()
            && ratio.abs() * control.approach.sqrt() > T::constant(LEAST_DRAG)
            && remaining_loss(law, ratio, half_way, course) == T::ZERO
    }

    /// How far the speed of a rebound is from that at which force and damping are equal, as 1 + c y; with c. `None` where damping is weak,
    /// or not in proportion to the force.
    fn distance_from_balance(&self) -> Option<(T, T)> {
        let (law, at, course) = (self.law, self.at, Course::REBOUND);
        if self.control.approach <= T::ZERO {
            return None;
        }
        let ratio = loss_over_force(law, at.s, course);
        let drag = -ratio * at.speed_squared.max(T::ZERO).sqrt();
        let half_way = T::constant(0.5) * (at.s + law.end());
        let hunt_crossley = drag > T::constant(LEAST_DRAG) && remaining_loss(law, ratio, half_way, course) == T::ZERO;
        hunt_crossley.then_some((T::ONE - drag, ratio))
    }

    /// Whether a rebound goes on at the speed of balance, but for less than the tolerance.
    fn is_balanced(&self) -> bool {
        let least = self.control.error.max(T::constant(BALANCE_ROUNDINGS) * T::EPSILON);
        self.distance_from_balance().is_some_and(|(distance, _)| distance.abs() < least)
    }

    /// The next interval of a rebound. Where the speed tends to that of balance, it does so as e^w, of which the nodes resolve so much;
    /// once it has, one interval takes `all` that remains, if what is observed allows it.
    fn relaxing_length(&self, length: T, all: Option<T>) -> T {
        match self.distance_from_balance() {
            None => length,
            Some(_) if self.is_balanced() => all.unwrap_or(length),
            Some((_, ratio)) => T::constant(DEEPEST) / (ratio * ratio * self.law.slope(self.at.s)),
        }
    }

    /// Whether contact has ended because damping cancels the elastic force.
    #[inline]
    fn is_released(&self, at: &Point<T>) -> bool {
        self.law.release_speed(at.s).is_some_and(|most| at.speed_squared > most * most)
    }

    /// Goes on to where damping cancels the elastic force, in front of the end of an interval of the signed length `farthest`.
    fn release<const N: usize>(
        &mut self,
        (farthest, beyond): (T, &Point<T>),
        turning_point: Option<T>,
        interval_of: impl Fn(&mut Self, T) -> Interval<T, N>,
    ) -> End
    where
        T: Nodes<N>,
    {
        let law = self.law;
        let excess = |at: &Point<T>| at.speed_squared.max(T::ZERO).sqrt() - law.release_speed(at.s).unwrap_or(T::ZERO);
        let ends = ((T::ZERO, excess(&self.at)), (farthest, excess(beyond)));
        let tolerance = T::constant(RELEASE_ACCURACY) * self.control.error;
        let length = root(ends.0, ends.1, tolerance, |length| Ok(excess(&interval_of(self, length).end)));
        let Ok::<_, NotConverged>(length) = length else {
            return End::Budget;
        };
        let interval = interval_of(self, length);
        match self.take(&interval, Course::REBOUND, turning_point) {
            Ok(true) => {
                // What the materials have not given back by then remains in them.
                self.at.energy = T::constant(0.5) * self.at.speed_squared;
                End::Separation
            }
            Ok(false) => self.stuck(Course::REBOUND),
            Err(end) => end,
        }
    }

    /// Whether what is left to lose on the way out cannot decide between rebound and capture.
    fn is_undecided(&self) -> bool {
        let (surplus, uncertain) = self.surplus();
        let farther = (self.at.s - self.barrier.0).max(T::ZERO);
        let loss = self.law.loss(self.at.s, true) * self.at.speed_squared.max(T::ZERO).sqrt() * farther;
        surplus.abs() <= uncertain && loss <= uncertain && well::well(self.law).is_some()
    }

    /// The first interval of the rebound, no deeper than `deepest`; its depth.
    #[inline]
    pub(crate) fn leave_peak<const N: usize>(&mut self, deepest: T) -> Result<T, End>
    where
        T: Nodes<N>,
    {
        self.leave_turning_point::<N>(deepest, Course::REBOUND)
    }

    /// The first interval from a turning point, no longer than `longest`; its length.
    pub(crate) fn leave_turning_point<const N: usize>(&mut self, longest: T, course: Course) -> Result<T, End>
    where
        T: Nodes<N>,
    {
        let signed = |length: T| if course.rebound { length } else { -length };
        let from = self.at.s;
        let mut depth = longest;
        let ratio = loss_over_force(self.law, from, course);
        if !course.reversed && ratio < T::ZERO && self.control.approach > T::ZERO {
            let exact = remaining_loss(self.law, ratio, from - signed(longest), course) == T::ZERO;
            if self.control.observed || !exact {
                depth = depth.min(T::constant(DEEPEST) / (ratio * ratio * signed(self.law.slope(from))));
            }
        }
        // The error that an iteration leaves grows with the root of the depth. Damped squares may do without this limit.
        let reach = T::constant(2.0 * TURNING_CONTRACTION) * self.law.loss(from, course.rebound);
        let stiffness = T::constant(LEAVING_DEPTH) * signed(self.law.slope(from));
        let limit = if reach * reach * depth > stiffness { stiffness / (reach * reach) } else { depth };
        let leave_by = |follower: &mut Self, depth: T| {
            let (energy, evaluations) = (follower.at.energy, &mut follower.statistics.evaluations);
            let mut interval: Interval<T, N> =
                leave(follower.law, from, signed(depth), energy, course, &follower.control, evaluations);
            follower.check(&mut interval);
            interval
        };
        let mut first = true;
        loop {
            let interval = leave_by(self, depth);
            let factor = self.length_factor(N, &interval);
            if course.rebound && interval.accepted && self.is_released(&interval.end) {
                return Err(self.release::<N>((depth, &interval.end), Some(from), leave_by));
            }
            if self.take(&interval, course, Some(from))? {
                return Ok(depth);
            }
            if first && interval.error >= T::ONE {
                depth = depth.min(limit);
            } else {
                depth = depth * factor.min(T::constant(REFUSED_SHRINK));
            }
            first = false;
            if depth <= T::EPSILON * T::EPSILON {
                return Err(End::Budget);
            }
        }
    }

    /// To separation at once, unless the speed has a singularity (where V = -E) nearer than half the way.
    fn departing_length(&self, length: T) -> T {
        let half = T::constant(0.5);
        let s = self.at.s;
        if s > self.barrier.0 && self.barrier.0 > self.law.end() {
            // Nothing may be jumped: whether the barrier is passed is seen on it.
            return length.min(s - self.barrier.0);
        }
        let distance = s - self.law.end();
        let length = length.min(distance);
        let half_way = s - half * distance;
        if length >= T::constant(WHOLE_DEPARTURE) * distance
            && self.at.energy < T::constant(SLOW_DEPARTURE) * self.law.potential(half_way).abs()
            && !self.is_balanced()
        {
            return T::constant(SLOW_DEPARTURE_LENGTH) * distance;
        }
        length
    }

    /// Where the potential equals the energy of a captured sphere, at its outermost point.
    pub(crate) fn outer_turning_point(&self) -> T {
        let (s, energy) = (self.at.s, self.at.energy);
        let (slope, curvature) = (self.law.slope(s), self.law.curvature(s).max(T::SMALLEST));
        let distance = slope / curvature;
        let swing = (distance * distance + self.at.speed_squared / curvature).sqrt();
        if swing <= T::constant(LINEAR_SWING) * s {
            // So close to the bottom energies hardly differ, but forces do: a little beyond the turning point of a linear swing.
            return s - distance - T::constant(BEYOND_SWING) * swing;
        }
        let (mut below, mut above) = (self.law.end(), s);
        for _ in 0..TURNING_HALVINGS {
            let middle = (below + above) * T::constant(0.5);
            if self.law.potential(middle) > energy {
                below = middle;
            } else {
                above = middle;
            }
        }
        let mut turning = above;
        if self.law.slope(turning) > T::ZERO {
            // Too close to the bottom to be told apart by halving: as far on its other side.
            let curvature = self.law.curvature(turning).max(T::SMALLEST);
            turning = turning - T::constant(2.0) * self.law.slope(turning) / curvature;
        }
        for _ in 0..TURNING_STEPS {
            let slope = self.law.slope(turning);
            if slope < T::ZERO {
                let next = turning - (self.law.potential(turning) - energy) / slope;
                if next > self.law.end() && next < s {
                    turning = next;
                }
            }
        }
        turning
    }

    /// An interval of a signed length, away from turning points.
    #[inline]
    pub(crate) fn pass<const N: usize>(&mut self, length: T, course: Course) -> Interval<T, N>
    where
        T: Nodes<N>,
    {
        let (polynomial, evaluations) = ((length, T::ZERO), &mut self.statistics.evaluations);
        let mut interval = pass(self.law, &self.at, polynomial, course, &self.control, evaluations);
        self.check(&mut interval);
        interval
    }

    /// The interval to the turning point ahead.
    #[inline]
    pub(crate) fn arrive<const N: usize>(&mut self, guess: T, course: Course) -> Interval<T, N>
    where
        T: Nodes<N>,
    {
        let evaluations = &mut self.statistics.evaluations;
        let mut interval = arrive(self.law, &self.at, guess, course, &self.control, evaluations);
        self.check(&mut interval);
        interval
    }

    /// Takes in the error of what is observed.
    #[inline]
    fn check<const N: usize>(&self, interval: &mut Interval<T, N>)
    where
        T: Nodes<N>,
    {
        if O::DEMANDS && interval.accepted {
            interval.error = interval.error.max(self.observer.error(self.law, interval, self.control.error));
            interval.accepted = interval.error <= self.control.error;
        }
    }

    /// Goes on to the end of an interval if it is accepted; `turning_point` is that of an interval that has one.
    #[inline]
    pub(crate) fn take<const N: usize>(
        &mut self,
        interval: &Interval<T, N>,
        course: Course,
        turning_point: Option<T>,
    ) -> Result<bool, End>
    where
        T: Nodes<N>,
    {
        let enters = !course.rebound && self.law.may_have_barrier() && interval.accepted;
        if enters && self.at.s < self.barrier.0 && interval.end.s > self.barrier.0 {
            let (surplus, uncertain) = (self.surplus_at_barrier(interval), self.surplus().1);
            if surplus < -uncertain {
                self.turns_in_front();
                self.statistics.refused += 1;
                return Ok(false);
            } else if surplus <= uncertain {
                return Err(End::Undecided);
            }
        }
        if !interval.accepted {
            // An arrival that is refused beforehand costs nothing; there is one at most for each interval taken.
            let tried = interval.forward || interval.error < T::ONE;
            self.statistics.refused += u32::from(tried);
        } else {
            self.statistics.intervals += 1;
            self.statistics.error = self.statistics.error.max(interval.error);
            let (from, to) = (self.at.s, interval.end.s);
            match self.observer.kink() {
                Some(kink) if from.min(to) < kink && kink < from.max(to) => {
                    self.show_divided(interval, course, turning_point, kink);
                }
                _ => self.show(interval, course, turning_point),
            }
            let middle = interval.y.get(N / 2).copied().unwrap_or(T::ZERO);
            let largest = interval.end.speed_squared.max(middle * middle);
            self.largest = self.largest.max(T::constant(0.5) * largest);
            self.at = interval.end;
        }
        if self.statistics.intervals + self.statistics.refused >= self.most_intervals {
            return Err(self.stuck(course));
        }
        Ok(interval.accepted)
    }

    /// Shows an interval to the observer, in two parts if the sphere begins to roll in it.
    #[inline]
    pub(super) fn show<const N: usize>(&mut self, interval: &Interval<T, N>, course: Course, turning_point: Option<T>)
    where
        T: Nodes<N>,
    {
        let roll = if O::EVENTS { self.observer.rolls_at(self.law, interval) } else { None };
        match roll {
            Some(z) => self.split(interval, course, turning_point, z),
            None => self.observer.observe(self.law, interval, course.rebound),
        }
    }

    /// By how much the next interval may be longer, from 0.3 to 3: (allowed error/error)^(1/2N).
    pub(crate) fn length_factor<const N: usize>(&self, nodes: usize, interval: &Interval<T, N>) -> T {
        let (error, allowed) = (interval.error, self.control.error);
        if error >= T::ONE {
            return T::constant(LENGTH_AFTER_FAILURE);
        }
        if error <= T::ZERO {
            return T::constant(LENGTH_WITHOUT_ERROR);
        }
        let grows = allowed > error;
        let (ratio, step, inverse) = if grows {
            (allowed.saturating_div(error), T::constant(LENGTH_GROWTH), T::constant(LENGTH_GROWTH))
        } else {
            (error.saturating_div(allowed), T::constant(LENGTH_SHRINK), T::constant(1.0 / LENGTH_SHRINK))
        };
        let mut power = T::ONE;
        for _ in 0..2 * nodes {
            power = power * inverse;
        }
        let (mut ratio, mut factor) = (ratio, T::constant(LENGTH_SAFETY));
        for _ in 0..LENGTH_STEPS {
            if ratio <= power {
                break;
            }
            ratio = ratio / power;
            factor = factor * step;
        }
        factor
    }

    /// Whether a sphere at s with speed y creeps to its equilibrium without ever passing it.
    ///
    /// The line y = (d/2) |x_eq - x| with d^2 >= 4 k, d the least damping and k the greatest stiffness on the way, can be
    /// crossed towards the equilibrium only.
    #[inline(never)]
    pub(crate) fn creeps(&self, s: T, y: T, course: Course) -> bool {
        let law = self.law;
        // On the way out the equilibrium lies nearer than first contact, so the secant below is at least this steep.
        let strength = law.damping(s, course.rebound);
        let steepest = T::constant(4.0) * law.slope(s);
        let farthest = law.indentation(s) - law.indentation(law.end());
        if course.rebound && strength * strength * farthest * law.indentation_slope(s) <= steepest {
            return false;
        }
        let Some(equilibrium) = self.equilibrium() else {
            return false;
        };
        if (s < equilibrium) == course.rebound {
            return false;
        }
        let damping = |s: T| law.damping(s, course.rebound);
        let distance = law.indentation(equilibrium) - law.indentation(s);
        let slope = law.indentation_slope(equilibrium);
        let stiffness = law.curvature(equilibrium) / (slope * slope);
        let secant = if distance == T::ZERO { T::ZERO } else { -(law.slope(s) / law.indentation_slope(s) / distance) };
        let least = damping(s).min(damping(equilibrium));
        least * least > T::constant(4.0) * stiffness.max(secant) && y < T::constant(0.5) * least * distance.abs()
    }

    /// Whether what is left of the way is less than a relative distance. Damped critically but for some percent, a sphere comes as
    /// close as the error allowed to its equilibrium before it turns.
    #[inline(never)]
    fn is_at_equilibrium(&self, distance: T) -> bool {
        let s = self.at.s;
        let close = s * distance;
        let reach = self.law.loss(s, true) * close;
        self.at.speed_squared <= reach * reach
            && self.equilibrium().is_some_and(|equilibrium| (s - equilibrium).abs() <= close)
    }

    /// Relative distance from the equilibrium within which the forces are hardly more than their rounding: errors are, squared, what
    /// that makes of them, and no interval is short enough.
    fn rounding_of_forces(&self) -> T {
        (T::constant(ROUNDING_OF_FORCES) / self.control.error).sqrt() * T::EPSILON
    }

    /// Contact radius at which the forces balance: the minimum of the potential, by Newton's method from above.
    pub(crate) fn equilibrium(&self) -> Option<T> {
        let mut s = T::constant(EQUILIBRIUM_START);
        if self.law.may_have_barrier() {
            // An external force may also hold the sphere beyond.
            for _ in 0..MOST_SHRINKS {
                if well::is_beyond_bottom(self.law, s, self.law.slope(s), self.law.curvature(s)) {
                    break;
                }
                s = s + s;
            }
        }
        for _ in 0..EQUILIBRIUM_STEPS {
            let curvature = self.law.curvature(s);
            if curvature <= T::ZERO {
                return None;
            }
            let step = self.law.slope(s) / curvature;
            s = s - step;
            if s - self.law.end() <= T::EPSILON {
                return None;
            }
            if step.abs() <= T::EPSILON * s {
                break;
            }
        }
        Some(s)
    }
}
