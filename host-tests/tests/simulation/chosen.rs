//! A law that is chosen at run time gives what the typed law gives, to the last bit.

use std::fmt::Debug;

use microimpact::contact::{
    Adaptive, AdaptiveNodes, AnyLaw, Collocation, Contact, ContactLaw, Energy, FixedCost, HertzLaw, Impulses, JkrEnd,
    JkrLaw, Output, PhaseSamples, Recording, RestCriterion, RungeKuttaGill, Slip, Surface, Times, Works,
};
use microimpact::{InputError, NormalMotion, PlanarMotion, Sphere, Stiffness};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::repetitions;

/// A number type with the tables of all methods here.
trait Number: AdaptiveNodes + PhaseSamples<7, 11> + Debug {}

impl Number for f32 {}
impl Number for f64 {}

/// Sizes of all terms; which of them a scene has is not part of it.
#[derive(Clone, Copy, Debug)]
struct Inputs {
    radius: f64,
    stiffness: f64,
    zeta_h: f64,
    strength: f64,
    zeta_a: f64,
    friction: f64,
    peeling: f64,
    force: f64,
    speed: f64,
    tangential: f64,
    peripheral: f64,
}

impl Inputs {
    fn random(random: &mut StdRng) -> Self {
        let inwards = random.random();
        let mut decades = |from: f64, to: f64| 10f64.powf(random.random_range(from..to));
        Self {
            radius: decades(-7.0, -4.0),
            stiffness: decades(8.0, 11.0),
            zeta_h: decades(-2.0, 2.0),
            strength: decades(0.0, 3.0),
            zeta_a: decades(-2.0, 2.0),
            friction: decades(-2.0, 0.0),
            peeling: decades(-16.0, -11.0),
            force: if inwards { -decades(-9.0, -5.0) } else { decades(-9.0, -5.0) },
            speed: decades(-2.0, 2.0),
            tangential: decades(-2.0, 2.0),
            peripheral: decades(-2.0, 2.0),
        }
    }
}

/// All of a result in words that differ if a bit does.
fn told(result: impl Debug) -> String {
    format!("{result:?}")
}

/// Compares two scenes by each method, in all that they can be asked for.
fn compare<T, L, S, O>(
    typed: &Contact<T, L, S>,
    chosen: &Contact<T, AnyLaw<T>, S>,
    motion: &PlanarMotion<T>,
    outputs: O,
) where
    T: Number,
    L: ContactLaw<T> + Debug,
    S: Surface<T, PlanarMotion<T>, After: Debug> + Debug,
    O: Output<T, S::Start, Result: Debug> + Copy,
{
    let c = T::constant;
    let agree = |found: [String; 2]| assert_eq!(found[0], found[1], "{typed:?}, {motion:?}");
    let controlled = Collocation::<9, T>::new(c(1e-6)).unwrap();
    let criterion = RestCriterion::new(c(1e-3), 100).unwrap();
    agree([
        told(typed.solve_to_rest(motion, &controlled, &criterion, outputs)),
        told(chosen.solve_to_rest(motion, &controlled, &criterion, outputs)),
    ]);
    agree([told(typed.critical_speed(&controlled)), told(chosen.critical_speed(&controlled))]);
    let fixed = FixedCost::<7>::new(4).unwrap().with_outputs::<11>();
    agree([told(typed.solve_for(motion, &fixed, outputs)), told(chosen.solve_for(motion, &fixed, outputs))]);
    let stepped = RungeKuttaGill::new(50);
    agree([told(typed.solve_for(motion, &stepped, outputs)), told(chosen.solve_for(motion, &stepped, outputs))]);
    // With every output it would take the compiler minutes: it contains every number of nodes.
    let adaptive = Adaptive::new(c(1e-5)).unwrap();
    agree([told(typed.solve_normal(motion, &adaptive)), told(chosen.solve_normal(motion, &adaptive))]);
}

