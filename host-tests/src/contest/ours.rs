//! The methods of this library, from a scene and a motion in SI units.

use std::hint::black_box;

use crate::Case;
use microimpact::simulation::{
    Adaptive, Collocation, ContactImpulses, ContactTimes, FixedCost, Nodes, NormalContact, PhaseNodes, RungeKuttaGill,
    SimulatedImpact, TangentialContact,
};
use microimpact::{Real, Stiffness};

use crate::contest::contestant::{Answer, Contestant, tolerances};
use crate::contest::problem::Problem;
use crate::contest::scene::{normal_scene, solved};

pub use super::methods::ours::COLLOCATION;
use super::methods::ours::{ADAPTIVE, FIXED_COST, PAPER};

/// Collocation in single precision.
pub const SINGLE_PRECISION: &str = "Collocation, f32";

type Outputs<T> = (ContactTimes<T>, ContactImpulses<T>);

/// The normal motion.
pub fn normal(case: &Case) -> Vec<Contestant> {
    let mut all = collocation::<5, f64>(COLLOCATION, case);
    all.extend(collocation::<6, f64>(COLLOCATION, case));
    all.extend(collocation::<7, f64>(COLLOCATION, case));
    all.extend(collocation::<8, f64>(COLLOCATION, case));
    all.extend(collocation::<9, f64>(COLLOCATION, case));
    all.extend(collocation::<10, f64>(COLLOCATION, case));
    all.extend(collocation::<12, f64>(COLLOCATION, case));
    all.extend(collocation::<14, f64>(COLLOCATION, case));
    all.extend(adaptive(case));
    all.extend(collocation::<6, f32>(SINGLE_PRECISION, case));
    all.extend(collocation::<8, f32>(SINGLE_PRECISION, case));
    all.extend(fixed_cost::<5>(case));
    all.extend(fixed_cost::<6>(case));
    all.extend(fixed_cost::<7>(case));
    all.extend(fixed_cost::<8>(case));
    all.extend(paper_method(case));
    all
}

/// The same impact with friction and spin.
pub fn oblique(case: &Case) -> Vec<Contestant> {
    let mut all = oblique_collocation::<6>(case);
    all.extend(oblique_collocation::<7>(case));
    all.extend(oblique_collocation::<9>(case));
    all.extend(oblique_collocation::<12>(case));
    all.extend(oblique_adaptive(case));
    all.extend(oblique_paper_method(case));
    all
}

/// The equations that peers are given.
pub fn problem(case: &Case) -> Problem {
    let (scene, motion) = normal_scene(case);
    let stiffness = Stiffness::new(case.number("stiffness_pa")).unwrap();
    Problem::new(&scene, stiffness, &motion)
}

