//! The paper's own method: how fast it converges, and the numbers that the paper prints, from it and from collocation.

use crate::everything::{EVERYTHING, Everything, Impact, solve_case};
use microimpact::contact::{Collocation, Contact, NormalContact, PaperScene, RungeKuttaGill, SlipHistory, Status};
use microimpact::{InputError, NormalMotion, Outcome, Real, Sphere, Stiffness, SurfaceMotion};
use reference::{Case, cases};

fn step_through<T: Real>(case: &Case, steps: u32) -> Result<Impact<T>, InputError> {
    solve_case(case, &RungeKuttaGill::new(steps))
}

fn case(name: &str) -> Case {
    cases().into_iter().find(|case| case.text("name") == name).unwrap()
}

/// Error of e at numbers of steps that grow by the fourth root of two.
fn errors(case: &Case, from: u32, to: u32) -> Vec<(f64, f64)> {
    let exact = case.number("restitution");
    let mut steps = f64::from(from);
    let mut errors = Vec::new();
    while steps <= f64::from(to) {
        let (impact, _) = step_through::<f64>(case, steps as u32).unwrap();
        errors.push((steps, (impact.normal.overall_restitution() - exact).abs()));
        steps *= 2f64.sqrt().sqrt();
    }
    errors
}

/// Slope of the logarithm of the error, by least squares.
fn order(errors: &[(f64, f64)]) -> f64 {
    let logarithms: Vec<_> = errors.iter().map(|(steps, error)| (steps.ln(), -error.ln())).collect();
    let count = logarithms.len() as f64;
    let (x, y) = logarithms.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / count, sum.1 + point.1 / count));
    let (xy, xx) = logarithms
        .iter()
        .fold((0.0, 0.0), |sum, point| (sum.0 + (point.0 - x) * (point.1 - y), sum.1 + (point.0 - x).powi(2)));
    xy / xx
}

#[test]
fn order_is_three_halves_with_adhesion() {
    let order = order(&errors(&case("table1"), 32, 65_536));
    assert!((1.35..1.65).contains(&order), "{order}");
}

#[test]
fn order_is_five_halves_without_adhesion() {
    let order = order(&errors(&case("mean_sphere_no_adhesion"), 32, 8192));
    assert!((2.35..2.65).contains(&order), "{order}");
}

/// From here on every finer step is exact to 1e-6 as well; the contact takes 1.45 times that.
#[test]
fn thousands_of_steps_for_six_digits() {
    let errors = errors(&case("table1"), 512, 32_768);
    let fewest = errors.iter().rev().take_while(|(_, error)| *error <= 1e-6).last().unwrap().0;
    assert!((2000.0..4000.0).contains(&fewest), "{fewest}");
}

#[test]
fn converges_to_the_reference() {
    for case in cases().iter().filter(|case| ["paper", "figure6", "random", "peeling"].contains(&case.text("family"))) {
        let name = case.text("name");
        let (impact, (times, impulses, works, slip)) = step_through::<f64>(case, 20_000).unwrap();
        assert_eq!(impact.run.status, Status::Solved, "{name}");
        assert_eq!(impact.normal.outcome() == Some(Outcome::Rebound), case.text("outcome") == "rebound", "{name}");
        let compare = |value: f64, column: &str, allowed: f64| {
            let exact = case.number(column);
            let scale = if exact == 0.0 { 1.0 } else { exact };
            assert!(((value - exact) / scale).abs() <= allowed, "{name}: {column} {value:e}, not {exact:e}");
        };
        if let Some(peak) = impact.normal.peak_indentation() {
            compare(peak, "max_indentation_m", 2e-6);
        }
        if case.text("outcome") != "rebound" {
            continue;
        }
        let (e, exact) = (impact.normal.overall_restitution(), case.number("restitution"));
        assert!((e * e - exact * exact).abs() <= 2e-6, "{name}: e = {e}, not {exact}");
        compare(times.peak.unwrap(), "time_peak_s", 2e-6);
        compare(times.contact.unwrap(), "contact_time_s", 1e-5);
        compare(impulses.elastic, "impulse_hertz_n_s", 2e-6);
        // Counted from the step in which the sphere turns, so of first order.
        compare(impulses.adhesion_rebound, "impulse_adhesion_rebound_n_s", 1e-4);
        compare(works.material, "work_material_j", 2e-6);
        compare(works.adhesion, "work_adhesion_j", 1e-5);
        let rolls = impact.tangential.motion() == SurfaceMotion::Rolling;
        assert_eq!(rolls, case.text("motion") == "rolling", "{name}");
        assert_eq!(slip.slides, !rolls, "{name}");
        for velocity in [slip.velocity, impact.tangential.velocity()] {
            compare(velocity, "speed_tangential_out_m_s", 1e-5);
        }
        for spin in [slip.spin, impact.tangential.spin()] {
            compare(spin, "spin_out_rad_s", 1e-5);
        }
        compare(slip.rotation, "rotation_rad", 1e-5);
        compare(slip.displacement, "displacement_tangential_m", 1e-5);
        if let Some(time) = slip.rolls_from {
            compare(time, "time_roll_s", 1e-5);
        }
    }
}

