//! Classes with a stated confidence: a reading whose errors allow another class is undecided.

use super::{ClassSet, Classifier, PlanarReading, Reading, Rejection, Verdict};
use crate::measure::{ClassProbabilities, Classifiable, Estimate, Uncertain};
use crate::{Approach, Class, InputError, NormalMotion, Parameter, PlanarMotion, Real};

/// A reading with standard errors: the motion of a particle in a plane, and its radius. The errors are independent.
///
/// A quantity that is not measured has its known value and its spread among the particles. Standard errors of the approach speed and of
/// the radius are at most three tenths of the value.
///
/// ```
/// use microimpact::Oblique;
/// use microimpact::instrument::{Reading, UncertainReading};
/// use microimpact::measure::Estimate;
///
/// let reading = UncertainReading {
///     approach: Estimate { value: 2.8, standard_error: 0.05 },
///     tangential: Estimate { value: 1.0, standard_error: 0.05 },
///     peripheral: Estimate { value: 0.0, standard_error: 0.3 },
///     radius: Estimate { value: 5e-6, standard_error: 0.1e-6 },
/// };
/// assert_eq!(reading.motion()?.motion().slip(), 1.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UncertainReading<T> {
    /// Approach speed, m/s.
    pub approach: Estimate<T>,
    /// Tangential velocity, m/s.
    pub tangential: Estimate<T>,
    /// Peripheral velocity, spin times radius, m/s.
    pub peripheral: Estimate<T>,
    /// Radius of the particle, m.
    pub radius: Estimate<T>,
}

impl<T: Real> Reading for UncertainReading<T> {
    type Motion = UncertainMotion<T>;

    fn motion(&self) -> Result<UncertainMotion<T>, InputError> {
        let [approach, tangential, peripheral] =
            [self.approach, self.tangential, self.peripheral].map(|velocity| velocity.value);
        let motion = PlanarReading { approach, tangential, peripheral }.motion()?;
        let input = |estimate: &Estimate<T>, parameter| {
            Uncertain::new(estimate.value, estimate.standard_error)?.within(parameter)
        };
        let inputs = [
            input(&self.approach, Parameter::ApproachSpeed)?,
            input(&self.tangential, Parameter::TangentialVelocity)?,
            input(&self.peripheral, Parameter::PeripheralVelocity)?,
            input(&self.radius, Parameter::Radius)?,
        ];
        Ok(UncertainMotion { motion, inputs })
    }
}

/// A valid [`UncertainReading`].
///
/// ```
/// use microimpact::Approach;
/// use microimpact::instrument::{Reading, UncertainReading};
/// use microimpact::measure::Estimate;
///
/// let exact = |value| Estimate { value, standard_error: 0.0 };
/// let reading = UncertainReading {
///     approach: exact(2.8),
///     tangential: exact(1.0),
///     peripheral: exact(0.0),
///     radius: exact(5e-6),
/// };
/// assert_eq!(reading.motion()?.normal().speed(), 2.8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct UncertainMotion<T> {
    motion: PlanarMotion<T>,
    /// Approach speed, tangential and peripheral velocity, and radius.
    inputs: [Uncertain<T>; 4],
}

impl<T: Real> UncertainMotion<T> {
    /// The motion without its errors.
    ///
    /// ```
    /// # use microimpact::{Oblique, instrument::{Reading, UncertainReading}, measure::Estimate};
    /// # let exact = |value| Estimate { value, standard_error: 0.0 };
    /// # let [approach, tangential, peripheral, radius] = [2.8, 1.0, 0.25, 5e-6].map(exact);
    /// let motion = UncertainReading { approach, tangential, peripheral, radius }.motion()?;
    /// assert_eq!(motion.motion().slip(), 0.75);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn motion(&self) -> &PlanarMotion<T> {
        &self.motion
    }
}

impl<T: Real> Approach<T> for UncertainMotion<T> {
    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        self.motion.normal()
    }
}

