//! How many times as fast arrays are as a loop of single calls, on one thread and on all.
//!
//! `cargo bench --package impact-arrays`

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use comfy_table::Table;
use impact_arrays::{
    Adhesion, Column, Contacts, Damping, Impacts, Law, Motions, Quantity, Restitution, RigidBodies, Surface,
};
use microimpact::contact::{Adaptive, Contact, FixedCost, Method};
use microimpact::rigid::SpeedRestitution;
use microimpact::{Class, InputError, NormalMotion, PlanarMotion, RigidBody, Sphere, Stiffness};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Rows by each model: a measurement takes about a millisecond, in which other work rarely interrupts it.
const ROWS_OF_RIGID_BODIES: usize = 8192;
const ROWS_OF_SIMULATIONS: usize = 256;

/// Measurements of the loop and of the arrays by turns; the least time of each counts.
const TURNS: usize = 300;

/// How many times more rows all threads share; both sides then also make the columns of their results.
const MORE: usize = 64;

/// Measurements of so many rows.
const LONG_TURNS: usize = 15;

/// The quantities that both compute, besides class and status.
const QUANTITIES: [Quantity; 2] = [Quantity::OverallRestitution, Quantity::SpinOut];

/// Numbers of the paper's Table 1 in SI units.
const DENSITY: f64 = 2600.0;
const GYRATION_RATIO: f64 = 0.4;
const STIFFNESS: f64 = 7.5e10;
const ADHESION: f64 = 250.0;
const ZETA_A: f64 = 6.25;
const ZETA_H: f64 = 10.5;
const FRICTION: f64 = 0.1;
const TANGENTIAL: f64 = 1.0;
const SPIN: f64 = 1.46e5;
const RESTITUTION_SPEED: f64 = 130.0;
const WORK_OF_ADHESION: f64 = 2.22e-12;

/// Radii in m and approach speeds in m/s of some rows.
struct Rows {
    radius: Vec<f64>,
    speed: Vec<f64>,
}

impl Rows {
    fn new(count: usize) -> Self {
        // Spheres that rebound and spheres that are captured alternate, as in a real stream of particles.
        let place = |row: usize, step: usize| (row * step % count) as f64 / count as f64;
        Self {
            radius: (0..count).map(|row| 2e-6 + 8e-6 * place(row, 7919)).collect(),
            speed: (0..count).map(|row| 0.5 + 10.0 * place(row, 104_729)).collect(),
        }
    }

    fn motions(&self) -> Motions<'_> {
        Motions::Planar {
            speed_normal: Column::Each(&self.speed),
            speed_tangential: Column::All(TANGENTIAL),
            spin: Column::All(SPIN),
        }
    }

    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        self.radius.iter().copied().zip(self.speed.iter().copied())
    }
}

/// A number that the compiler does not know, as those of a table.
fn given(number: f64) -> f64 {
    black_box(number)
}

/// What a single call gives: the class, if there is a result, and the quantities.
type Answer = (Option<Class>, [f64; QUANTITIES.len()]);

/// The columns of the loop, which it fills anew each time.
struct Results {
    status: Vec<Result<(), InputError>>,
    class: Vec<Option<Class>>,
    quantities: [Vec<f64>; QUANTITIES.len()],
}

impl Results {
    fn of(rows: usize) -> Self {
        Self {
            status: vec![Ok(()); rows],
            class: vec![None; rows],
            quantities: QUANTITIES.map(|_| vec![f64::NAN; rows]),
        }
    }

    /// Computes the first rows, each by a single call.
    #[inline(always)]
    fn fill(&mut self, rows: &Rows, single_call: impl Fn(f64, f64) -> Result<Answer, InputError>) {
        for (row, (radius, speed)) in rows.pairs().take(self.status.len()).enumerate() {
            let answer = single_call(radius, speed);
            self.status[row] = answer.map(|_| ());
            let (class, numbers) = answer.unwrap_or((None, [f64::NAN; QUANTITIES.len()]));
            self.class[row] = class;
            for (column, number) in self.quantities.iter_mut().zip(numbers) {
                column[row] = number;
            }
        }
        black_box(self);
    }
}

#[inline(always)]
fn sphere(radius: f64) -> Result<Sphere<f64>, InputError> {
    Sphere::new(radius, given(DENSITY), given(GYRATION_RATIO))
}

#[inline(always)]
fn motion(sphere: &Sphere<f64>, speed: f64) -> Result<PlanarMotion<f64>, InputError> {
    NormalMotion::new(speed)?.with_tangential(given(TANGENTIAL))?.with_spin(sphere, given(SPIN))
}

