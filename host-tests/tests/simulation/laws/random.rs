//! Every law with every damping over random scenes: the outcomes of all methods and number types are right, and errors are within
//! their bounds.

use std::f64::consts::PI;
use std::fmt::Write;
use std::sync::LazyLock;

use microimpact::contact::{Adaptive, AnyLaw, Collocation, Contact, FixedCost, JkrEnd, Method, RungeKuttaGill};
use microimpact::{CriticalSpeed, NormalMotion, Outcome, Real, Sphere, Stiffness};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::repetitions;

const LAWS: [&str; 6] = ["hertz", "ring", "dmt", "without tension", "jkr to snap-off", "jkr to pull-off"];
const DAMPINGS: [&str; 4] = ["elastic", "hysteretic", "viscoelastic", "constant"];

/// A scene of a sphere of unit mass and radius on a surface of unit stiffness, by numbers that single precision holds.
#[derive(Clone, Copy, Debug)]
struct Scene {
    law: usize,
    damping: usize,
    adhesion: f64,
    strength: f64,
    ring_damping: f64,
    speed: f64,
}

/// What becomes of it: e^2 is zero for a capture.
struct Solved {
    scene: Scene,
    outcome: Outcome,
    restitution_squared: f64,
}

impl Scene {
    fn random(number: usize, random: &mut StdRng) -> Self {
        let (law, damping) = (number % LAWS.len(), number / LAWS.len() % DAMPINGS.len());
        let mut decades = |from: f64, to: f64| f64::from(10_f64.powf(random.random_range(from..to)) as f32);
        let (adhesion, speed) = (decades(-2.0, 0.0), decades(-1.5, 1.5));
        let strength = match DAMPINGS[damping] {
            "constant" => f64::from(random.random_range(0.2_f32..1.0)),
            _ => decades(-3.0, 0.0),
        };
        Self { law, damping, adhesion, strength, ring_damping: 0.2, speed }
    }

    /// So weakly damped that adhesion multiplies the energy of an impact near the critical speed: losses are small against what moves,
    /// and not against that energy.
    fn weakly_damped(number: usize, random: &mut StdRng) -> Option<Self> {
        let scene = Self::random(number, random);
        let weak = 10_f64.powf(random.random_range(-6.0..-2.0));
        let strength = if DAMPINGS[scene.damping] == "constant" { 1.0 - weak } else { weak };
        let scene = Self { strength: f64::from(strength as f32), ring_damping: f64::from(weak as f32), ..scene };
        let critical = scene.contact::<f64>().critical_speed(&Adaptive::new(1e-10).unwrap()).unwrap();
        let distance = 10_f64.powf(random.random_range(-6.0..0.0)) * if random.random() { 1.0 } else { -0.9 };
        let CriticalSpeed::At(critical) = critical else { return None };
        Some(Self { speed: f64::from((critical * (1.0 + distance)) as f32), ..scene })
    }

    fn contact<T: Real>(&self) -> Contact<T, AnyLaw<T>> {
        let (stiffness, adhesion) = (Stiffness::new(T::ONE).unwrap(), T::constant(self.adhesion));
        let law = match LAWS[self.law] {
            "hertz" => Ok(AnyLaw::hertz(stiffness)),
            "ring" => AnyLaw::ring(stiffness, adhesion, T::constant(self.ring_damping)),
            "dmt" => AnyLaw::dmt(stiffness, adhesion),
            "without tension" => Ok(AnyLaw::without_tension(stiffness)),
            "jkr to snap-off" => AnyLaw::jkr(stiffness, adhesion, JkrEnd::SnapOff),
            _ => AnyLaw::jkr(stiffness, adhesion, JkrEnd::PullOff),
        };
        let (law, strength) = (law.unwrap(), T::constant(self.strength));
        let damped = match DAMPINGS[self.damping] {
            "elastic" => Ok(law),
            "hysteretic" => law.with_damping(strength),
            "viscoelastic" => law.with_viscoelastic_damping(strength),
            _ => law.with_constant_damping(strength),
        };
        Contact::new(Sphere::solid(T::ONE, T::constant(0.75 / PI)).unwrap(), damped.unwrap())
    }

    fn motion<T: Real>(&self) -> NormalMotion<T> {
        NormalMotion::new(T::constant(self.speed)).unwrap()
    }
}

static SCENES: LazyLock<Vec<Solved>> = LazyLock::new(|| {
    let (mut random, exact) = (StdRng::seed_from_u64(14), Collocation::<14, f64>::new(1e-13).unwrap());
    let count = repetitions(24_000, 2_400);
    let mut scenes: Vec<_> = (0..count).map(|number| Scene::random(number, &mut random)).collect();
    scenes.extend((0..count).filter_map(|number| Scene::weakly_damped(number, &mut random)));
    let solved = scenes.into_iter().filter_map(|scene| {
        let contact = scene.contact::<f64>().solve_normal(&scene.motion(), &exact).unwrap();
        let outcome = contact.outcome().unwrap_or_else(|| panic!("{scene:?}"));
        let restitution_squared = contact.overall_restitution().powi(2);
        (outcome != Outcome::Undecided).then_some(Solved { scene, outcome, restitution_squared })
    });
    solved.collect()
});

