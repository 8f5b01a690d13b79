//! An impact recorded in time: what is kept of it, how evenly, and how exactly.

use crate::everything::{EVERYTHING, Everything};
use microimpact::contact::{
    Collocation, Contact, Nodes, NormalContact, Recording, RunReport, Sample, SimulatedImpact, TangentialVelocities,
    Trajectory,
};
use microimpact::{NormalMotion, Outcome, PlanarMotion, Real, Sphere, Stiffness};

type Impact<T, const N: usize> = (SimulatedImpact<T, TangentialVelocities<T>>, (Everything<T>, Trajectory<T, N>));

/// An impact of the sphere of Table 1: speed, slip, zeta_H, f0, zeta_A.
#[derive(Clone, Copy, Debug)]
struct Scene(f64, f64, f64, f64, f64);

/// Rebound and capture, sliding and rolling, from no damping to so strong a one that a sphere creeps in without a peak.
const SCENES: [Scene; 10] = [
    Scene(2.8, -0.738, 10.5, 250.0, 6.25),
    Scene(2.8, 5.0, 10.5, 250.0, 6.25),
    Scene(2.8, 0.1, 0.0, 0.0, 0.0),
    Scene(2.8, 0.1, 1000.0, 0.0, 0.0),
    Scene(2.8, 0.1, 1e5, 0.0, 0.0),
    Scene(1.0, 0.1, 10.5, 250.0, 6.25),
    Scene(1.0, 0.2, 10.5, 250.0, 0.0),
    Scene(1.0, 0.01, 1000.0, 250.0, 6.25),
    Scene(30.0, 3.0, 1e5, 250.0, 6.25),
    Scene(30.0, 3.0, 5000.0, 25.0, 6.25),
];

fn sphere<T: Real>() -> Sphere<T> {
    Sphere::solid(T::constant(5.06e-6), T::constant(2600.0)).unwrap()
}

impl Scene {
    fn run<T: Nodes<12>, const N: usize>(self, tolerance: f64) -> Impact<T, N> {
        let c = T::constant;
        let Self(speed, slip, zeta, strength, zeta_adhesion) = self;
        let scene = Contact::hertz(sphere(), Stiffness::new(c(7.5e10)).unwrap());
        let scene = scene.with_damping(c(zeta)).unwrap().with_ring(c(strength), c(zeta_adhesion)).unwrap();
        let oblique = NormalMotion::new(c(speed)).unwrap().with_tangential(c(slip)).unwrap();
        let motion: PlanarMotion<T> = oblique.with_peripheral_velocity(T::ZERO).unwrap();
        let method = Collocation::<12, T>::new(c(tolerance).max(c(8.0) * T::EPSILON)).unwrap();
        scene.with_friction(c(0.1)).unwrap().solve_for(&motion, &method, (EVERYTHING, Recording::<N>)).unwrap()
    }

    fn trajectory<const N: usize>(self, tolerance: f64) -> Trajectory<f64, N> {
        self.run::<f64, N>(tolerance).1.1
    }
}

fn gaps<T: Real, const N: usize>(trajectory: &Trajectory<T, N>) -> Vec<T> {
    trajectory.dimensionless().windows(2).map(|pair| pair[1].time - pair[0].time).collect()
}

fn largest<T: Real>(gaps: &[T]) -> T {
    gaps.iter().copied().fold(T::ZERO, Real::max)
}

fn assert_keeps_what_it_must<T: Nodes<12>, const N: usize>(scene: Scene, close: T) {
    let (impact, ((times, _, _, slip), trajectory)) = scene.run::<T, N>(1e-9);
    let normal = impact.normal;
    let samples: Vec<Sample<T>> = trajectory.samples().collect();
    let [first, .., last] = samples[..] else { panic!("{scene:?}: {samples:?}") };
    assert!(samples.len() <= N, "{scene:?}");
    assert!(gaps(&trajectory).into_iter().all(|gap| gap >= T::ZERO), "{scene:?}");
    let near = |a: T, b: T| (a - b).abs() <= close * b.abs();

    let zero = T::ZERO;
    assert_eq!((first.time, first.indentation, first.force, first.elastic), (zero, zero, zero, zero));
    assert!(near(first.velocity, T::constant(scene.0)), "{scene:?}");

    assert_eq!(trajectory.peak().map(|peak| peak.time), times.peak, "{scene:?}");
    // The same product in another order.
    let same = |a: T, b: Option<T>| (a - b.unwrap()).abs() <= T::constant(4.0) * T::EPSILON * a;
    if let Some(peak) = trajectory.peak() {
        assert!(same(peak.indentation, normal.peak_indentation()), "{scene:?}");
        assert!(samples.contains(&peak) && peak.velocity == zero, "{scene:?}");
    }

    assert_eq!(trajectory.roll().map(|roll| roll.time), slip.rolls_from, "{scene:?}");
    if let Some(roll) = trajectory.roll() {
        assert!(samples.contains(&roll), "{scene:?}");
    }

    if normal.outcome() == Some(Outcome::Rebound) {
        assert_eq!((Some(last.time), last.indentation), (times.contact, zero), "{scene:?}");
        assert!(near(-last.velocity, normal.rebound_speed()), "{scene:?}: {last:?}");
    } else if normal.turning_indentation().is_some() {
        assert!(same(last.indentation, normal.turning_indentation()) && last.velocity == zero, "{scene:?}");
    }
}

