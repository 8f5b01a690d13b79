//! The speed that separates capture from rebound in the contact simulation.

use std::cell::LazyCell;
use std::f64::consts::PI;

use microimpact::contact::{Collocation, ConstantForce, Contact, HertzLaw, HystereticDamping, Nodes, Ring};
use microimpact::{CriticalSpeed, Fault, InputError, NormalMotion, Outcome, Parameter, Real, Sphere, Stiffness};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use reference::scenes::{Kind, critical_speed_near};

const REFERENCE: &str = include_str!("../../data/critical.csv");

type Scene<T> = Contact<T, HertzLaw<T, HystereticDamping<T>, Ring<T>, ConstantForce<T>>>;

/// A scene by its inputs in SI units.
#[derive(Clone, Copy, Debug)]
struct Inputs {
    radius: f64,
    density: f64,
    stiffness: f64,
    adhesion: f64,
    zeta_h: f64,
    zeta_a: f64,
    force: f64,
}

/// The spheres of figure 6, 5 um in diameter.
const FIGURE_6: Inputs = Inputs {
    radius: 2.5e-6,
    density: 2600.0,
    stiffness: 7.5e10,
    adhesion: 250.0,
    zeta_h: 10.5,
    zeta_a: 6.25,
    force: 0.0,
};

impl Inputs {
    fn scene<T: Real>(&self) -> Result<Scene<T>, InputError> {
        let sphere = Sphere::solid(T::constant(self.radius), T::constant(self.density))?;
        Contact::hertz(sphere, Stiffness::new(T::constant(self.stiffness))?)
            .with_damping(T::constant(self.zeta_h))?
            .with_ring(T::constant(self.adhesion), T::constant(self.zeta_a))?
            .with_external_force(T::constant(self.force))
    }

    fn critical<const N: usize, T: Nodes<N>>(&self, tolerance: f64) -> Result<CriticalSpeed<T>, InputError> {
        self.scene()?.critical_speed(&Collocation::<N, T>::new(T::constant(tolerance))?)
    }

    /// Those of a scene that matter for the critical speed.
    fn of(scene: &truth::Scene) -> Self {
        Self {
            radius: scene.radius,
            density: scene.density,
            stiffness: scene.stiffness,
            adhesion: scene.adhesion,
            zeta_h: scene.material_damping,
            zeta_a: scene.adhesion_damping,
            force: scene.force,
        }
    }

    fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.density * self.radius.powi(3)
    }

    fn equilibrium(&self) -> f64 {
        2.0 * PI * self.adhesion / self.stiffness
    }

    /// Force of adhesion at the equilibrium.
    fn adhesion_force(&self) -> f64 {
        2.0 * PI * self.adhesion * (self.radius * self.equilibrium()).sqrt()
    }

    /// Largest force with which the surface holds a resting sphere.
    fn largest_tension(&self) -> f64 {
        // Adhesion less elasticity is largest at a third of the equilibrium indentation.
        2.0 / 3.0 * (1.0_f64 / 3.0).sqrt() * self.adhesion_force()
    }

    /// The unit of speed in which the critical speed depends on the damping alone.
    fn unit(&self) -> f64 {
        self.equilibrium() * (self.stiffness * (self.radius * self.equilibrium()).sqrt() / self.mass()).sqrt()
    }

    fn outcome(&self, speed: f64) -> Outcome {
        let method = Collocation::<12, f64>::new(1e-12).unwrap();
        self.scene().unwrap().solve_normal(&NormalMotion::new(speed).unwrap(), &method).unwrap().outcome().unwrap()
    }

    /// Whether the outcome is this one, or undecided with an energy left that is no larger than twice its stated error.
    fn ends_in(&self, outcome: Outcome, speed: f64) -> bool {
        if self.outcome(speed) != Outcome::Undecided {
            return self.outcome(speed) == outcome;
        }
        let method = Collocation::<12, f64>::new(1e-12).unwrap();
        let run = self.scene().unwrap().solve(&NormalMotion::new(speed).unwrap(), &method).unwrap().run;
        let [r, density, k, f0, force] = [self.radius, self.density, self.stiffness, self.adhesion, self.force];
        let numbers = [r, density, 0.4, k, f0, self.zeta_h, self.zeta_a, 0.0, 0.0, force, speed, 0.0, 0.0];
        let margin = truth::solve(&truth::Scene::from_numbers(numbers), 1000).margin.unwrap();
        margin.to_f64().abs() <= 2.0 * run.error_bound
    }
}

