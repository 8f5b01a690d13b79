//! Coulomb's friction on a contact that is compliant along the surface: one elastic element between sphere and surface, which
//! sticks or slips (Mindlin 1949; Thornton, Cummins and Cleary 2011, 2013).
//!
//! In units of the scene the normal force is N = (5/4) s^3 at the contact radius s, and the stiffness of the element is
//! k = chi (3/2) (5/4) s. With b = 1 + 1/kappa the slip velocity u of the contact point and the force F of the element obey
//!
//! u' = b F,   sticking: F' = -k u while loading, (F/k)' = -u while unloading,   slipping in the direction q: F = -q f N.
//!
//! The element slips where |F| reaches f N, and sticks where its slip rate vanishes. That rate is u - q f V/chi while loading,
//! with the rate V of the indentation, and u - (2/3) q f V/chi while unloading.
//!
//! The normal motion does not depend on u and F. They are solved by collocation, in one part of each interval of the normal motion
//! or in several: a part ends at an event, or before the element has oscillated too far. On an interval s, V and the time are
//! polynomials. The error estimate keeps intervals so short that these polynomials are as exact between the nodes as at them.
//! So the nodes of a part need no new solution of the normal motion.

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::Surface;
use crate::contact::law::{ContactLaw, Units};
use crate::contact::solve::interval::{Interval, coefficients, dot, eliminate, integrals, series, unresolved};
use crate::contact::solve::nodes::Nodes;
use crate::contact::solve::observer::Observer;
use crate::contact::solve::path::NormalPath;
use crate::contact::solve::quantities::Times;
use crate::numbers::{NotConverged, root};
use crate::{Coulomb, Fault, InputError, Oblique, Parameter, Real, Sphere, SurfaceMotion};

/// Elastic force at contact radius 1, in units of an impact by Hertz's law.
const ELASTICITY: f64 = 1.25;

/// Tangential stiffness over chi there: (3/2) K a.
const STIFFNESS: f64 = 1.5 * ELASTICITY;

/// Elongation f N/k at which the element slips, divided by f d/chi, with the indentation d.
const LIMIT_OF_ELONGATION: f64 = 2.0 / 3.0;

/// Estimated error, divided by the last coefficients of the series in Legendre polynomials: the first coefficient that is left out is
/// a fraction of them. The tests keep this factor: no error over random impacts exceeds the tolerance.
const TAIL_ERROR: f64 = 0.1;

/// Longest oscillation of a sticking element in one part, in radians for each node: seven nodes then represent it to 1e-6, nine to
/// 1e-9.
const LONGEST_OSCILLATION: f64 = 0.06;

/// Largest number of parts of an interval. An interval that needs more is refused, and a shorter one is tried.
const MOST_PARTS: u32 = 64;

/// Places at which a polynomial is evaluated to find a root or a minimum below zero: several for each extremum that it can have.
const PLACES: u32 = 32;

/// Place, divided by the first of these, at which the polynomial is compared with its value at zero: does it fall at once?
const BEGINNING: f64 = 1.0 / 16.0;

/// Fraction of a bracket that a step of the golden-section search keeps,
const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_8;

/// and number of steps: the place of the minimum is then known to 1e-5 of the bracket, and its value to the square of that.
const MINIMUM_STEPS: u32 = 24;

/// Rounding error of a slip rate, in roundings of the slip.
const ROUNDINGS: f64 = 16.0;

/// How the force of the element changes while the contact shrinks.
///
/// ```
/// use microimpact::contact::Unloading;
///
/// assert_eq!(Unloading::default(), Unloading::Rescaled);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Unloading {
    /// The force falls with the stiffness, so that the energy of the element never grows (Thornton, Cummins and Cleary 2011).
    #[default]
    Rescaled,
    /// The force does not follow the stiffness, as in many programs for granular flow. This rule creates energy.
    Incremental,
}

