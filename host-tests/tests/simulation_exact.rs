//! The contact simulation against results that are known exactly, and over twelve decades of every input.

use microimpact::simulation::{Collocation, FixedCost, SimulatedImpact, Simulation, Status, TangentialContact};
use microimpact::{
    CriticalSpeed, InputError, NormalMotion, Outcome, PlanarMotion, Real, Sphere, Stiffness, SurfaceMotion,
};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

const BEST: f64 = 1e-13;

fn method() -> Collocation<14, f64> {
    Collocation::new(BEST).unwrap()
}

fn sphere() -> Sphere<f64> {
    Sphere::solid(5.06e-6, 2600.0).unwrap()
}

fn stiffness() -> Stiffness<f64> {
    Stiffness::new(7.5e10).unwrap()
}

/// C = (m/(r^3 K sqrt(v)))^(2/5), s/m (B4).
fn damping_unit(sphere: &Sphere<f64>, stiffness: Stiffness<f64>, speed: f64) -> f64 {
    (sphere.mass() / (sphere.radius().powi(3) * stiffness.pascals() * speed.sqrt())).powf(0.4)
}

/// The ring force is conservative, so without damping nothing is lost or captured, at any speed.
#[test]
fn no_damping_returns_everything() {
    let free = Simulation::new(sphere(), stiffness());
    let held = free.with_ring(250.0, 0.0).unwrap();
    for decade in -4..=4 {
        let motion = NormalMotion::new(10f64.powi(decade)).unwrap();
        let e = free.normal_impact(&method(), &motion).unwrap().overall_restitution();
        assert!((e - 1.0).abs() < 1e-14, "{decade}: {e}");
        let e = held.normal_impact(&method(), &motion).unwrap().overall_restitution();
        assert!((e - 1.0).abs() < 1e-13, "{decade}: {e}");
    }
}

/// Without adhesion d (1 + e) = ln((1 + d)/(1 - e d)), d = c_H v, whatever stiffness and mass.
#[test]
fn hunt_crossley() {
    let exact = [(0.1, 0.937475580), (0.5, 0.748434932), (1.0, 0.593624260), (2.0, 0.410719686), (10.0, 0.099981625)];
    for (sphere, stiffness) in
        [(sphere(), stiffness()), (Sphere::solid(1e-3, 8000.0).unwrap(), Stiffness::new(1e6).unwrap())]
    {
        for (d, e) in exact {
            let speed = 3.0;
            let zeta = d / (speed * damping_unit(&sphere, stiffness, speed));
            let scene = Simulation::new(sphere, stiffness).with_damping(zeta).unwrap();
            let contact = scene.normal_impact(&method(), &NormalMotion::new(speed).unwrap()).unwrap();
            let found = contact.overall_restitution();
            assert!((found - e).abs() < 6e-10, "{d}: {found}");
            let residual = d * (1.0 + found) - ((1.0 + d) / (1.0 - found * d)).ln();
            assert!(residual.abs() < 1e-10 * d.max(1.0 / (1.0 - found * d)), "{d}: {residual}");
        }
    }
}

/// However strong the damping, the sphere comes back, and never faster than 1/c_H.
#[test]
fn strong_damping_has_no_cliff() {
    for decade in 0..=6 {
        let d = 10f64.powi(decade);
        let zeta = d / damping_unit(&sphere(), stiffness(), 1.0);
        let scene = Simulation::new(sphere(), stiffness()).with_damping(zeta).unwrap();
        let impact = scene.impact(&method(), &NormalMotion::new(1.0).unwrap()).unwrap();
        assert_eq!(impact.run.status, Status::Solved);
        assert_eq!(impact.normal.outcome(), Some(Outcome::Rebound));
        let speed = impact.normal.rebound_speed();
        assert!(speed <= (1.0 + 1e-9) / d, "{d}: {speed}");
        // ln((1 + d)/(1 - e d)) = d (1 + e), solved for 1 - e d.
        let exact = (1.0 - (1.0 + d) * (-d * (1.0 + speed)).exp()) / d;
        assert!((speed / exact - 1.0).abs() < 1e-9, "{d}: {speed} against {exact}");
    }
}