/// Single precision follows the double one until its rounding outweighs the error of the steps.
#[test]
fn single_precision_loses_what_small_steps_gain() {
    let case = case("table1");
    let exact = case.number("restitution");
    let error = |steps| {
        let (impact, _) = step_through::<f32>(&case, steps).unwrap();
        (f64::from(impact.normal.overall_restitution()) - exact).abs()
    };
    assert!(error(256) < 1e-4);
    assert!(error(4096) < 1e-4);
}

/// Strong damping makes a fixed step unstable; that is reported and ends.
#[test]
fn every_run_ends_in_numbers() {
    for case in cases() {
        for steps in [16, 50, 500] {
            let (impact, _) = step_through::<f64>(&case, steps).unwrap();
            assert!(impact.run.steps <= steps * RungeKuttaGill::LONGEST_RUN + 1);
            assert!(impact.normal.overall_restitution().is_finite(), "{}", case.text("name"));
        }
    }
}

/// What the paper says of its simulations.
struct Printed {
    /// e of the mean sphere, and of that of Table 1.
    restitution_mean: f64,
    restitution: f64,
    peak: f64,
    work_of_adhesion: f64,
    rebound_angle: f64,
    tangential: f64,
    spin: f64,
    rotation: f64,
    equilibrium: f64,
    /// Contact radius over sphere radius, at equilibrium under f0 = 128.3 and 513.3 N/m.
    rests_at: [f64; 2],
    captured: [Outcome; 2],
}

/// What both methods give.
struct Answer {
    restitution: f64,
    peak: f64,
    peak_radius: f64,
    rebound_speed: f64,
    work_of_adhesion: f64,
    outcome: Outcome,
    slip: SlipHistory<f64>,
}

fn collocated(scene: &Scene, motion: &Motion) -> Answer {
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    let (impact, outputs) = scene.solve_for(motion, &method, EVERYTHING).unwrap();
    Answer::from(scene, &impact.normal, &outputs)
}

fn stepped(scene: &Scene, motion: &Motion) -> Answer {
    let (impact, outputs) = scene.solve_for(motion, &RungeKuttaGill::new(20_000), EVERYTHING).unwrap();
    Answer::from(scene, &impact.normal, &outputs)
}

impl Answer {
    fn from(scene: &Scene, normal: &NormalContact<f64>, (_, _, works, slip): &Everything<f64>) -> Self {
        let peak = normal.peak_indentation().unwrap();
        Self {
            restitution: normal.overall_restitution(),
            peak,
            peak_radius: scene.law().contact_radius_at(scene.sphere(), peak),
            rebound_speed: normal.rebound_speed(),
            work_of_adhesion: works.adhesion,
            outcome: normal.outcome().unwrap(),
            slip: *slip,
        }
    }
}

type Scene = PaperScene<f64>;
type Motion = microimpact::PlanarMotion<f64>;

