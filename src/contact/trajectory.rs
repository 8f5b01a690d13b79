//! An impact in time: indentation, velocity and force against time, in a bounded number of samples.
//!
//! The samples are nodes of the intervals, which come in the order of time. When the room is spent, the gap that has to lie
//! between a sample and the one before it is doubled, and what comes sooner is dropped: the largest gap stays below twice
//! that gap, plus the largest one between nodes. First contact, peak, beginning of rolling and end are always kept.

use heapless::{Vec, VecView};

use super::law::ContactLaw;
use super::outputs::{Ended, Output};
use super::solve::interval::{Interval, dot, integrals};
use super::solve::nodes::Nodes;
use super::solve::observer::Observer;
use super::solve::quantities::Times;
use crate::Real;

/// A moment of an impact, in SI units or dimensionless.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Recording};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
/// let motion = NormalMotion::new(1.0)?;
/// let (_, trajectory) = scene.solve_for(&motion, &Collocation::<9, f64>::new(1e-9)?, Recording::<32>)?;
/// // Damping opposes the motion: it adds to the elastic force on the way in and takes from it on the way out.
/// for sample in trajectory.samples() {
///     assert!((sample.force - sample.elastic) * sample.velocity >= 0.0);
/// }
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sample<T> {
    /// Time from first contact, s.
    pub time: T,
    /// Indentation delta, m.
    pub indentation: T,
    /// Its rate delta', m/s: positive on the way in, negative on the way out.
    pub velocity: T,
    /// Normal force of the surface on the sphere with adhesion and damping, N, positive where it repels. A constant external
    /// force is not part of it.
    pub force: T,
    /// Elastic part sqrt(r) K delta^(3/2) of the force, N.
    pub elastic: T,
}

impl<T: Real> Sample<T> {
    /// The moment at which the sphere passes the contact radius `s` with speed `y`.
    fn of(law: &impl ContactLaw<T>, time: T, s: T, y: T, rebound: bool) -> Self {
        let elastic = law.elastic_force(s);
        let net = elastic - law.adhesion_force(s);
        let damped = y * law.damping(s, rebound);
        let (velocity, force) = if rebound { (-y, net - damped) } else { (y, net + damped) };
        Self { time, indentation: law.indentation(s), velocity, force, elastic }
    }

    fn in_units(&self, unit: &Self) -> Self {
        Self {
            time: self.time * unit.time,
            indentation: self.indentation * unit.indentation,
            velocity: self.velocity * unit.velocity,
            force: self.force * unit.force,
            elastic: self.elastic * unit.elastic,
        }
    }
}

