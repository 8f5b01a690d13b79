//! Results of a simulation, in SI units.

use super::law::{ContactLaw, Units};
use super::scene::Classified;
use super::solve::path::NormalPath;
use super::solve::{MotionToRest, RunReport, Status};
#[cfg(doc)]
use super::{CompliantVelocities, TangentialVelocities};
use crate::{Class, ContactClass, Outcome, Real};

/// The result of a simulation, with `V` for the velocities along the surface: `()` without friction, else
/// [`TangentialVelocities`], or [`CompliantVelocities`] with compliance.
///
/// ```
/// use microimpact::contact::{Contact, Collocation, SimulatedImpact};
/// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let impact: SimulatedImpact<f64, ()> = scene.solve(&NormalMotion::new(1.0)?, &Collocation::<7, f64>::new(1e-6)?)?;
/// assert_eq!(impact.normal.outcome(), Some(Outcome::Rebound));
/// assert!((impact.normal.overall_restitution() - 1.0).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SimulatedImpact<T, V> {
    /// Along the normal.
    pub normal: NormalContact<T>,
    /// Along the surface, where friction takes part.
    pub tangential: V,
    /// Statistics of the solver.
    pub run: RunReport<T>,
}

impl<T: Real, V: Classified<T, Contact = ContactClass<T>>> SimulatedImpact<T, V> {
    /// Outcome and motion along the surface in one word; `None` where the method found no solution.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact};
    /// use microimpact::{Class, NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// let class = |v_n, v_t| Ok(scene.solve(&NormalMotion::new(v_n)?.with_tangential(v_t)?, &method)?.class());
    /// assert_eq!(class(8.0, 1.0), Ok::<_, microimpact::InputError>(Some(Class::ReboundRolling)));
    /// assert_eq!(class(8.0, 90.0), Ok(Some(Class::ReboundSliding)));
    /// assert_eq!(class(5.0, 1.0), Ok(Some(Class::CapturedRolling)));
    /// assert_eq!(class(5.0, 0.0), Ok(Some(Class::CapturedResting)));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn class(&self) -> Option<Class> {
        self.normal.outcome.map(|outcome| Class::of(outcome, self.tangential.contact().motion))
    }
}

/// The result of a simulation that follows a captured sphere to rest.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, RestCriterion, Status};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let (method, criterion) = (Collocation::<9, f64>::new(1e-9)?, RestCriterion::new(1e-6, 1000)?);
/// let captured = scene.solve_to_rest(&NormalMotion::new(1.0)?, &method, &criterion, ())?;
/// assert_eq!(captured.impact.run.status, Status::Solved);
/// assert!(captured.motion.is_some());
/// let rebound = scene.solve_to_rest(&NormalMotion::new(8.0)?, &method, &criterion, ())?;
/// assert!(rebound.motion.is_none());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SettledImpact<T, V, R = ()> {
    /// The impact. Velocities and outputs of a captured sphere are those at rest. If it does not come to rest within the
    /// turning points that were allowed, or damping takes less in a swing than rounding, the status of the run says that the
    /// budget is spent.
    pub impact: SimulatedImpact<T, V>,
    /// How a captured sphere came to where it was left; `None` for a rebound.
    pub motion: Option<MotionToRest<T>>,
    /// What else was asked for.
    pub outputs: R,
}

/// The normal side of a simulated impact.
///
/// ```
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Without adhesion and damping this is Hertz's impact.
/// let scene = Contact::hertz(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let contact = scene.solve(&NormalMotion::new(2.8)?, &Collocation::<9, f64>::new(1e-9)?)?.normal;
/// assert!((contact.peak_indentation().unwrap() - 1.9713e-8).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NormalContact<T> {
    status: Status,
    outcome: Option<Outcome>,
    approach: T,
    restitution_squared: T,
    /// Zero where there is none.
    peak_indentation: T,
    /// Zero where there is none; less where adhesion has stretched the contact.
    turning_indentation: T,
}

impl<T: Real> NormalContact<T> {
    #[inline]
    pub(super) fn new<L: ContactLaw<T>>(path: &NormalPath<T>, approach: T, law: &L, units: &Units<T>) -> Self {
        let indentation = |s: T| if s > T::ZERO { units.length * law.indentation(s) } else { T::ZERO };
        Self::with_indentations(path, approach, units.energy, (indentation(path.peak), indentation(path.turning)))
    }

    /// The result of a motion from a kinetic energy, with the indentations of the peak and of a turning point.
    #[inline]
    pub(super) fn with_indentations(path: &NormalPath<T>, approach: T, energy: T, (peak, turning): (T, T)) -> Self {
        Self {
            status: Status::of(path),
            outcome: path.outcome(),
            approach,
            restitution_squared: path.restitution_squared(energy),
            peak_indentation: peak,
            turning_indentation: turning,
        }
    }

    /// Whether the method found a solution.
    ///
    /// ```
    /// use microimpact::contact::{Contact, FixedCost, Status};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1e4)?;
    /// let contact = scene.solve(&NormalMotion::new(1.0)?, &FixedCost::<5>::new(3)?)?.normal;
    /// assert_eq!(contact.status(), Status::BudgetSpent); // too strongly damped for a method of fixed cost
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn status(&self) -> Status {
        self.status
    }

    /// Rebound or capture; `None` where the method found no solution.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact};
    /// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// assert_eq!(scene.solve(&NormalMotion::new(1.0)?, &method)?.normal.outcome(), Some(Outcome::Rebound));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn outcome(&self) -> Option<Outcome> {
        self.outcome
    }

    /// Overall restitution e; zero for a capture and where there is no solution.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// let contact = scene.solve(&NormalMotion::new(1.0)?, &method)?.normal;
    /// assert!((contact.overall_restitution() - 1.0).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn overall_restitution(&self) -> T {
        self.restitution_squared.sqrt()
    }

    /// Rebound speed V_n, m/s; zero for a capture and where there is no solution.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// let contact = scene.solve(&NormalMotion::new(2.0)?, &method)?.normal;
    /// assert!((contact.rebound_speed() - 2.0).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn rebound_speed(&self) -> T {
        self.approach * self.overall_restitution()
    }

    /// Peak indentation, m; `None` where an over-damped sphere creeps in without a peak.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let method = Collocation::<7, f64>::new(1e-6)?;
    /// assert!(scene.solve(&NormalMotion::new(1.0)?, &method)?.normal.peak_indentation().is_some());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn peak_indentation(&self) -> Option<T> {
        (self.peak_indentation > T::ZERO).then_some(self.peak_indentation)
    }

    /// Indentation at which a captured sphere first turns back, m; `None` for a rebound, a sphere that creeps to rest, or
    /// one that was not followed so far because no output asks for it. It is negative where adhesion pulls the surface outwards.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Times};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let (impact, _) = scene.solve_for(&NormalMotion::new(1.0)?, &Collocation::<9, f64>::new(1e-9)?, Times)?;
    /// let turning = impact.normal.turning_indentation().unwrap();
    /// assert!(turning > 0.0 && turning < impact.normal.peak_indentation().unwrap());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn turning_indentation(&self) -> Option<T> {
        (self.turning_indentation != T::ZERO).then_some(self.turning_indentation)
    }
}
