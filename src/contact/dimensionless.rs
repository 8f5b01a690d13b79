//! An impact as the solver sees it: a few numbers near one, which any number type holds.

use super::law::{Attraction, Damping, HertzLaw, HystereticDamping, NoForce, Ring};
use super::scene::Contact;
use super::solve::path::NormalPath;
use super::solve::{Method, Status};
use crate::{Approach, InputError, Outcome, Parameter, Real};

/// The normal motion of an impact in units of its own, without an external force.
///
/// The unit of length is the peak indentation of the undamped motion, that of speed such that the elastic force is (5/4) s^3
/// at the contact radius s. Contact radius and speed then lie in 0 to 1 whatever the particle. On a processor without
/// floating point these numbers are computed beforehand, for scenes that do not change, or in f32.
///
/// `D` is the damping of the materials and `A` the adhesion.
///
/// ```
/// use microimpact::contact::{Contact, DimensionlessImpact, FixedCost};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let impact: DimensionlessImpact<f64> = scene.dimensionless(&NormalMotion::new(2.8)?)?;
/// let contact = impact.solve(&FixedCost::<5>::new(3)?);
/// assert!((contact.overall_restitution() - 0.746193).abs() < 1e-5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DimensionlessImpact<T, D = HystereticDamping<T>, A = Ring<T>> {
    /// The law in units of the impact.
    pub(crate) law: HertzLaw<T, D, A>,
    /// Kinetic energy before the impact.
    pub(crate) energy: T,
}

/// How a dimensionless impact ends.
///
/// ```
/// use microimpact::contact::{DimensionlessContact, DimensionlessImpact, FixedCost, Status};
/// use microimpact::Outcome;
///
/// // Hertz's impact.
/// let impact = DimensionlessImpact::new(0.0_f32, 0.0, 0.0)?;
/// let contact: DimensionlessContact<f32> = impact.solve(&FixedCost::<4>::new(2)?);
/// assert_eq!((contact.status, contact.outcome), (Status::Solved, Some(Outcome::Rebound)));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DimensionlessContact<T> {
    /// Whether the method converged.
    pub status: Status,
    /// Rebound, capture or, where the error bound exceeds the size of e^2, [`Undecided`](Outcome::Undecided). `None` where the
    /// method did not converge.
    pub outcome: Option<Outcome>,
    /// Square of the overall restitution e; zero unless the outcome is a rebound.
    pub restitution_squared: T,
    /// Bound of the error of e^2. The error of e is at most this divided by e.
    pub error_bound: T,
}

impl<T: Real> DimensionlessContact<T> {
    #[inline]
    fn new(path: &NormalPath<T>, energy: T) -> Self {
        let (status, outcome, error_bound) = (Status::of(path), path.outcome(), path.error_bound);
        Self { status, outcome, restitution_squared: path.restitution_squared(energy), error_bound }
    }

    /// Overall restitution e; zero unless the outcome is a rebound.
    ///
    /// ```
    /// use microimpact::contact::{DimensionlessImpact, FixedCost};
    ///
    /// let impact = DimensionlessImpact::new(0.0, 0.0, 0.0)?;
    /// assert!((impact.solve(&FixedCost::<4>::new(2)?).overall_restitution() - 1.0_f64).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn overall_restitution(&self) -> T {
        self.restitution_squared.sqrt()
    }
}

impl<T: Real> DimensionlessImpact<T> {
    /// An impact with a ring and hysteretic damping, of known groups: strength p of adhesion, 0 to 0.999 (the force of the ring is
    /// (3/4) p s and the energy before the impact (1 - p)/2), and damping of the materials and of adhesion for the unit of speed over
    /// the force that it accompanies, 0 to 0.5.
    ///
    /// # Errors
    /// A group outside its range.
    ///
    /// ```
    /// use microimpact::{Fault, Parameter, contact::DimensionlessImpact};
    ///
    /// let error = DimensionlessImpact::new(0.0, 3.0, 0.0).unwrap_err();
    /// assert_eq!((error.parameter, error.fault), (Parameter::DimensionlessDamping, Fault::TooLarge));
    /// ```
    pub fn new(adhesion: T, material_damping: T, adhesion_damping: T) -> Result<Self, InputError> {
        let strength = Parameter::DimensionlessAdhesion.check(adhesion)?;
        let damping = HystereticDamping { rate: Parameter::DimensionlessDamping.check(material_damping)? };
        let adhesion = Ring { strength, damping: Parameter::DimensionlessDamping.check(adhesion_damping)? };
        let law = HertzLaw { stiffness: T::ONE, damping, adhesion, force: NoForce };
        Ok(Self { law, energy: T::constant(0.5) * (T::ONE - strength) })
    }
}

impl<T: Real, D: Damping<T>, A: Attraction<T>> DimensionlessImpact<T, D, A> {
    /// The impact, solved by a method.
    ///
    /// With groups in the ranges of [`new`](DimensionlessImpact::new) and by [`FixedCost`](super::FixedCost), every value on the way,
    /// intermediate ones included, stays below 128 in size, or below 256 where the sphere is captured. By
    /// [`Collocation`](super::Collocation) they stay below 1e25, which f32 holds.
    ///
    /// ```
    /// use microimpact::contact::{DimensionlessImpact, FixedCost};
    /// use microimpact::Outcome;
    ///
    /// let impact = DimensionlessImpact::new(0.97, 0.4, 0.1)?;
    /// assert_eq!(impact.solve(&FixedCost::<6>::new(6)?).outcome, Some(Outcome::Capture));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn solve(&self, method: &impl Method<T>) -> DimensionlessContact<T> {
        DimensionlessContact::new(&method.solve(&self.law, self.energy, &mut ()), self.energy)
    }
}

impl<T: Real, D: Damping<T>, A: Attraction<T>, S> Contact<T, HertzLaw<T, D, A>, S> {
    /// The impact of a sphere that arrives with `motion`, in units of its own.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::{Contact, FixedCost};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // Hertz's impact is the same whatever the sphere.
    /// let impact = |radius| Contact::hertz(Sphere::solid(radius, 1000.0)?, Stiffness::new(1e10)?)
    ///     .dimensionless(&NormalMotion::new(1.0)?);
    /// assert_eq!(impact(1e-6)?, impact(1e-3)?);
    /// assert_eq!(impact(1e-6)?.solve(&FixedCost::<4>::new(2)?).overall_restitution(), 1.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn dimensionless(&self, motion: &impl Approach<T>) -> Result<DimensionlessImpact<T, D, A>, InputError> {
        let (law, units) = self.in_units(motion.normal().speed())?;
        // Nothing but the set-up reads the stiffness, which fixed point would not hold.
        Ok(DimensionlessImpact { law: HertzLaw { stiffness: T::ONE, ..law }, energy: units.energy })
    }
}
