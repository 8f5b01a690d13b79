//! Calls of the contact simulation.
//!
//! Every term of a scene is in a scene with every number of nodes; the combinations of terms, which are
//! arithmetic without an index, are with the fewest nodes.

use core::hint::black_box;

use microimpact::contact::{
    Adaptive, AdaptiveNodes, AnyLaw, Attraction, Collocation, ConstantDamping, ConstantForce, Contact, ContactLaw,
    CriticalSpeedSearch, Damping, Dmt, Energy, ErrorControl, FixedCost, Groups, HertzLaw, HystereticDamping, Impulses,
    JkrEnd, JkrLaw, Nodes, NormalContact, Output, Peeling, PhaseSamples, ProportionalDamping, Recording, RestCriterion,
    Ring, RunReport, RungeKuttaGill, SimulatedImpact, Slip, SlipHistory, Surface, TangentialVelocities, Times,
    Trajectory, Unloading, ViscoelasticDamping, Works,
};
use microimpact::{Approach, Classification, ContactClass, Coulomb, InputError, PlanarMotion, Real, Sphere, Stiffness};

use super::{any, keep, motions};

/// A number type with the nodes for all of the probe's methods.
pub trait AnyNodes:
    AdaptiveNodes
    + Nodes<5>
    + Nodes<7>
    + Nodes<9>
    + Nodes<12>
    + PhaseSamples<4, 7>
    + PhaseSamples<4, 9>
    + PhaseSamples<5, 8>
    + PhaseSamples<5, 9>
    + PhaseSamples<6, 9>
    + PhaseSamples<7, 9>
    + PhaseSamples<7, 11>
    + PhaseSamples<8, 9>
    + PhaseSamples<8, 16>
{
}

impl AnyNodes for f32 {}
impl AnyNodes for f64 {}

/// A scene without any other term than Hertz's force.
type Elastic<T> = Contact<T, HertzLaw<T>>;

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes>() -> Result<(), InputError> {
    let scene: Elastic<T> = Contact::hertz(Sphere::solid(any(), any())?, Stiffness::new(any())?);
    terms::<T>()?;
    keep(scene.sphere());
    with_every_term::<5, T>(&scene)?;
    with_every_term::<7, T>(&scene)?;
    with_every_term::<9, T>(&scene)?;
    with_every_term::<12, T>(&scene)?;
    at_fixed_cost::<4, 7, T>(&scene)?;
    at_fixed_cost::<5, 8, T>(&scene)?;
    at_fixed_cost::<6, 9, T>(&scene)?;
    at_fixed_cost::<7, 11, T>(&scene)?;
    at_fixed_cost::<8, 16, T>(&scene)?;
    outputs(&scene)?;
    other_laws(&scene)?;
    compliant(&scene)?;
    chosen_at_run_time::<T>()?;
    with_damping(scene)?;
    with_damping(scene.with_damping(any())?)
}

fn terms<T: Nodes<5>>() -> Result<(), InputError> {
    keep(HystereticDamping::<T>::new(any())?);
    keep(Ring::<T>::new(any(), any())?);
    keep(Peeling::new(Coulomb::<T>::new(any())?, any())?);
    keep(ConstantForce::<T>::new(any())?);
    keep(Dmt::<T>::new(any())?);
    keep(ViscoelasticDamping::<T>::new(any())?);
    keep(ConstantDamping::<T>::new(any())?);
    let law = HertzLaw::new(Stiffness::new(any::<T>())?).with_damping(any())?.with_ring(any(), any())?;
    keep(law.with_external_force(any())?);
    let sphere = Sphere::solid(any(), any())?;
    keep((law.contact_radius_at(&sphere, any()), law.elastic_force_at(&sphere, any())));
    Ok(())
}

fn with_every_term<const N: usize, T: Nodes<N>>(scene: &Elastic<T>) -> Result<(), InputError> {
    let normal = scene.with_damping(any())?.with_ring(any(), any())?.with_external_force(any())?;
    let planar = normal.with_friction(any())?.with_peeling(any())?;
    let method = Collocation::<N, T>::new(any())?;
    let (_, _, motion) = motions(scene.sphere())?;
    contact(&planar.solve_normal(&motion, &method)?);
    let budgeted = method.with_budget(black_box(20));
    keep(budgeted.intervals());
    contact(&planar.solve_normal(&motion, &budgeted)?);
    keep(normal.critical_speed(&method)?);
    let mut search = CriticalSpeedSearch::new();
    keep(search.step(black_box(2), &normal, &method)?);
    keep(search.trials());
    everything(&planar, &motion, &method)
}

