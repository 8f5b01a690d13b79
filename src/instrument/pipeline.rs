//! The instrument: it classifies readings, counts the classes and drives the class lines.

use super::{ClassSet, Classifier, Reading, Rejection, Signal, SpeedBins, Tally, Verdict};
use crate::{Approach, Real};

/// An instrument: a classifier `C`, class lines `S` and a tally.
///
/// ```
/// use microimpact::instrument::{Instrument, NoLines, PlanarReading, Queue, SpeedBins};
/// use microimpact::{Class, RigidBody, Sphere, SpeedRestitution};
///
/// let scene = RigidBody::new(Sphere::solid(5.06e-6_f32, 2600.0)?, SpeedRestitution::new(130.0)?)
///     .with_work_of_adhesion(2.22e-12)?
///     .with_friction(0.1)?;
/// let mut instrument: Instrument<_, _, _, 6, 3> = Instrument::new(scene, NoLines, SpeedBins::new([1.0, 3.0, 10.0])?);
///
/// let mut queue = Queue::<PlanarReading<f32>, 16>::new();
/// let (mut interrupt, mut main_loop) = queue.split();
/// assert!(interrupt.send(PlanarReading { approach: 2.8, tangential: 0.0, peripheral: 0.739 }).is_ok());
/// assert!(interrupt.send(PlanarReading { approach: -2.8, tangential: 0.0, peripheral: 0.0 }).is_ok());
///
/// while let Some(reading) = main_loop.receive() {
///     let _ = instrument.process(&reading);
/// }
/// let tally = instrument.tally();
/// assert_eq!((tally.count(Class::ReboundRolling), tally.rejections().input, main_loop.lost()), (1, 1, 0));
/// assert!((tally.restitution()[1].mean() - 0.746).abs() < 0.001);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Instrument<C, S, T, const CLASSES: usize, const BINS: usize> {
    classifier: C,
    signal: S,
    tally: Tally<T, CLASSES, BINS>,
}

impl<C, S, T: Real, const CLASSES: usize, const BINS: usize> Instrument<C, S, T, CLASSES, BINS> {
    /// Creates an instrument with an empty tally.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(instrument.tally().classified(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn new(classifier: C, signal: S, bins: SpeedBins<T, BINS>) -> Self {
        Self { classifier, signal, tally: Tally::new(bins) }
    }

    /// Goes on with a tally that was kept, as after a restart.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let mut instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// let _ = instrument.process(&NormalReading { approach: 1.0 });
    /// let (scene, lines, tally) = instrument.release();
    /// assert_eq!(Instrument::resume(scene, lines, tally).tally().classified(), 1);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn resume(classifier: C, signal: S, tally: Tally<T, CLASSES, BINS>) -> Self {
        Self { classifier, signal, tally }
    }

    /// Replaces the classifier, as by that of a changed configuration, and returns the earlier one. The counts go on.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = |r| Ok::<_, microimpact::InputError>(
    ///     RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(r)?));
    /// let mut instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene(0.9)?, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(instrument.reconfigure(scene(0.5)?), scene(0.9)?);
    /// assert_eq!(instrument.process(&NormalReading { approach: 1.0 }).unwrap().restitution, Some(0.5));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn reconfigure(&mut self, classifier: C) -> C {
        core::mem::replace(&mut self.classifier, classifier)
    }

    /// Empties the tally and returns what it held; its bins stay.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let mut instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// let _ = instrument.process(&NormalReading { approach: 1.0 });
    /// assert_eq!(instrument.reset().classified(), 1);
    /// assert_eq!(instrument.tally().classified(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn reset(&mut self) -> Tally<T, CLASSES, BINS> {
        let empty = Tally::new(*self.tally.bins());
        core::mem::replace(&mut self.tally, empty)
    }

    /// The classifier, the class lines and the tally.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(instrument.release().0, scene);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn release(self) -> (C, S, Tally<T, CLASSES, BINS>) {
        (self.classifier, self.signal, self.tally)
    }

    /// Classifies a reading, counts its class and switches the class lines. A failure of the lines is counted; the class is
    /// returned all the same.
    ///
    /// # Errors
    /// The reading has no class. It is counted, and all lines go low.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins, Verdict};
    /// use microimpact::{ConstantRestitution, Outcome, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let mut instrument: Instrument<_, _, _, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// let verdict = instrument.process(&NormalReading { approach: 1.0 });
    /// assert_eq!(verdict, Ok(Verdict { class: Outcome::Rebound, restitution: Some(0.9) }));
    /// assert!(instrument.process(&NormalReading { approach: 0.0 }).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn process<R>(&mut self, reading: &R) -> Result<Verdict<T, C::Class>, Rejection>
    where
        R: Reading<Motion: Approach<T>>,
        C: Classifier<T, R::Motion>,
        S: Signal<C::Class>,
    {
        const { assert!(CLASSES == C::Class::COUNT, "the instrument must have as many classes as its classifier") };
        let verdict = self.verdict(reading);
        match &verdict {
            Ok((speed, verdict)) => self.tally.record(*speed, verdict),
            Err(rejection) => self.tally.reject(rejection),
        }
        let verdict = verdict.map(|(_, verdict)| verdict);
        if self.signal.show(verdict.ok().map(|verdict| verdict.class)).is_err() {
            self.tally.fail_signal();
        }
        verdict
    }

    /// Approach speed and verdict of a reading.
    #[inline]
    fn verdict<R>(&self, reading: &R) -> Result<(T, Verdict<T, C::Class>), Rejection>
    where
        R: Reading<Motion: Approach<T>>,
        C: Classifier<T, R::Motion>,
    {
        let motion = reading.motion()?;
        Ok((motion.normal().speed(), self.classifier.verdict(&motion)?))
    }

    /// Statistics of all readings so far.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(instrument.tally().rejections().total(), 0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn tally(&self) -> &Tally<T, CLASSES, BINS> {
        &self.tally
    }

    /// The classifier.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, SpeedBins};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(instrument.classifier(), &scene);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn classifier(&self) -> &C {
        &self.classifier
    }
}