/// Peaks of the undamped motion with adhesion, in units of the equilibrium indentation.
#[test]
fn undamped_peaks() {
    let equilibrium = 2.0 * std::f64::consts::PI * 250.0 / 7.5e10;
    let (r, k) = (5.06e-6_f64, 7.5e10);
    let unit = equilibrium * (k * (r * equilibrium).sqrt() / sphere().mass()).sqrt();
    let scene = Simulation::new(sphere(), stiffness()).with_ring(250.0, 0.0).unwrap();
    for (v, x) in [(0.5, 1.79645), (1.0, 2.08258), (3.0, 3.43431), (1e-4, 5.0 / 3.0)] {
        let contact = scene.normal_impact(&method(), &NormalMotion::new(v * unit).unwrap()).unwrap();
        let peak = contact.peak_indentation().unwrap() / equilibrium;
        assert!((peak - x).abs() < 6e-6, "{v}: {peak}");
        let (root, energy) = (peak.sqrt(), v * v / 2.0);
        let potential = 0.4 * peak * peak * root - 2.0 / 3.0 * peak * root;
        assert!((potential - energy).abs() < 1e-12, "{v}: {potential}");
    }
}

/// The tangential impulse at which slip ends and the final rolling velocity do not depend on the force law.
#[test]
fn rolling_is_independent_of_the_force_law() {
    let free = Simulation::new(sphere(), stiffness()).with_friction(0.3).unwrap();
    let held = Simulation::new(sphere(), stiffness())
        .with_damping(10.5)
        .and_then(|scene| scene.with_ring(250.0, 6.25))
        .and_then(|scene| scene.with_friction(0.3))
        .unwrap();
    let motion = planar(2.8, 1.0, -0.5);
    let expected = (5.0 * 1.0 + 2.0 * -0.5) / 7.0;
    for contact in
        [free.impact(&method(), &motion).unwrap().tangential, held.impact(&method(), &motion).unwrap().tangential]
    {
        assert_eq!(contact.motion(), SurfaceMotion::Rolling);
        assert!((contact.velocity() - expected).abs() < 1e-14);
        assert!((contact.spin() * 5.06e-6 - expected).abs() < 1e-14);
    }
}

/// Without adhesion and damping the elastic force turns the momentum round, so friction takes f times twice of it.
#[test]
fn sliding_impulse() {
    let scene = Simulation::new(sphere(), stiffness()).with_friction(0.05).unwrap();
    let contact = scene.impact(&method(), &planar(2.0, 5.0, 0.0)).unwrap().tangential;
    assert_eq!(contact.motion(), SurfaceMotion::Sliding);
    assert!((contact.velocity() - (5.0 - 0.05 * 4.0)).abs() < 1e-12);
    assert!((contact.spin() * 5.06e-6 - 2.5 * 0.05 * 4.0).abs() < 1e-12);
}

/// The same dimensionless scene in other units has the same restitution.
#[test]
fn similar_scenes_agree() {
    let e = |sphere: Sphere<f64>, stiffness: Stiffness<f64>, strength: f64, speed: f64| {
        let scene = Simulation::new(sphere, stiffness).with_damping(10.5).unwrap().with_ring(strength, 6.25).unwrap();
        scene.normal_impact(&method(), &NormalMotion::new(speed).unwrap()).unwrap().overall_restitution()
    };
    let expected = e(sphere(), stiffness(), 250.0, 2.8);
    // All lengths times 100; and stiffness, strength and density times 9.
    let large = Sphere::solid(5.06e-4, 2600.0).unwrap();
    assert!((e(large, stiffness(), 25_000.0, 2.8) - expected).abs() < 1e-13);
    let dense = Sphere::solid(5.06e-6, 9.0 * 2600.0).unwrap();
    assert!((e(dense, Stiffness::new(9.0 * 7.5e10).unwrap(), 9.0 * 250.0, 2.8) - expected).abs() < 1e-13);
}

