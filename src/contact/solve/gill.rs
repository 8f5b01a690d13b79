//! The paper's own method, for comparison: Runge-Kutta-Gill with a fixed time step on the equations as they are printed.
//!
//! It integrates B6 to B10 in indentation x and speed y = x', with forces of x^(1/2) and x^(3/2). The units are those of
//! the other methods, which leaves the errors of a fixed step as they are. Where contact ends, linear interpolation estimates the
//! time, and where sliding ends, a search finds it; the step is repeated up to it. As the forces are not smooth where x = 0, the
//! error falls with the power 3/2 of the step with adhesion and 5/2 without, not 4.

use core::cell::Cell;

use super::observer::Observer;
use super::path::{End, Method, NormalPath, Statistics};
use super::quantities::{Quantities, Times};
use super::well::barrier;
use crate::Real;
use crate::contact::law::ContactLaw;
use crate::numbers::{NotConverged, root};

/// The method of Runge, Kutta and Gill with a fixed step.
///
/// Its bound of the error of e^2 is an estimate from the changes by longer steps. Where adhesion multiplies the energy of a weakly
/// damped impact, a slow sphere that turns back too early may have a bound of a tenth of its error; its outcome is then undecided.
///
/// ```
/// use microimpact::contact::{RungeKuttaGill, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let motion = NormalMotion::new(2.8)?;
/// let error = |steps| -> Result<f64, microimpact::InputError> {
///     let contact = scene.solve(&motion, &RungeKuttaGill::new(steps))?;
///     Ok((contact.normal.overall_restitution() - 0.746193_f64).abs())
/// };
/// assert!(error(100)? > 1e-5); // an error of 1e-6 takes thousands of steps
/// assert!(error(20_000)? < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Steps"))]
pub struct RungeKuttaGill {
    steps: u32,
}

impl RungeKuttaGill {
    /// Steps after which a run gives up, in units of those in the duration of Hertz's impact.
    ///
    /// ```
    /// assert!(microimpact::contact::RungeKuttaGill::LONGEST_RUN > 1);
    /// ```
    pub const LONGEST_RUN: u32 = 64;

    /// Least number of steps in that duration: a quarter as many still follow the motion.
    const LEAST_STEPS: u32 = 16;

    /// A step that divides the duration of Hertz's impact by `steps`, at least 16.
    ///
    /// ```
    /// use microimpact::contact::RungeKuttaGill;
    ///
    /// assert_eq!(RungeKuttaGill::new(0), RungeKuttaGill::new(16));
    /// ```
    pub const fn new(steps: u32) -> Self {
        Self { steps: if steps < Self::LEAST_STEPS { Self::LEAST_STEPS } else { steps } }
    }
}

/// A number of steps that was read, and may be too small.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Steps {
    steps: u32,
}

#[cfg(feature = "serde")]
impl From<Steps> for RungeKuttaGill {
    fn from(read: Steps) -> Self {
        Self::new(read.steps)
    }
}

impl<T: Real> Method<T> for RungeKuttaGill {
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        // Fixed point has no digits for the small changes in a step.
        if T::SMALLEST == T::EPSILON || !O::IN_STEPS {
            return NormalPath::unsupported(energy);
        }
        let step = law.duration(energy) / T::constant(f64::from(self.steps));
        let most = self.steps.saturating_mul(Self::LONGEST_RUN);
        // What half as many steps change is a bound of the error. A quarter as many show whether that is small by chance.
        let runs = Run::new(law, energy, step, most).and_then(|run| {
            let twice = step + step;
            let coarsest = Run { step: twice + twice, most: most / 4, ..run }.follow(None, &mut ())?;
            let coarse = Run { step: twice, most: most / 2, ..run }.follow(None, &mut ())?;
            let fine = run.follow(Some([&coarse, &coarsest]), observer)?;
            Some([coarsest, coarse, fine])
        });
        let Some([coarsest, coarse, fine]) = runs else {
            return NormalPath::unsupported(energy);
        };
        let mut path = fine.path;
        for other in [coarsest, coarse] {
            let evaluations = other.path.statistics.evaluations;
            path.statistics.evaluations = path.statistics.evaluations.saturating_add(evaluations);
        }
        path
    }
}

/// Difference between a coordinate and the inverse of its indentation, above which the two functions do not belong together.
const INVERSE_ACCURACY: f64 = 1e-3;

/// Change by half as many steps over that by a quarter as many: the order of the method is 3/2 at least.
const LARGEST_RATIO: f64 = 0.36;

/// Bound of the error over the change by half as many steps. At the least order the error is 0.55 of it; rarely both changes are small
/// by chance.
const CHANGE_MARGIN: f64 = 2.0;

/// Change of the energy at the peak by half as many steps that a capture has to be certain by: the way back has as large an error.
const CAPTURE_MARGIN: f64 = 3.0;

