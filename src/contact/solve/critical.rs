//! The critical speed: the approach from which a sphere would just come to rest where it separates.
//!
//! The path that separates at rest is followed against time, from there to the bottom of the potential; the impact of a
//! trial speed is followed with time, to the same place. Which of the two is faster there tells rebound from capture, and
//! the difference of their energies by how much. Both are short, regular, and well conditioned in their direction
//! however strong the damping is, and at the critical speed neither comes near the slow end where the path of a single
//! run, with no speed and no force, is at its worst.

use super::collocation::UNTIMED;
use super::interval::{Control, Course, END_FROM_SPEED, Interval, Point, pass};
use super::nodes::Nodes;
use super::path::{End, Follower, REFUSED_SHRINK};
use super::well::{depth, well};
use crate::Real;
use crate::contact::law::ContactLaw;

/// Change at which iterations have converged, over the tolerance.
const CONVERGED: f64 = 0.1;

/// Least change of speeds at which iterations end, in roundings.
const LEAST_CHANGE: f64 = 4.0;

/// Error of the first interval from the end of contact, over the tolerance,
const ROOT_ERROR: f64 = 0.02;

/// and of one from a barrier, over the square of the tolerance.
const BARRIER_ERROR: f64 = 1e-3;

/// Least fraction of the energy that moves in the well, which keeps the tolerance positive.
const LEAST_DEPTH_FRACTION: f64 = 1e-12;

/// Least square of a fraction that makes the tolerance stricter: rounding does not allow more.
const LEAST_SQUARED_FRACTION: f64 = 1e-4;

/// Kinetic energy that damping leaves at the end of an interval, over what there would be without, below which the error is not the
/// square of the unresolved part any more,
const STIFF_FRACTION: f64 = 0.2;

/// and the factor on its tolerance then.
const STIFF_ERROR: f64 = 1e-4;

/// Square of a speed over the largest that the undamped impact has, from which the path from rest is followed no further: no
/// damped impact comes near it.
const MOST_SQUARED_SPEED: f64 = 4.0;

/// Halvings of a distance down to what is less than any fraction of it.
const MOST_HALVINGS: u32 = 60;

/// What becomes of a sphere that arrives with a kinetic energy.
pub(super) fn try_energy<const N: usize, T: Nodes<N>, L: ContactLaw<T>>(tolerance: T, law: &L, energy: T) -> Trial<T> {
    let (half, two) = (T::constant(0.5), T::constant(2.0));
    let converged = (T::constant(CONVERGED) * tolerance).max(T::constant(LEAST_CHANGE) * T::EPSILON);
    let mut control = Control { converged, error: tolerance, times: T::ZERO, observed: false, approach: T::ZERO };
    // Adhesion that catches a sphere nearer to the surface than it lets go takes energy even without damping.
    let first = law.start();
    let caught = |barrier: T| first > barrier && law.potential(first) < law.potential(barrier);
    let takes = |(barrier, bottom): &(T, T)| law.damping(*bottom, true) > T::ZERO || caught(*barrier);
    let Some((barrier, bottom)) = well(law).filter(takes) else {
        return Trial::Free;
    };
    let rest = law.potential(barrier);
    let depth = depth(law, (barrier, bottom));
    // Losses count in proportion to themselves, which at the critical speed make up all of the energy of the impact;
    // the error of an interval is in proportion to what moves in the well, and a square.
    let fraction = (energy / (energy + depth)).max(T::constant(LEAST_DEPTH_FRACTION));
    control.error = (control.error * fraction * fraction).max(unattainable());
    // Where the well is shallow, speeds are small in it.
    let scale = (two * depth).sqrt().min(T::ONE);
    let finer = Control { converged: control.converged * scale, ..control };
    let barred = law.may_have_barrier() && barrier > law.end();
    let start = if barred {
        beside_barrier(law, barrier, bottom, tolerance)
    } else {
        Point { s: barrier, energy: rest, speed_squared: T::ZERO }
    };
    let arrival = Point::arriving(law, energy);
    let fastest = two * (arrival.energy - law.potential(bottom));
    let most = T::constant(MOST_SQUARED_SPEED) * fastest;
    let departure = match Follower::from(law, finer, &mut (), start).ascend::<N>(bottom, most, tolerance) {
        Ok(point) => point,
        Err(trial) => return trial,
    };
    let kinetic = half * departure.speed_squared;
    // Where damping leaves little of the energy of the impact, errors count in proportion to what is left.
    let left = (kinetic / energy).min(T::ONE);
    control.error = (control.error * (left * left).max(T::constant(LEAST_SQUARED_FRACTION))).max(unattainable());
    control.converged = (control.converged * left.sqrt()).max(T::constant(LEAST_CHANGE) * T::EPSILON);
    if barred {
        // The sphere is slow where it passes the barrier on its way in.
        control.times = T::constant(UNTIMED);
    }
    let impact = match Follower::from(law, control, &mut (), arrival).descend::<N>(bottom, kinetic) {
        Ok(point) => point,
        Err(trial) => return trial,
    };
    // If little of the energy remains, the speed is known better, else the energy.
    let surplus = if kinetic < T::constant(END_FROM_SPEED) * energy {
        half * (impact.speed_squared - departure.speed_squared)
    } else {
        impact.energy - departure.energy
    };
    // Over the energy of the impact; what the two paths lose is the rest of it.
    let fraction = surplus / energy;
    // Far above the critical speed the loss may be less than can be told from none.
    let root = (T::ONE - fraction).max(T::EPSILON).sqrt();
    let excess = Some(fraction / (root * (T::ONE + root)) + surplus / (two * kinetic));
    Trial::Tried { rebounds: surplus > T::ZERO, excess }
}

