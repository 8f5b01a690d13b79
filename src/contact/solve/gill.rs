//! The paper's own method, for comparison: Runge-Kutta-Gill with a fixed time step on the equations as they are printed.
//!
//! It integrates B6 to B10 in indentation x and speed y = x', with forces of x^(1/2) and x^(3/2). The units are those of
//! the other methods, which leaves the errors of a fixed step as they are. Where sliding or contact ends, linear interpolation
//! estimates the time, and the step is repeated up to it. As the forces are not smooth where x = 0, the error falls with
//! the power 3/2 of the step with adhesion and 5/2 without, not 4.

use super::integrals::{Integrals, Quantities, Times};
use super::law::{NormalLaw, brink};
use super::motion::{Effort, End, Method, NormalPath};
use super::tangential::{SpinDamping, TangentialMotion};
use crate::Real;

/// The method of Runge, Kutta and Gill with a fixed step.
///
/// ```
/// use microimpact::simulation::{RungeKuttaGill, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let motion = NormalMotion::new(2.8)?;
/// let error = |steps| -> Result<f64, microimpact::InputError> {
///     let contact = scene.normal_impact(&RungeKuttaGill::new(steps), &motion)?;
///     Ok((contact.overall_restitution() - 0.746193_f64).abs())
/// };
/// assert!(error(100)? > 1e-5); // an error of 1e-6 takes thousands of steps
/// assert!(error(20_000)? < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RungeKuttaGill {
    steps: u32,
}

impl RungeKuttaGill {
    /// Steps after which a run gives up, in units of those in the duration of Hertz's impact.
    ///
    /// ```
    /// assert!(microimpact::simulation::RungeKuttaGill::LONGEST_RUN > 1);
    /// ```
    pub const LONGEST_RUN: u32 = 64;

    /// A step that divides the duration of Hertz's impact by `steps`, at least four.
    ///
    /// ```
    /// use microimpact::simulation::RungeKuttaGill;
    ///
    /// assert_eq!(RungeKuttaGill::new(0), RungeKuttaGill::new(4));
    /// ```
    pub const fn new(steps: u32) -> Self {
        Self { steps: if steps < 4 { 4 } else { steps } }
    }
}

/// Duration of Hertz's impact in units of its peak indentation over its speed.
const HERTZ_DURATION: f64 = 2.943_275_2;

impl<T: Real> Method<T, ()> for RungeKuttaGill {
    fn solve<L: NormalLaw<T>>(&self, law: &L, energy: T, (): &mut ()) -> NormalPath<T> {
        self.solve(law, energy, &mut ((), ()))
    }
}

impl<T: Real, O: Integrals<T>, S: SteppedMotion<T>> Method<T, (O, S)> for RungeKuttaGill {
    fn solve<L: NormalLaw<T>>(&self, law: &L, energy: T, observer: &mut (O, S)) -> NormalPath<T> {
        let square = energy + energy;
        let duration = T::constant(HERTZ_DURATION) * square.two_fifths_power() / square.sqrt();
        let step = duration / T::constant(f64::from(self.steps));
        integrate(law, energy, step, self.steps.saturating_mul(Self::LONGEST_RUN), observer)
    }
}

/// The tangential side of a motion that is solved with fixed steps.
pub trait SteppedMotion<T: Real>: Copy {
    /// Velocities and ways.
    type State: Quantities<T>;

    /// The state before contact.
    fn state(&self) -> Self::State;

    /// Its rate of change (B7 to B10) at contact radius s under the elastic force.
    fn rates(&self, state: &Self::State, s: T, elastic: T) -> Self::State;

    /// Slip in its first direction while the sphere slides.
    fn slip(&self, state: &Self::State) -> Option<T>;

    /// The sphere rolls from this time on.
    fn rolls_from(&mut self, time: T);

    /// The motion at the end.
    #[must_use]
    fn ended(self, state: &Self::State) -> Self;
}

impl<T: Real> SteppedMotion<T> for () {
    type State = ();

    #[inline]
    fn state(&self) {}

    #[inline]
    fn rates(&self, (): &(), _s: T, _elastic: T) {}

    #[inline]
    fn slip(&self, (): &()) -> Option<T> {
        None
    }

    #[inline]
    fn rolls_from(&mut self, _time: T) {}

    #[inline]
    fn ended(self, (): &()) {}
}

impl<T: Real, P: SpinDamping<T>> SteppedMotion<T> for TangentialMotion<T, P> {
    /// Velocities of centre and periphery, and the ways of both.
    type State = ([T; 2], [T; 2]);

    #[inline]
    fn state(&self) -> Self::State {
        ([self.tangential, self.peripheral], [self.displacement, self.rotation])
    }

    #[inline]
    fn rates(&self, state: &Self::State, s: T, elastic: T) -> Self::State {
        let ([tangential, peripheral], _) = *state;
        let ratio = self.gyration_ratio;
        let braking = if P::PRESENT { self.peeling.rate() * s * peripheral } else { T::ZERO };
        let accelerations = if self.slides() {
            let force = self.direction * self.friction * elastic;
            [-force, force / ratio - braking]
        } else {
            // The friction that keeps the sphere rolling shares the moment between both.
            let shared = -(ratio / (T::ONE + ratio) * braking);
            [shared, shared]
        };
        (accelerations, [tangential, peripheral])
    }

    #[inline]
    fn slip(&self, state: &Self::State) -> Option<T> {
        let ([tangential, peripheral], _) = *state;
        self.slides().then(|| (tangential - peripheral) * self.direction)
    }

    #[inline]
    fn rolls_from(&mut self, time: T) {
        self.roll(time);
    }

