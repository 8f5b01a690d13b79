//! Classifiers: a rigid-body model, a simulation, a [table](super::Tabulated) or a type of your own.

use core::fmt;

use super::ClassSet;
use crate::contact::{Classified as ContactClassified, Contact, ContactLaw, Method, Surface};
use crate::rigid::{MicroforceTerm, ReboundAdhesion, TangentialOutcome, TangentialTerm};
use crate::{
    AnyModel, Approach, Class, Classification, ContactClass, InputError, Oblique, Outcome, Real, RestitutionLaw,
    RigidBody,
};

/// A classifier for motions `M` with numbers `T`.
///
/// ```
/// use microimpact::instrument::{Classifier, Verdict};
/// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?).with_friction(0.1)?;
/// let verdict = scene.verdict(&NormalMotion::new(1.0)?.with_tangential(5.0)?);
/// assert_eq!(verdict, Ok(Verdict { class: Class::ReboundSliding, restitution: Some(0.9) }));
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait Classifier<T, M> {
    /// The classes that the classifier distinguishes.
    type Class: ClassSet;

    /// Classifies an impact.
    ///
    /// # Errors
    /// The reason why the impact cannot be classified.
    ///
    /// ```
    /// use microimpact::instrument::{Classifier, Rejection, Simulated};
    /// use microimpact::contact::{Contact, FixedCost};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1e4)?;
    /// let overdamped = Simulated { scene, method: FixedCost::<5>::new(3)? };
    /// assert_eq!(overdamped.verdict(&NormalMotion::new(1.0)?), Err(Rejection::Unsolved));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    fn verdict(&self, motion: &M) -> Result<Verdict<T, Self::Class>, Rejection>;
}

/// Result of a classifier: class and restitution of an impact.
///
/// ```
/// use microimpact::instrument::{Classifier, Verdict};
/// use microimpact::{ConstantRestitution, NormalMotion, Outcome, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
/// let verdict = scene.verdict(&NormalMotion::new(1.0)?);
/// assert_eq!(verdict, Ok(Verdict { class: Outcome::Rebound, restitution: Some(0.9) }));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Verdict<T, C> {
    /// Class of the impact.
    pub class: C,
    /// Overall restitution e, zero for a capture. `None` if the classifier determines the class only.
    pub restitution: Option<T>,
}

/// Why a reading has no class.
///
/// ```
/// use microimpact::instrument::{NormalReading, Reading, Rejection};
///
/// let rejection = Rejection::from(NormalReading { approach: -1.0 }.motion().unwrap_err());
/// assert_eq!(
///     rejection.to_string(),
///     "approach speed is -1 m/s, but must be 1e-12 to 1e6 m/s; enter -1 m/s as 1"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Rejection {
    /// A value or a ratio of forces is outside its range.
    Input(InputError),
    /// The method did not converge.
    Unsolved,
}

impl From<InputError> for Rejection {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Unsolved => f.write_str("the method did not converge"),
        }
    }
}

impl core::error::Error for Rejection {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Input(error) => Some(error),
            Self::Unsolved => None,
        }
    }
}

/// A [`Classification`] that has one class: an [`Outcome`] without friction, a [`Class`] with friction.
///
/// ```
/// use microimpact::instrument::Classified;
/// use microimpact::{Classification, Outcome};
///
/// let classification = Classification { outcome: Outcome::Capture, speed_over_critical: Some(0.5), contact: () };
/// assert_eq!(Classified::class(&classification), Outcome::Capture);
/// ```
pub trait Classified {
    /// The classes that are distinguished.
    type Class: ClassSet;

    /// The class.
    fn class(&self) -> Self::Class;
}

impl<T> Classified for Classification<T, ()> {
    type Class = Outcome;

    #[inline]
    fn class(&self) -> Outcome {
        self.outcome
    }
}

impl<T> Classified for Classification<T, ContactClass<T>> {
    type Class = Class;

    #[inline]
    fn class(&self) -> Class {
        Self::class(self)
    }
}

impl<T, M, L, A, S, X, C> Classifier<T, M> for RigidBody<T, L, A, S, X>
where
    T: Real,
    M: Approach<T>,
    L: RestitutionLaw<T>,
    A: ReboundAdhesion<T>,
    S: TangentialTerm<T, M, Impact: TangentialOutcome<T, Class = C>>,
    X: MicroforceTerm<T>,
    Classification<T, C>: Classified,
{
    type Class = <Classification<T, C> as Classified>::Class;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, Self::Class>, Rejection> {
        let impact = self.impact(motion);
        let class = Classified::class(&self.classify_impact(&impact));
        Ok(Verdict { class, restitution: Some(impact.normal.overall_restitution()) })
    }
}

/// A simulated scene and the method that solves it.
///
/// Without friction, any method is possible. With friction, the method must compute the motion along the surface too. The scene may
/// be an [`AnyModel`], made of a configuration at run time; a rigid body does not use the method.
///
/// ```
/// use microimpact::instrument::{Classifier, Simulated};
/// use microimpact::contact::{Contact, FixedCost};
/// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(2.5e-6_f32, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let classifier = Simulated { scene, method: FixedCost::<7>::new(4)? };
/// assert!(classifier.verdict(&NormalMotion::new(8.0)?).is_ok_and(|verdict| verdict.class == Outcome::Rebound));
/// assert!(classifier.verdict(&NormalMotion::new(3.0)?).is_ok_and(|verdict| verdict.class == Outcome::Capture));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Simulated<S, N> {
    /// The scene.
    pub scene: S,
    /// The method.
    pub method: N,
}

impl<T, B, L, S, M, C> Classifier<T, B> for Simulated<Contact<T, L, S>, M>
where
    T: Real,
    B: Approach<T>,
    L: ContactLaw<T>,
    S: Surface<T, B, After: ContactClassified<T, Contact = C>>,
    M: Method<T>,
    Classification<T, C>: Classified,
{
    type Class = <Classification<T, C> as Classified>::Class;

    fn verdict(&self, motion: &B) -> Result<Verdict<T, Self::Class>, Rejection> {
        simulated(&self.scene, &self.method, motion)
    }
}

/// The verdict of a simulation.
fn simulated<T, B, L, S, M, C>(
    scene: &Contact<T, L, S>,
    method: &M,
    motion: &B,
) -> Result<Verdict<T, <Classification<T, C> as Classified>::Class>, Rejection>
where
    T: Real,
    B: Approach<T>,
    L: ContactLaw<T>,
    S: Surface<T, B, After: ContactClassified<T, Contact = C>>,
    M: Method<T>,
    Classification<T, C>: Classified,
{
    let impact = scene.solve(motion, method)?;
    let outcome = impact.normal.outcome().ok_or(Rejection::Unsolved)?;
    let contact = impact.tangential.contact();
    let class = Classified::class(&Classification { outcome, speed_over_critical: None, contact });
    Ok(Verdict { class, restitution: Some(impact.normal.overall_restitution()) })
}

impl<T, B, M> Classifier<T, B> for Simulated<AnyModel<T>, M>
where
    T: Real,
    B: Oblique<T>,
    M: Method<T>,
{
    type Class = Class;

    fn verdict(&self, motion: &B) -> Result<Verdict<T, Class>, Rejection> {
        match self.scene {
            AnyModel::RigidBody(body) => body.verdict(motion),
            AnyModel::Contact(scene) => simulated(&scene, &self.method, motion),
        }
    }
}
