//! How an interval with strong damping is solved: by iterations of its damped squares, or by Newton's method with all speeds.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::damped_square::{DampedSpeeds, damped_square, loss_over_force, remaining_loss};
use super::interval::{
    Control, Course, Iterations, LEAVING_LIMIT, NO_CHANGE_YET, Point, Progress, TURNING_CONTRACTION, distance_to_stop,
    dot, eliminate, integrals, unresolved,
};
use super::nodes::Nodes;
use crate::Real;
use crate::contact::law::ContactLaw;

/// Least size of c y for damped squares: below it plain iterations converge about as fast.
pub(super) const LEAST_DRAG: f64 = 0.5;

/// Largest c^2 G/2 of an interval at a turning point whose times or works are asked for: from there to the turning point the speed
/// changes as e^w, of which the nodes resolve so much. `cargo trials --kind mild --method 1e-9` shows it.
pub(super) const DEEPEST: f64 = 7.0;

/// Roundings within which a speed is that of balance, which on the way out it does not exceed.
pub(super) const BALANCE_ROUNDINGS: f64 = 8.0;

/// Estimated error of a work over the square of the part that the nodes do not resolve.
const WORK_ERROR: f64 = 0.1;

/// Factor on the estimated error on the way out, where the speed tends to that of balance: nodes that do not resolve how it does have an error that
/// falls less fast than the square of what they do not resolve.
pub(super) const RELAXING_ERROR: f64 = 300.0;

/// The same where Newton's method was needed and no times are asked for.
const NEWTON_ERROR: f64 = 10.0;

/// The same where times are asked for: there errors of times are no longer squares.
const NEWTON_TIMES: f64 = 30.0;

/// Estimated error there over the root of the one above: where damping holds the speed at that of balance, the speed at the end is
/// no more exact than the polynomial. `cargo trials --kind largest-tension --method 1e-12` shows it.
const NEWTON_SPEED: f64 = 1.5e-4;

/// Losses so far over the loss at a node, in the first value of Newton's method: between those at early and late nodes.
const NEWTON_START: f64 = 0.3;

/// Steps of Newton's method. It converges quadratically: more steps mean that the interval is too long.
const NEWTON_STEPS: u32 = 10;

/// Largest relative decrease of a speed in a step, which keeps speeds positive.
const NEWTON_LARGEST_STEP: f64 = 0.9;

/// Relative step that comes of a nearly singular matrix.
const NEWTON_HOPELESS: f64 = 1e9;

/// Least squared relative step at which it ends, in roundings.
const NEWTON_ROUNDING: f64 = 4.0;

/// The turning point ahead as losses in proportion to the force would have it.
#[derive(Clone, Copy)]
pub(super) struct Stop<T> {
    /// Signed distance to it.
    pub(super) distance: T,
    /// c there; zero where damping is too weak for damped squares.
    pub(super) ratio: T,
    /// The damped square of the speed, or its square where c is zero.
    pub(super) square: T,
}

impl<T: Real> Stop<T> {
    /// The turning point without losses; `guess` is a first value of it.
    pub(super) fn undamped(law: &impl ContactLaw<T>, from: &Point<T>, guess: T) -> Self {
        let square = from.speed_squared;
        Self { distance: distance_to_stop(law, from.s, square, guess), ratio: T::ZERO, square }
    }

    /// That of strong damping on the way in, unless damping is weak there or c no measure of it.
    pub(super) fn damped(law: &impl ContactLaw<T>, from: &Point<T>, guess: T, course: Course) -> Option<Self> {
        if course.reversed || course.rebound {
            return None;
        }
        let inwards = guess > from.s;
        let possible = |distance: T| (distance > T::ZERO) == inwards && from.s + distance > law.end();
        let speed = from.speed_squared.max(T::ZERO).sqrt();
        let mut stop = Self::undamped(law, from, guess);
        // c changes along the path: once from the undamped turning point, and once from about the damped one.
        for _ in 0..2 {
            if !possible(stop.distance) {
                return None;
            }
            let turning = from.s + stop.distance;
            stop.ratio = loss_over_force(law, turning, course);
            let drag = stop.ratio * speed;
            if !(drag > T::constant(LEAST_DRAG) && drag.is_finite()) {
                return None;
            }
            stop.square = damped_square(stop.ratio, speed);
            stop.distance = distance_to_stop(law, from.s, stop.square, turning);
        }
        possible(stop.distance).then_some(stop)
    }

