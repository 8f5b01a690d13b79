//! The motion of a captured sphere after its capture: in and out about the equilibrium until it rests, or creeping there.
//!
//! Energies are counted from the bottom of the well, as (V(s) - V(b))/(s - b) (s - b): close to rest nothing cancels, so
//! that the decay is as exact after hundreds of swings as in the first.

use super::interval::{Course, Point};
use super::nodes::Nodes;
use super::observer::Observer;
use super::path::{End, Follower, NormalPath, REFUSED_SHRINK, Statistics, UNDAMPED_FRACTION};
use super::well;
use crate::contact::law::{ContactLaw, Units};
use crate::{InputError, Parameter, Real};

/// Excess of the energy at rest, in roots of a rounding: a creeping sphere stops just there.
const REST_ROUNDING: f64 = 3.0;

/// Energy by which a creeping sphere may pass its place of rest, over the energy there and in roots of a rounding.
const OVERSHOOT: f64 = 30.0;

/// Intervals of a creeping sphere that may be shortened to end where it comes to rest.
const MOST_SEARCHES: u32 = 20;

/// Longest interval of a creeping sphere, over the distance to the equilibrium, where the time has a singularity.
const CREEPING_FRACTION: f64 = 0.5;

/// Its shortest, in roundings of the coordinate.
const CREEPING_ROUNDING: f64 = 4.0;

/// Swings without a visible decay, there and back, after which the motion is given up.
const STEADY_SWINGS: u32 = 2;

/// Least energy at rest, over the depth of the well and in squared roundings: the remaining distance has some thousand
/// roundings of the coordinate.
const LEAST_REST_ENERGY: f64 = 1e6;

/// The condition that ends the simulation of a captured sphere, and the largest number of turning points until then.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, RestCriterion};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let (method, motion) = (Adaptive::new(1e-9)?, NormalMotion::new(1.0)?);
/// let time = |fraction| {
///     let settled = scene.solve_to_rest(&motion, &method, &RestCriterion::new(fraction, 1000)?, ())?;
///     Ok::<f64, microimpact::InputError>(settled.motion.unwrap().time)
/// };
/// assert!(time(1e-6)? > time(1e-3)?);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Unchecked<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct RestCriterion<T> {
    fraction: T,
    turning_points: u32,
}

impl<T: Real> RestCriterion<T> {
    /// The sphere counts as at rest if its energy above the bottom of the well is at most `fraction` times the depth of the
    /// well (1e-12 to 0.5). It is followed over at most so many `turning_points` (1 to 100000).
    ///
    /// The depth of the well is the energy that takes the sphere from its equilibrium off the surface. Without an external
    /// force a sphere at rest swings by less than 0.73 sqrt(fraction) of its equilibrium indentation. A number type's rounding
    /// limits the fraction from below.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::contact::RestCriterion;
    ///
    /// assert!(RestCriterion::new(1e-6, 1000).is_ok());
    /// assert!(RestCriterion::new(1e-6, 0).is_err());
    /// assert!(RestCriterion::new(0.0, 1000).is_err());
    /// ```
    pub fn new(fraction: T, turning_points: u32) -> Result<Self, InputError> {
        let fraction = Parameter::RestEnergy.check(fraction)?;
        Parameter::TurningPoints.check(f64::from(turning_points))?;
        let least = T::constant(LEAST_REST_ENERGY) * T::EPSILON * T::EPSILON;
        Ok(Self { fraction: fraction.max(least), turning_points })
    }
}

/// A criterion that was read and is not checked yet.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Unchecked<T> {
    fraction: T,
    turning_points: u32,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Unchecked<T>> for RestCriterion<T> {
    type Error = InputError;

    fn try_from(read: Unchecked<T>) -> Result<Self, InputError> {
        Self::new(read.fraction, read.turning_points)
    }
}

/// How a captured sphere came to rest along the normal.
///
/// ```
/// use core::f64::consts::PI;
/// use microimpact::contact::{Adaptive, Contact, RestCriterion};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let (method, criterion) = (Adaptive::new(1e-9)?, RestCriterion::new(1e-6, 1000)?);
/// let settled = scene.solve_to_rest(&NormalMotion::new(1.0)?, &method, &criterion, ())?;
/// let motion = settled.motion.unwrap();
/// assert!(!motion.creeps && motion.turning_points > 1);
/// let equilibrium: f64 = 2.0 * PI * 250.0 / 7.5e10;
/// assert!((motion.indentation / equilibrium - 1.0).abs() < 0.73e-3);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MotionToRest<T> {
    /// Time from first contact to rest, s. It ends at the first turning point at which the sphere is at rest or, if the sphere
    /// creeps, when its energy has decreased to that of rest. If the damping is within some percent of critical damping, the
    /// next turning point may be out of sight while creeping is not certain yet; then it is a later time.
    pub time: T,
    /// Turning points after the peak, the last included.
    pub turning_points: u32,
    /// Whether the sphere ends its motion creeping towards its equilibrium, which it never passes.
    pub creeps: bool,
    /// Indentation where the sphere rests, m.
    pub indentation: T,
}

