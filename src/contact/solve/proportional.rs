//! Impacts whose losses are in proportion to the force, l = c V', as under Hunt and Crossley's damping without adhesion: (17c) and (17d) of
//! the chapter on the method.
//!
//! With the speed y towards the surface and w = ln(1 + c y), dw/dt = -c V', and c^2 (V(peak) - V) = e^w - 1 - w on the way in and out: the
//! damped square of [`damped_square`](super::damped_square) has nothing left to integrate. w falls from its value at first contact through
//! zero at the peak to a negative value in the end. How the motion ends takes a logarithm and a root. What is observed along it is
//! integrated.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::damped_square::exponential;
use super::interval::{Course, Interval, Point, tail_of_times};
use super::nodes::Nodes;
use super::observer::Observer;
use super::path::{End, Follower, NormalPath, REFUSED_SHRINK};
use crate::Real;
use crate::contact::law::ContactLaw;

/// Least c v at first contact for which what is observed is integrated so: below it intervals of iterations cost less.
const LEAST_OBSERVED: f64 = 1.5;

/// w at which the rebound is divided, or half of w in the end where that is nearer: from the peak to there the coordinate changes as e^w.
const NEAR_THE_PEAK: f64 = -8.0;

/// Change of w from first contact, or to the end, up to which the potential is found from it: there the difference to that of the peak
/// would cancel.
const NEAR_THE_SURFACE: f64 = 1.0;

/// w of the next division over this one.
const FARTHER: f64 = 2.5;

/// Estimated error over the square of the part that the nodes do not resolve. On the way out also over the part of the integrals that
/// changes as e^w: it may be small, and missed as a whole.
const TAIL_ERROR: f64 = 1e-2;

/// Part of the integrals that changes as e^w near the peak, at least, over one part in the size of w at the surface.
const SMALL_PART: f64 = 0.1;

/// Steps of Halley's method at most. It converges cubically, but from far beyond a place where the potential is a power of the coordinate
/// each step takes a fixed fraction off.
const STEPS: u32 = 80;

/// Cube of the relative step at which they end, over the accuracy.
const LAST_STEP: f64 = 0.1;

/// Accuracy of a coordinate that is observed, over the tolerance.
const PLACE_ACCURACY: f64 = 1e-2;

/// Accuracy of a place at which a phase is divided: it need not be known.
const DIVISION_ACCURACY: f64 = 1e-3;

/// A step of Halley's method towards a value that is missing, from the first and the second derivative.
#[inline]
fn halley<T: Real>(missing: T, slope: T, curvature: T) -> T {
    missing * slope / (slope * slope + T::constant(0.5) * missing * curvature)
}

/// Whether no further step is needed.
fn is_last<T: Real>(step: T, size: T, accuracy: T) -> bool {
    let (step, size) = (step.abs(), size.abs());
    step * step * step <= T::constant(LAST_STEP) * accuracy * size * size * size
}

/// The negative w at which e^w - 1 - w has a positive value.
fn on_the_way_out<T: Real>(excess: T) -> T {
    let double = excess + excess;
    // Its first terms in powers of the root.
    let mut w = -(double.sqrt() + double * T::constant(1.0 / 6.0));
    for _ in 0..STEPS {
        let (rise, found) = exponential(w);
        let step = halley(excess - found, rise, T::ONE + rise);
        w = w + step;
        if is_last(step, w, T::EPSILON) {
            break;
        }
    }
    w
}

/// The coordinate at which the potential has a value, from a first value.
fn coordinate<T: Real>(law: &impl ContactLaw<T>, potential: T, first: T, accuracy: T) -> T {
    let mut s = first;
    for _ in 0..STEPS {
        let slope = law.slope(s);
        if slope == T::ZERO {
            break;
        }
        let step = halley(potential - law.potential(s), slope, law.curvature(s));
        s = s + step;
        if is_last(step, s, accuracy) {
            break;
        }
    }
    s
}

