//! Calls of all that the library offers, with inputs that the compiler does not know.
//!
//! Two things are left out: `Display`, because the formatting of core itself panics,
//! and `Debug` for the same reason. Functions that are used by many scenes are not
//! inlined, so that all of it is built soon.

use core::hint::black_box;

use microimpact::rigid::{
    AdhesionCoefficient, Departure, ElasticPlasticRestitution, Microforce, MicroforceTerm, NoMicroforce, Phases,
    PowerRestitution, ReboundAdhesion, RollingDissipation, SpeedAdhesion, TabulatedRestitution, TangentialOutcome,
    TangentialTerm, ViscoelasticRestitution, WorkOfAdhesion, image_charge_energy, infer, infer_assuming_rolling,
    infer_with_spins,
};
use microimpact::table::Single;
use microimpact::{
    AdhesionRegime, Approach, Class, Classification, ConstantRestitution, ContactClass, Coulomb, Fault, Hertz, Impact,
    ImpactError, InputError, KnownMaterial, MATERIALS, Material, NoAdhesion, NoFriction, NormalImpact, NormalMotion,
    Oblique, ObliqueMotion, Outcome, Parameter, PlanarMotion, Real, RestitutionLaw, RigidBody, SpeedRestitution,
    Sphere, Sticking, Stiffness, SurfaceMotion, TangentialImpact,
};

mod config;
mod contact;
#[cfg(feature = "probe")]
mod events;
mod fixed_point;
#[cfg(feature = "probe")]
mod instrument;
mod measure;
#[cfg(feature = "probe")]
mod sensors;
mod space;
mod table;

/// Calls everything, with one number type.
pub fn call_all<T>()
where
    T: contact::AnyNodes + Single + microimpact::measure::NormalDistribution + Into<f64>,
{
    call_rigid_body::<T>();
    keep(table::call_all::<T>());
    keep(contact::call_all::<T>());
    keep(config::call_all::<T>());
    keep(space::call_all::<T>());
    keep(fixed_point::call_all::<T>());
    measure::call_all::<T>();
    #[cfg(feature = "probe")]
    keep(instrument::call_all::<T>());
    #[cfg(feature = "probe")]
    keep(events::call_all::<T>());
    #[cfg(feature = "probe")]
    keep(sensors::call_all::<T>());
}

/// Calls everything but the contact simulation, with one number type.
pub fn call_rigid_body<T: Real>() {
    keep(numbers::<T>());
    keep(parameters::<T>());
    keep(errors());
    keep(elasticity::<T>());
    keep(scenes::<T>());
    keep(inverse::<T>());
}

/// A number that the compiler must expect to be any number.
fn any<T: Real>() -> T {
    black_box(T::ONE)
}

/// A use of `result` that the compiler cannot leave out.
fn keep<R>(result: R) {
    black_box(&result);
}

fn numbers<T: Real>() -> bool {
    keep(T::constant(black_box(1.0)));
    keep([any::<T>().sqrt(), any::<T>().two_fifths_power(), any::<T>().exp(), any::<T>().abs()]);
    keep([any::<T>().saturating_div(any()), any::<T>().min(any()), any::<T>().max(any())]);
    any::<T>().is_finite()
}

fn parameters<T: Real>() -> Result<T, InputError> {
    let parameter = black_box(Parameter::Radius);
    keep((parameter.name(), parameter.unit(), parameter.range()));
    parameter.check(any())
}

fn errors() -> ImpactError {
    ImpactError::from(InputError {
        parameter: black_box(Parameter::Radius),
        fault: black_box(Fault::TooLarge),
        value: black_box(2.0),
    })
}

fn elasticity<T: Real>() -> Result<(), InputError> {
    let material = Material::<T>::new(any(), any())?;
    keep(material.elastic_constant());
    let stiffness = Stiffness::new(any::<T>()).or(Stiffness::between(&material, &material))?;
    keep((stiffness.pascals(), Stiffness::tangential_ratio_between(&material, &material)));
    for sphere in [
        Sphere::<T>::solid(any(), any()),
        Sphere::hollow(any(), any(), any()),
        Sphere::coated(any(), any(), any(), any()),
        Sphere::new(any(), any(), any()),
    ] {
        let sphere = sphere?;
        keep((sphere.radius(), sphere.density(), sphere.mass()));
        keep((sphere.gyration_ratio(), sphere.radius_of_gyration()));
        keep(sphere.contact_inertia());
        let (normal, oblique, planar) = motions(&sphere)?;
        keep(MATERIALS.get(any::<T>().to_f64() as usize).map(KnownMaterial::elastic::<T>));
        keep(Sticking::new(&sphere, stiffness, any())?);
        keep(Hertz::yield_speed(&sphere, stiffness, any())?);
        keep(AdhesionRegime::of(&sphere, stiffness, any(), any())?);
        keep(Hertz::new(&sphere, stiffness, &normal));
        keep(Hertz::new(&sphere, stiffness, &oblique));
        keep(Hertz::new(&sphere, stiffness, &planar));
    }
    Ok(())
}

