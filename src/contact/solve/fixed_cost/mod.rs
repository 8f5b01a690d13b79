//! A method of fixed cost for firmware: approach and rebound are one polynomial each, in a fixed number of iterations.

mod iterations;
mod lanes;
mod verdict;

use iterations::STRONGEST;
use verdict::{LARGEST_ERROR, Seen};

#[cfg(doc)]
use super::Collocation;
use super::adaptive::show;
use super::nodes::{PhaseSamples, WEIGHT_POWER};
use super::observer::Observer;
use super::path::{End, Method, NormalPath};
use super::phase::Phase;
use super::well::barrier;
use crate::contact::law::ContactLaw;
use crate::{InputError, Parameter, Real};

/// A method that costs about the same for every impact: `N` nodes and a fixed number of iterations for each phase, and `M`
/// nodes for outputs.
///
/// The error of e over the scenes of the paper and others as mildly damped is 1e-5 with five nodes and 1e-6 with seven, both
/// in three iterations. Stronger damping needs more iterations. The bound of the error of e^2 consists of what the iterations leave,
/// what the nodes do not resolve, and rounding; the chapter on the [method](crate::contact::method) derives it. If it exceeds 0.003,
/// the status of a rebound is not *solved*; if e^2 is smaller, the outcome is *undecided*. Use [`Collocation`] for such impacts. The bound
/// holds for the paper's law, for the adhesion of [`Dmt`](crate::contact::Dmt), and for viscoelastic and constant damping, the latter
/// down to a nominal restitution of 0.2. A contact that begins or ends elsewhere than at zero indentation is
/// [`Unsupported`](super::Status::Unsupported).
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Iterations"))]
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

/// A number of iterations that was read and is not checked yet.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Iterations {
    iterations: u32,
}

#[cfg(feature = "serde")]
impl<const N: usize, const M: usize> TryFrom<Iterations> for FixedCost<N, M> {
    type Error = InputError;

    fn try_from(read: Iterations) -> Result<Self, InputError> {
        Ok(FixedCost::<N>::new(read.iterations)?.with_outputs())
    }
}

/// Nodes beyond those of a phase that the end of sliding needs: the square of the speed is that much a higher polynomial.
const NODES_OF_EVENTS: usize = 4;

/// Tolerance to which the end of sliding is found within a phase, for outputs that need it.
const END_OF_SLIP: f64 = 1e-9;

impl<T, const N: usize, const M: usize> Method<T> for FixedCost<N, M>
where
    T: PhaseSamples<N, M>,
{
    #[inline]
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        if !Self::represents(law, observer) {
            return NormalPath::unsupported(energy);
        }
        // Shows a phase, and returns the error of what is observed.
        let mut observe = |phase: &Phase<T, N>, rebound| {
            if !O::OBSERVES {
                return T::ZERO;
            }
            let whole = phase.samples::<M>(law, rebound);
            let error = if O::DEMANDS { observer.error(law, &whole, T::constant(LARGEST_ERROR)) } else { T::ZERO };
            show(law, phase, &whole, rebound, T::constant(END_OF_SLIP).max(T::EPSILON), observer);
            error
        };
        let mut phase = Phase::<T, N>::approach(law, energy);
        let ((arrives, observed), found) = iterations::run(&mut phase, law, energy, self.iterations, |phase| {
            // Where the approach comes to a stand before its peak, there is another one.
            let arrives = phase.is_represented(STRONGEST) && (!law.may_have_barrier() || phase.is_moving());
            (arrives, if arrives { observe(phase, false) } else { T::ZERO })
        });
        let seen = Seen {
            arrives,
            represented: arrives && phase.is_represented(STRONGEST) && phase.peak > T::ZERO,
            barrier: law.may_have_barrier().then(|| barrier(law).1),
            timed: O::TIMED,
            followed: O::TO_TURNING_POINT,
            observed,
        };
        let mut path = found.path::<N>(&seen, self.iterations, || phase.is_moving());
        if path.end == End::Separation && observe(&phase, true) > T::constant(LARGEST_ERROR) {
            path.end = End::Budget;
        }
        path
    }
}

impl<const N: usize, const M: usize> FixedCost<N, M> {
    /// Whether polynomials represent the motion under a law, and the number type what is observed of it: the way along the surface may
    /// be longer than fixed point holds.
    #[inline]
    fn represents<T: Real, O: Observer<T>>(law: &impl ContactLaw<T>, observer: &O) -> bool {
        let seen = !O::EVENTS || (!T::IS_FIXED_POINT && M >= N + NODES_OF_EVENTS);
        law.loss_power() >= WEIGHT_POWER && observer.kink().is_none() && seen
    }
}