/// Coulomb's friction with tangential compliance: the contact sticks elastically, with the stiffness k_t = 8 G* a of Mindlin (1949),
/// until friction is exhausted.
///
/// The stiffness is given as chi = k_t/((3/2) K a). Two materials give it by
/// [`tangential_ratio_between`](crate::Stiffness::tangential_ratio_between).
///
/// A strongly damped sphere leaves the surface slowly, and the contact sticks and slips again and again meanwhile, of the order of
/// sqrt(chi c_H v) times with the damping constant c_H ([`HystereticDamping`](crate::contact::HystereticDamping)). From chi c_H v of
/// 1e5 on, where the restitution is below chi/1e5, this may be too often to be followed: then the status is
/// [`BudgetSpent`](crate::contact::Status::BudgetSpent), and there is no outcome.
///
/// ```
/// use microimpact::{Coulomb, contact::Compliance};
///
/// assert!(Compliance::new(Coulomb::new(0.1)?, 0.85).is_ok());
/// assert!(Compliance::new(Coulomb::new(0.1)?, 0.0).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compliance<T> {
    friction: Coulomb<T>,
    stiffness_ratio: T,
    unloading: Unloading,
}

impl<T: Real> Compliance<T> {
    /// Friction on a contact of stiffness ratio chi, 1e-3 to 1e3, with [`Unloading::Rescaled`].
    ///
    /// # Errors
    /// A ratio outside its range.
    ///
    /// ```
    /// use microimpact::{Coulomb, contact::Compliance};
    ///
    /// assert!(Compliance::new(Coulomb::new(0.1)?, f64::NAN).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(friction: Coulomb<T>, stiffness_ratio: T) -> Result<Self, InputError> {
        let stiffness_ratio = Parameter::StiffnessRatio.check(stiffness_ratio)?;
        Ok(Self { friction, stiffness_ratio, unloading: Unloading::Rescaled })
    }

    /// The same contact with another rule of unloading.
    ///
    /// ```
    /// use microimpact::contact::{Compliance, Unloading};
    /// use microimpact::Coulomb;
    ///
    /// let compliance = Compliance::new(Coulomb::new(0.1)?, 0.85)?;
    /// assert_ne!(compliance.with_unloading(Unloading::Incremental), compliance);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn with_unloading(self, unloading: Unloading) -> Self {
        Self { unloading, ..self }
    }

    /// The same contact, if a law admits it.
    pub(crate) fn under(self, law: &impl ContactLaw<T>) -> Result<Self, InputError> {
        if law.admits_compliance() {
            return Ok(self);
        }
        let value = self.stiffness_ratio.to_f64() as f32;
        Err(InputError { parameter: Parameter::StiffnessRatio, fault: Fault::OtherLaw, value })
    }
}

/// Motion along the surface after an impact with tangential compliance, at separation.
///
/// Where friction acts the contact slips in the end, because the element holds less and less force as the contact shrinks. So the
/// motion is [`Sliding`](SurfaceMotion::Sliding) but where nothing slips from the beginning.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
/// let motion = NormalMotion::new(1.0)?.with_tangential(1.0)?;
/// let after = scene.with_compliance(10.0)?.solve(&motion, &Adaptive::new(1e-10)?)?.tangential;
/// assert_eq!((after.motion(), after.phases()), (SurfaceMotion::Sliding, 7));
/// assert!((after.slip() - 0.072934_f64).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CompliantVelocities<T> {
    motion: SurfaceMotion,
    velocity: T,
    spin: T,
    slip: T,
    impulse_ratio: T,
    phases: u32,
}

