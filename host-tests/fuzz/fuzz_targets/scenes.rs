//! Scenes of the simulation, solved by every method in `f32`, `f64` and fixed point. From this package's folder:
//!
//! ```text
//! cargo fuzz run --sanitizer none scenes
//! ```
//!
//! The bytes become a scene of any law with any of its terms (see the library of this package) and the settings of the methods. Checked:
//!
//! * nothing panics, and each scene ends in a result or in an [`InputError`];
//! * outputs of a solved impact are finite, and those of methods that control their error always;
//! * the outcome exists if and only if the status is *solved*;
//! * a rebound has a restitution of 0 to 1 and a ledger that balances; all else has a restitution of zero and no ledger;
//! * bounds of errors are finite and not negative;
//! * the outcome is not the opposite without outputs, unless e^2 is below ten bounds of its error;
//! * a critical speed is in its range, and is not contradicted by impacts that are 5 % slower or faster.
#![no_main]

use std::fmt::Debug;

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use microimpact::contact::{
    Adaptive, AdaptiveNodes, AnyLaw, Classified, Collocation, Contact, ContactImpulses, ContactTimes, ContactWorks,
    DimensionlessContact, DimensionlessImpact, Energy, FixedCost, Impulses, JkrEnd, Method, NormalContact, Output,
    PhaseSamples, Recording, RestCriterion, RungeKuttaGill, Sample, SimulatedImpact, Slip, SlipHistory, Status,
    Surface, TangentialVelocities, Times, Trajectory, Works,
};
use microimpact::rigid::EnergyLedger;
use microimpact::{
    Approach, CriticalSpeed, FixedPoint, Hertz, InputError, NormalMotion, Oblique, Outcome, Parameter, PlanarMotion,
    Real, Sphere, Stiffness,
};
use microimpact_fuzz::{scene, size};
use truth::Scene;

fuzz_target!(|data: &[u8]| {
    let Ok(trial) = Trial::of(&mut Unstructured::new(data)) else {
        return;
    };
    let _ = trial.run::<f64>();
    let _ = trial.run::<f32>();
    trial.run_in_fixed_point();
});

/// A scene and the settings of its solution.
#[derive(Debug)]
struct Trial {
    scene: Scene,
    terms: Terms,
    /// Tolerance of the methods that control their error.
    tolerance: f64,
    iterations: u32,
    steps: u32,
    rest: f64,
    turning_points: u32,
    /// Groups of a dimensionless impact.
    groups: [f64; 3],
    /// The speed over the critical one, less one, where it is to be near.
    near_critical: Option<f64>,
    law: Law,
    damping: Damping,
}

/// The terms of a scene.
#[derive(Debug)]
struct Terms {
    ring: bool,
    damping: bool,
    force: bool,
    surface: Along,
}

/// The law of contact: the paper's, or another with adhesion of about the same strength.
#[derive(Debug, PartialEq)]
enum Law {
    Paper,
    Dmt,
    Jkr(JkrEnd),
    WithoutTension,
}

/// The damping of the materials: the paper's, or another of about the same strength.
#[derive(Debug, PartialEq)]
enum Damping {
    Hysteretic,
    Viscoelastic,
    Constant,
}

/// What happens along the surface.
#[derive(Debug, PartialEq)]
enum Along {
    Nothing,
    Friction,
    Peeling,
}

/// Work of adhesion (J/m^2) over the strength of a ring (N/m) with about the same force.
const WORK_OVER_RING: f64 = 0.02;

/// More steps take too long.
const MOST_STEPS: u8 = 100;
const MOST_TURNING_POINTS: u8 = 100;