type Motions<T> = (NormalMotion<T>, ObliqueMotion<T>, PlanarMotion<T>);

#[inline(never)]
fn motions<T: Real>(sphere: &Sphere<T>) -> Result<Motions<T>, InputError> {
    let normal = NormalMotion::new(any()).or(NormalMotion::from_velocity(any()))?;
    let oblique = normal.with_tangential(any())?;
    let planar = oblique.with_spin(sphere, any()).or(oblique.with_peripheral_velocity(any()))?;
    keep((normal.speed(), oblique.normal(), planar.normal()));
    keep((oblique.tangential(), oblique.peripheral(), oblique.slip()));
    keep((planar.tangential(), planar.peripheral(), planar.slip()));
    Ok((normal, oblique, planar))
}

fn scenes<T: Real>() -> Result<(), InputError> {
    let sphere = Sphere::solid(any(), any())?;
    with_law(&sphere, ConstantRestitution::new(any::<T>())?)?;
    with_law(&sphere, SpeedRestitution::new(any::<T>())?)?;
    let stiffness = Stiffness::new(any())?;
    law_of_restitution::<T>(PowerRestitution::new(any::<T>(), any())?);
    law_of_restitution::<T>(
        ElasticPlasticRestitution::new(any::<T>()).or(ElasticPlasticRestitution::from_yield_pressure(
            &sphere,
            stiffness,
            any(),
        ))?,
    );
    law_of_restitution::<T>(ViscoelasticRestitution::new(&sphere, stiffness, any())?);
    law_of_restitution::<T>(TabulatedRestitution::<T, 4>::new(black_box([(any(), any()); 4]))?);
    keep(image_charge_energy(&sphere, any())?);
    Ok(())
}

fn law_of_restitution<T: Real>(law: impl RestitutionLaw<T>) {
    keep((law.restitution(any()), law.approach_speed(any())));
}

fn with_law<T: Real, L: RestitutionLaw<T> + Copy>(sphere: &Sphere<T>, law: L) -> Result<(), InputError> {
    law_of_restitution(law);
    adhesion::<T>(&law, NoAdhesion);
    adhesion(&law, AdhesionCoefficient::new(any::<T>())?);
    adhesion(&law, WorkOfAdhesion::new(any(), sphere)?);
    adhesion(&law, SpeedAdhesion::new(any::<T>(), any())?);
    keep(RigidBody::new(*sphere, law).with_adhesion_at_speed(any(), any())?.critical_speed());

    let scene = RigidBody::new(*sphere, law);
    with_adhesion(scene)?;
    with_adhesion(scene.with_adhesion_coefficient(any())?)?;
    with_adhesion(scene.with_work_of_adhesion(any())?)
}

fn adhesion<T: Real>(law: &impl RestitutionLaw<T>, adhesion: impl ReboundAdhesion<T>) {
    keep((adhesion.departure(any(), any()), adhesion.holding_speed(law, any())));
}

fn with_adhesion<T, L, A>(scene: RigidBody<T, L, A>) -> Result<(), InputError>
where
    T: Real,
    L: RestitutionLaw<T> + Copy,
    A: ReboundAdhesion<T> + Copy,
{
    microforce::<T>(NoMicroforce);
    microforce(Microforce::from_impulses(any::<T>(), any(), scene.sphere())?);
    with_microforce(scene)?;
    let pushed = scene.with_external_impulses(any(), any()).or(scene.with_external_force(any(), any()))?;
    with_microforce(pushed)
}

fn microforce<T: Real>(force: impl MicroforceTerm<T>) {
    keep((force.body_approach(any()), force.approach_speed(any())));
    keep((force.rebound(any()), force.pull()));
}