impl<T: Real> CompliantVelocities<T> {
    /// Whether the contact point slips: always, but where there was no slip before the impact.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.0)?;
    /// let after = scene.with_compliance(0.85)?.solve(&motion, &Adaptive::new(1e-9_f64)?)?.tangential;
    /// assert_eq!(after.motion(), SurfaceMotion::Rolling);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn motion(&self) -> SurfaceMotion {
        self.motion
    }

    /// Tangential velocity V_t, m/s.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // Slip in one direction takes f times the normal impulse from the velocity.
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let after = scene.with_compliance(0.85)?.solve(&motion, &Adaptive::new(1e-10)?)?.tangential;
    /// assert!((after.velocity() - 4.8_f64).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn velocity(&self) -> T {
        self.velocity
    }

    /// Spin W, rad/s.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let after = scene.with_compliance(0.85)?.solve(&motion, &Adaptive::new(1e-10)?)?.tangential;
    /// assert!((after.spin() / 0.5e6 - 1.0_f64).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn spin(&self) -> T {
        self.spin
    }

    /// Velocity of the contact point, V_t - r W, m/s.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // The contact point springs back, which a rigid contact does not do.
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(1.0)?;
    /// let after = scene.with_compliance(6.0 / 7.0)?.solve(&motion, &Adaptive::new(1e-9)?)?.tangential;
    /// assert!(after.slip() < 0.0_f64);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn slip(&self) -> T {
        self.slip
    }

    /// Impulse ratio mu, the tangential over the normal impulse; negative against a positive slip.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.1)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(5.0)?;
    /// let after = scene.with_compliance(0.85)?.solve(&motion, &Adaptive::new(1e-10)?)?.tangential;
    /// assert!((after.impulse_ratio() + 0.1_f64).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn impulse_ratio(&self) -> T {
        self.impulse_ratio
    }

    /// Number of phases: longest intervals of sticking, or of slip in one direction.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let scene = scene.with_compliance(6.0 / 7.0)?;
    /// let phases = |v_t| -> Result<u32, microimpact::InputError> {
    ///     let motion = NormalMotion::new(1.0)?.with_tangential(v_t)?;
    ///     Ok(scene.solve(&motion, &Adaptive::new(1e-9_f64)?)?.tangential.phases())
    /// };
    /// assert_eq!(phases(0.1)?, 2); // sticking, then slip
    /// assert_eq!(phases(1.0)?, 3); // slip, sticking, slip back
    /// assert_eq!(phases(5.0)?, 1); // slip throughout
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn phases(&self) -> u32 {
        self.phases
    }
}

/// The motion along the surface so far, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompliantMotion<T> {
    friction: T,
    stiffness_ratio: T,
    unloading: Unloading,
    gyration_ratio: T,
    /// Velocities of centre and periphery before contact, and the approach speed.
    velocity: T,
    peripheral: T,
    approach: T,
    /// Velocity of the contact point.
    slip: T,
    /// Force of the sticking element or, where unloading rescales it, its elongation F/k.
    element: T,
    /// Sign of the slip; zero where the element sticks.
    direction: T,
    /// Sign of a slip that has just ended, else zero.
    ended: T,
    /// Whether `element` is an elongation.
    elongates: bool,
    phases: u32,
    /// Estimated error of the slip so far, divided by the change that friction can produce.
    error: T,
    /// Distance of the contact point, and the time since first contact.
    distance: T,
    now: T,
}

/// The normal motion over a part of an interval, in the order of time.
struct Part<T, const N: usize> {
    s: [T; N],
    /// Rate of the indentation, positive on the way in.
    rate: [T; N],
    /// Duration of each fraction of the part.
    time: [T; N],
    begins_contact: bool,
}

/// The motion along the surface at the nodes of a part.
struct Followed<T, const N: usize> {
    slip: [T; N],
    element: [T; N],
    /// Last coefficients of its rates of change, divided by the change of slip that friction can produce.
    unresolved: T,
}

impl<T: Real> CompliantMotion<T> {
    /// Change of slip for each unit of friction impulse: b.
    #[inline]
    fn mobility(&self) -> T {
        T::ONE + T::ONE / self.gyration_ratio
    }