fn answer<T: Into<f64> + Real>(
    normal: &NormalContact<T>,
    (times, impulses): &Outputs<T>,
    effort: (u32, &'static str),
) -> Option<Answer> {
    Some(Answer {
        restitution: solved(normal.overall_restitution(), normal.status())?.into(),
        contact_time: times.contact.map(Into::into),
        impulse: Some(impulses.elastic.into()),
        effort: Some((effort.0 as usize, effort.1)),
    })
}

fn collocation<const N: usize, T: Nodes<N> + Into<f64>>(entry: &'static str, case: &Case) -> Vec<Contestant> {
    let contestant = |tolerance: f64| {
        let (scene, motion) = normal_scene::<T>(case);
        let method = Collocation::<N, T>::new(T::constant(tolerance)).ok()?;
        Some(Contestant::new(entry, format!("{N} nodes"), format!("{tolerance:.0e}"), move || {
            let impact: SimulatedImpact<_, _, Outputs<T>> =
                black_box(&scene).observe(&method, black_box(&motion)).ok()?;
            answer(&impact.normal, &impact.outputs, (impact.run.evaluations, "evaluations"))
        }))
    };
    tolerances().filter_map(contestant).collect()
}

fn oblique_collocation<const N: usize>(case: &Case) -> Vec<Contestant>
where
    f64: Nodes<N>,
{
    let contestant = |tolerance: f64| {
        let (scene, motion) = (case.scene().unwrap(), case.motion().unwrap());
        let method = Collocation::<N, f64>::new(tolerance).ok()?;
        Some(Contestant::new(COLLOCATION, format!("{N} nodes"), format!("{tolerance:.0e}"), move || {
            let impact: SimulatedImpact<_, TangentialContact<f64>, Outputs<f64>> =
                black_box(&scene).observe(&method, black_box(&motion)).ok()?;
            answer(&impact.normal, &impact.outputs, (impact.run.evaluations, "evaluations"))
        }))
    };
    tolerances().filter_map(contestant).collect()
}

/// It chooses nodes and method by the tolerance.
fn adaptive(case: &Case) -> Vec<Contestant> {
    let contestant = |tolerance: f64| {
        let (scene, motion) = normal_scene::<f64>(case);
        let method = Adaptive::new(tolerance).ok()?;
        Some(Contestant::new(ADAPTIVE, "", format!("{tolerance:.0e}"), move || {
            let impact: SimulatedImpact<_, _, Outputs<f64>> =
                black_box(&scene).observe(&method, black_box(&motion)).ok()?;
            answer(&impact.normal, &impact.outputs, (impact.run.evaluations, "evaluations"))
        }))
    };
    tolerances().filter_map(contestant).collect()
}

fn oblique_adaptive(case: &Case) -> Vec<Contestant> {
    let contestant = |tolerance: f64| {
        let (scene, motion) = (case.scene().unwrap(), case.motion().unwrap());
        let method = Adaptive::new(tolerance).ok()?;
        Some(Contestant::new(ADAPTIVE, "", format!("{tolerance:.0e}"), move || {
            let impact: SimulatedImpact<_, TangentialContact<f64>, Outputs<f64>> =
                black_box(&scene).observe(&method, black_box(&motion)).ok()?;
            answer(&impact.normal, &impact.outputs, (impact.run.evaluations, "evaluations"))
        }))
    };
    tolerances().filter_map(contestant).collect()
}

/// It gives no times or impulses.
fn fixed_cost<const N: usize>(case: &Case) -> Vec<Contestant>
where
    f64: PhaseNodes<N>,
{
    let contestant = |sweeps: u32| {
        let (scene, motion) = normal_scene::<f64>(case);
        let method = FixedCost::<N>::new(sweeps).unwrap();
        Contestant::new(FIXED_COST, format!("{N} nodes"), format!("{sweeps} sweeps"), move || {
            let contact = black_box(&scene).normal_impact(&method, black_box(&motion)).ok()?;
            let restitution = solved(contact.overall_restitution(), contact.status())?;
            Some(Answer::of_restitution(restitution, Some((2 * N * sweeps as usize, "evaluations"))))
        })
    };
    (2..=10).map(contestant).collect()
}

/// Numbers of steps in the duration of Hertz's impact.
fn steps() -> impl Iterator<Item = u32> {
    (0..=14).map(|half_octaves| (250.0 * 2f64.powf(0.5 * f64::from(half_octaves))) as u32)
}

fn paper_method(case: &Case) -> Vec<Contestant> {
    let contestant = |steps: u32| {
        let (scene, motion) = normal_scene::<f64>(case);
        let method = RungeKuttaGill::new(steps);
        Contestant::new(PAPER, "Runge-Kutta-Gill", format!("{steps} steps"), move || {
            let impact: SimulatedImpact<_, _, Outputs<f64>> =
                black_box(&scene).observe(&method, black_box(&motion)).ok()?;
            answer(&impact.normal, &impact.outputs, (impact.run.evaluations, "evaluations"))
        })
    };
    steps().map(contestant).collect()
}

fn oblique_paper_method(case: &Case) -> Vec<Contestant> {
    let contestant = |steps: u32| {
        let (scene, motion) = (case.scene::<f64>().unwrap(), case.motion().unwrap());
        let method = RungeKuttaGill::new(steps);
        Contestant::new(PAPER, "Runge-Kutta-Gill", format!("{steps} steps"), move || {
            let impact: SimulatedImpact<_, TangentialContact<f64>, Outputs<f64>> =
                black_box(&scene).observe(&method, black_box(&motion)).ok()?;
            answer(&impact.normal, &impact.outputs, (impact.run.evaluations, "evaluations"))
        })
    };
    steps().map(contestant).collect()
}