/// Every output of a scene with friction, alone and to rest.
fn everything<T, L, S>(
    scene: &Contact<T, L, S>,
    motion: &PlanarMotion<T>,
    method: &impl ErrorControl<T>,
) -> Result<(), InputError>
where
    T: Real,
    L: ContactLaw<T>,
    S: Surface<T, PlanarMotion<T>, After = TangentialVelocities<T>>,
    Slip: Output<T, S::Start, Result = SlipHistory<T>>,
    Energy: Output<T, S::Start>,
{
    let (impact, (measures, energy, slip)) =
        scene.solve_for(motion, method, ((Times, Impulses, Works), Energy, Slip))?;
    keep((impact.class(), measures));
    keep(energy);
    self::impact(&impact);
    history(&slip);
    let (_, recorded) = scene.solve_for(motion, method, (Slip, Recording::<16>))?;
    trajectory(&recorded.1);
    let criterion = RestCriterion::new(any(), black_box(1000))?;
    let settled = scene.solve_to_rest(motion, method, &criterion, Recording::<16>)?;
    keep(settled.motion);
    trajectory(&settled.outputs);
    Ok(())
}

fn at_fixed_cost<const N: usize, const M: usize, T>(scene: &Elastic<T>) -> Result<(), InputError>
where
    T: PhaseSamples<N, M> + PhaseSamples<N, 9>,
{
    let method = FixedCost::<N>::new(black_box(3))?;
    let (motion, _, planar) = motions(scene.sphere())?;
    contact(&scene.solve_normal(&motion, &method)?);
    let scene = scene.with_damping(any())?.with_ring(any(), any())?.with_external_force(any())?;
    contact(&scene.solve_normal(&motion, &method)?);
    let method = method.with_outputs::<M>();
    let scene = scene.with_friction(any())?;
    let (impact, outputs) = scene.solve_for(&planar, &method, (Times, Impulses, Works))?;
    keep((impact.class(), outputs));
    self::impact(&impact);
    // With nodes enough, where the slip ends.
    let scene = scene.with_peeling(any())?;
    let (impact, slip) = scene.solve_for(&planar, &method, Slip)?;
    self::impact(&impact);
    history(&slip);
    Ok(())
}

fn with_damping<T, D>(scene: Contact<T, HertzLaw<T, D>>) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: ProportionalDamping<T>,
{
    with_adhesion(scene)?;
    let scene = scene.with_ring(any(), any())?;
    with_adhesion(scene)?;
    let groups: Groups<T> = scene.groups(&motions(scene.sphere())?.0)?;
    keep(groups);
    let scene = scene.with_friction(any())?.with_peeling(any())?;
    let (_, _, planar) = motions(scene.sphere())?;
    solve(&scene, &planar)?;
    solve(&scene.with_external_force(any())?, &planar)
}

fn with_adhesion<T, D, A>(scene: Contact<T, HertzLaw<T, D, A>>) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: Damping<T>,
    A: Attraction<T>,
{
    with_force(scene)?;
    with_force(scene.with_external_force(any())?)
}

fn with_force<T, D, A, X>(scene: Contact<T, HertzLaw<T, D, A, X>>) -> Result<(), InputError>
where
    T: Nodes<5>,
    D: Damping<T>,
    A: Attraction<T>,
    X: Attraction<T>,
{
    let method = Collocation::<5, T>::new(any())?;
    let (normal, oblique, _) = motions(scene.sphere())?;
    contact(&scene.solve_normal(&normal, &method)?);
    solve(&scene.with_friction(any())?, &oblique)
}

/// The other laws and dampings.
fn other_laws<T: AnyNodes>(elastic: &Elastic<T>) -> Result<(), InputError> {
    let sphere = *elastic.sphere();
    let dmt = elastic.with_viscoelastic_damping(any())?.with_dmt(any())?;
    keep(dmt.force(&motions(&sphere)?.0)?.at(any(), any()));
    with_force(dmt)?;
    with_force(elastic.with_constant_damping(any())?.without_tension())?;
    let law = JkrLaw::new(Stiffness::new(any())?, any())?.ending_at(JkrEnd::PullOff);
    keep((law.with_damping(any())?, law.with_viscoelastic_damping(any())?));
    let scene = Contact::new(sphere, law.with_constant_damping(any())?);
    let (normal, oblique, _) = motions(&sphere)?;
    keep(scene.force(&normal)?.at(any(), any()));
    solve(&scene.with_friction(any())?, &oblique)
}

