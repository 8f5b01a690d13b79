//! Calls of what turns measurements into parameters, of dual numbers, and of the probabilities of classes.

use core::hint::black_box;

use microimpact::contact::{Collocation, Contact, FixedCost, Method};
use microimpact::measure::{
    CalibrationError, Estimate, ImpulseRatios, Location, MeasuredImpact, MeasuredRebound, RestitutionFit,
    adhesion_damping, estimate, friction, material_damping, parameter, ring_strength, rolling_motion,
};
use microimpact::measure::{ClassProbabilities, NormalDistribution, Uncertain};
use microimpact::{
    Class, CriticalSpeed, Dual, InputError, NormalMotion, Parameter, Real, RigidBody, SpeedRestitution, Sphere,
    Stiffness,
};

use super::contact::AnyNodes;
use super::{any, keep, motions};

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes + NormalDistribution>() {
    keep(contact(&FixedCost::<5>::new(black_box(3)), &Collocation::<7, T>::new(any())));
    keep(many::<T>());
    keep(duals::<T>());
    keep(probabilities::<T>());
    let fault = microimpact::Fault::TooLarge;
    keep(CalibrationError::from(InputError { parameter: Parameter::Radius, fault, value: 2.0 }));
}

fn contact<T: AnyNodes>(
    fixed: &Result<FixedCost<5>, InputError>,
    exact: &Result<Collocation<7, T>, InputError>,
) -> Result<(), CalibrationError> {
    one_impact::<T>(&(*fixed)?)?;
    one_impact::<T>(&(*exact)?)
}

fn one_impact<T: Real>(method: &impl Method<T>) -> Result<(), CalibrationError> {
    let scene = Contact::hertz(Sphere::solid(any(), any())?, Stiffness::new(any())?);
    let rebound = MeasuredRebound::from_speeds(any(), any())?;
    keep(material_damping(&scene.with_ring(any(), any())?, method, &rebound, any()));
    keep(adhesion_damping(&scene.with_damping(any())?, any(), method, &rebound, any()));
    keep(ring_strength(scene.sphere(), Stiffness::new(any())?, any()));
    let of_radius = |radius| Ok(Contact::hertz(Sphere::solid(radius, any())?, Stiffness::new(any())?));
    keep(parameter((any(), any()), of_radius, method, &rebound, any()));
    Ok(())
}

fn many<T: NormalDistribution>() -> Result<(), CalibrationError> {
    let sphere = Sphere::solid(any(), any())?;
    let speed = || Estimate { value: any::<T>(), standard_error: any() };
    let impacts = black_box([MeasuredImpact { sphere, approach: speed(), rebound: Some(speed()) }; 8]);
    let fit = RestitutionFit::of(&impacts)?;
    keep(fit.work_of_adhesion.holds(any()));
    keep(fit);
    let impacts = black_box([ImpulseRatios { measured: any::<T>(), rolling: any() }; 8]);
    keep(friction(&impacts));
    keep(Location::of(black_box(Parameter::Spin), black_box([any::<T>(); 8]).into_iter()));
    let (_, oblique, _) = motions(&sphere)?;
    keep(rolling_motion(&sphere, &oblique, any(), any()).ok());
    Ok(())
}

/// Results with their derivatives, by both models.
fn duals<T: AnyNodes>() -> Result<(), InputError> {
    let [radius, strength] = Dual::variables([any::<T>(), any()]);
    let fixed = || Dual::fixed(any::<T>());
    let scene = Contact::hertz(Sphere::solid(radius, fixed())?, Stiffness::new(fixed())?)
        .with_damping(fixed())?
        .with_ring(strength, fixed())?;
    let method = Collocation::<5, Dual<T, 2>>::new(fixed())?;
    let contact = scene.solve_normal(&NormalMotion::new(fixed())?, &method)?;
    let e = contact.overall_restitution();
    keep((e, e.standard_error(&[any(), any()])));
    keep(estimate(any(), e, &[any(), any()]));
    keep(scene.critical_speed(&method)?);
    keep(scene.solve_normal(&NormalMotion::new(fixed())?, &FixedCost::<5>::new(black_box(3))?)?.rebound_speed());
    keep([e.two_fifths_power(), e.exp(), e.saturating_div(radius), -e, e.abs(), e.min(radius)]);
    keep(e.is_finite());
    Ok(())
}

fn probabilities<T: AnyNodes + NormalDistribution>() -> Result<(), InputError> {
    keep(any::<T>().below());
    let inputs = [
        Uncertain::new(any::<T>(), any())?.within(black_box(Parameter::ApproachSpeed))?,
        Uncertain::new(any(), any())?,
        Uncertain::new(any(), any())?.within(Parameter::WorkOfAdhesion)?,
        Uncertain::new(any(), any())?.within(Parameter::Friction)?,
    ];
    let rigid_body = ClassProbabilities::new(&inputs, |[speed, slip, work, friction]| {
        let scene = RigidBody::new(Sphere::solid(any(), any())?, SpeedRestitution::new(any())?);
        let motion = NormalMotion::new(speed)?.with_tangential(slip)?;
        Ok((scene.with_work_of_adhesion(work)?.with_friction(friction)?, motion))
    })?;
    keep((rigid_body.of(black_box(Class::CapturedSliding)), rigid_body.rebound()));
    let method = Collocation::<5, T>::new(any())?;
    let contact = ClassProbabilities::new(&inputs, |[speed, slip, strength, friction]| {
        let scene = Contact::hertz(Sphere::solid(any(), any())?, Stiffness::new(any())?)
            .with_damping(any())?
            .with_ring(strength, any())?
            .with_friction(friction)?;
        Ok((scene, NormalMotion::new(speed)?.with_tangential(slip)?, &method))
    })?;
    keep(contact.of(black_box(Class::ReboundSliding)));
    let normal = ClassProbabilities::new(&inputs, |[speed, critical, ..]| {
        Ok((NormalMotion::new(speed)?, CriticalSpeed::At(critical)))
    })?;
    keep(normal.rebound());
    Ok(())
}
