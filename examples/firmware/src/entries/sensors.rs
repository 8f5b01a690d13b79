//! Calls of the front ends of sensors.

use core::hint::black_box;

use microimpact::contact::{Contact, FixedCost};
use microimpact::instrument::sensor::{
    ChargePulse, Clock, Doppler, DopplerBurst, ImageCharge, ImpulseSensor, PulseSum, Transit, radius_from_impulse,
};
use microimpact::instrument::{Rejection, Simulated};
use microimpact::measure::Estimate;
use microimpact::{Real, RigidBody, SpeedRestitution, Sphere, Stiffness};

use super::contact::AnyNodes;
use super::{any, keep};

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes>() -> Result<(), Rejection> {
    let clock = Clock::new(&estimate::<T>(), any())?;
    keep(clock.time(black_box(100))?);
    keep(Transit::new(&estimate(), clock)?.speed(black_box(100))?);
    let burst = black_box(DopplerBurst { periods: 16, ticks: 1000 });
    keep(Doppler::new(&estimate(), any(), clock)?.velocity(&burst)?);
    let pulse = black_box(ChargePulse { height: -200, width: 4000 });
    let particle = ImageCharge::new(&estimate(), &estimate(), any(), clock)?.particle(&pulse)?;
    keep(particle.radius(&estimate(), &estimate())?);

    let mut pulse = PulseSum::new(black_box(2048));
    pulse.add(black_box(2100));
    keep((pulse.sum(), pulse.samples()));
    let impulse = ImpulseSensor::new(&estimate::<T>(), any(), any())?.impulse(&pulse)?;
    keep(radius_from_impulse(&impulse, &estimate(), &estimate(), |radius| {
        RigidBody::new(Sphere::solid(radius, any())?, SpeedRestitution::new(any())?)
            .with_work_of_adhesion(any::<T>() * radius)
    })?);
    keep(radius_from_impulse(&impulse, &estimate(), &estimate(), |radius| {
        let scene = Contact::hertz(Sphere::solid(radius, any())?, Stiffness::new(any())?).with_ring(any(), any())?;
        Ok(Simulated { scene, method: FixedCost::<5>::new(black_box(3))? })
    })?);
    Ok(())
}

fn estimate<T: Real>() -> Estimate<T> {
    Estimate { value: any(), standard_error: any() }
}
