//! The normal force to which friction is proportional.

use core::f64::consts::PI;

use microimpact::contact::{
    Adaptive, AnyLaw, Collocation, Contact, ElasticForce, FixedCost, JkrEnd, Method, PressingForce, RestCriterion,
    RungeKuttaGill, Slip, Status, Times, TotalAndPullOff, TotalForce,
};
use microimpact::{NormalMotion, Oblique, Outcome, Sphere, Stiffness, SurfaceMotion};

const FRICTION: f64 = 0.2;
/// Work of adhesion, J/m^2, and strength of the ring, N/m.
const WORK: f64 = 0.3;
const RING: f64 = 2.0;

type Scene = Contact<f64, AnyLaw<f64>>;

fn sphere() -> Sphere<f64> {
    Sphere::solid(2e-6, 1050.0).unwrap()
}

fn stiffness() -> Stiffness<f64> {
    Stiffness::new(5e9).unwrap()
}

fn adaptive() -> Adaptive<f64> {
    Adaptive::new(1e-12).unwrap()
}

/// What a sphere that slides throughout loses of its velocity, over f.
fn impulse(scene: Scene, force: impl PressingForce<f64>, speed: f64, method: &impl Method<f64>) -> f64 {
    let motion = NormalMotion::new(speed).unwrap().with_tangential(1e3 * speed).unwrap();
    let scene = scene.with_friction_under(FRICTION, force).unwrap();
    let (impact, slip) = scene.solve_for(&motion, method, Slip).unwrap();
    assert_eq!(impact.run.status, Status::Solved);
    assert_eq!(impact.tangential.motion(), SurfaceMotion::Sliding);
    let after = impact.tangential.velocity();
    // What follows the motion along the surface agrees with the impulse alone.
    assert!((slip.velocity / after - 1.0).abs() < 1e-12, "{} {after}", slip.velocity);
    (motion.tangential() - after) / FRICTION
}

/// Checks a law without damping, from its pull-off force and the potential where the forces balance (over the mass; of first
/// contact it is zero).
fn check_undamped(name: &str, law: AnyLaw<f64>, pull_off: f64, at_balance: f64) {
    let scene = Contact::new(sphere(), law);
    for speed in [2.0, 5.0, 30.0] {
        let motion = NormalMotion::new(speed).unwrap();
        let (impact, times) = scene.solve_for(&motion, &adaptive(), Times).unwrap();
        assert_eq!(impact.normal.outcome(), Some(Outcome::Rebound), "{name} {speed}");
        let change = (1.0 + impact.normal.overall_restitution()) * speed;
        // The momentum changes by the impulse of the total force, and from balance to balance by that of the pressing part.
        let of_all = change + 2.0 * pull_off / sphere().mass() * times.contact.unwrap();
        let of_pressing = 2.0 * (speed * speed - 2.0 * at_balance).sqrt();
        let close = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-10, "{name} {speed}: {found} {expected}");
        };
        close(impulse(scene, TotalAndPullOff::new(), speed, &adaptive()), of_all);
        close(impulse(scene, TotalForce::new(), speed, &adaptive()), of_pressing);
        close(impulse(scene, TotalForce::new(), speed, &Collocation::<12, f64>::new(1e-12).unwrap()), of_pressing);
    }
}

#[test]
fn impulses_without_damping_are_exact() {
    let (r, k, m) = (sphere().radius(), stiffness().pascals(), sphere().mass());
    check_undamped("hertz", AnyLaw::hertz(stiffness()), 0.0, 0.0);
    let potential = |delta: f64| 0.4 * r.sqrt() * k * delta.powf(2.5);

    let pull = 2.0 * PI * WORK * r;
    let delta = (pull / (r.sqrt() * k)).powf(2.0 / 3.0);
    check_undamped("dmt", AnyLaw::dmt(stiffness(), WORK).unwrap(), pull, (potential(delta) - pull * delta) / m);

    // K a^3/r = 2 pi f0 a at the balance, and at a third of that square the tension is largest.
    let ring = 2.0 * PI * RING;
    let delta = ring / k;
    let a = (delta * r / 3.0).sqrt();
    let at_balance = potential(delta) - 2.0 / 3.0 * ring * r.sqrt() * delta.powf(1.5);
    check_undamped("ring", AnyLaw::ring(stiffness(), RING, 0.0).unwrap(), ring * a - k * a.powi(3) / r, at_balance / m);

    // K a^3/r = p a^(3/2) at the balance.
    let modulus = 0.75 * k;
    let p = (8.0 * PI * WORK * modulus).sqrt();
    let potential =
        |a: f64| 2.0 * k * a.powi(5) / (5.0 * r * r) - 2.0 * p * a.powf(3.5) / (3.0 * r) + PI * WORK * a * a;
    let (first, balance) = ((2.0 * PI * WORK * r * r / modulus).cbrt(), (p * r / k).powf(2.0 / 3.0));
    let drop = (potential(balance) - potential(first)) / m;
    for end in [JkrEnd::SnapOff, JkrEnd::PullOff] {
        let law = AnyLaw::jkr(stiffness(), WORK, end).unwrap();
        check_undamped("jkr", law, 1.5 * PI * WORK * r, drop);
    }
}

