//! The method that chooses by itself: whole phases where damping is mild and the tolerance not too small, else intervals.

use super::collocation::{Collocation, ErrorControl, at_least_rounding};
use super::critical::Trial;
use super::interval::{Interval, tail_of_times};
use super::nodes::{Nodes, PhaseSamples, WEIGHT_POWER};
use super::observer::Observer;
use super::path::{Effort, End, Method, NormalPath, find_end_of_slip};
use super::phase::Phase;
use super::rest::{RestCriterion, Settling};
use crate::contact::law::ContactLaw;
use crate::{InputError, Parameter, Real};

/// Error control by whatever is fastest for a scene and a tolerance: mild damping lets each phase be one polynomial, with as
/// many nodes as the tolerance needs; everything else goes to [`Collocation`].
///
/// It contains the code for every number of nodes: firmware that knows its scenes does better with
/// [`FixedCost`](super::FixedCost) or one [`Collocation`].
///
/// ```
/// use microimpact::contact::{Adaptive, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // From no damping to so much that the sphere hardly leaves the surface: d (1 + e) = ln((1 + d)/(1 - e d)).
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let motion = NormalMotion::new(1.0)?;
/// for zeta in [0.1, 10.0, 1e3, 1e5] {
///     let scene = Contact::hertz(sphere, stiffness).with_damping(zeta)?;
///     let e = scene.solve(&motion, &Adaptive::new(1e-9)?)?.normal.overall_restitution();
///     let d: f64 = scene.groups(&motion)?.material_damping;
///     assert!((1.0 - e * d - (1.0 + d) * (-d * (1.0 + e)).exp()).abs() < 1e-6 * d.max(1.0));
/// }
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Adaptive<T> {
    tolerance: T,
}

/// A number type with the tables for every number of nodes that a tolerance may need.
///
/// ```
/// fn restitution<T: microimpact::contact::AdaptiveNodes>() {}
///
/// restitution::<f32>();
/// restitution::<f64>();
/// ```
pub trait AdaptiveNodes:
    PhaseSamples<5, 10>
    + PhaseSamples<7, 13>
    + PhaseSamples<9, 16>
    + PhaseSamples<10, 18>
    + PhaseSamples<13, 24>
    + PhaseSamples<14, 26>
    + Nodes<7>
    + Nodes<9>
    + Nodes<10>
    + Nodes<12>
    + Nodes<14>
{
}

impl<T> AdaptiveNodes for T where
    T: PhaseSamples<5, 10>
        + PhaseSamples<7, 13>
        + PhaseSamples<9, 16>
        + PhaseSamples<10, 18>
        + PhaseSamples<13, 24>
        + PhaseSamples<14, 26>
        + Nodes<7>
        + Nodes<9>
        + Nodes<10>
        + Nodes<12>
        + Nodes<14>
{
}

impl<T: Real> Adaptive<T> {
    /// A method with a tolerance for e^2 and, relative to themselves, for all outputs asked for; a number type's rounding
    /// limits it from below.
    ///
    /// # Errors
    /// A tolerance outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::Adaptive::new(1e-6).is_ok());
    /// assert!(microimpact::contact::Adaptive::new(0.0).is_err());
    /// ```
    pub fn new(tolerance: T) -> Result<Self, InputError> {
        Ok(Self { tolerance: at_least_rounding(Parameter::Tolerance.check(tolerance)?) })
    }
}

/// A call of [`Collocation`] with the number of nodes that suits a tolerance.
macro_rules! by_intervals {
    ($tolerance:expr, $method:ident($($argument:expr),*)) => {{
        let tolerance = $tolerance;
        if tolerance >= T::constant(3e-7) {
            Collocation::<7, T> { tolerance }.$method($($argument),*)
        } else if tolerance >= T::constant(3e-10) {
            Collocation::<9, T> { tolerance }.$method($($argument),*)
        } else if tolerance >= T::constant(1e-11) {
            Collocation::<10, T> { tolerance }.$method($($argument),*)
        } else if tolerance >= T::constant(3e-13) {
            Collocation::<12, T> { tolerance }.$method($($argument),*)
        } else {
            Collocation::<14, T> { tolerance }.$method($($argument),*)
        }
    }};
}

