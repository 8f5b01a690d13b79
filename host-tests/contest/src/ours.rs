//! The methods of this library, from a scene and a motion in SI units.

use std::hint::black_box;

use microimpact::contact::{
    Adaptive, Collocation, FixedCost, Impulses, Method, Nodes, RingScene, RungeKuttaGill, Surface, Times,
};
use microimpact::{Approach, Real, Stiffness};
use reference::Case;

use crate::contestant::{Answer, Contestant, tolerances};
use crate::problem::Problem;
use crate::scene::{normal_scene, solved};

pub use microimpact_scenes::methods::ours::COLLOCATION;
use microimpact_scenes::methods::ours::{ADAPTIVE, FIXED_COST, PAPER};

/// Collocation in single precision.
pub const SINGLE_PRECISION: &str = "Collocation, f32";

/// The normal motion.
pub fn normal(case: &Case) -> Vec<Contestant> {
    let (impact, single) = (normal_scene::<f64>(case), normal_scene::<f32>(case));
    let mut all = collocation::<5, f64>(COLLOCATION, impact);
    all.extend(collocation::<6, f64>(COLLOCATION, impact));
    all.extend(collocation::<7, f64>(COLLOCATION, impact));
    all.extend(collocation::<8, f64>(COLLOCATION, impact));
    all.extend(collocation::<9, f64>(COLLOCATION, impact));
    all.extend(collocation::<10, f64>(COLLOCATION, impact));
    all.extend(collocation::<12, f64>(COLLOCATION, impact));
    all.extend(collocation::<14, f64>(COLLOCATION, impact));
    all.extend(adaptive(impact));
    all.extend(collocation::<6, f32>(SINGLE_PRECISION, single));
    all.extend(collocation::<8, f32>(SINGLE_PRECISION, single));
    all.extend(fixed_cost::<5>(case));
    all.extend(fixed_cost::<6>(case));
    all.extend(fixed_cost::<7>(case));
    all.extend(fixed_cost::<8>(case));
    all.extend(paper_method(impact));
    all
}

/// The same impact with friction and spin.
pub fn oblique(case: &Case) -> Vec<Contestant> {
    let impact = (case.scene::<f64>().unwrap(), case.motion().unwrap());
    let mut all = collocation::<6, f64>(COLLOCATION, impact);
    all.extend(collocation::<7, f64>(COLLOCATION, impact));
    all.extend(collocation::<9, f64>(COLLOCATION, impact));
    all.extend(collocation::<12, f64>(COLLOCATION, impact));
    all.extend(adaptive(impact));
    all.extend(paper_method(impact));
    all
}

/// The equations that peers are given.
pub fn problem(case: &Case) -> Problem {
    let (scene, motion) = normal_scene(case);
    let stiffness = Stiffness::new(case.number("stiffness_pa")).unwrap();
    Problem::new(&scene, stiffness, &motion)
}

/// A scene and a motion, for any method.
trait Impact<T: Real>: Copy + 'static {
    fn answer(&self, method: &impl Method<T>) -> Option<Answer>;
}

impl<T, S, B> Impact<T> for (RingScene<T, S>, B)
where
    T: Real + Into<f64> + 'static,
    S: Surface<T, B> + 'static,
    B: Approach<T> + Copy + 'static,
{
    fn answer(&self, method: &impl Method<T>) -> Option<Answer> {
        let (scene, motion) = self;
        let (impact, (times, impulses)) =
            black_box(scene).solve_for(black_box(motion), method, (Times, Impulses)).ok()?;
        Some(Answer {
            restitution: solved(impact.normal.overall_restitution(), impact.normal.status())?.into(),
            contact_time: times.contact.map(Into::into),
            impulse: Some(impulses.elastic.into()),
            effort: Some((impact.run.evaluations as usize, "evaluations")),
        })
    }
}

fn collocation<const N: usize, T: Nodes<N> + 'static>(entry: &'static str, impact: impl Impact<T>) -> Vec<Contestant> {
    let contestant = |tolerance: f64| {
        let method = Collocation::<N, T>::new(T::constant(tolerance)).ok()?;
        let run = move || impact.answer(&method);
        Some(Contestant::new(entry, format!("{N} nodes"), format!("{tolerance:.0e}"), run))
    };
    tolerances().filter_map(contestant).collect()
}

/// It chooses nodes and method by the tolerance.
fn adaptive(impact: impl Impact<f64>) -> Vec<Contestant> {
    let contestant = |tolerance: f64| {
        let method = Adaptive::new(tolerance).ok()?;
        Some(Contestant::new(ADAPTIVE, "", format!("{tolerance:.0e}"), move || impact.answer(&method)))
    };
    tolerances().filter_map(contestant).collect()
}

/// It gives no times or impulses.
fn fixed_cost<const N: usize>(case: &Case) -> Vec<Contestant> {
    let contestant = |iterations: u32| {
        let (scene, motion) = normal_scene::<f64>(case);
        let method = FixedCost::<N>::new(iterations).unwrap();
        Contestant::new(FIXED_COST, format!("{N} nodes"), format!("{iterations} iterations"), move || {
            let contact = black_box(&scene).solve_normal(black_box(&motion), &method).ok()?;
            let restitution = solved(contact.overall_restitution(), contact.status())?;
            Some(Answer::of_restitution(restitution, Some((2 * N * iterations as usize, "evaluations"))))
        })
    };
    (2..=10).map(contestant).collect()
}

/// Numbers of steps in the duration of Hertz's impact.
fn steps() -> impl Iterator<Item = u32> {
    (0..=14).map(|half_octaves| (250.0 * 2f64.powf(0.5 * f64::from(half_octaves))) as u32)
}

fn paper_method(impact: impl Impact<f64>) -> Vec<Contestant> {
    let contestant = |steps: u32| {
        let method = RungeKuttaGill::new(steps);
        Contestant::new(PAPER, "Runge-Kutta-Gill", format!("{steps} steps"), move || impact.answer(&method))
    };
    steps().map(contestant).collect()
}
