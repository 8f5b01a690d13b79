//! Events of particles whose size and material the detector measures: each has a scene of its own.

use super::{Classifier, Reading, Rejection, Verdict};
use crate::{Approach, Fault, InputError, NormalMotion, Parameter, Real};

/// A reading with the time at which it was taken.
///
/// The interrupt copies the counter of a clock, so that no floating point is needed there. An
/// [`EventCounter`](super::EventCounter) uses the times.
///
/// ```
/// use microimpact::instrument::{NormalReading, Reading, Stamped};
///
/// let event = Stamped { ticks: 4_000_000, reading: NormalReading { approach: 2.8 } };
/// assert_eq!(event.motion(), event.reading.motion());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stamped<R> {
    /// Value of a clock's counter. It counts upwards; zero follows the largest value.
    pub ticks: u32,
    /// The reading.
    pub reading: R,
}

impl<R: Reading> Reading for Stamped<R> {
    type Motion = R::Motion;

    #[inline]
    fn motion(&self) -> Result<R::Motion, InputError> {
        self.reading.motion()
    }
}

/// A reading of a detector that also measures the size of the particle, and that knows its material.
///
/// ```
/// use microimpact::instrument::{NormalReading, Reading, SizedReading};
///
/// let reading = SizedReading { radius: 5e-6, material: 0, reading: NormalReading { approach: 2.8 } };
/// assert_eq!(reading.motion()?.radius(), 5e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SizedReading<T, R> {
    /// Radius of the particle, m.
    pub radius: T,
    /// Index of the particle's material in the table of a [`PerParticle`] classifier; zero if there is one material only.
    pub material: u8,
    /// Motion of the particle.
    pub reading: R,
}

impl<T: Real, R: Reading> Reading for SizedReading<T, R> {
    type Motion = SizedMotion<T, R::Motion>;

    #[inline]
    fn motion(&self) -> Result<Self::Motion, InputError> {
        let radius = Parameter::Radius.check(self.radius)?;
        Ok(SizedMotion { radius, material: self.material, motion: self.reading.motion()? })
    }
}

/// A valid [`SizedReading`]: a motion with the radius and the material of the particle.
///
/// ```
/// use microimpact::Approach;
/// use microimpact::instrument::{NormalReading, Reading, SizedReading};
///
/// let motion = SizedReading { radius: 5e-6, material: 1, reading: NormalReading { approach: 2.8 } }.motion()?;
/// assert_eq!((motion.radius(), motion.material(), motion.normal().speed()), (5e-6, 1, 2.8));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SizedMotion<T, M> {
    radius: T,
    material: u8,
    motion: M,
}

impl<T: Real, M> SizedMotion<T, M> {
    /// Radius of the particle, m.
    ///
    /// ```
    /// # use microimpact::instrument::{NormalReading, Reading, SizedReading};
    /// let motion = SizedReading { radius: 5e-6, material: 0, reading: NormalReading { approach: 2.8 } }.motion()?;
    /// assert_eq!(motion.radius(), 5e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn radius(&self) -> T {
        self.radius
    }

    /// Index of the particle's material.
    ///
    /// ```
    /// # use microimpact::instrument::{NormalReading, Reading, SizedReading};
    /// let motion = SizedReading { radius: 5e-6, material: 3, reading: NormalReading { approach: 2.8 } }.motion()?;
    /// assert_eq!(motion.material(), 3);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn material(&self) -> u8 {
        self.material
    }

    /// The motion without the particle.
    ///
    /// ```
    /// # use microimpact::instrument::{NormalReading, Reading, SizedReading};
    /// let motion = SizedReading { radius: 5e-6, material: 0, reading: NormalReading { approach: 2.8 } }.motion()?;
    /// assert_eq!(motion.motion().speed(), 2.8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn motion(&self) -> &M {
        &self.motion
    }
}

impl<T, M: Approach<T>> Approach<T> for SizedMotion<T, M> {
    const OF_TWO_BODIES: bool = M::OF_TWO_BODIES;

    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        self.motion.normal()
    }
}

