//! The search for the critical speed, by trials of a speed.

use super::collocation::ErrorControl;
use super::critical::Trial;
use crate::contact::Contact;
use crate::contact::law::ContactLaw;
use crate::{CriticalSpeed, InputError, Parameter, Real};

/// Trials that use the energies of those before; later ones halve the bracket.
const MOST_GUIDED_TRIALS: u32 = 24;

/// Halving the logarithm of the range of speeds down to rounding takes 56.
const HALVINGS: u32 = 64;

/// Trials at most.
pub(crate) const MOST_TRIALS: u32 = MOST_GUIDED_TRIALS + HALVINGS;

/// Excess below which the step v/(1 + excess) would be too long.
const LEAST_EXCESS: f64 = -0.99;

/// Estimated error of a secant, over the tolerance, at which the search ends.
const SECANT_ACCURACY: f64 = 0.1;

/// Error of a trial, over the tolerance: those of its two paths add up, and the secant adds its own.
const SHARE_OF_A_TRIAL: f64 = 0.5;

/// Factor on the error of further trials where one could not be solved.
const COARSER: f64 = 8.0;

/// Slope of the excess over the one that the trials were made for, below which they were not exact enough.
const MUCH_FLATTER: f64 = 0.5;

/// Relative width of a bracket, in roundings, that cannot be halved any more.
const BRACKET_ROUNDING: f64 = 4.0;

/// A search for a critical speed in steps, between which a firmware does other work.
///
/// [`Contact::critical_speed`] tries as many speeds as it needs at once; a step of this search tries at most as many as its budget allows.
/// What is known so far is kept in the search. The critical speed is that of [`Contact::critical_speed`] to the last bit.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, CriticalSpeedSearch};
/// use microimpact::{Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let method = Collocation::<7, f32>::new(1e-6)?;
/// let mut search = CriticalSpeedSearch::new();
/// let critical = loop {
///     // Here a firmware feeds its watchdog and answers its host.
///     if let Some(critical) = search.step(1, &scene, &method)? {
///         break critical;
///     }
/// };
/// assert_eq!(critical, scene.critical_speed(&method)?);
/// assert!((2..10).contains(&search.trials()));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CriticalSpeedSearch<T> {
    /// `None` before the first trial, whose speed depends on the scene.
    search: Option<Search<T>>,
    result: Option<Result<CriticalSpeed<T>, InputError>>,
}

impl<T: Real> CriticalSpeedSearch<T> {
    /// A search that has tried no speed.
    ///
    /// ```
    /// use microimpact::contact::CriticalSpeedSearch;
    ///
    /// assert_eq!(CriticalSpeedSearch::<f32>::new().trials(), 0);
    /// ```
    pub const fn new() -> Self {
        Self { search: None, result: None }
    }

    /// Goes on with at most `budget` trials of a speed, of which there are at most [`Contact::MOST_TRIALS`]. Scene and method must be the
    /// same in every step. Returns the critical speed, m/s, once it is found, also if it is asked for again. A budget of zero tries no speed.
    ///
    /// A trial takes two paths, of at most [`Collocation::MOST_INTERVALS`](super::Collocation::MOST_INTERVALS) intervals each.
    ///
    /// # Errors
    /// Those of [`Contact::critical_speed`], in every further step too.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, CriticalSpeedSearch};
    /// use microimpact::{CriticalSpeed, Sphere, Stiffness};
    ///
    /// // Nothing holds the sphere.
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
    /// let (method, mut search) = (Adaptive::new(1e-9)?, CriticalSpeedSearch::new());
    /// assert_eq!(search.step(0, &scene, &method)?, None);
    /// assert_eq!(search.step(1, &scene, &method)?, Some(CriticalSpeed::AlwaysRebounds));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn step<L: ContactLaw<T>, S>(
        &mut self,
        budget: u32,
        scene: &Contact<T, L, S>,
        method: &impl ErrorControl<T>,
    ) -> Result<Option<CriticalSpeed<T>>, InputError> {
        let mut search = self.search.unwrap_or_else(|| Search::starting(scene.first_trial()));
        for _ in 0..budget {
            if self.result.is_some() {
                break;
            }
            let found = search.try_next(method.tolerance(), |speed, allowed| scene.try_speed(speed, allowed, method));
            self.result = found.map(|found| scene.suited(found?));
        }
        self.search = Some(search);
        self.result.transpose()
    }

    /// Trials so far.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, CriticalSpeedSearch};
    /// use microimpact::{Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let mut search = CriticalSpeedSearch::new();
    /// assert_eq!(search.step(2, &scene, &Adaptive::new(1e-9)?)?, None);
    /// assert_eq!(search.trials(), 2);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn trials(&self) -> u32 {
        self.search.map_or(0, |search| search.trials)
    }
}

impl<T: Real> Default for CriticalSpeedSearch<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// The approach speed that separates capture from rebound to a relative `tolerance`, by trials of a speed to a tolerance, from the
/// speed `first` on.
pub(crate) fn critical_speed<T: Real>(
    first: T,
    tolerance: T,
    mut try_speed: impl FnMut(T, T) -> Result<Trial<T>, InputError>,
) -> Result<CriticalSpeed<T>, InputError> {
    let mut search = Search::starting(first);
    loop {
        if let Some(result) = search.try_next(tolerance, &mut try_speed) {
            return result;
        }
    }
}

