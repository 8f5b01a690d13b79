//! Probabilities of classes against Monte Carlo, where inputs beyond their range take the nearest value of the range.

use std::fmt::Debug;

use microimpact::contact::{Collocation, Contact, Nodes, RingScene};
use microimpact::measure::{ClassProbabilities, Classifiable, NormalDistribution, Uncertain};
use microimpact::{
    Class, ConstantRestitution, Coulomb, CriticalSpeed, Dual, Fault, InputError, NormalMotion, Outcome, Parameter,
    PlanarMotion, Real, RestitutionLaw, RigidBody, SpeedRestitution, Sphere, Stiffness, rigid,
};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use reference::repetitions;

/// Accuracy that the documentation states.
const ACCURACY: f64 = 0.01;

const CLASSES: [Class; 4] =
    [Class::ReboundSliding, Class::ReboundRolling, Class::CapturedSliding, Class::CapturedRolling];

/// Inputs of a scene with their standard errors. An input without parameter has no range.
#[derive(Clone, Copy, Debug)]
struct Scene<const N: usize> {
    inputs: [f64; N],
    errors: [f64; N],
    parameters: [Option<Parameter>; N],
}

impl<const N: usize> Scene<N> {
    fn uncertain<T: Real>(&self) -> Result<[Uncertain<T>; N], InputError> {
        let mut inputs = [Uncertain::new(T::ZERO, T::ZERO)?; N];
        for (index, input) in inputs.iter_mut().enumerate() {
            *input = Uncertain::new(T::constant(self.inputs[index]), T::constant(self.errors[index]))?;
            if let Some(parameter) = self.parameters[index] {
                *input = input.within(parameter)?;
            }
        }
        Ok(inputs)
    }

    fn drawn(&self, random: &mut StdRng) -> [f64; N] {
        let mut inputs = self.inputs;
        for (index, input) in inputs.iter_mut().enumerate() {
            let deviation: f64 = StandardNormal.sample(random);
            *input += self.errors[index] * deviation;
            if let Some(parameter) = self.parameters[index] {
                let (smallest, largest) = parameter.range();
                *input = input.clamp(smallest, largest);
            }
        }
        inputs
    }

    /// Fractions of the classes in a number of draws.
    fn fractions(&self, random: &mut StdRng, draws: usize, class: impl Fn([f64; N]) -> Class) -> [f64; 4] {
        let mut counts = [0; 4];
        for _ in 0..draws {
            let class = match class(self.drawn(random)) {
                Class::CapturedResting => Class::CapturedRolling,
                class => class,
            };
            counts[CLASSES.iter().position(|other| *other == class).unwrap()] += 1;
        }
        counts.map(|count| f64::from(count) / draws as f64)
    }
}

fn probabilities<T: Real + Into<f64>>(found: ClassProbabilities<T>) -> [f64; 4] {
    CLASSES.map(|class| found.of(class).into())
}

fn difference(found: [f64; 4], expected: [f64; 4]) -> f64 {
    assert!((found.iter().sum::<f64>() - 1.0).abs() < 1e-6, "{found:?}");
    found.iter().zip(expected).map(|(found, expected)| (found - expected).abs()).fold(0.0, f64::max)
}

/// Number between two others, uniform in its logarithm.
fn logarithmic(random: &mut StdRng, smallest: f64, largest: f64) -> f64 {
    smallest * (largest / smallest).powf(random.random())
}

/// Number of standard errors from a boundary.
fn near(random: &mut StdRng) -> f64 {
    random.random_range(-1.5..1.5)
}

/// How a scene of the rigid body depends on its inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Speed, tangential velocity, peripheral velocity, f, W_A, k, r.
    Velocities,
    /// Speed along the path, tangent of the angle of incidence, spin, f, W_A, k, r: velocities share the first two and r.
    Angle,
    /// As `Velocities` with R instead of k, which is often limited to one.
    Restitution,
}

const KINDS: [Kind; 3] = [Kind::Velocities, Kind::Angle, Kind::Restitution];

type Body<T, L> = (RigidBody<T, L, rigid::WorkOfAdhesion<T>, Coulomb<T>>, PlanarMotion<T>);

fn body<T: Real, L: RestitutionLaw<T>>(law: L, inputs: [T; 7]) -> Result<Body<T, L>, InputError> {
    let [speed, tangential, peripheral, friction, work, _, radius] = inputs;
    let sphere = Sphere::solid(radius, T::constant(2600.0))?;
    let scene = RigidBody::new(sphere, law).with_work_of_adhesion(work)?.with_friction(friction)?;
    let motion = NormalMotion::new(speed)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
    Ok((scene, motion))
}