/// The motion and forces of an impact in time, in at most `N` samples, four or more, however many steps the motion takes.
///
/// First contact, peak, the moment at which the sphere begins to roll, and the end are among them; of so many nodes that they
/// have to be thinned, the others are spread evenly over time.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Recording, Times};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let motion = NormalMotion::new(2.8)?;
/// let (impact, (times, trajectory)) =
///     scene.solve_for(&motion, &Collocation::<9, f64>::new(1e-9)?, (Times, Recording::<64>))?;
/// let (first, last) = (trajectory.samples().next().unwrap(), trajectory.samples().last().unwrap());
/// assert_eq!((first.time, first.indentation, first.force), (0.0, 0.0, 0.0));
/// assert!((first.velocity / 2.8 - 1.0).abs() < 1e-12);
/// assert_eq!((Some(last.time), last.indentation), (times.contact, 0.0));
/// assert!((last.velocity / impact.normal.rebound_speed() + 1.0).abs() < 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Trajectory<T, const N: usize> {
    samples: Vec<Sample<T>, N>,
    unit: Sample<T>,
    peak: Option<usize>,
    roll: Option<usize>,
}

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// The samples in the order of time, in SI units.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Recording};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let (_, trajectory) =
    ///     scene.solve_for(&NormalMotion::new(1.0)?, &Collocation::<9, f64>::new(1e-9)?, Recording::<16>)?;
    /// let times: Vec<f64> = trajectory.samples().map(|sample| sample.time).collect();
    /// assert!(times.len() <= 16 && times.is_sorted());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn samples(&self) -> impl ExactSizeIterator<Item = Sample<T>> + DoubleEndedIterator + '_ {
        self.samples.iter().map(|sample| sample.in_units(&self.unit))
    }

    /// The samples in SI units, as a vector with room for `N`.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, Recording};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let (_, trajectory) =
    ///     scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9_f64)?, Recording::<16>)?;
    /// let samples: heapless::Vec<_, 16> = trajectory.into_samples();
    /// assert_eq!(samples[0].time, 0.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn into_samples(mut self) -> Vec<Sample<T>, N> {
        for sample in &mut self.samples {
            *sample = sample.in_units(&self.unit);
        }
        self.samples
    }

    /// The same in the [`units`](Self::units) of the motion.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Recording};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let (_, trajectory) =
    ///     scene.solve_for(&NormalMotion::new(1.0)?, &Collocation::<9, f64>::new(1e-9)?, Recording::<16>)?;
    /// for sample in trajectory.dimensionless() {
    ///     assert!((sample.elastic - 1.25 * sample.indentation.powf(1.5)).abs() < 1e-12);
    /// }
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn dimensionless(&self) -> &[Sample<T>] {
        self.samples.as_slice()
    }

    /// Units of the dimensionless samples, in SI.
    ///
    /// In Hertz's contact the unit of length is the peak indentation L of the motion without damping, that of velocity
    /// U = sqrt((4/5) sqrt(r) K L^(5/2)/m), that of time L/U, that of force m U^2/L. The elastic force is (5/4) delta^(3/2)
    /// in them.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Recording};
    /// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let motion = NormalMotion::new(1.0)?;
    /// let method = Collocation::<9, f64>::new(1e-9)?;
    /// let (_, trajectory) = Contact::hertz(sphere, stiffness).solve_for(&motion, &method, Recording::<16>)?;
    /// let hertz = Hertz::new(&sphere, stiffness, &motion);
    /// assert!((trajectory.units().indentation / hertz.indentation - 1.0).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn units(&self) -> Sample<T> {
        self.unit
    }

    /// The peak, where the velocity is zero for the first time; `None` where an over-damped sphere creeps in without one.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Recording};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let (impact, trajectory) =
    ///     scene.solve_for(&NormalMotion::new(1.0)?, &Collocation::<9, f64>::new(1e-9)?, Recording::<4>)?;
    /// let peak = trajectory.peak().unwrap();
    /// assert_eq!((peak.velocity, Some(peak.indentation)), (0.0, impact.normal.peak_indentation()));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn peak(&self) -> Option<Sample<T>> {
        self.marked(self.peak)
    }

    /// The moment at which a sliding sphere begins to roll; `None` where it does not, or rolls from first contact. With tangential
    /// compliance no sphere rolls.
    ///
    /// ```
    /// use microimpact::contact::{Collocation, Contact, Recording, Slip};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
    /// let motion = NormalMotion::new(1.0)?.with_tangential(0.7)?;
    /// let (_, (slip, trajectory)) = scene.solve_for(&motion, &Collocation::<9, f64>::new(1e-9)?, (Slip, Recording::<4>))?;
    /// assert_eq!(trajectory.roll().map(|roll| roll.time), slip.rolls_from);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn roll(&self) -> Option<Sample<T>> {
        self.marked(self.roll)
    }

    fn marked(&self, index: Option<usize>) -> Option<Sample<T>> {
        self.samples.get(index?).map(|sample| sample.in_units(&self.unit))
    }
}

/// Asks for a [`Trajectory`] of at most `N` samples.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, Recording};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let (_, trajectory) = scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9_f64)?, Recording::<16>)?;
/// assert!(trajectory.samples().count() <= 16);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Recording<const N: usize>;

impl<T: Real, S, const N: usize> Output<T, S> for Recording<N> {
    type Observer = Recorder<T, N>;
    type Result = Trajectory<T, N>;

