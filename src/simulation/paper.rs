//! The paper's own method, for comparison: Runge-Kutta-Gill with a fixed time step on the equations as they are printed.
//!
//! It integrates B6 to B10 in indentation x and speed y = x', with forces of x^(1/2) and x^(3/2). The units are those of
//! the other methods, which leaves the errors of a fixed step as they are. Where sliding or contact ends, linear interpolation
//! estimates the time, and the step is repeated up to it. As the forces are not smooth where x = 0, the error falls with
//! the power 3/2 of the step with adhesion and 5/2 without, not 4.

use super::Simulation;
use super::law::{Attraction, Damping, HertzLaw, NormalLaw};
use super::motion::{Effort, End, NormalPath};
use super::observer::{Impulses, Observer, Times, Works};
use super::outcome::{Everything, NormalContact, Output, Status};
use super::scaled::Scale;
use super::tangential::{SpinDamping, TangentialMotion, TangentialScene};
use crate::{Approach, Hertz, InputError, Real};

/// The method of Runge, Kutta and Gill with a fixed step.
///
/// ```
/// use microimpact::simulation::{RungeKuttaGill, Simulation, SteppedImpact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let motion = NormalMotion::new(2.8)?;
/// let error = |steps| -> Result<f64, microimpact::InputError> {
///     let impact: SteppedImpact<f64, (), ()> = scene.stepped_impact(&RungeKuttaGill::new(steps), &motion)?;
///     Ok((impact.normal.overall_restitution() - 0.746193).abs())
/// };
/// assert!(error(100)? > 1e-5); // an error of 1e-6 takes thousands of steps
/// assert!(error(20_000)? < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// What a run with fixed steps took.
///
/// ```
/// use microimpact::simulation::{RungeKuttaGill, Simulation, Status, StepReport, SteppedImpact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let impact: SteppedImpact<f64, ()> = scene.stepped_impact(&RungeKuttaGill::new(100), &NormalMotion::new(1.0)?)?;
/// let StepReport { status, steps } = impact.run;
/// assert_eq!(status, Status::Solved);
/// assert!(steps >= 101); // the last one goes beyond the contact and is repeated
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepReport {
    /// Whether the run came to its end.
    pub status: Status,
    /// Steps, repeated ones included; each evaluates the forces four times.
    pub steps: u32,
}

/// The result of a run with fixed steps, with `G` for the tangential side and `O` for the outputs.
///
/// ```
/// use microimpact::simulation::{RungeKuttaGill, Simulation, SteppedImpact};
/// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
///
/// // Table 1 of the paper.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
/// let impact: SteppedImpact<f64, _> = scene.stepped_impact(&RungeKuttaGill::new(2000), &before)?;
/// assert_eq!(impact.tangential.motion(), SurfaceMotion::Rolling);
/// assert!((impact.outputs.works.adhesion - 4.83e-13).abs() < 1e-15);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteppedImpact<T, G, O = Everything<T>> {
    /// Along the normal; a captured sphere is left as soon as it cannot escape, so its turning point is not known.
    pub normal: NormalContact<T>,
    /// Along the surface, where friction takes part.
    pub tangential: G,
    /// What else was asked for.
    pub outputs: O,
    /// What the run took.
    pub run: StepReport,
}

