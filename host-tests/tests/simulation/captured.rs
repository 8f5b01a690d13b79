//! The motion of a captured sphere to rest, against an integration of its own and the linear theory of small swings.

use core::f64::consts::PI;

use microimpact::contact::{
    Collocation, Contact, Impulses, MotionToRest, Nodes, Output, Recording, RestCriterion, SettledImpact, Slip, Status,
    Times, Works,
};
use microimpact::{NormalMotion, Outcome, Real, Sphere, Stiffness};

const DENSITY: f64 = 2600.0;
const STIFFNESS: f64 = 7.5e10;

/// A captured sphere of 5 um diameter: speed, zeta_H, f0, zeta_A, and the external force over the adhesion at equilibrium.
#[derive(Clone, Copy, Debug)]
struct Scene {
    speed: f64,
    material: f64,
    strength: f64,
    adhesion: f64,
    force: f64,
}

const fn scene(speed: f64, material: f64, strength: f64, adhesion: f64, force: f64) -> Scene {
    Scene { speed, material, strength, adhesion, force }
}

/// Damped in the materials, in adhesion and in both, lightly and strongly, pressed and pulled by a force.
const SCENES: [Scene; 14] = [
    scene(1.0, 10.5, 250.0, 6.25, 0.0),
    scene(4.5, 10.5, 250.0, 6.25, 0.0),
    scene(1.0, 10.5, 250.0, 0.0, 0.0),
    scene(1.0, 0.0, 250.0, 6.25, 0.0),
    scene(0.3, 1.0, 250.0, 1.0, 0.0),
    scene(1.0, 60.0, 250.0, 6.25, 0.0),
    scene(1.0, 10.5, 250.0, 100.0, 0.0),
    scene(1.0, 100.0, 250.0, 6.25, 0.0),
    scene(1.0, 300.0, 250.0, 0.0, 0.0),
    scene(1.0, 10.5, 250.0, 6.25, -0.5),
    scene(1.0, 10.5, 250.0, 6.25, 0.05),
    scene(1.0, 60.0, 250.0, 6.25, 0.05),
    scene(1e-3, 3.0, 250.0, 0.0, -30.0),
    scene(1e-3, 0.3, 250.0, 0.3, -30.0),
];

fn sphere<T: Real>() -> Sphere<T> {
    Sphere::solid(T::constant(2.5e-6), T::constant(DENSITY)).unwrap()
}

impl Scene {
    fn equilibrium(&self) -> f64 {
        2.0 * PI * self.strength / STIFFNESS
    }

    fn external_force(&self) -> f64 {
        let radius = sphere::<f64>().radius();
        self.force * 2.0 * PI * self.strength * (radius * self.equilibrium()).sqrt()
    }

    fn run<T: Nodes<N>, const N: usize, O: Output<T, ()>>(
        &self,
        tolerance: f64,
        share: f64,
        turning_points: u32,
        outputs: O,
    ) -> SettledImpact<T, (), O::Result> {
        let c = T::constant;
        let scene = Contact::hertz(sphere(), Stiffness::new(c(STIFFNESS)).unwrap());
        let scene = scene.with_damping(c(self.material)).unwrap();
        let scene = scene.with_ring(c(self.strength), c(self.adhesion)).unwrap();
        let scene = scene.with_external_force(c(self.external_force())).unwrap();
        let criterion = RestCriterion::new(c(share), turning_points).unwrap();
        let method = Collocation::<N, T>::new(c(tolerance)).unwrap();
        scene.solve_to_rest(&NormalMotion::new(c(self.speed)).unwrap(), &method, &criterion, outputs).unwrap()
    }

    fn motion(&self, share: f64) -> MotionToRest<f64> {
        let settled = self.run::<f64, 12, _>(1e-12, share, 100_000, ());
        assert_eq!(settled.impact.run.status, Status::Solved, "{self:?}");
        settled.motion.unwrap()
    }
}

/// B6 in units of equilibrium indentation and of the time at which a linear spring of its stiffness makes one radian:
/// ds/dsigma = y, dtau/dsigma = 2 s with the indentation x = s^2.
struct Independent {
    material: f64,
    adhesion: f64,
    force: f64,
}

type State = [f64; 3];

