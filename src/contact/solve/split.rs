//! Intervals in which the sphere begins to roll, solved in two parts, so that what is observed keeps the full order.
//!
//! The speed vanishes at a turning point. Close to it the rate of time is one over a small speed: a part that ends there is exact
//! only if it is solved from the turning point on, where the speed is a sum of positive terms, and if it is short.

use super::interval::{Control, Course, Interval, Point, leave, pass};
use super::nodes::Nodes;
use super::observer::Observer;
use super::path::Follower;
use crate::Real;
use crate::contact::law::ContactLaw;

/// Times that an interval may be solved anew to find where the sphere begins to roll.
const MOST_SPLITS: u32 = 40;

/// Residual of the end of sliding, over the root of the tolerance and the length, at which the search ends: the last step is
/// applied to first order, so that an error of its square remains.
const CLOSE_TO_END_OF_SLIP: f64 = 0.03;

/// Distance from a turning point, as a fraction of an interval that leads there, within which the end of sliding is looked for in
/// an interval of that length alone.
const NEAR_TURNING_POINT: f64 = 0.3;

/// A part of an interval, up to where the sphere may begin to roll.
pub(crate) struct FirstPart<T, const N: usize> {
    pub(crate) interval: Interval<T, N>,
    /// Time for each dz of the whole interval where the part ends.
    pub(crate) rate: T,
}

/// The part of an interval up to where the sphere begins to roll, and the time by which it ends too late; from a first value of
/// the fraction of the interval.
pub(crate) fn find_end_of_slip<T: Nodes<N>, const N: usize>(
    law: &impl ContactLaw<T>,
    observer: &impl Observer<T>,
    fraction: T,
    tolerance: T,
    mut part: impl FnMut(T) -> FirstPart<T, N>,
) -> (T, Interval<T, N>, T) {
    let close = T::constant(CLOSE_TO_END_OF_SLIP) * tolerance.sqrt();
    let (mut z, mut before, mut after) = (fraction, T::ZERO, T::ONE);
    let mut tries = 0;
    loop {
        let first = part(z);
        let late = observer.residual(law, &first.interval);
        let step = late / first.rate;
        tries += 1;
        if step.abs() <= close * z || tries == MOST_SPLITS {
            return (z, first.interval, late);
        }
        // Newton's step, held between the places known to come before and after.
        if late > T::ZERO {
            after = z;
        } else {
            before = z;
        }
        let tried = z;
        z = z - step;
        if !(z > before && z < after) {
            z = T::constant(0.5) * (before + after);
        }
        if z <= before || z >= after {
            return (tried, first.interval, late);
        }
    }
}

/// An interval with a turning point, divided at a distance from it: s = peak - depth z^2.
struct Turning<'a, T, L> {
    law: &'a L,
    control: &'a Control<T>,
    peak: T,
    depth: T,
    /// Energy at the turning point.
    energy: T,
    /// Away from the turning point: against time where the interval leads there.
    course: Course,
}

impl<'a, T: Real, L: ContactLaw<T>> Turning<'a, T, L> {
    /// A whole interval `from` a point, which leads to or from a turning point at the `peak`.
    fn of<const N: usize>(
        law: &'a L,
        from: &Point<T>,
        whole: &Interval<T, N>,
        course: Course,
        peak: T,
        control: &'a Control<T>,
    ) -> Self {
        let arrives = from.s != peak;
        let (depth, energy) =
            if arrives { (peak - from.s, whole.end.energy) } else { (peak - whole.end.s, from.energy) };
        Self { law, control, peak, depth, energy, course: Course { reversed: arrives, ..course } }
    }

    /// The part from the turning point to z.
    fn near<const N: usize>(&self, z: T, evaluations: &mut u32) -> Interval<T, N>
    where
        T: Nodes<N>,
    {
        let part = leave(self.law, self.peak, self.depth * z * z, self.energy, self.course, self.control, evaluations);
        Interval { forward: !self.course.reversed, ..part }
    }

