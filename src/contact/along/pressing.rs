//! The normal force to which Coulomb's friction is proportional.

use crate::Real;
use crate::contact::law::ContactLaw;
use crate::numbers::{NotConverged, root};
use crate::terms::ElasticForce;

/// The normal force to which Coulomb's friction is proportional.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, ElasticForce, TotalAndPullOff, TotalForce};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // A sphere that slides throughout: without damping the integral of the total force is 2 m v.
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let (motion, method) = (NormalMotion::new(5.0)?.with_tangential(50.0)?, Adaptive::new(1e-9)?);
/// let scene = Contact::hertz(sphere, stiffness).with_dmt(0.2)?;
/// let lost = |after: f64| (50.0 - after) / (0.1 * 2.0 * 5.0);
/// let elastic = scene.with_friction_under(0.1, ElasticForce)?.solve(&motion, &method)?.tangential.velocity();
/// assert_eq!(elastic, scene.with_friction(0.1)?.solve(&motion, &method)?.tangential.velocity());
/// let total = scene.with_friction_under(0.1, TotalForce::new())?.solve(&motion, &method)?.tangential.velocity();
/// let thornton = scene.with_friction_under(0.1, TotalAndPullOff::new())?.solve(&motion, &method)?.tangential.velocity();
/// assert!(1.0 < lost(total) && lost(total) < lost(elastic) && lost(elastic) < lost(thornton));
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait PressingForce<T: Real>: Copy {
    /// Whether it presses on a captured sphere at rest too, so that every slip ends.
    const PRESSES_AT_REST: bool;

    /// The same force with its numbers in units of the impact of a law in these units.
    #[must_use]
    fn in_units(&self, law: &impl ContactLaw<T>) -> Self;

    /// The force at a coordinate, in units of the impact.
    fn at(&self, law: &impl ContactLaw<T>, s: T) -> T;

    /// The coordinate up to which nothing presses, where the force has a kink.
    #[inline]
    fn kink(&self) -> Option<T> {
        None
    }
}

impl<T: Real> PressingForce<T> for ElasticForce {
    const PRESSES_AT_REST: bool = true;

    #[inline]
    fn in_units(&self, _law: &impl ContactLaw<T>) -> Self {
        Self
    }

    #[inline]
    fn at(&self, law: &impl ContactLaw<T>, s: T) -> T {
        law.elastic_force(s)
    }
}

/// The elastic force less adhesion where that is positive, and otherwise nothing. Damping does not count.
///
/// Nothing presses on a sphere at rest. A captured sphere may then slide on: its velocities are those where it first turns back, or,
/// by [`solve_to_rest`](crate::contact::Contact::solve_to_rest), where it rests along the normal.
/// [`FixedCost`](crate::contact::FixedCost) does not carry it where there is adhesion.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, RestCriterion, TotalForce};
/// use microimpact::{NormalMotion, Sphere, Stiffness, SurfaceMotion};
///
/// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction_under(0.1, TotalForce::new())?;
/// let motion = NormalMotion::new(1.0)?.with_tangential(70.0)?;
/// let (method, criterion) = (Adaptive::new(1e-9)?, RestCriterion::new(1e-6, 1000)?);
/// let settled = scene.solve_to_rest(&motion, &method, &criterion, ())?;
/// assert_eq!(settled.impact.tangential.motion(), SurfaceMotion::Sliding);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TotalForce<T> {
    /// The coordinate at which the forces balance, in units of an impact.
    balance: T,
}

impl<T: Real> TotalForce<T> {
    /// The force of any law.
    ///
    /// ```
    /// assert_eq!(microimpact::contact::TotalForce::<f32>::new(), Default::default());
    /// ```
    pub fn new() -> Self {
        Self { balance: T::ZERO }
    }
}

impl<T: Real> Default for TotalForce<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> PressingForce<T> for TotalForce<T> {
    const PRESSES_AT_REST: bool = false;

    fn in_units(&self, law: &impl ContactLaw<T>) -> Self {
        Self { balance: balance(law) }
    }

    #[inline]
    fn at(&self, law: &impl ContactLaw<T>, s: T) -> T {
        (law.elastic_force(s) - law.adhesion_force(s)).max(T::ZERO)
    }

    #[inline]
    fn kink(&self) -> Option<T> {
        Some(self.balance).filter(|place| *place > T::ZERO)
    }
}

/// The elastic force less adhesion, and twice the force that pulls the sphere off (Thornton 1991).
///
/// ```
/// assert_eq!(size_of::<microimpact::contact::TotalAndPullOff<f32>>(), 4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TotalAndPullOff<T> {
    /// Largest tension of the law, in units of an impact.
    pull_off: T,
}

impl<T: Real> TotalAndPullOff<T> {
    /// The force of any law.
    ///
    /// ```
    /// assert_eq!(microimpact::contact::TotalAndPullOff::<f32>::new(), Default::default());
    /// ```
    pub fn new() -> Self {
        Self { pull_off: T::ZERO }
    }
}

impl<T: Real> Default for TotalAndPullOff<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> PressingForce<T> for TotalAndPullOff<T> {
    const PRESSES_AT_REST: bool = true;

    fn in_units(&self, law: &impl ContactLaw<T>) -> Self {
        Self { pull_off: largest_tension(law).1 }
    }

    #[inline]
    fn at(&self, law: &impl ContactLaw<T>, s: T) -> T {
        law.elastic_force(s) - law.adhesion_force(s) + T::constant(2.0) * self.pull_off
    }
}

/// Coordinate beyond which the elastic force prevails: that of the undamped peak is one.
const BEYOND: f64 = 2.0;

/// Steps of the search for the largest tension; each takes a third off, and near a maximum half of the digits are enough.
const TENSION_STEPS: u32 = 80;

/// Doublings in the search for a place where the elastic force prevails.
const MOST_DOUBLINGS: u32 = 60;

/// By how much adhesion exceeds the elastic force.
fn tension<T: Real>(law: &impl ContactLaw<T>, s: T) -> T {
    law.adhesion_force(s) - law.elastic_force(s)
}

/// Where the tension of a law is largest, and that tension; zero without adhesion. A law has one maximum of it at most.
fn largest_tension<T: Real>(law: &impl ContactLaw<T>) -> (T, T) {
    let tension = |s| tension(law, s);
    let (mut low, mut high) = (law.end().min(law.start()), T::constant(BEYOND));
    let ends = (low, tension(low));
    for _ in 0..TENSION_STEPS {
        let third = (high - low) / T::constant(3.0);
        let (a, b) = (low + third, high - third);
        if tension(a) < tension(b) {
            low = a;
        } else {
            high = b;
        }
    }
    let middle = (low + high) / T::constant(2.0);
    let inner = (middle, tension(middle));
    let (place, largest) = if inner.1 > ends.1 { inner } else { ends };
    (place, largest.max(T::ZERO))
}

/// Where adhesion and the elastic force balance; zero without adhesion.
fn balance<T: Real>(law: &impl ContactLaw<T>) -> T {
    let tension = |s| tension(law, s);
    let (place, largest) = largest_tension(law);
    if largest <= T::ZERO {
        return T::ZERO;
    }
    let mut beyond = T::ONE.max(place + place);
    for _ in 0..MOST_DOUBLINGS {
        if tension(beyond) < T::ZERO {
            break;
        }
        beyond = beyond + beyond;
    }
    let found = root((place, largest), (beyond, tension(beyond)), T::EPSILON, |s| Ok::<_, NotConverged>(tension(s)));
    found.unwrap_or(T::ZERO)
}