/// A search for the root of the excess in a bracket of speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Search<T> {
    /// The first trial.
    first: T,
    trials: u32,
    /// The trial.
    speed: T,
    /// The largest speed known to be captured and the smallest known to rebound; ends of the range before there are any.
    bracket: (T, T),
    /// Whether those ends have been tried.
    tried: (bool, bool),
    /// Why the ends of the bracket could not be tried.
    errors: (Option<InputError>, Option<InputError>),
    /// Speed and excess of the last trial that had one.
    last: Option<(T, T)>,
    /// Change of the excess for each relative change of the speed, at most one. Where it is small, as under strong damping, the
    /// trials have to be as much more exact.
    slope: T,
    /// By how much the trials are less exact, since rounding hides smaller errors.
    coarser: T,
}

fn speed_range<T: Real>() -> (T, T) {
    let (slowest, fastest) = Parameter::ApproachSpeed.range();
    (T::constant(slowest), T::constant(fastest))
}

impl<T: Real> Search<T> {
    fn from(speed: T) -> Self {
        let (bracket, one) = (speed_range(), T::ONE);
        let (tried, errors) = ((false, false), (None, None));
        Self { first: speed, trials: 0, speed, bracket, tried, errors, last: None, slope: one, coarser: one }
    }

    /// From a first speed, or from the end of the range that is nearest to it.
    fn starting(first: T) -> Self {
        let (slowest, fastest) = speed_range();
        Self::from(first.max(slowest).min(fastest))
    }

    /// Tries the next speed; the result, once there is one.
    fn try_next(
        &mut self,
        tolerance: T,
        try_speed: impl FnOnce(T, T) -> Result<Trial<T>, InputError>,
    ) -> Option<Result<CriticalSpeed<T>, InputError>> {
        if self.trials >= MOST_TRIALS {
            return Some(self.result());
        }
        let allowed = T::constant(SHARE_OF_A_TRIAL) * self.slope * self.coarser * tolerance;
        let outcome = try_speed(self.speed, allowed);
        self.trials += 1;
        self.note(outcome, tolerance)
    }

    /// Takes in the outcome of the trial; the result, or the next trial.
    fn note(
        &mut self,
        outcome: Result<Trial<T>, InputError>,
        tolerance: T,
    ) -> Option<Result<CriticalSpeed<T>, InputError>> {
        let (slowest, fastest) = speed_range::<T>();
        let Self { first, speed, .. } = *self;
        let guided = self.trials <= MOST_GUIDED_TRIALS;
        let (rebounds, excess, error) = match outcome {
            Ok(Trial::Free) => return Some(Ok(CriticalSpeed::AlwaysRebounds)),
            Ok(Trial::Tried { rebounds, excess }) => (rebounds, excess, None),
            Ok(Trial::Unsolved) => {
                self.coarser = self.coarser * T::constant(COARSER);
                return Parameter::Tolerance.check(self.coarser * tolerance).err().map(Err);
            }
            // Forces outgrow the elastic one at low speeds; damping does so at high ones as well.
            Err(error) => (error.parameter == Parameter::DampingRatio && speed > first, None, Some(error)),
        };
        if rebounds {
            if speed <= slowest {
                return Some(error.map_or(Ok(CriticalSpeed::AlwaysRebounds), Err));
            }
            (self.bracket.1, self.tried.1, self.errors.1) = (speed, true, error);
        } else {
            if speed >= fastest {
                return Some(error.map_or(Ok(CriticalSpeed::NeverRebounds), Err));
            }
            (self.bracket.0, self.tried.0, self.errors.0) = (speed, true, error);
        }
        let (low, high) = self.bracket;
        if high <= low * (T::ONE + T::constant(BRACKET_ROUNDING) * T::EPSILON) {
            return Some(self.result());
        }
        let (mut next, mut error, mut slope) = (T::ZERO, T::ONE, T::ONE);
        if let Some(excess) = excess.filter(|_| guided) {
            let step = excess.saturating_div(self.slope);
            if step > T::constant(LEAST_EXCESS) {
                next = speed / (T::ONE + step);
            }
            if let Some((before, other)) = self.last.filter(|(_, other)| *other != excess) {
                slope = (excess - other) / (speed - before);
                let secant = speed - excess / slope;
                slope = slope * speed;
                if secant > low && secant < high {
                    next = secant;
                    // The error of a secant is the product of those of its two points, times a number of order one: in the speed, or
                    // in the excess where that grows faster.
                    error = ((next - speed) / next * ((next - before) / next)).abs();
                    error = error.max((excess * other).abs().saturating_div(slope));
                }
            }
            self.last = Some((speed, excess));
        }
        if error <= T::constant(SECANT_ACCURACY) * tolerance {
            if slope >= T::constant(MUCH_FLATTER) * self.slope {
                return Some(Ok(CriticalSpeed::At(next)));
            }
            // What the trials so far have told is not exact enough.
            *self = Self {
                first,
                trials: self.trials,
                slope: slope.max(T::EPSILON),
                coarser: self.coarser,
                ..Self::from(next)
            };
            return None;
        }
        self.speed = if next > low && next < high {
            next
        } else if speed == low && high >= fastest && !self.tried.1 {
            fastest
        } else if speed == high && low <= slowest && !self.tried.0 {
            slowest
        } else {
            (low * high).sqrt()
        };
        None
    }

    fn result(&self) -> Result<CriticalSpeed<T>, InputError> {
        let (low, high) = self.bracket;
        let (slowest, fastest) = speed_range();
        match self.errors.0.or(self.errors.1) {
            Some(error) => Err(error),
            None if high >= fastest => Ok(CriticalSpeed::NeverRebounds),
            None if low <= slowest => Ok(CriticalSpeed::AlwaysRebounds),
            None => Ok(CriticalSpeed::At((low * high).sqrt())),
        }
    }
}