/// A point of the path that comes to rest on a barrier, close to it: on the barrier itself it rests for ever, and forces are no more
/// than rounding errors.
///
/// At a distance x the speed is c x + g x^2 with c^2 = k + d c and (3 c - d) g = d' c - V'''/2, from the curvature -k of the
/// potential, the loss d, and their rates of change. The error in proportion to x^3 is less by another x where the path has come
/// to the bottom.
fn beside_barrier<T: Real, L: ContactLaw<T>>(law: &L, barrier: T, bottom: T, tolerance: T) -> Point<T> {
    let x = T::constant(BESIDE_BARRIER) * tolerance.sqrt().sqrt() * (bottom - barrier).min(barrier - law.end());
    let (two, s) = (T::constant(2.0), barrier + x);
    let (curvature, loss) = (law.curvature(barrier), law.loss(barrier, true));
    let first = (loss + (loss * loss - T::constant(4.0) * curvature.min(T::ZERO)).sqrt()) / two;
    let growth = (law.loss(s, true) - loss) * first - (law.curvature(s) - curvature) / two;
    let speed = first * x + growth * x / (T::constant(3.0) * first - loss);
    let speed_squared = speed * speed;
    Point { s, energy: law.potential(s) + speed_squared / two, speed_squared }
}

/// Distance from the barrier, over that of the bottom or the end of contact and the fourth root of the tolerance.
const BESIDE_BARRIER: f64 = 0.1;

/// Estimated error of an interval, in squared roundings, below which it is one of rounding.
const UNATTAINABLE: f64 = 64.0;

fn unattainable<T: Real>() -> T {
    T::constant(UNATTAINABLE) * T::EPSILON * T::EPSILON
}

/// The outcome of a trial.
#[derive(Clone, Copy, Debug)]
pub enum Trial<T> {
    /// Nothing holds the sphere or nothing takes energy from it.
    Free,
    /// `excess` is zero at the critical speed. Where damping is weak it is v/u - 1, with u the speed whose energy is what
    /// both paths lose: close to the critical one, as losses hardly depend on the speed, so that the excess is almost linear.
    /// Where damping is strong it is what the squares of the speeds at the bottom differ by. `None` where a path ends early.
    Tried { rebounds: bool, excess: Option<T> },
    /// A path could not be followed so exactly.
    Unsolved,
}

impl<T> Trial<T> {
    /// Damping takes so much that one of the paths ends early.
    const CAPTURED: Self = Self::Tried { rebounds: false, excess: None };
}

