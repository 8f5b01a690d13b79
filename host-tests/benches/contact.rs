//! The contact of Table 1 by collocation, by the paper's own method, and by other crates' solvers.
//!
//! Each benchmark is named with the error of e that it reaches, so that times are compared at equal error. The peers get
//! the regularised equations in the contact radius s, in which the motion is smooth and free of roots,
//!
//! ds/dz = y,   dy/dz = 2 s^2 (B (1 - g y) - A s^2 (1 + h y)),   dt/dz = 2 s,   dI/dz = 2 A s^4
//!
//! with g = 0 on approach, and are asked for what the others give: e, contact time and Hertz impulse. Where a peer
//! locates events it does so; where it does not, it stops short of the event, at a place given to it, and takes the rest
//! with the event's own variable as the independent one.

use std::cell::Cell;
use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use differential_equations::control::ControlFlag;
use differential_equations::interpolate::Interpolation;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod, solve_ode};
use differential_equations::prelude::ExplicitRungeKutta;
use differential_equations::solout::Solout;
use differential_equations::solution::Solution;
use microimpact::simulation::{
    Collocation, ContactImpulses, ContactTimes, HystereticDamping, Nodes, Ring, RungeKuttaGill, SimulatedImpact,
    Simulation, SteppedImpact,
};
use microimpact::{Coulomb, NormalMotion, PlanarMotion, Real, Sphere, Stiffness};
use ode_solvers::{Dop853, Dopri5, OutputType, SVector, System};

const CASES: &str = include_str!("../data/cases.csv");

/// A column of Table 1 in the reference.
fn exact(column: &str) -> f64 {
    let mut reader = csv::Reader::from_reader(CASES.as_bytes());
    let index = reader.headers().unwrap().iter().position(|name| name == column).unwrap();
    reader.records().next().unwrap().unwrap()[index].parse().unwrap()
}

type NormalScene<T> = Simulation<T, HystereticDamping<T>, Ring<T>>;
type ObliqueScene<T> = Simulation<T, HystereticDamping<T>, Ring<T>, Coulomb<T>>;
type Outputs<T> = (ContactTimes<T>, ContactImpulses<T>);

fn normal_scene<T: Real>() -> (NormalScene<T>, NormalMotion<T>) {
    let number = |column| T::constant(exact(column));
    let sphere = Sphere::solid(number("radius_m"), number("density_kg_m3")).unwrap();
    let scene = Simulation::new(sphere, Stiffness::new(number("stiffness_pa")).unwrap())
        .with_damping(number("zeta_h"))
        .unwrap()
        .with_ring(number("adhesion_n_m"), number("zeta_a"))
        .unwrap();
    (scene, NormalMotion::new(number("speed_normal_m_s")).unwrap())
}

fn oblique_scene<T: Real>() -> (ObliqueScene<T>, PlanarMotion<T>) {
    let number = |column| T::constant(exact(column));
    let (scene, motion) = normal_scene::<T>();
    let motion = motion.with_tangential(number("speed_tangential_m_s")).unwrap();
    let motion = motion.with_spin(scene.sphere(), number("spin_rad_s")).unwrap();
    (scene.with_friction(number("friction")).unwrap(), motion)
}

/// Measures `solve`, which returns e, under a name that states its error.
fn measure(group: &mut BenchmarkGroup<WallTime>, name: &str, mut solve: impl FnMut() -> f64) {
    let error = (solve() - exact("restitution")).abs();
    group.bench_function(format!("{name}, error {error:.0e}"), |bencher| bencher.iter(&mut solve));
}

fn collocation<const N: usize, T: Nodes<N> + Into<f64>>(group: &mut BenchmarkGroup<WallTime>, tolerance: f64) {
    let name = format!("collocation {} at {N} nodes, {tolerance:e}", std::any::type_name::<T>());
    let method = Collocation::<N, T>::new(T::constant(tolerance)).unwrap();
    let (scene, motion) = normal_scene::<T>();
    measure(group, &name, || {
        let impact: SimulatedImpact<_, _, Outputs<T>> = black_box(&scene).observe(&method, black_box(&motion)).unwrap();
        black_box(impact).normal.overall_restitution().into()
    });
}

fn oblique_collocation<const N: usize, T: Nodes<N> + Into<f64>>(group: &mut BenchmarkGroup<WallTime>, tolerance: f64) {
    let name = format!("collocation {} at {N} nodes, {tolerance:e}", std::any::type_name::<T>());
    let method = Collocation::<N, T>::new(T::constant(tolerance)).unwrap();
    let (scene, motion) = oblique_scene::<T>();
    measure(group, &name, || {
        let impact: SimulatedImpact<_, _, Outputs<T>> = black_box(&scene).observe(&method, black_box(&motion)).unwrap();
        black_box(impact).normal.overall_restitution().into()
    });
}