    /// c^2 G/2 of the speed.
    pub(super) fn depth(&self) -> T {
        T::constant(0.5) * self.ratio * self.ratio * self.square
    }
}

/// Whether the force opposes a motion inwards from one place to another, so that the loss over the force at the end measures the
/// damping of the whole interval. Adhesion may attract at first contact.
pub(super) fn opposes<T: Real>(law: &impl ContactLaw<T>, from: T, to: T) -> bool {
    law.slope(to) > T::ZERO && (law.slope(from) >= T::ZERO || from <= law.start())
}

/// The last node of an interval, but not the end of contact, where loss and force vanish.
fn last_within_contact<T: Real, const N: usize>(law: &impl ContactLaw<T>, s: &[T; N]) -> T {
    if s[N - 1] > law.end() { s[N - 1] } else { s[N - 2] }
}

/// The speeds of an interval away from turning points by damped squares; `false` where that does not converge.
#[inline(never)]
pub(super) fn pass_damped<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    from: &Point<T>,
    (s, length, (first, second)): (&[T; N], &[T; N], (T, T)),
    course: Course,
    control: &Control<T>,
    state: &mut Iterations<T, N>,
) -> bool {
    if !course.rebound && !opposes(law, from.s, s[N - 1]) {
        return false;
    }
    let ratio = loss_over_force(law, last_within_contact(law, s), course);
    let speed = from.speed_squared.max(T::ZERO).sqrt();
    let drag = ratio * speed;
    let beyond = T::ONE + drag < T::constant(-BALANCE_ROUNDINGS) * T::EPSILON;
    if !drag.is_finite() || drag.abs() < T::constant(LEAST_DRAG) || beyond {
        return false;
    }
    let before = damped_square(ratio, speed);
    let sign = if course.reversed { -T::ONE } else { T::ONE };
    let (mut square, mut loss) = ([T::ZERO; N], [T::ZERO; N]);
    for j in 0..N {
        let step = T::Z[j] * (first + second * T::Z[j]);
        square[j] = before - (T::constant(2.0) * law.mean_slope(s[j], from.s) * step);
        loss[j] = (sign + sign) * length[j] * remaining_loss(law, ratio, s[j], course);
    }
    // On the way out a remaining loss counts more, not less.
    let grows = course.rebound && loss.iter().any(|loss| *loss != T::ZERO);
    if grows || square.iter().any(|square| *square <= T::ZERO) {
        return false;
    }
    let mut speeds = DampedSpeeds::new([ratio; N], &square);
    let (mut reach, mut whole) = (T::ZERO, T::ZERO);
    for j in 0..N {
        let (divisor, speed) = (speeds.divisor(j), speeds.speed(j));
        whole = whole + T::WEIGHTS[j] * length[j] * law.loss(s[j], course.rebound);
        reach = reach + T::WEIGHTS[j] * loss[j].abs() / (divisor * divisor);
        let contracts = reach * divisor < speed;
        if !contracts {
            return false;
        }
        state.speed[j] = speed;
    }
    reach <= whole && state.converge_damped(&mut speeds, (&square, &loss), &T::INTEGRATION, control)
}

/// The speeds of an interval that begins at a turning point by damped squares; `false` where that does not converge.
#[inline(never)]
pub(super) fn leave_damped<T: Nodes<N>, const N: usize, L: ContactLaw<T>>(
    law: &L,
    (peak, depth): (T, T),
    (s, free): (&[T; N], &[T; N]),
    course: Course,
    control: &Control<T>,
    state: &mut Iterations<T, N>,
) -> bool {
    // On the way out a remaining loss counts most in the end, where the speed is that of balance.
    let place = if course.rebound && !course.reversed { last_within_contact(law, s) } else { peak };
    let ratio = loss_over_force(law, place, course);
    if !ratio.is_finite() || ratio == T::ZERO {
        return false;
    }
    let sign = if course.reversed { -T::ONE } else { T::ONE };
    let factor = sign * T::constant(4.0) * depth.abs();
    let loss = s.map(|s| factor * remaining_loss(law, ratio, s, course));
    let Some(mut speeds) = state.begin_damped(ratio, free, &loss) else {
        return false;
    };
    state.converge_damped(&mut speeds, (free, &loss), &T::TURNING_INTEGRATION, control)
}