fn speed<T: std::fmt::Debug>(result: Result<CriticalSpeed<T>, InputError>) -> T {
    match result {
        Ok(CriticalSpeed::At(speed)) => speed,
        other => panic!("{other:?}"),
    }
}

fn reference() -> Vec<(Inputs, f64)> {
    let mut reader = csv::Reader::from_reader(REFERENCE.as_bytes());
    let numbers =
        |row: csv::StringRecord| -> Vec<f64> { row.iter().skip(1).map(|cell| cell.parse().unwrap()).collect() };
    let rows = reader.records().map(|row| numbers(row.unwrap()));
    rows.map(|row| {
        let [radius, density, stiffness, adhesion, zeta_h, zeta_a, speed] = row.try_into().unwrap();
        (Inputs { radius, density, stiffness, adhesion, zeta_h, zeta_a, force: 0.0 }, speed)
    })
    .collect()
}

#[test]
fn reference_is_met() {
    let rows = reference();
    assert_eq!(rows.len(), 8);
    for (inputs, exact) in rows {
        let error = |speed: f64| (speed / exact - 1.0).abs();
        for (found, allowed) in [
            (speed(inputs.critical::<12, f64>(1e-12)), 2e-12),
            (speed(inputs.critical::<9, f64>(1e-9)), 1e-9),
            (speed(inputs.critical::<7, f64>(1e-6)), 1e-6),
            (f64::from(speed(inputs.critical::<8, f32>(1e-6))), 2e-6),
        ] {
            assert!(error(found) <= allowed, "{inputs:?}: {:e} of {allowed:e}", error(found));
        }
    }
}

/// Ten tolerances at most and one nearly always, but for four times what one unit of each input changes.
#[test]
fn tolerance_is_kept_over_random_scenes() {
    const SEED: u64 = 1;
    /// Relative change of an input whose effect tells that of one unit.
    const CHANGE: f64 = 1e-6;
    let (mut all, mut beyond) = (0, 0);
    for kind in [Kind::Mild, Kind::Critical, Kind::Equilibrium, Kind::Barrier, Kind::LargestTension] {
        for number in 0..reference::repetitions(1000, 40) {
            let scene = kind.scene(SEED, number);
            let inputs = Inputs::of(&scene);
            let Ok(CriticalSpeed::At(strict)) = inputs.critical::<12, f64>(1e-12) else { continue };
            let Some(exact) = critical_speed_near(&scene, strict) else { continue };
            let changes = LazyCell::new(|| {
                let change = |mut numbers: [f64; 13], input: usize| {
                    numbers[input] *= 1.0 + CHANGE;
                    let changed = critical_speed_near(&truth::Scene::from_numbers(numbers), exact);
                    changed.map_or(0.0, |changed| (changed / exact - 1.0).abs() / CHANGE)
                };
                (0..10).map(|input| change(scene.numbers(), input)).sum::<f64>()
            });
            let error = |speed: f64, tolerance: f64, unit: f64| {
                let error = (speed / exact - 1.0).abs();
                if error > tolerance { (error - 4.0 * unit * *changes) / tolerance } else { error / tolerance }
            };
            for error in [
                error(strict, 1e-12, f64::EPSILON),
                error(speed(inputs.critical::<9, f64>(1e-9)), 1e-9, f64::EPSILON),
                error(speed(inputs.critical::<7, f64>(1e-6)), 1e-6, f64::EPSILON),
                error(speed(inputs.critical::<7, f64>(1e-4)), 1e-4, f64::EPSILON),
            ] {
                assert!(error <= 10.0, "{}: {error} tolerances, {scene}", kind.name());
                beyond += u32::from(error > 1.0);
                all += 1;
            }
            if kind != Kind::LargestTension && scene == scene.in_single_precision() {
                let single = f64::from(speed(inputs.critical::<7, f32>(1e-6)));
                assert!((single / exact - 1.0).abs() < 5e-4, "{}: {single} for {exact}, {scene}", kind.name());
            }
        }
    }
    assert!(all > 100 && beyond * 100 < all, "{beyond} of {all}");
}

