//! Intervals of the path, each solved by collocation of the speed at Radau's nodes.
//!
//! Along an interval s is a polynomial of z on 0..1 and y^2 = free(z) - integral of loss(z) y dz, where `free` is the square of
//! the speed without losses. Away from turning points y itself is smooth in z. Towards a turning point z = 0 it vanishes
//! like z, so that s = peak - depth z^2 and y = z u with u smooth. Iterations over all nodes at once converge superlinearly if
//! the loss is a small part of the energy. Damped squares or Newton's method take over if it is not.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::damped_square::remaining_loss;
use super::nodes::Nodes;
use super::strong_damping::{
    DEEPEST, RELAXING_ERROR, Stop, leave_damped, newton_error, opposes, pass_damped, solve_by_newton,
};
use crate::Real;
use crate::contact::law::ContactLaw;

/// How exactly an interval is solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Control<T> {
    /// Change of the speeds at which the iterations end.
    pub(crate) converged: T,
    /// Largest error that an interval may have.
    pub(crate) error: T,
    /// Weight of the error of the time of an interval: more than one if times are asked for, less if only the end of the motion is,
    /// because energies depend little on its slow end, which makes times inexact.
    pub(crate) times: T,
    /// Whether anything but the end of the motion is asked for.
    pub(crate) observed: bool,
    /// Square of the speed before the impact, which errors of the energy count against; zero where they count against what moves.
    pub(crate) approach: T,
}

/// A point of the path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<T> {
    /// Contact radius.
    pub(crate) s: T,
    /// Energy E.
    pub(crate) energy: T,
    /// y^2, which close to a turning point is known better than E - V is.
    pub(crate) speed_squared: T,
}

impl<T: Real> Point<T> {
    /// First contact, with a kinetic energy.
    pub(crate) fn arriving(law: &impl ContactLaw<T>, kinetic: T) -> Self {
        let s = law.start();
        Self { s, energy: kinetic + law.potential(s), speed_squared: kinetic + kinetic }
    }
}

/// Direction of the path in time and space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Course {
    /// Whether the sphere is on its way out, where adhesion takes energy too.
    pub(crate) rebound: bool,
    /// Whether the path is followed against time, so that losses are gains.
    pub(crate) reversed: bool,
}

impl Course {
    pub(crate) const APPROACH: Self = Self { rebound: false, reversed: false };
    pub(crate) const REBOUND: Self = Self { rebound: true, reversed: false };
}

/// A solved interval: values at the nodes and at the end.
#[derive(Clone, Copy, Debug)]
pub struct Interval<T, const N: usize> {
    /// Contact radius.
    pub(crate) s: [T; N],
    /// Size of the speed.
    pub(crate) y: [T; N],
    /// Time for each dz.
    pub(crate) rate: [T; N],
    /// The point that the interval leads to.
    pub(crate) end: Point<T>,
    /// Whether it converged within the error allowed.
    pub(crate) accepted: bool,
    /// Estimated error.
    pub(crate) error: T,
    /// Whether z runs with time; an interval that arrives at a turning point is written from there.
    pub(crate) forward: bool,
}

