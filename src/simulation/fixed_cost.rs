//! A method of fixed cost for firmware: each phase of the normal motion is one polynomial, in a fixed number of sweeps.
//!
//! With the contact radius s = a (1 - z^2) below its peak a and the speed y = z u, both phases run from z = 0 at the peak to
//! z = 1 at s = 0, and u^2 = free(z) +- integral of z^2 loss(z) u dz / z^2 with plus on approach, seen backwards.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

#[cfg(doc)]
use super::Collocation;
use super::law::{NormalLaw, brink};
use super::motion::{Effort, End, NormalMethod, NormalPath};
use super::nodes::PhaseNodes;
use crate::{InputError, Parameter};

/// `N` nodes, 4 to 8, in a fixed number of sweeps for each phase; nothing but the restitution and the peak comes out.
///
/// Error of e over the scenes of the paper and others as mildly damped: 1e-5 with five nodes and three sweeps, 1e-6 with seven
/// and four. Stronger damping needs more sweeps; where they do not settle to some thousandths of the energy, the status of the
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
pub struct FixedCost<const N: usize> {
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
        Parameter::Sweeps.check(f64::from(sweeps))?;
        Ok(Self { sweeps })
    }
}

/// What the last sweeps may still change of the energy left, over the energy before.
const SETTLED: f64 = 0.003;

/// Loss over speed at the peak up to which a motion can be trusted.
const STRONGEST: f64 = 30.0;

/// Speeds over z at the nodes, and the losses that go with them.
struct Phase<T, const N: usize> {
    /// Peak contact radius.
    peak: T,
    free: [T; N],
    loss: [T; N],
    speed: [T; N],
}

impl<T: PhaseNodes<N>, const N: usize> Phase<T, N> {
    fn describe(&mut self, law: &impl NormalLaw<T>, rebound: bool) {
        let (two, four) = (T::constant(2.0), T::constant(4.0));
        for j in 0..N {
            let s = self.peak * T::M[j];
            self.free[j] = two * self.peak * law.divided(self.peak, s);
            // The weight (1 - z^2)^2 = (s/a)^2 of the nodes is taken out of the loss.
            self.loss[j] = four * self.peak * self.peak * self.peak * law.loss_over_square(s, rebound);
        }
    }

    /// Energy lost over the whole phase.
    #[inline]
    fn lost(&self) -> T {
        let mut lost = T::ZERO;
        for k in 0..N {
            lost = lost + T::WHOLE[k] * self.loss[k] * self.speed[k];
        }
        T::constant(0.5) * lost
    }

    /// One sweep, with one of Heron's steps for the root at every node.
    #[inline]
    fn sweep(&mut self, rebound: bool) {
        let half = T::constant(0.5);
        let mut square = self.free;
        for k in 0..N {
            let power = self.loss[k] * self.speed[k];
            let power = if rebound { -power } else { power };
            for j in 0..N {
                square[j] = square[j] + T::RUNNING[k][j] * power;
            }
        }
        for j in 0..N {
            // A captured sphere turns before s = 0: the floors let the loss exceed the energy all the same.
            let square = if rebound { square[j].max(T::ZERO) } else { square[j] };
            let speed = half * (self.speed[j] + square / self.speed[j]);
            self.speed[j] = if rebound { speed.max(T::constant(1e-3)) } else { speed };
        }
    }
}

impl<T: PhaseNodes<N>, const N: usize> NormalMethod<T> for FixedCost<N> {
    fn normal_motion<L: NormalLaw<T>>(&self, law: &L, energy: T) -> NormalPath<T> {
        let five = T::constant(5.0);
        let zeros = [T::ZERO; N];
        let mut phase = Phase { peak: T::ONE, free: zeros, loss: zeros, speed: zeros };
        // The undamped peak, which only an external force moves away from one.
        phase.peak = phase.peak - (law.potential(phase.peak) - energy) / law.slope(phase.peak);
        phase.describe(law, false);
        for j in 0..N {
            phase.speed[j] = phase.free[j].max(T::SMALLEST).sqrt();
        }
        let (mut sweeps, mut before) = (0, T::ZERO);
        // How far the last sweeps have still moved the energies lost.
        let mut unsettled = loop {
            let lost = phase.lost();
            let excess = law.potential(phase.peak) + lost - energy;
            phase.peak = phase.peak - excess / (law.slope(phase.peak) + five * lost / phase.peak);
            if sweeps == self.sweeps {
                break (lost - before).abs();
            }
            before = lost;
            phase.describe(law, false);
            phase.sweep(false);
            sweeps += 1;
        };
        let at_peak = law.potential(phase.peak);
        phase.describe(law, true);
        let mut lost = phase.lost();
        before = lost;
        for _ in 0..self.sweeps {
            before = lost;
            phase.sweep(true);
            lost = phase.lost();
        }
        unsettled = unsettled + (lost - before).abs();
        let left = at_peak - lost;
        // What a sweep leaves of an error grows with the loss over the speed: beyond this bound it can settle on a wrong
        // value. Of a capture only the sign counts.
        let mild = phase.loss[0] <= T::constant(STRONGEST) * phase.speed[0] && left <= T::constant(1.0001) * energy;
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
        let effort = Effort { stretches: 2, refused: 0, sweeps: 2 * self.sweeps, error };
        NormalPath { end, energy: left, peak: phase.peak, turning: T::ZERO, effort }
    }
}