impl Independent {
    fn rates(&self, [s, y, _]: State) -> State {
        let adhesion = if y < 0.0 { 1.0 - self.adhesion * y } else { 1.0 };
        let acceleration = s * adhesion - s * s * s * (1.0 + self.material * y) - self.force;
        [y, 2.0 * s * acceleration, 2.0 * s]
    }

    fn step(&self, at: State, length: f64) -> State {
        let along = |slope: State, length: f64| core::array::from_fn(|i| at[i] + length * slope[i]);
        let first = self.rates(at);
        let second = self.rates(along(first, length / 2.0));
        let third = self.rates(along(second, length / 2.0));
        let fourth = self.rates(along(third, length));
        core::array::from_fn(|i| at[i] + length / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
    }

    fn potential(&self, s: f64) -> f64 {
        0.4 * s.powi(5) - 2.0 / 3.0 * s.powi(3) + self.force * s * s
    }

    /// Depth of the well and potential at its bottom.
    fn well(&self) -> (f64, f64) {
        let mut bottom = 3.0_f64;
        for _ in 0..100 {
            bottom -= (bottom.powi(3) - bottom + self.force) / (3.0 * bottom * bottom - 1.0);
        }
        let (mut brink, mut inner) = (0.0_f64, bottom * (1.0 - 1e-9));
        for _ in 0..100 {
            let middle = 0.5 * (brink + inner);
            if middle.powi(3) - middle + self.force > 0.0 { brink = middle } else { inner = middle }
        }
        (self.potential(brink) - self.potential(bottom), self.potential(bottom))
    }

    /// The place within a step of `length` at which `passed` becomes true.
    fn event(&self, at: State, length: f64, passed: impl Fn(State) -> bool) -> State {
        let (mut before, mut after) = (0.0, length);
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            if passed(self.step(at, middle)) { after = middle } else { before = middle }
        }
        self.step(at, after)
    }

    /// Time and indentation at rest, number of turning points after the peak, and whether the sphere creeps.
    fn rest(&self, speed: f64, share: f64, step: f64) -> (f64, f64, u32, bool) {
        let (depth, bottom) = self.well();
        let excess = |[s, y, _]: State| 0.5 * y * y + self.potential(s) - bottom;
        let rest = share * depth;
        let (mut at, mut inwards, mut turning_points) = ([0.0, speed, 0.0], true, -1);
        let mut low: Option<State> = None;
        for _ in 0..100_000_000_u32 {
            let turns = |[_, y, _]: State| (y > 0.0) != inwards;
            let next = self.step(at, step);
            assert!(next[0] > 0.0, "it separates");
            if low.is_none() && excess(next) <= rest {
                low = Some(self.event(at, step, |there| excess(there) <= rest));
            }
            match low {
                // So much later and still on its way: it creeps.
                Some(low) if excess(next) <= 1e-4 * rest => {
                    return (low[2], low[0] * low[0], turning_points.max(0) as u32, true);
                }
                _ => {}
            }
            if turns(next) {
                let [s, _, time] = self.event(at, step, turns);
                turning_points += 1;
                if low.is_some() {
                    return (time, s * s, turning_points as u32, false);
                }
                inwards = !inwards;
                at = [s, if inwards { 1e-300 } else { -1e-300 }, time];
            } else {
                at = next;
            }
        }
        panic!("no rest");
    }
}

impl Scene {
    /// Units of length and time, and the scene in them.
    fn independent(&self) -> (f64, f64, Independent) {
        let (length, sphere) = (self.equilibrium(), sphere::<f64>());
        let stiffness = (sphere.radius() * length).sqrt() * STIFFNESS;
        let time = (sphere.mass() / stiffness).sqrt();
        // C = (m/(r^3 K sqrt(v)))^(2/5) (B4).
        let unit = (sphere.mass() / (sphere.radius().powi(3) * STIFFNESS * self.speed.sqrt())).powf(0.4);
        let damping = unit * length / time;
        let scene =
            Independent { material: self.material * damping, adhesion: self.adhesion * damping, force: self.force };
        (length, time, scene)
    }
}