/// The paper's own method.
impl<T, D, A, F, P, X> Simulation<T, D, A, F, P, X>
where
    T: Real,
    D: Scale<T, Scaled: Damping<T>>,
    A: Scale<T, Scaled: Attraction<T>>,
    X: Scale<T, Scaled: Attraction<T>>,
{
    /// The impact of a sphere by the paper's method, for comparison, with the outputs that the type `O` names as in
    /// [`observe`](Self::observe).
    ///
    /// # Errors
    /// As [`impact`](Self::impact).
    ///
    /// ```
    /// use microimpact::simulation::{ContactTimes, RungeKuttaGill, Simulation, SteppedImpact};
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let motion = NormalMotion::new(1.0)?;
    /// let impact: SteppedImpact<_, (), ContactTimes<f64>> =
    ///     Simulation::new(sphere, stiffness).stepped_impact(&RungeKuttaGill::new(400), &motion)?;
    /// assert!((impact.outputs.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0).abs() < 1e-5);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn stepped_impact<M, O>(
        &self,
        method: &RungeKuttaGill,
        motion: &M,
    ) -> Result<SteppedImpact<T, F::Contact, O>, InputError>
    where
        M: Approach<T>,
        F: TangentialScene<T, M, A, P, Observer: SteppedMotion<T>>,
        O: Output<T, Observer: SteppedOutput<T>>,
    {
        let approach = motion.normal().speed();
        let units = self.units(approach)?;
        let tangential = self.friction.start(&self.sphere, &self.adhesion, &self.peeling, motion, &units)?;
        let law = self.law(&units)?;
        let duration = Hertz::new(&self.sphere, self.stiffness, motion).duration / units.time();
        let step = duration / T::constant(f64::from(method.steps));
        let most = method.steps.saturating_mul(RungeKuttaGill::LONGEST_RUN);
        let run = integrate(&law, units.energy, step, most, O::begin(), tangential);
        Ok(SteppedImpact {
            normal: NormalContact::new(&run.path, approach, &self.sphere, self.stiffness, &units),
            tangential: F::finish(run.tangential, &self.sphere, &units),
            outputs: O::finish(run.outputs, &run.path, &self.sphere, &units),
            run: run.report,
        })
    }
}

/// Quantities that are integrated together; none at all is `()`.
pub trait Quantities<T: Real>: Copy {
    /// `of` each quantity and its counterpart.
    #[must_use]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self;
}

impl<T: Real> Quantities<T> for () {
    #[inline]
    fn combine(self, (): Self, _of: impl Fn(T, T) -> T + Copy) {}
}

impl<T: Real> Quantities<T> for [T; 2] {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        let ([a, b], [c, d]) = (self, other);
        [of(a, c), of(b, d)]
    }
}

/// Times are not integrated.
impl<T: Real> Quantities<T> for Times<T> {
    #[inline]
    fn combine(self, _other: Self, _of: impl Fn(T, T) -> T + Copy) -> Self {
        self
    }
}

impl<T: Real> Quantities<T> for Impulses<T> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self {
            elastic: of(self.elastic, other.elastic),
            adhesion_rebound: of(self.adhesion_rebound, other.adhesion_rebound),
        }
    }
}

impl<T: Real> Quantities<T> for Works<T> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self { material: of(self.material, other.material), adhesion: of(self.adhesion, other.adhesion) }
    }
}

impl<T: Real, A: Quantities<T>, B: Quantities<T>> Quantities<T> for (A, B) {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        (self.0.combine(other.0, of), self.1.combine(other.1, of))
    }
}

/// Integrals over the motion, and what they grow by in time at contact radius s and speed y, negative on rebound.
pub trait SteppedOutput<T: Real>: Quantities<T> {
    /// Growth of each integral.
    fn growth(law: &impl NormalLaw<T>, s: T, y: T) -> Self;

    /// What is known at the end, with the times of the motion.
    #[must_use]
    #[inline]
    fn timed(self, _times: &Times<T>) -> Self {
        self
    }
}

impl<T: Real> SteppedOutput<T> for () {
    #[inline]
    fn growth(_law: &impl NormalLaw<T>, _s: T, _y: T) {}
}

impl<T: Real> SteppedOutput<T> for Times<T> {
    #[inline]
    fn growth(_law: &impl NormalLaw<T>, _s: T, _y: T) -> Self {
        Self::new()
    }

    #[inline]
    fn timed(self, times: &Times<T>) -> Self {
        *times
    }
}

impl<T: Real> SteppedOutput<T> for Impulses<T> {
    #[inline]
    fn growth(law: &impl NormalLaw<T>, s: T, y: T) -> Self {
        let adhesion_rebound = if y < T::ZERO { law.adhesion_force(s) - law.adhesion_damping(s) * y } else { T::ZERO };
        Self { elastic: law.elastic_force(s), adhesion_rebound }
    }
}

