//! The entrants on the host: their errors, times and instructions.

use std::collections::HashMap;
use std::hint::black_box;

use contest::contestant::{Answer, Contestant as Peer};
use contest::race::least_times;
use contest::scene::solution;
use contest::{ours, peers, runge_kutta};
use microimpact_scenes::methods::inputs::{Inputs, TABLE_1};
use microimpact_scenes::methods::{Contestant, Extent, Number, Reply, Visitor, visit, visit_fixed_point};
use reference::grids::mild_rebounds;
use reference::{Case, case};

use super::point::{Entrant, Point, Series, Unit, rounding};
use crate::content::Run;

/// What is asked for besides the tasks of the boards.
pub(super) const OUTPUTS: &str = "normal, with contact time and impulse";

/// Runs of each entrant, of which the least time counts.
const TURNS: u32 = 20;

/// The solution of a scene.
pub(super) struct Exact {
    restitution: f64,
    /// m/s and rad/s.
    surface: [f64; 2],
    /// The faster of tangential and peripheral speed before the impact, or the approach speed where both are zero, m/s.
    speed: f64,
    radius: f64,
}

impl Exact {
    pub(super) fn of(case: &Case) -> Self {
        let radius = case.number("radius_m");
        let along = case.number("speed_tangential_m_s").abs().max(radius * case.number("spin_rad_s").abs());
        Self {
            restitution: case.number("restitution"),
            surface: [case.number("speed_tangential_out_m_s"), case.number("spin_out_rad_s")],
            speed: if along > 0.0 { along } else { case.number("speed_normal_m_s") },
            radius,
        }
    }

    /// Error of e, or the largest of it and those of the velocities along the surface over the speed before; not less
    /// than the rounding of the number type, below which an error is luck.
    pub(super) fn error(&self, scalar: &str, restitution: f64, surface: Option<[f64; 2]>) -> Option<f64> {
        let mut error = (restitution - self.restitution).abs();
        if let Some([velocity, spin]) = surface {
            let velocity = (velocity - self.surface[0]).abs() / self.speed;
            let spin = (spin - self.surface[1]).abs() * self.radius / self.speed;
            error = error.max(velocity).max(spin);
        }
        error.is_finite().then_some(error.max(rounding(scalar)))
    }
}

/// An entrant that can be run.
pub(super) struct Runner {
    pub(super) entrant: Entrant,
    /// Its error; `None` where it fails.
    pub(super) run: Box<dyn FnMut() -> Option<f64>>,
}

/// All entrants on the scene of Table 1.
pub(super) fn runners(run: &Run) -> Vec<Runner> {
    let extent = if run.quick {
        Extent { most_steps: 4096, sparse: true }
    } else {
        Extent { most_steps: 32_768, sparse: false }
    };
    let case = case("table1");
    let mut all = on_scene(&TABLE_1, &case, extent);
    let exact = solution(&case);
    let problem = ours::problem(&case);
    let mut others = ours::normal(&case);
    others.extend(runge_kutta::contestants(problem));
    others.extend(peers::all(problem));
    all.extend(others.into_iter().filter_map(|peer| with_outputs(peer, exact)));
    all
}

/// The entrants of the boards.
fn on_scene(inputs: &Inputs, case: &Case, extent: Extent) -> Vec<Runner> {
    let mut runners = Vec::new();
    let mut collector = Collector { exact: Exact::of(case), runners: &mut runners };
    visit::<f32>(inputs, extent, &mut collector);
    visit::<f64>(inputs, extent, &mut collector);
    visit_fixed_point(inputs, extent, &mut collector);
    runners
}

struct Collector<'a> {
    exact: Exact,
    runners: &'a mut Vec<Runner>,
}

impl Visitor for Collector<'_> {
    fn visit<T: Number>(&mut self, contestant: Contestant, mut run: impl FnMut() -> Option<Reply<T>> + 'static) {
        let entrant = Entrant {
            task: contestant.task.name().to_owned(),
            scalar: T::NAME.to_owned(),
            method: contestant.method.to_owned(),
            setting: contestant.to_string(),
        };
        let exact = Exact { ..self.exact };
        let error = move |reply: Reply<T>| {
            exact.error(T::NAME, reply.restitution.value(), reply.surface.map(|surface| surface.map(T::value)))
        };
        self.runners.push(Runner { entrant, run: Box::new(move || run().and_then(&error)) });
    }
}

/// A contestant that answers with contact time and impulse too.
fn with_outputs(mut peer: Peer, exact: Answer) -> Option<Runner> {
    if peer.answer().is_some_and(|answer| answer.impulse.is_none()) {
        return None;
    }
    let (entry, method, setting) = (peer.entry, &peer.method, &peer.setting);
    let (method_name, scalar) = match entry {
        ours::SINGLE_PRECISION => (ours::COLLOCATION, f32::NAME),
        _ => (entry, f64::NAME),
    };
    let entrant = Entrant {
        task: OUTPUTS.to_owned(),
        scalar: scalar.to_owned(),
        method: method_name.to_owned(),
        setting: if method.is_empty() { setting.clone() } else { format!("{method}, {setting}") },
    };
    let error = move |answer: Answer| {
        let largest = answer.errors(&exact).into_iter().flatten().fold(0.0, f64::max);
        largest.is_finite().then_some(largest.max(rounding(scalar)))
    };
    Some(Runner { entrant, run: Box::new(move || peer.answer().and_then(error)) })
}

/// Errors and least times.
pub(super) fn times(run: &Run, runners: &mut [Runner]) -> Series {
    let errors: Vec<Option<f64>> = runners.iter_mut().map(|runner| (runner.run)()).collect();
    let mut runs: Vec<_> = runners.iter_mut().map(|runner| || _ = black_box((runner.run)())).collect();
    let mut runs: Vec<&mut dyn FnMut()> = runs.iter_mut().map(|run| run as _).collect();
    let bar = run.progress(TURNS as usize, "times on the host");
    let times = least_times(&mut runs, TURNS, || bar.inc(1));
    let points = runners.iter().zip(errors).zip(times);
    let points = points.map(|((runner, error), cost)| Point { entrant: runner.entrant.clone(), error, cost });
    Series { processor: "host".to_owned(), unit: Unit::Seconds, points: points.collect() }
}

/// The largest error of each entrant over many scenes, `None` where it fails in one of them; and how many scenes.
pub(super) fn largest_errors(run: &Run) -> (HashMap<Entrant, Option<f64>>, usize) {
    let extent = Extent { most_steps: 1024, sparse: run.quick };
    let scenes: Vec<Case> = mild_rebounds().collect();
    let bar = run.progress(scenes.len(), "errors over all scenes");
    let mut errors: HashMap<Entrant, Option<f64>> = HashMap::new();
    for scene in &scenes {
        for mut runner in on_scene(&inputs(scene), scene, extent) {
            let error = (runner.run)();
            let largest = errors.entry(runner.entrant).or_insert(Some(0.0));
            *largest = largest.zip(error).map(|(largest, error)| largest.max(error));
        }
        bar.inc(1);
    }
    (errors, scenes.len())
}

fn inputs(case: &Case) -> Inputs {
    Inputs {
        radius: case.number("radius_m"),
        density: case.number("density_kg_m3"),
        stiffness: case.number("stiffness_pa"),
        ring: case.number("adhesion_n_m"),
        material_damping: case.number("zeta_h"),
        ring_damping: case.number("zeta_a"),
        friction: case.number("friction"),
        approach: case.number("speed_normal_m_s"),
        tangential: case.number("speed_tangential_m_s"),
        spin: case.number("spin_rad_s"),
    }
}
