//! The method of fixed cost: its error over the paper's and random scenes, and its honesty where it does not serve.

use microimpact::contact::{Collocation, Contact, FixedCost, Impulses, Method, PhaseSamples, Status};
use microimpact::{NormalMotion, Outcome, Real, Sphere, Stiffness, SurfaceMotion};
use reference::grids::PLANES;
use reference::{Case, cases};

/// Cases of these families whose outcome the method leaves open: they are too strongly damped for so few iterations, or too
/// close to the critical speed.
const MOST_UNKNOWN: usize = 6;

/// Largest error of e in some families, all of whose outcomes have to be right.
fn largest_error<T: Real>(families: &[&str], method: &impl Method<T>, double: impl Fn(T) -> f64) -> f64 {
    let (mut largest, mut unknown) = (0.0_f64, Vec::new());
    for case in cases().iter().filter(|case| families.contains(&case.text("family"))) {
        let name = case.text("name");
        let contact = case.scene::<T>().unwrap().solve_normal(&case.motion::<T>().unwrap(), method).unwrap();
        let Some(outcome) = contact.outcome().filter(|outcome| *outcome != Outcome::Undecided) else {
            unknown.push(name.to_owned());
            continue;
        };
        assert_eq!(outcome == Outcome::Rebound, case.text("outcome") == "rebound", "{name}");
        largest = largest.max((double(contact.overall_restitution()) - case.number("restitution")).abs());
    }
    assert!(unknown.len() <= MOST_UNKNOWN, "{unknown:?}");
    largest
}

const SCENES: [&str; 3] = ["paper", "figure6", "random"];

#[test]
fn five_nodes_and_three_iterations() {
    let error = largest_error(&SCENES, &FixedCost::<5>::new(3).unwrap(), f64::from as fn(f32) -> f64);
    assert!(error < 1e-5, "{error:.1e}");
}

#[test]
fn seven_nodes_and_three_iterations() {
    let error = largest_error(&SCENES, &FixedCost::<7>::new(3).unwrap(), f64::from as fn(f32) -> f64);
    assert!(error < 1e-6, "{error:.1e}");
}

/// Largest errors of the velocities along the surface, over the slip or the velocity before, and of the elastic impulse.
fn largest_tangential_error<const N: usize, const M: usize>() -> (f64, f64)
where
    f32: PhaseSamples<N, M>,
{
    let method = FixedCost::<N>::new(3).unwrap().with_outputs::<M>();
    let (mut velocity, mut impulse) = (0.0_f64, 0.0_f64);
    let rebounds = |case: &&Case| SCENES.contains(&case.text("family")) && case.text("outcome") == "rebound";
    for case in cases().iter().filter(rebounds) {
        let (scene, motion) = (case.scene::<f32>().unwrap(), case.motion().unwrap());
        let (impact, impulses) = scene.solve_for(&motion, &method, Impulses).unwrap();
        let slides = impact.tangential.motion() == SurfaceMotion::Sliding;
        assert_eq!(slides, case.text("motion") == "sliding", "{}", case.text("name"));
        let (radius, tangential) = (case.number("radius_m"), case.number("speed_tangential_m_s"));
        let slip = (tangential - radius * case.number("spin_rad_s")).abs().max(tangential.abs());
        let along = f64::from(impact.tangential.velocity()) - case.number("speed_tangential_out_m_s");
        let around = radius * (f64::from(impact.tangential.spin()) - case.number("spin_out_rad_s"));
        if slip > 0.0 {
            velocity = velocity.max(along.abs().max(around.abs()) / slip);
        }
        impulse = impulse.max((f64::from(impulses.elastic) / case.number("impulse_hertz_n_s") - 1.0).abs());
    }
    (velocity, impulse)
}

#[test]
fn velocities_along_the_surface_are_as_exact() {
    let (velocity, _) = largest_tangential_error::<5, 7>();
    assert!(velocity < 1e-5, "{velocity:.1e}");
    let (velocity, _) = largest_tangential_error::<7, 9>();
    assert!(velocity < 1e-6, "{velocity:.1e}");
    let (_, impulse) = largest_tangential_error::<7, 10>();
    assert!(impulse < 3e-6, "{impulse:.1e}");
}

#[test]
fn more_nodes_and_iterations_converge() {
    let error = |method: &dyn Fn() -> f64| method();
    let errors = [
        error(&|| largest_error(&["paper"], &FixedCost::<4>::new(8).unwrap(), |e: f64| e)),
        error(&|| largest_error(&["paper"], &FixedCost::<6>::new(10).unwrap(), |e: f64| e)),
        error(&|| largest_error(&["paper"], &FixedCost::<8>::new(12).unwrap(), |e: f64| e)),
    ];
    assert!(errors[1] < 0.2 * errors[0] && errors[2] < 0.2 * errors[1], "{errors:?}");
    assert!(errors[2] < 1e-7, "{errors:?}");
}

/// Where damping is too strong for it, the method says so instead of giving a wrong number.
#[test]
fn strong_damping_is_reported() {
    let sphere = Sphere::solid(5.06e-6, 2600.0).unwrap();
    let motion = NormalMotion::new(2.8).unwrap();
    let exact = Collocation::<12, f64>::new(1e-12).unwrap();
    let quick = FixedCost::<6>::new(6).unwrap();
    let mut unsolved = 0;
    for step in 0..200 {
        let zeta = 10f64.powf(f64::from(step) / 25.0);
        let scene = Contact::hertz(sphere, Stiffness::new(7.5e10).unwrap()).with_damping(zeta).unwrap();
        let contact = scene.solve_normal(&motion, &quick).unwrap();
        if contact.status() != Status::Solved {
            unsolved += 1;
            continue;
        }
        let e = scene.solve_normal(&motion, &exact).unwrap().overall_restitution();
        assert_eq!(contact.outcome(), Some(Outcome::Rebound), "{zeta}");
        assert!(
            (contact.overall_restitution() - e).abs() < 0.02,
            "{zeta}: {} against {e}",
            contact.overall_restitution()
        );
    }
    assert!(unsolved > 50);
}

/// Largest fraction of the planes of scenes up to that damping, close to the critical speed and far from it, that it refuses.
const MOST_REFUSED: f64 = 0.02;

#[test]
fn few_mildly_damped_scenes_are_refused() {
    const ACROSS: usize = 24;
    const MILD: f64 = 1.0;
    let method = FixedCost::<7>::new(3).unwrap();
    let (mut refused, mut all) = (0, 0);
    for plane in &PLANES {
        for (x, y) in
            plane.x.values(ACROSS).into_iter().flat_map(|x| plane.y.values(ACROSS).into_iter().map(move |y| (x, y)))
        {
            let Some(impact) = (plane.impact)(x, y).map(|impact| impact.in_single_precision()) else { continue };
            let (Ok(scene), Ok(motion)) = (impact.scene::<f64>(), impact.motion()) else { continue };
            let Ok(groups) = scene.groups(&motion) else { continue };
            if groups.material_damping.max(groups.adhesion_damping) <= MILD {
                let (Ok(scene), Ok(motion)) = (impact.scene::<f32>(), impact.motion()) else { continue };
                let impact = scene.solve(&motion, &method).unwrap();
                all += 1;
                refused += u32::from(impact.normal.status() != Status::Solved);
            }
        }
    }
    assert!(all > 1000 && f64::from(refused) < MOST_REFUSED * f64::from(all), "{refused} of {all}");
}