/// Hertz's contact and the ring of a number type, with and without damping and an external force, friction and peeling.
fn compare_laws<T: Number>(inputs: &Inputs) -> Result<(), InputError> {
    const ALL: ((Times, Impulses, Works), Energy, Slip) = ((Times, Impulses, Works), Energy, Slip);
    let c = T::constant;
    let (sphere, stiffness) = (Sphere::solid(c(inputs.radius), c(2600.0))?, Stiffness::new(c(inputs.stiffness))?);
    let (zeta_h, strength, zeta_a) = (c(inputs.zeta_h), c(inputs.strength), c(inputs.zeta_a));
    let (force, friction, peeling) = (c(inputs.force), c(inputs.friction), c(inputs.peeling));
    let motion = NormalMotion::new(c(inputs.speed))?
        .with_tangential(c(inputs.tangential))?
        .with_peripheral_velocity(c(inputs.peripheral))?;
    let any = |law: AnyLaw<T>| Contact::new(sphere, law).with_friction(friction);

    let (typed, chosen) = (Contact::hertz(sphere, stiffness).with_friction(friction)?, AnyLaw::hertz(stiffness));
    compare(&typed, &any(chosen)?, &motion, ALL);
    let (typed, chosen) = (typed.with_damping(zeta_h)?, chosen.with_damping(zeta_h)?);
    compare(&typed, &any(chosen)?, &motion, ALL);
    let (pulled, chosen) = (typed.with_external_force(force)?, chosen.with_external_force(force)?);
    compare(&pulled, &any(chosen)?, &motion, ALL);

    let typed = Contact::hertz(sphere, stiffness).with_friction(friction)?.with_ring(strength, zeta_a)?;
    let chosen = AnyLaw::ring(stiffness, strength, zeta_a)?;
    compare(&typed, &any(chosen)?, &motion, ALL);
    let (typed, chosen) = (typed.with_damping(zeta_h)?, chosen.with_damping(zeta_h)?);
    compare(&typed, &any(chosen)?, &motion, ALL);
    compare(&typed.with_peeling(peeling)?, &any(chosen)?.with_peeling(peeling)?, &motion, ALL);
    let (pulled, any_pulled) = (typed.with_external_force(force)?, chosen.with_external_force(force)?);
    compare(&pulled, &any(any_pulled)?, &motion, ALL);

    let straight = Contact::hertz(sphere, stiffness).with_damping(zeta_h)?.with_ring(strength, zeta_a)?;
    compare(&straight, &Contact::new(sphere, chosen), &motion, (Times, Impulses, Works, (Energy, Recording::<8>)));
    Ok(())
}

/// Compares two scenes without friction by one method.
fn compare_along_the_normal<L: ContactLaw<f64> + Debug>(typed: L, chosen: AnyLaw<f64>, inputs: &Inputs) {
    let (sphere, motion) = (Sphere::solid(inputs.radius, 2600.0).unwrap(), NormalMotion::new(inputs.speed).unwrap());
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    let (typed, chosen) = (Contact::new(sphere, typed), Contact::new(sphere, chosen));
    let found = told(typed.solve_for(&motion, &method, Times));
    assert_eq!(found, told(chosen.solve_for(&motion, &method, Times)), "{typed:?}, {motion:?}");
    assert_eq!(told(typed.critical_speed(&method)), told(chosen.critical_speed(&method)), "{typed:?}");
}

/// Every other law once, and every damping.
fn compare_other_laws(inputs: &Inputs) -> Result<(), InputError> {
    let Inputs { zeta_h, strength, zeta_a, force, .. } = *inputs;
    let (time, e) = (1e-10 * zeta_h, 1.0 / (1.0 + zeta_a));
    let (work, end) = (1e-3 * strength, JkrEnd::PullOff);
    let stiffness = Stiffness::new(inputs.stiffness)?;
    let (hertz, any) = (HertzLaw::new(stiffness), AnyLaw::hertz(stiffness));
    compare_along_the_normal(hertz.with_constant_damping(e)?, any.with_constant_damping(e)?, inputs);
    let (ring, any) = (hertz.with_ring(strength, zeta_a)?, AnyLaw::ring(stiffness, strength, zeta_a)?);
    compare_along_the_normal(ring.with_viscoelastic_damping(time)?, any.with_viscoelastic_damping(time)?, inputs);
    compare_along_the_normal(ring.with_constant_damping(e)?, any.with_constant_damping(e)?, inputs);
    let (dmt, any) = (hertz.with_dmt(work)?, AnyLaw::dmt(stiffness, work)?);
    compare_along_the_normal(dmt.with_damping(zeta_h)?, any.with_damping(zeta_h)?, inputs);
    let (pulled, any) = (dmt.with_external_force(force)?, any.with_external_force(force)?);
    compare_along_the_normal(pulled.with_constant_damping(e)?, any.with_constant_damping(e)?, inputs);
    let (ends, any) = (hertz.with_viscoelastic_damping(time)?.without_tension(), AnyLaw::without_tension(stiffness));
    compare_along_the_normal(ends, any.with_viscoelastic_damping(time)?, inputs);
    let (jkr, any) = (JkrLaw::new(stiffness, work)?, AnyLaw::jkr(stiffness, work, JkrEnd::SnapOff)?);
    compare_along_the_normal(jkr, any, inputs);
    compare_along_the_normal(jkr.with_damping(zeta_h)?, any.with_damping(zeta_h)?, inputs);
    let (pulled_off, any) = (jkr.ending_at(end), AnyLaw::jkr(stiffness, work, end)?);
    compare_along_the_normal(pulled_off.with_viscoelastic_damping(time)?, any.with_viscoelastic_damping(time)?, inputs);
    compare_along_the_normal(pulled_off.with_constant_damping(e)?, any.with_constant_damping(e)?, inputs);
    Ok(())
}

#[test]
fn chosen_laws_agree_with_typed_ones_to_the_last_bit() -> Result<(), InputError> {
    let mut random = StdRng::seed_from_u64(12);
    for _ in 0..repetitions(2000, 100) {
        let inputs = Inputs::random(&mut random);
        compare_laws::<f64>(&inputs)?;
        compare_laws::<f32>(&inputs)?;
        compare_other_laws(&inputs)?;
    }
    Ok(())
}