fn scene(radius: f64, strength: f64, zeta_h: f64, zeta_a: f64) -> Scene {
    Contact::hertz(Sphere::solid(radius, 2600.0).unwrap(), Stiffness::new(7.5e10).unwrap())
        .with_damping(zeta_h)
        .unwrap()
        .with_ring(strength, zeta_a)
        .unwrap()
        .with_friction(0.1)
        .unwrap()
}

fn motion(scene: &Scene, speed: f64, spin: f64) -> Motion {
    NormalMotion::new(speed).unwrap().with_tangential(0.0).unwrap().with_spin(scene.sphere(), spin).unwrap()
}

/// The paper's scenes, with half of the printed zeta_A = 12.5, which is what its program computed.
fn printed(solve: impl Fn(&Scene, &Motion) -> Answer) -> Printed {
    let at = |radius, speed, spin| {
        let scene = scene(radius, 250.0, 10.5, 6.25);
        solve(&scene, &motion(&scene, speed, spin))
    };
    let table1 = at(5.06e-6, 2.8, 1.454e5);
    // An undamped sphere that arrives at hardly any speed turns where 5/3 of its equilibrium indentation is.
    let slowly = |radius, strength| {
        let scene = scene(radius, strength, 0.0, 0.0);
        solve(&scene, &motion(&scene, 1e-3, 0.0))
    };
    let rests_at = |strength| slowly(4.3e-6, strength).peak_radius * 0.6f64.sqrt() / 4.3e-6;
    Printed {
        restitution_mean: at(4.3e-6, 2.8, 0.0).restitution,
        restitution: table1.restitution,
        peak: table1.peak,
        work_of_adhesion: table1.work_of_adhesion,
        rebound_angle: (table1.slip.velocity / table1.rebound_speed).atan().to_degrees(),
        tangential: table1.slip.velocity,
        spin: table1.slip.spin,
        rotation: table1.slip.rotation_degrees(),
        equilibrium: slowly(2.5e-6, 250.0).peak * 0.6,
        rests_at: [rests_at(128.3), rests_at(513.3)],
        captured: [at(2.5e-6, 5.15, 0.0).outcome, at(2.5e-6, 5.17, 0.0).outcome],
    }
}

/// Line by line, to one unit of the last digit printed, and to the digits that these equations give.
fn reproduces_the_table(found: &Printed) {
    let line = |value: f64, printed: f64, unit: f64, exact: f64, digit: f64| {
        assert!((value - printed).abs() <= unit, "{value:e}, printed {printed:e}");
        assert!((value - exact).abs() <= 0.6 * digit, "{value:e}, not {exact:e}");
    };
    line(found.restitution_mean, 0.62, 0.005, 0.6195, 1e-4);
    line(found.restitution, 0.746, 0.0005, 0.74619, 1e-5);
    // The paper's largest displacement is 0.2 % less than that of its own equations.
    line(found.peak, 4.243e-8, 0.01e-8, 4.251e-8, 0.001e-8);
    line(found.work_of_adhesion, 4.83e-13, 0.005e-13, 4.828e-13, 0.001e-13);
    line(found.rebound_angle, 5.75, 0.005, 5.7451, 1e-4);
    line(found.tangential, 0.21, 0.005, 0.2102, 1e-4);
    line(found.spin, 4.16e4, 0.01e4, 4.154e4, 0.001e4);
    line(found.rotation, 0.12, 0.005, 0.1234, 1e-4);
    line(found.equilibrium, 2.09e-8, 0.005e-8, 2.094e-8, 0.001e-8);
    line(found.rests_at[0], 0.05, 1e-5, 0.05, 1e-5);
    line(found.rests_at[1], 0.10, 1e-5, 0.10, 1e-5);
    // "About 5 m/s": 5.160.
    assert_eq!(found.captured, [Outcome::Capture, Outcome::Rebound]);
}

#[test]
fn table_of_the_paper_by_its_own_method() {
    reproduces_the_table(&printed(stepped));
}

#[test]
fn table_of_the_paper_by_collocation() {
    reproduces_the_table(&printed(collocated));
}

