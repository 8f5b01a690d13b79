//! Several impacts at once: a scene whose numbers hold one number of each impact.

// The lanes are those of the arrays.
#![allow(clippy::indexing_slicing)]

use super::along::{Surface, TangentialVelocities};
use super::law::{ContactLaw, Units};
use super::outputs::{ContactImpulses, ContactTimes, Impulses, Output, Times};
use super::result::{NormalContact, SimulatedImpact};
use super::scene::Contact;
use super::solve::path::NormalPath;
use super::solve::{FixedCost, PhaseSamples, RunReport};
use crate::{Approach, Coulomb, InputError, NoFriction, Oblique, ObliqueMotion, Real, Sphere};

/// What happens along the surface to several spheres at once: the surface of a scene that [`Contact::solve_lanes`] takes. `V` is the
/// number type with lanes, `T` that of one lane, and `B` the motion before the impact.
///
/// ```
/// use microimpact::contact::SurfaceInLanes;
/// use microimpact::{Coulomb, ObliqueMotion};
///
/// fn velocities<S: SurfaceInLanes<f64, f64, ObliqueMotion<f64>>>() -> usize {
///     size_of::<S::AfterLane>()
/// }
/// assert!(velocities::<Coulomb<f64>>() > 0);
/// ```
pub trait SurfaceInLanes<V: Real, T: Real, B>: Surface<V, B, Observer: Copy> {
    /// Velocities after the impact in one lane.
    type AfterLane;

    /// They, of the lane that `lane` takes out of each number.
    fn after_lane(
        observer: &Self::Observer,
        lane: impl Fn(V) -> T,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> Self::AfterLane;
}

impl<V: Real, T: Real, B> SurfaceInLanes<V, T, B> for NoFriction {
    type AfterLane = ();

    #[inline]
    fn after_lane((): &(), _: impl Fn(V) -> T, _: &NormalPath<T>, _: &Sphere<T>, _: &Units<T>) {}
}

impl<V: Real, T: Real, B: Oblique<V>> SurfaceInLanes<V, T, B> for Coulomb<V> {
    type AfterLane = TangentialVelocities<T>;

    #[inline]
    fn after_lane(
        observer: &Self::Observer,
        lane: impl Fn(V) -> T,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> TangentialVelocities<T> {
        <Coulomb<T> as Surface<T, ObliqueMotion<T>>>::after(&observer.map(lane), path, sphere, units)
    }
}

/// An output that [`Contact::solve_lanes_for`] takes: nothing, [`Times`], [`Impulses`], or two of them. `V` is the number type with lanes, `T`
/// that of one lane, and `S` the state along the surface before contact.
///
/// ```
/// use microimpact::contact::{ContactTimes, OutputInLanes, Times};
///
/// fn size<O: OutputInLanes<f64, f64, ()>>(_: O) -> usize {
///     size_of::<O::InLane>()
/// }
/// assert_eq!(size(Times), size_of::<ContactTimes<f64>>());
/// ```
pub trait OutputInLanes<V: Real, T: Real, S>: Output<V, S, Observer: Copy> {
    /// The output of one lane.
    type InLane;

    /// It, of the lane that `lane` takes out of each number.
    fn finish_lane(
        observer: &Self::Observer,
        lane: impl Fn(V) -> T + Copy,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> Self::InLane;
}

impl<V: Real, T: Real, S> OutputInLanes<V, T, S> for () {
    type InLane = ();

    #[inline]
    fn finish_lane((): &(), _: impl Fn(V) -> T + Copy, _: &NormalPath<T>, _: &Sphere<T>, _: &Units<T>) {}
}

impl<V: Real, T: Real, S> OutputInLanes<V, T, S> for Times {
    type InLane = ContactTimes<T>;

    #[inline]
    fn finish_lane(
        observer: &Self::Observer,
        lane: impl Fn(V) -> T + Copy,
        path: &NormalPath<T>,
        _: &Sphere<T>,
        units: &Units<T>,
    ) -> ContactTimes<T> {
        ContactTimes::new(&observer.map(lane), path, units)
    }
}

impl<V: Real, T: Real, S> OutputInLanes<V, T, S> for Impulses {
    type InLane = ContactImpulses<T>;

