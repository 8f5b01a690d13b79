//! Calls of the contact simulation.
//!
//! Every term of a scene is in a scene with every number of nodes; the combinations of terms, which are
//! arithmetic without an index, are with the fewest nodes.

use core::hint::black_box;

use microimpact::contact::{
    Attraction, Collocation, ConstantForce, ContactImpulses, ContactTimes, ContactWorks, Damping, Everything,
    FixedCost, HystereticDamping, Method, NoPeeling, Nodes, NormalContact, Peeling, PhaseSamples, RestCriterion, Ring,
    RunReport, RungeKuttaGill, Scale, SettledImpact, SimulatedImpact, Contact, TangentialContact, TangentialScene,
    TangentialVelocities, Trajectory,
};
use microimpact::{Approach, Classification, ContactClass, InputError, NoFriction, Real, Sphere, Stiffness};

use super::{any, keep, motions};

/// A number type with the nodes for all of the probe's methods.
pub trait AnyNodes:
    Nodes<5>
    + Nodes<7>
    + Nodes<9>
    + Nodes<12>
    + PhaseSamples<4, 7>
    + PhaseSamples<5, 8>
    + PhaseSamples<6, 9>
    + PhaseSamples<7, 10>
    + PhaseSamples<8, 16>
{
}

impl AnyNodes for f32 {}
impl AnyNodes for f64 {}

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes>() -> Result<(), InputError> {
    let scene = Simulation::<T>::new(Sphere::solid(any(), any())?, Stiffness::new(any())?);
    terms::<T>()?;
    keep(scene.sphere());
    with_every_term::<5, T>(&scene)?;
    with_every_term::<7, T>(&scene)?;
    with_every_term::<9, T>(&scene)?;
    with_every_term::<12, T>(&scene)?;
    at_fixed_cost::<4, 7, T>(&scene)?;
    at_fixed_cost::<5, 8, T>(&scene)?;
    at_fixed_cost::<6, 9, T>(&scene)?;
    at_fixed_cost::<7, 10, T>(&scene)?;
    at_fixed_cost::<8, 16, T>(&scene)?;
    outputs(&scene)?;
    with_damping(scene)?;
    with_damping(scene.with_damping(any())?)
}

fn terms<T: Nodes<5>>() -> Result<(), InputError> {
    keep(HystereticDamping::<T>::new(any())?);
    keep(Ring::<T>::new(any(), any())?);
    keep(Peeling::<T>::new(any())?);
    keep(ConstantForce::<T>::new(any())?);
    Ok(())
}

fn with_every_term<const N: usize, T: Nodes<N>>(scene: &Simulation<T>) -> Result<(), InputError> {
    let normal = scene.with_damping(any())?.with_ring(any(), any())?.with_external_force(any())?;
    let planar = normal.with_friction(any())?.with_peeling(any())?;
    let method = Collocation::<N, T>::new(any())?;
    let (_, _, motion) = motions(scene.sphere())?;
    contact(&planar.solve_normal(&motion, &method)?);
    keep(normal.critical_speed(&method)?);
    let impact = planar.impact(&method, &motion)?;
    keep((impact.class(), impact.energy(scene.sphere())));
    keep(impact.outputs);
    report(&impact.run);
    contact(&impact.normal);
    tangential(&impact.tangential);
    let recorded: SimulatedImpact<T, _, Trajectory<T, 16>> = planar.observe(&method, &motion)?;
    trajectory(&recorded.outputs);
    let criterion = RestCriterion::new(any(), black_box(1000))?;
    let settled: SettledImpact<T, _, Trajectory<T, 16>> = planar.observe_to_rest(&method, &motion, &criterion)?;
    keep(settled.motion);
    Ok(())
}

fn at_fixed_cost<const N: usize, const M: usize, T: PhaseSamples<N, M>>(
    scene: &Simulation<T>,
) -> Result<(), InputError> {
    let method = FixedCost::<N>::new(black_box(3))?;
    let (motion, _, planar) = motions(scene.sphere())?;
    contact(&scene.solve_normal(&motion, &method)?);
    let scene = scene.with_damping(any())?.with_ring(any(), any())?.with_external_force(any())?;
    contact(&scene.solve_normal(&motion, &method)?);
    let method = method.with_outputs::<M>();
    let impact: SimulatedImpact<T, TangentialVelocities<T>, Everything<T>> =
        scene.with_friction(any())?.observe(&method, &planar)?;
    keep((impact.class(), impact.outputs, impact.tangential));
    report(&impact.run);
    contact(&impact.normal);
    Ok(())
}

