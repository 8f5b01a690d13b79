//! Probabilities of classes against Monte Carlo, and the two normal distributions against quadrature.

use microimpact::contact::{
    Collocation, Contact, ContactImpulses, Impulses, Nodes, RingScene, SimulatedImpact, TangentialVelocities,
};
use microimpact::measure::{ClassProbabilities, NormalDistribution, rebound_probability, stopped_slip};
use microimpact::{
    Approach, Class, Coulomb, CriticalSpeed, Dual, InputError, NormalMotion, ObliqueMotion, Outcome, PlanarMotion,
    Real, RigidBody, SpeedRestitution, Sphere, Stiffness,
};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution, StandardNormal};

/// Speed, tangential velocity, peripheral velocity, friction, work of adhesion, k, radius.
type Inputs<T> = [T; 7];

type Body<T> = RigidBody<T, SpeedRestitution<T>, microimpact::rigid::WorkOfAdhesion<T>>;

fn body<T: Real>(inputs: Inputs<T>) -> Result<(Body<T>, PlanarMotion<T>), InputError> {
    let [speed, tangential, peripheral, _, work, k, radius] = inputs;
    let sphere = Sphere::solid(radius, T::constant(2600.0))?;
    let scene = RigidBody::new(sphere, SpeedRestitution::new(k)?).with_work_of_adhesion(work)?;
    let motion = NormalMotion::new(speed)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
    Ok((scene, motion))
}

fn predicted(inputs: Inputs<f64>, errors: &Inputs<f64>) -> Result<ClassProbabilities<f64>, InputError> {
    let inputs = Dual::variables(inputs);
    let (scene, motion) = body(inputs)?;
    let normal = scene.impact(&motion.normal()).normal;
    let change = normal.approach_speed() + normal.rebound_speed();
    let stopped = stopped_slip(scene.sphere(), &Coulomb::new(inputs[3])?, change);
    ClassProbabilities::new(&motion, &scene.critical_speed(), stopped, errors)
}

fn class(inputs: Inputs<f64>) -> Result<Class, InputError> {
    let (scene, motion) = body(inputs)?;
    Ok(scene.with_friction(inputs[3])?.classify(&motion).class())
}

fn drawn<const N: usize>(random: &mut StdRng, inputs: [f64; N], errors: &[f64; N]) -> [f64; N] {
    let mut inputs = inputs;
    for (input, error) in inputs.iter_mut().zip(errors) {
        let deviation: f64 = StandardNormal.sample(random);
        *input += error * deviation;
    }
    inputs
}

const CLASSES: [Class; 4] =
    [Class::ReboundSliding, Class::ReboundRolling, Class::CapturedSliding, Class::CapturedRolling];

#[test]
fn classes_of_the_rigid_body_model() -> Result<(), InputError> {
    const DRAWS: usize = 40_000;
    let errors = [0.08, 0.05, 0.1, 0.002, 0.1e-12, 5.0, 0.05e-6];
    let mut random = StdRng::seed_from_u64(2);
    for inputs in [
        [2.8, 0.0, 0.739, 0.1, 2.22e-12, 130.0, 5.06e-6],
        [2.8, 0.0, 1.7, 0.1, 2.22e-12, 130.0, 5.06e-6],
        [1.85, 0.7, 0.0, 0.1, 2.22e-12, 130.0, 5.06e-6],
        [1.9, -1.0, 0.0, 0.12, 2.22e-12, 130.0, 5.06e-6],
        // Slips of either sign may be too large.
        [2.8, 0.05, 0.0, 0.012, 2.22e-12, 130.0, 5.06e-6],
        [1.2, 0.5, 0.2, 0.1, 2.22e-12, 130.0, 5.06e-6],
    ] {
        let probabilities = predicted(inputs, &errors)?;
        let mut counts = [0; 4];
        for _ in 0..DRAWS {
            let class = match class(drawn(&mut random, inputs, &errors))? {
                Class::CapturedResting => Class::CapturedRolling,
                class => class,
            };
            counts[CLASSES.iter().position(|other| *other == class).unwrap()] += 1;
        }
        let total: f64 = CLASSES.iter().map(|class| probabilities.of(*class)).sum();
        assert!((total - 1.0).abs() < 1e-12);
        for (class, count) in CLASSES.into_iter().zip(counts) {
            let (share, probability) = (count as f64 / DRAWS as f64, probabilities.of(class));
            assert!(
                (0.0..=1.0).contains(&probability) && (share - probability).abs() < 0.03,
                "{inputs:?}: {class} {share} {probability}"
            );
        }
    }
    Ok(())
}

/// Speed, radius, stiffness, f0, zeta_H, zeta_A.
fn contact<T: Real>(inputs: [T; 6]) -> Result<(RingScene<T>, NormalMotion<T>), InputError> {
    let [speed, radius, stiffness, f0, zeta_h, zeta_a] = inputs;
    let scene = Contact::hertz(Sphere::solid(radius, T::constant(2600.0))?, Stiffness::new(stiffness)?)
        .with_damping(zeta_h)?
        .with_ring(f0, zeta_a)?;
    Ok((scene, NormalMotion::new(speed)?))
}

fn method<T: Nodes<9>>() -> Result<Collocation<9, T>, InputError> {
    Collocation::new(T::constant(1e-9))
}