/// A moment that takes the spin in less than a step: the method must not answer, since its steps grow without bound then.
#[test]
fn a_spin_that_decays_faster_than_the_steps_is_no_result() {
    let sphere = Sphere::solid(2.5e-6, 2600.0).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap()).with_damping(1.0).unwrap();
    let scene = scene.with_ring(250.0, 6.25).unwrap().with_friction(0.1).unwrap();
    let motion = NormalMotion::new(20.0).unwrap().with_tangential(-9.0).unwrap().with_spin(&sphere, -1e6).unwrap();
    let mut answers = Vec::new();
    for lambda in [1e-12, 1e-9, 1e-7, 1e-5] {
        let scene = scene.with_peeling(lambda).unwrap();
        let exact = scene.solve(&motion, &Collocation::<12, f64>::new(1e-10).unwrap()).unwrap().tangential.spin();
        for steps in [16, 100, 1000, 10_000] {
            let found = scene.solve(&motion, &RungeKuttaGill::new(steps)).unwrap();
            if found.run.status == Status::Solved {
                let error = (found.tangential.spin() - exact).abs() / 1e6;
                assert!(error < 0.1, "{lambda:e}, {steps} steps: {error:e}");
            }
            answers.push(found.run.status == Status::Solved);
        }
    }
    assert!(answers[..4].iter().all(|solved| *solved) && answers[12..].contains(&false), "{answers:?}");
}

/// A force turns the sphere back within the first step: the moment is strong only where the sphere is deepest, not where the step ends.
#[test]
fn a_spin_that_decays_while_a_step_turns_the_sphere_back_is_no_result() {
    let sphere = Sphere::new(2.96e-5, 238.0, 0.0353).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(1e8).unwrap()).with_damping(1.0).unwrap();
    let scene = scene.with_ring(0.0316, 1.0).unwrap().with_external_force(1e-6).unwrap();
    let scene = scene.with_friction(0.0316).unwrap();
    let motion = NormalMotion::new(0.001).unwrap().with_tangential(2.85).unwrap().with_spin(&sphere, -8e10).unwrap();
    let mut answers = Vec::new();
    for lambda in [1e-14, 1e-2] {
        let scene = scene.with_peeling(lambda).unwrap();
        let exact = scene.solve(&motion, &Collocation::<12, f64>::new(1e-10).unwrap()).unwrap().tangential.spin();
        let found = scene.solve(&motion, &RungeKuttaGill::new(53)).unwrap();
        if found.run.status == Status::Solved {
            let error = (found.tangential.spin() - exact).abs() / 8e10;
            assert!(error < 0.1, "{lambda:e}: {error:e}");
        }
        answers.push(found.run.status == Status::Solved);
    }
    assert_eq!(answers, [true, false]);
}

/// Friction that ends a fast slip within a hundredth of a step: sliding backward must not be left over, which a rolling sphere never loses.
#[test]
fn a_slip_that_ends_within_a_step_leaves_a_rolling_sphere() {
    let sphere = Sphere::solid(1.008e-5, 100.0).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(1e8).unwrap()).with_damping(1.0).unwrap();
    let scene = scene.with_ring(0.0316, 1.0).unwrap().with_friction(885.2).unwrap().with_peeling(4.88e-10).unwrap();
    let motion = NormalMotion::new(17.25).unwrap().with_tangential(0.1).unwrap().with_spin(&sphere, 1.196e7).unwrap();
    let exact = scene.solve(&motion, &Collocation::<12, f64>::new(1e-10).unwrap()).unwrap().tangential;
    for steps in [16, 100, 1000] {
        let found = scene.solve(&motion, &RungeKuttaGill::new(steps)).unwrap();
        assert_eq!(found.run.status, Status::Solved);
        let slip = (found.tangential.velocity() - sphere.radius() * found.tangential.spin()).abs();
        let error = (found.tangential.velocity() - exact.velocity()).abs();
        assert!(slip < 1e-9 && error < 0.01 * 17.25, "{steps} steps: slip {slip:e}, error {error:e}");
    }
}