#[test]
fn rest_agrees_with_an_independent_integration() {
    for scene in SCENES {
        for share in [1e-3, 1e-6] {
            let (length, time, independent) = scene.independent();
            let (rest, indentation, turning_points, creeps) =
                independent.rest(scene.speed * time / length, share, 1e-3);
            let motion = scene.motion(share);
            assert_eq!((motion.turning_points, motion.creeps), (turning_points, creeps), "{scene:?}");
            assert!((motion.time / (rest * time) - 1.0).abs() < 2e-9, "{scene:?}: {motion:?}");
            assert!((motion.indentation / (indentation * length) - 1.0).abs() < 1e-9, "{scene:?}: {motion:?}");
            let single = scene.run::<f32, 8, _>(1e-6, share, 1000, ());
            assert_eq!(single.impact.run.status, Status::Solved, "{scene:?}");
            let single = single.motion.unwrap();
            assert_eq!((single.turning_points, single.creeps), (turning_points, creeps), "{scene:?}");
            assert!((f64::from(single.time) / motion.time - 1.0).abs() < 1e-3, "{scene:?}: {single:?}");
        }
    }
}

/// Close to the bottom the sphere is a linear oscillator: its stiffness is k = sqrt(r delta_eq) K, the damping in the
/// materials d = c_H times the elastic force, which is that of adhesion there. On the way out adhesion adds as much for c_A.
#[test]
fn small_swings_are_those_of_a_linear_oscillator() {
    for (material, adhesion) in [(1.0, 0.0), (0.0, 1.0), (0.5, 0.25), (10.5, 6.25)] {
        let scene = Scene { material, adhesion, ..scene(0.05, 0.0, 250.0, 0.0, 0.0) };
        let (_, time, Independent { material, adhesion, .. }) = scene.independent();
        let (early, late) = (scene.motion(1e-8), scene.motion(1e-11));
        let swings = f64::from(late.turning_points - early.turning_points);
        // In units of m and k, on the way in and out.
        let phases = [material, material + adhesion].map(|damping| {
            let half_period = PI / (1.0 - damping * damping / 4.0).sqrt();
            (half_period, damping * half_period)
        });
        let decay = 0.5 * (phases[0].1 + phases[1].1);
        let half_period = (late.time - early.time) / time / swings;
        let expected = 0.5 * (phases[0].0 + phases[1].0);
        // There may be one swing more in the one direction than in the other.
        let uneven = (phases[0].0 - phases[1].0).abs() / swings;
        assert!((half_period - expected).abs() < uneven + 1e-7, "{scene:?}: {half_period} {expected}");
        // The number of swings is known to one at both ends.
        assert!((swings - 1e3_f64.ln() / decay).abs() <= 2.0, "{scene:?}: {swings} {decay}");
    }
}

/// Over more than a thousand swings the works of damping are the energy lost.
#[test]
fn energy_is_kept_over_a_thousand_swings() {
    let scene = scene(0.02, 0.08, 250.0, 0.02, 0.0);
    let sphere = sphere::<f64>();
    for share in [1e-1, 1e-4, 1e-10] {
        let settled = scene.run::<f64, 12, _>(1e-12, share, 100_000, Works);
        let (motion, works) = (settled.motion.unwrap(), settled.outputs);
        assert_eq!(settled.impact.run.status, Status::Solved);
        assert!(share > 1e-5 || motion.turning_points > 1000, "{}", motion.turning_points);
        let (root, depth) = (sphere.radius().sqrt(), motion.indentation);
        let potential = root * (0.4 * STIFFNESS * depth.powf(2.5) - 4.0 / 3.0 * PI * scene.strength * depth.powf(1.5));
        let lost = 0.5 * sphere.mass() * scene.speed * scene.speed - potential;
        let error = (works.material + works.adhesion) / lost - 1.0;
        assert!(error.abs() < 1e-9, "{motion:?}: {error:e}");
    }
}

/// Where the damping passes its critical strength a sphere neither turns back within sight nor creeps for sure.
#[test]
fn critical_damping_is_no_obstacle() {
    let (_, _, Independent { material: unit, .. }) = scene(1.0, 1.0, 250.0, 0.0, 0.0).independent();
    for damping in [1.8, 1.9, 1.95, 1.98, 1.99, 1.995, 1.999, 2.0, 2.001, 2.01, 2.05, 2.1] {
        let scene = scene(1.0, damping / unit, 250.0, 0.0, 0.0);
        for share in [1e-3, 1e-6, 1e-9, 1e-12] {
            let settled = scene.run::<f64, 12, _>(1e-12, share, 100, ());
            let run = settled.impact.run;
            assert_eq!(run.status, Status::Solved, "{damping} {share:e}");
            assert!(damping > 1.97 || run.steps + run.refused < 160, "{damping} {share:e}: {run:?}");
            let motion = settled.motion.unwrap();
            assert!(
                motion.turning_points < 3 && (damping < 2.0 || motion.turning_points == 0),
                "{damping}: {motion:?}"
            );
            assert!(
                (motion.indentation / scene.equilibrium() - 1.0).abs() <= 0.8 * share.sqrt(),
                "{damping}: {motion:?}"
            );
        }
    }
}