#[test]
fn outcomes_of_the_simulation() -> Result<(), InputError> {
    const DRAWS: usize = 10_000;
    let errors = [0.05, 0.02e-6, 1e9, 3.0, 0.3, 0.15];
    let mut random = StdRng::seed_from_u64(4);
    for speed in [5.0, 5.16, 5.4] {
        let inputs = [speed, 2.5e-6, 7.5e10, 250.0, 10.5, 6.25];
        let (scene, motion) = contact(Dual::variables(inputs))?;
        let critical = scene.critical_speed(&method()?)?;
        let probability = rebound_probability(motion.speed(), &critical, &errors)?;
        let mut rebounds = 0;
        for _ in 0..DRAWS {
            let (scene, motion) = contact(drawn(&mut random, inputs, &errors))?;
            rebounds += usize::from(scene.solve_normal(&motion, &method()?)?.outcome() == Some(Outcome::Rebound));
        }
        let share = rebounds as f64 / DRAWS as f64;
        assert!((share - probability).abs() < 0.02, "{speed}: {share} {probability}");
        assert!((0.1..0.9).contains(&probability) || speed != 5.16);
    }
    Ok(())
}

/// Whether a simulated sphere slides: friction goes by the impulse of the elastic force.
#[test]
fn sliding_in_the_simulation() -> Result<(), InputError> {
    const DRAWS: usize = 5_000;
    // The six inputs of the contact, then tangential velocity and friction.
    let (inputs, errors) =
        ([2.8, 5.06e-6, 7.5e10, 250.0, 10.5, 6.25, 0.0, 0.1], [0.05, 0.02e-6, 5e8, 3.0, 0.3, 0.2, 0.1, 0.004]);
    type Solved<T> = (SimulatedImpact<T, TangentialVelocities<T>>, ContactImpulses<T>);
    fn solved<T: Nodes<9>>(inputs: [T; 8]) -> Result<(ObliqueMotion<T>, Solved<T>, Sphere<T>), InputError> {
        let [speed, radius, stiffness, f0, zeta_h, zeta_a, tangential, friction] = inputs;
        let (scene, motion) = contact([speed, radius, stiffness, f0, zeta_h, zeta_a])?;
        let motion = motion.with_tangential(tangential)?;
        let solved = scene.with_friction(friction)?.solve_for(&motion, &method()?, Impulses)?;
        Ok((motion, solved, *scene.sphere()))
    }
    let mut random = StdRng::seed_from_u64(8);
    for tangential in [6.1, 6.3, 6.6] {
        let mut inputs = inputs;
        inputs[6] = tangential;
        let variables = Dual::variables(inputs);
        let (motion, (_, impulses), sphere) = solved(variables)?;
        let change = impulses.elastic / sphere.mass();
        let stopped = stopped_slip(&sphere, &Coulomb::new(variables[7])?, change);
        let always = CriticalSpeed::AlwaysRebounds;
        let probability = ClassProbabilities::new(&motion, &always, stopped, &errors)?.of(Class::ReboundSliding);
        let mut sliding = 0;
        for _ in 0..DRAWS {
            let (_, (impact, _), _) = solved(drawn(&mut random, inputs, &errors))?;
            sliding += usize::from(impact.class() == Some(Class::ReboundSliding));
        }
        let share = sliding as f64 / DRAWS as f64;

        assert!(
            (0.1..0.9).contains(&probability) && (share - probability).abs() < 0.03,
            "{tangential}: {share} {probability}"
        );
    }
    Ok(())
}

/// Standard errors of e by derivatives and by Monte Carlo.
#[test]
fn standard_error_of_restitution() -> Result<(), InputError> {
    const DRAWS: usize = 10_000;
    let (inputs, errors) = ([2.8, 5.06e-6, 7.5e10, 250.0, 10.5, 6.25], [0.02, 0.02e-6, 5e8, 3.0, 0.3, 0.2]);
    let (scene, motion) = contact(Dual::variables(inputs))?;
    let restitution = scene.solve_normal(&motion, &method()?)?.overall_restitution();
    let mut random = StdRng::seed_from_u64(6);
    let mut square = 0.0;
    for _ in 0..DRAWS {
        let (scene, motion) = contact(drawn(&mut random, inputs, &errors))?;
        let e = scene.solve_normal(&motion, &method()?)?.overall_restitution();
        square += (e - restitution.value).powi(2) / DRAWS as f64;
    }
    let error = restitution.standard_error(&errors);
    assert!((square.sqrt() / error - 1.0).abs() < 0.05, "{} {error}", square.sqrt());
    Ok(())
}

/// Integral of the density of one variable times the probability of the other.
fn by_quadrature(h: f64, k: f64, correlation: f64) -> f64 {
    const STEPS: u32 = 20_000;
    let (low, width) = (-9.0, h.clamp(-9.0, 9.0) + 9.0);
    let rest = (1.0 - correlation * correlation).sqrt();
    let at =
        |x: f64| (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt() * ((k - correlation * x) / rest).below();
    let step = width / f64::from(STEPS);
    (0..STEPS).map(|i| step * at(low + (f64::from(i) + 0.5) * step)).sum()
}

#[test]
fn two_normal_variables() {
    for h in [-2.5_f64, -1.0, 0.0, 0.3, 2.0] {
        for k in [-2.0, -0.5, 0.0, 0.31, 3.0] {
            for correlation in [-0.99, -0.9, -0.4, 0.0, 0.2, 0.7, 0.95, 0.999] {
                let (found, expected) = (h.both_below(k, correlation), by_quadrature(h, k, correlation));
                let bound = if correlation.abs() <= 0.9 { 1e-7 } else { 2e-4 };
                assert!((found - expected).abs() < bound, "{h} {k} {correlation}: {found} {expected}");
                let single = (h as f32).both_below(k as f32, correlation as f32);
                assert!((f64::from(single) - found).abs() < 1e-5);
            }
            assert_eq!(h.both_below(k, 1.0), h.min(k).below());
            assert!((h.both_below(k, -1.0) - (h.below() + k.below() - 1.0).max(0.0)).abs() < 1e-12);
        }
    }
    assert_eq!(f64::MAX.both_below(0.0, 0.5), 0.5);
}
