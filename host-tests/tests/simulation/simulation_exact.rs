//! The contact simulation against results that are known exactly, and over twelve decades of every input.

use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;

use crate::everything::{EVERYTHING, Impact};
use microimpact::contact::{Adaptive, Collocation, Contact, FixedCost, Impulses, Method, Slip, Status, Times};
use microimpact::{
    CriticalSpeed, InputError, NormalMotion, Outcome, PlanarMotion, Real, Sphere, Stiffness, SurfaceMotion,
};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::repetitions;

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
    let free = Contact::hertz(sphere(), stiffness());
    let held = free.with_ring(250.0, 0.0).unwrap();
    for decade in -4..=4 {
        let motion = NormalMotion::new(10f64.powi(decade)).unwrap();
        let e = free.solve_normal(&motion, &method()).unwrap().overall_restitution();
        assert!((e - 1.0).abs() < 1e-14, "{decade}: {e}");
        let e = held.solve_normal(&motion, &method()).unwrap().overall_restitution();
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
            let scene = Contact::hertz(sphere, stiffness).with_damping(zeta).unwrap();
            let contact = scene.solve_normal(&NormalMotion::new(speed).unwrap(), &method()).unwrap();
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
        let scene = Contact::hertz(sphere(), stiffness()).with_damping(zeta).unwrap();
        let impact = scene.solve(&NormalMotion::new(1.0).unwrap(), &method()).unwrap();
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
    let scene = Contact::hertz(sphere(), stiffness()).with_ring(250.0, 0.0).unwrap();
    for (v, x) in [(0.5, 1.79645), (1.0, 2.08258), (3.0, 3.43431), (1e-4, 5.0 / 3.0)] {
        let contact = scene.solve_normal(&NormalMotion::new(v * unit).unwrap(), &method()).unwrap();
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
    let free = Contact::hertz(sphere(), stiffness()).with_friction(0.3).unwrap();
    let held = Contact::hertz(sphere(), stiffness())
        .with_damping(10.5)
        .and_then(|scene| scene.with_ring(250.0, 6.25))
        .and_then(|scene| scene.with_friction(0.3))
        .unwrap();
    let motion = planar(2.8, 1.0, -0.5);
    let expected = (5.0 * 1.0 + 2.0 * -0.5) / 7.0;
    for (impact, slip) in
        [free.solve_for(&motion, &method(), Slip).unwrap(), held.solve_for(&motion, &method(), Slip).unwrap()]
    {
        let contact = impact.tangential;
        assert_eq!((contact.motion(), slip.slides), (SurfaceMotion::Rolling, false));
        for (velocity, spin) in [(contact.velocity(), contact.spin()), (slip.velocity, slip.spin)] {
            assert!((velocity - expected).abs() < 1e-14);
            assert!((spin * 5.06e-6 - expected).abs() < 1e-14);
        }
    }
}

/// Without adhesion and damping the elastic force turns the momentum round, so friction takes f times twice of it.
#[test]
fn sliding_impulse() {
    let scene = Contact::hertz(sphere(), stiffness()).with_friction(0.05).unwrap();
    let (impact, slip) = scene.solve_for(&planar(2.0, 5.0, 0.0), &method(), Slip).unwrap();
    let contact = impact.tangential;
    assert_eq!((contact.motion(), slip.slides), (SurfaceMotion::Sliding, true));
    for (velocity, spin) in [(contact.velocity(), contact.spin()), (slip.velocity, slip.spin)] {
        assert!((velocity - (5.0 - 0.05 * 4.0)).abs() < 1e-12);
        assert!((spin * 5.06e-6 - 2.5 * 0.05 * 4.0).abs() < 1e-12);
    }
}

/// The same dimensionless scene in other units has the same restitution.
#[test]
fn similar_scenes_agree() {
    let e = |sphere: Sphere<f64>, stiffness: Stiffness<f64>, strength: f64, speed: f64| {
        let scene = Contact::hertz(sphere, stiffness).with_damping(10.5).unwrap().with_ring(strength, 6.25).unwrap();
        scene.solve_normal(&NormalMotion::new(speed).unwrap(), &method()).unwrap().overall_restitution()
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
    let free = Contact::hertz(sphere(), stiffness());
    let undisturbed = free.solve_normal(&motion, &method()).unwrap();
    for force in [-1e-5, 1e-5] {
        let scene = free.with_external_force(force).unwrap();
        let (impact, (times, impulses)) = scene.solve_for(&motion, &method(), (Times, Impulses)).unwrap();
        assert!((impact.normal.overall_restitution() - 1.0).abs() < 1e-13);
        let deeper = impact.normal.peak_indentation() > undisturbed.peak_indentation();
        assert_eq!(deeper, force < 0.0);
        // The elastic impulse makes up for that of the force.
        let turned = 2.0 * sphere().mass() * 2.8 - force * times.contact.unwrap();
        assert!((impulses.elastic / turned - 1.0).abs() < 1e-12);
    }
}

/// A force out of the surface raises a barrier before separation: what cannot pass it is captured, and no method may
/// call that a rebound.
#[test]
fn force_out_of_the_surface_is_a_barrier() {
    let sphere = Sphere::solid(5e-6, 2600.0).unwrap();
    let scene = Contact::hertz(sphere, stiffness()).with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
    for force in [1e-4, 1.5e-4] {
        let scene = scene.with_external_force(force).unwrap();
        let CriticalSpeed::At(critical) = scene.critical_speed(&method()).unwrap() else {
            panic!("{force}: no critical speed");
        };
        for (share, outcome) in [(0.98, Outcome::Capture), (0.8, Outcome::Capture), (1.02, Outcome::Rebound)] {
            let motion = NormalMotion::new(share * critical).unwrap();
            let exact = scene.solve_normal(&motion, &method()).unwrap();
            assert_eq!((exact.status(), exact.outcome()), (Status::Solved, Some(outcome)), "{force}, {share}");
            let quick = scene.solve_normal(&motion, &FixedCost::<8>::new(12).unwrap()).unwrap();
            assert!(
                quick.status() != Status::Solved || quick.outcome() == Some(outcome),
                "{force}, {share}: {quick:?}"
            );
        }
        // Slower spheres turn back in front of the barrier.
        let reflected = scene.solve_normal(&NormalMotion::new(0.01).unwrap(), &method()).unwrap();
        assert_eq!((reflected.status(), reflected.outcome()), (Status::Solved, Some(Outcome::Rebound)));
        assert!(reflected.overall_restitution() > 0.99, "{force}: {reflected:?}");
    }
}

fn planar<T: Real>(speed: T, tangential: T, peripheral: T) -> PlanarMotion<T> {
    let oblique = NormalMotion::new(speed).unwrap().with_tangential(tangential).unwrap();
    oblique.with_peripheral_velocity(peripheral).unwrap()
}

/// Without friction the spin decays by exp(-lambda c), with c the same for every peeling moment: from one decay follow all
/// others, slow ones and those that are over within a fraction of the contact.
#[test]
fn spin_without_friction_decays_exponentially() {
    let scene = Contact::hertz(sphere(), stiffness()).with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
    let motion = planar(10.0, 0.0, 1.0);
    let left = |lambda: f64, exact: bool| {
        let scene = scene.with_friction(0.0).unwrap().with_peeling(lambda).unwrap();
        let impact = if exact {
            scene.solve(&motion, &method()).unwrap()
        } else {
            scene.solve(&motion, &Adaptive::new(1e-11).unwrap()).unwrap()
        };
        impact.tangential.spin() * sphere().radius()
    };
    let small = 1e-13;
    let rate = -left(small, true).ln() / small;
    for decay in [0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 1e3, 1e9] {
        let lambda = decay / rate;
        for found in [left(lambda, true), left(lambda, false)] {
            assert!((found - (-decay).exp()).abs() < 1e-9, "{decay}: {found:e}");
        }
    }
}

/// A scene of any inputs.
#[derive(Clone, Copy, Debug)]
struct Inputs {
    radius: f64,
    density: f64,
    gyration: f64,
    stiffness: f64,
    zeta_h: f64,
    strength: f64,
    zeta_a: f64,
    friction: f64,
    peeling: f64,
    force: Option<f64>,
    speed: f64,
    tangential: f64,
    spin: f64,
}

impl Inputs {
    /// Sizes spread evenly over twelve decades, or over the whole range of an input that has fewer; what can be absent is so
    /// in some scenes.
    fn random(random: &mut StdRng) -> Self {
        let mut decades = |from: f64, to: f64| 10f64.powf(random.random_range(from..to));
        let mut inputs = Self {
            radius: decades(-10.0, 0.0),
            density: decades(-2.0, 6.0),
            gyration: decades(-3.0, 0.0),
            stiffness: decades(3.0, 15.0),
            zeta_h: decades(-6.0, 6.0),
            strength: decades(-6.0, 6.0),
            zeta_a: decades(-6.0, 6.0),
            friction: decades(-9.0, 3.0),
            peeling: decades(-24.0, -12.0),
            force: Some(decades(-14.0, -2.0)),
            speed: decades(-9.0, 3.0),
            tangential: decades(-6.0, 6.0),
            spin: decades(-3.0, 9.0),
        };
        for input in [
            &mut inputs.zeta_h,
            &mut inputs.strength,
            &mut inputs.zeta_a,
            &mut inputs.friction,
            &mut inputs.peeling,
            &mut inputs.tangential,
            &mut inputs.spin,
        ] {
            if random.random_ratio(1, 12) {
                *input = 0.0;
            }
        }
        for input in [&mut inputs.tangential, &mut inputs.spin] {
            if random.random() {
                *input = -*input;
            }
        }
        let directions = [None, None, Some(1.0), Some(-1.0)];
        let direction = directions[random.random_range(0..directions.len())];
        inputs.force = inputs.force.zip(direction).map(|(size, direction)| size * direction);
        inputs
    }

    fn simulate<T: Real>(&self, method: &impl Method<T>) -> Result<Impact<T>, InputError> {
        let number = |input: f64| T::constant(input);
        let sphere = Sphere::new(number(self.radius), number(self.density), number(self.gyration))?;
        let motion = NormalMotion::new(number(self.speed))?
            .with_tangential(number(self.tangential))?
            .with_spin(&sphere, number(self.spin))?;
        let scene = Contact::hertz(sphere, Stiffness::new(number(self.stiffness))?)
            .with_damping(number(self.zeta_h))?
            .with_ring(number(self.strength), number(self.zeta_a))?
            .with_friction(number(self.friction))?
            .with_peeling(number(self.peeling))?;
        match self.force {
            Some(force) => scene.with_external_force(number(force))?.solve_for(&motion, method, EVERYTHING),
            None => scene.solve_for(&motion, method, EVERYTHING),
        }
    }
}

/// Values of an impact that have to be finite whatever the scene.
fn values<T: Real>((impact, (times, impulses, works, slip)): &Impact<T>) -> Vec<T> {
    let (normal, tangential) = (&impact.normal, &impact.tangential);
    let optional =
        [normal.peak_indentation(), normal.turning_indentation(), times.peak, times.contact, slip.rolls_from];
    let always = [
        normal.overall_restitution(),
        normal.rebound_speed(),
        impulses.elastic,
        impulses.adhesion_rebound,
        works.material,
        works.adhesion,
        tangential.velocity(),
        tangential.spin(),
        slip.velocity,
        slip.rotation,
        slip.displacement,
        slip.spin,
    ];
    optional.into_iter().flatten().chain(always).collect()
}

/// The restitution of a result that was solved. A named error was not; what is neither ends the test.
fn solved<T: Real>(inputs: &Inputs, result: Result<Impact<T>, InputError>, counts: &mut Counts) -> Option<T> {
    counts.ended += 1;
    let Ok(solved) = result else {
        return None;
    };
    let impact = &solved.0;
    assert!(values(&solved).iter().all(|value| value.is_finite()), "{inputs:?} {impact:?}");
    let e = impact.normal.overall_restitution();
    assert!(e >= T::ZERO && e <= T::ONE + T::constant(16.0) * T::EPSILON, "{inputs:?} {impact:?}");
    assert!(impact.run.steps + impact.run.refused <= Collocation::<8, T>::MOST_INTERVALS, "{inputs:?} {impact:?}");
    if impact.run.status != Status::Solved {
        // Only where a force far exceeds elasticity and speed, or a moment stops the spin much faster than the contact lasts.
        assert!(inputs.force.is_some() || inputs.peeling > 0.0, "{inputs:?} {impact:?}");
        counts.spent += 1;
        return None;
    }
    counts.solved += 1;
    (impact.normal.outcome() != Some(Outcome::Undecided)).then_some(e)
}

/// Impacts that ended, and those among them that were solved.
#[derive(Default)]
struct Counts {
    ended: u32,
    solved: u32,
    /// Those that spent their budget, and said so.
    spent: u32,
}

/// Simulates random scenes by one method in both precisions; what is solved in both agrees.
fn simulate_everything<D, S>(scenes: u32, seed: u64, double: &D, single: &S) -> Counts
where
    D: Method<f64>,
    S: Method<f32>,
{
    let (mut random, mut counts) = (StdRng::seed_from_u64(seed), Counts::default());
    for _ in 0..scenes {
        let inputs = Inputs::random(&mut random);
        let double = solved(&inputs, inputs.simulate(double), &mut counts);
        let single = solved(&inputs, inputs.simulate(single), &mut counts);
        if let (Some(e), Some(found)) = (double, single.map(f64::from)) {
            // A force that does more work than the sphere brings magnifies what single precision loses.
            let bound = if inputs.force.is_some() { 1e-2 } else { 1e-4 };
            assert!((e * e - found * found).abs() < bound, "{inputs:?}: {e} against {found}");
        }
    }
    counts
}

/// A million scenes for each method (fewer without MICROIMPACT_EXHAUSTIVE) over twelve decades of every input, half of them under an external force, end in a
/// result of finite numbers within the budget, or in a named error; each in both precisions.
#[test]
fn every_scene_ends() {
    const SCENES: u32 = 1_000_000;
    const PARTS: u32 = 64;
    let all = repetitions(SCENES, 32_000);
    let part = AtomicU32::new(0);
    let work = || {
        let mut total = Counts::default();
        loop {
            let part = part.fetch_add(1, Ordering::Relaxed);
            if part >= 2 * PARTS {
                return total;
            }
            let (scenes, seed) = (all / PARTS, u64::from(part));
            let counts = if part < PARTS {
                simulate_everything(scenes, seed, &Adaptive::new(1e-6).unwrap(), &Adaptive::new(1e-6).unwrap())
            } else {
                let (double, single) = (Collocation::<7, f64>::new(1e-6), Collocation::<7, f32>::new(1e-6));
                simulate_everything(scenes, seed, &double.unwrap(), &single.unwrap())
            };
            total.ended += counts.ended;
            total.solved += counts.solved;
            total.spent += counts.spent;
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let totals: Vec<Counts> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().map(|worker| worker.join().unwrap()).collect()
    });
    let ended: u32 = totals.iter().map(|counts| counts.ended).sum();
    let solved: u32 = totals.iter().map(|counts| counts.solved).sum();
    let spent: u32 = totals.iter().map(|counts| counts.spent).sum();
    println!("{solved} solved of {ended}, {spent} with the budget spent");
    assert_eq!(ended, 4 * all);
    assert!(solved > 3 * all, "{solved}");
    assert!(spent < all / 500, "{spent}");
}
