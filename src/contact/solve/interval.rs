//! Intervals of the path, each solved by collocation of the speed at Radau's nodes.
//!
//! Along an interval s is a polynomial of z on 0..1 and y^2 = free(z) - integral of loss(z) y dz, where `free` is the square of
//! the speed without losses. Away from turning points y itself is smooth in z. Towards a turning point z = 0 it vanishes
//! like z, so that s = peak - depth z^2 and y = z u with u smooth. Iterations over all nodes at once converge superlinearly if
//! the loss is a small part of the energy. Newton's method takes over if it is not.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::balance::{self, Balance};
use super::nodes::Nodes;
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
const NO_CHANGE_YET: f64 = 1e9;

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

/// Factor by which an iteration reduces the error of an interval that begins at a turning point, over the loss over the
/// speed there: a third, and 2 % more.
pub(super) const TURNING_CONTRACTION: f64 = 0.34;

/// Largest such factor for which iterations are tried; beyond it a shorter interval costs less.
const LEAVING_LIMIT: f64 = 0.4;

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

/// Losses so far over the loss at a node, in the first value of Newton's method: between those at early and late nodes.
const NEWTON_START: f64 = 0.3;

/// Factor on the estimated error where times are asked for and Newton's method was needed: there errors of times are no longer
/// squares.
const STRONG_DAMPING_TIMES: f64 = 30.0;

/// Estimated error there over the root of the one above: where damping holds the speed at that of balance, the speed at the end is
/// no more exact than the polynomial. `cargo trials --kind largest-tension --method 1e-12` shows it.
const STRONG_DAMPING_SPEED: f64 = 1.5e-4;

/// Steps of Newton's method. It converges quadratically: more steps mean that the interval is too long.
const NEWTON_STEPS: u32 = 10;

/// Largest relative decrease of a speed in a step, which keeps speeds positive.
const NEWTON_LARGEST_STEP: f64 = 0.9;

/// Relative step that comes of a nearly singular matrix.
const NEWTON_HOPELESS: f64 = 1e9;

/// Least squared relative step at which it ends, in roundings.
const NEWTON_ROUNDING: f64 = 4.0;

/// Estimated error over the square of the part that the nodes do not resolve.
const TAIL_ERROR: f64 = 0.02;

/// The same of a work.
const WORK_ERROR: f64 = 0.25;

/// Weight of the second highest coefficient: the highest may vanish by chance.
const SECOND_COEFFICIENT: f64 = 0.3;

/// The unknowns of an interval while they are iterated.
struct Iterations<T, const N: usize> {
    /// Speeds, or speeds over z.
    speed: [T; N],
    /// Half their reciprocals, renewed by multiplication alone: those of the speeds before the last iteration.
    half_inverse: [T; N],
    /// Loss times speed.
    power: [T; N],
    /// Square of the last change.
    change: T,
    /// Square of the speed that has the rounding of positions.
    terms: T,
    iterations: u32,
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

    /// The same by the squares of a balance; `loss` is what is left of the losses.
    #[inline]
    fn iterate_balanced(
        &mut self,
        balance: &mut Balance<T, N>,
        free: &[T; N],
        loss: &[T; N],
        lost: impl Fn(T, T) -> T,
        table: &[[T; N]; N],
    ) -> T {
        let sums = integrals(table, &self.power);
        let mut change = T::ZERO;
        for j in 0..N {
            if !balance.improve(j, lost(free[j], sums[j])) {
                // Not converged, whatever the step.
                change = free[j].max(T::ONE);
            }
            let step = balance.speed(j) - self.speed[j];
            self.speed[j] = balance.speed(j);
            change = change + step * step;
        }
        self.take_unbalanced(balance, loss);
        self.iterations += 1;
        change
    }

    fn converge_balanced(
        &mut self,
        balance: &mut Balance<T, N>,
        (free, loss): (&[T; N], &[T; N]),
        table: &[[T; N]; N],
        control: &Control<T>,
    ) -> bool {
        let scale = (self.speed[0] * self.speed[0]).max(self.speed[N - 1] * self.speed[N - 1]);
        self.take_unbalanced(balance, loss);
        (self.change, self.iterations) = (T::constant(NO_CHANGE_YET), 0);
        loop {
            let change = self.iterate_balanced(balance, free, loss, |free, lost| free - lost, table);
            for j in 0..N {
                self.half_inverse[j] = T::constant(0.5) / self.speed[j];
            }
            match self.has_converged(change, scale, control) {
                Progress::Converged => return true,
                Progress::Converging if self.iterations < MOST_BALANCED => {}
                _ => return false,
            }
        }
    }