/// Energy that a captured sphere lacks, over what it lacks with half as many steps: what it lacks with infinitely many is as much less
/// again as half of the difference.
const LEAST_LACK: f64 = 0.5;

/// Largest bound of the error of e^2 with which a rebound counts as solved.
const LARGEST_ERROR: f64 = 0.1;

/// Change of the time of the peak by half as many steps, over the whole time, with which a result counts as solved: close to a barrier
/// energies hardly change while times do, and with them the end of a slip.
const LARGEST_TIME_CHANGE: f64 = 0.02;

/// Largest decay in a step, with which the method is still exact to a percent. Steps of more than 2.8 of it grow without bound.
const LARGEST_DECAY: f64 = 1.0;

/// Roundings of the largest energy by which a change may vanish by chance.
const ROUNDINGS: f64 = 64.0;

/// Indentation and speed, and the observer's state.
type State<T, O> = ([T; 2], O);

/// Evaluations of the forces in a step.
const STAGES: u32 = 4;

/// A motion with a fixed step.
struct Run<'a, T, L> {
    law: &'a L,
    energy: T,
    step: T,
    most: u32,
    /// Where the barrier stands that holds the sphere, and the energy to pass it.
    barrier: (T, T),
}

/// A motion with the time and the energy of its peak, and the energies where it passes the barrier on both ways and at its end, with
/// which another is compared.
struct Followed<T> {
    path: NormalPath<T>,
    peak_time: T,
    at_peak: T,
    at_entry: T,
    at_barrier: T,
    left: T,
}

impl<'a, T: Real, L: ContactLaw<T>> Run<'a, T, L> {
    /// At most so many steps; `None` where the indentation does not determine the coordinate, or contact does not end at one.
    fn new(law: &'a L, energy: T, step: T, most: u32) -> Option<Self> {
        if law.release_speed(law.end()).is_some() {
            return None;
        }
        // A law of one's own can have an indentation that its coordinate does not invert.
        let middle = T::constant(0.5) * (law.start() + T::ONE);
        let inverse = law.coordinate(law.indentation(middle))? - middle;
        if inverse.abs() > T::constant(INVERSE_ACCURACY) {
            return None;
        }
        // A sphere that comes slower than a barrier is high turns back in front of it and has none to pass on its way out.
        let total = energy + law.potential(law.start());
        let barrier = Some(barrier(law)).filter(|(_, height)| total > *height).unwrap_or((law.end(), T::ZERO));
        Some(Self { law, energy, step, most, barrier })
    }