/// Every adhesive law with every damping.
fn damped() -> Vec<(&'static str, Scene)> {
    let (stiffness, mut scenes) = (stiffness(), Vec::new());
    for (name, law) in [
        ("dmt", AnyLaw::dmt(stiffness, WORK)),
        ("ring", AnyLaw::ring(stiffness, RING, 3.0)),
        ("jkr", AnyLaw::jkr(stiffness, WORK, JkrEnd::SnapOff)),
    ] {
        let law = law.unwrap();
        let damped = [law.with_damping(3.0), law.with_viscoelastic_damping(2e-10), law.with_constant_damping(0.8)];
        scenes.extend(damped.map(|law| (name, Contact::new(sphere(), law.unwrap()))));
    }
    scenes
}

/// A solver in time, which knows of no kink, comes to the same.
#[test]
fn impulses_with_damping_agree_with_time_steps() {
    let gill = RungeKuttaGill::new(20_000);
    // It does not carry a law with two radii for an indentation.
    for (name, scene) in damped().into_iter().filter(|(name, _)| *name != "jkr") {
        let total =
            [impulse(scene, TotalForce::new(), 5.0, &adaptive()), impulse(scene, TotalForce::new(), 5.0, &gill)];
        let thornton = [
            impulse(scene, TotalAndPullOff::new(), 5.0, &adaptive()),
            impulse(scene, TotalAndPullOff::new(), 5.0, &gill),
        ];
        for [exact, in_time] in [total, thornton] {
            assert!((in_time / exact - 1.0).abs() < 3e-6, "{name}: {exact} {in_time}");
        }
    }
}

/// The tolerance holds for what follows from the impulse, whatever the size of the intervals.
#[test]
fn tolerances_hold() {
    for ((name, scene), tolerance) in damped().into_iter().flat_map(|scene| [1e-4, 1e-6, 1e-8].map(|t| (scene, t))) {
        let exact = impulse(scene, TotalForce::new(), 5.0, &adaptive());
        let found = impulse(scene, TotalForce::new(), 5.0, &Adaptive::new(tolerance).unwrap());
        assert!((found / exact - 1.0).abs() < tolerance, "{name} {tolerance:e}: {exact} {found}");
    }
}

/// Where the sphere begins to roll, from sliding throughout to rolling at once.
#[test]
fn rolling_begins_where_the_impulse_suffices() {
    for (name, scene) in damped() {
        let scene_with = scene.with_friction_under(FRICTION, TotalForce::new()).unwrap();
        let all = impulse(scene, TotalForce::new(), 5.0, &adaptive());
        // Friction needs 2/7 of the slip for a solid sphere.
        let most = 3.5 * FRICTION * all;
        for part in [0.001, 0.3, 0.5, 0.9, 0.999, 1.001, 1.5] {
            let motion = NormalMotion::new(5.0).unwrap().with_tangential(part * most).unwrap();
            let (impact, slip) = scene_with.solve_for(&motion, &adaptive(), Slip).unwrap();
            let expected = if part < 1.0 { SurfaceMotion::Rolling } else { SurfaceMotion::Sliding };
            assert_eq!(impact.tangential.motion(), expected, "{name} {part}");
            assert_eq!(slip.slides, part > 1.0, "{name} {part}");
            assert!((slip.velocity / impact.tangential.velocity() - 1.0).abs() < 1e-9, "{name} {part}");
            let margin = impact.tangential.friction_over_limit().unwrap();
            assert!((margin * part - 1.0).abs() < 1e-9, "{name} {part}: {margin}");
        }
    }
}

#[test]
fn the_elastic_force_is_the_default() {
    for (name, scene) in damped() {
        let motion = NormalMotion::new(5.0).unwrap().with_tangential(3.0).unwrap();
        let by_name = scene.with_friction_under(FRICTION, ElasticForce).unwrap().solve(&motion, &adaptive()).unwrap();
        let default = scene.with_friction(FRICTION).unwrap().solve(&motion, &adaptive()).unwrap();
        assert_eq!(by_name.tangential, default.tangential, "{name}");
    }
}

