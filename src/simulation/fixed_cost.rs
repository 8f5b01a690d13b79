//! A method of fixed cost for firmware: approach and rebound are one polynomial each, in a fixed number of sweeps.

#[cfg(doc)]
use super::Collocation;
use super::integrals::Integrals;
use super::law::{NormalLaw, brink};
use super::motion::{Effort, End, Method, NormalPath};
use super::nodes::{PhaseNodes, PhaseSamples};
use super::phase::Phase;
use crate::{InputError, Parameter};

/// `N` nodes in a fixed number of sweeps for each phase; only the restitution and the peak come out, or, with `M` nodes for
/// them, outputs that are integrals over the motion too.
///
/// Error of e over the scenes of the paper and others as mildly damped: 1e-5 with five nodes and 1e-6 with seven, both in three
/// sweeps. Stronger damping needs more sweeps; where they do not settle to some thousandths of the energy, the status of the
/// result is not that of a solution. Closer to the critical speed than the error, the outcome is not certain: [`Collocation`]
/// decides there.
///
/// ```
/// use microimpact::simulation::{FixedCost, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(5.06e-6_f32, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let contact = scene.normal_impact(&FixedCost::<5>::new(3)?, &NormalMotion::new(2.8)?)?;
/// assert!((contact.overall_restitution() - 0.746193).abs() < 1e-5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FixedCost<const N: usize, const M: usize = 0> {
    sweeps: u32,
}

impl<const N: usize> FixedCost<N> {
    /// A method with a number of sweeps for each phase, 1 to 40.
    ///
    /// # Errors
    /// A number outside its range.
    ///
    /// ```
    /// assert!(microimpact::simulation::FixedCost::<5>::new(0).is_err());
    /// ```
    pub fn new(sweeps: u32) -> Result<Self, InputError> {
        Parameter::Iterations.check(f64::from(sweeps))?;
        Ok(Self { sweeps })
    }

    /// The same method, with outputs from `M` nodes of each phase.
    ///
    /// With two nodes more than `N` velocities along the surface are as exact as e, relative to the slip; impulses take three
    /// more, and times near the critical speed twice as many.
    ///
    /// ```
    /// use microimpact::simulation::{ContactTimes, FixedCost, SimulatedImpact, Simulation};
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let motion = NormalMotion::new(1.0)?;
    /// let method = FixedCost::<7>::new(3)?.with_outputs::<10>();
    /// let impact: SimulatedImpact<_, (), ContactTimes<f64>> = Simulation::new(sphere, stiffness).observe(&method, &motion)?;
    /// assert!((impact.outputs.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_outputs<const M: usize>(self) -> FixedCost<N, M> {
        FixedCost { sweeps: self.sweeps }
    }
}

/// What the last sweeps may still change of the energy left, over the energy before.
const SETTLED: f64 = 0.003;

/// What a sweep changes of the energy left, over the energy before, above which the reciprocals of the speeds are renewed.
const UNSTEADY: f64 = 0.01;

/// Loss over speed at the peak up to which a motion can be trusted.
const STRONGEST: f64 = 30.0;

impl<T: PhaseNodes<N>, const N: usize, const M: usize> Method<T, ()> for FixedCost<N, M> {
    #[inline]
    fn solve<L: NormalLaw<T>>(&self, law: &L, energy: T, (): &mut ()) -> NormalPath<T> {
        self.run(law, energy, |_, _| {})
    }
}

impl<T, O, S, const N: usize, const M: usize> Method<T, (O, S)> for FixedCost<N, M>
where
    T: PhaseSamples<N, M>,
    (O, S): Integrals<T>,
{
    fn solve<L: NormalLaw<T>>(&self, law: &L, energy: T, observer: &mut (O, S)) -> NormalPath<T> {
        self.run(law, energy, |phase: &Phase<T, N>, rebound| {
            observer.add(law, &phase.samples::<M>(law, rebound), rebound);
        })
    }
}

impl<const N: usize, const M: usize> FixedCost<N, M> {
    /// Approach and rebound, each shown to `observe` when it is solved.
    #[inline]
    fn run<T, L>(&self, law: &L, energy: T, mut observe: impl FnMut(&Phase<T, N>, bool)) -> NormalPath<T>
    where
        T: PhaseNodes<N>,
        L: NormalLaw<T>,
    {
        let moves = |by: T| by.abs() > T::constant(UNSTEADY) * energy;
        let mut phase = Phase::<T, N>::approach(law, energy);
        let mut lost = phase.estimate;
        // How far the last sweep has still moved the energy lost.
        let (mut moved, mut at_peak) = (T::ZERO, energy);
        for sweep in 0..self.sweeps {
            if sweep > 0 {
                phase.describe(law, false);
            }
            if moves(moved) {
                phase.renew();
            }
            let before = lost;
            lost = phase.sweep::<false>().0;
            moved = lost - before;
            at_peak = phase.correct_peak(law, energy, lost);
        }
        let unsettled = moved.abs();
        observe(&phase, false);
        phase.turn(law);
        let mut gained = T::ZERO;
        moved = T::ZERO;
        for _ in 0..self.sweeps {
            if moves(moved) {
                phase.renew();
            } else {
                phase.renew_slowest();
            }
            let before = gained;
            gained = phase.sweep::<false>().0;
            moved = gained - before;
        }
        let unsettled = unsettled + moved.abs();
        observe(&phase, true);
        let left = at_peak + gained;
        // What a sweep leaves of an error grows with the loss over the speed: beyond this bound it can settle on a wrong
        // value. Of a capture only the sign counts.
        let mild = -phase.loss[0] <= T::constant(STRONGEST) * phase.speed[0] && left <= T::constant(1.0001) * energy;
        let settled =
            unsettled <= T::constant(SETTLED) * energy || (left < T::ZERO && unsettled < T::constant(-0.25) * left);
        // A sphere that comes slower than a barrier is high never meets the peak computed here.
        let (_, escape) = brink(law);
        let end = match mild && settled && energy > escape {
            false => End::Budget,
            true if left > escape => End::Separation,
            true => End::Capture,
        };
        let error = unsettled.saturating_div(energy);
        let effort = Effort { stretches: 2, refused: 0, sweeps: 2 * self.sweeps, nodes: N as u32, error };
        NormalPath { end, energy: left, peak: phase.peak, turning: T::ZERO, effort }
    }
}