/// A classifier that states a class if its probability reaches a confidence. Otherwise the class is [`Class::Undecided`].
///
/// `scene` makes an impact from a radius (m) and a motion: see [`Classifiable`]. It is called about nine times for a reading, which
/// takes 12 000 instructions and 2.6 KiB of stack with a rigid body in single precision on a Cortex-M4F. A simulation searches for
/// the critical speed in each call, and takes 7.5 million; the critical speed of a [boundary table](crate::table::BoundaryTable)
/// with the normal motion takes its place where the outcome is enough. A sphere that may rest counts as rolling. The restitution
/// is not computed.
///
/// ```
/// use microimpact::instrument::{Confident, Instrument, NoLines, SpeedBins, UncertainReading};
/// use microimpact::measure::Estimate;
/// use microimpact::{Class, RigidBody, SpeedRestitution, Sphere};
///
/// // The work of adhesion is proportional to the radius.
/// let classifier = Confident::new(0.95, |radius, motion| {
///     let scene = RigidBody::new(Sphere::solid(radius, 2600.0)?, SpeedRestitution::new(130.0)?)
///         .with_work_of_adhesion(4.4e-7 * radius)?
///         .with_friction(0.1)?;
///     Ok((scene, motion))
/// })?;
/// let mut instrument: Instrument<_, _, f64, 6, 1> = Instrument::new(classifier, NoLines, SpeedBins::new([10.0])?);
/// let mut class = |approach, standard_error| {
///     let reading = UncertainReading {
///         approach: Estimate { value: approach, standard_error },
///         tangential: Estimate { value: 0.0, standard_error: 0.02 },
///         peripheral: Estimate { value: 0.2, standard_error: 0.05 },
///         radius: Estimate { value: 5.06e-6, standard_error: 0.05e-6 },
///     };
///     instrument.process(&reading).map(|verdict| verdict.class)
/// };
/// assert_eq!(class(2.8, 0.05), Ok(Class::ReboundRolling));
/// assert_eq!(class(1.4, 0.05), Ok(Class::CapturedRolling));
/// // The critical speed is 1.8 m/s.
/// assert_eq!(class(1.85, 0.05), Ok(Class::Undecided));
/// assert_eq!(instrument.tally().count(Class::Undecided), 1);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confident<T, F> {
    confidence: T,
    scene: F,
}

impl<T: Real, F> Confident<T, F> {
    /// Creates a classifier from the smallest probability of a class that it states (0.5 to 1), and the scene.
    ///
    /// # Errors
    /// The confidence is outside its range.
    ///
    /// ```
    /// use microimpact::instrument::Confident;
    /// use microimpact::{Approach, CriticalSpeed, Parameter};
    ///
    /// let refused = Confident::new(0.4, |_, motion| Ok((motion.normal(), CriticalSpeed::At(2.0))));
    /// assert!(refused.is_err_and(|error| error.parameter == Parameter::Confidence));
    /// ```
    pub fn new<C>(confidence: T, scene: F) -> Result<Self, InputError>
    where
        F: Fn(T, PlanarMotion<T>) -> Result<C, InputError>,
        C: Classifiable<T>,
    {
        Ok(Self { confidence: Parameter::Confidence.check(confidence)?, scene })
    }

    /// Probabilities of the classes of a reading.
    ///
    /// # Errors
    /// The scene refuses a value within a few standard errors of the reading.
    ///
    /// ```
    /// use microimpact::instrument::{Confident, Reading, UncertainReading};
    /// use microimpact::measure::Estimate;
    /// use microimpact::{CriticalSpeed, NormalMotion, Approach};
    ///
    /// let [approach, tangential, peripheral, radius] =
    ///     [(2.0, 0.1), (0.0, 0.0), (0.0, 0.0), (5e-6, 0.0)].map(|(value, standard_error)| Estimate { value, standard_error });
    /// let motion = UncertainReading { approach, tangential, peripheral, radius }.motion()?;
    /// // A critical speed of 2 m/s.
    /// let classifier = Confident::new(0.9, |_, motion| Ok((Approach::normal(&motion), CriticalSpeed::At(2.0))))?;
    /// assert!((classifier.probabilities(&motion)?.rebound() - 0.5_f64).abs() < 1e-3);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn probabilities<C>(&self, motion: &UncertainMotion<T>) -> Result<ClassProbabilities<T>, InputError>
    where
        F: Fn(T, PlanarMotion<T>) -> Result<C, InputError>,
        C: Classifiable<T>,
    {
        ClassProbabilities::new(&motion.inputs, |[approach, tangential, peripheral, radius]| {
            (self.scene)(radius, PlanarReading { approach, tangential, peripheral }.motion()?)
        })
    }
}

impl<T, F, C> Classifier<T, UncertainMotion<T>> for Confident<T, F>
where
    T: Real,
    F: Fn(T, PlanarMotion<T>) -> Result<C, InputError>,
    C: Classifiable<T>,
{
    type Class = Class;

    fn verdict(&self, motion: &UncertainMotion<T>) -> Result<Verdict<T, Class>, Rejection> {
        let expected = self.probabilities(motion)?.by_class();
        let mut classes = Class::ALL.iter().zip(expected);
        let class = classes.find(|(_, probability)| *probability >= self.confidence);
        Ok(Verdict { class: class.map_or(Class::Undecided, |(class, _)| *class), restitution: None })
    }
}

#[cfg(feature = "defmt")]
impl<T: defmt::Format, F> defmt::Format for Confident<T, F> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "Confident {{ confidence: {} }}", self.confidence);
    }
}