impl<T: Nodes<N>, const N: usize> Iterations<T, N> {
    /// The first speeds over z of an interval at a turning point, without the remaining losses; `None` where iterations do not converge.
    pub(super) fn begin_damped(&mut self, ratio: T, free: &[T; N], loss: &[T; N]) -> Option<DampedSpeeds<T, N>> {
        let speeds = DampedSpeeds::new(T::Z.map(|z| ratio * z), free);
        let mut reach = T::ZERO;
        for j in 0..N {
            let (divisor, speed) = (speeds.divisor(j), speeds.speed(j));
            reach = reach.max(loss[j].abs() / (divisor * divisor));
            let contracts =
                T::constant(0.5 * TURNING_CONTRACTION) * reach * divisor < T::constant(LEAVING_LIMIT) * speed;
            if !contracts {
                return None;
            }
            self.speed[j] = speed;
        }
        self.take_remaining(&speeds, loss);
        Some(speeds)
    }

    /// One iteration. `lost` gives a damped square from that without remaining losses and the integral of these.
    #[inline]
    pub(super) fn iterate_damped(
        &mut self,
        speeds: &mut DampedSpeeds<T, N>,
        (free, loss): (&[T; N], &[T; N]),
        lost: impl Fn(T, T) -> T,
        table: &[[T; N]; N],
    ) -> T {
        let sums = integrals(table, &self.power);
        let mut change = T::ZERO;
        for j in 0..N {
            if !speeds.improve(j, lost(free[j], sums[j])) {
                // Not converged, whatever the step.
                change = free[j].max(T::ONE);
            }
            let step = speeds.speed(j) - self.speed[j];
            self.speed[j] = speeds.speed(j);
            self.half_inverse[j] = T::constant(0.5) / self.speed[j];
            change = change + step * step;
        }
        self.take_remaining(speeds, loss);
        self.iterations += 1;
        change
    }

    fn converge_damped(
        &mut self,
        speeds: &mut DampedSpeeds<T, N>,
        (free, loss): (&[T; N], &[T; N]),
        table: &[[T; N]; N],
        control: &Control<T>,
    ) -> bool {
        let scale = (self.speed[0] * self.speed[0]).max(self.speed[N - 1] * self.speed[N - 1]);
        self.take_remaining(speeds, loss);
        (self.change, self.iterations) = (T::constant(NO_CHANGE_YET), 0);
        loop {
            let change = self.iterate_damped(speeds, (free, loss), |free, lost| free - lost, table);
            match self.has_converged(change, scale, control) {
                Progress::Converged => return true,
                Progress::Converging => {}
                Progress::Diverging => return false,
            }
        }
    }

    /// Takes in the remaining losses at the present speeds.
    #[inline]
    pub(super) fn take_remaining(&mut self, speeds: &DampedSpeeds<T, N>, loss: &[T; N]) {
        for j in 0..N {
            self.power[j] = loss[j] * self.speed[j] / speeds.divisor(j);
        }
    }

    /// Estimated error of an interval solved by damped squares, of which `loss` is all that damping takes: what the nodes do not resolve
    /// of that counts where it is observed, and times where they are asked for.
    pub(super) fn error_damped(&mut self, scale: T, rate: &[T; N], loss: &[T; N], control: &Control<T>) -> T {
        let timed = control.times > T::ONE;
        let mut error = self.error(scale, rate, &if timed { *control } else { Control { times: T::ZERO, ..*control } });
        if control.observed {
            self.take_losses(loss);
            // A work counts against the energy of the impact.
            let tail = unresolved(&self.power);
            let whole = dot(&T::WEIGHTS, &self.power).abs() + scale + T::SMALLEST;
            error = error.max(T::constant(WORK_ERROR) * (tail / whole) * (tail / whole.max(control.approach)));
        }
        error
    }
}

/// Estimated error of an interval solved by Newton's method, from that of its quadrature: strong damping makes the forces near the nodes
/// almost balance, and what remains is less exact.
pub(super) fn newton_error<T: Real>(error: T, control: &Control<T>) -> T {
    if control.times > T::ONE {
        (T::constant(NEWTON_TIMES) * error).max(T::constant(NEWTON_SPEED) * error.sqrt())
    } else {
        T::constant(NEWTON_ERROR) * error
    }
}

/// Newton's method with the dense Jacobian, for intervals that lose most of their energy.
#[inline(never)]
pub(super) fn solve_by_newton<T: Nodes<N>, const N: usize>(
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