/// Sum of products, in four parts that do not wait for each other.
#[inline]
pub(crate) fn dot<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sums = [T::ZERO; 4];
    for k in 0..N {
        sums[k % 4] = sums[k % 4] + a[k] * b[k];
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// Integrals from zero to each node.
// Inlined into a loop, the whole table would be copied to the stack first.
#[inline(never)]
pub(crate) fn integrals<T: Real, const N: usize>(table: &[[T; N]; N], f: &[T; N]) -> [T; N] {
    let mut sums = [T::ZERO; N];
    for k in 0..N {
        for j in 0..N {
            sums[j] = sums[j] + table[k][j] * f[k];
        }
    }
    sums
}

/// Coefficients of the first shifted Legendre polynomials, from values at the nodes; the others are zero.
#[inline]
pub(crate) fn coefficients<T: Nodes<N>, const N: usize>(values: &[T; N], terms: usize) -> [T; N] {
    let mut coefficients = [T::ZERO; N];
    for i in 0..terms.min(N) {
        coefficients[i] = dot(&T::LEGENDRE[i], values);
    }
    coefficients
}

/// Sum of the first shifted Legendre polynomials at places between 0 and 1, by Clenshaw's recurrence.
#[inline]
pub(crate) fn series<T: Real, const N: usize, const M: usize>(
    coefficients: &[T; N],
    terms: usize,
    places: &[T; M],
) -> [T; M] {
    let x = places.map(|place| T::constant(2.0) * place - T::ONE);
    let (mut now, mut before) = ([T::ZERO; M], [T::ZERO; M]);
    for i in (0..terms.min(N)).rev() {
        let (up, down) = ((2 * i + 1) as f64 / (i + 1) as f64, (i + 1) as f64 / (i + 2) as f64);
        let (up, down) = (T::constant(up), T::constant(down));
        for q in 0..M {
            let next = coefficients[i] + up * x[q] * now[q] - down * before[q];
            before[q] = now[q];
            now[q] = next;
        }
    }
    now
}

/// Least first value of a speed over that without losses: the first-order estimate of the losses may exceed it.
const LEAST_FIRST_SPEED: f64 = 0.5;

/// Squared change before the first iteration: anything is an improvement.
pub(super) const NO_CHANGE_YET: f64 = 1e9;

/// Growth of the squared change at which iterations diverge: the change has doubled.
const DIVERGENCE: f64 = 4.0;

/// Squared change of one node by rounding, over the squared rounding of its speed.
///
/// A step is the residual over twice the speed. About eight roundings go into the residual, each of half an `EPSILON` of the
/// square of the speed, so that the step has an error of two `EPSILON` of the speed.
const CHANGE_ROUNDING: f64 = 4.0;

/// Largest square of the losses over that of the speed for which iterations are tried. Half their ratio is the factor by
/// which an iteration reduces the error.
const ITERATION_LIMIT: f64 = 1.0;

/// The same up to which they are tried before damped squares.
const WEAK: f64 = 0.1;

/// Factor by which an iteration reduces the error of an interval that begins at a turning point, over the loss over the
/// speed there: a third, and 2 % more.
pub(super) const TURNING_CONTRACTION: f64 = 0.34;

/// Largest such factor for which iterations are tried; beyond it a shorter interval costs less.
pub(super) const LEAVING_LIMIT: f64 = 0.4;

/// The same where damped squares take over beyond it.
const SURE_LEAVING_LIMIT: f64 = 0.33;

/// The same for an interval that ends at a turning point, squared; its refusal costs nothing, so that it may be larger.
const ARRIVING_LIMIT: f64 = 0.3;

/// Least distance of a root of the speed behind an interval that ends at a turning point, over its length in z, where times are
/// asked for.
const NEAREST_ROOT: f64 = 0.3;

/// Power of the length in the losses of an interval that ends at a turning point.
const LOSS_POWER_OF_DEPTH: f64 = 1.5;

/// Largest relative change of all speeds that is applied to them; larger ones are left to an iteration.
const LARGEST_RESCALING: f64 = 0.1;

/// Kinetic energy over the energy, below which the speed is known better than the energy.
pub(super) const END_FROM_SPEED: f64 = 0.1;

/// Steps of Newton's method for the distance to the undamped turning point, which is only a first value.
const UNDAMPED_STEPS: u32 = 8;

/// Relative step at which they end.
const UNDAMPED_ACCURACY: f64 = 0.02;

/// Estimated error over the square of the part that the nodes do not resolve.
const TAIL_ERROR: f64 = 0.02;

/// Weight of the second highest coefficient: the highest may vanish by chance.
const SECOND_COEFFICIENT: f64 = 0.3;

/// The unknowns of an interval while they are iterated.
pub(super) struct Iterations<T, const N: usize> {
    /// Speeds, or speeds over z.
    pub(super) speed: [T; N],
    /// Half their reciprocals, renewed by multiplication alone: those of the speeds before the last iteration.
    pub(super) half_inverse: [T; N],
    /// Loss times speed.
    pub(super) power: [T; N],
    /// Square of the last change.
    pub(super) change: T,
    /// Square of the speed that has the rounding of positions.
    terms: T,
    pub(super) iterations: u32,
}

/// Margin for the next squared change over what superlinear convergence predicts: the change may be ten times as large.
const SUPERLINEAR_MARGIN: f64 = 100.0;

/// Iterations that an interval may take. They converge superlinearly: more iterations mean that the interval is too long.
const MOST_ITERATIONS: u32 = 20;

impl<T: Nodes<N>, const N: usize> Iterations<T, N> {
    /// Speeds without losses, less an estimate of their decrease by losses, along an interval up to the coordinate `farthest`.
    #[inline]
    fn from(farthest: T, free: &[T; N], loss: &[T; N], taken: &[T; N]) -> Self {
        let (mut speed, mut half_inverse, mut power) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
        for j in 0..N {
            let root = free[j].max(T::SMALLEST).sqrt();
            speed[j] = (root - taken[j]).max(T::constant(LEAST_FIRST_SPEED) * root);
            half_inverse[j] = T::constant(0.5) / speed[j];
            power[j] = loss[j] * speed[j];
        }
        // The rounding of positions does not shrink with the speed, but with the terms of the potential: of the forces that go on to
        // first contact that of adhesion has the lowest power.
        let terms = (farthest * farthest * farthest).min(T::ONE);
        Self { speed, half_inverse, power, change: T::constant(NO_CHANGE_YET), terms, iterations: 0 }
    }

    /// One iteration, with Heron's step for the root at every node. `lost` gives the square of a speed from the square without
    /// losses and the integral of the losses.
    #[inline]
    fn iterate(&mut self, free: &[T; N], loss: &[T; N], lost: impl Fn(T, T) -> T, table: &[[T; N]; N]) -> T {
        let two = T::constant(2.0);
        let mut step = integrals(table, &self.power);
        // One short loop for each array, which the compiler turns into vectors.
        for j in 0..N {
            step[j] = self.half_inverse[j] * (lost(free[j], step[j]) - self.speed[j] * self.speed[j]);
        }
        for j in 0..N {
            self.speed[j] = self.speed[j] + step[j];
        }
        for j in 0..N {
            self.half_inverse[j] = self.half_inverse[j] * (two - two * self.speed[j] * self.half_inverse[j]);
        }
        for j in 0..N {
            self.power[j] = loss[j] * self.speed[j];
        }
        self.iterations += 1;
        dot(&step, &step)
    }

    /// Changes all speeds by a fraction of themselves, unless the fraction is so large that an iteration does better. Returns the
    /// square of the relative change.
    #[inline]
    fn scale(&mut self, fraction: T) -> T {
        if fraction.abs() < T::constant(LARGEST_RESCALING) {
            let (more, less) = (T::ONE + fraction, T::ONE - fraction);
            for j in 0..N {
                self.speed[j] = self.speed[j] * more;
            }
            for j in 0..N {
                self.half_inverse[j] = self.half_inverse[j] * less;
            }
        }
        T::constant(N as f64) * (fraction * fraction).min(T::ONE)
    }

    /// Takes in changed losses at the present speeds.
    #[inline]
    pub(super) fn take_losses(&mut self, loss: &[T; N]) {
        for j in 0..N {
            self.power[j] = loss[j] * self.speed[j];
        }
    }

    /// Whether the iterations have converged, from the square of the last change and the square `scale` of the speeds. They
    /// converge superlinearly: the next change is at most this one squared over the one before, or the fraction of this one by
    /// which the reciprocals were wrong.
    #[inline]
    pub(super) fn has_converged(&mut self, change: T, scale: T, control: &Control<T>) -> Progress {
        let relative = control.converged * control.converged * scale.min(T::ONE);
        // Rounding alone keeps the changes at this size for ever. A first iteration may hide behind it.
        let rounding = T::constant(CHANGE_ROUNDING * N as f64) * T::EPSILON * T::EPSILON * scale.max(self.terms);
        let enough = if self.iterations > 1 { relative.max(rounding) } else { relative };
        let superlinear =
            self.iterations > 1 && T::constant(SUPERLINEAR_MARGIN) * change * change <= enough * self.change;
        if change <= enough || (superlinear && change * self.residual() <= enough) {
            return Progress::Converged;
        }
        if change < T::constant(DIVERGENCE) * self.change && self.iterations < MOST_ITERATIONS {
            self.change = change;
            return Progress::Converging;
        }
        Progress::Diverging
    }

    /// Square of the largest relative error of a reciprocal in the last iteration.
    #[inline]
    fn residual(&self) -> T {
        let mut largest = T::ZERO;
        for j in 0..N {
            let product = self.speed[j] * self.half_inverse[j];
            largest = largest.max((T::ONE - product - product).abs());
        }
        largest
    }

    fn converge(&mut self, free: &[T; N], loss: &[T; N], table: &[[T; N]; N], control: &Control<T>) -> bool {
        let scale = free[0].max(free[N - 1]);
        loop {
            let change = self.iterate(free, loss, |free, lost| free - lost, table);
            match self.has_converged(change, scale, control) {
                Progress::Converged => return true,
                Progress::Diverging => return false,
                Progress::Converging => {}
            }
        }
    }

    /// Estimated error: the square of what the highest polynomial of the nodes contributes, since Radau's
    /// quadrature converges twice as fast as interpolation.
    ///
    /// The error of the losses is that square as a fraction of them. Where adhesion has multiplied the energy of the impact, losses
    /// that are small here are not small against that energy.
    #[inline]
    pub(super) fn error(&self, scale: T, rate: &[T; N], control: &Control<T>) -> T {
        let tail = dot(&T::HIGHEST_COEFFICIENT, &self.power).abs();
        let lost = dot(&T::WEIGHTS, &self.power).abs();
        let fraction = tail / (lost + scale + T::SMALLEST);
        let fraction =
            if control.times > T::ZERO { fraction.max(control.times * tail_of_times(rate)) } else { fraction };
        let square = fraction * fraction;
        if control.approach > T::ZERO && scale > control.approach {
            // A sphere that loses more than it came with is captured, whatever the error.
            let energy = control.approach.max(lost);
            return T::constant(TAIL_ERROR) * square.max(tail / energy * (tail / (lost + T::SMALLEST)));
        }
        T::constant(TAIL_ERROR) * square
    }
}

/// The part of the times that the nodes do not resolve, as a fraction of them.
#[inline]
pub(crate) fn tail_of_times<T: Nodes<N>, const N: usize>(rate: &[T; N]) -> T {
    unresolved(rate) / (dot(&T::WEIGHTS, rate).abs() + T::SMALLEST)
}

/// The part of an integral that the nodes do not resolve.
#[inline]
pub(crate) fn unresolved<T: Nodes<N>, const N: usize>(values: &[T; N]) -> T {
    let before = T::constant(SECOND_COEFFICIENT) * dot(&T::LEGENDRE[N - 2], values).abs();
    dot(&T::HIGHEST_COEFFICIENT, values).abs().max(before)
}

pub(super) enum Progress {
    Converged,
    Converging,
    Diverging,
}

/// Away from turning points: from a point along s + first z + second z^2.
#[inline]
pub(crate) fn pass<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    from: &Point<T>,
    (first, second): (T, T),
    course: Course,
    control: &Control<T>,
    evaluations: &mut u32,
) -> Interval<T, N> {
    let (two, half) = (T::constant(2.0), T::constant(0.5));
    let (mut s, mut free, mut loss, mut length) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
    let slow = from.speed_squared < from.energy.abs();
    let (mut possible, mut contracting, mut reach, mut taken) = (true, true, T::ZERO, [T::ZERO; N]);
    let mut weak = true;
    for j in 0..N {
        let step = T::Z[j] * (first + second * T::Z[j]);
        s[j] = from.s + step;
        length[j] = (first + two * second * T::Z[j]).abs();
        // From the speed where that is small, else from the energy: the form that does not cancel.
        free[j] = if slow {
            from.speed_squared - two * law.mean_slope(s[j], from.s) * step
        } else {
            two * (from.energy - law.potential(s[j]))
        };
        loss[j] = two * length[j] * law.loss(s[j], course.rebound);
        possible &= free[j] > T::ZERO;
        // Half of the losses so far, over the speed, is the factor by which an iteration reduces an error.
        let here = T::WEIGHTS[j] * loss[j];
        taken[j] = half * (reach + half * here);
        reach = reach + here;
        contracting &= reach * reach < T::constant(ITERATION_LIMIT) * free[j];
        weak &= reach * reach < T::constant(WEAK) * free[j];
    }
    if course.reversed {
        loss = loss.map(|loss| -loss);
        taken = taken.map(|taken| -taken);
    }
    let mut state = Iterations::from(from.s.max(s[N - 1]), &free, &loss, &taken);
    let mut accepted = possible;
    let strong = possible && !weak && control.approach > T::ZERO;
    let damped = strong && pass_damped(law, from, (&s, &length, (first, second)), course, control, &mut state);
    let mut newton = false;
    if possible && !damped {
        if state.iterations > 0 {
            *evaluations += state.iterations * N as u32;
            state = Iterations::from(from.s.max(s[N - 1]), &free, &loss, &taken);
        }
        if !(contracting && state.converge(&free, &loss, &T::INTEGRATION, control)) {
            newton = true;
            accepted = solve_by_newton(&free, &loss, &mut state, control);
        }
    }
    *evaluations += state.iterations * N as u32;
    let lost = dot(&T::WEIGHTS, &state.power);
    let mut rate = [T::ZERO; N];
    for j in 0..N {
        accepted &= state.speed[j] > T::ZERO;
        rate[j] = length[j] * law.indentation_slope(s[j]) / state.speed[j];
    }
    let scale = free[0].max(free[N - 1]);
    let error = if !possible {
        T::ONE
    } else if damped {
        let error = state.error_damped(scale, &rate, &loss, control);
        if course.rebound { T::constant(RELAXING_ERROR) * error } else { error }
    } else if newton {
        newton_error(state.error(scale, &rate, control), control)
    } else {
        state.error(scale, &rate, control)
    };
    let last = state.speed[N - 1];
    // Newton's method and damped squares know the speed at the end, iterations know the energy lost; where almost all is lost the one
    // counts, elsewhere the other.
    let speed_squared = if newton || damped { last * last } else { free[N - 1] - lost };
    let energy = if damped || newton && speed_squared < T::constant(END_FROM_SPEED) * from.energy.abs() {
        half * speed_squared + law.potential(s[N - 1])
    } else {
        from.energy - half * lost
    };
    let end = Point { s: s[N - 1], energy, speed_squared };
    Interval { s, y: state.speed, rate, end, accepted: accepted && error <= control.error, error, forward: true }
}