/// A classifier that makes a scene for each particle, from its material and its radius.
///
/// `P` describes a material in any way, and `scene` makes the classifier: a [`RigidBody`](crate::RigidBody), a
/// [`Simulated`](super::Simulated) contact, or a [`Tabulated`](super::Tabulated) table that covers the radius. A reading whose
/// radius is out of range, or whose material is not in the table, is rejected and counted.
///
/// ```
/// use microimpact::instrument::{Instrument, NoLines, NormalReading, PerParticle, SizedReading, SpeedBins};
/// use microimpact::{ConstantRestitution, InputError, Outcome, RigidBody, Sphere, rigid::WorkOfAdhesion};
///
/// /// Density (kg/m^3) and work of adhesion for a radius (J/m).
/// struct Material(f32, f32);
/// static MATERIALS: [Material; 2] = [Material(2600.0, 4e-7), Material(1050.0, 1e-6)];
///
/// type Scene = RigidBody<f32, ConstantRestitution<f32>, WorkOfAdhesion<f32>>;
/// fn scene(material: &Material, radius: f32) -> Result<Scene, InputError> {
///     RigidBody::new(Sphere::solid(radius, material.0)?, ConstantRestitution::new(0.9)?)
///         .with_work_of_adhesion(material.1 * radius)
/// }
///
/// let classifier = PerParticle { materials: &MATERIALS, scene };
/// let mut instrument: Instrument<_, _, f32, 3, 1> = Instrument::new(classifier, NoLines, SpeedBins::new([10.0])?);
/// let mut class = |radius, material| {
///     let reading = NormalReading { approach: 1.0 };
///     instrument.process(&SizedReading { radius, material, reading }).map(|verdict| verdict.class)
/// };
/// assert_eq!(class(10e-6, 0), Ok(Outcome::Rebound));
/// assert_eq!(class(2e-6, 0), Ok(Outcome::Capture));
/// assert_eq!(class(10e-6, 1), Ok(Outcome::Capture));
/// assert_eq!(
///     class(10e-6, 2).unwrap_err().to_string(),
///     "index of the material is 2, but must be the index of an entry of the table; the first entry has the index 0"
/// );
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerParticle<'a, P, F> {
    /// The materials. The first has the index zero.
    pub materials: &'a [P],
    /// Makes the classifier for a particle of a material and a radius (m).
    pub scene: F,
}

impl<'a, P, F> PerParticle<'a, P, F> {
    /// Makes the classifier for a particle with a `material` index and a `radius`, m.
    ///
    /// # Errors
    /// The table has no such material, or the scene cannot be made for this radius.
    ///
    /// ```
    /// use microimpact::instrument::PerParticle;
    /// use microimpact::{InputError, Parameter, Sphere};
    ///
    /// let densities = [1000.0, 2600.0];
    /// let particles = PerParticle { materials: &densities, scene: |&density, radius| Sphere::solid(radius, density) };
    /// assert_eq!(particles.scene(1, 5e-6)?.density(), 2600.0);
    /// assert_eq!(particles.scene(2, 5e-6).unwrap_err().parameter, Parameter::MaterialIndex);
    /// # Ok::<(), InputError>(())
    /// ```
    #[inline]
    pub fn scene<T, C>(&self, material: u8, radius: T) -> Result<C, InputError>
    where
        F: Fn(&'a P, T) -> Result<C, InputError>,
    {
        let Some(properties) = self.materials.get(usize::from(material)) else {
            let (parameter, fault) = (Parameter::MaterialIndex, Fault::NotInTable);
            return Err(InputError { parameter, fault, value: f32::from(material) });
        };
        (self.scene)(properties, radius)
    }
}

impl<'a, T, M, P, F, C> Classifier<T, SizedMotion<T, M>> for PerParticle<'a, P, F>
where
    T: Real,
    C: Classifier<T, M>,
    F: Fn(&'a P, T) -> Result<C, InputError>,
{
    type Class = C::Class;

    #[inline]
    fn verdict(&self, motion: &SizedMotion<T, M>) -> Result<Verdict<T, C::Class>, Rejection> {
        self.scene(motion.material, motion.radius)?.verdict(&motion.motion)
    }
}

#[cfg(feature = "defmt")]
impl<P: defmt::Format, F> defmt::Format for PerParticle<'_, P, F> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "PerParticle {{ materials: {} }}", self.materials);
    }
}