impl<T: AdaptiveNodes> ErrorControl<T> for Adaptive<T> {
    fn tolerance(&self) -> T {
        self.tolerance
    }

    fn solve_to_rest<L: ContactLaw<T>, O: Observer<T>>(
        &self,
        law: &L,
        energy: T,
        observer: &mut O,
        criterion: &RestCriterion<T>,
    ) -> (NormalPath<T>, Option<Settling<T>>) {
        by_intervals!(self.tolerance, solve_to_rest(law, energy, observer, criterion))
    }

    fn try_energy<L: ContactLaw<T>>(&self, law: &L, energy: T) -> Trial<T> {
        by_intervals!(self.tolerance, try_energy(law, energy))
    }
}

impl<T: AdaptiveNodes> Method<T> for Adaptive<T> {
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        let tolerance = self.tolerance;
        let whole_phases = law.loss_power() >= WEIGHT_POWER && !law.may_have_barrier();
        let mut attempts = Attempts { tolerance, allowed: if whole_phases { 2 } else { 0 } };
        // Each number of nodes from the tolerance on that it mostly reaches, with times and without, to one that fewer reach
        // with ease.
        macro_rules! try_phases {
            ($nodes:literal, $outputs:literal, $timed:literal, $untimed:literal, $enough:literal) => {
                let reached = T::constant(if O::TIMED { $timed } else { $untimed });
                if tolerance >= reached
                    && tolerance < T::constant($enough)
                    && let Some(path) = attempts.phases::<L, O, $nodes, $outputs>(law, energy, observer)
                {
                    return path;
                }
            };
        }
        try_phases!(5, 10, 3e-5, 1e-5, 1.0);
        try_phases!(7, 13, 5e-7, 3e-7, 1e-4);
        try_phases!(9, 16, 2e-8, 1e-8, 1e-5);
        try_phases!(10, 18, 7e-9, 2e-9, 2e-7);
        // To divide so many nodes where the sphere begins to roll costs more than intervals do.
        if !O::EVENTS {
            try_phases!(13, 24, 6e-10, 3e-11, 5e-8);
            try_phases!(14, 26, 2e-10, 8e-12, 2e-9);
        }
        by_intervals!(tolerance, solve(law, energy, observer))
    }
}

/// Sweeps that a phase may take.
const MOST_SWEEPS: u32 = 12;

/// Square of the change of the speeds, over that of the tolerance, at which the sweeps end.
const SETTLED: f64 = 0.1;

/// Square of the change of the speeds above which their reciprocals are renewed.
const UNSTEADY: f64 = 1e-3;

/// Loss over speed at the peak beyond which sweeps take longer than intervals.
const STRONGEST: f64 = 5.0;