    /// The part from z, where the sphere is in the `middle`, to 1.
    fn far<const N: usize>(&self, middle: &Point<T>, z: T, evaluations: &mut u32) -> Interval<T, N>
    where
        T: Nodes<N>,
    {
        let rest = T::ONE - z;
        let polynomial = (-(T::constant(2.0) * self.depth * z * rest), -(self.depth * rest * rest));
        let part = pass(self.law, middle, polynomial, self.course, self.control, evaluations);
        if self.course.reversed { Interval { forward: false, end: *middle, ..part } } else { part }
    }
}

/// The path of an interval away from turning points: s + first z + second z^2.
struct Along<T> {
    first: T,
    second: T,
}

impl<T: Real> Along<T> {
    fn of<const N: usize>(from: T, whole: &Interval<T, N>) -> Self
    where
        T: Nodes<N>,
    {
        let length = whole.end.s - from;
        let (z, s) = T::Z.iter().zip(&whole.s).nth(N / 2).map_or((T::ONE, from), |(z, s)| (*z, *s));
        let second = (length * z - (s - from)) / (z * (T::ONE - z) + T::SMALLEST);
        let second = if second.abs() <= T::EPSILON.sqrt() * length.abs() { T::ZERO } else { second };
        Self { first: length - second, second }
    }

    /// Where the path has gone so far.
    fn place(&self, gone: T) -> T {
        let root = (self.first * self.first + T::constant(4.0) * self.second * gone).max(T::ZERO).sqrt();
        (gone + gone) / if self.first < T::ZERO { self.first - root } else { self.first + root }
    }

    /// The path up to z, on 0..1.
    fn until(&self, z: T) -> (T, T) {
        (self.first * z, self.second * z * z)
    }

    /// The path from z on.
    fn after(&self, z: T) -> (T, T) {
        let rest = T::ONE - z;
        ((self.first + T::constant(2.0) * self.second * z) * rest, self.second * rest * rest)
    }
}