/// From a turning point `peak`, where the sphere rests, down to `peak` - `depth`.
#[inline]
pub(crate) fn leave<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    peak: T,
    depth: T,
    energy: T,
    course: Course,
    control: &Control<T>,
    evaluations: &mut u32,
) -> Interval<T, N> {
    let (two, half) = (T::constant(2.0), T::constant(0.5));
    let (mut s, mut free, mut loss) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
    let (mut possible, mut strongest) = (true, T::ZERO);
    for j in 0..N {
        s[j] = peak - depth * T::Z[j] * T::Z[j];
        free[j] = two * depth * law.mean_slope(peak, s[j]);
        loss[j] = T::constant(4.0) * depth.abs() * law.loss(s[j], course.rebound);
        possible &= free[j] > T::ZERO;
        strongest = strongest.max(loss[j]);
    }
    if course.reversed {
        loss = loss.map(|loss| -loss);
    }
    let mut state = Iterations::from(peak.max(s[N - 1]), &free, &loss, &taken_from_turning_point(&loss));
    let contraction = T::constant(TURNING_CONTRACTION) * strongest * state.half_inverse[0];
    let with_damped_squares = control.approach > T::ZERO;
    let contracts = contraction < T::constant(if with_damped_squares { SURE_LEAVING_LIMIT } else { LEAVING_LIMIT });
    let damped = possible
        && !contracts
        && with_damped_squares
        && leave_damped(law, (peak, depth), (&s, &free), course, control, &mut state);
    let plain = possible && contracts;
    let mut accepted = damped || plain && state.converge(&free, &loss, &T::TURNING_INTEGRATION, control);
    *evaluations += state.iterations * N as u32;
    let lost = half * dot(&T::TURNING_WEIGHTS, &state.power);
    let (rate, y) = from_turning_point(law, &s, &state, depth.abs(), &mut accepted);
    let error = if damped {
        state.error_damped(free[N - 1], &rate, &loss, control)
    } else if plain {
        state.error(free[N - 1], &rate, control)
    } else {
        T::ONE
    };
    let (last, place) = (state.speed[N - 1], s[N - 1]);
    let (speed_squared, energy) = if damped {
        (last * last, law.potential(place) + half * last * last)
    } else {
        (two * (depth * law.mean_slope(peak, place) - lost), energy - lost)
    };
    let end = Point { s: place, energy, speed_squared };
    Interval { s, y, rate, end, accepted: accepted && error <= control.error, error, forward: true }
}