/// In a loop it is a part of it, as in the arrays.
#[inline(always)]
fn rigid_body(radius: f64, speed: f64) -> Result<Answer, InputError> {
    let sphere = sphere(radius)?;
    let body = RigidBody::new(sphere, SpeedRestitution::new(given(RESTITUTION_SPEED))?)
        .with_work_of_adhesion(given(WORK_OF_ADHESION))?
        .with_friction(given(FRICTION))?;
    let impact = body.impact(&motion(&sphere, speed)?);
    let class = body.classify_impact(&impact).class();
    Ok((Some(class), [impact.normal.overall_restitution(), impact.tangential.spin(&sphere)]))
}

fn simulation(radius: f64, speed: f64, method: &impl Method<f64>) -> Result<Answer, InputError> {
    let sphere = sphere(radius)?;
    let contact = Contact::hertz(sphere, Stiffness::new(given(STIFFNESS))?)
        .with_damping(given(ZETA_H))?
        .with_ring(given(ADHESION), given(ZETA_A))?
        .with_friction(given(FRICTION))?;
    let impact = contact.solve(&motion(&sphere, speed)?, method)?;
    Ok((impact.class(), [impact.normal.overall_restitution(), impact.tangential.spin()]))
}

/// Seconds of a run.
fn seconds<R>(run: impl FnOnce() -> R) -> f64 {
    let start = Instant::now();
    black_box(run());
    start.elapsed().as_secs_f64()
}

/// Least times of two runs by turns, s.
fn least(turns: usize, mut one: impl FnMut(), mut other: impl FnMut()) -> [f64; 2] {
    (0..turns).fold([f64::INFINITY; 2], |[a, b], _| [a.min(seconds(&mut one)), b.min(seconds(&mut other))])
}

/// A line of the table: nanoseconds of a row in a loop, and how many times as fast arrays are, on one thread and, with more rows, on all.
/// `arrays` computes a number of rows.
fn line(
    model: &str,
    count: usize,
    one: &ThreadPool,
    rows: &Rows,
    single_call: impl Fn(f64, f64) -> Result<Answer, InputError> + Sync,
    arrays: impl Fn(usize) -> Impacts + Sync,
) -> [String; 4] {
    let compute = |count| {
        black_box(arrays(count));
    };
    let mut results = Results::of(count);
    let [alone, together] = one.install(|| least(TURNS, || results.fill(rows, &single_call), || compute(count)));
    let more = MORE * count;
    let [alone_more, on_all] = least(LONG_TURNS, || Results::of(more).fill(rows, &single_call), || compute(more));
    let nanoseconds = format!("{:.0}", 1e9 * alone / count as f64);
    [model.to_owned(), nanoseconds, format!("{:.2}", alone / together), format!("{:.2}", alone_more / on_all)]
}

fn main() -> Result<(), Box<dyn Error>> {
    let one = ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut table = Table::new();
    let threads = format!("factor, {} threads", rayon::current_num_threads());
    table.set_header(["model", "loop, ns a row", "factor, 1 thread", &threads]);

    let rows = Rows::new(MORE * ROWS_OF_RIGID_BODIES);
    let bodies = RigidBodies {
        radius: Column::Each(&rows.radius),
        density: Column::All(DENSITY),
        gyration_ratio: Column::All(GYRATION_RATIO),
        restitution: Restitution::Power { speed: Column::All(RESTITUTION_SPEED), power: Column::All(1.0) },
        adhesion: Adhesion::Work(Column::All(WORK_OF_ADHESION)),
        friction: Column::All(FRICTION),
        rolling_arm: Column::All(0.0),
    };
    let arrays = |count| bodies.classify(&rows.motions(), count, &QUANTITIES);
    table.add_row(line("rigid body", ROWS_OF_RIGID_BODIES, &one, &rows, rigid_body, arrays));

    let rows = Rows::new(MORE * ROWS_OF_SIMULATIONS);
    let contacts = Contacts {
        radius: Column::Each(&rows.radius),
        density: Column::All(DENSITY),
        stiffness: Column::All(STIFFNESS),
        law: Law::Ring { strength: Column::All(ADHESION), damping: Column::All(ZETA_A) },
        damping: Damping::Hysteretic(Column::All(ZETA_H)),
        surface: Surface::Coulomb { friction: Column::All(FRICTION) },
        ..Contacts::default()
    };
    let method = Adaptive::new(1e-9)?;
    let alone = |radius, speed| simulation(radius, speed, &method);
    let arrays = |count| contacts.simulate(&rows.motions(), count, &method, &QUANTITIES);
    table.add_row(line("simulation, Adaptive, 1e-9", ROWS_OF_SIMULATIONS, &one, &rows, alone, arrays));
    // In lanes, as fast as the processor's vectors allow.
    let quick = FixedCost::<7>::new(3)?;
    let alone = |radius, speed| simulation(radius, speed, &quick);
    let arrays = |count| contacts.simulate_in_lanes(&rows.motions(), count, &quick, &method, &QUANTITIES);
    table.add_row(line("simulation, FixedCost<7>, in lanes", ROWS_OF_SIMULATIONS, &one, &rows, alone, arrays));
    println!("{table}");
    Ok(())
}