/// A sphere that is damped almost critically passes its equilibrium by less than rounding lets a tight tolerance see.
#[test]
fn a_turning_point_next_to_the_equilibrium_spends_no_budget() {
    let sphere = Sphere::solid(5.06e-6, DENSITY).unwrap();
    for step in 0..100 {
        let stiffness = Stiffness::new(4e9 * 1.008_f64.powi(step)).unwrap();
        let scene = Contact::hertz(sphere, stiffness).with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
        let (motion, method) =
            (NormalMotion::new(0.329_034_456_231).unwrap(), Collocation::<14, f64>::new(1e-13).unwrap());
        let (found, _) = scene.solve_for(&motion, &method, (Times, Impulses, Works)).unwrap();
        assert_eq!(found.run.status, Status::Solved, "{stiffness:?}: {:?}", found.run);
        assert_eq!(found.normal.outcome(), Some(Outcome::Capture));
    }
}

/// A sphere at rest lies as close to its equilibrium as the share says.
#[test]
fn indentation_tends_to_the_equilibrium() {
    for scene in SCENES.iter().filter(|scene| scene.force == 0.0) {
        for share in [1e-2, 1e-4, 1e-8, 1e-12_f64] {
            let motion = scene.motion(share);
            let distance = motion.indentation / scene.equilibrium() - 1.0;
            assert!(distance.abs() <= 0.75 * share.sqrt() * (1.0 + share.sqrt()), "{scene:?}: {motion:?}");
        }
    }
}

#[test]
fn spent_turning_points_are_reported() {
    for most in [1, 2, 7] {
        let settled = SCENES[0].run::<f64, 9, _>(1e-9, 1e-6, most, ());
        assert_eq!(settled.impact.run.status, Status::BudgetSpent);
        // That the sphere is captured is sure all the same.
        assert_eq!(settled.impact.normal.status(), Status::Solved);
        assert_eq!(settled.impact.normal.outcome(), Some(Outcome::Capture));
        let motion = settled.motion.unwrap();
        assert_eq!(motion.turning_points, most);
        if most == 1 {
            assert_eq!(Some(motion.indentation), settled.impact.normal.turning_indentation());
        }
    }
}

/// A rebound is the same with and without the wish to follow a capture.
#[test]
fn rebound_is_not_followed() {
    let scene = Contact::hertz(sphere(), Stiffness::new(STIFFNESS).unwrap());
    let scene = scene.with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap();
    let (method, motion) = (Collocation::<9, f64>::new(1e-9).unwrap(), NormalMotion::new(8.0).unwrap());
    let (criterion, all) = (RestCriterion::new(1e-6, 10).unwrap(), (Times, Impulses, Works));
    let settled = scene.solve_to_rest(&motion, &method, &criterion, all).unwrap();
    assert_eq!(settled.motion, None);
    assert_eq!((settled.impact, settled.outputs), scene.solve_for(&motion, &method, all).unwrap());
}