/// A phase of the motion, from first contact to the peak or from there to the end of contact.
///
/// Its variable u goes from zero at the surface to one at the peak. It is the part of the way at which w would have its value if it changed
/// in proportion to the potential. Time, coordinate and speed are smooth functions of u.
struct Phase<T> {
    peak: T,
    /// Potential at the peak.
    potential: T,
    /// Coordinate at the surface,
    surface: T,
    /// and w there.
    w: T,
    rebound: bool,
    /// 1/c.
    inverse: T,
    w_over_potential: T,
    /// Size of that times the way from the surface to the peak, over c.
    rate: T,
    /// Relative error that a coordinate may have.
    accuracy: T,
}

impl<T: Real> Phase<T> {
    /// u where w has a value.
    fn where_w_is(&self, law: &impl ContactLaw<T>, w: T) -> T {
        let potential = self.potential * (T::ONE - w / self.w);
        let place = coordinate(law, potential, self.peak, T::constant(DIVISION_ACCURACY));
        (place - self.surface) / (self.peak - self.surface)
    }

    /// The coordinate whose part of the way is u.
    fn place(&self, u: T) -> T {
        self.surface + u * (self.peak - self.surface)
    }

    /// The coordinate at u, near a first value over the place on the way, the size of the speed, and the time for each du.
    #[inline(never)]
    fn at(&self, law: &impl ContactLaw<T>, u: T, first: T) -> (T, T, T) {
        let inverse = self.inverse;
        let place = self.place(u);
        let change = self.w_over_potential * law.potential(place);
        let (rise, potential) = if change.abs() < T::constant(NEAR_THE_SURFACE) {
            let (growth, rise) = (T::ONE + exponential(self.w).0, exponential(-change).0);
            (growth + growth * rise - T::ONE, -(growth * rise + change) * inverse * inverse)
        } else {
            let w = self.w_over_potential * law.mean_slope(self.peak, place) * (self.peak - place);
            let (rise, excess) = exponential(w);
            (rise, self.potential - excess * inverse * inverse)
        };
        let s = coordinate(law, potential, first * place, self.accuracy);
        let slope = law.slope(s);
        // At the surface both slopes vanish, and the indentation too.
        let rate =
            if slope > T::ZERO { self.rate * law.slope(place) * law.indentation_slope(s) / slope } else { T::ZERO };
        (s, rise.abs() * inverse, rate)
    }

    /// The interval from one u to another.
    fn interval<const N: usize>(&self, law: &impl ContactLaw<T>, from: T, to: T) -> Interval<T, N>
    where
        T: Nodes<N>,
    {
        let (mut s, mut y, mut rate) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
        let mut ratio = T::ONE;
        for j in 0..N {
            let u = from + (to - from) * T::Z[j];
            (s[j], y[j], rate[j]) = self.at(law, u, ratio);
            rate[j] = (to - from).abs() * rate[j];
            let place = self.place(u);
            if place > T::ZERO {
                ratio = s[j] / place;
            }
        }
        let (place, speed_squared) = (s[N - 1], y[N - 1] * y[N - 1]);
        let energy = law.potential(place) + T::constant(0.5) * speed_squared;
        let end = Point { s: place, energy, speed_squared };
        Interval { s, y, rate, end, accepted: true, error: T::ZERO, forward: true }
    }
}

/// c, where the losses are in proportion to the force and damping is strong for a sphere with a kinetic energy.
#[inline]
pub(crate) fn strong_ratio<T: Real>(law: &impl ContactLaw<T>, kinetic: T) -> Option<T> {
    law.loss_over_slope().filter(|&ratio| ratio * (kinetic + kinetic).sqrt() >= T::constant(LEAST_OBSERVED))
}

/// c, if the motion from first contact with a kinetic energy is taken in closed form. Where it is observed, iterations cost less if damping
/// is weak, and have to find where the sphere begins to roll.
#[inline]
pub(super) fn in_closed_form<T: Real, O: Observer<T>>(law: &impl ContactLaw<T>, kinetic: T, observer: &O) -> Option<T> {
    let ratio = law.loss_over_slope()?;
    let drag = ratio * (kinetic + kinetic).sqrt();
    let is_observed = O::OBSERVES && (drag < T::constant(LEAST_OBSERVED) || observer.kink().is_some());
    let is_damped = drag > T::EPSILON && drag < T::ONE / T::EPSILON;
    (is_damped && !is_observed && !O::EVENTS && !O::DEMANDS).then_some(ratio)
}