/// To a turning point ahead, which is found on the way; `guess` is a first value of it. z runs from there, against time.
#[inline]
pub(crate) fn arrive<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    from: &Point<T>,
    guess: T,
    course: Course,
    control: &Control<T>,
    evaluations: &mut u32,
) -> Interval<T, N> {
    let (two, half) = (T::constant(2.0), T::constant(0.5));
    let inwards = guess > from.s;
    let undamped = Stop::undamped(law, from, guess);
    let opposed = opposes(law, from.s, from.s + undamped.distance);
    let strong = if control.approach > T::ZERO && opposed { Stop::damped(law, from, guess, course) } else { None };
    let stop = strong.unwrap_or(undamped);
    let Stop { distance: mut depth, ratio, square } = stop;
    let mut turning = from.s + depth;
    let refused = |turning: T, possible: bool| Interval {
        s: [turning; N],
        y: [T::ZERO; N],
        rate: [T::ZERO; N],
        end: Point { s: if possible { turning } else { from.s }, energy: from.energy, speed_squared: T::ZERO },
        accepted: false,
        error: T::ONE,
        forward: false,
    };
    if (depth > T::ZERO) != inwards || turning <= law.end() {
        return refused(turning, false);
    }
    if strong.is_none() {
        // The error that an iteration leaves is known beforehand, so that a strongly damped arrival costs nothing.
        let reach = T::constant(2.0 * TURNING_CONTRACTION)
            * depth.abs()
            * law.loss(if course.rebound { from.s } else { turning }, course.rebound);
        let stopping = two * depth * law.mean_slope(turning, from.s);
        if !(stopping > T::ZERO && reach * reach < T::constant(ARRIVING_LIMIT) * stopping) {
            return refused(turning, true);
        }
    }
    // A sphere that is still being accelerated came from where it was slow: close behind it the speed has a root, and times a
    // singularity that the nodes may not show.
    let rise = -(T::constant(4.0) * depth * law.slope(from.s));
    if control.times > T::ONE && from.speed_squared < T::constant(NEAREST_ROOT) * rise
        || control.observed && stop.depth() > T::constant(DEEPEST)
    {
        return refused(turning, true);
    }
    let (mut s, mut free, mut loss) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
    let describe = |turning: T, depth: T, s: &mut [T; N], free: &mut [T; N], loss: &mut [T; N]| {
        let factor = T::constant(4.0) * depth.abs();
        let factor = if course.reversed { -factor } else { factor };
        for j in 0..N {
            s[j] = turning - depth * T::Z[j] * T::Z[j];
            free[j] = two * depth * law.mean_slope(turning, s[j]);
            loss[j] = factor * remaining_loss(law, ratio, s[j], course);
        }
    };
    describe(turning, depth, &mut s, &mut free, &mut loss);
    if free.iter().any(|free| *free <= T::ZERO) {
        return refused(turning, true);
    }
    let taken = if strong.is_none() { taken_from_turning_point(&loss).map(|taken| -taken) } else { [T::ZERO; N] };
    let mut state = Iterations::from(turning.max(from.s), &free, &loss, &taken);
    let mut speeds = if strong.is_some() { state.begin_damped(ratio, &free, &loss) } else { None };
    if strong.is_some() && speeds.is_none() {
        return refused(turning, true);
    }
    let mut accepted = false;
    let slow = strong.is_some() || from.speed_squared < T::constant(END_FROM_SPEED) * from.energy.abs();
    // Where the potential is a sum of large terms, as far inside, or the speed is small, what it rises by is known better.
    let by_speed = inwards || slow;
    let mut lost;
    let mut estimated = strong.is_none();
    loop {
        // Seen from the turning point the losses of the way there are still to come. A first step goes by their estimate.
        let change = match &mut speeds {
            Some(speeds) => {
                state.iterate_damped(speeds, (&free, &loss), |free, lost| free + lost, &T::TURNING_INTEGRATION)
            }
            None if estimated => T::ONE,
            None => state.iterate(&free, &loss, |free, lost| free + lost, &T::TURNING_INTEGRATION),
        };
        estimated = false;
        lost = half * dot(&T::TURNING_WEIGHTS, &state.power);
        let excess = if by_speed {
            law.mean_slope(turning, from.s) * depth + lost - half * square
        } else {
            law.potential(turning) + lost - from.energy
        };
        let slope = law.slope(turning);
        // Losses grow with the distance to the power 1.5, and with the coordinate one power less than the elastic energy.
        let power =
            T::constant(LOSS_POWER_OF_DEPTH) + T::constant(law.energy_power() - 1.0) * depth.max(T::ZERO) / turning;
        let step = excess / (slope + power * lost / depth);
        let scale = if speeds.is_some() { from.speed_squared } else { free[0].max(free[N - 1]) };
        let mut change = change + step * step;
        if speeds.is_none() {
            // As the speed at the far end changes with the turning point, so do those on the way.
            change = change + state.scale(-(step * slope / square)) * scale;
        }
        depth = depth - step;
        turning = from.s + depth;
        if (depth > T::ZERO) != inwards || turning <= law.end() {
            break;
        }
        match state.has_converged(change, scale, control) {
            Progress::Converged => {
                accepted = true;
                break;
            }
            Progress::Diverging => break,
            Progress::Converging => {
                describe(turning, depth, &mut s, &mut free, &mut loss);
                match &speeds {
                    Some(speeds) => state.take_remaining(speeds, &loss),
                    None => state.take_losses(&loss),
                }
            }
        }
    }
    *evaluations += state.iterations * N as u32;
    let (rate, y) = from_turning_point(law, &s, &state, depth.abs(), &mut accepted);
    let last = state.speed[N - 1];
    let error = if strong.is_some() {
        let loss = s.map(|s| T::constant(4.0) * depth.abs() * law.loss(s, course.rebound));
        state.error_damped(from.speed_squared.max(last * last), &rate, &loss, control)
    } else {
        state.error(last * last, &rate, control)
    };
    let energy = if slow { law.potential(turning) } else { from.energy - lost };
    let end = Point { s: turning, energy, speed_squared: T::ZERO };
    Interval { s, y, rate, end, accepted: accepted && error <= control.error, error, forward: false }
}