/// Steps of the paper's method for an error of e of 1e-6.
const STEPS: u32 = 2900;

/// The regularised equations, with the variable that they are solved against.
#[derive(Clone, Copy)]
struct Regularised {
    elastic: f64,
    adhesion: f64,
    material_damping: f64,
    adhesion_damping: f64,
    rebound: bool,
    against: Variable,
}

#[derive(Clone, Copy)]
enum Variable {
    Stretched,
    Speed,
    Radius,
}

/// Contact radius, speed, time and Hertz impulse.
type Vector = [f64; 4];

impl Regularised {
    fn table1() -> Self {
        Self {
            elastic: exact("group_a"),
            adhesion: exact("group_b"),
            material_damping: exact("group_h"),
            adhesion_damping: exact("group_g"),
            rebound: false,
            against: Variable::Stretched,
        }
    }

    /// Speed at first touch: the scale of length is the undamped peak, where this energy is spent.
    fn start(&self) -> Vector {
        [0.0, (0.8 * self.elastic - 4.0 / 3.0 * self.adhesion).sqrt(), 0.0, 0.0]
    }

    #[inline]
    fn rates(&self, [s, y, _, _]: Vector) -> Vector {
        let square = s * s;
        let lost = if self.rebound { self.adhesion_damping * y } else { 0.0 };
        let pull = self.adhesion * (1.0 - lost) - self.elastic * square * (1.0 + self.material_damping * y);
        let rates = [y, 2.0 * square * pull, 2.0 * s, 2.0 * self.elastic * square * square];
        let share = match self.against {
            Variable::Stretched => return rates,
            Variable::Speed => 1.0 / rates[1],
            Variable::Radius => 1.0 / rates[0],
        };
        rates.map(|rate| rate * share)
    }

    /// e by a solver without events, which takes the equations from a state at one value of the variable to another.
    #[inline]
    fn without_events(self, places: [f64; 2], mut leg: impl FnMut(Self, f64, Vector, f64) -> Vector) -> f64 {
        let start = self.start();
        let short = leg(self, 0.0, start, places[0]);
        let peak = leg(Self { against: Variable::Speed, ..self }, short[1], short, 0.0);
        let back = Self { rebound: true, ..self };
        let short = leg(back, 0.0, peak, places[1]);
        let end = leg(Self { against: Variable::Radius, ..back }, short[0], short, 0.0);
        black_box(end)[1] / -start[1]
    }
}

/// The equations for `differential_equations`, with the side of the peak that they are on.
struct Sided {
    approach: Regularised,
    rebound: Cell<bool>,
}

impl ODE<f64, Vector> for Sided {
    #[inline]
    fn diff(&self, _z: f64, state: &Vector, rates: &mut Vector) {
        *rates = Regularised { rebound: self.rebound.get(), ..self.approach }.rates(*state);
    }
}

/// Locates the peak and the separation on the solver's own interpolation, by the Illinois method.
struct Events<'a> {
    system: &'a Sided,
    places: Vec<f64>,
    end: Vector,
}

impl Solout<f64, Vector> for Events<'_> {
    fn solout<I: Interpolation<f64, Vector> + ?Sized>(
        &mut self,
        now: f64,
        before: f64,
        state: &Vector,
        state_before: &Vector,
        interpolation: &mut I,
        _solution: &mut Solution<f64, Vector>,
    ) -> ControlFlag<f64, Vector> {
        let rebound = self.system.rebound.get();
        let index = usize::from(!rebound);
        if state[index] > 0.0 || now == before || (rebound && state_before[0] <= 0.0) || (!rebound && state[1] == 0.0) {
            return ControlFlag::Continue;
        }
        let (mut low, mut high) = ((before, state_before[index]), (now, state[index]));
        let mut root = (now, *state);
        for _ in 0..12 {
            let place = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            root = (place, interpolation.interpolate(place).unwrap());
            let value = root.1[index];
            if value.abs() < 1e-15 {
                break;
            }
            if value > 0.0 {
                low = (place, value);
                high.1 *= 0.5;
            } else {
                high = (place, value);
                low.1 *= 0.5;
            }
        }
        self.places.push(root.0);
        if rebound {
            self.end = root.1;
            return ControlFlag::Terminate;
        }
        self.system.rebound.set(true);
        root.1[1] = 0.0;
        ControlFlag::ModifyState(root.0, root.1)
    }
}