    /// Impulse of friction so far, over the mass.
    #[inline]
    fn impulse(&self) -> T {
        (self.slip - (self.velocity - self.peripheral)) / self.mobility()
    }

    /// Velocities of centre and periphery.
    #[inline]
    pub(crate) fn velocities(&self) -> (T, T) {
        (self.velocity + self.impulse(), self.peripheral - self.impulse() / self.gyration_ratio)
    }

    /// Distances of centre and periphery. They depend on the distance of the contact point as the velocities do on the slip.
    pub(crate) fn distances(&self) -> (T, T) {
        let moved = (self.distance - (self.velocity - self.peripheral) * self.now) / self.mobility();
        (self.velocity * self.now + moved, self.peripheral * self.now - moved / self.gyration_ratio)
    }

    /// Whether the contact point moves or the element holds a force.
    #[inline]
    pub(crate) fn moves(&self) -> bool {
        self.direction != T::ZERO || self.slip != T::ZERO || self.element != T::ZERO
    }

    /// Kinetic energies along the surface before contact and now, over the mass.
    pub(crate) fn energies(&self) -> [T; 2] {
        let unit = self.energy_speed();
        [(self.velocity, self.peripheral), self.velocities()].map(|(v, u)| {
            let (v, u) = (v / unit, u / unit);
            T::constant(0.5) * (v * v + self.gyration_ratio * u * u)
        })
    }

    /// A velocity whose square times the mass is the unit of these energies, as with friction alone.
    pub(crate) fn energy_speed(&self) -> T {
        self.velocity.abs().max(self.peripheral.abs()).max(T::ONE)
    }

    /// Force or elongation of the element at which it slips.
    #[inline]
    fn limit(&self, s: T) -> T {
        if self.elongates {
            T::constant(LIMIT_OF_ELONGATION) * self.friction * s * s / self.stiffness_ratio
        } else {
            T::constant(ELASTICITY) * self.friction * s * s * s
        }
    }

    #[inline]
    fn stiffness(&self, s: T) -> T {
        T::constant(STIFFNESS) * self.stiffness_ratio * s
    }

    /// Slip rate of the element in a direction: the velocity `slip` of the contact point less the rate at which the element shortens.
    #[inline]
    fn slip_rate(&self, direction: T, slip: T, rate: T) -> T {
        let factor = if self.elongates { T::constant(LIMIT_OF_ELONGATION) } else { T::ONE };
        direction * slip - factor * self.friction * rate / self.stiffness_ratio
    }

    /// Change of slip that friction can produce.
    #[inline]
    fn scale(&self) -> T {
        (self.velocity - self.peripheral).abs().min(self.mobility() * self.friction)
    }