/// Both phases by `N` nodes and their outputs by `M`, unless the motion does not lend itself to it or the estimated error is
/// too large.
fn phases<T, L, O, const N: usize, const M: usize>(
    law: &L,
    energy: T,
    tolerance: T,
    observer: &mut O,
) -> Result<NormalPath<T>, Failed>
where
    T: PhaseSamples<N, M>,
    L: ContactLaw<T>,
    O: Observer<T>,
{
    let mut phase = Phase::<T, N>::approach(law, energy);
    if phase.loss[0] > T::constant(STRONGEST) * phase.speed[0] {
        return Err(Failed::ByFar);
    }
    let mut sweeps = 0;
    let mut settle = |phase: &mut Phase<T, N>, after: &mut dyn FnMut(&mut Phase<T, N>, T)| {
        let (enough, mut before) = (T::constant(SETTLED) * tolerance * tolerance, T::ZERO);
        for _ in 0..MOST_SWEEPS {
            let (gained, change) = phase.sweep::<true>();
            sweeps += 1;
            after(phase, gained);
            // Sweeps converge superlinearly.
            if change <= enough || change * change <= enough * before {
                return Ok(gained);
            }
            if change > T::constant(UNSTEADY) {
                phase.renew();
            }
            before = change;
        }
        Err(Failed::ByFar)
    };
    let mut at_peak = energy;
    settle(&mut phase, &mut |phase, lost| {
        at_peak = phase.correct_peak(law, energy, lost);
        phase.describe(law, false);
    })?;
    let peak = phase.peak;
    let tails = phase.tails(energy);
    let mut error = tails.error_of_energy();
    let judge = |error: T| match error {
        _ if error <= tolerance => Ok(()),
        _ if error <= T::constant(100.0) * tolerance => Err(Failed::ByLittle),
        _ => Err(Failed::ByFar),
    };
    let approach = O::OBSERVES.then(|| phase.samples::<M>(law, false));
    let timed = |interval: &Option<Interval<T, M>>, least: T| {
        let Some(interval) = interval else { return least };
        let share = tail_of_times::<T, M>(&interval.rate);
        least.max(T::constant(0.1) * share * share)
    };
    if O::TIMED {
        error = error.max(timed(&approach, tails.error_of_times()));
    }
    judge(error)?;
    let before = phase.clone();
    phase.turn(law);
    let gained = settle(&mut phase, &mut |_, _| {})?;
    let tails = phase.tails(energy);
    error = error.max(tails.error_of_energy());
    let left = at_peak + gained;
    if left <= T::ZERO && O::TO_TURNING_POINT {
        return Err(Failed::ByFar);
    }
    let rebound = O::OBSERVES.then(|| phase.samples::<M>(law, true));
    if O::TIMED {
        error = error.max(timed(&rebound, tails.error_of_times()));
    }
    judge(error)?;
    if left.abs() <= T::constant(4.0) * error * energy {
        return Err(Failed::ByLittle);
    }
    if let (Some(approach), Some(rebound)) = (&approach, &rebound) {
        show(law, &before, approach, false, tolerance, observer);
        show(law, &phase, rebound, true, tolerance, observer);
    }
    let end = if left > T::ZERO { End::Separation } else { End::Capture };
    let effort = Effort { intervals: 2, refused: 0, sweeps, nodes: N as u32, error };
    Ok(NormalPath { end, energy: left, peak, turning: T::ZERO, effort })
}

/// Shows a phase to an observer, in two parts if the sphere begins to roll in it.
pub(super) fn show<T, O, const N: usize, const M: usize>(
    law: &impl ContactLaw<T>,
    phase: &Phase<T, N>,
    whole: &Interval<T, M>,
    rebound: bool,
    tolerance: T,
    observer: &mut O,
) where
    T: PhaseSamples<N, M>,
    O: Observer<T>,
{
    let rolls_at = if O::EVENTS { observer.rolls_at(law, whole) } else { None };
    let Some(share) = rolls_at else {
        return observer.observe(law, whole, rebound);
    };
    let gains = phase.gains::<M>();
    let place = |share: T| if rebound { share } else { T::ONE - share };
    let first = |share: T| phase.part(law, &gains, place(T::ZERO), place(share));
    let (share, part, late) = find_end_of_slip(law, observer, share, tolerance, first);
    let late = late / share * part.rate.last().copied().unwrap_or(T::ZERO);
    let mut rest = || phase.part(law, &gains, place(share), place(T::ONE));
    observer.observe_rolling(law, whole, &part, late, &mut rest, rebound);
}

/// How an attempt failed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Failed {
    /// A few nodes more may be enough.
    ByLittle,
    ByFar,
}

/// Attempts at whole phases: a second one only where the first was not enough by little.
struct Attempts<T> {
    tolerance: T,
    allowed: u32,
}

impl<T: Real> Attempts<T> {
    fn phases<L, O, const N: usize, const M: usize>(
        &mut self,
        law: &L,
        energy: T,
        observer: &mut O,
    ) -> Option<NormalPath<T>>
    where
        T: PhaseSamples<N, M>,
        L: ContactLaw<T>,
        O: Observer<T>,
    {
        if self.allowed == 0 {
            return None;
        }
        let solved = phases::<T, L, O, N, M>(law, energy, self.tolerance, observer);
        self.allowed = if solved.as_ref().err() == Some(&Failed::ByLittle) { self.allowed - 1 } else { 0 };
        solved.ok()
    }
}
