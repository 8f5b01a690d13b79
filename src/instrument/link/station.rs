//! An instrument that answers requests.

use heapless::Vec;

use super::{Arrivals, Described, MOST_CLASSES, PROTOCOL, Refusal, Reply, Report, Request, Schema};
use crate::instrument::{ClassSet, Classifier, Instrument, Reading, Rejections, Signal};
use crate::{Approach, Real, SceneConfig};

/// An instrument behind a link: it answers the requests of a host.
///
/// ```
/// use microimpact::instrument::link::{Received, Reply, Request, Station, fixed_scene};
/// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins};
/// use microimpact::{ConstantRestitution, Outcome, RigidBody, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
/// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
/// let mut station = Station::new(instrument);
/// let request = Request::Event { number: 7, reading: NormalReading { approach: 1.0 } };
/// let reply = station.answer(&request, &Received::default(), fixed_scene);
/// assert!(matches!(reply, Reply::Classified { number: 7, verdict } if verdict.class == Outcome::Rebound));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Station<C, S, T, const CLASSES: usize, const BINS: usize> {
    instrument: Instrument<C, S, T, CLASSES, BINS>,
    /// Counts of tallies that were emptied, and of answers to other requests than events.
    earlier: Report,
}

/// What the way from the host has counted, for a [`Report`].
///
/// ```
/// assert_eq!(microimpact::instrument::link::Received::default().lost, 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Received {
    /// Counts of the [`Inlet`](super::Inlet).
    pub arrivals: Arrivals,
    /// Requests that found the queue full.
    pub lost: u32,
    /// Clock ticks while the instrument was awake; zero if it does not count them.
    pub ticks: u64,
}

impl<C, S, T, const CLASSES: usize, const BINS: usize> Station<C, S, T, CLASSES, BINS> {
    /// The station of an instrument.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, SpeedBins, link::Station};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(Station::new(instrument).instrument(), &instrument);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub const fn new(instrument: Instrument<C, S, T, CLASSES, BINS>) -> Self {
        Self { instrument, earlier: Report::NONE }
    }

    /// The instrument.
    ///
    /// ```
    /// use microimpact::instrument::{Instrument, NoLines, SpeedBins, link::Station};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// assert_eq!(Station::new(instrument).instrument().classifier(), &scene);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub const fn instrument(&self) -> &Instrument<C, S, T, CLASSES, BINS> {
        &self.instrument
    }
}