/// What friction has done until rest: all the impulse of the elastic force counts, and angular momentum is kept.
#[test]
fn friction_acts_until_rest() {
    let sphere = sphere();
    let scene = Contact::hertz(sphere, Stiffness::new(STIFFNESS).unwrap());
    let scene = scene.with_damping(10.5).unwrap().with_ring(250.0, 6.25).unwrap().with_friction(0.1).unwrap();
    let (method, criterion) = (Collocation::<12, f64>::new(1e-12).unwrap(), RestCriterion::new(1e-6, 1000).unwrap());
    for (tangential, peripheral) in
        [(0.5, 0.0), (1.0, -0.5), (20.0, 0.0), (50.0, -20.0), (70.0, 0.0), (80.0, 10.0), (200.0, 0.0), (200.0, -300.0)]
    {
        let oblique = NormalMotion::new(1.0).unwrap().with_tangential(tangential).unwrap();
        let motion = oblique.with_peripheral_velocity(peripheral).unwrap();
        let outputs = (Impulses, Recording::<64>, Slip);
        let settled = scene.solve_to_rest(&motion, &method, &criterion, outputs).unwrap();
        let (impulses, trajectory, slip) = settled.outputs;
        let rest = settled.motion.unwrap();
        let momentum = slip.velocity + 0.4 * sphere.radius() * slip.spin;
        assert!((momentum / (tangential + 0.4 * peripheral) - 1.0).abs() < 1e-10);
        let change = 0.1 * impulses.elastic / sphere.mass();
        let rolls = change >= 2.0 / 7.0 * (tangential - peripheral);
        let velocity = if rolls { (5.0 * tangential + 2.0 * peripheral) / 7.0 } else { tangential - change };
        assert_eq!(!slip.slides, rolls, "{tangential}");
        assert!((slip.velocity - velocity).abs() < 1e-9 * tangential, "{tangential}: {velocity}");
        assert!(slip.displacement > velocity * rest.time);
        assert_eq!(trajectory.roll().map(|roll| roll.time), slip.rolls_from);
        assert_eq!(rolls, tangential < 100.0);
    }
}

/// The recording goes on to rest, evenly, however many swings there are.
#[test]
fn swings_are_recorded() {
    for scene in SCENES {
        let settled = scene.run::<f64, 9, _>(1e-9, 1e-6, 1000, (Times, Recording::<128>));
        let (rest, (times, trajectory)) = (settled.motion.unwrap(), settled.outputs);
        let samples: Vec<_> = trajectory.samples().collect();
        let last = samples[samples.len() - 1];
        assert!(samples.len() <= 128 && samples.is_sorted_by(|a, b| a.time <= b.time));
        assert_eq!(last.time, rest.time, "{scene:?}");
        assert!((last.indentation / rest.indentation - 1.0).abs() < 1e-14, "{scene:?}");
        assert_eq!(trajectory.peak().map(|peak| peak.time), times.peak, "{scene:?}");
        let gaps = samples.windows(2).map(|pair| pair[1].time - pair[0].time);
        let evenness = gaps.fold(0.0, f64::max) / rest.time * samples.len() as f64;
        // Thinning takes every other sample at most: it leaves half the room, but for gaps between nodes.
        let count = samples.len();
        assert!(rest.turning_points < 10 || (count > 48 && evenness < 2.5), "{scene:?}: {count}, {evenness}");
    }
}

/// Damping, adhesion and force over many decades: every captured sphere comes to rest, in both number types, unless the
/// damping is so weak that it takes ten thousands of swings.
#[test]
fn every_captured_sphere_comes_to_rest() {
    let (mut captured, mut crept) = (0, 0);
    for speed in [1e-3, 0.1, 1.0, 30.0] {
        for material in [0.0, 0.1, 3.0, 30.0, 300.0, 3e3, 1e5, 1e7] {
            for adhesion in [0.0, 1.0, 30.0, 1e3, 1e5] {
                for strength in [1.0, 250.0, 1e4] {
                    for force in [0.0, -1e-3, -0.3, -30.0, 0.03, 0.3] {
                        let scene = Scene { speed, material, strength, adhesion, force };
                        let double = scene.run::<f64, 9, _>(1e-9, 1e-6, 100_000, ());
                        let single = scene.run::<f32, 8, _>(1e-6, 1e-6, 100_000, ());
                        let Some(motion) = double.motion else { continue };
                        captured += 1;
                        crept += u32::from(motion.creeps);
                        let weak = motion.turning_points > 30_000;
                        let status = if weak { Status::BudgetSpent } else { Status::Solved };
                        for found in [double.impact.run.status, single.impact.run.status] {
                            assert!(found == Status::Solved || found == status, "{scene:?}: {motion:?}");
                        }
                        assert!(motion.time.is_finite() && motion.indentation > 0.0, "{scene:?}: {motion:?}");
                        assert!(single.motion.is_none_or(|motion| motion.time.is_finite()), "{scene:?}");
                    }
                }
            }
        }
    }
    assert!(captured > 1000 && crept > 1000 && captured - crept > 300, "{captured} {crept}");
}
