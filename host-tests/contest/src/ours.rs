//! The methods of this library, from scenes and motions in SI units.

use std::hint::black_box;
use std::marker::PhantomData;
use std::rc::Rc;

use microimpact::contact::{
    Adaptive, Collocation, Contact, ContactLaw, FixedCost, Impulses, Method, Nodes, PhaseSamples, RungeKuttaGill,
    Surface, Times,
};
use microimpact::{Approach, Real, Stiffness};
use reference::Case;

use crate::contestant::{Answer, Asked, Contestant, Solver, tolerances};
use crate::problem::Problem;
use crate::scene::{hertz_scene, normal_scene, solved};

use microimpact_scenes::methods::ours::PAPER;
pub use microimpact_scenes::methods::ours::{ADAPTIVE, COLLOCATION, FIXED_COST};

/// Collocation in single precision.
pub const SINGLE_PRECISION: &str = "Collocation, f32";

/// The normal motion.
pub fn normal(case: &Case) -> Vec<Contestant> {
    let single = [normal_scene::<f32>(case)].into();
    let impacts = [normal_scene::<f64>(case)].into();
    let mut all = general(&impacts, Asked::Outputs);
    all.extend(collocation::<6, f32>(SINGLE_PRECISION, &single, Asked::Outputs));
    all.extend(collocation::<8, f32>(SINGLE_PRECISION, &single, Asked::Outputs));
    all.extend(fixed_costs(&impacts, Asked::Outputs));
    all.extend(paper_method(&impacts));
    all
}

/// The same impact with friction and spin.
pub fn oblique(case: &Case) -> Vec<Contestant> {
    let impacts = [(case.scene::<f64>().unwrap(), case.motion().unwrap())].into();
    let mut all = collocation::<6, f64>(COLLOCATION, &impacts, Asked::Outputs);
    all.extend(collocation::<7, f64>(COLLOCATION, &impacts, Asked::Outputs));
    all.extend(collocation::<9, f64>(COLLOCATION, &impacts, Asked::Outputs));
    all.extend(collocation::<12, f64>(COLLOCATION, &impacts, Asked::Outputs));
    all.extend(adaptive(&impacts, Asked::Outputs));
    all.extend(paper_method(&impacts));
    all
}

/// All methods but the paper's on the normal motion of impacts, one after another. Without adhesion the scene has none.
pub fn in_turn(cases: &[Case], asked: Asked) -> Vec<Contestant> {
    if cases.iter().all(|case| case.number("adhesion_n_m") == 0.0) {
        methods(&cases.iter().map(hertz_scene::<f64>).collect(), asked)
    } else {
        methods(&cases.iter().map(normal_scene::<f64>).collect(), asked)
    }
}

/// The equations that peers are given.
pub fn problem(case: &Case) -> Problem {
    let (scene, motion) = normal_scene(case);
    let stiffness = Stiffness::new(case.number("stiffness_pa")).unwrap();
    Problem::new(&scene, stiffness, &motion)
}

fn methods<I: Impact<f64>>(impacts: &Rc<[I]>, asked: Asked) -> Vec<Contestant> {
    let mut all = general(impacts, asked);
    all.extend(fixed_costs(impacts, asked));
    all
}

/// The methods with a tolerance.
fn general<I: Impact<f64>>(impacts: &Rc<[I]>, asked: Asked) -> Vec<Contestant> {
    let mut all = collocation::<5, f64>(COLLOCATION, impacts, asked);
    all.extend(collocation::<6, f64>(COLLOCATION, impacts, asked));
    all.extend(collocation::<7, f64>(COLLOCATION, impacts, asked));
    all.extend(collocation::<8, f64>(COLLOCATION, impacts, asked));
    all.extend(collocation::<9, f64>(COLLOCATION, impacts, asked));
    all.extend(collocation::<10, f64>(COLLOCATION, impacts, asked));
    all.extend(collocation::<12, f64>(COLLOCATION, impacts, asked));
    all.extend(collocation::<14, f64>(COLLOCATION, impacts, asked));
    all.extend(adaptive(impacts, asked));
    all
}