impl<T: Real> SteppedOutput<T> for Works<T> {
    #[inline]
    fn growth(law: &impl NormalLaw<T>, s: T, y: T) -> Self {
        let adhesion = if y < T::ZERO { law.adhesion_damping(s) * y * y } else { T::ZERO };
        Self { material: law.material_damping(s) * y * y, adhesion }
    }
}

impl<T: Real, A: SteppedOutput<T>, B: SteppedOutput<T>> SteppedOutput<T> for (A, B) {
    #[inline]
    fn growth(law: &impl NormalLaw<T>, s: T, y: T) -> Self {
        (A::growth(law, s, y), B::growth(law, s, y))
    }

    #[inline]
    fn timed(self, times: &Times<T>) -> Self {
        (self.0.timed(times), self.1.timed(times))
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

/// A finished run, in units of the scene.
struct Run<T, O, S> {
    path: NormalPath<T>,
    outputs: O,
    tangential: S,
    report: StepReport,
}

/// Indentation and speed, integrals, and the tangential state.
type State<T, O, S> = ([T; 2], (O, S));

/// Follows the motion with a fixed step, `most` times at most.
fn integrate<T, D, A, X, O, S>(
    law: &HertzLaw<D, A, X>,
    energy: T,
    step: T,
    most: u32,
    outputs: O,
    mut tangential: S,
) -> Run<T, O, S>
where
    T: Real,
    D: Damping<T>,
    A: Attraction<T>,
    X: Attraction<T>,
    O: SteppedOutput<T>,
    S: SteppedMotion<T>,
{
    let half = T::constant(0.5);
    let mut state: State<T, O, S::State> = ([T::ZERO, (energy + energy).sqrt()], (outputs, tangential.state()));
    let mut times = Times::new();
    let effort = Effort { stretches: 0, refused: 0, sweeps: 0, error: T::ZERO };
    let mut path = NormalPath { end: End::Budget, energy, peak: T::ZERO, turning: T::ZERO, effort };
    let mut steps = 0;
    while steps < most {
        steps += 1;
        let [x, y] = state.0;
        let mut duration = step;
        let mut next = gill(law, &tangential, &state, duration);
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
            steps += 1;
            duration = step * share;
            next = gill(law, &tangential, &state, duration);
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
        if speed < T::ZERO {
            path.energy = half * speed * speed + law.potential(depth.max(T::ZERO).sqrt());
            if path.energy < T::ZERO {
                path.end = End::Capture;
                break;
            }
        }
    }
    let [x, y] = state.0;
    if path.end == End::Budget && half * y * y + law.potential(x.max(T::ZERO).sqrt()) < T::ZERO {
        path.end = End::Capture;
    }
    let status = if path.end == End::Budget { Status::BudgetSpent } else { Status::Solved };
    let (outputs, motion) = state.1;
    let (outputs, tangential) = (outputs.timed(&times), tangential.ended(&motion));
    Run { path, outputs, tangential, report: StepReport { status, steps } }
}

/// A step by Gill's coefficients.
#[inline]
fn gill<T, D, A, X, O, S>(
    law: &HertzLaw<D, A, X>,
    tangential: &S,
    from: &State<T, O, S::State>,
    step: T,
) -> State<T, O, S::State>
where
    T: Real,
    D: Damping<T>,
    A: Attraction<T>,
    X: Attraction<T>,
    O: SteppedOutput<T>,
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
fn rates<T, D, A, X, O, S>(
    law: &HertzLaw<D, A, X>,
    tangential: &S,
    state: &State<T, O, S::State>,
) -> State<T, O, S::State>
where
    T: Real,
    D: Damping<T>,
    A: Attraction<T>,
    X: Attraction<T>,
    O: SteppedOutput<T>,
    S: SteppedMotion<T>,
{
    let ([x, y], (_, motion)) = state;
    let (s, y) = (x.max(T::ZERO).sqrt(), *y);
    let elastic = law.elastic_force(s);
    let inwards = law.adhesion_force(s) + law.force.force(s);
    let acceleration = inwards - elastic - law.damping(s, y < T::ZERO) * y;
    ([y, acceleration], (O::growth(law, s, y), tangential.rates(motion, s, elastic)))
}