    fn begin(&self, _start: &S) -> Recorder<T, N> {
        const { assert!(N >= 4, "first contact, peak, beginning of rolling and end make four samples") };
        let mut recorder = Recorder { samples: Vec::new(), thinning: Thinning::new(T::constant(2.0 / N as f64)) };
        let zero = T::ZERO;
        // What it is follows in the end, from the law and the units.
        let first = Sample { time: zero, indentation: zero, velocity: zero, force: zero, elastic: zero };
        recorder.thinning.add(&mut recorder.samples, first);
        recorder
    }

    fn finish<L: ContactLaw<T>>(&self, recorder: Recorder<T, N>, end: &Ended<'_, T, L>) -> Trajectory<T, N> {
        let Recorder { mut samples, thinning } = recorder;
        let units = end.units;
        thinning.end(&mut samples);
        if let Some(first) = samples.first_mut() {
            *first = Sample::of(end.law, T::ZERO, end.law.start(), (units.energy + units.energy).sqrt(), false);
        }
        let force = end.sphere.mass() * (units.speed / units.time());
        let unit =
            Sample { time: units.time(), indentation: units.length, velocity: units.speed, force, elastic: force };
        Trajectory { samples, unit, peak: thinning.peak, roll: thinning.roll }
    }
}

/// Samples of a motion in progress.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorder<T, const N: usize> {
    samples: Vec<Sample<T>, N>,
    thinning: Thinning<T>,
}

impl<T: Real, const N: usize> Observer<T> for Recorder<T, N> {
    const TIMED: bool = true;

    fn observe<const M: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, M>, rebound: bool)
    where
        T: Nodes<M>,
    {
        let (samples, thinning) = (self.samples.as_mut_view(), &mut self.thinning);
        let (begin, duration) = (thinning.now, dot(&T::WEIGHTS, &interval.rate));
        let running = integrals(&T::INTEGRATION, &interval.rate);
        let nodes = running.iter().zip(interval.s.iter().zip(&interval.y));
        // The last node is the end of the interval, or its beginning where it is written against time.
        if interval.forward {
            for (&running, (&s, &y)) in nodes.take(M - 1) {
                thinning.add(samples, Sample::of(law, begin + running, s, y, rebound));
            }
        } else {
            for (&running, (&s, &y)) in nodes.take(M - 1).rev() {
                thinning.add(samples, Sample::of(law, begin + (duration - running), s, y, rebound));
            }
        }
        thinning.now = begin + duration;
        let (s, y) = (interval.end.s, interval.end.speed_squared.max(T::ZERO).sqrt());
        thinning.add(samples, Sample::of(law, thinning.now, s, y, rebound));
        // An interval that is written against time leads to a turning point, or is a part of one that does.
        if interval.end.speed_squared <= T::ZERO && !rebound && thinning.peak.is_none() {
            thinning.peak = thinning.mark(samples, T::ZERO);
        }
    }

    fn observe_rolling<const M: usize>(
        &mut self,
        law: &impl ContactLaw<T>,
        whole: &Interval<T, M>,
        before: &Interval<T, M>,
        late: T,
        after: &mut dyn FnMut() -> Interval<T, M>,
        rebound: bool,
    ) where
        T: Nodes<M>,
    {
        let end = self.thinning.now + dot(&T::WEIGHTS, &whole.rate);
        self.observe(law, before, rebound);
        self.thinning.roll = self.thinning.mark(&mut self.samples, -late);
        self.observe(law, &after(), rebound);
        self.thinning.end_at(&mut self.samples, end);
    }

    type State = ();

    #[inline]
    fn state(&self) {}

    #[inline]
    fn rates(&self, (): &(), _law: &impl ContactLaw<T>, _s: T, _y: T, _rebound: bool) {}

    fn rolls_from(&mut self, _time: T) {
        self.thinning.roll = self.thinning.mark(&mut self.samples, T::ZERO);
    }

    fn stepped(&mut self, law: &impl ContactLaw<T>, time: T, s: T, y: T, rebound: bool) {
        self.thinning.now = time;
        self.thinning.add(&mut self.samples, Sample::of(law, time, s, y, rebound));
        if y == T::ZERO && self.thinning.peak.is_none() {
            self.thinning.peak = self.thinning.mark(&mut self.samples, T::ZERO);
        }
    }

    #[inline]
    fn ended(&mut self, (): &(), _times: &Times<T>) {}
}