/// The motion after capture, in units of the scene.
pub struct Settling<T> {
    turning_points: u32,
    creeps: bool,
    indentation: T,
    pub(crate) at_rest: bool,
}

impl<T: Real> Settling<T> {
    pub(crate) fn in_units(&self, time: T, units: &Units<T>) -> MotionToRest<T> {
        let Self { turning_points, creeps, indentation, .. } = *self;
        MotionToRest { time: time * units.time(), turning_points, creeps, indentation: units.length * indentation }
    }
}

/// The well in which a captured sphere moves.
#[derive(Clone, Copy)]
struct Well<T> {
    /// Contact radius at the bottom.
    bottom: T,
    /// Energy above the bottom that counts as rest.
    rest: T,
}

impl<T: Real, L: ContactLaw<T>, O: Observer<T>> Follower<'_, T, L, O> {
    /// Follows a captured sphere from where its `path` ends to rest; what it takes is added to the path.
    pub(crate) fn settle<const N: usize>(
        &mut self,
        path: &mut NormalPath<T>,
        criterion: &RestCriterion<T>,
    ) -> Settling<T>
    where
        T: Nodes<N>,
    {
        // Forces that all but balance have no digits for more.
        self.control.times = T::ONE;
        let indentation = self.law.indentation(self.at.s);
        let mut settling = Settling { turning_points: 0, creeps: false, indentation, at_rest: false };
        let Some(bottom) = self.equilibrium() else {
            return settling;
        };
        let barrier = self.barrier.0;
        let depth = well::depth(self.law, (barrier, bottom));
        let well = Well { bottom, rest: criterion.fraction * depth };
        // Where the sphere would turn back without losses, ahead and behind; it never comes as far again.
        let mut course = if path.peak > T::ZERO { Course::REBOUND } else { Course::APPROACH };
        let outermost = if path.turning > T::ZERO { path.turning } else { self.outer_turning_point() };
        let innermost = if path.peak > T::ZERO { path.peak } else { self.undamped_peak() };
        let (mut ahead, mut behind) = if course.rebound { (outermost, innermost) } else { (innermost, outermost) };
        let mut turned = path.turning > T::ZERO;
        settling.turning_points = turned.into();
        let damped = self.law.damping(bottom, true) > T::ZERO;
        let mut steady = 0;
        loop {
            settling.at_rest = self.rests(&well);
            if settling.at_rest || settling.turning_points >= criterion.turning_points {
                break;
            }
            if turned {
                course = if course.rebound { Course::APPROACH } else { Course::REBOUND };
                (ahead, behind) = (behind, self.at.s);
            }
            self.statistics = Statistics::NONE;
            let swing = self.swing::<N>(&well, ahead, course, &mut settling.creeps);
            path.statistics.add(&self.statistics);
            turned = swing == Ok(true);
            if turned && path.peak == T::ZERO {
                path.peak = self.at.s;
            } else if turned {
                settling.turning_points += 1;
                path.turning = if settling.turning_points == 1 { self.at.s } else { path.turning };
            }
            // Where damping takes less than rounding on the way there and back, the decay is not to be seen any more.
            let lower = if course.rebound { self.at.s > ahead } else { self.at.s < ahead };
            steady = if damped && turned && !lower { steady + 1 } else { 0 };
            if swing.is_err() || steady == STEADY_SWINGS {
                settling.at_rest = self.rests(&well);
                break;
            }
        }
        settling.indentation = self.law.indentation(self.at.s);
        path.energy = self.at.energy;
        settling
    }

    fn rests(&self, well: &Well<T>) -> bool {
        Self::excess(self.law, &self.at, well) <= well.rest * (T::ONE + T::constant(REST_ROUNDING) * T::EPSILON.sqrt())
    }

    /// Energy above the bottom of the well.
    fn excess(law: &L, at: &Point<T>, well: &Well<T>) -> T {
        T::constant(0.5) * at.speed_squared + law.mean_slope(at.s, well.bottom) * (at.s - well.bottom)
    }

    /// To the next turning point (`true`), which does not lie as far as `beyond`, or creeping to rest.
    fn swing<const N: usize>(
        &mut self,
        well: &Well<T>,
        beyond: T,
        course: Course,
        creeps: &mut bool,
    ) -> Result<bool, End>
    where
        T: Nodes<N>,
    {
        let along = |way: T| if course.rebound { -way } else { way };
        *creeps = self.creeps(self.at.s, self.at.speed_squared.sqrt(), course);
        if self.at.speed_squared <= T::ZERO {
            self.leave_turning_point::<N>(along(well.bottom - self.at.s), course)?;
        }
        let (mut length, mut searches) = (T::ONE, 0);
        let least = well.rest * (T::ONE - T::constant(OVERSHOOT) * T::EPSILON.sqrt());
        loop {
            if !*creeps {
                let arrival = self.arrive::<N>(beyond, course);
                if self.take(&arrival, course, Some(arrival.end.s))? {
                    return Ok(true);
                }
                // Not beyond the turning point without losses from here, or else that of the swing before.
                let undamped = along(arrival.end.s - self.at.s);
                let ahead = if undamped > T::ZERO { undamped } else { along(beyond - self.at.s) };
                length = length.min(T::constant(UNDAMPED_FRACTION) * ahead);
            }
            loop {
                let step = if *creeps { length.min(self.creeping_length(well)) } else { length };
                let interval = self.pass::<N>(along(step), course);
                let factor = self.length_factor(N, &interval);
                let excess = || Self::excess(self.law, &interval.end, well);
                if *creeps && interval.accepted && searches < MOST_SEARCHES && excess() < least {
                    // Close to the bottom the root of the energy above it is proportional to the distance.
                    let [before, after, rest] =
                        [Self::excess(self.law, &self.at, well), excess().max(T::ZERO), well.rest].map(T::sqrt);
                    length = step * (before - rest) / (before - after);
                    searches += 1;
                    continue;
                }
                if self.take(&interval, course, None)? {
                    length = step * factor.max(T::ONE);
                    break;
                }
                length = step * factor.min(T::constant(REFUSED_SHRINK));
                if length <= T::EPSILON * T::EPSILON {
                    return Err(End::Budget);
                }
            }
            *creeps = *creeps || self.creeps(self.at.s, self.at.speed_squared.sqrt(), course);
            if *creeps && self.rests(well) {
                return Ok(false);
            }
        }
    }

    /// To the place where a creeping sphere counts as at rest, or half way to the equilibrium if that is nearer: the time
    /// has a singularity there.
    fn creeping_length(&self, well: &Well<T>) -> T {
        // Close to the bottom the energy goes with the square of the distance.
        let fraction = (well.rest / Self::excess(self.law, &self.at, well)).sqrt().max(T::constant(CREEPING_FRACTION));
        let length = (self.at.s - well.bottom).abs() * (T::ONE - fraction);
        length.max(T::constant(CREEPING_ROUNDING) * T::EPSILON * self.at.s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Collocation, HertzLaw, NoDamping, NoForce, Ring};

    /// Nothing takes energy, so that the sphere turns at the same places for ever.
    #[test]
    fn undamped_swings_do_not_drift() -> Result<(), InputError> {
        const TURNING_POINTS: u32 = if cfg!(miri) { 5 } else { 1001 };
        let (adhesion, damping, force) = (Ring { strength: 0.5, damping: 0.0 }, NoDamping, NoForce);
        let law = HertzLaw { stiffness: 1.0, damping, adhesion, force };
        let control = Collocation::<12, f64>::new(1e-12)?.control(true, true);
        for turning in [0.05_f64, 0.3, 0.5, 0.547] {
            let energy = law.potential(turning);
            let at = Point { s: turning, energy, speed_squared: 0.0 };
            let (end, statistics) = (End::Capture, Statistics::NONE);
            let mut path = NormalPath { end, energy, peak: 1.0, turning, error_bound: 0.0, statistics };
            let mut observer = ();
            let mut follower = Follower::from(&law, control, &mut observer, at);
            let settling = follower.settle::<12>(&mut path, &RestCriterion::new(1e-12, TURNING_POINTS)?);
            assert_eq!((settling.turning_points, settling.at_rest, settling.creeps), (TURNING_POINTS, false, false));
            let drift = settling.indentation.sqrt() - turning;
            assert!(drift.abs() < 1e-11, "{turning}: {drift}");
        }
        Ok(())
    }
}
