//! A method of fixed cost for firmware: approach and rebound are one polynomial each, in a fixed number of iterations.

#[cfg(doc)]
use super::Collocation;
use super::adaptive::show;
use super::nodes::{PhaseNodes, PhaseSamples, WEIGHT_POWER};
use super::observer::Observer;
use super::path::{End, Method, NormalPath, Statistics};
use super::phase::Phase;
use super::well::barrier;
use crate::contact::law::ContactLaw;
use crate::{InputError, Parameter};

/// A method that costs about the same for every impact: `N` nodes and a fixed number of iterations for each phase, and `M`
/// nodes for outputs.
///
/// The error of e over the scenes of the paper and others as mildly damped is 1e-5 with five nodes and 1e-6 with seven, both
/// in three iterations. Stronger damping needs more iterations; where they do not converge to some thousandths of the
/// energy, the status of the result is not *solved*. If the approach speed is closer to the critical speed than the error,
/// the outcome is not certain: use [`Collocation`] for such impacts.
///
/// ```
/// use microimpact::contact::{Contact, FixedCost};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(5.06e-6_f32, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let impact = scene.solve(&NormalMotion::new(2.8)?, &FixedCost::<5>::new(3)?)?;
/// assert!((impact.normal.overall_restitution() - 0.746193).abs() < 1e-5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FixedCost<const N: usize, const M: usize = 9> {
    iterations: u32,
}

impl<const N: usize> FixedCost<N> {
    /// A method with a number of iterations for each phase, 1 to 40, and nine nodes for outputs.
    ///
    /// # Errors
    /// A number outside its range.
    ///
    /// ```
    /// assert!(microimpact::contact::FixedCost::<5>::new(0).is_err());
    /// ```
    pub fn new(iterations: u32) -> Result<Self, InputError> {
        Parameter::Iterations.check(f64::from(iterations))?;
        Ok(Self { iterations })
    }

    /// The same method, with velocities along the surface and outputs from `M` nodes of each phase. Where neither is
    /// asked for, no code for them is generated.
    ///
    /// With two nodes more than `N` velocities along the surface are as exact as e, relative to the slip; impulses take three
    /// more, and times near the critical speed twice as many. Outputs that look for the end of sliding
    /// ([`Slip`](crate::contact::Slip), [`Energy`](crate::contact::Energy)) and a peeling moment need four more; with fewer
    /// the status is [`Unsupported`](super::Status::Unsupported).
    ///
    /// ```
    /// use microimpact::contact::{Contact, FixedCost, Times};
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let motion = NormalMotion::new(1.0)?;
    /// let method = FixedCost::<7>::new(3)?.with_outputs::<10>();
    /// let (_, times) = Contact::hertz(sphere, stiffness).solve_for(&motion, &method, Times)?;
    /// assert!((times.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0_f64).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_outputs<const M: usize>(self) -> FixedCost<N, M> {
        FixedCost { iterations: self.iterations }
    }
}

/// Nodes beyond those of a phase that the end of sliding needs: the square of the speed is that much a higher polynomial.
const NODES_OF_EVENTS: usize = 4;

/// Change of the remaining energy by the last iterations, over the energy before, up to which they count as converged.
const CONVERGED: f64 = 0.003;

/// Change of the remaining energy by an iteration, over the energy before, above which the reciprocals of the speeds are
/// renewed: below it their error changes the energy by less than its square.
const UNSTEADY: f64 = 0.01;

/// Loss over speed at the peak above which iterations can converge to a wrong value: the error that an iteration leaves is in
/// proportion to it.
const STRONGEST: f64 = 30.0;

/// Remaining energy over the energy before, above which there is no solution: no phase gains energy, but for rounding.
const LARGEST_GAIN: f64 = 1.0001;

/// Change by the last iterations over the energy that a capture lacks, below which its sign is certain.
const CLEAR_CAPTURE: f64 = 0.25;

/// Tolerance to which the end of sliding is found within a phase, for outputs that need it.
const END_OF_SLIP: f64 = 1e-9;

impl<T, const N: usize, const M: usize> Method<T> for FixedCost<N, M>
where
    T: PhaseSamples<N, M>,
{
    #[inline]
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        if law.loss_power() < WEIGHT_POWER || (O::EVENTS && M < N + NODES_OF_EVENTS) {
            return NormalPath::unsupported(energy);
        }
        self.run(law, energy, |phase: &Phase<T, N>, rebound| {
            if O::OBSERVES {
                let tolerance = T::constant(END_OF_SLIP).max(T::EPSILON);
                show(law, phase, &phase.samples::<M>(law, rebound), rebound, tolerance, observer);
            }
        })
    }
}

impl<const N: usize, const M: usize> FixedCost<N, M> {
    /// Approach and rebound, each shown to `observe` when it is solved.
    #[inline]
    fn run<T, L>(&self, law: &L, energy: T, mut observe: impl FnMut(&Phase<T, N>, bool)) -> NormalPath<T>
    where
        T: PhaseNodes<N>,
        L: ContactLaw<T>,
    {
        let moves = |by: T| by.abs() > T::constant(UNSTEADY) * energy;
        let mut phase = Phase::<T, N>::approach(law, energy);
        let mut lost = phase.estimate;
        // Change of the energy lost by the last iteration; before the first as large as takes the reciprocals.
        let (mut moved, mut at_peak) = (energy, energy);
        for iteration in 0..self.iterations {
            if iteration > 0 {
                phase.describe(law, false);
            }
            if moves(moved) {
                phase.renew();
            }
            let before = lost;
            lost = phase.iterate::<false>().0;
            moved = lost - before;
            at_peak = phase.correct_peak(law, energy, lost);
        }
        let changed = moved.abs();
        observe(&phase, false);
        phase.turn(law);
        let mut gained = T::ZERO;
        moved = energy;
        for _ in 0..self.iterations {
            if moves(moved) {
                phase.renew();
            } else {
                phase.renew_slowest();
            }
            let before = gained;
            gained = phase.iterate::<false>().0;
            moved = gained - before;
        }
        let changed = changed + moved.abs();
        observe(&phase, true);
        let left = at_peak + gained;
        let mild =
            -phase.loss[0] <= T::constant(STRONGEST) * phase.speed[0] && left <= T::constant(LARGEST_GAIN) * energy;
        // Of a capture only the sign counts.
        let converged = changed <= (T::constant(CONVERGED) * energy).max(T::constant(-CLEAR_CAPTURE) * left);
        // A sphere that comes slower than a barrier is high never meets the peak computed here.
        let (_, escape) = barrier(law);
        let end = match mild && converged && energy > escape {
            false => End::Budget,
            true if left > escape => End::Separation,
            true => End::Capture,
        };
        let error = changed / energy;
        let statistics =
            Statistics { intervals: 2, refused: 0, iterations: 2 * self.iterations, nodes: N as u32, error };
        NormalPath { end, energy: left, peak: phase.peak, turning: T::ZERO, statistics }
    }
}