/// A well that is flat but for a millionth of the forces is still seen in single precision.
#[test]
fn a_nearly_flattened_well_is_seen_in_single_precision() {
    const SEED: u64 = 1;
    const FLAT: f64 = 1e-6;
    let (mut seen, mut nearly_flat) = (0, 0);
    for number in 0..reference::repetitions(1500, 500) {
        let inputs = Inputs::of(&Kind::LargestTension.scene(SEED, number).in_single_precision());
        let left = 1.0 - inputs.force / inputs.largest_tension();
        if left < FLAT
            || !matches!(inputs.critical::<12, f64>(1e-12), Ok(found) if found != CriticalSpeed::AlwaysRebounds)
        {
            continue;
        }
        assert_ne!(inputs.critical::<7, f32>(1e-6), Ok(CriticalSpeed::AlwaysRebounds), "{left:e} {inputs:?}");
        seen += 1;
        nearly_flat += u32::from(left < 30.0 * FLAT);
    }
    assert!(seen > 30 && nearly_flat > 3, "{nearly_flat} of {seen}");
}

/// Damping that depends on the speed is at the critical speed what it would be if held constant.
#[test]
fn exact_speeds_with_the_damping_at_the_critical_speed() {
    for (damping, exact, digits) in [
        (1e-4, 0.018_194_5, 5e-8),
        (1e-3, 0.057_615, 5e-8),
        (0.01, 0.184_717_255, 5e-10),
        (0.1, 0.675_811_296, 5e-10),
        (0.3, 1.807_647_853, 5e-10),
        (0.4, 3.029_947_387, 5e-10),
    ] {
        for radius in [1e-8, 1e-6, 1e-3] {
            let inputs = Inputs { radius, zeta_a: 0.0, ..FIGURE_6 };
            let critical = exact * inputs.unit();
            // c_H = zeta_H C with C of B4.
            let c = (inputs.mass() / (radius.powi(3) * inputs.stiffness * critical.sqrt())).powf(0.4);
            let inputs = Inputs { zeta_h: damping / inputs.unit() / c, ..inputs };
            let found = speed(inputs.critical::<12, f64>(1e-12)) / inputs.unit();
            // The slope of the table's speed by its damping turns into a smaller one where the damping falls with speed.
            assert!((found - exact).abs() <= digits, "{damping}: {found} for {exact}");
        }
    }
}

/// Damping up to what lets the critical speed exceed that of adhesion alone by far; there little is left of the energy at
/// the bottom of the potential.
#[test]
fn tolerance_is_kept_under_strong_damping() {
    for adhesion in [0.0, 0.6] {
        for step in 0..30 {
            let zeta_h = 8.0 * 1.08_f64.powi(step);
            let inputs = Inputs { zeta_h, zeta_a: adhesion * zeta_h, ..FIGURE_6 };
            let exact = speed(inputs.critical::<14, f64>(1e-13));
            if exact > 10.0 * inputs.unit() {
                continue;
            }
            for (found, tolerance) in [
                (speed(inputs.critical::<12, f64>(1e-12)), 1e-12),
                (speed(inputs.critical::<10, f64>(1e-9)), 1e-9),
                (speed(inputs.critical::<9, f64>(1e-9)), 1e-9),
                (speed(inputs.critical::<8, f64>(1e-6)), 1e-6),
                (speed(inputs.critical::<7, f64>(1e-6)), 1e-6),
            ] {
                let error = (found / exact - 1.0).abs();
                assert!(error <= 2.0 * tolerance, "{inputs:?}: {error:e} of {tolerance:e}");
            }
        }
    }
}