    #[inline]
    fn finish_lane(
        observer: &Self::Observer,
        lane: impl Fn(V) -> T + Copy,
        _: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> ContactImpulses<T> {
        ContactImpulses::new(&observer.map(lane), sphere, units)
    }
}

impl<V: Real, T: Real, S, A: OutputInLanes<V, T, S>, B: OutputInLanes<V, T, S>> OutputInLanes<V, T, S> for (A, B) {
    type InLane = (A::InLane, B::InLane);

    #[inline]
    fn finish_lane(
        (a, b): &Self::Observer,
        lane: impl Fn(V) -> T + Copy,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> Self::InLane {
        (A::finish_lane(a, lane, path, sphere, units), B::finish_lane(b, lane, path, sphere, units))
    }
}

/// Impacts in `W` lanes, each with its outputs.
type InLanes<T, A, R, const W: usize> = [(SimulatedImpact<T, A>, R); W];

impl<V: Real, L: ContactLaw<V>, S> Contact<V, L, S> {
    /// `W` impacts at once, by a number type with `W` lanes of the type `T`: its numbers describe one scene and one motion in each
    /// lane. A result is that of [`solve`](Self::solve) in its lane, with a status and an outcome of its own.
    ///
    /// [`Real`] states what such a type has to do. If its arithmetic in a lane is that of `T`, results are the same to the last bit. A law
    /// with an external force is [`Unsupported`](super::Status::Unsupported).
    ///
    /// # Errors
    /// As [`solve`](Self::solve), if it fails in any lane.
    ///
    /// The package `impact-arrays` of the repository has such types. With four f64 in each number:
    ///
    /// ```text
    /// let scene = Contact::hertz(Sphere::solid(radii, densities)?, Stiffness::new(stiffnesses)?);
    /// let impacts: [SimulatedImpact<f64, ()>; 4] = scene.solve_lanes(&NormalMotion::new(speeds)?, &method)?;
    /// ```
    pub fn solve_lanes<T, B, const N: usize, const M: usize, const W: usize>(
        &self,
        before: &B,
        method: &FixedCost<N, M>,
    ) -> Result<[SimulatedImpact<T, S::AfterLane>; W], InputError>
    where
        T: PhaseSamples<N, M>,
        V: PhaseSamples<N, M> + Into<[T; W]>,
        B: Approach<V>,
        S: SurfaceInLanes<V, T, B>,
    {
        Ok(self.solve_lanes_for(before, method, ())?.map(|(impact, ())| impact))
    }

    /// The same, with [`Times`], [`Impulses`] or both, which are those of [`solve_for`](Self::solve_for) in their lane.
    ///
    /// # Errors
    /// As [`solve`](Self::solve), if it fails in any lane.
    ///
    /// ```text
    /// let impacts: [(SimulatedImpact<f64, ()>, ContactTimes<f64>); 4] =
    ///     scene.solve_lanes_for(&NormalMotion::new(speeds)?, &method, Times)?;
    /// ```
    pub fn solve_lanes_for<T, B, O, const N: usize, const M: usize, const W: usize>(
        &self,
        before: &B,
        method: &FixedCost<N, M>,
        outputs: O,
    ) -> Result<InLanes<T, S::AfterLane, O::InLane, W>, InputError>
    where
        T: PhaseSamples<N, M>,
        V: PhaseSamples<N, M> + Into<[T; W]>,
        B: Approach<V>,
        S: SurfaceInLanes<V, T, B>,
        O: OutputInLanes<V, T, S::Start>,
    {
        let (law, units, approach) = self.in_units_of(before)?;
        let start = self.surface.start(before, self.sphere(), &law, &units)?;
        let observer = (outputs.begin(&start), S::observer(&start));
        let solved = method.solve_lanes::<T, V, L, _, W>(&law, units.energy, observer);
        let indentations: [T; W] = (units.length * law.indentation(solved.peak)).into();
        Ok(core::array::from_fn(|index| {
            let (path, (observed, along)) = solved.path(index, method);
            let lane = |numbers: V| numbers.into()[index];
            let (sphere, units) = (self.sphere().map(lane), units.map(lane));
            let peak = if path.peak > T::ZERO { indentations[index] } else { T::ZERO };
            let impact = SimulatedImpact {
                normal: NormalContact::with_indentations(&path, lane(approach), units.energy, (peak, T::ZERO)),
                tangential: S::after_lane(along, lane, &path, &sphere, &units),
                run: RunReport::new(&path),
            };
            (impact, O::finish_lane(observed, lane, &path, &sphere, &units))
        }))
    }
}