    /// Follows an interval. Returns the estimated error, divided by the change of slip that friction can produce.
    fn advance<const N: usize>(&mut self, interval: &Interval<T, N>) -> T
    where
        T: Nodes<N>,
    {
        let inwards = (interval.s[N - 1] > interval.s[0]) == interval.forward;
        let curves = [&interval.s, &interval.y, &interval.rate].map(|values| coefficients(values, N));
        let stiffest = self.stiffness(interval.s[0].max(interval.s[N - 1]));
        let duration = dot(&T::WEIGHTS, &interval.rate);
        let oscillation = duration * (self.mobility() * stiffest).sqrt();
        let longest = T::constant(LONGEST_OSCILLATION * N as f64);
        let mut from = T::ZERO;
        let (before, mut largest) = (self.error, T::constant(TAIL_ERROR) * unresolved(&interval.y));
        for _ in 0..MOST_PARTS {
            let mut length = T::ONE - from;
            let last = self.direction != T::ZERO || length * oscillation <= longest;
            if !last {
                length = longest / oscillation;
            }
            let places = T::Z.map(|z| if interval.forward { from + length * z } else { T::ONE - from - length * z });
            let [s, speed, time] = curves.each_ref().map(|curve| series(curve, N, &places));
            let rate = if inwards { speed } else { speed.map(|speed| -speed) };
            let begins_contact = self.now == T::ZERO && from == T::ZERO;
            let part = Part { s, rate, time: time.map(|time| length * time), begins_contact };
            if !inwards && !self.elongates && self.unloading == Unloading::Rescaled {
                // The peak is where the interval begins.
                self.element = self.element / self.stiffness(at(&part.s, T::ZERO));
                self.elongates = true;
            }
            let followed = self.follow(&part);
            largest = largest.max(T::constant(TAIL_ERROR) * followed.unresolved);
            self.error = before + largest;
            let moments = integrals(&T::INTEGRATION, &product(&followed.slip, &part.time));
            let Some((place, direction)) = self.event(&part, &followed) else {
                (self.slip, self.element) = (followed.slip[N - 1], followed.element[N - 1]);
                self.distance = self.distance + moments[N - 1];
                self.ended = T::ZERO;
                if last {
                    self.now = self.now + duration;
                    return largest;
                }
                from = from + length;
                continue;
            };
            self.slip = at(&followed.slip, place);
            self.distance = self.distance + at(&moments, place);
            self.phases += 1;
            self.ended = self.direction;
            self.element = -self.direction * self.limit(at(&part.s, place));
            self.direction = direction;
            from = from + length * place;
        }
        T::ONE
    }

    /// The motion over a part of an interval, without events.
    fn follow<const N: usize>(&self, part: &Part<T, N>) -> Followed<T, N>
    where
        T: Nodes<N>,
    {
        let b = self.mobility();
        let scale = self.scale() + T::SMALLEST;
        if self.direction != T::ZERO {
            let force = -self.direction * b * self.friction * T::constant(ELASTICITY);
            let mut change = part.time;
            for j in 0..N {
                let s = part.s[j];
                change[j] = force * s * s * s * part.time[j];
            }
            let slip = integrals(&T::INTEGRATION, &change).map(|change| self.slip + change);
            return Followed { slip, element: [T::ZERO; N], unresolved: unresolved(&change) / scale };
        }
        // u' = drive x and x' = -pull u: u follows from x by integration, and x from a system of linear equations.
        let (mut drive, mut pull) = (part.time.map(|time| b * time), part.time);
        for j in 0..N {
            let stiff = if self.elongates { &mut drive[j] } else { &mut pull[j] };
            *stiff = *stiff * self.stiffness(part.s[j]);
        }
        let (mut matrix, mut element) = ([[T::ZERO; N]; N], [T::ZERO; N]);
        let pulled = integrals(&T::INTEGRATION, &pull);
        for k in 0..N {
            let column = integrals(&T::INTEGRATION, &product(&pull, &T::INTEGRATION[k]));
            for j in 0..N {
                matrix[j][k] = column[j] * drive[k];
            }
            matrix[k][k] = matrix[k][k] + T::ONE;
            element[k] = self.element - self.slip * pulled[k];
        }
        // Not singular: the collocation of an oscillation has a solution for every length of the part.
        eliminate(&mut matrix, &mut element);
        let change = product(&drive, &element);
        let slip = integrals(&T::INTEGRATION, &change).map(|change| self.slip + change);
        // An error of the force counts relative to the limit of friction, or by the slip that an oscillation turns it into.
        let stiffness = self.stiffness(T::ONE);
        let mut weight = (b / T::constant(ELASTICITY)).min((b / stiffness).sqrt());
        if self.elongates {
            weight = weight * stiffness;
        }
        let of_element = weight * unresolved(&product(&pull, &slip));
        Followed { slip, element, unresolved: unresolved(&change).max(of_element) / scale }
    }