/// A contact that gives sideways.
fn compliant<T: AnyNodes>(elastic: &Elastic<T>) -> Result<(), InputError> {
    let scene = elastic.with_damping(any())?.with_friction(any())?.with_compliance(any())?;
    let scene = scene.with_unloading(black_box(Unloading::Incremental));
    let (_, _, planar) = motions(elastic.sphere())?;
    let (impact, outputs) =
        scene.solve_for(&planar, &Collocation::<7, T>::new(any())?, (Times, (Impulses, Works), Slip, Energy))?;
    keep((impact.class(), outputs));
    let along = impact.tangential;
    keep((along.motion(), along.velocity(), along.spin(), along.slip(), along.impulse_ratio(), along.phases()));
    keep(scene.solve(&planar, &FixedCost::<5>::new(black_box(3))?.with_outputs::<9>())?.class());
    Ok(())
}

/// What all scenes with friction have in common.
fn solve<T, L, S, M>(scene: &Contact<T, L, S>, motion: &M) -> Result<(), InputError>
where
    T: Nodes<5>,
    L: ContactLaw<T>,
    S: Surface<T, M, After = TangentialVelocities<T>>,
    Slip: Output<T, S::Start, Result = SlipHistory<T>>,
    M: Approach<T>,
{
    let method = Collocation::<5, T>::new(any())?;
    impact(&scene.solve(motion, &method)?);
    let (impact, slip) = scene.solve_for(motion, &method, Slip)?;
    self::impact(&impact);
    history(&slip);
    Ok(())
}

/// Outputs one by one, the method that chooses, and the paper's.
fn outputs<T: AnyNodes>(scene: &Elastic<T>) -> Result<(), InputError> {
    let normal = scene.with_damping(any())?.with_ring(any(), any())?.with_external_force(any())?;
    let (oblique, (straight, moved, spun)) = (normal.with_friction(any())?, motions(scene.sphere())?);
    let method = Collocation::<5, T>::new(any())?;
    let (_, each) = normal.solve_for(&straight, &method, (Times, (Impulses, Works), Energy))?;
    keep(each);
    let (_, each) = oblique.solve_for(&moved, &method, (Times, Impulses, Works, Slip))?;
    keep(each);

    let class: Option<Classification<T, ContactClass<T>>> = oblique.classify(&moved, &method)?;
    keep(class);

    let adaptive = Adaptive::new(any())?;
    everything(&oblique, &spun, &adaptive)?;
    keep(oblique.critical_speed(&adaptive)?);

    let method = RungeKuttaGill::new(black_box(100));
    keep(normal.solve_for(&straight, &method, (Times, Impulses, Works))?.1);
    contact(&normal.solve_normal(&straight, &method)?);
    history(&oblique.solve_for(&moved, &method, Slip)?.1);
    history(&oblique.with_peeling(any())?.solve_for(&spun, &method, Slip)?.1);
    Ok(())
}

fn chosen_at_run_time<T: AnyNodes>() -> Result<(), InputError> {
    let sphere = Sphere::solid(any(), any())?;
    let (stiffness, (_, _, planar)) = (Stiffness::new(any())?, motions(&sphere)?);
    let law = match black_box(0) {
        0 => AnyLaw::hertz(stiffness),
        1 => AnyLaw::ring(stiffness, any(), any())?,
        2 => AnyLaw::dmt(stiffness, any())?,
        3 => AnyLaw::without_tension(stiffness),
        _ => AnyLaw::jkr(stiffness, any(), JkrEnd::SnapOff)?,
    };
    let law = match black_box(0) {
        0 => law.with_damping(any())?,
        1 => law.with_viscoelastic_damping(any())?,
        _ => law.with_constant_damping(any())?,
    };
    let scene = Contact::new(sphere, law.with_external_force(any())?).with_friction(any())?;
    keep(scene.law());
    solve(&scene, &planar)?;
    solve(&scene.with_peeling(any())?, &planar)?;
    contact(&scene.solve_normal(&planar, &FixedCost::<5>::new(black_box(3))?)?);
    keep(scene.critical_speed(&Collocation::<5, T>::new(any())?)?);
    Ok(())
}

#[inline(never)]
fn contact<T: Real>(contact: &NormalContact<T>) {
    keep((contact.outcome(), contact.overall_restitution(), contact.rebound_speed()));
    keep((contact.peak_indentation(), contact.turning_indentation(), contact.status()));
}

#[inline(never)]
fn impact<T: Real>(impact: &SimulatedImpact<T, TangentialVelocities<T>>) {
    report(&impact.run);
    contact(&impact.normal);
    let after = &impact.tangential;
    keep((impact.class(), after.motion(), after.velocity(), after.spin(), after.friction_over_limit()));
}

#[inline(never)]
fn history<T: Real>(slip: &SlipHistory<T>) {
    keep((*slip, slip.rotation_degrees()));
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