/// Distance from a point to where the square of a speed would be spent without losses: Newton's method from beyond.
pub(super) fn distance_to_stop<T: Real>(law: &impl ContactLaw<T>, from: T, square: T, guess: T) -> T {
    let half = T::constant(0.5);
    let mut distance = guess - from;
    let slope = law.slope(from);
    if slope * distance > T::ZERO && square < T::constant(2.0) * slope * distance {
        distance = half * square / slope;
    }
    for _ in 0..UNDAMPED_STEPS {
        let excess = law.mean_slope(from + distance, from) * distance - half * square;
        let step = excess / law.slope(from + distance);
        distance = distance - step;
        if step.abs() < T::constant(UNDAMPED_ACCURACY) * distance.abs() {
            break;
        }
    }
    distance
}

/// What losses, as if linear in z, take from the speeds over z on the way from a turning point, to first order.
#[inline]
fn taken_from_turning_point<T: Nodes<N>, const N: usize>(loss: &[T; N]) -> [T; N] {
    let mut taken = [T::ZERO; N];
    for j in 0..N {
        taken[j] = T::Z[j] * (loss[0] + T::constant(3.0) * loss[j]) * T::constant(1.0 / 24.0);
    }
    taken
}

/// Times and speeds of an interval that begins at a turning point.
#[inline]
fn from_turning_point<T: Nodes<N>, const N: usize>(
    law: &impl ContactLaw<T>,
    s: &[T; N],
    state: &Iterations<T, N>,
    depth: T,
    accepted: &mut bool,
) -> ([T; N], [T; N]) {
    let (mut rate, mut y) = ([T::ZERO; N], [T::ZERO; N]);
    for j in 0..N {
        *accepted &= state.speed[j] > T::ZERO;
        rate[j] = T::constant(2.0) * depth * law.indentation_slope(s[j]) / state.speed[j];
        y[j] = state.speed[j] * T::Z[j];
    }
    (rate, y)
}

/// Solves a system of linear equations in place, with row pivoting; `false` where it is singular.
pub(crate) fn eliminate<T: Real, const N: usize>(matrix: &mut [[T; N]; N], right: &mut [T; N]) -> bool {
    for p in 0..N {
        // Exchanged on the way rather than in the end: every index is one of a loop, so none has to be checked.
        for i in p + 1..N {
            if matrix[i][p].abs() > matrix[p][p].abs() {
                matrix.swap(p, i);
                right.swap(p, i);
            }
        }
        if matrix[p][p] == T::ZERO {
            return false;
        }
        let inverse = T::ONE / matrix[p][p];
        for i in p + 1..N {
            let factor = matrix[i][p] * inverse;
            for k in p..N {
                matrix[i][k] = matrix[i][k] - factor * matrix[p][k];
            }
            right[i] = right[i] - factor * right[p];
        }
    }
    for p in (0..N).rev() {
        let mut sum = right[p];
        for k in p + 1..N {
            sum = sum - matrix[p][k] * right[k];
        }
        right[p] = sum / matrix[p][p];
    }
    true
}