/// What decides which samples are kept; all of it is compiled once, whatever the room for samples.
#[derive(Clone, Debug, PartialEq)]
struct Thinning<T> {
    /// Time at the end of what has been recorded.
    now: T,
    /// Twice the reciprocal of the room for samples.
    fraction: T,
    /// Least time between a sample and the one before it, unless it is marked.
    gap: T,
    /// The latest sample where it is not kept: the last one, if none follows.
    waiting: Option<Sample<T>>,
    peak: Option<usize>,
    roll: Option<usize>,
}

impl<T: Real> Thinning<T> {
    fn new(fraction: T) -> Self {
        Self { now: T::ZERO, fraction, gap: T::ZERO, waiting: None, peak: None, roll: None }
    }

    /// Whether no place is free but the one for the last sample.
    fn is_full(samples: &VecView<Sample<T>>) -> bool {
        samples.len() + 1 >= samples.capacity()
    }

    /// Keeps a sample if it comes late enough after the one before.
    #[inline(never)]
    fn add(&mut self, samples: &mut VecView<Sample<T>>, sample: Sample<T>) {
        if self.is_due(samples, &sample) && Self::is_full(samples) {
            self.thin(samples, sample.time);
        }
        if self.is_due(samples, &sample) && !Self::is_full(samples) {
            self.waiting = samples.push(sample).err();
        } else {
            self.waiting = Some(sample);
        }
    }

    /// Moves the latest sample to a time that is known better than by its own interval.
    fn end_at(&mut self, samples: &mut VecView<Sample<T>>, time: T) {
        self.now = time;
        if let Some(latest) = self.waiting.as_mut().or_else(|| samples.last_mut()) {
            latest.time = time;
        }
    }

    fn is_due(&self, samples: &VecView<Sample<T>>, sample: &Sample<T>) -> bool {
        samples.last().is_none_or(|last| sample.time - last.time >= self.gap)
    }

    /// Makes the gap at least twice as large and drops what comes sooner.
    fn thin(&mut self, samples: &mut VecView<Sample<T>>, now: T) {
        self.gap = (self.gap + self.gap).max(self.fraction * now);
        let (mut kept, mut before) = (0, None);
        for index in 0..samples.len() {
            let Some(&sample) = samples.get(index) else {
                break;
            };
            let marked = self.peak == Some(index) || self.roll == Some(index);
            if !marked && before.is_some_and(|before| sample.time - before < self.gap) {
                continue;
            }
            for mark in [&mut self.peak, &mut self.roll] {
                if *mark == Some(index) {
                    *mark = Some(kept);
                }
            }
            if let Some(place) = samples.get_mut(kept) {
                *place = sample;
            }
            before = Some(sample.time);
            kept += 1;
        }
        samples.truncate(kept);
    }

    /// Keeps the latest sample for good, moved in time by `before`; its place.
    #[inline(never)]
    fn mark(&mut self, samples: &mut VecView<Sample<T>>, before: T) -> Option<usize> {
        if let Some(sample) = self.waiting.take() {
            for _ in 0..usize::BITS {
                if !Self::is_full(samples) {
                    break;
                }
                self.thin(samples, sample.time);
            }
            self.waiting = samples.push(sample).err();
        }
        let latest = samples.last_mut()?;
        latest.time = latest.time + before;
        latest.indentation = latest.indentation + before * latest.velocity;
        Some(samples.len() - 1)
    }

    /// Adds the last sample, for which a place is free.
    fn end(&self, samples: &mut VecView<Sample<T>>) {
        if let Some(sample) = self.waiting {
            // It has one: `is_full` counts it in.
            let _ = samples.push(sample);
        }
    }
}