/// e, and where the events were. A solver lives on the stack and counts its steps over all runs, so each run has its own.
fn differential_equations_solve(
    mut solver: impl OrdinaryNumericalMethod<f64, Vector> + Interpolation<f64, Vector>,
    equations: Regularised,
) -> (f64, Vec<f64>) {
    let system = Sided { approach: equations, rebound: Cell::new(false) };
    let start = equations.start();
    let mut events = Events { system: &system, places: Vec::with_capacity(2), end: start };
    black_box(solve_ode(&mut solver, &system, 0.0, 20.0, &start, &mut events).unwrap());
    (black_box(events.end)[1] / -start[1], events.places)
}

impl System<f64, SVector<f64, 4>> for Regularised {
    fn system(&self, _z: f64, state: &SVector<f64, 4>, rates: &mut SVector<f64, 4>) {
        *rates = self.rates((*state).into()).into();
    }
}

fn peers(group: &mut BenchmarkGroup<WallTime>) {
    let equations = Regularised::table1();
    // Places a little before the events, for those that do not look for them.
    let fine = ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13);
    let (_, places) = differential_equations_solve(fine, equations);
    let places = [0.97 * places[0], 0.97 * (places[1] - places[0])];

    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        measure(group, &format!("differential-equations dop853, {tolerance:e}"), || {
            let solver = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance);
            differential_equations_solve(solver, black_box(equations)).0
        });
        measure(group, &format!("ode_solvers dop853, {tolerance:e}"), || {
            black_box(equations).without_events(places, |system, from, state, to| {
                let mut solver = Dop853::new(system, from, to, to - from, state.into(), tolerance, tolerance);
                solver.set_output(OutputType::Sparse);
                solver.integrate().unwrap();
                (*solver.y_out().last().unwrap()).into()
            })
        });
        if tolerance >= 1e-8 {
            measure(group, &format!("differential-equations dopri5, {tolerance:e}"), || {
                let solver = ExplicitRungeKutta::dopri5().rtol(tolerance).atol(tolerance);
                differential_equations_solve(solver, black_box(equations)).0
            });
            measure(group, &format!("ode_solvers dopri5, {tolerance:e}"), || {
                black_box(equations).without_events(places, |system, from, state, to| {
                    let mut solver = Dopri5::new(system, from, to, to - from, state.into(), tolerance, tolerance);
                    solver.set_output(OutputType::Sparse);
                    solver.integrate().unwrap();
                    (*solver.y_out().last().unwrap()).into()
                })
            });
        }
    }
}

fn configured<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(20).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(600));
    group
}

fn normal(criterion: &mut Criterion) {
    let mut group = configured(criterion, "Table 1, e, time and impulse");
    collocation::<6, f64>(&mut group, 1e-6);
    collocation::<7, f64>(&mut group, 1e-6);
    collocation::<9, f64>(&mut group, 1e-9);
    collocation::<12, f64>(&mut group, 1e-12);
    collocation::<8, f32>(&mut group, 1e-6);
    let (scene, motion) = normal_scene::<f64>();
    measure(&mut group, &format!("Runge-Kutta-Gill, {STEPS} steps"), || {
        let impact: SteppedImpact<_, _, Outputs<f64>> =
            black_box(&scene).stepped_impact(&RungeKuttaGill::new(STEPS), black_box(&motion)).unwrap();
        black_box(impact).normal.overall_restitution()
    });
    peers(&mut group);
}

fn oblique(criterion: &mut Criterion) {
    let mut group = configured(criterion, "Table 1, oblique");
    oblique_collocation::<6, f64>(&mut group, 1e-6);
    oblique_collocation::<7, f64>(&mut group, 1e-6);
    oblique_collocation::<9, f64>(&mut group, 1e-9);
    oblique_collocation::<12, f64>(&mut group, 1e-12);
    oblique_collocation::<8, f32>(&mut group, 1e-6);
    let (scene, motion) = oblique_scene::<f64>();
    measure(&mut group, &format!("Runge-Kutta-Gill, {STEPS} steps"), || {
        let impact: SteppedImpact<_, _, Outputs<f64>> =
            black_box(&scene).stepped_impact(&RungeKuttaGill::new(STEPS), black_box(&motion)).unwrap();
        black_box(impact).normal.overall_restitution()
    });
}

criterion_group!(benches, normal, oblique);
criterion_main!(benches);
