//! Calls of the way from an interrupt to a class, and of the link to a host.

use core::convert::Infallible;
use core::hint::black_box;

use embedded_hal::digital::{ErrorType, OutputPin};
use microimpact::contact::{Collocation, Contact, FixedCost};
use microimpact::instrument::link::{
    Encoder, FrameFault, Inlet, Outlet, Received, Refusal, Reply, Report, Request, Station, fixed_scene,
};
use microimpact::instrument::{
    ClassLines, ClassSet, Classified, Classifier, Instrument, NoLines, NormalReading, ObliqueReading, PlanarReading,
    Queue, Reading, Rejection, Signal, Simulated, SpeedBins, Statistics, Tabulated, Tally, Verdict,
};
use microimpact::table::{BoundaryTable, RestitutionTable, Single, TableRebound};
use microimpact::{
    Approach, Class, Coulomb, CriticalSpeed, InputError, NoFriction, Outcome, Real, RigidBody, SceneConfig,
    SpeedRestitution, Sphere, Stiffness,
};

use super::contact::AnyNodes;
use super::{any, keep};

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes + Single>() -> Result<(), InputError> {
    let normal = NormalReading::<T> { approach: any() };
    let oblique = ObliqueReading::<T> { approach: any(), tangential: any() };
    let planar = PlanarReading::<T> { approach: any(), tangential: any(), peripheral: any() };
    let sphere = Sphere::solid(any(), any())?;
    let body = RigidBody::new(sphere, SpeedRestitution::new(any::<T>())?).with_work_of_adhesion(any())?;
    let friction = body.with_friction(any())?;
    let simulation = Contact::hertz(sphere, Stiffness::new(any())?).with_ring(any(), any())?;
    let fixed = Simulated { scene: simulation, method: FixedCost::<5>::new(black_box(3))? };
    let exact = Simulated { scene: simulation.with_friction(any())?, method: Collocation::<5, T>::new(any())? };
    keep(Classified::class(&body.classify(&normal.motion()?)));
    keep(Classified::class(&friction.classify(&oblique.motion()?)));
    process::<T, _, _, 3>(body, &normal, lines())?;
    process::<T, _, _, 6>(friction, &oblique, lines())?;
    process::<T, _, _, 6>(friction, &planar, lines())?;
    process::<T, _, _, 3>(fixed, &normal, lines())?;
    process::<T, _, _, 6>(exact, &oblique, lines())?;
    let boundary = BoundaryTable::<2>::new(any::<T>(), |_| Ok(black_box(CriticalSpeed::At(any::<T>()))))?;
    let source = |_, _| Ok(TableRebound { restitution: any::<T>(), impulse: any() });
    let table = RestitutionTable::<T, 2, 3, 4>::new(boundary, any(), source)?;
    process::<T, _, _, 4>(Tabulated { table: boundary, sphere, friction: NoFriction }, &normal, lines())?;
    process::<T, _, _, 4>(Tabulated { table: boundary.as_slice(), sphere, friction: NoFriction }, &normal, lines())?;
    process::<T, _, _, 4>(Tabulated { table, sphere, friction: NoFriction }, &normal, lines())?;
    process::<T, _, _, 5>(Tabulated { table, sphere, friction: Coulomb::new(any())? }, &planar, lines())?;
    let chosen = Simulated { scene: super::config::scene::<T>()?, method: FixedCost::<5>::new(black_box(3))? };
    process::<T, _, _, 6>(chosen, &planar, lines())?;
    keep(Signal::<Class>::show(&mut NoLines, black_box(None)));
    link()?;
    statistics::<T>()
}

/// A line whose switching cannot be foreseen.
struct Line;

impl ErrorType for Line {
    type Error = Infallible;
}

impl OutputPin for Line {
    fn set_low(&mut self) -> Result<(), Infallible> {
        keep(false);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        keep(true);
        Ok(())
    }
}

fn lines<const CLASSES: usize>() -> ClassLines<Line, CLASSES> {
    ClassLines::new(ClassLines::new([const { Line }; CLASSES]).release())
}

