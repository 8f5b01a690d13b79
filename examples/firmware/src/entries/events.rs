//! Calls of what an instrument does with events of sized particles.

use core::hint::black_box;

use microimpact::contact::{Collocation, Contact, FixedCost};
use microimpact::instrument::{
    Classifier, Confident, DriftAlarm, EventCounter, NormalReading, ObservedRebound, PerParticle, PlanarReading,
    Reading, Rejection, Scatter, Simulated, SizeBins, SizedReading, SizedTally, SpeedBins, Stamped, UncertainReading,
    corrected_rate,
};
use microimpact::measure::{Estimate, NormalDistribution};
use microimpact::rigid::Departure;
use microimpact::{
    Approach, Class, InputError, Oblique, Outcome, PlanarMotion, Real, RigidBody, SpeedRestitution, Sphere, Stiffness,
};

use super::contact::AnyNodes;
use super::{any, keep};

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes + NormalDistribution>() -> Result<(), Rejection> {
    sized::<T>()?;
    confident::<T>()?;
    tally::<T>()?;
    counting::<T>()?;
    observed::<T>()?;
    Ok(())
}

fn estimate<T: Real>() -> Estimate<T> {
    Estimate { value: any(), standard_error: any() }
}

fn sized<T: AnyNodes>() -> Result<(), Rejection> {
    let densities = black_box([T::ONE, T::ONE]);
    let bodies = PerParticle {
        materials: &densities,
        scene: |density: &T, radius: T| {
            RigidBody::new(Sphere::solid(radius, *density)?, SpeedRestitution::new(any())?)
                .with_work_of_adhesion(any::<T>() * radius)?
                .with_friction(any())
        },
    };
    let reading = PlanarReading { approach: any::<T>(), tangential: any(), peripheral: any() };
    let reading = SizedReading { radius: any::<T>(), material: black_box(1), reading };
    let motion = Stamped { ticks: black_box(1), reading }.motion()?;
    keep((motion.radius(), motion.material(), motion.motion().slip(), motion.normal().speed()));
    keep(bodies.verdict(&motion)?);
    keep(bodies.scene(black_box(1), any())?.verdict(&reading.reading.motion()?)?);
    let contacts = PerParticle {
        materials: &densities,
        scene: |density: &T, radius: T| {
            let scene = Contact::hertz(Sphere::solid(radius, *density)?, Stiffness::new(any())?);
            Ok(Simulated { scene: scene.with_ring(any(), any())?, method: FixedCost::<5>::new(black_box(3))? })
        },
    };
    let reading =
        SizedReading { radius: any::<T>(), material: black_box(0), reading: NormalReading { approach: any() } };
    keep(contacts.verdict(&reading.motion()?)?);
    Ok(())
}

fn confident<T: AnyNodes>() -> Result<(), Rejection> {
    let reading = UncertainReading {
        approach: estimate::<T>(),
        tangential: estimate(),
        peripheral: estimate(),
        radius: estimate(),
    };
    let motion = black_box(reading).motion()?;
    keep((motion.normal().speed(), motion.motion().slip()));
    let rigid_body = Confident::new(any(), |radius, motion: PlanarMotion<T>| {
        let scene = RigidBody::new(Sphere::solid(radius, any())?, SpeedRestitution::new(any())?);
        Ok((scene.with_work_of_adhesion(any::<T>() * radius)?.with_friction(any())?, motion))
    })?;
    keep(rigid_body.verdict(&motion)?);
    keep(rigid_body.probabilities(&motion)?.by_class());
    let method = Collocation::<5, T>::new(any())?;
    let simulation = Confident::new(any(), |radius, motion: PlanarMotion<T>| {
        let scene = Contact::hertz(Sphere::solid(radius, any())?, Stiffness::new(any())?);
        Ok((scene.with_ring(any(), any())?.with_friction(any())?, motion, &method))
    })?;
    keep(simulation.verdict(&motion)?);
    Ok(())
}

fn tally<T: Real>() -> Result<(), InputError> {
    let (sizes, speeds) = (SizeBins::new([any(), any()])?, SpeedBins::new([any::<T>(), any(), any()])?);
    let mut tally = SizedTally::<T, 6, 2, 3>::new(sizes, speeds);
    tally.record(any(), any(), black_box(Class::ReboundRolling), Some(&[any(); 6]))?;
    tally.record(any(), any(), black_box(Class::Undecided), black_box(None))?;
    keep((*tally.sizes().edges(), *tally.speeds().edges(), *tally.beyond()));
    let class = black_box(Class::CapturedSliding);
    for cell in [tally.cell(black_box(1), black_box(2)).copied(), Some(tally.total())].into_iter().flatten() {
        keep((cell.count(class), cell.readings(), cell.excess(class), cell.residual(class)));
    }
    let mut outcomes = SizedTally::<T, 3, 2, 3>::new(sizes, speeds);
    outcomes.record(any(), any(), black_box(Outcome::Rebound), Some(&[any(); 3]))
}

fn counting<T: Real>() -> Result<(), InputError> {
    let mut counter = EventCounter::new(black_box(0), black_box(100), black_box(20));
    counter.wait(black_box(1));
    keep(counter.arrive(black_box(2)));
    keep((counter.elapsed(), counter.counts()));
    let rate = corrected_rate::<T>(counter.counts().recorded, any(), &estimate())?;
    keep((rate, rate.coincidence(any())?));
    let mut alarm = DriftAlarm::<T>::new(any(), any())?;
    keep(alarm.observe(black_box(true), any())?);
    alarm.reset();
    keep(alarm);
    Ok(())
}

fn observed<T: NormalDistribution>() -> Result<(), InputError> {
    let observed = ObservedRebound {
        approach: estimate::<T>(),
        tangential: estimate(),
        peripheral: estimate(),
        rebound: estimate(),
        tangential_after: estimate(),
    };
    let scene = RigidBody::new(Sphere::solid(any(), any())?, SpeedRestitution::new(any())?)
        .with_work_of_adhesion(any())?
        .with_friction(any())?;
    let found = observed.compare(&Scatter { restitution: any(), impulse_ratio: any() }, |before| {
        let impact = scene.impact(before);
        let (normal, tangential) = (impact.normal.rebound_speed(), impact.tangential.velocity());
        Ok::<_, InputError>(Departure { normal, tangential })
    })?;
    keep((found.restitution.residual(), found.impulse_ratio.probability()));
    Ok(())
}