/// A barrier closer to first touch than single precision tells apart from it is still where a sphere separates at rest.
#[test]
fn a_barrier_next_to_first_touch_is_seen_in_single_precision() {
    let inputs = Inputs {
        radius: 1.35e-7,
        density: 360.0,
        stiffness: 3.88e9,
        adhesion: 9.3e-3,
        zeta_h: 44.0,
        zeta_a: 2.24e4,
        force: 0.0,
    };
    for step in 0..24 {
        let pulled = Inputs { force: 10_f64.powf(-12.0 + 0.5 * f64::from(step)) * inputs.adhesion_force(), ..inputs };
        let double = speed(pulled.critical::<12, f64>(1e-12));
        let single = f64::from(speed(pulled.critical::<8, f32>(1e-6)));
        assert!((single / double - 1.0).abs() < 1e-4, "{pulled:?}: {single} for {double}");
    }
}

#[test]
fn capture_speed_of_the_paper() {
    assert!((speed(FIGURE_6.critical::<9, f64>(1e-9)) - 5.160).abs() < 5e-4);
}

#[test]
fn no_critical_speed_where_there_is_none() {
    let always = |inputs: Inputs| assert_eq!(inputs.critical::<9, f64>(1e-9), Ok(CriticalSpeed::AlwaysRebounds));
    always(Inputs { adhesion: 0.0, ..FIGURE_6 });
    always(Inputs { zeta_h: 0.0, zeta_a: 0.0, ..FIGURE_6 });
    // A force out of the surface that is stronger than adhesion anywhere.
    always(Inputs { force: 1e-3, ..FIGURE_6 });
    let never = Inputs { zeta_h: 1e5, ..FIGURE_6 };
    assert_eq!(never.critical::<9, f64>(1e-9), Ok(CriticalSpeed::NeverRebounds));
    assert_eq!(never.outcome(1e6), Outcome::Capture);
    let soft = Inputs { radius: 1e-9, stiffness: 1.0, adhesion: 1e9, ..FIGURE_6 };
    assert_eq!(soft.critical::<9, f64>(1e-9).unwrap_err().parameter, Parameter::AdhesionRatio);
}

/// 75 Pa instead of 75 GPa: the largest speeds are captured, and no speed that occurs suits the scene.
#[test]
fn a_stiffness_in_the_wrong_unit() {
    let soft = Inputs { stiffness: 75.0, ..FIGURE_6 };
    assert_eq!(soft.outcome(1e6), Outcome::Capture);
    let error = soft.critical::<9, f64>(1e-9).unwrap_err();
    assert_eq!((error.parameter, error.fault), (Parameter::DampingRatio, Fault::TooLarge));
}

#[test]
fn a_barrier_of_an_external_force_turns_slow_spheres_back() {
    let inputs = Inputs { radius: 1e-6, zeta_h: 10.0, zeta_a: 6.0, force: 3e-5, ..FIGURE_6 };
    let critical = speed(inputs.critical::<12, f64>(1e-12));
    // So close to a barrier, and behind it, energies hardly differ.
    assert_ne!(inputs.outcome(critical * (1.0 + 1e-6)), Outcome::Capture);
    assert_eq!(inputs.outcome(critical * (1.0 + 1e-4)), Outcome::Rebound);
    assert_eq!(inputs.outcome(critical * (1.0 - 1e-4)), Outcome::Capture);
    assert_eq!(inputs.outcome(1.0), Outcome::Capture);
    assert_eq!(inputs.outcome(0.5), Outcome::Rebound);
}

#[test]
fn a_force_into_the_surface_captures_without_adhesion() {
    let inputs = Inputs { radius: 1e-3, adhesion: 0.0, zeta_a: 0.0, force: -1e-3, ..FIGURE_6 };
    let critical = speed(inputs.critical::<12, f64>(1e-12));
    let twice = Inputs { force: -2e-3, ..inputs };
    assert!(speed(twice.critical::<12, f64>(1e-12)) > critical);
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(1995), failure_persistence: None, ..ProptestConfig::default() }
}

/// A number with its logarithm spread evenly between powers of ten.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|power| 10f64.powf(power))
}