impl Trial {
    fn of(bytes: &mut Unstructured<'_>) -> Result<Self> {
        let terms = bytes.arbitrary::<u8>()?;
        let near = bytes.arbitrary::<u8>()?;
        let sign = if near & 4 == 0 { 1.0 } else { -1.0 };
        let scene = scene(bytes)?;
        let terms = Terms {
            ring: terms & 1 == 0,
            damping: terms & 2 == 0,
            force: terms & 12 == 12,
            surface: match terms >> 4 & 3 {
                0 => Along::Peeling,
                1 => Along::Nothing,
                _ => Along::Friction,
            },
        };
        let mut trial = Self {
            tolerance: size(bytes, Parameter::Tolerance.range())?,
            iterations: u32::from(bytes.arbitrary::<u8>()? % 44),
            steps: u32::from(bytes.arbitrary::<u8>()? % MOST_STEPS),
            rest: size(bytes, Parameter::RestEnergy.range())?,
            turning_points: u32::from(bytes.arbitrary::<u8>()? % MOST_TURNING_POINTS),
            groups: [size(bytes, (1e-6, 0.999))?, size(bytes, (1e-6, 0.5))?, size(bytes, (1e-6, 0.5))?],
            // Nearer by up to 1e-10 of it.
            near_critical: (near & 3 == 3).then(|| sign * 10_f64.powf(-f64::from(near >> 3) / 3.1)),
            scene,
            terms,
            law: Law::Paper,
            damping: Damping::Hysteretic,
        };
        // Last, so that bytes which end here mean what they always meant.
        let kind = bytes.arbitrary::<u8>()?;
        trial.law = match kind % 6 {
            1 | 2 => Law::Dmt,
            3 => Law::Jkr(JkrEnd::SnapOff),
            4 => Law::Jkr(JkrEnd::PullOff),
            5 => Law::WithoutTension,
            _ => Law::Paper,
        };
        trial.damping = match kind / 6 % 4 {
            1 | 2 => Damping::Viscoelastic,
            3 => Damping::Constant,
            _ => Damping::Hysteretic,
        };
        if !matches!(trial.law, Law::Paper | Law::Dmt) {
            trial.terms.force = false;
        }
        if trial.law != Law::Paper && trial.terms.surface == Along::Peeling {
            trial.terms.surface = Along::Friction;
        }
        Ok(trial)
    }

    fn run<T: Real + AdaptiveNodes + PhaseSamples<5, 9>>(&self) -> std::result::Result<(), InputError> {
        let number = T::constant;
        let Scene { radius, density, gyration_ratio, stiffness, speed, tangential, spin, .. } = self.scene;
        let sphere = Sphere::new(number(radius), number(density), number(gyration_ratio))?;
        let contact = Contact::new(sphere, self.law(Stiffness::new(number(stiffness))?)?);
        let mut speed = number(speed);
        if let Some(distance) = self.near_critical
            && let CriticalSpeed::At(critical) = contact.critical_speed(&Adaptive::new(number(1e-6))?)?
        {
            speed = critical * number(1.0 + distance);
        }
        let normal = NormalMotion::new(speed)?;
        let motion = normal.with_tangential(number(tangential))?.with_spin(&sphere, number(spin))?;
        let (friction, peeling) = (number(self.scene.friction), number(self.scene.peeling));
        let solver = Solver { trial: self, motion, scene: contact };
        match self.terms.surface {
            Along::Nothing => solver.by_every_method(&contact),
            Along::Friction => solver.by_every_method(&contact.with_friction(friction)?),
            Along::Peeling => solver.by_every_method(&contact.with_friction(friction)?.with_peeling(peeling)?),
        }
        Ok(())
    }

    fn law<T: Real>(&self, stiffness: Stiffness<T>) -> std::result::Result<AnyLaw<T>, InputError> {
        let (scene, number) = (&self.scene, T::constant);
        let work = number(WORK_OVER_RING * scene.adhesion);
        let mut law = match self.law {
            Law::Dmt => AnyLaw::dmt(stiffness, work)?,
            Law::Jkr(end) => AnyLaw::jkr(stiffness, work, end)?,
            Law::WithoutTension => AnyLaw::without_tension(stiffness),
            Law::Paper if self.terms.ring => {
                AnyLaw::ring(stiffness, number(scene.adhesion), number(scene.adhesion_damping))?
            }
            Law::Paper => AnyLaw::hertz(stiffness),
        };
        if self.terms.damping {
            let zeta = scene.material_damping;
            law = match self.damping {
                Damping::Hysteretic => law.with_damping(number(zeta))?,
                // The damping force of both at the peak of Hertz's impact.
                Damping::Viscoelastic => {
                    let sphere = Sphere::solid(scene.radius, scene.density)?;
                    let peak = Hertz::new(&sphere, Stiffness::new(scene.stiffness)?, &NormalMotion::new(scene.speed)?);
                    let group = (sphere.mass() / scene.radius.powi(3) / scene.stiffness / scene.speed.sqrt()).powf(0.4);
                    law.with_viscoelastic_damping(number(zeta * group * peak.indentation))?
                }
                Damping::Constant => law.with_constant_damping(number((-0.1 * zeta).exp()))?,
            };
        }
        if self.terms.force {
            law = law.with_external_force(number(scene.force))?;
        }
        Ok(law)
    }
}

