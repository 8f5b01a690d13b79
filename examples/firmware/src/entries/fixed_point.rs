//! Calls of both models in fixed point, and of what leads there.

use core::hint::black_box;

use microimpact::contact::{
    Attraction, Contact, Damping, DimensionlessImpact, FixedCost, HertzLaw, Impulses, PhaseSamples, Times,
};
use microimpact::rigid::{ReboundAdhesion, TangentialOutcome, TangentialTerm};
use microimpact::{
    Approach, ConstantRestitution, Coulomb, FixedPoint, FixedPointTerm, Impact, InFixedPoint, InputError, NormalMotion,
    PlanarMotion, Real, RestitutionLaw, RigidBody, SpeedRestitution, Sphere, Stiffness,
};

use super::{any, call_rigid_body, keep};

/// Calls everything in fixed point, set up in one number type.
pub(super) fn call_all<T: Real + Into<f64> + PhaseSamples<5, 9>>() -> Result<(), InputError> {
    call_rigid_body::<FixedPoint>();
    keep(black_box(FixedPoint::nearest(black_box(1.0))).to_f64());
    keep(any::<FixedPoint>().geometric_mean(any()));
    let sphere = Sphere::<T>::solid(any(), any())?;
    with_law(RigidBody::new(sphere, ConstantRestitution::new(any())?))?;
    with_law(RigidBody::new(sphere, SpeedRestitution::new(any())?))?;

    let scene = Contact::hertz(sphere, Stiffness::new(any())?).with_damping(any())?.with_ring(any(), any())?;
    let impact = scene.dimensionless(&NormalMotion::new(any())?).or(DimensionlessImpact::new(any(), any(), any()))?;
    keep(impact.solve(&FixedCost::<5>::new(black_box(3))?).overall_restitution());
    oblique_contact(&scene.with_friction(any())?)?;
    let dmt = Contact::hertz(sphere, Stiffness::new(any())?).with_dmt(any())?.with_viscoelastic_damping(any())?;
    oblique_contact(&dmt.with_friction(any())?)?;
    let dmt = dmt.dimensionless(&NormalMotion::new(any())?)?;
    keep(dmt.in_fixed_point()?.solve(&FixedCost::<5>::new(black_box(3))?).overall_restitution());
    let hertz = Contact::hertz(sphere, Stiffness::new(any())?);
    oblique_contact(&hertz.with_friction(any())?)?;
    let hertz = hertz.dimensionless(&NormalMotion::new(any())?)?;
    keep(hertz.in_fixed_point()?.solve(&FixedCost::<5>::new(black_box(3))?).overall_restitution());
    let impact = impact.in_fixed_point()?;
    solved::<4>(&impact)?;
    solved::<5>(&impact)?;
    solved::<6>(&impact)?;
    solved::<7>(&impact)?;
    solved::<8>(&impact)
}

#[inline(never)]
fn solved<const N: usize>(impact: &DimensionlessImpact<FixedPoint>) -> Result<(), InputError>
where
    FixedPoint: PhaseSamples<N, 9>,
{
    keep(impact.solve(&FixedCost::<N>::new(black_box(3))?).overall_restitution());
    Ok(())
}

#[inline(never)]
fn oblique_contact<T, D, A>(scene: &Contact<T, HertzLaw<T, D, A>, Coulomb<T>>) -> Result<(), InputError>
where
    T: Real,
    D: Damping<T> + FixedPointTerm<T, Fixed: Damping<FixedPoint>>,
    A: Attraction<T> + FixedPointTerm<T, Fixed: Attraction<FixedPoint>>,
{
    let scene = scene.in_fixed_point(any())?;
    let motion = PlanarMotion::in_units([any(), any(), any()])?;
    let method = FixedCost::<5>::new(black_box(3))?.with_outputs::<9>();
    let (impact, outputs) = scene.solve_for(&motion, &method, (Times, Impulses))?;
    keep((impact.class(), impact.normal.overall_restitution(), outputs));
    Ok(())
}

fn with_law<T, L>(scene: RigidBody<T, L>) -> Result<(), InputError>
where
    T: Real + Into<f64>,
    L: InFixedPoint<T, Fixed: RestitutionLaw<FixedPoint>> + Copy,
{
    with_adhesion(scene)?;
    with_adhesion(scene.with_adhesion_coefficient(any())?)?;
    with_adhesion(scene.with_work_of_adhesion(any())?)
}

fn with_adhesion<T, L, A>(scene: RigidBody<T, L, A>) -> Result<(), InputError>
where
    T: Real + Into<f64>,
    L: InFixedPoint<T, Fixed: RestitutionLaw<FixedPoint>> + Copy,
    A: InFixedPoint<T, Fixed: ReboundAdhesion<FixedPoint>> + Copy,
{
    let unit = any::<T>();
    let normal = NormalMotion::new(any())?;
    let oblique = normal.with_tangential(any())?;
    let planar = oblique.with_peripheral_velocity(any())?;
    let (normal, oblique, planar) =
        (normal.in_fixed_point(unit)?, oblique.in_fixed_point(unit)?, planar.in_fixed_point(unit)?);
    let rough = scene.with_friction(any())?.in_fixed_point(unit)?;
    let smooth = scene.in_fixed_point(unit)?;
    keep(smooth.critical_speed());
    keep(smooth.impact(&normal).energy(smooth.sphere()));
    keep(smooth.classify(&normal));
    impact(&rough, &oblique);
    impact(&rough, &planar);
    Ok(())
}

fn impact<L, A, S, M>(scene: &RigidBody<FixedPoint, L, A, S>, motion: &M)
where
    L: RestitutionLaw<FixedPoint>,
    A: ReboundAdhesion<FixedPoint>,
    S: TangentialTerm<FixedPoint, M>,
    M: Approach<FixedPoint>,
{
    let impact: Impact<FixedPoint, S::Impact> = scene.impact(motion);
    keep(impact.tangential.classify(black_box(microimpact::Outcome::Capture)));
    keep(impact.normal);
    keep(scene.classify(motion));
}