/// `FixedCost` with three nodes more for outputs, which impulses take.
fn fixed_costs<I: Impact<f64>>(impacts: &Rc<[I]>, asked: Asked) -> Vec<Contestant> {
    let mut all = fixed_cost::<5, 8>(impacts, asked);
    all.extend(fixed_cost::<6, 9>(impacts, asked));
    all.extend(fixed_cost::<7, 10>(impacts, asked));
    all.extend(fixed_cost::<8, 11>(impacts, asked));
    all.extend(fixed_cost::<9, 12>(impacts, asked));
    all.extend(fixed_cost::<10, 13>(impacts, asked));
    all
}

/// A scene and a motion, for any method.
trait Impact<T: Real>: Copy + 'static {
    fn restitution(&self, method: &impl Method<T>) -> Option<Answer>;
    fn outputs(&self, method: &impl Method<T>) -> Option<Answer>;
}

impl<T, L, S, B> Impact<T> for (Contact<T, L, S>, B)
where
    T: Real + Into<f64> + 'static,
    L: ContactLaw<T> + 'static,
    S: Surface<T, B> + 'static,
    B: Approach<T> + Copy + 'static,
    Self: Copy,
{
    fn restitution(&self, method: &impl Method<T>) -> Option<Answer> {
        let (scene, motion) = self;
        let contact = black_box(scene).solve_normal(black_box(motion), method).ok()?;
        Some(Answer::of_restitution(solved(contact.overall_restitution(), contact.status())?.into(), None))
    }

    fn outputs(&self, method: &impl Method<T>) -> Option<Answer> {
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

/// A method on impacts.
struct Ours<T, I, M> {
    impacts: Rc<[I]>,
    method: M,
    asked: Asked,
    scalar: PhantomData<T>,
}

impl<T: Real, I: Impact<T>, M: Method<T>> Solver for Ours<T, I, M> {
    fn solve(&mut self, tell: &mut dyn FnMut(Option<Answer>)) {
        for impact in self.impacts.iter() {
            tell(match self.asked {
                Asked::Restitution => impact.restitution(&self.method),
                Asked::Outputs => impact.outputs(&self.method),
            });
        }
    }
}

fn contestant<T: Real + 'static, I: Impact<T>>(
    (entry, variant, setting): (&'static str, String, String),
    impacts: &Rc<[I]>,
    method: impl Method<T> + 'static,
    asked: Asked,
) -> Contestant {
    Contestant::of(entry, variant, setting, Ours { impacts: Rc::clone(impacts), method, asked, scalar: PhantomData })
}

fn collocation<const N: usize, T: Nodes<N> + 'static>(
    entry: &'static str,
    impacts: &Rc<[impl Impact<T>]>,
    asked: Asked,
) -> Vec<Contestant> {
    let with = |tolerance: f64| {
        let method = Collocation::<N, T>::new(T::constant(tolerance)).ok()?;
        Some(contestant((entry, format!("{N} nodes"), format!("{tolerance:.0e}")), impacts, method, asked))
    };
    tolerances().filter_map(with).collect()
}

/// It chooses nodes and method by the tolerance.
fn adaptive(impacts: &Rc<[impl Impact<f64>]>, asked: Asked) -> Vec<Contestant> {
    let with = |tolerance: f64| {
        let method = Adaptive::new(tolerance).ok()?;
        Some(contestant((ADAPTIVE, String::new(), format!("{tolerance:.0e}")), impacts, method, asked))
    };
    tolerances().filter_map(with).collect()
}

fn fixed_cost<const N: usize, const M: usize>(impacts: &Rc<[impl Impact<f64>]>, asked: Asked) -> Vec<Contestant>
where
    f64: PhaseSamples<N, M>,
{
    let with = |iterations: u32| {
        let method = FixedCost::<N>::new(iterations).ok()?.with_outputs::<M>();
        let setting = format!("{iterations} iterations");
        Some(contestant((FIXED_COST, format!("{N} nodes"), setting), impacts, method, asked))
    };
    (2..=10).filter_map(with).collect()
}

/// Numbers of steps in the duration of Hertz's impact.
fn steps() -> impl Iterator<Item = u32> {
    (0..=14).map(|half_octaves| (250.0 * 2f64.powf(0.5 * f64::from(half_octaves))) as u32)
}

fn paper_method(impacts: &Rc<[impl Impact<f64>]>) -> Vec<Contestant> {
    let with = |steps: u32| {
        let names = (PAPER, "Runge-Kutta-Gill".to_owned(), format!("{steps} steps"));
        contestant(names, impacts, RungeKuttaGill::new(steps), Asked::Outputs)
    };
    steps().map(with).collect()
}