impl Trial {
    /// The groups in `f64`, and scene and groups in fixed point.
    fn run_in_fixed_point(&self) {
        let [p, h, g] = self.groups;
        let mut impacts: Vec<DimensionlessImpact<FixedPoint>> =
            DimensionlessImpact::new(p, h, g).and_then(|impact| impact.in_fixed_point()).into_iter().collect();
        impacts.extend(self.dimensionless().and_then(|impact| impact.in_fixed_point()));
        impacts.extend(DimensionlessImpact::new(
            FixedPoint::constant(p),
            FixedPoint::constant(h),
            FixedPoint::constant(g),
        ));
        for impact in impacts {
            if let Ok(method) = FixedCost::<4>::new(self.iterations) {
                self.check_dimensionless(&impact.solve(&method));
            }
            if let Ok(method) = FixedCost::<5>::new(self.iterations) {
                self.check_dimensionless(&impact.solve(&method));
            }
            let by_steps = impact.solve(&RungeKuttaGill::new(self.steps));
            assert_eq!((by_steps.status, by_steps.outcome), (Status::Unsupported, None));
        }
        if let (Ok(impact), Ok(method)) = (DimensionlessImpact::new(p, h, g), Adaptive::new(self.tolerance)) {
            self.check_dimensionless(&impact.solve(&method));
        }
    }

    /// The scene without force and surface.
    fn dimensionless(&self) -> std::result::Result<DimensionlessImpact<f32>, InputError> {
        let number = |value: f64| value as f32;
        let Scene { radius, density, stiffness, speed, .. } = self.scene;
        let sphere = Sphere::solid(number(radius), number(density))?;
        Contact::hertz(sphere, Stiffness::new(number(stiffness))?)
            .with_damping(number(self.scene.material_damping))?
            .with_ring(number(self.scene.adhesion), number(self.scene.adhesion_damping))?
            .dimensionless(&NormalMotion::new(number(speed))?)
    }

    fn check_dimensionless<T: Real>(&self, contact: &DimensionlessContact<T>) {
        let DimensionlessContact { status, outcome, restitution_squared, error_bound } = *contact;
        let what = || format!("{self:?}: {contact:?}");
        assert_eq!(status == Status::Solved, outcome.is_some(), "{}", what());
        check_restitution(restitution_squared, outcome, error_bound, &what);
        check_restitution(contact.overall_restitution(), outcome, error_bound, &what);
    }
}

/// A restitution or its square, against the outcome and the bound of the error.
fn check_restitution<T: Real>(e: T, outcome: Option<Outcome>, bound: T, what: &dyn Fn() -> String) {
    if outcome == Some(Outcome::Rebound) {
        assert!(e >= T::ZERO && e <= T::ONE + bound + T::constant(16.0) * T::EPSILON, "{}", what());
    } else {
        assert!(e == T::ZERO, "{}", what());
    }
    if outcome.is_some() {
        assert!(bound.is_finite() && bound >= T::ZERO, "{}", what());
    }
}

/// Numbers of a result, by whether each exists.
trait Numbers<T> {
    fn numbers(&self) -> Vec<Option<T>>;
}

impl<T> Numbers<T> for () {
    fn numbers(&self) -> Vec<Option<T>> {
        Vec::new()
    }
}

impl<T: Real> Numbers<T> for TangentialVelocities<T> {
    fn numbers(&self) -> Vec<Option<T>> {
        vec![Some(self.velocity()), Some(self.spin()), self.friction_over_limit()]
    }
}

impl<T: Real> Numbers<T> for SlipHistory<T> {
    fn numbers(&self) -> Vec<Option<T>> {
        let Self { velocity, spin, rotation, displacement, rolls_from, .. } = *self;
        vec![Some(velocity), Some(spin), Some(rotation), Some(displacement), rolls_from]
    }
}