impl<T: Real, L: ContactLaw<T>> Follower<'_, T, L, ()> {
    /// From first contact over the peak down to the contact radius `to`; `Err` where the sphere does not get there. It is captured if
    /// it would arrive with less than the kinetic energy `least`.
    fn descend<const N: usize>(mut self, to: T, least: T) -> Result<Point<T>, Trial<T>>
    where
        T: Nodes<N>,
    {
        let early = |end| if end == End::Budget { Trial::Unsolved } else { Trial::CAPTURED };
        self.approach::<N>().map_err(early)?;
        let peak = self.at.s;
        if peak <= to {
            return Err(Trial::CAPTURED);
        }
        self.leave_peak::<N>(peak - to).map_err(early)?;
        let converged = self.control.converged;
        let mut length = self.at.s - to;
        while self.at.s > to {
            // Strong damping leaves a speed that is small against what the potential drives; it counts by itself.
            self.control.converged = converged * self.at.speed_squared.sqrt().min(T::ONE);
            let Some((_, next)) = self.step::<N>(-length.min(self.at.s - to), false, Course::REBOUND) else {
                // Next to the bottom, where it creeps, no interval is short enough.
                let most =
                    self.law.mean_slope(self.at.s, to) * (self.at.s - to) + T::constant(0.5) * self.at.speed_squared;
                return Err(if most < least { Trial::CAPTURED } else { Trial::Unsolved });
            };
            length = next;
        }
        Ok(self.at)
    }

    /// From rest up to the coordinate `to`, against time, where its speed is exact to a relative `tolerance`; `Err` where the square of
    /// its speed exceeds `most`.
    fn ascend<const N: usize>(mut self, to: T, most: T, tolerance: T) -> Result<Point<T>, Trial<T>>
    where
        T: Nodes<N>,
    {
        // From the end of contact the speed begins as a root. From a barrier it begins in proportion to the distance, and what is wrong
        // there grows on the way: the error is no square.
        let (mut resting, mut length) = (!self.law.may_have_barrier() || self.at.s <= self.law.end(), to - self.at.s);
        let error = self.control.error;
        let strict = if resting { T::constant(ROOT_ERROR) * error } else { T::constant(BARRIER_ERROR) * error * error };
        self.control.error = strict.max(unattainable());
        while self.at.s < to {
            let course = Course { rebound: true, reversed: true };
            let taken;
            (taken, length) = self.step::<N>(length.min(to - self.at.s), resting, course).ok_or(Trial::Unsolved)?;
            if taken {
                (resting, self.control.error) = (false, error);
            } else if resting && length < self.negligible(to, tolerance) {
                self.at = self.beside_rest(length);
                (resting, self.control.error) = (false, error);
            }
            if self.at.speed_squared > most {
                return Err(Trial::CAPTURED);
            }
        }
        Ok(self.at)
    }

    /// A distance from rest in which losses are less than a fraction of those on the way to the coordinate `to`.
    fn negligible(&self, to: T, fraction: T) -> T {
        let (half, s) = (T::constant(0.5), self.at.s);
        let lost = |length: T| self.law.loss(s + length, true) * length;
        let mut length = half * (to - s);
        let few = fraction * lost(length);
        for _ in 0..MOST_HALVINGS {
            if lost(length) <= few {
                break;
            }
            length = length * half;
        }
        length
    }

    /// The path at a small distance from where it rests, with losses as if linear in the distance. What is wrong with the speed is less
    /// than those losses, and does not grow on the way.
    fn beside_rest(&self, distance: T) -> Point<T> {
        let s = self.at.s + distance;
        let free = (T::constant(-2.0) * self.law.mean_slope(s, self.at.s) * distance).max(T::ZERO);
        let speed = free.sqrt() + T::constant(0.25) * self.law.loss(s, true) * distance;
        let speed_squared = speed * speed;
        Point { s, energy: self.law.potential(s) + T::constant(0.5) * speed_squared, speed_squared }
    }

    /// Tries an interval of signed length `step`, `from_rest` where the speed begins as a power of it: whether it was
    /// taken, and how long the next should be. `None` where it is of no use to go on.
    // Inlined into both directions, it would be there twice.
    #[inline(never)]
    fn step<const N: usize>(&mut self, step: T, from_rest: bool, course: Course) -> Option<(bool, T)>
    where
        T: Nodes<N>,
    {
        let polynomial = if from_rest { (T::ZERO, step) } else { (step, T::ZERO) };
        let mut evaluations = 0;
        let mut interval: Interval<T, N> =
            pass(self.law, &self.at, polynomial, course, &self.control, &mut evaluations);
        if !course.reversed {
            let driven = (self.law.potential(self.at.s) - self.law.potential(interval.end.s)).max(T::ZERO);
            let left = interval.end.speed_squared.max(T::ZERO) / (self.at.speed_squared + driven + driven);
            // Where damping takes nearly all, errors are no longer squares.
            let stiff = if left < T::constant(STIFF_FRACTION) { T::constant(STIFF_ERROR) } else { T::ONE };
            let error = self.control.error;
            let strict = error * stiff * (left * left).max(T::constant(LEAST_SQUARED_FRACTION));
            interval.error = interval.error * (error / strict.max(unattainable::<T>().min(error)));
            interval.accepted &= interval.error <= error;
        }
        let factor = self.length_factor(N, &interval);
        let taken = self.take(&interval, course, None).ok()?;
        let length = step.abs() * if taken { factor } else { factor.min(T::constant(REFUSED_SHRINK)) };
        (length > T::EPSILON * T::EPSILON).then_some((taken, length))
    }
}