fn by_velocities<T: Real>(inputs: [T; 7]) -> Result<Body<T, SpeedRestitution<T>>, InputError> {
    body(SpeedRestitution::new(inputs[5])?, inputs)
}

fn by_angle<T: Real>(
    [speed, tangent, spin, f, work, k, radius]: [T; 7],
) -> Result<Body<T, SpeedRestitution<T>>, InputError> {
    let normal = speed / (T::ONE + tangent * tangent).sqrt();
    by_velocities([normal, normal * tangent, spin * radius, f, work, k, radius])
}

fn by_restitution<T: Real>(inputs: [T; 7]) -> Result<Body<T, ConstantRestitution<T>>, InputError> {
    body(ConstantRestitution::new(inputs[5])?, inputs)
}

impl Kind {
    fn parameters(self) -> [Option<Parameter>; 7] {
        use Parameter::{
            ApproachSpeed, Friction, PeripheralVelocity, Radius, Restitution, RestitutionSpeed, Spin,
            TangentialVelocity, WorkOfAdhesion,
        };
        let (along, turning) = match self {
            Self::Angle => (None, Spin),
            _ => (Some(TangentialVelocity), PeripheralVelocity),
        };
        let law = if self == Self::Restitution { Restitution } else { RestitutionSpeed };
        [Some(ApproachSpeed), along, Some(turning), Some(Friction), Some(WorkOfAdhesion), Some(law), Some(Radius)]
    }

    fn predicted<T: Real>(self, scene: &Scene<7>) -> Result<ClassProbabilities<T>, InputError> {
        let inputs = scene.uncertain()?;
        match self {
            Self::Velocities => ClassProbabilities::new(&inputs, by_velocities),
            Self::Angle => ClassProbabilities::new(&inputs, by_angle),
            Self::Restitution => ClassProbabilities::new(&inputs, by_restitution),
        }
    }

    fn class(self, inputs: [f64; 7]) -> Class {
        fn class<L: RestitutionLaw<f64>>((scene, motion): Body<f64, L>) -> Class {
            scene.classify(&motion).class()
        }
        match self {
            Self::Velocities => class(by_velocities(inputs).unwrap()),
            Self::Angle => class(by_angle(inputs).unwrap()),
            Self::Restitution => class(by_restitution(inputs).unwrap()),
        }
    }

    /// A scene within a few standard errors of both boundaries, with errors of 1 to 10 %.
    fn hard_scene(self, random: &mut StdRng) -> Scene<7> {
        let errors: [f64; 7] = std::array::from_fn(|_| logarithmic(random, 0.01, 0.1));
        let [speed, radius] = [(0.3, 10.0), (5e-7, 3e-5)].map(|(low, high)| logarithmic(random, low, high));
        let friction = logarithmic(random, 0.02, 0.5);
        let constant = self == Self::Restitution;
        let law = if constant { 1.0 - logarithmic(random, 0.003, 0.3) } else { logarithmic(random, 30.0, 500.0) };
        let restitution = |speed: f64| if constant { law } else { law / (law + speed) };
        let law_error = if constant { errors[5] } else { 0.0 };
        let spread =
            (errors[0].powi(2) + (0.5 * errors[4]).powi(2) + (1.5 * errors[6]).powi(2) + law_error.powi(2)).sqrt();
        let critical = speed * (spread * near(random)).exp();
        let held = restitution(critical) * critical;
        let sphere = Sphere::solid(radius, 2600.0).unwrap();
        let work = 0.5 * sphere.mass() * held * held;
        let e = (restitution(speed).powi(2) - (held / speed).powi(2)).max(0.0).sqrt() + random.random_range(0.0..0.3);
        let stopped = friction * speed * (1.0 + e.min(1.0)) / sphere.contact_inertia();
        let peripheral = speed * random.random_range(-1.0..1.0);
        let direction = if random.random() { 1.0 } else { -1.0 };
        let margin = (errors[0].powi(2) + errors[3].powi(2) + 0.03).sqrt() * near(random);
        let tangential = peripheral + direction * stopped * (1.0 + margin);
        let inputs = if self == Self::Angle {
            let tangent = tangential / speed;
            [speed * tangent.hypot(1.0), tangent, peripheral / radius, friction, work, law, radius]
        } else {
            [speed, tangential, peripheral, friction, work, law, radius]
        };
        let errors = std::array::from_fn(|index| errors[index] * inputs[index].abs());
        Scene { inputs, errors, parameters: self.parameters() }
    }
}