/// A force out of the surface lets go earlier than one into it, by the energy that it does not take back.
#[test]
fn constant_force_is_conservative() {
    let motion = NormalMotion::new(2.8).unwrap();
    let free = Simulation::new(sphere(), stiffness());
    let undisturbed = free.impact(&method(), &motion).unwrap();
    for force in [-1e-5, 1e-5] {
        let scene = free.with_external_force(force).unwrap();
        let impact = scene.impact(&method(), &motion).unwrap();
        assert!((impact.normal.overall_restitution() - 1.0).abs() < 1e-13);
        let deeper = impact.normal.peak_indentation() > undisturbed.normal.peak_indentation();
        assert_eq!(deeper, force < 0.0);
        // The elastic impulse makes up for that of the force.
        let turned = 2.0 * sphere().mass() * 2.8 - force * impact.outputs.times.contact.unwrap();
        assert!((impact.outputs.impulses.elastic / turned - 1.0).abs() < 1e-12);
    }
}

/// A force out of the surface raises a barrier before separation: what cannot pass it is captured, and no method may
/// call that a rebound.
#[test]
fn force_out_of_the_surface_is_a_barrier() {
    let sphere = Sphere::solid(5e-6, 2600.0).unwrap();
    let scene = Simulation::new(sphere, stiffness()).with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
    for force in [1e-4, 1.5e-4] {
        let scene = scene.with_external_force(force).unwrap();
        let CriticalSpeed::At(critical) = scene.critical_speed(&method()).unwrap() else {
            panic!("{force}: no critical speed");
        };
        for (share, outcome) in [(0.98, Outcome::Capture), (0.8, Outcome::Capture), (1.02, Outcome::Rebound)] {
            let motion = NormalMotion::new(share * critical).unwrap();
            let exact = scene.normal_impact(&method(), &motion).unwrap();
            assert_eq!((exact.status(), exact.outcome()), (Status::Solved, Some(outcome)), "{force}, {share}");
            let quick = scene.normal_impact(&FixedCost::<8>::new(12).unwrap(), &motion).unwrap();
            assert!(
                quick.status() != Status::Solved || quick.outcome() == Some(outcome),
                "{force}, {share}: {quick:?}"
            );
        }
        // Slower spheres turn back in front of the barrier.
        let reflected = scene.normal_impact(&method(), &NormalMotion::new(0.01).unwrap()).unwrap();
        assert_eq!((reflected.status(), reflected.outcome()), (Status::Solved, Some(Outcome::Rebound)));
        assert!(reflected.overall_restitution() > 0.99, "{force}: {reflected:?}");
    }
}

fn planar<T: Real>(speed: T, tangential: T, peripheral: T) -> PlanarMotion<T> {
    let oblique = NormalMotion::new(speed).unwrap().with_tangential(tangential).unwrap();
    oblique.with_peripheral_velocity(peripheral).unwrap()
}

/// A scene of powers of ten.
#[derive(Clone, Copy, Debug)]
struct Decades {
    radius: f64,
    density: f64,
    stiffness: f64,
    strength: f64,
    zeta_h: f64,
    zeta_a: f64,
    friction: f64,
    speed: f64,
    tangential: f64,
    peripheral: f64,
}

impl Decades {
    fn simulate<const N: usize, T: microimpact::simulation::Nodes<N>>(
        &self,
        tolerance: f64,
    ) -> Result<SimulatedImpact<T, TangentialContact<T>>, InputError> {
        let power = |decade: f64| T::constant(10f64.powf(decade));
        let motion = NormalMotion::new(power(self.speed))?
            .with_tangential(power(self.tangential))?
            .with_peripheral_velocity(-power(self.peripheral))?;
        Simulation::new(Sphere::solid(power(self.radius), power(self.density))?, Stiffness::new(power(self.stiffness))?)
            .with_damping(power(self.zeta_h))?
            .with_ring(power(self.strength), power(self.zeta_a))?
            .with_friction(power(self.friction))?
            .impact(&Collocation::new(T::constant(tolerance))?, &motion)
    }
}