fn process<T, C, R, const CLASSES: usize>(
    classifier: C,
    reading: &R,
    lines: ClassLines<Line, CLASSES>,
) -> Result<(), InputError>
where
    T: Real,
    R: Reading<Motion: Approach<T>> + Copy,
    C: Classifier<T, R::Motion> + Copy,
{
    let mut instrument: Instrument<C, _, T, CLASSES, 3> =
        Instrument::new(classifier, lines, SpeedBins::new([any(), any(), any()])?);
    let mut queue = Queue::<R, 4>::default();
    keep(queue.is_empty());
    let (mut sender, mut receiver) = queue.split();
    keep(sender.send(black_box(*reading)).is_ok());
    while let Some(reading) = receiver.receive() {
        let verdict = instrument.process(&reading);
        keep(verdict.as_ref().is_ok_and(|verdict| verdict.restitution.is_some()));
        if let Err(rejection) = verdict {
            keep(rejection);
        }
    }
    keep((receiver.is_empty(), receiver.lost()));
    keep(instrument.reconfigure(black_box(classifier)).verdict(&reading.motion()?).is_ok());
    keep(instrument.reset().classified());
    let (classifier, lines, tally) = instrument.release();
    let instrument = Instrument::<C, _, T, CLASSES, 3>::resume(classifier, lines, tally);
    let mut tally = *instrument.tally();
    keep(instrument.classifier().verdict(&reading.motion()?).is_ok());
    for &class in C::Class::ALL {
        keep(tally.count(class));
    }
    tally.reject(&black_box(Rejection::Unsolved));
    tally.fail_signal();
    keep((tally.classified(), tally.rejections().total(), tally.signal_failures()));
    keep((*tally.bins().edges(), *tally.restitution(), *tally.restitution_beyond()));
    Ok(())
}

fn statistics<T: Real>() -> Result<(), InputError> {
    let mut statistics = Statistics::<T>::default();
    statistics.add(any());
    statistics.merge(&black_box(statistics));
    keep((statistics.count(), statistics.mean(), statistics.variance()));
    let mut tally = Tally::<T, 3, 1>::new(SpeedBins::new([any()])?);
    tally.record(any(), &Verdict { class: black_box(Outcome::Rebound), restitution: Some(any()) });
    keep(tally);
    Ok(())
}

fn link() -> Result<(), InputError> {
    let mut encoder = Encoder::<184>::default();
    let reading = PlanarReading { approach: any::<f32>(), tangential: any(), peripheral: any() };
    let mut inlet = Inlet::<64>::default();
    let number = black_box(1);
    let method = FixedCost::<5>::new(black_box(3))?.with_outputs::<7>();
    let configure = |scene: &SceneConfig<f32>| Ok::<_, Refusal>(Simulated { scene: scene.scene()?, method });
    let classifier = Simulated { scene: super::config::scene::<f32>()?, method };
    let instrument: Instrument<_, _, f32, 6, 1> = Instrument::new(classifier, lines::<6>(), SpeedBins::new([any()])?);
    let mut station = Station::new(instrument);
    let mut outlet = Outlet::<f32, PlanarReading<f32>, Class, 184>::default();
    let mut hear = |reply: &Reply<f32, Class>| {
        for &byte in encoder.frame(reply).unwrap_or_default() {
            keep(outlet.receive(black_box(byte)));
        }
    };
    hear(&station.started::<PlanarReading<f32>>());
    let requests: [Request<_>; 6] = [
        Request::Event { number, reading },
        Request::Report { number },
        Request::Describe { number },
        Request::Counts { number },
        Request::Reset { number },
        Request::Configure { number, scene: super::config::any_scene() },
    ];
    let mut encoder = Encoder::<64>::default();
    for request in &requests {
        for &byte in encoder.frame(request).unwrap_or_default() {
            if let Some(request) = inlet.receive::<PlanarReading<f32>, f32>(black_box(byte)) {
                let received = Received { arrivals: inlet.arrivals(), lost: any::<f32>() as u32, ticks: 0 };
                hear(&station.answer(&request, &received, configure));
                hear(&station.answer(&request, &received, fixed_scene));
            }
        }
    }
    keep(station.instrument().tally().classified());
    let report = Report { arrivals: inlet.arrivals(), ..black_box(Report::default()) };
    keep((report.is_complete(), report.arrivals.faults.total()));
    let mut faults = report.arrivals.faults;
    faults.add(black_box(FrameFault::Content));
    keep(faults);
    Ok(())
}