#[test]
fn first_touch_peak_roll_and_end_are_kept_exactly() {
    for scene in SCENES {
        assert_keeps_what_it_must::<f64, 4>(scene, 1e-7);
        assert_keeps_what_it_must::<f64, 5>(scene, 1e-7);
        assert_keeps_what_it_must::<f64, 7>(scene, 1e-7);
        assert_keeps_what_it_must::<f64, 16>(scene, 1e-7);
        assert_keeps_what_it_must::<f64, 64>(scene, 1e-7);
        assert_keeps_what_it_must::<f64, 512>(scene, 1e-7);
        assert_keeps_what_it_must::<f32, 4>(scene, 1e-4);
        assert_keeps_what_it_must::<f32, 32>(scene, 1e-4);
        assert_keeps_what_it_must::<f32, 512>(scene, 1e-4);
    }
}

/// The scenes above are what they are said to be.
#[test]
fn scenes_differ() {
    let runs = SCENES.map(|scene| scene.run::<f64, 512>(1e-9));
    let count = |of: &dyn Fn(&NormalContact<f64>) -> bool| runs.iter().filter(|(impact, _)| of(&impact.normal)).count();
    assert!(count(&|normal| normal.outcome() == Some(Outcome::Rebound)) >= 3);
    assert!(count(&|normal| normal.turning_indentation().is_some()) >= 1);
    assert!(count(&|normal| normal.peak_indentation().is_none()) >= 1);
    let rolls = runs.iter().filter(|(_, ((.., slip), _))| slip.rolls_from.is_some()).count();
    assert!((2..SCENES.len()).contains(&rolls), "{rolls}");
    // Some take many steps.
    let steps = runs.map(|(impact, _)| impact.run.steps);
    assert!(steps.iter().any(|steps| *steps > 20), "{steps:?}");
}

/// Largest gap over mean gap: below two but for the gaps that marked samples cut, and those that the steps leave.
fn assert_is_even<const N: usize>(scene: Scene) {
    let all = scene.trajectory::<4096>(1e-9);
    let steps = largest(&gaps(&all));
    let trajectory = scene.trajectory::<N>(1e-9);
    let (gaps, span) = (gaps(&trajectory), trajectory.dimensionless().last().unwrap().time);
    if all.dimensionless().len() < N {
        assert_eq!(trajectory.dimensionless(), all.dimensionless());
        return;
    }
    let mean = span / (gaps.len() as f64 - 3.0);
    let worst = largest(&gaps);
    assert!(worst <= 2.0 * mean + steps, "{scene:?}, {N}: {worst} {mean} {steps}");
    assert!(gaps.len() + 2 > N / 3, "{scene:?}, {N}: {}", gaps.len());
}

#[test]
fn samples_are_spread_evenly() {
    for scene in SCENES {
        assert_is_even::<8>(scene);
        assert_is_even::<16>(scene);
        assert_is_even::<32>(scene);
        assert_is_even::<64>(scene);
        assert_is_even::<128>(scene);
        assert_is_even::<512>(scene);
    }
}

/// Kinetic and potential energy of a dimensionless sample; p is the strength of adhesion.
fn energy(sample: &Sample<f64>, p: f64) -> f64 {
    let x = sample.indentation;
    0.5 * (sample.velocity * sample.velocity + x.powf(2.5) - p * x.powf(1.5))
}

#[test]
fn energy_never_grows() {
    for scene in SCENES {
        let trajectory = scene.trajectory::<512>(1e-12);
        // The peak of the undamped motion is the unit of length: 2 E = 1 - p.
        let first = trajectory.dimensionless()[0];
        let p = 1.0 - first.velocity * first.velocity;
        let energies: Vec<f64> = trajectory.dimensionless().iter().map(|sample| energy(sample, p)).collect();
        for pair in energies.windows(2) {
            assert!(pair[1] <= pair[0] + 1e-6 * energies[0], "{scene:?}: {pair:?}");
        }
        if scene.2 == 0.0 {
            assert!((energies[energies.len() - 1] / energies[0] - 1.0).abs() < 1e-11, "{scene:?}");
        }
    }
}

/// Error of the trapezoidal rule for the impulse of the force, which is the change of momentum, over the latter; and the
/// number of samples.
fn impulse_error<const N: usize>(scene: Scene) -> (f64, f64) {
    let trajectory = scene.trajectory::<N>(1e-9);
    let samples: Vec<Sample<f64>> = trajectory.samples().collect();
    let impulse: f64 =
        samples.windows(2).map(|pair| 0.5 * (pair[0].force + pair[1].force) * (pair[1].time - pair[0].time)).sum();
    let momentum = sphere::<f64>().mass() * (samples[0].velocity - samples[samples.len() - 1].velocity);
    ((impulse / momentum - 1.0).abs(), samples.len() as f64)
}

/// The rule is of second order.
#[test]
fn impulse_of_the_samples_is_the_change_of_momentum() {
    for scene in SCENES {
        let (error, samples) = impulse_error::<512>(scene);
        assert!(error < 0.01 && error * samples * samples < 25.0, "{scene:?}: {error}");
        if scene.2 < 100.0 {
            let (error, samples) = impulse_error::<16>(scene);
            assert!(error * samples * samples < 40.0, "{scene:?}: {error}");
        }
    }
}

/// Five numbers a sample, and nothing where none is asked for.
#[test]
fn room_of_a_recording() {
    type Plain = SimulatedImpact<f32, ()>;
    let sample = 5 * size_of::<f32>();
    assert_eq!(size_of::<Sample<f32>>(), sample);
    assert_eq!(size_of::<Trajectory<f32, 64>>() - size_of::<Trajectory<f32, 4>>(), 60 * sample);
    // Besides the samples their number, their units and the places of two of them.
    assert!(size_of::<Trajectory<f32, 4>>() <= 5 * sample + 6 * size_of::<usize>());
    assert_eq!(size_of::<Plain>(), size_of::<NormalContact<f32>>() + size_of::<RunReport<f32>>());
}