impl<T: Real, L: ContactLaw<T>, O: Observer<T>> Follower<'_, T, L, O> {
    /// An interval that is already accepted is not refused for the parts that it is divided into.
    fn unlimited(&self) -> Control<T> {
        Control { error: T::ONE / T::EPSILON, times: T::ZERO, ..self.control }
    }

    /// Shows an interval in two parts, before and after a `place`, in the order of time.
    #[inline(never)]
    pub(super) fn show_divided<const N: usize>(
        &mut self,
        whole: &Interval<T, N>,
        course: Course,
        turning_point: Option<T>,
        place: T,
    ) where
        T: Nodes<N>,
    {
        let (from, control, law) = (self.at, self.unlimited(), self.law);
        let mut evaluations = 0;
        let [first, second]: [Interval<T, N>; 2] = match turning_point {
            None => {
                let along = Along::of(from.s, whole);
                let z = along.place(place - from.s);
                let first: Interval<T, N> = pass(law, &from, along.until(z), course, &control, &mut evaluations);
                [first, pass(law, &first.end, along.after(z), course, &control, &mut evaluations)]
            }
            Some(peak) => {
                let turning = Turning::of(law, &from, whole, course, peak, &control);
                let z = ((peak - place) / turning.depth).sqrt();
                let near: Interval<T, N> = turning.near(z, &mut evaluations);
                let far: Interval<T, N> = turning.far(&near.end, z, &mut evaluations);
                if turning.course.reversed {
                    [Interval { end: near.end, ..far }, Interval { end: whole.end, ..near }]
                } else {
                    [near, far]
                }
            }
        };
        self.statistics.evaluations += evaluations;
        let to_turning_point = turning_point.filter(|peak| from.s != *peak);
        self.show(&first, course, if to_turning_point.is_some() { None } else { turning_point });
        self.at = first.end;
        self.show(&second, course, to_turning_point);
        self.at = from;
    }

    /// Shows an interval in two parts, before and after the sphere begins to roll about at z, in the order of time.
    #[inline(never)]
    pub(super) fn split<const N: usize>(
        &mut self,
        whole: &Interval<T, N>,
        course: Course,
        turning_point: Option<T>,
        z: T,
    ) where
        T: Nodes<N>,
    {
        let control = self.unlimited();
        match turning_point {
            None => self.split_passage(whole, course, z, &control),
            Some(peak) => {
                let turning = Turning::of(self.law, &self.at, whole, course, peak, &control);
                self.split_turning(whole, turning, z);
            }
        }
    }

    /// Away from turning points.
    fn split_passage<const N: usize>(&mut self, whole: &Interval<T, N>, course: Course, z: T, control: &Control<T>)
    where
        T: Nodes<N>,
    {
        let (law, from, along) = (self.law, self.at, Along::of(self.at.s, whole));
        let evaluations = &mut self.statistics.evaluations;
        let (z, first, late) = find_end_of_slip(law, self.observer, z, self.control.error, |z| {
            let interval: Interval<T, N> = pass(law, &from, along.until(z), course, control, evaluations);
            FirstPart { rate: interval.rate.last().copied().unwrap_or(T::ZERO) / z, interval }
        });
        let mut middle = first.end;
        if course.rebound && middle.speed_squared < T::ZERO {
            middle.energy = whole.end.energy;
        }
        let mut after = || pass(law, &middle, along.after(z), course, control, evaluations);
        self.observer.observe_rolling(law, whole, &first, late, &mut after, course.rebound);
    }

    /// To or from a turning point. Where the sphere begins to roll close to it, a short interval is divided.
    fn split_turning<const N: usize>(&mut self, whole: &Interval<T, N>, turning: Turning<'_, T, L>, z: T)
    where
        T: Nodes<N>,
    {
        let (law, rebound, arrives) = (self.law, turning.course.rebound, turning.course.reversed);
        let nearness = T::constant(NEAR_TURNING_POINT);
        if if arrives { T::ONE - z } else { z } >= nearness {
            return self.divide(whole, &turning, z);
        }
        let evaluations = &mut self.statistics.evaluations;
        let near: Interval<T, N> = turning.near(nearness, evaluations);
        let far: Interval<T, N> = turning.far(&near.end, nearness, evaluations);
        let near = if arrives { Interval { end: whole.end, ..near } } else { near };
        let short = Turning { depth: turning.depth * nearness * nearness, ..turning };
        if !arrives {
            match self.observer.rolls_at(law, &near) {
                Some(z) => self.divide(&near, &short, z),
                None => return self.divide(whole, &turning, z),
            }
            return self.observer.observe(law, &far, rebound);
        }
        if self.observer.rolls_at(law, &far).is_some() {
            return self.divide(whole, &turning, z);
        }
        self.observer.observe(law, &far, rebound);
        match self.observer.rolls_at(law, &near) {
            Some(z) => self.divide(&near, &short, z),
            None => self.observer.observe(law, &near, rebound),
        }
    }

    fn divide<const N: usize>(&mut self, whole: &Interval<T, N>, turning: &Turning<'_, T, L>, z: T)
    where
        T: Nodes<N>,
    {
        let (law, rebound, arrives) = (self.law, turning.course.rebound, turning.course.reversed);
        let evaluations = &mut self.statistics.evaluations;
        let distance = |z: T| if arrives { T::ONE - z } else { z };
        let (z, first, late) = find_end_of_slip(law, self.observer, z, self.control.error, |z| {
            let z = distance(z);
            let near: Interval<T, N> = turning.near(z, evaluations);
            let rate = near.rate.last().copied().unwrap_or(T::ZERO) / z;
            FirstPart { interval: if arrives { turning.far(&near.end, z, evaluations) } else { near }, rate }
        });
        let mut middle = first.end;
        if rebound && middle.speed_squared < T::ZERO {
            middle.energy = whole.end.energy;
        }
        let mut after = || {
            if arrives {
                Interval { end: whole.end, ..turning.near(distance(z), evaluations) }
            } else {
                turning.far(&middle, z, evaluations)
            }
        };
        self.observer.observe_rolling(law, whole, &first, late, &mut after, rebound);
    }
}