impl<T: Real> Numbers<T> for ContactTimes<T> {
    fn numbers(&self) -> Vec<Option<T>> {
        vec![self.peak, self.contact]
    }
}

impl<T: Real> Numbers<T> for ContactImpulses<T> {
    fn numbers(&self) -> Vec<Option<T>> {
        vec![Some(self.elastic), Some(self.adhesion_rebound)]
    }
}

impl<T: Real> Numbers<T> for ContactWorks<T> {
    fn numbers(&self) -> Vec<Option<T>> {
        vec![Some(self.material), Some(self.adhesion)]
    }
}

impl<T: Real> Numbers<T> for Option<EnergyLedger<T>> {
    fn numbers(&self) -> Vec<Option<T>> {
        self.iter().flat_map(|l| [l.before, l.after, l.material, l.adhesion, l.friction, l.rolling]).map(Some).collect()
    }
}

impl<T: Real> Numbers<T> for NormalContact<T> {
    fn numbers(&self) -> Vec<Option<T>> {
        let (peak, turning) = (self.peak_indentation(), self.turning_indentation());
        vec![Some(self.overall_restitution()), Some(self.rebound_speed()), peak, turning]
    }
}

impl<T: Real, const N: usize> Numbers<T> for Trajectory<T, N> {
    fn numbers(&self) -> Vec<Option<T>> {
        let numbers =
            |sample: Sample<T>| [sample.time, sample.indentation, sample.velocity, sample.force, sample.elastic];
        self.samples().flat_map(numbers).map(Some).collect()
    }
}

/// What a method knows of its error.
#[derive(Clone, Copy, PartialEq)]
enum Care {
    /// It keeps a tolerance.
    Controlled,
    /// It states a bound.
    Bounded,
}

/// A bound of the error of e^2 within which all results lie that count as solved.
const LARGEST_BOUND: f64 = 0.1;

/// A scene without surface, the motion before its impact, and where they come from.
struct Solver<'a, T> {
    trial: &'a Trial,
    motion: PlanarMotion<T>,
    scene: Contact<T, AnyLaw<T>>,
}

type OutputsOf<T, S> = <Slip as Output<T, <S as Surface<T, PlanarMotion<T>>>::Start>>::Result;

