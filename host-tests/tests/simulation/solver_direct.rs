//! Every method on every law of the library whose solution is known in closed form.

use std::f64::consts::PI;

use microimpact::contact::{
    Adaptive, Collocation, Contact, ContactLaw, FixedCost, Impulses, Method, RungeKuttaGill, Status, Times, Works,
};
use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};

const SPEED: f64 = 2.8;

fn sphere() -> Sphere<f64> {
    Sphere::solid(5.06e-6, 2600.0).unwrap()
}

fn stiffness() -> Stiffness<f64> {
    Stiffness::new(7.5e10).unwrap()
}

/// What is known of an impact at [`SPEED`]; times only where they are known.
struct Exact {
    e: f64,
    /// m.
    peak: Option<f64>,
    /// s.
    peak_time: Option<f64>,
    contact_time: Option<f64>,
}

/// One method: errors are relative, of e that of e^2.
fn check<L: ContactLaw<f64>>(
    scene: &Contact<f64, L>,
    exact: &Exact,
    name: &str,
    method: &impl Method<f64>,
    allowed: f64,
) {
    let momentum = sphere().mass() * SPEED;
    let motion = NormalMotion::new(SPEED).unwrap();
    let (impact, (times, impulses, works)) = scene.solve_for(&motion, method, (Times, Impulses, Works)).unwrap();
    assert_eq!((impact.run.status, impact.normal.outcome()), (Status::Solved, Some(Outcome::Rebound)), "{name}");
    let e = impact.normal.overall_restitution();
    let square = e * e - exact.e * exact.e;
    assert!(square.abs() < allowed, "{name}: e^2 by {square:e}");
    let lost = (works.material + works.adhesion) / (0.5 * momentum * SPEED) - (1.0 - exact.e * exact.e);
    assert!(lost.abs() < allowed, "{name}: works by {lost:e}");
    for (what, found, exact) in [
        ("peak", impact.normal.peak_indentation(), exact.peak),
        ("time of the peak", times.peak, exact.peak_time),
        ("contact time", times.contact, exact.contact_time),
    ] {
        let Some(exact) = exact else { continue };
        let error = found.unwrap() / exact - 1.0;
        assert!(error.abs() < allowed, "{name}: {what} by {error:e}");
    }
    // Without adhesion the elastic force alone makes the momentum, as damping gives back what it took.
    if impulses.adhesion_rebound == 0.0 {
        let error = impulses.elastic / (momentum * (1.0 + exact.e)) - 1.0;
        assert!(error.abs() < allowed, "{name}: impulse by {error:e}");
    }
}

/// All methods that control their error, and that with steps in time.
fn check_all<L: ContactLaw<f64>>(scene: &Contact<f64, L>, exact: &Exact) {
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
        let name = format!("adaptive, {tolerance:e}");
        check(scene, exact, &name, &Adaptive::new(tolerance).unwrap(), 3.0 * tolerance);
    }
    check(scene, exact, "seven nodes", &Collocation::<7, f64>::new(1e-6).unwrap(), 3e-6);
    check(scene, exact, "nine nodes", &Collocation::<9, f64>::new(1e-9).unwrap(), 3e-9);
    check(scene, exact, "ten nodes", &Collocation::<10, f64>::new(1e-11).unwrap(), 3e-11);
    check(scene, exact, "twelve nodes", &Collocation::<12, f64>::new(1e-12).unwrap(), 3e-12);
    check(scene, exact, "fourteen nodes", &Collocation::<14, f64>::new(1e-13).unwrap(), 5e-13);
    check(scene, exact, "steps in time", &RungeKuttaGill::new(20_000), 2e-6);
}