impl<T: Real, L: ContactLaw<T>, O: Observer<T>> Follower<'_, T, L, O> {
    /// From first contact to separation, with a loss of `ratio` times the force.
    pub(super) fn pass_in_closed_form<const N: usize>(&mut self, ratio: T) -> NormalPath<T>
    where
        T: Nodes<N>,
    {
        let law = self.law;
        let drag = ratio * self.control.approach.sqrt();
        let growth = T::ONE + drag;
        let w = growth.ln();
        // The logarithm has the rounding of 1 + c v, which a step of Newton's method takes away.
        let w = w + (drag - exponential(w).0) / growth;
        let excess = exponential(w).1;
        let potential = excess / (ratio * ratio);
        let peak = coordinate(law, potential, self.undamped_peak(), T::EPSILON);
        let last = on_the_way_out(excess);
        self.statistics.evaluations += N as u32;
        let phase = |surface: T, w: T, rebound: bool| {
            let (inverse, w_over_potential) = (T::ONE / ratio, w / potential);
            let rate = w_over_potential.abs() * (peak - surface) * inverse;
            let accuracy = T::EPSILON.max(T::constant(PLACE_ACCURACY) * self.control.error);
            Phase { peak, potential, surface, w, rebound, inverse, w_over_potential, rate, accuracy }
        };
        let (approach, rebound) = (phase(law.start(), w, false), phase(law.end(), last, true));
        let shown = if O::OBSERVES { self.show_phases::<N>(&approach, &rebound) } else { Ok(()) };
        self.statistics.intervals = self.statistics.intervals.max(2);
        let speed = exponential(last).0 / ratio;
        let speed_squared = speed * speed;
        self.at = Point { s: law.end(), energy: T::constant(0.5) * speed_squared, speed_squared };
        self.path(shown.err().unwrap_or(End::Separation), peak)
    }

    fn show_phases<const N: usize>(&mut self, approach: &Phase<T>, rebound: &Phase<T>) -> Result<(), End>
    where
        T: Nodes<N>,
    {
        self.show_phase::<N>(approach, T::ZERO, T::ONE, T::ONE)?;
        // What changes as e^w fades, until it is below the tolerance.
        let (mut w, faded) = (T::constant(NEAR_THE_PEAK).max(T::constant(0.5) * rebound.w), self.control.error.ln());
        let part = T::constant(SMALL_PART) / (T::ONE + rebound.w.abs());
        let (mut from, mut fading) = (T::ONE, part);
        while w > rebound.w {
            let to = rebound.where_w_is(self.law, w);
            self.show_phase::<N>(rebound, from, to, fading)?;
            from = to;
            if w <= faded {
                fading = T::ONE;
                break;
            }
            (fading, w) = (part * w.exp(), w * T::constant(FARTHER));
        }
        self.show_phase::<N>(rebound, from, T::ZERO, fading)
    }

    /// Shows a phase from one u to another.
    #[inline(never)]
    fn show_phase<const N: usize>(&mut self, phase: &Phase<T>, from: T, to: T, fading: T) -> Result<(), End>
    where
        T: Nodes<N>,
    {
        let course = Course { rebound: phase.rebound, reversed: false };
        let (mut from, mut next) = (from, to);
        loop {
            let mut interval: Interval<T, N> = phase.interval(self.law, from, next);
            self.statistics.evaluations += N as u32;
            interval.error = self.unresolved_along(&interval, fading);
            interval.accepted = interval.error <= self.control.error;
            if self.take(&interval, course, None)? {
                if next == to {
                    return Ok(());
                }
                (from, next) = (next, to);
            } else {
                next = from + self.length_factor(N, &interval).min(T::constant(REFUSED_SHRINK)) * (next - from);
            }
        }
    }

    /// Estimated error of what is observed over an interval whose speeds are exact.
    fn unresolved_along<const N: usize>(&self, interval: &Interval<T, N>, fading: T) -> T
    where
        T: Nodes<N>,
    {
        let tail = self.control.times * tail_of_times(&interval.rate);
        T::constant(TAIL_ERROR) * tail * tail / fading
    }
}