#[test]
fn restitution_that_rises_as_a_root() -> Result<(), InputError> {
    // Linear in the inputs, the rebound speed would give 0.446 for rebound sliding.
    let scene = Scene {
        inputs: [
            4.6480587503753314,
            0.4294542427787837,
            -0.7233432712827333,
            0.06495755672604567,
            1.2528010498797415e-10,
            221.3293280740263,
            1.0330450756940003e-5,
        ],
        errors: [0.1252, 0.0231, 0.0068, 4.66e-4, 2.04e-12, 1.62, 5e-8],
        parameters: Kind::Velocities.parameters(),
    };
    let expected = scene.fractions(&mut StdRng::seed_from_u64(2), 100_000, |inputs| Kind::Velocities.class(inputs));
    let found = probabilities(Kind::Velocities.predicted::<f64>(&scene)?);
    assert!(difference(found, expected) < ACCURACY, "{found:?} {expected:?}");
    Ok(())
}

/// Scenes with both boundaries near: 300, 100 of each kind, with MICROIMPACT_EXHAUSTIVE.
#[test]
fn classes_of_the_rigid_body() -> Result<(), InputError> {
    for kind in KINDS {
        for seed in 0..repetitions(100, 5) {
            let mut random = StdRng::seed_from_u64(1000 + seed as u64);
            let scene = kind.hard_scene(&mut random);
            let expected = scene.fractions(&mut random, 400_000, |inputs| kind.class(inputs));
            let found = probabilities(kind.predicted::<f64>(&scene)?);
            assert!(difference(found, expected) < ACCURACY, "{kind:?} {seed} {scene:?}: {found:?} {expected:?}");
            let single = probabilities(kind.predicted::<f32>(&scene)?);
            assert!(difference(single, found) < 1e-4, "{kind:?} {seed} {scene:?}: {single:?} {found:?}");
        }
    }
    Ok(())
}

/// Errors three times as large, of 3 to 30 %: 80 scenes with MICROIMPACT_EXHAUSTIVE.
#[test]
fn large_errors() -> Result<(), InputError> {
    for kind in [Kind::Velocities, Kind::Restitution] {
        for seed in 0..repetitions(40, 3) {
            let mut random = StdRng::seed_from_u64(1000 + seed as u64);
            let mut scene = kind.hard_scene(&mut random);
            scene.errors = scene.errors.map(|error| 3.0 * error);
            let expected = scene.fractions(&mut random, 100_000, |inputs| kind.class(inputs));
            let found = probabilities(kind.predicted::<f64>(&scene)?);
            assert!(difference(found, expected) < 4.0 * ACCURACY, "{kind:?} {seed} {scene:?}: {found:?} {expected:?}");
        }
    }
    Ok(())
}

/// Errors above three tenths, of each input that is never negative.
#[test]
fn larger_errors_are_refused() {
    for kind in KINDS {
        let scene = kind.hard_scene(&mut StdRng::seed_from_u64(3));
        for (index, parameter) in scene.parameters.into_iter().enumerate() {
            let mut large = scene;
            large.errors[index] = 0.301 * scene.inputs[index].abs();
            let of_one_sign = parameter.filter(|parameter| parameter.range().0 >= 0.0);
            let refused = kind.predicted::<f64>(&large).err().map(|error| (error.parameter, error.fault));
            assert_eq!(refused, of_one_sign.map(|parameter| (parameter, Fault::TooUncertain)), "{kind:?} {index}");
        }
    }
}

/// A scene whose R, near its bound or beyond it in many draws, is nearly all that is uncertain about the outcome.
fn bounded_scene(random: &mut StdRng) -> Scene<7> {
    let mut scene = Kind::Restitution.hard_scene(random);
    let [.., work, restitution, _] = &mut scene.inputs;
    let error = logarithmic(random, 0.005, 0.1);
    let before = *restitution;
    *restitution = 1.0 - error * random.random_range(0.0..2.5);
    // The same critical speed, or one that a deviation within the bound has.
    *work *= (*restitution * (1.0 + error * random.random_range(-1.5..0.5)) / before).powi(2);
    for (index, part) in [(0, 0.1), (4, 0.15), (6, 0.05)] {
        scene.errors[index] = part * error * scene.inputs[index] * random.random::<f64>();
    }
    scene.errors[5] = error;
    scene
}