#[test]
fn hertz() {
    let scene = Contact::hertz(sphere(), stiffness());
    // (5 m v^2/(4 sqrt(r) K))^(2/5), and 2 sqrt(pi) Gamma(7/5)/Gamma(9/10) times that over v.
    let energy = 1.25 * sphere().mass() * SPEED * SPEED;
    let indentation = (energy / (sphere().radius().sqrt() * stiffness().pascals())).powf(0.4);
    let duration = 2.943_275_184_324_704_7 * indentation / SPEED;
    let exact =
        Exact { e: 1.0, peak: Some(indentation), peak_time: Some(0.5 * duration), contact_time: Some(duration) };
    check_all(&scene, &exact);
    check(&scene, &exact, "fixed cost", &FixedCost::<5>::new(1).unwrap().with_outputs::<16>(), 1e-12);
    check(&scene, &exact, "fixed cost", &FixedCost::<7>::new(3).unwrap().with_outputs::<16>(), 1e-12);
}

/// The peak x of an undamped ring, in units of its equilibrium indentation, at speeds v in those that belong to it:
/// v^2/2 = (2/5) x^(5/2) - (2/3) x^(3/2).
#[test]
fn undamped_ring() {
    for (v, x) in [(0.5, 1.79645), (1.0, 2.08258), (3.0, 3.43431)] {
        // f0 by which the speed becomes v: the unit of speed goes with its power 5/4.
        let unit = |strength: f64| {
            let equilibrium = 2.0 * PI * strength / 7.5e10;
            let spring = 7.5e10 * (5.06e-6 * equilibrium).sqrt();
            (equilibrium, equilibrium * (spring / sphere().mass()).sqrt())
        };
        let strength = (SPEED / v / unit(1.0).1).powf(0.8);
        let equilibrium = unit(strength).0;
        let mut peak: f64 = x;
        for _ in 0..20 {
            let root = peak.sqrt();
            let excess = 0.4 * peak * peak * root - 2.0 / 3.0 * peak * root - 0.5 * v * v;
            peak -= excess / (peak * root - root);
        }
        assert!((peak - x).abs() < 6e-6);
        let scene = Contact::hertz(sphere(), stiffness()).with_ring(strength, 0.0).unwrap();
        let exact = Exact { e: 1.0, peak: Some(peak * equilibrium), peak_time: None, contact_time: None };
        check_all(&scene, &exact);
        check(&scene, &exact, "fixed cost", &FixedCost::<5>::new(3).unwrap(), 1e-12);
        check(&scene, &exact, "fixed cost", &FixedCost::<7>::new(1).unwrap(), 1e-12);
    }
}

/// Hunt and Crossley's damping: d (1 + e) = ln((1 + d)/(1 - e d)).
#[test]
fn hysteretic_damping() {
    let unit = Contact::hertz(sphere(), stiffness()).with_damping(1.0).unwrap();
    let unit = unit.groups(&NormalMotion::new(SPEED).unwrap()).unwrap().material_damping;
    for (d, table) in [
        (0.1, 0.937475579950),
        (0.5, 0.748434931597),
        (1.0, 0.593624260040),
        (2.0, 0.410719686061),
        (10.0, 0.0999816247529),
    ] {
        let mut e: f64 = table;
        for _ in 0..20 {
            // 1 - e d = (1 + d) exp(-d (1 + e)), by Newton's method.
            let fall = (1.0 + d) * (-d * (1.0 + e)).exp();
            e += (1.0 - e * d - fall) / (d - d * fall);
        }
        assert!((e - table).abs() < 1e-12, "{d}: {e}");
        let scene = Contact::hertz(sphere(), stiffness()).with_damping(d / unit).unwrap();
        let exact = Exact { e, peak: None, peak_time: None, contact_time: None };
        check_all(&scene, &exact);
        if d <= 0.5 {
            check(&scene, &exact, "fixed cost", &FixedCost::<7>::new(4).unwrap(), 1e-5);
            check(&scene, &exact, "fixed cost", &FixedCost::<9>::new(8).unwrap().with_outputs::<13>(), 1e-7);
        }
    }
}