prop_compose! {
    fn scenes()(
        radius in decades(-8.0, -3.0),
        density in decades(2.0, 4.3),
        stiffness in decades(8.0, 12.0),
        adhesion in decades(-3.0, 3.0),
        zeta_h in decades(-3.0, 2.5),
        zeta_a in decades(-3.0, 2.5),
        // Into the surface, over the force scale of adhesion.
        force in prop_oneof![Just(0.0), decades(-4.0, 0.5).prop_map(|force| -force)],
    ) -> Inputs {
        let inputs = Inputs { radius, density, stiffness, adhesion, zeta_h, zeta_a, force: 0.0 };
        Inputs { force: force * inputs.adhesion_force(), ..inputs }
    }
}

prop_compose! {
    /// A force out of the surface, with a barrier from far closer to first touch than single precision tells apart from it.
    fn pulled_scenes()(inputs in scenes(), share in decades(-12.0, -1.0)) -> Inputs {
        Inputs { force: share * inputs.adhesion_force(), ..inputs }
    }
}

proptest! {
    #![proptest_config(config(reference::repetitions(2000, 200)))]

    #[test]
    fn capture_below_and_rebound_above(inputs in scenes()) {
        match inputs.critical::<12, f64>(1e-12) {
            // Far beyond the speeds at which adhesion matters e is a root of rounding errors.
            Ok(CriticalSpeed::At(critical)) if critical < 1e2 * inputs.unit() => {
                prop_assert!(inputs.ends_in(Outcome::Capture, critical * (1.0 - 1e-6)));
                if critical * (1.0 + 1e-6) <= 1e6 {
                    prop_assert!(inputs.ends_in(Outcome::Rebound, critical * (1.0 + 1e-6)));
                }
            }
            Ok(CriticalSpeed::At(critical)) => {
                prop_assert_ne!(inputs.outcome(critical * 0.999), Outcome::Rebound);
                prop_assert_ne!(inputs.outcome((critical * 1.001).min(1e6)), Outcome::Capture);
            }
            Ok(CriticalSpeed::NeverRebounds) => prop_assert_eq!(inputs.outcome(1e6), Outcome::Capture),
            Ok(CriticalSpeed::AlwaysRebounds) => prop_assert_eq!(inputs.outcome(1e-12), Outcome::Rebound),
            Err(error) => prop_assert!(false, "{}", error),
        }
    }

    #[test]
    fn single_precision_agrees(inputs in prop_oneof![scenes(), pulled_scenes()]) {
        if let (Ok(CriticalSpeed::At(double)), Ok(single)) =
            (inputs.critical::<12, f64>(1e-12), inputs.critical::<8, f32>(1e-6))
            && double < 3.0 * inputs.unit()
        {
            let CriticalSpeed::At(single) = single else { return Err(TestCaseError::fail(format!("{single:?}"))) };
            prop_assert!((f64::from(single) / double - 1.0).abs() < 1e-5, "{} for {}", single, double);
        }
    }
}

/// Inputs anywhere within and beyond their ranges end in a result or a named error.
#[test]
fn nothing_panics_or_returns_what_is_no_speed() {
    let mut runner = proptest::test_runner::TestRunner::new(config(reference::repetitions(500, 50)));
    let wild = (decades(-10.0, 0.0), decades(-2.0, 6.0), decades(0.0, 16.0), decades(-12.0, 9.0))
        .prop_flat_map(|scene| (Just(scene), decades(-12.0, 9.0), decades(-12.0, 9.0), -1.0..1.0, decades(-20.0, 6.0)));
    let result = runner.run(&wild, |((radius, density, stiffness, adhesion), zeta_h, zeta_a, sign, force)| {
        let force = if sign < -0.3 {
            -force
        } else if sign > 0.3 {
            force
        } else {
            0.0
        };
        let inputs = Inputs { radius, density, stiffness, adhesion, zeta_h, zeta_a, force };
        if let Ok(CriticalSpeed::At(speed)) = inputs.critical::<9, f64>(1e-9) {
            prop_assert!((1e-12..=1e6).contains(&speed));
        }
        if let Ok(CriticalSpeed::At(speed)) = inputs.critical::<8, f32>(1e-6) {
            prop_assert!((0.9e-12..=1e6).contains(&speed));
        }
        Ok(())
    });
    result.unwrap();
}