impl<T: Real + AdaptiveNodes + PhaseSamples<5, 9>> Solver<'_, T> {
    fn by_every_method<S>(&self, scene: &Contact<T, AnyLaw<T>, S>)
    where
        S: Surface<T, PlanarMotion<T>, After: Numbers<T> + Classified<T> + Debug>,
        Slip: Output<T, S::Start>,
        Energy: Output<T, S::Start, Result = Option<EnergyLedger<T>>>,
        OutputsOf<T, S>: Numbers<T> + Debug,
    {
        let Trial { tolerance, iterations, steps, .. } = *self.trial;
        let tolerance = T::constant(tolerance);
        if let Ok(method) = Adaptive::new(tolerance) {
            self.check(scene, &method, Care::Controlled);
            self.check_critical_speed(&method);
            self.check_rest(scene, &method);
            self.check_class(scene, &method);
        }
        // So many nodes suit no smaller tolerance.
        if let Ok(method) = Collocation::<7, T>::new(tolerance.max(T::constant(3e-7))) {
            self.check(scene, &method, Care::Controlled);
        }
        if let Ok(method) = Collocation::<9, T>::new(tolerance.max(T::constant(3e-10))) {
            self.check(scene, &method, Care::Controlled);
        }
        if let Ok(method) = FixedCost::<5>::new(iterations) {
            self.check(scene, &method, Care::Bounded);
            self.check(scene, &method.with_outputs::<10>(), Care::Bounded);
        }
        if let Ok(method) = FixedCost::<7>::new(iterations) {
            self.check(scene, &method.with_outputs::<13>(), Care::Bounded);
        }
        self.check(scene, &RungeKuttaGill::new(steps), Care::Bounded);
    }

    /// Kinetic energy before the impact; without friction only that of the normal motion takes part.
    fn kinetic(&self) -> T {
        let (v, u, sphere) = (self.motion.tangential(), self.motion.peripheral(), self.scene.sphere());
        let speed = self.motion.normal().speed();
        let along =
            if self.trial.terms.surface == Along::Nothing { T::ZERO } else { v * v + sphere.gyration_ratio() * u * u };
        T::constant(0.5) * sphere.mass() * (speed * speed + along)
    }

    /// The scene as 13 numbers, and the trial in words.
    fn inputs(&self) -> String {
        let speed = self.motion.normal().speed().to_f64();
        let (scene, number) = (Scene { speed, ..self.trial.scene }, std::any::type_name::<T>());
        format!("{scene} in {number}, {:?}", self.trial)
    }

    /// The impact by a method, and what that knows of its error.
    fn check<S>(&self, scene: &Contact<T, AnyLaw<T>, S>, method: &(impl Method<T> + Debug), care: Care)
    where
        S: Surface<T, PlanarMotion<T>, After: Numbers<T> + Debug>,
        Slip: Output<T, S::Start>,
        Energy: Output<T, S::Start, Result = Option<EnergyLedger<T>>>,
        OutputsOf<T, S>: Numbers<T> + Debug,
    {
        let outputs = ((Times, Impulses, Works), (Slip, Energy), Recording::<8>);
        let Ok((impact, outputs)) = scene.solve_for(&self.motion, method, outputs) else {
            return;
        };
        let ((times, impulses, works), (slip, ledger), trajectory) = &outputs;
        let SimulatedImpact { normal, tangential, run } = &impact;
        let what = || format!("{} {method:?}: {impact:?} {outputs:?}", self.inputs());
        assert_eq!(run.status, normal.status(), "{}", what());
        check_normal(normal, run.error_bound, &what);
        let numbers = [
            normal.numbers(),
            tangential.numbers(),
            times.numbers(),
            impulses.numbers(),
            works.numbers(),
            slip.numbers(),
            ledger.numbers(),
            trajectory.numbers(),
        ]
        .concat();
        let solved = run.status == Status::Solved;
        assert!(!solved || are_finite(&normal.numbers()), "{}", what());
        // What is not solved may have diverged.
        if solved || care == Care::Controlled {
            assert!(are_finite(&numbers), "{}", what());
        }
        let rebounds = normal.outcome() == Some(Outcome::Rebound);
        assert_eq!(rebounds, ledger.is_some(), "{}", what());
        assert!(rebounds || times.contact.is_none(), "{}", what());
        assert!(times.peak.is_none_or(|peak| peak >= T::ZERO), "{}", what());
        assert!(!rebounds || times.contact >= times.peak, "{}", what());
        assert!(!solved || run.estimated_error >= T::ZERO, "{}", what());
        self.check_ledger(ledger.as_ref(), care == Care::Controlled, &what);
        // In single precision an energy may be too small a number.
        let (kinetic, least) = (self.kinetic(), T::constant(1e-30));
        let keeps = |ledger: &EnergyLedger<T>| (ledger.before / kinetic - T::ONE).abs() <= T::constant(0.1);
        assert!(kinetic < least || ledger.as_ref().is_none_or(keeps), "{}", what());
        let bound = if care == Care::Controlled { run.error_bound } else { T::constant(LARGEST_BOUND) };
        self.check_alone(normal, method, bound);
    }

    /// The normal motion without outputs, whose bound is of the same order, has not the opposite outcome.
    fn check_alone(&self, normal: &NormalContact<T>, method: &(impl Method<T> + Debug), bound: T) {
        let Ok(alone) = self.scene.solve_normal(&self.motion, method) else {
            return;
        };
        let what = || format!("{} {method:?}: {alone:?} {normal:?}", self.inputs());
        assert_eq!(alone.status() == Status::Solved, alone.outcome().is_some(), "{}", what());
        let e = alone.overall_restitution().max(normal.overall_restitution());
        // Bounds are estimates: near the critical speed two runs may differ by a few of them.
        let opposite = are_opposite(alone.outcome(), normal.outcome());
        assert!(!opposite || e * e <= T::constant(10.0) * bound, "{}", what());
    }

    /// The losses make up the difference of the energies, within what any tolerance allows.
    fn check_ledger(&self, ledger: Option<&EnergyLedger<T>>, controlled: bool, what: &dyn Fn() -> String) {
        // In single precision an energy may be too small a number, and the work of a force may far exceed all energies.
        let exact = T::EPSILON < T::constant(1e-10) && !self.trial.terms.force;
        if let Some(ledger) = ledger.filter(|_| exact && controlled) {
            let balance = ledger.lost() - (ledger.before - ledger.after);
            assert!(balance.abs() <= T::constant(0.1) * ledger.before, "{}", what());
        }
    }

    /// A critical speed is in its range; slower spheres are captured and faster ones rebound.
    fn check_critical_speed(&self, method: &Adaptive<T>) {
        let scene = &self.scene;
        let Ok(CriticalSpeed::At(speed)) = scene.critical_speed(method) else {
            return;
        };
        let what = || format!("{}: {speed:?}", self.inputs());
        let (slowest, fastest) = Parameter::ApproachSpeed.range();
        assert!(speed >= T::constant(slowest) && speed <= T::constant(fastest), "{}", what());
        let outcome = |speed: T| scene.solve(&NormalMotion::new(speed).ok()?, method).ok()?.normal.outcome();
        assert_ne!(outcome(speed * T::constant(1.05)), Some(Outcome::Capture), "{}", what());
        // A force out of the surface turns back slow spheres before adhesion holds them.
        if !self.trial.terms.force {
            assert_ne!(outcome(speed / T::constant(1.05)), Some(Outcome::Rebound), "{}", what());
        }
    }

    /// A captured sphere comes to rest, or the status says that it did not.
    fn check_rest<S>(&self, scene: &Contact<T, AnyLaw<T>, S>, method: &Adaptive<T>)
    where
        S: Surface<T, PlanarMotion<T>, After: Numbers<T> + Debug>,
        Slip: Output<T, S::Start>,
        OutputsOf<T, S>: Numbers<T> + Debug,
    {
        let Trial { rest, turning_points, .. } = *self.trial;
        let Ok(criterion) = RestCriterion::new(T::constant(rest), turning_points) else {
            return;
        };
        let Ok(settled) = scene.solve_to_rest(&self.motion, method, &criterion, (Times, Slip)) else {
            return;
        };
        let what = || format!("{}: {settled:?}", self.inputs());
        let SimulatedImpact { normal, tangential, run } = &settled.impact;
        check_normal(normal, run.error_bound, &what);
        assert_eq!(normal.outcome() == Some(Outcome::Capture), settled.motion.is_some(), "{}", what());
        let (times, slip) = &settled.outputs;
        let numbers = [normal.numbers(), tangential.numbers(), times.numbers(), slip.numbers()].concat();
        assert!(are_finite(&numbers), "{}", what());
        if let Some(motion) = settled.motion {
            assert!(motion.time >= T::ZERO && motion.time.is_finite() && motion.indentation.is_finite(), "{}", what());
            assert!(motion.turning_points <= turning_points, "{}", what());
        }
    }

    /// A class exists if and only if there is an outcome, and its margins are positive numbers.
    fn check_class<S>(&self, scene: &Contact<T, AnyLaw<T>, S>, method: &Adaptive<T>)
    where
        S: Surface<T, PlanarMotion<T>, After: Classified<T>>,
    {
        if let Ok(Some(class)) = scene.classify(&self.motion, method) {
            let what = || format!("{}: {:?}", self.inputs(), class.speed_over_critical);
            assert!(
                class.speed_over_critical.is_none_or(|margin| margin > T::ZERO && margin.is_finite()),
                "{}",
                what()
            );
        }
    }
}

fn check_normal<T: Real>(normal: &NormalContact<T>, bound: T, what: &dyn Fn() -> String) {
    let outcome = normal.outcome();
    assert_eq!(normal.status() == Status::Solved, outcome.is_some(), "{}", what());
    check_restitution(normal.overall_restitution(), outcome, bound, what);
}

fn are_finite<T: Real>(numbers: &[Option<T>]) -> bool {
    numbers.iter().flatten().all(|number| number.is_finite())
}

/// Whether one is a rebound and the other a capture.
fn are_opposite(one: Option<Outcome>, other: Option<Outcome>) -> bool {
    use Outcome::{Capture, Rebound};
    matches!((one, other), (Some(Rebound), Some(Capture)) | (Some(Capture), Some(Rebound)))
}