impl<C, S, T: Real, const CLASSES: usize, const BINS: usize> Station<C, S, T, CLASSES, BINS> {
    /// What the station says when it starts.
    ///
    /// ```
    /// use microimpact::instrument::link::{Reply, Schema, Station};
    /// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins};
    /// use microimpact::{ConstantRestitution, Outcome, RigidBody, Sphere};
    ///
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?);
    /// let instrument: Instrument<_, _, f64, 3, 1> = Instrument::new(scene, NoLines, SpeedBins::new([10.0])?);
    /// let started = Station::new(instrument).started::<NormalReading<f64>>();
    /// let expected = Schema::of::<f64, NormalReading<f64>, Outcome>();
    /// assert!(matches!(started, Reply::Started { schema, .. } if schema == expected));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn started<R>(&self) -> Reply<T, C::Class>
    where
        T: Described,
        R: Reading + Described,
        C: Classifier<T, R::Motion, Class: Described>,
    {
        Reply::Started { protocol: PROTOCOL, schema: Schema::of::<T, R, C::Class>() }
    }

    /// Answers a request. `received` is what the way from the host has counted so far, and `configure` makes a classifier of a scene
    /// that the host sends, or returns a [`Refusal`], to which `?` converts an [`InputError`](crate::InputError): [`fixed_scene`] refuses
    /// every scene.
    ///
    /// ```
    /// use microimpact::instrument::link::{Received, Refusal, Reply, Request, Station};
    /// use microimpact::instrument::{Instrument, NoLines, ObliqueReading, Simulated, SpeedBins};
    /// use microimpact::contact::FixedCost;
    /// use microimpact::{ModelConfig, ReboundAdhesionConfig, RestitutionConfig, SceneConfig};
    ///
    /// let scene = |restitution| {
    ///     let restitution = RestitutionConfig::Constant { restitution };
    ///     let model = ModelConfig::RigidBody { restitution, adhesion: ReboundAdhesionConfig::None };
    ///     SceneConfig::solid(1e-6_f32, 1000.0, model)
    /// };
    /// let method = FixedCost::<5>::new(3)?.with_outputs::<7>();
    /// let configure = |scene: &SceneConfig<f32>| Ok::<_, Refusal>(Simulated { scene: scene.scene()?, method });
    /// let classifier = Simulated { scene: scene(0.9).scene()?, method };
    /// let instrument: Instrument<_, _, f32, 6, 1> = Instrument::new(classifier, NoLines, SpeedBins::new([10.0])?);
    /// let mut station = Station::new(instrument);
    ///
    /// let reading = ObliqueReading { approach: 1.0, tangential: 0.0 };
    /// let mut ask = |request: Request<_>| station.answer(&request, &Received::default(), configure);
    /// assert_eq!(ask(Request::Configure { number: 1, scene: scene(0.5) }), Reply::Configured { number: 1 });
    /// assert!(matches!(ask(Request::Configure { number: 2, scene: scene(5.0) }), Reply::Refused { number: 2, .. }));
    /// let reply = ask(Request::Event { number: 1, reading });
    /// assert!(matches!(reply, Reply::Classified { verdict, .. } if verdict.restitution == Some(0.5)));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn answer<R>(
        &mut self,
        request: &Request<R, T>,
        received: &Received,
        configure: impl FnOnce(&SceneConfig<T>) -> Result<C, Refusal>,
    ) -> Reply<T, C::Class>
    where
        T: Described,
        R: Reading<Motion: Approach<T>> + Described,
        C: Classifier<T, R::Motion, Class: Described>,
        S: Signal<C::Class>,
    {
        match request {
            Request::Event { .. } => {}
            Request::Report { .. } => self.earlier.reports = self.earlier.reports.saturating_add(1),
            _ => self.earlier.commands = self.earlier.commands.saturating_add(1),
        }
        match *request {
            Request::Event { number, ref reading } => match self.instrument.process(reading) {
                Ok(verdict) => Reply::Classified { number, verdict },
                Err(rejection) => Reply::Rejected { number, rejection },
            },
            Request::Report { number } => Reply::Report { number, report: self.report(received) },
            Request::Describe { number } => {
                Reply::Description { number, protocol: PROTOCOL, schema: Schema::of::<T, R, C::Class>() }
            }
            Request::Counts { number } => Reply::Counts { number, counts: self.counts::<C::Class>() },
            Request::Reset { number } => {
                let counts = self.counts::<C::Class>();
                self.earlier = self.report(&Received::default());
                self.instrument.reset();
                Reply::Reset { number, counts }
            }
            Request::Configure { number, ref scene } => match configure(scene) {
                Ok(classifier) => {
                    self.instrument.reconfigure(classifier);
                    Reply::Configured { number }
                }
                Err(refusal) => Reply::Refused { number, refusal },
            },
        }
    }

    /// The number of readings in each class since the tally was emptied.
    fn counts<K: ClassSet>(&self) -> Vec<u64, MOST_CLASSES> {
        const { assert!(K::COUNT <= MOST_CLASSES, "more classes than a reply has room for") };
        let mut counts = Vec::new();
        for &class in K::ALL {
            // There is room for all of them.
            let _ = counts.push(self.instrument.tally().count(class));
        }
        counts
    }

    /// The counts since the instrument started.
    fn report(&self, received: &Received) -> Report {
        let (tally, earlier) = (self.instrument.tally(), &self.earlier);
        let (Rejections { input, unsolved }, Received { arrivals, lost, ticks }) = (tally.rejections(), *received);
        Report {
            arrivals,
            lost,
            classified: earlier.classified.saturating_add(tally.classified()),
            rejections: Rejections {
                input: earlier.rejections.input.saturating_add(input),
                unsolved: earlier.rejections.unsolved.saturating_add(unsolved),
            },
            reports: earlier.reports,
            commands: earlier.commands,
            signal_failures: earlier.signal_failures.saturating_add(tally.signal_failures()),
            ticks,
        }
    }
}

/// For [`Station::answer`]: refuses every scene, as an instrument does whose scene does not change.
///
/// # Errors
/// Always.
///
/// ```
/// use microimpact::instrument::link::{Refusal, fixed_scene};
/// use microimpact::{ModelConfig, ReboundAdhesionConfig, RestitutionConfig, SceneConfig};
///
/// let restitution = RestitutionConfig::Constant { restitution: 0.9 };
/// let model = ModelConfig::RigidBody { restitution, adhesion: ReboundAdhesionConfig::None };
/// assert_eq!(fixed_scene::<f64, ()>(&SceneConfig::solid(1e-6, 1000.0, model)), Err(Refusal::Fixed));
/// ```
pub const fn fixed_scene<T, C>(_scene: &SceneConfig<T>) -> Result<C, Refusal> {
    Err(Refusal::Fixed)
}
