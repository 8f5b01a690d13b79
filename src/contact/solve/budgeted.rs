//! A method with a budget.

use super::adaptive::{Adaptive, AdaptiveNodes};
use super::collocation::Collocation;
use super::nodes::Nodes;
use super::observer::Observer;
use super::path::{MOST_INTERVALS, Method, NormalPath};
use crate::contact::law::ContactLaw;

/// A method that gives up after a number of intervals, which bounds what a simulation takes:
/// [`Collocation::with_budget`] and [`Adaptive::with_budget`].
///
/// Of the other methods, [`FixedCost`](super::FixedCost) has its budget in its number of iterations, and
/// [`RungeKuttaGill`](super::RungeKuttaGill) in its number of steps. A critical speed is found in steps by a
/// [`CriticalSpeedSearch`](crate::contact::CriticalSpeedSearch).
///
/// ```
/// use microimpact::contact::{Budgeted, Collocation};
///
/// let method: Budgeted<Collocation<7, f32>> = Collocation::new(1e-6)?.with_budget(40);
/// assert_eq!(method.intervals(), 40);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Budgeted<M> {
    method: M,
    intervals: u32,
}

impl<M> Budgeted<M> {
    pub(super) const fn new(method: M, intervals: u32) -> Self
    where
        M: Copy,
    {
        Self { method, intervals }
    }

    /// Intervals after which a run gives up, refused ones included.
    ///
    /// ```
    /// use microimpact::contact::Collocation;
    ///
    /// assert_eq!(Collocation::<7, f32>::new(1e-6)?.with_budget(1_000_000).intervals(), Collocation::<7, f32>::MOST_INTERVALS);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn intervals(&self) -> u32 {
        self.intervals
    }
}

impl<T: Nodes<N>, const N: usize> Method<T> for Budgeted<Collocation<N, T>> {
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        // A number that was read may be larger.
        self.method.solve_within(self.intervals.min(MOST_INTERVALS), law, energy, observer)
    }
}

impl<T: AdaptiveNodes> Method<T> for Budgeted<Adaptive<T>> {
    fn solve<L: ContactLaw<T>, O: Observer<T>>(&self, law: &L, energy: T, observer: &mut O) -> NormalPath<T> {
        self.method.solve_within(Some(self.intervals), law, energy, observer)
    }
}