    /// The first event in a part of an interval: its place, and the direction of slip after it, or zero.
    fn event<const N: usize>(&self, part: &Part<T, N>, followed: &Followed<T, N>) -> Option<(T, T)>
    where
        T: Nodes<N>,
    {
        let rates = |direction: T| {
            let mut rates = followed.slip;
            for j in 0..N {
                rates[j] = self.slip_rate(direction, followed.slip[j], part.rate[j]);
            }
            rates
        };
        if self.direction != T::ZERO {
            // A rate that vanishes at separation, at the threshold of slip throughout, may be negative by its error.
            let allowed = self.error * self.scale() + T::constant(ROUNDINGS) * T::EPSILON * self.slip.abs();
            return Some((first_fall(&rates(self.direction).map(|rate| rate + allowed))?, T::ZERO));
        }
        if !self.moves() {
            return None;
        }
        // How far the element is from its limit. Zeros that are known beforehand are divided out.
        let gap = |direction: T| {
            let mut gap = followed.element;
            if direction == self.ended {
                // It begins at zero with slope zero: a slip in this direction has just ended.
                let mut pull = part.time;
                if !self.elongates {
                    for j in 0..N {
                        pull[j] = pull[j] * self.stiffness(part.s[j]);
                    }
                }
                gap = integrals(&T::INTEGRATION, &product(&pull, &rates(direction)));
                for j in 0..N {
                    gap[j] = -gap[j] / (T::Z[j] * T::Z[j]);
                }
                return gap;
            }
            for j in 0..N {
                let s = part.s[j];
                gap[j] = self.limit(s) + direction * gap[j];
                if part.begins_contact {
                    gap[j] = gap[j] / (s * s * s);
                }
            }
            gap
        };
        let falls = [T::ONE, -T::ONE].map(|direction| first_fall(&gap(direction)).map(|place| (place, direction)));
        match falls {
            [Some(forward), Some(back)] => Some(if back.0 < forward.0 { back } else { forward }),
            [forward, back] => forward.or(back),
        }
    }
}

/// Products node by node.
#[inline]
fn product<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> [T; N] {
    let mut product = *a;
    for j in 0..N {
        product[j] = product[j] * b[j];
    }
    product
}

/// The polynomial through the values at the nodes, at a place between 0 and 1.
#[inline]
fn at<T: Nodes<N>, const N: usize>(values: &[T; N], place: T) -> T {
    let [value] = series(&coefficients(values, N), N, &[place]);
    value
}

/// The first place between 0 and 1 at which the polynomial through the values at the nodes falls below zero, even if it comes back
/// at once. Zero where it is not positive and falls from the beginning.
#[inline(never)]
fn first_fall<T: Nodes<N>, const N: usize>(values: &[T; N]) -> Option<T> {
    let coefficients = coefficients(values, N);
    let height = |place: T| {
        let [height] = series(&coefficients, N, &[place]);
        (place, height)
    };
    let fall = |above: (T, T), below: (T, T)| {
        root(above, below, T::EPSILON, |place| Ok::<_, NotConverged>(height(place).1)).unwrap_or(below.0)
    };
    // Closer together at both ends, as the extrema of polynomials are.
    let place = |index: u32| {
        let t = T::constant(f64::from(index) / f64::from(PLACES));
        t * t * (T::constant(3.0) - t - t)
    };
    let (mut before, mut here) = (height(T::ZERO), height(T::ZERO));
    let mut falling = height(T::constant(BEGINNING) * place(1)).1 < here.1;
    for index in 1..=PLACES {
        let next = height(place(index));
        if here.1 <= T::ZERO && next.1 < here.1 {
            return Some(here.0);
        }
        if here.1 > T::ZERO && next.1 < T::ZERO {
            return Some(fall(here, next));
        }
        if falling && here.1 > T::ZERO && next.1 >= here.1 {
            let lowest = minimum(before.0, next.0, height);
            if lowest.1 < T::ZERO {
                return Some(fall(before, lowest));
            }
        }
        falling = next.1 < here.1;
        (before, here) = (here, next);
    }
    None
}