    /// Follows the motion, whose error those with half and with a quarter as many steps show. Without them the sphere is captured where
    /// it turns back.
    #[inline(never)]
    fn follow<O: Observer<T>>(&self, coarser: Option<[&Followed<T>; 2]>, observer: &mut O) -> Option<Followed<T>> {
        let Self { law, energy, step, most, barrier: (place, escape) } = *self;
        let (half, zero) = (T::constant(0.5), T::ZERO);
        let (first, last) = (law.indentation(law.start()), law.indentation(law.end()));
        let outside = law.indentation(place);
        let mut state: State<T, O::State> = ([first, (energy + energy).sqrt()], observer.state());
        let mut times = Times::new();
        let statistics = Statistics::NONE;
        let mut path =
            NormalPath { end: End::Budget, energy, peak: zero, turning: zero, error_bound: zero, statistics };
        let mut searches = 0;
        let total = |s: T, speed: T| half * speed * speed + law.potential(s);
        let (mut at_peak, mut left, mut margin) = (energy, energy, zero);
        let (mut at_entry, mut at_barrier) = (None, None);
        let mut too_long = false;
        // Change of a quantity by half as many steps.
        let change = |now: T, of: fn(&Followed<T>) -> T| {
            coarser.map_or(zero, |[coarse, coarsest]| {
                let before = (of(coarse) - of(coarsest)).abs() * T::constant(LARGEST_RATIO);
                (now - of(coarse)).abs().max(before)
            })
        };
        // A sphere that lacks less than this with more steps may not be captured.
        let lack = coarser.and_then(|[coarse, _]| {
            // One that creeps never turns back.
            let followed = coarse.path.end == End::Capture || coarse.path.statistics.intervals >= most / 2;
            (followed && coarse.left < escape).then(|| T::constant(LEAST_LACK) * (escape - coarse.left))
        });
        // Square of a speed that is only rounding, as that of a sphere that creeps.
        let rounding = T::constant(ROUNDINGS) * T::EPSILON;
        let standstill = rounding * rounding * energy.max(half);
        // What rounding has taken from the state.
        let mut carry = state.combine(state, |_, _| zero);
        while path.statistics.intervals < most {
            path.statistics.intervals += 1;
            let [x, y] = state.0;
            let mut duration = step;
            let (mut next, mut rest) = advanced(law, observer, &state, &carry, duration);
            // Up to the earlier of separation, by linear interpolation, and the end of sliding.
            let separates = y < zero && next.0[0] <= last;
            if separates {
                duration = step * ((x - last) / (x - next.0[0]));
                (next, rest) = advanced(law, observer, &state, &carry, duration);
            }
            let rolls = is_bounded(&next) && observer.slip(&next.1).is_some_and(|slip| slip <= zero);
            if rolls {
                let (end, steps) = end_of_slip(law, observer, &state, &carry, (duration, &next));
                duration = end;
                searches += steps;
                (next, rest) = advanced(law, observer, &state, &carry, duration);
            }
            if separates || rolls {
                path.statistics.refused += 1;
            }
            let [depth, speed] = next.0;
            if !is_bounded(&next) {
                break;
            }
            if y >= zero && speed < zero && y * y + speed * speed > standstill {
                let to_peak = duration * y / (y - speed);
                times.peak = times.now + to_peak;
                path.peak = law.coordinate(x + half * to_peak * y)?;
                at_peak = law.potential(path.peak);
                let changed = change(at_peak, |other| other.at_peak);
                margin = T::constant(CAPTURE_MARGIN) * changed + rounding * energy.max(half);
                observer.stepped(law, times.peak, path.peak, zero, false);
            }
            let before = (x, left);
            (state, carry) = (next, rest);
            times.now = times.now + duration;
            let s = law.coordinate(depth)?;
            // Within a step that turns the sphere back, it is deeper than at either end, and a stage of the step deeper still.
            let deepest = depth.max(x + half * duration * y);
            too_long = too_long
                || (O::DEMANDS
                    && step * observer.fastest_decay(law, law.coordinate(deepest)?) > T::constant(LARGEST_DECAY));
            left = total(s, speed);
            let here = || left + (before.1 - left) * (outside - depth) / (before.0 - depth);
            if speed < zero && before.0 > outside && depth <= outside {
                at_barrier = Some(here());
            } else if speed > zero && before.0 < outside && depth >= outside {
                at_entry = Some(here());
            }
            observer.stepped(law, times.now, s, speed.abs(), speed < zero);
            if rolls {
                observer.rolls_from(times.now);
            } else if separates {
                path.end = End::Separation;
                // A slow sphere, which a constant force holds, is not quite where the interpolation has it.
                left = half * speed * speed - law.conservative_force(law.end()) * (depth - last);
                break;
            }
            // Without a margin to judge by, the sphere is followed until it turns back.
            let held = speed < zero && s >= place && lack.is_some_and(|lack| left < escape - margin.max(lack));
            if held || (y < zero && speed >= zero) {
                path.end = if held || coarser.is_none() { End::Capture } else { End::Undecided };
                break;
            }
        }
        let (entry, at_barrier) = (at_entry.unwrap_or(at_peak), at_barrier.unwrap_or(left));
        if coarser.is_some() {
            let changed = change(left, |other| other.left);
            let mut uncertain = margin;
            if path.end == End::Separation {
                // Nothing holds a sphere that turned back in front of the barrier.
                let in_front = path.peak < place && at_peak < escape - margin;
                let passing = margin.max(change(at_barrier, |other| other.at_barrier));
                if !in_front && at_barrier - escape <= passing {
                    path.end = End::Undecided;
                }
                uncertain = T::constant(CHANGE_MARGIN) * passing.max(changed);
                if path.end == End::Undecided {
                    uncertain = uncertain.max((at_barrier - escape).abs());
                }
                let surplus = left - energy - law.potential(law.start());
                if !(uncertain <= T::constant(LARGEST_ERROR) * energy && surplus <= uncertain) {
                    path.end = End::Budget;
                }
            } else if path.end == End::Undecided {
                uncertain = margin.max(changed).max((escape - left).abs());
                if uncertain > energy {
                    path.end = End::Budget;
                }
            } else if path.end == End::Budget && state.0[0] >= outside {
                let held = lack.is_some_and(|lack| left < escape - margin.max(changed).max(lack));
                path.end = if held { End::Capture } else { End::Budget };
            }
            let entry_change = T::constant(CAPTURE_MARGIN) * change(entry, |other| other.at_entry);
            if path.end != End::Budget && at_entry.is_some() && entry - escape <= entry_change {
                // Whether it passes the barrier on its way in is not known.
                path.end = End::Undecided;
                uncertain = uncertain.max(entry_change).max((entry - escape).abs());
            }
            path.error_bound = uncertain.min(energy) / energy;
            if too_long || change(times.peak, |other| other.peak_time) > T::constant(LARGEST_TIME_CHANGE) * times.now {
                path.end = End::Budget;
            }
        }
        path.energy = left;
        let steps = path.statistics.intervals.saturating_add(path.statistics.refused).saturating_add(searches);
        path.statistics.evaluations = steps.saturating_mul(STAGES);
        observer.ended(&state.1, &times);
        Some(Followed { path, peak_time: times.peak, at_peak, at_entry: entry, at_barrier, left })
    }
}