fn with_microforce<T, L, A, X>(scene: RigidBody<T, L, A, NoFriction, X>) -> Result<(), InputError>
where
    T: Real,
    L: RestitutionLaw<T> + Copy,
    A: ReboundAdhesion<T> + Copy,
    X: MicroforceTerm<T> + Copy,
{
    let sphere = scene.sphere();
    keep(scene.critical_speed());
    let (normal, oblique, planar) = motions(sphere)?;
    keep(scene.classify(&normal));
    keep(scene.impact(&normal).energy(sphere));
    normal_impact(&scene.impact(&normal).normal, sphere);
    let with_ratio = [scene.impact_with_ratio(&oblique, any()), scene.impact_with_ratio(&planar, any())];
    for impact in with_ratio.iter().flatten() {
        planar_impact(impact, sphere);
        keep(scene.classify_impact(impact));
    }

    keep(Coulomb::new(any::<T>())?.coefficient());
    let scene = scene.with_friction(any())?;
    with_friction(&scene)?;
    keep(RollingDissipation::new(Coulomb::new(any::<T>())?, any(), sphere)?);
    with_friction(&scene.with_rolling_dissipation(any())?)
}

fn with_friction<T, L, A, S, X>(scene: &RigidBody<T, L, A, S, X>) -> Result<(), InputError>
where
    T: Real,
    L: RestitutionLaw<T>,
    A: ReboundAdhesion<T>,
    X: MicroforceTerm<T>,
    S: TangentialTerm<T, ObliqueMotion<T>, Impact = TangentialImpact<T>>
        + TangentialTerm<T, PlanarMotion<T>, Impact = TangentialImpact<T>>,
{
    let (_, oblique, planar) = motions(scene.sphere())?;
    keep(scene.impact(&planar).lane(|number: T| number));
    for impact in [scene.impact(&oblique), scene.impact(&planar)] {
        planar_impact(&impact, scene.sphere());
        keep(scene.classify_impact(&impact));
    }
    for classification in [scene.classify(&oblique), scene.classify(&planar)] {
        keep(class(&classification));
    }
    Ok(())
}

fn class<T: Copy>(classification: &Classification<T, ContactClass<T>>) -> Class {
    keep(
        Classification {
            contact: ContactClass {
                motion: black_box(SurfaceMotion::Sliding),
                friction_over_limit: classification.contact.friction_over_limit,
            },
            ..*classification
        }
        .class(),
    );
    classification.class()
}

#[inline(never)]
fn normal_impact<T: Real>(impact: &NormalImpact<T>, sphere: &Sphere<T>) {
    keep((impact.is_capture(), impact.approach_speed(), impact.rebound_speed()));
    keep((impact.restitution(), impact.overall_restitution()));
    keep((impact.adhesion_coefficient(), impact.adhesion_loss()));
    keep(impact.works(sphere));
    let impulses = impact.impulses(sphere);
    keep([impulses.body.total(), impulses.external.total()]);
    keep(impulses);
}

#[inline(never)]
fn planar_impact<T: Real>(impact: &Impact<T, TangentialImpact<T>>, sphere: &Sphere<T>) {
    normal_impact(&impact.normal, sphere);
    let energy = impact.energy(sphere);
    keep((energy.lost(), impact.loss_ratio()));
    keep(energy);

    let tangential = &impact.tangential;
    keep((tangential.velocity(), tangential.peripheral(), tangential.slip()));
    keep((tangential.spin(sphere), tangential.spin_before(sphere)));
    keep((tangential.impulse_ratio(), tangential.rolling_ratio()));
    keep((tangential.energy_bound(), tangential.velocity_ratio()));
    keep((tangential.rolling_arm(sphere), tangential.at_deepest_point()));
    keep(tangential.impulses(sphere));
    keep(tangential.classify(black_box(Outcome::Capture)));
    TangentialOutcome::<T>::classify(&(), black_box(Outcome::Capture));
    keep(Phases { approach: any::<T>(), rebound: any() }.total());
}

fn inverse<T: Real>() -> Result<(), ImpactError> {
    let sphere = Sphere::solid(any(), any())?;
    let (normal, oblique, planar) = motions(&sphere)?;
    let after = Departure { normal: any(), tangential: any() };
    let constant = ConstantRestitution::new(any::<T>())?;
    let by_speed = SpeedRestitution::new(any::<T>())?;
    keep(NormalImpact::from_measurement(&constant, &normal, any()));
    keep(NormalImpact::from_measurement(&by_speed, &normal, any()));
    let inferred = [
        infer(&sphere, &constant, &planar, &after, any()),
        infer(&sphere, &by_speed, &planar, &after, any()),
        infer_assuming_rolling(&sphere, &constant, &oblique, &after),
        infer_assuming_rolling(&sphere, &by_speed, &oblique, &after),
        infer_with_spins(&sphere, &constant, &planar, &after, any(), any()),
        infer_with_spins(&sphere, &by_speed, &planar, &after, any(), any()),
    ];
    for impact in inferred.iter().flatten() {
        planar_impact(impact, &sphere);
    }
    Ok(())
}