/// Place and height of the minimum between two places, by golden-section search.
fn minimum<T: Real>(mut low: T, mut high: T, height: impl Fn(T) -> (T, T)) -> (T, T) {
    let kept = T::constant(GOLDEN_SECTION);
    let (mut left, mut right) = (height(high - kept * (high - low)), height(low + kept * (high - low)));
    for _ in 0..MINIMUM_STEPS {
        if left.1 < right.1 {
            high = right.0;
            right = left;
            left = height(high - kept * (high - low));
        } else {
            low = left.0;
            left = right;
            right = height(low + kept * (high - low));
        }
    }
    if left.1 < right.1 { left } else { right }
}

impl<T: Real> Observer<T> for CompliantMotion<T> {
    const TIMED: bool = true;
    // The element can oscillate faster than the normal motion changes.
    const DEMANDS: bool = true;
    const IN_STEPS: bool = false;

    #[inline]
    fn observe<const N: usize>(&mut self, _law: &impl ContactLaw<T>, interval: &Interval<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
        self.advance(interval);
    }

    #[inline]
    fn error<const N: usize>(&self, _law: &impl ContactLaw<T>, interval: &Interval<T, N>, allowed: T) -> T
    where
        T: Nodes<N>,
    {
        let mut trial = *self;
        let error = trial.advance(interval);
        // The solver chooses lengths as if an error were proportional to the power 2 N of the length. This one is to the power N.
        (error * error / allowed).min(T::ONE)
    }

    type State = ();

    #[inline]
    fn state(&self) {}

    #[inline]
    fn rates(&self, (): &(), _law: &impl ContactLaw<T>, _s: T, _y: T, _rebound: bool) {}

    #[inline]
    fn ended(&mut self, (): &(), _times: &Times<T>) {}
}

#[diagnostic::do_not_recommend] // so that a message speaks of the motion, not of this bound
impl<T: Real, B: Oblique<T>> Surface<T, B> for Compliance<T> {
    type Start = CompliantMotion<T>;
    type Observer = CompliantMotion<T>;
    type After = CompliantVelocities<T>;

    fn start<L: ContactLaw<T>>(
        &self,
        before: &B,
        sphere: &Sphere<T>,
        law: &L,
        units: &Units<T>,
    ) -> Result<Self::Start, InputError> {
        let Self { friction, stiffness_ratio, unloading } = self.under(law)?;
        let friction = friction.coefficient();
        let approach = (units.energy + units.energy).sqrt();
        let (velocity, peripheral) = (before.tangential() / units.speed, before.peripheral() / units.speed);
        let slip = velocity - peripheral;
        let slips = stiffness_ratio * slip.abs() > friction * approach;
        let direction = if slip < T::ZERO { -T::ONE } else { T::ONE };
        Ok(CompliantMotion {
            friction,
            stiffness_ratio,
            unloading,
            gyration_ratio: sphere.gyration_ratio(),
            velocity,
            peripheral,
            approach,
            slip,
            element: T::ZERO,
            direction: if slips { direction } else { T::ZERO },
            ended: T::ZERO,
            elongates: false,
            phases: 1,
            error: T::ZERO,
            distance: T::ZERO,
            now: T::ZERO,
        })
    }

    #[inline]
    fn observer(start: &Self::Start) -> CompliantMotion<T> {
        *start
    }

    fn after(
        observer: &CompliantMotion<T>,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> CompliantVelocities<T> {
        let (velocity, peripheral) = observer.velocities();
        let restitution = path.restitution_squared(units.energy).sqrt();
        CompliantVelocities {
            motion: if observer.moves() { SurfaceMotion::Sliding } else { SurfaceMotion::Rolling },
            velocity: velocity * units.speed,
            spin: peripheral * units.speed / sphere.radius(),
            slip: observer.slip * units.speed,
            impulse_ratio: observer.impulse() / ((T::ONE + restitution) * observer.approach),
            phases: observer.phases,
        }
    }
}