#[test]
fn fixed_cost_refuses_a_kink() {
    let scene = |law: AnyLaw<f64>| Contact::new(sphere(), law.with_damping(1.0).unwrap());
    let (hertz, dmt) = (scene(AnyLaw::hertz(stiffness())), scene(AnyLaw::dmt(stiffness(), WORK).unwrap()));
    let method = FixedCost::<7>::new(4).unwrap();
    let motion = NormalMotion::new(5.0).unwrap().with_tangential(100.0).unwrap();
    let status =
        dmt.with_friction_under(FRICTION, TotalForce::new()).unwrap().solve(&motion, &method).unwrap().run.status;
    assert_eq!(status, Status::Unsupported);
    // Without adhesion there is no kink.
    let quick = FixedCost::<7>::new(6).unwrap().with_outputs::<13>();
    for (found, exact) in [
        (impulse(hertz, TotalForce::new(), 5.0, &quick), impulse(hertz, ElasticForce, 5.0, &adaptive())),
        (impulse(dmt, TotalAndPullOff::new(), 5.0, &quick), impulse(dmt, TotalAndPullOff::new(), 5.0, &adaptive())),
    ] {
        assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
    }
}

/// Nothing presses on a sphere at rest, so that a fast one slides on; twice the pull-off force brings every slip to an end.
#[test]
fn captured_spheres_slide_on_or_roll() {
    let criterion = RestCriterion::new(1e-6, 10_000).unwrap();
    fn at_rest(
        scene: Scene,
        force: impl PressingForce<f64>,
        tangential: f64,
        (method, criterion): (&Adaptive<f64>, &RestCriterion<f64>),
    ) -> (SurfaceMotion, f64, f64) {
        let motion = NormalMotion::new(0.02).unwrap().with_tangential(tangential).unwrap();
        let scene = scene.with_friction_under(FRICTION, force).unwrap();
        let settled = scene.solve_to_rest(&motion, method, criterion, Slip).unwrap();
        assert_eq!(settled.impact.normal.outcome(), Some(Outcome::Capture));
        assert!(settled.motion.is_some());
        (settled.impact.tangential.motion(), settled.impact.tangential.velocity(), settled.outputs.velocity)
    }
    for (name, scene) in damped() {
        let with = (&adaptive(), &criterion);
        let (slow, velocity, followed) = at_rest(scene, TotalForce::new(), 1e-4, with);
        assert_eq!(slow, SurfaceMotion::Rolling, "{name}");
        assert!((velocity / (1e-4 / 1.4) - 1.0).abs() < 1e-9 && (velocity / followed - 1.0).abs() < 1e-9, "{name}");
        let (fast, velocity, followed) = at_rest(scene, TotalForce::new(), 100.0, with);
        assert_eq!(fast, SurfaceMotion::Sliding, "{name}");
        assert!((velocity / followed - 1.0).abs() < 1e-9 && velocity < 100.0, "{name}: {velocity} {followed}");
        let (ends, velocity, _) = at_rest(scene, TotalAndPullOff::new(), 100.0, with);
        assert_eq!(ends, SurfaceMotion::Rolling, "{name}");
        assert!((velocity * 1.4 / 100.0 - 1.0).abs() < 1e-9, "{name}");
    }
}

#[test]
fn single_precision_has_its_digits() {
    let sphere = Sphere::solid(2e-6_f32, 1050.0).unwrap();
    let motion = NormalMotion::new(5.0_f32).unwrap().with_tangential(500.0).unwrap();
    let law = AnyLaw::dmt(Stiffness::new(5e9).unwrap(), WORK as f32).unwrap().with_viscoelastic_damping(2e-10).unwrap();
    let scene = Contact::new(sphere, law).with_friction_under(FRICTION as f32, TotalForce::new()).unwrap();
    let after = scene.solve(&motion, &Adaptive::new(1e-6).unwrap()).unwrap().tangential.velocity();
    let law = AnyLaw::dmt(stiffness(), WORK).unwrap().with_viscoelastic_damping(2e-10).unwrap();
    let lost = FRICTION * impulse(Contact::new(self::sphere(), law), TotalForce::new(), 5.0, &adaptive());
    assert!((f64::from(500.0 - after) / lost - 1.0).abs() < 1e-4, "{after} {lost}");
}