fn with_damping<T, D>(scene: Simulation<T, D>) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: Scale<T, Scaled: Damping<T>> + Copy,
{
    with_adhesion(scene)?;
    let scene = scene.with_ring(any(), any())?;
    with_adhesion(scene)?;
    let scene = scene.with_friction(any())?.with_peeling(any())?;
    let (_, _, planar) = motions(scene.sphere())?;
    solve(&scene, &planar)?;
    solve(&scene.with_external_force(any())?, &planar)
}

fn with_adhesion<T, D, A>(scene: Simulation<T, D, A>) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: Scale<T, Scaled: Damping<T>> + Copy,
    A: Scale<T, Scaled: Attraction<T>> + Copy,
{
    with_force(scene)?;
    with_force(scene.with_external_force(any())?)
}

fn with_force<T, D, A, X>(scene: Simulation<T, D, A, NoFriction, NoPeeling, X>) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: Scale<T, Scaled: Damping<T>> + Copy,
    A: Scale<T, Scaled: Attraction<T>> + Copy,
    X: Scale<T, Scaled: Attraction<T>> + Copy,
{
    let method = Collocation::<5, T>::new(any())?;
    let (normal, oblique, _) = motions(scene.sphere())?;
    keep(scene.groups(&normal)?);
    contact(&scene.solve_normal(&normal, &method)?);
    solve(&scene.with_friction(any())?, &oblique)
}

/// What all scenes with friction have in common.
fn solve<T, D, A, F, P, X, M>(scene: &Simulation<T, D, A, F, P, X>, motion: &M) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: Scale<T, Scaled: Damping<T>>,
    A: Scale<T, Scaled: Attraction<T>>,
    X: Scale<T, Scaled: Attraction<T>>,
    F: TangentialScene<T, M, A, P, TangentialContact<T>>,
    Collocation<5, T>: Method<T, ((), F::Observer)>,
    M: Approach<T>,
{
    let impact: SimulatedImpact<T, TangentialContact<T>, ()> =
        scene.observe(&Collocation::<5, T>::new(any())?, motion)?;
    report(&impact.run);
    contact(&impact.normal);
    tangential(&impact.tangential);
    Ok(())
}

/// Outputs one by one, and the paper's method.
fn outputs<T: Nodes<5>>(scene: &Simulation<T>) -> Result<(), InputError> {
    type Each<T> = (ContactTimes<T>, (ContactImpulses<T>, ContactWorks<T>));
    let normal = scene.with_damping(any())?.with_ring(any(), any())?.with_external_force(any())?;
    let (oblique, (straight, moved, spun)) = (normal.with_friction(any())?, motions(scene.sphere())?);
    let method = Collocation::<5, T>::new(any())?;
    let each: SimulatedImpact<T, (), Each<T>> = normal.observe(&method, &straight)?;
    keep(each.outputs);
    let each: SimulatedImpact<T, TangentialContact<T>, Each<T>> = oblique.observe(&method, &moved)?;
    keep(each.outputs);

    let class: Option<Classification<T, ContactClass<T>>> = oblique.classify(&method, &moved)?;
    keep(class);

    let method = RungeKuttaGill::new(black_box(100));
    keep(normal.impact(&method, &straight)?.outputs);
    contact(&normal.solve_normal(&straight, &method)?);
    keep(oblique.impact(&method, &moved)?.tangential);
    keep(oblique.with_peeling(any())?.impact(&method, &spun)?.tangential);
    Ok(())
}

#[inline(never)]
fn contact<T: Real>(contact: &NormalContact<T>) {
    keep((contact.outcome(), contact.overall_restitution(), contact.rebound_speed()));
    keep((contact.peak_indentation(), contact.turning_indentation()));
    keep((contact.peak_contact_radius(), contact.peak_force()));
}

#[inline(never)]
fn tangential<T: Real>(contact: &TangentialContact<T>) {
    keep((contact.motion(), contact.tangential(), contact.spin()));
    keep((contact.rotation(), contact.rotation_degrees()));
    keep((contact.displacement(), contact.rolls_from()));
}

#[inline(never)]
fn trajectory<T: Real>(trajectory: &Trajectory<T, 16>) {
    for sample in trajectory.samples().rev() {
        keep(sample);
    }
    keep((trajectory.dimensionless(), trajectory.units(), trajectory.peak(), trajectory.roll()));
}

#[inline(never)]
fn report<T: Real>(run: &RunReport<T>) {
    keep(*run);
}