/// Where one bounded input decides whether a sphere rebounds: 100 scenes with MICROIMPACT_EXHAUSTIVE.
#[test]
fn one_bounded_input_decides() -> Result<(), InputError> {
    for seed in 0..repetitions(100, 5) {
        let mut random = StdRng::seed_from_u64(2000 + seed as u64);
        let scene = bounded_scene(&mut random);
        let expected = scene.fractions(&mut random, 400_000, |inputs| Kind::Restitution.class(inputs));
        let found = probabilities(Kind::Restitution.predicted::<f64>(&scene)?);
        assert!(difference(found, expected) < ACCURACY, "{seed} {scene:?}: {found:?} {expected:?}");
        let single = probabilities(Kind::Restitution.predicted::<f32>(&scene)?);
        assert!(difference(single, found) < 1e-4, "{seed} {scene:?}: {single:?} {found:?}");
    }
    Ok(())
}

/// Far from a boundary, and with errors in one input alone, where the other boundary is a step.
#[test]
fn certain_outcomes_and_single_errors() -> Result<(), InputError> {
    let parameters = Kind::Velocities.parameters();
    let inputs = [2.8, 0.0, 0.739, 0.1, 2.22e-12, 130.0, 5.06e-6];
    let mut random = StdRng::seed_from_u64(5);
    for (changes, errors) in [
        (vec![], [0.08, 0.05, 0.1, 0.002, 0.1e-12, 5.0, 0.05e-6]),
        (vec![(2, 1.7)], [0.08, 0.05, 0.1, 0.002, 0.1e-12, 5.0, 0.05e-6]),
        (vec![(0, 1.2), (1, 0.5), (2, 0.2)], [0.08, 0.05, 0.1, 0.002, 0.1e-12, 5.0, 0.05e-6]),
        // Slips of either sign may be too large.
        (vec![(1, 0.75), (3, 0.012)], [0.08, 0.05, 0.1, 0.002, 0.1e-12, 5.0, 0.05e-6]),
        (vec![(0, 1.85), (2, 0.8)], [0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (vec![(0, 1.85), (2, 0.7)], [0.0, 0.0, 0.0, 0.0, 0.2e-12, 0.0, 0.0]),
        (vec![(0, 1.85), (2, 0.8)], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2e-6]),
        (vec![], [0.0; 7]),
    ] {
        let mut scene = Scene { inputs, errors, parameters };
        for (index, value) in changes {
            scene.inputs[index] = value;
        }
        let expected = scene.fractions(&mut random, 100_000, |inputs| Kind::Velocities.class(inputs));
        let found = probabilities(Kind::Velocities.predicted::<f64>(&scene)?);
        assert!(difference(found, expected) < ACCURACY, "{scene:?}: {found:?} {expected:?}");
    }
    Ok(())
}

#[test]
fn errors_too_large_are_refused() {
    fn refused<T: Real + Debug>(error: T) -> InputError {
        Uncertain::new(T::ONE, error).unwrap_err()
    }
    for (error, fault) in [(1e30, Fault::TooLarge), (f64::NAN, Fault::NotFinite), (-1.0, Fault::TooSmall)] {
        for found in [refused(error), refused(error as f32)] {
            assert_eq!((found.parameter, found.fault), (Parameter::StandardError, fault));
        }
    }
    // The largest error that is accepted, for one input after the other.
    let mut scene = Kind::Velocities.hard_scene(&mut StdRng::seed_from_u64(3));
    for index in 0..7 {
        let mut large = scene;
        large.errors[index] = Parameter::StandardError.range().1;
        match Kind::Velocities.predicted::<f32>(&large) {
            Ok(found) => assert!(probabilities(found).iter().all(|p| (0.0..=1.0).contains(p)), "{index} {found:?}"),
            Err(error) => assert_ne!(error.fault, Fault::NotFinite),
        }
    }
    scene.inputs[1] = f64::NAN;
    assert!(Kind::Velocities.predicted::<f64>(&scene).is_err());
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

const SIMULATED: [Option<Parameter>; 8] = [
    Some(Parameter::ApproachSpeed),
    Some(Parameter::Radius),
    Some(Parameter::Stiffness),
    Some(Parameter::AdhesionStrength),
    Some(Parameter::MaterialDamping),
    Some(Parameter::AdhesionDamping),
    Some(Parameter::TangentialVelocity),
    Some(Parameter::Friction),
];

/// A simulated scene within a few standard errors of both boundaries, with errors of 1 to 10 %.
fn hard_contact(random: &mut StdRng) -> Result<Scene<8>, InputError> {
    let errors: [f64; 8] = std::array::from_fn(|_| logarithmic(random, 0.01, 0.1));
    let ranges = [(1e-6, 6e-6), (3e10, 2e11), (100.0, 400.0), (3.0, 20.0), (2.0, 10.0)];
    let [radius, stiffness, f0, zeta_h, zeta_a] = ranges.map(|(low, high)| logarithmic(random, low, high));
    let friction = logarithmic(random, 0.02, 0.3);
    let (scene, _) = contact([1.0, radius, stiffness, f0, zeta_h, zeta_a])?;
    let CriticalSpeed::At(critical) = scene.critical_speed(&method()?)? else { panic!("{scene:?}") };
    let spread = (errors[0].powi(2) + errors[1].powi(2) + errors[3].powi(2)).sqrt();
    let speed = critical * (spread * near(random)).exp();
    let impact = (scene.with_friction(friction)?, NormalMotion::new(speed)?.with_tangential(0.0)?, &method()?);
    let stopped = impact.stopped_slip(speed.max(1.05 * critical), Outcome::Rebound)?.unwrap();
    let margin = (errors[0].powi(2) + errors[7].powi(2) + 0.01).sqrt() * near(random);
    let direction = if random.random() { 1.0 } else { -1.0 };
    let inputs = [speed, radius, stiffness, f0, zeta_h, zeta_a, direction * stopped * (1.0 + margin), friction];
    let errors = std::array::from_fn(|index| errors[index] * inputs[index].abs());
    Ok(Scene { inputs, errors, parameters: SIMULATED })
}

/// Simulated scenes with both boundaries near: 30 with MICROIMPACT_EXHAUSTIVE.
#[test]
fn classes_of_the_simulation() -> Result<(), InputError> {
    let draws = repetitions(100_000, 10_000);
    // Three standard errors of the fractions.
    let noise = 1.5 / (draws as f64).sqrt();
    let (exact, fast) = (method()?, Collocation::<7, f64>::new(1e-6)?);
    for seed in 0..repetitions(30, 3) {
        let mut random = StdRng::seed_from_u64(seed as u64);
        let scene = hard_contact(&mut random)?;
        let impact = |[speed, radius, stiffness, f0, zeta_h, zeta_a, tangential, friction]: [f64; 8]| {
            let (scene, motion) = contact([speed, radius, stiffness, f0, zeta_h, zeta_a])?;
            Ok((scene.with_friction(friction)?, motion.with_tangential(tangential)?))
        };
        let class = |inputs| {
            let (scene, motion) = impact(inputs).unwrap();
            let solved = scene.solve(&motion, &fast).unwrap().class();
            match solved {
                Some(Class::Undecided) | None => scene.solve(&motion, &exact).unwrap().class().unwrap(),
                Some(class) => class,
            }
        };
        let expected = scene.fractions(&mut random, draws as usize, class);
        let found = ClassProbabilities::new(&scene.uncertain()?, |inputs| {
            let (scene, motion) = impact(inputs)?;
            Ok((scene, motion, &exact))
        })?;
        let found = probabilities(found);
        assert!(difference(found, expected) < ACCURACY.max(noise), "{seed} {scene:?}: {found:?} {expected:?}");
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
    let scene = Scene { inputs, errors, parameters: [None; 6] };
    for _ in 0..DRAWS {
        let (scene, motion) = contact(scene.drawn(&mut random))?;
        let e = scene.solve_normal(&motion, &method()?)?.overall_restitution();
        square += (e - restitution.value).powi(2) / DRAWS as f64;
    }
    let error = restitution.standard_error(&errors);
    assert!((square.sqrt() / error - 1.0).abs() < 0.05, "{} {error}", square.sqrt());
    Ok(())
}

#[test]
fn normal_distribution() {
    for (x, expected) in [(-3.0, 0.001_349_898), (0.0, 0.5), (1.0, 0.841_344_746)] {
        assert!((f64::below(x) - expected).abs() < 1e-9);
        assert!((f64::from(f32::below(x as f32)) - expected).abs() < 1e-7);
    }
}