fn decades() -> impl Strategy<Value = Decades> {
    let sphere = (-10.0..0.0, -2.0..6.0, 3.0..15.0);
    let forces = (-6.0..6.0, -6.0..6.0, -6.0..6.0, -6.0..3.0);
    let motion = (-9.0..3.0, -6.0..6.0, -6.0..6.0);
    (sphere, forces, motion).prop_map(
        |((radius, density, stiffness), (strength, zeta_h, zeta_a, friction), (speed, tangential, peripheral))| {
            Decades { radius, density, stiffness, strength, zeta_h, zeta_a, friction, speed, tangential, peripheral }
        },
    )
}

/// Values of an impact that have to be finite whatever the scene.
fn values<T: Real>(impact: &SimulatedImpact<T, TangentialContact<T>>) -> Vec<T> {
    let (normal, tangential, outputs) = (&impact.normal, &impact.tangential, &impact.outputs);
    let optional = [
        normal.peak_indentation(),
        normal.turning_indentation(),
        normal.peak_force(),
        outputs.times.peak,
        outputs.times.contact,
        tangential.rolls_from(),
    ];
    let always = [
        normal.overall_restitution(),
        normal.rebound_speed(),
        outputs.impulses.elastic,
        outputs.impulses.adhesion_rebound,
        outputs.works.material,
        outputs.works.adhesion,
        tangential.velocity(),
        tangential.rotation(),
        tangential.displacement(),
        tangential.spin(),
    ];
    optional.into_iter().flatten().chain(always).collect()
}

/// Whether a result was solved; a named error was not. What is neither ends the test.
fn is_solved<T: Real>(
    decades: &Decades,
    result: &Result<SimulatedImpact<T, TangentialContact<T>>, InputError>,
) -> bool {
    let Ok(impact) = result else {
        return false;
    };
    assert!(values(impact).iter().all(|value| value.is_finite()), "{decades:?} {impact:?}");
    let e = impact.normal.overall_restitution();
    assert!(e >= T::ZERO && e <= T::ONE + T::constant(16.0) * T::EPSILON, "{decades:?} {impact:?}");
    assert!(impact.run.steps + impact.run.refused <= Collocation::<8, T>::MOST_STRETCHES, "{decades:?} {impact:?}");
    impact.run.status == Status::Solved
}

/// Half a million scenes over twelve decades of most inputs, in both precisions, end in a result of finite numbers within the budget, or in a
/// named error; what is solved in both precisions agrees.
#[test]
fn every_scene_ends() {
    const SCENES: u32 = 500_000;
    let (mut runner, strategy) = (TestRunner::deterministic(), decades());
    let (mut solved, mut spent) = (0, 0);
    for _ in 0..SCENES {
        let decades = strategy.new_tree(&mut runner).unwrap().current();
        let (double, single) = (decades.simulate::<7, f64>(1e-6), decades.simulate::<7, f32>(1e-6));
        let both = (is_solved(&decades, &double), is_solved(&decades, &single));
        solved += u32::from(both.0) + u32::from(both.1);
        spent += u32::from(double.is_ok() && !both.0) + u32::from(single.is_ok() && !both.1);
        if let ((true, true), Ok(double), Ok(single)) = (both, double, single) {
            let (e, found) = (double.normal.overall_restitution(), f64::from(single.normal.overall_restitution()));
            assert!((e * e - found * found).abs() < 1e-4, "{decades:?}: {e} against {found}");
        }
    }
    println!("{solved} solved, {spent} with the budget spent, of {}", 2 * SCENES);
    assert!(solved > SCENES);
    assert_eq!(spent, 0);
}