    /// Takes in what is left of the losses at the present speeds.
    #[inline]
    fn take_unbalanced(&mut self, balance: &Balance<T, N>, loss: &[T; N]) {
        for j in 0..N {
            self.power[j] = loss[j] * self.speed[j] / balance.growth(j);
        }
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
    fn take_losses(&mut self, loss: &[T; N]) {
        for j in 0..N {
            self.power[j] = loss[j] * self.speed[j];
        }
    }

    /// Whether the iterations have converged, from the square of the last change and the square `scale` of the speeds. They
    /// converge superlinearly: the next change is at most this one squared over the one before, or the fraction of this one by
    /// which the reciprocals were wrong.
    #[inline]
    fn has_converged(&mut self, change: T, scale: T, control: &Control<T>) -> Progress {
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
    fn error(&self, scale: T, rate: &[T; N], control: &Control<T>) -> T {
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

impl<T: Nodes<N>, const N: usize> Iterations<T, N> {
    /// The same of an interval solved by the squares of a balance, of which `loss` is all that damping takes: what the nodes do not
    /// resolve of that counts where it is observed, and times where they are asked for.
    fn error_balanced(&mut self, scale: T, rate: &[T; N], loss: &[T; N], control: &Control<T>) -> T {
        let timed = control.times > T::ONE;
        let error = self.error(scale, rate, &if timed { *control } else { Control { times: T::ZERO, ..*control } });
        if !control.observed {
            return error;
        }
        self.take_losses(loss);
        // A work counts against the energy of the impact.
        let tail = dot(&T::HIGHEST_COEFFICIENT, &self.power).abs();
        let whole = dot(&T::WEIGHTS, &self.power).abs() + scale + T::SMALLEST;
        error.max(T::constant(WORK_ERROR) * (tail / whole) * (tail / whole.max(control.approach)))
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

enum Progress {
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
    let mut newton = false;
    let balanced = possible
        && !weak
        && !course.rebound
        && control.approach > T::ZERO
        && pass_balanced(law, from, (&s, &length, (first, second)), course, control, &mut state);
    if possible && !balanced {
        if state.iterations > 0 {
            let before = state.iterations;
            state = Iterations::from(from.s.max(s[N - 1]), &free, &loss, &taken);
            *evaluations += before * N as u32;
        }
        if !(contracting && state.converge(&free, &loss, &T::INTEGRATION, control)) {
            newton = true;
            accepted = solve_strongly_damped(&free, &loss, &mut state, control);
        }
    }
    *evaluations += state.iterations * N as u32;
    let lost = dot(&T::WEIGHTS, &state.power);
    let mut rate = [T::ZERO; N];
    for j in 0..N {
        accepted &= state.speed[j] > T::ZERO;
        rate[j] = length[j] * law.indentation_slope(s[j]) / state.speed[j];
    }
    let error = if balanced {
        state.error_balanced(free[0].max(free[N - 1]), &rate, &loss, control)
    } else if possible {
        state.error(free[0].max(free[N - 1]), &rate, control)
    } else {
        T::ONE
    };
    // Strong damping makes the forces near the nodes almost balance. What remains is less exact than its quadrature.
    let error = if newton && control.times > T::ONE {
        (T::constant(STRONG_DAMPING_TIMES) * error).max(T::constant(STRONG_DAMPING_SPEED) * error.sqrt())
    } else {
        error
    };
    let last = state.speed[N - 1];
    // Newton's method knows the speed at the end, iterations know the energy lost; where almost all is lost the one counts,
    // elsewhere the other.
    let speed_squared = if newton || balanced { last * last } else { free[N - 1] - lost };
    let energy = if balanced || newton && speed_squared < T::constant(END_FROM_SPEED) * from.energy.abs() {
        half * speed_squared + law.potential(s[N - 1])
    } else {
        from.energy - half * lost
    };
    let end = Point { s: s[N - 1], energy, speed_squared };
    Interval { s, y: state.speed, rate, end, accepted: accepted && error <= control.error, error, forward: true }
}

/// The speeds of an interval away from turning points by the squares of a balance; `false` where that does not converge.
#[inline(never)]
fn pass_balanced<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    from: &Point<T>,
    (s, length, (first, second)): (&[T; N], &[T; N], (T, T)),
    course: Course,
    control: &Control<T>,
    state: &mut Iterations<T, N>,
) -> bool {
    let ratio = balance::ratio(law, s[N - 1], course);
    let speed = from.speed_squared.max(T::ZERO).sqrt();
    let drag = ratio * speed;
    if !drag.is_finite() || drag.abs() < T::constant(STRONG) || T::ONE + drag < T::EPSILON.sqrt() {
        return false;
    }
    let before = balance::square(ratio, speed);
    let sign = if course.reversed { -T::ONE } else { T::ONE };
    let (mut square, mut loss) = ([T::ZERO; N], [T::ZERO; N]);
    for j in 0..N {
        let step = T::Z[j] * (first + second * T::Z[j]);
        square[j] = before - (T::constant(2.0) * law.mean_slope(s[j], from.s) * step);
        loss[j] = (sign + sign) * length[j] * balance::unbalanced(law, ratio, s[j], course);
    }
    if square.iter().any(|square| *square <= T::ZERO) {
        return false;
    }
    let mut balance = Balance::new([ratio; N], &square);
    let (mut reach, mut whole) = (T::ZERO, T::ZERO);
    for j in 0..N {
        let growth = balance.growth(j);
        let speed = balance.speed(j);
        whole = whole + T::WEIGHTS[j] * length[j] * law.loss(s[j], course.rebound);
        reach = reach + T::WEIGHTS[j] * loss[j].abs() / (growth * growth);
        if !(reach * growth < speed) {
            return false;
        }
        state.speed[j] = speed;
    }
    if reach > whole {
        return false;
    }
    state.converge_balanced(&mut balance, (&square, &loss), &T::INTEGRATION, control)
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
    let contracts = contraction < T::constant(LEAVING_LIMIT);
    let mut accepted = possible && contracts && state.converge(&free, &loss, &T::TURNING_INTEGRATION, control);
    let mut balanced = false;
    if possible && !contracts && control.approach > T::ZERO {
        balanced = leave_balanced(law, (peak, depth), (&s, &free), course, control, &mut state);
        accepted = balanced;
    }
    *evaluations += state.iterations * N as u32;
    let lost = half * dot(&T::TURNING_WEIGHTS, &state.power);
    let (rate, y) = from_turning_point(law, &s, &state, depth.abs(), &mut accepted);
    let error = if balanced {
        state.error_balanced(free[N - 1], &rate, &loss, control)
    } else if possible && contracts {
        state.error(free[N - 1], &rate, control)
    } else {
        T::ONE
    };
    let (last, place) = (state.speed[N - 1], s[N - 1]);
    let speed_squared = if balanced { last * last } else { two * (depth * law.mean_slope(peak, place) - lost) };
    let energy = if balanced { law.potential(place) + half * speed_squared } else { energy - lost };
    let end = Point { s: place, energy, speed_squared };
    Interval { s, y, rate, end, accepted: accepted && error <= control.error, error, forward: true }
}

/// The speeds of an interval that begins at a turning point by the squares of a balance; `false` where that does not converge.
#[inline(never)]
fn leave_balanced<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    (peak, depth): (T, T),
    (s, free): (&[T; N], &[T; N]),
    course: Course,
    control: &Control<T>,
    state: &mut Iterations<T, N>,
) -> bool {
    let ratio = balance::ratio(law, peak, course);
    if !ratio.is_finite() || ratio == T::ZERO {
        return false;
    }
    let sign = if course.reversed { -T::ONE } else { T::ONE };
    let mut loss = [T::ZERO; N];
    for j in 0..N {
        loss[j] = sign * T::constant(4.0) * depth.abs() * balance::unbalanced(law, ratio, s[j], course);
    }
    let mut balance = Balance::new(T::Z.map(|z| ratio * z), free);
    let mut reach = T::ZERO;
    for j in 0..N {
        let (growth, speed) = (balance.growth(j), balance.speed(j));
        reach = reach.max(loss[j].abs() / (growth * growth));
        let contraction = T::constant(0.5 * TURNING_CONTRACTION) * reach * growth;
        if !(contraction < T::constant(LEAVING_LIMIT) * speed) {
            return false;
        }
        state.speed[j] = speed;
    }
    state.converge_balanced(&mut balance, (free, &loss), &T::TURNING_INTEGRATION, control)
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
    let mut depth = distance_to_stop(law, from.s, from.speed_squared, guess);
    let mut turning = from.s + depth;
    if control.approach > T::ZERO
        && !course.rebound
        && law.slope(turning) > T::ZERO
        && (law.slope(from.s) >= T::ZERO || from.s <= law.start())
        && let Some(stop) = stop(law, from, guess, course)
    {
        return arrive_balanced(law, from, &stop, course, control, evaluations);
    }
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
    // The error that an iteration leaves is known beforehand, so that a strongly damped arrival costs nothing.
    let reach = T::constant(2.0 * TURNING_CONTRACTION)
        * depth.abs()
        * law.loss(if course.rebound { from.s } else { turning }, course.rebound);
    let stopping = two * depth * law.mean_slope(turning, from.s);
    if !(stopping > T::ZERO && reach * reach < T::constant(ARRIVING_LIMIT) * stopping) {
        return refused(turning, true);
    }
    // A sphere that is still being accelerated came from where it was slow: close behind it the speed has a root, and times a
    // singularity that the nodes may not show.
    let rise = -(T::constant(4.0) * depth * law.slope(from.s));
    if control.times > T::ONE && from.speed_squared < T::constant(NEAREST_ROOT) * rise {
        return refused(turning, true);
    }
    let (mut s, mut free, mut loss) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
    let describe = |turning: T, depth: T, s: &mut [T; N], free: &mut [T; N], loss: &mut [T; N]| {
        let factor = T::constant(4.0) * depth.abs();
        let factor = if course.reversed { -factor } else { factor };
        for j in 0..N {
            s[j] = turning - depth * T::Z[j] * T::Z[j];
            free[j] = two * depth * law.mean_slope(turning, s[j]);
            loss[j] = factor * law.loss(s[j], course.rebound);
        }
    };
    describe(turning, depth, &mut s, &mut free, &mut loss);
    if free.iter().any(|free| *free <= T::ZERO) {
        return refused(turning, true);
    }
    let taken = taken_from_turning_point(&loss).map(|taken| -taken);
    let mut state = Iterations::from(turning.max(from.s), &free, &loss, &taken);
    let mut accepted = false;
    let slow = from.speed_squared < T::constant(END_FROM_SPEED) * from.energy.abs();
    // Where the potential is a sum of large terms, as far inside, or the speed is small, what it rises by is known better.
    let by_speed = inwards || slow;
    let mut lost;
    let mut estimated = true;
    loop {
        // Seen from the turning point the losses of the way there are still to come. A first step goes by their estimate.
        let change = if estimated {
            T::ONE
        } else {
            state.iterate(&free, &loss, |free, lost| free + lost, &T::TURNING_INTEGRATION)
        };
        estimated = false;
        lost = half * dot(&T::TURNING_WEIGHTS, &state.power);
        let excess = if by_speed {
            law.mean_slope(turning, from.s) * depth + lost - half * from.speed_squared
        } else {
            law.potential(turning) + lost - from.energy
        };
        let slope = law.slope(turning);
        // Losses grow with the distance to the power 1.5, and with the coordinate one power less than the elastic energy.
        let power =
            T::constant(LOSS_POWER_OF_DEPTH) + T::constant(law.energy_power() - 1.0) * depth.max(T::ZERO) / turning;
        let step = excess / (slope + power * lost / depth);
        // As the speed at the far end changes with the turning point, so do those on the way.
        let fraction = -(step * slope / from.speed_squared);
        let scale = free[0].max(free[N - 1]);
        let change = change + step * step + state.scale(fraction) * scale;
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
                state.take_losses(&loss);
            }
        }
    }
    *evaluations += state.iterations * N as u32;
    let (rate, y) = from_turning_point(law, &s, &state, depth.abs(), &mut accepted);
    let last = state.speed[N - 1];
    let error = state.error(last * last, &rate, control);
    let energy = if slow { law.potential(turning) } else { from.energy - lost };
    let end = Point { s: turning, energy, speed_squared: T::ZERO };
    Interval { s, y, rate, end, accepted: accepted && error <= control.error, error, forward: false }
}

/// Square of the losses over that of the speed up to which plain iterations are tried first.
const WEAK: f64 = 0.1;

/// Iterations that an interval by the squares of a balance may take.
const MOST_BALANCED: u32 = 10;

/// Least c y.
const STRONG: f64 = 0.5;

/// Largest c^2 G/2 of an interval at a turning point where times are asked for.
pub(super) const DEEPEST: f64 = 7.0;
pub(super) const SHALLOW: f64 = 5.0;

/// Where force and damping together stop the sphere, if damping is strong.
pub(super) struct Stop<T> {
    pub(super) distance: T,
    pub(super) ratio: T,
    pub(super) square: T,
}

impl<T: Real> Stop<T> {
    pub(super) fn depth(&self) -> T {
        T::constant(0.5) * self.ratio * self.ratio * self.square
    }
}

pub(super) fn stop<T: Real>(law: &impl ContactLaw<T>, from: &Point<T>, guess: T, course: Course) -> Option<Stop<T>> {
    if course.reversed {
        return None;
    }
    let inwards = guess > from.s;
    let speed = from.speed_squared.max(T::ZERO).sqrt();
    let (mut square, mut turning, mut ratio) = (from.speed_squared, guess, T::ZERO);
    for _ in 0..2 {
        let distance = distance_to_stop(law, from.s, square, turning);
        turning = from.s + distance;
        if (distance > T::ZERO) != inwards || turning <= law.end() {
            return None;
        }
        ratio = balance::ratio(law, turning, course);
        if !(ratio * speed > T::constant(STRONG) && (ratio * speed).is_finite()) {
            return None;
        }
        square = balance::square(ratio, speed);
    }
    let distance = distance_to_stop(law, from.s, square, turning);
    ((distance > T::ZERO) == inwards && from.s + distance > law.end()).then_some(Stop { distance, ratio, square })
}

/// The same by the squares of a balance.
#[inline(never)]
fn arrive_balanced<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    from: &Point<T>,
    stop: &Stop<T>,
    course: Course,
    control: &Control<T>,
    evaluations: &mut u32,
) -> Interval<T, N> {
    let (two, half) = (T::constant(2.0), T::constant(0.5));
    let &Stop { distance: mut depth, ratio, square } = stop;
    let mut turning = from.s + depth;
    let inwards = depth > T::ZERO;
    let refused = |turning: T| Interval {
        s: [turning; N],
        y: [T::ZERO; N],
        rate: [T::ZERO; N],
        end: Point { s: turning, energy: from.energy, speed_squared: T::ZERO },
        accepted: false,
        error: T::ONE,
        forward: false,
    };
    // A sphere that is still being accelerated came from where it was slow: close behind it the speed has a root, and times a
    // singularity that the nodes may not show.
    let rise = -(T::constant(4.0) * depth * law.slope(from.s));
    if control.times > T::ONE && from.speed_squared < T::constant(NEAREST_ROOT) * rise
        || control.observed && stop.depth() > T::constant(DEEPEST)
    {
        return refused(turning);
    }
    let (mut s, mut free, mut loss) = ([T::ZERO; N], [T::ZERO; N], [T::ZERO; N]);
    let describe = |turning: T, depth: T, s: &mut [T; N], free: &mut [T; N], loss: &mut [T; N]| {
        let factor = T::constant(4.0) * depth.abs();
        for j in 0..N {
            s[j] = turning - depth * T::Z[j] * T::Z[j];
            free[j] = two * depth * law.mean_slope(turning, s[j]);
            loss[j] = factor * balance::unbalanced(law, ratio, s[j], course);
        }
    };
    describe(turning, depth, &mut s, &mut free, &mut loss);
    if free.iter().any(|free| *free <= T::ZERO) {
        return refused(turning);
    }
    let mut balance = Balance::new(T::Z.map(|z| ratio * z), &free);
    let mut state = Iterations::from(turning.max(from.s), &free, &loss, &[T::ZERO; N]);
    let (mut reach, mut accepted) = (T::ZERO, false);
    for j in 0..N {
        let (growth, speed) = (balance.growth(j), balance.speed(j));
        reach = reach.max(loss[j].abs() / (growth * growth));
        let contraction = T::constant(0.5 * TURNING_CONTRACTION) * reach * growth;
        if !(contraction < T::constant(LEAVING_LIMIT) * speed) {
            return refused(turning);
        }
        state.speed[j] = speed;
    }
    state.take_unbalanced(&balance, &loss);
    loop {
        let change =
            state.iterate_balanced(&mut balance, &free, &loss, |free, lost| free + lost, &T::TURNING_INTEGRATION);
        for j in 0..N {
            state.half_inverse[j] = half / state.speed[j];
        }
        let lost = half * dot(&T::TURNING_WEIGHTS, &state.power);
        let excess = law.mean_slope(turning, from.s) * depth + lost - half * square;
        let power =
            T::constant(LOSS_POWER_OF_DEPTH) + T::constant(law.energy_power() - 1.0) * depth.max(T::ZERO) / turning;
        let step = excess / (law.slope(turning) + power * lost / depth);
        let scale = from.speed_squared;
        let change = change + step * step;
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
            Progress::Converging if state.iterations >= MOST_BALANCED => break,
            Progress::Converging => {
                describe(turning, depth, &mut s, &mut free, &mut loss);
                state.take_unbalanced(&balance, &loss);
            }
        }
    }
    *evaluations += state.iterations * N as u32;
    let (rate, y) = from_turning_point(law, &s, &state, depth.abs(), &mut accepted);
    let last = state.speed[N - 1];
    for j in 0..N {
        loss[j] = T::constant(4.0) * depth.abs() * law.loss(s[j], course.rebound);
    }
    let error = state.error_balanced(from.speed_squared.max(last * last), &rate, &loss, control);
    let end = Point { s: turning, energy: law.potential(turning), speed_squared: T::ZERO };
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

/// Newton's method with the dense Jacobian, for intervals that lose most of their energy.
#[inline(never)]
fn solve_strongly_damped<T: Nodes<N>, const N: usize>(
    free: &[T; N],
    loss: &[T; N],
    state: &mut Iterations<T, N>,
    control: &Control<T>,
) -> bool {
    let speed = &mut state.speed;
    for j in 0..N {
        let root = free[j].max(T::SMALLEST).sqrt();
        // As if the loss so far had acted at this node's speed.
        // Where the losses are gains, as if that at this node acted from the start.
        let half = T::constant(0.5);
        speed[j] = if loss[j] > T::ZERO {
            root * root / (root + T::constant(NEWTON_START) * loss[j])
        } else {
            root - half * T::Z[j] * loss[j]
        };
    }
    let enough = control.converged.max(T::constant(NEWTON_ROUNDING) * T::EPSILON);
    let mut converged = false;
    for _ in 0..NEWTON_STEPS {
        let (mut jacobian, mut residual) = ([[T::ZERO; N]; N], [T::ZERO; N]);
        for j in 0..N {
            let mut lost = T::ZERO;
            for k in 0..N {
                jacobian[j][k] = T::INTEGRATION[k][j] * loss[k];
                lost = lost + jacobian[j][k] * speed[k];
            }
            jacobian[j][j] = jacobian[j][j] + speed[j] + speed[j];
            residual[j] = free[j] - lost - speed[j] * speed[j];
        }
        if !eliminate(&mut jacobian, &mut residual) {
            break;
        }
        let (mut fraction, mut largest) = (T::ONE, T::ZERO);
        for j in 0..N {
            let bound = T::constant(-NEWTON_LARGEST_STEP) * speed[j];
            if residual[j] < bound {
                fraction = fraction.min(bound / residual[j]);
            }
            largest = largest.max(residual[j].abs() / speed[j]);
        }
        for j in 0..N {
            speed[j] = speed[j] + fraction * residual[j];
        }
        state.iterations += 1;
        if largest * largest <= enough {
            converged = true;
            break;
        }
        if largest >= T::constant(NEWTON_HOPELESS) {
            break;
        }
    }
    for j in 0..N {
        state.power[j] = loss[j] * speed[j];
    }
    converged
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