/// Time after which a sphere rolls that slides before a step and would slide backward after it, and the steps of the search for it. What a strong friction does within
/// a step is far from linear in time, and a slip that were left would never end, since the sphere then counts as rolling.
#[inline(never)]
fn end_of_slip<T: Real, L: ContactLaw<T>, O: Observer<T>>(
    law: &L,
    observer: &O,
    from: &State<T, O::State>,
    carry: &State<T, O::State>,
    (latest, last): (T, &State<T, O::State>),
) -> (T, u32) {
    let slip = |state: &State<T, O::State>| observer.slip(&state.1).unwrap_or(T::ZERO);
    if slip(from) <= T::ZERO {
        return (T::ZERO, 0);
    }
    let mut steps = 0;
    let after = |time| {
        steps += 1;
        Ok::<_, NotConverged>(slip(&advanced(law, observer, from, carry, time).0))
    };
    let time = root((T::ZERO, slip(from)), (latest, slip(last)), T::EPSILON, after).unwrap_or(latest);
    (time, steps)
}

/// Whether all quantities of a state, and their squares, are finite: steps that are too long for a damping or a moment make them grow
/// beyond all bounds.
#[inline]
fn is_bounded<T: Real, O: Quantities<T>>(state: &State<T, O>) -> bool {
    let bounded = Cell::new(true);
    let _ = state.combine(*state, |quantity, _| {
        bounded.set(bounded.get() && (quantity * quantity).is_finite());
        quantity
    });
    bounded.get()
}

/// The state after a step and what its rounding has taken, which the next step adds again: the sum of many small changes is then as exact
/// as one of few.
#[inline]
fn advanced<T, L, O>(
    law: &L,
    observer: &O,
    from: &State<T, O::State>,
    carry: &State<T, O::State>,
    step: T,
) -> (State<T, O::State>, State<T, O::State>)
where
    T: Real,
    L: ContactLaw<T>,
    O: Observer<T>,
{
    let change = gill(law, observer, from, step).combine(*carry, |change, rest| change + rest);
    let next = from.combine(change, |state, change| state + change);
    let taken = next.combine(*from, |next, from| next - from);
    (next, change.combine(taken, |change, taken| change - taken))
}

/// The change in a step by Gill's coefficients.
#[inline(never)]
fn gill<T, L, O>(law: &L, observer: &O, from: &State<T, O::State>, step: T) -> State<T, O::State>
where
    T: Real,
    L: ContactLaw<T>,
    O: Observer<T>,
{
    const ROOT: f64 = core::f64::consts::FRAC_1_SQRT_2;
    let change = |sum: &State<T, O::State>| {
        let rates = rates(law, observer, &from.combine(*sum, |state, change| state + change));
        rates.combine(rates, |rate, _| step * rate)
    };
    let none = from.combine(*from, |_, _| T::ZERO);
    let first = change(&none);
    let sum = first.combine(first, |k, _| T::constant(0.5) * k);
    // What a stage has not used of the changes so far.
    let second = change(&sum);
    let sum = sum.combine(second.combine(first, |k, q| k - q), |sum, d| sum + T::constant(1.0 - ROOT) * d);
    let rest = second.combine(first, |k, q| T::constant(2.0 - 2.0 * ROOT) * k + T::constant(3.0 * ROOT - 2.0) * q);
    let third = change(&sum);
    let sum = sum.combine(third.combine(rest, |k, q| k - q), |sum, d| sum + T::constant(1.0 + ROOT) * d);
    let rest = third.combine(rest, |k, q| T::constant(2.0 + 2.0 * ROOT) * k - T::constant(2.0 + 3.0 * ROOT) * q);
    let fourth = change(&sum);
    let last = fourth.combine(rest, |k, q| T::constant(1.0 / 6.0) * k - T::constant(1.0 / 3.0) * q);
    sum.combine(last, |sum, d| sum + d)
}

/// The rates of change: B6 and those of the observer. Outside the contact no force acts.
#[inline]
fn rates<T, L, O>(law: &L, observer: &O, state: &State<T, O::State>) -> State<T, O::State>
where
    T: Real,
    L: ContactLaw<T>,
    O: Observer<T>,
{
    let ([x, y], observed) = state;
    let (s, y) = (law.coordinate(*x).unwrap_or(T::ZERO), *y);
    let rebound = y < T::ZERO;
    let acceleration = law.conservative_force(s) - law.damping(s, rebound) * y;
    ([y, acceleration], observer.rates(observed, law, s, y.abs(), rebound))
}