    #[inline]
    fn ended(mut self, state: &Self::State) -> Self {
        ([self.tangential, self.peripheral], [self.displacement, self.rotation]) = *state;
        self
    }
}

/// Indentation and speed, integrals, and the tangential state.
type State<T, O, S> = ([T; 2], (O, S));

/// Follows the motion with a fixed step, `most` times at most.
fn integrate<T, L, O, S>(law: &L, energy: T, step: T, most: u32, (outputs, tangential): &mut (O, S)) -> NormalPath<T>
where
    T: Real,
    L: NormalLaw<T>,
    O: Integrals<T>,
    S: SteppedMotion<T>,
{
    let half = T::constant(0.5);
    let mut state: State<T, O, S::State> = ([T::ZERO, (energy + energy).sqrt()], (*outputs, tangential.state()));
    let mut times = Times::new();
    let effort = Effort { stretches: 0, refused: 0, sweeps: 0, nodes: 4, error: T::ZERO };
    let mut path = NormalPath { end: End::Budget, energy, peak: T::ZERO, turning: T::ZERO, effort };
    // A sphere that comes slower than a barrier is high turns back in front of it and has none to pass on its way out.
    let (brink, escape) = Some(brink(law)).filter(|(_, height)| energy > *height).unwrap_or((T::ZERO, T::ZERO));
    let held = |depth: T, speed: T| {
        let s = depth.max(T::ZERO).sqrt();
        s >= brink && half * speed * speed + law.potential(s) < escape
    };
    while path.effort.stretches < most {
        path.effort.stretches += 1;
        let [x, y] = state.0;
        let mut duration = step;
        let mut next = gill(law, tangential, &state, duration);
        // The earlier of separation and the end of sliding, by linear interpolation.
        let separates = y < T::ZERO && next.0[0] <= T::ZERO;
        let mut share = if separates { x / (x - next.0[0]) } else { T::ONE };
        let mut rolls = false;
        if let (Some(before), Some(after)) = (tangential.slip(&state.1.1), tangential.slip(&next.1.1))
            && after <= T::ZERO
            && before <= share * (before - after)
        {
            share = before / (before - after);
            rolls = true;
        }
        if separates || rolls {
            path.effort.refused += 1;
            duration = step * share;
            next = gill(law, tangential, &state, duration);
        }
        let [depth, speed] = next.0;
        if !(depth.is_finite() && speed.is_finite()) {
            break;
        }
        if y >= T::ZERO && speed < T::ZERO {
            let rest = duration * y / (y - speed);
            times.peak = times.now + rest;
            path.peak = (x + half * rest * y).sqrt();
        }
        state = next;
        times.now = times.now + duration;
        if rolls {
            tangential.rolls_from(times.now);
        } else if separates {
            path.end = End::Separation;
            path.energy = half * speed * speed;
            break;
        }
        if speed < T::ZERO && held(depth, speed) {
            path.end = End::Capture;
            break;
        }
    }
    let [depth, speed] = state.0;
    if path.end == End::Budget && held(depth, speed) {
        path.end = End::Capture;
    }
    path.effort.sweeps = path.effort.stretches + path.effort.refused;
    let (integrals, motion) = state.1;
    *outputs = integrals.timed(&times);
    *tangential = tangential.ended(&motion);
    path
}

/// A step by Gill's coefficients.
#[inline]
fn gill<T, L, O, S>(law: &L, tangential: &S, from: &State<T, O, S::State>, step: T) -> State<T, O, S::State>
where
    T: Real,
    L: NormalLaw<T>,
    O: Integrals<T>,
    S: SteppedMotion<T>,
{
    const ROOT: f64 = core::f64::consts::FRAC_1_SQRT_2;
    let change = |state: &State<T, O, S::State>| {
        let rates = rates(law, tangential, state);
        rates.combine(rates, |rate, _| step * rate)
    };
    let first = change(from);
    let state = from.combine(first, |state, k| state + T::constant(0.5) * k);
    // What a stage has not used of the changes so far.
    let second = change(&state);
    let state = state.combine(second.combine(first, |k, q| k - q), |state, d| state + T::constant(1.0 - ROOT) * d);
    let rest = second.combine(first, |k, q| T::constant(2.0 - 2.0 * ROOT) * k + T::constant(3.0 * ROOT - 2.0) * q);
    let third = change(&state);
    let state = state.combine(third.combine(rest, |k, q| k - q), |state, d| state + T::constant(1.0 + ROOT) * d);
    let rest = third.combine(rest, |k, q| T::constant(2.0 + 2.0 * ROOT) * k - T::constant(2.0 + 3.0 * ROOT) * q);
    let fourth = change(&state);
    let last = fourth.combine(rest, |k, q| T::constant(1.0 / 6.0) * k - T::constant(1.0 / 3.0) * q);
    state.combine(last, |state, d| state + d)
}

/// The rates of change: B6, the integrals, and the tangential side. Outside the contact no force acts.
#[inline]
fn rates<T, L, O, S>(law: &L, tangential: &S, state: &State<T, O, S::State>) -> State<T, O, S::State>
where
    T: Real,
    L: NormalLaw<T>,
    O: Integrals<T>,
    S: SteppedMotion<T>,
{
    let ([x, y], (integrals, motion)) = state;
    let (s, y) = (x.max(T::ZERO).sqrt(), *y);
    let rebound = y < T::ZERO;
    let acceleration = law.conservative_force(s) - law.damping(s, rebound) * y;
    let growth = integrals.growth(law, s, y.abs(), rebound);
    ([y, acceleration], (growth, tangential.rates(motion, s, law.elastic_force(s))))
}