/// Every outcome that a method has has to be right, and its error of e^2 within so many times the stated bound. Where it is
/// undecided, e^2 is within `undecided` bounds.
fn check<T: Real>(method: &impl Method<T>, bounds: f64, undecided: f64) {
    let mut faults = String::new();
    for Solved { scene, outcome, restitution_squared } in SCENES.iter() {
        let found = scene.contact::<T>().solve(&scene.motion(), method).unwrap();
        let (e, bound) = (found.normal.overall_restitution().to_f64(), found.run.error_bound.to_f64());
        let right = match found.normal.outcome() {
            None => true,
            Some(Outcome::Undecided) => *restitution_squared <= undecided * bound,
            Some(found) => found == *outcome && (e * e - restitution_squared).abs() <= bounds * bound,
        };
        if !right {
            let (law, damping) = (LAWS[scene.law], DAMPINGS[scene.damping]);
            let _ = writeln!(faults, "{law}, {damping}: {:?} {e}, {bound:e}, {scene:?}", found.normal.outcome());
        }
    }
    assert!(faults.is_empty(), "{outcome} of {}\n{faults}", SCENES.len(), outcome = faults.lines().count());
}

/// The number of scenes of a law that a method answers.
fn answered(method: &impl Method<f64>, law: &str) -> usize {
    let of_law = SCENES.iter().filter(|solved| LAWS[solved.scene.law] == law);
    let answers = of_law.filter(|Solved { scene, .. }| {
        scene.contact::<f64>().solve(&scene.motion(), method).unwrap().normal.outcome().is_some()
    });
    answers.count()
}

#[test]
fn scenes_are_captures_and_rebounds_of_every_law() {
    for (law, name) in LAWS.iter().enumerate() {
        let count =
            |outcome| SCENES.iter().filter(|solved| solved.scene.law == law && solved.outcome == outcome).count();
        assert!(count(Outcome::Rebound) > 100, "{name}");
        assert_eq!(count(Outcome::Capture) > 20, law != 0 && law != 3, "{name}");
    }
}

/// Their error adds up to ten times the tolerance in few scenes of a damping that takes nearly all.
#[test]
fn methods_that_control_their_error() {
    check(&Adaptive::new(1e-6).unwrap(), 10.0, 2.0);
    check(&Adaptive::new(1e-9).unwrap(), 10.0, 2.0);
    check(&Collocation::<7, f64>::new(1e-6).unwrap(), 10.0, 2.0);
    check(&Collocation::<9, f64>::new(1e-9).unwrap(), 10.0, 2.0);
    check::<f32>(&Adaptive::new(1e-6).unwrap(), 2.0, 2.0);
}

#[test]
fn methods_of_fixed_cost() {
    check::<f64>(&FixedCost::<5>::new(3).unwrap(), 1.0, 2.0);
    check::<f64>(&FixedCost::<7>::new(3).unwrap(), 1.0, 2.0);
    check::<f64>(&FixedCost::<9>::new(20).unwrap(), 1.0, 2.0);
    check::<f32>(&FixedCost::<7>::new(3).unwrap(), 1.0, 2.0);
    let method = FixedCost::<7>::new(3).unwrap();
    for law in ["hertz", "ring", "dmt"] {
        assert!(answered(&method, law) > 50, "{law}");
    }
    for law in ["without tension", "jkr to snap-off", "jkr to pull-off"] {
        assert_eq!(answered(&method, law), 0, "{law}");
    }
}

#[test]
fn steps_in_time() {
    let method = RungeKuttaGill::new(2000);
    // Its error adds up to five bounds. Where a slow sphere turns back too early, the bound is up to ten times too small.
    check::<f64>(&method, 5.0, 20.0);
    for law in ["hertz", "ring", "dmt"] {
        assert!(answered(&method, law) > 50, "{law}");
    }
    for law in ["without tension", "jkr to snap-off", "jkr to pull-off"] {
        assert_eq!(answered(&method, law), 0, "{law}");
    }
}

/// Damping of every strength. In single precision the critical speed is less exact where damping takes nearly all of the energy.
#[test]
fn critical_speeds_keep_their_tolerance_under_any_damping() {
    let mut random = StdRng::seed_from_u64(15);
    let (mut tried, mut inexact, mut wrong) = (0, 0, 0);
    for number in 0..repetitions(10_000, 2_000) {
        let scene = Scene::random(number, &mut random);
        let strength = 10_f64.powf(random.random_range(-3.0..3.0));
        let strength = match DAMPINGS[scene.damping] {
            "constant" => (-0.1 * strength).exp().max(1e-3),
            "viscoelastic" => strength.min(1.0),
            _ => strength,
        };
        let scene = Scene { strength: f64::from(strength as f32), ..scene };
        let found = |tolerance| scene.contact::<f64>().critical_speed(&Adaptive::new(tolerance).unwrap()).unwrap();
        let single = scene.contact::<f32>().critical_speed(&Adaptive::new(1e-4).unwrap()).unwrap();
        match (found(1e-10), found(1e-6), single) {
            (CriticalSpeed::At(exact), CriticalSpeed::At(found), CriticalSpeed::At(single)) => {
                let (error, single) = ((found / exact - 1.0).abs(), (f64::from(single) / exact - 1.0).abs());
                assert!(error <= 1e-5, "{scene:?}: {exact} {error:e}");
                tried += 1;
                inexact += usize::from(error > 1e-6) + usize::from(single > 1e-3);
                wrong += usize::from(single > 0.1);
            }
            (exact, found, single) => {
                assert_eq!(exact, found, "{scene:?}");
                wrong += usize::from(format!("{single:?}") != format!("{exact:?}"));
            }
        }
    }
    assert!(tried > 100 && inexact * 100 <= tried && wrong * 1000 <= tried, "{inexact}, {wrong} of {tried}");
}
